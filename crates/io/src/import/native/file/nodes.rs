//! Nodes and transforms in a native scene.

use crate::import::native::values::{Matrix, Quaternion, Scale, Vector};
use glam::{DAffine3, DQuat, DVec3};
use glimray_scene as scene;
use schemars::JsonSchema;
use serde::Deserialize;
use toml::Spanned;

/// A node: its children are scaled, rotated and translated with it.
#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(in crate::import::native) struct NodeTable {
    /// Its name; unique among nodes and objects.
    #[schemars(with = "String")]
    pub name: Spanned<String>,
    /// The name of its parent, which comes earlier in the list.
    #[schemars(with = "Option<String>")]
    pub carried_by: Option<Spanned<String>>,
    /// Its transform. Animations override these values.
    #[schemars(with = "Option<TransformTable>")]
    pub transform: Option<Spanned<TransformTable>>,
    /// A static transform between it and its parent.
    #[schemars(with = "Option<TransformTable>")]
    pub placement: Option<Spanned<TransformTable>>,
    /// Whether its children are visible; default true. The state at rest if it is animated.
    #[serde(default = "yes")]
    pub visible: bool,
}

/// A transform: scale, then rotation, then translation.
#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub(in crate::import::native) struct TransformTable {
    /// The translation.
    pub translate: Vector,
    /// Rotation in degrees about the x, then the y, then the z axis of the world, counter-clockwise when
    /// the axis points at you.
    #[schemars(with = "Vector")]
    pub rotate_deg: Option<Vector>,
    /// The rotation as a quaternion [x, y, z, w], instead of `rotate_deg`.
    pub rotation: Option<Quaternion>,
    /// A scale factor for all axes, or one for each; not 0, negative ones mirror.
    pub scale: Scale,
    /// Instead of all others: the images of the x, the y and the z axis as vectors, and that of the
    /// origin as a point.
    pub matrix: Option<Matrix>,
}

impl TransformTable {
    /// The rotation.
    pub fn orientation(&self) -> DQuat {
        let turned = self.rotate_deg.map(|degrees| scene::rotation(degrees.0));
        let given = self.rotation.map(|rotation| rotation.0);
        given.or(turned).unwrap_or(DQuat::IDENTITY)
    }

    /// The affine map.
    pub fn affine(&self) -> DAffine3 {
        let composed = || {
            let (scale, translate) = (self.scale.0, self.translate.0);
            DAffine3::from_scale_rotation_translation(scale, self.orientation(), translate)
        };
        self.matrix.map_or_else(composed, |matrix| matrix.0)
    }

    /// Whether it has other keys besides a matrix, or two rotations.
    pub fn is_double(&self) -> bool {
        let turned = self.rotate_deg.is_some() || self.rotation.is_some();
        let other = turned || self.translate.0 != DVec3::ZERO || self.scale.0 != DVec3::ONE;
        (self.matrix.is_some() && other) || (self.rotate_deg.is_some() && self.rotation.is_some())
    }
}

impl Default for TransformTable {
    fn default() -> Self {
        Self {
            translate: Vector(DVec3::ZERO),
            rotate_deg: None,
            rotation: None,
            scale: Scale(DVec3::ONE),
            matrix: None,
        }
    }
}

fn yes() -> bool {
    true
}
