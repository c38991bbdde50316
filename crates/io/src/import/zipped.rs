//! A ZIP archive of a model with its files, read in memory.

use super::archive::Archive;
use super::error::{ImportError, fault};
use super::paths::{self, Files};
use super::resolver::{FileError, Resolver};
use super::source::quote;
use super::{Options, SCENE_ENDINGS, SceneFormat};
use glimray_scene::Scene;
use glimray_scene::text::one_line;
use std::cell::Cell;
use std::path::{Path, PathBuf};

/// A file of an archive that names the archive's scene, for archives with several.
pub const SCENE_MEMBER: &str = ".glimray-scene";

/// The most bytes of such a name.
const MAX_NAME: u64 = 4096;

/// Bytes that files may unpack to, for each byte of the archive. Models compress to about a fifth; of a
/// decompression bomb every byte becomes up to a thousand.
const PER_BYTE: u64 = 64;

/// Bytes that may be unpacked in addition.
const ALWAYS: u64 = 64 << 20;

/// An archive of which only so much is unpacked.
struct Bounded {
    archive: Archive,
    /// Bytes that may still be unpacked.
    left: Cell<u64>,
}

impl Resolver for Bounded {
    fn resolve(&self, base: &Path, name: &Path) -> Result<PathBuf, FileError> {
        self.archive.resolve(base, name)
    }

    fn read(&self, path: &Path, limit: u64) -> Result<Vec<u8>, FileError> {
        let bytes = self.archive.read(path, limit.min(self.left.get()))?;
        self.left.set(self.left.get() - bytes.len() as u64);
        Ok(bytes)
    }
}

/// The scene in the archive `bytes`, the contents of the file at `path`: the one that [`SCENE_MEMBER`] names, or the first one of the folder nearest
/// to the root, in the order of [`SCENE_ENDINGS`] and then of names. Others are noted.
pub(super) fn read_scene(
    path: &Path,
    bytes: Vec<u8>,
    options: &Options,
) -> Result<Scene, ImportError> {
    let refuse = |why: &str, todo: &str| {
        Err(ImportError::Malformed(fault(
            "bad archive",
            path,
            why,
            todo,
        )))
    };
    let length = bytes.len() as u64;
    let archive = match Archive::new(bytes) {
        Ok(archive) => archive,
        Err(error) => {
            let why = one_line(&error.to_string());
            return refuse(&why, "Check that it was written completely");
        }
    };
    let mut scenes: Vec<(usize, usize, PathBuf)> = (archive.names())
        .filter_map(|name| rank(name).map(|rank| (name.components().count(), rank, name.into())))
        .collect();
    scenes.sort();
    if let Some(name) = named(&archive) {
        scenes = vec![(0, 0, name)];
    }
    let Some((_, _, name)) = scenes.first().cloned() else {
        let why = format!(
            "none of its {} files is a scene or model",
            archive.names().count()
        );
        return refuse(&why, "Put a scene or model into it");
    };
    let files = Bounded {
        archive,
        left: Cell::new(ALWAYS + PER_BYTE.saturating_mul(length)),
    };
    let format = SceneFormat::required(&name)?;
    let limit = format.max_bytes.min(files.left.get());
    let bytes = files.read(&name, format.max_bytes);
    let bytes = bytes.map_err(|error| paths::unreadable(&name, &error, limit))?;
    let mut scene = format.scene(&name, bytes, options, &Files::of(&files).named_in(&name))?;
    if scenes.len() > 1 {
        let name = quote(name.to_string_lossy().as_bytes());
        let more = scenes.len() - 1;
        scene.skipped.push(format!(
            "only {name} is shown: the archive has {more} more scene(s)"
        ));
    }
    Ok(scene)
}

/// The scene that the archive's [`SCENE_MEMBER`] names, if it is there.
fn named(archive: &Archive) -> Option<PathBuf> {
    let bytes = archive.read(Path::new(SCENE_MEMBER), MAX_NAME).ok()?;
    let text = String::from_utf8(bytes).ok()?;
    let name = Path::new(text.trim());
    (archive.names())
        .find(|found| *found == name)
        .map(Into::into)
}

/// The place of a file's ending among those of scenes, but archives; `None` for other files, and those that
/// macOS adds to archives.
fn rank(name: &Path) -> Option<usize> {
    let mut parts = name
        .components()
        .filter_map(|part| part.as_os_str().to_str());
    if parts.any(|part| part.starts_with('.') || part == "__MACOSX") {
        return None;
    }
    let ending = name.extension()?;
    let place = (SCENE_ENDINGS.iter()).position(|known| ending.eq_ignore_ascii_case(known));
    place.filter(|_| SceneFormat::of(name).is_some_and(|format| !format.is_archive()))
}
