//! Importers: scene files to [`Scene`]s. [`load`] and [`load_from`] choose the format by the file
//! extension.
//!
//! `formats.rs` lists the formats; `toml` files are glimray's own.
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
mod corners;
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
pub(crate) mod native;
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
pub use formats::{FORMAT_KEYS, SCENE_ENDINGS, SCENE_FORMATS, SceneFormat};
pub use gltf::{GLTF_EXTENSIONS, Support, gltf_properties};
pub use options::{Axis, Baking, Environment, EnvironmentSource, Ground, Options, Staging};
#[cfg(not(target_arch = "wasm32"))]
pub use picture::smaller_pictures;
pub use picture::{Meaning, Pixels, pixels};
pub use resolver::{FileError, Memory, Resolver};
pub use stage::{framed_camera, is_framed};
#[cfg(not(target_arch = "wasm32"))]
pub use step::Step;
#[cfg(feature = "archive")]
pub use zipped::SCENE_MEMBER;

use error::fault;
use formats::MAX_GEOMETRY_BYTES;
use glimray_scene::{LightTransport, Picture, Scene};
use paths::Files;
use std::path::Path;
#[cfg(not(target_arch = "wasm32"))]
use std::path::PathBuf;
use std::sync::Arc;

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
    let named = match options.by_content {
        true => SceneFormat::of(path),
        false => Some(SceneFormat::required(path)?),
    };
    let most = named.map_or(MAX_GEOMETRY_BYTES, |format| format.max_bytes);
    let bytes = step::read(path, report, || folder::read(path, most));
    let bytes = bytes.map_err(|error| match named {
        Some(format) => format.unreadable(path, &error),
        None => paths::unreadable(path, &error, most),
    })?;
    let format = named.map_or_else(|| SceneFormat::of_content(path, &bytes), Ok)?;
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

/// Loads the scene `name` from `resolver`, which also provides the files that it refers to and decides which folders are
/// accessible. A file that [`Options::environment`] names is on the disk; browsers have none and leave the environment out.
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
    let format = SceneFormat::required(Path::new(name))?;
    let path = Files::of(resolver).resolve(name).map_err(|refusal| {
        refusal.into_error("scene", |why, todo| {
            ImportError::Malformed(fault("bad scene", Path::new(name), &why, todo))
        })
    })?;
    let bytes = resolver.read(&path, format.max_bytes);
    let bytes = bytes.map_err(|error| format.unreadable(&path, &error))?;
    let files = Files::of(resolver).named_in(&path);
    #[cfg(target_arch = "wasm32")]
    let options = &Options {
        environment: Environment::default(),
        ..options.clone()
    };
    let scene = format.scene(&path, bytes, options, &files);
    #[cfg(not(target_arch = "wasm32"))]
    let scene = scene.and_then(|mut scene| {
        environment::apply(&mut scene, &path, options, &|_| ())?;
        Ok(scene)
    });
    scene
}

/// Parses the scene in `text`, which must not refer to files. `name` stands for the file's path in
/// errors. If it ends in `.scene` or `.nff`, the text has that format, otherwise the native one.
///
/// # Errors
/// `text` is malformed or refers to a file, or an override is invalid.
pub fn parse(name: &str, text: &str, options: &Options) -> Result<Scene, ImportError> {
    let path = Path::new(name);
    let known = SceneFormat::of(path).filter(|format| !format.is_model);
    let format = known.unwrap_or(&SCENE_FORMATS[0]);
    format.scene(path, text.as_bytes().to_vec(), options, &Files::none())
}

/// Applies the last steps that all scenes need.
fn finish(scene: &mut Scene, options: &Options) {
    range::limit(scene);
    rounding::note(scene);
    corners::note(scene);
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
    Ok(texture(path, Meaning::Color)?.0)
}

/// Reads the image file at `path` for a texture whose values mean this, and notes on what is wrong with it.
///
/// # Errors
/// As [`picture()`].
#[cfg(not(target_arch = "wasm32"))]
pub fn texture(path: &Path, meaning: Meaning) -> Result<(Arc<Picture>, Vec<String>), ImportError> {
    let whole = path.canonicalize().unwrap_or_else(|_| path.to_owned());
    let folder = Folder::of(&whole)?;
    let name = whole.file_name().unwrap_or_default().to_string_lossy();
    named_picture(&folder, &name, path, meaning)
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
    let (picture, _) = named_picture(resolver, name, Path::new(name), Meaning::Color)?;
    Ok(picture)
}

/// Reads the image `name`, which errors show as `path`, and notes on it.
fn named_picture(
    resolver: &dyn Resolver,
    name: &str,
    path: &Path,
    meaning: Meaning,
) -> Result<(Arc<Picture>, Vec<String>), ImportError> {
    let files = Files::of(resolver);
    let quoted = source::quote(name.as_bytes());
    let mut pictures = picture::Pictures::new(&Options::default());
    let read = match files.resolve(name) {
        Ok(found) => pictures.picture(
            &picture::Place::File(found),
            &quoted,
            meaning.into(),
            &picture::reader(&files),
        ),
        Err(refusal) => Err(picture::Refused::File(refusal)),
    };
    let read = read.map(|picture| (picture, pictures.into_notes()));
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
