//! Transform arithmetic, and checks for all tables with a transform.

use super::Texts;
use super::file::Spanned;
use super::file::TransformTable;
use crate::import::error::ImportError;
use crate::import::number::in_range;
use glam::{DAffine3, DMat3, DVec3};

/// Refuses a transform that specifies something twice.
pub(super) fn check(transform: &Spanned<TransformTable>, texts: &Texts) -> Result<(), ImportError> {
    if !transform.is_double() {
        return Ok(());
    }
    let why = "`matrix` replaces all others, and `rotation` replaces `rotate_deg`";
    Err(texts.malformed(transform.span(), why.to_owned(), "Leave out the others"))
}

/// The product of `outer` and `inner`, exact, including the signs of zeros, if one of them is the
/// identity.
pub(super) fn chain(outer: DAffine3, inner: DAffine3) -> DAffine3 {
    let bits = |affine: DAffine3| affine.to_cols_array().map(f64::to_bits);
    if bits(outer) == bits(DAffine3::IDENTITY) {
        inner
    } else if inner == DAffine3::IDENTITY {
        outer
    } else if outer == DAffine3::IDENTITY {
        inner
    } else {
        outer * inner
    }
}

/// The matrix for normals if points are transformed by `transform`: the inverse transpose up to a
/// positive factor, without dividing by a small determinant.
pub(super) fn normal_matrix(transform: DAffine3) -> DMat3 {
    let [x, y, z] = [
        transform.matrix3.x_axis,
        transform.matrix3.y_axis,
        transform.matrix3.z_axis,
    ];
    let sign = x.cross(y).dot(z).signum();
    DMat3::from_cols(y.cross(z), z.cross(x), x.cross(y)) * sign
}

/// Whether `matrix` is safely invertible: its axes are in range, and they are far from coplanar or its condition number is
/// small enough for f64, as below very uneven scales.
pub(super) fn is_invertible(matrix: DMat3) -> bool {
    let axes = [matrix.x_axis, matrix.y_axis, matrix.z_axis];
    let is_good = |axis: &DVec3| {
        let length = axis.length();
        length >= f64::from(f32::MIN_POSITIVE) && in_range(axis.abs().max_element())
    };
    let [x, y, z] = axes.map(DVec3::normalize_or_zero);
    let norm = |matrix: DMat3| {
        matrix
            .to_cols_array()
            .map(|c| c * c)
            .iter()
            .sum::<f64>()
            .sqrt()
    };
    let condition = norm(matrix) * norm(matrix.inverse());
    axes.iter().all(is_good) && (x.cross(y).dot(z).abs() > 1e-12 || condition < 1e12)
}
