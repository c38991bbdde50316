//! A rectangle that selects what is in it: real drags.

use super::edit::{BLUE, RED, file, on_screen, open};
use crate::harness::Window;
use eframe::egui::{Event, Key, Modifiers, PointerButton, Pos2, vec2};
use glam::{DVec3, dvec3};
use glimray_viewer::model::bindings::Preset;
use glimray_viewer::model::tool::Tool;

/// Drags from one point of the screen to another while these keys are held.
fn drag(window: &mut Window, [from, to]: [Pos2; 2], held: Modifiers) {
    window.harness.event(Event::ModifiersChanged(held));
    super::edit::drag(window, from, to);
    (window.harness).event(Event::ModifiersChanged(Modifiers::NONE));
    window.settle();
}

/// A rectangle on the screen around the middle of a ball, smaller than that.
fn around(window: &Window, center: DVec3) -> [Pos2; 2] {
    let at = on_screen(window, center);
    [at - vec2(6.0, 5.0), at + vec2(7.0, 4.0)]
}

const LEFT: DVec3 = dvec3(-1.0, 0.0, 0.0);
const RIGHT: DVec3 = dvec3(1.0, 0.0, 0.0);

#[test]
fn a_rectangle_selects_shift_adds_and_ctrl_removes() {
    let (_folder, path) = file();
    let mut window = open(&path, "400x300");
    (window.harness).key_press_modifiers(Modifiers::ALT, Key::B);
    window.settle();
    assert_eq!(window.session().tool, Tool::Box);
    let camera = window.camera();
    let [left, right] = [LEFT, RIGHT].map(|center| around(&window, center));
    drag(&mut window, left, Modifiers::NONE);
    assert_eq!(window.session().selected(), [RED]);
    drag(&mut window, right, Modifiers::SHIFT);
    assert_eq!(window.session().selected(), [RED, BLUE]);
    drag(&mut window, left, Modifiers::COMMAND);
    assert_eq!(window.session().selected(), [BLUE]);
    let both = [left[0], right[1]];
    // From the lower right to the upper left as well.
    drag(&mut window, [both[1], both[0]], Modifiers::NONE);
    assert_eq!(window.session().selected(), [RED, BLUE]);
    let document_steps = |window: &Window| {
        let session = window.session();
        session
            .document
            .as_ref()
            .map(|document| document.undo_count())
    };
    assert_eq!(document_steps(&window), Some(0));
    let nowhere = around(&window, dvec3(0.0, 1.5, 0.0));
    drag(&mut window, nowhere, Modifiers::NONE);
    assert!(window.session().selected().is_empty());
    assert_eq!(window.camera(), camera, "the drag moved the camera");
}

#[test]
fn escape_ends_the_rectangle_and_the_selection_stays() {
    let (_folder, path) = file();
    let mut window = open(&path, "400x300");
    window.session().tool = Tool::Box;
    window.session().select(vec![BLUE]);
    window.settle();
    let [from, to] = around(&window, LEFT);
    window.harness.hover_at(from);
    window.harness.step();
    window.harness.drag_at(from);
    window.harness.step();
    window.harness.hover_at(to);
    window.harness.step();
    assert!(window.session().tool_state.frame.is_some());
    window.harness.key_press(Key::Escape);
    window.harness.step();
    assert!(window.session().tool_state.frame.is_none());
    window.harness.drop_at(to);
    window.settle();
    assert_eq!(window.session().selected(), [BLUE]);
    assert_eq!(window.session().tool, Tool::Box);
}

#[test]
fn with_the_keys_of_blender_a_drag_in_the_empty_picture_selects() {
    let (_folder, path) = file();
    let mut window = open(&path, "400x300");
    (window.session().preferences.bindings).set_preset(Preset::Blender);
    let left = around(&window, LEFT);
    drag(&mut window, left, Modifiers::NONE);
    assert_eq!(window.session().selected(), [RED]);
    window.harness.key_press(Key::B);
    window.settle();
    assert_eq!(window.session().tool, Tool::Box);
    assert_eq!(window.session().view.region, None);
}

#[test]
fn a_lamp_without_a_surface_is_in_the_rectangle_where_it_stands() {
    let (_folder, path) = file();
    let text = std::fs::read_to_string(&path).expect("a scene");
    let lamp = text.replace("position = [3, 4, 5]", "position = [0, 1, 0]");
    std::fs::write(&path, lamp).expect("a file");
    let mut window = open(&path, "400x300");
    window.session().tool = Tool::Box;
    let ends = around(&window, dvec3(0.0, 1.0, 0.0));
    drag(&mut window, ends, Modifiers::NONE);
    let light = glimray::scene::ObjectRef::Light(0);
    let expected = glimray_viewer::model::objects::Id::Object(light);
    assert_eq!(window.session().selected(), [expected]);
}

#[test]
fn a_rectangle_that_waits_is_dropped_when_the_view_changes() {
    let (_folder, path) = file();
    let mut window = open(&path, "400x300");
    window.session().tool = Tool::Box;
    window.session().select(vec![BLUE]);
    window.settle();
    let [from, to] = around(&window, LEFT);
    window.harness.hover_at(from);
    window.harness.step();
    window.harness.drag_at(from);
    window.harness.step();
    window.harness.hover_at(to);
    window.harness.step();
    // No answer can have come when the button is released.
    window.session().sight.latest = None;
    window.harness.event(Event::PointerButton {
        pos: to,
        button: PointerButton::Primary,
        pressed: false,
        modifiers: Modifiers::NONE,
    });
    window.harness.step();
    assert!(window.session().sight.boxed.is_some());
    let mut controller = window.session().controller.clone().expect("a camera");
    controller.orbit(glam::dvec2(40.0, 0.0), glam::dvec2(400.0, 300.0));
    window.session().controller = Some(controller);
    window.settle();
    assert!(window.session().sight.boxed.is_none());
    assert_eq!(window.session().selected(), [BLUE]);
    // Without a change it selects as soon as the answer comes.
    let [from, to] = around(&window, LEFT);
    drag(&mut window, [from, to], Modifiers::NONE);
    assert_eq!(window.session().selected(), [RED]);
}

#[test]
fn an_area_light_that_is_not_visible_is_selected_where_it_stands() {
    let (_folder, path) = file();
    let text = std::fs::read_to_string(&path).expect("a scene");
    let point = "point = { position = [3, 4, 5], color = [0.9, 0.9, 0.9] }";
    let hidden =
        "sphere = { center = [0, 1, 0], radius = 0.2, color = [1, 1, 1], visible = false }";
    std::fs::write(&path, text.replace(point, hidden)).expect("a file");
    let mut window = open(&path, "400x300");
    window.session().tool = Tool::Box;
    let ends = around(&window, dvec3(0.0, 1.0, 0.0));
    drag(&mut window, ends, Modifiers::NONE);
    let light = glimray::scene::ObjectRef::Light(0);
    let expected = glimray_viewer::model::objects::Id::Object(light);
    assert_eq!(window.session().selected(), [expected]);
}
