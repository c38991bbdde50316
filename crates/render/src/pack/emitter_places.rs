//! Where the emissive surfaces of an instance are while the shutter is open.

use super::placement::Placement;
use crate::layout::{PackedInstance, PackedKey};
use glam::{DAffine3, DMat3, DVec3, Mat3, Vec3};

/// The transforms of an instance to render space.
#[derive(Clone, Debug)]
pub struct Places {
    /// When the shutter opens.
    linear: Mat3,
    /// The inverse of its transpose, for normals.
    normal: DMat3,
    /// At each key; one if it does not move.
    keys: Vec<DAffine3>,
    placements: Vec<Placement>,
}

/// In render space.
impl Default for Places {
    fn default() -> Self {
        Self {
            linear: Mat3::IDENTITY,
            normal: DMat3::IDENTITY,
            keys: vec![DAffine3::IDENTITY],
            placements: Vec::new(),
        }
    }
}

impl Places {
    /// The places of an instance of a view with these keys.
    pub fn of(instance: &PackedInstance, keys: &[PackedKey]) -> Self {
        let matrix = |rows: [[f32; 3]; 3]| Mat3::from_cols_array_2d(&rows).transpose();
        let linear = matrix([instance.linear_x, instance.linear_y, instance.linear_z]);
        let inverse = matrix([instance.inverse_x, instance.inverse_y, instance.inverse_z]);
        let own = &keys[instance.first_key as usize..];
        let placements: Vec<_> = match instance.key_count {
            0 | 1 => Vec::new(),
            count => own[..count as usize]
                .iter()
                .map(Placement::unpacked)
                .collect(),
        };
        let still = DAffine3 {
            matrix3: linear.as_dmat3(),
            translation: Vec3::from(instance.translation).as_dvec3(),
        };
        Self {
            linear,
            normal: inverse.as_dmat3().transpose(),
            keys: match placements.is_empty() {
                true => vec![still],
                false => placements.iter().map(Placement::transform).collect(),
            },
            placements,
        }
    }

    /// The transform without its translation when the shutter opens.
    pub fn linear(&self) -> Mat3 {
        self.linear
    }

    /// A box around these points of the instance at all times.
    pub fn bounds(&self, points: &[DVec3]) -> (DVec3, DVec3) {
        let (mut min, mut max) = (DVec3::INFINITY, DVec3::NEG_INFINITY);
        for key in &self.keys {
            for &point in points {
                let at = key.transform_point3(point);
                (min, max) = (min.min(at), max.max(at));
            }
        }
        let pairs = self.placements.windows(2);
        let strays = pairs.flat_map(|pair| points.iter().map(|&p| stray(&pair[0], &pair[1], p)));
        let slack = strays.fold(0.0, f64::max);
        (min - slack, max + slack)
    }

    /// The unit normal on the front of a triangle with these edges and normals at its corners; `None` if the instance moves,
    /// or if the normals do not agree where the front is.
    pub fn front(&self, edges: [Vec3; 2], normals: [Vec3; 3]) -> Option<DVec3> {
        if self.keys.len() > 1 {
            return None;
        }
        let [u, v] = edges.map(|edge| self.keys[0].matrix3 * edge.as_dvec3());
        let across = u.cross(v).try_normalize()?;
        let sides = normals.map(|n| (self.normal * n.as_dvec3()).normalize_or_zero().dot(across));
        match () {
            () if sides.iter().all(|side| *side > 1e-4) => Some(across),
            () if sides.iter().all(|side| *side < -1e-4) => Some(-across),
            () => None,
        }
    }
}

/// How far a point of a moving instance may be from the line between its places at two keys: half again the second
/// derivative over 8, and no more than a turn by any angle.
fn stray(from: &Placement, to: &Placement, point: DVec3) -> f64 {
    let (before, after) = (from.stretch * point, to.stretch * point);
    let reach = before.length().max(after.length());
    let turn = 2.0 * from.rotation.dot(to.rotation).abs().clamp(0.0, 1.0).acos();
    let bend = turn * turn * reach + 2.0 * turn * (after - before).length();
    (1.5 * bend / 8.0).min(2.0 * reach)
}
