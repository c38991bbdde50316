//! A writer of binary glTF.

use crate::surface::Surface;
use glam::Vec3;
use image::{ImageFormat, RgbaImage};
use serde_json::{Value, json};
use std::io::Cursor;

const FLOAT: u32 = 5126;

/// The parts of a model in the making that name places in its buffer.
#[derive(Default)]
pub struct Glb {
    bin: Vec<u8>,
    views: Vec<Value>,
    accessors: Vec<Value>,
    images: Vec<Value>,
    meshes: Vec<Value>,
}

/// Bytes of little-endian floats.
pub fn floats(values: &[f32]) -> Vec<u8> {
    values
        .iter()
        .flat_map(|value| value.to_le_bytes())
        .collect()
}

fn vectors(values: &[Vec3]) -> Vec<u8> {
    values
        .iter()
        .flat_map(|value| floats(&value.to_array()))
        .collect()
}

impl Glb {
    fn view(&mut self, bytes: &[u8]) -> usize {
        self.bin.resize(self.bin.len().next_multiple_of(4), 0);
        self.views.push(json!({
            "buffer": 0, "byteOffset": self.bin.len(), "byteLength": bytes.len(),
        }));
        self.bin.extend_from_slice(bytes);
        self.views.len() - 1
    }

    /// An accessor of floats with more members.
    pub fn accessor(&mut self, bytes: &[u8], kind: &str, count: usize, more: Value) -> usize {
        self.typed(bytes, FLOAT, kind, count, more)
    }

    fn typed(
        &mut self,
        bytes: &[u8],
        component: u32,
        kind: &str,
        count: usize,
        more: Value,
    ) -> usize {
        let mut accessor = json!({
            "bufferView": self.view(bytes), "componentType": component, "type": kind, "count": count,
        });
        merge(&mut accessor, more);
        self.accessors.push(accessor);
        self.accessors.len() - 1
    }

    fn points(&mut self, points: &[Vec3]) -> usize {
        let least = points.iter().copied().reduce(Vec3::min).unwrap_or_default();
        let most = points.iter().copied().reduce(Vec3::max).unwrap_or_default();
        let bounds = json!({ "min": least.to_array(), "max": most.to_array() });
        self.accessor(&vectors(points), "VEC3", points.len(), bounds)
    }

    /// Adds a picture as PNG and returns the index of its texture.
    pub fn picture(&mut self, picture: &RgbaImage) -> Result<usize, image::ImageError> {
        let mut bytes = Vec::new();
        picture.write_to(&mut Cursor::new(&mut bytes), ImageFormat::Png)?;
        let view = self.view(&bytes);
        self.images
            .push(json!({ "bufferView": view, "mimeType": "image/png" }));
        Ok(self.images.len() - 1)
    }

    /// A primitive with more members.
    pub fn primitive(&mut self, surface: &Surface, material: Option<usize>, more: Value) -> Value {
        let count = surface.positions.len();
        let indices = surface.triangles.as_flattened().iter();
        let indices: Vec<u8> = indices.flat_map(|index| index.to_le_bytes()).collect();
        let mut primitive = json!({
            "material": material,
            "attributes": {
                "POSITION": self.points(&surface.positions),
                "NORMAL": self.accessor(&vectors(&surface.normals), "VEC3", count, json!({})),
                "TEXCOORD_0": self.accessor(&floats(surface.uvs.as_flattened()), "VEC2", count, json!({})),
            },
            "indices": self.typed(&indices, 5123, "SCALAR", 3 * surface.triangles.len(), json!({})),
        });
        merge(&mut primitive, more);
        primitive
    }

    /// A primitive whose vertices follow joints as `weights` says of a point.
    pub fn skinned(
        &mut self,
        surface: &Surface,
        material: Option<usize>,
        weights: impl Fn(Vec3) -> ([u8; 4], [f32; 4]),
    ) -> Value {
        let found: Vec<_> = surface
            .positions
            .iter()
            .map(|&point| weights(point))
            .collect();
        let joints: Vec<u8> = found.iter().flat_map(|(joints, _)| *joints).collect();
        let shares: Vec<f32> = found.iter().flat_map(|(_, shares)| *shares).collect();
        let joints = self.typed(&joints, 5121, "VEC4", found.len(), json!({}));
        let weights = self.accessor(&floats(&shares), "VEC4", found.len(), json!({}));
        let more = json!({ "attributes": { "JOINTS_0": joints, "WEIGHTS_0": weights } });
        self.primitive(surface, material, more)
    }

    /// A morph target that leads from one surface to another.
    pub fn morph(&mut self, from: &Surface, to: &Surface) -> Value {
        let difference = |to: &[Vec3], from: &[Vec3]| -> Vec<Vec3> {
            to.iter().zip(from).map(|(to, from)| to - from).collect()
        };
        let positions = difference(&to.positions, &from.positions);
        let normals = difference(&to.normals, &from.normals);
        let count = normals.len();
        json!({
            "POSITION": self.points(&positions),
            "NORMAL": self.accessor(&vectors(&normals), "VEC3", count, json!({})),
        })
    }

    pub fn mesh<const N: usize>(&mut self, name: &str, primitives: [Value; N]) -> usize {
        self.meshes
            .push(json!({ "name": name, "primitives": primitives.to_vec() }));
        self.meshes.len() - 1
    }

    /// Writes the model whose other members are `document`.
    pub fn write(mut self, path: &str, mut document: Value) -> std::io::Result<()> {
        self.bin.resize(self.bin.len().next_multiple_of(4), 0);
        let textures: Vec<_> = (0..self.images.len())
            .map(|image| json!({ "source": image }))
            .collect();
        merge(
            &mut document,
            json!({
                "buffers": [{ "byteLength": self.bin.len() }],
                "bufferViews": self.views, "accessors": self.accessors, "meshes": self.meshes,
                "images": self.images, "textures": textures,
            }),
        );
        let mut text = document.to_string().into_bytes();
        text.resize(text.len().next_multiple_of(4), b' ');
        let mut bytes = Vec::new();
        let length = 12 + 8 + text.len() + 8 + self.bin.len();
        for word in [
            0x4654_6c67,
            2,
            length as u32,
            text.len() as u32,
            0x4e4f_534a,
        ] {
            bytes.extend(word.to_le_bytes());
        }
        bytes.extend(text);
        for word in [self.bin.len() as u32, 0x004e_4942] {
            bytes.extend(word.to_le_bytes());
        }
        bytes.extend(self.bin);
        std::fs::write(path, bytes)
    }
}

/// Adds the members of `more`, also to members that both have.
fn merge(value: &mut Value, more: Value) {
    match (value, more) {
        (Value::Object(members), Value::Object(more)) => {
            for (key, more) in more {
                merge(members.entry(key).or_insert(Value::Null), more);
            }
        }
        (value, more) => *value = more,
    }
}
