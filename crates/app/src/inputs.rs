//! The files that a run reads. No output may overwrite them, also not through links.

use super::error::AppError;
use glimray_io::import::SceneFormat;
use std::path::{Path, PathBuf};

/// Files that were read, or that were looked for and not found.
#[derive(Clone, Debug, Default)]
pub struct Inputs(Vec<FileId>);

/// Identifies the file that a path leads to.
#[derive(Clone, Debug)]
struct FileId {
    /// `None` if the file does not exist.
    node: Option<Node>,
    /// The path with links in its folder resolved; `None` if the folder does not exist.
    place: Option<PathBuf>,
}

/// Device and inode number, which all hard links of a file share.
#[cfg(unix)]
type Node = (u64, u64);
/// The path with all links resolved.
#[cfg(not(unix))]
type Node = PathBuf;

impl Inputs {
    /// Identifies these files as they are now.
    pub fn new(paths: impl IntoIterator<Item = impl AsRef<Path>>) -> Self {
        let ids = paths.into_iter().map(|path| FileId::of(path.as_ref()));
        Self(ids.collect())
    }

    /// Whether `path` leads to one of them, also through symbolic or hard links.
    pub fn contain(&self, path: &Path) -> bool {
        let id = FileId::of(path);
        self.0.iter().any(|known| known.is_same(&id))
    }

    /// Refuses to write `what` to `path` if the path leads to one of them. `flag` names another path.
    ///
    /// # Errors
    /// [`AppError::Unwritable`].
    pub fn refuse_overwrite(&self, path: &Path, what: &str, flag: &str) -> Result<(), AppError> {
        match self.contain(path) {
            false => Ok(()),
            true => Err(AppError::Unwritable(format!(
                "cannot write the {what} ({}): this run reads that file. Name another one with {flag}.",
                path.display()
            ))),
        }
    }
}

impl FileId {
    fn of(path: &Path) -> Self {
        Self {
            node: node(path),
            place: place(path),
        }
    }

    fn is_same(&self, other: &Self) -> bool {
        match (&self.node, &other.node) {
            (Some(a), Some(b)) => a == b,
            _ => self.place.is_some() && self.place == other.place,
        }
    }
}

#[cfg(unix)]
fn node(path: &Path) -> Option<Node> {
    use std::os::unix::fs::MetadataExt as _;
    let found = path.metadata().ok()?;
    Some((found.dev(), found.ino()))
}

#[cfg(not(unix))]
fn node(path: &Path) -> Option<Node> {
    path.canonicalize().ok()
}

fn place(path: &Path) -> Option<PathBuf> {
    let folder = match path.parent() {
        Some(folder) if !folder.as_os_str().is_empty() => folder,
        _ => Path::new("."),
    };
    Some(folder.canonicalize().ok()?.join(path.file_name()?))
}

/// Whether two paths lead to the same file, whether it exists or not.
pub fn is_same(a: &Path, b: &Path) -> bool {
    a == b || FileId::of(a).is_same(&FileId::of(b))
}

/// Whether a file of this name may be a model, to which what it lacks is added, and not a whole scene. An archive may.
pub fn may_be_model(path: &Path) -> bool {
    SceneFormat::of(path).is_none_or(|format| format.is_model)
}
