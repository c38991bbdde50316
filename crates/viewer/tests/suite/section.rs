//! The section plane in the properties of the scene.

use super::edit::{drag, file, on_screen, open};
use crate::harness::Window;
use eframe::egui::{Key, Modifiers, vec2};
use egui_kittest::kittest::Queryable;
use glam::{DVec3, dvec3};
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

#[test]
fn the_plane_is_moved_by_its_arrow_and_tilted_by_its_rings_in_the_picture() {
    let (_folder, path) = file();
    let mut window = open(&path, "400x300");
    window.session().edit("cut", |scene| {
        scene.section = Some(Section {
            normal: DVec3::X,
            offset: 0.25,
        });
    });
    window.settle();
    let steps = |window: &Window| {
        let session = window.session();
        session.document.as_ref().map(|it| it.undo_count())
    };
    let before = steps(&window).expect("a document");
    // The arrow goes to the right from where the plane is nearest to the middle of the scene.
    let start = on_screen(&window, dvec3(0.25, 0.0, 0.0));
    let from = start + vec2(70.0, 0.0);
    drag(&mut window, from, from + vec2(35.0, 0.0));
    let pixel = 2.0 * 8.0 * 15_f64.to_radians().tan() / 300.0;
    let moved = section(&window).expect("a plane");
    assert_eq!(moved.normal, DVec3::X);
    let expected = 0.25 + 35.0 * pixel;
    assert!(
        (moved.offset - expected).abs() < 0.02,
        "{moved:?} for {expected}"
    );
    assert_eq!(steps(&window), Some(before + 1));
    let camera = window.camera();

    // The ring around the line of sight is a circle in the picture: a quarter of a turn about where the plane is.
    let middle = on_screen(&window, dvec3(moved.offset, 0.0, 0.0));
    let radius = 0.7 * 84.0;
    let slant = radius * std::f32::consts::FRAC_1_SQRT_2;
    let from = middle + vec2(-slant, -slant);
    drag(&mut window, from, from + vec2(0.0, 2.0 * slant));
    let tilted = section(&window).expect("a plane");
    assert!((tilted.normal.length() - 1.0).abs() < 1e-9);
    // Counter-clockwise: what pointed to the right points upwards.
    assert!(tilted.normal.distance(DVec3::Y) < 0.05, "{tilted:?}");
    let through = tilted.normal.dot(dvec3(moved.offset, 0.0, 0.0));
    assert!((tilted.offset - through).abs() < 1e-6, "{tilted:?}");
    assert_eq!(steps(&window), Some(before + 2));
    assert_eq!(window.camera(), camera, "the drag moved the camera");
    for expected in [moved.offset, 0.25] {
        window
            .harness
            .key_press_modifiers(Modifiers::COMMAND, Key::Z);
        window.settle();
        let plane = section(&window).expect("a plane");
        assert!((plane.offset - expected).abs() < 1e-9);
        assert_eq!(plane.normal, DVec3::X);
    }
}
