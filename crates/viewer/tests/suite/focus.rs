//! Where the keyboard goes: real clicks and keys, nothing set from outside.

use super::contrast::contrast;
use super::edit::{BLUE, RED, file, open, scene};
use super::names::CONTROLS;
use crate::harness::Window;
use crate::support::verdict::Verdict;
use eframe::egui::{Color32, Event, Key, Modifiers, PointerButton, Pos2, Role};
use egui_kittest::kittest::{NodeT, Queryable, by};
use glimray::scene::{Geometry, Scene};
use glimray_viewer::model::tool::Tool;
use glimray_viewer::state::dialogs::Dialog;
use std::collections::BTreeSet;

/// A click of the left button, each event in a frame of its own.
pub fn click_at(window: &mut Window, pos: Pos2, button: PointerButton) {
    window.harness.hover_at(pos);
    window.harness.step();
    for pressed in [true, false] {
        window.harness.event(Event::PointerButton {
            pos,
            button,
            pressed,
            modifiers: Modifiers::NONE,
        });
        window.harness.step();
    }
    window.harness.run_steps(2);
}

fn click(window: &mut Window, label: &str) {
    let pos = window.harness.get_by_label(label).rect().center();
    click_at(window, pos, PointerButton::Primary);
}

/// A widget that is called so, and not the label beside it.
fn click_field(window: &mut Window, label: &str) {
    let pos = {
        let mut nodes = window.harness.get_all_by_label(label);
        let field = nodes.find(|node| node.accesskit_node().role() != Role::Label);
        field.expect("a field").rect().center()
    };
    click_at(window, pos, PointerButton::Primary);
}

/// Keys as a keyboard sends them: each letter is a key and a text.
pub fn type_text(window: &mut Window, text: &str) {
    for letter in text.chars() {
        let key = Key::from_name(&letter.to_uppercase().to_string());
        let press = |pressed| {
            key.map(|key| Event::Key {
                key,
                physical_key: None,
                pressed,
                repeat: false,
                modifiers: Modifiers::NONE,
            })
        };
        let events = press(true).into_iter();
        let events = events.chain([Event::Text(letter.into())]);
        for event in events.chain(press(false)) {
            window.harness.event(event);
        }
        window.harness.step();
    }
    window.harness.step();
}

fn key(window: &mut Window, key: Key) {
    window.harness.key_press(key);
    window.harness.run_steps(2);
}

/// State that letters would change if they were taken as shortcuts.
fn untouched(window: &Window) -> (Scene, Tool, bool, bool, bool) {
    let session = window.session();
    let (repeats, blurs) = (session.playback.repeats, session.playback.blurs);
    let scene = Scene::clone(session.scene().expect("a scene"));
    (scene, session.tool, repeats, blurs, session.view.paused)
}

#[test]
fn after_a_click_on_a_line_the_search_can_be_typed() {
    let (_folder, path) = file();
    let mut window = open(&path, "64x48");
    click(&mut window, "sphere 1 (red)");
    assert_eq!(window.session().selection, Some(RED));
    let before = untouched(&window);
    click(&mut window, "Search the outline");
    // Each of these letters is a shortcut too.
    type_text(&mut window, "blue");
    assert_eq!(window.session().editing.listing.query, "blue");
    assert!(untouched(&window) == before, "a letter fired a shortcut");
    let row_of = |id| window.session().editing.listing.row_of(id);
    assert!(row_of(BLUE).is_some() && row_of(RED).is_none());
}

#[test]
fn after_a_click_on_a_line_a_number_can_be_typed() {
    let (_folder, path) = file();
    let mut window = open(&path, "64x48");
    click(&mut window, "sphere 1 (red)");
    click_field(&mut window, "Position y");
    type_text(&mut window, "0.25");
    key(&mut window, Key::Enter);
    window.settle();
    let Geometry::Sphere { center, .. } = scene(&window).shapes[0].geometry else {
        panic!("a sphere stays one");
    };
    assert_eq!(center.to_array(), [-1.0, 0.25, 0.0]);
}

#[test]
fn after_a_click_on_a_line_a_path_can_be_typed() {
    let (folder, path) = file();
    let mut window = open(&path, "64x48");
    click(&mut window, "sphere 1 (red)");
    let name = folder.path().join("blue.toml");
    window
        .harness
        .key_press_modifiers(Modifiers::COMMAND | Modifiers::SHIFT, Key::S);
    window.harness.run_steps(3);
    click_field(&mut window, "File name");
    window
        .harness
        .key_press_modifiers(Modifiers::COMMAND, Key::A);
    window.harness.step();
    let before = untouched(&window);
    type_text(&mut window, name.to_str().expect("Unicode"));
    assert!(untouched(&window) == before, "a letter fired a shortcut");
    key(&mut window, Key::Enter);
    window.settle();
    assert!(name.is_file(), "nothing was saved under the typed name");
}

#[test]
fn after_a_click_on_a_line_a_name_can_be_typed_and_another_click_ends_it() {
    let (_folder, path) = file();
    let mut window = open(&path, "64x48");
    click(&mut window, "red");
    key(&mut window, Key::F2);
    window
        .harness
        .key_press_modifiers(Modifiers::COMMAND, Key::A);
    window.harness.step();
    type_text(&mut window, "plum");
    click(&mut window, "Search the outline");
    window.settle();
    assert_eq!(scene(&window).materials[0].name, "plum");
    type_text(&mut window, "plum");
    assert_eq!(window.session().editing.listing.query, "plum");
}

#[test]
fn arrows_go_on_through_the_outline_after_its_search_was_used() {
    let (_folder, path) = file();
    let mut window = open(&path, "64x48");
    click(&mut window, "Search the outline");
    type_text(&mut window, "sphere");
    click(&mut window, "sphere 1 (red)");
    key(&mut window, Key::ArrowDown);
    window.settle();
    assert_eq!(window.session().selection, Some(BLUE));
    key(&mut window, Key::ArrowUp);
    window.settle();
    assert_eq!(window.session().selection, Some(RED));
    assert_eq!(window.session().editing.listing.query, "sphere");
}

/// The name of the widget with the focus.
fn focused(window: &Window) -> Option<String> {
    let has_focus = |node: &egui_kittest::kittest::AccessKitNode<'_>| node.is_focused();
    let mut nodes = window.harness.query_all(by().predicate(has_focus));
    let name = nodes.next()?.accesskit_node().label();
    // Without a focused widget the window itself has the focus.
    name.filter(|name| !name.is_empty())
}

/// Presses Tab until a widget with this name has the focus.
#[track_caller]
fn tab_to(window: &mut Window, name: &str) {
    for _ in 0..400 {
        key(window, Key::Tab);
        if focused(window).as_deref() == Some(name) {
            return;
        }
    }
    panic!("Tab does not reach “{name}”");
}

#[test]
fn keys_perform_commands_while_a_button_has_the_focus() {
    let (_folder, path) = file();
    let mut window = open(&path, "64x48");
    key(&mut window, Key::Tab);
    assert!(focused(&window).is_some(), "Tab focuses something");
    let samples = window.session().view.settings.samples;
    key(&mut window, Key::M);
    assert_eq!(window.session().view.settings.samples, 2 * samples);
    (window.harness).key_press_modifiers(Modifiers::SHIFT, Key::M);
    window.harness.run_steps(2);
    assert_eq!(window.session().view.settings.samples, samples);
    key(&mut window, Key::F12);
    assert!(
        window.session().files.saving.is_some(),
        "F12 saves a picture"
    );
    key(&mut window, Key::Escape);
}

#[test]
fn space_belongs_to_the_button_with_the_focus() {
    let scene = "assets/scenes/orbits.toml";
    let mut window = Window::open(&[scene, "--size", "64x48", "--samples", "1"]);
    window.settle();
    tab_to(&mut window, "Loop");
    let before = window.session().playback.clone();
    key(&mut window, Key::Space);
    let now = window.session().playback.clone();
    assert_ne!(now.repeats, before.repeats);
    assert_eq!(now.is_playing, before.is_playing);
    key(&mut window, Key::U);
    assert_ne!(window.session().playback.blurs, before.blurs);
}

#[test]
fn function_keys_and_ctrl_chords_leave_a_text_and_letters_stay_in_it() {
    let (_folder, path) = file();
    let mut window = open(&path, "64x48");
    click(&mut window, "Search the outline");
    let before = untouched(&window);
    type_text(&mut window, "nlv");
    (window.harness).key_press_modifiers(Modifiers::COMMAND, Key::Z);
    window.harness.run_steps(2);
    assert!(untouched(&window) == before, "a letter fired a shortcut");
    let theme = window.harness.ctx.theme();
    key(&mut window, Key::F9);
    window.settle();
    assert_ne!(window.harness.ctx.theme(), theme);
    click(&mut window, "Search the outline");
    (window.harness).key_press_modifiers(Modifiers::COMMAND, Key::Comma);
    window.harness.run_steps(3);
    assert!(window.session().dialogs.is_open(Dialog::Preferences));
}

#[test]
fn a_command_while_a_number_is_typed_takes_the_number_first() {
    let (_folder, path) = file();
    let mut window = open(&path, "64x48");
    click(&mut window, "sphere 1 (red)");
    click_field(&mut window, "Position y");
    type_text(&mut window, "0.25");
    let count = scene(&window).shapes.len();
    (window.harness).key_press_modifiers(Modifiers::COMMAND, Key::D);
    window.settle();
    let shapes = scene(&window).shapes;
    assert_eq!(shapes.len(), count + 1, "Ctrl+D duplicates");
    let Geometry::Sphere { center, .. } = shapes[0].geometry else {
        panic!("a sphere stays one");
    };
    assert_eq!(center.y, 0.25);
}

#[test]
fn an_open_menu_leaves_function_keys_to_commands() {
    let (_folder, path) = file();
    let mut window = open(&path, "64x48");
    click(&mut window, "Edit");
    assert!(
        window
            .harness
            .query_by_label_contains("Duplicate")
            .is_some()
    );
    key(&mut window, Key::F12);
    window.harness.run_steps(2);
    assert!(
        window.session().files.saving.is_some(),
        "F12 saves a picture"
    );
    assert!(
        window
            .harness
            .query_by_label_contains("Duplicate")
            .is_none()
    );
}

#[test]
fn tab_reaches_every_widget_and_the_focus_has_a_ring() {
    let (_folder, path) = file();
    let mut window = open(&path, "64x48");
    // A selected line must not keep the focus.
    click(&mut window, "sphere 1 (red)");
    window.settle();
    let mut reached = BTreeSet::new();
    let plain = window.harness.render().expect("a picture of the window");
    let ringed = [
        "sphere 2 (blue)",
        "Hide sphere 2 (blue)",
        "Fold Materials",
        "Rendered picture",
        "Statistics",
        "Denoise",
    ];
    let mut verdict = Verdict::on("rings");
    loop {
        key(&mut window, Key::Tab);
        let name = focused(&window).unwrap_or_default();
        let has_focus = |node: &egui_kittest::kittest::AccessKitNode<'_>| node.is_focused();
        let nodes = window.harness.query_all(by().predicate(has_focus));
        let rects: Vec<_> = nodes.map(|node| node.rect()).collect();
        if ringed.contains(&name.as_str())
            && let Some(rect) = rects.first()
        {
            let picture = window.harness.render().expect("a picture of the window");
            let least = (0..4)
                .map(|inward| {
                    let at = (rect.min.x as u32 + inward, rect.center().y as u32);
                    let color = |picture: &::image::RgbaImage| {
                        let [r, g, b, _] = picture.get_pixel(at.0, at.1).0;
                        Color32::from_rgb(r, g, b)
                    };
                    contrast(color(&picture), color(&plain))
                })
                .fold(0.0, f64::max);
            verdict.that(&name, least >= 3.0, || format!("contrast {least:.2}"));
        }
        let key = (name, format!("{rects:?}"));
        if !reached.insert(key) {
            break;
        }
    }
    let names: BTreeSet<_> = reached.iter().map(|(name, _)| name.as_str()).collect();
    for name in ringed {
        verdict.that(name, names.contains(name), || {
            "Tab does not reach it".to_owned()
        });
    }
    let is_control = |node: &egui_kittest::kittest::AccessKitNode<'_>| {
        CONTROLS.contains(&node.role()) && !node.is_disabled()
    };
    for node in window.harness.query_all(by().predicate(is_control)) {
        let name = node.accesskit_node().label().unwrap_or_default();
        // Titles of panels can be dragged by the mouse; the menu Window shows panels.
        if node.accesskit_node().role() != Role::Tab && !names.contains(name.as_str()) {
            verdict.that(name, false, || "Tab does not reach it".to_owned());
        }
    }
    verdict.close();
}
