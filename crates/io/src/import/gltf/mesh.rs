//! Primitives to triangles (section 3.7.2 of the specification). All primitives of a mesh become one mesh
//! with a material at each vertex.

use super::Reader;
use super::blame::Blame;
use super::deform::{Modelled, Sources, Wanted};
use super::document::{Kind, Node, Primitive};
use super::materials::MaterialKey;
use crate::import::budget;
use crate::import::error::ImportError;
use crate::import::notes;
use crate::import::rounding;
use crate::import::tangent::tangent;
use crate::import::uvs;
use glam::{Vec2, Vec3, Vec4};
use glimray_scene::Mesh;
use std::collections::HashSet;
use std::fmt::Display;

/// Key of a node's still mesh: its number in the file, its skin, and the bits of its weights.
pub(super) type MeshKey = (usize, Option<usize>, Vec<u64>);

/// The attributes of one primitive, one of each per vertex if there are any.
struct Vertices {
    positions: Vec<Vec3>,
    normals: Vec<Vec3>,
    /// The first and the second set that the material uses.
    uvs: [Vec<Vec2>; 2],
    colors: Vec<Vec4>,
    /// Zero where the file's have no direction.
    tangents: Vec<Vec4>,
    /// Vertices whose position is not finite.
    broken: HashSet<u32>,
}

impl Vertices {
    /// Gives every corner of `triangles` a vertex of its own, with the normal of the triangle, whose
    /// front is where it is counter-clockwise. Returns the vertices that they were.
    fn flatten(&mut self, triangles: &mut [[u32; 3]]) -> Vec<u32> {
        fn spread<T: Copy>(values: &mut Vec<T>, corners: &[u32]) {
            if !values.is_empty() {
                *values = corners.iter().map(|&i| values[i as usize]).collect();
            }
        }
        let corners = triangles.as_flattened_mut();
        spread(&mut self.positions, corners);
        for uvs in &mut self.uvs {
            spread(uvs, corners);
        }
        spread(&mut self.colors, corners);
        // Tangents in the file are for normals in the file.
        self.tangents = Vec::new();
        self.normals = Vec::with_capacity(corners.len());
        for corners in self.positions.chunks_exact(3) {
            let [a, b, c] = [corners[0], corners[1], corners[2]].map(|p| p.as_dvec3());
            // Triangles without area are dropped later.
            let normal = (b - a).cross(c - a).normalize_or_zero().as_vec3();
            self.normals.extend([normal; 3]);
        }
        let sources = corners.to_vec();
        for (i, corner) in corners.iter_mut().enumerate() {
            *corner = i as u32;
        }
        sources
    }
}

impl Reader<'_> {
    /// The index in the scene of the triangles of the mesh of `source`, in its pose at rest and in world
    /// space if it has a skin; `None` if it has none.
    pub(super) fn mesh(
        &mut self,
        index: usize,
        source: &Node,
        place: &str,
    ) -> Result<Option<usize>, ImportError> {
        let weights = self.weights_of(source);
        let bits = weights.iter().map(|weight| weight.to_bits()).collect();
        let key: MeshKey = (index, source.skin, bits);
        if let Some(known) = self.meshes.get(&key) {
            return Ok(*known);
        }
        let joints = self.skin_of(source, place)?;
        let wanted = Wanted {
            weights: Some(&weights),
            is_skinned: joints.is_some(),
        };
        let modelled = self.modelled(index, wanted, place)?;
        let is_posed = joints.is_some() || weights.iter().any(|weight| *weight != 0.0);
        let mut mesh = match is_posed {
            true => {
                let here = format!("meshes[{index}]");
                self.posed(modelled, joints, weights, &here)?
            }
            false => modelled.mesh,
        };
        rounding::note_lost_light(&mut self.notes, &mesh, &self.scene.materials);
        let repairs = mesh.repair();
        notes::of_repairs(&mut self.notes, repairs);
        let found = (!mesh.triangles.is_empty()).then(|| {
            self.scene.meshes.push(mesh.into());
            self.scene.meshes.len() - 1
        });
        self.meshes.insert(key, found);
        Ok(found)
    }

    /// `meshes[index]` as it was modelled, and what may deform it.
    pub(super) fn modelled(
        &mut self,
        index: usize,
        wanted: Wanted,
        place: &str,
    ) -> Result<Modelled, ImportError> {
        let document = self.document;
        let source = self.blame.get(&document.meshes, index, "meshes", place)?;
        let mut modelled = Modelled::default();
        modelled.mesh.name = source.name.clone().unwrap_or_default();
        for (i, primitive) in source.primitives.iter().enumerate() {
            let here = format!("meshes[{index}].primitives[{i}]");
            let added = self.primitive(&mut modelled, primitive, wanted, &here);
            self.spared(added)?;
        }
        Ok(modelled)
    }

    fn primitive(
        &mut self,
        modelled: &mut Modelled,
        primitive: &Primitive,
        wanted: Wanted,
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
        self.reserve(&modelled.mesh, primitive, count, here)?;
        let material = self.material_of(primitive, here)?;
        let mut vertices = self.vertices(primitive, positions, &material, here)?;
        let count = vertices.positions.len();
        let mut triangles = self.triangles(primitive, count, &vertices.broken, here)?;
        let first = modelled.mesh.positions.len();
        if first + count.max(3 * triangles.len()) > u32::MAX as usize {
            return Err(self.blame.bad(here, "the mesh has more than 2³² vertices"));
        }
        let corners = vertices.normals.is_empty().then(|| {
            let corners = vertices.flatten(&mut triangles);
            modelled.flat.push(first..first + corners.len());
            corners
        });
        let sources = Sources { count, corners };
        let targets = &mut modelled.targets;
        let wanted_targets = (wanted.weights, !vertices.tangents.is_empty());
        self.add_targets(targets, primitive, wanted_targets, (first, &sources), here)?;
        if wanted.is_skinned {
            self.add_influences(&mut modelled.influences, primitive, &sources, here)?;
        }
        let mesh = &mut modelled.mesh;
        let shift = |triangle: [u32; 3]| triangle.map(|i| first as u32 + i);
        mesh.triangles.extend(triangles.into_iter().map(shift));
        let count = vertices.positions.len();
        let material = self.scene_material(material)?;
        (mesh.materials).extend(std::iter::repeat_n(material, count));
        for (uvs, own) in (mesh.uv_sets_mut().into_iter()).zip(&vertices.uvs) {
            if !own.is_empty() {
                uvs.resize(first, Vec2::ZERO);
                uvs.extend(own);
            }
        }
        if !vertices.tangents.is_empty() {
            mesh.tangents.resize(first, Vec4::ZERO);
            mesh.tangents.extend(&vertices.tangents);
        }
        if !vertices.colors.is_empty() {
            mesh.colors.resize(first, Vec4::ONE);
            mesh.colors.extend(&vertices.colors);
        }
        mesh.positions.extend(&vertices.positions);
        mesh.normals.extend(&vertices.normals);
        let count = mesh.positions.len();
        if !mesh.tangents.is_empty() {
            mesh.tangents.resize(count, Vec4::ZERO);
        }
        if !mesh.colors.is_empty() {
            mesh.colors.resize(count, Vec4::ONE);
        }
        for uvs in mesh.uv_sets_mut() {
            if !uvs.is_empty() {
                uvs.resize(count, Vec2::ZERO);
            }
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
        type Vertex = (Vec3, Vec3, [Vec2; 2], [Vec4; 2], u32);
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
        let mut positions = accessors.vectors::<3>(positions, &[Kind::Vec3], 0.0, &at)?;
        let count = positions.len();
        let whole = positions.iter().find(|p| p.iter().all(|x| x.is_finite()));
        let Some(&whole) = whole else {
            return Err(self.blame.bad(at, "no position is finite"));
        };
        let mut broken = HashSet::new();
        for (i, position) in positions.iter_mut().enumerate() {
            if !position.iter().all(|x| x.is_finite()) {
                *position = whole;
                broken.insert(i as u32);
            }
        }
        let attribute = |name: &str| primitive.attributes.get(name).copied();
        let blame = self.blame;
        let mut normals = Vec::new();
        if let Some(index) = attribute("NORMAL") {
            let found = accessors.vectors::<3>(index, &[Kind::Vec3], 0.0, &place("NORMAL"));
            let found = found.and_then(|it| of_count(it, count, place("NORMAL"), blame));
            normals = self.spared(found)?.unwrap_or_default();
        }
        let mut sets = [Vec::new(), Vec::new()];
        for (values, set) in sets.iter_mut().zip(self.uv_sets(material)) {
            let name = format!("TEXCOORD_{set}");
            match attribute(&name) {
                Some(index) => {
                    let found = accessors.vectors::<2>(index, &[Kind::Vec2], 0.0, &place(&name));
                    let found = found.and_then(|it| of_count(it, count, place(&name), blame));
                    *values = self.spared(found)?.unwrap_or_default();
                }
                None => self.notes.add("meshes without texture coordinates", || {
                    format!("{here} has no {name}: each texture shows a single colour")
                }),
            }
        }
        let mut colors = Vec::new();
        if let Some(index) = attribute("COLOR_0") {
            let place = place("COLOR_0");
            let found = self.colors(index, material, &place);
            let found = found.and_then(|it| of_count(it, count, &place, blame));
            colors = self.spared(found)?.unwrap_or_default();
            if self.accessors().most_unless_normalized(index).is_some() {
                self.notes.add("vertex colours", || {
                    format!("{place} is not marked as normalised, and read as if it were")
                });
            }
            if colors.iter().all(|color| *color == Vec4::ONE) {
                colors = Vec::new();
            }
        }
        let accessors = self.accessors();
        let mut tangents = Vec::new();
        if let Some(index) = attribute("TANGENT")
            && self.has_tangents(material)
        {
            let found = accessors.vectors::<4>(index, &[Kind::Vec4], 1.0, &place("TANGENT"));
            let found = found.and_then(|it| of_count(it, count, place("TANGENT"), blame));
            tangents = self.spared(found)?.unwrap_or_default();
        }
        let mut lost = 0;
        // glTF's v points down.
        let mut uv = |uv: [f32; 2]| {
            let [u, v] = uv.map(|x| uvs::in_range(x.into(), &mut lost) as f32);
            Vec2::new(u, 1.0 - v)
        };
        let sets = sets.map(|set| set.into_iter().map(&mut uv).collect());
        uvs::note(lost, &mut self.notes);
        Ok(Vertices {
            positions: positions.into_iter().map(Vec3::from).collect(),
            normals: normals.into_iter().map(Vec3::from).collect(),
            uvs: sets,
            colors,
            broken,
            tangents: (tangents.into_iter().map(|t| tangent(t.map(f64::from)))).collect(),
        })
    }

    /// The colours of vertices in `accessors[index]`, to which `place` refers; with an alpha of 1 where it has no effect.
    fn colors(
        &self,
        index: usize,
        material: &MaterialKey,
        place: &str,
    ) -> Result<Vec<Vec4>, ImportError> {
        let accessors = self.accessors();
        let kinds = [Kind::Vec3, Kind::Vec4];
        let mut colors = accessors.vectors::<4>(index, &kinds, 1.0, place)?;
        if let Some(most) = accessors.most_unless_normalized(index) {
            let scaled = colors.as_flattened_mut().iter_mut();
            scaled.for_each(|value| *value /= most);
        }
        if !self.has_alpha(material) {
            colors.iter_mut().for_each(|color| color[3] = 1.0);
        }
        Ok(colors.into_iter().map(Vec4::from).collect())
    }

    /// The triangles of a primitive with `count` vertices, without those at `broken` ones.
    fn triangles(
        &mut self,
        primitive: &Primitive,
        count: usize,
        broken: &HashSet<u32>,
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
        let mut triangles: Vec<_> = match primitive.mode {
            5 => windows()
                .enumerate()
                .map(|(i, [a, b, c])| if i % 2 == 0 { [a, b, c] } else { [a, c, b] })
                .collect(),
            6 => (indices.get(1..).unwrap_or_default().windows(2))
                .map(|w| [w[0], w[1], indices[0]])
                .collect(),
            _ => indices.as_chunks::<3>().0.to_vec(),
        };
        let is_whole = |index: &u32| (*index as usize) < count && !broken.contains(index);
        let before = triangles.len();
        triangles.retain(|corners| corners.iter().all(is_whole));
        let dropped = before - triangles.len();
        if dropped > 0 {
            let why = match indices.iter().find(|index| **index as usize >= count) {
                Some(index) => {
                    format!("the index {index} is not below the number of vertices, {count}")
                }
                None => format!("{} positions are not finite", broken.len()),
            };
            if triangles.is_empty() {
                return Err(self.blame.bad(place, why));
            }
            self.notes.add("meshes with lost triangles", || {
                format!("{here}: {dropped} of {before} triangles left out: {why}")
            });
        }
        Ok(triangles)
    }
}

/// `values`, if there is one for each of `count` vertices.
fn of_count<T>(
    values: Vec<T>,
    count: usize,
    place: impl Display,
    blame: Blame,
) -> Result<Vec<T>, ImportError> {
    match values.len() == count {
        true => Ok(values),
        false => {
            let why = format!("{} values for {count} vertices", values.len());
            Err(blame.bad(place, why))
        }
    }
}
