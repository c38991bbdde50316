//! Builds a [`Scene`] from the tables of a native scene: resolves names, places objects, reads files, and
//! checks everything that involves more than one value.

mod surfaces;

use super::file::Spanned;
use super::file::{MaterialRef, OutputTable, SceneFile, in_order};
use super::nodes::{NodePlacement, Nodes};
use super::objects::{Object, Objects};
use super::textures::Textures;
use super::transforms::{chain, is_invertible};
use super::values::{BackdropValue, or};
use super::{Texts, animation, cameras, lights, materials};
use crate::import::error::ImportError;
use crate::import::notes::Notes;
use crate::import::number::in_range;
use crate::import::paths::Files;
use crate::import::{Options, stage};
use glam::{DAffine3, Vec3};
use glimray_scene::{Material, OutputDefaults, Scene, Shadows, Shutter};
use std::collections::{BTreeMap, HashMap};
use std::ops::Range;
use surfaces::{MeshKey, MeshPlace, PlacedMesh, Triangles};

/// The scene that `file` describes.
pub(super) fn scene(
    file: SceneFile,
    texts: &Texts,
    files: &Files,
    options: &Options,
) -> Result<Scene, ImportError> {
    let objects = Objects::new(&file, texts, files)?;
    let textures = Textures::new(&file, texts, files, options)?;
    let mut builder = Builder::new(&file, &objects, textures, texts, files)?;
    builder.list(objects.roots.clone(), NodePlacement::default())?;
    builder.finish_triangles();
    let background = builder.textures.background(file.background.as_ref())?;
    builder.textures.complete()?;
    let (mut nodes, names) = (builder.nodes, builder.names);
    let mut notes = builder.notes;
    let mut scene = Scene {
        nodes: std::mem::take(&mut nodes.nodes),
        textures: builder.textures.textures,
        pictures: builder.textures.pictures.finish(&mut notes),
        background,
        ..builder.scene
    };
    let mut lights = lights::lights(&file, &nodes, texts)?;
    let (cameras, camera_index) = cameras::cameras(&file, &nodes, texts)?;
    scene.camera_index = camera_index;
    scene.cameras = if cameras.is_empty() {
        vec![stage::framed_camera(&scene, scene.output.size)]
    } else {
        cameras
    };
    if scene.materials.is_empty() {
        scene.materials.push(Material::default());
    }
    let found = animation::Found {
        nodes: &nodes,
        cameras: &scene.cameras,
        lights: &mut lights,
        materials: &names,
    };
    scene.tracks = animation::tracks(&file, found, texts, &mut notes)?;
    scene.remarks.extend(notes.take_remarks());
    scene.skipped = notes.into_lines();
    scene.lights = lights.into_iter().map(|named| named.light).collect();
    if file.output.samples.is_none() {
        scene.output.samples = scene.default_samples();
    }
    Ok(scene)
}

struct Builder<'a> {
    pub texts: &'a Texts<'a>,
    pub files: &'a Files<'a>,
    objects: &'a Objects<'a>,
    pub nodes: Nodes<'a>,
    /// Without its textures, images, background and nodes, which are added at the end.
    pub scene: Scene,
    pub textures: Textures<'a>,
    pub notes: Notes,
    /// Indices of materials by name.
    names: HashMap<String, usize>,
    /// The material of objects that name none, once it exists.
    default_material: Option<usize>,
    /// Materials that are written inside objects, by object index.
    inline_materials: HashMap<usize, usize>,
    /// Meshes already read, by file and replacement material.
    pub meshes: HashMap<MeshKey, PlacedMesh>,
    /// Meshes by object index, so that copies do not resolve files again.
    pub meshes_of_objects: HashMap<usize, PlacedMesh>,
    /// Meshes under [meshes].
    pub named_meshes: HashMap<String, MeshPlace>,
    /// All single triangles, by the node that they are attached to.
    pub triangles: BTreeMap<Option<usize>, Triangles>,
}

impl<'a> Builder<'a> {
    fn new(
        file: &'a SceneFile,
        objects: &'a Objects<'a>,
        mut textures: Textures<'a>,
        texts: &'a Texts<'a>,
        files: &'a Files<'a>,
    ) -> Result<Self, ImportError> {
        let in_file = in_order(&file.materials);
        let names = in_file.iter().map(|(name, _)| (*name).clone()).zip(0..);
        let names = names.collect();
        let materials = (in_file.into_iter())
            .map(|(name, table)| materials::material(name, table.get_ref(), &mut textures))
            .collect::<Result<_, _>>()?;
        let mut builder = Self {
            texts,
            files,
            objects,
            nodes: Nodes::new(objects, file, texts)?,
            textures,
            notes: Notes::default(),
            scene: Scene {
                materials,
                ambient: or(file.ambient, Vec3::ZERO),
                shadows: or(file.shadows, Shadows::Opaque),
                section: file.section.map(Into::into),
                staged: file.staged.unwrap_or_default(),
                output: output(&file.output),
                ..Scene::default()
            },
            names,
            default_material: None,
            inline_materials: HashMap::new(),
            meshes: HashMap::new(),
            meshes_of_objects: HashMap::new(),
            named_meshes: HashMap::new(),
            triangles: BTreeMap::new(),
        };
        for (name, table) in in_order(&file.meshes) {
            builder.named_mesh(name, table.get_ref())?;
        }
        Ok(builder)
    }

    pub fn refuse(&self, span: Range<usize>, why: impl Into<String>, todo: &str) -> ImportError {
        self.texts.malformed(span, why.into(), todo)
    }

    /// Places a list of objects.
    fn list(&mut self, list: Range<usize>, place: NodePlacement) -> Result<(), ImportError> {
        let objects = self.objects;
        for index in list {
            let object = objects.get(index);
            let place = match &object.table.carried_by {
                Some(node) => self.nodes.declared(node, self.texts)?,
                None => place,
            };
            if object.is_shown() || object.has_node {
                // At most the permitted number of copies, or an empty group.
                for copy in 0..object.repeat.count() as u64 {
                    self.copy(index, object, copy, place)?;
                }
            }
        }
        Ok(())
    }

    /// Places one copy of an object.
    fn copy(
        &mut self,
        index: usize,
        object: &Object,
        copy: u64,
        place: NodePlacement,
    ) -> Result<(), ImportError> {
        let table = object.table.get_ref();
        let transform = table.transform.as_ref();
        let repeated = chain(place.node_from_here, object.repeat.placement(copy));
        let inner = if object.has_node {
            self.nodes.add(index, object, repeated, place)
        } else {
            let own = transform.map_or(DAffine3::IDENTITY, |t| t.affine());
            NodePlacement {
                node_from_here: chain(repeated, own),
                ..place
            }
        };
        let span = || {
            let repeat = table.repeat.as_ref().map(Spanned::span);
            let span = transform.map(Spanned::span).or(repeat);
            span.unwrap_or(object.table.span())
        };
        if !is_invertible(inner.world_from_here().matrix3) {
            let why = "the object's scale, combined with those of its groups and nodes, is zero or out of range";
            return Err(self.refuse(span(), why, "Check these scales"));
        }
        if !object.is_shown() {
            return Ok(());
        }
        if let Some(group) = object.group {
            return self.list(self.objects.members(group), inner);
        }
        let world_from_node = inner.world_from_node;
        let reached = self.surface(index, inner, object.table)?;
        let reached = reached
            .into_iter()
            .map(|p| world_from_node.transform_point3(p));
        if reached.flat_map(|p| p.to_array()).all(in_range) {
            return Ok(());
        }
        let why = "the object's coordinates are out of range: at most 3.4e38 is allowed";
        let todo = "Make it smaller, or move it nearer to the origin";
        Err(self.refuse(span(), why, todo))
    }

    /// The material of the object with this index.
    pub fn material_of(
        &mut self,
        index: usize,
        material: Option<&Spanned<MaterialRef>>,
    ) -> Result<usize, ImportError> {
        let Some(reference) = material else {
            return Ok(*self.default_material.get_or_insert_with(|| {
                self.scene.materials.push(Material::default());
                self.scene.materials.len() - 1
            }));
        };
        match reference.get_ref() {
            MaterialRef::Name(name) => self.named(name, reference.span()),
            MaterialRef::Inline(table) => {
                if let Some(&known) = self.inline_materials.get(&index) {
                    return Ok(known);
                }
                let material = materials::material("", table, &mut self.textures)?;
                self.scene.materials.push(material);
                let last = self.scene.materials.len() - 1;
                self.inline_materials.insert(index, last);
                Ok(last)
            }
        }
    }

    /// The material of this name.
    pub fn named(&self, name: &str, span: Range<usize>) -> Result<usize, ImportError> {
        materials::named(&self.names, name, span, self.texts)
    }
}

fn output(table: &OutputTable) -> OutputDefaults {
    let plain = OutputDefaults::default();
    let [open, close] = or(table.shutter, [plain.shutter.open, plain.shutter.close]);
    let integrator = or(table.integrator, plain.integrator);
    OutputDefaults {
        size: table.size.map_or(plain.size, |size| size.0.into()),
        integrator,
        samples: or(table.samples, plain.samples),
        antialias: table.antialias.map(Into::into),
        noise: or(table.noise, plain.noise),
        max_depth: or(table.max_depth, integrator.max_depth()),
        filter: or(table.filter, plain.filter),
        filter_radius: table.filter_radius.map(Into::into),
        light_samples: or(table.light_samples, plain.light_samples),
        exposure_ev: or(table.exposure_ev, plain.exposure_ev),
        auto_exposure: table.auto_exposure.unwrap_or(plain.auto_exposure),
        tone: table.tone.map(Into::into),
        path_tone: or(table.path_tone, plain.path_tone),
        transfer: or(table.transfer, plain.transfer),
        fps: or(table.fps, plain.fps),
        duration: table.duration.map(Into::into),
        shutter: Shutter { open, close },
        denoise: table.denoise.unwrap_or(plain.denoise),
        backdrop: (table.backdrop.as_ref()).map_or(plain.backdrop, BackdropValue::backdrop),
    }
}
