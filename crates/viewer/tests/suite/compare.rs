//! Snapshots, reference pictures, differences and the histogram in the window.

use super::edit;
use super::pixels::{self, Bytes};
use crate::harness::Window;
use eframe::egui::{self, Key, Modifiers};
use egui_kittest::kittest::{NodeT, Queryable, by};
use glam::Vec3;
use glimray::scene::Background;
use glimray_viewer::actions::comparing;
use glimray_viewer::model::file_dialog::{FileDialogs, Reply};
use glimray_viewer::model::gallery::MOST;
use glimray_viewer::model::view_settings::{ErrorMap, Sharing, Source};
use glimray_viewer::worker::comparison::ShownDifference;
use std::path::{Path, PathBuf};
use tempfile::TempDir;

/// A window of 64×48 pixels with two balls.
fn balls() -> (TempDir, Window) {
    let (folder, path) = edit::file();
    let window = edit::open(&path, "64x48");
    (folder, window)
}

/// A window of 64×48 pixels that are all of this linear colour.
fn plain(folder: &Path, color: &str) -> Window {
    let path = folder.join("plain.toml");
    let text = format!(
        "background = {color}\ncamera = {{ look_from = [0, 0, 8], look_at = [0, 0, 0] }}\n"
    );
    std::fs::write(&path, text).expect("a file");
    edit::open(&path, "64x48")
}

/// A PNG of one colour.
fn reference(folder: &Path, (width, height): (u32, u32), color: [u8; 3]) -> PathBuf {
    let path = folder.join("reference.png");
    let picture = ::image::RgbImage::from_pixel(width, height, ::image::Rgb(color));
    picture.save(&path).expect("a PNG");
    path
}

fn keep(window: &mut Window) {
    window.harness.key_press_modifiers(Modifiers::SHIFT, Key::K);
    window.settle();
}

fn compare(window: &mut Window, sharing: Sharing) {
    window.session().view.compare(sharing);
    window.settle();
}

fn difference(window: &Window) -> ShownDifference {
    let render = window.harness.state().render_thread();
    render.difference().expect("a difference")
}

/// The difference as it is displayed.
fn difference_pixels(window: &Window) -> Bytes {
    pixels::on(&difference(window).screen, &window.gpu)
}

fn still_pixels(window: &Window) -> Bytes {
    let still = window.harness.state().render_thread().still();
    pixels::on(&still.expect("a still"), &window.gpu)
}

fn picture_pixels(window: &Window) -> Bytes {
    pixels::on(&window.shown().screen.expect("a screen"), &window.gpu)
}

fn messages(window: &Window) -> Vec<String> {
    let messages = window.session().messages.current();
    messages.into_iter().map(|message| message.text).collect()
}

/// The colour of the window at a fraction of the picture's width, below its labels.
fn color_at(window: &mut Window, share: f64) -> [u8; 3] {
    let viewport = window.session().viewport.expect("a picture");
    let at = viewport.point(glam::dvec2(share, 0.9) * viewport.extent());
    let image = window.harness.render().expect("a picture of the window");
    let [r, g, b, _] = image.get_pixel(at.x as u32, at.y as u32).0;
    [r, g, b]
}

#[test]
fn a_picture_does_not_differ_from_its_snapshot_however_it_is_developed() {
    let (_folder, mut window) = balls();
    keep(&mut window);
    let name = window.session().comparing.gallery.all()[0].name.clone();
    assert_eq!(name, "Snapshot 1");
    compare(&mut window, Sharing::Difference(ErrorMap::absolute(100.0)));
    let before = picture_pixels(&window);
    for exposure in [0.0, 1.5] {
        window.session().view.tone.exposure_ev = exposure;
        window.settle();
        let shown = difference(&window);
        assert_eq!((shown.rmse, shown.mean), (0.0, 0.0), "{exposure} EV");
        let black = [[0; 3]; 64 * 48];
        assert!(difference_pixels(&window).rgb == black, "{exposure} EV");
        still_pixels(&window).assert_same(&picture_pixels(&window), "the snapshot");
    }
    assert!(
        picture_pixels(&window) != before,
        "the exposure has no effect"
    );
}

#[test]
fn a_snapshot_of_a_view_mode_is_shown_as_it_was() {
    use glimray::render::Integrator;
    let (_folder, mut window) = balls();
    window.session().view.settings.integrator = Integrator::Depth;
    window.settle();
    let before = picture_pixels(&window);
    keep(&mut window);
    window.session().view.settings.integrator = Integrator::Whitted;
    window.session().view.tone.exposure_ev += 1.0;
    compare(&mut window, Sharing::Wipe(0.5));
    still_pixels(&window).assert_same(&before, "the snapshot");
}

#[test]
fn a_snapshot_outlasts_edits_and_the_wipe_shows_it() {
    let (_folder, mut window) = balls();
    let before = picture_pixels(&window);
    keep(&mut window);
    window.session().edit("whiten", |scene| {
        scene.background = Background::Color(Vec3::ONE);
    });
    compare(&mut window, Sharing::Wipe(0.5));
    assert!(picture_pixels(&window) != before, "the edit has no effect");
    still_pixels(&window).assert_same(&before, "the snapshot");
    // Both ends of the row are background.
    assert_eq!(color_at(&mut window, 0.02), [255; 3]);
    let old = before.rgb[43 * 64];
    assert_eq!(color_at(&mut window, 0.98), old);
    // The snapshot of a region lies in its place.
    window.session().view.comparison = None;
    window.session().view.region = Some([0.5, 0.0, 1.0, 1.0]);
    window.settle();
    keep(&mut window);
    window.session().view.region = None;
    compare(&mut window, Sharing::Difference(ErrorMap::absolute(1.0)));
    assert_eq!(
        window
            .session()
            .still()
            .map(|still| still.name.clone())
            .as_deref(),
        Some("Snapshot 2")
    );
    assert_eq!(difference(&window).rmse, 0.0);
    let (still, picture) = (still_pixels(&window), picture_pixels(&window));
    let row = 24 * 64..25 * 64;
    assert_eq!(still.rgb[row.clone()][..32], [[0; 3]; 32]);
    assert_eq!(still.rgb[row.clone()][32..], picture.rgb[row][32..]);
}

#[test]
fn a_difference_of_two_view_modes_is_that_of_their_pixels() {
    let (_folder, mut window) = balls();
    window.harness.key_press(Key::Y);
    window.settle();
    let comparison = window.session().view.comparison.expect("a comparison");
    assert_eq!(comparison.error_map(), Some(ErrorMap::absolute(4.0)));
    let render = window.harness.state().render_thread();
    let beside = glimray_viewer::worker::progressive_image::PictureSlot::Beside;
    let beside = render.shown(beside).and_then(|shown| shown.screen);
    let beside = pixels::on(&beside.expect("a screen"), &window.gpu);
    let first = picture_pixels(&window);
    let mut squares = 0.0;
    let pairs = first.rgb.iter().zip(&beside.rgb);
    let expected: Vec<_> = pairs
        .map(|(a, b)| {
            [0, 1, 2].map(|channel| {
                let off = a[channel].abs_diff(b[channel]);
                squares += f64::from(off).powi(2);
                off.saturating_mul(4)
            })
        })
        .collect();
    assert!(difference_pixels(&window).rgb == expected);
    let rmse = (squares / (3.0 * 64.0 * 48.0)).sqrt() / 255.0;
    assert!(rmse > 0.1 && (difference(&window).rmse - rmse).abs() < 1e-9);
    let told = format!("RMSE {rmse:.4}");
    window.harness.get_by_label_contains(&told);
    window.harness.key_press(Key::Y);
    window.settle();
    assert_eq!(window.session().view.comparison, None);
}

#[test]
fn a_reference_of_another_size_is_scaled_to_the_pictures_height() {
    let folder = tempfile::tempdir().expect("a folder");
    let mut window = plain(folder.path(), "[1, 1, 1]");
    let path = reference(folder.path(), (32, 24), [51, 102, 153]);
    comparing::open_reference(&mut window.session(), path);
    window.settle();
    assert_eq!(still_pixels(&window).size, (32, 24));
    assert_eq!(color_at(&mut window, 0.75), [51, 102, 153]);
    assert_eq!(color_at(&mut window, 0.25), [255; 3]);
    compare(&mut window, Sharing::Difference(ErrorMap::absolute(1.0)));
    let white = difference_pixels(&window);
    assert_eq!(white.size, (64, 48));
    assert!(white.rgb.iter().all(|rgb| *rgb == [204, 153, 102]));
    let rmse = ((204_f64.powi(2) + 153_f64.powi(2) + 102_f64.powi(2)) / 3.0).sqrt() / 255.0;
    assert!((difference(&window).rmse - rmse).abs() < 1e-9);
    // The offered size makes the pixels match.
    window.harness.get_by_label("Render at 32×24").click();
    window.settle();
    assert_eq!(picture_pixels(&window).size, (32, 24));
    assert!(window.harness.query_by_label("Render at 32×24").is_none());
    // A narrower one leaves the sides out: 24 of 48 rows are 36 of 64 columns for 18×24.
    let path = reference(folder.path(), (18, 24), [0; 3]);
    comparing::open_reference(&mut window.session(), path);
    window.session().view.settings.size = (64, 48);
    window.settle();
    let (found, count) = (
        difference_pixels(&window),
        window.session().comparing.gallery.all().len(),
    );
    let row: Vec<_> = (0..64)
        .map(|x| u8::from((14..50).contains(&x)) * 255)
        .collect();
    let middle: Vec<_> = found.rgb[..64].iter().map(|rgb| rgb[0]).collect();
    assert_eq!(middle, row);
    assert!((difference(&window).rmse - 1.0).abs() < 1e-9);
    assert_eq!(count, 1, "a file that is opened again replaces its picture");
}

#[test]
fn radiance_from_a_file_is_developed_like_the_picture() {
    let folder = tempfile::tempdir().expect("a folder");
    let mut window = plain(folder.path(), "[0.25, 0.5, 4]");
    let path = folder.path().join("reference.exr");
    let radiance = ::image::Rgb32FImage::from_pixel(64, 48, ::image::Rgb([0.25, 0.5, 4.0]));
    radiance.save(&path).expect("an EXR");
    comparing::open_reference(&mut window.session(), path);
    compare(&mut window, Sharing::Difference(ErrorMap::absolute(1.0)));
    window.session().view.next_tone_curve();
    window.settle();
    assert_eq!(difference(&window).rmse, 0.0);
    still_pixels(&window).assert_same(&picture_pixels(&window), "the reference");
}

#[test]
fn a_reference_that_cannot_be_read_is_one_message_and_changes_nothing() {
    let (folder, mut window) = balls();
    keep(&mut window);
    compare(&mut window, Sharing::SideBySide);
    let before = window.session().view.comparison;
    let path = folder.path().join("broken.png");
    std::fs::write(&path, b"\x89PNG\r\n\x1a\nnothing").expect("a file");
    let count = messages(&window).len();
    comparing::open_reference(&mut window.session(), path.clone());
    window.settle();
    let told = messages(&window);
    assert_eq!(told.len(), count + 1, "{told:?}");
    let message = &told[count];
    assert!(message.starts_with("Cannot read the picture"), "{message}");
    for words in [
        path.to_str().expect("a name"),
        "Check that it was written completely",
    ] {
        assert!(message.contains(words), "{message}");
    }
    assert_eq!(window.session().view.comparison, before);
    assert_eq!(window.session().comparing.gallery.all().len(), 1);
}

#[test]
fn a_reference_is_chosen_in_a_dialog_or_typed() {
    let (folder, mut window) = balls();
    let path = reference(folder.path(), (64, 48), [9; 3]);
    let keys = Modifiers::COMMAND | Modifiers::SHIFT;
    let chosen = path.clone();
    let answer = move |request: glimray_viewer::model::file_dialog::Request| {
        assert!(!request.saves && request.kind.is_some(), "{request:?}");
        Reply::Chosen(chosen.clone())
    };
    window.session().files.dialogs = FileDialogs::answering(answer);
    window.harness.key_press_modifiers(keys, Key::O);
    window.settle();
    let comparison = window.session().view.comparison.expect("a comparison");
    assert!(matches!(comparison.sharing, Sharing::Wipe(_)));
    assert!(matches!(comparison.source, Source::Still(_)));
    // The scene is not changed, as it would be by an environment.
    assert!(!window.session().has_changes());
    window.harness.get_by_label("Remove").click();
    window.settle();
    assert_eq!(window.session().view.comparison, None);
    assert!(window.session().comparing.gallery.all().is_empty());

    window.session().files.dialogs = FileDialogs::answering(|_| Reply::Unavailable);
    window.harness.key_press_modifiers(keys, Key::O);
    window.settle();
    window.harness.get_by_label("Path").focus();
    window.harness.step();
    let text = path.display().to_string();
    window.harness.event(egui::Event::Text(text));
    window.harness.run_steps(2);
    window.harness.key_press(Key::Enter);
    window.settle();
    let still = window.session().still().map(|still| still.name.clone());
    assert_eq!(still.as_deref(), Some("reference.png"));
}

#[test]
fn a_full_gallery_refuses_another_snapshot() {
    let (_folder, mut window) = balls();
    for _ in 0..=MOST {
        keep(&mut window);
    }
    assert_eq!(window.session().comparing.gallery.all().len(), MOST);
    let told = messages(&window);
    assert!(
        told.iter().any(|text| text.contains("Remove one")),
        "{told:?}"
    );
}

#[test]
fn a_comparison_comes_back_after_a_flip_to_a_kept_picture() {
    use glimray::render::Integrator;
    let (_folder, mut window) = balls();
    keep(&mut window);
    let normals = Source::Integrator(Integrator::Normals);
    window.session().view.compare_with(normals);
    compare(&mut window, Sharing::SideBySide);
    let before = window.session().view.comparison;
    assert_eq!(before.map(|it| it.source), Some(normals));
    window.harness.key_press(Key::F6);
    window.settle();
    assert!(window.session().still().is_some(), "it is not flipped");
    window.harness.key_press(Key::F6);
    window.settle();
    assert_eq!(window.session().view.comparison, before);
    // One that has ended meanwhile does not come back.
    window.harness.key_press(Key::F6);
    window.settle();
    window.session().view.comparison = None;
    window.settle();
    for _ in 0..2 {
        window.harness.key_press(Key::F6);
        window.settle();
    }
    assert_eq!(window.session().view.comparison, None);
}

#[test]
fn the_histogram_tells_what_is_clipped_and_is_measured_once() {
    let folder = tempfile::tempdir().expect("a folder");
    let mut window = plain(folder.path(), "[1, 1, 1]");
    let told = |window: &Window| {
        let found = window.harness.query_all(by().label_contains("Histogram: "));
        let labels = found.filter_map(|node| node.accesskit_node().label());
        labels.collect::<Vec<_>>()
    };
    window.harness.get_by_label("Log").scroll_to_me();
    window.settle();
    let white = "Histogram: 0.0 % of the pixels are black, 100.0 % are clipped to white, mean luminance 100.0 %";
    assert_eq!(told(&window), [white]);
    window.harness.get_by_label("White 100.0 %");
    // Nothing is measured while nothing changes.
    window.session().histogram.latest = None;
    for _ in 0..8 {
        window.harness.step();
    }
    window.settle();
    assert!(
        window.session().histogram.latest.is_none(),
        "measured again"
    );
    assert_eq!(window.session().until_next_frame(), None);
    // Another exposure is another picture: 2⁻⁶⁴ of white is black.
    window.session().view.tone.exposure_ev = -64.0;
    window.settle();
    let black = "Histogram: 100.0 % of the pixels are black, 0.0 % are clipped to white, mean luminance 0.0 %";
    assert_eq!(told(&window), [black]);
}

#[test]
fn a_snapshot_of_a_denoised_picture_is_denoised_and_it_compares_with_the_raw_one() {
    use glimray::render::Integrator;
    use glimray_viewer::worker::progressive_image::PictureSlot;
    let (_folder, mut window) = balls();
    {
        let mut session = window.session();
        session.view.settings.integrator = Integrator::Path;
        session.view.set_samples(4);
        session.view.settings.features = true;
    }
    window.settle();
    let raw = picture_pixels(&window);
    window.session().view.tone.denoise = true;
    window.settle();
    let denoised = picture_pixels(&window);
    assert!(denoised != raw, "denoising has no effect");
    keep(&mut window);
    let detail = window.session().comparing.gallery.all()[0].detail.clone();
    assert!(detail.ends_with("denoised"), "{detail}");
    compare(&mut window, Sharing::Difference(ErrorMap::absolute(100.0)));
    let shown = difference(&window);
    assert_eq!((shown.rmse, shown.mean), (0.0, 0.0));
    still_pixels(&window).assert_same(&denoised, "the snapshot");

    window.session().view.compare_with(Source::Raw);
    window.settle();
    let render = window.harness.state().render_thread();
    let beside = render.shown(PictureSlot::Beside).expect("a picture");
    let screen = beside.screen.expect("a screen");
    pixels::on(&screen, &window.gpu).assert_same(&raw, "the picture without denoising");
    picture_pixels(&window).assert_same(&denoised, "the picture");
    assert!(difference(&window).rmse > 0.0);
}
