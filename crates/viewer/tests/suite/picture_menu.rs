//! The menu of a point of the picture, the picture on the clipboard, and the values of magnified pixels.

use crate::edit;
use crate::harness::Window;
use crate::pixels;
use eframe::egui::{self, Key, Modifiers, PointerButton, Pos2, Role, vec2};
use egui_kittest::kittest::{NodeT, Queryable};
use glimray_viewer::model::bindings::Preset;
use glimray_viewer::model::objects::Id;
use glimray_viewer::model::tool::Tool;
use std::time::Instant;
use tempfile::TempDir;

/// Two balls, seen with 64 × 48 pixels.
fn open() -> (TempDir, Window) {
    let (folder, path) = edit::file();
    let window = edit::open(&path, "64x48");
    (folder, window)
}

fn button(window: &mut Window, pos: Pos2, pressed: bool) {
    window.harness.event(egui::Event::PointerButton {
        pos,
        button: PointerButton::Secondary,
        pressed,
        modifiers: Modifiers::NONE,
    });
    window.harness.step();
}

fn right_click(window: &mut Window, point: Pos2) {
    window.harness.hover_at(point);
    window.harness.step();
    button(window, point, true);
    button(window, point, false);
    window.settle();
}

fn choose(window: &mut Window, entry: &str) {
    let button = (window.harness).get_by_role_and_label(Role::Button, entry);
    button.click();
    window.harness.run_steps(3);
    window.settle();
}

/// Right clicks along the middle row until an object is under the cursor.
fn open_on_an_object(window: &mut Window) -> Pos2 {
    let middle = window.session().viewport.expect("a picture").rect.center();
    for step in 0..30 {
        let side = if step % 2 == 0 { 1.0 } else { -1.0 };
        let point = middle + vec2(side * step as f32, 0.0);
        right_click(window, point);
        let menu = window.session().picture_menu.clone().expect("a menu");
        if menu.point.is_some() {
            return point;
        }
        window.harness.key_press(Key::Escape);
        window.harness.run_steps(3);
    }
    panic!("nothing is in the middle row");
}

#[test]
fn the_menu_of_an_object_hides_duplicates_and_deletes_it() {
    let (_folder, mut window) = open();
    let count = |window: &Window| window.session().scene().expect("a scene").shapes.len();
    let before = count(&window);
    open_on_an_object(&mut window);
    let id = window.session().selection.expect("it is selected");
    choose(&mut window, "Duplicate");
    assert_eq!(count(&window), before + 1);
    window.session().selection = None;
    open_on_an_object(&mut window);
    choose(&mut window, "Delete");
    assert_eq!(count(&window), before);
    open_on_an_object(&mut window);
    let id_now = window.session().selection.expect("a selection");
    choose(&mut window, "Hide");
    let scene = window.session().scene().expect("a scene").clone();
    assert!(!glimray_viewer::model::objects::is_visible(&scene, id_now));
    assert!(matches!(id, Id::Object(_)));
}

#[test]
fn the_menu_frames_focuses_and_inspects_what_is_under_the_cursor() {
    let (_folder, path) = edit::file();
    let text = std::fs::read_to_string(&path).expect("a scene");
    let with_lens = text.replace("fov_y_deg = 30", "fov_y_deg = 30\nlens = { radius = 0.01 }");
    std::fs::write(&path, with_lens).expect("a file");
    let mut window = edit::open(&path, "64x48");
    let focus = |window: &Window| window.camera().lens.expect("a lens").focus_distance;
    assert_eq!(focus(&window), 8.0);
    open_on_an_object(&mut window);
    choose(&mut window, "Focus here");
    // The balls begin 0.75 before their centres, which are at 8.
    assert!((7.25..7.9).contains(&focus(&window)), "{}", focus(&window));
    let before = window.camera().look_from;
    open_on_an_object(&mut window);
    choose(&mut window, "Frame");
    assert_ne!(window.camera().look_from, before);
    open_on_an_object(&mut window);
    choose(&mut window, "Material");
    let selection = window.session().selection;
    assert!(matches!(selection, Some(Id::Material(_))), "{selection:?}");
    open_on_an_object(&mut window);
    let pixel = window.session().picture_menu.clone().expect("a menu").pixel;
    choose(&mut window, "Inspect rays");
    let session = window.session();
    assert_eq!(session.tool, Tool::Inspect);
    let inspected = session.inspector.inspected.as_ref().expect("rays");
    assert_eq!(inspected.tree.pixel, pixel);
}

#[test]
fn over_the_background_there_is_no_object_and_right_drags_open_nothing() {
    let (_folder, mut window) = open();
    let corner = window.session().viewport.expect("a picture").rect.min + vec2(1.5, 1.5);
    right_click(&mut window, corner);
    assert!(window.session().picture_menu.is_some());
    let delete = window.harness.get_by_label("Delete");
    assert!(delete.accesskit_node().is_disabled());
    window.harness.key_press(Key::Escape);
    window.harness.run_steps(3);
    assert!(window.session().picture_menu.is_none());
    for preset in Preset::ALL {
        window.session().preferences.bindings.set_preset(preset);
        button(&mut window, corner, true);
        for step in 1..6 {
            window
                .harness
                .hover_at(corner + vec2(0.0, 6.0 * step as f32));
            window.harness.step();
        }
        button(&mut window, corner + vec2(0.0, 30.0), false);
        window.settle();
        assert!(window.session().picture_menu.is_none(), "{preset:?}");
        right_click(&mut window, corner);
        assert!(window.session().picture_menu.is_some(), "{preset:?}");
        window.harness.key_press(Key::Escape);
        window.harness.run_steps(3);
    }
}

#[test]
fn the_picture_is_copied_as_it_is_shown() {
    let (_folder, mut window) = open();
    let modifiers = Modifiers::COMMAND | Modifiers::SHIFT;
    // Each event is a frame, and only the commands of the last one can be seen.
    window.harness.event(egui::Event::Key {
        key: Key::P,
        physical_key: None,
        pressed: true,
        repeat: false,
        modifiers,
    });
    let start = Instant::now();
    let copied = loop {
        window.harness.step();
        let commands = window.harness.output().platform_output.commands.clone();
        let image = commands.into_iter().find_map(|command| match command {
            egui::OutputCommand::CopyImage(image) => Some(image),
            _ => None,
        });
        if let Some(image) = image {
            break image;
        }
        assert!(
            start.elapsed() < crate::support::PATIENCE,
            "nothing is copied"
        );
    };
    assert_eq!(copied.size, [64, 48]);
    let screen = window.shown().screen.expect("a picture");
    let shown = pixels::on(&screen, &window.gpu);
    let copied: Vec<[u8; 3]> = (copied.pixels.iter())
        .map(|color| [color.r(), color.g(), color.b()])
        .collect();
    assert!(copied == shown.rgb, "other pixels are copied");
}

/// The texts that the window draws.
fn texts(window: &Window) -> Vec<String> {
    fn of(shape: &egui::Shape, texts: &mut Vec<String>) {
        match shape {
            egui::Shape::Text(text) => texts.push(text.galley.text().to_owned()),
            egui::Shape::Vec(shapes) => shapes.iter().for_each(|shape| of(shape, texts)),
            _ => {}
        }
    }
    let mut texts = Vec::new();
    for clipped in &window.harness.output().shapes {
        of(&clipped.shape, &mut texts);
    }
    texts
}

#[test]
fn magnified_pixels_have_their_values_in_them() {
    let (_folder, mut window) = open();
    let center = window.session().viewport.expect("a picture").rect.center();
    window.harness.hover_at(center);
    window.harness.step();
    let has_values = |window: &Window, rgb: [u8; 3]| {
        let [red, green, blue] = rgb;
        texts(window).contains(&format!("{red}\n{green}\n{blue}"))
    };
    let screen = window.shown().screen.expect("a picture");
    let shown = pixels::on(&screen, &window.gpu);
    let middle = shown.rgb[24 * 64 + 32];
    assert!(!has_values(&window, middle));
    for _ in 0..16 {
        window
            .harness
            .key_press_modifiers(Modifiers::ALT, Key::PageUp);
        window.harness.step();
    }
    window.settle();
    window.harness.step();
    assert!(
        has_values(&window, middle),
        "{middle:?}: {:?}",
        texts(&window)
    );
    window
        .harness
        .key_press_modifiers(Modifiers::ALT, Key::Home);
    window.harness.run_steps(2);
    assert!(!has_values(&window, middle));
}

#[test]
fn kept_pictures_are_flipped_to_by_keys() {
    let (_folder, mut window) = open();
    window.harness.key_press(Key::F6);
    window.settle();
    assert_eq!(window.session().view.comparison, None);
    for _ in 0..2 {
        window.harness.key_press_modifiers(Modifiers::SHIFT, Key::K);
        window.settle();
    }
    let shown = |window: &Window| window.session().still().map(|still| still.name.clone());
    window.harness.key_press(Key::F6);
    window.settle();
    let last = shown(&window).expect("a kept picture");
    window.harness.key_press(Key::F6);
    window.settle();
    assert_eq!(shown(&window), None);
    window
        .harness
        .key_press_modifiers(Modifiers::SHIFT, Key::F6);
    window.settle();
    let first = shown(&window).expect("a kept picture");
    assert_ne!(first, last);
    window
        .harness
        .key_press_modifiers(Modifiers::SHIFT, Key::F6);
    window.settle();
    assert_eq!(shown(&window), Some(last));
}
