//! The bind groups of `bindings.wesl` on the host: layouts and the buffers in them.

use crate::{
    gpu::{Gpu, GpuError, Ledger, Needs},
    layout::{IMAGE_WIDTH_LOG2, PackedFrame, PackedLight, PackedSlice, PackedTone},
    pack::{PackedScene, PackedView},
    render::settings::Fetch,
};
use bytemuck::{bytes_of, cast_slice};
use std::borrow::Cow;
use wgpu::{BindGroupLayout, BindingType, Buffer, BufferBindingType, BufferUsages};

const ROW_BYTES: u64 = 16;
const IMAGE_WIDTH: u32 = 1 << IMAGE_WIDTH_LOG2;
const ROW_FORMAT: wgpu::TextureFormat = wgpu::TextureFormat::Rgba32Uint;
const TEXEL_FORMAT: wgpu::TextureFormat = wgpu::TextureFormat::Rgba16Float;

/// Layouts of groups 0 to 3.
pub struct Layouts {
    pub scene: BindGroupLayout,
    pub frame: BindGroupLayout,
    pub film: BindGroupLayout,
    pub develop: BindGroupLayout,
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
        let image = BindingType::StorageTexture {
            access: wgpu::StorageTextureAccess::ReadOnly,
            format: ROW_FORMAT,
            view_dimension: wgpu::TextureViewDimension::D2,
        };
        let texels = BindingType::Texture {
            sample_type: wgpu::TextureSampleType::Float { filterable: false },
            view_dimension: wgpu::TextureViewDimension::D2,
            multisampled: false,
        };
        let geometry = if fetch == Fetch::Image { image } else { read };
        let layout = |label, types: &[BindingType]| {
            let entries: Vec<_> = (0..)
                .zip(types)
                .map(|(binding, &ty)| wgpu::BindGroupLayoutEntry {
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
        Self {
            scene: layout(
                "scene",
                &[geometry, geometry, geometry, geometry, read, texels],
            ),
            frame: layout("frame", &[read, write]),
            film: layout("film", &[write]),
            develop: layout("develop", &[read, write]),
        }
    }
}

/// Everything on the GPU but the pipelines.
pub struct Buffers {
    pub scene_group: wgpu::BindGroup,
    pub frame_group: wgpu::BindGroup,
    pub film_group: wgpu::BindGroup,
    pub slice: Buffer,
    pub film: Buffer,
    pub staging: Buffer,
}

impl Buffers {
    /// Uploads the scene and the frame, and makes room for `film_rows`.
    pub fn new(
        gpu: &Gpu,
        layouts: &Layouts,
        fetch: Fetch,
        scene: &PackedScene,
        view: &PackedView,
        film_rows: usize,
    ) -> Result<Self, GpuError> {
        let shapes = gpu.upload("shapes", cast_slice(&scene.shapes))?;
        let rows = scene_rows(scene)
            .into_iter()
            .map(|(what, bytes)| Rows::upload(gpu, fetch, what, &bytes))
            .collect::<Result<Vec<_>, _>>()?;
        let texels = cast_slice(&scene.texels);
        let texels = gpu.upload_image("texels", texels, IMAGE_WIDTH, TEXEL_FORMAT)?;
        let mut resources: Vec<_> = rows.iter().map(Rows::resource).collect();
        resources.push(shapes.as_entire_binding());
        resources.push(wgpu::BindingResource::TextureView(&texels));
        let scene_group = group(gpu, &layouts.scene, &resources);

        let storage = BufferUsages::STORAGE | BufferUsages::COPY_SRC | BufferUsages::COPY_DST;
        let slice = gpu.allocate("slice", size_of::<PackedSlice>() as u64, storage)?;
        let film_bytes = film_rows as u64 * ROW_BYTES;
        let film = gpu.allocate("film", film_bytes, storage)?;
        let staging = gpu.allocate(
            "staging",
            film_bytes + size_of::<PackedSlice>() as u64,
            BufferUsages::MAP_READ | BufferUsages::COPY_DST,
        )?;
        let frame_group = frame_group(gpu, layouts, view, &slice)?;
        let film_group = group(gpu, &layouts.film, &[film.as_entire_binding()]);
        Ok(Self {
            scene_group,
            frame_group,
            film_group,
            slice,
            film,
            staging,
        })
    }

    /// Puts another frame in place.
    pub fn set_view(
        &mut self,
        gpu: &Gpu,
        layouts: &Layouts,
        view: &PackedView,
    ) -> Result<(), GpuError> {
        self.frame_group = frame_group(gpu, layouts, view, &self.slice)?;
        Ok(())
    }
}

fn frame_group(
    gpu: &Gpu,
    layouts: &Layouts,
    view: &PackedView,
    slice: &Buffer,
) -> Result<wgpu::BindGroup, GpuError> {
    let mut bytes = bytes_of(&view.frame).to_vec();
    bytes.extend_from_slice(cast_slice(&view.lights));
    let frame = gpu.upload("frame", &bytes)?;
    let resources = [frame.as_entire_binding(), slice.as_entire_binding()];
    Ok(group(gpu, &layouts.frame, &resources))
}

/// What the shaders fetch as rows of 16 bytes, in the order of their bindings.
fn scene_rows(scene: &PackedScene) -> [(&'static str, Cow<'_, [u8]>); 4] {
    let both = |first, second: &'_ [u8]| match second.is_empty() {
        true => Cow::Borrowed(first),
        false => Cow::Owned([first, second].concat()),
    };
    [
        ("nodes", Cow::Borrowed(cast_slice(&scene.nodes))),
        ("triangles", Cow::Borrowed(cast_slice(&scene.triangles))),
        (
            "vertices",
            both(cast_slice(&scene.vertices), cast_slice(&scene.uvs)),
        ),
        (
            "materials",
            both(cast_slice(&scene.materials), cast_slice(&scene.textures)),
        ),
    ]
}

/// How many bytes of each there are.
fn row_bytes(scene: &PackedScene) -> [(&'static str, u64); 4] {
    [
        ("nodes", size_of_val(&scene.nodes[..]) as u64),
        ("triangles", size_of_val(&scene.triangles[..]) as u64),
        (
            "vertices",
            (size_of_val(&scene.vertices[..]) + size_of_val(&scene.uvs[..])) as u64,
        ),
        (
            "materials",
            (size_of_val(&scene.materials[..]) + size_of_val(&scene.textures[..])) as u64,
        ),
    ]
}

/// One of them on the GPU.
enum Rows {
    Image(wgpu::TextureView),
    Buffer(Buffer),
}

impl Rows {
    fn upload(gpu: &Gpu, fetch: Fetch, what: &'static str, bytes: &[u8]) -> Result<Self, GpuError> {
        Ok(match fetch {
            Fetch::Image => Self::Image(gpu.upload_image(what, bytes, IMAGE_WIDTH, ROW_FORMAT)?),
            _ => Self::Buffer(gpu.upload(what, bytes)?),
        })
    }

    fn resource(&self) -> wgpu::BindingResource<'_> {
        match self {
            Self::Image(view) => wgpu::BindingResource::TextureView(view),
            Self::Buffer(buffer) => buffer.as_entire_binding(),
        }
    }
}

/// A bind group of these resources at bindings 0, 1, ….
pub fn group(
    gpu: &Gpu,
    layout: &BindGroupLayout,
    resources: &[wgpu::BindingResource],
) -> wgpu::BindGroup {
    let entries: Vec<_> = (0..)
        .zip(resources)
        .map(|(binding, resource)| wgpu::BindGroupEntry {
            binding,
            resource: resource.clone(),
        })
        .collect();
    gpu.device.create_bind_group(&wgpu::BindGroupDescriptor {
        label: None,
        layout,
        entries: &entries,
    })
}

/// The fetch to use: as asked, or images on software adapters, where they are twice as fast.
/// Elsewhere buffers, unless only images are large enough.
pub fn choose_fetch(wanted: Fetch, gpu: &Gpu, scene: &PackedScene) -> Fetch {
    let fits = largest_row_bytes(scene) <= gpu.adapter().max_binding_bytes;
    match wanted {
        Fetch::Auto if gpu.is_cpu() || !fits => Fetch::Image,
        Fetch::Auto => Fetch::Buffer,
        chosen => chosen,
    }
}

/// What the device must be able to do for this scene and this film.
pub fn needs(scene: &PackedScene, fetch: Fetch, film_rows: usize) -> Needs {
    let shapes = size_of_val(&scene.shapes[..]) as u64;
    let film = film_rows as u64 * ROW_BYTES;
    let rows = largest_row_bytes(scene);
    if fetch != Fetch::Image {
        return Needs {
            binding_bytes: shapes.max(film).max(rows),
            texture_side: 0,
        };
    }
    // Texels keep to what WebGPU guarantees.
    let height = rows.div_ceil(u64::from(IMAGE_WIDTH) * 16);
    Needs {
        binding_bytes: shapes.max(film),
        texture_side: IMAGE_WIDTH.max(height.try_into().unwrap_or(u32::MAX)),
    }
}

fn largest_row_bytes(scene: &PackedScene) -> u64 {
    let sizes = row_bytes(scene).map(|(_, bytes)| bytes);
    sizes.into_iter().max().unwrap_or(0)
}

/// All that a render will allocate, on the GPU and for the picture on the host.
pub fn ledger(
    scene: &PackedScene,
    view: &PackedView,
    film_rows: usize,
    picture_pixels: u64,
) -> Ledger {
    let mut ledger = Ledger::default();
    for (what, bytes) in row_bytes(scene) {
        ledger.plan(what, bytes);
    }
    ledger.plan("texels", size_of_val(&scene.texels[..]) as u64);
    ledger.plan("shapes", size_of_val(&scene.shapes[..]) as u64);
    let lights = view.lights.len() * size_of::<PackedLight>();
    let frame = size_of::<PackedFrame>() + size_of::<PackedTone>() + lights;
    ledger.plan("frame", frame as u64);
    ledger.plan("film and its copies", 4 * film_rows as u64 * ROW_BYTES);
    ledger.plan("picture", picture_pixels * 2 * ROW_BYTES);
    ledger
}
