//! Decomposes transforms into parts that can be interpolated.

use crate::layout::PackedKey;
use glam::{DAffine3, DMat3, DQuat, DVec3, Quat, Vec3};

/// A transform as stretch, then rotation, then translation. Any affine transform can be written that way
/// (Shoemake and Duff, Matrix Animation and Polar Decomposition, 1992).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Placement {
    pub translation: DVec3,
    pub rotation: DQuat,
    /// Symmetric; negative definite if the transform mirrors.
    pub stretch: DMat3,
}

impl Placement {
    /// Decomposes an invertible transform.
    pub fn of(transform: DAffine3) -> Self {
        let mirror = transform.matrix3.determinant().signum();
        let matrix = transform.matrix3 * mirror;
        let turn = nearest_rotation(matrix);
        let stretch = turn.transpose() * matrix;
        Self {
            translation: transform.translation,
            rotation: DQuat::from_mat3(&turn).normalize(),
            stretch: (stretch + stretch.transpose()) * (0.5 * mirror),
        }
    }

    /// Interpolates to the next key, as `space_between` of `lib/motion.wesl` does.
    pub fn between(&self, next: &Self, fraction: f64) -> Self {
        Self {
            translation: self.translation.lerp(next.translation, fraction),
            rotation: (self.rotation * (1.0 - fraction) + next.rotation * fraction).normalize(),
            stretch: self.stretch * (1.0 - fraction) + next.stretch * fraction,
        }
    }

    /// The composed transform.
    pub fn transform(&self) -> DAffine3 {
        DAffine3 {
            matrix3: DMat3::from_quat(self.rotation) * self.stretch,
            translation: self.translation,
        }
    }

    /// The inverse of [`Self::packed`].
    pub fn unpacked(key: &PackedKey) -> Self {
        let wide = |v: [f32; 3]| Vec3::from(v).as_dvec3();
        let (d, s) = (wide(key.stretch), wide(key.shear));
        Self {
            translation: wide(key.translation),
            rotation: Quat::from_array(key.rotation).as_dquat(),
            stretch: DMat3::from_cols_array_2d(&[
                [d.x, s.z, s.y],
                [s.z, d.y, s.x],
                [s.y, s.x, d.z],
            ]),
        }
    }

    pub fn packed(&self) -> PackedKey {
        let [x, y, z] = [
            self.stretch.x_axis,
            self.stretch.y_axis,
            self.stretch.z_axis,
        ];
        PackedKey {
            translation: self.translation.as_vec3().into(),
            rotation: self.rotation.as_quat().into(),
            stretch: DVec3::new(x.x, y.y, z.z).as_vec3().into(),
            shear: DVec3::new(y.z, x.z, x.y).as_vec3().into(),
            ..Default::default()
        }
    }
}

/// The placements with all quaternions in one hemisphere relative to their predecessor, so that
/// interpolation takes the short way.
pub fn aligned(mut placements: Vec<Placement>) -> Vec<Placement> {
    for i in 1..placements.len() {
        if placements[i].rotation.dot(placements[i - 1].rotation) < 0.0 {
            placements[i].rotation = -placements[i].rotation;
        }
    }
    placements
}

/// The orthogonal factor of a matrix with positive determinant, by Newton's iteration with scaling
/// (Higham, Computing the Polar Decomposition, 1986).
fn nearest_rotation(matrix: DMat3) -> DMat3 {
    let norm = |m: &DMat3| m.to_cols_array().iter().map(|c| c * c).sum::<f64>().sqrt();
    let mut turn = matrix * norm(&matrix).recip();
    for _ in 0..64 {
        let inverse = turn.inverse().transpose();
        let scale = (norm(&inverse) / norm(&turn)).sqrt();
        let next = (turn * scale + inverse * scale.recip()) * 0.5;
        if !next.is_finite() {
            return DMat3::IDENTITY;
        }
        let change = norm(&(next - turn));
        turn = next;
        if change < 1e-15 {
            break;
        }
    }
    turn
}
