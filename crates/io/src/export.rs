//! Exports a [`Scene`] as a native scene file that reads like one written by hand: sections in a fixed
//! order, names for everything that is referred to, and only values that differ from the defaults. The scene
//! becomes a `SceneFile`, which the importer reads too, and `text.rs` lays it out.
//!
//! Nothing is lost: [`crate::import`] turns the text and its companion files into a scene that is packed
//! to the same bytes, and exporting that scene gives the same text. Numbers are written in the fewest
//! digits that preserve all bits. Angles, scales and corners replace a matrix if they give exactly that
//! matrix. Deforming meshes stay in their pose at time 0. Not preserved are [`Scene::skipped`], the grouping of
//! tracks, unused images, and missing or duplicate names, which are replaced by generated ones.
//!
//! This module does not access the disk: the caller writes the files, companion files first.

mod animation;
mod cameras;
mod exact;
mod files;
mod lights;
mod materials;
mod names;
mod objects;
mod output;
mod physical;
mod pictures;
mod ply;
mod runs;
mod shapes;
mod text;
mod textures;

use crate::import::native::MAX_MARKS;
use crate::import::native::file::{SceneFile, Spanned};
use crate::import::native::values::differing;
use files::Beside;
use glam::Vec3;
use glimray_scene::{Scene, Shadows};
use names::Names;
use std::collections::{BTreeMap, HashMap};

/// A scene file and its companion files.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Export {
    /// The scene file itself, in TOML.
    pub text: String,
    /// Files that it refers to, relative to its folder: meshes, images, transforms of copies.
    pub files: Vec<ExportFile>,
}

/// A companion file of a scene file.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct ExportFile {
    /// File name without a folder.
    pub name: String,
    /// Contents of the file.
    pub bytes: Vec<u8>,
}

/// Why a scene cannot be exported.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum ExportError {
    /// The scene exceeds the native format's limit of keys and values.
    #[error(
        "scene refused: a scene file would need {marks} keys and values, but the limit is {limit}. {todo}."
    )]
    TooBig {
        /// Number of keys, values and brackets.
        marks: usize,
        /// Limit of that number.
        limit: usize,
        /// Advice to the user.
        todo: &'static str,
    },
    /// An image cannot be encoded.
    #[error("scene refused: an image of {width} × {height} texels cannot be written: {why}.")]
    Picture {
        /// In texels.
        width: u32,
        /// In texels.
        height: u32,
        /// The encoder's message.
        why: String,
    },
}

/// The advice on a scene that needs too many keys and values. Each key of its animation takes at least six of them.
fn remedy(marks: usize, key_count: usize, clip_count: usize) -> &'static str {
    match 12 * key_count > marks {
        true if clip_count > 1 => {
            "The keys of its animation are most of them: choose one clip, or render the model as it is"
        }
        true => "The keys of its animation are most of them: render the model as it is",
        false => "Remove objects that are not copies of others",
    }
}

/// Exports `scene` as a native scene file. The names of its companion files start with `stem`. `is_taken`
/// tells whether a name belongs to a file with different contents; then another name is chosen, so that
/// no file is overwritten and older scene files stay valid.
///
/// # Errors
/// The scene is too large for a scene file, or an image cannot be encoded.
pub fn native(
    scene: &Scene,
    stem: &str,
    is_taken: &dyn Fn(&str, &[u8]) -> bool,
) -> Result<Export, ExportError> {
    let still;
    let scene = match scene.deformations.is_empty() {
        true => scene,
        false => {
            still = scene.at_rest(0.0);
            &still
        }
    };
    let mut writer = Writer {
        scene,
        names: Names::of(scene),
        beside: Beside::new(stem, is_taken),
        pictures: HashMap::new(),
    };
    let file = toml::Table::try_from(writer.file()?);
    let text = text::text(&file.expect("strings for keys, and values that TOML has"));
    let marks = text.bytes().filter(|b| b"[]{}.=,#\"'".contains(b)).count();
    if marks > MAX_MARKS {
        let limit = MAX_MARKS;
        let curves = scene.tracks.iter().map(|track| track.curve.times.len());
        return Err(ExportError::TooBig {
            marks,
            limit,
            todo: remedy(marks, curves.sum(), scene.clips.len()),
        });
    }
    Ok(Export {
        text,
        files: writer.beside.files,
    })
}

struct Writer<'a> {
    scene: &'a Scene,
    names: Names,
    beside: Beside<'a>,
    /// The names of image files, by image index.
    pictures: HashMap<(usize, pictures::Role), String>,
}

impl Writer<'_> {
    fn file(&mut self) -> Result<SceneFile, ExportError> {
        let scene = self.scene;
        // Pictures are numbered in this order.
        let background = self.background()?;
        let textures = scene.textures.iter().map(|it| self.texture(it));
        let textures = textures.collect::<Result<Vec<_>, _>>()?;
        let materials = scene.materials.iter().enumerate();
        let materials = materials.map(|(i, it)| self.material(i, it).map(Some));
        let materials = materials.collect::<Result<Vec<_>, _>>()?;
        let meshes = scene.meshes.iter().enumerate();
        let meshes: Vec<_> = meshes.map(|(i, it)| Some(self.mesh(i, it))).collect();
        let mut objects = self.instances();
        objects.extend(self.shapes());
        let cameras = scene.cameras.iter().enumerate();
        let mut cameras: Vec<_> = cameras.map(|(i, it)| self.camera(i, it).into()).collect();
        let lights = scene.lights.iter().enumerate();
        let nodes = scene.nodes.iter().enumerate();
        Ok(SceneFile {
            output: self.output(),
            background,
            ambient: differing(scene.ambient, Vec3::ZERO),
            shadows: differing(scene.shadows, Shadows::Opaque),
            section: scene.section.map(Into::into),
            staged: scene.staged.then_some(true),
            camera: cameras.pop_if(|_| scene.cameras.len() == 1),
            cameras,
            textures: named(&self.names.textures, textures),
            materials: named(&self.names.materials, materials),
            meshes: named(&self.names.meshes, meshes),
            nodes: nodes.map(|(i, it)| self.node(i, it).into()).collect(),
            groups: BTreeMap::new(),
            objects,
            lights: lights.map(|(i, it)| self.light(i, it).into()).collect(),
            animation: self.animations(),
        })
    }
}

/// Tables by name, in this order.
fn named<T>(names: &[String], tables: Vec<Option<T>>) -> BTreeMap<String, Spanned<T>> {
    let tables = names.iter().zip(tables).enumerate();
    tables
        .filter_map(|(index, (name, table))| {
            Some((name.clone(), Spanned::new(index..index, table?)))
        })
        .collect()
}
