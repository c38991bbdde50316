//! Numbers as they would be written by hand, provided that they preserve the exact value.

use crate::import::native::file::TransformTable;
use crate::import::native::values::{Matrix, Quaternion, Vector, differing};
use glam::{DAffine3, DQuat, DVec3, EulerRot, Vec3};
use glimray_scene::{Transform, rotation};

/// The numbers of decimals that are tried, in order.
const DECIMALS: [usize; 7] = [0, 1, 2, 3, 5, 8, 11];

/// The shortest numbers near `exact` for which `holds` is true.
pub(super) fn shortest<const N: usize>(
    exact: [f64; N],
    holds: impl Fn([f64; N]) -> bool,
) -> Option<[f64; N]> {
    let decimals = DECIMALS.map(Some).into_iter();
    for decimals in decimals.chain([None]) {
        let rounded = exact.map(|value| match decimals {
            Some(count) => format!("{value:.count$}").parse().unwrap_or(value) + 0.0,
            None => format!("{value:.14e}").parse().unwrap_or(value),
        });
        if holds(rounded) {
            return Some(rounded);
        }
    }
    holds(exact).then_some(exact)
}

/// The angle in degrees that converts to exactly these radians, if there is one.
pub(super) fn degrees(radians: f64) -> Option<f64> {
    let is_it = |degrees: f64| degrees.to_radians().to_bits() == radians.to_bits();
    let near = radians.to_degrees();
    shortest([near], |[degrees]| is_it(degrees))
        .map(|[degrees]| degrees)
        .or_else(|| {
            [near.next_up(), near.next_down()]
                .into_iter()
                .find(|d| is_it(*d))
        })
}

pub(super) fn is_same(a: DAffine3, b: DAffine3) -> bool {
    a.to_cols_array().map(f64::to_bits) == b.to_cols_array().map(f64::to_bits)
}

/// Whether two vectors are the same, with the signs of zeros.
pub(super) fn same_bits(a: Vec3, b: Vec3) -> bool {
    a.to_array().map(f32::to_bits) == b.to_array().map(f32::to_bits)
}

/// An angle in degrees, or in radians if no degrees that `is_read` accepts give it.
pub(super) fn angle(radians: f64, is_read: impl Fn(&f64) -> bool) -> (Option<f64>, Option<f64>) {
    match degrees(radians).filter(is_read) {
        Some(degrees) => (Some(degrees), None),
        None => (None, Some(radians)),
    }
}

/// A transform as a table; `None` for the identity.
pub(super) fn transform(affine: DAffine3) -> Option<TransformTable> {
    if is_same(affine, DAffine3::IDENTITY) {
        return None;
    }
    let mut table = TransformTable::default();
    if is_same(DAffine3::from_translation(affine.translation), affine) {
        table.translate = Some(affine.translation.into());
    } else if let Some(transform) = decomposed(affine) {
        table.translate = differing(transform.translate, DVec3::ZERO);
        table.rotate_deg = differing(transform.rotate_deg, DVec3::ZERO);
        table.scale = differing(transform.scale, DVec3::ONE);
    } else {
        table.matrix = Some(Matrix(affine));
    }
    Some(table)
}

/// The scale, angles and translation that give exactly `affine`, if they are short enough.
fn decomposed(affine: DAffine3) -> Option<Transform> {
    let (near, is_near) = Transform::of(affine);
    if !is_near {
        return None;
    }
    let mirrored = affine.matrix3.determinant() < 0.0;
    // Combinations of signs of the scale, mirroring or not; the most likely one comes first.
    let signs: &[[f64; 3]] = match mirrored {
        true => &[
            [-1.0, 1.0, 1.0],
            [1.0, -1.0, 1.0],
            [1.0, 1.0, -1.0],
            [-1.0; 3],
        ],
        false => &[
            [1.0; 3],
            [-1.0, -1.0, 1.0],
            [-1.0, 1.0, -1.0],
            [1.0, -1.0, -1.0],
        ],
    };
    signs.iter().find_map(|&sign| {
        let scale = near.scale.abs() * DVec3::from(sign);
        let turned = affine * DAffine3::from_scale(scale.recip());
        let (_, turn, _) = turned.to_scale_rotation_translation();
        angles(turn).into_iter().find_map(|angles| {
            let of = |n: [f64; 9]| Transform {
                translate: DVec3::new(n[0], n[1], n[2]),
                rotate_deg: DVec3::new(n[3], n[4], n[5]),
                scale: DVec3::new(n[6], n[7], n[8]),
            };
            let t = affine.translation.to_array();
            let [a, s] = [angles.to_array(), scale.to_array()];
            let near = [t[0], t[1], t[2], a[0], a[1], a[2], s[0], s[1], s[2]];
            // The translation is exact already: rounding it would not help.
            let exact = |n: [f64; 9]| Transform {
                translate: affine.translation,
                ..of(n)
            };
            shortest(near, |n| is_same(exact(n).affine(), affine)).map(exact)
        })
    })
}

/// Equivalent angles about x, y and z in degrees.
fn angles(turn: DQuat) -> [DVec3; 2] {
    let (z, y, x) = turn.to_euler(EulerRot::ZYX);
    let first = DVec3::new(x, y, z);
    let half = std::f64::consts::PI;
    let wrap = |angle: f64| angle - (angle / (2.0 * half)).round() * 2.0 * half;
    let second = DVec3::new(wrap(x + half), wrap(half - y), wrap(z + half));
    let mut both = [first, second].map(|v| DVec3::from(v.to_array().map(f64::to_degrees)));
    both.sort_by(|a, b| a.length_squared().total_cmp(&b.length_squared()));
    both
}

/// A rotation as angles in degrees or a quaternion; neither for the identity.
pub(super) fn turn(turn: DQuat) -> (Option<Vector>, Option<Quaternion>) {
    let bits = |q: DQuat| q.to_array().map(f64::to_bits);
    if bits(turn) == bits(DQuat::IDENTITY) {
        return (None, None);
    }
    let found = angles(turn).into_iter().find_map(|angles| {
        shortest(angles.to_array(), |n| {
            bits(rotation(n.into())) == bits(turn)
        })
    });
    match found {
        Some(degrees) => (Some(Vector(degrees.into())), None),
        None => (None, Some(Quaternion(turn))),
    }
}
