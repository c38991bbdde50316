//! Shader modules whose loops wgpu does not bound: the only unsafe code.

#![allow(unsafe_code)]

use super::Gpu;

/// The checks that wgpu adds to kernels: all but its bound on loops, of which drivers of GPUs make code that takes up to 1.8 times
/// as long (benches/log/2026-11.md, 2026-11-26). Other adapters get a bound of our own: [`super::bound_loops`].
pub fn runtime_checks() -> wgpu::ShaderRuntimeChecks {
    wgpu::ShaderRuntimeChecks {
        force_loop_bounding: false,
        ..wgpu::ShaderRuntimeChecks::checked()
    }
}

impl Gpu {
    /// A shader module with [`runtime_checks`].
    pub(super) fn shader_module(
        &self,
        descriptor: wgpu::ShaderModuleDescriptor,
    ) -> wgpu::ShaderModule {
        // SAFETY: without the bound a loop that never ends is undefined behaviour. Modules come only from the kernels of
        // this program, whose loops all end: they count up to a limit, follow a ray down a tree that the host has built
        // and back up, or end with a path, whose depth is limited.
        unsafe { (self.device).create_shader_module_trusted(descriptor, runtime_checks()) }
    }
}
