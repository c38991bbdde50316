//! The programs in `examples/` that show how the library is used: what they write is right.

use crate::support::program::Workspace;
use crate::support::skip::{Need, skip};
use crate::support::verdict::Verdict;
use glam::{DVec3, dvec3};
use std::path::PathBuf;
use std::process::Command;

/// The program of an example; `None` where it is not built.
pub fn built(name: &str) -> Option<PathBuf> {
    let test = std::env::current_exe().expect("the tests' own path");
    let target = test.ancestors().nth(2).expect("the folder of the profile");
    let path = target.join("examples").join(name);
    let path = path.with_extension(std::env::consts::EXE_EXTENSION);
    if !path.exists() {
        skip(
            Need::Examples,
            format_args!("{} is not built", path.display()),
        );
        return None;
    }
    Some(path)
}

/// The output of an example; `None` where it is not built.
fn run(name: &str, arguments: &[PathBuf]) -> Option<String> {
    let output = Command::new(built(name)?)
        .args(arguments)
        .output()
        .expect("it runs");
    let told = String::from_utf8_lossy(&output.stderr);
    assert!(output.status.success(), "{name}: {told}");
    Some(String::from_utf8(output.stdout).expect("UTF-8"))
}

#[test]
fn the_headless_example_writes_what_the_program_writes() {
    let workspace = Workspace::new();
    let scene = "camera = { look_from = [0, 1, 4], look_at = [0, 0, 0] }\n\
        lights = [{ point = { position = [2, 3, 4] } }]\n\
        [output]\nsize = [24, 16]\nsamples = 4\nexposure_ev = 0.5\ntone = 'aces'\n\
        [[objects]]\nsphere = { center = [0, 0, 0], radius = 1 }\n";
    workspace.write("a.toml", scene);
    let paths = [workspace.path("a.toml"), workspace.path("example.png")];
    if run("headless", &paths).is_none() {
        return;
    }
    workspace.run("render a.toml -o program.png").expect(0);
    assert!(workspace.read("example.png") == workspace.read("program.png"));
}

#[test]
fn the_scene_made_in_code_has_its_sky_and_its_triangle() {
    let workspace = Workspace::new();
    let path = workspace.path("out.png");
    if run("scene_from_code", std::slice::from_ref(&path)).is_none() {
        return;
    }
    let picture = ::image::open(path).expect("a picture").into_rgb8();
    assert_eq!(picture.dimensions(), (320, 200));
    // The camera of the example, and the direction of a pixel's centre.
    let eye = dvec3(0.0, 1.6, 5.0);
    let forward = (dvec3(0.0, 0.7, 0.0) - eye).normalize();
    let right = forward.cross(DVec3::Y).normalize();
    let up = right.cross(forward);
    let slope = 20_f64.to_radians().tan();
    let direction = |x: u32, y: u32| {
        let across = (2.0 * (f64::from(x) + 0.5) / 320.0 - 1.0) * 1.6;
        let upwards = 1.0 - 2.0 * (f64::from(y) + 0.5) / 200.0;
        (forward + slope * (across * right + upwards * up)).normalize()
    };
    let mut verdict = Verdict::on("pixels");
    for (x, y) in [(0, 0), (160, 0), (319, 10)] {
        let share = (direction(x, y).y + 1.0) / 2.0;
        let sky = DVec3::splat(0.5).lerp(dvec3(0.2, 0.4, 0.8), share);
        let found = picture.get_pixel(x, y).0.map(f64::from);
        let expected = sky.to_array().map(|c| 255.0 * srgb(c));
        let is_near = (0..3).all(|i| (found[i] - expected[i]).abs() <= 2.0);
        verdict.that(format!("sky at {x},{y}"), is_near, || {
            format!("{found:?}, not {expected:?}")
        });
    }
    let pixel = |point: DVec3| {
        let seen = (point - eye) / ((point - eye).dot(forward) * slope);
        let x = (seen.dot(right) / 1.6 + 1.0) / 2.0 * 320.0;
        let y = (1.0 - seen.dot(up)) / 2.0 * 200.0;
        (x as u32, y as u32)
    };
    // Where the middle of the triangle is seen, and points beside it: only its paint is red.
    for (point, is_on) in [
        (dvec3(-1.2, 0.5, -1.0), true),
        (dvec3(-1.6, 0.5, -1.0), true),
        (dvec3(-2.1, 0.5, -1.0), false),
        (dvec3(-1.2, 1.8, -1.0), false),
    ] {
        let (x, y) = pixel(point);
        let [r, _, b] = picture.get_pixel(x, y).0;
        verdict.that(point, (r / 2 > b) == is_on, || format!("red {r}, blue {b}"));
    }
    // Samples spread over pixels: at the slanted edge of the triangle most rows have a pixel between its blue and that
    // of the floor behind.
    let rows = (0..10).map(|step| {
        let height = 0.3 + 0.05 * f64::from(step);
        let (x, y) = pixel(dvec3(-2.2 + height / 1.6, height, -1.0));
        let blue = |x: u32| i32::from(picture.get_pixel(x, y).0[2]);
        let (floor, paint) = (blue(x - 4), blue(x + 4));
        (x - 3..x + 4).any(|x| blue(x) < floor - 12 && blue(x) > paint + 12)
    });
    let mixed = rows.filter(|is_mixed| *is_mixed).count();
    verdict.that("the edge", mixed >= 7, || format!("{mixed} of 10 rows"));
    verdict.close();
}

/// IEC 61966-2-1.
fn srgb(c: f64) -> f64 {
    match c <= 0.003_130_8 {
        true => 12.92 * c,
        false => 1.055 * c.powf(1.0 / 2.4) - 0.055,
    }
}

#[test]
fn the_example_of_a_shader_function_prints_fresnels_reflectance() {
    let Some(text) = run("shader_function", &[]) else {
        return;
    };
    let mut verdict = Verdict::on("reflectance of glass");
    let lines: Vec<_> = text.lines().collect();
    assert_eq!(lines.len(), 7, "{text}");
    for line in lines {
        let (angle, found) = line.split_once(' ').expect("two numbers");
        let angle: f64 = angle.parse().expect("degrees");
        let found: f64 = found.parse().expect("a reflectance");
        let i = angle.to_radians();
        let t = (i.sin() / 1.5).asin();
        // Fresnel's equations by angles.
        let expected = match angle {
            0.0 => 0.04,
            _ => {
                let s = (i - t).sin() / (i + t).sin();
                let p = (i - t).tan() / (i + t).tan();
                (s * s + p * p) / 2.0
            }
        };
        verdict.that(line, (found - expected).abs() < 1e-5, || {
            format!("not {expected}")
        });
    }
    verdict.close();
}
