//! The fields of the report.

use crate::support::program::Workspace;
use serde_json::{Value, json};
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
        cut_off_trees error fetch.reason fetch.storage \
        glimray image.bsdf image.clamp_indirect image.denoise image.height image.integrator image.max_depth \
        image.mean_samples image.path image.samples image.seed image.transparent_shadows image.width memory.gpu_bytes memory.host_peak_bytes nonfinite_samples rays.primary \
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

/// Whoever has the picture and its report can tell what is missing in the light.
#[test]
fn the_report_says_what_the_light_of_paths_lacks() {
    let workspace = Workspace::new();
    let render = |flags: &str| {
        let line =
            format!("render a.scene --size 8x8 --samples 2 {flags} --report r.json -o a.png");
        let run = workspace.run(&line).expect(0);
        let report: Value = serde_json::from_slice(&workspace.read("r.json")).expect("JSON");
        let image = &report["image"];
        let names = ["transparent_shadows", "clamp_indirect", "bsdf", "denoise"];
        (json!(names.map(|name| &image[name])), run)
    };
    let path = "--integrator path";
    let biased = "--transparent-shadows --clamp-indirect 2.5 --bsdf spec --denoise -v";
    let (said, run) = render(&format!("{path} {biased}"));
    assert_eq!(said, json!([true, 2.5, "spec", true]));
    let text = "paths: BSDF spec; all glass lets shadow rays pass, without caustics; indirect light is clamped to 2.5";
    run.says(text);
    run.says("removed about ");
    let (said, _) = render(path);
    assert_eq!(said, json!([false, null, "full", false]));
    let (said, _) = render("--integrator whitted");
    assert_eq!(said, json!([null, null, null, false]));
}

/// Only where shadow catchers are seen is there something that their cap could take away.
#[test]
fn the_report_says_what_the_cap_takes_from_shadow_catchers() {
    let workspace = Workspace::new();
    let scene = "[output]\nsize = [8, 8]\nbackdrop = \"transparent\"\nintegrator = \"path\"\n\
        [[lights]]\npoint = { position = [0, 3, 0] }\n\
        [[objects]]\nplane = { point = [0, -1, 0] }\n";
    let report = |catcher: bool| -> Value {
        let material = format!("material = {{ shadow_catcher = {catcher} }}\n");
        workspace.write("catcher.toml", &(scene.to_owned() + &material));
        workspace
            .run("render catcher.toml --samples 4 -v --report r.json -o a.png")
            .expect(0);
        serde_json::from_slice(&workspace.read("r.json")).expect("JSON")
    };
    let cut = report(true)["catcher_cut"].as_f64().expect("a share");
    assert!((0.0..=1.0).contains(&cut), "{cut}");
    assert_eq!(report(false).get("catcher_cut"), None);
}
