//! The host model: what a picture is made of, with every question settled.
//!
//! A [`Scene`] is resolved once, by [`crate::import`]. Whoever holds one may rely on this:
//! * right-handed, +Y up, lengths in metres (or whatever unit the file used), angles in radians;
//! * colours are linear Rec. 709, finite and not negative;
//! * every index is in range, every number finite, every direction and normal of unit length;
//! * there is at least one camera and one material.
//!
//! Placement (cameras, lights, instances, analytic shapes) is kept in f64 and mesh vertices in f32
//! near their own origin, so that a scene far from the world's origin loses nothing.

mod frame;
mod mesh;

pub use frame::Frame;
pub use mesh::{Mesh, Repairs};

use glam::{DAffine3, DVec3, Vec3};

/// Everything that is in a picture, at rest. What moves leaves through [`Scene::frame`].
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Scene {
    /// Triangle meshes, each in its own object space.
    pub meshes: Vec<Mesh>,
    /// Placements of meshes in the world.
    pub instances: Vec<Instance>,
    /// Analytic shapes, in world space.
    pub shapes: Vec<Shape>,
    /// At least one.
    pub materials: Vec<Material>,
    /// May be empty.
    pub lights: Vec<Light>,
    /// At least one.
    pub cameras: Vec<Camera>,
    /// Index into `cameras` of the one to use unless told otherwise.
    pub camera_index: usize,
    /// Linear radiance of rays that hit nothing.
    pub background: Vec3,
    /// Linear radiance of the ambient term, multiplied by [`Material::ambient`].
    pub ambient: Vec3,
    /// What the file says about the picture; flags win over it.
    pub output: OutputDefaults,
    /// What the importer left out or repaired, one sentence each, in file order.
    pub skipped: Vec<String>,
}

/// One mesh in the world.
#[derive(Clone, Debug, PartialEq)]
pub struct Instance {
    /// Index into [`Scene::meshes`].
    pub mesh: usize,
    /// Invertible; may scale unevenly or mirror.
    pub world_from_object: DAffine3,
}

/// An analytic surface with one material.
#[derive(Clone, Debug, PartialEq)]
pub struct Shape {
    /// Where it is and how large.
    pub geometry: Geometry,
    /// Index into [`Scene::materials`].
    pub material: usize,
}

/// The surface of a [`Shape`], in world space.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Geometry {
    /// All points at one distance from a centre.
    Sphere {
        /// The centre.
        center: DVec3,
        /// Above 0.
        radius: f64,
    },
    /// An infinite plane.
    Plane {
        /// Any point on it.
        point: DVec3,
        /// Of unit length.
        normal: DVec3,
    },
}

/// Phong coefficients, per colour channel (Phong 1975).
#[derive(Clone, Debug, PartialEq)]
pub struct Material {
    /// Empty when the file gives none.
    pub name: String,
    /// k_d, 0 or more.
    pub diffuse: Vec3,
    /// k_s, 0 or more.
    pub specular: Vec3,
    /// The exponent α, 0 or more.
    pub shininess: f32,
    /// Multiplies [`Scene::ambient`]. The course's format wants 1, others the diffuse colour.
    pub ambient: Vec3,
    /// Whether the shading normal is turned to the side that the ray comes from. The course's
    /// format wants it left as given: a surface lit from behind gets the ambient term only.
    pub two_sided: bool,
}

impl Default for Material {
    /// A matte light grey, seen from both sides.
    fn default() -> Self {
        Self {
            name: String::new(),
            diffuse: Vec3::splat(0.8),
            specular: Vec3::ZERO,
            shininess: 1.0,
            ambient: Vec3::splat(0.8),
            two_sided: true,
        }
    }
}

/// A light without extent: it casts hard shadows and is itself invisible.
#[derive(Clone, Debug, PartialEq)]
pub struct Light {
    /// Where it is and which way it shines.
    pub kind: LightKind,
    /// Linear radiance L of the Phong sum, at distance 1 where it falls off; 0 or more.
    pub color: Vec3,
    /// How it fades.
    pub attenuation: Attenuation,
}

/// Place and direction of a [`Light`], in world space.
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
}

/// How a light fades with the distance r to it. A directional light never does.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Attenuation {
    /// Not at all.
    #[default]
    None,
    /// 1/r².
    InverseSquare,
}

/// A pinhole camera. Its image plane is the near plane at distance 1, whose height the field of
/// view sets; the aspect is the picture's width over its height.
#[derive(Clone, Debug, PartialEq)]
pub struct Camera {
    /// Empty when the file gives none.
    pub name: String,
    /// The pinhole, in world space.
    pub look_from: DVec3,
    /// A point in the middle of the picture, in world space; differs from `look_from`.
    pub look_at: DVec3,
    /// Upwards in the picture, of any length; not parallel to the viewing direction.
    pub up: DVec3,
    /// Vertical field of view in radians, in (0, π).
    pub fov_y: f64,
}

impl Default for Camera {
    /// The course's camera: at the origin, looking to (0, 0, −1), up (0, 1, 0), 60° high.
    fn default() -> Self {
        Self {
            name: String::new(),
            look_from: DVec3::ZERO,
            look_at: DVec3::NEG_Z,
            up: DVec3::Y,
            fov_y: std::f64::consts::FRAC_PI_3,
        }
    }
}

/// How a scene wants its picture, where no flag says otherwise.
#[derive(Clone, Debug, PartialEq)]
pub struct OutputDefaults {
    /// Width and height in pixels.
    pub size: (u32, u32),
    /// Samples per pixel, at least 1.
    pub samples: u32,
    /// Stops; each doubles the brightness.
    pub exposure_ev: f32,
    /// Applied after the exposure.
    pub tone: ToneCurve,
    /// Applied last.
    pub transfer: Transfer,
}

impl Default for OutputDefaults {
    fn default() -> Self {
        Self {
            size: (640, 480),
            samples: 1,
            exposure_ev: 0.0,
            tone: ToneCurve::None,
            transfer: Transfer::Srgb,
        }
    }
}

/// From scene-linear radiance to display-linear [0, 1].
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum ToneCurve {
    /// Clamp.
    #[default]
    None,
    /// Narkowicz' fit of the ACES filmic curve (2015).
    Aces,
    /// Sobotka's AgX, Wrensch's polynomial fit (2023).
    Agx,
    /// x / (1 + x) on luminance (Reinhard et al. 2002).
    Reinhard,
}

/// From display-linear [0, 1] to stored values.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Transfer {
    /// IEC 61966-2-1.
    #[default]
    Srgb,
    /// As is, which the course's format wants.
    Linear,
}

impl Scene {
    /// The axis-aligned box (min, max) round everything bounded, in world space; `None` when there
    /// is nothing bounded.
    pub fn bounds(&self) -> Option<(DVec3, DVec3)> {
        let shapes = self.shapes.iter().filter_map(|shape| match shape.geometry {
            Geometry::Sphere { center, radius } => Some((center - radius, center + radius)),
            Geometry::Plane { .. } => None,
        });
        let instances = self.instances.iter().filter_map(|instance| {
            self.meshes[instance.mesh]
                .positions
                .iter()
                .map(|p| instance.world_from_object.transform_point3(p.as_dvec3()))
                .map(|p| (p, p))
                .reduce(union)
        });
        shapes.chain(instances).reduce(union)
    }

    /// Number of triangles in the world, instances counted each.
    pub fn triangle_count(&self) -> usize {
        self.instances
            .iter()
            .map(|instance| self.meshes[instance.mesh].triangles.len())
            .sum()
    }
}

fn union(a: (DVec3, DVec3), b: (DVec3, DVec3)) -> (DVec3, DVec3) {
    (a.0.min(b.0), a.1.max(b.1))
}
