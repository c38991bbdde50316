//! `render` and `demo`: files, crops, linear formats.

use crate::support::program::{SCENE, Workspace};
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
        ("m.glb", "path", 8, 16),
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

/// A triangle in the middle of the picture. Its sides leave the lower corners free, where the ground would be.
const TRIANGLE: &str = "v -1 0 0\nv 1 0 0\nv 0 2 0\nf 1 2 3\n";

#[test]
fn a_background_leaves_out_the_ground_that_was_not_asked_for() {
    let workspace = Workspace::new();
    workspace.write("m.obj", TRIANGLE);
    let corner = |flags: &str| {
        let line = format!("render m.obj --size 24x18 --samples 2 --tone none {flags} -o m.png");
        workspace.run(&line).expect(0);
        let picture = image::open(workspace.path("m.png")).expect("a picture");
        let picture = picture.into_rgba8();
        assert_eq!(picture.get_pixel(12, 9).0[3], 255, "the model, {flags}");
        [0, 23].map(|x| picture.get_pixel(x, 17).0)
    };
    let path = "--integrator path --background";
    assert_eq!(corner(&format!("{path} transparent")), [[0; 4]; 2]);
    let white = format!("{path} 1,1,1 --environment sky");
    assert_eq!(corner(&white), [[255; 4]; 2]);
    let blue = [[0, 0, 255, 255]; 2];
    assert_eq!(corner("--integrator whitted --background 0,0,1"), blue);
    for [_, _, _, opacity] in corner(&format!("{path} transparent --ground surface")) {
        assert_eq!(opacity, 255, "the ground that was asked for");
    }
    for [r, _, b, _] in corner("--integrator whitted --background 0,0,1 --ground surface") {
        assert!(r > 0 && b < 255, "a grey ground");
    }
}

/// A ball that fills the picture, which is therefore opaque.
const NEAR: &str = "--look-from 0,0,-1.9 --look-at 0,0,-3 --size 8x8 --samples 2 --integrator path";

#[test]
fn transparent_pictures_have_an_alpha_channel_even_where_all_is_opaque() {
    let workspace = Workspace::new();
    let run = |line: &str| workspace.run(line).expect(0);
    let colors = |name: &str| {
        let picture = image::open(workspace.path(name)).expect("a picture");
        // The reader of a crop adds what is missing of the whole picture.
        let mut pixels = picture
            .to_rgba32f()
            .into_vec()
            .into_iter()
            .skip(3)
            .step_by(4);
        assert!(
            name == "crop.exr" || pixels.all(|opacity| opacity == 1.0),
            "{name}"
        );
        picture.color()
    };
    let clear = "--background transparent";
    run(&format!("render a.scene {NEAR} -o plain.png"));
    assert_eq!(colors("plain.png"), image::ColorType::Rgb8);
    run(&format!("render a.scene {NEAR} -o plain.exr"));
    assert_eq!(colors("plain.exr"), image::ColorType::Rgb32F);
    for (name, flags) in [
        ("a", ""),
        ("denoised", "--denoise"),
        ("crop", "--crop 1,1,5,6"),
    ] {
        run(&format!(
            "render a.scene {NEAR} {clear} {flags} -o {name}.png"
        ));
        assert_eq!(colors(&format!("{name}.png")), image::ColorType::Rgba8);
        run(&format!(
            "render a.scene {NEAR} {clear} {flags} -o {name}.exr"
        ));
        assert_eq!(colors(&format!("{name}.exr")), image::ColorType::Rgba32F);
    }
    let layers = "--layers beauty,depth --denoise";
    run(&format!(
        "render a.scene {NEAR} {clear} {layers} -o layers.exr"
    ));
    assert_eq!(colors("layers.exr"), image::ColorType::Rgba32F);
    run(&format!("render a.scene {NEAR} {clear} -o a.film"));
    run("merge a.film -o merged.png");
    assert!(workspace.read("merged.png") == workspace.read("a.png"));
    run(&format!(
        "animate a.scene {NEAR} {clear} --frames 0 -o f_%d.png"
    ));
    assert_eq!(colors("f_0.png"), image::ColorType::Rgba8);
}

/// The course's format has linear values for pictures without a tone curve; AgX is made for sRGB.
#[test]
fn the_curve_of_paths_comes_with_its_transfer_function() {
    let workspace = Workspace::new();
    let native = "[output]\nintegrator = \"path\"\ntransfer = \"linear\"\n\
        [[objects]]\nsphere = { center = [0, 0, -3], radius = 1 }\n";
    workspace.write("linear.toml", native);
    let picture = |flags: &str| {
        let line =
            format!("render {flags} --size 12x9 --samples 2 --background 0.2,0.3,0.4 -o p.png");
        workspace.run(&line).expect(0);
        workspace.read("p.png")
    };
    for (usual, said) in [
        ("a.scene --integrator path", "--tone agx --transfer srgb"),
        ("a.scene --integrator path --tone agx", "--transfer srgb"),
        ("a.scene --integrator path --transfer linear", "--tone agx"),
        ("a.scene --integrator path --tone none", "--transfer linear"),
        (
            "a.scene --integrator whitted",
            "--tone none --transfer linear",
        ),
        ("linear.toml", "--tone agx --transfer linear"),
    ] {
        assert!(
            picture(usual) == picture(&format!("{usual} {said}")),
            "{usual}"
        );
    }
    let washed = picture("a.scene --integrator path --transfer linear");
    assert!(picture("a.scene --integrator path") != washed);
}

#[test]
fn depth_0_is_said_where_a_scene_has_a_mirror_or_glass() {
    let workspace = Workspace::new();
    let course = |specular: f64| SCENE.replace("spe: 0.2 0.2 0.2", &format!("spe: 0 {specular} 0"));
    workspace.write("mirror.scene", course(0.9));
    workspace.write("glossy.scene", course(0.6));
    let glass = "[output]\nmax_depth = 0\n[materials]\nglass = { refract = { ior = 1.5 } }\n[[lights]]\n\
                 point = { position = [3, 3, 3] }\n[[objects]]\nsphere = { center = [0, 0, 0], radius = 1 }\n\
                 material = \"glass\"\n";
    workspace.write("glass.toml", glass);
    for (line, is_said) in [
        ("mirror.scene", true),
        ("mirror.scene --max-depth 0", false),
        ("mirror.scene --max-depth 1", false),
        ("mirror.scene --integrator normals", false),
        ("glossy.scene", false),
        ("glass.toml", true),
        ("glass.toml --set output.max_depth=1", false),
    ] {
        let run = workspace.run(&format!("render {line} --size 8x8 -o a.png"));
        let said = run.expect(0).stderr;
        assert_eq!(said.contains("--max-depth 5"), is_said, "{line}: {said}");
    }
}
