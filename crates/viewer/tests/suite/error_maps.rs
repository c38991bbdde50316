//! Error maps and false colours, held against figures from outside the window.

use super::edit;
use super::pixels::{self, Bytes};
use crate::harness::Window;
use eframe::egui::{Key, Modifiers};
use egui_kittest::kittest::{NodeT, Queryable, by};
use glimray_app::flip::Flip;
use glimray_viewer::actions::comparing;
use glimray_viewer::model::view_settings::{ErrorMap, Measure, Sharing};
use glimray_viewer::worker::comparison::ShownDifference;
use std::path::Path;

/// A window of 64×48 pixels that are all of this linear colour.
fn plain(folder: &Path, color: &str) -> Window {
    let path = folder.join("plain.toml");
    let text = format!(
        "background = {color}\ncamera = {{ look_from = [0, 0, 8], look_at = [0, 0, 0] }}\n"
    );
    std::fs::write(&path, text).expect("a file");
    edit::open(&path, "64x48")
}

fn compare(window: &mut Window, measure: Measure, gain: f32) -> ShownDifference {
    let map = ErrorMap { measure, gain };
    if let Some(comparison) = &mut window.session().view.comparison {
        comparison.sharing = Sharing::Difference(map);
    }
    window.settle();
    let render = window.harness.state().render_thread();
    render.difference().expect("a difference")
}

fn picture(window: &Window) -> Bytes {
    pixels::on(&window.shown().screen.expect("a screen"), &window.gpu)
}

fn labels(window: &Window, part: &str) -> Vec<String> {
    let found = window.harness.query_all(by().label_contains(part));
    let told = found.filter_map(|it| it.accesskit_node().label());
    told.filter(|text| text.starts_with(part)).collect()
}

#[test]
fn relative_errors_are_of_linear_values_whatever_the_exposure() {
    let folder = tempfile::tempdir().expect("a folder");
    let mut window = plain(folder.path(), "[0.5, 2, 0]");
    let path = folder.path().join("reference.exr");
    let radiance = ::image::Rgb32FImage::from_pixel(64, 48, ::image::Rgb([0.25, 4.0, 0.0]));
    radiance.save(&path).expect("an EXR");
    comparing::open_reference(&mut window.session(), path);
    window.settle();
    // By hand: (0.25 / 0.26 + 2 / 4.01 + 0) / 3, and (0.0625 / 0.0725 + 4 / 16.01 + 0) / 3.
    for (measure, name, expected) in [
        (Measure::Relative, "mean", (0.25 / 0.26 + 2.0 / 4.01) / 3.0),
        (
            Measure::RelativeSquared,
            "relMSE",
            (0.0625 / 0.0725 + 4.0 / 16.01) / 3.0_f64,
        ),
    ] {
        for exposure in [0.0, -2.0] {
            window.session().view.tone.exposure_ev = exposure;
            let shown = compare(&mut window, measure, 1.0);
            assert!((shown.mean - expected).abs() < 1e-6, "{}", shown.mean);
            let told = labels(&window, &format!("{name} "));
            assert_eq!(told, [format!("{name} {expected:.6}")]);
        }
    }
    // A scale from black to pale yellow, which ends at 1 / gain.
    let map = pixels::on(
        &compare(&mut window, Measure::Relative, 100.0).screen,
        &window.gpu,
    );
    assert!(map.rgb.iter().all(|rgb| *rgb == [252, 253, 191]));
    let told = labels(&window, "Legend");
    assert!(told[0].contains("from 0 (black) to 0.01"), "{told:?}");
}

#[test]
fn display_values_of_a_file_are_decoded_for_relative_errors() {
    let folder = tempfile::tempdir().expect("a folder");
    let mut window = plain(folder.path(), "[0, 0, 0]");
    let path = folder.path().join("reference.png");
    let white = ::image::RgbImage::from_pixel(64, 48, ::image::Rgb([188; 3]));
    white.save(&path).expect("a PNG");
    comparing::open_reference(&mut window.session(), path);
    window.settle();
    // IEC 61966-2-1: level 188 is a linear value of 0.5029.
    let shown = compare(&mut window, Measure::Relative, 1.0);
    let expected = 0.502_886_5 / (0.502_886_5 + 0.01);
    assert!((shown.mean - expected).abs() < 1e-5, "{}", shown.mean);
}

#[test]
fn the_mean_of_flip_is_that_of_the_command_compare() {
    let (_folder, path) = edit::file();
    let mut window = edit::open(&path, "64x48");
    let before = picture(&window);
    window.harness.key_press_modifiers(Modifiers::SHIFT, Key::K);
    window.settle();
    window.session().edit("paint", |scene| {
        scene.background = glimray::scene::Background::Color(glam::vec3(0.9, 0.3, 0.1));
    });
    window.settle();
    let after = picture(&window);
    window.session().view.compare(Sharing::SideBySide);
    let mean = compare(&mut window, Measure::Flip, 1.0).mean;
    // The command compares the levels of saved pictures by this function.
    let levels = [after, before].map(|picture| picture.rgb.concat());
    let flip = Flip::new([64, 48], levels).expect("the feature");
    // The command adds single-precision numbers up.
    let off = (mean - f64::from(flip.mean)).abs();
    assert!(mean > 0.05 && off < 1e-4, "{mean} for {}", flip.mean);
    let brightest = flip.errors.iter().copied().fold(0.0, f32::max);
    assert_eq!(
        labels(&window, "mean FLIP"),
        [format!("mean FLIP {mean:.6}")]
    );
    // A gain that takes the largest error to the end of the scale.
    let shown = compare(&mut window, Measure::Flip, 1.0 / brightest);
    let map = pixels::on(&shown.screen, &window.gpu);
    let place = flip.errors.iter().position(|error| *error == brightest);
    assert_eq!(map.rgb[place.expect("a pixel")], [252, 253, 191]);
}

#[test]
fn false_colours_tell_stops_around_middle_grey_before_the_tone_curve() {
    let folder = tempfile::tempdir().expect("a folder");
    // Middle grey is a reflectance of 18 %, and each stop doubles the light.
    let mut window = plain(folder.path(), "[0.18, 0.18, 0.18]");
    let color = |window: &mut Window| {
        window.settle();
        let pixels = picture(window).rgb;
        assert!(pixels.iter().all(|rgb| *rgb == pixels[0]));
        pixels[0]
    };
    let before = color(&mut window);
    window.harness.key_press_modifiers(Modifiers::SHIFT, Key::Y);
    assert_eq!(color(&mut window), [128; 3]);
    window.session().view.next_tone_curve();
    assert_eq!(color(&mut window), [128; 3], "another tone curve");
    let mut seen = Vec::new();
    for stops in [-9.0, -6.0, -2.0, -1.4, -1.0, 0.4, 0.6, 1.0, 6.0, 9.0] {
        window.session().view.tone.exposure_ev = stops;
        seen.push(color(&mut window));
    }
    let [
        far,
        six,
        two,
        near_one,
        one,
        zero,
        near_plus,
        plus,
        white,
        more,
    ] = seen[..]
    else {
        panic!("ten colours");
    };
    assert_eq!((far, near_one, zero), (six, one, [128; 3]));
    assert_eq!((near_plus, white, more), (plus, [255; 3], [255; 3]));
    let mut different = vec![six, two, one, zero, plus, white];
    different.dedup();
    assert_eq!(different.len(), 6, "{different:?}");
    let told = labels(&window, "Legend");
    assert!(told[0].contains("-6 to +6 EV"), "{told:?}");
    let before_all = window.session().view.scene_tone;
    window.session().view.tone = before_all;
    window.harness.key_press_modifiers(Modifiers::SHIFT, Key::Y);
    assert_eq!(color(&mut window), before);
}

#[test]
fn a_picture_in_false_colours_does_not_differ_from_its_snapshot() {
    let (_folder, path) = edit::file();
    let mut window = edit::open(&path, "64x48");
    window.harness.key_press_modifiers(Modifiers::SHIFT, Key::K);
    window.settle();
    window.harness.key_press_modifiers(Modifiers::SHIFT, Key::Y);
    window.settle();
    assert!(window.session().view.false_color);
    window.harness.key_press(Key::Y);
    window.settle();
    for measure in [Measure::Absolute, Measure::Flip] {
        let shown = compare(&mut window, measure, 1.0);
        assert_eq!((shown.rmse, shown.mean), (0.0, 0.0), "{measure:?}");
    }
}

#[test]
fn values_that_are_not_finite_are_left_out_of_relative_errors() {
    let folder = tempfile::tempdir().expect("a folder");
    let mut window = plain(folder.path(), "[0.5, 0.5, 0.5]");
    let path = folder.path().join("reference.exr");
    let mut radiance = ::image::Rgb32FImage::from_pixel(64, 48, ::image::Rgb([0.25; 3]));
    radiance.put_pixel(3, 4, ::image::Rgb([f32::INFINITY; 3]));
    radiance.save(&path).expect("an EXR");
    comparing::open_reference(&mut window.session(), path);
    window.settle();
    let shown = compare(&mut window, Measure::Relative, 1.0);
    assert!((shown.mean - 0.25 / 0.26).abs() < 1e-5, "{}", shown.mean);
}
