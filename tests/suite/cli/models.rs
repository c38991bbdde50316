//! Defaults of models: few samples that are denoised, an estimate, and warnings of black pictures.

use crate::import::gltf::model::ship;
use crate::support::program::Workspace;
use serde_json::{Value, json};
use std::io::{BufRead, BufReader};
use std::process::Stdio;

/// A roof of two faces.
const ROOF: &str = "v 0 1 0\nv 0 1 1\nv -1 0 0\nv -1 0 1\nv 1 0 0\nv 1 0 1\nf 1 3 4 2\nf 2 6 5 1\n";

fn workspace() -> Workspace {
    let workspace = Workspace::new();
    workspace.write("a.obj", ROOF);
    workspace
}

/// The `image` part of the report of a small picture.
fn image(workspace: &Workspace, flags: &str) -> Value {
    let line = format!("render a.obj --size 24x18 --report - {flags}");
    workspace.run(&line).expect(0).report["image"].clone()
}

#[test]
fn models_have_few_samples_and_are_denoised() {
    let workspace = workspace();
    for (flags, samples, denoise) in [
        ("", 8, true),
        ("--samples 16", 16, true),
        ("--no-denoise", 8, false),
        ("--denoise --no-denoise", 8, false),
        ("--integrator whitted", 16, false),
        ("--integrator whitted --denoise", 16, true),
        ("--integrator normals", 16, false),
    ] {
        let image = image(&workspace, &format!("-o a.png {flags}"));
        let found = (&image["samples"], &image["denoise"]);
        assert_eq!(found, (&json!(samples), &json!(denoise)), "{flags}");
    }
    let line = "turntable a.obj --size 24x18 --seconds 0.1 --report - -o t_%d.png";
    let turned = &workspace.run(line).expect(0).report["image"];
    assert_eq!(
        (&turned["samples"], &turned["denoise"]),
        (&json!(8), &json!(true))
    );
    // Other scenes have what they say.
    let plain = workspace.run("render a.scene --size 24x18 --integrator path --report - -o s.png");
    assert_eq!(plain.expect(0).report["image"]["denoise"], false);
}

#[test]
fn the_raw_picture_stays_in_films_and_layers() {
    let workspace = workspace();
    for line in [
        "render a.obj --size 24x18 -o clean.png",
        "render a.obj --size 24x18 --no-denoise -o noisy.png",
        "render a.obj --size 24x18 -o both.exr",
        "render a.obj --size 24x18 -o a.film",
        "merge a.film -o merged.png",
        "merge a.film --no-denoise -o merged_noisy.png",
        "convert a.obj -o native.toml",
        "render native.toml --size 24x18 -o native.png",
    ] {
        workspace.run(line).expect(0);
    }
    let read = |name: &str| workspace.read(name);
    assert!(read("clean.png") != read("noisy.png"));
    assert!(
        read("merged.png") == read("clean.png"),
        "a film keeps that it is denoised"
    );
    assert!(read("merged_noisy.png") == read("noisy.png"));
    assert!(read("native.png") == read("clean.png"));
    let layers = read("both.exr");
    assert!(layers.windows(8).any(|name| name == b"beauty.R"));
}

#[test]
fn colours_of_models_are_those_of_their_materials() {
    let workspace = Workspace::new();
    workspace.write(
        "a.mtl",
        "newmtl lamp\nKd 0 1 0\nillum 0\nnewmtl paint\nKd 0.6 0 0\nKs 0 0 0\nillum 1\n",
    );
    let square = "v -1 -1 0\nv 1 -1 0\nv 1 1 0\nv -1 1 0\nf 1 2 3 4\n";
    for material in ["lamp", "paint"] {
        workspace.write(
            &format!("{material}.obj"),
            format!("mtllib a.mtl\nusemtl {material}\n{square}"),
        );
    }
    let middle = |line: &str| {
        let line = format!("render {line} --look-from 0,0,5 --look-at 0,0,0 --size 9x9 -o a.png");
        workspace.run(&line).expect(0);
        let picture = image::load_from_memory(&workspace.read("a.png")).expect("a picture");
        picture.into_rgb8().get_pixel(4, 4).0
    };
    assert_eq!(middle("lamp.obj --bare"), [0, 255, 0], "an unlit colour");
    for integrator in ["path", "whitted"] {
        let [red, green, blue] = middle(&format!("paint.obj --integrator {integrator}"));
        assert!(
            red > 100 && green < 10 && blue < 10,
            "{integrator}: {red} {green} {blue}"
        );
    }
    let washed = middle("paint.obj --tone agx");
    assert!(washed[1] > 25, "{washed:?}");
}

#[test]
fn a_black_picture_is_warned_of_with_its_reason() {
    let workspace = workspace();
    workspace.write("ship.glb", ship(json!({})).glb());
    let run = |flags: &str| {
        let line = format!("render --size 24x18 -o a.png {flags}");
        workspace.run(&line).expect(0).stderr
    };
    let note = "camera 1 `framed` takes the place of camera 0 `bridge`, which sees nothing that is lit; --camera 0 \
                shows that";
    let framed = run("ship.glb");
    assert!(
        framed.contains(note) && !framed.contains("black"),
        "{framed}"
    );
    let inside = run("ship.glb --camera bridge");
    assert!(!inside.contains(note), "{inside}");
    assert!(
        inside.contains(
            "warning: the picture is black, or nearly so: camera 0 `bridge` sees nothing that is lit, as it may be \
             inside a closed object. Use --camera 1."
        ),
        "{inside}"
    );
    let dark = run("a.obj --exposure -20");
    assert!(
        dark.contains("black, or nearly so: its exposure is -20 EV. Use --exposure 0"),
        "{dark}"
    );
    for bright in [
        "a.obj",
        "a.scene",
        "a.obj --exposure -20 --integrator depth",
    ] {
        let bright = run(bright);
        assert!(!bright.contains("black"), "{bright}");
    }
    // A film fades in.
    let frames = "turntable a.obj --size 24x18 --seconds 0.1 --exposure -20 -o t_%d.png";
    let warnings = workspace.run(frames).expect(0).stderr;
    assert_eq!(
        warnings.matches("black, or nearly so").count(),
        1,
        "{warnings}"
    );
}

#[test]
fn a_long_render_says_how_long_it_will_take_and_a_short_one_does_not() {
    let workspace = workspace();
    let lines = |line: &str| {
        let mut child = workspace
            .command(line)
            .stderr(Stdio::piped())
            .spawn()
            .expect("glimray runs");
        let lines = BufReader::new(child.stderr.take().expect("a pipe")).lines();
        let said = lines
            .map_while(Result::ok)
            .find(|line| line.contains("left"));
        let _ = child.kill();
        let _ = child.wait();
        said
    };
    let picture = lines("render a.obj --size 1024x1024 --samples 65536 -o a.png").expect("a line");
    assert!(
        picture.starts_with("about ") && picture.ends_with(" left"),
        "{picture}"
    );
    let film = "turntable a.obj --size 256x256 --seconds 400 --samples 64 -o t_%04d.png";
    let film = lines(film).expect("a line");
    assert!(
        film.starts_with("about ") && film.ends_with(" frame(s)"),
        "{film}"
    );
    assert_eq!(lines("render a.obj --size 24x18 -o b.png"), None);
}
