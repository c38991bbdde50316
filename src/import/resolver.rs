//! Where importers get files from: a folder, memory, or whatever implements [`Resolver`].

use std::collections::BTreeMap;
use std::io;
use std::path::{Component, Path, PathBuf};
use std::sync::Arc;

/// Finds and reads the files that a scene consists of. Importers ask for files in no other way, so
/// that scenes can come from memory or out of an archive as well.
///
/// A file is known by the path that [`Resolver::resolve`] returns for it: equal paths are one file, and
/// errors show them. What they mean otherwise is up to the resolver.
pub trait Resolver {
    /// The file called `name` in a file of the folder `base`, which is the parent of a path returned
    /// before, or empty for the root. Names come out of scene files, whose authors nobody knows; their
    /// folders are parted by `/`, and they are neither empty nor URLs.
    ///
    /// # Errors
    /// [`FileError::Missing`] if there is no such file, [`FileError::Outside`] if the name leads to
    /// where scenes may not read, [`FileError::NotPlain`] for a folder, [`FileError::Failed`].
    fn resolve(&self, base: &Path, name: &Path) -> Result<PathBuf, FileError>;

    /// The bytes of the file at `path`, which [`Resolver::resolve`] returned.
    ///
    /// # Errors
    /// [`FileError::TooLong`] if they are more than `limit`, and whatever keeps them from being read.
    fn read(&self, path: &Path, limit: u64) -> Result<Vec<u8>, FileError>;
}

/// Why a [`Resolver`] has no file.
#[derive(Debug, thiserror::Error)]
pub enum FileError {
    /// There is none of that name.
    #[error("no such file")]
    Missing,
    /// The name leads out of what scenes may read.
    #[error("outside of what may be read")]
    Outside,
    /// It is a folder.
    #[error("it is a folder")]
    IsFolder,
    /// It is a pipe, a device or the like.
    #[error("it is not a plain file")]
    NotPlain,
    /// It is longer than what was asked for.
    #[error("{length} bytes")]
    TooLong {
        /// Bytes that it has, as far as is known.
        length: u64,
    },
    /// There is not enough memory for it.
    #[error("{length} bytes do not fit into the memory")]
    NoMemory {
        /// Bytes that it has.
        length: u64,
    },
    /// The system refused.
    #[error("{0}")]
    Failed(#[source] io::Error),
}

/// Files in memory, by their names: `a.toml`, `meshes/b.ply`. Files name each other as they do in
/// folders.
#[derive(Clone, Debug, Default)]
pub struct Memory(BTreeMap<PathBuf, Arc<[u8]>>);

impl Memory {
    /// Adds a file, or replaces the one of that name. `name` is relative to the root, its folders are
    /// parted by `/`.
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

/// The path of a file among those of a map, which have normalized paths; see [`Resolver::resolve`].
pub(super) fn located<T>(
    files: &BTreeMap<PathBuf, T>,
    base: &Path,
    name: &Path,
) -> Result<PathBuf, FileError> {
    if !goes_down(name) {
        return Err(FileError::Outside);
    }
    let path = normalized(&base.join(name));
    if files.contains_key(&path) {
        return Ok(path);
    }
    let is_folder = files.keys().any(|file| file.starts_with(&path));
    Err(match is_folder {
        true => FileError::IsFolder,
        false => FileError::Missing,
    })
}

/// Whether the name stays in its folder or goes into folders of it.
pub(super) fn goes_down(name: &Path) -> bool {
    name.components()
        .all(|part| matches!(part, Component::Normal(_) | Component::CurDir))
}

/// `path` with its `.` and `..` carried out by name alone.
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
