//! Which meshes need tangents, and those that their files do not give.

use super::mikktspace::{self, Surface, Tangents};
use super::{Influences, Material, Mesh, MorphTarget, Scene, Space, Texture};
use crate::threads;
use glam::{DAffine3, DMat3, DVec3, Vec2, Vec3, Vec4};
use std::collections::{BTreeMap, HashMap};
use std::sync::Arc;

/// The texture coordinates that tangents follow: one of the two sets, transformed.
#[derive(Clone, Copy, Debug)]
struct Mapping {
    is_second: bool,
    picture_from_uv: DAffine3,
}

impl Scene {
    /// Gives tangents to the corners of triangles that lack them and whose material has a normal map or anisotropy: by
    /// the rules of MikkTSpace, in the texture coordinates of the normal map. Vertices whose corners get different
    /// tangents are divided. Importers do this last.
    pub fn complete_tangents(&mut self) {
        let mappings = Mappings::new(self);
        if mappings.list.is_empty() {
            return;
        }
        // Nodes may share a mesh.
        let mut places = HashMap::<_, Vec<usize>>::new();
        for (index, mesh) in self.meshes.iter().enumerate() {
            places.entry(Arc::as_ptr(mesh)).or_default().push(index);
        }
        let mut jobs: Vec<(Vec<usize>, Arc<Mesh>)> = Vec::new();
        for places in places.into_values() {
            let mesh = self.meshes[places[0]].clone();
            // A mesh that nothing else holds is changed in place.
            places
                .iter()
                .for_each(|&place| self.meshes[place] = Arc::default());
            jobs.push((places, mesh));
        }
        let mut copies_of = HashMap::new();
        let completed = threads::map(jobs, |(places, mut mesh)| {
            let copies = complete(&mut mesh, &mappings);
            (places, mesh, copies)
        });
        for (places, mesh, copies) in completed {
            let copies: Arc<[u32]> = copies.into();
            for place in places {
                self.meshes[place] = mesh.clone();
                copies_of.insert(place, copies.clone());
            }
        }
        self.deform_copies(&copies_of);
    }

    /// Changes materials or textures. Tangents follow: where the texture coordinates of normal maps lie differently after it,
    /// those of meshes are found anew, also those that their files give. Tangents of surfaces that needed none are
    /// those of the first texture coordinates.
    pub fn change_mappings<T>(&mut self, change: impl FnOnce(&mut Self) -> T) -> T {
        let before = Mappings::new(self);
        let result = change(self);
        let after = Mappings::new(self);
        let is_other = |material: usize| before.axes(material) != after.axes(material);
        let others: Vec<bool> = (0..self.materials.len()).map(is_other).collect();
        let is_new = |material: usize| !before.needs(material) && after.needs(material);
        if others.contains(&true) {
            // Nodes may share a mesh.
            let mut known = HashMap::<_, usize>::new();
            for index in 0..self.meshes.len() {
                match known.get(&Arc::as_ptr(&self.meshes[index])) {
                    Some(first) => self.meshes[index] = self.meshes[*first].clone(),
                    None => {
                        known.insert(Arc::as_ptr(&self.meshes[index]), index);
                        forget(&mut self.meshes[index], &others);
                    }
                }
            }
        }
        if others.contains(&true) || (0..self.materials.len()).any(is_new) {
            self.complete_tangents();
        }
        result
    }

    /// Lets copies of vertices move as these do. What deformations shared, they share again.
    fn deform_copies(&mut self, copies_of: &HashMap<usize, Arc<[u32]>>) {
        let mut targets = Replaced::<[MorphTarget]>::default();
        let mut influences = Replaced::<Influences>::default();
        for deformation in &mut self.deformations {
            let copies = copies_of.get(&deformation.mesh);
            let Some(copies) = copies.filter(|copies| !copies.is_empty()) else {
                continue;
            };
            let first = self.meshes[deformation.mesh].positions.len() - copies.len();
            targets.replace(&mut deformation.targets, |before| {
                let mut all = before.to_vec();
                for target in &mut all {
                    target.copy_vertices(copies, first);
                }
                all.into()
            });
            if let Some(skin) = &mut deformation.skin {
                influences.replace(&mut skin.influences, |before| {
                    let mut all = before.clone();
                    all.copy_vertices(copies);
                    all.into()
                });
            }
        }
    }
}

/// Shared values that were replaced: the old, which is kept so that its address stays in use, and the new.
struct Replaced<T: ?Sized>(HashMap<*const T, [Arc<T>; 2]>);

impl<T: ?Sized> Default for Replaced<T> {
    fn default() -> Self {
        Self(HashMap::new())
    }
}

impl<T: ?Sized> Replaced<T> {
    fn replace(&mut self, value: &mut Arc<T>, make: impl FnOnce(&T) -> Arc<T>) {
        let entry = self.0.entry(Arc::as_ptr(value));
        let [_, new] = entry.or_insert_with(|| [value.clone(), make(value)]);
        *value = new.clone();
    }
}

/// The mappings of a scene.
#[derive(Default)]
struct Mappings {
    list: Vec<Mapping>,
    /// Indices into `list`; `None` for materials that need no tangents.
    of_materials: Vec<Option<usize>>,
}

impl Mappings {
    fn new(scene: &Scene) -> Self {
        let mut mappings = Self::default();
        let mut known = HashMap::new();
        for material in &scene.materials {
            let place = mapping(material, &scene.textures).map(|mapping| {
                let bits = mapping.picture_from_uv.to_cols_array().map(f64::to_bits);
                *known.entry((mapping.is_second, bits)).or_insert_with(|| {
                    mappings.list.push(mapping);
                    mappings.list.len() - 1
                })
            });
            mappings.of_materials.push(place);
        }
        mappings
    }

    /// Whether the surfaces of a material need tangents.
    fn needs(&self, material: usize) -> bool {
        self.of_materials.get(material).is_some_and(Option::is_some)
    }

    /// The directions of a material's tangents depend on this: the set of texture coordinates, and the axes of the picture.
    fn axes(&self, material: usize) -> (bool, DMat3) {
        let mapping = self.of_materials.get(material).copied().flatten();
        mapping.map_or((false, DMat3::IDENTITY), |mapping| {
            let Mapping {
                is_second,
                picture_from_uv,
            } = self.list[mapping];
            (is_second, picture_from_uv.matrix3)
        })
    }
}

/// Removes the tangents of triangles of these materials.
fn forget(mesh: &mut Arc<Mesh>, of_materials: &[bool]) {
    let is_it = |triangle: &[u32; 3]| {
        let material = mesh.materials[triangle[0] as usize];
        of_materials[material as usize]
    };
    if mesh.tangents.is_empty() || !mesh.triangles.iter().any(is_it) {
        return;
    }
    let triangles: Vec<[u32; 3]> = mesh.triangles.iter().copied().filter(is_it).collect();
    let tangents = &mut Arc::make_mut(mesh).tangents;
    for vertex in triangles.into_iter().flatten() {
        tangents[vertex as usize] = Vec4::ZERO;
    }
}

/// The mapping that the tangents of a material's surfaces follow; `None` if it needs none.
fn mapping(material: &Material, textures: &[Texture]) -> Option<Mapping> {
    let of_texture = |index: usize| {
        let texture = &textures[index];
        (texture.space != Space::World).then_some(Mapping {
            is_second: texture.space == Space::SecondUv,
            picture_from_uv: texture.pattern_from_space,
        })
    };
    let model = material.metallic_roughness();
    let plain = Mapping {
        is_second: false,
        picture_from_uv: DAffine3::IDENTITY,
    };
    let anisotropy = model.and_then(|model| (model.anisotropy > 0.0).then_some(plain));
    let normal = material.textures.normal.and_then(of_texture);
    let coat = model.and_then(|model| model.textures.clearcoat_normal);
    normal.or(coat.and_then(of_texture)).or(anisotropy)
}

/// Gives a mesh the tangents that materials with these mappings need. Returns the vertices of which copies were added.
fn complete(mesh: &mut Arc<Mesh>, mappings: &Mappings) -> Vec<u32> {
    let is_given = |vertex: u32| {
        let tangent = mesh.tangents.get(vertex as usize);
        tangent.is_some_and(|tangent| *tangent != Vec4::ZERO)
    };
    let mut parts = BTreeMap::<usize, Vec<usize>>::new();
    for (index, triangle) in mesh.triangles.iter().enumerate() {
        // The textures of the first corner's material apply.
        let material = mesh.materials[triangle[0] as usize] as usize;
        if let Some(mapping) = mappings.of_materials[material]
            && !triangle.iter().all(|&vertex| is_given(vertex))
        {
            parts.entry(mapping).or_default().push(index);
        }
    }
    parts.retain(|&mapping, _| !uvs(mesh, mappings.list[mapping].is_second).is_empty());
    if parts.is_empty() {
        return Vec::new();
    }
    let mesh = Arc::make_mut(mesh);
    let count = mesh.positions.len();
    mesh.tangents.resize(count, Vec4::ZERO);
    let mut divided = Divided::new(std::mem::take(&mut mesh.tangents));
    let mut places = vec![u32::MAX; count];
    for (mapping, part) in parts {
        let found = Part::new(mesh, &mappings.list[mapping], &part, &mut places).tangents();
        for (&index, tangents) in part.iter().zip(&found.of_corners) {
            for (corner, &tangent) in mesh.triangles[index].iter_mut().zip(tangents) {
                let tangent = found.list.get(tangent as usize);
                *corner = divided.vertex(*corner, tangent.copied().unwrap_or(Vec4::ZERO));
            }
        }
    }
    let Divided {
        tangents, copies, ..
    } = divided;
    mesh.copy_vertices(&copies);
    mesh.tangents = tangents;
    copies
}

fn uvs(mesh: &Mesh, is_second: bool) -> &[Vec2] {
    match is_second && !mesh.second_uvs.is_empty() {
        true => &mesh.second_uvs,
        false => &mesh.uvs,
    }
}

/// Triangles of a mesh that share a mapping.
#[derive(Default)]
struct Part {
    positions: Vec<Vec3>,
    normals: Vec<Vec3>,
    uvs: Vec<Vec2>,
    triangles: Vec<[u32; 3]>,
}

impl Part {
    /// `places` has `u32::MAX` for each vertex of the mesh, before and after.
    fn new(mesh: &Mesh, mapping: &Mapping, triangles: &[usize], places: &mut [u32]) -> Self {
        let mut part = Self::default();
        let uvs = uvs(mesh, mapping.is_second);
        let mut vertices = Vec::new();
        let mut place = |vertex: u32| {
            let i = vertex as usize;
            if places[i] == u32::MAX {
                places[i] = vertices.len() as u32;
                vertices.push(vertex);
                part.positions.push(mesh.positions[i]);
                part.normals.push(mesh.normals[i]);
                let uv = DVec3::new(uvs[i].x.into(), uvs[i].y.into(), 0.0);
                let uv = mapping.picture_from_uv.transform_point3(uv);
                part.uvs.push(uv.truncate().as_vec2());
            }
            places[i]
        };
        let corners = triangles.iter().map(|&index| mesh.triangles[index]);
        part.triangles = corners.map(|corners| corners.map(&mut place)).collect();
        for vertex in vertices {
            places[vertex as usize] = u32::MAX;
        }
        part
    }

    fn tangents(&self) -> Tangents {
        mikktspace::tangents(Surface {
            positions: &self.positions,
            normals: &self.normals,
            uvs: &self.uvs,
            triangles: &self.triangles,
        })
    }
}

/// Vertices that are divided where their corners differ in tangent.
struct Divided {
    /// Tangents of all vertices and copies.
    tangents: Vec<Vec4>,
    /// Whether the tangent of a vertex was determined.
    is_set: Vec<bool>,
    /// The vertices of which there are copies, by copy.
    copies: Vec<u32>,
    /// The copies with a tangent, by vertex and bits.
    known: HashMap<(u32, [u32; 4]), u32>,
    /// Index of the first copy.
    first: usize,
}

impl Divided {
    fn new(tangents: Vec<Vec4>) -> Self {
        Self {
            is_set: tangents.iter().map(|it| *it != Vec4::ZERO).collect(),
            copies: Vec::new(),
            known: HashMap::new(),
            first: tangents.len(),
            tangents,
        }
    }

    /// The vertex for a corner at `vertex` with this tangent: itself if it is the first to get one, otherwise a copy.
    fn vertex(&mut self, vertex: u32, tangent: Vec4) -> u32 {
        let i = vertex as usize;
        if !std::mem::replace(&mut self.is_set[i], true) {
            self.tangents[i] = tangent;
        }
        if self.tangents[i] == tangent {
            return vertex;
        }
        let bits = tangent.to_array().map(f32::to_bits);
        *self.known.entry((vertex, bits)).or_insert_with(|| {
            self.tangents.push(tangent);
            self.copies.push(vertex);
            (self.first + self.copies.len() - 1) as u32
        })
    }
}
