//! Triangle meshes, and the repairs that every mesh format needs.

use crate::threads;
use glam::{DVec3, Vec2, Vec3, Vec4};
use std::sync::atomic::{AtomicBool, Ordering};

/// Indexed triangles in object space. Positions are in range, triangles have an area (unless the mesh
/// deforms), and normals have unit length: [`Mesh::repair`] ensures that for any file.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Mesh {
    /// Empty if the file gives none.
    pub name: String,
    /// The vertices, in object space.
    pub positions: Vec<Vec3>,
    /// One unit normal for each position.
    pub normals: Vec<Vec3>,
    /// One (u, v) for each position, v upwards; empty if the file gives none.
    pub uvs: Vec<Vec2>,
    /// A second set of (u, v), as `uvs`; empty if the file gives none or no texture uses it.
    pub second_uvs: Vec<Vec2>,
    /// For each position the direction along u in which a normal map and anisotropy are oriented: a vector of unit
    /// length, and in w 1 or −1 as w · normal × tangent points along v or against it. All zero where a triangle's own
    /// u and v decide. Empty if no material needs them; see [`super::Scene::complete_tangents`].
    pub tangents: Vec<Vec4>,
    /// Linear red, green, blue and alpha of each position, 0 or more, which multiply what the material says; see
    /// [`super::Material::colored_parts`]. The alpha multiplies [`super::Material::alpha`]. Empty if the file gives none.
    pub colors: Vec<Vec4>,
    /// For each position, an index into [`super::Scene::materials`]. Where the vertices of a triangle
    /// differ, their coefficients are interpolated and the textures of the first one apply.
    pub materials: Vec<u32>,
    /// Indices into the arrays above. The winding determines the geometric normal only.
    pub triangles: Vec<[u32; 3]>,
}

/// The repairs that [`Mesh::repair`] made.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Repairs {
    /// Degenerate triangles that were dropped.
    pub dropped_triangles: usize,
    /// Triangles that were dropped because they name a vertex that does not exist.
    pub dangling_triangles: usize,
    /// Normals without a usable length, recomputed from the adjacent triangles.
    pub recomputed_normals: usize,
}

impl Mesh {
    /// How the arrays do not fit each other, or the number of materials of their scene; `None` if they do.
    pub fn inconsistency(&self, materials: usize) -> Option<String> {
        let vertices = self.positions.len();
        let arrays = [
            ("normals", self.normals.len()),
            ("materials", self.materials.len()),
        ];
        let optional = [
            ("texture coordinates", self.uvs.len()),
            ("second texture coordinates", self.second_uvs.len()),
            ("tangents", self.tangents.len()),
            ("colors", self.colors.len()),
        ];
        let given = optional.into_iter().filter(|(_, count)| *count > 0);
        if let Some((what, count)) =
            (arrays.into_iter().chain(given)).find(|(_, count)| *count != vertices)
        {
            return Some(format!("it has {count} {what} for {vertices} positions"));
        }
        let mut corners = self.triangles.iter().flatten();
        if let Some(corner) = corners.find(|&&corner| corner as usize >= vertices) {
            return Some(format!(
                "a triangle has vertex {corner}, and there are {vertices}"
            ));
        }
        let mut used = self.materials.iter();
        let unknown = used.find(|&&material| material as usize >= materials)?;
        Some(format!(
            "a vertex has material {unknown}, and the scene has {materials}"
        ))
    }

    /// Both sets of texture coordinates.
    pub fn uv_sets_mut(&mut self) -> [&mut Vec<Vec2>; 2] {
        [&mut self.uvs, &mut self.second_uvs]
    }

    /// Adds copies of vertices at the end, in the order of `vertices`, which are indices.
    pub fn copy_vertices(&mut self, vertices: &[u32]) {
        fn copy<T: Copy>(list: &mut Vec<T>, vertices: &[u32]) {
            if !list.is_empty() {
                vertices.iter().for_each(|&i| list.push(list[i as usize]));
            }
        }
        copy(&mut self.positions, vertices);
        copy(&mut self.normals, vertices);
        copy(&mut self.uvs, vertices);
        copy(&mut self.second_uvs, vertices);
        copy(&mut self.tangents, vertices);
        copy(&mut self.colors, vertices);
        copy(&mut self.materials, vertices);
    }

    /// Drops triangles with a vertex that does not exist and those whose area is zero (or below f32's precision),
    /// recomputes missing and zero normals as the area-weighted mean of the adjacent triangles' normals, and normalises the
    /// others.
    ///
    /// `normals` may be shorter than `positions`; the missing ones count as zero and are not reported as
    /// repaired. Positions must be finite.
    pub fn repair(&mut self) -> Repairs {
        let dangling_triangles = self.drop_dangling();
        let before = self.triangles.len();
        let (positions, triangles) = (&self.positions, &self.triangles);
        let has_area = threads::collect(before, |index| {
            area_normal(positions, &triangles[index]).is_some()
        });
        if has_area.contains(&false) {
            let mut has_area = has_area.into_iter();
            self.triangles
                .retain(|_| has_area.next().unwrap_or_default());
        }
        Repairs {
            dropped_triangles: before - self.triangles.len(),
            dangling_triangles,
            ..self.repair_normals()
        }
    }

    /// Drops triangles with a vertex that does not exist, and returns their number.
    fn drop_dangling(&mut self) -> usize {
        let (before, vertices) = (self.triangles.len(), self.positions.len());
        let exist = |triangle: &[u32; 3]| triangle.iter().all(|&i| (i as usize) < vertices);
        self.triangles.retain(exist);
        before - self.triangles.len()
    }

    /// As [`Self::repair`], but keeps triangles without area, which a deformation may give one.
    pub fn repair_normals(&mut self) -> Repairs {
        let dangling_triangles = self.drop_dangling();
        let given_normals = self.normals.len();
        self.normals.resize(self.positions.len(), Vec3::ZERO);
        let positions = &self.positions;
        let lacks_some = AtomicBool::new(false);
        threads::for_chunks(&mut self.normals, |_, normals| {
            for normal in normals {
                let given = normal.as_dvec3();
                let length = given.length();
                if !has_direction(normal) {
                    lacks_some.store(true, Ordering::Relaxed);
                } else if (length - 1.0).abs() > f64::from(f32::EPSILON) {
                    // Others are as near to 1 as f32 allows: they stay, so that a second repair changes nothing.
                    *normal = (given / length).as_vec3();
                }
            }
        });
        let mut recomputed_normals = 0;
        // Nothing else takes as much memory, and most files have all normals.
        if lacks_some.into_inner() {
            let mut area_normals = vec![None::<DVec3>; self.positions.len()];
            for triangle in &self.triangles {
                let normal = area_normal(positions, triangle).unwrap_or_default();
                for &i in triangle {
                    *area_normals[i as usize].get_or_insert_default() += normal;
                }
            }
            let lacking = self.normals.iter_mut().enumerate();
            for (i, normal) in lacking.filter(|(_, normal)| !has_direction(normal)) {
                let around = area_normals[i];
                recomputed_normals += usize::from(i < given_normals && around.is_some());
                let mean = around.and_then(DVec3::try_normalize);
                *normal = mean.unwrap_or(DVec3::Y).as_vec3();
            }
        }
        Repairs {
            dropped_triangles: 0,
            dangling_triangles,
            recomputed_normals,
        }
    }

    /// Centres the vertices on the origin and returns the translation that moves them back. For importers
    /// whose files place vertices far from the origin.
    pub fn from_world_positions<'a, P>(positions: P) -> (Vec<Vec3>, DVec3)
    where
        P: IntoIterator<Item = &'a DVec3, IntoIter: Clone>,
    {
        let positions = positions.into_iter();
        let Some((min, max)) = positions
            .clone()
            .map(|&p| (p, p))
            .reduce(super::posed::union)
        else {
            return (Vec::new(), DVec3::ZERO);
        };
        // Only if the offset costs f32 precision; otherwise the file's numbers are kept.
        let center = (min + max) / 2.0;
        let offset = if center.abs().max_element() > 4.0 * (max - min).max_element() {
            center
        } else {
            DVec3::ZERO
        };
        let local = positions.map(|p| (*p - offset).as_vec3()).collect();
        (local, offset)
    }
}

/// Whether a normal is long enough to be normalised.
fn has_direction(normal: &Vec3) -> bool {
    let length = normal.as_dvec3().length();
    length.is_finite() && length > 1e-30
}

/// The triangle's normal by its winding, of twice its area in length; `None` if the area is below f32's
/// precision. Indices must be in range.
pub fn area_normal(positions: &[Vec3], triangle: &[u32; 3]) -> Option<DVec3> {
    let [a, b, c] = triangle.map(|i| positions[i as usize].as_dvec3());
    let normal = (b - a).cross(c - a);
    let edges = [
        a.distance_squared(b),
        b.distance_squared(c),
        c.distance_squared(a),
    ];
    let longest = edges.into_iter().fold(0.0, f64::max);
    // Below one f32 rounding error of the longest edge, the height is noise.
    (normal.length() > longest * f64::from(f32::EPSILON) * 0.5).then_some(normal)
}
