//! What is in the bind groups of `bindings.wesl`, on the host.

use super::layouts::{Layouts, ROW_FORMAT, TEXEL_FORMAT, group};
use crate::{
    gpu::{Gpu, GpuError, Ledger, Needs},
    layout::{IMAGE_WIDTH_LOG2, PackedFrame, PackedLight, PackedNode, PackedSlice, PackedTone},
    pack::{PackedScene, PackedView},
    render::policy::Fetch,
};
use bytemuck::{bytes_of, cast_slice};
use std::borrow::Cow;
use wgpu::{Buffer, BufferUsages};

const ROW_BYTES: u64 = 16;
const IMAGE_WIDTH: u32 = 1 << IMAGE_WIDTH_LOG2;

/// What shaders write and the host reads.
const READABLE: BufferUsages = BufferUsages::STORAGE
    .union(BufferUsages::COPY_SRC)
    .union(BufferUsages::COPY_DST);

/// Everything on the GPU but the pipelines.
pub struct Buffers {
    pub scene_group: wgpu::BindGroup,
    pub frame_group: wgpu::BindGroup,
    pub film_group: wgpu::BindGroup,
    pub slice: Buffer,
    pub film: Buffer,
    pub staging: Buffer,
    scene: SceneBuffers,
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
        let buffers = SceneBuffers::new(gpu, fetch, scene, view)?;
        let scene_group = buffers.group(gpu, layouts);
        let slice = gpu.allocate("slice", size_of::<PackedSlice>() as u64, READABLE)?;
        let (film, staging) = film(gpu, film_rows)?;
        let frame_group = frame_group(gpu, layouts, view, &slice)?;
        let film_group = group(gpu, &layouts.film, &[film.as_entire_binding()]);
        Ok(Self {
            scene_group,
            frame_group,
            film_group,
            slice,
            film,
            staging,
            scene: buffers,
        })
    }

    /// Makes room for `film_rows`, unless there is. Returns whether the film is another now.
    pub fn make_room(
        &mut self,
        gpu: &Gpu,
        layouts: &Layouts,
        film_rows: usize,
    ) -> Result<bool, GpuError> {
        if film_rows as u64 * ROW_BYTES <= self.film.size() {
            return Ok(false);
        }
        self.film.destroy();
        self.staging.destroy();
        (self.film, self.staging) = film(gpu, film_rows)?;
        self.film_group = group(gpu, &layouts.film, &[self.film.as_entire_binding()]);
        Ok(true)
    }

    /// Puts another scene in place of the one that was, whose buffers are destroyed first.
    pub fn set_scene(
        &mut self,
        gpu: &Gpu,
        layouts: &Layouts,
        fetch: Fetch,
        scene: &PackedScene,
        view: &PackedView,
    ) -> Result<(), GpuError> {
        self.scene.destroy();
        self.scene = SceneBuffers::new(gpu, fetch, scene, view)?;
        self.scene_group = self.scene.group(gpu, layouts);
        self.frame_group = frame_group(gpu, layouts, view, &self.slice)?;
        Ok(())
    }

    /// Puts another frame in place: of the scene only what it places, and materials that change.
    pub fn set_view(
        &mut self,
        gpu: &Gpu,
        layouts: &Layouts,
        scene: &PackedScene,
        view: &PackedView,
    ) -> Result<(), GpuError> {
        if !self.scene.has_room_for(view) {
            self.scene.make_room(gpu, scene, view)?;
            self.scene_group = self.scene.group(gpu, layouts);
        }
        self.scene.write_view(gpu, scene, view)?;
        self.frame_group = frame_group(gpu, layouts, view, &self.slice)?;
        Ok(())
    }
}

/// What kernels read of a scene, and of what a view places in it.
struct SceneBuffers {
    fetch: Fetch,
    nodes: Rows,
    /// Bytes that fit behind the scene's nodes.
    view_room: u64,
    triangles: Rows,
    vertices: Rows,
    materials: Rows,
    shapes: Buffer,
    texels: wgpu::TextureView,
}

impl SceneBuffers {
    fn new(
        gpu: &Gpu,
        fetch: Fetch,
        scene: &PackedScene,
        view: &PackedView,
    ) -> Result<Self, GpuError> {
        let rows = |what, first: &[u8], second: &[u8]| {
            let rows = Rows::allocate(gpu, fetch, what, (first.len() + second.len()) as u64)?;
            rows.write(gpu, 0, &both(first, second))?;
            Ok::<_, GpuError>(rows)
        };
        let (nodes, view_room) = nodes(gpu, fetch, scene, view)?;
        let vertices = cast_slice(&scene.vertices);
        let materials = cast_slice(&scene.materials);
        let texels = cast_slice(&scene.texels);
        let buffers = Self {
            fetch,
            nodes,
            view_room,
            triangles: rows("triangles", cast_slice(&scene.triangles), &[])?,
            vertices: rows("vertices", vertices, cast_slice(&scene.uvs))?,
            materials: rows("materials", materials, cast_slice(&scene.textures))?,
            shapes: gpu.upload("shapes", cast_slice(&scene.shapes))?,
            texels: gpu.upload_image("texels", texels, IMAGE_WIDTH, TEXEL_FORMAT)?,
        };
        buffers.write_view(gpu, scene, view)?;
        Ok(buffers)
    }

    fn destroy(&self) {
        for rows in [
            &self.nodes,
            &self.triangles,
            &self.vertices,
            &self.materials,
        ] {
            rows.destroy();
        }
        self.shapes.destroy();
        self.texels.texture().destroy();
    }

    fn group(&self, gpu: &Gpu, layouts: &Layouts) -> wgpu::BindGroup {
        let rows = [
            &self.nodes,
            &self.triangles,
            &self.vertices,
            &self.materials,
        ];
        let mut resources: Vec<_> = rows.into_iter().map(Rows::resource).collect();
        resources.push(self.shapes.as_entire_binding());
        resources.push(wgpu::BindingResource::TextureView(&self.texels));
        group(gpu, &layouts.scene, &resources)
    }

    /// Puts the nodes where there is room for the view. Those that were are destroyed first, as the
    /// ledger counts them once.
    fn make_room(
        &mut self,
        gpu: &Gpu,
        scene: &PackedScene,
        view: &PackedView,
    ) -> Result<(), GpuError> {
        self.nodes.destroy();
        (self.nodes, self.view_room) = nodes(gpu, self.fetch, scene, view)?;
        Ok(())
    }

    fn has_room_for(&self, view: &PackedView) -> bool {
        view_bytes(view) <= self.view_room
    }

    fn write_view(
        &self,
        gpu: &Gpu,
        scene: &PackedScene,
        view: &PackedView,
    ) -> Result<(), GpuError> {
        if view_bytes(view) > 0 {
            let offset = u64::from(scene.first_view_node()) * size_of::<PackedNode>() as u64;
            self.nodes.write(gpu, offset, &view.node_parts().concat())?;
        }
        if !view.materials.is_empty() {
            let (materials, textures) = (cast_slice(&view.materials), cast_slice(&scene.textures));
            self.materials.write(gpu, 0, &both(materials, textures))?;
        }
        Ok(())
    }
}

/// The scene's nodes, with room behind them for views that place a little more than this one, and how
/// many bytes that is.
fn nodes(
    gpu: &Gpu,
    fetch: Fetch,
    scene: &PackedScene,
    view: &PackedView,
) -> Result<(Rows, u64), GpuError> {
    let view_room = room_for(view);
    let nodes = Rows::allocate(gpu, fetch, "nodes", node_bytes(scene, view_room))?;
    nodes.write(gpu, 0, cast_slice(&scene.nodes))?;
    Ok((nodes, view_room))
}

/// A film with this many rows, and what it is read back through, with the accounts of a slice.
fn film(gpu: &Gpu, rows: usize) -> Result<(Buffer, Buffer), GpuError> {
    let bytes = rows as u64 * ROW_BYTES;
    let film = gpu.allocate("film", bytes, READABLE)?;
    let staging = gpu.allocate(
        "staging",
        bytes + size_of::<PackedSlice>() as u64,
        BufferUsages::MAP_READ | BufferUsages::COPY_DST,
    )?;
    Ok((film, staging))
}

/// The view's frame and lights, with the accounts of a slice.
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

/// Two slices one after the other.
fn both<'a>(first: &'a [u8], second: &[u8]) -> Cow<'a, [u8]> {
    match second.is_empty() {
        true => Cow::Borrowed(first),
        false => Cow::Owned([first, second].concat()),
    }
}

/// What a view adds to the scene's nodes.
fn view_bytes(view: &PackedView) -> u64 {
    view.node_parts().iter().map(|part| part.len() as u64).sum()
}

/// The room that is made for a view, in bytes: views differ in how much they place.
fn room_for(view: &PackedView) -> u64 {
    view_bytes(view) * 5 / 4
}

/// The scene's nodes, and behind them room for a view.
fn node_bytes(scene: &PackedScene, view_room: u64) -> u64 {
    match view_room {
        0 => size_of_val(&scene.nodes[..]) as u64,
        _ => u64::from(scene.first_view_node()) * size_of::<PackedNode>() as u64 + view_room,
    }
}

/// How many bytes of each there are.
fn row_bytes(scene: &PackedScene, view: &PackedView) -> [(&'static str, u64); 4] {
    [
        ("nodes", node_bytes(scene, room_for(view))),
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
    fn allocate(gpu: &Gpu, fetch: Fetch, what: &'static str, bytes: u64) -> Result<Self, GpuError> {
        let usage = BufferUsages::STORAGE | BufferUsages::COPY_DST;
        Ok(match fetch {
            Fetch::Image => {
                Self::Image(gpu.allocate_image(what, bytes, IMAGE_WIDTH, ROW_FORMAT)?)
            }
            // WebGPU wants a binding to hold at least one element.
            _ => Self::Buffer(gpu.allocate(what, bytes.max(ROW_BYTES), usage)?),
        })
    }

    /// Writes from `offset` on, which is the beginning of a row of an image.
    fn write(&self, gpu: &Gpu, offset: u64, bytes: &[u8]) -> Result<(), GpuError> {
        match self {
            Self::Image(view) => {
                let row = offset / (ROW_BYTES * u64::from(IMAGE_WIDTH));
                gpu.write_image(view, row as u32, bytes)
            }
            Self::Buffer(buffer) => gpu.write(buffer, offset, bytes),
        }
    }

    fn destroy(&self) {
        match self {
            Self::Image(view) => view.texture().destroy(),
            Self::Buffer(buffer) => buffer.destroy(),
        }
    }

    fn resource(&self) -> wgpu::BindingResource<'_> {
        match self {
            Self::Image(view) => wgpu::BindingResource::TextureView(view),
            Self::Buffer(buffer) => buffer.as_entire_binding(),
        }
    }
}

/// The fetch to use: as asked, or images on software adapters, where they are twice as fast.
/// Elsewhere buffers, unless only images are large enough.
pub fn choose_fetch(wanted: Fetch, gpu: &Gpu, scene: &PackedScene, view: &PackedView) -> Fetch {
    let fits = largest_row_bytes(scene, view) <= gpu.adapter().max_binding_bytes;
    match wanted {
        Fetch::Auto if gpu.is_cpu() || !fits => Fetch::Image,
        Fetch::Auto => Fetch::Buffer,
        chosen => chosen,
    }
}

/// What the device must be able to do for this scene and this film.
pub fn needs(scene: &PackedScene, view: &PackedView, fetch: Fetch, film_rows: usize) -> Needs {
    let shapes = size_of_val(&scene.shapes[..]) as u64;
    let film = film_rows as u64 * ROW_BYTES;
    let rows = largest_row_bytes(scene, view);
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

fn largest_row_bytes(scene: &PackedScene, view: &PackedView) -> u64 {
    let sizes = row_bytes(scene, view).map(|(_, bytes)| bytes);
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
    for (what, bytes) in row_bytes(scene, view) {
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
