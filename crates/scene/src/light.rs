//! Light sources.

use glam::{DVec3, Vec3};

/// A light. A light without extent casts hard shadows and is itself invisible.
#[derive(Clone, Debug, PartialEq)]
pub struct Light {
    /// Kind, position and direction.
    pub kind: LightKind,
    /// Linear radiance L of the Phong sum; 0 or more. With attenuation it applies at distance 1 (for area
    /// lights seen from far away along the normal).
    pub color: Vec3,
    /// How it fades with distance.
    pub attenuation: Attenuation,
    /// Shadow rays per shaded point, at least 1; more than 1 is useful for area lights only.
    pub samples: u32,
    /// Whether rays hit the light itself; for area lights only.
    pub visible: bool,
    /// Index into [`super::Scene::nodes`] of the parent node; `None` is the world.
    pub node: Option<usize>,
    /// May be empty.
    pub name: String,
}

impl Default for Light {
    /// A black point light.
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
            name: String::new(),
        }
    }
}

/// Kind, position and direction of a [`Light`], in the space of its node.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum LightKind {
    /// Shines evenly in all directions.
    Point {
        /// Position of the light.
        position: DVec3,
    },
    /// Shines from infinitely far away.
    Directional {
        /// The unit direction in which the light travels.
        direction: DVec3,
    },
    /// Shines into a cone: full intensity inside `inner`, falling smoothly to zero at `outer`.
    Spot {
        /// Position of the light.
        position: DVec3,
        /// The unit direction of the cone's axis, in which the light travels.
        direction: DVec3,
        /// Angle from the axis in radians, in [0, `outer`].
        inner: f64,
        /// Angle from the axis in radians, in [`inner`, π/2].
        outer: f64,
    },
    /// A parallelogram that emits to the side of its normal, edge_u × edge_v.
    Rectangle {
        /// The centre.
        center: DVec3,
        /// From the centre to the middle of one edge.
        edge_u: DVec3,
        /// From the centre to the middle of the other edge; not parallel to `edge_u`.
        edge_v: DVec3,
    },
    /// A disc that emits to the side of its normal.
    Disc {
        /// The centre.
        center: DVec3,
        /// Unit vector.
        normal: DVec3,
        /// Above 0.
        radius: f64,
    },
    /// A sphere that emits in all directions.
    Sphere {
        /// The centre.
        center: DVec3,
        /// Above 0.
        radius: f64,
    },
}

impl LightKind {
    /// The kind in words, such as "point light".
    pub fn title(&self) -> &'static str {
        match self {
            Self::Point { .. } => "point light",
            Self::Directional { .. } => "directional light",
            Self::Spot { .. } => "spot light",
            Self::Rectangle { .. } => "rectangle light",
            Self::Disc { .. } => "disc light",
            Self::Sphere { .. } => "sphere light",
        }
    }

    /// The radiance that the surface of an area light of `color` 1 emits, in the convention that a
    /// diffuse surface of k_d reflects k_d/π times its irradiance. `None` for a light without extent.
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

/// How a light fades with the distance r. A directional light never fades.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Attenuation {
    /// No attenuation.
    #[default]
    None,
    /// 1/r²; an area light also weakens with the cosine to its normal, as a Lambertian emitter does.
    InverseSquare,
}
