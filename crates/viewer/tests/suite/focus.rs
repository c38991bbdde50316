//! Where the keyboard goes: real clicks and keys, nothing set from outside.

use super::edit::{BLUE, RED, file, open, scene};
use crate::harness::Window;
use eframe::egui::{Event, Key, Modifiers, PointerButton, Pos2, Role};
use egui_kittest::kittest::{NodeT, Queryable};
use glimray::scene::{Geometry, Scene};
use glimray_viewer::model::tool::Tool;

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
