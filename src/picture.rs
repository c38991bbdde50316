//! One call from a scene file to a picture.

use glimray_io::import::{self, Baking, ImportError, Options, Resolver};
#[cfg(not(target_arch = "wasm32"))]
use glimray_render::gpu::blocking::wait;
use glimray_render::gpu::{AdapterChoice, Gpu};
use glimray_render::pack::{self, PackError};
use glimray_render::{ExecutionPolicy, RenderError, RenderSettings, Renderer, Tone};
use glimray_scene::{Scene, image::Image};
#[cfg(not(target_arch = "wasm32"))]
use std::path::Path;
use std::sync::Arc;

/// The choices of [`render_file`]. The scene makes those that are `None`, as it does for `glimray render`.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct PictureOptions {
    /// Width and height in pixels, each 1 to [`glimray_render::MAX_SIDE`].
    pub size: Option<(u32, u32)>,
    /// Samples per pixel, at least 1.
    pub samples: Option<u32>,
    /// The moment of an animation, in seconds.
    pub time: f64,
    /// The adapter.
    pub adapter: AdapterChoice,
}

/// The reason why a scene file gave no picture.
#[derive(Debug, thiserror::Error)]
pub enum PictureError {
    /// The file was refused.
    #[error(transparent)]
    Import(#[from] ImportError),
    /// The scene cannot be packed for the GPU.
    #[error(transparent)]
    Pack(#[from] PackError),
    /// Rendering failed.
    #[error(transparent)]
    Render(#[from] RenderError),
}

impl PictureOptions {
    /// The options of the import.
    fn of_import(&self) -> Options {
        Options {
            size: self.size,
            baking: Baking::IfClassical,
            ..Options::default()
        }
    }

    /// Puts the choices in the place of those of the scene.
    fn apply(&self, scene: &mut Scene) {
        let output = &mut scene.output;
        output.size = self.size.unwrap_or(output.size);
        output.samples = self.samples.unwrap_or(output.samples);
    }
}

/// Renders the scene `name` of a resolver as [`render_file`] renders a file. Nothing waits.
///
/// # Errors
/// As [`render_file`].
pub async fn render_from(
    resolver: &dyn Resolver,
    name: &str,
    options: &PictureOptions,
) -> Result<Image, PictureError> {
    let mut scene = import::load_from(resolver, name, &options.of_import())?;
    options.apply(&mut scene);
    render(&scene, options).await
}

/// Renders a scene file, or a model, to the picture that `glimray render` writes: by the integrator, with the samples and the
/// tone of the scene, and denoised where it is. Values of the picture are for the display: [`glimray_io::output::save`]
/// writes them to PNG and JPEG files.
///
/// # Errors
/// The file cannot be read, there is no adapter, or the adapter cannot render the scene.
#[cfg(not(target_arch = "wasm32"))]
pub fn render_file(
    path: impl AsRef<Path>,
    options: &PictureOptions,
) -> Result<Image, PictureError> {
    let mut scene = import::load_with(path.as_ref(), &options.of_import())?;
    options.apply(&mut scene);
    wait(render(&scene, options))
}

async fn render(scene: &Scene, options: &PictureOptions) -> Result<Image, PictureError> {
    let packed = Arc::new(pack::scene(scene)?);
    let (shutter, fps) = (scene.output.shutter, scene.output.fps);
    let [open, close] = [shutter.open, shutter.close].map(|frames| options.time + frames / fps);
    let view = packed.view(&scene.motion_samples(open, close))?;
    let gpu = (Gpu::open(&options.adapter).await).map_err(RenderError::from)?;
    let settings = RenderSettings::from(&scene.output);
    let mut renderer = Renderer::new(gpu, packed, &view, settings, ExecutionPolicy::default())?;
    while !renderer.is_done() {
        renderer.step_async().await?;
    }
    Ok(renderer.develop_async(&Tone::from(&scene.output)).await?)
}
