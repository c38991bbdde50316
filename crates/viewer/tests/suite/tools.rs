//! Tools that measure.

use super::edit::{file, on_screen, open};
use super::focus::click_at;
use eframe::egui::{Event, Key, Modifiers, OutputCommand, PointerButton, vec2};
use glam::{DVec3, dvec3};
use glimray::scene::Section;
use glimray_viewer::model::tool::Tool;

/// The point of a ball of radius 0.75 that a camera at (0, 0, 8) sees at its centre.
fn front(center: DVec3) -> DVec3 {
    let camera = dvec3(0.0, 0.0, 8.0);
    center + (camera - center).normalize() * 0.75
}

#[test]
fn two_clicks_measure_the_distance_between_two_points() {
    let (_folder, path) = file();
    let mut window = open(&path, "400x300");
    (window.harness).key_press_modifiers(Modifiers::ALT, Key::M);
    window.settle();
    assert_eq!(window.session().tool, Tool::Measure);
    let centers = [dvec3(-1.0, 0.0, 0.0), dvec3(1.0, 0.0, 0.0)];
    let ends = centers.map(front);
    for center in centers {
        let at = on_screen(&window, center);
        click_at(&mut window, at, PointerButton::Primary);
        window.settle();
    }
    // A pixel is 0.015 wide there.
    let points = window.session().tool_state.measured.clone();
    assert_eq!(points.len(), 2, "{points:?}");
    for (point, end) in points.iter().zip(ends) {
        assert!(point.distance(end) < 0.03, "{point} is not {end}");
    }
    let messages = window.session().messages.current();
    let text = messages.last().expect("a message").text.clone();
    let distance: f64 = text
        .strip_prefix("Distance: ")
        .and_then(|number| number.parse().ok())
        .unwrap_or_else(|| panic!("{text}"));
    assert!(
        (distance - ends[0].distance(ends[1])).abs() < 0.05,
        "{text}"
    );
    assert_eq!(window.session().selection, None, "the click selected");

    // Between the balls, the line is drawn over the background.
    let at = on_screen(&window, (ends[0] * 0.6 + ends[1] * 0.4).with_y(0.0));
    let picture = window.harness.render().expect("a picture of the window");
    let near = (-2..=2).map(|dy| picture.get_pixel(at.x as u32, (at.y as i32 + dy) as u32).0);
    let is_yellow = |[red, green, blue, _]: [u8; 4]| red > 200 && green > 160 && blue < 120;
    assert!(
        near.clone().any(is_yellow),
        "{:?}",
        near.collect::<Vec<_>>()
    );

    // The third click starts another measurement.
    let at = on_screen(&window, centers[0]);
    click_at(&mut window, at, PointerButton::Primary);
    window.settle();
    assert_eq!(window.session().tool_state.measured.len(), 1);
}

#[test]
fn a_click_on_the_background_measures_nothing() {
    let (_folder, path) = file();
    let mut window = open(&path, "400x300");
    window.session().tool = Tool::Measure;
    let at = on_screen(&window, dvec3(0.0, 1.5, 0.0));
    click_at(&mut window, at, PointerButton::Primary);
    window.settle();
    assert!(window.session().tool_state.measured.is_empty());
    let messages = window.session().messages.current();
    let text = messages.last().expect("a message").text.clone();
    assert_eq!(text, "Nothing is under the cursor");
}

#[test]
fn ends_snap_to_vertices_and_measurements_are_kept_copied_and_removed() {
    let (_folder, path) = file();
    let text = std::fs::read_to_string(&path).expect("a scene");
    let ball = "sphere = { center = [1, 0, 0], radius = 0.75 }";
    let cube = "box = { min = [0.5, -0.5, -0.5], max = [1.5, 0.5, 0.5] }";
    std::fs::write(&path, text.replace(ball, cube)).expect("a file");
    let mut window = open(&path, "400x300");
    (window.harness).key_press_modifiers(Modifiers::ALT, Key::M);
    window.settle();
    // The upper corners of the front face, each five points beside the click; one is beyond the cube.
    let corners = [dvec3(0.5, 0.5, 0.5), dvec3(1.5, 0.5, 0.5)];
    for (corner, off) in corners.into_iter().zip([vec2(4.0, 3.0), vec2(3.0, -4.0)]) {
        let at = on_screen(&window, corner) + off;
        click_at(&mut window, at, PointerButton::Primary);
        window.settle();
    }
    let first = window.session().tool_state.measured.clone();
    assert_eq!(first.len(), 2, "{first:?}");
    for (point, corner) in first.iter().zip(corners) {
        assert!(point.distance(corner) < 1e-6, "{point} is not {corner}");
    }
    // Farther than eight points from a corner, and before one that is hidden: the surface.
    let middle = on_screen(&window, dvec3(1.0, 0.0, 0.5));
    let hidden = on_screen(&window, dvec3(1.5, -0.5, -0.5));
    for at in [middle, hidden] {
        click_at(&mut window, at, PointerButton::Primary);
        window.settle();
    }
    let second = window.session().tool_state.measured.clone();
    assert!((second[0].z - 0.5).abs() < 1e-4, "{second:?}");
    assert!(second[1].z > 0.4, "{second:?}");
    assert_eq!(window.session().tool_state.measurements().len(), 2);

    window.harness.event(Event::Key {
        key: Key::M,
        physical_key: None,
        pressed: true,
        repeat: false,
        modifiers: Modifiers::SHIFT | Modifiers::ALT,
    });
    window.harness.step();
    let commands = window.harness.output().platform_output.commands.clone();
    let text = commands.into_iter().find_map(|command| match command {
        OutputCommand::CopyText(text) => Some(text),
        _ => None,
    });
    let text = text.expect("a text");
    let numbers: Vec<f64> = (text.lines().nth(1).expect("a line").split('\t'))
        .map(|number| number.parse().expect("a number"))
        .collect();
    let expected = [0.5, 0.5, 0.5, 1.5, 0.5, 0.5, 1.0, 1.0, 0.0, 0.0];
    assert_eq!(numbers.len(), expected.len(), "{text}");
    for (number, expected) in numbers.iter().zip(expected) {
        assert!((number - expected).abs() < 1e-5, "{text}");
    }
    assert_eq!(text.lines().count(), 3, "{text}");

    let objects = window.session().scene().expect("a scene").shapes.len();
    for left in [1, 0] {
        window.harness.key_press(Key::Delete);
        window.settle();
        assert_eq!(window.session().tool_state.measurements().len(), left);
    }
    assert_eq!(
        window.session().scene().expect("a scene").shapes.len(),
        objects
    );
}

#[test]
fn ends_do_not_snap_to_vertices_that_the_section_plane_cuts_away() {
    let (_folder, path) = file();
    let text = std::fs::read_to_string(&path).expect("a scene");
    let ball = "sphere = { center = [1, 0, 0], radius = 0.75 }";
    let cube = "box = { min = [0.5, -0.5, -0.5], max = [1.5, 0.5, 0.5] }";
    std::fs::write(&path, text.replace(ball, cube)).expect("a file");
    let mut window = open(&path, "400x300");
    window.session().tool = Tool::Measure;
    // Through the middle of the cube, and through its front face, where the corner stays.
    for (offset, expected) in [(0.0, 0.0), (0.5, 0.5)] {
        window.session().edit("cut", |scene| {
            scene.section = Some(Section {
                normal: DVec3::Z,
                offset,
            });
        });
        window.settle();
        let corner = dvec3(0.5, 0.5, 0.5);
        let at = on_screen(&window, corner) + vec2(4.0, 4.0);
        click_at(&mut window, at, PointerButton::Primary);
        window.settle();
        let point = *(window.session().tool_state.measured.last()).expect("a point");
        assert!((point.z - expected).abs() < 1e-3, "{point} at {offset}");
        let is_corner = point.distance(corner) < 1e-6;
        assert_eq!(is_corner, offset == 0.5, "{point} at {offset}");
    }
}
