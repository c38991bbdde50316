//! glTF 2.0: `.gltf` with its files or `data:` URIs, and `.glb`.
//!
//! Nothing in a file is trusted: `container.rs` and `accessor.rs` check every range, `hierarchy.rs` that
//! nodes form trees, and a [`blame::Ledger`] bounds the memory to 16 times the size of the file and its
//! buffers, decoded where they are compressed, plus 64 MiB: a file may pack vertices into a few bytes each. What
//! cannot be shown is noted.

mod accessor;
mod aim;
mod animation;
mod beside;
mod blame;
mod buffers;
mod cameras;
mod compressed;
mod container;
mod deform;
mod document;
mod document_animation;
mod document_materials;
mod extensions;
mod field_forms;
mod field_table;
mod fields;
mod hierarchy;
mod lights;
mod map_kinds;
mod maps;
mod material_fields;
mod materials;
mod mesh;
mod meshopt;
mod node_transform;
mod references;
mod skins;
mod store;
mod textures;
mod unused;
mod uv_sets;
mod values;
mod version;

use super::budget::Budget;
use super::error::ImportError;
use super::notes::Notes;
use super::paths::Files;
use super::source::{Source, quote};
use super::{Axis, Options, stage, suggest};
use accessor::Accessors;
use blame::{Blame, Ledger};
use buffers::Buffers;
use deform::Deformable;
use document::{Document, Primitive, TextureInfo};
pub use extensions::{GLTF_EXTENSIONS, Support};
pub use fields::gltf_properties;
use glam::DAffine3;
use glimray_scene::text::one_line;
use glimray_scene::{Clip, LightTransport, OutputDefaults, Scene, Shadows};
use materials::{MaterialKey, Surface};
use mesh::MeshKey;
use skins::Bound;
use std::cell::{Cell, OnceCell};
use std::collections::HashMap;
use std::path::Path;
use std::sync::Arc;
use store::Store;
use unused::Unused;

/// Width and height of a picture, in pixels.
const SIZE: (u32, u32) = (800, 600);

/// Bytes that an object of the JSON may take in memory.
const PER_OBJECT: u64 = 400;

/// Bytes that a value of the JSON takes while its properties are checked.
const PER_VALUE: u64 = 48;

/// The state of an import.
struct Reader<'a> {
    document: &'a Document,
    buffers: &'a Buffers,
    files: &'a Files<'a>,
    blame: Blame<'a>,
    ledger: &'a Ledger<'a>,
    /// Whether the model will be path-traced, so that nothing is to be noted that only paths show.
    traces_paths: bool,
    notes: Notes,
    unused: Unused,
    /// The first fault for which a part of the model was left out.
    fault: Option<ImportError>,
    scene: Scene,
    /// Width of the picture over its height. A camera made for a wider one shows as much to the sides, and more above.
    aspect: f64,
    /// From the file's axes to those of the scene, in which +Y is up.
    turn: DAffine3,
    /// The number of the chosen variant.
    variant: Option<usize>,
    /// For each node of the file whether a clip that is played moves it.
    animated: Vec<bool>,
    /// For each node of the file whether a clip that is played changes its scale.
    scaled: Vec<bool>,
    /// For each node of the file the nodes below it.
    children: Vec<Vec<usize>>,
    /// For each node of the file its index in the scene.
    node_of: Vec<Option<usize>>,
    /// For each node of the file its transform at rest; the identity outside the chosen scene.
    worlds: Vec<DAffine3>,
    /// For each node of the file whether it or a node above it is animated.
    moving: Vec<bool>,
    /// For each node of the file whether a clip that is played changes the weights of its morph targets.
    morphed: Vec<bool>,
    /// For each node of the file whether it is a moving joint of a skin.
    is_joint: Vec<bool>,
    /// Still meshes; `None` for those without triangles.
    meshes: HashMap<MeshKey, Option<usize>>,
    /// Meshes that clips deform, by number in the file, with or without a skin.
    deformables: HashMap<(usize, bool), Option<Deformable>>,
    /// For each deformation of the scene its node in the file, and the joints of its skin.
    deforming: Vec<(usize, Option<Arc<[Bound]>>)>,
    skins: HashMap<usize, Arc<[Bound]>>,
    /// For each camera and each light of the scene its number in the file.
    cameras: Vec<usize>,
    lights: Vec<usize>,
    surfaces: HashMap<MaterialKey, Surface>,
    /// For each material in the file its primitives, found when they are needed.
    primitives_of: OnceCell<HashMap<usize, Vec<&'a Primitive>>>,
    /// Maps whose transform a clip that is played moves, and their textures in the scene: each has one of its own.
    moved_maps: HashMap<*const TextureInfo, Option<usize>>,
    /// The indices of materials in the scene.
    materials: HashMap<MaterialKey, u32>,
    store: Store,
}

impl<'a> Reader<'a> {
    fn accessors(&self) -> Accessors<'a> {
        Accessors {
            document: self.document,
            buffers: self.buffers,
            ledger: self.ledger,
        }
    }

    /// The value of `found`; `None` with a note if a part of the model is malformed, which leaves the others.
    ///
    /// # Errors
    /// The model is too large, or names files that may not be read.
    fn spared<T>(&mut self, found: Result<T, ImportError>) -> Result<Option<T>, ImportError> {
        match found {
            Ok(value) => Ok(Some(value)),
            Err(ImportError::Malformed(fault)) if !self.ledger.is_exceeded.get() => {
                (self.notes).add("parts left out", || format!("left out: {}", fault.why));
                self.fault.get_or_insert(ImportError::Malformed(fault));
                Ok(None)
            }
            Err(error) => Err(error),
        }
    }
}

/// The model in `bytes`, the contents of the file at `path`, as a scene.
///
/// # Errors
/// The model is malformed, requires an unknown extension, names files that may not be read, is too large, or has not
/// the scene, clip or variant that `options` names.
pub(super) fn read(
    path: &Path,
    bytes: Vec<u8>,
    options: &Options,
    files: &Files,
) -> Result<Scene, ImportError> {
    let blame = Blame { path };
    let parts = container::parts(&bytes, blame)?;
    let mut notes = Notes::default();
    let (mut document, mut unused) = parse(&bytes[parts.json.clone()], &mut notes, blame)?;
    let integrator = options.integrator.unwrap_or(LightTransport::Path);
    let traces_paths = integrator == LightTransport::Path;
    extensions::check(&document, traces_paths, &mut notes, blame)?;
    beside::find(&document, &mut unused, &mut notes);
    references::find_parts(&document, &mut unused);
    let mut faults: Vec<ImportError> = parts.cut.into_iter().collect();
    let report = &mut |fault| faults.push(fault);
    let mut buffers = Buffers::read(&document, bytes, parts.bin, files, blame, report)?;
    let in_files = buffers.total();
    faults.extend(compressed::expand(&mut document, &mut buffers, blame)?);
    for fault in &faults {
        notes.add("parts left out", || {
            format!("left out: {}", fault.fault().why)
        });
    }
    let ledger = Ledger {
        blame,
        budget: Budget::of(buffers.total().saturating_add(in_files)),
        held: Cell::new(buffers.total() as u64),
        is_exceeded: Cell::new(false),
    };
    let (width, height) = options.size.unwrap_or(SIZE);
    let mut reader = Reader {
        document: &document,
        buffers: &buffers,
        files,
        blame,
        ledger: &ledger,
        traces_paths,
        notes,
        unused,
        fault: faults.into_iter().next(),
        scene: Scene {
            shadows: Shadows::Filtered,
            output: OutputDefaults {
                size: SIZE,
                integrator: LightTransport::Path,
                max_depth: LightTransport::Path.max_depth(),
                ..OutputDefaults::default()
            },
            ..Scene::default()
        },
        aspect: f64::from(width.max(1)) / f64::from(height.max(1)),
        turn: options.up.map_or(DAffine3::IDENTITY, Axis::turn),
        variant: None,
        animated: Vec::new(),
        scaled: Vec::new(),
        children: Vec::new(),
        moving: Vec::new(),
        morphed: Vec::new(),
        is_joint: Vec::new(),
        node_of: vec![None; document.nodes.len()],
        worlds: vec![DAffine3::IDENTITY; document.nodes.len()],
        meshes: HashMap::new(),
        deformables: HashMap::new(),
        deforming: Vec::new(),
        skins: HashMap::new(),
        cameras: Vec::new(),
        lights: Vec::new(),
        surfaces: HashMap::new(),
        primitives_of: OnceCell::new(),
        moved_maps: HashMap::new(),
        materials: HashMap::new(),
        store: Store::new(options),
    };
    reader.variant = reader.chosen_variant(options.variant.as_deref())?;
    let clips = reader.clips(options.clip.as_deref())?;
    reader.find_moved(&clips);
    let (roots, place) = reader.chosen_scene(options.scene.as_deref())?;
    reader.plan_images();
    reader.nodes(&roots, &place)?;
    reader.find_unshown(&roots);
    reader.bind_skins();
    let all = document.animations.iter().map(|clip| Clip {
        name: clip.name.clone().unwrap_or_default(),
        seconds: None,
    });
    reader.scene.clips = all.collect();
    let variants = document.extensions.variants.iter();
    let variants = variants.flat_map(|it| &it.variants);
    reader.scene.variants = variants.map(|variant| variant.name.clone()).collect();
    let scenes = document.scenes.iter().filter(|_| document.scenes.len() > 1);
    let scenes = scenes.map(|scene| scene.name.clone().unwrap_or_default());
    reader.scene.alternatives = scenes.collect();
    for clip in clips {
        reader.tracks(clip)?;
    }
    reader.hold_maps();
    reader.finish(options)
}

/// The JSON in `bytes`, and what of it says nothing about the picture.
fn parse(bytes: &[u8], notes: &mut Notes, blame: Blame) -> Result<(Document, Unused), ImportError> {
    let source = Source::new("bad model", blame.path, bytes.to_vec())?;
    let budget = Budget::of(bytes.len());
    let count = |marks: &[u8]| bytes.iter().filter(|byte| marks.contains(byte)).count() as u64;
    let size = count(b"{").saturating_mul(PER_OBJECT);
    budget.check(size, |why, todo| blame.file(&why, todo))?;
    let refuse = |error: serde_json::Error| {
        let lines = source.bytes.split_inclusive(|&byte| byte == b'\n');
        let line = lines.take(error.line().saturating_sub(1)).map(<[u8]>::len);
        let at = line.sum::<usize>() + error.column().saturating_sub(1);
        let why = error.to_string();
        let why = why.split(" at line ").next().unwrap_or_default();
        let why = one_line(why);
        let todo = "Check that it is a complete glTF 2.0 file";
        match error.line() {
            0 => blame.file(&why, todo),
            _ => source.malformed(at..at + 1, why, todo),
        }
    };
    let size = count(b"{[,:").saturating_mul(PER_VALUE);
    let is_small = budget
        .check(size, |why, todo| blame.file(&why, todo))
        .is_ok();
    let (document, unused): (Document, Unused) = match is_small {
        true => {
            let mut json = serde_json::from_slice(&source.bytes).map_err(refuse)?;
            let unused = fields::check(&mut json, notes);
            (serde_json::from_value(json).map_err(refuse)?, unused)
        }
        false => {
            notes.add("properties that were not checked", || {
                "the model has too many properties to tell which are not used".to_owned()
            });
            let document = serde_json::from_slice(&source.bytes);
            (document.map_err(refuse)?, Unused::default())
        }
    };
    version::check(&document, notes, blame)?;
    Ok((document, unused))
}

/// The number of the entry that `wanted` names, by its name or number.
fn named<'n>(
    what: &str,
    wanted: &str,
    names: impl Iterator<Item = Option<&'n str>>,
    blame: Blame,
) -> Result<usize, ImportError> {
    let names: Vec<&str> = names.map(Option::unwrap_or_default).collect();
    if let Some(index) = names.iter().position(|name| *name == wanted) {
        return Ok(index);
    }
    match wanted.parse::<usize>() {
        Ok(index) if index < names.len() => return Ok(index),
        _ => {}
    }
    let why = suggest::unknown(what, wanted, names.iter().copied());
    let known: Vec<String> = (names.iter().take(8).enumerate())
        .map(|(i, name)| match name.is_empty() {
            true => i.to_string(),
            false => quote(name.as_bytes()),
        })
        .collect();
    let todo = match known.len() {
        0 => format!("The model has no {what}"),
        _ => format!("It has {}", known.join(", ")),
    };
    Err(blame.file(&why, &todo))
}

impl Reader<'_> {
    fn chosen_variant(&mut self, wanted: Option<&str>) -> Result<Option<usize>, ImportError> {
        let variants = self.document.extensions.variants.as_ref();
        let names = variants.map_or(&[][..], |it| &it.variants);
        if wanted.is_none() && !names.is_empty() {
            let shown = names.iter().take(8).map(|it| quote(it.name.as_bytes()));
            let shown: Vec<String> = shown.collect();
            self.notes.remark(format!(
                "no variant of its materials is chosen, of which it has {}: {}",
                names.len(),
                shown.join(", ")
            ));
        }
        let names = names.iter().map(|variant| Some(variant.name.as_str()));
        wanted
            .map(|wanted| named("variant", wanted, names, self.blame))
            .transpose()
    }

    /// The root nodes of the chosen scene, and their place in the file.
    fn chosen_scene(&mut self, wanted: Option<&str>) -> Result<(Vec<usize>, String), ImportError> {
        let scenes = &self.document.scenes;
        let index = match wanted {
            Some(wanted) => {
                let names = scenes.iter().map(|scene| scene.name.as_deref());
                named("scene", wanted, names, self.blame)?
            }
            None if scenes.is_empty() => {
                // A library of parts: show all of them.
                let mut is_root = vec![true; self.document.nodes.len()];
                let nodes = self.document.nodes.iter();
                for &child in nodes.flat_map(|node| &node.children) {
                    if let Some(is_root) = is_root.get_mut(child) {
                        *is_root = false;
                    }
                }
                let roots = (0..is_root.len()).filter(|&i| is_root[i]).collect();
                return Ok((roots, "nodes".to_owned()));
            }
            None => self.document.scene.unwrap_or(0),
        };
        let place = format!("scenes[{index}].nodes");
        let scene = self.blame.get(scenes, index, "scenes", "scene");
        let (index, place) = match self.spared(scene)? {
            Some(_) => (index, place),
            None => (0, "scenes[0].nodes".to_owned()),
        };
        for other in (0..scenes.len()).filter(|other| *other != index) {
            let why = "another scene is shown";
            self.unused.of("scenes", other, "", why);
        }
        Ok((scenes[index].nodes.clone(), place))
    }

    /// The scene.
    ///
    /// # Errors
    /// Nothing can be shown, because all of it is malformed.
    fn finish(mut self, options: &Options) -> Result<Scene, ImportError> {
        let mut scene = self.scene;
        if let (true, Some(fault)) = (scene.instances.is_empty(), self.fault) {
            return Err(fault);
        }
        scene.pictures = self.store.pictures.finish(&mut self.notes);
        if scene.materials.is_empty() {
            scene.materials.push(glimray_scene::Material::default());
        }
        scene.remarks.extend(self.unused.into_lines());
        scene.remarks.extend(self.notes.take_remarks());
        scene.skipped = self.notes.into_lines();
        if scene.instances.is_empty() {
            scene.skipped.push("the model has no triangles".to_owned());
        }
        stage::complete(&mut scene, options);
        Ok(scene)
    }
}
