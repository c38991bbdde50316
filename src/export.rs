//! A [`Scene`] into a native scene file, as a person would have written it: sections in a fixed order,
//! everything named that something else refers to, and only what differs from the defaults.
//!
//! Nothing is lost: [`crate::import`] makes of the text and the files beside it a scene that is packed
//! to the same bytes, and writing that scene gives the same text. A number is written in as few digits
//! as give back all its bits. Angles, scales and corners take the place of a matrix where they give
//! that matrix exactly. Not kept are [`Scene::skipped`], the grouping of tracks, pictures that nothing
//! shows, and names that are missing or given twice, in whose place new ones are made up.
//!
//! Nothing here touches a disk: whoever calls writes the files, those beside the scene first.

mod animation;
mod cameras;
mod exact;
mod files;
mod lights;
mod materials;
mod names;
mod objects;
mod output;
mod pictures;
mod ply;
mod runs;
mod shapes;
mod text;
mod textures;

use crate::scene::Scene;
use files::Beside;
use names::Names;
use std::collections::HashMap;
use text::Text;

/// A scene as a file, and what lies beside it.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Export {
    /// The scene file itself, in TOML.
    pub text: String,
    /// Files that it names, relative to its folder: meshes, pictures, places of copies.
    pub files: Vec<ExportFile>,
}

/// A file beside a scene file.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct ExportFile {
    /// Its name, without a folder.
    pub name: String,
    /// All of it.
    pub bytes: Vec<u8>,
}

/// Why a scene cannot be written.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum ExportError {
    /// A native scene has a limit on how much it may say.
    #[error(
        "scene refused: it has so many different things that a scene file would take {marks} keys \
         and values, but at most {limit} are read. Leave out objects that no copy of one stands for."
    )]
    TooBig {
        /// Keys, values and brackets.
        marks: usize,
        /// How many there may be.
        limit: usize,
    },
    /// A picture cannot be encoded.
    #[error("scene refused: a picture of {width} × {height} texels cannot be written: {why}.")]
    Picture {
        /// In texels.
        width: u32,
        /// In texels.
        height: u32,
        /// What the encoder says.
        why: String,
    },
}

/// How many keys, values and brackets the importer of the native format reads.
const MAX_MARKS: usize = 500_000;

/// `scene` as a native scene file. The names of files beside it begin with `stem`; `is_taken` says
/// whether a name belongs to a file with other contents than these, so that another one is chosen:
/// no file has to be overwritten, and an older scene file goes on to find what it names.
///
/// # Errors
/// There is too much in the scene for a scene file, or a picture that cannot be encoded.
pub fn native(
    scene: &Scene,
    stem: &str,
    is_taken: &dyn Fn(&str, &[u8]) -> bool,
) -> Result<Export, ExportError> {
    let mut writer = Writer {
        scene,
        names: Names::of(scene),
        beside: Beside::new(stem, is_taken),
        pictures: HashMap::new(),
        text: Text::new(),
    };
    writer.root()?;
    writer.output();
    writer.cameras();
    writer.lights();
    writer.textures()?;
    writer.materials();
    writer.meshes();
    writer.nodes();
    writer.instances();
    writer.shapes();
    writer.animations();
    let text = writer.text.finish();
    let marks = text.bytes().filter(|b| b"[]{}.=,#\"'".contains(b)).count();
    if marks > MAX_MARKS {
        let limit = MAX_MARKS;
        return Err(ExportError::TooBig { marks, limit });
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
    /// The files of pictures, by their index.
    pictures: HashMap<usize, String>,
    text: Text,
}
