//! The arrays of bind group 0 of `bindings.wesl`: their contents, and which parts must be uploaded.

use super::{
    layouts::{ROW_FORMAT, TEXEL_FORMAT},
    policy::Fetch,
    stats::Uploads,
};
use crate::{
    gpu::{Gpu, GpuError},
    layout::{
        FLOAT_NODE_ROWS, FloatNode, IMAGE_WIDTH_LOG2, LAYER_ROWS_LOG2, NODE_ROWS, PackedNode,
        PackedTriangle,
    },
    pack::{PackedScene, PackedView, Segments, with_float_planes},
};
use bytemuck::{Pod, cast_slice, pod_collect_to_vec};
use std::borrow::Cow;
use wgpu::{Buffer, BufferUsages, TextureFormat, TextureUsages};

pub const ROW_BYTES: u64 = 16;
pub const IMAGE_WIDTH: u32 = 1 << IMAGE_WIDTH_LOG2;
pub const ARRAY_COUNT: usize = 5;

/// Maximum number of bytes that are merged into one write.
const MAX_GATHERED: usize = 16 << 20;

/// The contents of one buffer or image.
pub struct Array<'a> {
    pub what: &'static str,
    kind: Kind,
    /// In ascending order; gaps occur only before the data of a view.
    pub pieces: Vec<Piece<'a>>,
    /// Size in bytes, with some spare room for views with more instances.
    pub bytes: u64,
}

/// Bytes at an offset.
#[derive(Clone, Copy)]
pub struct Piece<'a> {
    offset: u64,
    bytes: &'a [u8],
    /// Whether the bytes are nodes whose planes the device has as floats.
    is_float_nodes: bool,
    counts_as: Upload,
}

#[derive(Clone, Copy, PartialEq)]
enum Kind {
    /// Rows of 16 bytes, in an image or a buffer.
    Rows,
    /// Words of 4 bytes, always in an image of layers.
    Texels,
}

/// A member of [`Uploads`].
type Upload = fn(&mut Uploads) -> &mut u64;

/// The rows of 16 bytes of a node for this fetch, image or buffer.
pub fn node_rows(fetch: Fetch) -> u32 {
    match fetch {
        Fetch::Image => NODE_ROWS,
        _ => FLOAT_NODE_ROWS,
    }
}

/// All arrays for this fetch, image or buffer, in binding order.
pub fn arrays<'a>(
    scene: &'a PackedScene,
    view: &'a PackedView,
    fetch: Fetch,
) -> [Array<'a>; ARRAY_COUNT] {
    let geometry: Upload = |uploads| &mut uploads.geometry;
    let surfaces: Upload = |uploads| &mut uploads.surfaces;
    let mut nodes = Array::new("nodes", Kind::Rows);
    let runs = scene.nodes.bytes();
    runs.for_each(|run| nodes.push_nodes(run, fetch, geometry));
    nodes.add_view(scene, view, fetch);
    let [later_triangles, later_vertices] = view.later_keys();
    let mut triangles = Array::new("triangles", Kind::Rows);
    for (first, run) in scene.triangles.runs() {
        triangles.push(view.triangles_from(first).unwrap_or(run), geometry);
    }
    let shapes = scene.shapes.bytes();
    shapes.for_each(|run| triangles.push(run, geometry));
    triangles.align(size_of::<PackedTriangle>() as u64, &later_triangles);
    (later_triangles.iter()).for_each(|run| triangles.push(run, geometry));
    let mut vertices = Array::new("vertices", Kind::Rows);
    for (first, run) in scene.vertices.runs() {
        vertices.push(view.vertices_from(first).unwrap_or(run), geometry);
    }
    (scene.uvs.bytes()).for_each(|run| vertices.push(run, geometry));
    for (first, run) in scene.tangents.runs() {
        vertices.push(view.tangents_from(first).unwrap_or(run), geometry);
    }
    (scene.colors.bytes()).for_each(|run| vertices.push(run, geometry));
    (later_vertices.iter()).for_each(|run| vertices.push(run, geometry));
    let mut materials = Array::new("materials", Kind::Rows);
    materials.push(
        match view.materials.is_empty() {
            true => cast_slice(&scene.materials),
            false => cast_slice(&view.materials),
        },
        surfaces,
    );
    materials.push(
        match view.textures.is_empty() {
            true => cast_slice(&scene.textures),
            false => cast_slice(&view.textures),
        },
        surfaces,
    );
    let texels = Array::of("texels", Kind::Texels, &scene.texels, surfaces);
    [nodes, triangles, vertices, materials, texels]
}

impl<'a> Array<'a> {
    fn new(what: &'static str, kind: Kind) -> Self {
        Self {
            what,
            kind,
            pieces: Vec::new(),
            bytes: 0,
        }
    }

    fn of<T: Pod>(
        what: &'static str,
        kind: Kind,
        segments: &'a Segments<T>,
        counts_as: Upload,
    ) -> Self {
        let mut array = Self::new(what, kind);
        segments.bytes().for_each(|run| array.push(run, counts_as));
        array
    }

    /// An array of rows outside of the scene.
    pub fn of_rows(what: &'static str, bytes: &'a [u8]) -> Self {
        let mut array = Self::new(what, Kind::Rows);
        array.push(bytes, |uploads| &mut uploads.geometry);
        array
    }

    fn push(&mut self, bytes: &'a [u8], counts_as: Upload) {
        self.push_as(false, bytes, counts_as);
    }

    fn push_nodes(&mut self, bytes: &'a [u8], fetch: Fetch, counts_as: Upload) {
        self.push_as(fetch != Fetch::Image, bytes, counts_as);
    }

    fn push_as(&mut self, is_float_nodes: bool, bytes: &'a [u8], counts_as: Upload) {
        let piece = Piece {
            offset: self.bytes,
            bytes,
            is_float_nodes,
            counts_as,
        };
        if !bytes.is_empty() {
            self.bytes += piece.len();
            self.pieces.push(piece);
        }
    }

    /// Leaves a gap before `pieces`, if there are any, so that they start at a multiple of `bytes`.
    fn align(&mut self, bytes: u64, pieces: &[&[u8]]) {
        if !pieces.is_empty() {
            self.bytes = self.bytes.next_multiple_of(bytes);
        }
    }

    /// Adds the data of a view to the nodes, with some spare room.
    fn add_view(&mut self, scene: &PackedScene, view: &'a PackedView, fetch: Fetch) {
        let [nodes, instances, keys, rest @ ..] = view.node_parts();
        let scene_bytes = self.bytes;
        let node_bytes = u64::from(node_rows(fetch)) * ROW_BYTES;
        let first = u64::from(scene.first_view_node()) * node_bytes;
        self.bytes = first;
        for part in view.deformed_nodes() {
            self.push_nodes(part, fetch, |uploads| &mut uploads.geometry);
        }
        self.push_nodes(nodes, fetch, |uploads| &mut uploads.tlas);
        for part in [instances, keys] {
            self.push(part, |uploads| &mut uploads.tlas);
        }
        for part in rest {
            self.push(part, |uploads| &mut uploads.frames);
        }
        self.bytes = match self.bytes - first {
            0 => scene_bytes,
            view_bytes => first + view_bytes * 5 / 4,
        };
    }

    /// Whether it may be stored in an image of rows.
    pub fn is_row_image(&self) -> bool {
        self.kind == Kind::Rows
    }

    /// Size in bytes without spare room.
    pub fn least_bytes(&self) -> u64 {
        let last = self.pieces.last();
        last.map_or(0, |last| last.offset + last.len())
    }

    /// Uploads the pieces that differ from the `known` contents of the array.
    pub fn write(
        &self,
        gpu: &Gpu,
        rows: &Rows,
        known: &[Piece],
        uploads: &mut Uploads,
    ) -> Result<(), GpuError> {
        let is_there = |piece: &Piece| {
            let index = known.binary_search_by_key(&piece.offset, |known| known.offset);
            index.is_ok_and(|index| {
                let known = known[index].bytes;
                std::ptr::eq(known, piece.bytes) || known == piece.bytes
            })
        };
        // Adjacent pieces are written together.
        let (mut start, mut gathered) = (0, Vec::new());
        for piece in self.pieces.iter().filter(|piece| !is_there(piece)) {
            *(piece.counts_as)(uploads) += piece.len();
            let is_next = start + gathered.len() as u64 == piece.offset;
            if !is_next || gathered.len() as u64 + piece.len() > MAX_GATHERED as u64 {
                rows.write(gpu, start, &gathered)?;
                gathered.clear();
            }
            if piece.len() > MAX_GATHERED as u64 {
                start = piece.offset;
                for bytes in piece.on_device() {
                    rows.write(gpu, start, &bytes)?;
                    start += bytes.len() as u64;
                }
                continue;
            }
            if gathered.is_empty() {
                start = piece.offset;
            }
            piece
                .on_device()
                .for_each(|bytes| gathered.extend_from_slice(&bytes));
        }
        rows.write(gpu, start, &gathered)
    }
}

impl<'a> Piece<'a> {
    /// The piece's length on the device, in bytes.
    fn len(&self) -> u64 {
        let bytes = self.bytes.len() as u64;
        match self.is_float_nodes {
            true => bytes * u64::from(FLOAT_NODE_ROWS) / u64::from(NODE_ROWS),
            false => bytes,
        }
    }

    /// The piece's bytes on the device, in one part or several.
    fn on_device(&self) -> impl Iterator<Item = Cow<'a, [u8]>> {
        const NODES: usize = 1 << 16;
        let is_float_nodes = self.is_float_nodes;
        let part = match is_float_nodes {
            true => NODES * size_of::<PackedNode>(),
            false => self.bytes.len(),
        };
        self.bytes
            .chunks(part)
            .map(move |bytes| match is_float_nodes {
                false => Cow::Borrowed(bytes),
                true => {
                    let nodes = cast_slice::<u8, PackedNode>(bytes).iter();
                    let nodes: Vec<FloatNode> = nodes.map(with_float_planes).collect();
                    Cow::Owned(pod_collect_to_vec(&nodes))
                }
            })
    }
}

/// One of the arrays on the GPU.
#[derive(Clone)]
pub enum Rows {
    Image(wgpu::TextureView),
    Buffer(Buffer),
}

impl Rows {
    pub fn allocate(gpu: &Gpu, fetch: Fetch, array: &Array, bytes: u64) -> Result<Self, GpuError> {
        let usage = BufferUsages::STORAGE | BufferUsages::COPY_DST;
        let binding = match fetch {
            Fetch::Image => TextureUsages::STORAGE_BINDING,
            _ => TextureUsages::TEXTURE_BINDING,
        };
        let image = |layer_rows, format| {
            let size = (IMAGE_WIDTH, layer_rows);
            let image = gpu.allocate_image(array.what, bytes, size, (format, binding))?;
            Ok(Self::Image(image))
        };
        match array.kind {
            Kind::Rows if fetch == Fetch::Image => image(None, ROW_FORMAT),
            Kind::Texels => image(Some(1 << LAYER_ROWS_LOG2), TEXEL_FORMAT),
            // WebGPU requires a binding to hold at least one element; 256 bytes hold any of our structs.
            Kind::Rows => {
                let buffer = gpu.allocate(array.what, bytes.max(256), usage)?;
                Ok(Self::Buffer(buffer))
            }
        }
    }

    /// Capacity in bytes.
    pub fn bytes(&self) -> u64 {
        match self {
            Self::Image(view) => {
                let texture = view.texture();
                let rows = u64::from(texture.height()) * u64::from(texture.depth_or_array_layers());
                rows * row_bytes(texture)
            }
            Self::Buffer(buffer) => buffer.size(),
        }
    }

    /// The size of a replacement for at least `bytes`, with a quarter of spare room if that takes at most
    /// `spare` bytes and the device allows it.
    pub fn grown(&self, gpu: &Gpu, bytes: u64, spare: u64) -> u64 {
        let limits = gpu.device.limits();
        let wanted = bytes + (bytes / 4).min(spare);
        let most = match self {
            Self::Image(view) => {
                let rows = match view.texture().format() {
                    TEXEL_FORMAT => limits.max_texture_array_layers << LAYER_ROWS_LOG2,
                    _ => limits.max_texture_dimension_2d,
                };
                u64::from(rows) * row_bytes(view.texture())
            }
            Self::Buffer(_) => (limits.max_storage_buffer_binding_size).min(limits.max_buffer_size),
        };
        wanted.min(most).max(bytes)
    }

    /// Writes at `offset`, which must be the start of a row or texel.
    fn write(&self, gpu: &Gpu, offset: u64, bytes: &[u8]) -> Result<(), GpuError> {
        match self {
            _ if bytes.is_empty() => Ok(()),
            Self::Image(view) => {
                let texel = texel_bytes(view.texture().format());
                gpu.write_image(view, offset / texel, bytes)
            }
            Self::Buffer(buffer) => gpu.write(buffer, offset, bytes),
        }
    }

    pub fn destroy(&self) {
        match self {
            Self::Image(view) => view.texture().destroy(),
            Self::Buffer(buffer) => buffer.destroy(),
        }
    }

    pub fn resource(&self) -> wgpu::BindingResource<'_> {
        match self {
            Self::Image(view) => wgpu::BindingResource::TextureView(view),
            Self::Buffer(buffer) => buffer.as_entire_binding(),
        }
    }
}

fn row_bytes(texture: &wgpu::Texture) -> u64 {
    u64::from(IMAGE_WIDTH) * texel_bytes(texture.format())
}

fn texel_bytes(format: TextureFormat) -> u64 {
    u64::from(format.block_copy_size(None).unwrap_or(16))
}
