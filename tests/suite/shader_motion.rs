//! `lib/motion.wesl` and moving nodes: interpolation between keys, against f64 and against invariants.

use crate::support::{
    harness::gpu,
    random::Random,
    types::{Moment, Node, Space},
    verdict::{Tolerance, Verdict, ulp},
};
use glam::{DMat3, DQuat, DVec3};
use glimray::layout::{
    ATTENUATION_INVERSE_SQUARE, ATTENUATION_NONE, LIGHT_DISC, LIGHT_SPOT, PackedCamera, PackedKey,
    PackedLight,
};
use glimray_shader_test::Plain;

const SPACE: &str = "lib::motion::space_between";

fn vector(v: [f32; 3]) -> DVec3 {
    DVec3::from(v.map(f64::from))
}

fn matrix(columns: [[f32; 3]; 3]) -> DMat3 {
    let [x, y, z] = columns.map(vector);
    DMat3::from_cols(x, y, z)
}

fn norm(m: DMat3) -> f64 {
    m.to_cols_array().iter().map(|c| c * c).sum::<f64>().sqrt()
}

fn quaternion(random: &mut Random) -> DQuat {
    DQuat::from_axis_angle(random.direction(), random.between(-3.1, 3.1))
}

fn key(translation: DVec3, rotation: DQuat, stretch: DMat3) -> Plain<PackedKey> {
    let [x, y, z] = [stretch.x_axis, stretch.y_axis, stretch.z_axis];
    Plain(PackedKey {
        translation: translation.as_vec3().into(),
        rotation: rotation.as_quat().into(),
        stretch: DVec3::new(x.x, y.y, z.z).as_vec3().into(),
        shear: DVec3::new(y.z, x.z, x.y).as_vec3().into(),
        ..PackedKey::default()
    })
}

/// The symmetric matrix of a key.
fn stretch(key: &PackedKey) -> DMat3 {
    let ([xx, yy, zz], [yz, xz, xy]) = (key.stretch, key.shear);
    matrix([[xx, xy, xz], [xy, yy, yz], [xz, yz, zz]])
}

/// Scales along three axes at right angles: a symmetric matrix.
fn along(axes: DQuat, scales: DVec3) -> DMat3 {
    let turn = DMat3::from_quat(axes);
    turn * DMat3::from_diagonal(scales) * turn.transpose()
}

#[test]
fn a_moment_lies_between_the_right_two_keys() {
    let mut inputs = Vec::new();
    for count in [2_u32, 3, 5, 9, 17, 33, 65, 129, 257] {
        inputs.extend((0..=256).map(|i| (i as f32 / 256.0, count)));
        inputs.push((1.0_f32.next_down(), count));
    }
    let moments: Vec<Moment> = gpu().map("lib::motion::moment_of", &inputs);
    let mut verdict = Verdict::on("moment_of");
    for ((time, count), moment) in inputs.iter().zip(&moments) {
        let at = f64::from(*time) * f64::from(count - 1);
        let name = format!("{time} of {count} keys");
        verdict.that(&name, moment.key + 2 <= *count, || format!("{moment:?}"));
        let fraction = f64::from(moment.fraction);
        let is_there = (f64::from(moment.key) + fraction - at).abs() <= 2.0 * ulp(at.max(1.0));
        verdict.that(&name, is_there && (0.0..=1.0).contains(&fraction), || {
            format!("{moment:?}, not {at}")
        });
    }
    verdict.close();
}

#[test]
fn a_rotation_matrix_turns_as_its_quaternion() {
    let mut random = Random::new(31);
    let mut quaternions: Vec<DQuat> = (0..400).map(|_| quaternion(&mut random)).collect();
    let half = std::f64::consts::PI;
    quaternions.extend([DQuat::IDENTITY, -DQuat::IDENTITY]);
    quaternions
        .extend([DVec3::X, DVec3::Y, DVec3::Z].map(|axis| DQuat::from_axis_angle(axis, half)));
    const PROBE: &str = "
        import package::lib::motion::rotation_matrix;
        fn probe(q: vec4f, v: vec3f) -> vec3f { return rotation_matrix(q) * v; }
    ";
    let inputs: Vec<([f32; 4], [f32; 3])> = (quaternions.iter())
        .map(|q| (q.as_quat().into(), random.direction().as_vec3().into()))
        .collect();
    let turned: Vec<[f32; 3]> = gpu().map_source(PROBE, &inputs);
    let mut verdict = Verdict::on("rotation_matrix");
    for ((q, v), got) in inputs.iter().zip(&turned) {
        let q = DQuat::from_array(q.map(f64::from)).normalize();
        // q v q*, by products of quaternions.
        let v = vector(*v);
        let p = q * DQuat::from_xyzw(v.x, v.y, v.z, 0.0) * q.conjugate();
        let expected = [p.x, p.y, p.z];
        verdict.near(
            format!("{q} of {v}"),
            got,
            &expected,
            Tolerance::Absolute(6e-7),
        );
    }
    verdict.close();
}

#[test]
fn interpolated_transforms_are_the_mean_and_have_the_right_inverse() {
    let mut random = Random::new(32);
    let mut inputs = Vec::new();
    for i in 0..3000 {
        let size = 10f64.powf(random.between(-11.0, 11.0));
        let mirror = if i % 3 == 0 { -1.0 } else { 1.0 };
        // Up to a hundred times as long as wide.
        let mut scales = || {
            DVec3::from_array(std::array::from_fn(|_| {
                10f64.powf(random.between(-2.0, 0.0))
            }))
        };
        let (first, second) = (scales() * size * mirror, scales() * size * mirror);
        let (axes, turn) = (quaternion(&mut random), quaternion(&mut random));
        // As close as the host places keys: a tenth of a radian.
        let small = |random: &mut Random| DQuat::from_scaled_axis(0.1 * random.in_cube());
        let (a, b) = (
            random.in_cube() * 10.0 * size,
            random.in_cube() * 10.0 * size,
        );
        let fraction = [0.0, 0.5, 1.0, random.between(0.0, 1.0)][i % 4] as f32;
        inputs.push((
            key(a, turn, along(axes, first)),
            key(
                b,
                small(&mut random) * turn,
                along(small(&mut random) * axes, second),
            ),
            fraction,
        ));
    }
    let spaces: Vec<Space> = gpu().map(SPACE, &inputs);
    let mut verdict = Verdict::on("space_between");
    for (i, ((a, b, fraction), space)) in inputs.iter().zip(&spaces).enumerate() {
        let fraction = f64::from(*fraction);
        let translation = vector(a.translation).lerp(vector(b.translation), fraction);
        let quat = |key: &PackedKey| DQuat::from_array(key.rotation.map(f64::from));
        let rotation = (quat(a) * (1.0 - fraction) + quat(b) * fraction).normalize();
        let stretched = stretch(a) * (1.0 - fraction) + stretch(b) * fraction;
        let linear = DMat3::from_quat(rotation) * stretched;
        let inverse = linear.inverse();
        let condition = norm(linear) * norm(inverse);
        let (got, got_inverse) = (matrix(space.linear), matrix(space.inverse));
        let off = vector(space.translation).distance(translation);
        let reach = vector(a.translation)
            .length()
            .max(vector(b.translation).length());
        verdict.that(format!("place {i}"), off <= 2e-7 * reach, || {
            format!("{off} of {reach}")
        });
        let off = norm(got - linear) / norm(linear);
        verdict.that(
            format!("linear {i}"),
            off <= gpu().bound(1e-6, 1.5e-6),
            || off,
        );
        let off = norm(got_inverse - inverse) / norm(inverse);
        verdict.that(
            format!("inverse {i} of condition {condition:.0}"),
            off <= 1e-6 * condition,
            || off,
        );
    }
    verdict.close();
}

#[test]
fn rotating_objects_keep_their_size_and_shape_at_every_moment() {
    let mut random = Random::new(33);
    let mut inputs = Vec::new();
    let mut sizes = Vec::new();
    for _ in 0..300 {
        let size =
            10f64.powf(random.between(-3.0, 3.0)) * if random.below(2) == 0 { 1.0 } else { -1.0 };
        let turn = quaternion(&mut random);
        // Up to a radian, far more than the host allows between two keys.
        let next = DQuat::from_axis_angle(random.direction(), random.between(0.0, 1.0)) * turn;
        let ball = DMat3::from_diagonal(DVec3::splat(size));
        for fraction in [0.0, 0.1, 0.25, 0.5, 0.9, 1.0_f32] {
            inputs.push((
                key(DVec3::ZERO, turn, ball),
                key(DVec3::ZERO, next, ball),
                fraction,
            ));
            sizes.push(f64::from(size as f32));
        }
    }
    let spaces: Vec<Space> = gpu().map(SPACE, &inputs);
    let mut verdict = Verdict::on("space_between");
    for (space, size) in spaces.iter().zip(sizes) {
        let linear = matrix(space.linear) * size.recip();
        let off = norm(linear.transpose() * linear - DMat3::IDENTITY);
        verdict.that(format!("size {size}"), off < 2e-6, || {
            format!("{off} off a rotation")
        });
        verdict.that("not mirrored", linear.determinant() > 0.0, || linear);
    }
    verdict.close();
}

/// Distinct words of a struct, so that no two can be confused.
fn different(random: &mut Random, count: usize) -> Vec<f32> {
    (0..count)
        .map(|_| random.between(0.1, 9.0) as f32)
        .collect()
}

/// The rounding of a number between two: on GPUs `mix` may add a part of their difference.
fn interpolated(a: f32, b: f32) -> Tolerance {
    let larger = f64::from(a.abs().max(b.abs()));
    gpu().bound(Tolerance::Ulps(4.0), Tolerance::Absolute(4.0 * ulp(larger)))
}

#[test]
fn every_member_of_a_camera_is_interpolated() {
    let mut random = Random::new(34);
    let mut camera = |blades| {
        let mut words = different(&mut random, 16);
        words[15] = f32::from_bits(blades);
        Plain(*bytemuck::from_bytes::<PackedCamera>(bytemuck::cast_slice(
            &words,
        )))
    };
    let inputs: Vec<_> = [0.0, 0.25, 0.7, 1.0_f32]
        .map(|fraction| (camera(5), camera(5), fraction))
        .into();
    let cameras: Vec<Plain<PackedCamera>> = gpu().map("lib::motion::camera_between", &inputs);
    let mut verdict = Verdict::on("camera_between");
    for ((a, b, fraction), got) in inputs.iter().zip(&cameras) {
        verdict.near("blades", &got.blade_count, &5, Tolerance::Exact);
        let words =
            |camera: &PackedCamera| -> Vec<f32> { bytemuck::cast_slice(&[*camera]).to_vec() };
        let (a, b, got) = (words(a), words(b), words(got));
        for i in 0..15 {
            let expected = f64::from(a[i]) * f64::from(1.0 - fraction) + f64::from(b[i] * fraction);
            verdict.near(
                format!("word {i} at {fraction}"),
                &got[i],
                &expected,
                interpolated(a[i], b[i]),
            );
        }
    }
    verdict.close();
}

#[test]
fn every_member_of_a_light_is_interpolated_and_its_direction_has_unit_length() {
    let mut random = Random::new(35);
    let mut light = |kind, attenuation, direction: DVec3| {
        let words = different(&mut random, 24);
        Plain(PackedLight {
            kind,
            attenuation,
            direction: direction.as_vec3().into(),
            sample_count: 7,
            ..*bytemuck::from_bytes::<PackedLight>(bytemuck::cast_slice(&words))
        })
    };
    let mut inputs = Vec::new();
    for fraction in [0.0, 0.3, 0.5, 1.0_f32] {
        for (kind, attenuation) in [
            (LIGHT_SPOT, ATTENUATION_NONE),
            (LIGHT_DISC, ATTENUATION_INVERSE_SQUARE),
        ] {
            inputs.push((
                light(kind, attenuation, DVec3::X),
                light(kind, attenuation, DVec3::NEG_Z),
                fraction,
            ));
        }
    }
    let lights: Vec<Plain<PackedLight>> = gpu().map("lib::motion::light_between", &inputs);
    let mut verdict = Verdict::on("light_between");
    for ((a, b, fraction), got) in inputs.iter().zip(&lights) {
        let s = f64::from(*fraction);
        let fixed = [got.kind, got.attenuation, got.sample_count];
        verdict.near(
            "tags",
            &fixed,
            &[a.kind, a.attenuation, 7],
            Tolerance::Exact,
        );
        let direction = DVec3::X.lerp(DVec3::NEG_Z, s).normalize();
        verdict.near(
            format!("direction at {s}"),
            &got.direction,
            &direction.to_array(),
            Tolerance::Absolute(3e-7),
        );
        let numbers = |light: &PackedLight| {
            [
                light.position,
                light.color,
                light.edge_u,
                light.edge_v,
                [light.cos_inner, light.cos_outer, light.radius],
            ]
            .concat()
        };
        for (i, ((a, b), got)) in numbers(a)
            .iter()
            .zip(numbers(b))
            .zip(numbers(got))
            .enumerate()
        {
            let expected = f64::from(*a) * (1.0 - s) + f64::from(b) * s;
            verdict.near(
                format!("number {i} at {s}"),
                &got,
                &expected,
                interpolated(*a, b),
            );
        }
    }
    verdict.close();
}

#[test]
fn a_light_that_turns_right_round_keeps_a_direction() {
    let light = |direction: DVec3| {
        Plain(PackedLight {
            direction: direction.as_vec3().into(),
            ..PackedLight::default()
        })
    };
    let inputs = [(light(DVec3::Y), light(DVec3::NEG_Y), 0.5_f32)];
    let lights: Vec<Plain<PackedLight>> = gpu().map("lib::motion::light_between", &inputs);
    assert_eq!(lights[0].direction, [0.0, 1.0, 0.0]);
}

/// Interpolated planes of a node, up to the rounding of its size and motion: packed boxes have more slack than
/// that.
#[test]
fn moving_nodes_are_interpolated_linearly() {
    let mut random = Random::new(36);
    let mut node = |lo: DVec3, size: f64| {
        let mut planes = || -> [[f32; 4]; 2] {
            let pairs: [[usize; 2]; 4] =
                std::array::from_fn(|_| [random.below(256), random.below(256)]);
            let pick = |of: fn(usize, usize) -> usize| pairs.map(|[a, b]| of(a, b) as f32);
            [pick(usize::min), pick(usize::max)]
        };
        let [[near_x, far_x], [near_y, far_y], [near_z, far_z]] = [planes(), planes(), planes()];
        let scale = random.in_cube() * 0.4 + 0.6;
        Node {
            lo: lo.as_vec3().into(),
            scale: (scale * size / 255.0).as_vec3().into(),
            near_x,
            far_x,
            near_y,
            far_y,
            near_z,
            far_z,
            child_count: 1 + random.below(4) as u32,
        }
    };
    let mut places = Random::new(37);
    let inputs: Vec<_> = (0..4000)
        .map(|i| {
            let size = 10f64.powf(places.between(-3.0, 3.0));
            let from = places.in_cube() * size * 1000.0;
            let way = places.in_cube() * size * [0.0, 0.1, 10.0][i % 3];
            let fraction = [0.0, 1.0, places.between(0.0, 1.0)][i / 3 % 3];
            (
                node(from, size),
                node(from + way, size * 1.7),
                fraction as f32,
            )
        })
        .collect();
    let nodes: Vec<Node> = gpu().map("lib::intersect::node::node_between", &inputs);
    let mut verdict = Verdict::on("node_between");
    for (i, ((a, b, fraction), got)) in inputs.iter().zip(&nodes).enumerate() {
        verdict.near(
            format!("child_count {i}"),
            &got.child_count,
            &a.child_count,
            Tolerance::Exact,
        );
        let rows = |node: &Node| {
            [
                [node.near_x, node.far_x],
                [node.near_y, node.far_y],
                [node.near_z, node.far_z],
            ]
        };
        let plane = |node: &Node, axis: usize, side: usize, child: usize| {
            f64::from(node.lo[axis])
                + f64::from(node.scale[axis]) * f64::from(rows(node)[axis][side][child])
        };
        for axis in 0..3 {
            let size = 255.0 * f64::from(a.scale[axis].max(b.scale[axis]));
            let way = (f64::from(a.lo[axis]) - f64::from(b.lo[axis])).abs();
            // Planes are measured from the lower corner at the first key, so they do not round like numbers of its size.
            let most = 3.0 * ulp(size + way);
            for side in 0..2 {
                for child in 0..4 {
                    let [from, to] = [a, b].map(|node| plane(node, axis, side, child));
                    let expected = from + (to - from) * f64::from(*fraction);
                    let off = plane(got, axis, side, child) - expected;
                    verdict.that(format!("node {i}, axis {axis}"), off.abs() <= most, || {
                        format!("{off} off {expected}, {most} allowed")
                    });
                }
            }
        }
    }
    verdict.close();
}

#[test]
fn every_power_of_two_of_a_pixels_moments_is_stratified() {
    let mut random = Random::new(38);
    let mut verdict = Verdict::on("stratified_1d");
    for key in [0, 1, u32::MAX]
        .into_iter()
        .chain((0..29).map(|_| random.word()))
    {
        let inputs: Vec<_> = (0..1024_u32).map(|index| (index, key)).collect();
        let times: Vec<f32> = gpu().map("lib::sampling::stratified_1d", &inputs);
        for k in 0..=10 {
            let mut strata = vec![0; 1 << k];
            for time in &times[..1 << k] {
                strata[(f64::from(*time) * f64::from(1 << k)) as usize] += 1;
            }
            let name = format!("the first 2^{k} moments of key {key:#x}");
            verdict.that(name, strata.iter().all(|&count| count == 1), || "uneven");
        }
    }
    verdict.close();
}
