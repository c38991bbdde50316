//! Primitives to triangles (section 3.7.2 of the specification). All primitives of a mesh become one mesh
//! with a material at each vertex.

use super::Reader;
use super::document::{Kind, Primitive};
use super::materials::MaterialKey;
use crate::import::budget;
use crate::import::error::ImportError;
use crate::import::notes;
use crate::scene::Mesh;
use glam::{DAffine3, Vec2, Vec3, Vec4};

/// The attributes of one primitive, one of each per vertex if there are any.
struct Vertices {
    positions: Vec<Vec3>,
    normals: Vec<Vec3>,
    uvs: Vec<Vec2>,
    colors: Vec<Vec4>,
}

impl Vertices {
    /// Gives every corner of `triangles` a vertex of its own, with the normal of the triangle, whose
    /// front is where it is counter-clockwise.
    fn flatten(&mut self, triangles: &mut [[u32; 3]]) {
        fn spread<T: Copy>(values: &mut Vec<T>, corners: &[u32]) {
            if !values.is_empty() {
                *values = corners.iter().map(|&i| values[i as usize]).collect();
            }
        }
        let corners = triangles.as_flattened_mut();
        spread(&mut self.positions, corners);
        spread(&mut self.uvs, corners);
        spread(&mut self.colors, corners);
        self.normals = Vec::with_capacity(corners.len());
        for corners in self.positions.chunks_exact(3) {
            let [a, b, c] = [corners[0], corners[1], corners[2]].map(|p| p.as_dvec3());
            // Triangles without area are dropped later.
            let normal = (b - a).cross(c - a).normalize_or_zero().as_vec3();
            self.normals.extend([normal; 3]);
        }
        for (i, corner) in corners.iter_mut().enumerate() {
            *corner = i as u32;
        }
    }
}

impl Reader<'_> {
    /// The index in the scene of the triangles of `meshes[index]`, in world space if it has a skin;
    /// `None` if it has none.
    pub(super) fn mesh(
        &mut self,
        index: usize,
        skin: Option<usize>,
        place: &str,
    ) -> Result<Option<usize>, ImportError> {
        if let Some(known) = self.meshes.get(&(index, skin)) {
            return Ok(*known);
        }
        let joints = match skin {
            Some(skin) => Some(self.joints(skin, place)?),
            None => None,
        };
        let document = self.document;
        let source = self.blame.get(&document.meshes, index, "meshes", place)?;
        let mut mesh = Mesh {
            name: source.name.clone().unwrap_or_default(),
            ..Mesh::default()
        };
        for (i, primitive) in source.primitives.iter().enumerate() {
            let here = format!("meshes[{index}].primitives[{i}]");
            let (weights, joints) = (source.weights.as_deref(), joints.as_deref());
            self.primitive(&mut mesh, primitive, weights, joints, &here)?;
        }
        let repairs = mesh.repair();
        notes::of_repairs(&mut self.notes, repairs);
        let found = (!mesh.triangles.is_empty()).then(|| {
            self.scene.meshes.push(mesh.into());
            self.scene.meshes.len() - 1
        });
        self.meshes.insert((index, skin), found);
        Ok(found)
    }

    fn primitive(
        &mut self,
        mesh: &mut Mesh,
        primitive: &Primitive,
        weights: Option<&[f64]>,
        joints: Option<&[DAffine3]>,
        here: &str,
    ) -> Result<(), ImportError> {
        let kind = match primitive.mode {
            0 => Some("points"),
            1..=3 => Some("lines"),
            4..=6 => None,
            mode => return Err(self.blame.bad(here, format_args!("mode {mode} is unknown"))),
        };
        if let Some(kind) = kind {
            self.notes
                .add("skipped primitives", || format!("{kind} skipped: {here}"));
            return Ok(());
        }
        let Some(&positions) = primitive.attributes.get("POSITION") else {
            self.notes.add("skipped primitives", || {
                format!("a primitive without positions skipped: {here}")
            });
            return Ok(());
        };
        let count = self.accessors().count(positions, here)?;
        self.reserve(mesh, primitive, count, here)?;
        let material = self.material_of(primitive, here)?;
        let mut vertices = self.vertices(primitive, positions, &material, here)?;
        self.morph(&mut vertices, primitive, weights, here)?;
        if let Some(joints) = joints {
            let Vertices {
                positions, normals, ..
            } = &mut vertices;
            self.pose(positions, normals, primitive, joints, here)?;
        }
        let mut triangles = self.triangles(primitive, vertices.positions.len(), here)?;
        if vertices.normals.is_empty() {
            vertices.flatten(&mut triangles);
        }
        let first = mesh.positions.len();
        if first + vertices.positions.len() > u32::MAX as usize {
            return Err(self.blame.bad(here, "the mesh has more than 2³² vertices"));
        }
        let shift = |triangle: [u32; 3]| triangle.map(|i| first as u32 + i);
        mesh.triangles.extend(triangles.into_iter().map(shift));
        let count = vertices.positions.len();
        self.paint(&mut mesh.materials, count, &vertices.colors, material)?;
        if !vertices.uvs.is_empty() {
            mesh.uvs.resize(first, Vec2::ZERO);
            mesh.uvs.extend(&vertices.uvs);
        }
        mesh.positions.extend(&vertices.positions);
        mesh.normals.extend(&vertices.normals);
        if !mesh.uvs.is_empty() {
            mesh.uvs.resize(mesh.positions.len(), Vec2::ZERO);
        }
        Ok(())
    }

    /// Checks that the triangles of a primitive with `count` positions fit into the budget.
    fn reserve(
        &self,
        mesh: &Mesh,
        primitive: &Primitive,
        count: u64,
        here: &str,
    ) -> Result<(), ImportError> {
        type Vertex = (Vec3, Vec3, Vec2, u32);
        let corners = match primitive.indices {
            Some(indices) => self.accessors().count(indices, here)?,
            None => count,
        };
        let triangles = match primitive.mode {
            4 => corners / 3,
            _ => corners,
        };
        let vertices = match primitive.attributes.contains_key("NORMAL") {
            true => count,
            false => triangles.saturating_mul(3),
        };
        let bytes = |count: u64, size: usize| count.saturating_mul(size as u64);
        let stays = bytes(vertices, size_of::<Vertex>())
            .saturating_add(bytes(triangles, size_of::<[u32; 3]>()));
        // The accessors' values, and the arrays of the mesh while they grow.
        let transient = stays
            .saturating_add(budget::size::<Vertex>(mesh.positions.len()))
            .saturating_add(bytes(corners, size_of::<u32>()));
        self.ledger.take(stays, transient, here)
    }

    fn vertices(
        &mut self,
        primitive: &Primitive,
        positions: usize,
        material: &MaterialKey,
        here: &str,
    ) -> Result<Vertices, ImportError> {
        let accessors = self.accessors();
        let place = |name: &str| format!("{here}.attributes.{name}");
        let at = place("POSITION");
        let positions = accessors.vectors::<3>(positions, &[Kind::Vec3], 0.0, &at)?;
        let count = positions.len();
        if let Some(i) = (positions.iter()).position(|p| !p.iter().all(|x| x.is_finite())) {
            let why = format!("the position of vertex {i} is not finite");
            return Err(self.blame.bad(at, why));
        }
        let attribute = |name: &str| primitive.attributes.get(name).copied();
        let same_count = |have: usize, name: &str| match have == count {
            true => Ok(()),
            false => {
                let why = format!("{have} values for {count} vertices");
                Err(self.blame.bad(place(name), why))
            }
        };
        let mut normals = Vec::new();
        if let Some(index) = attribute("NORMAL") {
            normals = accessors.vectors::<3>(index, &[Kind::Vec3], 0.0, &place("NORMAL"))?;
            same_count(normals.len(), "NORMAL")?;
        }
        let mut uvs = Vec::new();
        if let Some(set) = self.uv_set(material) {
            let name = format!("TEXCOORD_{set}");
            match attribute(&name) {
                Some(index) => {
                    uvs = accessors.vectors::<2>(index, &[Kind::Vec2], 0.0, &place(&name))?;
                    same_count(uvs.len(), &name)?;
                }
                None => self.notes.add("meshes without texture coordinates", || {
                    format!("{here} has no {name}: each texture shows a single colour")
                }),
            }
        }
        let accessors = self.accessors();
        let mut colors = Vec::new();
        if let Some(index) = attribute("COLOR_0") {
            let kinds = [Kind::Vec3, Kind::Vec4];
            colors = accessors.vectors::<4>(index, &kinds, 1.0, &place("COLOR_0"))?;
            same_count(colors.len(), "COLOR_0")?;
        }
        // glTF's v points down. Beyond 1e9, f32 has whole numbers only, and all are equivalent.
        let uv = |[u, v]: [f32; 2]| {
            let place = |x: f32| if x.is_nan() { 0.0 } else { x.clamp(-1e9, 1e9) };
            Vec2::new(place(u), 1.0 - place(v))
        };
        Ok(Vertices {
            positions: positions.into_iter().map(Vec3::from).collect(),
            normals: normals.into_iter().map(Vec3::from).collect(),
            uvs: uvs.into_iter().map(uv).collect(),
            colors: colors.into_iter().map(Vec4::from).collect(),
        })
    }

    /// Adds the morph targets with their default weights.
    fn morph(
        &mut self,
        vertices: &mut Vertices,
        primitive: &Primitive,
        weights: Option<&[f64]>,
        here: &str,
    ) -> Result<(), ImportError> {
        for (i, target) in primitive.targets.iter().enumerate() {
            let weight = weights
                .and_then(|weights| weights.get(i))
                .copied()
                .unwrap_or(0.0) as f32;
            if weight == 0.0 {
                continue;
            }
            for (name, values) in [
                ("POSITION", &mut vertices.positions),
                ("NORMAL", &mut vertices.normals),
            ] {
                let Some(&index) = target.get(name) else {
                    continue;
                };
                let at = format!("{here}.targets[{i}].{name}");
                let moved = self
                    .accessors()
                    .vectors::<3>(index, &[Kind::Vec3], 0.0, &at)?;
                if moved.len() != values.len() && !values.is_empty() {
                    return Err(self
                        .blame
                        .bad(at, "a target for another number of vertices"));
                }
                for (value, moved) in values.iter_mut().zip(moved) {
                    let value_then = *value + weight * Vec3::from(moved);
                    if !value_then.is_finite() {
                        return Err(self.blame.bad(at, "a displacement is not finite"));
                    }
                    *value = value_then;
                }
            }
        }
        Ok(())
    }

    /// The triangles of a primitive with `count` vertices.
    fn triangles(
        &mut self,
        primitive: &Primitive,
        count: usize,
        here: &str,
    ) -> Result<Vec<[u32; 3]>, ImportError> {
        let place = format!("{here}.indices");
        let indices = match primitive.indices {
            Some(indices) => self.accessors().indices(indices, &place)?,
            None if count > u32::MAX as usize => {
                return Err(self.blame.bad(here, "more than 2³² vertices"));
            }
            None => (0..count as u32).collect(),
        };
        if let Some(index) = indices.iter().find(|&&index| index as usize >= count) {
            let why = format!("the index {index} is not below the number of vertices, {count}");
            return Err(self.blame.bad(place, why));
        }
        let rest = match primitive.mode {
            4 => indices.len() % 3,
            _ if indices.len() < 3 => indices.len(),
            _ => 0,
        };
        if rest > 0 {
            self.notes.add("incomplete triangles", || {
                format!("the last {rest} corners of {here} make no triangle")
            });
        }
        let windows = || indices.windows(3).map(|w| [w[0], w[1], w[2]]);
        Ok(match primitive.mode {
            5 => windows()
                .enumerate()
                .map(|(i, [a, b, c])| if i % 2 == 0 { [a, b, c] } else { [a, c, b] })
                .collect(),
            6 => (indices.get(1..).unwrap_or_default().windows(2))
                .map(|w| [w[0], w[1], indices[0]])
                .collect(),
            _ => indices.as_chunks::<3>().0.to_vec(),
        })
    }
}
