//! The request of a picture in the window.

use glimray_app::layers::PictureLayer;
use glimray_render::pack::PackedScene;
use glimray_render::{ExecutionPolicy, Integrator, RenderSettings, Shows, Tone};
use glimray_scene::{Background, Camera, Scene};
use std::sync::Arc;

/// All inputs of a picture, as on the command line.
#[derive(Clone, Debug)]
pub struct RenderRequest {
    /// Compared by address: every edit makes a new one.
    pub scene: Arc<Scene>,
    /// Number of restarts.
    pub restarts: u32,
    /// Overrides the scene's camera, in world space.
    pub camera: Option<Camera>,
    /// Overrides the scene's background.
    pub background: Option<Background>,
    /// When the shutter opens and closes, in seconds.
    pub shutter_interval: (f64, f64),
    /// The full-resolution size.
    pub settings: RenderSettings,
    /// The render settings; the worker chooses the time slices.
    pub policy: ExecutionPolicy,
    /// The tone mapping.
    pub tone: Tone,
    /// The layer that is shown, if the film has layers.
    pub layer: PictureLayer,
    /// Whether path-traced coarse pictures are denoised although the picture in full is not.
    pub denoises_previews: bool,
    /// Whether the luminance of a picture of radiance is shown in false colours.
    pub false_color: bool,
}

impl PartialEq for RenderRequest {
    fn eq(&self, other: &Self) -> bool {
        self.shows_same(other)
            && self.settings == other.settings
            && self.policy == other.policy
            && self.is_developed_like(other)
            && self.denoises_previews == other.denoises_previews
    }
}

impl RenderRequest {
    /// Whether coarse pictures are denoised.
    pub fn denoises_coarse(&self) -> bool {
        let is_noisy = self.settings.integrator == Integrator::Path;
        is_noisy && (self.tone.denoise || self.denoises_previews)
    }

    /// Whether both put the same film on the screen in the same way.
    pub fn is_developed_like(&self, other: &Self) -> bool {
        self.tone == other.tone
            && self.layer == other.layer
            && self.false_color == other.false_color
    }

    /// Whether false colours are shown.
    pub fn is_false_color(&self) -> bool {
        self.false_color && self.is_radiance()
    }

    /// Whether the picture is one of radiance, to which the tone mapping applies.
    pub fn is_radiance(&self) -> bool {
        self.layer == PictureLayer::Beauty
            && self.settings.integrator.entry().shows == Shows::Radiance
    }

    /// Whether both show the same scene and view.
    pub fn shows_same(&self, other: &Self) -> bool {
        Arc::ptr_eq(&self.scene, &other.scene)
            && self.restarts == other.restarts
            && self.camera == other.camera
            && self.background == other.background
            && self.shutter_interval == other.shutter_interval
    }
}

/// A scene that was packed while it was loaded, or in the background.
#[derive(Clone, Debug)]
pub struct PreparedScene {
    /// The scene, compared by address.
    pub scene: Arc<Scene>,
    /// The packed form of `scene`.
    pub packed: Arc<PackedScene>,
}

impl PreparedScene {
    /// The packed scene if it is `scene`.
    pub fn packed(&self, scene: &Arc<Scene>) -> Option<&Arc<PackedScene>> {
        Arc::ptr_eq(&self.scene, scene).then_some(&self.packed)
    }
}
