//! A writer of small models.

use glimray::import::{self, Options};
use glimray::scene::{LightTransport, Scene};
use serde_json::{Value, json};

pub const FLOAT: u32 = 5126;
pub const UNSIGNED_BYTE: u32 = 5121;
pub const UNSIGNED_SHORT: u32 = 5123;

/// A model in the making: its JSON and its only buffer.
#[derive(Clone)]
pub struct Model {
    pub json: Value,
    pub bin: Vec<u8>,
}

/// Bytes of little-endian floats.
pub fn floats(values: &[f32]) -> Vec<u8> {
    values
        .iter()
        .flat_map(|value| value.to_le_bytes())
        .collect()
}

impl Model {
    /// One node with one mesh and no primitives yet.
    pub fn new() -> Self {
        Self {
            json: json!({
                "asset": { "version": "2.0" },
                "scenes": [{ "nodes": [0] }],
                "nodes": [{ "mesh": 0 }],
                "meshes": [{ "primitives": [] }],
                "accessors": [], "bufferViews": [],
            }),
            bin: Vec::new(),
        }
    }

    /// A triangle in the plane z = 0 with the given members of its primitive.
    pub fn triangle(primitive: Value) -> Self {
        let mut model = Self::new();
        let position = model.vectors(&[[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]]);
        model.primitive(position, primitive);
        model
    }

    /// Adds a primitive with a POSITION and more members to the first mesh.
    pub fn primitive(&mut self, position: usize, more: Value) {
        let mut primitive = json!({ "attributes": { "POSITION": position } });
        merge(&mut primitive, more);
        let primitives = self.json["meshes"][0]["primitives"].as_array_mut();
        primitives.expect("a list").push(primitive);
    }

    /// Adds a buffer view and returns its index.
    pub fn view(&mut self, bytes: &[u8]) -> usize {
        self.bin.resize(self.bin.len().next_multiple_of(4), 0);
        let view = json!({
            "buffer": 0, "byteOffset": self.bin.len(), "byteLength": bytes.len(),
        });
        self.bin.extend_from_slice(bytes);
        self.push("bufferViews", view)
    }

    /// Adds an accessor for `count` elements of a type in new bytes and returns its index.
    pub fn accessor(&mut self, bytes: &[u8], component: u32, kind: &str, count: usize) -> usize {
        let view = self.view(bytes);
        let accessor = json!({
            "bufferView": view, "componentType": component, "type": kind, "count": count,
        });
        self.push("accessors", accessor)
    }

    /// Adds an accessor with vectors of three floats.
    pub fn vectors(&mut self, values: &[[f32; 3]]) -> usize {
        let bytes = floats(values.as_flattened());
        self.accessor(&bytes, FLOAT, "VEC3", values.len())
    }

    /// Adds an accessor with vectors of two floats.
    pub fn pairs(&mut self, values: &[[f32; 2]]) -> usize {
        let bytes = floats(values.as_flattened());
        self.accessor(&bytes, FLOAT, "VEC2", values.len())
    }

    /// Adds an accessor with vectors of four floats.
    pub fn quads(&mut self, values: &[[f32; 4]]) -> usize {
        let bytes = floats(values.as_flattened());
        self.accessor(&bytes, FLOAT, "VEC4", values.len())
    }

    /// Adds an accessor with numbers.
    pub fn numbers(&mut self, values: &[f32]) -> usize {
        self.accessor(&floats(values), FLOAT, "SCALAR", values.len())
    }

    /// Adds an entry to a list of the JSON and returns its index.
    pub fn push(&mut self, list: &str, entry: Value) -> usize {
        if self.json[list].is_null() {
            self.json[list] = json!([]);
        }
        let entries = self.json[list].as_array_mut().expect("a list");
        entries.push(entry);
        entries.len() - 1
    }

    /// Merges members into the JSON.
    pub fn with(mut self, more: Value) -> Self {
        merge(&mut self.json, more);
        self
    }

    /// As a GLB.
    pub fn glb(&self) -> Vec<u8> {
        let mut json = self.json.clone();
        if json["buffers"].is_null() && !self.bin.is_empty() {
            json["buffers"] = json!([{ "byteLength": self.bin.len() }]);
        }
        let mut text = json.to_string().into_bytes();
        text.resize(text.len().next_multiple_of(4), b' ');
        let mut bin = self.bin.clone();
        bin.resize(bin.len().next_multiple_of(4), 0);
        let length = 12 + 8 + text.len() + 8 + bin.len();
        let mut bytes = b"glTF".to_vec();
        for word in [2, length as u32, text.len() as u32, 0x4e4f_534a] {
            bytes.extend(word.to_le_bytes());
        }
        bytes.extend(text);
        for word in [bin.len() as u32, 0x004e_4942] {
            bytes.extend(word.to_le_bytes());
        }
        bytes.extend(bin);
        bytes
    }

    /// As a `.gltf` whose buffer has the given URI.
    pub fn gltf(&self, uri: &str) -> String {
        let mut json = self.json.clone();
        json["buffers"] = json!([{ "byteLength": self.bin.len(), "uri": uri }]);
        json.to_string()
    }

    /// Imports the model, lit for the classical integrator, which adds no picture of a sky.
    pub fn scene(&self) -> Scene {
        let folder = super::folder(&[("a.glb", &self.glb())]);
        let options = Options {
            integrator: Some(LightTransport::Whitted),
            baking: import::Baking::Always,
            ..Options::default()
        };
        let scene = import::load_with(&folder.path().join("a.glb"), &options);
        scene.unwrap_or_else(|error| panic!("{error}"))
    }

    /// The message for the model.
    pub fn message(&self) -> String {
        super::super::messages("a.glb", &[self.glb()])
    }
}

/// Puts the members of `from` into `into`, recursively.
fn merge(into: &mut Value, from: Value) {
    match (into, from) {
        (Value::Object(into), Value::Object(from)) => {
            for (key, value) in from {
                merge(into.entry(key).or_insert(Value::Null), value);
            }
        }
        (into, from) => *into = from,
    }
}

/// Base64 (RFC 4648).
pub fn base64(bytes: &[u8]) -> String {
    const LETTERS: &[u8; 64] = b"ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    let mut text = String::new();
    for part in bytes.chunks(3) {
        let byte = |i: usize| u32::from(part.get(i).copied().unwrap_or(0));
        let bits = byte(0) << 16 | byte(1) << 8 | byte(2);
        for i in 0..4 {
            match i <= part.len() {
                true => text.push(char::from(LETTERS[(bits >> (18 - 6 * i) & 63) as usize])),
                false => text.push('='),
            }
        }
    }
    text
}

/// A PNG of RGBA texels, row by row.
pub fn png(width: u32, texels: &[[u8; 4]]) -> Vec<u8> {
    let height = texels.len() as u32 / width;
    let image = image::RgbaImage::from_raw(width, height, texels.as_flattened().to_vec());
    let mut bytes = std::io::Cursor::new(Vec::new());
    image
        .expect("as many texels")
        .write_to(&mut bytes, image::ImageFormat::Png)
        .expect("a PNG");
    bytes.into_inner()
}

/// Adds a picture as a texture and returns its index.
pub fn picture(model: &mut Model, width: u32, texels: &[[u8; 4]]) -> usize {
    let uri = format!("data:image/png;base64,{}", base64(&png(width, texels)));
    let source = model.push("images", json!({ "uri": uri }));
    model.push("textures", json!({ "source": source }))
}

/// The corners and faces of a closed box around the origin, twice as long as `half`.
fn closed_box(model: &mut Model, half: f32) -> (usize, usize) {
    let corners: Vec<_> = (0..8)
        .map(|i: u32| [0, 1, 2].map(|axis| if i >> axis & 1 == 0 { -half } else { half }))
        .collect();
    let faces: [[u16; 4]; 6] = [
        [0, 4, 6, 2],
        [1, 3, 7, 5],
        [0, 1, 5, 4],
        [2, 6, 7, 3],
        [0, 2, 3, 1],
        [4, 5, 7, 6],
    ];
    let indices = faces
        .iter()
        .flat_map(|[a, b, c, d]| [*a, *b, *c, *a, *c, *d]);
    let bytes: Vec<u8> = indices.flat_map(u16::to_le_bytes).collect();
    let positions = model.vectors(&corners);
    (
        positions,
        model.accessor(&bytes, UNSIGNED_SHORT, "SCALAR", 36),
    )
}

/// A closed ship around the origin with a camera in it, a tower beside it, and more nodes, cameras and materials. The ship
/// has the material 0.
pub fn ship(more: Value) -> Model {
    let mut model = Model::new();
    let (positions, indices) = closed_box(&mut model, 1.0);
    model.primitive(positions, json!({ "indices": indices, "material": 0 }));
    let tower = json!({ "mesh": 0, "translation": [10, 0, 0] });
    let lens = json!({ "type": "perspective", "perspective": { "yfov": 0.8, "znear": 0.1 } });
    let model = model.with(json!({
        "scenes": [{ "nodes": [0, 1, 2] }],
        "nodes": [{ "mesh": 0 }, tower, { "camera": 0, "name": "bridge" }],
        "cameras": [lens],
        "materials": [{}],
    }));
    model.with(more)
}
