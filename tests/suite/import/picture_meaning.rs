//! The meaning of numbers in image files: alpha, colour spaces, windows, exposure and orientation.

mod headers;
mod openexr;

use crate::support::program::Workspace;
use glam::Vec4;
use glimray::import::{self, Memory, Options};
use glimray::scene::{Picture, Scene};
use headers::{REDS, png_with, radiance};
use openexr::{Exr, REC2020};
use std::path::Path;

/// A scene whose only texture is this picture, and the table that names it.
fn with_texture(name: &str, bytes: &[u8], more: &str) -> Scene {
    let text = format!("textures.t = {{ picture = {{ file = '{name}'{more} }} }}");
    let files = Memory::from_iter([("a.toml", text.as_bytes()), (name, bytes)]);
    import::load_from(&files, "a.toml", &Options::default())
        .unwrap_or_else(|error| panic!("{error}"))
}

fn with_background(name: &str, bytes: &[u8]) -> Scene {
    let text = format!("background = {{ picture = '{name}' }}");
    let files = Memory::from_iter([("a.toml", text.as_bytes()), (name, bytes)]);
    import::load_from(&files, "a.toml", &Options::default())
        .unwrap_or_else(|error| panic!("{error}"))
}

fn texels(picture: &Picture) -> Vec<Vec4> {
    picture.linear().collect()
}

#[track_caller]
fn assert_near(found: Vec4, expected: [f32; 4], tolerance: f32) {
    let off = (found - Vec4::from(expected)).abs().max_element();
    assert!(off <= tolerance, "{found}, not {expected:?}");
}

#[test]
fn pixels_outside_of_scenes_mean_the_same() {
    let read = |name: &str, bytes: &[u8]| {
        import::pixels(Path::new(name), bytes).unwrap_or_else(|error| panic!("{error}"))
    };
    let color = read("a.exr", &Exr::new(2, 1).colored(&[0.4, 0.2, -0.1, 0.5]));
    assert_eq!(color.values, [[0.8, 0.4, -0.2, 0.5]; 2]);
    assert!(color.is_light && color.has_alpha);
    let wide = Exr {
        chromaticities: Some(REC2020),
        ..Exr::new(1, 1)
    };
    // Values outside of the gamut are not cut.
    let red = read("a.exr", &wide.colored(&[1.0, 0.0, 0.0])).values[0];
    assert_near(red.into(), [1.6605, -0.1246, -0.0182, 1.0], 1e-3);
    let light = radiance("#?RGBE\nEXPOSURE=2\nPIXASPECT=2", "-Y 2 +X 3", &REDS);
    let light = read("a.hdr", &light);
    assert_eq!(light.values[0], [0.25, 0.125, 0.0625, 1.0]);
    assert_eq!(light.ignored, ["says `PIXASPECT=2`, which is not applied"]);
    let codes = read("a.png", &png_with(b"gAMA", &100_000u32.to_be_bytes()));
    assert_eq!(
        codes.values[0].map(|value| value * 255.0),
        [9.0, 9.0, 9.0, 255.0]
    );
    assert!(!codes.is_light && !codes.has_alpha);
}

/// Pictures of one channel are compared, and what a file says and its picture does not follow is a warning.
#[test]
fn compare_reads_what_scenes_read() {
    let workspace = Workspace::new();
    let one = Exr::new(2, 2);
    let values = vec![0.5, 0.25, 1.0, 2.0];
    workspace.write("grey.exr", one.of(&[("Y", values.clone())]));
    workspace.write("depth.exr", one.of(&[("depth.Z", values.clone())]));
    let alpha = ("A", vec![0.5]);
    workspace.write("thin.exr", one.of(&[("Y", values.clone()), alpha.clone()]));
    let colors = ["R", "G", "B"].map(|name| (name, values.clone()));
    workspace.write("color.exr", one.of(&colors));
    workspace.write("thin_color.exr", one.of(&[&colors[..], &[alpha]].concat()));
    workspace.run("compare grey.exr color.exr").expect(0);
    workspace.run("compare thin.exr thin_color.exr").expect(0);
    workspace.run("compare thin.exr grey.exr").expect(8);
    let run = workspace.run("compare depth.exr grey.exr").expect(0);
    assert_eq!(
        run.stderr,
        "warning: depth.exr has no nameless layer: the layer `depth` is shown.\n"
    );
}
