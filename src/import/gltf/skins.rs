//! Skins (section 3.7.3 of the specification): a mesh that follows several nodes is shown in the pose that
//! the nodes have at rest. Its vertices are in world space; the transform of its own node has no effect.

use super::Reader;
use super::document::{Kind, Primitive};
use crate::import::error::ImportError;
use glam::{DAffine3, DMat3, DVec3, Vec3};

impl Reader<'_> {
    /// For each joint of `skins[index]` the transform from the mesh, as it was modelled, to the world.
    pub(super) fn joints(
        &mut self,
        index: usize,
        here: &str,
    ) -> Result<Vec<DAffine3>, ImportError> {
        let document = self.document;
        let skin = self.blame.get(&document.skins, index, "skins", here)?;
        let place = format!("skins[{index}]");
        let mut transforms = Vec::with_capacity(skin.joints.len());
        for &joint in &skin.joints {
            self.blame.get(&document.nodes, joint, "nodes", &place)?;
            transforms.push(self.worlds[joint]);
        }
        if let Some(inverses) = skin.inverse_bind_matrices {
            let matrices = self
                .accessors()
                .vectors::<16>(inverses, &[Kind::Mat4], 0.0, &place)?;
            if matrices.len() < transforms.len() {
                return Err(self
                    .blame
                    .bad(place, "fewer inverse bind matrices than joints"));
            }
            for (transform, matrix) in transforms.iter_mut().zip(matrices) {
                let m = matrix.map(f64::from);
                let column = |i: usize| DVec3::new(m[4 * i], m[4 * i + 1], m[4 * i + 2]);
                *transform *= DAffine3 {
                    matrix3: DMat3::from_cols(column(0), column(1), column(2)),
                    translation: column(3),
                };
            }
        }
        Ok(transforms)
    }

    /// Moves vertices as `joints` say: each by the mean of its joints' transforms, weighted.
    pub(super) fn pose(
        &self,
        positions: &mut [Vec3],
        normals: &mut [Vec3],
        primitive: &Primitive,
        joints: &[DAffine3],
        here: &str,
    ) -> Result<(), ImportError> {
        let mut sums = Vec::new();
        for set in 0.. {
            let attribute = |name: &str| {
                let index = primitive.attributes.get(&format!("{name}_{set}"))?;
                Some((*index, format!("{here}.attributes.{name}_{set}")))
            };
            let (Some((numbers, place)), Some((weights, _))) =
                (attribute("JOINTS"), attribute("WEIGHTS"))
            else {
                break;
            };
            let numbers = self
                .accessors()
                .vectors::<4>(numbers, &[Kind::Vec4], 0.0, &place)?;
            let weights = self
                .accessors()
                .vectors::<4>(weights, &[Kind::Vec4], 0.0, &place)?;
            if numbers.len() != positions.len() || weights.len() != positions.len() {
                let why = "joints and weights for another number of vertices";
                return Err(self.blame.bad(place, why));
            }
            self.ledger
                .take(0, (positions.len() * size_of::<Sum>()) as u64, &place)?;
            sums.resize(positions.len(), Sum::ZERO);
            for ((sum, numbers), weights) in sums.iter_mut().zip(numbers).zip(weights) {
                for (number, weight) in numbers.into_iter().zip(weights) {
                    if weight == 0.0 || !weight.is_finite() {
                        continue;
                    }
                    let Some(joint) = joints.get(number as usize).filter(|_| number >= 0.0) else {
                        let why = format!("the skin has no joint {number}");
                        return Err(self.blame.bad(place, why));
                    };
                    let weight = f64::from(weight);
                    sum.weight += weight;
                    sum.matrix += joint.matrix3 * weight;
                    sum.translation += joint.translation * weight;
                }
            }
        }
        for (i, sum) in sums.iter().enumerate() {
            if sum.weight.abs() < 1e-6 {
                continue;
            }
            let moved = (sum.matrix * positions[i].as_dvec3() + sum.translation) / sum.weight;
            let moved = moved.as_vec3();
            if !moved.is_finite() {
                let why = format!("the skin moves vertex {i} out of range");
                return Err(self.blame.bad(here, why));
            }
            positions[i] = moved;
            if let Some(normal) = normals.get_mut(i) {
                // The cofactor matrix: also right where the mean of transforms cannot be inverted.
                let [x, y, z] = [sum.matrix.x_axis, sum.matrix.y_axis, sum.matrix.z_axis];
                let cofactors = DMat3::from_cols(y.cross(z), z.cross(x), x.cross(y));
                *normal = (cofactors * normal.as_dvec3())
                    .normalize_or_zero()
                    .as_vec3();
            }
        }
        Ok(())
    }
}

/// The weighted sum of the transforms of a vertex.
#[derive(Clone, Copy)]
struct Sum {
    weight: f64,
    matrix: DMat3,
    translation: DVec3,
}

impl Sum {
    const ZERO: Self = Self {
        weight: 0.0,
        matrix: DMat3::ZERO,
        translation: DVec3::ZERO,
    };
}
