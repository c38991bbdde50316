//! A model with a skin, two morph targets and a clip with every interpolation: its JSON is fixed, and all numbers in its
//! buffer are arbitrary.

use super::PNG;
use glimray::import::{self, ImportError, Memory, Options};
use glimray::scene::Scene;
use std::fmt::Write;

const VERTICES: usize = 6;

/// Contents of the buffer, in this order: number of elements, components, their glTF type, and whether they are
/// normalised bytes instead of floats.
const PARTS: [(usize, usize, &str, bool); 16] = [
    (VERTICES, 3, "VEC3", false), // 0 positions
    (VERTICES, 3, "VEC3", false), // 1 normals
    (VERTICES, 2, "VEC2", false), // 2 texture coordinates
    (VERTICES, 4, "VEC4", true),  // 3 joints
    (VERTICES, 4, "VEC4", true),  // 4 weights
    (VERTICES, 3, "VEC3", false), // 5 a morph target
    (VERTICES, 3, "VEC3", false), // 6 another
    (2, 16, "MAT4", false),       // 7 inverse bind matrices
    (4, 1, "SCALAR", false),      // 8 times
    (2, 1, "SCALAR", false),      // 9 other times
    (12, 4, "VEC4", false),       // 10 rotations, with tangents
    (4, 3, "VEC3", false),        // 11 translations
    (4, 3, "VEC3", false),        // 12 scales
    (8, 1, "SCALAR", false),      // 13 weights of morph targets
    (2, 4, "VEC4", false),        // 14 base colours
    (2, 2, "VEC2", false),        // 15 offsets of the base colour's map
];

/// Bytes of a part.
fn len((count, components, _, is_narrow): (usize, usize, &str, bool)) -> usize {
    count * components * if is_narrow { 1 } else { 4 }
}

/// The model whose buffer begins with `bytes`; the rest is zero.
///
/// # Errors
/// The model is refused.
pub fn model(bytes: &[u8]) -> Result<Scene, ImportError> {
    let total: usize = PARTS.into_iter().map(len).sum();
    let mut buffer = bytes[..bytes.len().min(total)].to_vec();
    buffer.resize(total, 0);
    let (mut views, mut accessors) = (String::new(), String::new());
    let mut start = 0;
    for (index, part) in PARTS.into_iter().enumerate() {
        let (count, _, kind, is_narrow) = part;
        let size = len(part);
        if index == 3 {
            // There are two joints.
            buffer[start..start + size]
                .iter_mut()
                .for_each(|joint| *joint &= 1);
        }
        let component = if is_narrow { 5121 } else { 5126 };
        let is_normalized = is_narrow && index != 3;
        let written = write!(
            views,
            "{{\"buffer\":0,\"byteOffset\":{start},\"byteLength\":{size}}},"
        )
        .and_then(|()| {
            write!(
                accessors,
                "{{\"bufferView\":{index},\"componentType\":{component},\"count\":{count},\"type\":\"{kind}\",\"normalized\":{is_normalized}}},"
            )
        });
        written.expect("memory takes everything");
        start += size;
    }
    let json = include_str!("poses.json")
        .replace("VIEWS", views.trim_end_matches(','))
        .replace("ACCESSORS", accessors.trim_end_matches(','))
        .replace("TOTAL", &total.to_string());
    let files = [
        ("a.gltf", json.as_bytes()),
        ("a.bin", &buffer[..]),
        ("a.png", PNG),
    ];
    import::load_from(&Memory::from_iter(files), "a.gltf", &Options::default())
}

/// A moment of `scene` that is not as it must be.
pub fn broken(scene: &Scene, time: f64) -> Option<String> {
    let frame = scene.frame(time);
    if let Some(node) = (frame.nodes.iter()).find(|node| !node.world_from_node.is_finite()) {
        return Some(format!("{node:?} at {time} s"));
    }
    for (deformation, weights) in scene.deformations.iter().zip(&frame.weights) {
        let pose = deformation.pose(&frame.nodes, weights);
        let mesh = &scene.meshes[deformation.mesh];
        let posed = deformation.posed(mesh, &pose);
        for vertex in 0..posed.len() {
            let (position, normal) = posed.vertex(vertex);
            if !position.is_finite() || !normal.is_finite() {
                return Some(format!("{position} with {normal} at {time} s"));
            }
        }
    }
    for texture in &frame.textures {
        if !texture.pattern_from_space.is_finite() {
            return Some(format!("{texture:?} at {time} s"));
        }
    }
    None
}
