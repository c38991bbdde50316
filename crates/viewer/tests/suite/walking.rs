//! Walking with keys and the mouse, and bookmarks with pictures: by keys and the mouse.

use super::edit::{file, open, perform};
use super::focus::click_at;
use crate::harness::Window;
use eframe::egui::{self, Key, Modifiers, PointerButton, Pos2, vec2};
use egui_kittest::kittest::Queryable;
use glam::DVec3;
use glimray_viewer::model::bindings::{Action, Preset};
use glimray_viewer::model::preferences::{Store, THUMBNAIL};

fn window() -> (tempfile::TempDir, Window) {
    let (folder, path) = file();
    (folder, open(&path, "160x120"))
}

fn middle(window: &Window) -> Pos2 {
    window.session().viewport.expect("a picture").rect.center()
}

fn forward(window: &Window) -> DVec3 {
    let camera = window.camera();
    (camera.look_at - camera.look_from).normalize()
}

fn begin(window: &mut Window) {
    let middle = middle(window);
    window.harness.hover_at(middle);
    window.harness.step();
    window
        .harness
        .key_press_modifiers(Modifiers::SHIFT, Key::Backtick);
    window.harness.run_steps(3);
    assert!(window.session().walk.is_some());
}

fn hold(window: &mut Window, key: Key, frames: usize) {
    window.harness.key_down(key);
    window.harness.run_steps(frames);
    window.harness.key_up(key);
    window.settle();
}

#[test]
fn a_walk_with_keys_and_the_mouse_is_kept_in_one_step_of_the_camera() {
    for preset in Preset::ALL {
        let (_folder, mut window) = window();
        window.session().preferences.bindings.set_preset(preset);
        let start = window.camera();
        begin(&mut window);
        hold(&mut window, Key::W, 8);
        let ahead = window.camera().look_from - start.look_from;
        assert!(
            ahead.z < -0.01 && ahead.x.abs() < 1e-9,
            "{preset:?}: {ahead}"
        );
        // To the right by a quarter of the picture's height: a quarter of the angle of view.
        let height = window.session().viewport.expect("a picture").rect.height();
        let to = middle(&window) + vec2(0.25 * height, 0.0);
        window.harness.hover_at(to);
        window.settle();
        let angle = forward(&window).x.asin();
        let expected = 0.25 * start.fov_y;
        assert!(
            (angle - expected).abs() < 0.01,
            "{angle}, expected {expected}"
        );
        // S is a tool elsewhere.
        hold(&mut window, Key::S, 4);
        window.harness.key_press(Key::Enter);
        window.settle();
        assert!(window.session().walk.is_none());
        let end = window.camera();
        assert_ne!(end.look_from, start.look_from);
        window.harness.key_press_modifiers(Modifiers::ALT, Key::Z);
        window.settle();
        assert_eq!(window.camera(), start);
        window
            .harness
            .key_press_modifiers(Modifiers::ALT | Modifiers::SHIFT, Key::Z);
        window.settle();
        assert!(window.camera().look_from.distance(end.look_from) < 1e-9);
    }
}

#[test]
fn escape_and_a_right_click_put_the_camera_back_and_leave_no_step() {
    for ends_by_click in [false, true] {
        let (_folder, mut window) = window();
        let start = window.camera();
        begin(&mut window);
        hold(&mut window, Key::D, 6);
        assert!(window.camera().look_from.x > start.look_from.x + 0.01);
        let at = middle(&window);
        match ends_by_click {
            true => click_at(&mut window, at, PointerButton::Secondary),
            false => window.harness.key_press(Key::Escape),
        }
        window.settle();
        assert!(window.session().walk.is_none() && window.session().picture_menu.is_none());
        assert_eq!(window.camera(), start);
        window.harness.key_press_modifiers(Modifiers::ALT, Key::Z);
        window.settle();
        let session = window.session();
        let mut told = session.messages.current().into_iter().map(|it| it.text);
        assert!(told.any(|text| text == "No camera movement to undo"));
    }
}

#[test]
fn a_click_keeps_the_walk_and_selects_nothing_and_the_wheel_makes_it_faster() {
    let way = |turns: f32| {
        let (_folder, mut window) = window();
        let start = window.camera().look_from;
        begin(&mut window);
        for _ in 0..3 {
            window.harness.event(egui::Event::MouseWheel {
                unit: egui::MouseWheelUnit::Line,
                delta: vec2(0.0, turns),
                phase: egui::TouchPhase::Move,
                source: egui::MouseWheelSource::Unknown,
                modifiers: Modifiers::NONE,
            });
        }
        window.harness.run_steps(2);
        hold(&mut window, Key::E, 6);
        let at = middle(&window);
        click_at(&mut window, at, PointerButton::Primary);
        window.settle();
        assert!(window.session().walk.is_none());
        assert!(window.session().selection.is_none());
        let up = window.camera().look_from - start;
        assert!(up.y > 0.0, "{up}");
        up.y
    };
    let (slow, fast) = (way(0.0), way(1.0));
    // Three steps of a quarter each.
    let factor = fast / slow;
    assert!((1.5..2.6).contains(&factor), "{factor}");
}

#[test]
fn a_bookmark_has_a_picture_of_its_view_that_outlives_the_window_and_a_number() {
    let (_folder, mut window) = window();
    window.harness.key_press(Key::K);
    window.settle();
    let start = window.camera();
    perform(&mut window, Action::ViewTop);
    window.harness.key_press(Key::K);
    window.settle();
    let top = window.camera();
    assert_ne!(start, top);
    let kept: Vec<_> = {
        let session = window.session();
        session
            .preferences
            .cameras
            .values()
            .flatten()
            .cloned()
            .collect()
    };
    assert_eq!(kept.len(), 2);
    let pixels = kept[0].picture.as_ref().expect("a picture").pixels();
    let pixels = pixels.expect("a JPEG file");
    // 160 × 120 pixels in the room of a small picture.
    assert_eq!((pixels.width(), pixels.height()), (107, THUMBNAIL[1]));
    // A red ball at the left, a blue one at the right, as in the picture.
    let [left, right] = [0.35, 0.65].map(|share| {
        let x = (share * f64::from(pixels.width())) as u32;
        pixels.get_pixel(x, pixels.height() / 2).0
    });
    assert!(
        left[0] > 2 * left[2] && right[2] > 2 * right[0],
        "{left:?} {right:?}"
    );
    let mut store = Store::in_folder(window.settings.path());
    store.save(&window.session().preferences).expect("settings");
    let (read, notes) = Store::in_folder(window.settings.path()).load();
    assert_eq!(notes, Vec::<String>::new());
    let read: Vec<_> = read.cameras.values().flatten().cloned().collect();
    assert_eq!(read, kept);

    window
        .harness
        .key_press_modifiers(Modifiers::COMMAND, Key::K);
    window.harness.run_steps(3);
    window.harness.key_press(Key::Num1);
    window.settle();
    assert_eq!(window.camera(), start);
    window.harness.get_by_label("Picture of View 2").click();
    window.settle();
    assert_eq!(window.camera().look_from, top.look_from);
    window.harness.key_press(Key::Num3);
    window.settle();
    let told = "There is no bookmark 3";
    assert!(
        window
            .session()
            .messages
            .current()
            .iter()
            .any(|it| it.text == told)
    );
    // Numbers are views again once the dialog is closed.
    window.harness.key_press(Key::Escape);
    window.settle();
    window.harness.key_press(Key::Num1);
    window.settle();
    assert!(forward(&window).distance(DVec3::NEG_Z) < 1e-9);
    assert_ne!(window.camera(), start);
}

#[test]
fn a_reload_during_a_walk_frees_the_pointer() {
    let (_folder, path) = file();
    let mut window = open(&path, "160x120");
    begin(&mut window);
    let text = std::fs::read_to_string(&path).expect("a scene");
    std::fs::write(&path, text.replace("ambient = [0.2", "ambient = [0.3")).expect("a file");
    window.session().clicked.push(Action::Reload);
    let frees = |command: &egui::ViewportCommand| {
        *command == egui::ViewportCommand::CursorGrab(egui::viewport::CursorGrab::None)
    };
    let mut is_free = false;
    for _ in 0..400 {
        window.harness.step();
        let output = &window.harness.output().viewport_output;
        is_free |= output.values().any(|it| it.commands.iter().any(frees));
        if window.session().walk.is_none() {
            break;
        }
        std::thread::sleep(std::time::Duration::from_millis(5));
    }
    assert!(window.session().walk.is_none(), "it is not reloaded");
    assert!(is_free, "the pointer is still held");
}
