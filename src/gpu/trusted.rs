//! Shader modules whose loops wgpu does not bound: the only unsafe code.

#![allow(unsafe_code)]

use super::Gpu;

impl Gpu {
    /// A shader module. Its loops have no bound of wgpu's: drivers of GPUs make code of it that takes up to 1.8 times as long
    /// (benches/LOG.md, 2026-11-26), and other adapters get one of our own ([`super::bound_loops`]). All other checks remain.
    pub(super) fn shader_module(
        &self,
        descriptor: wgpu::ShaderModuleDescriptor,
    ) -> wgpu::ShaderModule {
        let checks = wgpu::ShaderRuntimeChecks {
            force_loop_bounding: false,
            ..wgpu::ShaderRuntimeChecks::checked()
        };
        // SAFETY: without the bound a loop that never ends is undefined behaviour. Modules come only from the kernels of
        // this program, whose loops all end: they count up to a limit, follow a ray down a tree that the host has built
        // and back up, or end with a path, whose depth is limited.
        unsafe { self.device.create_shader_module_trusted(descriptor, checks) }
    }
}
