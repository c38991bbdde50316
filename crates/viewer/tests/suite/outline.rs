//! The outline under the mouse: whole lines, groups, several lines at once, lines that are dragged.

use super::focus::click_at;
use crate::harness::Window;
use eframe::egui::{Modifiers, PointerButton, Pos2, Role, pos2};
use egui_kittest::kittest::Queryable;
use glam::{DVec3, dvec3};
use glimray::scene::{ObjectRef, Scene};
use glimray_viewer::model::bindings::Action;
use glimray_viewer::model::objects::{self, Id};
use std::path::PathBuf;
use tempfile::TempDir;

/// Three balls, two of them on a node that is moved and turned.
const BALLS: &str = r#"
ambient = [0.2, 0.2, 0.2]

[camera]
look_from = [0, 0, 8]
look_at = [0, 0, 0]

[materials]
red = { phong = { diffuse = [0.75, 0.125, 0.0625] } }

[[nodes]]
name = "arm"
transform = { translate = [0, 2, 0], rotate_deg = [0, 0, 90] }

[[objects]]
sphere = { center = [1, 0, 0], radius = 0.5 }
material = "red"
carried_by = "arm"

[[objects]]
sphere = { center = [2, 0, 0], radius = 0.5 }
material = "red"
carried_by = "arm"

[[objects]]
sphere = { center = [3, 0, 0], radius = 0.5 }
material = "red"
"#;

const NAMES: [&str; 3] = ["sphere 1 (red)", "sphere 2 (red)", "sphere 3 (red)"];

fn ball(index: usize) -> Id {
    Id::Object(ObjectRef::Shape(index))
}

fn open() -> (TempDir, Window) {
    let folder = tempfile::tempdir().expect("a folder");
    let path: PathBuf = folder.path().join("balls.toml");
    std::fs::write(&path, BALLS).expect("a file");
    let path = path.to_str().expect("a path in UTF-8");
    let mut window = Window::open(&[path, "--size", "64x48", "--samples", "1"]);
    window.settle();
    (folder, window)
}

fn scene(window: &Window) -> Scene {
    Scene::clone(window.session().scene().expect("a scene"))
}

fn perform(window: &mut Window, action: Action) {
    window.session().clicked.push(action);
    window.settle();
}

/// A line of the outline, and not the title of the properties of the same name.
fn line<'a>(window: &'a Window, label: &'a str) -> egui_kittest::Node<'a> {
    window.harness.get_by_role_and_label(Role::Button, label)
}

fn center(window: &Window, label: &str) -> Pos2 {
    line(window, label).rect().center()
}

fn click_with(window: &mut Window, label: &str, modifiers: Modifiers) {
    line(window, label).click_modifiers(modifiers);
    window.settle();
}

fn drag(window: &mut Window, from: &str, to: &str) {
    let (from, to) = (center(window, from), center(window, to));
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

fn place(scene: &Scene, index: usize) -> DVec3 {
    let place = objects::place(scene, ball(index), 0.0);
    place.expect("a ball").translation
}

#[test]
fn a_click_anywhere_on_a_line_selects() {
    let (_folder, mut window) = open();
    let rect = line(&window, NAMES[2]).rect();
    let label = center(&window, NAMES[2]);
    // The panel is 260 points wide; left of the icon and right of the text nothing is drawn.
    for x in [rect.min.x + 2.0, rect.max.x - 40.0] {
        window.session().selection = None;
        click_at(&mut window, pos2(x, label.y), PointerButton::Primary);
        assert_eq!(window.session().selection, Some(ball(2)), "at {x}");
    }
}

#[test]
fn groups_fold_and_unfold_and_what_is_selected_elsewhere_is_revealed() {
    let (_folder, mut window) = open();
    let has =
        |window: &Window, label: &str| window.harness.query_all_by_label(label).next().is_some();
    window.harness.get_by_label("Fold arm").click();
    window.settle();
    assert!(!has(&window, NAMES[0]) && !has(&window, NAMES[1]));
    assert!(has(&window, NAMES[2]));
    // A search finds what is folded away.
    window.session().editing.listing.query = "sphere 1".into();
    window.settle();
    assert!(has(&window, NAMES[0]));
    window.session().editing.listing.query.clear();
    window.settle();
    assert!(!has(&window, NAMES[0]));
    window.session().selection = Some(ball(1));
    window.settle();
    assert!(has(&window, NAMES[1]) && has(&window, "Fold arm"));
    window.harness.get_by_label("Fold Objects").click();
    window.settle();
    assert!(!has(&window, "arm") && !has(&window, NAMES[2]));
    window.harness.get_by_label("Unfold Objects").click();
    window.settle();
    assert!(has(&window, "arm") && has(&window, NAMES[2]));
}

#[test]
fn several_lines_are_deleted_hidden_and_duplicated_in_one_step() {
    let (_folder, mut window) = open();
    let before = scene(&window);
    click_with(&mut window, NAMES[0], Modifiers::NONE);
    click_with(&mut window, NAMES[2], Modifiers::COMMAND);
    assert_eq!(window.session().selected(), [ball(2), ball(0)]);
    perform(&mut window, Action::ToggleVisible);
    let hidden = scene(&window);
    let visible: Vec<bool> = (0..3)
        .map(|index| objects::is_visible(&hidden, ball(index)))
        .collect();
    assert_eq!(visible, [false, true, false]);
    perform(&mut window, Action::ToggleVisible);
    assert_eq!(scene(&window), before);
    perform(&mut window, Action::Duplicate);
    let copies = scene(&window);
    assert_eq!(copies.shapes.len(), 5);
    assert_eq!(
        copies.shapes[3..],
        [before.shapes[2].clone(), before.shapes[0].clone()]
    );
    assert_eq!(window.session().selected(), [ball(3), ball(4)]);
    perform(&mut window, Action::Undo);
    assert_eq!(scene(&window), before);
    click_with(&mut window, NAMES[0], Modifiers::NONE);
    click_with(&mut window, NAMES[1], Modifiers::SHIFT);
    assert_eq!(window.session().selected(), [ball(1), ball(0)]);
    perform(&mut window, Action::Delete);
    // The number stays.
    let mut third = before.shapes[2].clone();
    third.name = "sphere 3".to_owned();
    assert_eq!(scene(&window).shapes, [third]);
    assert_eq!(window.session().selected(), []);
    perform(&mut window, Action::Undo);
    assert_eq!(scene(&window), before);
}

#[test]
fn a_line_that_is_added_twice_is_taken_out_again_and_a_plain_click_ends_the_group() {
    let (_folder, mut window) = open();
    click_with(&mut window, NAMES[0], Modifiers::NONE);
    click_with(&mut window, NAMES[1], Modifiers::COMMAND);
    click_with(&mut window, NAMES[1], Modifiers::COMMAND);
    assert_eq!(window.session().selected(), [ball(0)]);
    click_with(&mut window, NAMES[2], Modifiers::SHIFT);
    assert_eq!(window.session().selected().len(), 3);
    click_with(&mut window, NAMES[1], Modifiers::NONE);
    assert_eq!(window.session().selected(), [ball(1)]);
}

#[test]
fn a_line_dropped_on_a_node_or_on_the_heading_changes_its_parent_and_keeps_its_place() {
    let (_folder, mut window) = open();
    let before = scene(&window);
    // A quarter turn about z takes (1, 0, 0) to (0, 1, 0).
    assert!(place(&before, 0).distance(dvec3(0.0, 3.0, 0.0)) < 1e-9);
    drag(&mut window, NAMES[2], "arm");
    let moved = scene(&window);
    assert_eq!(moved.shapes[2].node, Some(0));
    assert!(place(&moved, 2).distance(dvec3(3.0, 0.0, 0.0)) < 1e-9);
    drag(&mut window, NAMES[0], "Objects");
    let moved = scene(&window);
    assert_eq!(moved.shapes[0].node, None);
    assert!(place(&moved, 0).distance(dvec3(0.0, 3.0, 0.0)) < 1e-9);
    // On another object it goes where that is.
    let [from, to] = [0, 1].map(|index| window.session().label(ball(index)));
    drag(&mut window, &from, &to);
    assert_eq!(scene(&window).shapes[0].node, Some(0));
    for _ in 0..3 {
        perform(&mut window, Action::Undo);
    }
    assert_eq!(scene(&window), before);
}

#[test]
fn the_menu_of_a_line_renames_it() {
    let (_folder, mut window) = open();
    for (label, name) in [("arm", "arm"), (NAMES[0], "sphere 1")] {
        let at = center(&window, label);
        click_at(&mut window, at, PointerButton::Secondary);
        window.harness.get_by_label("Rename").click();
        window.settle();
        let renaming = window.session().editing.renaming.take();
        assert_eq!(renaming.map(|(_, name)| name).as_deref(), Some(name));
        window.settle();
    }
}
