//! Materials that are dragged onto objects, from the outline and from the preview.

use crate::edit::{BLUE, RED, file, on_screen, open, perform, scene};
use crate::harness::Window;
use eframe::egui::{Key, Pos2, Role};
use egui_kittest::kittest::{Queryable, by};
use glam::dvec3;
use glimray::scene::Scene;
use glimray_viewer::model::bindings::Action;
use glimray_viewer::model::material_presets::MaterialPreset;
use tempfile::TempDir;

/// The balls of the tests of editing.
fn balls() -> (TempDir, Window) {
    let (folder, path) = file();
    let window = open(&path, "400x300");
    (folder, window)
}

fn line(window: &Window, label: &str) -> Pos2 {
    let line = window.harness.get_by_role_and_label(Role::Button, label);
    line.rect().center()
}

/// Presses at a place and moves to another one, without letting go.
fn carry(window: &mut Window, from: Pos2, to: Pos2) {
    window.harness.hover_at(from);
    window.harness.step();
    window.harness.drag_at(from);
    window.harness.step();
    for share in [0.3, 0.7, 1.0, 1.0] {
        window.harness.hover_at(from + (to - from) * share);
        window.harness.step();
    }
    window.settle();
}

fn let_go(window: &mut Window, at: Pos2) {
    window.harness.drop_at(at);
    window.settle();
}

fn materials(scene: &Scene) -> Vec<&str> {
    let shapes = scene.shapes.iter();
    shapes
        .map(|shape| scene.materials[shape.material].name.as_str())
        .collect()
}

/// Whether a label in the window begins so.
fn is_told(window: &Window, start: &str) -> bool {
    let begins = |node: &egui_kittest::kittest::AccessKitNode<'_>| {
        let text = node.value().or(node.label());
        text.is_some_and(|text| text.starts_with(start))
    };
    let mut found = window.harness.query_all(by().predicate(begins));
    found.next().is_some()
}

#[test]
fn a_material_is_dropped_on_a_line_of_the_outline() {
    let (_folder, mut window) = balls();
    let before = scene(&window);
    let (from, to) = (line(&window, "blue"), line(&window, "sphere 1 (red)"));
    carry(&mut window, from, to);
    assert!(is_told(&window, "Give blue to sphere 1 (red)"));
    let_go(&mut window, to);
    assert_eq!(materials(&scene(&window)), ["blue", "blue"]);
    let document = window.session().document.clone().expect("a document");
    assert_eq!(document.undo_count(), 1);
    assert_eq!(document.undo_name(), Some("give blue to sphere 1 (red)"));
    assert!(!is_told(&window, "Give blue"));
    perform(&mut window, Action::Undo);
    assert!(scene(&window) == before);
}

#[test]
fn a_material_is_dropped_on_the_object_under_the_cursor() {
    let (_folder, mut window) = balls();
    let from = line(&window, "red");
    let nothing = on_screen(&window, dvec3(0.0, 1.5, 0.0));
    carry(&mut window, from, nothing);
    assert!(is_told(&window, "Drop red on an object"));
    let to = on_screen(&window, dvec3(1.0, 0.2, 0.0));
    window.harness.hover_at(to);
    window.settle();
    assert!(is_told(&window, "Give red to sphere 2 (blue)"));
    let_go(&mut window, to);
    assert_eq!(materials(&scene(&window)), ["red", "red"]);
    assert_eq!(window.session().selection, None, "the drop selects nothing");
}

#[test]
fn escape_and_a_drop_on_nothing_change_nothing() {
    let (_folder, mut window) = balls();
    let before = scene(&window);
    let (from, to) = (
        line(&window, "red"),
        on_screen(&window, dvec3(1.0, 0.0, 0.0)),
    );
    carry(&mut window, from, to);
    window.harness.key_press(Key::Escape);
    window.harness.run_steps(3);
    assert!(!is_told(&window, "Give red"));
    let_go(&mut window, to);
    assert!(scene(&window) == before);
    let nothing = on_screen(&window, dvec3(0.0, 1.5, 0.0));
    carry(&mut window, from, nothing);
    let_go(&mut window, nothing);
    assert!(scene(&window) == before);
    let told = window.session().messages.current();
    assert!(
        told.iter()
            .any(|it| it.text == "Nothing is under the cursor")
    );
}

#[test]
fn all_selected_objects_get_what_is_dropped_on_one() {
    let (_folder, mut window) = balls();
    // A third material, which neither of them has.
    glimray_viewer::actions::materials::add(&mut window.session(), MaterialPreset::Clay);
    window.session().select(vec![RED, BLUE]);
    window.settle();
    let (from, to) = (
        line(&window, "Clay"),
        on_screen(&window, dvec3(1.0, 0.0, 0.0)),
    );
    carry(&mut window, from, to);
    let_go(&mut window, to);
    assert_eq!(materials(&scene(&window)), ["Clay", "Clay"]);
}

#[test]
fn the_preview_can_be_dragged_too() {
    let (_folder, mut window) = balls();
    window.session().select(vec![RED]);
    window.settle();
    let preview = window.harness.get_by_label("Preview of red");
    let (from, to) = (
        preview.rect().center(),
        on_screen(&window, dvec3(1.0, 0.0, 0.0)),
    );
    carry(&mut window, from, to);
    let_go(&mut window, to);
    assert_eq!(materials(&scene(&window)), ["red", "red"]);
}
