//! Sheets of the window: bindings that are changed, preferences that are kept.

use crate::harness::Window;
use eframe::egui;
use egui_kittest::kittest::Queryable;
use glimray_viewer::actions::settings;
use glimray_viewer::model::bindings::Action;
use glimray_viewer::model::preferences::{Store, Theme};
use glimray_viewer::model::tool::Tool;
use glimray_viewer::state::dialogs::Dialog;
use glimray_viewer::state::layout::Panel;
use std::fs;

const SMALL: [&str; 4] = ["--size", "48x32", "--samples", "1"];

fn open() -> Window {
    let mut window = Window::open(&SMALL);
    window.settle();
    window
}

fn label(window: &Window, action: Action) -> String {
    window.session.borrow().preferences.bindings.label(action)
}

/// Changes a binding as a person would: opens the sheet, searches, clicks and presses.
fn rebind(window: &mut Window, action: Action, modifiers: egui::Modifiers, key: egui::Key) {
    if !window.session().dialogs.is_open(Dialog::Shortcuts) {
        window.harness.key_press(egui::Key::F1);
        window.harness.run_steps(2);
    }
    window.harness.get_by_label("Search shortcuts").focus();
    window.harness.step();
    let name = action.name().to_owned();
    window.harness.event(egui::Event::Text(name));
    window.harness.run_steps(2);
    let button = format!("Change: {}", action.description());
    window.harness.get_by_label(&button).click();
    window.harness.run_steps(3);
    window.harness.key_press_modifiers(modifiers, key);
    window.harness.run_steps(2);
}

#[test]
fn every_command_is_in_the_sheet_of_bindings() {
    let window = open();
    window.session().dialogs.open(Dialog::Shortcuts);
    let mut window = window;
    window.harness.run_steps(3);
    for action in Action::ALL {
        let name = format!("Change: {}", action.description());
        let found = window.harness.query_all_by_label(&name).count();
        assert!(found >= 1, "{} is not in the sheet", action.name());
    }
}

#[test]
fn a_changed_binding_gives_the_command_and_is_kept() {
    let mut window = open();
    rebind(
        &mut window,
        Action::TogglePanels,
        egui::Modifiers::ALT,
        egui::Key::J,
    );
    assert_eq!(label(&window, Action::TogglePanels), "Alt+J");
    window.session().dialogs.close(Dialog::Shortcuts);
    settings::write(&mut window.session());
    let mut store = Store::in_folder(window.settings.path());
    let (kept, notes) = store.load();
    assert_eq!(notes, Vec::<String>::new());
    assert_eq!(kept.bindings.label(Action::TogglePanels), "Alt+J");
}

#[test]
fn a_key_that_another_command_has_is_refused_and_said() {
    let mut window = open();
    let before = label(&window, Action::TogglePanels);
    rebind(
        &mut window,
        Action::TogglePanels,
        egui::Modifiers::NONE,
        egui::Key::G,
    );
    assert_eq!(label(&window, Action::TogglePanels), before);
    assert_eq!(label(&window, Action::Tool(Tool::Move)), "G");
    let why = format!(
        "G is already used by “{}”. Change that shortcut first.",
        Action::Tool(Tool::Move).description()
    );
    window.harness.get_by_label(&why);
}

#[test]
fn a_key_that_is_captured_gives_no_command() {
    let mut window = open();
    let tool = window.session().tool;
    rebind(
        &mut window,
        Action::TogglePanels,
        egui::Modifiers::NONE,
        egui::Key::R,
    );
    assert_eq!(window.session().tool, tool);
}

#[test]
fn escape_closes_the_uppermost_sheet_only() {
    let mut window = open();
    window.session().dialogs.close(Dialog::Hint);
    window.session().dialogs.open(Dialog::Messages);
    window.session().dialogs.open(Dialog::Preferences);
    window.harness.run_steps(2);
    window.harness.key_press(egui::Key::Escape);
    window.harness.run_steps(2);
    assert!(!window.session().dialogs.is_open(Dialog::Preferences));
    assert!(window.session().dialogs.is_open(Dialog::Messages));
}

#[test]
fn the_hint_is_shown_until_it_is_read_once() {
    let mut window = Window::open_with(&SMALL, tempfile::tempdir().expect("a folder"));
    window.settle();
    window.harness.get_by_label("Got it").click();
    window.harness.run_steps(2);
    assert!(window.session().preferences.hint_seen);
    settings::write(&mut window.session());
    let Window { settings, .. } = window;
    let mut again = Window::open_with(&SMALL, settings);
    again.settle();
    assert!(again.harness.query_by_label("Got it").is_none());
}

#[test]
fn theme_scale_and_panels_come_back_and_are_reset_in_one_click() {
    let mut window = open();
    window.session().preferences.theme = Theme::Light;
    window.session().preferences.ui_scale = 1.25;
    window.harness.key_press(egui::Key::O);
    window.settle();
    // More than a second of the window's own clock.
    window.harness.run_steps(8);
    settings::write(&mut window.session());
    let Window { settings, .. } = window;
    let mut again = Window::open_with(&SMALL, settings);
    again.settle();
    assert_eq!(again.harness.ctx.theme(), egui::Theme::Light);
    assert_eq!(again.harness.ctx.zoom_factor(), 1.25);
    assert!(!again.harness.state().layout().is_visible(Panel::Outline));
    again.session().dialogs.open(Dialog::Preferences);
    again.harness.run_steps(3);
    again.harness.get_by_label("Reset everything…").click();
    again.harness.run_steps(3);
    again.harness.get_by_label("Reset everything now").click();
    again.harness.run_steps(3);
    assert_eq!(again.session().preferences.theme, Theme::System);
    assert_eq!(again.session().preferences.ui_scale, 1.0);
    assert!(again.harness.state().layout().is_visible(Panel::Outline));
}

#[test]
fn settings_that_cannot_be_written_are_one_notice() {
    let settings = tempfile::tempdir().expect("a folder");
    let mut window = Window::open_with(&SMALL, settings);
    window.settle();
    // A file is where the folder should be.
    let blocked = window.settings.path().join("blocked");
    fs::write(&blocked, "").expect("a file");
    window.session().store = Store::in_folder(blocked.join("settings"));
    for scale in [1.25, 1.5, 1.75] {
        window.session().preferences.ui_scale = scale;
        settings::write(&mut window.session());
    }
    let session = window.session.borrow();
    let told = session
        .messages
        .all()
        .iter()
        .filter(|n| n.text.contains("Cannot save the settings"));
    assert_eq!(told.count(), 1);
}

#[test]
fn menu_entries_do_what_their_keys_do() {
    let mut window = open();
    window.harness.get_by_label("Window").click();
    window.harness.run_steps(3);
    window.harness.get_by_label_contains("Full screen");
    window.harness.get_by_label_contains("Zoom in").click();
    window.harness.run_steps(3);
    assert_eq!(window.session().preferences.ui_scale, 1.1);
}
