//! The turntable: exact framing over the whole turn, a seamless loop, lights attached to the camera.

use crate::support::random::Random;
use glam::{DAffine3, DQuat, DVec3, Vec3, dvec3};
use glimray::scene::{
    Background, Camera, Geometry, Instance, Light, LightKind, Material, Mesh, Node, Scene, Shape,
    Turntable, turntable,
};
use std::f64::consts::{PI, TAU};

/// A scene with these vertices.
fn scene(positions: Vec<Vec3>) -> Scene {
    Scene {
        materials: vec![Material::default()],
        cameras: vec![Camera::default()],
        meshes: vec![
            Mesh {
                positions,
                ..Mesh::default()
            }
            .into(),
        ],
        instances: vec![Instance {
            mesh: 0,
            placement: DAffine3::IDENTITY,
            node: None,
            name: String::new(),
        }],
        ..Scene::default()
    }
}

/// Image coordinates of a point: x and y, ±1 at the edges, and its depth.
fn project(camera: &Camera, aspect: f64, p: DVec3) -> DVec3 {
    let forward = (camera.look_at - camera.look_from).normalize();
    let right = forward.cross(camera.up).normalize();
    let q = p - camera.look_from;
    let (tangent, z) = ((camera.fov_y / 2.0).tan(), q.dot(forward));
    dvec3(
        q.dot(right) / (z * tangent * aspect),
        q.dot(right.cross(forward)) / (z * tangent),
        z,
    )
}

/// Extent of one point to the left, right, bottom and top, maximised near `time`.
fn sharpened(scene: &Scene, options: &Turntable, p: DVec3, edge: usize, time: f64) -> f64 {
    let at = |t: f64| edges(&scene.frame(t).camera, options, p)[edge];
    let mut width = options.seconds / 360.0;
    let mut best = time;
    for _ in 0..60 {
        for t in [best - width, best + width] {
            if at(t) > at(best) {
                best = t;
            }
        }
        width *= 0.7;
    }
    at(best)
}

fn edges(camera: &Camera, options: &Turntable, p: DVec3) -> [f64; 4] {
    let q = project(camera, options.aspect, p);
    assert!(q.z > 0.0);
    [-q.x, q.x, -q.y, q.y]
}

/// Extent of the points to the left, right, bottom and top over the whole turn.
fn reach(scene: &Scene, options: &Turntable, points: &[DVec3]) -> [f64; 4] {
    let mut best = [(f64::NEG_INFINITY, 0.0, DVec3::ZERO); 4];
    for i in 0..360 {
        let time = options.seconds * f64::from(i) / 360.0;
        let camera = scene.frame(time).camera;
        for &p in points {
            for (best, reach) in best.iter_mut().zip(edges(&camera, options, p)) {
                if reach > best.0 {
                    *best = (reach, time, p);
                }
            }
        }
    }
    [0, 1, 2, 3].map(|edge| sharpened(scene, options, best[edge].2, edge, best[edge].1))
}

/// One pair of opposite extents equals `most`, none exceeds it; top and bottom are equal.
fn check(name: &str, reach: [f64; 4], most: f64) {
    let touches = |edge: usize| (reach[edge] - most).abs() < 1e-6;
    let furthest = reach.into_iter().fold(0.0, f64::max);
    assert!(furthest < most + 1e-9, "{name}: {reach:?}");
    let touches_a_pair = touches(0) && touches(1) || touches(2) && touches(3);
    assert!(touches_a_pair, "{name}: {reach:?} against {most}");
    assert!((reach[2] - reach[3]).abs() < 1e-5, "{name}: {reach:?}");
}

#[test]
fn all_vertices_stay_in_the_picture_and_some_reach_the_margin() {
    let mut random = Random::new(7);
    let shapes = [
        ("cube", DVec3::ONE),
        ("pole", dvec3(0.1, 3.0, 0.1)),
        ("board", dvec3(3.0, 0.1, 2.0)),
    ];
    let (mut by_sides, mut by_height) = (0, 0);
    for (name, size) in shapes {
        for elevation in [-50.0, 0.0, 15.0, 40.0, 75.0, 88.0_f64] {
            for aspect in [0.5, 1.0, 2.0] {
                let far = random.in_cube() * 30.0;
                let positions: Vec<Vec3> = (0..12)
                    .map(|_| (far + random.in_cube() * size).as_vec3())
                    .collect();
                let points: Vec<DVec3> = positions.iter().map(|p| p.as_dvec3()).collect();
                let options = Turntable {
                    axis: if random.below(2) == 0 {
                        DVec3::Y
                    } else {
                        random.direction() * 3.0
                    },
                    elevation: elevation.to_radians(),
                    seconds: 4.0,
                    fov_y: random.between(0.2, 1.5),
                    aspect,
                    margin: 0.05,
                    clockwise: random.below(2) == 0,
                };
                let mut scene = scene(positions);
                assert!(turntable(&mut scene, &options));
                let reach = reach(&scene, &options, &points);
                check(&format!("{name} {options:?}"), reach, 0.95);
                *(if reach[3] < 0.94 {
                    &mut by_sides
                } else {
                    &mut by_height
                }) += 1;
            }
        }
    }
    assert!(by_sides > 5 && by_height > 5, "{by_sides} {by_height}");
}

#[test]
fn a_ball_in_the_middle_just_touches_the_margin() {
    let mut scene = scene(vec![]);
    scene.nodes = vec![Node {
        translation: dvec3(3.0, 4.0, 5.0),
        rotation: DQuat::from_rotation_x(1.0),
        scale: DVec3::splat(2.0),
        ..Node::default()
    }];
    scene.shapes = vec![Shape {
        geometry: Geometry::Sphere {
            center: DVec3::ZERO,
            radius: 0.75,
        },
        material: 0,
        node: Some(0),
        name: String::new(),
    }];
    for (fov_y, aspect) in [(0.6, 1.5), (0.6, 0.5), (2.0, 1.0)] {
        let options = Turntable {
            fov_y,
            aspect,
            margin: 0.1,
            ..Turntable::default()
        };
        let mut scene = scene.clone();
        assert!(turntable(&mut scene, &options));
        let camera = scene.frame(1.7).camera;
        // A ball is tangent to the planes of a wedge when its centre is r / sin(angle) away.
        let tangent = (fov_y / 2.0).tan() * 0.9 * aspect.min(1.0);
        let expected = 1.5 / tangent.atan().sin();
        let distance = camera.look_from.distance(dvec3(3.0, 4.0, 5.0));
        assert!((distance - expected).abs() < 1e-9, "{distance} {expected}");
        assert!(camera.look_at.distance(dvec3(3.0, 4.0, 5.0)) < 1e-9);
        assert!((camera.look_from.y - 4.0 - expected * options.elevation.sin()).abs() < 1e-9);
    }
}

#[test]
fn a_level_ring_is_framed_by_its_sides() {
    // A ring of radius 1 seen level, in a square image with a field of view of 90°: the sides of the
    // frustum touch it when the camera is √2 from the axis; the height does not matter.
    let ring = (0..360).map(|i| {
        let (sin, cos) = (TAU * f64::from(i) / 360.0).sin_cos();
        dvec3(cos, 0.0, sin).as_vec3()
    });
    let mut scene = scene(ring.collect());
    let options = Turntable {
        elevation: 0.0,
        fov_y: PI / 2.0,
        aspect: 1.0,
        margin: 0.0,
        ..Turntable::default()
    };
    assert!(turntable(&mut scene, &options));
    let distance = scene.frame(0.0).camera.look_from.length();
    assert!((distance - 2_f64.sqrt()).abs() < 1e-6, "{distance}");
}

#[test]
fn the_loop_closes_and_the_model_turns_counter_clockwise() {
    for (clockwise, sign) in [(false, -1.0), (true, 1.0)] {
        let mut scene = scene(vec![Vec3::ZERO, Vec3::ONE]);
        let options = Turntable {
            seconds: 3.0,
            clockwise,
            ..Turntable::default()
        };
        assert!(turntable(&mut scene, &options));
        assert_eq!(scene.duration(), 3.0);
        let camera = |t: f64| scene.frame(t).camera;
        assert!(camera(0.0).look_from.distance(camera(3.0).look_from) < 1e-12);
        assert!(camera(0.5).look_from.distance(camera(6.5).look_from) < 1e-12);
        let from_axis = |t: f64| camera(t).look_from - camera(t).look_at;
        assert!(from_axis(0.0).z > 0.0 && from_axis(0.0).x.abs() < 1e-12);
        // A sixth of a turn after half a second; about +y, z goes to x.
        let angle = from_axis(0.5).x.atan2(from_axis(0.5).z);
        assert!((angle - sign * TAU / 6.0).abs() < 1e-12, "{angle}");
    }
}

/// The ground of a model is removed, as it would not turn with it; one that only catches the shadow cannot be seen to stand.
#[test]
fn only_a_ground_that_catches_the_shadow_stays() {
    let grounds = |shadow_catcher| {
        let mut scene = scene(vec![Vec3::ZERO, Vec3::ONE, Vec3::X]);
        scene.materials.push(Material {
            shadow_catcher,
            ..Material::default()
        });
        scene.shapes.push(Shape {
            geometry: Geometry::Plane {
                point: DVec3::ZERO,
                normal: DVec3::Y,
            },
            material: scene.materials.len() - 1,
            node: None,
            name: String::new(),
        });
        scene.staged = true;
        assert!(turntable(&mut scene, &Turntable::default()));
        scene.shapes.len()
    };
    assert_eq!([false, true].map(grounds), [0, 1]);
}

#[test]
fn the_three_lights_follow_the_camera() {
    let mut scene = scene(vec![Vec3::ZERO, Vec3::ONE, Vec3::X]);
    assert!(turntable(&mut scene, &Turntable::default()));
    assert_eq!(scene.lights.len(), 3);
    assert!(matches!(scene.background, Background::Gradient { .. }));
    let seen = |t: f64| {
        let frame = scene.frame(t);
        let forward = (frame.camera.look_at - frame.camera.look_from).normalize();
        let right = forward.cross(frame.camera.up).normalize();
        let up = right.cross(forward);
        let by_camera = |v: DVec3| dvec3(v.dot(right), v.dot(up), v.dot(forward));
        let lights = frame.lights.iter().map(|light| match light.kind {
            LightKind::Disc { center, normal, .. } => [
                by_camera(center - frame.camera.look_from),
                by_camera(normal),
            ],
            other => panic!("{other:?}"),
        });
        lights.collect::<Vec<_>>()
    };
    let first = seen(0.0);
    for t in [0.1, 2.0, 7.9] {
        for (a, b) in first.iter().flatten().zip(seen(t).iter().flatten()) {
            assert!(a.distance(*b) < 1e-12);
        }
    }
    // The key light is on the right and above, the fill light on the left, the back light behind the
    // camera's target.
    let distance = {
        let camera = scene.frame(0.0).camera;
        camera.look_from.distance(camera.look_at)
    };
    assert!(first[0][0].x > 0.0 && first[0][0].y > 0.0 && first[0][0].z < distance);
    assert!(first[1][0].x < 0.0 && first[1][0].z < distance);
    assert!(first[2][0].z > distance);
    // A fully lit grey is neither black nor overexposed.
    let sum: Vec3 = scene.lights.iter().map(|light| light.color).sum();
    assert!(sum.max_element() * 0.5 + 0.06 < 1.0 && sum.min_element() * 0.5 > 0.3);
}

#[test]
fn lights_of_the_file_are_kept_and_staged_ones_are_replaced() {
    let mut lit = scene(vec![Vec3::ZERO, Vec3::ONE]);
    lit.lights = vec![Light {
        color: Vec3::ONE,
        ..Light::default()
    }];
    lit.background = Background::Color(Vec3::ONE);
    let mut staged = Scene {
        staged: true,
        background: Background::Gradient {
            bottom: Vec3::ONE,
            top: Vec3::ONE,
        },
        ..lit.clone()
    };
    let lamp = LightKind::Disc {
        center: DVec3::Y,
        normal: DVec3::NEG_Y,
        radius: 1.0,
    };
    staged.lights.push(Light {
        kind: lamp,
        ..Light::default()
    });
    let unlit = Scene {
        lights: Vec::new(),
        ..staged.clone()
    };
    let before = lit.clone();
    assert!(turntable(&mut lit, &Turntable::default()));
    assert_eq!(lit.lights, before.lights);
    assert_eq!(lit.background, before.background);
    assert!(turntable(&mut staged, &Turntable::default()));
    assert_eq!(staged.lights.len(), 4, "its own weak light and the three");
    assert_eq!(staged.lights[0], before.lights[0]);
    assert!(staged.background != unlit.background);
    assert!(!staged.staged);
    // One whose lamps are left out has none here either.
    let mut turned = unlit.clone();
    assert!(turntable(&mut turned, &Turntable::default()));
    assert!(turned.lights.is_empty());
}

#[test]
fn a_scene_without_bounds_has_no_turntable() {
    let mut empty = scene(vec![]);
    let before = empty.clone();
    assert!(!turntable(&mut empty, &Turntable::default()));
    assert_eq!(empty, before);
}

#[test]
fn a_single_point_can_be_looked_at() {
    for far in [0.0, 1e6] {
        let mut scene = scene(vec![Vec3::splat(far)]);
        assert!(turntable(&mut scene, &Turntable::default()));
        let camera = scene.frame(1.0).camera;
        assert!(camera.look_from.distance(camera.look_at) > 0.0);
        assert!(camera.look_from.is_finite());
    }
}
