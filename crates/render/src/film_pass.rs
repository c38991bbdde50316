//! Passes of kernels that read the film, and the memory of what they write.

use crate::gpu::{GpuError, Ledger, MEMORY_LIMIT_BYTES};

/// Adds a pass of a kernel that reads the film, with its bind groups 1 to 3, for a grid of workgroups.
pub fn add_film_pass(
    encoder: &mut wgpu::CommandEncoder,
    pipeline: &wgpu::ComputePipeline,
    [frame, film, target]: [&wgpu::BindGroup; 3],
    (columns, rows): (u32, u32),
) {
    let mut pass = encoder.begin_compute_pass(&Default::default());
    pass.set_pipeline(pipeline);
    pass.set_bind_group(1, frame, &[]);
    pass.set_bind_group(2, film, &[]);
    pass.set_bind_group(3, target, &[]);
    pass.dispatch_workgroups(columns, rows, 1);
}

/// Bytes per pixel of a picture, its sums, and their copies for upload and readback.
pub const PIXEL_BYTES: u64 = 64;

/// Checks that a picture can be developed or denoised without a renderer, in so many bytes per pixel.
pub fn check_memory(width: u32, height: u32, pixel_bytes: u64) -> Result<(), GpuError> {
    let pixels = u64::from(width).saturating_mul(height.into());
    let mut ledger = Ledger::default();
    ledger.plan("picture and film", pixels.saturating_mul(pixel_bytes));
    ledger.check(MEMORY_LIMIT_BYTES)
}
