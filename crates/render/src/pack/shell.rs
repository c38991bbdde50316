//! The surface of a mesh as a closed volume: inside tests and connected components.

use glam::{DAffine3, DVec3, Vec3};
use glimray_scene::Mesh;
use std::collections::{HashMap, HashSet};

/// The triangles of a mesh, in its own space.
#[derive(Debug)]
pub struct Shell {
    corners: Vec<[Vec3; 3]>,
    min: Vec3,
    max: Vec3,
}

impl Shell {
    /// The shell of a mesh; `None` without triangles.
    pub fn of(mesh: &Mesh) -> Option<Self> {
        let corner = |&i: &u32| mesh.positions[i as usize];
        let corners: Vec<[Vec3; 3]> = (mesh.triangles.iter())
            .map(|t| [corner(&t[0]), corner(&t[1]), corner(&t[2])])
            .collect();
        let points = corners.iter().flatten().copied();
        Some(Self {
            min: points.clone().reduce(Vec3::min)?,
            max: points.reduce(Vec3::max)?,
            corners,
        })
    }

    /// The bounding box after `placement`.
    pub fn bounds(&self, placement: DAffine3) -> (DVec3, DVec3) {
        let corners = self.corners.iter().flatten();
        let placed = corners.map(|corner| placement.transform_point3(corner.as_dvec3()));
        placed.fold((DVec3::INFINITY, DVec3::NEG_INFINITY), |(min, max), p| {
            (min.min(p), max.max(p))
        })
    }

    /// Whether a ray from the point crosses the surface an odd number of times. Its direction is neither an
    /// axis nor a diagonal, so that it rarely hits an edge.
    pub fn contains(&self, point: DVec3) -> bool {
        let (min, max) = (self.min.as_dvec3(), self.max.as_dvec3());
        if point.cmplt(min).any() || point.cmpgt(max).any() {
            return false;
        }
        let direction = DVec3::new(0.541_196, 0.723_607, 0.428_571);
        let crosses = |corners: &[Vec3; 3]| {
            let [a, b, c] = corners.map(Vec3::as_dvec3);
            let (edge1, edge2, from) = (b - a, c - a, point - a);
            let p = direction.cross(edge2);
            let determinant = edge1.dot(p);
            let q = from.cross(edge1);
            let (u, v) = (from.dot(p) / determinant, direction.dot(q) / determinant);
            determinant != 0.0
                && u >= 0.0
                && v >= 0.0
                && u + v <= 1.0
                && edge2.dot(q) / determinant > 0.0
        };
        self.corners.iter().filter(|c| crosses(c)).count() % 2 == 1
    }
}

/// Whether the triangles of a mesh enclose a volume: along each edge as many of them run in one direction as in the other.
/// Vertices at the same position are one, as along seams of texture coordinates. A sheet of which each triangle has a twin for
/// the other side encloses nothing.
pub fn is_closed(mesh: &Mesh) -> bool {
    let same = welded(mesh);
    let triangles = || (mesh.triangles.iter()).map(|t| t.map(|i| same[i as usize]));
    let mut faces: Vec<_> = triangles()
        .map(|mut triangle| {
            triangle.sort_unstable();
            triangle
        })
        .filter(|[a, b, c]| a != b && b != c)
        .collect();
    faces.sort_unstable();
    let mut edges: Vec<_> = triangles()
        .flat_map(|[a, b, c]| [(a, b), (b, c), (c, a)])
        .filter(|(from, to)| from != to)
        .map(|(from, to)| (from.min(to), from.max(to), from < to))
        .collect();
    edges.sort_unstable();
    let is_balanced = (edges.chunk_by(|a, b| (a.0, a.1) == (b.0, b.1))).all(|edge| {
        let forward = edge.iter().filter(|(.., is_forward)| *is_forward).count();
        2 * forward == edge.len()
    });
    !edges.is_empty() && is_balanced && faces.windows(2).all(|pair| pair[0] != pair[1])
}

/// For each vertex the first one at the same position.
fn welded(mesh: &Mesh) -> Vec<usize> {
    let mut first_at = HashMap::new();
    // -0 and 0 are one position.
    let bits = |p: &Vec3| (*p + Vec3::ZERO).to_array().map(f32::to_bits);
    (mesh.positions.iter().enumerate())
        .map(|(i, p)| *first_at.entry(bits(p)).or_insert(i))
        .collect()
}

/// The number of sets of triangles connected by equal vertex positions.
pub fn part_count(mesh: &Mesh) -> usize {
    // A union-find forest over the vertices: each points to an earlier one of its component, or to itself.
    let mut leads_to = welded(mesh);
    let root = |leads_to: &mut [usize], mut i: usize| {
        while leads_to[i] != i {
            leads_to[i] = leads_to[leads_to[i]];
            i = leads_to[i];
        }
        i
    };
    for triangle in &mesh.triangles {
        let [a, b, c] = triangle.map(|i| root(&mut leads_to, i as usize));
        let first = a.min(b).min(c);
        for i in [a, b, c] {
            leads_to[i] = first;
        }
    }
    // Unused vertices form no component.
    let roots: HashSet<usize> = (mesh.triangles.iter())
        .map(|triangle| root(&mut leads_to, triangle[0] as usize))
        .collect();
    roots.len()
}
