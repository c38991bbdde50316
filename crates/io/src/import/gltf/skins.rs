//! Skins (section 3.7.3 of the specification): a mesh that follows several nodes, its joints. The transform of
//! its own node has no effect.

use super::Reader;
use super::document::{Kind, Node};
use crate::import::budget;
use crate::import::error::ImportError;
use glam::{DAffine3, DMat3, DVec3};
use glimray_scene::{Joint, Pose};
use std::sync::Arc;

/// A joint: its node in the file, and the transform from the mesh as it was modelled to that node.
pub(super) type Bound = (usize, DAffine3);

impl Reader<'_> {
    /// The joints of the skin of `node`; `None` if it has none that can be used.
    pub(super) fn skin_of(
        &mut self,
        node: &Node,
        here: &str,
    ) -> Result<Option<Arc<[Bound]>>, ImportError> {
        match node.skin {
            Some(skin) => {
                let found = self.skin(skin, here);
                self.spared(found)
            }
            None => Ok(None),
        }
    }

    /// The joints of `skins[index]`.
    pub(super) fn skin(&mut self, index: usize, here: &str) -> Result<Arc<[Bound]>, ImportError> {
        if let Some(known) = self.skins.get(&index) {
            return Ok(known.clone());
        }
        let document = self.document;
        let skin = self.blame.get(&document.skins, index, "skins", here)?;
        let place = format!("skins[{index}]");
        let size = budget::size::<(Bound, Joint)>(skin.joints.len());
        self.ledger.take(size, size, &place)?;
        let mut joints = Vec::with_capacity(skin.joints.len());
        for &joint in &skin.joints {
            self.blame.get(&document.nodes, joint, "nodes", &place)?;
            joints.push((joint, DAffine3::IDENTITY));
        }
        if let Some(inverses) = skin.inverse_bind_matrices {
            let matrices = self
                .accessors()
                .vectors::<16>(inverses, &[Kind::Mat4], 0.0, &place);
            let matrices = self.spared(matrices)?.unwrap_or_default();
            let mut lacking = joints.len().saturating_sub(matrices.len());
            for ((_, bind), matrix) in joints.iter_mut().zip(matrices) {
                let m = matrix.map(f64::from);
                let column = |i: usize| DVec3::new(m[4 * i], m[4 * i + 1], m[4 * i + 2]);
                let found = DAffine3 {
                    matrix3: DMat3::from_cols(column(0), column(1), column(2)),
                    translation: column(3),
                };
                match found.is_finite() {
                    true => *bind = found,
                    false => lacking += 1,
                }
            }
            if lacking > 0 {
                self.notes.add("skins without matrices", || {
                    format!(
                        "{place}: {lacking} joints have no inverse bind matrix: it is the identity"
                    )
                });
            }
        }
        let joints: Arc<[Bound]> = joints.into();
        self.skins.insert(index, joints.clone());
        Ok(joints)
    }

    /// The pose of a skin at rest.
    pub(super) fn rest_pose(&self, joints: Option<&[Bound]>, weights: Vec<f64>) -> Pose {
        let joints = joints.unwrap_or_default().iter();
        Pose {
            weights,
            joints: joints
                .map(|(node, bind)| self.worlds[*node] * *bind)
                .collect(),
        }
    }

    /// The joints of the scene for those of a skin, after all nodes were added. Joints that never move, or are
    /// outside the chosen scene, have no node.
    pub(super) fn scene_joints(&self, joints: &[Bound]) -> Vec<Joint> {
        let joint = |&(file_node, bind): &Bound| {
            let node = self.node_of[file_node];
            Joint {
                node,
                node_from_mesh: match node {
                    Some(_) => bind,
                    None => self.worlds[file_node] * bind,
                },
            }
        };
        joints.iter().map(joint).collect()
    }
}
