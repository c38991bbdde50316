//! Renders the frames of an animation.

use super::Files;
use super::fingerprint::{self, Fingerprint};
use super::journal::Origin;
use crate::clock::Clock;
use crate::error::AppError;
use glimray_io::output::Format;
use glimray_render::gpu::{AdapterReport, Gpu};
use glimray_render::pack::{self, PackedScene, PackedView};
use glimray_render::{self as render, ExecutionPolicy, RenderSettings, Renderer, Tone};
use glimray_scene::Scene;
use std::sync::Arc;

/// The frames of an animation. All of them share one renderer, so that only moving geometry is uploaded per frame.
pub struct Frames<'a> {
    scene: &'a Scene,
    clock: Clock,
    settings: RenderSettings,
    packed: Arc<PackedScene>,
    /// Fingerprints of the scene and of the settings.
    fingerprints: (Fingerprint, Fingerprint),
    adapter: Option<AdapterReport>,
    /// The adapter until the renderer takes it; always `None` if nothing may be rendered.
    gpu: Option<Gpu>,
    renderer: Option<Renderer>,
}

impl<'a> Frames<'a> {
    /// Packs the scene. Without `gpu` no frame can be rendered. `settings_fingerprint` is [`of_settings`].
    ///
    /// # Errors
    /// The scene cannot be packed.
    pub fn new(
        scene: &'a Scene,
        clock: Clock,
        settings: RenderSettings,
        settings_fingerprint: Fingerprint,
        gpu: Option<Gpu>,
    ) -> Result<Self, AppError> {
        let packed = Arc::new(pack::scene(scene)?);
        let of_scene = render::Fingerprint::of_scene(&packed).to_string();
        Ok(Self {
            scene,
            clock,
            settings,
            packed,
            fingerprints: (of_scene, settings_fingerprint),
            adapter: gpu.as_ref().map(|gpu| gpu.adapter().clone()),
            gpu,
            renderer: None,
        })
    }

    /// The settings of every frame.
    pub fn settings(&self) -> &RenderSettings {
        &self.settings
    }

    /// Time to build the BVHs, in seconds.
    pub fn build_seconds(&self) -> f64 {
        self.packed.build_seconds
    }

    /// The adapter; `None` if nothing may be rendered.
    pub fn adapter(&self) -> Option<&AdapterReport> {
        self.adapter.as_ref()
    }

    /// The packed view of a frame: camera, lights and moving geometry during its exposure.
    ///
    /// # Errors
    /// The view cannot be packed.
    pub fn view(&self, number: u32) -> Result<PackedView, AppError> {
        let (open, close) = self.clock.frame(number);
        Ok(self.packed.view(&self.scene.motion_samples(open, close))?)
    }

    /// The origin of a frame with this view.
    pub fn origin(&self, view: &PackedView) -> Origin {
        let (scene, settings) = self.fingerprints.clone();
        Origin {
            scene,
            view: render::Fingerprint::of_view(view).to_string(),
            settings,
            renderer: self.adapter.as_ref().map(|adapter| {
                let AdapterReport {
                    name,
                    backend,
                    driver,
                    ..
                } = adapter;
                let version = env!("CARGO_PKG_VERSION");
                format!("glimray {version}, {backend}, {name}, {driver}")
            }),
        }
    }

    /// The renderer at the start of a frame with this view. `policy` is asked for at the first one.
    ///
    /// # Errors
    /// `policy` failed, the frame cannot be rendered, or there is no adapter.
    pub fn begin(
        &mut self,
        view: &PackedView,
        policy: impl FnOnce() -> Result<ExecutionPolicy, AppError>,
    ) -> Result<&mut Renderer, AppError> {
        match (&mut self.renderer, self.gpu.take()) {
            (Some(renderer), _) => {
                renderer.set_frame(view)?;
                Ok(renderer)
            }
            (empty, Some(gpu)) => {
                let (scene, settings) = (self.packed.clone(), self.settings.clone());
                let renderer = Renderer::new(gpu, scene, view, settings, policy()?)?;
                Ok(empty.insert(renderer))
            }
            (None, None) => Err(AppError::Internal("there is no adapter".into())),
        }
    }

    /// The renderer; `None` before the first frame.
    pub fn renderer(&self) -> Option<&Renderer> {
        self.renderer.as_ref()
    }
}

/// The fingerprint of everything except scene and view that affects a frame's file. `layers` names further layers.
pub fn of_settings(
    settings: &RenderSettings,
    tone: &Tone,
    files: Option<&Files>,
    layers: &str,
) -> Fingerprint {
    let format = match files {
        // Quality affects only lossy formats.
        Some(files) if files.format == Format::Jpeg => format!("JPEG {}", files.options.quality),
        Some(files) => files.format.to_string(),
        None => String::new(),
    };
    let (settings, tone) = (settings.fingerprint(), tone.fingerprint());
    fingerprint::of_text(&format!("{settings} {tone} {format}{layers}"))
}
