//! `explain`: text, JSON, OBJ lines, refusals, device loss.

use crate::support::program::{Run, Workspace};
use serde_json::Value;
use std::fs;

#[test]
fn explain_writes_text_json_and_obj_lines() {
    let workspace = Workspace::new();
    let run = workspace
        .run("explain a.scene --size 9x9 --pixel 4,4 --obj rays.obj")
        .expect(0);
    insta::assert_snapshot!(run.text(), @r"
    pixel 4,4 of 9×9
    sample 0: 2 ray(s), weight 1
    └ primary hits shape 0 at distance 2, material 0
      │ at (0, 0, -2), normal (0, 0, 1), from outside
      │ throughput 1 1 1, contribution 0.1 0.1 0.1 (ambient 0.1 0.1 0.1)
      └ shadow to light 0, 4.123 away: unoccluded, throughput 1 1 1, contribution 0.5097 0.07311 0.07311
          L 1 1 1, l·n 0.7276, r·v 0.7276, α 20
          diffuse 0.5093 0.07276 0.07276 (k_d 0.7 0.1 0.1), highlight 0.0003459 0.0003459 0.0003459 (k_s 0.2 0.2 0.2)
      sum 0.6097 0.1731 0.1731, colour 0.6097 0.1731 0.1731
    sum    0.6097 0.1731 0.1731, the weighted mean of 1 sample(s)
    pixel  0.6097 0.1731 0.1731 (linear)
    ");
    let lines = fs::read_to_string(workspace.path("rays.obj")).expect("lines");
    // From the camera to the sphere, and from there to the light. Shadow rays start slightly above the
    // surface.
    let vertices = lines.lines().filter_map(|line| line.strip_prefix("v "));
    let numbers = vertices.flat_map(|vertex| vertex.split(' ').map(|c| c.parse::<f64>()));
    let expected = [0.0, 0.0, 0.0, 0.0, 0.0, -2.0, 0.0, 0.0, -2.0, 2.0, 2.0, 1.0];
    let numbers: Vec<_> = numbers.map(|number| number.expect("a number")).collect();
    assert_eq!(numbers.len(), expected.len(), "{lines}");
    let near = |(a, b): (&f64, f64)| (a - b).abs() < 1e-4;
    assert!(numbers.iter().zip(expected).all(near), "{lines}");
    let words: Vec<_> = lines
        .lines()
        .filter(|line| !line.starts_with("v "))
        .collect();
    assert_eq!(
        words,
        [
            "# rays of pixel 4,4",
            "o sample_0",
            "g primary",
            "l 1 2",
            "g shadow",
            "l 3 4"
        ]
    );
    let json = workspace
        .run("explain a.scene --size 9x9 --pixel 4,4 --json")
        .expect(0)
        .json();
    assert_eq!(json["pixel"], serde_json::json!([4, 4]));
    assert_eq!(json["size"], serde_json::json!([9, 9]));
    let rays = &json["samples"][0]["rays"];
    assert_eq!(rays[0]["kind"], "primary");
    assert_eq!(
        rays[0]["hit"]["object"],
        serde_json::json!({ "kind": "shape", "index": 0 })
    );
    assert_eq!(rays[1]["kind"], "shadow");
    assert_eq!(rays[1]["parent"], 0);
    assert_eq!(rays[0]["children"], serde_json::json!([1]));
    for channel in 0..3 {
        let of = |value: &Value| value[channel].as_f64().expect("a number");
        let sum = of(&rays[0]["contribution"]) + of(&rays[1]["contribution"]);
        assert!((sum - of(&json["value"])).abs() < 1e-6, "{json:#}");
        assert!((sum - of(&json["sum"])).abs() < 1e-6, "{json:#}");
    }
}

#[test]
fn explain_lists_the_rays_of_a_path_one_after_the_other() {
    let workspace = Workspace::new();
    let line = "explain a.scene --size 9x9 --pixel 4,4 --integrator path --samples 1";
    let run = workspace.run(line).expect(0);
    insta::assert_snapshot!(run.text(), @r"
    pixel 4,4 of 9×9
    sample 0: 3 ray(s), weight 1
    ├ primary hits shape 0 at distance 2, material 0
    │ at (0, 0, -2), normal (0, 0, 1), from outside
    │ reflects 0.2 0.2 0.2
    │ throughput 1 1 1, contribution 0 0 0
    │ samples light 0, chance 1, 4.123 away: unoccluded
    │   radiance per density 3.142 3.142 3.142, BSDF 0.1288 0.01967 0.01967, weight 1, path density 0.1079, contribution 0.4046 0.06181 0.06181
    │ goes on: diffuse, BSDF 0.1621 0.02844 0.02844, density 0.1427, factor 1.136 0.1993 0.1993
    └ diffuse reflection towards (0.24, 0.3848, 0.8913) hits nothing
      throughput 1.136 0.1993 0.1993, contribution 1.136 0.1993 0.1993 (background 1 1 1, weight 1, path density 0.1427)
      sum 1.541 0.2611 0.2611, colour 1.541 0.2611 0.2611
    sum    1.541 0.2611 0.2611, the weighted mean of 1 sample(s)
    pixel  1.541 0.2611 0.2611 (linear)
    ");
    let json = workspace.run(&format!("{line} --json")).expect(0).json();
    assert_eq!(json["integrator"], "path");
    let rays = &json["samples"][0]["rays"];
    let shadow = &rays[1];
    assert_eq!(
        (&shadow["kind"], &shadow["parent"]),
        (&"shadow".into(), &0.into())
    );
    // A lamp without extent is found by light samples only.
    assert_eq!(shadow["sharing"]["light_pdf"], Value::Null);
    assert_eq!(shadow["sharing"]["light_weight"], 1.0);
    assert_eq!(shadow["shadow"]["sample"]["source"], "light");
    assert_eq!(shadow["shadow"]["sample"]["chance"], 1.0);
    let step = &rays[0]["step"];
    assert_eq!(
        (&step["outcome"], &step["survival"]),
        (&"scattered".into(), &1.0.into())
    );
    assert_eq!(rays[2]["lobe"], step["lobe"]);
    assert_eq!(rays[2]["throughput"], step["throughput"]);
}

#[test]
fn explaining_a_missing_pixel_or_sample_exits_2_with_one_line() {
    let workspace = Workspace::new();
    let run = |flags: &str| {
        let run = workspace
            .run(&format!("explain a.scene --size 9x9 {flags}"))
            .expect(2);
        assert_eq!(run.stderr.lines().count(), 1, "{}", run.stderr);
        run.stderr
    };
    insta::assert_snapshot!(run("--pixel 9,0"), @"error: no such pixel (--pixel 9,0): the picture has columns 0 to 8 and rows 0 to 8. Choose a pixel inside.");
    insta::assert_snapshot!(run("--pixel 0,0 --crop 2,3,5,6"), @"error: no such pixel (--pixel 0,0): the --crop region has columns 2 to 4 and rows 3 to 5. Choose a pixel inside.");
    insta::assert_snapshot!(run("--pixel 0,0 --integrator depth"), @"error: cannot explain (--integrator depth): only whitted and path trace rays. Choose one of them.");
    insta::assert_snapshot!(run("--pixel 0,0 --sample 4 --samples 4"), @"error: no such sample (--sample 4): the pixel has 4, from 0 to 3. Choose one of these, or raise --samples.");
    workspace.run("explain a.scene").expect(2);
    workspace.run("explain a.scene --pixel 1").expect(2);
    workspace.run("explain a.scene --pixel 1,-1").expect(2);
    workspace
        .run("explain a.scene --pixel 1,1 --obj no/rays.obj")
        .expect(4);
    workspace.run("explain nothing.scene --pixel 1,1").expect(3);
}

#[test]
fn a_lost_device_does_not_change_the_ray_tree() {
    let workspace = Workspace::new();
    let line = "explain a.scene --size 9x9 --samples 4 --pixel 4,4 --json";
    let expected = workspace.run(line).expect(0);
    // The first submission clears the film, the second one warms up the pipeline; two more count and record the rays.
    for fault in [
        "device@2",
        "device@3",
        "device@4",
        "device@3,6",
        "device@1,4,7",
    ] {
        let mut command = workspace.command(line);
        let run = Run::from(
            command
                .env("GLIMRAY_FAULT", fault)
                .output()
                .expect("glimray runs"),
        );
        assert_eq!(run.expect(0).text(), expected.text(), "{fault}");
    }
    let mut command = workspace.command(line);
    let run = Run::from(
        command
            .env("GLIMRAY_FAULT", "device@*")
            .output()
            .expect("it runs"),
    );
    run.expect(6);
}
