//! Pictures that fit the window: the camera of a model without one, and other room.

use super::pixels;
use crate::harness::Window;
use crate::support::PATIENCE;
use eframe::egui::{Key, vec2};
use egui_kittest::kittest::Queryable;
use glam::{DVec2, DVec3};
use glimray::scene::Camera;
use glimray_viewer::actions::files::pictures;
use glimray_viewer::model::camera::project;
use glimray_viewer::state::files::SaveSize;
use glimray_viewer::state::layout::Panel;
use std::path::PathBuf;
use std::time::Instant;
use tempfile::TempDir;

/// A model that is ten times as wide as high, in a file without a camera.
fn plank() -> (TempDir, PathBuf) {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("plank.obj");
    let text = "v -5 0 0\nv 5 0 0\nv 5 1 0\nv -5 1 0\nf 1 2 3 4\n";
    std::fs::write(&path, text).expect("a file");
    (folder, path)
}

/// Whether all corners of the plank are in a picture of this size.
fn shows_all(camera: &Camera, (width, height): (u32, u32)) -> bool {
    let size = DVec2::new(f64::from(width), f64::from(height));
    [(-5.0, 0.0), (5.0, 0.0), (5.0, 1.0), (-5.0, 1.0)]
        .into_iter()
        .all(|(x, y)| {
            let at = project(camera, DVec3::new(x, y, 0.0), size).expect("before the camera");
            at.cmpge(DVec2::ZERO).all() && at.cmple(size).all()
        })
}

#[test]
fn a_model_without_a_camera_is_seen_whole_in_the_window_and_in_its_picture() {
    let (folder, path) = plank();
    let mut window = Window::open(&[path.to_str().expect("text"), "--samples", "1"]);
    window.settle();
    let (size, own) = (
        window.shown().size,
        window.request().scene.cameras[0].clone(),
    );
    assert!(size.0 < size.1, "the panel is wide: {size:?}");
    assert!(!shows_all(&own, size), "any camera would do");
    let start = window.camera();
    assert!(shows_all(&start, size), "cut off: {start:?}");
    assert_eq!(window.request().camera.as_ref(), Some(&start));
    window.harness.key_press(Key::Num1);
    window.settle();
    window.harness.key_press(Key::Home);
    window.settle();
    assert_eq!(window.camera(), start);

    // A window of other proportions.
    window.harness.set_size(vec2(1400.0, 500.0));
    window.settle();
    let (wide, camera) = (window.shown().size, window.camera());
    assert!(wide.0 > wide.1);
    assert!(shows_all(&camera, wide) && camera != start);

    // The file at the size of the scene is what the command line renders.
    let saved = folder.path().join("saved.png");
    {
        let mut session = window.session();
        pictures::open(&mut session, false);
        let dialog = session.files.saving.as_mut().expect("a sheet");
        dialog.path = saved.display().to_string();
        dialog.size = SaveSize::Scene;
        pictures::save(&mut session, false);
    }
    let start = Instant::now();
    while !saved.exists() || window.session().files.waits_to_save() {
        assert!(start.elapsed() < PATIENCE, "not saved");
        window.harness.step();
    }
    // With a size of its own, the window's picture is the command line's.
    let path = path.to_str().expect("text");
    let mut other = Window::open(&[path, "--samples", "1", "--size", "800x600"]);
    other.settle();
    assert_eq!(other.request().camera, None);
    let expected = pixels::on(&other.shown().screen.expect("a screen"), &other.gpu);
    let picture = ::image::open(&saved).expect("a picture").into_rgb8();
    let picture: Vec<_> = picture.pixels().map(|pixel| pixel.0).collect();
    assert!(picture == expected.rgb, "not the command line's picture");
}

#[test]
fn a_camera_of_the_file_or_of_the_command_line_is_left_alone() {
    let (_folder, path) = plank();
    let path = path.to_str().expect("text");
    let mut window = Window::open(&[path, "--samples", "1", "--look-from", "0,0,9"]);
    window.settle();
    assert_eq!(window.request().camera, None);
    let mut window = Window::open(&["assets/scenes/orbits.toml", "--samples", "1"]);
    window.settle();
    assert_eq!(window.request().camera, None);
}

#[test]
fn a_scaled_picture_is_rendered_anew_once_the_size_is_quiet() {
    let scene = "assets/scenes/sphere.scene";
    let mut window = Window::open(&[scene, "--samples", "65536"]);
    let start = Instant::now();
    loop {
        assert!(start.elapsed() < PATIENCE, "too fast to be worth keeping");
        window.harness.step();
        let render = window.harness.state().render_thread();
        let shown = render.shown(glimray_viewer::worker::progressive_image::PictureSlot::Main);
        let progress = shown.map(|shown| shown.progress).unwrap_or_default();
        if !progress.is_coarse && progress.trace_seconds > 2.5 {
            break;
        }
    }
    let before = window.session().picture_size();
    window.session().view.paused = true;
    window.harness.set_size(vec2(900.0, 640.0));
    window.harness.run_steps(20);
    assert_eq!(
        window.session().picture_size(),
        before,
        "a paused picture is lost"
    );
    window.harness.get_by_label("Re-render to fit");
    window.session().view.paused = false;
    window.harness.run_steps(20);
    let viewport = window.session().viewport.expect("a picture");
    let size = window.session().picture_size();
    assert_ne!(size, before, "still scaled");
    let pixels = viewport.rect.size();
    assert!((pixels.x - size.0 as f32).abs() < 2.0 && (pixels.y - size.1 as f32).abs() < 2.0);
    let label = "Re-render to fit";
    assert!(window.harness.query_by_label(label).is_none());
}

#[test]
fn the_inspector_puts_back_the_layout_that_it_found() {
    let mut window = Window::open(&["--size", "64x48", "--samples", "1"]);
    window.settle();
    let rects = |window: &Window| {
        let layout = window.harness.state().layout();
        Panel::ALL.map(|panel| layout.is_visible(panel).then(|| layout.rect(panel)))
    };
    let before = rects(&window);
    window.harness.key_press(Key::I);
    window.settle();
    assert_ne!(rects(&window), before);
    window.harness.key_press(Key::I);
    window.settle();
    window.harness.key_press(Key::Escape);
    window.settle();
    assert_eq!(rects(&window), before);
    // A panel that was opened meanwhile stays open.
    window.harness.key_press(Key::I);
    window.settle();
    window.harness.key_press(Key::O);
    window.settle();
    window.harness.key_press(Key::Escape);
    window.settle();
    assert!(!window.harness.state().layout().is_visible(Panel::Outline));
    assert!(!window.harness.state().layout().is_visible(Panel::Outside));
}
