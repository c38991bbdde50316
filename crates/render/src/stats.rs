//! Statistics of a render.

use super::RenderError;
use crate::{gpu::GpuError, layout::PackedCounters};

/// Maximum number of device losses in one picture.
const MAX_LOSSES: u32 = 3;

/// Statistics of a render so far.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Stats {
    /// Time spent on creating pipelines and running each once without work, which is when drivers compile, in
    /// seconds.
    pub compile_seconds: f64,
    /// Time spent on uploading the scene, including after a loss, in seconds.
    pub upload_seconds: f64,
    /// The uploaded bytes.
    pub uploads: Uploads,
    /// Time spent on tracing, from submission to readback, including discarded work, in seconds.
    pub trace_seconds: f64,
    /// Time spent on developing, in seconds.
    pub develop_seconds: f64,
    /// Number of tracing submissions.
    pub submissions: u64,
    /// The duration of the longest one, in milliseconds.
    pub longest_submission_ms: f64,
    /// Samples that were dropped because a channel is NaN or has a magnitude above 2^40.
    pub nonfinite_samples: u64,
    /// Samples whose ray tree exceeded its stack or its maximum number of rays, or in which a ray entered more
    /// nested volumes than its list of media holds. Cut-off rays are missing in the picture, and the media
    /// behind omitted volumes are wrong.
    pub cut_off_trees: u64,
    /// The sum of the throughputs, in luminance, of paths that the limit of bounces cut off.
    pub cut_throughput: f64,
    /// The luminance that clamping removed; in any unit, but that of `kept_light`.
    pub clamped_light: f64,
    /// The luminance that paths found besides, counted where light is clamped.
    pub kept_light: f64,
    /// Planned memory in bytes, of the largest frame; see [`super::ExecutionPolicy::memory_limit_bytes`].
    pub gpu_bytes: u64,
    /// Number of device losses.
    pub device_losses: u32,
    /// Number of samples in the film.
    pub samples: u64,
    /// Counted if [`super::ExecutionPolicy::count_rays`] is set.
    pub rays: Option<Rays>,
}

/// Bytes uploaded to the device so far. Unchanged data is not uploaded again.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Uploads {
    /// BLASes, triangles, shapes and vertices of scenes.
    pub geometry: u64,
    /// Materials, textures and texels.
    pub surfaces: u64,
    /// TLASes, with instances and their keys.
    pub tlas: u64,
    /// Frames with their lights, and keys of moving cameras.
    pub frames: u64,
}

/// Rays by kind. There is one shadow ray for each light, or for each sample of an area light, that the surface
/// faces.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Rays {
    /// Camera rays, one for each sample.
    pub primary: u64,
    /// Camera rays that hit something.
    pub primary_hits: u64,
    /// Shadow rays.
    pub shadow: u64,
    /// Shadow rays that are blocked before the light.
    pub shadow_blocked: u64,
    /// Reflected rays.
    pub reflection: u64,
    /// Reflected rays that hit something.
    pub reflection_hits: u64,
    /// Refracted rays.
    pub refraction: u64,
    /// Refracted rays that hit something.
    pub refraction_hits: u64,
}

impl Stats {
    pub(super) fn submitted(&mut self, seconds: f64) {
        self.trace_seconds += seconds;
        self.submissions += 1;
        self.longest_submission_ms = self.longest_submission_ms.max(seconds * 1e3);
    }

    /// Adds the counters of a slice.
    pub(super) fn add(&mut self, counters: &PackedCounters) {
        self.nonfinite_samples += u64::from(counters.nonfinite_samples);
        self.cut_off_trees += u64::from(counters.cut_off_trees);
        self.cut_throughput += f64::from(counters.cut_throughput) / 256.0;
        let wide = |high: u32, low: u32| (u64::from(high) << 32 | u64::from(low)) as f64;
        self.clamped_light += wide(counters.clamped_light_high, counters.clamped_light);
        self.kept_light += wide(counters.kept_light_high, counters.kept_light);
        if let Some(rays) = &mut self.rays {
            rays.primary += u64::from(counters.primary);
            rays.primary_hits += u64::from(counters.primary_hits);
            rays.shadow += u64::from(counters.shadow);
            rays.shadow_blocked += u64::from(counters.shadow_blocked);
            rays.reflection += u64::from(counters.reflection);
            rays.reflection_hits += u64::from(counters.reflection_hits);
            rays.refraction += u64::from(counters.refraction);
            rays.refraction_hits += u64::from(counters.refraction_hits);
        }
    }

    /// The share of the light that the limit of bounces and clamping removed from path-traced pictures, 0 to 1. That
    /// of the limit is an estimate, which takes what the cut-off paths would have found to be as bright as the
    /// picture. 0 without samples.
    pub fn energy_cut(&self) -> f64 {
        let beyond_limit = self.cut_throughput / (self.samples as f64).max(1.0);
        let found = self.clamped_light + self.kept_light;
        let kept = match found > 0.0 {
            true => self.kept_light / found,
            false => 1.0,
        };
        1.0 - (1.0 - beyond_limit) * kept
    }

    /// Counts a device failure; fails if there are too many in one picture. `earlier` failures belong to
    /// previous pictures.
    pub(super) fn count_loss(&mut self, earlier: u32) -> Result<(), RenderError> {
        self.device_losses += 1;
        let count = self.device_losses - earlier;
        if count > MAX_LOSSES {
            return Err(GpuError::KeptFailing { count }.into());
        }
        Ok(())
    }
}
