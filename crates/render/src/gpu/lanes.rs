//! Proves on a software adapter that lanes read what is theirs, and that a subgroup has as many of them as the adapter says.
//!
//! Mesa's shader cache does not know the width of vectors: Mesa 25.0 gives functions that were compiled for 8 lanes
//! to kernels of 16, whose pictures are then wrong. The cache of the program has a folder for each width, but
//! other programs that use the library may not.

use super::{Gpu, GpuError, Source, blocking::wait};
use bytemuck::{cast_slice, pod_collect_to_vec};
use std::sync::atomic::Ordering;

/// Invocations, a workgroup of those that trace.
const COUNT: u32 = 64;

/// Each invocation reads a texel of its own, and gets the index of the lane on the other side of its subgroup.
const KERNEL: &str = "
    @group(0) @binding(0) var texels: texture_storage_2d<rgba32uint, read>;
    @group(0) @binding(1) var<storage, read_write> found: array<vec2u>;
    @compute @workgroup_size(64)
    fn prove_lanes(@builtin(local_invocation_index) index: u32) {
        let texel = textureLoad(texels, vec2u(index, 0u));
        found[index] = vec2u(texel.y, OTHER);
    }";

impl Gpu {
    /// Tries the lanes of a software adapter, once for each device. Waits for it. A browser has a cache of its own.
    pub(super) fn prove_lanes(&self) -> Result<(), GpuError> {
        let can_try = self.is_cpu() && self.reads_images();
        if !can_try || self.lanes_proved.load(Ordering::Acquire) {
            return Ok(());
        }
        if self.try_lanes()? != expected(self.packet_lanes()) {
            return Err(GpuError::WrongLanes {
                adapter: self.report.name.clone(),
            });
        }
        self.lanes_proved.store(true, Ordering::Release);
        Ok(())
    }

    fn try_lanes(&self) -> Result<Vec<[u32; 2]>, GpuError> {
        let other = match self.packet_lanes() {
            Some(lanes) => format!(
                "subgroupShuffle(index, (index ^ {}u) % {lanes}u)",
                lanes / 2
            ),
            None => "index".to_owned(),
        };
        let bytes = u64::from(8 * COUNT);
        let usage = wgpu::BufferUsages::STORAGE | wgpu::BufferUsages::COPY_SRC;
        let results = self.allocate("lanes", bytes, usage)?;
        let staging = self.allocate(
            "lanes",
            bytes,
            wgpu::BufferUsages::MAP_READ | wgpu::BufferUsages::COPY_DST,
        )?;
        let texels: Vec<[u32; 4]> = (0..COUNT).map(|index| [0, texel(index), 0, 0]).collect();
        let texels: &[u8] = cast_slice(&texels);
        let format = wgpu::TextureFormat::Rgba32Uint;
        let image = self.allocate_image(
            "lanes",
            texels.len() as u64,
            (COUNT, None),
            (format, wgpu::TextureUsages::STORAGE_BINDING),
        )?;
        self.write_image(&image, 0, texels)?;
        let encoder = self.scoped("lanes", || {
            let device = &self.device;
            let module = device.create_shader_module(wgpu::ShaderModuleDescriptor {
                label: Some("lanes"),
                source: wgpu::ShaderSource::Wgsl(KERNEL.replace("OTHER", &other).into()),
            });
            let pipeline = device.create_compute_pipeline(&wgpu::ComputePipelineDescriptor {
                label: Some("lanes"),
                layout: None,
                module: &module,
                entry_point: None,
                compilation_options: Default::default(),
                cache: None,
            });
            let group = device.create_bind_group(&wgpu::BindGroupDescriptor {
                label: Some("lanes"),
                layout: &pipeline.get_bind_group_layout(0),
                entries: &[
                    wgpu::BindGroupEntry {
                        binding: 0,
                        resource: wgpu::BindingResource::TextureView(&image),
                    },
                    wgpu::BindGroupEntry {
                        binding: 1,
                        resource: results.as_entire_binding(),
                    },
                ],
            });
            let mut encoder = device.create_command_encoder(&Default::default());
            let mut pass = encoder.begin_compute_pass(&Default::default());
            pass.set_pipeline(&pipeline);
            pass.set_bind_group(0, &group, &[]);
            pass.dispatch_workgroups(1, 1, 1);
            drop(pass);
            encoder
        })?;
        let source = Source {
            buffer: &results,
            offset: 0,
            bytes,
        };
        wait(self.submit_and_read(encoder, &[source], &staging, pod_collect_to_vec))
    }
}

/// A number that no other texel has.
fn texel(index: u32) -> u32 {
    1000 + 7 * index
}

/// The results of invocations that are lanes along x of subgroups of this size.
fn expected(lanes: Option<u32>) -> Vec<[u32; 2]> {
    let other = |index: u32| lanes.map_or(index, |lanes| index ^ (lanes / 2));
    (0..COUNT)
        .map(|index| [texel(index), other(index)])
        .collect()
}
