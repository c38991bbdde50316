//! Chooses the resolution of previews and the length of time slices.

use crate::worker::request::RenderRequest;
use glimray_render::gpu::Gpu;
use glimray_render::{Antialias, ExecutionPolicy, RenderSettings, Slicing};
use std::time::Duration;

/// Target time of a submission while the window is active: on software, the cores that draw the window also
/// trace.
const SLICE: Duration = Duration::from_millis(8);
const SLICE_ON_CPU: Duration = Duration::from_millis(30);
/// Target time of a preview.
const COARSE: Duration = Duration::from_millis(12);
const COARSE_ON_CPU: Duration = Duration::from_millis(30);
/// Minimum interval between presentations during refinement. On software, drawing the window slows down
/// rendering.
const LOOK: Duration = Duration::from_millis(16);
const LOOK_ON_CPU: Duration = Duration::from_millis(250);
/// Maximum side length of a film tile.
const MAX_SIDE: u32 = 16384;

/// Maximum downscaling of a preview along each side.
const MAX_DIVISOR: u32 = 16;
/// Hysteresis: how far a preview may exceed the target before the next one is coarser, and the fraction of
/// the target below which it becomes finer. Small variations do not make the picture flicker.
const TOO_SLOW: f64 = 1.3;
const FAST_ENOUGH: f64 = 0.75;
/// Weight of the newest measurement in the average.
const NEWS: f64 = 0.3;
/// Divisors of the pictures between the coarse one and the one in full.
const LEVELS: [u32; 3] = [8, 4, 2];
/// The longest that the first sample of the picture in full may take without them, in seconds.
const AT_ONCE: f64 = 0.2;
/// Seconds of a sample before the first measurement: a slow scene on two cores.
const FIRST_GUESS: f64 = 4e-6;

/// Chooses the resolution of previews from measured times.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Pace {
    /// Estimated seconds per sample.
    seconds: f64,
    is_measured: bool,
    divisor: u32,
}

impl Default for Pace {
    fn default() -> Self {
        Self {
            seconds: FIRST_GUESS,
            is_measured: false,
            divisor: 1,
        }
    }
}

impl Pace {
    /// Adds a measurement: samples, at least 1, and their total seconds.
    pub fn measured(&mut self, seconds: f64, samples: u64) {
        let new = seconds / samples as f64;
        // A different scene or view resets the average.
        let is_other = !self.is_measured || new > 2.0 * self.seconds || 2.0 * new < self.seconds;
        self.seconds = match is_other {
            true => new,
            false => self.seconds + NEWS * (new - self.seconds),
        };
        self.is_measured = true;
    }

    /// Divisor of width and height for a picture of so many pixels that should take `wanted` seconds.
    pub fn divisor(&mut self, pixels: u64, wanted: f64) -> u32 {
        let time = |divisor: u32| pixels as f64 * self.seconds / f64::from(divisor).powi(2);
        let first_within = |limit: f64| {
            let mut divisors = 1..MAX_DIVISOR;
            divisors.find(|d| time(*d) <= limit).unwrap_or(MAX_DIVISOR)
        };
        if time(self.divisor) > TOO_SLOW * wanted {
            self.divisor = first_within(wanted);
        } else if self.divisor > 1 && time(self.divisor - 1) <= FAST_ENOUGH * wanted {
            self.divisor = first_within(FAST_ENOUGH * wanted);
        }
        self.divisor
    }

    /// The divisor of the picture that comes after one of this divisor: 8, 4, 2 and at last 1, which is the
    /// picture in full. Where a sample of `pixels` takes little time, that comes at once.
    pub fn next(&self, pixels: u64, divisor: u32) -> u32 {
        if pixels as f64 * self.seconds < AT_ONCE {
            return 1;
        }
        // A level that is hardly finer than the last is not worth its time.
        let mut finer = LEVELS.into_iter().filter(|level| 3 * level <= 2 * divisor);
        finer.next().unwrap_or(1)
    }
}

/// Maximum time to delay a window frame for its preview. Drawing the window meanwhile would slow down the
/// preview, only to show the old picture.
pub fn wait_limit(gpu: &Gpu) -> Duration {
    let coarse = if gpu.is_cpu() { COARSE_ON_CPU } else { COARSE };
    coarse.mul_f64(1.5)
}

/// Minimum interval between presentations during refinement.
pub fn between_looks(gpu: &Gpu) -> Duration {
    if gpu.is_cpu() { LOOK_ON_CPU } else { LOOK }
}

/// Time slices that keep the window responsive.
pub fn policy(gpu: &Gpu, policy: ExecutionPolicy) -> ExecutionPolicy {
    let slice = if gpu.is_cpu() { SLICE_ON_CPU } else { SLICE };
    ExecutionPolicy {
        slicing: Slicing {
            target_seconds: slice.as_secs_f64(),
            tile_side: MAX_SIDE,
            even_passes: true,
            ..policy.slicing
        },
        host_copy: false,
        ..policy
    }
}

/// The divisor of the first picture: as fine as the time allows.
pub fn first_divisor(gpu: &Gpu, pace: &mut Pace, settings: &RenderSettings) -> u32 {
    let time = if gpu.is_cpu() { COARSE_ON_CPU } else { COARSE };
    pace.divisor(pixels(settings), time.as_secs_f64())
}

/// Pixels that are rendered.
pub fn pixels(settings: &RenderSettings) -> u64 {
    let [.., width, height] = settings.region();
    u64::from(width) * u64::from(height)
}

/// A picture of one sample, with width and height divided.
pub fn coarse(request: &RenderRequest, divisor: u32) -> RenderSettings {
    let settings = &request.settings;
    let smaller = |length: u32| length.div_ceil(divisor);
    let antialias = match settings.antialias {
        Antialias::Adaptive => Antialias::Stratified,
        other => other,
    };
    RenderSettings {
        size: (smaller(settings.size.0), smaller(settings.size.1)),
        crop: (settings.crop)
            .map(|[x0, y0, x1, y1]| [x0 / divisor, y0 / divisor, smaller(x1), smaller(y1)]),
        samples: 1,
        antialias,
        features: settings.features || request.denoises_coarse(),
        ..settings.clone()
    }
}
