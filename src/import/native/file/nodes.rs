//! How a native scene describes what carries things, and where things are.

use crate::import::native::values::{Matrix, Quaternion, Scale, Vector};
use crate::scene;
use glam::{DAffine3, DQuat, DVec3};
use schemars::JsonSchema;
use serde::Deserialize;
use toml::Spanned;

/// A frame of reference: what it carries is scaled, rotated and moved with it.
#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(in crate::import::native) struct NodeTable {
    /// The name by which others find it. No other node and no object has it.
    #[schemars(with = "String")]
    pub name: Spanned<String>,
    /// The name of a node further up that carries it.
    #[schemars(with = "Option<String>")]
    pub carried_by: Option<Spanned<String>>,
    /// Where it is. Animations take the place of these values.
    #[schemars(with = "Option<TransformTable>")]
    pub transform: Option<Spanned<TransformTable>>,
    /// What else lies between it and what carries it, and is not animated.
    #[schemars(with = "Option<TransformTable>")]
    pub placement: Option<Spanned<TransformTable>>,
    /// Whether what it carries is there (true if left out), at first if that is animated.
    #[serde(default = "yes")]
    pub visible: bool,
}

/// Scaled first, then rotated, then moved.
#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub(in crate::import::native) struct TransformTable {
    /// How far to move it.
    pub translate: Vector,
    /// Degrees to turn it round the x, then the y, then the z axis of the world,
    /// counter-clockwise when the axis points at you.
    #[schemars(with = "Vector")]
    pub rotate_deg: Option<Vector>,
    /// The same as a quaternion [x, y, z, w], in place of `rotate_deg`.
    pub rotation: Option<Quaternion>,
    /// A factor for all axes, or one for each; not 0, negative ones mirror.
    pub scale: Scale,
    /// In place of all others: where the x, the y and the z axis go as vectors, and the origin as a
    /// point.
    pub matrix: Option<Matrix>,
}

impl TransformTable {
    /// How it turns.
    pub fn turn(&self) -> DQuat {
        let turned = self.rotate_deg.map(|degrees| scene::rotation(degrees.0));
        let given = self.rotation.map(|rotation| rotation.0);
        given.or(turned).unwrap_or(DQuat::IDENTITY)
    }

    /// The map that it describes.
    pub fn affine(&self) -> DAffine3 {
        let told = || {
            let (scale, translate) = (self.scale.0, self.translate.0);
            DAffine3::from_scale_rotation_translation(scale, self.turn(), translate)
        };
        self.matrix.map_or_else(told, |matrix| matrix.0)
    }

    /// Whether it says more than a matrix, or turns in two ways.
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
