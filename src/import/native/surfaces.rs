//! The surfaces of a native scene, each in the space of its node: analytic ones, single triangles and
//! the meshes of files.

use super::build::{Builder, normal_matrix};
use super::file::{MeshTable, ObjectTable, TriangleTable};
use super::nodes::Place;
use super::shapes;
use super::values::Vector;
use crate::import::error::ImportError;
use crate::import::source::quote;
use crate::import::{obj, repair_notes};
use crate::scene::{self, Geometry, Instance, Mesh, Repairs, Shape, Space};
use glam::{DAffine3, DVec3, Vec2};
use std::collections::HashMap;
use std::path::{Path, PathBuf};
use toml::Spanned;

/// A mesh file and the material it was given in place of its own.
pub(super) type MeshKey = (PathBuf, Option<usize>);

/// A mesh and where its own origin is; `None` when the file has no triangles.
pub(super) type PlacedMesh = Option<MeshPlace>;

#[derive(Clone, Copy)]
pub(super) struct MeshPlace {
    mesh: usize,
    offset: DVec3,
    /// The largest coordinates, without signs.
    reach: DVec3,
}

/// Triangles that will be one mesh, still without its positions.
#[derive(Default)]
pub(super) struct Triangles {
    mesh: Mesh,
    corners: Vec<DVec3>,
}

impl Builder<'_> {
    /// Adds the surface of an object, and returns points that it reaches to, in the space of its node.
    pub fn surface(
        &mut self,
        index: usize,
        place: Place,
        object: &Spanned<ObjectTable>,
    ) -> Result<Vec<DVec3>, ImportError> {
        let table = object.get_ref();
        if let (Some(_), Some(_)) = (&table.plane, place.node) {
            let why = "a plane cannot move: it is endless";
            let todo = "Take it out of what is animated, looked at, or carries something, or make it a large rectangle";
            return Err(self.refuse(object.span(), why, todo));
        }
        if let Some(triangle) = &table.triangle {
            self.triangle(index, triangle, place, table)
        } else if let Some(mesh) = &table.mesh {
            self.mesh(index, mesh, place, table)
        } else {
            self.shape(index, place, table)
        }
    }

    fn shape(
        &mut self,
        index: usize,
        place: Place,
        table: &ObjectTable,
    ) -> Result<Vec<DVec3>, ImportError> {
        let material = self.material_of(index, table.material.as_ref())?;
        let textured = self.scene.materials[material].textures != scene::Textures::default();
        let placed = place.node_from_here;
        let kind = (textured, place.node.is_some());
        let Some(geometry) = shapes::geometry(table, placed, kind, self.texts)? else {
            return Ok(Vec::new());
        };
        self.scene.shapes.push(Shape {
            geometry,
            material,
            node: place.node,
        });
        Ok(match (geometry, geometry.bounds()) {
            (Geometry::Plane { point, .. }, _) => vec![point],
            (_, Some((min, max))) => vec![min, max],
            (_, None) => Vec::new(),
        })
    }

    fn triangle(
        &mut self,
        index: usize,
        triangle: &TriangleTable,
        place: Place,
        table: &ObjectTable,
    ) -> Result<Vec<DVec3>, ImportError> {
        let placed = place.node_from_here;
        let corners = triangle
            .vertices
            .map(|Vector(p)| placed.transform_point3(p));
        let flat = (corners[1] - corners[0])
            .cross(corners[2] - corners[0])
            .normalize_or(DVec3::Y);
        let turn = normal_matrix(placed);
        let normals = match triangle.normals {
            Some(normals) => normals.map(|n| (turn * n.0).normalize_or(flat)),
            None => [flat; 3],
        };
        let materials = match &triangle.materials {
            None => [self.material_of(index, table.material.as_ref())?; 3],
            Some([a, b, c]) => [
                self.named(a.get_ref(), a.span())?,
                self.named(b.get_ref(), b.span())?,
                self.named(c.get_ref(), c.span())?,
            ],
        };
        let Triangles { mesh, corners: all } = self.triangles.entry(place.node).or_default();
        let first = all.len() as u32;
        all.extend(corners);
        mesh.normals.extend(normals.map(|n| n.as_vec3()));
        mesh.materials.extend(materials.map(|index| index as u32));
        mesh.triangles.push([first, first + 1, first + 2]);
        Ok(corners.to_vec())
    }

    fn mesh(
        &mut self,
        index: usize,
        mesh: &MeshTable,
        place: Place,
        table: &ObjectTable,
    ) -> Result<Vec<DVec3>, ImportError> {
        let read = match self.meshes_of_objects.get(&index) {
            Some(&read) => read,
            None => {
                let read = self.mesh_file(index, mesh, table)?;
                self.meshes_of_objects.insert(index, read);
                read
            }
        };
        let Some(MeshPlace {
            mesh,
            offset,
            reach,
        }) = read
        else {
            return Ok(Vec::new());
        };
        let placement = place.node_from_here * DAffine3::from_translation(offset);
        self.scene.instances.push(Instance {
            mesh,
            placement,
            node: place.node,
        });
        let corner = |i: u8| {
            let side = |bit: u8| if i & bit == 0 { -1.0 } else { 1.0 };
            placement.transform_point3(reach * DVec3::new(side(1), side(2), side(4)))
        };
        Ok((0..8).map(corner).collect())
    }

    fn mesh_file(
        &mut self,
        index: usize,
        mesh: &MeshTable,
        table: &ObjectTable,
    ) -> Result<PlacedMesh, ImportError> {
        let name = mesh.file.get_ref();
        let path = self.files.resolve(name).map_err(|refusal| {
            refusal.into_error("mesh file", |why, todo| {
                self.refuse(mesh.file.span(), why, todo)
            })
        })?;
        let material = match &table.material {
            Some(material) => Some(self.material_of(index, Some(material))?),
            None => None,
        };
        let key = (path, material);
        if let Some(&read) = self.meshes.get(&key) {
            return Ok(read);
        }
        let read = self.read_mesh(&key.0, name, material)?;
        self.meshes.insert(key, read);
        Ok(read)
    }

    fn read_mesh(
        &mut self,
        path: &Path,
        name: &str,
        material: Option<usize>,
    ) -> Result<PlacedMesh, ImportError> {
        let wants_uvs = material.map(|index| self.wants_uvs(index));
        let pictures = &mut self.textures.pictures;
        let mut model = obj::read_model(path, self.files, pictures, wants_uvs)?;
        self.scene.skipped.extend(
            model
                .skipped
                .into_iter()
                .map(|note| format!("{}: {note}", quote(name.as_bytes()))),
        );
        if model.mesh.triangles.is_empty() {
            return Ok(None);
        }
        match material {
            Some(index) => model.mesh.materials.fill(index as u32),
            None => {
                let first = self.scene.materials.len() as u32;
                model
                    .mesh
                    .materials
                    .iter_mut()
                    .for_each(|index| *index += first);
                let first = self.textures.textures.len();
                for material in &mut model.materials {
                    material.textures.shift(first);
                }
                self.textures.textures.append(&mut model.textures);
                self.scene.materials.append(&mut model.materials);
            }
        }
        let positions = model.mesh.positions.iter();
        let reach = positions
            .map(|p| p.as_dvec3().abs())
            .reduce(DVec3::max)
            .unwrap_or_default();
        self.scene.meshes.push(model.mesh);
        Ok(Some(MeshPlace {
            mesh: self.scene.meshes.len() - 1,
            offset: model.offset,
            reach,
        }))
    }

    /// Whether a texture of the material with this index lies on u and v.
    fn wants_uvs(&self, material: usize) -> bool {
        let textures = self.scene.materials[material].textures.all();
        let is_uv = |&index: &usize| self.textures.textures[index].space == Space::Uv;
        textures.iter().flatten().any(is_uv)
    }

    /// Makes meshes of all single triangles: one for each node, unless it is a copy of another.
    pub fn finish_triangles(&mut self) {
        let mut known: HashMap<Vec<u32>, usize> = HashMap::new();
        let mut all = Repairs::default();
        for (node, Triangles { mut mesh, corners }) in std::mem::take(&mut self.triangles) {
            let (positions, offset) = Mesh::from_world_positions(&corners);
            mesh.positions = positions;
            let is_wanted = |&material: &u32| self.wants_uvs(material as usize);
            if mesh.materials.iter().any(is_wanted) {
                // u goes from the first corner to the second, v to the third.
                let own = [Vec2::ZERO, Vec2::X, Vec2::Y];
                mesh.uvs = own.repeat(mesh.triangles.len());
            }
            let repairs = mesh.repair();
            all.dropped_triangles += repairs.dropped_triangles;
            all.recomputed_normals += repairs.recomputed_normals;
            if mesh.triangles.is_empty() {
                continue;
            }
            let numbers = mesh.positions.iter().chain(&mesh.normals);
            let bits = numbers.flat_map(|p| p.to_array()).map(f32::to_bits);
            let contents = bits.chain(mesh.materials.iter().copied()).collect();
            let next = self.scene.meshes.len();
            let index = *known.entry(contents).or_insert(next);
            if index == next {
                self.scene.meshes.push(mesh);
            }
            self.scene.instances.push(Instance {
                mesh: index,
                placement: DAffine3::from_translation(offset),
                node,
            });
        }
        self.scene.skipped.extend(repair_notes(all));
    }
}
