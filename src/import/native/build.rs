//! From the tables of a native scene to a [`Scene`]: names are looked up, objects placed, files
//! read, and everything checked that takes more than one value to see.

use super::file::{
    MaterialRef, MeshTable, ObjectTable, OutputTable, SceneFile, TransformTable, TriangleTable,
};
use super::textures::Textures;
use super::values::Vector;
use super::{Texts, cameras, lights, materials, shapes};
use crate::import::error::ImportError;
use crate::import::number::in_range;
use crate::import::paths::Files;
use crate::import::source::quote;
use crate::import::{obj, repair_notes, stage, suggest};
use crate::scene::{self, Geometry, Instance, Material, Mesh, OutputDefaults, Scene, Shape, Space};
use glam::{DAffine3, DMat3, DQuat, DVec3, Vec2};
use std::collections::HashMap;
use std::ops::Range;
use std::path::PathBuf;
use toml::Spanned;

/// The scene that `file` describes.
pub(super) fn scene(file: SceneFile, texts: &Texts, files: &Files) -> Result<Scene, ImportError> {
    let mut builder = Builder::new(&file, texts, files)?;
    for object in &file.objects {
        builder.object(object)?;
    }
    builder.finish_triangles();
    let background = builder.textures.background(&file.background)?;
    let mut scene = Scene {
        textures: builder.textures.textures,
        pictures: builder.textures.pictures.pictures,
        background,
        ..builder.scene
    };
    let lights = file.lights.iter().map(|table| lights::light(table, texts));
    scene.lights = lights.collect::<Result<_, _>>()?;
    let cameras = cameras::cameras(&file, texts)?;
    scene.cameras = if cameras.is_empty() {
        vec![stage::camera(&scene)]
    } else {
        cameras
    };
    if scene.materials.is_empty() {
        scene.materials.push(Material::default());
    }
    Ok(scene)
}

/// A mesh file and the material it was given in place of its own.
type MeshKey = (PathBuf, Option<usize>);

/// The index of a mesh and its offset; `None` when the file has no triangles.
type PlacedMesh = Option<(usize, DVec3)>;

struct Builder<'a> {
    texts: &'a Texts<'a>,
    files: &'a Files,
    /// Still without its textures, pictures and background.
    scene: Scene,
    textures: Textures<'a>,
    names: HashMap<String, usize>,
    /// The material of objects that name none, once there is one.
    default_material: Option<usize>,
    /// Meshes already read, by file and the material they were given, and their offsets.
    meshes: HashMap<MeshKey, PlacedMesh>,
    /// All single triangles, in world space, as one mesh without its positions.
    triangles: Mesh,
    corners: Vec<DVec3>,
}

impl<'a> Builder<'a> {
    fn new(file: &SceneFile, texts: &'a Texts, files: &'a Files) -> Result<Self, ImportError> {
        let mut textures = Textures::new(file, texts, files)?;
        let materials = (file.materials.iter())
            .map(|(name, table)| materials::material(name, table, &mut textures))
            .collect::<Result<_, _>>()?;
        Ok(Self {
            texts,
            files,
            textures,
            scene: Scene {
                materials,
                ambient: file.ambient.0,
                shadows: file.shadows.into(),
                output: output(&file.output),
                ..Scene::default()
            },
            names: file.materials.keys().cloned().zip(0..).collect(),
            default_material: None,
            meshes: HashMap::new(),
            triangles: Mesh::default(),
            corners: Vec::new(),
        })
    }

    fn refuse(&self, span: Range<usize>, why: impl Into<String>, todo: &str) -> ImportError {
        self.texts.malformed(span, why.into(), todo)
    }

    fn object(&mut self, object: &Spanned<ObjectTable>) -> Result<(), ImportError> {
        let table = object.get_ref();
        if shapes::count(table) + meshes_in(table) != 1 {
            let todo = "Give it exactly one of `sphere`, `plane`, `disc`, `rectangle`, `box`, `cylinder`, `cone`, `torus`, `triangle` and `mesh`";
            return Err(self.refuse(object.span(), "an object is one surface", todo));
        }
        if !table.visible {
            return Ok(());
        }
        let transform = table.transform.as_ref();
        let placed = transform.map_or(DAffine3::IDENTITY, |t| world_from_object(t.get_ref()));
        let reached = if let Some(triangle) = &table.triangle {
            self.triangle(triangle, placed, table)?
        } else if let Some(mesh) = &table.mesh {
            self.mesh(mesh, placed, table)?
        } else {
            self.shape(placed, table)?
        };
        if reached
            .iter()
            .all(|p| p.to_array().into_iter().all(in_range))
        {
            return Ok(());
        }
        let span = transform.map_or(object.span(), Spanned::span);
        let why = "the object reaches out of range: at most 3.4e38 is allowed";
        Err(self.refuse(
            span,
            why,
            "Make it smaller, or leave it nearer to the origin",
        ))
    }

    // Each of the following returns points that the placed object reaches to.

    fn shape(&mut self, placed: DAffine3, table: &ObjectTable) -> Result<Vec<DVec3>, ImportError> {
        let material = self.material_of(table)?;
        let textured = self.scene.materials[material].textures != scene::Textures::default();
        let Some(geometry) = shapes::geometry(table, placed, textured, self.texts)? else {
            return Ok(Vec::new());
        };
        self.scene.shapes.push(Shape {
            geometry,
            material,
            node: None,
        });
        Ok(match (geometry, geometry.bounds()) {
            (Geometry::Plane { point, .. }, _) => vec![point],
            (_, Some((min, max))) => vec![min, max],
            (_, None) => Vec::new(),
        })
    }

    fn triangle(
        &mut self,
        triangle: &TriangleTable,
        placed: DAffine3,
        table: &ObjectTable,
    ) -> Result<Vec<DVec3>, ImportError> {
        let first = self.corners.len() as u32;
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
            None => [self.material_of(table)?; 3],
            Some([a, b, c]) => [
                self.named(a.get_ref(), a.span())?,
                self.named(b.get_ref(), b.span())?,
                self.named(c.get_ref(), c.span())?,
            ],
        };
        self.corners.extend(corners);
        self.triangles.normals.extend(normals.map(|n| n.as_vec3()));
        self.triangles
            .materials
            .extend(materials.map(|index| index as u32));
        self.triangles.triangles.push([first, first + 1, first + 2]);
        Ok(corners.to_vec())
    }

    fn mesh(
        &mut self,
        mesh: &MeshTable,
        placed: DAffine3,
        table: &ObjectTable,
    ) -> Result<Vec<DVec3>, ImportError> {
        let name = mesh.file.get_ref();
        let path = self.files.resolve(name).map_err(|refusal| {
            refusal.into_error("mesh file", |why, todo| {
                self.refuse(mesh.file.span(), why, todo)
            })
        })?;
        let material = match table.material {
            Some(_) => Some(self.material_of(table)?),
            None => None,
        };
        let key = (path, material);
        let read = match self.meshes.get(&key) {
            Some(&read) => read,
            None => {
                let read = self.read_mesh(&key.0, name, material)?;
                self.meshes.insert(key, read);
                read
            }
        };
        let Some((mesh, offset)) = read else {
            return Ok(Vec::new());
        };
        let world_from_object = placed * DAffine3::from_translation(offset);
        self.scene.instances.push(Instance {
            mesh,
            placement: world_from_object,
            node: None,
        });
        let positions = self.scene.meshes[mesh]
            .positions
            .iter()
            .map(|p| p.as_dvec3());
        let reach = positions
            .map(DVec3::abs)
            .reduce(DVec3::max)
            .unwrap_or_default();
        let corner = |i: u8| {
            let side = |bit: u8| if i & bit == 0 { -1.0 } else { 1.0 };
            world_from_object.transform_point3(reach * DVec3::new(side(1), side(2), side(4)))
        };
        Ok((0..8).map(corner).collect())
    }

    fn read_mesh(
        &mut self,
        path: &std::path::Path,
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
        self.scene.meshes.push(model.mesh);
        Ok(Some((self.scene.meshes.len() - 1, model.offset)))
    }

    /// Whether a texture of the material with this index lies on u and v.
    fn wants_uvs(&self, material: usize) -> bool {
        let textures = self.scene.materials[material].textures.all();
        let is_uv = |&index: &usize| self.textures.textures[index].space == Space::Uv;
        textures.iter().flatten().any(is_uv)
    }

    fn finish_triangles(&mut self) {
        let mut mesh = std::mem::take(&mut self.triangles);
        let (positions, offset) = Mesh::from_world_positions(&self.corners);
        mesh.positions = positions;
        let is_wanted = |&material: &u32| self.wants_uvs(material as usize);
        if mesh.materials.iter().any(is_wanted) {
            // u goes from the first corner to the second, v to the third.
            let own = [Vec2::ZERO, Vec2::X, Vec2::Y];
            mesh.uvs = own.repeat(mesh.triangles.len());
        }
        let repairs = mesh.repair();
        self.scene.skipped.extend(repair_notes(repairs));
        if !mesh.triangles.is_empty() {
            let world_from_object = DAffine3::from_translation(offset);
            self.scene.instances.push(Instance {
                mesh: self.scene.meshes.len(),
                placement: world_from_object,
                node: None,
            });
            self.scene.meshes.push(mesh);
        }
    }

    fn material_of(&mut self, object: &ObjectTable) -> Result<usize, ImportError> {
        let Some(reference) = &object.material else {
            return Ok(*self.default_material.get_or_insert_with(|| {
                self.scene.materials.push(Material::default());
                self.scene.materials.len() - 1
            }));
        };
        match reference.get_ref() {
            MaterialRef::Name(name) => self.named(name, reference.span()),
            MaterialRef::Inline(table) => {
                let material = materials::material("", table, &mut self.textures)?;
                self.scene.materials.push(material);
                Ok(self.scene.materials.len() - 1)
            }
        }
    }

    fn named(&self, name: &str, span: Range<usize>) -> Result<usize, ImportError> {
        self.names.get(name).copied().ok_or_else(|| {
            let mut known: Vec<&str> = self.names.keys().map(String::as_str).collect();
            known.sort_unstable();
            let why = suggest::unknown("material", name, known);
            self.refuse(
                span,
                why,
                "Add it under [materials], or name one that is there",
            )
        })
    }
}

fn meshes_in(table: &ObjectTable) -> usize {
    usize::from(table.triangle.is_some()) + usize::from(table.mesh.is_some())
}

fn output(table: &OutputTable) -> OutputDefaults {
    let [width, height] = table.size.0;
    OutputDefaults {
        size: (width, height),
        samples: table.samples.0,
        antialias: table.antialias.map(Into::into),
        noise: table.noise.0,
        max_depth: table.max_depth.0,
        filter: table.filter.into(),
        filter_radius: table.filter_radius.map(|radius| radius.0),
        light_samples: table.light_samples.0,
        exposure_ev: table.exposure_ev.0,
        tone: table.tone.into(),
        transfer: table.transfer.into(),
        ..OutputDefaults::default()
    }
}

fn world_from_object(table: &TransformTable) -> DAffine3 {
    placement(table.scale.0, table.rotate_deg.0, table.translate.0)
}

/// Scales first, then rotates round x, y and z, then moves.
pub(super) fn placement(scale: DVec3, rotate_deg: DVec3, translate: DVec3) -> DAffine3 {
    let [x, y, z] = rotate_deg.to_array().map(f64::to_radians);
    let rotation =
        DQuat::from_rotation_z(z) * DQuat::from_rotation_y(y) * DQuat::from_rotation_x(x);
    DAffine3::from_scale_rotation_translation(scale, rotation, translate)
}

/// What normals are multiplied by where points are by `transform`: the inverse transpose, up to a
/// positive factor, without the loss of a division by a small determinant.
pub(super) fn normal_matrix(transform: DAffine3) -> DMat3 {
    let [x, y, z] = [
        transform.matrix3.x_axis,
        transform.matrix3.y_axis,
        transform.matrix3.z_axis,
    ];
    let sign = x.cross(y).dot(z).signum();
    DMat3::from_cols(y.cross(z), z.cross(x), x.cross(y)) * sign
}
