//! Nodes and transforms in a native scene.

use super::Spanned;
use crate::import::native::values::{Matrix, Quaternion, Scale, Vector, or};
use glam::{DAffine3, DQuat, DVec3};
use glimray_scene as scene;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// A node: its children are scaled, rotated and translated with it.
#[derive(Debug, Deserialize, Serialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct NodeTable {
    /// Its name; unique among nodes and objects.
    pub name: Spanned<String>,
    /// The name of its parent, which comes earlier in the list.
    pub carried_by: Option<Spanned<String>>,
    /// Its transform. Animations override these values.
    pub transform: Option<Spanned<TransformTable>>,
    /// A static transform between it and its parent.
    pub placement: Option<Spanned<TransformTable>>,
    /// Whether its children are visible; default true. The state at rest if it is animated.
    pub visible: Option<bool>,
}

/// A transform: scale, then rotation, then translation.
#[derive(Clone, Debug, Default, Deserialize, Serialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct TransformTable {
    /// The translation.
    pub translate: Option<Vector>,
    /// Rotation in degrees about the x, then the y, then the z axis of the world, counter-clockwise when
    /// the axis points at you.
    pub rotate_deg: Option<Vector>,
    /// The rotation as a quaternion [x, y, z, w], instead of `rotate_deg`.
    pub rotation: Option<Quaternion>,
    /// A scale factor for all axes, or one for each; not 0, negative ones mirror.
    pub scale: Option<Scale>,
    /// Instead of all others: the images of the x, the y and the z axis as vectors, and that of the
    /// origin as a point.
    pub matrix: Option<Matrix>,
}

impl TransformTable {
    /// The scale, the rotation and the translation, without a matrix.
    pub fn parts(&self) -> (DVec3, DQuat, DVec3) {
        let turned = self.rotate_deg.map(|degrees| scene::rotation(degrees.0));
        let rotation = or(self.rotation, turned.unwrap_or(DQuat::IDENTITY));
        (
            or(self.scale, DVec3::ONE),
            rotation,
            or(self.translate, DVec3::ZERO),
        )
    }

    /// The affine map.
    pub fn affine(&self) -> DAffine3 {
        let composed = || {
            let (scale, rotation, translation) = self.parts();
            DAffine3::from_scale_rotation_translation(scale, rotation, translation)
        };
        self.matrix.map_or_else(composed, |matrix| matrix.0)
    }

    /// Whether it has other keys besides a matrix, or two rotations.
    pub fn is_double(&self) -> bool {
        let (scale, _, translation) = self.parts();
        let turned = self.rotate_deg.is_some() || self.rotation.is_some();
        let other = turned || translation != DVec3::ZERO || scale != DVec3::ONE;
        (self.matrix.is_some() && other) || (self.rotate_deg.is_some() && self.rotation.is_some())
    }
}
