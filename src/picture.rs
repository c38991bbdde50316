//! One call from a scene file to a picture.

use glimray_io::import::{self, Baking, ImportError, Options, Resolver};
#[cfg(not(target_arch = "wasm32"))]
use glimray_render::gpu::blocking::wait;
use glimray_render::gpu::{AdapterChoice, Gpu};
use glimray_render::pack::{self, PackError};
use glimray_render::{ExecutionPolicy, MAX_SIDE, RenderError, RenderSettings, Renderer, Tone};
use glimray_scene::{Scene, image::Image};
#[cfg(not(target_arch = "wasm32"))]
use std::path::Path;
use std::sync::Arc;

/// The choices of [`render_file`]. The scene makes those that are `None`, as it does for `glimray render`.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct PictureOptions {
    /// Width and height in pixels, each 1 to [`MAX_SIDE`](crate::render::MAX_SIDE).
    pub size: Option<(u32, u32)>,
    /// Samples per pixel, at least 1.
    pub samples: Option<u32>,
    /// The moment of an animation, in seconds: any finite number. The default is 0.
    pub time: f64,
    /// The adapter that renders. The default is the fastest kind available.
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
    /// An option is out of its range.
    #[error("bad option ({name}): {value} is not {wanted}.")]
    Option {
        /// The field of [`PictureOptions`].
        name: &'static str,
        /// The value of the field.
        value: String,
        /// The range of the field.
        wanted: &'static str,
    },
    /// Rendering failed.
    #[error(transparent)]
    Render(#[from] RenderError),
}

impl PictureOptions {
    /// Checks the ranges.
    fn check(&self) -> Result<(), PictureError> {
        let is_side = |side: &u32| (1..=MAX_SIDE).contains(side);
        let (name, value, wanted) = match self {
            Self {
                size: Some(size), ..
            } if ![size.0, size.1].iter().all(is_side) => (
                "size",
                format!("{size:?}"),
                "two sides of 1 to 1,000,000 pixels",
            ),
            Self {
                samples: Some(0), ..
            } => ("samples", "0".to_owned(), "at least 1"),
            Self { time, .. } if !time.is_finite() => ("time", time.to_string(), "finite"),
            _ => return Ok(()),
        };
        Err(PictureError::Option {
            name,
            value,
            wanted,
        })
    }

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

/// Renders the scene `name` of a resolver as [`render_file`] renders a file. The call reads the files; the future renders
/// without waiting for the device, but kernels are compiled in between.
///
/// Outside browsers the future polls the device and asks to be polled again at once, so that an executor's thread stays
/// busy. Threads that may sleep call [`render_file`] or [`gpu::blocking::wait`](crate::gpu::blocking::wait).
///
/// # Errors
/// As [`render_file`].
pub fn render_from<'a>(
    resolver: &dyn Resolver,
    name: &str,
    options: &'a PictureOptions,
) -> impl Future<Output = Result<Image, PictureError>> + use<'a> {
    let loaded = loaded(options, |import| import::load_from(resolver, name, import));
    async move { render(&loaded?, options).await }
}

/// Renders a scene file, or a model, to the picture that `glimray render` writes: by the integrator, with the samples and the
/// tone of the scene, and denoised where it is. The picture has display values, 0 to 1: exposure, tone curve and transfer
/// function are applied. [`output::save`](crate::output::save) writes it to a file.
///
/// # Errors
/// An option is out of its range; the file cannot be read or is refused; the scene cannot be packed; there is no adapter; or
/// the adapter cannot render the scene.
#[cfg(not(target_arch = "wasm32"))]
pub fn render_file(
    path: impl AsRef<Path>,
    options: &PictureOptions,
) -> Result<Image, PictureError> {
    let scene = loaded(options, |import| import::load_with(path.as_ref(), import))?;
    wait(render(&scene, options))
}

/// The scene with the choices in the place of its own.
fn loaded(
    options: &PictureOptions,
    load: impl FnOnce(&Options) -> Result<Scene, ImportError>,
) -> Result<Scene, PictureError> {
    options.check()?;
    let mut scene = load(&options.of_import())?;
    options.apply(&mut scene);
    Ok(scene)
}

async fn render(scene: &Scene, options: &PictureOptions) -> Result<Image, PictureError> {
    let packed = Arc::new(pack::scene(scene)?);
    let (open, close) = (scene.output.shutter).interval(options.time, scene.output.fps);
    let view = packed.view(&scene.motion_samples(open, close))?;
    let gpu = (Gpu::open(&options.adapter).await).map_err(RenderError::from)?;
    let settings = RenderSettings::from(&scene.output);
    let mut renderer = Renderer::new(gpu, packed, &view, settings, ExecutionPolicy::default())?;
    while !renderer.is_done() {
        renderer.step_async().await?;
    }
    Ok(renderer.develop_async(&Tone::from(&scene.output)).await?)
}
