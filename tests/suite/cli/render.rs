//! `render` and `demo`: files, crops, linear formats.

use crate::support::program::Workspace;
use std::fs;

#[test]
fn the_same_command_gives_the_same_bytes_under_the_scenes_name() {
    let workspace = Workspace::new();
    let render = || {
        workspace
            .run("render a.scene --size 64x48 --samples 4")
            .expect(0);
        fs::read(workspace.path("a.png")).expect("a picture")
    };
    assert!(render() == render());
    assert_eq!(workspace.made(), ["a.png"]);
}

#[test]
fn a_crop_equals_that_part_of_the_whole_picture() {
    let workspace = Workspace::new();
    workspace
        .run("render a.scene --size 64x48 -o whole.png")
        .expect(0);
    workspace
        .run("render a.scene --size 64x48 --crop 20,10,45,31 -o part.png")
        .expect(0);
    let whole = image::open(workspace.path("whole.png")).expect("a picture");
    let part = image::open(workspace.path("part.png")).expect("a picture");
    assert!(whole.crop_imm(20, 10, 25, 21).into_rgb8() == part.into_rgb8());
}

#[test]
fn linear_formats_store_radiance_without_tone_curve_or_transfer() {
    let workspace = Workspace::new();
    workspace
        .run("render a.scene --size 16x16 -o a.exr")
        .expect(0);
    workspace
        .run("render a.scene --size 16x16 -o b.png --transfer linear --tone none")
        .expect(0);
    workspace
        .run("compare a.exr b.png --tolerance 0.51")
        .expect(0);
    workspace
        .run("render a.scene --size 16x16 -o c.exr --transfer srgb")
        .expect(0);
    workspace.run("compare a.exr c.exr --tolerance 1").expect(8);
}

#[test]
fn the_demo_needs_no_file() {
    let workspace = Workspace::new();
    workspace.run("demo --size 32x18").expect(0);
    let demo = image::open(workspace.path("glimray.png")).expect("a picture");
    assert_eq!((demo.width(), demo.height()), (32, 18));
}

#[test]
fn gltf_models_are_path_traced_unless_the_command_line_says_otherwise() {
    let workspace = Workspace::new();
    let model = crate::import::gltf::model::Model::triangle(serde_json::json!({}));
    workspace.write("m.glb", model.glb());
    let image = |command: &str| {
        workspace
            .run(&format!(
                "render {command} --size 8x6 -o p.png --report r.json"
            ))
            .expect(0);
        let report = fs::read_to_string(workspace.path("r.json")).expect("a report");
        let report: serde_json::Value = serde_json::from_str(&report).expect("JSON");
        report["image"].clone()
    };
    for (command, integrator, samples, depth) in [
        ("m.glb", "path", 64, 16),
        ("m.glb --integrator whitted", "whitted", 16, 8),
        ("m.glb --samples 2 --max-depth 3", "path", 2, 3),
        ("a.scene", "whitted", 1, 0),
        ("a.scene --integrator path", "path", 64, 16),
    ] {
        let image = image(command);
        assert_eq!(image["integrator"], integrator, "{command}");
        assert_eq!(image["samples"], samples, "{command}");
        assert_eq!(image["max_depth"], depth, "{command}");
    }
}
