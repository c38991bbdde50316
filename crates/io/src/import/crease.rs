//! Normals for triangles that have none: smooth, except across sharp edges.
//!
//! The normal of a corner is the mean of the normals of the faces around its vertex, each weighted by its
//! angle there (Thürmer and Wüthrich, Computing Vertex Normals from Polygonal Facets, 1998), restricted to
//! faces within the crease angle of the corner's own face. Vertices are split where their corners differ in
//! normal or material.

use glam::{DVec3, Vec3};
use glimray_scene::{Mesh, area_normal};
use std::collections::HashMap;

/// Where more faces than this meet in a vertex, faces of nearly equal direction are taken together:
/// comparing all pairs would take quadratic time.
const MANY: usize = 32;

/// Limit of the directions that are told apart in a vertex of many faces.
const MOST_DIRECTIONS: usize = 64;

/// The cosine of the angle within which faces are taken together: one degree.
const ALIKE: f64 = 0.999_847_695_156_391_3;

/// Triangles over shared positions, each with an area.
#[derive(Default)]
pub(super) struct Facets {
    pub positions: Vec<Vec3>,
    pub triangles: Vec<[u32; 3]>,
    /// The material of each triangle.
    pub materials: Vec<u32>,
}

/// One corner at the vertex that is looked at.
struct Corner {
    /// Index among all corners.
    index: u32,
    /// The unit normal of its face, scaled by the angle of the face at the vertex.
    weighted: DVec3,
    /// The unit normal of its face.
    normal: DVec3,
    material: u32,
}

impl Facets {
    /// Bytes of memory that [`Self::into_mesh`] takes per triangle, with the result and the facets.
    pub const BYTES: usize = 4 * size_of::<[u32; 3]>() + 3 * size_of::<(Vec3, Vec3, u32, u32)>();

    /// Drops triangles without area and returns their number.
    pub fn drop_degenerate(&mut self) -> usize {
        let before = self.triangles.len();
        let positions = &self.positions;
        let has_area = |triangle: &[u32; 3]| area_normal(positions, triangle).is_some();
        let kept: Vec<bool> = self.triangles.iter().map(has_area).collect();
        let mut next = kept.iter();
        self.triangles.retain(|_| next.next() == Some(&true));
        let mut next = kept.iter();
        self.materials.retain(|_| next.next() == Some(&true));
        before - self.triangles.len()
    }

    /// The mesh with its normals. `crease` is the crease angle in radians.
    pub fn into_mesh(self, crease: f64) -> Mesh {
        let crease = crease.cos();
        let (starts, order) = self.corners_by_vertex();
        let mut mesh = Mesh {
            triangles: vec![[0; 3]; self.triangles.len()],
            ..Mesh::default()
        };
        let mut round = Vec::new();
        for (vertex, range) in starts.windows(2).enumerate() {
            round.clear();
            let corners = &order[range[0] as usize..range[1] as usize];
            round.extend(corners.iter().map(|&index| self.corner(index)));
            let normals = if round.len() > MANY {
                means_of_many(&round, crease)
            } else {
                means(&round, crease)
            };
            let mut made: HashMap<([u32; 3], u32), u32> = HashMap::new();
            let first = mesh.positions.len();
            for (corner, normal) in round.iter().zip(normals) {
                let key = (normal.to_array().map(f32::to_bits), corner.material);
                let known = if round.len() > MANY {
                    made.get(&key).map(|&index| index as usize)
                } else {
                    let is_same =
                        |&i: &usize| mesh.normals[i] == normal && mesh.materials[i] == key.1;
                    (first..mesh.positions.len()).find(is_same)
                };
                let index = known.unwrap_or(mesh.positions.len()) as u32;
                if known.is_none() {
                    mesh.positions.push(self.positions[vertex]);
                    mesh.normals.push(normal);
                    mesh.materials.push(corner.material);
                    if round.len() > MANY {
                        made.insert(key, index);
                    }
                }
                let at = corner.index as usize;
                mesh.triangles[at / 3][at % 3] = index;
            }
        }
        mesh
    }

    /// The corners of each vertex: where they begin in the second list, and their indices.
    fn corners_by_vertex(&self) -> (Vec<u32>, Vec<u32>) {
        let corners = self.triangles.as_flattened();
        let mut starts = vec![0; self.positions.len() + 1];
        for &vertex in corners {
            starts[vertex as usize + 1] += 1;
        }
        for i in 1..starts.len() {
            starts[i] += starts[i - 1];
        }
        let mut next = starts.clone();
        let mut order = vec![0; corners.len()];
        for (i, &vertex) in corners.iter().enumerate() {
            let at = &mut next[vertex as usize];
            order[*at as usize] = i as u32;
            *at += 1;
        }
        (starts, order)
    }

    fn corner(&self, index: u32) -> Corner {
        let face = index as usize / 3;
        corner(
            &self.positions,
            self.triangles[face],
            index,
            self.materials[face],
        )
    }
}

/// The corner of `triangle` with this index among all corners.
fn corner(positions: &[Vec3], triangle: [u32; 3], index: u32, material: u32) -> Corner {
    let side = index as usize % 3;
    let place = |i: usize| positions[triangle[(side + i) % 3] as usize].as_dvec3();
    let (a, b) = (place(1) - place(0), place(2) - place(0));
    let cross = a.cross(b);
    let normal = cross.normalize_or_zero();
    Corner {
        index,
        weighted: normal * cross.length().atan2(a.dot(b)),
        normal,
        material,
    }
}

/// The normal of each corner.
fn means(round: &[Corner], crease: f64) -> Vec<Vec3> {
    let mean = |own: &Corner| {
        let near = round
            .iter()
            .filter(|other| own.normal.dot(other.normal) >= crease);
        let sum: DVec3 = near.map(|other| other.weighted).sum();
        sum.normalize_or(own.normal).as_vec3()
    };
    round.iter().map(mean).collect()
}

/// The normal of each of many corners, whose faces are grouped by direction.
fn means_of_many(round: &[Corner], crease: f64) -> Vec<Vec3> {
    let mut groups: Vec<Corner> = Vec::new();
    let mut group_of = Vec::with_capacity(round.len());
    for corner in round {
        let is_alike = |group: &Corner| group.normal.dot(corner.normal) >= ALIKE;
        let known = groups.iter().position(is_alike);
        let group = match known {
            Some(known) => known,
            None if groups.len() < MOST_DIRECTIONS => {
                groups.push(Corner {
                    weighted: DVec3::ZERO,
                    ..*corner
                });
                groups.len() - 1
            }
            None => {
                let nearness = |group: &Corner| group.normal.dot(corner.normal);
                let all = groups.iter().enumerate();
                let nearest = all.max_by(|a, b| nearness(a.1).total_cmp(&nearness(b.1)));
                nearest.map_or(0, |(index, _)| index)
            }
        };
        groups[group].weighted += corner.weighted;
        group_of.push(group);
    }
    let normals = means(&groups, crease);
    group_of.into_iter().map(|group| normals[group]).collect()
}

/// Computes the normals of `mesh`, which has none. Where all faces around a vertex are within half the crease
/// angle, in radians, of their mean, weighted by area, the vertex gets that normal; other vertices are split
/// as by [`Facets::into_mesh`].
pub(super) fn sharpen(mesh: &mut Mesh, crease: f64) {
    // Then any two of them are within the crease angle.
    let near = (crease / 2.0).cos();
    let mut sums = vec![DVec3::ZERO; mesh.positions.len()];
    for triangle in &mesh.triangles {
        if let Some(normal) = area_normal(&mesh.positions, triangle) {
            triangle
                .iter()
                .for_each(|&vertex| sums[vertex as usize] += normal);
        }
    }
    mesh.normals = sums
        .iter()
        .map(|sum| sum.normalize_or_zero().as_vec3())
        .collect();
    drop(sums);
    let mut is_sharp = vec![false; mesh.positions.len()];
    for triangle in &mesh.triangles {
        let Some(normal) = area_normal(&mesh.positions, triangle) else {
            continue;
        };
        let least = near * normal.length();
        for &vertex in triangle {
            let mean = mesh.normals[vertex as usize].as_dvec3();
            is_sharp[vertex as usize] |= normal.dot(mean) < least;
        }
    }
    if is_sharp.contains(&true) {
        split(mesh, &is_sharp, crease.cos());
    }
}

/// Splits the vertices that are marked.
fn split(mesh: &mut Mesh, is_sharp: &[bool], crease: f64) {
    let corners = mesh.triangles.as_flattened();
    let mut order: Vec<(u32, u32)> = (corners.iter().zip(0..))
        .filter(|&(&vertex, _)| is_sharp[vertex as usize])
        .map(|(&vertex, corner)| (vertex, corner))
        .collect();
    order.sort_unstable();
    let mut next = 0;
    while let Some(&(vertex, _)) = order.get(next) {
        let length = order[next..]
            .iter()
            .take_while(|corner| corner.0 == vertex)
            .count();
        let all = &order[next..next + length];
        next += length;
        let round: Vec<Corner> = (all.iter())
            .map(|&(_, index)| {
                let triangle = mesh.triangles[index as usize / 3];
                corner(&mesh.positions, triangle, index, 0)
            })
            .filter(|corner| corner.normal != DVec3::ZERO)
            .collect();
        let normals = match round.len() > MANY {
            true => means_of_many(&round, crease),
            false => means(&round, crease),
        };
        let mut made: HashMap<[u32; 3], u32> = HashMap::new();
        for (corner, normal) in round.iter().zip(normals) {
            let is_first = made.is_empty();
            let index = *made
                .entry(normal.to_array().map(f32::to_bits))
                .or_insert_with(|| {
                    if is_first {
                        mesh.normals[vertex as usize] = normal;
                        return vertex;
                    }
                    mesh.copy_vertices(&[vertex]);
                    if let Some(last) = mesh.normals.last_mut() {
                        *last = normal;
                    }
                    mesh.positions.len() as u32 - 1
                });
            let at = corner.index as usize;
            mesh.triangles[at / 3][at % 3] = index;
        }
    }
}
