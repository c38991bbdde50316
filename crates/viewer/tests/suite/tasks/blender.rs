//! A Blender user arranges two balls by the keys of Blender: a copy that follows the hand and is deleted again, a move, a
//! rotation and a scale by numbers, both balls as one, and a slip that is taken back.

use crate::edit::{BLUE, RED, file, on_screen, open, scene};
use crate::focus::click_at;
use crate::harness::Window;
use crate::making::{also, center_of, click_row, middle, press, save_as};
use eframe::egui::{Key, Modifiers, PointerButton, vec2};
use glam::dvec3;
use glimray::import;
use glimray::scene::Geometry;
use glimray_viewer::model::bindings::Preset;
use glimray_viewer::model::objects::is_visible;

/// Keys one after the other, with the hand over the picture.
fn keys(window: &mut Window, keys: &[Key]) {
    window.harness.hover_at(middle(window));
    window.harness.step();
    for key in keys {
        press(window, Modifiers::NONE, *key);
    }
    window.settle();
}

#[test]
fn a_blender_user_arranges_a_scene_by_the_keys_of_blender() {
    let (folder, path) = file();
    let mut window = open(&path, "320x240");
    (window.session().preferences.bindings).set_preset(Preset::Blender);
    let before = scene(&window);

    // Tab goes into the interface, as everywhere: the keys of the picture work still.
    press(&mut window, Modifiers::NONE, Key::Tab);
    press(&mut window, Modifiers::NONE, Key::Escape);
    // The middle button orbits, about the balls.
    let start = middle(&window);
    window.harness.hover_at(start);
    window.harness.step();
    for pressed in [true, false] {
        window.harness.event(eframe::egui::Event::PointerButton {
            pos: start,
            button: PointerButton::Middle,
            pressed,
            modifiers: Modifiers::NONE,
        });
        window.harness.step();
        if pressed {
            for step in [30.0, 60.0] {
                window.harness.hover_at(start + vec2(step, 10.0));
                window.harness.step();
            }
        }
    }
    window.settle();
    let camera = window.camera();
    assert_ne!(camera.look_from, before.frame(0.0).camera.look_from);
    let distance = camera.look_from.length();
    assert!((distance - 8.0).abs() < 0.05, "{distance} from the balls");

    // A copy follows the hand, and X deletes it and nothing else.
    let red = on_screen(&window, dvec3(-1.0, 0.0, 0.0));
    click_at(&mut window, red, PointerButton::Primary);
    window.settle();
    assert_eq!(window.session().selected(), [RED]);
    press(&mut window, Modifiers::SHIFT, Key::D);
    let to = red + vec2(60.0, -60.0);
    window.harness.hover_at(to);
    window.harness.run_steps(2);
    click_at(&mut window, to, PointerButton::Primary);
    window.settle();
    assert_eq!(scene(&window).shapes.len(), 3);
    keys(&mut window, &[Key::X]);
    assert!(scene(&window) == before, "not only the copy is gone");

    // Numbers along axes.
    click_row(&mut window, "sphere 1 (red)");
    keys(&mut window, &[Key::G, Key::X, Key::Num1, Key::Enter]);
    keys(&mut window, &[Key::S, Key::Num2, Key::Enter]);
    // Both as one, turned about their middle; a slip is cancelled, another one undone.
    also(&mut window, "sphere 2 (blue)");
    let mut both = window.session().selected();
    both.sort_unstable();
    assert_eq!(both, [RED, BLUE]);
    keys(&mut window, &[Key::G, Key::Y, Key::Num2, Key::Enter]);
    keys(&mut window, &[Key::G, Key::Z, Key::Num9, Key::Escape]);
    keys(&mut window, &[Key::S, Key::Num5, Key::Enter]);
    press(&mut window, Modifiers::COMMAND, Key::Z);
    keys(
        &mut window,
        &[Key::R, Key::Z, Key::Num1, Key::Num8, Key::Num0, Key::Enter],
    );
    // H hides both, and shows them again.
    for is_shown in [false, true] {
        keys(&mut window, &[Key::H]);
        let now = scene(&window);
        assert!(
            [RED, BLUE]
                .iter()
                .all(|id| is_visible(&now, *id) == is_shown)
        );
    }

    let path = folder.path().join("arranged.toml");
    save_as(&mut window, &path);
    let saved = import::load(&path).expect("a scene");
    assert_eq!(saved.shapes.len(), 2);
    // Red went from (−1, 0, 0) to (0, 0, 0) and to (0, 2, 0), blue from (1, 0, 0) to (1, 2, 0). A half turn about their
    // middle, (½, 2, 0), changes their places.
    let radius = |shape: usize| match saved.shapes[shape].geometry {
        Geometry::Sphere { radius, .. } => radius,
        _ => panic!("not a ball"),
    };
    let [red, blue] = [0, 1].map(|shape| center_of(&saved, shape));
    assert!(red.abs_diff_eq(dvec3(1.0, 2.0, 0.0), 1e-6), "red at {red}");
    assert!(
        blue.abs_diff_eq(dvec3(0.0, 2.0, 0.0), 1e-6),
        "blue at {blue}"
    );
    assert!((radius(0) - 1.5).abs() < 1e-6 && (radius(1) - 0.75).abs() < 1e-6);
}
