//! The handles by which a hand moves, turns and scales things: what a drag of so many pixels does.

use crate::support::verdict::Verdict;
use glam::{DAffine3, DMat3, DQuat, DVec2, DVec3, dvec2, dvec3};
use glimray::scene::Camera;
use glimray_viewer::model::handles::{
    Eye, Grip, Handles, Part, angle_between, nearest_on_line, on_plane,
};
use glimray_viewer::model::objects::{Freedom, Scaling};
use glimray_viewer::model::snapping::Snap;
use glimray_viewer::model::tool::Tool;
use std::f64::consts::{FRAC_PI_2, PI};

const SIZE: DVec2 = DVec2::new(400.0, 300.0);
const FREE: Freedom = Freedom {
    translate: true,
    rotate: true,
    scale: Scaling::Uneven,
};
/// How long handles are, in pixels.
const LENGTH: f64 = 80.0;

/// Along −z from a distance of 10, with a field of view of 60°.
fn ahead() -> Camera {
    Camera {
        look_from: dvec3(0.0, 0.0, 10.0),
        look_at: DVec3::ZERO,
        ..Camera::default()
    }
}

/// From somewhere above.
fn aslant() -> Camera {
    Camera {
        look_from: dvec3(4.0, 3.0, 6.0),
        look_at: DVec3::ZERO,
        ..Camera::default()
    }
}

fn eye(camera: &Camera) -> Eye<'_> {
    Eye { camera, size: SIZE }
}

fn handles(tool: Tool, place: DAffine3, camera: &Camera) -> Handles {
    Handles::new(tool, place, FREE, eye(camera), LENGTH).expect("handles")
}

/// The place after a drag of a handle from one point to another.
fn drag(
    tool: Tool,
    part: Part,
    place: DAffine3,
    camera: &Camera,
    from: DVec2,
    moved: DVec2,
    snap: Snap,
) -> DAffine3 {
    let mut grip = Grip::new(part, handles(tool, place, camera), place, from);
    grip.move_pointer(moved, false);
    grip.dragged(eye(camera), snap).expect("a place").place
}

#[test]
fn a_line_is_nearest_to_a_ray_where_both_are_perpendicular_to_the_way_between() {
    let axis = dvec3(0.3, -0.5, 0.8).normalize();
    let point = dvec3(1.0, 2.0, -3.0);
    let from = dvec3(-4.0, 1.0, 2.0);
    let direction = dvec3(0.7, 0.1, -0.6).normalize();
    let s = nearest_on_line((from, direction), point, axis).expect("a point");
    let on_line = point + axis * s;
    let t = (on_line - from).dot(direction);
    let way = on_line - (from + direction * t);
    assert!(way.dot(axis).abs() < 1e-12 && way.dot(direction).abs() < 1e-12);
    assert_eq!(nearest_on_line((from, axis), point, axis), None);
}

#[test]
fn a_plane_is_met_ahead_only() {
    let met = on_plane((DVec3::ZERO, DVec3::Z), dvec3(5.0, 5.0, 2.0), DVec3::Z);
    assert_eq!(met, Some(dvec3(0.0, 0.0, 2.0)));
    assert_eq!(
        on_plane((DVec3::ZERO, DVec3::Z), dvec3(0.0, 0.0, -2.0), DVec3::Z),
        None
    );
    assert_eq!(
        on_plane((DVec3::ZERO, DVec3::X), dvec3(0.0, 0.0, 2.0), DVec3::Z),
        None
    );
}

#[test]
fn angles_have_the_sign_of_the_right_hand() {
    assert!((angle_between(DVec3::X, DVec3::Y, DVec3::Z) - FRAC_PI_2).abs() < 1e-15);
    assert!((angle_between(DVec3::Y, DVec3::X, DVec3::Z) + FRAC_PI_2).abs() < 1e-15);
    assert!((angle_between(DVec3::Z, DVec3::X, DVec3::Y) - FRAC_PI_2).abs() < 1e-15);
}

#[test]
fn what_an_arrow_moves_stays_under_the_hand() {
    let mut verdict = Verdict::on("arrows");
    for (name, camera) in [("ahead", ahead()), ("aslant", aslant())] {
        let eye = eye(&camera);
        for (axis, way) in DVec3::AXES.into_iter().enumerate() {
            let place = DAffine3::from_translation(dvec3(0.3, -0.2, 0.5));
            let at = |by: f64| eye.project(place.translation + way * by).expect("ahead");
            if at(0.0).distance(at(1.0)) < 10.0 {
                continue;
            }
            // The hand goes along the arrow as the picture shows it.
            let moved = at(1.2) - at(0.5);
            let now = drag(
                Tool::Move,
                Part::Axis(axis),
                place,
                &camera,
                at(0.5),
                moved,
                Snap::Off,
            );
            let expected = place.translation + way * 0.7;
            let off = now.translation.distance(expected);
            verdict.that(format!("{name}, axis {axis}"), off < 1e-9, || {
                format!("{off} from where the hand is")
            });
        }
    }
    verdict.close();
}

#[test]
fn what_a_plane_moves_stays_under_the_hand() {
    let camera = aslant();
    let eye = eye(&camera);
    let place = DAffine3::from_translation(dvec3(0.3, -0.2, 0.5));
    let to = place.translation + dvec3(0.4, 0.0, -0.25);
    let [from, to] = [place.translation, to].map(|point| eye.project(point).expect("ahead"));
    let now = drag(
        Tool::Move,
        Part::Plane(1),
        place,
        &camera,
        from,
        to - from,
        Snap::Off,
    );
    assert!(
        now.translation.distance(dvec3(0.7, -0.2, 0.25)) < 1e-9,
        "{now}"
    );
}

#[test]
fn a_ring_that_faces_the_camera_turns_by_the_angle_in_the_picture() {
    let camera = ahead();
    let middle = SIZE / 2.0;
    // From the right to the top: counter-clockwise by a quarter.
    let from = middle + dvec2(LENGTH, 0.0);
    let moved = dvec2(-LENGTH, -LENGTH);
    let start = DAffine3::from_scale(dvec3(1.0, 2.0, 3.0));
    for part in [Part::Ring(2), Part::All] {
        let now = drag(Tool::Rotate, part, start, &camera, from, moved, Snap::Off);
        let expected = DMat3::from_rotation_z(FRAC_PI_2) * start.matrix3;
        assert!(now.matrix3.abs_diff_eq(expected, 1e-9), "{part:?}: {now}");
    }
}

#[test]
fn a_ring_seen_from_its_edge_is_rolled() {
    let camera = ahead();
    // The front of the ring about y goes to the right with the hand, by as much as the ring is long.
    let eye = eye(&camera);
    let reach = eye.pixel_at(DVec3::ZERO) * LENGTH;
    let now = drag(
        Tool::Rotate,
        Part::Ring(1),
        DAffine3::IDENTITY,
        &camera,
        SIZE / 2.0,
        dvec2(LENGTH / 2.0, 0.0),
        Snap::Off,
    );
    let front = now.transform_vector3(DVec3::Z);
    assert!(
        (front.x - 0.5_f64.sin()).abs() < 1e-9,
        "{front}, reach {reach}"
    );
}

#[test]
fn a_box_scales_along_the_own_axis_only() {
    let camera = ahead();
    let turn = DQuat::from_rotation_z(PI / 6.0);
    let start = DAffine3::from_scale_rotation_translation(dvec3(2.0, 1.0, 1.0), turn, DVec3::ZERO);
    let eye = eye(&camera);
    let along = turn * DVec3::X;
    let at = |by: f64| eye.project(along * by).expect("ahead");
    let (from, moved) = (at(0.8), at(1.2) - at(0.8));
    let now = drag(
        Tool::Scale,
        Part::Axis(0),
        start,
        &camera,
        from,
        moved,
        Snap::Off,
    );
    let expected = start.matrix3 * DMat3::from_diagonal(dvec3(1.5, 1.0, 1.0));
    assert!(now.matrix3.abs_diff_eq(expected, 1e-9), "{now}");
    assert_eq!(now.translation, start.translation);
}

#[test]
fn the_middle_scales_evenly_and_never_to_nothing() {
    let camera = ahead();
    let start = DAffine3::IDENTITY;
    let scale = |moved| {
        let now = drag(
            Tool::Scale,
            Part::All,
            start,
            &camera,
            SIZE / 2.0,
            moved,
            Snap::Off,
        );
        now.matrix3
    };
    let doubled = DMat3::from_diagonal(DVec3::splat(2.0));
    assert!(scale(dvec2(LENGTH, 0.0)).abs_diff_eq(doubled, 1e-9));
    assert!(scale(dvec2(-10.0 * LENGTH, 0.0)).determinant() > 0.0);
}

#[test]
fn steps_are_whole_with_snapping_and_a_tenth_when_fine() {
    let camera = ahead();
    let pixel = 2.0 * 10.0 * (PI / 6.0).tan() / SIZE.y;
    let start = DAffine3::IDENTITY;
    let middle = SIZE / 2.0;
    let now = drag(
        Tool::Move,
        Part::Axis(0),
        start,
        &camera,
        middle,
        dvec2(0.7 / pixel, 0.0),
        Snap::Whole,
    );
    // Handles are 80 pixels long, which is about 3 units: steps of 1.
    assert!((now.translation.x - 1.0).abs() < 1e-9, "{now}");
    let place = handles(Tool::Move, start, &camera);
    let mut grip = Grip::new(Part::Axis(0), place, start, middle);
    grip.move_pointer(dvec2(100.0, 0.0), true);
    let fine = grip
        .dragged(eye(&camera), Snap::Off)
        .expect("a place")
        .place;
    assert!((fine.translation.x - 10.0 * pixel).abs() < 1e-9, "{fine}");
}

#[test]
fn the_handle_under_the_pointer_is_the_one_that_is_taken() {
    let camera = ahead();
    let eye = eye(&camera);
    let middle = SIZE / 2.0;
    let moves = handles(Tool::Move, DAffine3::IDENTITY, &camera);
    let mut verdict = Verdict::on("handles under the pointer");
    for (name, at, part) in [
        ("on the x arrow", dvec2(60.0, 2.0), Some(Part::Axis(0))),
        // The squares with z are seen from their edges here: they leave the arrows to the hand.
        (
            "exactly on the x arrow",
            dvec2(60.0, 0.0),
            Some(Part::Axis(0)),
        ),
        ("nearer to its root", dvec2(30.0, 0.0), Some(Part::Axis(0))),
        ("on the y arrow", dvec2(-3.0, -70.0), Some(Part::Axis(1))),
        ("in the middle", dvec2(2.0, 1.0), Some(Part::All)),
        (
            "in the square of x and y",
            dvec2(30.0, -30.0),
            Some(Part::Plane(2)),
        ),
        ("beside all", dvec2(-50.0, 50.0), None),
    ] {
        let found = moves.part_at(eye, middle + at, 6.0);
        verdict.that(name, found == part, || format!("{found:?}"));
    }
    let rings = handles(Tool::Rotate, DAffine3::IDENTITY, &camera);
    let on_ring = middle + dvec2(LENGTH, LENGTH) * 0.5_f64.sqrt();
    let found = rings.part_at(eye, on_ring, 6.0);
    verdict.that("on the ring about z", found == Some(Part::Ring(2)), || {
        format!("{found:?}")
    });
    verdict.close();
}

#[test]
fn there_are_handles_only_for_what_is_free_and_in_front() {
    let camera = ahead();
    let fixed = Freedom {
        translate: false,
        rotate: false,
        scale: Scaling::None,
    };
    let place = DAffine3::IDENTITY;
    for tool in [Tool::Move, Tool::Rotate, Tool::Scale] {
        assert_eq!(Handles::new(tool, place, fixed, eye(&camera), LENGTH), None);
        let behind = DAffine3::from_translation(dvec3(0.0, 0.0, 11.0));
        assert_eq!(Handles::new(tool, behind, FREE, eye(&camera), LENGTH), None);
    }
    let even = Freedom {
        scale: Scaling::Even,
        ..FREE
    };
    let found = Handles::new(Tool::Scale, place, even, eye(&camera), LENGTH).expect("one");
    assert_eq!(found.parts, [Part::All]);
}
