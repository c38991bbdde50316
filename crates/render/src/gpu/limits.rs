//! The limits that a device is opened with.

use super::{GpuError, Needs, STORAGE_IMAGES};

/// WebGPU's default limits, raised to `needs` where the adapter allows it.
pub(super) fn limits_for(needs: Needs, adapter: &wgpu::Limits) -> Result<wgpu::Limits, GpuError> {
    let defaults = wgpu::Limits::default();
    let raise = |(name, in_bytes), need: u64, default: u64, most: u64| {
        if need > default && need > most {
            return Err(GpuError::Limit {
                name,
                need,
                limit: most,
                in_bytes,
            });
        }
        Ok(need.max(default).min(most.max(1)))
    };
    let binding = raise(
        ("one storage buffer binding", true),
        needs.binding_bytes,
        defaults.max_storage_buffer_binding_size,
        adapter.max_storage_buffer_binding_size,
    )?;
    let buffer = raise(
        ("one buffer", true),
        needs.binding_bytes,
        defaults.max_buffer_size,
        adapter.max_buffer_size,
    )?;
    let side = raise(
        ("texels along a texture's side", false),
        needs.texture_side.into(),
        defaults.max_texture_dimension_2d.into(),
        adapter.max_texture_dimension_2d.into(),
    )?;
    // Limits that an adapter cannot meet (a GL driver below the WebGPU minimum) are not requested; creating the
    // pipeline of a shader that needs them fails.
    let floor = defaults.or_worse_values_from(adapter);
    Ok(wgpu::Limits {
        max_storage_buffer_binding_size: binding,
        max_buffer_size: buffer,
        max_texture_dimension_2d: side as u32,
        max_storage_textures_per_shader_stage: adapter
            .max_storage_textures_per_shader_stage
            .min(STORAGE_IMAGES),
        ..floor
    })
}
