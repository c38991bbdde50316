//! Moves, rotations and scales in whole steps.

use super::edit::{RED, file, on_screen, open, scene};
use crate::harness::Window;
use eframe::egui::{Event, Key, Modifiers, Vec2, vec2};
use glam::{DVec3, dvec3};
use glimray_viewer::model::bindings::Preset;
use glimray_viewer::model::objects;

/// Two balls, the red one selected, with the keys of Blender and the pointer beside it.
fn blender() -> (tempfile::TempDir, Window) {
    let (folder, path) = file();
    let mut window = open(&path, "400x300");
    {
        let mut session = window.session();
        session.preferences.bindings.set_preset(Preset::Blender);
        session.selection = Some(RED);
    }
    hover(&mut window, Vec2::ZERO);
    window.settle();
    (folder, window)
}

fn hover(window: &mut Window, off: Vec2) {
    let at = on_screen(window, dvec3(0.0, 0.5, 0.0));
    window.harness.hover_at(at + off);
    window.harness.run_steps(2);
}

fn press(window: &mut Window, key: Key) {
    window.harness.key_press(key);
    window.harness.run_steps(2);
}

fn hold(window: &mut Window, modifiers: Modifiers) {
    window.harness.event(Event::ModifiersChanged(modifiers));
    window.harness.run_steps(2);
}

fn place(window: &Window) -> glam::DAffine3 {
    objects::place(&scene(window), RED, 0.0).expect("a place")
}

/// Whether a number is a whole number of steps, and not 0.
fn is_whole(value: f64, step: f64) -> bool {
    let count = (value / step).round();
    count != 0.0 && (value / step - count).abs() < 1e-6
}

#[test]
fn ctrl_moves_in_steps_of_the_grid_and_the_switch_makes_that_usual() {
    let (_folder, mut window) = blender();
    press(&mut window, Key::G);
    press(&mut window, Key::X);
    // A pixel is 0.0143 wide there, so a line of the grid comes after 14 of them: after 1.
    let by = |window: &Window| place(window).translation.x + 1.0;
    hover(&mut window, vec2(60.0, 0.0));
    assert!(!is_whole(by(&window), 1.0) && (by(&window) - 0.86).abs() < 0.05);
    hold(&mut window, Modifiers::CTRL);
    assert!((by(&window) - 1.0).abs() < 1e-9, "{}", by(&window));
    hold(&mut window, Modifiers::NONE);
    assert!(!is_whole(by(&window), 1.0));
    press(&mut window, Key::Escape);
    window.settle();
    (window.harness).key_press_modifiers(Modifiers::ALT, Key::S);
    window.settle();
    assert!(window.session().preferences.snaps);
    hover(&mut window, Vec2::ZERO);
    press(&mut window, Key::G);
    press(&mut window, Key::X);
    hover(&mut window, vec2(60.0, 0.0));
    assert!((by(&window) - 1.0).abs() < 1e-9, "{}", by(&window));
    // Now Ctrl is for free moves.
    hold(&mut window, Modifiers::CTRL);
    assert!(!is_whole(by(&window), 1.0));
    hold(&mut window, Modifiers::NONE);
    // With Shift the pointer is slow, and steps are a tenth.
    hold(&mut window, Modifiers::SHIFT);
    hover(&mut window, vec2(250.0, 0.0));
    assert!(
        is_whole(by(&window), 0.1) && !is_whole(by(&window), 1.0),
        "{}",
        by(&window)
    );
    hold(&mut window, Modifiers::NONE);
    press(&mut window, Key::Escape);
    window.settle();
    assert_eq!(place(&window).translation.x, -1.0);
}

#[test]
fn rotations_have_steps_of_15_degrees_or_5_and_scales_of_a_tenth() {
    let (_folder, mut window) = blender();
    (window.harness).key_press_modifiers(Modifiers::ALT, Key::S);
    window.settle();
    press(&mut window, Key::R);
    press(&mut window, Key::Z);
    hover(&mut window, vec2(20.0, 90.0));
    let angle = |window: &Window| {
        let x = place(window).matrix3.x_axis;
        x.y.atan2(x.x).to_degrees()
    };
    assert!(is_whole(angle(&window), 15.0), "{}°", angle(&window));
    hold(&mut window, Modifiers::SHIFT);
    for step in 1..30 {
        hover(&mut window, vec2(20.0, 90.0 + 10.0 * step as f32));
        assert!(is_whole(angle(&window), 5.0), "{}°", angle(&window));
        if !is_whole(angle(&window), 15.0) {
            break;
        }
    }
    assert!(!is_whole(angle(&window), 15.0), "no fine step");
    hold(&mut window, Modifiers::NONE);
    press(&mut window, Key::Escape);
    window.settle();
    hover(&mut window, Vec2::ZERO);
    press(&mut window, Key::S);
    hover(&mut window, vec2(37.0, 0.0));
    let size = place(&window).matrix3.x_axis.length() / 0.75;
    assert!(is_whole(size - 1.0, 0.1), "{size}");
    assert!((place(&window).translation - DVec3::NEG_X).length() < 1e-9);
}
