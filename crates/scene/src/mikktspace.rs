//! Tangents by the rules of MikkTSpace (Mikkelsen, Simulation of Wrinkled Surfaces Revisited, 2008; mikktspace.com), on
//! which the programs that bake normal maps have agreed. Triangles are joined where vertices are equal in position,
//! normal and texture coordinates, and neighbours around a vertex share a tangent as long as their mappings have the
//! same orientation.
//!
//! This version differs from the original where that does not stay linear in the size of a mesh: the original recurses
//! around a vertex, compares all triangles there with each other to leave out exactly opposite ones, and searches all
//! triangles for those without area. Arithmetic is f64.

use glam::{DVec2, DVec3, Vec2, Vec3, Vec4};
use std::collections::HashMap;

/// Lengths and areas below this count as none.
const LEAST: f64 = f32::MIN_POSITIVE as f64;

/// A corner without a group, a side without a neighbour.
const NONE: u32 = u32::MAX;

/// Mesh data that tangents depend on. Indices are in range.
#[derive(Clone, Copy)]
pub struct Surface<'a> {
    /// By vertex.
    pub positions: &'a [Vec3],
    /// Unit normals, by vertex.
    pub normals: &'a [Vec3],
    /// Texture coordinates, by vertex.
    pub uvs: &'a [Vec2],
    /// The triangles, by their vertices.
    pub triangles: &'a [[u32; 3]],
}

/// Tangents that are shared by corners of triangles.
pub struct Tangents {
    /// Unit vectors in the plane of the normal along u; w is 1 or −1, and w · normal × tangent points along v.
    pub list: Vec<Vec4>,
    /// For the corners of each triangle an index into `list`; `u32::MAX` where u and v have no direction.
    pub of_corners: Vec<[u32; 3]>,
}

/// The tangents of all corners.
pub fn tangents(surface: Surface) -> Tangents {
    let corners = surface.welded();
    let mut faces: Vec<Face> = surface
        .triangles
        .iter()
        .map(|triangle| surface.face(triangle))
        .collect();
    let neighbors = neighbors(&faces, &corners);
    let mut groups = Groups {
        of_corners: vec![[NONE; 3]; corners.len()],
        list: Vec::new(),
        open: Vec::new(),
    };
    let mut members = Vec::new();
    for first in 0..corners.len() {
        for k in 0..3 {
            if !faces[first].joins_any && groups.of_corners[first][k] == NONE {
                groups.spread(&mut faces, &corners, &neighbors, (first, k), &mut members);
                groups.list.push(surface.mean(&faces, &members));
            }
        }
    }
    groups.lend(&faces, &corners);
    Tangents {
        list: groups.list,
        of_corners: groups.of_corners,
    }
}

/// Per-triangle data: direction of u, orientation and degeneracy.
#[derive(Clone, Copy)]
struct Face {
    /// The direction in which u grows with v constant, of unit length.
    along_u: Vec3,
    /// Whether u and v are not mirrored on it.
    is_upright: bool,
    /// Whether u and v have no direction on it.
    joins_any: bool,
    /// Whether two of its corners are at the same place.
    is_degenerate: bool,
}

impl Surface<'_> {
    /// The triangles with the first of all equal vertices in place of each.
    fn welded(&self) -> Vec<[u32; 3]> {
        let mut first = HashMap::new();
        let mut of_vertices = vec![NONE; self.positions.len()];
        let mut weld = |vertex: u32| {
            let i = vertex as usize;
            if of_vertices[i] == NONE {
                let (p, n, uv) = (self.positions[i], self.normals[i], self.uvs[i]);
                // 0 and −0 are equal.
                let bits = [p.x, p.y, p.z, n.x, n.y, n.z, uv.x, uv.y].map(|x| (x + 0.0).to_bits());
                of_vertices[i] = *first.entry(bits).or_insert(vertex);
            }
            of_vertices[i]
        };
        let triangles = self.triangles.iter();
        triangles.map(|corners| corners.map(&mut weld)).collect()
    }

    fn face(&self, triangle: &[u32; 3]) -> Face {
        let [a, b, c] = triangle.map(|i| self.positions[i as usize].as_dvec3());
        let [p, q, r] = triangle.map(|i| self.uvs[i as usize].as_dvec2());
        let (e1, e2): (DVec3, DVec3) = (b - a, c - a);
        let (d1, d2): (DVec2, DVec2) = (q - p, r - p);
        let area = d1.perp_dot(d2);
        let (u, v) = (d2.y * e1 - d1.y * e2, d1.x * e2 - d2.x * e1);
        let has_directions = area.abs() > LEAST
            && u.length() / area.abs() > LEAST
            && v.length() / area.abs() > LEAST;
        let is_degenerate = a == b || b == c || c == a;
        Face {
            along_u: match has_directions {
                true => (u * area.signum()).normalize_or_zero().as_vec3(),
                false => Vec3::ZERO,
            },
            is_upright: area > 0.0,
            joins_any: is_degenerate || !has_directions,
            is_degenerate,
        }
    }

    /// The tangent that corners of triangles share: the mean of the directions along u in the plane of the normal,
    /// weighted with the angles of the corners.
    fn mean(&self, faces: &[Face], members: &[(u32, u8)]) -> Vec4 {
        let (first, k) = members[0];
        let vertex = self.triangles[first as usize][usize::from(k)];
        let normal = self.normals[vertex as usize].as_dvec3();
        let within = |v: DVec3| (v - normal.dot(v) * normal).normalize_or_zero();
        let mut sum = DVec3::ZERO;
        for &(index, k) in members {
            let face = &faces[index as usize];
            if face.joins_any {
                continue;
            }
            let triangle = &self.triangles[index as usize];
            let at = |k: usize| self.positions[triangle[k % 3] as usize].as_dvec3();
            let k = usize::from(k);
            let [next, last] = [k + 1, k + 2].map(|other| within(at(other) - at(k)));
            let angle = next.dot(last).clamp(-1.0, 1.0).acos();
            sum += angle * within(face.along_u.as_dvec3());
        }
        let own = || within(faces[first as usize].along_u.as_dvec3());
        let mean = sum.try_normalize().unwrap_or_else(own);
        let hand = if faces[first as usize].is_upright {
            1.0
        } else {
            -1.0
        };
        mean.as_vec3().extend(hand)
    }
}

/// For each side of each triangle, from corner k to the next, the triangle on its other side. Several triangles at
/// the same edge are paired in their order.
fn neighbors(faces: &[Face], corners: &[[u32; 3]]) -> Vec<[u32; 3]> {
    let mut sides = Vec::with_capacity(3 * corners.len());
    for (index, triangle) in (0u32..).zip(corners) {
        if !faces[index as usize].is_degenerate {
            for k in 0..3u8 {
                let (from, to) = (triangle[usize::from(k)], triangle[usize::from((k + 1) % 3)]);
                sides.push((from.min(to), from.max(to), index, k, from < to));
            }
        }
    }
    sides.sort_unstable();
    let mut neighbors = vec![[NONE; 3]; corners.len()];
    let mut waiting: Vec<(u32, u8)> = Vec::new();
    for edge in sides.chunk_by(|a, b| (a.0, a.1) == (b.0, b.1)) {
        // Sides that go one way wait for one that goes the other way.
        waiting.clear();
        let (mut next, mut is_forward) = (0, true);
        for &(_, _, index, k, goes_forward) in edge {
            match waiting.get(next) {
                Some(&(other, side)) if goes_forward != is_forward => {
                    neighbors[index as usize][usize::from(k)] = other;
                    neighbors[other as usize][usize::from(side)] = index;
                    next += 1;
                }
                _ => {
                    is_forward = goes_forward;
                    waiting.push((index, k));
                }
            }
        }
    }
    neighbors
}

/// The corners that share tangents.
struct Groups {
    /// For the corners of each triangle the index of their tangent.
    of_corners: Vec<[u32; 3]>,
    list: Vec<Vec4>,
    /// Triangles that a group reaches next.
    open: Vec<u32>,
}

impl Groups {
    /// Starts the next group at a corner of a triangle and spreads it around the vertex. `members` becomes the list of
    /// its corners.
    fn spread(
        &mut self,
        faces: &mut [Face],
        corners: &[[u32; 3]],
        neighbors: &[[u32; 3]],
        (first, k): (usize, usize),
        members: &mut Vec<(u32, u8)>,
    ) {
        let vertex = corners[first][k];
        let is_upright = faces[first].is_upright;
        members.clear();
        self.open.push(first as u32);
        while let Some(index) = self.open.pop() {
            let i = index as usize;
            let Some(k) = corners[i].iter().position(|&corner| corner == vertex) else {
                continue;
            };
            if self.of_corners[i][k] != NONE {
                continue;
            }
            // The first group that reaches a triangle without directions determines its orientation.
            if faces[i].joins_any && self.of_corners[i] == [NONE; 3] {
                faces[i].is_upright = is_upright;
            }
            if faces[i].is_upright != is_upright {
                continue;
            }
            self.of_corners[i][k] = self.list.len() as u32;
            members.push((index, k as u8));
            let sides = [neighbors[i][k], neighbors[i][(k + 2) % 3]];
            (self.open).extend(sides.into_iter().filter(|&side| side != NONE));
        }
    }

    /// Gives the corners of triangles without area the tangents of others at the same vertices.
    fn lend(&mut self, faces: &[Face], corners: &[[u32; 3]]) {
        if !faces.iter().any(|face| face.is_degenerate) {
            return;
        }
        let mut known = HashMap::new();
        for (index, triangle) in corners.iter().enumerate() {
            for (k, &vertex) in triangle.iter().enumerate() {
                let group = self.of_corners[index][k];
                if group != NONE && !faces[index].is_degenerate {
                    known.entry(vertex).or_insert(group);
                }
            }
        }
        for (index, triangle) in corners.iter().enumerate() {
            if faces[index].is_degenerate {
                let group = |vertex| known.get(&vertex).copied().unwrap_or(NONE);
                self.of_corners[index] = triangle.map(group);
            }
        }
    }
}
