//! Moving, rotating and scaling without a button, as in Blender.

use super::edit::{BLUE, RED, file, on_screen, open, scene};
use super::focus::click_at;
use crate::harness::Window;
use eframe::egui::{Key, Modifiers, PointerButton, vec2};
use glam::{DAffine3, DMat3, DVec3, dvec3};
use glimray_viewer::model::bindings::Preset;
use glimray_viewer::model::objects;
use glimray_viewer::model::objects::Id;
use glimray_viewer::model::tool::Tool;
use std::f64::consts::FRAC_PI_2;

/// Two balls, of which the red one is selected, and the pointer over the picture.
fn blender() -> (tempfile::TempDir, Window) {
    let (folder, path) = file();
    let mut window = open(&path, "400x300");
    {
        let mut session = window.session();
        session.preferences.bindings.set_preset(Preset::Blender);
        session.selection = Some(RED);
    }
    let at = on_screen(&window, dvec3(0.0, 0.5, 0.0));
    window.harness.hover_at(at);
    window.settle();
    (folder, window)
}

fn keys(window: &mut Window, keys: &[Key]) {
    for key in keys {
        window.harness.key_press(*key);
        window.harness.step();
    }
    window.harness.run_steps(2);
}

fn place(window: &Window, id: Id) -> DAffine3 {
    objects::place(&scene(window), id, 0.0).expect("a place")
}

#[track_caller]
fn assert_at(window: &Window, expected: DAffine3) {
    let place = place(window, RED);
    assert!(
        place.abs_diff_eq(expected, 1e-4),
        "{place} is not {expected}"
    );
}

/// Where the red ball is at first.
fn start() -> DAffine3 {
    DAffine3::from_mat3_translation(
        DMat3::from_diagonal(DVec3::splat(0.75)),
        dvec3(-1.0, 0.0, 0.0),
    )
}

fn is_over(window: &Window) -> bool {
    let session = window.session();
    session.editing.modal.is_none() && session.editing.grip.is_none()
}

#[test]
fn g_x_and_a_number_move_along_x_and_delete_nothing() {
    let (_folder, mut window) = blender();
    let before = scene(&window);
    keys(&mut window, &[Key::G, Key::X]);
    assert_eq!(scene(&window).shapes.len(), 2, "X deleted something");
    keys(
        &mut window,
        &[Key::Minus, Key::Num1, Key::Period, Key::Num5, Key::Enter],
    );
    window.settle();
    let expected = DAffine3::from_translation(dvec3(-1.5, 0.0, 0.0)) * start();
    assert_at(&window, expected);
    assert!(is_over(&window));
    let session = window.session();
    let document = session.document.as_ref().expect("a document");
    assert_eq!(document.undo_count(), 1);
    assert_eq!(document.undo_name(), Some("move sphere 1 (red)"));
    assert_eq!(session.selection, Some(RED));
    let scene = session.scene().expect("a scene");
    assert_eq!(scene.shapes[1], before.shapes[1]);
}

#[test]
fn the_pointer_leads_without_a_button_and_only_along_the_axis() {
    let (_folder, mut window) = blender();
    let at = on_screen(&window, dvec3(0.0, 0.5, 0.0));
    keys(&mut window, &[Key::G, Key::Y]);
    window.harness.hover_at(at + vec2(25.0, -40.0));
    window.harness.run_steps(2);
    // A pixel of the plane in which both balls lie, 8 before the camera.
    let pixel = 2.0 * 8.0 * 15_f64.to_radians().tan() / 300.0;
    let by = dvec3(25.0 * pixel, 40.0 * pixel, 0.0);
    // Rays beside an axis are nearest to it a little before or behind that plane.
    let along = |window: &Window, axis: usize| {
        let way = place(window, RED).translation - start().translation;
        let others = way - DVec3::AXES[axis] * way[axis];
        assert_eq!(others, DVec3::ZERO, "off the axis");
        assert!((way[axis] / by[axis] - 1.0).abs() < 0.05, "{way} for {by}");
    };
    along(&window, 1);
    // Another axis counts from where the pointer was at first.
    keys(&mut window, &[Key::X]);
    along(&window, 0);
    let both = DAffine3::from_translation(by) * start();
    // Repeating the axis: all ways.
    keys(&mut window, &[Key::X]);
    assert_at(&window, both);
    // Across an axis: in the plane of the others.
    window.harness.key_press_modifiers(Modifiers::SHIFT, Key::Z);
    window.harness.run_steps(2);
    assert_at(&window, both);
    click_at(&mut window, at + vec2(25.0, -40.0), PointerButton::Primary);
    window.settle();
    assert_at(&window, both);
    assert!(is_over(&window));
    assert_eq!(
        window.session().selection,
        Some(RED),
        "the click selected something"
    );
}

#[test]
fn escape_and_a_right_click_take_a_movement_back() {
    let (_folder, mut window) = blender();
    let before = scene(&window);
    let at = on_screen(&window, dvec3(0.0, 0.5, 0.0));
    for ends_by_key in [true, false] {
        keys(&mut window, &[Key::G]);
        window.harness.hover_at(at + vec2(60.0, 30.0));
        window.harness.run_steps(2);
        assert_ne!(scene(&window), before);
        match ends_by_key {
            true => keys(&mut window, &[Key::Escape]),
            false => click_at(&mut window, at + vec2(60.0, 30.0), PointerButton::Secondary),
        }
        window.settle();
        assert_eq!(scene(&window), before, "by a key: {ends_by_key}");
        assert!(is_over(&window));
        window.harness.hover_at(at);
        window.harness.step();
    }
    let session = window.session();
    assert_eq!(
        session.document.as_ref().expect("a document").undo_count(),
        0
    );
    assert_eq!(session.selection, Some(RED));
}

#[test]
fn r_and_s_turn_and_scale_by_numbers() {
    let (_folder, mut window) = blender();
    keys(&mut window, &[Key::S, Key::X, Key::Num2, Key::Enter]);
    window.settle();
    let stretched = start() * DAffine3::from_scale(dvec3(2.0, 1.0, 1.0));
    assert_at(&window, stretched);
    // 3, less one digit, is 9 and 0.
    keys(
        &mut window,
        &[
            Key::R,
            Key::Z,
            Key::Num3,
            Key::Backspace,
            Key::Num9,
            Key::Num0,
            Key::Enter,
        ],
    );
    window.settle();
    let mut turned = stretched;
    turned.matrix3 = DMat3::from_rotation_z(FRAC_PI_2) * turned.matrix3;
    assert_at(&window, turned);
    keys(&mut window, &[Key::S, Key::Period, Key::Num5, Key::Enter]);
    window.settle();
    assert_at(&window, turned * DAffine3::from_scale(DVec3::splat(0.5)));
}

#[test]
fn another_tool_begins_again_and_afterwards_x_deletes() {
    let (_folder, mut window) = blender();
    keys(
        &mut window,
        &[Key::G, Key::X, Key::Num3, Key::S, Key::Num2, Key::Enter],
    );
    window.settle();
    assert_at(&window, start() * DAffine3::from_scale(DVec3::splat(2.0)));
    assert_eq!(window.session().tool, Tool::Scale);
    window.session().selection = Some(BLUE);
    keys(&mut window, &[Key::X]);
    window.settle();
    assert_eq!(scene(&window).shapes.len(), 1);
}

#[test]
fn other_presets_take_the_tool_and_nothing_moves() {
    let (_folder, mut window) = blender();
    let before = scene(&window);
    window
        .session()
        .preferences
        .bindings
        .set_preset(Preset::Glimray);
    keys(&mut window, &[Key::G]);
    let at = on_screen(&window, dvec3(0.0, 0.0, 0.0));
    window.harness.hover_at(at + vec2(50.0, 50.0));
    window.settle();
    assert_eq!(window.session().tool, Tool::Move);
    assert_eq!(scene(&window), before);
    assert!(is_over(&window));
}
