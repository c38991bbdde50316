//! Somebody opens a model, looks at it from all sides, goes to the next one and keeps a picture, without a setting.

use super::answer;
use crate::harness::Window;
use crate::making::{middle, press};
use eframe::egui::{
    Event, Key, Modifiers, MouseWheelSource, MouseWheelUnit, TouchPhase, Vec2, vec2,
};
use glam::{DVec3, dvec3};
use glimray_viewer::model::camera::project;

/// A box of 2 × 1 × 4 with its middle at (10, 5, −3), as an OBJ file.
fn crate_of_wood() -> String {
    let mut text = String::new();
    for corner in 0..8 {
        let side = |bit: i32, half: f64| if corner >> bit & 1 == 1 { half } else { -half };
        let (x, y, z) = (side(0, 1.0), side(1, 0.5), side(2, 2.0));
        text += &format!("v {} {} {}\n", 10.0 + x, 5.0 + y, z - 3.0);
    }
    for [a, b, c, d] in [
        [1, 3, 4, 2],
        [5, 6, 8, 7],
        [1, 2, 6, 5],
        [3, 7, 8, 4],
        [1, 5, 7, 3],
        [2, 4, 8, 6],
    ] {
        text += &format!("f {a} {b} {c} {d}\n");
    }
    text
}

/// Where the corners of the box are in the picture, in fractions of its width and height.
fn corners(window: &Window) -> Vec<DVec3> {
    let camera = window.camera();
    let mut found = Vec::new();
    for corner in 0..8 {
        let side = |bit: i32, half: f64| if corner >> bit & 1 == 1 { half } else { -half };
        let point = dvec3(10.0, 5.0, -3.0) + dvec3(side(0, 1.0), side(1, 0.5), side(2, 2.0));
        let extent = window.session().viewport.expect("a picture").extent();
        let at = project(&camera, point, extent).expect("in front of the camera");
        found.push((at / extent).extend(0.0));
    }
    found
}

fn assert_framed(window: &Window, what: &str) {
    let corners = corners(window);
    let low = corners.iter().copied().reduce(DVec3::min).expect("corners");
    let high = corners.iter().copied().reduce(DVec3::max).expect("corners");
    let is_inside = low.min_element() >= 0.0 && high.max_element() <= 1.0;
    assert!(is_inside, "{what}: {low} to {high} is cut off");
    let size = high - low;
    assert!(
        size.x.max(size.y) > 0.3,
        "{what}: only {size} of the picture"
    );
}

fn wheel(window: &mut Window, points: f32) {
    window.harness.hover_at(middle(window));
    window.harness.event(Event::MouseWheel {
        unit: MouseWheelUnit::Line,
        delta: vec2(0.0, points),
        phase: TouchPhase::Move,
        source: MouseWheelSource::Wheel,
        modifiers: Modifiers::NONE,
    });
    window.settle();
}

fn drag(window: &mut Window, by: Vec2) {
    let start = middle(window);
    crate::edit::drag(window, start, start + by);
}

#[test]
fn somebody_looks_at_models_from_all_sides_and_keeps_a_picture() {
    let folder = tempfile::tempdir().expect("a folder");
    let model = |name: &str| {
        let path = folder.path().join(name);
        std::fs::write(&path, crate_of_wood()).expect("a file");
        path
    };
    let first = model("a.obj");
    model("b.obj");
    let first = first.to_str().expect("a path in UTF-8");
    let mut window = Window::open(&[first, "--samples", "1"]);
    window.settle();
    assert_framed(&window, "at first");
    let away = |window: &Window| window.camera().look_from - dvec3(10.0, 5.0, -3.0);

    // Round it and nearer: the model stays in the middle.
    let (camera, distance) = (window.camera().look_from, away(&window).length());
    drag(&mut window, vec2(120.0, 30.0));
    assert!(window.camera().look_from.distance(camera) > 0.1 * distance);
    assert!((away(&window).length() - distance).abs() < 0.2 * distance);
    wheel(&mut window, 3.0);
    assert!(
        away(&window).length() < distance,
        "the wheel goes away from it"
    );
    // A wrong way is taken back, and lost models are found again.
    for _ in 0..2 {
        press(&mut window, Modifiers::ALT, Key::Z);
        window.settle();
    }
    assert!(window.camera().look_from.distance(camera) < 1e-6 * distance);
    wheel(&mut window, -40.0);
    press(&mut window, Modifiers::SHIFT, Key::F);
    window.settle();
    assert_framed(&window, "after Frame all");
    for (key, axis) in [
        (Key::Num1, DVec3::Z),
        (Key::Num3, DVec3::X),
        (Key::Num7, DVec3::Y),
    ] {
        press(&mut window, Modifiers::NONE, key);
        window.settle();
        let towards = away(&window).normalize();
        assert!(towards.dot(axis) > 0.999, "{key:?} looks from {towards}");
        assert_framed(&window, "along an axis");
    }

    // The next model is framed without a word, too.
    press(&mut window, Modifiers::COMMAND, Key::PageDown);
    window.settle();
    assert_eq!(window.session().title(), "b.obj");
    assert_framed(&window, "the next model");
    let picture = folder.path().join("kept.png");
    press(&mut window, Modifiers::NONE, Key::F12);
    answer(&mut window, &picture);
    let kept = ::image::open(&picture).expect("a picture").to_rgb8();
    let [ground, model] = [[0.02, 0.02], [0.5, 0.5]].map(|[x, y]| {
        let at = |share: f64, length: u32| (share * f64::from(length)) as u32;
        kept.get_pixel(at(x, kept.width()), at(y, kept.height())).0
    });
    assert_ne!(ground, model, "there is nothing in the picture");
    let told = window.session().messages.current();
    let is_saved = |text: &str| text.contains("kept.png");
    assert!(
        told.iter().all(|it| is_saved(&it.text)),
        "{:?}",
        told[0].text
    );
}
