//! Nodes of the transform hierarchy.

use glam::{DAffine3, DQuat, DVec3};

/// A coordinate frame. Points in it are scaled, rotated and translated, then placed in the space of the
/// parent node. Tracks override scale, rotation and translation.
#[derive(Clone, Debug, PartialEq)]
pub struct Node {
    /// Empty if the file gives none.
    pub name: String,
    /// Index into [`super::Scene::nodes`] of the parent, which comes earlier; `None` is the world.
    pub parent: Option<usize>,
    /// The static transform between this node and its parent; invertible.
    pub placement: DAffine3,
    /// At rest.
    pub translation: DVec3,
    /// At rest, of unit length.
    pub rotation: DQuat,
    /// At rest; no component is 0, negative ones mirror.
    pub scale: DVec3,
    /// Whether objects attached to it or to its descendants are visible at rest.
    pub visible: bool,
}

impl Default for Node {
    /// The identity, attached to the world.
    fn default() -> Self {
        Self {
            name: String::new(),
            parent: None,
            placement: DAffine3::IDENTITY,
            translation: DVec3::ZERO,
            rotation: DQuat::IDENTITY,
            scale: DVec3::ONE,
            visible: true,
        }
    }
}

impl Node {
    /// From this node's space to its parent's, at rest.
    pub fn parent_from_node(&self) -> DAffine3 {
        let Self {
            translation,
            rotation,
            scale,
            ..
        } = *self;
        self.placement * DAffine3::from_scale_rotation_translation(scale, rotation, translation)
    }
}
