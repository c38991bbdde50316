//! The published picture and its progress.

use super::ProgressiveImage;
use crate::worker::error_map::linear;
use glimray_render::{RenderError, Screen, Stats, Tone};
use glimray_scene::image::{Image, ScreenImage};
use std::sync::Arc;

/// A published picture.
#[derive(Clone, Debug)]
pub struct Shown {
    /// The picture so far; where it has no sample yet it is transparent.
    pub screen: Option<Screen>,
    /// Background image: the coarse preview or previous picture, scaled to fit.
    pub under: Option<Screen>,
    /// Whether `under` is the coarse preview, which comes as a whole.
    pub under_is_coarse: bool,
    /// While this is a part: the whole picture as it was last, to lie under both.
    pub whole: Option<Screen>,
    /// Which part of the picture this is: x, y, width and height in pixels of `size`.
    pub region: [u32; 4],
    /// Width and height of the whole picture.
    pub size: (u32, u32),
    /// The range of a quantity over which it is shown.
    pub range: Option<[f32; 2]>,
    /// How far it is.
    pub progress: Progress,
    /// Costs of the renderer since the window was opened.
    pub stats: Stats,
    /// Trees that were built or refitted since then.
    pub trees_built: usize,
    /// The adapter's name.
    pub adapter: Arc<str>,
}

/// How far a picture is, and what it took.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Progress {
    /// Samples that every pixel has.
    pub samples: u32,
    /// Mean samples of a pixel: more than [`Progress::samples`] while a pass over the picture goes on.
    pub mean_samples: f64,
    /// Samples that it is to get.
    pub target: u32,
    /// Share of the work that is done, in 0..=1.
    pub share: f64,
    /// Seconds of tracing in this picture.
    pub trace_seconds: f64,
    /// Camera rays per second of tracing.
    pub rays_per_second: f64,
    /// Estimated root mean square error of the developed picture, in levels of 1; `None` before there
    /// are enough samples, and without antialiasing.
    pub noise: Option<f64>,
    /// How often a picture was put on a screen.
    pub frames_shown: u64,
    /// Whether this is the coarse picture.
    pub is_coarse: bool,
    /// Whether it has all its samples.
    pub is_done: bool,
}

impl Progress {
    /// The samples so far: `17`, or `17.3` while a pass over the picture goes on.
    pub fn samples_so_far(&self) -> String {
        // Rounded down, so that no count is named too soon.
        let tenths = (self.mean_samples * 10.0 + 1e-6).floor();
        match tenths > f64::from(self.samples) * 10.0 && !self.is_coarse && !self.is_done {
            true => format!("{:.1}", tenths / 10.0),
            false => self.samples.to_string(),
        }
    }
}

impl ProgressiveImage {
    /// The picture to draw.
    pub fn shown(&self) -> Option<Shown> {
        let (renderer, request) = (self.renderer.as_ref()?, self.request.as_ref()?);
        let stats = renderer.stats();
        let seconds = stats.trace_seconds - self.spent.seconds;
        let rays = stats.samples - self.spent.samples;
        let has_picture = !self.is_coarse && self.last_look.is_some();
        Some(Shown {
            screen: self.screen.clone().filter(|_| has_picture),
            under: self.coarse.clone().or(self.screen.clone()),
            under_is_coarse: self.coarse.is_some(),
            whole: self.whole.clone(),
            region: request.settings.region(),
            size: request.settings.size,
            range: self.range,
            progress: Progress {
                samples: renderer.samples_done(),
                mean_samples: renderer.progress() * f64::from(request.settings.samples),
                target: request.settings.samples,
                share: renderer.progress(),
                trace_seconds: seconds,
                rays_per_second: rays as f64 / seconds.max(1e-9),
                noise: self.noise.estimate(),
                frames_shown: self.frames_shown,
                is_coarse: self.is_coarse,
                is_done: self.is_done(),
            },
            stats: stats.clone(),
            trees_built: self.trees_built,
            adapter: self.adapter.clone(),
        })
    }

    /// The samples so far as linear values: radiance without exposure and tone curve, or else what is displayed, decoded. `raw`
    /// leaves the denoising out. `None` before there are any.
    ///
    /// # Errors
    /// The device failed.
    pub fn linear(&mut self, raw: bool) -> Result<Option<Image>, RenderError> {
        let (Some(renderer), Some(request)) = (&mut self.renderer, &self.request) else {
            return Ok(None);
        };
        if request.is_radiance() {
            let tone = Tone {
                denoise: !raw && renderer.denoises(&request.tone),
                ..Tone::LINEAR
            };
            let has_samples = renderer.samples_done() > 0;
            return has_samples.then(|| renderer.develop(&tone)).transpose();
        }
        let Some(shown) = self.shown() else {
            return Ok(None);
        };
        let Some(screen) = shown.screen.or(shown.under) else {
            return Ok(None);
        };
        let ScreenImage {
            width,
            height,
            pixels,
        } = screen.read(&self.gpu)?;
        let pixels = pixels
            .iter()
            .map(|pixel| pixel.map(|level| f32::from(level) / 255.0));
        Ok(Some(linear(&Image {
            width,
            height,
            pixels: pixels.collect(),
        })))
    }

    /// The picture to draw without denoising.
    pub fn shown_raw(&self) -> Option<Shown> {
        let shown = self.shown()?;
        Some(match shown.screen.is_some() {
            true => Shown {
                screen: self.raw.clone().or(shown.screen),
                ..shown
            },
            false => shown,
        })
    }
}
