//! The accounts of a render.

use super::RenderError;
use crate::{gpu::GpuError, layout::PackedCounters};

/// How often a lost device is replaced before a picture is given up.
const MAX_LOSSES: u32 = 3;

/// What a render has cost so far.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Stats {
    /// Making pipelines and running each once with nothing to do, when drivers compile.
    pub compile_seconds: f64,
    /// Copying the scene to the device, again after a loss.
    pub upload_seconds: f64,
    /// What was copied to it.
    pub uploads: Uploads,
    /// Tracing, from submission to the copy of the film, whatever came of it.
    pub trace_seconds: f64,
    /// Developing, each time it was asked for.
    pub develop_seconds: f64,
    /// Submissions that traced.
    pub submissions: u64,
    /// The longest of them, in milliseconds.
    pub longest_submission_ms: f64,
    /// Samples that were dropped: with them a sum would be infinite or not a number.
    pub nonfinite_samples: u64,
    /// Samples whose ray tree outgrew its stack or had too many rays, or a ray of which came into more
    /// transparent bodies, one inside the other, than it remembers. What was cut off is missing in the
    /// picture, and behind bodies that were forgotten it is wrong.
    pub cut_off_trees: u64,
    /// Planned memory in bytes, of the frame that takes most; see [`super::ExecutionPolicy::memory_limit_bytes`].
    pub gpu_bytes: u64,
    /// How often the device was lost and replaced.
    pub device_losses: u32,
    /// Camera rays whose sum is in the film.
    pub samples: u64,
    /// Kept with [`super::ExecutionPolicy::count_rays`].
    pub rays: Option<Rays>,
}

/// Bytes copied to the device so far. What is there already is not copied again.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Uploads {
    /// Trees, triangles, shapes and vertices of scenes.
    pub geometry: u64,
    /// Materials, textures and texels.
    pub surfaces: u64,
    /// Trees over instances, the instances and their keys.
    pub tlas: u64,
    /// Frames with their lights, and keys of moving cameras.
    pub frames: u64,
}

/// Rays by kind. Shadow rays count one for each light, or sample of a light with extent, that the
/// surface faces.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Rays {
    /// From the camera, one for each sample.
    pub primary: u64,
    /// Those that hit something.
    pub primary_hits: u64,
    /// To lights.
    pub shadow: u64,
    /// Those that hit something before the light.
    pub shadow_blocked: u64,
    /// Mirrored.
    pub reflection: u64,
    /// Those that hit something.
    pub reflection_hits: u64,
    /// Refracted.
    pub refraction: u64,
    /// Those that hit something.
    pub refraction_hits: u64,
}

impl Stats {
    pub(super) fn submitted(&mut self, seconds: f64) {
        self.trace_seconds += seconds;
        self.submissions += 1;
        self.longest_submission_ms = self.longest_submission_ms.max(seconds * 1e3);
    }

    /// Adds the accounts of a slice.
    pub(super) fn add(&mut self, counters: &PackedCounters) {
        self.nonfinite_samples += u64::from(counters.nonfinite_samples);
        self.cut_off_trees += u64::from(counters.cut_off_trees);
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

    /// Counts a failure of the device; too many of them in one picture, before which there were
    /// `earlier` ones, are the end.
    pub(super) fn count_loss(&mut self, earlier: u32) -> Result<(), RenderError> {
        self.device_losses += 1;
        let count = self.device_losses - earlier;
        if count > MAX_LOSSES {
            return Err(GpuError::KeptFailing { count }.into());
        }
        Ok(())
    }
}
