//! The edges of a mesh.

use glam::Vec3;
use glimray_scene::Mesh;
use std::collections::HashMap;

/// Cosine of the angle between two faces from which on their edge is a crease: 30°.
const CREASE: f32 = 0.866_025_4;

/// The edges of a mesh as pairs of indices into its positions, once each, although vertices that differ in their normals or
/// texture coordinates are stored several times.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct MeshEdges {
    /// All edges: the features first.
    all: Vec<[u32; 2]>,
    feature_count: usize,
}

/// The faces at an edge.
struct Side {
    ends: [u32; 2],
    face: u32,
}

impl MeshEdges {
    /// Finds the edges.
    pub fn of(mesh: &Mesh) -> Self {
        let mut first: HashMap<[u32; 3], u32> = HashMap::with_capacity(mesh.positions.len());
        let welded: Vec<u32> = (mesh.positions.iter().zip(0..))
            .map(|(position, index)| {
                // Zero has two signs.
                let key = (*position + Vec3::ZERO).to_array().map(f32::to_bits);
                *first.entry(key).or_insert(index)
            })
            .collect();
        let mut sides: Vec<Side> = Vec::with_capacity(3 * mesh.triangles.len());
        for (triangle, face) in mesh.triangles.iter().zip(0..) {
            for (a, b) in [(0, 1), (1, 2), (2, 0)] {
                let [a, b] = [a, b].map(|corner: usize| welded[triangle[corner] as usize]);
                if a != b {
                    let ends = [a.min(b), a.max(b)];
                    sides.push(Side { ends, face });
                }
            }
        }
        sides.sort_unstable_by_key(|side| (side.ends, side.face));
        let (mut features, mut others) = (Vec::new(), Vec::new());
        for sides in sides.chunk_by(|a, b| a.ends == b.ends) {
            match is_feature(mesh, sides) {
                true => features.push(sides[0].ends),
                false => others.push(sides[0].ends),
            }
        }
        let feature_count = features.len();
        features.append(&mut others);
        Self {
            all: features,
            feature_count,
        }
    }

    /// All edges, or the features.
    pub fn chosen(&self, all: bool) -> &[[u32; 2]] {
        match all {
            true => &self.all,
            false => &self.all[..self.feature_count],
        }
    }
}

/// Whether an edge is at a border, at a crease, or between materials.
fn is_feature(mesh: &Mesh, sides: &[Side]) -> bool {
    let [a, b] = sides else {
        return true;
    };
    let [a, b] = [a, b].map(|side| mesh.triangles[side.face as usize]);
    let normal = |corners: [u32; 3]| {
        let [a, b, c] = corners.map(|corner| mesh.positions[corner as usize]);
        (b - a).cross(c - a).normalize_or_zero()
    };
    let material = |corners: [u32; 3]| mesh.materials[corners[0] as usize];
    normal(a).dot(normal(b)) < CREASE || material(a) != material(b)
}
