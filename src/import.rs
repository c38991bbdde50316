//! Scene files into [`Scene`]s: [`load`] chooses the importer by the file's ending.
//!
//! | ending | format | module |
//! |---|---|---|
//! | `.toml` | glimray's own | `native.rs` |
//! | `.scene` | the course's | `course.rs` |
//! | `.nff` | Haines' Neutral File Format | `nff.rs` |
//! | `.obj` | Wavefront OBJ with MTL | `obj.rs` |
//!
//! `ply.rs` reads Stanford's PLY files, of which native scenes place triangles and points.
//! Pictures that scenes and models name are read by `picture.rs`.
//!
//! Files are hostile until read: nothing here panics, follows a path out of the scene's folder, or
//! takes more memory than eight times the file's size (and 64 MiB; see `budget.rs`). Colours that no
//! arithmetic could bear are lowered (`range.rs`). What cannot be rendered but does no harm is left
//! out and named in [`Scene::skipped`]; everything else is one [`ImportError`] with the place it
//! happened at.

mod budget;
mod course;
mod error;
mod native;
mod nff;
mod notes;
mod number;
mod obj;
mod paths;
mod picture;
mod ply;
mod polygon;
mod range;
mod source;
mod stage;
mod suggest;

pub use error::{Excerpt, Fault, ImportError, Position};

use crate::scene::{Picture, Scene};
use error::fault;
use paths::{Files, Seen};
use source::Source;
use std::path::{Path, PathBuf};
use std::sync::Arc;

/// What a caller may add to a scene file.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Options {
    /// Folders outside the scene's own in which it may name files.
    pub allow_dirs: Vec<PathBuf>,
    /// `KEY=VALUE` pairs that replace or add one value of a native scene each, such as
    /// `camera.fov_y_deg=30`, `objects.0.sphere.radius=2` or `output.tone=aces`. Values are TOML; a
    /// bare word is a string.
    pub overrides: Vec<String>,
}

/// The endings of the files that [`load`] reads, in lower case.
pub const SCENE_ENDINGS: &[&str] = &["toml", "scene", "nff", "obj"];

/// The endings of the files that [`picture()`] reads, as they usually are.
pub const PICTURE_ENDINGS: &[&str] = &["hdr", "exr", "png", "jpg", "jpeg"];

/// The largest geometry file (`.scene`, `.nff`, `.obj`) that is read, in bytes.
const MAX_GEOMETRY_BYTES: u64 = 2 << 30;

/// The scene in the file at `path`, with default [`Options`].
///
/// # Errors
/// See [`load_with`].
pub fn load(path: &Path) -> Result<Scene, ImportError> {
    load_with(path, &Options::default())
}

/// The scene in the file at `path`.
///
/// # Errors
/// The file or one it names is missing, unreadable, too big, malformed or outside the scene's
/// folder; the ending is unknown; an override does not fit, or the format takes none.
pub fn load_with(path: &Path, options: &Options) -> Result<Scene, ImportError> {
    load_seen(path, options, &Seen::default())
}

/// The scene in the file at `path`, and every file that it comes from or asked for: the file itself,
/// meshes, material libraries, pictures; those too that are missing. Whoever watches them for changes
/// knows when to load it again, whether it could be loaded or not.
pub fn load_watched(path: &Path, options: &Options) -> (Result<Scene, ImportError>, Vec<PathBuf>) {
    let seen = Seen::default();
    seen.note(path);
    (load_seen(path, options, &seen), seen.paths())
}

fn load_seen(path: &Path, options: &Options, seen: &Seen) -> Result<Scene, ImportError> {
    let mut scene = load_as_written(path, options, seen)?;
    range::limit(&mut scene);
    scene.pin_render_origin();
    Ok(scene)
}

/// The scene in the file at `path`, whatever its colours are.
fn load_as_written(path: &Path, options: &Options, seen: &Seen) -> Result<Scene, ImportError> {
    let ending = path.extension().unwrap_or_default().to_ascii_lowercase();
    let is_native = match ending.to_str() {
        Some("toml") => true,
        Some("scene" | "nff" | "obj") => false,
        _ => return Err(unknown_format(path)),
    };
    if is_native {
        let files = Files::beside(path, &options.allow_dirs, seen)?;
        return native::read(&native::open(path)?, options, &files);
    }
    if !options.overrides.is_empty() {
        let why = "only native scenes (.toml) have keys to set";
        let fault = fault("override refused", path, why, "Leave out the overrides");
        return Err(ImportError::Malformed(fault));
    }
    let bytes = paths::read(path, MAX_GEOMETRY_BYTES)?;
    if ending == "scene" {
        return course::read(&Source::new("bad scene", path, bytes)?);
    }
    if ending == "nff" {
        return nff::read(&Source::new("bad scene", path, bytes)?);
    }
    let files = Files::beside(path, &options.allow_dirs, seen)?;
    obj::read_scene(&Source::new("bad model", path, bytes)?, &files)
}

/// The scene in `text`, which can name no files. `name` stands for the file's path in errors; if it
/// ends in `.scene` or `.nff` the text is in that format, else in the native one.
///
/// # Errors
/// `text` is malformed or names a file, or an override does not fit.
pub fn parse(name: &str, text: &str, options: &Options) -> Result<Scene, ImportError> {
    let path = Path::new(name);
    let source = Source::new("bad scene", path, text.as_bytes().to_vec())?;
    let mut scene = match path.extension().and_then(|ending| ending.to_str()) {
        Some("scene") => course::read(&source),
        Some("nff") => nff::read(&source),
        _ => native::read(&source, options, &Files::none()),
    }?;
    range::limit(&mut scene);
    scene.pin_render_origin();
    Ok(scene)
}

/// The picture in the file at `path`, as linear colours.
///
/// # Errors
/// The file is missing, unreadable, too big, or no picture that is known.
pub fn picture(path: &Path) -> Result<Arc<Picture>, ImportError> {
    let whole = path.canonicalize().unwrap_or_else(|_| path.to_owned());
    let files = Files::beside(&whole, &[], &Seen::default())?;
    let name = whole.file_name().unwrap_or_default().to_string_lossy();
    let mut pictures = picture::Pictures::default();
    match pictures.read(&files, &name) {
        Ok(index) => Ok(pictures.pictures.swap_remove(index)),
        Err(refused) => Err(refused.into_error(|why, todo| {
            ImportError::Malformed(fault("picture refused", path, &why, todo))
        })),
    }
}

/// The JSON Schema (2020-12) of the native format, for editors that complete and check TOML.
pub fn native_schema() -> serde_json::Value {
    native::schema()
}

fn unknown_format(path: &Path) -> ImportError {
    let ending = path.extension().map_or_else(
        || "the name has no ending".to_owned(),
        |ending| {
            let ending = format!(".{}", ending.to_string_lossy());
            format!(
                "the ending {} is not known",
                source::quote(ending.as_bytes())
            )
        },
    );
    ImportError::UnknownFormat(fault(
        "unknown scene format",
        path,
        &ending,
        "Name a .toml (native), .scene (course), .nff or .obj (Wavefront) file",
    ))
}
