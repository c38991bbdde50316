//! The surfaces of a native scene, each in the space of its node: analytic shapes, single triangles, and
//! meshes from files.

use super::Builder;
use crate::import::error::ImportError;
use crate::import::native::file::Spanned;
use crate::import::native::file::{MeshOrName, MeshTable, ObjectTable, TriangleTable};
use crate::import::native::nodes::NodePlacement;
use crate::import::native::shapes;
use crate::import::native::transforms::{chain, normal_matrix};
use crate::import::native::values::{Triple, Vector};
use crate::import::notes::{self, Notes};
use crate::import::rounding;
use crate::import::source::quote;
use crate::import::{MAX_GEOMETRY_BYTES, obj, ply, suggest};
use glam::{DAffine3, DVec3, Vec2};
use glimray_scene::{Geometry, Instance, Mesh, Repairs, Shape, Space};
use std::collections::HashMap;
use std::path::{Path, PathBuf};
use std::sync::Arc;

/// A mesh file, and the materials that replace its own.
pub(super) type MeshKey = (PathBuf, Vec<usize>);

/// A mesh and the translation of its origin; `None` if the file has no triangles.
pub(super) type PlacedMesh = Option<MeshPlace>;

#[derive(Clone, Copy)]
pub(super) struct MeshPlace {
    mesh: usize,
    offset: DVec3,
    /// The largest absolute coordinates.
    reach: DVec3,
}

/// Triangles that will become one mesh, without their positions.
#[derive(Default)]
pub(super) struct Triangles {
    mesh: Mesh,
    corners: Vec<DVec3>,
}

impl Builder<'_> {
    /// Adds the surface of an object, and returns points on its bounds, in the space of its node.
    pub fn surface(
        &mut self,
        index: usize,
        place: NodePlacement,
        object: &Spanned<ObjectTable>,
    ) -> Result<Vec<DVec3>, ImportError> {
        let table = object.get_ref();
        if let (Some(_), Some(node)) = (&table.plane, place.node)
            && !self.nodes.is_fixed(node)
        {
            let why = "a plane is infinite and cannot move";
            let todo =
                "Do not animate it, attach anything to it or look at it, or use a large rectangle";
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
        place: NodePlacement,
        table: &ObjectTable,
    ) -> Result<Vec<DVec3>, ImportError> {
        let material = self.material_of(index, table.material.as_ref())?;
        let textured = (self.scene.materials[material].texture_indices())
            .next()
            .is_some();
        let placed = place.node_from_here;
        let kind = (textured, place.node.is_some() && table.carried_by.is_none());
        let Some(geometry) = shapes::geometry(table, placed, kind, self.texts)? else {
            return Ok(Vec::new());
        };
        self.scene.shapes.push(Shape {
            geometry,
            material,
            node: place.node,
            name: self.name_of(index),
        });
        Ok(match (geometry, geometry.bounds()) {
            (Geometry::Plane { point, .. }, _) => vec![point],
            (_, Some((min, max))) => vec![min, max],
            (_, None) => Vec::new(),
        })
    }

    /// The name of the object with this index. A node that it has bears the name instead.
    fn name_of(&self, index: usize) -> String {
        let object = self.objects.get(index);
        let name = object.table.name.as_ref().filter(|_| !object.has_node);
        name.map_or_else(String::new, |name| name.get_ref().clone())
    }

    fn triangle(
        &mut self,
        index: usize,
        triangle: &TriangleTable,
        place: NodePlacement,
        table: &ObjectTable,
    ) -> Result<Vec<DVec3>, ImportError> {
        let placed = place.node_from_here;
        let corners = (triangle.vertices.0).map(|Vector(p)| placed.transform_point3(p));
        let flat = (corners[1] - corners[0])
            .cross(corners[2] - corners[0])
            .normalize_or(DVec3::Y);
        let turn = normal_matrix(placed);
        let normals = match &triangle.normals {
            Some(Triple(normals)) => normals.map(|n| (turn * n.0).normalize_or(flat)),
            None => [flat; 3],
        };
        let materials = match &triangle.materials {
            None => [self.material_of(index, table.material.as_ref())?; 3],
            Some(Triple([a, b, c])) => [
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
        mesh: &Spanned<MeshOrName>,
        place: NodePlacement,
        table: &ObjectTable,
    ) -> Result<Vec<DVec3>, ImportError> {
        let read = match self.meshes_of_objects.get(&index) {
            Some(&read) => read,
            None => {
                let read = match mesh.get_ref() {
                    MeshOrName::Name(name) => Some(self.known_mesh(name, mesh, table)?),
                    MeshOrName::Table(mesh) => {
                        let material = table.material.as_ref();
                        let material = material.map(|m| self.material_of(index, Some(m)));
                        self.mesh_file(mesh, material.transpose()?)?
                    }
                };
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
        let placement = chain(place.node_from_here, DAffine3::from_translation(offset));
        self.scene.instances.push(Instance {
            mesh,
            placement,
            node: place.node,
            name: self.name_of(index),
        });
        let corner = |i: u8| {
            let side = |bit: u8| if i & bit == 0 { -1.0 } else { 1.0 };
            placement.transform_point3(reach * DVec3::new(side(1), side(2), side(4)))
        };
        Ok((0..8).map(corner).collect())
    }

    fn known_mesh(
        &self,
        name: &str,
        mesh: &Spanned<MeshOrName>,
        table: &ObjectTable,
    ) -> Result<MeshPlace, ImportError> {
        if let Some(material) = &table.material {
            let why = "a mesh under [meshes] has its own materials";
            let todo = "Change them there, or name its file here";
            return Err(self.refuse(material.span(), why, todo));
        }
        self.named_meshes.get(name).copied().ok_or_else(|| {
            let mut known: Vec<&str> = self.named_meshes.keys().map(String::as_str).collect();
            known.sort_unstable();
            let why = suggest::unknown("mesh", name, known);
            let todo = "Add it under [meshes], or give a table with its `file`";
            self.refuse(mesh.span(), why, todo)
        })
    }

    /// Reads a mesh under [meshes], which becomes part of the scene whether or not an object uses it.
    pub fn named_mesh(&mut self, name: &str, table: &MeshTable) -> Result<(), ImportError> {
        let read = self.mesh_file(table, None)?;
        let place = read.unwrap_or_else(|| {
            self.scene.meshes.push(Mesh::default().into());
            MeshPlace {
                mesh: self.scene.meshes.len() - 1,
                offset: DVec3::ZERO,
                reach: DVec3::ZERO,
            }
        });
        if let Some(mesh) = Arc::get_mut(&mut self.scene.meshes[place.mesh]) {
            name.clone_into(&mut mesh.name);
        }
        self.named_meshes.insert(name.to_owned(), place);
        Ok(())
    }

    /// Reads the mesh in a file. `material`, if any, replaces all of its materials.
    fn mesh_file(
        &mut self,
        mesh: &MeshTable,
        material: Option<usize>,
    ) -> Result<PlacedMesh, ImportError> {
        let name = mesh.file.get_ref();
        let path = self.files.resolve(name).map_err(|refusal| {
            refusal.into_error("mesh file", |why, todo| {
                self.refuse(mesh.file.span(), why, todo)
            })
        })?;
        let is_ply = path
            .extension()
            .is_some_and(|e| e.eq_ignore_ascii_case("ply"));
        let mut materials = Vec::new();
        if let Some(names) = &mesh.materials {
            if !is_ply || material.is_some() {
                let why = "`materials` apply only to a PLY file without another material";
                return Err(self.refuse(mesh.file.span(), why, "Leave them out"));
            }
            for name in names {
                materials.push(self.named(name.get_ref(), name.span())?);
            }
        }
        materials.extend(material);
        if is_ply && materials.is_empty() {
            materials.push(self.material_of(usize::MAX, None)?);
        }
        let key = (path, materials);
        if let Some(&read) = self.meshes.get(&key) {
            return Ok(read);
        }
        let read = match is_ply {
            true => self.read_ply(&key.0, name, &key.1)?,
            false => self.read_obj(&key.0, name, material)?,
        };
        self.meshes.insert(key, read);
        Ok(read)
    }

    fn read_ply(
        &mut self,
        path: &Path,
        name: &str,
        materials: &[usize],
    ) -> Result<PlacedMesh, ImportError> {
        let bytes = self.files.read(path, MAX_GEOMETRY_BYTES)?;
        let mut notes = Notes::default();
        let (mut mesh, offset) = ply::mesh(path, &bytes, materials.len(), &mut notes)?;
        for material in &mut mesh.materials {
            *material = materials[*material as usize] as u32;
        }
        rounding::note_lost_light(&mut notes, &mesh, &self.scene.materials);
        notes::of_repairs(&mut notes, mesh.repair());
        self.notes.append(notes, &quote(name.as_bytes()));
        Ok(self.add_mesh(mesh, offset))
    }

    fn add_mesh(&mut self, mesh: Mesh, offset: DVec3) -> PlacedMesh {
        if mesh.triangles.is_empty() {
            return None;
        }
        let positions = mesh.positions.iter();
        let reach = positions
            .map(|p| p.as_dvec3().abs())
            .reduce(DVec3::max)
            .unwrap_or_default();
        self.scene.meshes.push(mesh.into());
        Some(MeshPlace {
            mesh: self.scene.meshes.len() - 1,
            offset,
            reach,
        })
    }

    fn read_obj(
        &mut self,
        path: &Path,
        name: &str,
        material: Option<usize>,
    ) -> Result<PlacedMesh, ImportError> {
        let wants_uvs = material.map(|index| self.wants_uvs(index));
        let pictures = &mut self.textures.pictures;
        let mut model = obj::read_model(path, self.files, pictures, wants_uvs)?;
        self.notes.append(model.notes, &quote(name.as_bytes()));
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
                    material.shift_textures(first);
                }
                self.textures.textures.append(&mut model.textures);
                self.scene.materials.append(&mut model.materials);
            }
        }
        Ok(self.add_mesh(model.mesh, model.offset))
    }

    /// Whether a texture of the material with this index uses u and v.
    fn wants_uvs(&self, material: usize) -> bool {
        let material = &self.scene.materials[material];
        let mut textures = material.texture_indices();
        textures.any(|index| self.textures.textures[index].space != Space::World)
    }

    /// Builds meshes from all single triangles: one for each node, shared between copies.
    pub fn finish_triangles(&mut self) {
        let mut known: HashMap<Vec<u32>, usize> = HashMap::new();
        let mut all = Repairs::default();
        for (node, Triangles { mut mesh, corners }) in std::mem::take(&mut self.triangles) {
            let (positions, offset) = Mesh::from_world_positions(&corners);
            mesh.positions = positions;
            let is_wanted = |&material: &u32| self.wants_uvs(material as usize);
            if mesh.materials.iter().any(is_wanted) {
                // u grows from the first corner to the second, v to the third.
                let own = [Vec2::ZERO, Vec2::X, Vec2::Y];
                mesh.uvs = own.repeat(mesh.triangles.len());
            }
            rounding::note_lost_light(&mut self.notes, &mesh, &self.scene.materials);
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
                self.scene.meshes.push(mesh.into());
            }
            self.scene.instances.push(Instance {
                mesh: index,
                placement: DAffine3::from_translation(offset),
                node,
                name: String::new(),
            });
        }
        notes::of_repairs(&mut self.notes, all);
    }
}
