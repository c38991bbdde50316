//! What the window looks like: pictures of it, held against those in `tests/snapshots`.
//! `UPDATE_SNAPSHOTS=1 cargo test --release --test suite looks` writes them anew.

use super::harness::Window;
use eframe::egui::{self, Key};
use egui_kittest::SnapshotOptions;
use glimray::scene::ObjectRef;
use glimray::viewer::model::objects::Id;
use glimray::viewer::model::preferences::Theme;
use glimray::viewer::model::tool::Tool;
use glimray::viewer::model::view_settings::Sharing;

/// Other drivers round otherwise along edges: this many pixels of 700,000 may differ.
const MAX_PIXELS: usize = 1000;

fn open() -> Window {
    let mut window = Window::open(&["--size", "320x240", "--samples", "2"]);
    // Times are never the same.
    window.session().shows_statistics = false;
    window.settle();
    window
}

#[track_caller]
fn check(window: &mut Window, name: &str) {
    window.settle();
    let folder = concat!(env!("CARGO_MANIFEST_DIR"), "/tests/snapshots");
    let options = SnapshotOptions::default()
        .output_path(folder)
        .max_failed_pixels(MAX_PIXELS);
    window.harness.snapshot_options(name, &options);
}

#[test]
fn what_is_selected_has_handles_and_numbers() {
    let mut window = open();
    {
        let mut session = window.session();
        session.selection = Some(Id::Object(ObjectRef::Shape(3)));
        session.tool = Tool::Move;
    }
    check(&mut window, "editing");
}

#[test]
fn light_colours_are_legible_with_every_panel_beside_a_wipe() {
    let mut window = open();
    window.session().preferences.theme = Theme::Light;
    window.session().view.compare(Sharing::Wipe(0.4));
    check(&mut window, "light");
}

#[test]
fn twice_as_many_pixels_show_the_same() {
    let mut window = open();
    window.harness.set_pixels_per_point(2.0);
    check(&mut window, "fine");
}

#[test]
fn the_sheet_of_bindings_lies_over_the_window() {
    let mut window = open();
    window.harness.key_press(Key::F1);
    check(&mut window, "bindings");
}

#[test]
fn the_preferences_lie_over_the_window() {
    let mut window = open();
    window
        .harness
        .key_press_modifiers(egui::Modifiers::COMMAND, Key::Comma);
    check(&mut window, "preferences");
}

#[test]
fn the_rays_of_a_pixel_are_a_tree_and_lines_in_space() {
    let mut window = open();
    window.harness.key_press(Key::I);
    window.settle();
    let viewport = window.session().viewport.expect("a picture");
    let at = viewport.point(glam::dvec2(0.5, 0.5) * viewport.extent());
    window.harness.drag_at(at);
    window.harness.step();
    window.harness.drop_at(at);
    window.settle();
    window.harness.hover_at(egui::pos2(4.0, 690.0));
    check(&mut window, "rays");
}
