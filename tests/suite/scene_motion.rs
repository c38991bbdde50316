//! The frames of an open shutter: as many as it takes, and no more.

use crate::support::effort;
use glam::{DQuat, DVec3, dvec3};
use glimray::scene::{
    Beyond, Camera, CameraProperty, Curve, Easing, Frame, Interpolation, Light, LightKind,
    LightProperty, Material, MaterialProperty, Node, NodeProperty, Scene, Target, Track, Values,
};
use std::f64::consts::TAU;

fn curve(times: &[f64], values: Values) -> Curve {
    Curve {
        times: times.to_vec(),
        values,
        interpolation: Interpolation::Linear,
        easing: Easing::None,
        beyond: Beyond::Hold,
    }
}

fn vectors(times: &[f64], values: &[DVec3]) -> Curve {
    curve(times, Values::Vector(values.to_vec()))
}

/// A scene of as many nodes, seen from ten units in front of the origin.
fn scene(nodes: usize, tracks: Vec<(Target, Curve)>) -> Scene {
    Scene {
        materials: vec![Material::default()],
        cameras: vec![Camera {
            look_from: dvec3(0.0, 0.0, 10.0),
            look_at: DVec3::ZERO,
            ..Camera::default()
        }],
        nodes: vec![Node::default(); nodes],
        tracks: (tracks.into_iter())
            .map(|(target, curve)| Track {
                targets: vec![target],
                curve,
            })
            .collect(),
        ..Scene::default()
    }
}

/// A wheel that turns as often in each second.
fn wheel(turns: f64) -> Scene {
    let turn = Curve {
        beyond: Beyond::Repeat,
        ..vectors(&[0.0, 1.0], &[DVec3::ZERO, dvec3(0.0, 0.0, TAU * turns)])
    };
    scene(1, vec![(Target::Node(0, NodeProperty::Angles), turn)])
}

/// Least k of frames that turn evenly by `angle` in all, each by at most `most`.
fn doublings(angle: f64, most: f64) -> u32 {
    (0..8)
        .find(|k| angle / f64::from(1 << k) <= most)
        .unwrap_or(8)
}

#[test]
fn what_stands_still_takes_one_frame() {
    let still = scene(3, vec![]);
    assert_eq!(still.motion_samples(0.0, 1.0), [still.frame(0.0)]);
    let wheel = wheel(1.0);
    assert_eq!(wheel.motion_samples(0.3, 0.3), [wheel.frame(0.3)]);
    let slide = vectors(&[1.0, 2.0], &[DVec3::ZERO, DVec3::X]);
    let late = scene(1, vec![(Target::Node(0, NodeProperty::Translation), slide)]);
    assert_eq!(
        late.motion_samples(0.0, 1.0).len(),
        1,
        "before its first key"
    );
    assert_eq!(late.motion_samples(2.0, 3.0).len(), 1, "after its last key");
    assert_eq!(late.motion_samples(0.5, 1.5).len() % 2, 1);
    let rest = vectors(&[0.0, 1.0, 2.0], &[DVec3::X, DVec3::X, DVec3::Y]);
    let rests = scene(1, vec![(Target::Node(0, NodeProperty::Translation), rest)]);
    assert_eq!(
        rests.motion_samples(0.2, 0.8).len(),
        1,
        "between equal keys"
    );
}

#[test]
fn a_straight_even_way_takes_two_frames() {
    let slide = vectors(&[0.0, 2.0], &[DVec3::ZERO, dvec3(100.0, 3.0, 0.0)]);
    let scene = scene(1, vec![(Target::Node(0, NodeProperty::Translation), slide)]);
    let samples = scene.motion_samples(0.5, 1.0);
    assert_eq!(samples, [scene.frame(0.5), scene.frame(1.0)]);
}

#[test]
fn a_wheel_takes_as_many_frames_as_it_turns() {
    // Whole turns too, which end where they started.
    for turns in [0.01, 0.1, 0.5, 1.0, 2.0, 3.0] {
        let scene = wheel(turns);
        let samples = scene.motion_samples(0.0, 1.0);
        let expected = (1 << doublings(TAU * turns, 0.1)) + 1;
        assert_eq!(samples.len(), expected, "{turns} turns");
        for (i, frame) in samples.iter().enumerate() {
            let t = i as f64 / (expected - 1) as f64;
            let rim = frame.nodes[0].world_from_node.transform_point3(DVec3::X);
            assert!((rim.length() - 1.0).abs() < 1e-12);
            let (sin, cos) = (TAU * turns * t).sin_cos();
            // The last one is that before the next round starts.
            assert!(rim.distance(dvec3(cos, sin, 0.0)) < 1e-6, "{turns} at {t}");
        }
    }
    assert_eq!(wheel(1000.0).motion_samples(0.0, 1.0).len(), 257);
}

#[test]
fn a_jump_inside_a_shot_takes_all_frames_and_one_at_its_end_none() {
    let jump = Curve {
        interpolation: Interpolation::Step,
        ..vectors(&[0.0, 1.0], &[DVec3::ZERO, DVec3::X])
    };
    let scene = scene(1, vec![(Target::Node(0, NodeProperty::Translation), jump)]);
    assert_eq!(scene.motion_samples(0.5, 1.5).len(), 257);
    assert_eq!(scene.motion_samples(0.5, 1.0), [scene.frame(0.5)]);
    assert_eq!(scene.motion_samples(1.0, 1.5), [scene.frame(1.0)]);
}

#[test]
fn rotations_that_come_back_between_the_ends_are_seen() {
    let thirds = [0.0, 1.0, 2.0, 3.0].map(|i| DQuat::from_rotation_z(TAU * i / 3.0));
    let turn = curve(&[0.0, 1.0, 2.0, 3.0], Values::Rotation(thirds.to_vec()));
    let scene = scene(1, vec![(Target::Node(0, NodeProperty::Rotation), turn)]);
    assert_eq!(
        scene.motion_samples(0.0, 3.0).len(),
        (1 << doublings(TAU, 0.1)) + 1
    );
}

#[test]
fn a_way_that_comes_back_between_the_ends_is_seen() {
    // Out and back within a sixteenth of the samples, at no simple share of it.
    let times = [0.0, 0.30, 0.33, 0.36, 1.0];
    let values = [DVec3::ZERO, DVec3::ZERO, DVec3::X, DVec3::ZERO, DVec3::ZERO];
    let jerk = vectors(&times, &values);
    let scene = scene(1, vec![(Target::Node(0, NodeProperty::Translation), jerk)]);
    let samples = scene.motion_samples(0.0, 1.0);
    let furthest = (samples.iter())
        .map(|frame| frame.nodes[0].world_from_node.translation.x)
        .fold(0.0, f64::max);
    assert!(furthest > 0.9, "{furthest} in {} frames", samples.len());
}

/// How far what is between two frames is off, in the worst case, for the origin of node 0.
fn worst_chord(scene: &Scene, samples: &[Frame], open: f64, close: f64) -> f64 {
    let place = |frame: &Frame| frame.nodes[0].world_from_node.translation;
    let count = samples.len() - 1;
    let mut worst = 0.0_f64;
    for i in 0..count * 32 {
        let t = i as f64 / 32.0;
        let (a, b) = (place(&samples[i / 32]), place(&samples[i / 32 + 1]));
        let time = open + (close - open) * t / count as f64;
        worst = worst.max(a.lerp(b, t.fract()).distance(place(&scene.frame(time))));
    }
    worst
}

#[test]
fn chords_of_a_bent_way_are_as_good_as_seen_from_the_camera() {
    let times = [0.0, 0.4, 1.0, 1.3];
    let values = [DVec3::ZERO, DVec3::X, dvec3(1.0, 1.0, 0.0), DVec3::Y];
    for interpolation in [Interpolation::Linear, Interpolation::CatmullRom] {
        for easing in [Easing::None, Easing::IN_OUT] {
            let bent = Curve {
                interpolation,
                easing,
                ..vectors(&times, &values)
            };
            let mut counts = Vec::new();
            for distance in [10.0, 1000.0] {
                let mut scene = scene(
                    1,
                    vec![(Target::Node(0, NodeProperty::Translation), bent.clone())],
                );
                scene.cameras[0].look_from.z = distance;
                let samples = scene.motion_samples(0.1, 1.2);
                let worst = worst_chord(&scene, &samples, 0.1, 1.2);
                // A little more than at the quarters, where it is measured.
                assert!(worst <= 1.3e-3 * distance, "{worst} from {distance}");
                counts.push(samples.len());
            }
            assert!(counts[1] < counts[0], "{counts:?}");
        }
    }
}

#[test]
fn a_camera_on_a_turning_node_takes_small_steps() {
    let turn = vectors(&[0.0, 1.0], &[DVec3::ZERO, dvec3(0.0, 1.0, 0.0)]);
    let mut scene = scene(1, vec![(Target::Node(0, NodeProperty::Angles), turn)]);
    scene.cameras[0].node = Some(0);
    let samples = scene.motion_samples(0.0, 1.0);
    assert_eq!(samples.len(), (1 << doublings(1.0, 0.02)) + 1);
    let forward = |frame: &Frame| (frame.camera.look_at - frame.camera.look_from).normalize();
    for pair in samples.windows(2) {
        let turn = forward(&pair[0]).angle_between(forward(&pair[1]));
        assert!(turn <= 0.02, "{turn}");
    }
}

#[test]
fn a_pan_of_the_camera_takes_small_steps() {
    let pan = vectors(&[0.0, 1.0], &[dvec3(-3.0, 0.0, 0.0), dvec3(3.0, 0.0, 0.0)]);
    let scene = scene(0, vec![(Target::Camera(0, CameraProperty::LookAt), pan)]);
    let samples = scene.motion_samples(0.0, 1.0);
    let forward = |frame: &Frame| (frame.camera.look_at - frame.camera.look_from).normalize();
    let most = (samples.windows(2))
        .map(|pair| forward(&pair[0]).angle_between(forward(&pair[1])))
        .fold(0.0, f64::max);
    assert!(most <= 0.0201, "{most}");
    assert!(samples.len() <= 65, "{}", samples.len());
}

#[test]
fn what_the_shutter_freezes_stays_as_it_opened() {
    let slide = vectors(&[0.0, 1.0], &[DVec3::ZERO, DVec3::X]);
    let switch = |values: [f64; 2]| Curve {
        interpolation: Interpolation::Step,
        ..curve(&[0.0, 0.5], Values::Scalar(values.to_vec()))
    };
    let color = vectors(&[0.0, 1.0], &[DVec3::ONE, DVec3::ZERO]);
    let mut scene = scene(
        3,
        vec![
            (Target::Node(0, NodeProperty::Translation), slide),
            (Target::Node(1, NodeProperty::Visible), switch([1.0, 0.0])),
            (Target::Node(2, NodeProperty::Visible), switch([0.0, 1.0])),
            (Target::Light(0, LightProperty::On), switch([1.0, 0.0])),
            (Target::Light(1, LightProperty::On), switch([0.0, 1.0])),
            (Target::Material(0, MaterialProperty::Diffuse), color),
        ],
    );
    scene.lights = vec![
        Light {
            color: glam::Vec3::ONE,
            ..Light::default()
        };
        2
    ];
    let samples = scene.motion_samples(0.25, 0.75);
    assert!(samples.len() > 1);
    for frame in &samples {
        assert_eq!(frame.materials, samples[0].materials);
        assert_eq!(frame.lights, samples[0].lights);
        assert_eq!([1, 2].map(|i| frame.nodes[i].visible), [true, false]);
    }
    // The pictures before and after do change.
    assert_ne!(scene.frame(0.75).materials, samples[0].materials);
    assert_ne!(scene.frame(0.75).lights, samples[0].lights);
    // What the shutter freezes is no movement.
    scene.tracks.remove(0);
    assert_eq!(scene.motion_samples(0.25, 0.75).len(), 1);
}

#[test]
fn a_light_on_a_bent_way_takes_more_than_two_frames() {
    let bent = vectors(&[0.0, 0.5, 1.0], &[DVec3::ZERO, DVec3::ONE, DVec3::X]);
    let mut scene = scene(0, vec![(Target::Light(0, LightProperty::Position), bent)]);
    scene.lights = vec![Light {
        kind: LightKind::Point {
            position: DVec3::ZERO,
        },
        ..Light::default()
    }];
    assert_eq!(scene.motion_samples(0.0, 1.0).len(), 3);
}

#[test]
fn ten_thousand_still_nodes_cost_little() {
    let mut scene = wheel(0.3);
    scene.nodes.extend(vec![Node::default(); 10_000]);
    let samples = effort::within(1000.0, || scene.motion_samples(0.0, 1.0));
    assert_eq!(samples.len(), 33);
}

#[test]
fn shots_far_out_in_time_end() {
    for beyond in [Beyond::Hold, Beyond::Repeat, Beyond::PingPong] {
        let mut scene = wheel(0.3);
        scene.tracks[0].curve.beyond = beyond;
        for (open, close) in [(1e17, 1.1e17), (1e300, f64::MAX), (-1e300, 1e300)] {
            let samples = scene.motion_samples(open, close);
            assert!(samples.len() <= 257);
            for frame in samples {
                assert!(frame.nodes[0].world_from_node.is_finite());
            }
        }
    }
}
