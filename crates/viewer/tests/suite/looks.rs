//! The look of the window: pictures of it, held against those in `tests/snapshots`.
//! `UPDATE_SNAPSHOTS=1 cargo test --profile ci -p glimray-viewer looks` writes them anew.

use crate::harness::Window;
use crate::support::verdict::Verdict;
use eframe::egui::{self, Key};
use egui_kittest::kittest::Queryable;
use egui_kittest::{SnapshotError, SnapshotOptions, try_image_snapshot_options};
use glimray::scene::{Geometry, ObjectRef};
use glimray_viewer::actions::inspector;
use glimray_viewer::model::objects::Id;
use glimray_viewer::model::preferences::Theme;
use glimray_viewer::model::tool::Tool;
use glimray_viewer::model::view_settings::{ErrorMap, Sharing};
use glimray_viewer::state::layout::Panel;

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
    let folder = "tests/snapshots";
    let options = SnapshotOptions::default()
        .output_path(folder)
        .max_failed_pixels(MAX_PIXELS);
    window.harness.snapshot_options(name, &options);
}

/// Checks a rectangle, in points, of a picture of the window.
fn check_part(
    image: &::image::RgbaImage,
    rect: egui::Rect,
    scale: f32,
    name: &str,
) -> Result<(), SnapshotError> {
    let (corner, size) = (rect.min * scale, rect.size() * scale);
    let part = ::image::imageops::crop_imm(
        image,
        corner.x.round() as u32,
        corner.y.round() as u32,
        size.x.round() as u32,
        size.y.round() as u32,
    );
    let folder = "tests/snapshots";
    let options = SnapshotOptions::default()
        .output_path(folder)
        .max_failed_pixels(MAX_PIXELS);
    try_image_snapshot_options(&part.to_image(), name, &options)
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
    inspect_the_centre(&mut window);
    check(&mut window, "rays");
}

#[test]
fn the_paths_of_a_pixel_are_lists_and_lines_in_space() {
    let scene = "assets/scenes/cornell_box.toml";
    let mut window = Window::open(&[scene, "--size", "240x240", "--integrator", "path"]);
    window.harness.set_size(egui::vec2(1280.0, 1000.0));
    window.session().shows_statistics = false;
    window.settle();
    inspect_the_centre(&mut window);
    // Through the glass ball.
    inspector::inspect(&mut window.session(), [165, 183]);
    check(&mut window, "rays_path");
}

/// Takes the ray inspector and clicks the centre of the picture.
fn inspect_the_centre(window: &mut Window) {
    window.harness.key_press(Key::I);
    window.settle();
    let viewport = window.session().viewport.expect("a picture");
    let at = viewport.point(glam::dvec2(0.5, 0.5) * viewport.extent());
    window.harness.drag_at(at);
    window.harness.step();
    window.harness.drop_at(at);
    window.settle();
    window.harness.hover_at(egui::pos2(4.0, 690.0));
}

#[test]
fn a_picture_is_compared_with_its_snapshot_before_an_edit() {
    let mut window = open();
    window
        .harness
        .key_press_modifiers(egui::Modifiers::SHIFT, Key::K);
    window.settle();
    window.session().edit("shrink", |scene| {
        let Geometry::Sphere { radius, .. } = &mut scene.shapes[2].geometry else {
            panic!("not a sphere");
        };
        *radius *= 0.7;
    });
    window.session().view.compare(Sharing::Wipe(0.5));
    // Messages go away in time.
    let messages = window.session().messages.current();
    for message in messages {
        window.session().messages.dismiss(&message.text);
    }
    check(&mut window, "compare_wipe");
    window
        .session()
        .view
        .compare(Sharing::Difference(ErrorMap::absolute(2.0)));
    check(&mut window, "compare_difference");
    window.harness.get_by_label("Log").scroll_to_me();
    window.settle();
    let plot = (window.harness).get_by_label_contains("Histogram: ").rect();
    let image = window.harness.render().expect("a picture of the window");
    check_part(&image, plot, 1.0, "histogram").expect("the snapshot");
}

#[test]
fn every_panel_is_legible_in_both_themes_at_both_scales() {
    let mut verdict = Verdict::on("panels");
    let looks = [
        (Theme::Dark, "dark", 1.0, "100"),
        (Theme::Dark, "dark", 2.0, "200"),
        (Theme::Light, "light", 1.0, "100"),
        (Theme::Light, "light", 2.0, "200"),
    ];
    for (theme, color, scale, percent) in looks {
        let scene = "assets/scenes/orbits.toml";
        let mut window = Window::open(&[scene, "--size", "160x120", "--samples", "1"]);
        {
            let mut session = window.session();
            session.shows_statistics = false;
            session.preferences.theme = theme;
            session.selection = Some(Id::Object(ObjectRef::Shape(0)));
        }
        let viewports = &mut window.harness.input_mut().viewports;
        let root = viewports.get_mut(&egui::ViewportId::ROOT);
        root.expect("a window").native_pixels_per_point = Some(scale);
        window.settle();
        let mut compare = |window: &mut Window, panel: Panel| {
            window.settle();
            let rect = window.harness.state().layout().rect(panel);
            let rect = rect.unwrap_or_else(|| panic!("{panel:?} is hidden"));
            let image = window.harness.render().expect("a picture of the window");
            let name = format!("panels/{panel:?}_{color}_{percent}").to_lowercase();
            let outcome = check_part(&image, rect, scale, &name);
            verdict.that(name, outcome.is_ok(), || format!("{:?}", outcome.err()));
        };
        for panel in [
            Panel::Picture,
            Panel::Outline,
            Panel::Properties,
            Panel::Time,
            Panel::Render,
        ] {
            compare(&mut window, panel);
        }
        inspect_the_centre(&mut window);
        for panel in [Panel::Rays, Panel::Outside] {
            compare(&mut window, panel);
        }
    }
    verdict.close();
}
