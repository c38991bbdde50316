//! The same pictures through a second driver, the OpenGL backend of wgpu if available, without bounds of loops, and in vectors
//! of another width.

use crate::golden;
use crate::path::lobes;
use crate::reference::compare::{assert_none, check_alike, render, render_on, sized, users_gpu};
use crate::reference::scenes;
use crate::support::devices::Devices;
use crate::support::skip::{Need, skip};
use glimray::gpu::{AdapterChoice, Backend, Gpu};
use glimray::import;
use glimray::render::{Antialias, ExecutionPolicy, Integrator, RenderSettings};
use glimray::scene::{Scene, Shadows};
use std::{path::Path, process::Command};

/// The adapter of the OpenGL backend, if available.
const GL: AdapterChoice = AdapterChoice {
    backend: Some(Backend::Gl),
    adapter: None,
    bounds_loops: false,
};

#[test]
fn scenes_look_the_same_through_opengl() {
    static DEVICES: Devices = Devices::new(|| Gpu::new(&GL));
    if let Err(error) = Gpu::new(&GL) {
        return skip(Need::Gl, error);
    }
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("assets/scenes");
    let mut scenes: Vec<_> = (std::fs::read_dir(folder).expect("the scenes"))
        .filter_map(|entry| Some(entry.ok()?.path()))
        .filter(|path| {
            path.extension()
                .is_some_and(|e| e == "toml" || e == "scene")
        })
        .collect();
    scenes.sort();
    assert!(!scenes.is_empty());
    let settings = antialiased(240, 160);
    // Each scene has kernels of its own, which take both drivers seconds to compile.
    assert_none(scenes.iter().step_by(3).map(|path| {
        let scene = import::load(path).expect("a scene");
        let default = (settings.clone(), ExecutionPolicy::default());
        let (actual, _) = render_on(DEVICES.lease(), &scene, &default);
        let (expected, _) = render(&scene, &settings);
        // Light at grazing incidence on many boundaries may be transmitted or totally reflected, depending on
        // rounding.
        let fraction = match scene.shadows {
            Shadows::Opaque => 0.001,
            Shadows::Filtered => 0.01,
        };
        check_alike(
            &path.display().to_string(),
            &expected,
            &actual,
            3.0,
            fraction,
        )
    }));
}

/// Users' devices do not bound loops, those of other tests do.
#[test]
fn pictures_are_the_same_with_and_without_bounds_of_loops() {
    let compare = |name: &str, scene: Scene, settings: RenderSettings, fraction| {
        let (expected, _) = render(&scene, &settings);
        let (actual, _) = render_on(users_gpu(), &scene, &settings);
        check_alike(name, &expected, &actual, 1.0, fraction)
    };
    let whitted = antialiased(96, 64);
    let paths = RenderSettings {
        integrator: Integrator::Path,
        ..whitted.clone()
    };
    assert_none([
        compare("spheres", scenes::spheres(), whitted.clone(), 0.001),
        compare("meshes", scenes::meshes(), whitted.clone(), 0.001),
        compare(
            "mirrors",
            scenes::mirrors_and_glass(),
            whitted.clone(),
            0.001,
        ),
        compare("everything", scenes::everything(), whitted, 0.001),
        // Rounding decides which way some paths go.
        compare("paths", scenes::everything(), paths.clone(), 0.01),
        compare("lobes", lobes::scene(), paths, 0.05),
    ]);
}

/// lavapipe has subgroups of 8 lanes in vectors of 256 bits, and of 16 in those of 512. It chooses when it is loaded, so
/// the other width has a process of its own.
#[test]
fn packets_of_8_and_of_16_lanes_pass_the_same_tests() {
    const WIDTH: &str = "LP_NATIVE_VECTOR_WIDTH";
    let tests = [
        "pictures::images_buffers_and_packets_give_the_same_bits",
        "bench::packets::nodes_and_primitives_per_packet_do_not_grow",
        "ray_query::packets_and_single_rays_find_the_same_in_a_deep_tree",
        "golden::golden_pictures_are_as_they_were",
    ];
    let other = match std::env::var(WIDTH).as_deref() {
        Ok("512") => "256",
        _ => "512",
    };
    let mut command = Command::new(std::env::current_exe().expect("the test program"));
    let output = command
        .arg("--exact")
        .args(tests)
        .env(WIDTH, other)
        .env(golden::STRIDE, "4")
        .output();
    let output = output.expect("the tests run");
    let text = String::from_utf8_lossy(&output.stdout);
    let passed = format!("{} passed", tests.len());
    assert!(
        output.status.success() && text.contains(&passed),
        "{other} bits: {text}"
    );
}

fn antialiased(width: u32, height: u32) -> RenderSettings {
    RenderSettings {
        samples: 4,
        antialias: Antialias::Stratified,
        ..sized(width, height)
    }
}
