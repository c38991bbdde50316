//! The viewer's camera against the geometry of a picture.

use crate::support::random::Random;
use glam::{DVec2, DVec3, dvec2, dvec3};
use glimray::scene::{Camera, Lens};
use glimray_viewer::model::camera::{CameraController, Flight, Side, project, ray_through};
use std::f64::consts::{FRAC_PI_2, PI};

const SIZE: DVec2 = dvec2(640.0, 480.0);
const BOX: (DVec3, DVec3) = (dvec3(-1.0, -2.0, -3.0), dvec3(3.0, 2.0, 1.0));

fn camera() -> Camera {
    Camera {
        name: "main".to_owned(),
        look_from: dvec3(3.1, 2.3, 7.7),
        look_at: dvec3(0.1, 0.2, -0.3),
        up: dvec3(0.0, 3.0, 0.0),
        fov_y: 0.7,
        ..Camera::default()
    }
}

fn parallel() -> Camera {
    Camera {
        orthographic_height: Some(6.5),
        ..camera()
    }
}

fn rig(camera: &Camera) -> CameraController {
    CameraController::new(camera, Some(BOX))
}

/// Lets a minute go by.
fn settled(mut rig: CameraController) -> Camera {
    for _ in 0..600 {
        rig.advance(0.1);
    }
    assert!(!rig.is_moving());
    rig.camera()
}

/// Pixels from the upper left corner, and the depth, by the textbook.
fn image(camera: &Camera, p: DVec3) -> DVec3 {
    let forward = (camera.look_at - camera.look_from).normalize();
    let right = forward.cross(camera.up).normalize();
    let q = p - camera.look_from;
    let z = q.dot(forward);
    let half = match camera.orthographic_height {
        Some(height) => height / 2.0,
        None => z * (camera.fov_y / 2.0).tan(),
    };
    let (x, y) = (q.dot(right) / half, q.dot(right.cross(forward)) / half);
    dvec3(SIZE.x / 2.0 + x * SIZE.y / 2.0, SIZE.y / 2.0 * (1.0 - y), z)
}

fn forward(camera: &Camera) -> DVec3 {
    (camera.look_at - camera.look_from).normalize()
}

#[track_caller]
fn near(a: DVec3, b: DVec3, tolerance: f64) {
    assert!(a.distance(b) <= tolerance, "{a} and {b}");
}

/// Cameras with and without perspective, upright and rolled, near and far.
fn cameras() -> Vec<Camera> {
    let mut random = Random::new(7);
    let mut cameras = vec![camera(), parallel()];
    for i in 0..40 {
        let at = 5.0 * random.in_cube();
        let reach = 10f64.powf(random.between(-2.0, 3.0));
        cameras.push(Camera {
            look_from: at + reach * random.direction(),
            look_at: at,
            up: random.direction(),
            fov_y: random.between(0.05, 2.5),
            orthographic_height: (i % 3 == 0).then(|| random.between(0.1, 30.0)),
            ..Camera::default()
        });
    }
    cameras
}

#[test]
fn a_camera_that_was_not_touched_is_the_scenes_own_and_so_is_one_that_came_home() {
    for camera in cameras() {
        let mut rig = rig(&camera);
        assert!(rig.is_home() && !rig.is_moving());
        assert_eq!(rig.camera(), camera);
        rig.orbit(dvec2(170.0, -40.0), SIZE);
        rig.zoom(3.0, None);
        rig.toggle_orthographic();
        rig.look_from(Side::Left);
        rig.advance(0.1);
        assert!(!rig.is_home());
        assert_ne!(rig.camera(), camera);
        rig.go_home();
        assert_eq!(rig.destination(), camera);
        assert_eq!(settled(rig), camera);
    }
}

#[test]
fn a_touched_camera_sees_what_the_scenes_own_saw() {
    let mut random = Random::new(8);
    for camera in cameras() {
        let mut rig = rig(&camera);
        // There and back: not the scene's own bits any more.
        rig.orbit(dvec2(1.0, 0.0), SIZE);
        rig.orbit(dvec2(-1.0, 0.0), SIZE);
        let reach = camera.look_at.distance(camera.look_from);
        for _ in 0..10 {
            let p = camera.look_at + 0.3 * reach * random.in_cube();
            near(image(&rig.camera(), p), image(&camera, p), 1e-6 * SIZE.y);
        }
    }
}

#[test]
fn orbiting_over_the_height_of_the_picture_is_half_a_turn_about_the_pivot() {
    let camera = camera();
    let mut rig = rig(&camera);
    rig.orbit(dvec2(SIZE.y, 0.0), SIZE);
    let turned = rig.camera();
    let there = camera.look_from - camera.look_at;
    let expected = camera.look_at + dvec3(-there.x, there.y, -there.z);
    near(turned.look_from, expected, 1e-12);
    assert_eq!((turned.look_at, turned.up), (camera.look_at, DVec3::Y));
    // A drag to the right turns what is in front to the right.
    let mut rig = self::rig(&camera);
    let front = camera.look_at - 0.1 * forward(&camera);
    let before = image(&camera, front);
    rig.orbit(dvec2(10.0, 0.0), SIZE);
    assert!(image(&rig.camera(), front).x > before.x);
    rig.orbit(dvec2(-10.0, 10.0), SIZE);
    assert!(image(&rig.camera(), front).y > before.y);
}

#[test]
fn orbiting_stops_at_the_poles_and_stays_upright() {
    for (drag, down) in [(1e5, -1.0), (-1e5, 1.0)] {
        let mut rig = rig(&camera());
        rig.orbit(dvec2(33.0, drag), SIZE);
        let at_pole = rig.camera();
        near(forward(&at_pole), down * DVec3::Y, 1e-12);
        let right = forward(&at_pole).cross(at_pole.up).normalize();
        assert!(right.y.abs() < 1e-12 && right.is_finite());
        // Away from it again, what was to the right is still there.
        rig.orbit(dvec2(0.0, -100.0 * drag.signum()), SIZE);
        let after = rig.camera();
        near(forward(&after).cross(after.up).normalize(), right, 1e-9);
    }
}

#[test]
fn no_orbit_rolls_an_upright_camera() {
    let mut random = Random::new(9);
    let mut rig = rig(&camera());
    for _ in 0..500 {
        let drag = 300.0 * random.in_cube().truncate();
        rig.orbit(drag, SIZE);
        let camera = rig.camera();
        let right = forward(&camera).cross(camera.up).normalize();
        assert!(right.y.abs() < 1e-9, "{camera:?}");
    }
}

#[test]
fn panning_keeps_what_is_under_the_cursor_under_it() {
    let mut random = Random::new(10);
    for camera in cameras() {
        let mut rig = rig(&camera);
        let reach = camera.look_at.distance(camera.look_from);
        for _ in 0..5 {
            let now = rig.camera();
            let depth = reach * random.between(0.2, 3.0);
            let from = dvec2(random.between(0.0, SIZE.x), random.between(0.0, SIZE.y));
            let to = dvec2(random.between(0.0, SIZE.x), random.between(0.0, SIZE.y));
            let (origin, direction) = ray_through(&now, from, SIZE);
            let point = origin + direction * depth;
            rig.pan(from, to, SIZE, Some(point));
            let seen = image(&rig.camera(), point);
            near(seen.with_z(0.0), to.extend(0.0), 1e-5);
            near(forward(&rig.camera()), forward(&now), 1e-9);
        }
    }
}

#[test]
fn zooming_to_a_point_keeps_it_where_it_is_all_the_while() {
    for camera in cameras() {
        for steps in [-4.0, 6.0] {
            let mut rig = rig(&camera);
            let cursor = dvec2(501.0, 77.0);
            let (origin, direction) = ray_through(&camera, cursor, SIZE);
            let reach = camera.look_at.distance(camera.look_from);
            let point = origin + direction * reach * 0.7;
            rig.zoom(steps, Some(point));
            for _ in 0..30 {
                rig.advance(0.02);
                let seen = image(&rig.camera(), point);
                near(seen.with_z(0.0), cursor.extend(0.0), 1e-4);
            }
            let factor = 0.85_f64.powf(steps);
            let after = settled(rig);
            let (a, b) = match camera.orthographic_height {
                Some(height) => (after.orthographic_height.unwrap_or(0.0), height * factor),
                None => (
                    after.look_from.distance(point),
                    camera.look_from.distance(point) * factor,
                ),
            };
            assert!((a / b - 1.0).abs() < 1e-9, "{a} and {b}");
        }
    }
}

#[test]
fn a_point_as_deep_as_the_pivot_is_where_the_cursor_is() {
    for camera in cameras() {
        let rig = rig(&camera);
        let cursor = dvec2(12.0, 470.0);
        let seen = image(&camera, rig.point_at(cursor, SIZE));
        near(seen.with_z(0.0), cursor.extend(0.0), 1e-6);
        let projected = project(&camera, rig.point_at(cursor, SIZE), SIZE).expect("in front");
        near(projected.extend(0.0), cursor.extend(0.0), 1e-6);
    }
}

#[test]
fn movement_does_not_depend_on_how_time_is_cut_into_frames() {
    type Start = fn(&mut CameraController);
    let starts: [(&str, Start); 5] = [
        ("zoom", |rig| rig.zoom(3.0, Some(dvec3(0.5, 0.0, 0.0)))),
        ("view", |rig| rig.look_from(Side::Top)),
        ("frame", |rig| rig.frame(BOX, 1.5)),
        ("recentre", |rig| rig.recentre(dvec3(1.0, 1.0, 0.0))),
        ("fly", |rig| {
            rig.fly(Flight {
                right: 0.5,
                up: 0.2,
                forward: 1.0,
                pace: 1.0,
            });
        }),
    ];
    for (name, start) in starts {
        for camera in [camera(), parallel()] {
            let after = |frames: u32| {
                let mut rig = rig(&camera);
                start(&mut rig);
                for _ in 0..frames {
                    rig.advance(0.1 / f64::from(frames));
                }
                rig.camera()
            };
            let (one, ten, many) = (after(1), after(10), after(1000));
            for other in [ten, many] {
                near(one.look_from, other.look_from, 1e-9);
                near(one.look_at, other.look_at, 1e-9);
                let heights = [&one, &other].map(|c| c.orthographic_height.unwrap_or(1.0));
                assert!(
                    (heights[0] - heights[1]).abs() < 1e-9,
                    "{name}: {heights:?}"
                );
            }
            assert_ne!(one.look_from, camera.look_from, "{name}");
        }
    }
}

#[test]
fn all_of_a_framed_box_is_in_the_picture_and_reaches_its_margin() {
    let mut random = Random::new(11);
    for camera in cameras() {
        let mut rig = rig(&camera);
        let corner = 3.0 * random.in_cube();
        let extent = random.in_cube().abs() * 10f64.powf(random.between(-3.0, 2.0));
        let framed = (corner, corner + extent);
        rig.frame(framed, SIZE.x / SIZE.y);
        let after = settled(rig);
        near(forward(&after), forward(&camera), 1e-9);
        near(
            image(&after, corner + extent / 2.0),
            (SIZE / 2.0).extend(image(&after, corner + extent / 2.0).z),
            1e-6,
        );
        let mut reach: f64 = 0.0;
        for i in 0..8 {
            let share = dvec3(f64::from(i & 1), f64::from(i >> 1 & 1), f64::from(i >> 2));
            let seen = image(&after, corner + extent * share);
            assert!(seen.z > 0.0);
            let off = (seen.truncate() - SIZE / 2.0).abs() / (SIZE / 2.0);
            reach = reach.max(off.max_element());
        }
        assert!((reach - 0.95).abs() < 1e-6, "{reach}");
    }
}

#[test]
fn a_framed_point_leaves_the_distance_as_it_is() {
    let mut rig = rig(&camera());
    let point = dvec3(4.0, 5.0, 6.0);
    rig.frame((point, point), 1.0);
    let after = settled(rig);
    assert_eq!(after.look_at, point);
    let distance = camera().look_at.distance(camera().look_from);
    assert!((after.look_from.distance(point) - distance).abs() < 1e-9);
}

#[test]
fn views_look_along_the_axes() {
    let rows = [
        (Side::Front, DVec3::NEG_Z, DVec3::X),
        (Side::Back, DVec3::Z, DVec3::NEG_X),
        (Side::Right, DVec3::NEG_X, DVec3::NEG_Z),
        (Side::Left, DVec3::X, DVec3::Z),
        (Side::Top, DVec3::NEG_Y, DVec3::X),
        (Side::Bottom, DVec3::Y, DVec3::X),
    ];
    let z_up = |v: DVec3| dvec3(v.x, -v.z, v.y);
    for (side, direction, right) in rows {
        for rolled in [0.0, 2.0, -3.0] {
            let mut rig = rig(&camera());
            rig.orbit(dvec2(1234.0, 10.0), SIZE);
            rig.roll(rolled);
            rig.look_from(side);
            let after = settled(rig);
            near(forward(&after), direction, 1e-9);
            near(forward(&after).cross(after.up).normalize(), right, 1e-9);
            assert_eq!(after.look_at, camera().look_at);
        }
        let mut rig = rig(&Camera {
            up: DVec3::Z,
            ..camera()
        });
        assert_eq!(rig.up_axis(), DVec3::Z);
        rig.look_from(side);
        let after = settled(rig);
        near(forward(&after), z_up(direction), 1e-9);
        near(
            forward(&after).cross(after.up).normalize(),
            z_up(right),
            1e-9,
        );
    }
}

#[test]
fn a_view_is_reached_by_the_shorter_way_round() {
    let mut rig = rig(&Camera {
        look_from: dvec3(0.1, 0.0, -5.0),
        look_at: DVec3::ZERO,
        ..Camera::default()
    });
    rig.look_from(Side::Back);
    rig.advance(0.05);
    // Not once round: it is behind all the while.
    assert!(rig.camera().look_from.z < -4.9);
}

#[test]
fn what_is_at_the_pivot_keeps_its_size_without_perspective() {
    let mut random = Random::new(12);
    for camera in cameras() {
        let mut rig = rig(&camera);
        rig.orbit(dvec2(30.0, 5.0), SIZE);
        let before = rig.camera();
        rig.toggle_orthographic();
        assert!(!rig.is_moving());
        let after = rig.camera();
        assert_eq!(
            after.orthographic_height.is_some(),
            before.orthographic_height.is_none()
        );
        let axes = (
            forward(&before).cross(before.up).normalize(),
            before.up.reject_from(forward(&before)).normalize(),
        );
        let reach = before.look_at.distance(before.look_from);
        for _ in 0..5 {
            let off = 0.3 * reach * random.in_cube();
            let p = before.look_at + off.x * axes.0 + off.y * axes.1;
            let flat = |c: &Camera| image(c, p).with_z(0.0);
            near(flat(&after), flat(&before), 1e-6 * SIZE.y);
        }
        rig.toggle_orthographic();
        let again = rig.camera();
        near(again.look_at, before.look_at, 0.0);
        if before.orthographic_height.is_none() {
            near(again.look_from, before.look_from, 1e-9 * reach);
        }
    }
}

#[test]
fn an_orthographic_view_that_was_asked_for_has_everything_before_it() {
    for camera in cameras() {
        if camera.orthographic_height.is_some() {
            continue;
        }
        let mut rig = rig(&camera);
        rig.toggle_orthographic();
        for side in [Side::Front, Side::Right, Side::Top] {
            rig.zoom(20.0, None);
            rig.look_from(side);
            rig.arrive();
            for i in 0..8 {
                let share = dvec3(f64::from(i & 1), f64::from(i >> 1 & 1), f64::from(i >> 2));
                let corner = BOX.0 + (BOX.1 - BOX.0) * share;
                assert!(image(&rig.camera(), corner).z > 0.0);
            }
        }
    }
}

#[test]
fn recentring_starts_from_the_picture_as_it_is_and_ends_with_the_point_in_the_middle() {
    for camera in cameras() {
        let mut rig = rig(&camera);
        let reach = camera.look_at.distance(camera.look_from);
        let (origin, direction) = ray_through(&camera, dvec2(100.0, 400.0), SIZE);
        let point = origin + 1.7 * reach * direction;
        let depth = image(&camera, point).z;
        rig.recentre(point);
        let probe = camera.look_at;
        near(
            image(&rig.camera(), probe),
            image(&camera, probe),
            1e-6 * SIZE.y * reach.max(1.0),
        );
        assert_eq!(rig.pivot(), point);
        let after = settled(rig);
        assert_eq!(after.look_at, point);
        near(forward(&after), forward(&camera), 1e-9);
        if camera.orthographic_height.is_none() {
            let now = image(&after, point).z;
            assert!((now / depth - 1.0).abs() < 1e-9, "{now} and {depth}");
        }
    }
    // A point behind the camera cannot be seen, and so not be the pivot.
    let mut rig = rig(&camera());
    rig.recentre(camera().look_from - forward(&camera()));
    assert!(rig.is_home());
}

#[test]
fn flying_gets_under_way_keeps_its_speed_and_comes_to_rest() {
    let mut rig = rig(&camera());
    let ahead = |pace| Flight {
        forward: 1.0,
        pace,
        ..Flight::default()
    };
    rig.fly(ahead(1.0));
    rig.advance(5.0);
    let (from, direction) = (rig.camera().look_from, forward(&rig.camera()));
    rig.advance(1.0);
    let way = rig.camera().look_from - from;
    let radius = (BOX.1 - BOX.0).length() / 2.0;
    near(way, direction * radius / 2.0, 1e-9);
    rig.fly(ahead(4.0));
    rig.advance(5.0);
    let from = rig.camera().look_from;
    rig.advance(1.0);
    near(
        rig.camera().look_from - from,
        direction * radius * 2.0,
        1e-9,
    );
    rig.fly(Flight::default());
    assert!(rig.is_moving());
    let camera = settled(rig);
    near(forward(&camera), direction, 1e-12);
}

#[test]
fn looking_about_leaves_the_eye_where_it_is() {
    let camera = camera();
    let mut rig = rig(&camera);
    rig.look(dvec2(SIZE.y, 0.0), SIZE);
    near(rig.camera().look_from, camera.look_from, 1e-12);
    // To the right by the angle of view.
    let (a, b) = (forward(&camera), forward(&rig.camera()));
    let heading = |v: DVec3| (-v.x).atan2(-v.z);
    assert!((heading(a) - heading(b) - camera.fov_y).abs() < 1e-12);
}

#[test]
fn a_roll_is_kept_until_it_is_taken_away() {
    let mut rig = rig(&camera());
    rig.roll(0.5);
    rig.orbit(dvec2(50.0, 20.0), SIZE);
    let camera = rig.camera();
    let right = forward(&camera).cross(camera.up).normalize();
    assert!((right.y.abs() - 0.5_f64.sin() * forward(&camera).with_y(0.0).length()).abs() < 1e-9);
    rig.level();
    let camera = settled(rig);
    assert!(forward(&camera).cross(camera.up).y.abs() < 1e-12);
}

#[test]
fn a_camera_that_was_gone_to_is_that_camera() {
    for camera in cameras() {
        let mut rig = rig(&self::camera());
        rig.orbit(dvec2(1000.0, 100.0), SIZE);
        rig.roll(7.0);
        rig.go_to(&camera);
        assert!(rig.is_moving());
        assert_eq!(settled(rig), camera);
    }
}

#[test]
fn the_scenes_camera_takes_along_only_a_rig_that_is_at_home() {
    let other = cameras()[5].clone();
    let mut rig = rig(&camera());
    rig.set_home(&other);
    assert_eq!(rig.camera(), other);
    rig.orbit(dvec2(10.0, 0.0), SIZE);
    let moved = rig.camera();
    rig.set_home(&camera());
    assert_eq!(rig.camera(), moved);
    rig.go_home();
    assert_eq!(settled(rig), camera());
}

#[test]
fn a_rig_flies_away_from_a_home_that_moves() {
    let mut rig = rig(&camera());
    rig.fly(Flight {
        forward: 1.0,
        pace: 1.0,
        ..Flight::default()
    });
    rig.set_home(&cameras()[5]);
    rig.set_home(&cameras()[5]);
    assert!(rig.advance(0.1));
    assert!(!rig.is_home());
}

#[test]
fn no_zoom_is_too_much() {
    for camera in [camera(), parallel()] {
        for steps in [-1e4, 1e4] {
            let mut rig = rig(&camera);
            for _ in 0..20 {
                rig.zoom(steps, Some(dvec3(0.3, 0.2, 0.1)));
                rig.advance(0.3);
                rig.drag_zoom(dvec2(0.0, -steps), SIZE, None);
            }
            let after = settled(rig);
            let size = after
                .orthographic_height
                .unwrap_or(after.look_from.distance(after.look_at));
            assert!(size > 1e-9 && size < 1e9, "{size}");
            assert!(after.look_from.is_finite() && after.look_at != after.look_from);
        }
    }
}

#[test]
fn the_angle_of_view_changes_without_changing_the_size_at_the_pivot() {
    let camera = camera();
    let mut rig = rig(&camera);
    rig.set_fov_y(0.3);
    let after = rig.camera();
    assert!((after.fov_y - 0.3).abs() < 1e-12);
    let p = camera.look_at + forward(&camera).cross(DVec3::Y);
    near(
        image(&after, p).with_z(0.0),
        image(&camera, p).with_z(0.0),
        1e-9 * SIZE.y,
    );
}

#[test]
fn focusing_makes_what_is_as_deep_as_the_point_sharp() {
    let lens = Lens {
        radius: 0.1,
        focus_distance: 3.0,
        blade_count: 0,
        blade_rotation: 0.0,
    };
    let mut rig = rig(&Camera {
        lens: Some(lens),
        ..camera()
    });
    let point = dvec3(1.0, 0.0, 0.0);
    rig.focus_on(point);
    let after = rig.camera().lens.expect("a lens").focus_distance;
    assert!((after - image(&camera(), point).z).abs() < 1e-12);
    let mut pinhole = self::rig(&camera());
    pinhole.focus_on(point);
    assert!(pinhole.is_home());
}

#[test]
fn rays_go_through_the_points_that_are_projected_there() {
    let mut random = Random::new(13);
    for camera in cameras() {
        let at = dvec2(random.between(0.0, SIZE.x), random.between(0.0, SIZE.y));
        let (origin, direction) = ray_through(&camera, at, SIZE);
        assert!((direction.length() - 1.0).abs() < 1e-12);
        let point = origin + 2.5 * direction;
        near(image(&camera, point).with_z(0.0), at.extend(0.0), 1e-6);
        assert_eq!(project(&camera, origin - direction, SIZE), None);
    }
}

#[test]
fn the_upward_axis_is_the_one_that_a_camera_is_level_to() {
    let looking = |forward: DVec3, up: DVec3| {
        let camera = Camera {
            look_from: -forward,
            look_at: DVec3::ZERO,
            up,
            ..Camera::default()
        };
        CameraController::new(&camera, None).up_axis()
    };
    let rows = [
        (
            "an ordinary camera",
            dvec3(1.0, -0.5, -2.0),
            DVec3::Y,
            DVec3::Y,
        ),
        (
            "one that looks straight down",
            DVec3::NEG_Y,
            DVec3::NEG_Z,
            DVec3::Y,
        ),
        (
            "up in the picture",
            dvec3(0.0, -0.8, -0.6),
            dvec3(0.0, 0.6, -0.8),
            DVec3::Y,
        ),
        ("Z is up", dvec3(1.0, 2.0, -0.5), DVec3::Z, DVec3::Z),
        ("Z is up, from the front", DVec3::Y, DVec3::Z, DVec3::Z),
        (
            "upside down",
            dvec3(1.0, -0.5, -2.0),
            DVec3::NEG_Y,
            DVec3::NEG_Y,
        ),
        ("rolled", DVec3::NEG_Z, dvec3(1.0, 1.0, 0.0), DVec3::Y),
    ];
    for (name, forward, up, axis) in rows {
        near(looking(forward, up), axis, 1e-12);
        assert!(!name.is_empty());
    }
    let mut rig = rig(&camera());
    rig.set_up_axis(DVec3::Z);
    let camera = rig.camera();
    assert!(forward(&camera).cross(camera.up).z.abs() < 1e-12);
    rig.orbit(dvec2(SIZE.y / 2.0, 0.0), SIZE);
    let turned = forward(&rig.camera());
    assert!((turned.z - forward(&camera).z).abs() < 1e-12);
    let heading = |v: DVec3| v.y.atan2(v.x);
    let turn = (heading(turned) - heading(forward(&camera))).rem_euclid(2.0 * PI);
    assert!((turn - 3.0 * FRAC_PI_2).abs() < 1e-9, "{turn}");
}

#[test]
fn the_view_from_the_side_that_a_direction_points_to_looks_against_it() {
    let ways = [
        DVec3::X,
        DVec3::NEG_X,
        DVec3::Y,
        DVec3::NEG_Y,
        DVec3::Z,
        DVec3::NEG_Z,
    ];
    for axis in ways {
        for way in ways {
            let mut rig = rig(&camera());
            rig.set_up_axis(axis);
            let side = rig.side_towards(way);
            rig.look_from(side);
            near(forward(&settled(rig)), -way, 1e-6);
        }
    }
    let mut rig = rig(&camera());
    rig.set_up_axis(DVec3::Z);
    assert_eq!(rig.side_towards(DVec3::Z), Side::Top);
    assert_eq!(rig.side_towards(DVec3::NEG_Y), Side::Front);
    assert_eq!(rig.side_towards(dvec3(0.9, 0.3, 0.3)), Side::Right);
}
