//! Transforms of nodes, made invertible where they flatten space.

use glam::{DAffine3, DMat3, DQuat, DVec3};

/// Replaces a scale of 0, relative to the largest of the three, so that transforms are invertible.
const FLAT: f64 = 1e-6;

/// `q` with unit length, if it has a length.
pub fn unit(q: DQuat) -> Option<DQuat> {
    let length = q.length();
    (length.is_finite() && length > 1e-12).then(|| q * length.recip())
}

/// The linear part of the matrix of a node.
pub fn linear(matrix: &[f64; 16]) -> DMat3 {
    let column = |i: usize| DVec3::new(matrix[4 * i], matrix[4 * i + 1], matrix[4 * i + 2]);
    DMat3::from_cols(column(0), column(1), column(2))
}

/// `matrix` with a small extent along the normal of the plane that it flattens space to; tiny if it is 0.
pub fn thickened(matrix: DMat3) -> DMat3 {
    if matrix == DMat3::ZERO {
        return DMat3::from_diagonal(DVec3::splat(FLAT));
    }
    let most = matrix
        .to_cols_array()
        .map(f64::abs)
        .into_iter()
        .fold(0.0, f64::max);
    let unit = matrix * most.recip();
    if !unit.is_finite() || unit.determinant().abs() > FLAT * FLAT {
        return matrix;
    }
    let normal = |m: DMat3| {
        let crosses = [
            m.x_axis.cross(m.y_axis),
            m.y_axis.cross(m.z_axis),
            m.z_axis.cross(m.x_axis),
        ];
        let longest = crosses
            .into_iter()
            .max_by(|a, b| a.length().total_cmp(&b.length()));
        longest.unwrap_or_default().normalize_or_zero()
    };
    // Across the plane of its columns, for what lies across that of its rows.
    let (across, along) = (normal(unit), normal(unit.transpose()));
    let thin = DMat3::from_cols(across * along.x, across * along.y, across * along.z);
    let sign = if (unit + thin * FLAT).determinant() < 0.0 {
        -1.0
    } else {
        1.0
    };
    matrix + thin * (sign * FLAT * most)
}

/// `scale` with small numbers in place of 0.
pub fn extended(scale: DVec3) -> DVec3 {
    if scale == DVec3::ZERO {
        return DVec3::splat(FLAT);
    }
    let least = FLAT * scale.abs().max_element();
    DVec3::from(scale.to_array().map(|s| match s.abs() < least {
        true => least.copysign(s),
        false => s,
    }))
}

/// Whether a transform is finite and can be inverted.
pub fn is_invertible(transform: &DAffine3) -> bool {
    let most = transform
        .matrix3
        .to_cols_array()
        .into_iter()
        .fold(0.0, |a: f64, b| a.max(b.abs()));
    let inverse = transform.inverse();
    transform.is_finite() && inverse.is_finite() && most < 1e18 && {
        transform.translation.abs().max_element() < 1e18 && transform.matrix3.determinant() != 0.0
    }
}
