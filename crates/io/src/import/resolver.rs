//! Where importers get files from: a folder, memory, or any implementation of [`Resolver`].

use glimray_scene::bytes::size;
use std::collections::BTreeMap;
use std::io;
use std::path::{Component, Path, PathBuf};
use std::sync::Arc;

/// Finds and reads the files that a scene consists of. Importers access files only through it, so scenes
/// can also come from memory or an archive.
///
/// A file is identified by the path that [`Resolver::resolve`] returns for it: equal paths are the same
/// file, and errors show them. Otherwise their meaning is up to the resolver.
pub trait Resolver {
    /// The file `name`, relative to the folder `base`, which is the parent of a path returned before, or
    /// empty for the root. Names come from scene files, which are not trusted; folders are separated by
    /// `/`, and names are neither empty nor URLs.
    ///
    /// # Errors
    /// [`FileError::Missing`] if there is no such file, [`FileError::Outside`] if the name points outside
    /// the folders that scenes may read, [`FileError::NotPlain`] for a folder, [`FileError::Failed`].
    fn resolve(&self, base: &Path, name: &Path) -> Result<PathBuf, FileError>;

    /// Reads the file at `path`, which [`Resolver::resolve`] returned.
    ///
    /// # Errors
    /// [`FileError::TooLong`] if it has more than `limit` bytes, and any error that prevents reading it.
    fn read(&self, path: &Path, limit: u64) -> Result<Vec<u8>, FileError>;
}

/// Why a [`Resolver`] cannot provide a file.
#[derive(Debug, thiserror::Error)]
pub enum FileError {
    /// There is no file of that name.
    #[error("no such file")]
    Missing,
    /// The name points outside the folders that scenes may read.
    #[error("outside the folders that may be read")]
    Outside,
    /// The name is that of a folder.
    #[error("it is a folder")]
    IsFolder,
    /// The name is that of a pipe, a device or similar.
    #[error("it is not a plain file")]
    NotPlain,
    /// The file is longer than the limit.
    #[error("{}", size(*length))]
    TooLong {
        /// Length of the file in bytes, as far as known.
        length: u64,
    },
    /// There is not enough memory for it.
    #[error("{} do not fit into memory", size(*length))]
    NoMemory {
        /// Length of the file in bytes.
        length: u64,
    },
    /// The operating system refused.
    #[error("{0}")]
    Failed(#[source] io::Error),
}

/// Files in memory by name: `a.toml`, `meshes/b.ply`. Files refer to each other as in folders.
#[derive(Clone, Debug, Default)]
pub struct Memory(BTreeMap<PathBuf, Arc<[u8]>>);

impl Memory {
    /// Adds a file, or replaces the one of that name. `name` is relative to the root, with folders
    /// separated by `/`.
    pub fn insert(&mut self, name: impl AsRef<Path>, bytes: impl Into<Arc<[u8]>>) {
        self.0.insert(normalized(name.as_ref()), bytes.into());
    }
}

impl<N: AsRef<Path>, B: Into<Arc<[u8]>>> FromIterator<(N, B)> for Memory {
    fn from_iter<I: IntoIterator<Item = (N, B)>>(files: I) -> Self {
        let mut memory = Self::default();
        for (name, bytes) in files {
            memory.insert(name, bytes);
        }
        memory
    }
}

impl Resolver for Memory {
    fn resolve(&self, base: &Path, name: &Path) -> Result<PathBuf, FileError> {
        located(&self.0, base, name)
    }

    fn read(&self, path: &Path, limit: u64) -> Result<Vec<u8>, FileError> {
        let bytes = self.0.get(path).ok_or(FileError::Missing)?;
        match bytes.len() as u64 {
            length if length > limit => Err(FileError::TooLong { length }),
            _ => Ok(bytes.to_vec()),
        }
    }
}

/// Looks a file up in a map with normalised paths; see [`Resolver::resolve`]. All files of the map belong to the scene, so a
/// name may go up, but not above the root.
pub(super) fn located<T>(
    files: &BTreeMap<PathBuf, T>,
    base: &Path,
    name: &Path,
) -> Result<PathBuf, FileError> {
    let path = base.join(name);
    if !stays_inside(&path) {
        return Err(FileError::Outside);
    }
    let path = normalized(&path);
    if files.contains_key(&path) {
        return Ok(path);
    }
    let is_folder = files.keys().any(|file| file.starts_with(&path));
    Err(match is_folder {
        true => FileError::IsFolder,
        false => FileError::Missing,
    })
}

/// Whether the name stays in its folder or a subfolder.
#[cfg(any(feature = "archive", not(target_arch = "wasm32")))]
pub(super) fn goes_down(name: &Path) -> bool {
    name.components()
        .all(|part| matches!(part, Component::Normal(_) | Component::CurDir))
}

/// Whether no part of the path is above its root.
fn stays_inside(path: &Path) -> bool {
    let mut depth = 0_usize;
    path.components().all(|part| {
        let next = match part {
            Component::Normal(_) => depth.checked_add(1),
            Component::CurDir => Some(depth),
            Component::ParentDir => depth.checked_sub(1),
            Component::RootDir | Component::Prefix(_) => None,
        };
        depth = next.unwrap_or_default();
        next.is_some()
    })
}

/// `path` with `.` and `..` resolved lexically.
pub(super) fn normalized(path: &Path) -> PathBuf {
    let mut result = PathBuf::new();
    for component in path.components() {
        match component {
            Component::CurDir => {}
            Component::ParentDir => {
                result.pop();
            }
            other => result.push(other),
        }
    }
    result
}
