//! Somebody tunes the settings of a picture, keeps what it looked like, compares, saves the settings with the scene, and gets
//! the same picture from the command line.

use super::answer;
use crate::edit::{file, open};
use crate::harness::Window;
use crate::making::{click, press};
use eframe::egui::{Key, Modifiers};
use egui_kittest::kittest::Queryable;
use glimray::render::Integrator;
use glimray::{PictureOptions, import, output, render_file};

fn set(window: &mut Window, field: &str, value: f64) {
    (window.harness.get_by_label(field)).set_value_accesskit(value);
    window.settle();
}

fn settled_press(window: &mut Window, modifiers: Modifiers, key: Key) {
    press(window, modifiers, key);
    window.settle();
}

#[test]
fn somebody_tunes_a_picture_compares_and_renders_it_by_the_command_line() {
    let (folder, path) = file();
    let mut window = open(&path, "64x48");
    settled_press(&mut window, Modifiers::SHIFT, Key::Num8);
    assert_eq!(window.request().settings.integrator, Integrator::Path);
    set(&mut window, "Samples", 8.0);
    settled_press(&mut window, Modifiers::SHIFT, Key::K);
    for _ in 0..2 {
        settled_press(&mut window, Modifiers::NONE, Key::Equals);
    }
    window.harness.get_by_label("Denoise").click();
    window.settle();

    // Before and after, side by side and as a difference.
    settled_press(&mut window, Modifiers::NONE, Key::X);
    let kept = window.session().comparing.gallery.all()[0].name.clone();
    assert_eq!(kept, "Snapshot 1");
    let wiped = window.session().view.comparison;
    assert!(wiped.is_some(), "nothing is compared");
    settled_press(&mut window, Modifiers::NONE, Key::F6);
    assert!(
        window.session().still().is_some(),
        "the snapshot is not shown"
    );
    settled_press(&mut window, Modifiers::NONE, Key::F6);
    assert_eq!(window.session().view.comparison, wiped);

    click(&mut window, "Save settings to scene");
    let tuned = folder.path().join("tuned.toml");
    crate::making::save_as(&mut window, &tuned);
    let output = import::load(&tuned).expect("a scene").output;
    assert_eq!(output.samples, 8);
    let picture = folder.path().join("window.png");
    settled_press(&mut window, Modifiers::NONE, Key::F12);
    answer(&mut window, &picture);

    // The scene alone gives the bytes of the window's picture.
    let rendered = folder.path().join("rendered.png");
    let image = render_file(&tuned, &PictureOptions::default()).expect("a picture");
    output::save(&rendered, &image).expect("a file");
    let pixels = |path| ::image::open(path).expect("a picture").to_rgb8();
    assert!(
        pixels(&picture) == pixels(&rendered),
        "the window shows another picture"
    );
}
