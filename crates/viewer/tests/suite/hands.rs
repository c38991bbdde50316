//! Effects of keys and buttons in the window.

use crate::harness::Window;
use eframe::egui::{self, Key, Modifiers, PointerButton, Pos2, Role};
use egui_kittest::kittest::Queryable;
use glimray_viewer::model::bindings::Action;

fn open(scene: &str) -> Window {
    let path = format!("assets/scenes/{scene}");
    let mut window = Window::open(&[&path, "--size", "64x48", "--samples", "2"]);
    window.settle();
    window
}

fn bind(window: &Window, action: Action, trigger: &str) {
    let trigger = trigger.parse().expect("a trigger");
    let bindings = &mut window.session().preferences.bindings;
    bindings.set(action, vec![trigger]).expect("it suits");
}

fn middle(window: &Window) -> Pos2 {
    window.session().viewport.expect("a picture").rect.center()
}

fn button(window: &mut Window, pos: Pos2, button: PointerButton, pressed: bool) {
    window.harness.event(egui::Event::PointerButton {
        pos,
        button,
        pressed,
        modifiers: Modifiers::NONE,
    });
    window.harness.step();
}

#[test]
fn keys_fly_in_a_scene_that_moves() {
    let mut window = open("orbits.toml");
    let before = window.camera().look_from;
    window.harness.key_down(Key::W);
    window.harness.run_steps(10);
    window.harness.key_up(Key::W);
    window.settle();
    assert_ne!(window.camera().look_from, before);
}

#[test]
fn what_a_hand_moves_is_in_the_same_frame_and_a_still_hand_costs_none() {
    let mut window = open("sphere.scene");
    let middle = middle(&window);
    window.harness.hover_at(middle);
    window.harness.step();
    button(&mut window, middle, PointerButton::Primary, true);
    // On a busy machine most frames are too short for a picture.
    let is_in_time = (1..=400).any(|number| {
        let before = window.shown().stats.samples;
        let to = middle + egui::vec2(10.0 + (number % 20) as f32, 0.0);
        window.harness.hover_at(to);
        window.harness.step();
        window.shown().stats.samples > before
    });
    assert!(is_in_time, "never in the same frame");
    assert!(window.shown().progress.is_coarse);
    for _ in 0..200 {
        window.harness.step();
    }
    assert_eq!(window.session().until_next_frame(), None);
    button(&mut window, middle, PointerButton::Primary, false);
    window.settle();
    assert!(!window.shown().progress.is_coarse);
    assert_eq!(window.session().until_next_frame(), None);
}

#[test]
fn a_key_can_do_what_needs_a_point_under_the_cursor() {
    let mut window = open("sphere.scene");
    bind(&window, Action::Select, "J");
    bind(&window, Action::SetPivot, "Shift+J");
    window.harness.key_press(Key::J);
    window.settle();
    assert_eq!(window.session().selection, None, "there is no cursor");
    let point = middle(&window);
    window.harness.hover_at(point);
    window.harness.step();
    window.harness.key_press(Key::J);
    window.settle();
    assert!(window.session().selection.is_some());
    let pivot = |window: &Window| window.session().controller.as_ref().expect("a rig").pivot();
    let before = pivot(&window);
    window.harness.key_press_modifiers(Modifiers::SHIFT, Key::J);
    window.settle();
    assert_ne!(pivot(&window), before);
}

#[test]
fn every_button_can_give_every_command() {
    let mut window = open("sphere.scene");
    let free = |action| {
        let bindings = &mut window.session().preferences.bindings;
        bindings.set(action, Vec::new()).expect("no trigger");
    };
    free(Action::PictureMenu);
    bind(&window, Action::MoreSamples, "Click right");
    bind(&window, Action::FewerSamples, "Click fourth");
    bind(&window, Action::Orbit, "Drag fifth");
    let point = middle(&window);
    for (which, samples) in [(PointerButton::Secondary, 4), (PointerButton::Extra1, 2)] {
        window.harness.hover_at(point);
        window.harness.step();
        button(&mut window, point, which, true);
        button(&mut window, point, which, false);
        window.settle();
        assert_eq!(window.session().view.settings.samples, samples, "{which:?}");
    }
    let before = window.camera().look_from;
    button(&mut window, point, PointerButton::Extra2, true);
    for step in [8.0, 16.0] {
        window.harness.hover_at(point + egui::vec2(step, 0.0));
        window.harness.step();
    }
    let end = point + egui::vec2(16.0, 0.0);
    button(&mut window, end, PointerButton::Extra2, false);
    window.settle();
    assert_ne!(window.camera().look_from, before);
}

#[test]
fn a_picture_that_is_not_to_be_seen_is_not_photographed() {
    let mut window = open("sphere.scene");
    window.harness.get_by_label("Window").click();
    window.harness.run_steps(3);
    let entry = (window.harness).get_by_role_and_label(Role::CheckBox, "Picture");
    entry.click();
    window.settle();
    assert_eq!(window.session().viewport, None);
    window.harness.key_press(Key::Escape);
    window.harness.run_steps(3);
    window
        .harness
        .key_press_modifiers(Modifiers::SHIFT, Key::F12);
    window.harness.run_steps(3);
    let session = window.session();
    assert!(session.files.saving.is_none());
    let told = "The picture is hidden. Show its panel first";
    assert!(session.messages.all().iter().any(|n| n.text == told));
}

#[test]
fn a_material_may_hang_over_an_object_that_an_undo_takes_away() {
    use crate::edit::{file, on_screen, open, perform, scene};
    let (_folder, path) = file();
    let mut window = open(&path, "400x300");
    window
        .session()
        .edit("empty", |scene| scene.shapes.truncate(1));
    perform(&mut window, Action::Undo);
    // The second ball comes back and is gone again below a material.
    let blue = on_screen(&window, glam::dvec3(1.0, 0.0, 0.0));
    let line = window.harness.get_by_role_and_label(Role::Button, "red");
    let from = line.rect().center();
    window.harness.hover_at(from);
    window.harness.step();
    button(&mut window, from, PointerButton::Primary, true);
    for share in [0.3, 0.7, 1.0, 1.0] {
        window.harness.hover_at(from + (blue - from) * share);
        window.harness.step();
    }
    window.settle();
    perform(&mut window, Action::Redo);
    assert_eq!(scene(&window).shapes.len(), 1);
    button(&mut window, blue, PointerButton::Primary, false);
    window.settle();
}
