//! Frames of reference, which may move and carry what is attached to them.

use glam::{DAffine3, DQuat, DVec3};

/// A frame of reference. Points in it are scaled, rotated and translated, then placed in the space
/// of its parent. Tracks replace the first three.
#[derive(Clone, Debug, PartialEq)]
pub struct Node {
    /// Empty when the file gives none.
    pub name: String,
    /// Index into [`super::Scene::nodes`] of an earlier node; `None` is the world.
    pub parent: Option<usize>,
    /// What stands still between this node and its parent; invertible.
    pub placement: DAffine3,
    /// At rest.
    pub translation: DVec3,
    /// At rest, of unit length.
    pub rotation: DQuat,
    /// At rest; no component is 0, negative ones mirror.
    pub scale: DVec3,
    /// Whether what is attached to it, or to nodes below it, is there at rest.
    pub visible: bool,
}

impl Default for Node {
    /// The world's own frame.
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
