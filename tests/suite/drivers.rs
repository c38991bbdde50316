//! Pictures through a second driver, the OpenGL backend of wgpu if available, and in vectors of another width.

use crate::explain::project_scenes;
use crate::golden;
use crate::reference::compare::{assert_none, check_alike, render, render_on, sized};
use crate::support::devices::Devices;
use crate::support::skip::{Need, skip};
use glimray::gpu::{AdapterChoice, Backend, Gpu};
use glimray::render::{Antialias, ExecutionPolicy, RenderSettings};
use glimray::scene::Shadows;
use std::process::Command;

/// The adapter of the OpenGL backend, if available.
const GL: AdapterChoice = AdapterChoice {
    backend: Some(Backend::Gl),
    adapter: None,
};

#[test]
fn scenes_look_the_same_through_opengl() {
    static DEVICES: Devices = Devices::new(|| Gpu::new(&GL));
    if let Err(error) = Gpu::new(&GL) {
        return skip(Need::Gl, error);
    }
    let settings = antialiased(240, 160);
    // Each scene has kernels of its own, which take both drivers seconds to compile.
    let scenes = project_scenes(&["toml", "scene"]).into_iter().step_by(3);
    assert_none(scenes.map(|(name, scene)| {
        let default = (settings.clone(), ExecutionPolicy::default());
        let (actual, _) = render_on(DEVICES.lease(), &scene, &default);
        let (expected, _) = render(&scene, &settings);
        // Light at grazing incidence on many boundaries may be transmitted or totally reflected, depending on
        // rounding.
        let fraction = match scene.shadows {
            Shadows::Opaque => 0.001,
            Shadows::Filtered => 0.01,
        };
        check_alike(&name, &expected, &actual, 3.0, fraction)
    }));
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
        "lanes::crops_of_generated_scenes_are_the_pixels_of_the_whole",
        "lanes::a_value_leaves_a_loop_lane_by_lane",
    ];
    let other = match std::env::var(WIDTH).as_deref() {
        Ok("512") => "256",
        _ => "512",
    };
    let kernels = format!("{}/{other}-bits", env!("CARGO_TARGET_TMPDIR"));
    let mut command = Command::new(std::env::current_exe().expect("the test program"));
    let output = command
        .arg("--exact")
        .args(tests)
        .env(WIDTH, other)
        // Mesa's cache does not distinguish widths, and code of another width crashes.
        .env("MESA_SHADER_CACHE_DIR", kernels)
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

/// For `tests/drivers/run.sh`. With one seed, rounding decides single choices differently: some pixels differ much, either
/// way, and the mean of their differences is that of chance, but small: one wrong pixel may outshine the picture. A part in
/// 10,000 may be rounding itself.
#[test]
#[ignore = "compares the pictures A.exr:B.exr that GLIMRAY_PICTURES names"]
fn two_pictures_have_the_same_mean() {
    let paths = std::env::var("GLIMRAY_PICTURES").expect("GLIMRAY_PICTURES");
    let (a, b) = paths.split_once(':').expect("two paths");
    let [a, b] = [a, b].map(|path| image::open(path).expect(path).into_rgb32f());
    assert_eq!(a.dimensions(), b.dimensions());
    let light = |pixel: &image::Rgb<f32>| pixel.0.map(f64::from).iter().sum::<f64>();
    let count = a.pixels().len() as f64;
    let total: f64 = a.pixels().map(light).sum();
    let differences = || a.pixels().zip(b.pixels()).map(|(a, b)| light(b) - light(a));
    let mean = differences().sum::<f64>() / count;
    let variance = differences().map(|d| (d - mean).powi(2)).sum::<f64>() / (count - 1.0);
    let z = mean / (variance / count).sqrt().max(f64::MIN_POSITIVE);
    let part = mean * count / total;
    println!("the mean differs by {part:.1e} of it: z {z:.1}");
    assert!(part.abs() < 1e-4 || part.abs() < 0.02 && z.abs() < 4.0);
}
