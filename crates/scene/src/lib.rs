//! The host model: everything that defines an image, fully resolved.
//!
//! A [`Scene`] is resolved once, by an importer (`glimray_io`). Every scene guarantees:
//! * right-handed, +Y up, lengths in metres (or the file's unit), angles in radians;
//! * colours are linear Rec. 709, finite and not negative;
//! * every index is in range, every number is finite, every direction and normal has unit length;
//! * there is at least one camera and one material.
//!
//! Placements (cameras, lights, instances, analytic shapes) are kept in f64 and mesh vertices in f32 near
//! their own origin, so that a scene far from the world origin keeps its precision.
//!
//! ```
//! use glam::{DVec3, Vec3, dvec3};
//! use glimray_scene::{Camera, Geometry, Light, LightKind, Phong, Scene, Shape};
//!
//! let red = Phong { diffuse: Vec3::new(0.8, 0.1, 0.1), ..Phong::default() };
//! let scene = Scene {
//!     materials: vec![red.into()],
//!     shapes: vec![Shape {
//!         geometry: Geometry::Sphere { center: DVec3::ZERO, radius: 2.0 },
//!         material: 0,
//!         node: None,
//!         name: "ball".to_owned(),
//!     }],
//!     lights: vec![Light {
//!         kind: LightKind::Point { position: dvec3(3.0, 4.0, 5.0) },
//!         ..Light::default()
//!     }],
//!     cameras: vec![Camera { look_from: dvec3(0.0, 0.0, 9.0), ..Camera::default() }],
//!     ..Scene::default()
//! };
//! assert_eq!(scene.bounds(), Some((DVec3::splat(-2.0), DVec3::splat(2.0))));
//! assert_eq!(scene.frame(0.0).camera.look_from.z, 9.0);
//! ```

mod animation;
mod append;
mod bounds;
mod bsdf;
mod built_in;
pub mod bytes;
mod classical;
pub mod clock;
mod curve;
mod deformation;
mod frame;
mod framing;
pub mod image;
mod light;
mod lit;
mod material;
mod mesh;
mod metallic_roughness;
mod mikktspace;
mod mipmap;
mod motion;
mod node;
mod object;
mod output;
mod physical;
mod picture;
mod posed;
pub mod random;
mod section;
mod shape;
mod sight;
pub mod sky;
mod tangents;
pub mod text;
mod texture;
pub mod threads;
mod transform;
mod turntable;

pub use animation::{
    Beyond, CameraProperty, Clip, Curve, Easing, Interpolation, LayerProperty, LightProperty,
    MaterialProperty, NodeProperty, Target, TextureProperty, Track, Values,
};
pub use bounds::corners;
pub use bsdf::{Bsdf, Phong, PhongTextures};
pub use built_in::{BuiltIn, BuiltInEntry};
pub use classical::ClassicalMaps;
pub use curve::Value;
pub use deformation::{Deformation, Influences, Joint, MorphTarget, Pose, PosedMesh, Skin};
pub use frame::{Frame, NodeState};
pub use framing::Framing;
pub use light::{Attenuation, Light, LightKind};
pub use material::{Coverage, Fresnel, LayerTextures, Material, Mixing, Textures};
pub use mesh::{Mesh, Repairs, area_normal};
pub use metallic_roughness::{Lobes, MetallicRoughness, SurfacePoint};
pub use node::Node;
pub use object::{ObjectRef, is_numbered};
pub use output::{
    Antialias, Backdrop, Filter, LightTransport, OutputDefaults, Shutter, ToneCurve, Transfer,
};
pub use picture::{
    LARGEST_TEXEL, LUMINANCE, MAX_PICTURE_BYTES, Origin, Picture, SrgbCurve, Texels,
    linear_from_srgb, srgb_from_linear,
};
pub use picture::{SMALLEST_TEXEL, fit, scale_of};
pub use section::Section;
pub use shape::{CanonicalShape, Geometry, Shape};
pub use sight::Sight;
pub use texture::{Minify, Pattern, Space, Texture, UvTransform, Wrap};
pub use transform::{Transform, angles, rotation};
pub use turntable::{MAX_ELEVATION, Turntable, orbit, turntable};

use glam::{DAffine3, DVec3, Vec3};
use std::sync::Arc;

/// The contents of a picture, at rest. [`Scene::frame`] evaluates the animation at one time.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Scene {
    /// Triangle meshes, each in its own object space; shared, so that copying a scene is cheap.
    pub meshes: Vec<Arc<Mesh>>,
    /// Placements of meshes.
    pub instances: Vec<Instance>,
    /// Morph targets and skins of meshes, in ascending order of these.
    pub deformations: Vec<Deformation>,
    /// Analytic shapes.
    pub shapes: Vec<Shape>,
    /// At least one.
    pub materials: Vec<Material>,
    /// Spatially varying colours.
    pub textures: Vec<Texture>,
    /// The images that textures and the background use; shared as meshes are.
    pub pictures: Vec<Arc<Picture>>,
    /// May be empty.
    pub lights: Vec<Light>,
    /// At least one.
    pub cameras: Vec<Camera>,
    /// Index into `cameras` of the default camera.
    pub camera_index: usize,
    /// How many cameras come before the default one because they see nothing that is lit.
    pub blind_cameras: usize,
    /// The point in world space near which packed f32 coordinates are most precise; `None` is the rest
    /// position of the default camera. Importers set it to that position and it stays there when another
    /// camera is used, so that the same geometry is always packed to the same bytes. A point at distance
    /// d from it is kept to about 6e-8 d: a camera far from it that looks at something close shows the
    /// difference.
    pub render_origin: Option<DVec3>,
    /// Radiance of rays that hit nothing.
    pub background: Background,
    /// Linear radiance of the ambient term, multiplied by [`Phong::ambient`].
    pub ambient: Vec3,
    /// Whether lamps, background, ambient light and ground were added to show a model that has no lights or weak ones. All
    /// its area lights are those lamps, and all its planes that ground.
    pub staged: bool,
    /// How transparent surfaces affect shadow rays.
    pub shadows: Shadows,
    /// The plane beyond which the scene is cut away.
    pub section: Option<Section>,
    /// Coordinate frames that instances, shapes, lights and cameras may be attached to; parents before
    /// their children.
    pub nodes: Vec<Node>,
    /// The animation.
    pub tracks: Vec<Track>,
    /// The clips of the file that it was read from.
    pub clips: Vec<Clip>,
    /// Names of the material variants of that file, one of which can be chosen when it is read.
    pub variants: Vec<String>,
    /// Names of the scenes of that file if it has several, empty where it gives none; this is one of them.
    pub alternatives: Vec<String>,
    /// The file's output settings; command-line flags override them.
    pub output: OutputDefaults,
    /// Parts of the file that the importer skipped or repaired: the first few of each kind, a sentence each, and how
    /// many more there were.
    pub skipped: Vec<String>,
    /// Properties of the file on which the picture does not depend, or which are decided otherwise, and what was asked
    /// for; a sentence each.
    pub remarks: Vec<String>,
}

/// A mesh placed in the world. All instances of a mesh share its triangles.
#[derive(Clone, Debug, PartialEq)]
pub struct Instance {
    /// Index into [`Scene::meshes`].
    pub mesh: usize,
    /// From object space to the space of `node`. Invertible; may scale unevenly or mirror.
    pub placement: DAffine3,
    /// Index into [`Scene::nodes`]; `None` is the world. The skin of a deforming mesh gives positions in the
    /// world: then the node may hide the instance, but does not move it.
    pub node: Option<usize>,
    /// May be empty: then it goes by the name of its mesh. Copies of one object have the same.
    pub name: String,
}

/// Linear radiance of rays that hit nothing.
#[derive(Clone, Debug, PartialEq)]
pub enum Background {
    /// A constant colour.
    Color(Vec3),
    /// Linear in the y of the ray's direction, from `bottom` straight down to `top` straight up.
    Gradient {
        /// Straight down.
        bottom: Vec3,
        /// Straight up.
        top: Vec3,
    },
    /// An equirectangular environment map: its centre lies in the direction −Z, its upper edge straight
    /// up, and +X to the right of the centre.
    Picture {
        /// Index into [`Scene::pictures`].
        picture: usize,
        /// Factor on its radiance, 0 or more.
        strength: f32,
        /// Rotation about +Y in radians, counter-clockwise seen from above.
        rotation: f64,
    },
}

impl Default for Background {
    fn default() -> Self {
        Self::Color(Vec3::ZERO)
    }
}

/// How transparent surfaces affect shadow rays.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Shadows {
    /// Every surface casts a full shadow, as in Whitted's ray tracer.
    #[default]
    Opaque,
    /// Light passes straight through, attenuated by transmittance, Fresnel reflection and absorption.
    Filtered,
}

/// A pinhole or thin-lens camera. Its image plane is at distance 1; the vertical field of view sets the
/// height of the plane, and the aspect ratio is the image's width over its height.
///
/// The rays of an orthographic camera are parallel and start on the plane through `look_from`: geometry
/// behind that plane is not visible. The dielectric volumes that contain `look_from` are taken to contain
/// the origins of all rays.
#[derive(Clone, Debug, PartialEq)]
pub struct Camera {
    /// Empty if the file gives none.
    pub name: String,
    /// The pinhole or the centre of the lens, in the space of `node`.
    pub look_from: DVec3,
    /// The point at the centre of the image, in the space of `node`; differs from `look_from`.
    pub look_at: DVec3,
    /// The up direction, of any length; not parallel to the viewing direction.
    pub up: DVec3,
    /// Vertical field of view in radians, in (0, π).
    pub fov_y: f64,
    /// Height of the visible region in scene units, above 0, of an orthographic camera. `None` for a
    /// perspective camera; `fov_y` is used only then.
    pub orthographic_height: Option<f64>,
    /// `None` for a pinhole, which renders everything in focus.
    pub lens: Option<Lens>,
    /// Distances along the viewing direction, in scene units, of the planes between which the camera sees: the nearer
    /// one is at least 0, the other one beyond it, possibly infinite. Other light than that to the camera is not
    /// clipped: shadows and mirror images stay whole.
    pub clip: (f64, f64),
    /// Index into [`Scene::nodes`] of the parent node; `None` is the world.
    pub node: Option<usize>,
    /// Index into [`Scene::nodes`] of a node whose origin the camera looks at, instead of `look_at`.
    pub target: Option<usize>,
}

/// The aperture of a thin lens.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Lens {
    /// Above 0, in scene units; of a polygonal aperture its circumradius.
    pub radius: f64,
    /// Distance to the plane of focus along the viewing direction, above 0.
    pub focus_distance: f64,
    /// Number of corners of the aperture, 3 or more; 0 for a circle.
    pub blade_count: u32,
    /// Angle in radians of the first corner, counter-clockwise from the image's right.
    pub blade_rotation: f64,
}

impl Camera {
    /// The planes of a camera that sees all that is in front of it.
    pub const UNCLIPPED: (f64, f64) = (0.0, f64::INFINITY);

    /// Whether `look_at` is more than a direction: formats whose cameras have no such point leave both ends as they are by
    /// default.
    pub fn has_aim(&self) -> bool {
        self.target.is_some() || (self.look_from, self.look_at) != (DVec3::ZERO, DVec3::NEG_Z)
    }
}

impl Default for Camera {
    /// The course's camera: at the origin, looking along −Z, up +Y, with a field of view of 60°.
    fn default() -> Self {
        Self {
            name: String::new(),
            look_from: DVec3::ZERO,
            look_at: DVec3::NEG_Z,
            up: DVec3::Y,
            fov_y: std::f64::consts::FRAC_PI_3,
            orthographic_height: None,
            lens: None,
            clip: Self::UNCLIPPED,
            node: None,
            target: None,
        }
    }
}

impl Scene {
    /// Makes `picture` the background, with strength 1 and without rotation. The largest pictures are halved until all of the
    /// scene take at most [`MAX_PICTURE_BYTES`]; returns how many times that was.
    pub fn set_environment(&mut self, picture: Arc<Picture>) -> usize {
        self.background = Background::Picture {
            picture: self.pictures.len(),
            strength: 1.0,
            rotation: 0.0,
        };
        self.pictures.push(picture);
        picture::fit(&mut self.pictures)
    }

    /// Makes the background a sky, whose arguments are those of [`sky::picture`]. Strength and rotation stay if it is a sky
    /// or built in already.
    pub fn set_sky(&mut self, elevation: f64, azimuth: f64) {
        self.set_generated(sky::picture(elevation, azimuth));
    }

    /// Makes the background a built-in environment. Strength and rotation stay if it is a sky or built in already.
    pub fn set_built_in(&mut self, environment: BuiltIn) {
        self.set_generated(environment.picture());
    }

    fn set_generated(&mut self, picture: Picture) {
        match self.background {
            Background::Picture { picture: index, .. }
                if self.pictures[index].origin.is_generated() =>
            {
                self.pictures[index] = Arc::new(picture);
            }
            _ => _ = self.set_environment(Arc::new(picture)),
        }
    }

    /// Fixes the render origin at its present position, so that it no longer follows the camera.
    pub fn pin_render_origin(&mut self) {
        let origin = self.render_origin_at(&self.frame(0.0));
        self.render_origin = Some(origin);
    }

    /// [`Self::render_origin`], or else the position of the camera in `rest`, the frame at time 0.
    pub fn render_origin_at(&self, rest: &Frame) -> DVec3 {
        self.render_origin.unwrap_or(rest.camera.look_from)
    }

    /// Makes meshes and pictures that are equal to those of the same number in `other` the same objects.
    pub fn share(&mut self, other: &Self) {
        fn share<T: PartialEq>(own: &mut [Arc<T>], others: &[Arc<T>]) {
            for (own, other) in own.iter_mut().zip(others) {
                if own == other {
                    *own = other.clone();
                }
            }
        }
        share(&mut self.meshes, &other.meshes);
        share(&mut self.pictures, &other.pictures);
    }

    /// The node that moves an instance, if any.
    pub fn node_of(&self, instance: &Instance) -> Option<usize> {
        let deformation = self.deformation_of(instance.mesh);
        let is_skinned = deformation.is_some_and(|it| it.skin.is_some());
        instance.node.filter(|_| !is_skinned)
    }

    /// Adds a copy of a mesh with its deformation, which the same tracks move, and returns its index.
    pub fn copy_mesh(&mut self, mesh: usize) -> usize {
        self.meshes.push(self.meshes[mesh].clone());
        let copy = self.meshes.len() - 1;
        let known = self.deformations.binary_search_by_key(&mesh, |it| it.mesh);
        if let Ok(index) = known {
            let own = self.deformations.len();
            self.deformations.push(Deformation {
                mesh: copy,
                ..self.deformations[index].clone()
            });
            for track in &mut self.tracks {
                let same = track.targets.iter().filter_map(|target| match *target {
                    Target::Weight(of, weight) if of == index => Some(Target::Weight(own, weight)),
                    _ => None,
                });
                let more: Vec<_> = same.collect();
                track.targets.extend(more);
            }
        }
        copy
    }

    /// The deformation of a mesh.
    pub fn deformation_of(&self, mesh: usize) -> Option<&Deformation> {
        let found = self.deformations.binary_search_by_key(&mesh, |it| it.mesh);
        Some(&self.deformations[found.ok()?])
    }

    /// Number of triangles in the world; each instance counts.
    pub fn triangle_count(&self) -> usize {
        self.instances
            .iter()
            .map(|instance| self.meshes[instance.mesh].triangles.len())
            .sum()
    }
}
