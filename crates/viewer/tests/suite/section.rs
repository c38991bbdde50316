//! The section plane in the properties of the scene.

use crate::harness::Window;
use eframe::egui::{Key, Modifiers};
use egui_kittest::kittest::Queryable;
use glam::DVec3;
use glimray::render::Tone;
use glimray::scene::Section;

fn section(window: &Window) -> Option<Section> {
    window.session().scene().expect("a scene").section
}

#[test]
fn a_scene_is_cut_open_and_turned_by_hand_and_closed_again_by_undo() {
    let mut window = Window::open(&["assets/scenes/sphere.scene", "--size", "64x48"]);
    window.settle();
    let whole = window.image(Tone::LINEAR);
    window.harness.get_by_label("Cut open").click_accesskit();
    window.settle();
    // The camera of the scene looks along −z.
    let cut = section(&window).expect("a plane");
    assert_eq!(cut.normal, DVec3::Z);
    assert!(whole.pixels != window.image(Tone::LINEAR).pixels);

    let row = window.harness.get_by_label("Offset");
    row.set_value_accesskit(1e6);
    window.settle();
    assert_eq!(section(&window).expect("a plane").offset, 1e6);
    assert!(whole.pixels == window.image(Tone::LINEAR).pixels);

    let button = window.harness.get_by_label("Face the camera");
    button.click_accesskit();
    window.settle();
    assert!((section(&window).expect("a plane").offset - cut.offset).abs() < 1e-9);

    for _ in 0..3 {
        window
            .harness
            .key_press_modifiers(Modifiers::COMMAND, Key::Z);
        window.settle();
    }
    assert_eq!(section(&window), None);
    assert!(whole.pixels == window.image(Tone::LINEAR).pixels);
}
