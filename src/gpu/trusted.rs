//! Shader modules whose loops wgpu does not bound: the only unsafe code.

#![allow(unsafe_code)]

use super::Gpu;

impl Gpu {
    /// A shader module. On GPUs its loops have no bound of wgpu's, a counter in each loop of which drivers make code that
    /// takes up to 1.8 times as long (benches/LOG.md, 2026-11-26). All other checks remain.
    pub(super) fn shader_module(
        &self,
        descriptor: wgpu::ShaderModuleDescriptor,
    ) -> wgpu::ShaderModule {
        if self.is_cpu() {
            return self.device.create_shader_module(descriptor);
        }
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
