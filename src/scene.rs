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

mod animation;
mod bounds;
mod curve;
mod frame;
mod light;
mod lit;
mod material;
mod mesh;
mod motion;
mod node;
mod object;
mod output;
mod shape;
mod texture;
mod transform;
mod turntable;

pub use animation::{
    Beyond, CameraProperty, Curve, Easing, Interpolation, LightProperty, MaterialProperty,
    NodeProperty, Target, Track, Values,
};
pub use curve::Value;
pub use frame::{Frame, NodeState};
pub use light::{Attenuation, Light, LightKind};
pub use material::{Fresnel, Material, Mixing, Textures};
pub use mesh::{Mesh, Repairs};
pub use node::Node;
pub use object::ObjectRef;
pub use output::{Antialias, Filter, OutputDefaults, Shutter, ToneCurve, Transfer};
pub use shape::{CanonicalShape, Geometry, Shape};
pub use texture::{Pattern, Picture, Space, Texture, linear_from_srgb};
pub use transform::{Transform, angles, rotation};
pub use turntable::{MAX_ELEVATION, Turntable, turntable};

use glam::{DAffine3, DVec3, Vec3};
use std::sync::Arc;

/// Everything that is in a picture, at rest. What moves leaves through [`Scene::frame`].
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Scene {
    /// Triangle meshes, each in its own object space; shared, so that a copy of a scene is cheap.
    pub meshes: Vec<Arc<Mesh>>,
    /// Placements of meshes.
    pub instances: Vec<Instance>,
    /// Analytic shapes.
    pub shapes: Vec<Shape>,
    /// At least one.
    pub materials: Vec<Material>,
    /// Colours that vary over a surface.
    pub textures: Vec<Texture>,
    /// What textures and the background show; shared as meshes are.
    pub pictures: Vec<Arc<Picture>>,
    /// May be empty.
    pub lights: Vec<Light>,
    /// At least one.
    pub cameras: Vec<Camera>,
    /// Index into `cameras` of the one to use unless told otherwise.
    pub camera_index: usize,
    /// Where f32 is finest when the scene is packed, in world space; `None` is where the default camera
    /// is at rest. Importers set it to that place, and it stays there when another camera looks, so
    /// that the same geometry is packed to the same bytes. A point at a distance d from it is kept to
    /// about 6e-8 d: a camera far from it sees the difference if it looks at something close by.
    pub render_origin: Option<DVec3>,
    /// What rays see that hit nothing.
    pub background: Background,
    /// Linear radiance of the ambient term, multiplied by [`Material::ambient`].
    pub ambient: Vec3,
    /// Whether lights, background and ambient light are not the file's, whose format has none, but
    /// such as show a bare model.
    pub staged: bool,
    /// How shadow rays meet what is transparent.
    pub shadows: Shadows,
    /// What instances, shapes, lights and cameras may be attached to; parents before their children.
    pub nodes: Vec<Node>,
    /// What changes over time.
    pub tracks: Vec<Track>,
    /// What the file says about the picture; flags win over it.
    pub output: OutputDefaults,
    /// What the importer left out or repaired: of each kind the first few, a sentence each, and how
    /// many more there were.
    pub skipped: Vec<String>,
}

/// One mesh in the world. Its triangles are in memory once, however many instances there are.
#[derive(Clone, Debug, PartialEq)]
pub struct Instance {
    /// Index into [`Scene::meshes`].
    pub mesh: usize,
    /// From object space to the space of `node`. Invertible; may scale unevenly or mirror.
    pub placement: DAffine3,
    /// Index into [`Scene::nodes`]; `None` is the world.
    pub node: Option<usize>,
}

/// What rays see that hit nothing, as linear radiance.
#[derive(Clone, Debug, PartialEq)]
pub enum Background {
    /// The same everywhere.
    Color(Vec3),
    /// By the direction's y: from `bottom` straight down to `top` straight up, linearly.
    Gradient {
        /// Straight down.
        bottom: Vec3,
        /// Straight up.
        top: Vec3,
    },
    /// An equirectangular picture: its middle lies in the direction −Z, its upper edge straight up,
    /// +X to the right of the middle.
    Picture {
        /// Index into [`Scene::pictures`].
        picture: usize,
        /// Multiplies it, 0 or more.
        strength: f32,
        /// Radians by which it is turned about +Y, counter-clockwise from above.
        rotation: f64,
    },
}

impl Default for Background {
    fn default() -> Self {
        Self::Color(Vec3::ZERO)
    }
}

/// How shadow rays meet what is transparent.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Shadows {
    /// Everything throws a full shadow, as in the classical ray tracer.
    #[default]
    Opaque,
    /// Light goes straight through, weakened by transmission, Fresnel's reflection and absorption.
    Filtered,
}

/// A camera with a pinhole, or with a thin lens. Its image plane is the near plane at distance 1,
/// whose height the field of view sets; the aspect is the picture's width over its height.
///
/// Rays of an orthographic one are parallel and start on the plane through `look_from`: what lies
/// behind that is not seen. Which bodies they start in is decided at `look_from` for all of them.
#[derive(Clone, Debug, PartialEq)]
pub struct Camera {
    /// Empty when the file gives none.
    pub name: String,
    /// The pinhole, in the space of `node`.
    pub look_from: DVec3,
    /// A point in the middle of the picture, in the space of `node`; differs from `look_from`.
    pub look_at: DVec3,
    /// Upwards in the picture, of any length; not parallel to the viewing direction.
    pub up: DVec3,
    /// Vertical field of view in radians, in (0, π).
    pub fov_y: f64,
    /// Of an orthographic camera: the height of what is in the picture, in scene units, above 0.
    /// Absent for perspective; only then `fov_y` counts.
    pub orthographic_height: Option<f64>,
    /// Absent for a pinhole, to which everything is sharp.
    pub lens: Option<Lens>,
    /// Index into [`Scene::nodes`] of what carries it; `None` is the world.
    pub node: Option<usize>,
    /// Index into [`Scene::nodes`] of what it looks at, the origin of that node's space, in place of
    /// `look_at`.
    pub target: Option<usize>,
}

/// The opening of a thin lens.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Lens {
    /// Above 0, in scene units; of a polygon the distance of its corners.
    pub radius: f64,
    /// Distance along the viewing direction of what is sharp, above 0.
    pub focus_distance: f64,
    /// Corners of the opening, 3 or more; 0 for a round one.
    pub blade_count: u32,
    /// Radians counter-clockwise of the first corner from the picture's right.
    pub blade_rotation: f64,
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
            orthographic_height: None,
            lens: None,
            node: None,
            target: None,
        }
    }
}

impl Scene {
    /// Keeps the render origin where it is now, whatever becomes of the camera.
    pub fn pin_render_origin(&mut self) {
        let origin = self.render_origin_at(&self.frame(0.0));
        self.render_origin = Some(origin);
    }

    /// [`Self::render_origin`], or the camera of the frame at time 0.
    pub fn render_origin_at(&self, rest: &Frame) -> DVec3 {
        self.render_origin.unwrap_or(rest.camera.look_from)
    }

    /// Number of triangles in the world, instances counted each.
    pub fn triangle_count(&self) -> usize {
        self.instances
            .iter()
            .map(|instance| self.meshes[instance.mesh].triangles.len())
            .sum()
    }
}
