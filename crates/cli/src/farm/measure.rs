//! Measures what a picture or an animation costs, by rendering a few rows with few samples.

use crate::device;
use crate::interrupt::Interrupt;
use crate::job::Job;
use glimray_app::error::AppError;
use glimray_app::storage;
use glimray_render::gpu::Gpu;
use glimray_render::pack::{self, PackedScene};
use glimray_render::{Antialias, FilmOutline, RenderSettings, Renderer};
use glimray_scene::image::Image;
use std::sync::Arc;
use std::time::Instant;

/// Strips of a picture that are measured, and their height in rows.
const STRIPS: u32 = 24;
const STRIP_ROWS: u32 = 8;

/// Frames of an animation that are measured.
const FRAMES: usize = 5;

/// Least seconds of a measurement: shorter ones measure the submission.
const LEAST_SECONDS: f64 = 0.05;

/// Most samples of a measurement.
const MOST_SAMPLES: u32 = 64;

/// Costs of the work on this machine.
pub struct Costs {
    /// The adapter.
    pub adapter: String,
    /// Seconds to load the scene, build its tree, open the adapter and compile the kernels.
    pub start: f64,
    /// Seconds of each frame; one for a picture.
    pub frames: Vec<f64>,
    /// Seconds of each row of the region, for all samples, of the frame in the middle.
    pub rows: Vec<f64>,
    /// The outline of a film of the picture.
    pub film: FilmOutline,
    /// Some rows of the picture, as they are developed.
    pub sample: Image,
    /// The device that was measured.
    pub gpu: Gpu,
}

/// Measures the frames whose shutter is open at these times, in seconds.
///
/// # Errors
/// Errors of rendering.
pub fn measure(
    job: &Job,
    planned: &RenderSettings,
    gpu: Gpu,
    shutters: &[(f64, f64)],
    (started, interrupt): (Instant, &Interrupt),
) -> Result<Costs, AppError> {
    let middle = shutters[shutters.len() / 2];
    let mut meter = Meter::new(job, planned, gpu, middle, interrupt)?;
    let start = started.elapsed().as_secs_f64();
    let rows = meter.rows(middle, STRIPS)?;
    let renderer = &mut meter.renderer;
    let film = renderer.outline_of(planned);
    let sample = renderer.develop(&job.tone(planned, false))?;
    let frames = match shutters.len() {
        1 => vec![rows.iter().sum()],
        count => {
            let points = count.min(FRAMES);
            let at = |point: usize| point * (count - 1) / (points - 1).max(1);
            let mut known = Vec::new();
            for point in 0..points {
                let rows = meter.rows(shutters[at(point)], STRIPS / 4)?;
                known.push((at(point), rows.iter().sum()));
            }
            (0..count).map(|index| between(&known, index)).collect()
        }
    };
    let gpu = meter.renderer.gpu().clone();
    Ok(Costs {
        adapter: device::describe(gpu.adapter()),
        start,
        frames,
        rows,
        film,
        sample,
        gpu,
    })
}

/// Renders strips of frames.
struct Meter<'a> {
    job: &'a Job<'a>,
    settings: RenderSettings,
    packed: Arc<PackedScene>,
    renderer: Renderer,
    interrupt: &'a Interrupt,
}

impl<'a> Meter<'a> {
    /// Has everything compiled, by rendering a strip.
    fn new(
        job: &'a Job<'a>,
        planned: &RenderSettings,
        gpu: Gpu,
        shutter: (f64, f64),
        interrupt: &'a Interrupt,
    ) -> Result<Self, AppError> {
        // Few samples tell enough, and those of adaptive sampling cannot be cut.
        let settings = RenderSettings {
            antialias: match planned.antialias {
                Antialias::Adaptive => Antialias::Stratified,
                other => other,
            },
            ..planned.clone()
        };
        let packed = Arc::new(pack::scene(&job.scene)?);
        let view = packed.view(&job.scene.motion_samples(shutter.0, shutter.1))?;
        let [_, top, ..] = settings.region();
        let first = strip(&settings, top, 1);
        let policy = storage::with_requested(job.policy())?;
        let renderer = Renderer::new(gpu, packed.clone(), &view, first, policy)?;
        let mut meter = Self {
            job,
            settings,
            packed,
            renderer,
            interrupt,
        };
        meter.finish()?;
        Ok(meter)
    }

    /// Seconds of each row of a frame.
    fn rows(&mut self, (open, close): (f64, f64), strips: u32) -> Result<Vec<f64>, AppError> {
        let view = (self.packed).view(&self.job.scene.motion_samples(open, close))?;
        let [_, top, _, height] = self.settings.region();
        let most_samples = MOST_SAMPLES.min(self.settings.samples);
        let strips = strips.clamp(1, height.div_ceil(STRIP_ROWS));
        let mut rows = vec![0.0; height as usize];
        for index in 0..strips {
            let band =
                |index: u32| (u64::from(height) * u64::from(index) / u64::from(strips)) as u32;
            let (from, to) = (band(index), band(index + 1));
            let y = top + ((from + to).saturating_sub(STRIP_ROWS) / 2).max(from);
            let mut samples = 1;
            let (mut seconds, mut measured);
            loop {
                let strip = strip(&self.settings, y, samples);
                measured = strip.region()[3];
                let policy = self.job.policy();
                (self.renderer).restart(self.packed.clone(), &view, strip, policy)?;
                let begun = Instant::now();
                self.finish()?;
                seconds = begun.elapsed().as_secs_f64();
                if seconds >= LEAST_SECONDS || samples >= most_samples {
                    break;
                }
                samples = (samples * 4).min(most_samples);
            }
            let of_row = seconds / f64::from(measured) / f64::from(samples);
            let cost = of_row * f64::from(self.settings.samples);
            rows[from as usize..to as usize].fill(cost);
        }
        Ok(rows)
    }

    fn finish(&mut self) -> Result<(), AppError> {
        while !self.renderer.is_done() {
            self.interrupt.check()?;
            self.renderer.step()?;
        }
        Ok(())
    }
}

/// The settings of a strip with its first row at `y`.
fn strip(settings: &RenderSettings, y: u32, samples: u32) -> RenderSettings {
    let [x, top, width, height] = settings.region();
    let bottom = (y + STRIP_ROWS).min(top + height);
    RenderSettings {
        crop: Some([x, y, x + width, bottom]),
        sample_range: Some(0..samples),
        ..settings.clone()
    }
}
/// The value at `index` on the straight line between its neighbours among `known`, which are in order.
fn between(known: &[(usize, f64)], index: usize) -> f64 {
    let next = known.partition_point(|(at, _)| *at < index);
    let (right_at, right) = known[next.min(known.len() - 1)];
    let (left_at, left) = known[next.saturating_sub(1)];
    match right_at > left_at && index < right_at {
        true => left + (right - left) * (index - left_at) as f64 / (right_at - left_at) as f64,
        false => right,
    }
}
