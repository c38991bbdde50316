//! The bars and the axes over the picture, and the grid of labels and fields beside it.

use crate::edit::{RED, file, on_screen, open};
use crate::focus::click_at;
use crate::harness::Window;
use crate::look::unfold;
use crate::support::verdict::Verdict;
use eframe::egui::{Event, FontId, Key, Modifiers, PointerButton, Pos2, Rect, Role, vec2};
use egui_kittest::kittest::{NodeT, Queryable, by};
use glam::{DVec3, dvec3};
use glimray::render::Integrator;
use glimray::scene::ObjectRef;
use glimray_app::layers::PictureLayer;
use glimray_viewer::actions::{files, settings};
use glimray_viewer::model::objects::Id;
use glimray_viewer::model::preferences::Store;
use glimray_viewer::model::tool::Tool;
use glimray_viewer::model::view_settings::Sharing;
use glimray_viewer::state::layout::Panel;

/// The rectangle of a button.
#[track_caller]
fn button(window: &Window, name: &str) -> Rect {
    let mut found = window.harness.query_all_by_label(name);
    let button = found.find(|node| node.accesskit_node().role() == Role::Button);
    button
        .unwrap_or_else(|| panic!("no button “{name}”"))
        .rect()
}

#[track_caller]
fn click(window: &mut Window, name: &str) {
    let at = button(window, name).center();
    click_at(window, at, PointerButton::Primary);
    window.settle();
}

#[test]
fn tools_are_buttons_over_the_picture_and_the_rest_of_it_takes_clicks() {
    let (_folder, path) = file();
    let mut window = open(&path, "400x300");
    let picture = window.harness.get_by_label("Rendered picture").rect();
    for (tool, name) in [
        (Tool::Move, "Move tool"),
        (Tool::Rotate, "Rotate tool"),
        (Tool::Scale, "Scale tool"),
        (Tool::Measure, "Measure tool"),
        (Tool::Select, "Select tool"),
    ] {
        assert!(picture.contains_rect(button(&window, name)), "{name}");
        click(&mut window, name);
        assert_eq!(window.session().tool, tool);
        // Elsewhere than over the picture it is seen too.
        let is_told = window
            .harness
            .query_by_role_and_label(Role::Label, name)
            .is_some();
        assert_eq!(is_told, tool != Tool::Select, "{name} in the status bar");
    }
    assert_eq!(window.session().selection, None, "a click fell through");
    let at = on_screen(&window, dvec3(-1.0, 0.0, 0.0));
    click_at(&mut window, at, PointerButton::Primary);
    window.settle();
    assert_eq!(window.session().selection, Some(RED));
    // Overlays are hidden together.
    (window.harness).key_press_modifiers(Modifiers::SHIFT, Key::O);
    window.settle();
    assert!(window.harness.query_by_label("Move tool").is_none());
}

#[test]
fn edits_are_undone_by_a_button_over_the_picture() {
    let (_folder, path) = file();
    let mut window = open(&path, "400x300");
    let is_enabled = |window: &Window, name: &str| {
        let node = window.harness.get_by_role_and_label(Role::Button, name);
        !node.accesskit_node().is_disabled()
    };
    assert!(!is_enabled(&window, "Undo"));
    let before = window.session().scene().expect("a scene").shapes.len();
    window.session().selection = Some(RED);
    window.harness.key_press(Key::Delete);
    window.settle();
    click(&mut window, "Undo");
    assert_eq!(
        window.session().scene().expect("a scene").shapes.len(),
        before
    );
    assert!(is_enabled(&window, "Redo"));
    let size = button(&window, "Undo").size();
    assert!(size.min_elem() >= 24.0, "{size:?}");
}

#[test]
fn the_upper_bar_has_view_mode_comparison_region_and_camera() {
    let (_folder, path) = file();
    let mut window = open(&path, "400x300");
    click(&mut window, "Classical (Whitted) ⏷");
    let entry = window.harness.get_by_label("Normals");
    entry.click();
    window.settle();
    assert_eq!(
        window.session().view.settings.integrator,
        Integrator::Normals
    );
    window.session().view.settings.integrator = Integrator::Path;
    window.settle();
    click(&mut window, "Path tracing ⏷");
    window.harness.get_by_label("Albedo").click();
    window.settle();
    assert_eq!(window.session().view.layer, PictureLayer::Albedo);
    assert_eq!(window.session().view.settings.integrator, Integrator::Path);
    window.harness.key_press(Key::Escape);
    window.harness.run_steps(2);
    click(&mut window, "Comparison");
    window.harness.get_by_label("Side by side").click();
    window.settle();
    let sharing = window.session().view.comparison.map(|it| it.sharing);
    assert_eq!(sharing, Some(Sharing::SideBySide));
    window.session().view.comparison = None;
    click(&mut window, "Render region");
    assert_eq!(window.session().tool, Tool::Region);
    click(&mut window, "Overlays");
    assert!(!window.session().shows_overlays);
    let messages = window.session().messages.current();
    let told = messages
        .iter()
        .any(|notice| notice.text.contains("Shift+O"));
    assert!(told, "nothing says how overlays come back");
}

fn direction(window: &Window) -> DVec3 {
    let camera = window.camera();
    (camera.look_at - camera.look_from).normalize()
}

#[test]
fn a_click_on_an_end_of_the_axes_looks_along_it_and_a_drag_orbits() {
    let (_folder, path) = file();
    let mut window = open(&path, "400x300");
    for (name, expected) in [
        ("Right view", DVec3::NEG_X),
        ("Top view", DVec3::NEG_Y),
        ("Front view", DVec3::NEG_Z),
    ] {
        click(&mut window, name);
        let found = direction(&window);
        assert!(found.dot(expected) > 0.999, "{name}: {found}");
    }
    let from = button(&window, "Front view").center();
    let to = from + vec2(20.0, 0.0);
    let press = |window: &mut Window, pos: Pos2, pressed| {
        window.harness.event(Event::PointerButton {
            pos,
            button: PointerButton::Primary,
            pressed,
            modifiers: Modifiers::NONE,
        });
        window.harness.step();
    };
    window.harness.hover_at(from);
    window.harness.step();
    press(&mut window, from, true);
    for share in [0.5, 1.0] {
        window.harness.hover_at(from + share * (to - from));
        window.harness.step();
    }
    press(&mut window, to, false);
    window.settle();
    let found = direction(&window);
    assert!(
        found.dot(DVec3::NEG_Z) < 0.99,
        "the drag did not orbit: {found}"
    );
    assert_eq!(window.session().selection, None);
}

#[test]
fn with_z_up_the_upper_end_of_the_axes_is_the_view_from_above() {
    let (_folder, path) = file();
    let text = std::fs::read_to_string(&path).expect("a scene");
    let from = "look_from = [0, 0, 8]";
    let turned = text.replace(from, "look_from = [0, -8, 0]\nup = [0, 0, 1]");
    std::fs::write(&path, turned).expect("a file");
    let mut window = open(&path, "400x300");
    let top = button(&window, "Top view").center();
    let front = button(&window, "Front view").center();
    assert!(top.y < front.y - 20.0, "{top} is not above {front}");
    for (name, expected) in [
        ("Top view", DVec3::NEG_Z),
        ("Right view", DVec3::NEG_X),
        ("Front view", DVec3::Y),
    ] {
        click(&mut window, name);
        let found = direction(&window);
        assert!(found.dot(expected) > 0.999, "{name}: {found}");
    }
}

#[test]
fn a_drag_at_the_axes_is_one_step_of_the_camera() {
    let (_folder, path) = file();
    let mut window = open(&path, "400x300");
    let before = window.camera();
    let from = button(&window, "Front view").center();
    window.harness.hover_at(from);
    window.harness.step();
    window.harness.drag_at(from);
    window.harness.step();
    let to = from + vec2(24.0, 8.0);
    for share in [0.25, 0.5, 0.75, 1.0] {
        window.harness.hover_at(from + share * (to - from));
        window.harness.step();
    }
    window.harness.drop_at(to);
    window.settle();
    assert_ne!(window.camera(), before);
    (window.harness).key_press_modifiers(Modifiers::ALT, Key::Z);
    window.settle();
    assert_eq!(window.camera(), before, "the drag is more than one step");
}

/// Fields with these names.
fn fields(window: &Window, names: &[&str]) -> Vec<Rect> {
    let found = |name: &&str| {
        let mut nodes = window.harness.query_all_by_label(name);
        let field = nodes.find(|node| node.accesskit_node().role() != Role::Label);
        field.unwrap_or_else(|| panic!("no field “{name}”")).rect()
    };
    names.iter().map(found).collect()
}

#[test]
fn fields_stand_under_each_other_and_fill_their_column() {
    let mut window = Window::open(&["assets/scenes/orbits.toml", "--size", "64x48"]);
    window.harness.set_size(vec2(1280.0, 800.0));
    window.session().selection = Some(Id::Object(ObjectRef::Shape(0)));
    window.settle();
    let mut verdict = Verdict::on("grid");
    for axis in ["x", "y", "z"] {
        let names = [format!("Position {axis}"), format!("Rotation {axis}")];
        let names = names.each_ref().map(String::as_str);
        let rects = fields(&window, &names);
        let is_under = (rects[0].min.x - rects[1].min.x).abs() < 0.5
            && (rects[0].max.x - rects[1].max.x).abs() < 0.5;
        verdict.that(axis, is_under, || format!("{rects:?}"));
    }
    let ends = |rects: Vec<Rect>| -> (Vec<f32>, Vec<f32>) {
        rects.iter().map(|rect| (rect.min.x, rect.max.x)).unzip()
    };
    for names in [
        &[
            "Shininess",
            "Opacity",
            "Priority",
            "Fresnel",
            "Mixing",
            "Material",
        ][..],
        &["View mode", "Exposure", "Tone curve", "Transfer", "Compare"],
    ] {
        let (left, right) = ends(fields(&window, names));
        for edges in [left, right] {
            let spread = edges.iter().fold(f32::MIN, |a, b| a.max(*b))
                - edges.iter().fold(f32::MAX, |a, b| a.min(*b));
            verdict.that(format!("{names:?}"), spread < 0.5, || format!("{edges:?}"));
        }
    }
    verdict.close();
}

#[test]
fn everyday_settings_stand_above_those_of_experts_which_are_folded() {
    let mut window = Window::open(&["--size", "64x48", "--samples", "1"]);
    window.settle();
    let top = |window: &Window, name: &str| fields(window, &[name])[0].min.y;
    let everyday = ["View mode", "Exposure", "Samples", "Denoise"];
    let lowest = everyday.map(|name| top(&window, name)).into_iter();
    let lowest = lowest.fold(f32::MIN, f32::max);
    assert!(lowest < top(&window, "Compare"));
    for expert in ["Triangle test", "Brute force", "Seed", "Min throughput"] {
        assert!(
            window.harness.query_all_by_label(expert).next().is_none(),
            "{expert}"
        );
    }
    for title in ["Sampling", "Rays"] {
        unfold(&mut window, title);
    }
    for expert in ["Triangle test", "Seed"] {
        assert!(
            window.harness.query_all_by_label(expert).next().is_some(),
            "{expert}"
        );
    }
}

#[test]
fn menus_fit_into_a_low_window() {
    let mut window = Window::open(&["--size", "64x48", "--samples", "1"]);
    window.harness.set_size(vec2(640.0, 480.0));
    window.settle();
    for (menu, last) in [
        ("File", "Quit"),
        ("View", "Level horizon"),
        ("Render", "Halve samples"),
    ] {
        let bar = window.harness.get_all_by_label(menu).next();
        bar.expect("a menu").click();
        window.harness.run_steps(3);
        let entry = window.harness.get_all(by().label_contains(last)).next();
        entry.expect("an entry").scroll_to_me();
        window.harness.run_steps(8);
        let rect = {
            let mut entries = window.harness.get_all(by().label_contains(last));
            entries.next().expect("an entry").rect()
        };
        let room = window.harness.ctx.content_rect();
        assert!(room.contains_rect(rect), "{menu}: {rect:?}");
        window.harness.key_press(Key::Escape);
        window.harness.run_steps(3);
    }
}

#[test]
fn letters_of_other_scripts_come_from_an_installed_font() {
    let name = "שלום";
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join(format!("{name}.toml"));
    std::fs::copy("assets/scenes/orbits.toml", &path).expect("a scene");
    let path = path.to_str().expect("Unicode");
    let mut window = Window::open(&["--size", "64x48", "--samples", "1"]);
    window.settle();
    let has_letters = |window: &Window| {
        let id = FontId::default();
        window
            .harness
            .ctx
            .fonts_mut(|fonts| fonts.has_glyphs(&id, name))
    };
    assert!(!has_letters(&window), "they were there before");
    files::open(&mut window.session(), vec![path.into()]);
    window.settle();
    let font = "/usr/share/fonts/truetype/dejavu/DejaVuSans.ttf";
    // A system without any font with these letters shows boxes.
    if std::path::Path::new(font).exists() {
        assert!(has_letters(&window));
    }
}

#[test]
fn a_field_of_view_in_whole_degrees_stays_one() {
    let mut window = Window::open(&["--size", "64x48", "--samples", "1"]);
    window.settle();
    for degrees in [35.0_f64, 50.0, 60.0, 70.0] {
        let mut session = window.session();
        let controller = session.controller.as_mut().expect("a camera");
        controller.set_fov_y(degrees.to_radians());
        let fov_y = controller.camera().fov_y;
        assert_eq!(fov_y.to_bits(), degrees.to_radians().to_bits(), "{degrees}");
    }
}

#[test]
fn the_first_steps_and_messages_leave_picture_and_histogram_free() {
    let settings = tempfile::tempdir().expect("a folder");
    let mut window = Window::open_with(&["--size", "64x48", "--samples", "1"], settings);
    window.harness.set_size(vec2(1280.0, 800.0));
    window.settle();
    let picture = window.harness.get_by_label("Rendered picture").rect();
    for name in ["Orbit", "Set the pivot", "Drop a file", "Blender, Maya…"] {
        let rect = window.harness.get_by_label(name).rect();
        assert!(
            rect.max.x < picture.min.x + 40.0,
            "{name}: {rect:?}, {picture:?}"
        );
    }
    window.session().messages.notify("A message");
    window.settle();
    let rect = window.harness.get_by_label("A message").rect();
    assert!(
        picture.contains_rect(rect),
        "{rect:?} is not in {picture:?}"
    );
}

#[test]
fn fields_of_a_small_window_at_200_percent_can_be_scrolled_into_view() {
    let mut window = Window::open(&["assets/scenes/orbits.toml", "--size", "64x48"]);
    window.session().selection = Some(Id::Object(ObjectRef::Shape(0)));
    window.session().preferences.ui_scale = 2.0;
    window.harness.set_size(vec2(640.0, 480.0));
    window.settle();
    let mut verdict = Verdict::on("fields");
    for (panel, name) in [
        (Panel::Properties, "Position x"),
        (Panel::Properties, "Position z"),
        (Panel::Properties, "Rotation z"),
        (Panel::Render, "View mode"),
        (Panel::Render, "Exposure"),
        (Panel::Render, "Samples"),
    ] {
        let mut nodes = window.harness.query_all_by_label(name);
        let field = nodes.find(|node| node.accesskit_node().role() != Role::Label);
        field.expect("a field").scroll_to_me();
        drop(nodes);
        window.settle();
        let panel = window
            .harness
            .state()
            .layout()
            .rect(panel)
            .expect("a panel");
        let rect = fields(&window, &[name])[0];
        let is_inside = rect.min.x >= panel.min.x - 0.5 && rect.max.x <= panel.max.x + 0.5;
        verdict.that(name, is_inside, || format!("{rect:?} in {panel:?}"));
    }
    verdict.close();
}

#[test]
fn the_first_steps_of_a_small_window_lie_over_the_picture() {
    let settings = tempfile::tempdir().expect("a folder");
    let mut window = Window::open_with(&["--size", "64x48", "--samples", "1"], settings);
    window.harness.set_size(vec2(640.0, 600.0));
    window.settle();
    let picture = window.harness.get_by_label("Rendered picture").rect();
    let button = window.harness.get_by_label("Got it").rect();
    assert!(picture.contains_rect(button), "{button:?}, {picture:?}");
    let outline = window.harness.state().layout().rect(Panel::Outline);
    let outline = outline.expect("the outline");
    let text = window.harness.get_by_label("Drop a file").rect();
    assert!(!outline.intersects(text), "{text:?}, {outline:?}");
}

#[test]
fn a_small_picture_has_the_most_important_buttons() {
    let mut window = Window::open(&["--size", "64x48", "--samples", "1"]);
    window.harness.set_size(vec2(640.0, 330.0));
    window.settle();
    let picture = window.harness.get_by_label("Rendered picture").rect();
    assert!(picture.height() < 300.0, "{picture:?}");
    for name in ["View ⏷", "Overlays", "Comparison", "Camera"] {
        let mut found = window.harness.query_all_by_label(name);
        let is_inside = found.any(|node| picture.contains_rect(node.rect()));
        assert!(is_inside, "{name} is not in {picture:?}");
    }
    assert!(window.harness.query_by_label("Render region").is_none());
}

#[test]
fn overlays_are_chosen_in_a_menu_that_stays_open_and_snapping_has_a_switch() {
    let (_folder, path) = file();
    let mut window = open(&path, "400x300");
    click(&mut window, "Choose overlays");
    for entry in ["Grid", "Selection outline"] {
        window.harness.get_by_label(entry).click();
        window.settle();
    }
    let chosen = window.session().preferences.overlays;
    assert!(chosen.grid && !chosen.outline && !chosen.wireframe);
    window.harness.key_press(Key::Escape);
    window.settle();
    // An overlay that is chosen while all are hidden is shown, and the others stay hidden.
    window.session().shows_overlays = false;
    (window.harness).key_press_modifiers(Modifiers::ALT, Key::G);
    window.settle();
    assert!(window.session().shows_overlays && window.session().preferences.overlays.grid);
    click(&mut window, "Snapping");
    assert!(window.session().preferences.snaps);
    // The next window has them.
    settings::write(&mut window.session());
    let (kept, _) = Store::in_folder(window.settings.path()).load();
    let chosen = window.session().preferences.overlays;
    assert!(chosen.grid && !chosen.outline);
    assert_eq!((kept.overlays, kept.snaps), (chosen, true));
    // Beside the rays the picture is narrow: the bar has fewer buttons, and all of them lie in it.
    window.harness.key_press(Key::I);
    window.settle();
    let picture = window.harness.get_by_label("Rendered picture").rect();
    assert!(picture.contains_rect(button(&window, "Camera")));
    assert!(window.harness.query_by_label("Choose overlays").is_none());
}
