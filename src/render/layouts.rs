//! Bind group layouts of `bindings.wesl`, and bind groups.

use super::policy::Fetch;
use crate::gpu::Gpu;
use wgpu::{BindGroupLayout, BindingType, BufferBindingType, TextureFormat};

/// Format of the images that hold rows of the scene.
pub const ROW_FORMAT: TextureFormat = TextureFormat::Rgba32Uint;
/// Format of the words of texels.
pub const TEXEL_FORMAT: TextureFormat = TextureFormat::R32Uint;
/// Format of screen textures: values already encoded for display.
pub const SCREEN_FORMAT: TextureFormat = TextureFormat::Rgba8Unorm;

/// Layouts of groups 0 to 3.
pub struct Layouts {
    pub scene: BindGroupLayout,
    pub frame: BindGroupLayout,
    pub film: BindGroupLayout,
    pub develop: BindGroupLayout,
    pub show: BindGroupLayout,
}

impl Layouts {
    pub fn new(gpu: &Gpu, fetch: Fetch) -> Self {
        let read = BindingType::Buffer {
            ty: BufferBindingType::Storage { read_only: true },
            has_dynamic_offset: false,
            min_binding_size: None,
        };
        let write = BindingType::Buffer {
            ty: BufferBindingType::Storage { read_only: false },
            has_dynamic_offset: false,
            min_binding_size: None,
        };
        let image = |format, view_dimension| BindingType::StorageTexture {
            access: wgpu::StorageTextureAccess::ReadOnly,
            format,
            view_dimension,
        };
        let sampled = BindingType::Texture {
            sample_type: wgpu::TextureSampleType::Uint,
            view_dimension: wgpu::TextureViewDimension::D2Array,
            multisampled: false,
        };
        let screen = BindingType::StorageTexture {
            access: wgpu::StorageTextureAccess::WriteOnly,
            format: SCREEN_FORMAT,
            view_dimension: wgpu::TextureViewDimension::D2,
        };
        let (geometry, texels) = match fetch {
            Fetch::Image => (
                image(ROW_FORMAT, wgpu::TextureViewDimension::D2),
                image(TEXEL_FORMAT, wgpu::TextureViewDimension::D2Array),
            ),
            _ => (read, sampled),
        };
        let layout_at = |label, bindings: &[u32], types: &[BindingType]| {
            let entries: Vec<_> = (bindings.iter())
                .zip(types)
                .map(|(&binding, &ty)| wgpu::BindGroupLayoutEntry {
                    binding,
                    visibility: wgpu::ShaderStages::COMPUTE,
                    ty,
                    count: None,
                })
                .collect();
            gpu.device
                .create_bind_group_layout(&wgpu::BindGroupLayoutDescriptor {
                    label: Some(label),
                    entries: &entries,
                })
        };
        let layout = |label, types: &[BindingType]| layout_at(label, &[0, 1, 2, 3, 4], types);
        Self {
            scene: layout("scene", &[geometry, geometry, geometry, geometry, texels]),
            frame: layout("frame", &[read, write]),
            film: layout("film", &[write]),
            develop: layout("develop", &[read, write]),
            show: layout_at("show", &[0, 2], &[read, screen]),
        }
    }
}

/// A bind group of these resources at bindings 0, 1, ….
pub fn group(
    gpu: &Gpu,
    layout: &BindGroupLayout,
    resources: &[wgpu::BindingResource],
) -> wgpu::BindGroup {
    let numbered: Vec<_> = (0..).zip(resources.iter().cloned()).collect();
    group_at(gpu, layout, &numbered)
}

/// A bind group of resources at the given bindings.
pub fn group_at(
    gpu: &Gpu,
    layout: &BindGroupLayout,
    resources: &[(u32, wgpu::BindingResource)],
) -> wgpu::BindGroup {
    let entries: Vec<_> = (resources.iter())
        .map(|(binding, resource)| wgpu::BindGroupEntry {
            binding: *binding,
            resource: resource.clone(),
        })
        .collect();
    gpu.device.create_bind_group(&wgpu::BindGroupDescriptor {
        label: None,
        layout,
        entries: &entries,
    })
}
