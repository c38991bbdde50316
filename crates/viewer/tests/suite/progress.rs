//! How a picture refines, and what the window tells of it.

use crate::harness::Window;
use crate::reference::compare::{open_gpu, sized};
use crate::reference::scenes;
use crate::support::PATIENCE;
use eframe::egui::Key;
use egui_kittest::kittest::{Queryable, by};
use glimray::pack;
use glimray::render::{Antialias, ExecutionPolicy, Integrator, RenderSettings, Renderer, Slicing};
use glimray_viewer::model::bindings::Action;
use glimray_viewer::state::time_left::TimeLeft;
use glimray_viewer::worker::progressive_image::{PictureSlot, Progress};
use std::sync::Arc;
use std::time::{Duration, Instant};

#[test]
fn passes_over_a_path_traced_picture_at_most_double_its_samples() {
    let scene = scenes::spheres();
    let packed = Arc::new(pack::scene(&scene).expect("a packed scene"));
    let view = packed.frame(&scene.frame(0.0)).expect("a view");
    let settings = RenderSettings {
        integrator: Integrator::Path,
        samples: 64,
        antialias: Antialias::Stratified,
        ..sized(256, 192)
    };
    let policy = ExecutionPolicy {
        slicing: Slicing {
            // A part of the picture in each submission.
            max_groups: 16,
            even_passes: true,
            ..Slicing::default()
        },
        host_copy: false,
        ..ExecutionPolicy::default()
    };
    let renderer = Renderer::new(open_gpu(), packed, &view, settings, policy);
    let mut renderer = renderer.expect("a renderer");
    let mut counts = vec![0];
    while !renderer.is_done() {
        renderer.step().expect("samples");
        counts.push(renderer.samples_done());
    }
    counts.dedup();
    assert_eq!(counts, [0, 1, 2, 4, 8, 16, 32, 64]);
}

#[test]
fn the_samples_so_far_are_a_fraction_while_a_pass_goes_on() {
    let at = |samples, mean_samples| Progress {
        samples,
        mean_samples,
        target: 64,
        ..Progress::default()
    };
    let told = |progress: Progress| progress.samples_so_far();
    assert_eq!(told(at(16, 17.36)), "17.3");
    assert_eq!(told(at(16, 17.02)), "17.0");
    assert_eq!(told(at(16, 16.0)), "16");
    assert_eq!(told(at(16, 16.000_001)), "16");
    assert_eq!(told(at(0, 0.25)), "0.2");
    let done = Progress {
        is_done: true,
        ..at(64, 64.0)
    };
    assert_eq!(told(done), "64");
}

#[test]
fn the_time_left_waits_a_second_is_smooth_and_ends_with_a_pause() {
    let mut left = TimeLeft::default();
    let at = |trace_seconds: f64, share: f64| Progress {
        trace_seconds,
        share,
        ..Progress::default()
    };
    left.update(&at(0.1, 0.000_06), false);
    assert_eq!(left.seconds(), None, "from a tenth of a second");
    left.update(&at(1.0, 0.1), false);
    assert!((left.seconds().expect("an estimate") - 9.0).abs() < 1e-9);
    // The last part took longer: 22 s are left by the latest figures.
    left.update(&at(1.5, 0.064), false);
    let other = left.seconds();
    assert!(
        (other.expect("an estimate") - 1.5 * 0.936 / 0.064).abs() < 1e-9,
        "not begun again"
    );
    left.update(&at(2.0, 0.08), false);
    let smooth = left.seconds().expect("an estimate");
    let latest = 2.0 * 0.92 / 0.08;
    let expected = 1.5 * 0.936 / 0.064 - 0.5;
    assert!(smooth > expected && smooth < expected + 0.5 * (latest - expected));
    left.update(&at(2.0, 0.08), true);
    assert_eq!(left.seconds(), None, "while it is paused");
    left.update(&at(2.0, 0.08), false);
    assert_eq!(left.seconds(), Some(smooth));
    let done = Progress {
        is_done: true,
        ..at(20.0, 1.0)
    };
    left.update(&done, false);
    assert_eq!(left.seconds(), None);
}

#[test]
fn the_histogram_of_another_scene_is_forgotten() {
    let mut window = Window::open(&[
        "assets/scenes/sphere.scene",
        "--size",
        "64x48",
        "--samples",
        "1",
    ]);
    // The whole Render panel is in the window.
    window.harness.set_size(eframe::egui::vec2(1000.0, 1600.0));
    window.settle();
    let label = "Histogram: no picture yet";
    assert!(window.session().histogram.latest.is_some());
    window.session().show_built_in().expect("the demo");
    window.session().view.paused = true;
    window.harness.step();
    assert!(window.session().histogram.latest.is_none());
    window.harness.get_by_label(label);
    window.session().view.paused = false;
    window.settle();
    assert!(window.session().histogram.latest.is_some());
}

#[test]
fn no_box_lies_over_a_picture_that_is_there() {
    let mut window = Window::open(&[
        "assets/scenes/sphere.scene",
        "--size",
        "64x48",
        "--samples",
        "2",
    ]);
    window.settle();
    // Each needs shaders that are not compiled yet.
    for action in [
        Action::IntegratorHeat,
        Action::IntegratorUv,
        Action::IntegratorPath,
        Action::NextLayer,
    ] {
        window.session().clicked.push(action);
        let start = Instant::now();
        for _ in 0..8 {
            window.harness.step();
        }
        while !window.harness.state().is_settled() {
            assert!(start.elapsed() < PATIENCE, "{action:?} does not settle");
            window.harness.step();
            let render = window.harness.state().render_thread();
            let activity = render.activity();
            let is_late =
                activity.is_some_and(|it| it.since.elapsed() > Duration::from_millis(400));
            let is_there = render
                .shown(PictureSlot::Main)
                .is_some_and(|shown| shown.screen.is_some() || shown.under.is_some());
            let told = (window.harness).query_all(by().label_contains("Preparing"));
            let count = told.count();
            assert!(
                !is_there || count <= 1,
                "{action:?}: {count} times, late: {is_late}"
            );
        }
    }
    window.harness.key_press(Key::Escape);
}

#[test]
fn nothing_is_submitted_while_a_window_configures_its_surface() {
    let scene = "assets/scenes/sphere.scene";
    let mut window = Window::open(&[scene, "--size", "64x48", "--samples", "2"]);
    window.settle();
    let submissions = |window: &Window| window.shown().stats.submissions;
    let before = submissions(&window);
    window.gpu.hold_submissions();
    window.session().restart();
    for _ in 0..100 {
        window.harness.step();
        std::thread::yield_now();
    }
    assert_eq!(submissions(&window), before);
    window.gpu.release_submissions();
    window.settle();
    assert!(submissions(&window) > before);
    assert!(window.shown().progress.is_done);
}
