//! The picture panel: the pixel under the cursor, pixel zoom, and the room that the picture fills.

use super::edit;
use super::pixels;
use crate::harness::Window;
use eframe::egui::{
    Event, Key, Modifiers, MouseWheelSource, MouseWheelUnit, Pos2, Rect, TouchPhase, pos2, vec2,
};
use egui_kittest::kittest::Queryable;
use glam::{DVec3, dvec2};
use glimray_viewer::actions::files::pictures;
use glimray_viewer::model::viewport::{PixelZoom, Viewport};
use glimray_viewer::state::files::SaveSize;

/// Moves the cursor to a pixel's centre and waits until it is known what is there.
fn rest_on(window: &mut Window, [x, y]: [u32; 2]) {
    let viewport = window.session().viewport.expect("a picture");
    let at = viewport.point(dvec2(f64::from(x) + 0.5, f64::from(y) + 0.5));
    window.harness.hover_at(at);
    window.settle();
}

#[test]
fn the_status_bar_tells_colour_object_and_distance_of_the_pixel_under_the_cursor() {
    let (_folder, path) = edit::file();
    let mut window = edit::open(&path, "65x49");
    window.settle();
    rest_on(&mut window, [21, 24]);
    let screen = window.shown().screen.expect("a screen");
    let rgb = pixels::on(&screen, &window.gpu).rgb[24 * 65 + 21];
    assert!(rgb[0] > rgb[2], "not the red ball: {rgb:?}");

    // A sphere of radius 0.75 round (−1, 0, 0), seen from (0, 0, 8) with 30° from bottom to top.
    let half = 8.0 * 15_f64.to_radians().tan() * 65.0 / 49.0;
    let direction = DVec3::new((21.5 / 65.0 * 2.0 - 1.0) * half, 0.0, -8.0).normalize();
    let to_center = DVec3::new(-1.0, 0.0, -8.0);
    let along = to_center.dot(direction);
    let expected = along - (0.75_f64.powi(2) - to_center.length_squared() + along * along).sqrt();

    let probe = window.session().cursor.current().cloned();
    let probe = probe.expect("an answer");
    assert_eq!(probe.rgb, Some(rgb));
    let surface = probe.surface.expect("a surface");
    assert_eq!(surface.object, "sphere 1 (red)");
    assert!(
        (surface.distance - expected).abs() < 1e-4,
        "{} and {expected}",
        surface.distance
    );
    let [r, g, b] = rgb;
    let text = format!("x 21, y 24  RGB {r} {g} {b}  sphere 1 (red)  distance 7.3");
    window.harness.get_by_label_contains(&text);

    rest_on(&mut window, [0, 0]);
    let probe = window.session().cursor.current().cloned();
    let probe = probe.expect("an answer");
    assert_eq!(probe.surface, None);
    let [r, g, b] = probe.rgb.expect("a colour");
    let text = format!("x 0, y 0  RGB {r} {g} {b}  Background");
    window.harness.get_by_label(&text);
    window.harness.hover_at(pos2(4.0, 690.0));
    window.settle();
    assert!(window.harness.query_by_label_contains("RGB").is_none());
}

#[test]
fn a_resting_cursor_asks_once() {
    let mut window = Window::open(&["--size", "64x48", "--samples", "1"]);
    window.settle();
    rest_on(&mut window, [32, 24]);
    let first = window.session().cursor.probe.take();
    assert!(first.is_some(), "no answer");
    for _ in 0..8 {
        window.harness.step();
    }
    window.settle();
    assert_eq!(window.session().cursor.probe, None, "asked again");
    window.session().view.tone.exposure_ev -= 2.0;
    window.settle();
    let darker = window.session().cursor.probe.clone();
    let sum = |probe: Option<glimray_viewer::state::cursor::Probe>| {
        let rgb = probe.and_then(|probe| probe.rgb).expect("a colour");
        rgb.map(u32::from).iter().sum::<u32>()
    };
    assert!(sum(darker) < sum(first), "the colour is not the new one");
}

#[test]
fn pixel_zoom_keeps_its_point_and_ends_where_it_began() {
    let space = Rect::from_min_size(pos2(100.0, 50.0), vec2(640.0, 480.0));
    let fitted = Viewport::fitting(space, (640, 480), 1.0);
    let mut zoom = PixelZoom::default();
    assert_eq!(zoom.of(fitted), fitted);
    let point = pos2(260.0, 170.0);
    let before = fitted.position(point);
    for _ in 0..6 {
        let now = zoom.of(fitted);
        let share = now.position(point) / now.extent();
        zoom.zoom(1.0, eframe::egui::vec2(share.x as f32, share.y as f32));
    }
    let magnified = zoom.of(fitted);
    assert!((magnified.rect.width() - 8.0 * 640.0).abs() < 0.1);
    assert!((magnified.position(point) - before).length() < 0.01);
    zoom.zoom(100.0, vec2(1.0, 1.0));
    assert_eq!(zoom.scale(), PixelZoom::MAX);
    // Room beside the picture is never seen.
    assert!(zoom.of(fitted).rect.expand(0.1).contains_rect(space));
    zoom.zoom(-100.0, vec2(0.25, 0.75));
    assert_eq!(zoom, PixelZoom::default());
}

#[test]
fn the_wheel_with_alt_magnifies_pixels_and_a_key_resets_them() {
    let mut window = Window::open(&["--size", "64x48", "--samples", "1"]);
    window.settle();
    let fitted = window.session().viewport.expect("a picture");
    let camera = window.camera();
    let at: Pos2 = fitted.point(dvec2(16.0, 12.0));
    window.harness.hover_at(at);
    window.harness.step();
    window.harness.event(Event::MouseWheel {
        unit: MouseWheelUnit::Line,
        delta: vec2(0.0, 4.0),
        phase: TouchPhase::Move,
        source: MouseWheelSource::Wheel,
        modifiers: Modifiers::ALT,
    });
    window.settle();
    let magnified = window.session().viewport.expect("a picture");
    assert_eq!(magnified.rect.width(), 4.0 * fitted.rect.width());
    assert!((magnified.position(at) - dvec2(16.0, 12.0)).length() < 0.01);
    assert_eq!(window.camera(), camera, "the camera has moved");
    assert_eq!(window.shown().size, (64, 48), "rendered at another size");
    window.harness.get_by_label("400 %");
    window
        .harness
        .key_press_modifiers(Modifiers::ALT, Key::Home);
    window.settle();
    assert_eq!(window.session().viewport, Some(fitted));
}

#[test]
fn a_picture_worth_keeping_fills_other_room_scaled_until_it_is_rendered_to_fit() {
    let mut window = Window::open(&["--samples", "1"]);
    window.settle();
    let kept = window.shown().size;
    // The thread that renders says how much this took; the next frames must not.
    let space = (kept.0 - 200, kept.1 - 100);
    window.session().set_spent(60.0);
    window.session().set_space(space);
    assert_eq!(window.session().picture_size(), kept);
    assert!(window.session().is_scaled_to_room());
    window.session().take_room();
    assert_eq!(window.session().picture_size(), space);
    assert!(!window.session().is_scaled_to_room());

    let room = Rect::from_min_size(pos2(0.0, 0.0), vec2(1000.0, 800.0));
    let filling = Viewport::filling(room, (500, 300), 1.0);
    assert_eq!(filling.rect.size(), vec2(1000.0, 600.0));
    let fitting = Viewport::fitting(room, (500, 300), 1.0);
    assert_eq!(fitting.rect.size(), vec2(500.0, 300.0));
    // A picture of other proportions lies there with its own, as high as the new one.
    let under = fitting.under((300, 300));
    assert_eq!(under.size(), vec2(300.0, 300.0));
    assert_eq!(under.center(), fitting.rect.center());
    // A coarse one is rounded up to whole pixels.
    assert_eq!(fitting.under((72, 43)), fitting.rect);
}

/// The balls in a scene of 40 × 30 pixels with two samples.
fn small() -> (tempfile::TempDir, std::path::PathBuf) {
    let (folder, path) = edit::file();
    let text = std::fs::read_to_string(&path).expect("a scene");
    let text = text + "\n[output]\nsize = [40, 30]\nsamples = 2\n";
    std::fs::write(&path, text).expect("a file");
    (folder, path)
}

#[test]
fn a_picture_that_is_rendered_for_a_file_can_be_given_up() {
    let (folder, scene) = small();
    let mut window = Window::open(&[scene.to_str().expect("a path in UTF-8")]);
    window.settle();
    window.session().view.paused = true;
    window.session().view.set_samples(65_536);
    let path = folder.path().join("never.png");
    {
        let mut session = window.session();
        pictures::open(&mut session, false);
        let dialog = session.files.saving.as_mut().expect("a sheet");
        dialog.path = path.display().to_string();
        dialog.size = SaveSize::Twice;
        pictures::save(&mut session, false);
        assert!(session.files.waits_to_save());
    }
    window.harness.run_steps(3);
    window.session().files.jobs.cancel_lasting();
    window.settle();
    assert!(!window.session().files.waits_to_save());
    assert!(!path.exists());
}

#[test]
fn the_scenes_frame_has_its_proportions_and_the_pictures_height() {
    let room = Rect::from_min_size(pos2(0.0, 0.0), vec2(900.0, 300.0));
    let viewport = Viewport::fitting(room, (900, 300), 1.0);
    let frame = viewport.framing((40, 30));
    assert_eq!(
        frame,
        Rect::from_min_size(pos2(250.0, 0.0), vec2(400.0, 300.0))
    );
    // The line is drawn where the scene's picture ends.
    let (_folder, scene) = small();
    let text = std::fs::read_to_string(&scene).expect("a scene");
    std::fs::write(&scene, text.replace("[40, 30]", "[30, 60]")).expect("a file");
    let mut window = Window::open(&[scene.to_str().expect("a path in UTF-8")]);
    window.settle();
    let viewport = window.session().viewport.expect("a picture");
    let line = viewport.framing((30, 60)).left_center();
    for is_shown in [true, false] {
        window.session().shows_overlays = is_shown;
        window.harness.run_steps(2);
        let image = window.harness.render().expect("a picture of the window");
        let (x, y) = (line.x.round() as u32, line.y.round() as u32);
        let is_light = |x| {
            image.get_pixel(x, y).0[..3]
                .iter()
                .all(|level| *level > 120)
        };
        assert_eq!(
            (x - 1..=x + 1).any(is_light),
            is_shown,
            "overlays: {is_shown}"
        );
    }
}
