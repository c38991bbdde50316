//! Kept pictures by number: keys that flip to them, and their list.

use super::edit;
use super::pixels::{self, Bytes};
use crate::harness::Window;
use eframe::egui::{Key, Modifiers};
use egui_kittest::kittest::{NodeT, Queryable, by};
use glimray::scene::Background;
use glimray_viewer::actions::comparing;
use glimray_viewer::model::bindings::Preset;
use glimray_viewer::model::gallery::MOST;
use glimray_viewer::model::view_settings::{Sharing, Source};
use std::collections::BTreeSet;
use tempfile::TempDir;

/// A window with pictures of three backgrounds: two are kept, and the third is the present one.
fn kept() -> (TempDir, Window, [Bytes; 3]) {
    let (folder, path) = edit::file();
    let mut window = edit::open(&path, "64x48");
    let mut pictures = Vec::new();
    for level in [0.2, 0.5, 1.0] {
        window.session().edit("paint", |scene| {
            scene.background = Background::Color(glam::Vec3::splat(level));
        });
        window.settle();
        pictures.push(pixels::on(
            &window.shown().screen.expect("a screen"),
            &window.gpu,
        ));
        if level < 1.0 {
            window.harness.key_press_modifiers(Modifiers::SHIFT, Key::K);
            window.settle();
        }
    }
    let pictures = pictures.try_into().ok().expect("three pictures");
    (folder, window, pictures)
}

fn press(window: &mut Window, modifiers: Modifiers, key: Key) {
    window.harness.key_press_modifiers(modifiers, key);
    window.settle();
}

/// Clicks a widget of the list, which may have to be scrolled to.
fn click(window: &mut Window, label: &str) {
    window.harness.get_by_label(label).scroll_to_me();
    window.settle();
    window.harness.get_by_label(label).click();
    window.settle();
}

/// The name of the kept picture that hides the present one, and its pixels.
fn flipped(window: &Window) -> Option<(String, Bytes)> {
    let name = {
        let session = window.session();
        let comparison = session.view.comparison?;
        assert_eq!(comparison.sharing, Sharing::Wipe(0.0));
        session.still()?.name.clone()
    };
    let still = window.harness.state().render_thread().still();
    Some((name, pixels::on(&still.expect("a still"), &window.gpu)))
}

#[test]
fn number_keys_flip_between_kept_pictures_and_the_present_one() {
    for (preset, modifiers) in [
        (Preset::Glimray, Modifiers::ALT),
        (Preset::Maya, Modifiers::ALT),
        (Preset::Blender, Modifiers::ALT | Modifiers::SHIFT),
    ] {
        let (_folder, mut window, [first, second, _]) = kept();
        window.session().preferences.bindings.set_preset(preset);
        assert!(window.session().view.comparison.is_none());
        for (key, name, pixels) in [
            (Key::Num1, "Snapshot 1", &first),
            (Key::Num2, "Snapshot 2", &second),
            (Key::Num1, "Snapshot 1", &first),
        ] {
            press(&mut window, modifiers, key);
            let (shown, found) = flipped(&window).expect("a kept picture");
            assert_eq!(shown, name, "{preset:?}");
            found.assert_same(pixels, name);
        }
        // The key of the one that is shown brings the present one back.
        press(&mut window, modifiers, Key::Num1);
        assert_eq!(window.session().view.comparison, None, "{preset:?}");
        // A number without a picture changes nothing, and says so.
        press(&mut window, modifiers, Key::Num7);
        assert_eq!(window.session().view.comparison, None);
        let told = window.session().messages.current();
        let is_told = told
            .iter()
            .any(|it| it.text == "No picture is kept under 7");
        assert!(is_told, "{preset:?}");
    }
}

#[test]
fn a_number_stays_with_its_picture_and_a_free_one_is_given_anew() {
    let (_folder, mut window, _) = kept();
    click(&mut window, "Remove: Snapshot 1");
    let numbers = |window: &Window| {
        let session = window.session();
        let stills = session.comparing.gallery.all().iter();
        stills
            .map(|it| (it.number, it.name.clone()))
            .collect::<Vec<_>>()
    };
    assert_eq!(numbers(&window), [(2, "Snapshot 2".to_owned())]);
    press(&mut window, Modifiers::ALT, Key::Num2);
    assert_eq!(
        flipped(&window).map(|it| it.0).as_deref(),
        Some("Snapshot 2")
    );
    // The one that is shown comes from its own number, not from its place in the list.
    press(&mut window, Modifiers::ALT, Key::Num2);
    press(&mut window, Modifiers::SHIFT, Key::K);
    let expected = [(1, "Snapshot 1".to_owned()), (2, "Snapshot 2".to_owned())];
    assert_eq!(numbers(&window), expected);
    for _ in 0..MOST {
        comparing::keep_snapshot(&mut window.session());
        window.settle();
    }
    let all: BTreeSet<_> = numbers(&window).into_iter().map(|it| it.0).collect();
    assert_eq!(all, (1..=MOST).collect());
}

#[test]
fn the_list_flips_renames_and_removes() {
    let (_folder, mut window, [first, ..]) = kept();
    let line = |window: &Window, name: &str| {
        let found = window.harness.query_all(by().label_contains(name));
        found
            .filter_map(|it| it.accesskit_node().label())
            .collect::<Vec<_>>()
    };
    click(&mut window, "1: Snapshot 1");
    let (name, pixels) = flipped(&window).expect("a kept picture");
    assert_eq!(name, "Snapshot 1");
    pixels.assert_same(&first, "the first");
    click(&mut window, "1: Snapshot 1");
    assert_eq!(window.session().view.comparison, None);

    click(&mut window, "Rename: Snapshot 1");
    press(&mut window, Modifiers::COMMAND, Key::A);
    window
        .harness
        .event(eframe::egui::Event::Text(" warm light ".to_owned()));
    window.settle();
    press(&mut window, Modifiers::NONE, Key::Enter);
    window.harness.get_by_label("1: warm light");
    // Escape leaves a name as it is, and so does an empty one.
    for (text, key) in [("x", Key::Escape), ("  ", Key::Enter)] {
        click(&mut window, "Rename: warm light");
        press(&mut window, Modifiers::COMMAND, Key::A);
        window
            .harness
            .event(eframe::egui::Event::Text(text.to_owned()));
        window.settle();
        press(&mut window, Modifiers::NONE, key);
        assert_eq!(line(&window, "1: "), ["1: warm light"], "{text:?}");
    }
    press(&mut window, Modifiers::ALT, Key::Num1);
    assert!(flipped(&window).is_some());
    click(&mut window, "Remove: warm light");
    assert_eq!(window.session().view.comparison, None);
    let source = window.session().view.proposed;
    assert!(
        !matches!(source, Some(Source::Still(id)) if window.session().comparing.gallery.get(id).is_none())
    );
    assert_eq!(line(&window, "1: "), Vec::<String>::new());
}
