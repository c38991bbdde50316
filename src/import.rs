//! Importers: scene files to [`Scene`]s. [`load`] and [`load_from`] choose the format by the file
//! extension.
//!
//! | extension | format | module |
//! |---|---|---|
//! | `.toml` | glimray's own | `native.rs` |
//! | `.scene` | the course's | `course.rs` |
//! | `.nff` | Haines' Neutral File Format | `nff.rs` |
//! | `.obj` | Wavefront OBJ with MTL | `obj.rs` |
//! | `.gltf`, `.glb` | glTF 2.0 | `gltf.rs` |
//! | `.ply` | Stanford PLY, text or binary; also meshes and point sets of native scenes | `ply.rs` |
//! | `.stl` | STL, text or binary | `stl.rs` |
//! | `.zip` | an archive of any of these with its files (feature `archive`) | `zipped.rs` |
//!
//! `picture.rs` reads the images that scenes and models refer to. `model.rs` and `stage.rs` make a scene of a model.
//!
//! Importers get files from a [`Resolver`]: a [`Folder`] on disk, [`Memory`], an `Archive`, or an
//! implementation of the caller.
//!
//! Files are not trusted: nothing here panics, follows a path out of the scene's folder, or takes more
//! memory than eight times the file's size plus 64 MiB (see `budget.rs`). Colours so large that
//! arithmetic would overflow are clamped (`range.rs`). Features that cannot be rendered are skipped and
//! listed in [`Scene::skipped`]; everything else is one [`ImportError`] with its position.

#[cfg(feature = "archive")]
mod archive;
mod budget;
mod course;
mod crease;
mod encoding;
#[cfg(not(target_arch = "wasm32"))]
mod environment;
mod error;
mod faults;
#[cfg(not(target_arch = "wasm32"))]
mod folder;
mod formats;
mod gltf;
mod levels;
mod model;
mod native;
mod nff;
mod notes;
mod number;
mod obj;
mod options;
mod paths;
mod picture;
mod ply;
mod polygon;
mod range;
mod resolver;
mod rounding;
mod source;
mod stage;
#[cfg(not(target_arch = "wasm32"))]
mod step;
mod stl;
mod suggest;
mod tangent;
mod tint;
mod uvs;
mod visibility;
mod weld;
#[cfg(feature = "archive")]
mod zipped;

#[cfg(feature = "archive")]
pub use archive::Archive;
pub use error::{Excerpt, Fault, ImportError, Position};
#[cfg(not(target_arch = "wasm32"))]
pub use folder::Folder;
pub use formats::{FORMAT_KEYS, SCENE_FORMATS, SceneFormat};
pub use gltf::{GLTF_EXTENSIONS, Support};
pub use options::{Axis, Baking, Environment, EnvironmentSource, Ground, Options, Staging};
pub use picture::{Pixels, pixels};
pub use resolver::{FileError, Memory, Resolver};
#[cfg(not(target_arch = "wasm32"))]
pub use step::Step;
#[cfg(feature = "archive")]
pub use zipped::SCENE_MEMBER;

use crate::scene::{LightTransport, Picture, Scene};
use error::fault;
use paths::Files;
use source::Source;
use std::path::Path;
#[cfg(not(target_arch = "wasm32"))]
use std::path::PathBuf;
use std::sync::Arc;

/// The extensions of the files that [`load`] reads, in lower case.
pub const SCENE_ENDINGS: &[&str] = &[
    "toml",
    "scene",
    "nff",
    "obj",
    "gltf",
    "glb",
    "ply",
    "stl",
    #[cfg(feature = "archive")]
    "zip",
];

/// The usual extensions of the files that [`picture()`] reads.
pub const PICTURE_ENDINGS: &[&str] = &[
    "hdr",
    "exr",
    "png",
    "jpg",
    "jpeg",
    "webp",
    #[cfg(feature = "basis")]
    "ktx2",
];

/// Size limit of a geometry file (`.scene`, `.nff`, `.obj`, `.gltf`, `.glb`, `.ply`, `.stl`) in bytes.
const MAX_GEOMETRY_BYTES: u64 = 2 << 30;

/// The scene formats.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Format {
    Native,
    Course,
    Nff,
    Obj,
    Gltf,
    Ply,
    Stl,
    #[cfg(feature = "archive")]
    Zip,
}

impl Format {
    /// The format of a file extension.
    fn of(path: &Path) -> Result<Self, ImportError> {
        let ending = path.extension().unwrap_or_default().to_ascii_lowercase();
        match ending.to_str() {
            Some("toml") => Ok(Self::Native),
            Some("scene") => Ok(Self::Course),
            Some("nff") => Ok(Self::Nff),
            Some("obj") => Ok(Self::Obj),
            Some("gltf" | "glb") => Ok(Self::Gltf),
            Some("ply") => Ok(Self::Ply),
            Some("stl") => Ok(Self::Stl),
            #[cfg(feature = "archive")]
            Some("zip") => Ok(Self::Zip),
            _ => Err(formats::unknown(path)),
        }
    }

    /// Whether files have a model rather than a whole scene.
    fn is_model(self) -> bool {
        !matches!(self, Self::Native | Self::Course | Self::Nff)
    }

    /// Whether files have scenes of other formats in them.
    fn is_archive(self) -> bool {
        match self {
            #[cfg(feature = "archive")]
            Self::Zip => true,
            _ => false,
        }
    }

    /// The format's size limit for files, in bytes.
    fn limit(self) -> u64 {
        match self {
            Self::Native => native::MAX_BYTES,
            _ => MAX_GEOMETRY_BYTES,
        }
    }

    /// The error for a scene file that could not be read.
    fn unreadable(self, path: &Path, error: &FileError) -> ImportError {
        match paths::unreadable(path, error, self.limit()) {
            // The size limit belongs to the format; it is not for lack of memory.
            ImportError::TooBig(fault) if self == Self::Native => ImportError::Malformed(fault),
            error => error,
        }
    }

    /// The scene in `bytes`, the contents of the file at `path`.
    fn scene(
        self,
        path: &Path,
        bytes: Vec<u8>,
        options: &Options,
        files: &Files,
    ) -> Result<Scene, ImportError> {
        let has_keys = self == Self::Native || self.is_archive();
        if !has_keys && !options.overrides.is_empty() {
            let why = "only native scenes (.toml) have keys to set";
            let fault = fault("override refused", path, why, "Leave out the overrides");
            return Err(ImportError::Malformed(fault));
        }
        options.check_model_flags(self, path)?;
        if !self.is_model() && options.up.is_some() {
            let why = "only models have an axis that points up";
            let todo = "Leave it out, or give the camera an up direction";
            return Err(ImportError::Malformed(fault(
                "up axis refused",
                path,
                why,
                todo,
            )));
        }
        let what = match self {
            Self::Obj => "bad model",
            _ => "bad scene",
        };
        let source = |bytes| match self {
            Self::Native => Source::new(what, path, bytes),
            _ => Source::of_any_encoding(what, path, bytes),
        };
        let mut scene = match self {
            Self::Native => native::read(&source(bytes)?, options, files),
            Self::Course => course::read(&source(bytes)?),
            Self::Nff => nff::read(&source(bytes)?),
            Self::Obj => obj::read_scene(&source(bytes)?, files, options),
            Self::Gltf => gltf::read(path, bytes, options, files),
            Self::Ply => ply::read_scene(path, &bytes, options),
            Self::Stl => stl::read_scene(path, bytes, options),
            #[cfg(feature = "archive")]
            // It is already limited.
            Self::Zip => return zipped::read_scene(path, bytes, options),
        }?;
        finish(&mut scene, options);
        Ok(scene)
    }
}

impl Options {
    /// Refuses the options for glTF models where there is no such model.
    fn check_model_flags(&self, format: Format, path: &Path) -> Result<(), ImportError> {
        let given = [
            ("scene", &self.scene),
            ("clip", &self.clip),
            ("variant", &self.variant),
        ];
        match given.iter().find(|(_, value)| value.is_some()) {
            Some((what, _)) if !(format == Format::Gltf || format.is_archive()) => {
                let why = format!("only glTF models have a {what} to choose");
                let fault = fault("choice refused", path, &why, "Leave out the choice");
                Err(ImportError::Malformed(fault))
            }
            _ => Ok(()),
        }
    }
}

/// Loads the scene file at `path` with default [`Options`].
///
/// # Errors
/// See [`load_with`].
#[cfg(not(target_arch = "wasm32"))]
pub fn load(path: &Path) -> Result<Scene, ImportError> {
    load_with(path, &Options::default())
}

/// Loads the scene file at `path`.
///
/// # Errors
/// The file or one that it refers to is missing, unreadable, too large, malformed or outside the scene's
/// folder; the extension is unknown; an override is invalid, or the format has no overrides.
#[cfg(not(target_arch = "wasm32"))]
pub fn load_with(path: &Path, options: &Options) -> Result<Scene, ImportError> {
    load_seen(path, options, &mut Vec::new(), &|_| ())
}

/// Loads the scene file at `path` and returns every file that it depends on: the scene file, meshes,
/// material libraries and images, including missing ones. A caller that watches these files knows when to
/// reload the scene, also if loading failed. `report` is called before each [`Step`].
#[cfg(not(target_arch = "wasm32"))]
pub fn load_watched(
    path: &Path,
    options: &Options,
    report: &dyn Fn(Step),
) -> (Result<Scene, ImportError>, Vec<PathBuf>) {
    let mut seen = vec![path.to_owned()];
    let scene = load_seen(path, options, &mut seen, report);
    (scene, seen)
}

#[cfg(not(target_arch = "wasm32"))]
fn load_seen(
    path: &Path,
    options: &Options,
    seen: &mut Vec<PathBuf>,
    report: &dyn Fn(Step),
) -> Result<Scene, ImportError> {
    let format = Format::of(path)?;
    let bytes = step::read(path, report, || folder::read(path, format.limit()));
    let bytes = bytes.map_err(|error| format.unreadable(path, &error))?;
    let folder = Folder::of(path)?.allowing(&options.allow_dirs)?;
    let files = step::Reporting {
        resolver: &folder,
        report,
    };
    let scene = format.scene(path, bytes, options, &Files::of(&files));
    let own = options.environment.file().map(Path::to_owned);
    for file in folder.requested().into_iter().chain(own) {
        if !seen.contains(&file) {
            seen.push(file);
        }
    }
    let mut scene = scene?;
    environment::apply(&mut scene, path, options, report)?;
    Ok(scene)
}

/// Loads the scene `name` from `resolver`, which also provides the files that it refers to. Only the
/// overrides of `options` apply: the resolver decides which folders are accessible.
///
/// # Errors
/// See [`load_with`].
///
/// ```
/// use glimray::import::{self, Memory, Options};
/// let files = Memory::from_iter([
///     ("scene.toml", "[[objects]]\nmesh = { file = 'models/a.obj' }".as_bytes()),
///     ("models/a.obj", b"v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3"),
/// ]);
/// let scene = import::load_from(&files, "scene.toml", &Options::default())?;
/// assert_eq!(scene.triangle_count(), 1);
/// # Ok::<(), import::ImportError>(())
/// ```
pub fn load_from(
    resolver: &dyn Resolver,
    name: &str,
    options: &Options,
) -> Result<Scene, ImportError> {
    let format = Format::of(Path::new(name))?;
    let path = Files::of(resolver).resolve(name).map_err(|refusal| {
        refusal.into_error("scene", |why, todo| {
            ImportError::Malformed(fault("bad scene", Path::new(name), &why, todo))
        })
    })?;
    let bytes = resolver.read(&path, format.limit());
    let bytes = bytes.map_err(|error| format.unreadable(&path, &error))?;
    let files = Files::of(resolver).named_in(&path);
    let options = Options {
        environment: Environment::default(),
        ..options.clone()
    };
    format.scene(&path, bytes, &options, &files)
}

/// Parses the scene in `text`, which must not refer to files. `name` stands for the file's path in
/// errors. If it ends in `.scene` or `.nff`, the text has that format, otherwise the native one.
///
/// # Errors
/// `text` is malformed or refers to a file, or an override is invalid.
pub fn parse(name: &str, text: &str, options: &Options) -> Result<Scene, ImportError> {
    let path = Path::new(name);
    let source = Source::new("bad scene", path, text.as_bytes().to_vec())?;
    let mut scene = match path.extension().and_then(|ending| ending.to_str()) {
        Some("scene") => course::read(&source),
        Some("nff") => nff::read(&source),
        _ => native::read(&source, options, &Files::none()),
    }?;
    finish(&mut scene, options);
    Ok(scene)
}

/// What all scenes need at last.
fn finish(scene: &mut Scene, options: &Options) {
    range::limit(scene);
    rounding::note(scene);
    scene.complete_tangents();
    let shows_maps = match options.baking {
        Baking::Never => false,
        Baking::IfClassical => scene.output.integrator == LightTransport::Whitted,
        Baking::Always => true,
    };
    if shows_maps {
        scene.bake_classical_maps();
    }
    scene.pin_render_origin();
}

/// Reads the image file at `path` as linear colours.
///
/// # Errors
/// The file is missing, unreadable, too large, or not a supported image.
#[cfg(not(target_arch = "wasm32"))]
pub fn picture(path: &Path) -> Result<Arc<Picture>, ImportError> {
    let whole = path.canonicalize().unwrap_or_else(|_| path.to_owned());
    let folder = Folder::of(&whole)?;
    let name = whole.file_name().unwrap_or_default().to_string_lossy();
    named_picture(&folder, &name, path)
}

/// Reads the equirectangular panorama at `path`, as [`Environment`] names one, and notes on what is wrong with it.
///
/// # Errors
/// As [`picture()`], or it is not twice as wide as high.
#[cfg(not(target_arch = "wasm32"))]
pub fn environment(path: &Path) -> Result<(Arc<Picture>, Vec<String>), ImportError> {
    let (picture, notes) = environment::read(path, &Options::default(), &|_| ())?;
    Ok((Arc::new(picture), notes))
}

/// Reads the image `name` from `resolver` as linear colours.
///
/// # Errors
/// See [`picture()`].
pub fn picture_from(resolver: &dyn Resolver, name: &str) -> Result<Arc<Picture>, ImportError> {
    named_picture(resolver, name, Path::new(name))
}

/// Reads the image `name`, which errors show as `path`.
fn named_picture(
    resolver: &dyn Resolver,
    name: &str,
    path: &Path,
) -> Result<Arc<Picture>, ImportError> {
    let files = Files::of(resolver);
    let quoted = source::quote(name.as_bytes());
    let read = match files.resolve(name) {
        Ok(found) => picture::Pictures::new(&Options::default()).picture(
            &picture::Place::File(found),
            &quoted,
            picture::Role::Color,
            &picture::reader(&files),
        ),
        Err(refusal) => Err(picture::Refused::File(refusal)),
    };
    read.map_err(|refused| {
        refused.into_error(|why, todo| {
            ImportError::Malformed(fault("picture refused", path, &why, todo))
        })
    })
}

/// The JSON Schema (2020-12) of the native format, for editors with TOML completion and validation.
pub fn native_schema() -> serde_json::Value {
    native::schema()
}
