//! The camera's lens in a photographer's units, and its focus by a click.

use super::edit;
use crate::harness::Window;
use eframe::egui;
use eframe::egui::{Modifiers, PointerButton};
use egui_kittest::kittest::{NodeT, Queryable};
use glimray_viewer::model::objects::Id;

fn number(window: &mut Window, label: &str) -> f64 {
    let row = window.harness.get_by_label(label);
    row.accesskit_node().numeric_value().expect("a number")
}

fn enter(window: &mut Window, label: &str, value: f64) {
    let row = window.harness.get_by_label(label);
    row.set_value_accesskit(value);
    window.settle();
}

fn camera(window: &Window) -> glimray::scene::Camera {
    let session = window.session();
    session.scene().expect("a scene").cameras[0].clone()
}

#[test]
fn focal_length_and_f_stop_are_the_angle_of_view_and_the_radius() {
    let (_folder, path) = edit::file();
    let mut window = edit::open(&path, "64x48");
    window.session().selection = Some(Id::Camera(0));
    window.settle();
    // A picture 24 mm high is seen by 30° from 44.8 mm.
    let expected = 12.0 / 15_f64.to_radians().tan();
    assert!((number(&mut window, "Focal length") - expected).abs() < 0.01);
    enter(&mut window, "Focal length", 12.0);
    assert!((camera(&window).fov_y.to_degrees() - 90.0).abs() < 1e-6);
    enter(&mut window, "Field of view", 30.0);
    assert!((number(&mut window, "Focal length") - expected).abs() < 0.01);

    window.harness.get_by_label("Thin lens").click_accesskit();
    window.settle();
    enter(&mut window, "Focal length", 48.0);
    enter(&mut window, "F-stop", 2.0);
    // The aperture is 24 mm wide.
    let radius = camera(&window).lens.expect("a lens").radius;
    assert!((radius - 0.012).abs() < 1e-9, "{radius}");
    enter(&mut window, "Radius", 0.006);
    assert!((number(&mut window, "F-stop") - 4.0).abs() < 1e-6);
}

#[test]
fn a_click_sets_the_focus_of_the_camera() {
    let (_folder, path) = edit::file();
    let mut window = edit::open(&path, "65x49");
    window.session().selection = Some(Id::Camera(0));
    window.settle();
    window.harness.get_by_label("Thin lens").click_accesskit();
    window.settle();
    assert_eq!(camera(&window).lens.expect("a lens").focus_distance, 8.0);
    window
        .harness
        .get_by_label("Focus by click")
        .click_accesskit();
    window.settle();
    // The red ball is 0.75 nearer than the point that the camera looks at.
    let viewport = window.session().viewport.expect("a picture");
    let at = viewport.point(glam::dvec2(21.5, 24.5));
    window.harness.hover_at(at);
    window.harness.step();
    for pressed in [true, false] {
        window.harness.event(egui::Event::PointerButton {
            pos: at,
            button: PointerButton::Primary,
            pressed,
            modifiers: Modifiers::NONE,
        });
        window.harness.step();
    }
    window.settle();
    let focus = camera(&window).lens.expect("a lens").focus_distance;
    assert!((7.2..7.4).contains(&focus), "{focus}");
    assert_eq!(window.session().selection, Some(Id::Camera(0)));
    edit::perform(&mut window, glimray_viewer::model::bindings::Action::Undo);
    assert_eq!(camera(&window).lens.expect("a lens").focus_distance, 8.0);
}
