//! The JSON part of glTF 2.0 (sections 3 and 5 of its specification) and of the extensions that are read,
//! as types. Everything else in a file, such as `extras`, is ignored. Nothing here is checked beyond the
//! types: indices may be out of range, and numbers may have any finite value.
//!
//! An index that the file lacks leads nowhere: it is `ABSENT`.
//!
//! The types are our own, because the crate `gltf` knows few of these extensions and panics on indices out
//! of range unless it validates, which refuses extensions that are read here.

use serde::Deserialize;
use std::collections::BTreeMap;

pub use super::document_animation::*;
use super::document_materials::absent;
pub use super::document_materials::{ABSENT, Material, TextureInfo};

#[derive(Debug, Default, Deserialize)]
#[serde(default, rename_all = "camelCase")]
pub struct Document {
    pub asset: Option<Asset>,
    pub extensions_used: Vec<String>,
    pub extensions_required: Vec<String>,
    pub accessors: Vec<Accessor>,
    pub animations: Vec<Animation>,
    pub buffers: Vec<Buffer>,
    pub buffer_views: Vec<BufferView>,
    pub cameras: Vec<Camera>,
    pub images: Vec<Image>,
    pub materials: Vec<Material>,
    pub meshes: Vec<Mesh>,
    pub nodes: Vec<Node>,
    pub samplers: Vec<Sampler>,
    pub scene: Option<usize>,
    pub scenes: Vec<Scene>,
    pub skins: Vec<Skin>,
    pub textures: Vec<Texture>,
    pub extensions: RootExtensions,
}

#[derive(Debug, Default, Deserialize)]
#[serde(default, rename_all = "camelCase")]
pub struct Asset {
    pub version: String,
    pub min_version: Option<String>,
}

#[derive(Debug, Deserialize)]
#[serde(rename_all = "camelCase")]
pub struct Accessor {
    pub buffer_view: Option<usize>,
    #[serde(default)]
    pub byte_offset: u64,
    #[serde(default)]
    pub component_type: u32,
    #[serde(default)]
    pub normalized: bool,
    #[serde(default)]
    pub count: u64,
    #[serde(default, rename = "type")]
    pub kind: Kind,
    pub sparse: Option<Box<Sparse>>,
}

#[cfg(feature = "draco")]
impl Accessor {
    /// An accessor of this shape without elements.
    pub fn of(kind: Kind) -> Self {
        Self {
            buffer_view: None,
            byte_offset: 0,
            component_type: 0,
            normalized: false,
            count: 0,
            kind,
            sparse: None,
        }
    }
}

/// The shape of an accessor's elements.
#[derive(Clone, Copy, Debug, Default, Deserialize, PartialEq, Eq, Hash)]
#[serde(rename_all = "UPPERCASE")]
pub enum Kind {
    #[default]
    Scalar,
    Vec2,
    Vec3,
    Vec4,
    Mat2,
    Mat3,
    Mat4,
}

#[derive(Debug, Default, Deserialize)]
#[serde(default)]
pub struct Sparse {
    pub count: u64,
    pub indices: SparseIndices,
    pub values: SparseValues,
}

#[derive(Debug, Default, Deserialize)]
#[serde(rename_all = "camelCase")]
pub struct SparseIndices {
    #[serde(default = "absent")]
    pub buffer_view: usize,
    #[serde(default)]
    pub byte_offset: u64,
    #[serde(default)]
    pub component_type: u32,
}

#[derive(Debug, Default, Deserialize)]
#[serde(rename_all = "camelCase")]
pub struct SparseValues {
    #[serde(default = "absent")]
    pub buffer_view: usize,
    #[serde(default)]
    pub byte_offset: u64,
}

#[derive(Debug, Deserialize)]
#[serde(rename_all = "camelCase")]
pub struct Buffer {
    pub uri: Option<String>,
    #[serde(default)]
    pub byte_length: u64,
}

#[derive(Debug, Deserialize)]
#[serde(rename_all = "camelCase")]
pub struct BufferView {
    #[serde(default = "absent")]
    pub buffer: usize,
    #[serde(default)]
    pub byte_offset: u64,
    #[serde(default)]
    pub byte_length: u64,
    pub byte_stride: Option<u64>,
    pub extensions: Option<Box<ViewExtensions>>,
}

#[derive(Debug, Default, Deserialize)]
#[serde(default)]
pub struct ViewExtensions {
    #[serde(rename = "EXT_meshopt_compression")]
    pub ext: Option<CompressedView>,
    #[serde(rename = "KHR_meshopt_compression")]
    pub khr: Option<CompressedView>,
}

#[derive(Debug, Deserialize)]
#[serde(rename_all = "camelCase")]
pub struct CompressedView {
    #[serde(default = "absent")]
    pub buffer: usize,
    #[serde(default)]
    pub byte_offset: u64,
    #[serde(default)]
    pub byte_length: u64,
    #[serde(default)]
    pub byte_stride: u64,
    #[serde(default)]
    pub count: u64,
    #[serde(default)]
    pub mode: String,
    pub filter: Option<String>,
}

#[derive(Debug, Deserialize)]
pub struct Scene {
    #[serde(default)]
    pub name: Option<String>,
    #[serde(default)]
    pub nodes: Vec<usize>,
}

#[derive(Debug, Default, Deserialize)]
#[serde(default)]
pub struct Node {
    pub name: Option<String>,
    pub children: Vec<usize>,
    pub matrix: Option<Box<[f64; 16]>>,
    pub translation: Option<[f64; 3]>,
    pub rotation: Option<[f64; 4]>,
    pub scale: Option<[f64; 3]>,
    pub mesh: Option<usize>,
    pub camera: Option<usize>,
    pub skin: Option<usize>,
    pub weights: Option<Vec<f64>>,
    pub extensions: Option<Box<NodeExtensions>>,
}

#[derive(Debug, Default, Deserialize)]
#[serde(default)]
pub struct NodeExtensions {
    #[serde(rename = "KHR_lights_punctual")]
    pub light: Option<NodeLight>,
    #[serde(rename = "EXT_mesh_gpu_instancing")]
    pub instancing: Option<Instancing>,
    #[serde(rename = "KHR_node_visibility")]
    pub visibility: Option<Visibility>,
}

#[derive(Debug, Deserialize)]
pub struct Visibility {
    #[serde(default = "yes")]
    pub visible: bool,
}

fn yes() -> bool {
    true
}

#[derive(Debug, Deserialize)]
pub struct NodeLight {
    #[serde(default = "absent")]
    pub light: usize,
}

#[derive(Debug, Deserialize)]
pub struct Instancing {
    #[serde(default)]
    pub attributes: BTreeMap<String, usize>,
}

#[derive(Debug, Deserialize)]
pub struct Mesh {
    #[serde(default)]
    pub name: Option<String>,
    #[serde(default)]
    pub primitives: Vec<Primitive>,
    #[serde(default)]
    pub weights: Option<Vec<f64>>,
}

#[derive(Debug, Deserialize)]
pub struct Primitive {
    #[serde(default)]
    pub attributes: BTreeMap<String, usize>,
    #[serde(default)]
    pub indices: Option<usize>,
    #[serde(default)]
    pub material: Option<usize>,
    #[serde(default = "triangles")]
    pub mode: u32,
    #[serde(default)]
    pub targets: Vec<BTreeMap<String, usize>>,
    #[serde(default)]
    pub extensions: Option<Box<PrimitiveExtensions>>,
}

fn triangles() -> u32 {
    4
}

#[derive(Debug, Default, Deserialize)]
#[serde(default)]
pub struct PrimitiveExtensions {
    #[serde(rename = "KHR_materials_variants")]
    pub variants: Option<VariantMappings>,
    #[cfg(feature = "draco")]
    #[serde(rename = "KHR_draco_mesh_compression")]
    pub draco: Option<CompressedPrimitive>,
}

#[cfg(feature = "draco")]
#[derive(Debug, Deserialize)]
#[serde(rename_all = "camelCase")]
pub struct CompressedPrimitive {
    #[serde(default = "absent")]
    pub buffer_view: usize,
    #[serde(default)]
    pub attributes: BTreeMap<String, u32>,
}

#[derive(Debug, Default, Deserialize)]
#[serde(default)]
pub struct VariantMappings {
    pub mappings: Vec<VariantMapping>,
}

#[derive(Debug, Deserialize)]
pub struct VariantMapping {
    #[serde(default = "absent")]
    pub material: usize,
    #[serde(default)]
    pub variants: Vec<usize>,
}

#[derive(Debug, Deserialize)]
pub struct Skin {
    #[serde(default, rename = "inverseBindMatrices")]
    pub inverse_bind_matrices: Option<usize>,
    #[serde(default)]
    pub joints: Vec<usize>,
}

#[derive(Debug, Deserialize)]
pub struct Camera {
    #[serde(default)]
    pub name: Option<String>,
    #[serde(default)]
    pub perspective: Option<Perspective>,
    #[serde(default)]
    pub orthographic: Option<Orthographic>,
}

#[derive(Debug, Deserialize)]
#[serde(rename_all = "camelCase")]
pub struct Perspective {
    #[serde(default)]
    pub yfov: f64,
    pub aspect_ratio: Option<f64>,
    #[serde(default)]
    pub znear: f64,
    #[serde(default)]
    pub zfar: Option<f64>,
}

#[derive(Debug, Deserialize)]
pub struct Orthographic {
    #[serde(default)]
    pub ymag: f64,
    #[serde(default)]
    pub xmag: f64,
    #[serde(default)]
    pub znear: f64,
    #[serde(default)]
    pub zfar: Option<f64>,
}

#[derive(Debug, Deserialize)]
#[serde(rename_all = "camelCase")]
pub struct Image {
    #[serde(default)]
    pub name: Option<String>,
    #[serde(default)]
    pub uri: Option<String>,
    #[serde(default)]
    pub buffer_view: Option<usize>,
}

#[derive(Debug, Default, Deserialize)]
#[serde(default, rename_all = "camelCase")]
pub struct Sampler {
    pub mag_filter: Option<u32>,
    pub min_filter: Option<u32>,
    pub wrap_s: Option<u32>,
    pub wrap_t: Option<u32>,
}

#[derive(Debug, Default, Deserialize)]
#[serde(default)]
pub struct Texture {
    pub sampler: Option<usize>,
    pub source: Option<usize>,
    pub extensions: TextureExtensions,
}

impl Texture {
    /// The number of its image: of the one that needs no extension if there is a choice.
    pub fn image(&self) -> Option<usize> {
        let webp = || self.extensions.webp.as_ref()?.source;
        let basisu = || self.extensions.basisu.as_ref()?.source;
        (self.source.or_else(webp)).or_else(|| basisu().filter(|_| cfg!(feature = "basis")))
    }
}

#[derive(Debug, Default, Deserialize)]
#[serde(default)]
pub struct TextureExtensions {
    #[serde(rename = "EXT_texture_webp")]
    pub webp: Option<TextureSource>,
    #[serde(rename = "KHR_texture_basisu")]
    pub basisu: Option<TextureSource>,
}

#[derive(Debug, Default, Deserialize)]
#[serde(default)]
pub struct TextureSource {
    pub source: Option<usize>,
}

#[derive(Debug, Default, Deserialize)]
#[serde(default)]
pub struct RootExtensions {
    #[serde(rename = "KHR_lights_punctual")]
    pub lights: Option<Lights>,
    #[serde(rename = "KHR_materials_variants")]
    pub variants: Option<Variants>,
}

#[derive(Debug, Default, Deserialize)]
#[serde(default)]
pub struct Lights {
    pub lights: Vec<Light>,
}

#[derive(Debug, Deserialize)]
pub struct Light {
    #[serde(default, rename = "type")]
    pub kind: String,
    #[serde(default)]
    pub name: Option<String>,
    #[serde(default)]
    pub color: Option<[f64; 3]>,
    #[serde(default)]
    pub intensity: Option<f64>,
    #[serde(default)]
    pub spot: Option<Spot>,
}

#[derive(Debug, Default, Deserialize)]
#[serde(default, rename_all = "camelCase")]
pub struct Spot {
    pub inner_cone_angle: f64,
    pub outer_cone_angle: Option<f64>,
}

#[derive(Debug, Default, Deserialize)]
#[serde(default)]
pub struct Variants {
    pub variants: Vec<Variant>,
}

#[derive(Debug, Default, Deserialize)]
#[serde(default)]
pub struct Variant {
    pub name: String,
}
