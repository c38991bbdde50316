//! Transforms in the terms of files and input fields: scale, angles and translation.

use glam::{DAffine3, DMat3, DQuat, DVec3};

/// A transform in the terms of files and input fields: scales first, then rotates about x, y and z, then
/// translates.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Transform {
    /// The translation.
    pub translate: DVec3,
    /// Degrees about the x, then the y, then the z axis, counter-clockwise when the axis points at the
    /// viewer.
    pub rotate_deg: DVec3,
    /// Scale factors along the axes; not 0, negative ones mirror.
    pub scale: DVec3,
}

impl Default for Transform {
    /// The identity.
    fn default() -> Self {
        Self {
            translate: DVec3::ZERO,
            rotate_deg: DVec3::ZERO,
            scale: DVec3::ONE,
        }
    }
}

impl Transform {
    /// The affine map.
    pub fn affine(&self) -> DAffine3 {
        let rotation = rotation(self.rotate_deg);
        DAffine3::from_scale_rotation_translation(self.scale, rotation, self.translate)
    }

    /// The nearest transform to an invertible map, and whether it equals the map up to rounding: scale
    /// and angles cannot represent shear. A map that mirrors gets a negative scale along x.
    pub fn of(affine: DAffine3) -> (Self, bool) {
        let columns = affine.matrix3;
        let lengths = [columns.x_axis, columns.y_axis, columns.z_axis].map(DVec3::length);
        let mirrored = columns.determinant() < 0.0;
        let mut scale = DVec3::from(lengths);
        if mirrored {
            scale.x = -scale.x;
        }
        let x = (columns.x_axis / scale.x).normalize_or(DVec3::X);
        let y = (columns.y_axis / scale.y).reject_from_normalized(x);
        let y = y.normalize_or(x.any_orthonormal_vector());
        let rotate_deg = angles(DMat3::from_cols(x, y, x.cross(y)));
        let transform = Self {
            translate: affine.translation,
            rotate_deg: DVec3::from(rotate_deg.to_array().map(f64::to_degrees)),
            scale,
        };
        let recomposed = transform.affine().matrix3;
        let size = lengths.into_iter().fold(0.0, f64::max);
        let is_same = recomposed.abs_diff_eq(columns, 1e-9 * size);
        (transform, is_same)
    }
}

/// Rotation by degrees about x, then y, then z.
pub fn rotation(rotate_deg: DVec3) -> DQuat {
    let [x, y, z] = rotate_deg.to_array().map(f64::to_radians);
    DQuat::from_rotation_z(z) * DQuat::from_rotation_y(y) * DQuat::from_rotation_x(x)
}

/// The angles in radians about x, then y, then z of a rotation. Where y is a right angle, x and z turn
/// about the same axis, and z is 0.
pub fn angles(rotation: DMat3) -> DVec3 {
    let [x, y, z] = [rotation.x_axis, rotation.y_axis, rotation.z_axis];
    let flat = x.x.hypot(x.y);
    if flat < 1e-9 {
        let about_x = (-z.y).atan2(y.y);
        return DVec3::new(about_x, (-x.z).atan2(flat), 0.0);
    }
    DVec3::new(y.z.atan2(z.z), (-x.z).atan2(flat), x.y.atan2(x.x))
}
