//! The output of `inspect --json`.

use super::attenuation;
use super::deforming::{ClipEntry, DeformationEntry};
use super::materials::MaterialEntry;
use super::motion::MotionEntry;
use super::textures::{PictureEntry, TextureEntry};
use crate::report::SceneReport;
use glimray_app::value_names::{TONES, TRANSFERS};
use glimray_render::{Integrator, Tone};
use glimray_scene::{Background, Camera, Light, LightKind, OutputDefaults, Scene};
use schemars::JsonSchema;
use serde::Serialize;

/// The contents of a scene: lengths in scene units, angles in degrees, colours in linear radiance, cameras and lights in
/// world space at time 0.
#[derive(Serialize, JsonSchema)]
pub struct Inspection {
    #[serde(flatten)]
    scene: SceneReport,
    /// Null for a scene without bounded objects.
    bounds: Option<BoundsEntry>,
    /// The camera that is used.
    camera_index: usize,
    /// How many cameras come before that one because they see nothing that is lit.
    blind_cameras: usize,
    cameras: Vec<CameraEntry>,
    light_list: Vec<LightEntry>,
    material_list: Vec<MaterialEntry>,
    texture_list: Vec<TextureEntry>,
    picture_list: Vec<PictureEntry>,
    background: BackgroundEntry,
    ambient: [f32; 3],
    /// Null without a section plane.
    section: Option<SectionEntry>,
    output: OutputEntry,
    animation: MotionEntry,
    clips: Vec<ClipEntry>,
    /// Meshes with skins or morph targets.
    deforming: Vec<DeformationEntry>,
    /// Whether nothing in the scene emits light.
    unlit: bool,
    /// Properties of the file that say nothing about the picture or are decided otherwise.
    remarks: Vec<String>,
}

/// A box in world space.
#[derive(Serialize, JsonSchema)]
struct BoundsEntry {
    min: [f64; 3],
    max: [f64; 3],
}

/// The plane beyond which the scene is cut away.
#[derive(Serialize, JsonSchema)]
struct SectionEntry {
    /// The unit direction towards what is cut away.
    normal: [f64; 3],
    /// The distance from the origin in that direction.
    offset: f64,
}

/// A camera.
#[derive(Serialize, JsonSchema)]
struct CameraEntry {
    name: String,
    look_from: [f64; 3],
    look_at: [f64; 3],
    up: [f64; 3],
    fov_y_deg: f64,
    /// The height of the view; null with perspective.
    orthographic: Option<f64>,
    /// Distance of the near plane, before which nothing is seen.
    near: f64,
    /// Distance of the far plane, beyond which nothing is seen; null without one.
    far: Option<f64>,
    /// Null for a pinhole.
    lens: Option<LensEntry>,
}

/// A thin lens.
#[derive(Serialize, JsonSchema)]
struct LensEntry {
    radius: f64,
    focus_distance: f64,
    blades: u32,
    blade_rotation_deg: f64,
}

/// A light.
#[derive(Serialize, JsonSchema)]
struct LightEntry {
    #[serde(flatten)]
    place: PlaceEntry,
    color: [f32; 3],
    /// `none` or `inverse-square`.
    attenuation: &'static str,
    /// Shadow rays to a light with an extent.
    samples: u32,
    /// Whether rays hit it.
    visible: bool,
}

/// Where a light is, by its kind.
#[derive(Serialize, JsonSchema)]
#[serde(tag = "kind", rename_all = "lowercase")]
enum PlaceEntry {
    Spot {
        position: [f64; 3],
        direction: [f64; 3],
        inner_deg: f64,
        outer_deg: f64,
    },
    Point {
        position: [f64; 3],
    },
    Directional {
        direction: [f64; 3],
    },
    Rectangle {
        center: [f64; 3],
        edge_u: [f64; 3],
        edge_v: [f64; 3],
    },
    Disc {
        center: [f64; 3],
        normal: [f64; 3],
        radius: f64,
    },
    Sphere {
        center: [f64; 3],
        radius: f64,
    },
}

/// A colour, a gradient or a picture.
#[derive(Serialize, JsonSchema)]
#[serde(untagged)]
enum BackgroundEntry {
    Color([f32; 3]),
    Gradient {
        bottom: [f32; 3],
        top: [f32; 3],
    },
    Picture {
        /// Index in `picture_list`.
        picture: usize,
        strength: f32,
        rotation_deg: f64,
    },
}

/// The settings that the scene sets for its picture.
#[derive(Serialize, JsonSchema)]
struct OutputEntry {
    /// Width and height in pixels.
    size: (u32, u32),
    integrator: &'static str,
    samples: u32,
    max_depth: u32,
    /// Whether the picture is denoised.
    denoise: bool,
    exposure_ev: f32,
    auto_exposure: bool,
    tone: &'static str,
    transfer: &'static str,
}

impl Inspection {
    pub fn new(path: &str, scene: &Scene) -> Self {
        Self {
            scene: SceneReport::new(path, scene),
            bounds: (scene.bounds()).map(|(min, max)| BoundsEntry {
                min: min.into(),
                max: max.into(),
            }),
            camera_index: scene.camera_index,
            blind_cameras: scene.blind_cameras,
            cameras: scene.cameras_at(0.0).iter().map(Into::into).collect(),
            light_list: scene.frame(0.0).lights.iter().map(Into::into).collect(),
            material_list: scene.materials.iter().map(Into::into).collect(),
            texture_list: scene.textures.iter().map(Into::into).collect(),
            picture_list: (scene.pictures.iter())
                .map(|picture| PictureEntry::from(&**picture))
                .collect(),
            background: (&scene.background).into(),
            ambient: scene.ambient.into(),
            section: scene.section.map(|section| SectionEntry {
                normal: section.normal.into(),
                offset: section.offset,
            }),
            output: (&scene.output).into(),
            animation: scene.into(),
            clips: scene.clips.iter().map(Into::into).collect(),
            deforming: (scene.deformations.iter())
                .map(|deformation| DeformationEntry::new(scene, deformation))
                .collect(),
            unlit: scene.is_unlit(),
            remarks: scene.remarks.clone(),
        }
    }
}

impl From<&Camera> for CameraEntry {
    fn from(camera: &Camera) -> Self {
        Self {
            name: camera.name.clone(),
            look_from: camera.look_from.into(),
            look_at: camera.look_at.into(),
            up: camera.up.into(),
            fov_y_deg: camera.fov_y.to_degrees(),
            orthographic: camera.orthographic_height,
            near: camera.clip.0,
            far: Some(camera.clip.1).filter(|far| far.is_finite()),
            lens: camera.lens.map(|lens| LensEntry {
                radius: lens.radius,
                focus_distance: lens.focus_distance,
                blades: lens.blade_count,
                blade_rotation_deg: lens.blade_rotation.to_degrees(),
            }),
        }
    }
}

impl From<&Light> for LightEntry {
    fn from(light: &Light) -> Self {
        let place = match light.kind {
            LightKind::Point { position } => PlaceEntry::Point {
                position: position.into(),
            },
            LightKind::Directional { direction } => PlaceEntry::Directional {
                direction: direction.into(),
            },
            LightKind::Spot {
                position,
                direction,
                inner,
                outer,
            } => PlaceEntry::Spot {
                position: position.into(),
                direction: direction.into(),
                inner_deg: inner.to_degrees(),
                outer_deg: outer.to_degrees(),
            },
            LightKind::Rectangle {
                center,
                edge_u,
                edge_v,
            } => PlaceEntry::Rectangle {
                center: center.into(),
                edge_u: edge_u.into(),
                edge_v: edge_v.into(),
            },
            LightKind::Disc {
                center,
                normal,
                radius,
            } => PlaceEntry::Disc {
                center: center.into(),
                normal: normal.into(),
                radius,
            },
            LightKind::Sphere { center, radius } => PlaceEntry::Sphere {
                center: center.into(),
                radius,
            },
        };
        Self {
            place,
            color: light.color.into(),
            attenuation: attenuation(light),
            samples: light.samples,
            visible: light.visible,
        }
    }
}

impl From<&Background> for BackgroundEntry {
    fn from(background: &Background) -> Self {
        match *background {
            Background::Color(color) => Self::Color(color.into()),
            Background::Gradient { bottom, top } => Self::Gradient {
                bottom: bottom.into(),
                top: top.into(),
            },
            Background::Picture {
                picture,
                strength,
                rotation,
            } => Self::Picture {
                picture,
                strength,
                rotation_deg: rotation.to_degrees(),
            },
        }
    }
}

impl From<&OutputDefaults> for OutputEntry {
    fn from(output: &OutputDefaults) -> Self {
        Self {
            size: output.size,
            integrator: Integrator::from(output.integrator).entry().name,
            samples: output.samples,
            max_depth: output.max_depth,
            denoise: output.denoise,
            exposure_ev: output.exposure_ev,
            auto_exposure: output.auto_exposure,
            tone: TONES.name(&Tone::from(output).curve),
            transfer: TRANSFERS.name(&output.transfer),
        }
    }
}
