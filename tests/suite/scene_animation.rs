//! Animation: curves against their closed forms, and the state of a scene at one moment.

use crate::support::effort;
use glam::{DAffine3, DMat3, DQuat, DVec3, Vec3, dvec3};
use glimray::scene::{
    Beyond, Camera, CameraProperty, Curve, Easing, Geometry, Instance, Interpolation, Lens, Light,
    LightKind, LightProperty, Material, MaterialProperty, Mesh, Node, NodeProperty, Scene, Shape,
    Target, Track, Value, Values,
};
use std::f64::consts::{FRAC_PI_2, PI, TAU};

fn scalars(times: &[f64], values: &[f64]) -> Curve {
    Curve {
        times: times.to_vec(),
        values: Values::Scalar(values.to_vec()),
        interpolation: Interpolation::Linear,
        easing: Easing::None,
        beyond: Beyond::Hold,
    }
}

fn vectors(times: &[f64], values: &[DVec3]) -> Curve {
    Curve {
        values: Values::Vector(values.to_vec()),
        ..scalars(times, &[])
    }
}

fn rotations(times: &[f64], values: &[DQuat]) -> Curve {
    Curve {
        values: Values::Rotation(values.to_vec()),
        ..scalars(times, &[])
    }
}

fn scalar(curve: &Curve, time: f64) -> f64 {
    match curve.at(time) {
        Value::Scalar(value) => value,
        other => panic!("{other:?}"),
    }
}

fn rotation(curve: &Curve, time: f64) -> DQuat {
    match curve.at(time) {
        Value::Rotation(value) => value,
        other => panic!("{other:?}"),
    }
}

/// Radians between two rotations.
fn angle(a: DQuat, b: DQuat) -> f64 {
    let b = if a.dot(b) < 0.0 { -b } else { b };
    4.0 * (a - b).length().atan2((a + b).length())
}

fn track(target: Target, curve: Curve) -> Track {
    Track {
        targets: vec![target],
        curve,
    }
}

fn node(index: usize, property: NodeProperty, curve: Curve) -> Track {
    track(Target::Node(index, property), curve)
}

/// A scene of `nodes` with a camera ten units in front of the origin.
fn scene(nodes: Vec<Node>, tracks: Vec<Track>) -> Scene {
    Scene {
        materials: vec![Material::default()],
        cameras: vec![Camera {
            look_from: dvec3(0.0, 0.0, 10.0),
            look_at: DVec3::ZERO,
            ..Camera::default()
        }],
        nodes,
        tracks,
        ..Scene::default()
    }
}

const WAYS: [Interpolation; 4] = [
    Interpolation::Step,
    Interpolation::Linear,
    Interpolation::CatmullRom,
    Interpolation::Hermite,
];

#[test]
fn curves_pass_exactly_through_their_keys() {
    let times = [-1.5, 0.1, 0.7, 2.3, 9.1];
    let values = [3.0, -0.1, 0.7, 1e-3, 1e9];
    for interpolation in WAYS {
        for beyond in [Beyond::Hold, Beyond::Repeat, Beyond::PingPong] {
            for easing in [Easing::None, Easing::IN_OUT] {
                let keys = match interpolation {
                    Interpolation::Hermite => values.iter().flat_map(|v| [2.0, *v, -5.0]).collect(),
                    _ => values.to_vec(),
                };
                let curve = Curve {
                    interpolation,
                    beyond,
                    easing,
                    ..scalars(&times, &keys)
                };
                for i in 0..5 {
                    assert_eq!(scalar(&curve, times[i]), values[i], "{curve:?}");
                }
            }
        }
    }
}

#[test]
fn catmull_rom_reproduces_a_parabola_at_uneven_times() {
    let parabola = |t: f64| 3.0 - 2.0 * t + 0.7 * t * t;
    let times = [0.0, 0.3, 1.9, 2.0, 4.5];
    let curve = Curve {
        interpolation: Interpolation::CatmullRom,
        ..scalars(&times, &times.map(parabola))
    };
    for i in 0..=450 {
        let t = f64::from(i) / 100.0;
        assert!((scalar(&curve, t) - parabola(t)).abs() < 1e-12, "{t}");
    }
    let two = Curve {
        interpolation: Interpolation::CatmullRom,
        ..scalars(&[1.0, 3.0], &[5.0, 9.0])
    };
    assert!((scalar(&two, 1.5) - 6.0).abs() < 1e-12);
}

#[test]
fn hermite_is_the_cubic_of_its_tangents() {
    // t³ − 2t² + 5 between 1 and 3, whose derivative is 3t² − 4t.
    let cubic = |t: f64| t * t * t - 2.0 * t * t + 5.0;
    let slope = |t: f64| 3.0 * t * t - 4.0 * t;
    let keys = [1.0, 1.5, 3.0].map(|t| [slope(t), cubic(t), slope(t)]);
    let curve = Curve {
        interpolation: Interpolation::Hermite,
        ..scalars(&[1.0, 1.5, 3.0], keys.as_flattened())
    };
    for i in 0..=200 {
        let t = 1.0 + f64::from(i) / 100.0;
        assert!((scalar(&curve, t) - cubic(t)).abs() < 1e-12, "{t}");
    }
}

#[test]
fn rotations_turn_at_constant_speed_on_the_shorter_arc() {
    let axis = dvec3(1.0, 2.0, -2.0) / 3.0;
    for whole in [1e-7, 0.01, 1.0, 3.0] {
        let end = DQuat::from_axis_angle(axis, whole);
        for end in [end, -end] {
            let curve = rotations(&[0.0, 2.0], &[DQuat::IDENTITY, end]);
            for i in 0..=20 {
                let t = f64::from(i) / 10.0;
                let expected = DQuat::from_axis_angle(axis, whole * t / 2.0);
                let off = angle(rotation(&curve, t), expected);
                assert!(off < 1e-14, "{whole} {t}: {off}");
            }
        }
    }
}

#[test]
fn cubic_rotations_stay_of_unit_length_and_near_an_even_turn() {
    // Keys of a rotation at constant speed, some with the opposite sign.
    let times = [0.0, 0.5, 0.8, 1.7, 2.0];
    let keys: Vec<DQuat> = (times.iter().enumerate())
        .map(|(i, t)| DQuat::from_rotation_y(*t) * if i % 2 == 0 { 1.0 } else { -1.0 })
        .collect();
    let curve = Curve {
        interpolation: Interpolation::CatmullRom,
        ..rotations(&times, &keys)
    };
    for i in 0..=200 {
        let t = f64::from(i) / 100.0;
        let got = rotation(&curve, t);
        assert!((got.length() - 1.0).abs() < 1e-14);
        assert!(angle(got, DQuat::from_rotation_y(t)) < 2e-3, "{t}");
    }
}

#[test]
fn easing_is_that_of_css() {
    let eased = |easing| Curve {
        easing,
        ..scalars(&[0.0, 1.0], &[0.0, 1.0])
    };
    let in_out = eased(Easing::IN_OUT);
    assert!((scalar(&in_out, 0.5) - 0.5).abs() < 1e-12);
    // By definition: at the parameter s the time is x(s) and the progress y(s).
    let rows = [
        [0.42, 0.0, 1.0, 1.0],
        [0.0, 0.0, 0.58, 1.0],
        [0.42, 0.0, 0.58, 1.0],
        [0.25, 0.1, 0.25, 1.0],
        [1.0, 0.0, 0.0, 1.0],
        [0.0, 1.0, 1.0, 0.0],
        [0.5, -2.0, 0.5, 3.0],
    ];
    for [x1, y1, x2, y2] in rows {
        let curve = eased(Easing::Bezier([x1, y1, x2, y2]));
        for i in 0..=100 {
            let s = f64::from(i) / 100.0;
            let at = |a: f64, b: f64| {
                3.0 * (1.0 - s).powi(2) * s * a + 3.0 * (1.0 - s) * s * s * b + s.powi(3)
            };
            let (time, way) = (at(x1, x2), at(y1, y2));
            // Where x is stationary, the slope of y is unbounded.
            let tolerance = if (x1, x2) == (1.0, 0.0) { 1e-4 } else { 1e-9 };
            let off = (scalar(&curve, time) - way).abs();
            assert!(off < tolerance, "{x1} {y1} {x2} {y2} at {s}: {off}");
        }
    }
}

#[test]
fn the_end_of_a_repeated_curve_is_its_last_key_and_then_it_begins_again() {
    // 23 frames of 24 a second end at a time that f32 rounds down.
    let end = f64::from(23.0_f32 / 24.0);
    let curve = Curve {
        beyond: Beyond::Repeat,
        ..scalars(&[0.0, end], &[-1.0, 1.0])
    };
    assert_eq!(scalar(&curve, end), 1.0);
    assert_eq!(scalar(&curve, 23.0 / 24.0), 1.0);
    assert_eq!(scalar(&curve, 0.0), -1.0);
    assert_eq!(scalar(&curve, -end), -1.0);
    let after = scalar(&curve, end + 1e-4 * end);
    assert!((after + 1.0).abs() < 1e-3, "{after}");
}

#[test]
fn repeated_curves_are_smooth_across_the_seam() {
    let curve = Curve {
        interpolation: Interpolation::CatmullRom,
        beyond: Beyond::Repeat,
        ..scalars(&[1.0, 1.4, 2.5, 3.0], &[0.5, 2.0, -1.0, 0.5])
    };
    let step = 1e-5;
    let slope = |t: f64| (scalar(&curve, t + step) - scalar(&curve, t)) / step;
    assert!((slope(3.0 - step) - slope(3.0)).abs() < 1e-2);
    assert!((slope(1.0) - slope(3.0)).abs() < 1e-6);
    // The parabola's tangent at the seam, by hand: gaps 0.5 and 0.4, slopes 3 and 3.75.
    let tangent = (3.0 * 0.4 + 3.75 * 0.5) / 0.9;
    assert!((slope(1.0) - tangent).abs() < 1e-3, "{}", slope(1.0));
    for i in 0..50 {
        let t = 1.0 + f64::from(i) * 0.04;
        for turns in [-3.0, 1.0, 10.0] {
            assert!((scalar(&curve, t + 2.0 * turns) - scalar(&curve, t)).abs() < 1e-10);
        }
    }
}

#[test]
fn ping_pong_mirrors_the_curve() {
    let curve = Curve {
        beyond: Beyond::PingPong,
        ..scalars(&[1.0, 2.0, 4.0], &[0.0, 10.0, 40.0])
    };
    let held = Curve {
        beyond: Beyond::Hold,
        ..curve.clone()
    };
    for i in 0..=30 {
        let t = 1.0 + f64::from(i) / 10.0;
        let expected = scalar(&held, t);
        for time in [8.0 - t, t + 6.0, 2.0 - t, t - 12.0] {
            assert!((scalar(&curve, time) - expected).abs() < 1e-10, "{time}");
        }
    }
    assert_eq!(scalar(&held, -1e300), 0.0);
    assert_eq!(scalar(&held, 1e300), 40.0);
}

#[test]
fn extreme_times_and_keys_give_finite_values() {
    let wide = scalars(&[-1e308, 1e308], &[-1.7e308, 1.7e308]);
    let short = scalars(&[0.0, 5e-324, 1e-323], &[1.7e308, -1.7e308, 1e300]);
    let plain = scalars(&[0.1, 0.2, 0.7], &[1.0, -2.0, 1.0]);
    let single = scalars(&[3.0], &[7.0]);
    let far = [0.0, 0.15, 1e-320, 1e17, 1e300, f64::MAX, f64::MIN_POSITIVE];
    for curve in [wide, short, plain, single] {
        for interpolation in [
            Interpolation::Step,
            Interpolation::Linear,
            Interpolation::CatmullRom,
        ] {
            for beyond in [Beyond::Hold, Beyond::Repeat, Beyond::PingPong] {
                let curve = Curve {
                    interpolation,
                    beyond,
                    ..curve.clone()
                };
                for t in far.into_iter().flat_map(|t| [t, -t]) {
                    let value = scalar(&curve, t);
                    assert!(value.is_finite(), "{curve:?} at {t}: {value}");
                }
            }
        }
    }
}

#[test]
fn a_curve_of_a_million_keys_is_looked_up_quickly() {
    let count = 1_000_000;
    let times: Vec<f64> = (0..count).map(f64::from).collect();
    let values: Vec<f64> = times.iter().map(|t| (t * 0.01).sin()).collect();
    let curve = Curve {
        interpolation: Interpolation::CatmullRom,
        ..scalars(&times, &values)
    };
    // Comparing all keys for each value would take 10¹¹ comparisons.
    effort::within(1000.0, || {
        for i in 0..100_000 {
            let t = f64::from(i) * 9.87;
            assert!((scalar(&curve, t) - (t * 0.01).sin()).abs() < 1e-5);
        }
    });
}

/// A planet on a circle of radius 5 in one second, its moon at a distance of 1 in a quarter.
fn planets() -> Scene {
    let turn = |seconds: f64| Curve {
        beyond: Beyond::Repeat,
        ..vectors(&[0.0, seconds], &[DVec3::ZERO, dvec3(0.0, TAU, 0.0)])
    };
    let orbit = Node::default();
    let planet = Node {
        parent: Some(0),
        placement: DAffine3::from_translation(dvec3(5.0, 0.0, 0.0)),
        ..Node::default()
    };
    let moon = Node {
        parent: Some(1),
        translation: DVec3::X,
        ..Node::default()
    };
    let tracks = vec![
        node(0, NodeProperty::Angles, turn(1.0)),
        node(1, NodeProperty::Angles, turn(0.25)),
    ];
    scene(vec![orbit, planet, moon], tracks)
}

#[test]
fn children_follow_their_parents() {
    let scene = planets();
    for i in 0..40 {
        let t = f64::from(i) * 0.037;
        let nodes = scene.frame(t).nodes;
        // A turn about +y takes x to −z.
        let on_circle = |turns: f64| {
            let a = TAU * turns;
            dvec3(a.cos(), 0.0, -a.sin())
        };
        let planet = 5.0 * on_circle(t);
        let moon = planet + on_circle(5.0 * t);
        assert!(nodes[1].world_from_node.translation.distance(planet) < 1e-12);
        assert!(nodes[2].world_from_node.translation.distance(moon) < 1e-12);
    }
    assert_eq!(scene.moving_nodes(), [true; 3]);
    assert!(scene.is_animated());
    assert_eq!(scene.duration(), 1.0);
}

#[test]
fn angles_turn_about_x_then_y_then_z() {
    let angles = dvec3(0.3, -1.1, 2.0);
    let curve = vectors(&[0.0], &[angles]);
    let scene = scene(
        vec![Node::default()],
        vec![node(0, NodeProperty::Angles, curve)],
    );
    let expected = DMat3::from_rotation_z(angles.z)
        * DMat3::from_rotation_y(angles.y)
        * DMat3::from_rotation_x(angles.x);
    let got = scene.frame(3.0).nodes[0].world_from_node.matrix3;
    assert!(got.abs_diff_eq(expected, 1e-14));
    assert!(!scene.is_animated());
}

#[test]
fn a_node_scaled_through_zero_stays_invertible() {
    let curve = vectors(&[0.0, 1.0], &[DVec3::ONE, dvec3(-1.0, 1.0, 1.0)]);
    let scene = scene(
        vec![Node::default()],
        vec![node(0, NodeProperty::Scale, curve)],
    );
    for t in [0.0, 0.25, 0.5, 0.75, 1.0] {
        let inverse = scene.frame(t).nodes[0].world_from_node.inverse();
        assert!(inverse.is_finite(), "{t}");
    }
    let middle = scene.frame(0.25).nodes[0].world_from_node.matrix3;
    assert!(middle.x_axis.distance(DVec3::X * 0.5) < 1e-15);
}

#[test]
fn a_camera_on_a_node_sees_the_nodes_space_unchanged() {
    let place = DAffine3::from_scale_rotation_translation(
        DVec3::splat(2.0),
        DQuat::from_rotation_z(0.4) * DQuat::from_rotation_x(1.0),
        dvec3(1.0, 2.0, 3.0),
    );
    let mut scene = scene(
        vec![Node {
            placement: place,
            ..Node::default()
        }],
        vec![],
    );
    scene.cameras[0] = Camera {
        look_from: dvec3(1.0, 0.0, 4.0),
        look_at: dvec3(0.0, 1.0, 0.0),
        node: Some(0),
        lens: Some(Lens {
            radius: 0.1,
            focus_distance: 3.0,
            blade_count: 0,
            blade_rotation: 0.0,
        }),
        ..Camera::default()
    };
    let camera = scene.frame(0.0).camera;
    let image = |camera: &Camera, p: DVec3| {
        let forward = (camera.look_at - camera.look_from).normalize();
        let right = forward.cross(camera.up).normalize();
        let q = p - camera.look_from;
        dvec3(q.dot(right), q.dot(right.cross(forward)), q.dot(forward)) / q.dot(forward)
    };
    for p in [dvec3(0.3, 0.2, 0.1), dvec3(-1.0, 1.0, -2.0)] {
        let world = place.transform_point3(p);
        let off = image(&camera, world).distance(image(&scene.cameras[0], p));
        assert!(off < 1e-12);
    }
    let lens = camera.lens.expect("a lens");
    assert!((lens.focus_distance - 6.0).abs() < 1e-12 && (lens.radius - 0.2).abs() < 1e-12);
    assert_eq!((camera.node, camera.target), (None, None));
}

#[test]
fn a_camera_looks_at_its_target_and_always_has_a_direction() {
    let curve = vectors(&[0.0, 2.0], &[dvec3(0.0, 0.0, 5.0), dvec3(0.0, 0.0, 15.0)]);
    let mut scene = scene(
        vec![Node::default()],
        vec![node(0, NodeProperty::Translation, curve)],
    );
    scene.cameras[0].target = Some(0);
    let forward = |camera: &Camera| {
        let forward = (camera.look_at - camera.look_from).normalize();
        assert!(forward.cross(camera.up).length() > 0.0);
        forward
    };
    assert_eq!(forward(&scene.frame(0.0).camera), DVec3::NEG_Z);
    assert_eq!(forward(&scene.frame(2.0).camera), DVec3::Z);
    // If the target coincides with the camera, it keeps the direction to its own look_at.
    assert_eq!(forward(&scene.frame(1.0).camera), DVec3::NEG_Z);
}

#[test]
fn a_camera_that_tilts_straight_down_keeps_a_continuous_up_vector() {
    let curve = vectors(&[0.0, 1.0], &[dvec3(0.0, 0.0, -1.0), dvec3(0.0, -2.0, 0.0)]);
    let mut scene = scene(vec![], vec![]);
    scene.cameras[0].look_from = DVec3::ZERO;
    scene.cameras[0].look_at = DVec3::NEG_Z;
    scene.tracks = vec![track(Target::Camera(0, CameraProperty::LookAt), curve)];
    let up = |t: f64| {
        let camera = scene.frame(t).camera;
        let forward = (camera.look_at - camera.look_from).normalize();
        let right = forward.cross(camera.up).normalize();
        right.cross(forward)
    };
    assert!(up(1.0).distance(DVec3::NEG_Z) < 1e-12);
    assert!(up(1.0 - 1e-6).distance(up(1.0)) < 1e-5);
}

#[test]
fn lights_follow_their_nodes() {
    let matrix = DMat3::from_rotation_y(0.7) * DMat3::from_diagonal(dvec3(2.0, -1.0, 0.5));
    let place = DAffine3::from_mat3_translation(matrix, dvec3(1.0, -2.0, 3.0));
    let mut scene = scene(
        vec![Node {
            placement: place,
            ..Node::default()
        }],
        vec![],
    );
    let direction = dvec3(1.0, 2.0, 2.0) / 3.0;
    let center = dvec3(0.5, 0.5, 0.5);
    let (edge_u, edge_v) = (dvec3(1.0, 1.0, 0.0), dvec3(0.0, 0.0, 2.0));
    let kinds = [
        LightKind::Point { position: center },
        LightKind::Directional { direction },
        LightKind::Spot {
            position: center,
            direction,
            inner: 0.2,
            outer: 0.3,
        },
        LightKind::Rectangle {
            center,
            edge_u,
            edge_v,
        },
        LightKind::Disc {
            center,
            normal: direction,
            radius: 2.0,
        },
        LightKind::Sphere {
            center,
            radius: 2.0,
        },
    ];
    scene.lights = (kinds.iter())
        .map(|kind| Light {
            kind: *kind,
            color: Vec3::ONE,
            node: Some(0),
            ..Light::default()
        })
        .collect();
    let lights = scene.frame(0.0).lights;
    let middle = place.transform_point3(center);
    let along = (matrix * direction).normalize();
    // A normal stays perpendicular to the image of its plane.
    let normal_of = |n: DVec3| (matrix.inverse().transpose() * n).normalize();
    assert!(lights.iter().all(|light| light.node.is_none()));
    assert_eq!(lights[0].kind, LightKind::Point { position: middle });
    assert_eq!(lights[1].kind, LightKind::Directional { direction: along });
    assert!(matches!(lights[2].kind,
        LightKind::Spot { position, direction, inner: 0.2, outer: 0.3 }
            if position == middle && direction == along));
    let LightKind::Rectangle {
        edge_u: u,
        edge_v: v,
        ..
    } = lights[3].kind
    else {
        panic!("{:?}", lights[3]);
    };
    let expected = normal_of(edge_u.cross(edge_v));
    assert!(u.cross(v).normalize().distance(expected) < 1e-12);
    assert!(u.distance(matrix * edge_u) < 1e-12);
    let LightKind::Disc { normal, radius, .. } = lights[4].kind else {
        panic!("{:?}", lights[4]);
    };
    assert!(normal.distance(normal_of(direction)) < 1e-12);
    // The area of the image is the determinant times the length of the transformed normal.
    let factor = (matrix.inverse().transpose() * direction).length();
    assert!((radius * radius - 4.0 * factor).abs() < 1e-12);
    assert!(
        matches!(lights[5].kind, LightKind::Sphere { radius, .. } if (radius - 2.0).abs() < 1e-12)
    );
}

#[test]
fn lights_off_or_hidden_are_black_and_keep_their_position() {
    let bright = Light {
        color: Vec3::ONE,
        visible: true,
        ..Light::default()
    };
    let mut scene = scene(vec![Node::default(), Node::default()], vec![]);
    scene.nodes[1].parent = Some(0);
    scene.lights = vec![
        bright.clone(),
        Light {
            node: Some(1),
            ..bright.clone()
        },
        bright,
    ];
    let switch = |values: [f64; 2]| Curve {
        interpolation: Interpolation::Step,
        ..scalars(&[0.0, 1.0], &values)
    };
    scene.tracks = vec![
        track(Target::Light(0, LightProperty::On), switch([1.0, 0.0])),
        node(0, NodeProperty::Visible, switch([0.0, 1.0])),
        track(
            Target::Light(2, LightProperty::Intensity),
            scalars(&[0.0, 1.0], &[0.5, 3.0]),
        ),
        track(
            Target::Light(2, LightProperty::Color),
            vectors(&[0.0], &[dvec3(1.0, 2.0, 4.0)]),
        ),
    ];
    let shown = |t: f64| {
        let lights = scene.frame(t).lights;
        [0, 1, 2].map(|i| (lights[i].color, lights[i].visible))
    };
    let last = |factor: f32| (Vec3::new(1.0, 2.0, 4.0) * factor, true);
    assert_eq!(
        shown(0.0),
        [(Vec3::ONE, true), (Vec3::ZERO, false), last(0.5)]
    );
    assert_eq!(
        shown(1.0),
        [(Vec3::ZERO, false), (Vec3::ONE, true), last(3.0)]
    );
}

#[test]
fn overshooting_cubics_stay_in_range() {
    let plunge = |values: [f64; 4]| Curve {
        interpolation: Interpolation::CatmullRom,
        ..scalars(&[0.0, 1.0, 1.1, 2.0], &values)
    };
    let colors = Curve {
        values: Values::Vector([1.0, 0.0, 0.0, 1.0].map(DVec3::splat).to_vec()),
        ..plunge([0.0; 4])
    };
    let mut scene = scene(vec![], vec![]);
    scene.lights = vec![Light::default()];
    scene.cameras[0].lens = Some(Lens {
        radius: 0.1,
        focus_distance: 3.0,
        blade_count: 0,
        blade_rotation: 0.0,
    });
    let material = |property| Target::Material(0, property);
    scene.tracks = vec![
        Track {
            targets: vec![
                material(MaterialProperty::Ior),
                material(MaterialProperty::Shininess),
                Target::Camera(0, CameraProperty::FovY),
                Target::Camera(0, CameraProperty::FocusDistance),
                Target::Camera(0, CameraProperty::LensRadius),
                Target::Light(0, LightProperty::Intensity),
            ],
            curve: plunge([3.0, 0.001, 0.001, 3.0]),
        },
        track(
            material(MaterialProperty::Opacity),
            plunge([0.0, 1.0, 1.0, 0.0]),
        ),
        Track {
            targets: vec![
                material(MaterialProperty::Diffuse),
                material(MaterialProperty::Absorption),
                Target::Light(0, LightProperty::Color),
            ],
            curve: colors,
        },
    ];
    let mut overshot = false;
    for i in 0..=200 {
        let t = f64::from(i) / 100.0;
        overshot |= scalar(&scene.tracks[0].curve, t) < 0.0;
        let frame = scene.frame(t);
        let lens = frame.camera.lens.expect("a lens");
        let material = &frame.materials[0];
        assert!(frame.camera.fov_y > 0.0 && frame.camera.fov_y < PI);
        assert!(lens.radius > 0.0 && lens.focus_distance > 0.0);
        assert!(frame.lights[0].color.min_element() >= 0.0);
        assert!(material.classical().ior > 0.0 && material.classical().shininess >= 0.0);
        assert!((0.0..=1.0).contains(&material.classical().opacity));
        assert!(material.classical().diffuse.min_element() >= 0.0);
        assert!(material.classical().absorption.min_element() >= 0.0);
    }
    assert!(overshot, "the test shows nothing");
}

#[test]
fn bounds_include_objects_on_nodes() {
    let mut scene = scene(
        vec![Node {
            rotation: DQuat::from_rotation_z(FRAC_PI_2),
            translation: dvec3(10.0, 0.0, 0.0),
            scale: dvec3(1.0, 3.0, 1.0),
            ..Node::default()
        }],
        vec![],
    );
    scene.shapes = vec![Shape {
        geometry: Geometry::Sphere {
            center: DVec3::X,
            radius: 0.5,
        },
        material: 0,
        node: Some(0),
        name: String::new(),
    }];
    scene.meshes = vec![
        Mesh {
            positions: vec![Vec3::ZERO, Vec3::Y],
            ..Mesh::default()
        }
        .into(),
    ];
    scene.instances = vec![Instance {
        mesh: 0,
        placement: DAffine3::from_translation(DVec3::Y),
        node: Some(0),
        name: String::new(),
    }];
    // A quarter turn about z takes x to y and y to −x.
    let (min, max) = scene.bounds().expect("bounds");
    assert!(min.distance(dvec3(4.0, 0.0, -0.5)) < 1e-12, "{min}");
    assert!(max.distance(dvec3(11.5, 1.5, 0.5)) < 1e-12, "{max}");
}

#[test]
fn tracks_accept_values_of_their_type_only() {
    let rotations = Values::Rotation(vec![DQuat::IDENTITY]);
    let vectors = Values::Vector(vec![DVec3::ONE]);
    let scalars = Values::Scalar(vec![1.0]);
    let rows = [
        (
            Target::Node(0, NodeProperty::Rotation),
            [true, false, false],
        ),
        (Target::Node(0, NodeProperty::Angles), [false, true, false]),
        (Target::Node(0, NodeProperty::Visible), [false, false, true]),
        (Target::Camera(0, CameraProperty::Up), [false, true, false]),
        (
            Target::Camera(0, CameraProperty::FovY),
            [false, false, true],
        ),
        (Target::Light(0, LightProperty::Color), [false, true, false]),
        (Target::Light(0, LightProperty::On), [false, false, true]),
        (
            Target::Material(0, MaterialProperty::Reflect),
            [false, true, false],
        ),
        (
            Target::Material(0, MaterialProperty::Ior),
            [false, false, true],
        ),
    ];
    for (target, expected) in rows {
        let takes = [&rotations, &vectors, &scalars].map(|values| target.accepts(values));
        assert_eq!(takes, expected, "{target:?}");
    }
    let wrong = rotation_of_wrong_kind();
    assert_eq!(
        wrong.frame(0.0).nodes[0].world_from_node,
        DAffine3::IDENTITY
    );
}

fn rotation_of_wrong_kind() -> Scene {
    let curve = vectors(&[0.0], &[DVec3::ONE]);
    scene(
        vec![Node::default()],
        vec![node(0, NodeProperty::Rotation, curve)],
    )
}
