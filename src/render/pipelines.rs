//! Pipelines of the kernels that trace rays.

use super::{layouts::Layouts, policy::Fetch};
use crate::gpu::{Compiled, Gpu, GpuError, Kernel, Overrides};

/// A pipeline for bind groups 0 to 2, specialised by these overrides.
pub fn tracing(
    gpu: &Gpu,
    fetch: Fetch,
    layouts: &Layouts,
    kernel: Kernel,
    overrides: Overrides,
) -> Result<Compiled, GpuError> {
    let groups = [&layouts.scene, &layouts.frame, &layouts.film].map(Some);
    gpu.pipeline(&kernel, fetch == Fetch::Image, &groups, overrides)
}
