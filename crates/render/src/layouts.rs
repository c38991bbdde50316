//! Bind group layouts of `bindings.wesl`, and bind groups.

use super::policy::Fetch;
use crate::gpu::{Gpu, Variant};
use wgpu::{
    BindGroup, BindGroupDescriptor, BindGroupEntry, BindGroupLayout, BindGroupLayoutDescriptor,
    BindGroupLayoutEntry, BindingResource, BindingType, BufferBindingType, ShaderStages,
    StorageTextureAccess, TextureFormat, TextureSampleType, TextureViewDimension,
};

/// Format of the images that hold rows of the scene.
pub const ROW_FORMAT: TextureFormat = TextureFormat::Rgba32Uint;
/// Format of the words of texels.
pub const TEXEL_FORMAT: TextureFormat = TextureFormat::R32Uint;
/// Format of screen textures: values already encoded for display.
pub const SCREEN_FORMAT: TextureFormat = TextureFormat::Rgba8Unorm;

/// Format of what the denoiser reads and writes, and of its guides.
pub const COLOR_FORMAT: TextureFormat = TextureFormat::Rgba32Float;
pub const GUIDE_FORMAT: TextureFormat = TextureFormat::Rgba32Uint;

/// Layouts of groups 0 to 3.
pub struct Layouts {
    pub scene: BindGroupLayout,
    pub frame: BindGroupLayout,
    pub film: BindGroupLayout,
    pub develop: BindGroupLayout,
}

impl Layouts {
    pub fn new(gpu: &Gpu, fetch: Fetch) -> Self {
        let (read, write) = (buffer(true), buffer(false));
        let image = |format, view_dimension| BindingType::StorageTexture {
            access: StorageTextureAccess::ReadOnly,
            format,
            view_dimension,
        };
        let sampled = BindingType::Texture {
            sample_type: TextureSampleType::Uint,
            view_dimension: TextureViewDimension::D2Array,
            multisampled: false,
        };
        let (geometry, texels) = match fetch {
            Fetch::Image => (
                image(ROW_FORMAT, TextureViewDimension::D2),
                image(TEXEL_FORMAT, TextureViewDimension::D2Array),
            ),
            _ => (read, sampled),
        };
        let layout =
            |label, types: &[BindingType]| layout(gpu, label, (0..).zip(types.iter().copied()));
        Self {
            scene: layout("scene", &[geometry, geometry, geometry, geometry, texels]),
            frame: layout("frame", &[read, write]),
            film: layout("film", &[write]),
            develop: layout("develop", &[read, write]),
        }
    }
}

/// A bind group of these resources at bindings 0, 1, ….
pub fn group(gpu: &Gpu, layout: &BindGroupLayout, resources: &[BindingResource]) -> BindGroup {
    let numbered: Vec<_> = (0..).zip(resources.iter().cloned()).collect();
    group_at(gpu, layout, &numbered)
}

/// Bind group 3 of a variant of a kernel that works on textures: these resources at their bindings, and its layout.
pub fn target(
    gpu: &Gpu,
    variant: Variant,
    resources: &[(u32, BindingResource)],
) -> (BindGroupLayout, BindGroup) {
    let sampled = |sample_type| BindingType::Texture {
        sample_type,
        view_dimension: TextureViewDimension::D2,
        multisampled: false,
    };
    let image = |access, format| BindingType::StorageTexture {
        access,
        format,
        view_dimension: TextureViewDimension::D2,
    };
    let written = |format| image(StorageTextureAccess::WriteOnly, format);
    let read = |format| image(StorageTextureAccess::ReadOnly, format);
    let type_of = |binding| match binding {
        2 => written(SCREEN_FORMAT),
        4 | 8 if variant == Variant::Image => read(COLOR_FORMAT),
        5 if variant == Variant::Image => read(GUIDE_FORMAT),
        4 | 7..=9 | 14 => sampled(TextureSampleType::Float { filterable: false }),
        5 => sampled(TextureSampleType::Uint),
        6 | 11..=13 | 15 => written(COLOR_FORMAT),
        10 => written(GUIDE_FORMAT),
        0 | 3 => buffer(true),
        _ => buffer(false),
    };
    let bindings = resources.iter().map(|(binding, _)| *binding);
    let layout = layout(gpu, "target", bindings.map(|it| (it, type_of(it))));
    let group = group_at(gpu, &layout, resources);
    (layout, group)
}

/// A storage buffer.
fn buffer(read_only: bool) -> BindingType {
    BindingType::Buffer {
        ty: BufferBindingType::Storage { read_only },
        has_dynamic_offset: false,
        min_binding_size: None,
    }
}

fn layout(
    gpu: &Gpu,
    label: &str,
    types: impl Iterator<Item = (u32, BindingType)>,
) -> BindGroupLayout {
    let entries: Vec<_> = types
        .map(|(binding, ty)| BindGroupLayoutEntry {
            binding,
            visibility: ShaderStages::COMPUTE,
            ty,
            count: None,
        })
        .collect();
    gpu.device
        .create_bind_group_layout(&BindGroupLayoutDescriptor {
            label: Some(label),
            entries: &entries,
        })
}

fn group_at(
    gpu: &Gpu,
    layout: &BindGroupLayout,
    resources: &[(u32, BindingResource)],
) -> BindGroup {
    let entries: Vec<_> = (resources.iter())
        .map(|(binding, resource)| BindGroupEntry {
            binding: *binding,
            resource: resource.clone(),
        })
        .collect();
    gpu.device.create_bind_group(&BindGroupDescriptor {
        label: None,
        layout,
        entries: &entries,
    })
}
