//! The fields of the report.

use crate::support::program::Workspace;
use serde_json::Value;
use std::fs;

/// The names of all fields, such as `outer.inner`.
fn field_names(value: &Value, prefix: &str) -> Vec<String> {
    let Value::Object(fields) = value else {
        return vec![prefix.trim_end_matches('.').into()];
    };
    let mut names: Vec<_> = fields
        .iter()
        .flat_map(|(name, value)| field_names(value, &format!("{prefix}{name}.")))
        .collect();
    names.sort();
    names
}

#[test]
fn the_report_has_the_promised_fields() {
    let workspace = Workspace::new();
    workspace
        .run("render a.scene --size 32x24 --count-rays --report r.json -o a.png")
        .expect(0);
    let text = fs::read_to_string(workspace.path("r.json")).expect("a report");
    let report: Value = serde_json::from_str(&text).expect("JSON");
    let promised = "adapter.backend adapter.device_type adapter.driver adapter.name command \
        cut_off_trees error fetch.buffer_seconds fetch.image_seconds fetch.reason fetch.seconds fetch.storage \
        glimray image.height image.integrator image.max_depth image.mean_samples image.path image.samples image.seed \
        image.width memory.gpu_bytes memory.host_peak_bytes nonfinite_samples rays.primary \
        rays.primary_hits rays.reflection rays.reflection_hits rays.refraction \
        rays.refraction_hits rays.shadow rays.shadow_blocked scene.instances scene.lights \
        scene.materials scene.path scene.shapes scene.skipped scene.spheres scene.triangles \
        seconds.bvh seconds.compile seconds.develop seconds.gpu seconds.load seconds.total \
        seconds.trace seconds.upload seconds.write submissions.count submissions.longest_ms";
    assert_eq!(field_names(&report, "").join(" "), promised);
    assert_eq!(report["command"], "render");
    assert_eq!(report["scene"]["spheres"], 1);
    assert_eq!(report["image"]["width"], 32);
    assert_eq!(report["image"]["path"], "a.png");
    assert_eq!(report["image"]["integrator"], "whitted");
    assert_eq!(report["rays"]["primary"], 32 * 24);
    let seconds = |name: &str| report["seconds"][name].as_f64().expect(name);
    let parts = [
        "load", "bvh", "gpu", "compile", "upload", "trace", "develop", "write",
    ];
    let sum: f64 = parts.iter().map(|part| seconds(part)).sum();
    assert!(sum <= seconds("total"), "{report}");
}

#[test]
fn rays_are_null_unless_counted_and_the_report_can_go_to_standard_output() {
    let workspace = Workspace::new();
    let run = workspace
        .run("render a.scene --size 8x8 --report - -o a.png")
        .expect(0);
    assert_eq!(run.json()["rays"], Value::Null);
}
