//! What lights a scene.

use glam::{DVec3, Vec3};

/// A light. Without extent it casts hard shadows and is itself invisible.
#[derive(Clone, Debug, PartialEq)]
pub struct Light {
    /// Where it is and which way it shines.
    pub kind: LightKind,
    /// Linear radiance L of the Phong sum, at distance 1 where it falls off (of area lights: seen
    /// from far away along the normal); 0 or more.
    pub color: Vec3,
    /// How it fades.
    pub attenuation: Attenuation,
    /// Shadow rays for each shaded point, at least 1; more than 1 make sense for area lights only.
    pub samples: u32,
    /// Whether rays see the light itself; makes sense for area lights only.
    pub visible: bool,
    /// Index into [`super::Scene::nodes`] of what carries it; `None` is the world.
    pub node: Option<usize>,
}

impl Default for Light {
    /// A dark point.
    fn default() -> Self {
        Self {
            kind: LightKind::Point {
                position: DVec3::ZERO,
            },
            color: Vec3::ZERO,
            attenuation: Attenuation::None,
            samples: 1,
            visible: false,
            node: None,
        }
    }
}

/// Place and direction of a [`Light`], in the space of its node.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum LightKind {
    /// Shines evenly all round.
    Point {
        /// Where it is.
        position: DVec3,
    },
    /// Shines from infinitely far.
    Directional {
        /// The unit direction in which the light travels.
        direction: DVec3,
    },
    /// Shines into a cone: full strength inside `inner`, smoothly down to nothing at `outer`.
    Spot {
        /// Where it is.
        position: DVec3,
        /// The unit direction of the cone's axis, in which the light travels.
        direction: DVec3,
        /// Radians off the axis, in [0, `outer`].
        inner: f64,
        /// Radians off the axis, in [`inner`, π/2].
        outer: f64,
    },
    /// Shines from a parallelogram to the side of its normal, which is along edge_u × edge_v.
    Rectangle {
        /// The middle.
        center: DVec3,
        /// From the centre to the middle of one side.
        edge_u: DVec3,
        /// From the centre to the middle of the other; not parallel to `edge_u`.
        edge_v: DVec3,
    },
    /// Shines from a disc to the side of its normal.
    Disc {
        /// The middle.
        center: DVec3,
        /// Of unit length.
        normal: DVec3,
        /// Above 0.
        radius: f64,
    },
    /// Shines from a sphere to all sides.
    Sphere {
        /// The middle.
        center: DVec3,
        /// Above 0.
        radius: f64,
    },
}

impl LightKind {
    /// What the surface of an area light of `color` 1 emits: its radiance in the sense that a
    /// diffuse surface of k_d under the light shows k_d/π times its irradiance. `None` for a light
    /// without extent.
    pub fn radiance(&self) -> Option<f64> {
        use std::f64::consts::PI;
        match self {
            Self::Point { .. } | Self::Directional { .. } | Self::Spot { .. } => None,
            Self::Rectangle { edge_u, edge_v, .. } => {
                Some(PI / (4.0 * edge_u.cross(*edge_v).length()))
            }
            Self::Disc { radius, .. } | Self::Sphere { radius, .. } => {
                Some(1.0 / (radius * radius))
            }
        }
    }
}

/// How a light fades with the distance r to it. A directional light never does.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Attenuation {
    /// Not at all.
    #[default]
    None,
    /// 1/r²; an area light then also weakens with the cosine off its normal, as a lamp does.
    InverseSquare,
}
