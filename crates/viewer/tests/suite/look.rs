//! How the picture is looked at: the panel of its settings, comparing, and rendering a part.

use crate::harness::Window;
use crate::reference::compare::start;
use eframe::egui::{self, Key, Pos2};
use egui_kittest::kittest::{NodeT, Queryable, by};
use glam::Vec3;
use glimray::render::Integrator;
use glimray::scene::{Antialias, Background};
use glimray_viewer::model::preferences::Theme;
use glimray_viewer::model::tool::Tool;
use glimray_viewer::model::view_settings::{Comparison, Sharing, Source};
use glimray_viewer::worker::progressive_image::PictureSlot;

fn open() -> Window {
    let mut window = Window::open(&["--size", "64x48", "--samples", "4"]);
    window.settle();
    window
}

fn click(window: &mut Window, label: &str) {
    window.harness.get_by_label(label).click();
    window.settle();
}

/// Unfolds a section of the panel.
pub fn unfold(window: &mut Window, title: &str) {
    let role = egui::Role::DisclosureTriangle;
    (window.harness.get_by_role_and_label(role, title)).scroll_to_me();
    window.settle();
    window.harness.get_by_role_and_label(role, title).click();
    window.settle();
}

/// Where a share of the picture's width and height is on the screen.
fn at(window: &Window, x: f64, y: f64) -> Pos2 {
    let viewport = window.session().viewport.expect("a picture");
    viewport.point(glam::dvec2(x, y) * viewport.extent())
}

fn drag(window: &mut Window, from: Pos2, to: Pos2) {
    window.harness.hover_at(from);
    window.harness.step();
    window.harness.drag_at(from);
    window.harness.step();
    for share in [0.3, 0.7, 1.0] {
        window.harness.hover_at(from + (to - from) * share);
        window.harness.step();
    }
    window.harness.drop_at(to);
    window.settle();
}

#[test]
fn samples_are_doubled_and_halved_by_buttons() {
    let mut window = open();
    click(&mut window, "×2");
    assert_eq!(window.session().view.settings.samples, 8);
    assert_eq!(window.shown().progress.target, 8);
    assert_eq!(window.shown().progress.samples, 8);
    click(&mut window, "½");
    click(&mut window, "½");
    assert_eq!(window.shown().progress.samples, 2);
}

#[test]
fn one_sample_lies_in_the_centre_and_several_are_spread() {
    let window = open();
    let look = &mut window.session().view;
    // The demo's own choice is adaptive.
    look.settings.antialias = Antialias::Stratified;
    look.set_samples(1);
    assert_eq!(look.settings.antialias, Antialias::None);
    look.set_samples(2);
    assert_eq!(look.settings.antialias, Antialias::Stratified);
    // The person's choice stays.
    look.settings.antialias = Antialias::Adaptive;
    look.set_samples(1);
    assert_eq!(look.settings.antialias, Antialias::Adaptive);
    look.set_samples(0);
    assert_eq!(look.settings.samples, 1);
}

#[test]
fn a_changed_value_has_a_way_back_to_the_scene() {
    let mut window = open();
    assert!(window.harness.query_by_label("Reset exposure").is_none());
    let scene = window.session().view.scene_tone.exposure_ev;
    window.session().view.tone.exposure_ev = scene + 2.0;
    window.session().view.settings.max_depth += 3;
    window.settle();
    click(&mut window, "Reset exposure");
    assert_eq!(window.session().view.tone.exposure_ev, scene);
    assert!(window.harness.query_by_label("Reset exposure").is_none());
    unfold(&mut window, "Rays");
    (window.harness.get_by_label("Reset max depth")).scroll_to_me();
    window.settle();
    click(&mut window, "Reset max depth");
    let look = window.session().view.clone();
    assert_eq!(look.settings, look.scene_settings);
}

#[test]
fn every_setting_of_the_picture_is_in_the_panel_under_its_name() {
    let mut window = open();
    unfold(&mut window, "Sampling");
    unfold(&mut window, "Rays");
    for name in [
        "View mode",
        "Compare",
        "Samples",
        "Antialias",
        "Noise",
        "Filter",
        "Filter radius",
        "Light samples",
        "Seed",
        "Max depth",
        "Min throughput",
        "Triangle test",
        "Brute force",
        "Fit to window",
        "Width",
        "Height",
        "Exposure",
        "Tone curve",
        "Transfer",
        "Denoise",
    ] {
        let widgets = window.harness.get_all_by_label(name);
        let count = widgets
            .filter(|node| node.accesskit_node().role() != egui::Role::Label)
            .count();
        assert_eq!(count, 1, "{name}");
    }
}

#[test]
fn pausing_and_restarting_are_buttons() {
    let mut window = open();
    let room = |window: &Window, name: &str| window.harness.get_by_label(name).rect();
    let before = room(&window, "Pause");
    click(&mut window, "Pause");
    assert!(window.session().view.paused);
    assert_eq!(room(&window, "Continue"), before, "the buttons jump");
    click(&mut window, "Continue");
    assert!(!window.session().view.paused);
    let before = window.shown().stats.samples;
    click(&mut window, "Restart");
    let traced = window.shown().stats.samples - before;
    assert!(traced >= 4 * 64 * 48, "{traced} samples");
}

#[test]
fn the_line_of_a_split_wipe_is_moved_by_mouse_and_by_keys() {
    let mut window = open();
    window.session().view.compare(Sharing::Wipe(0.5));
    window.settle();
    let request = |window: &Window, place: PictureSlot| {
        let requests = window.session().requests();
        requests.pictures[place as usize]
            .clone()
            .expect("a picture")
    };
    assert_eq!(
        request(&window, PictureSlot::Main).settings.integrator,
        Integrator::Whitted
    );
    assert_eq!(
        request(&window, PictureSlot::Beside).settings.integrator,
        Integrator::Normals
    );
    let share = |window: &Window| match window.session().view.comparison {
        Some(Comparison {
            sharing: Sharing::Wipe(share),
            ..
        }) => f64::from(share),
        other => panic!("no wipe: {other:?}"),
    };
    let before = window.camera();
    let (from, to) = (at(&window, 0.5, 0.3), at(&window, 0.25, 0.3));
    drag(&mut window, from, to);
    assert!((share(&window) - 0.25).abs() < 0.01, "{}", share(&window));
    assert_eq!(
        window.camera().look_from,
        before.look_from,
        "the camera moved too"
    );
    window.harness.get_by_label("Comparison wipe").focus();
    window.harness.step();
    let start = share(&window);
    window.harness.key_press(Key::ArrowRight);
    window.harness.key_press(Key::ArrowRight);
    window.harness.key_press(Key::ArrowLeft);
    window.settle();
    assert!(
        (share(&window) - start - 0.02).abs() < 1e-5,
        "{}",
        share(&window)
    );
    click(&mut window, "Swap");
    assert_eq!(
        request(&window, PictureSlot::Main).settings.integrator,
        Integrator::Normals
    );
    assert_eq!(
        request(&window, PictureSlot::Beside).settings.integrator,
        Integrator::Whitted
    );
}

#[test]
fn the_mouse_goes_round_the_scene_in_both_pictures_side_by_side() {
    let mut window = open();
    window.session().view.compare(Sharing::SideBySide);
    window.settle();
    let whole = window.harness.get_by_label("Rendered picture").rect();
    for share in [0.25, 0.75] {
        let before = window.camera().look_from;
        let from = whole.lerp_inside(egui::vec2(share, 0.5));
        drag(&mut window, from, from + egui::vec2(20.0, 0.0));
        assert_ne!(window.camera().look_from, before, "at {share}");
    }
}

#[test]
fn a_region_is_drawn_with_the_mouse_its_edges_are_moved_and_it_ends() {
    let mut window = open();
    window.session().tool = Tool::Region;
    let camera = window.camera().look_from;
    // Upwards and to the left: the corners may come in any order.
    let (from, to) = (at(&window, 0.75, 0.75), at(&window, 0.25, 0.25));
    drag(&mut window, from, to);
    let close = |window: &Window, expected: [f64; 4]| {
        let region = window.session().view.region.expect("a region");
        let off = region.iter().zip(expected).map(|(a, b)| (a - b).abs());
        assert!(
            off.fold(0.0, f64::max) < 0.02,
            "{region:?} is not {expected:?}"
        );
    };
    close(&window, [0.25, 0.25, 0.75, 0.75]);
    assert_eq!(window.session().tool, Tool::Select);
    let [.., width, height] = window.shown().region;
    assert!(
        width.abs_diff(32) <= 1 && height.abs_diff(24) <= 1,
        "{width}×{height}"
    );
    let (from, to) = (at(&window, 0.75, 0.5), at(&window, 0.9, 0.6));
    drag(&mut window, from, to);
    close(&window, [0.25, 0.25, 0.9, 0.75]);
    assert_eq!(window.camera().look_from, camera, "the camera moved too");
    window.harness.get_by_label("Left edge");
    window.harness.get_by_label("Clear region").scroll_to_me();
    window.settle();
    click(&mut window, "Clear region");
    assert!(window.session().view.region.is_none());
    assert_eq!(window.shown().region, [0, 0, 64, 48]);
}

#[test]
fn a_click_with_the_region_tool_is_no_region() {
    let mut window = open();
    window.session().tool = Tool::Region;
    let from = at(&window, 0.5, 0.5);
    drag(&mut window, from, from + egui::vec2(1.0, 1.0));
    assert!(window.session().view.region.is_none());
    assert_eq!(window.session().tool, Tool::Region);
}

#[test]
fn an_edge_that_is_dragged_over_the_middle_stays_in_its_picture() {
    let mut window = open();
    window.session().view.compare(Sharing::SideBySide);
    window.session().view.region = Some([0.25, 0.25, 0.75, 0.75]);
    window.settle();
    let whole = window.harness.get_by_label("Rendered picture").rect();
    let from = at(&window, 0.75, 0.5);
    drag(&mut window, from, whole.lerp_inside(egui::vec2(0.75, 0.5)));
    let region = window.session().view.region.expect("a region");
    assert_eq!(region, [0.25, 0.25, 1.0, 0.75]);
}

#[test]
fn a_view_of_a_quantity_has_a_legend_with_its_range_and_unit() {
    let mut window = Window::open(&["--size", "64x48", "--samples", "1"]);
    window.settle();
    let legends = |window: &Window| {
        let found = window.harness.query_all(by().label_contains("Legend: "));
        found
            .filter_map(|node| node.accesskit_node().label())
            .collect::<Vec<_>>()
    };
    assert!(legends(&window).is_empty());
    for (integrator, words) in [
        (Integrator::Depth, "scene units"),
        (Integrator::Heat, "steps"),
        (Integrator::Samples, "samples from 1 (black) to 1"),
    ] {
        window.session().view.settings.integrator = integrator;
        window.settle();
        let tone = window.request().tone;
        let [least, most] = window.shown().range.expect("a range");
        assert!(
            least <= most && most > 0.0,
            "{integrator:?}: {least}, {most}"
        );
        let found = legends(&window);
        assert!(found.len() == 1 && found[0].contains(words), "{found:?}");
        assert!(
            found[0].contains(&glimray_app::legend::number(least)),
            "{found:?}"
        );
        // Saved pictures and those of the command line are as shown.
        let settings = window.request().settings;
        let mut renderer = start(&window.request().scene, &settings).expect("a renderer");
        while !renderer.is_done() {
            renderer.step().expect("a step");
        }
        assert_eq!(renderer.range().expect("a range"), Some([least, most]));
        let expected = renderer.develop(&tone).expect("a picture");
        assert!(window.image(tone) == expected, "{integrator:?}");
    }
    // Two of them in a comparison, and none without overlays.
    window.session().view.comparison = Some(Comparison {
        source: Source::Integrator(Integrator::Depth),
        sharing: Sharing::Wipe(0.5),
    });
    window.settle();
    assert_eq!(legends(&window).len(), 2);
    window.session().shows_overlays = false;
    window.settle();
    assert!(legends(&window).is_empty());
}

#[test]
fn stops_are_shown_with_two_decimals() {
    let mut window = open();
    let exposure = 0.2 + 1.0 / 3.0;
    window.session().view.tone.exposure_ev = exposure;
    window.settle();
    window.harness.get_by_value("0.53 EV");
    assert_eq!(window.session().view.tone.exposure_ev, exposure);
}

#[test]
fn every_glyph_of_buttons_is_in_the_fonts() {
    let mut window = open();
    window.harness.step();
    // Glyphs of egui's colour picker, of panels and of tabs.
    for glyph in "📋⚠↺↻➕≤≥→←↑↓×½°".chars() {
        let font = egui::FontId::proportional(13.0);
        let is_there = (window.harness.ctx).fonts_mut(|fonts| fonts.has_glyph(&font, glyph));
        assert!(is_there, "{glyph}");
    }
}

#[test]
fn a_pale_colour_has_an_edge_that_is_seen_on_a_light_panel() {
    let mut window = Window::open(&["--size", "64x48", "--samples", "1"]);
    window.session().preferences.theme = Theme::Light;
    window.session().edit("whiten", |scene| {
        scene.background = Background::Color(Vec3::ONE)
    });
    window.settle();
    let rect = window.harness.get_by_label("Background colour").rect();
    let picture = window.harness.render().expect("a picture of the window");
    let grey = |pos: Pos2| {
        let pixel = picture.get_pixel(pos.x as u32, pos.y as u32).0;
        pixel[..3]
            .iter()
            .map(|level| i32::from(*level))
            .sum::<i32>()
            / 3
    };
    let panel = grey(rect.left_center() - egui::vec2(2.0, 0.0));
    let edges = [-0.5, 0.5, 1.5].map(|y| grey(rect.center_top() + egui::vec2(0.0, y)));
    let darkest = edges.into_iter().min().expect("a pixel");
    assert!(panel - darkest > 60, "{edges:?} on {panel}");
}

#[test]
fn where_a_scene_does_not_set_its_samples_the_window_aims_at_64() {
    let folder = tempfile::tempdir().expect("a folder");
    let text = "camera = { look_from = [0, 0, 8], look_at = [0, 0, 0] }\n";
    for (name, said, own, aim) in [
        ("silent.toml", "", 1, 64),
        ("few.toml", "output = { samples = 3 }\n", 3, 3),
        ("many.toml", "output = { samples = 100 }\n", 100, 100),
    ] {
        let path = folder.path().join(name);
        std::fs::write(&path, format!("{said}{text}")).expect("a file");
        let path = path.to_str().expect("a path in UTF-8");
        let mut window = Window::open(&[path, "--size", "16x12"]);
        window.settle();
        assert_eq!(window.shown().progress.samples, aim, "{name}");
        // Keeping the other settings does not write the window's own count into the scene.
        window.session().save_view_settings();
        let kept = window.session().scene().expect("a scene").output.samples;
        assert_eq!(kept, own, "{name}");
    }
}
