//! The outline of the selection along the pixels that show it.

use super::edit::{BLUE, RED, file, on_screen, open};
use crate::harness::Window;
use crate::reference::compare::render;
use eframe::egui::{Key, Pos2};
use glam::{DVec2, DVec3, dvec2, dvec3};
use glimray::render::Tone;
use glimray::scene::ObjectRef;
use glimray_viewer::actions::sight;
use glimray_viewer::model::objects::Id;
use glimray_viewer::model::sight::{Sight, contours};
use glimray_viewer::state::sight::Silhouettes;
use std::f64::consts::TAU;
use std::sync::Arc;

const SIZE: (u32, u32) = (400, 300);

fn silhouettes(window: &Window) -> Arc<Silhouettes> {
    let mut session = window.session();
    let selected = session.selected();
    sight::silhouettes(&mut session, &selected).expect("it is known what the pixels show")
}

/// The direction through a place in the picture of a camera at (0, 0, 8) that looks along −z with a field of view of 30°.
fn direction(at: DVec2) -> DVec3 {
    let half = dvec2(SIZE.0.into(), SIZE.1.into()) / 2.0;
    let off = (at - half) / half.y * 15_f64.to_radians().tan();
    dvec3(off.x, -off.y, -1.0).normalize()
}

/// How far outside of the disc of a ball of radius 0.75 a place in the picture is, in pixels, and the angle at which it lies
/// around the middle. Rays that touch the ball form a cone.
fn off_disc(at: DVec2, center: DVec3) -> (f64, f64) {
    let way = center - dvec3(0.0, 0.0, 8.0);
    let cone = (0.75 / way.length()).asin();
    let ray = direction(at);
    let angle = ray.angle_between(way);
    // A pixel in the middle of the picture is this wide; elsewhere it is narrower.
    let pixel = 15_f64.to_radians().tan() / (f64::from(SIZE.1) / 2.0);
    let side = ray - way.normalize();
    ((angle - cone) / pixel, side.y.atan2(side.x))
}

#[test]
fn the_outline_of_a_ball_is_the_disc_that_it_is_projected_to() {
    let (_folder, path) = file();
    let mut window = open(&path, "400x300");
    window.session().select(vec![RED]);
    window.settle();
    let found = silhouettes(&window);
    assert!(found.others.is_empty() && found.hidden.is_empty());
    assert_eq!(found.lead.len(), 1, "one closed line");
    let line = &found.lead[0];
    assert_eq!(line.first(), line.last(), "it is open");
    let mut seen = [false; 24];
    for ends in line.windows(2) {
        // Between points too.
        for share in [0.0, 0.25, 0.5, 0.75] {
            let (off, around) = off_disc(ends[0].lerp(ends[1], share), dvec3(-1.0, 0.0, 0.0));
            assert!(off.abs() < 1.0, "{off} pixels off the disc");
            let sector = (around / TAU).rem_euclid(1.0) * 24.0;
            seen[(sector as usize).min(23)] = true;
        }
    }
    assert_eq!(seen, [true; 24], "it does not go all the way round");

    // So it is drawn: at the edge of the disc, and not at the corner of a box around the ball.
    let picture = window.harness.render().expect("a picture of the window");
    let is_orange = |at: Pos2| {
        let near = (-2..=2).flat_map(|dx| (-2..=2).map(move |dy| (dx, dy)));
        near.into_iter().any(|(dx, dy)| {
            let (x, y) = ((at.x as i32 + dx) as u32, (at.y as i32 + dy) as u32);
            let [red, green, blue, _] = picture.get_pixel(x, y).0;
            red > 210 && green > 120 && green < 220 && blue < 120
        })
    };
    let viewport = window.session().viewport.expect("a picture");
    assert!(is_orange(viewport.point(line[0])));
    let corner = on_screen(&window, dvec3(-1.75, 0.75, 0.75));
    assert!(!is_orange(corner), "there is a box");
}

#[test]
fn the_lead_and_the_others_have_lines_of_their_own() {
    let (_folder, path) = file();
    let mut window = open(&path, "400x300");
    window.session().select(vec![BLUE, RED]);
    window.settle();
    let found = silhouettes(&window);
    for (lines, center) in [(&found.lead, 1.0), (&found.others, -1.0)] {
        assert_eq!(lines.len(), 1);
        for at in &lines[0] {
            let (off, _) = off_disc(*at, dvec3(center, 0.0, 0.0));
            assert!(off.abs() < 1.0, "{off} pixels off the disc at {center}");
        }
    }
}

#[test]
fn what_lies_before_the_selection_is_not_outlined_and_what_is_hidden_is_known() {
    let (_folder, path) = file();
    let text = std::fs::read_to_string(&path).expect("a scene");
    // The blue ball is larger, and before a part of the red one.
    let before = "center = [1, 0, 0], radius = 0.75";
    let partly = text.replace(before, "center = [0.2, 0, 2], radius = 0.75");
    std::fs::write(&path, partly).expect("a file");
    let mut window = open(&path, "400x300");
    window.session().select(vec![RED]);
    window.settle();
    let found = silhouettes(&window);
    assert!(found.hidden.is_empty());
    let way = dvec3(0.2, 0.0, 2.0) - dvec3(0.0, 0.0, 8.0);
    let cone = (0.75 / way.length()).asin();
    let pixel = 15_f64.to_radians().tan() / 150.0;
    for at in found.lead.iter().flatten() {
        let inside = (cone - direction(*at).angle_between(way)) / pixel;
        assert!(inside < 1.0, "{inside} pixels within the ball before it");
    }
    let shared = found.lead.iter().flatten().filter(|at| {
        let off = (cone - direction(**at).angle_between(way)) / pixel;
        off.abs() < 1.0
    });
    assert!(
        shared.count() > 3,
        "the line does not follow the ball before it"
    );

    let all = text.replace(before, "center = [-0.75, 0, 2], radius = 0.75");
    std::fs::write(&path, all).expect("a file");
    let mut window = open(&path, "400x300");
    window.session().select(vec![RED]);
    window.settle();
    let found = silhouettes(&window);
    assert_eq!(found.hidden, [RED]);
    assert!(found.lead.is_empty());
}

#[test]
fn an_outline_follows_a_ball_that_was_moved_and_the_camera() {
    let (_folder, path) = file();
    let mut window = open(&path, "400x300");
    window.session().select(vec![RED]);
    window.settle();
    window.session().change("move", |scene| {
        let place = glam::DAffine3::from_translation(dvec3(-0.5, 0.5, 0.0))
            * glam::DAffine3::from_scale(DVec3::splat(0.75));
        glimray_viewer::model::objects::set_place(scene, RED, place, 0.0)
    });
    let moved = |window: &Window| {
        let found = silhouettes(window);
        let (off, _) = off_disc(found.lead[0][0], dvec3(-0.5, 0.5, 0.0));
        off.abs()
    };
    window.settle();
    assert!(moved(&window) < 1.0, "{} pixels off", moved(&window));
    // A material leaves all outlines where they are, at once.
    let before = silhouettes(&window);
    window.session().change("dim", |scene| {
        scene.materials[0].emission.x = 0.5;
        Ok(())
    });
    assert!(Arc::ptr_eq(&before, &silhouettes(&window)));
    for _ in 0..3 {
        window.harness.key_press(Key::ArrowLeft);
        window.settle();
    }
    let off = moved(&window);
    assert!(off > 2.0, "the outline stays although the camera has moved");
}

#[test]
fn a_picture_that_is_looked_at_while_it_refines_keeps_its_pixels() {
    let (_folder, path) = file();
    let arguments = [
        path.to_str().expect("UTF-8"),
        "--size",
        "400x300",
        "--samples",
        "64",
    ];
    let mut window = Window::open(&arguments);
    let mut looks = 0;
    for round in 0..10_000 {
        window
            .session()
            .select(vec![if round % 2 == 0 { RED } else { BLUE }]);
        // Each answer is asked for anew.
        looks += u32::from(window.session().sight.latest.take().is_some());
        window.harness.step();
        if looks > 3 && window.harness.state().is_settled() {
            break;
        }
    }
    assert!(looks > 3, "only {looks} answers");
    window.settle();
    let scene = super::edit::scene(&window);
    let (expected, _) = render(&scene, &window.request().settings);
    assert!(window.image(Tone::LINEAR) == expected, "other pixels");
}

/// A picture of letters: each letter is an object.
fn letters(rows: &[&str]) -> Sight {
    let size = (rows[0].len() as u32, rows.len() as u32);
    let seen = rows.concat().into_bytes().into_iter().map(|letter| {
        let object = (letter != b' ').then(|| ObjectRef::Shape((letter - b'a').into()));
        (object, f32::from(letter))
    });
    Sight::new(size, 1, seen)
}

#[test]
fn what_a_rectangle_of_pixels_shows_is_listed_once() {
    let sight = letters(&["aab ", "acb ", "  bd"]);
    let objects = |a: (f64, f64), b: (f64, f64)| -> Vec<_> {
        let found = sight.objects_in(a.into(), b.into());
        found.into_iter().map(Id::Object).collect()
    };
    let shape = |index| Id::Object(ObjectRef::Shape(index));
    assert_eq!(objects((0.0, 0.0), (0.9, 2.9)), [shape(0)]);
    // From any corner, and beyond the picture.
    assert_eq!(objects((2.5, 1.5), (1.5, 1.5)), [shape(1), shape(2)]);
    assert_eq!(objects((3.5, 2.5), (90.0, 90.0)), [shape(3)]);
    assert_eq!(objects((-9.0, -9.0), (-1.0, 9.0)), []);
    // Three pixels of the first, and three of the second.
    assert_eq!(sight.objects(), [0, 1, 2, 3].map(ObjectRef::Shape));
    let larger = letters(&["abb"]);
    assert_eq!(larger.objects(), [1, 0].map(ObjectRef::Shape));
}

#[test]
fn lines_end_at_the_border_and_pixels_that_touch_at_a_corner_keep_their_own() {
    let sight = letters(&["a   ", " a  ", "   a"]);
    let lines = |index| sight.silhouettes(|object| object == ObjectRef::Shape(index));
    // One in the corner has two sides within the picture, the next one four, the last two.
    let mut lengths: Vec<usize> = lines(0).iter().map(Vec::len).collect();
    lengths.sort_unstable();
    assert_eq!(lengths, [2, 2, 5]);
    assert_eq!(lines(1), Vec::<Vec<DVec2>>::new());
    // Half a picture: a straight line from border to border.
    let half: Vec<u32> = (0..48).map(|index| u32::from(index % 8 < 4)).collect();
    let found = contours(&half, glam::uvec2(8, 6));
    assert_eq!(found.len(), 1);
    assert!(found[0].iter().all(|at| (at.x - 4.0).abs() < 1e-9));
    let rows: Vec<f64> = found[0].iter().map(|at| at.y).collect();
    assert!(rows[0].min(rows[rows.len() - 1]) == 0.5, "{rows:?}");
    assert!(rows[0].max(rows[rows.len() - 1]) == 5.5, "{rows:?}");
    // Neighbours each have their whole outline: two more sides in the middle of each row.
    let both = letters(&["    ", " ab ", "    "]);
    assert_eq!(both.silhouettes(|_| true).len(), 2);
}
