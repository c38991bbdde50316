//! The first picture of the window, and a drag that goes round it.

use crate::harness::Window;
use crate::reference::compare::render;
use eframe::egui;
use egui_kittest::kittest::Queryable;

#[test]
fn the_demo_is_shown_without_a_file() {
    let mut window = Window::open(&["--size", "64x48", "--samples", "2"]);
    window.settle();
    window.harness.get_by_label("Rendered picture");
    let shown = window.shown();
    assert!(shown.progress.is_done, "{:?}", shown.progress);
    assert_eq!(shown.progress.samples, 2);
    assert_eq!(shown.size, (64, 48));
}

#[test]
fn a_converged_picture_has_the_pixels_of_the_command_line() {
    let mut window = Window::open(&["--size", "64x48", "--samples", "4"]);
    window.settle();
    let request = window.request();
    let (expected, _) = render(&request.scene, &request.settings);
    let image = window.image(glimray::render::Tone::LINEAR);
    assert!(
        image == expected,
        "the window's picture differs from the renderer's"
    );
}

#[test]
fn a_drag_goes_round_the_scene() {
    let mut window = Window::open(&["--size", "64x48"]);
    window.settle();
    let before = window.camera();
    let middle = window
        .harness
        .get_by_label("Rendered picture")
        .rect()
        .center();
    window.harness.drag_at(middle);
    window.harness.step();
    window.harness.hover_at(middle + egui::vec2(12.0, 0.0));
    window.harness.step();
    window.harness.drop_at(middle + egui::vec2(12.0, 0.0));
    window.settle();
    let after = window.camera();
    assert_ne!(before.look_from, after.look_from);
    let distance = |camera: &glimray::scene::Camera| camera.look_from.distance(camera.look_at);
    assert!((distance(&before) - distance(&after)).abs() < 1e-9);
    assert!((before.look_from.y - after.look_from.y).abs() < 1e-9);
}
