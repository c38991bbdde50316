//! Files on disk: what a scene names must lie in its folder and be a plain file.

use super::error::{ImportError, fault};
use super::paths::reason;
use super::resolver::{FileError, Resolver, goes_down, normalized};
use std::cell::RefCell;
use std::fs::{self, File};
use std::io::{self, Read};
use std::path::{Path, PathBuf};

/// How many files are kept in mind; nobody watches more.
const MAX_SEEN: usize = 4096;

/// A folder on disk, and others beside it whose files may be named too. Names and links that lead out
/// of them are refused.
#[derive(Debug)]
pub struct Folder {
    /// Without links.
    root: PathBuf,
    /// Without links.
    allowed: Vec<PathBuf>,
    seen: RefCell<Vec<PathBuf>>,
}

impl Folder {
    /// The folder at `path`.
    ///
    /// # Errors
    /// It does not exist.
    pub fn new(path: &Path) -> Result<Self, ImportError> {
        Ok(Self {
            root: real("cannot find the scene folder", path)?,
            allowed: Vec::new(),
            seen: RefCell::default(),
        })
    }

    /// The folder that the file at `path` is in.
    ///
    /// # Errors
    /// It does not exist.
    pub fn of(path: &Path) -> Result<Self, ImportError> {
        match path.parent() {
            Some(parent) if parent != Path::new("") => Self::new(parent),
            _ => Self::new(Path::new(".")),
        }
    }

    /// The same, and the folders `dirs`, in which files may be named by absolute paths or by `..`.
    ///
    /// # Errors
    /// One of them does not exist.
    pub fn allowing(mut self, dirs: &[PathBuf]) -> Result<Self, ImportError> {
        for dir in dirs {
            let dir = real("cannot use the permitted folder", dir)?;
            self.allowed.push(dir);
        }
        Ok(self)
    }

    /// Every file that was looked for, each once: those too that are missing.
    pub fn seen(&self) -> Vec<PathBuf> {
        self.seen.borrow().clone()
    }

    fn note(&self, path: &Path) {
        let mut seen = self.seen.borrow_mut();
        if seen.len() < MAX_SEEN && !seen.iter().any(|known| known == path) {
            seen.push(path.to_owned());
        }
    }

    fn is_allowed(&self, path: &Path) -> bool {
        self.allowed.iter().any(|dir| path.starts_with(dir))
    }
}

impl Resolver for Folder {
    fn resolve(&self, base: &Path, name: &Path) -> Result<PathBuf, FileError> {
        // Decided by name alone, so that nothing outside is even looked at.
        let wanted = normalized(&self.root.join(base).join(name));
        if !(goes_down(name) || self.is_allowed(&wanted)) {
            return Err(FileError::Outside);
        }
        let real = wanted.canonicalize().map_err(|error| {
            self.note(&wanted);
            match error.kind() {
                io::ErrorKind::NotFound => FileError::Missing,
                _ => FileError::Failed(error),
            }
        })?;
        // Decided again once links are resolved.
        if !(real.starts_with(&self.root) || self.is_allowed(&real)) {
            return Err(FileError::Outside);
        }
        self.note(&real);
        match real.is_file() {
            true => Ok(real),
            false => Err(FileError::NotPlain),
        }
    }

    fn read(&self, path: &Path, limit: u64) -> Result<Vec<u8>, FileError> {
        read(path, limit)
    }
}

/// The bytes of the plain file at `path`, wherever it is: at most `limit`.
pub(super) fn read(path: &Path, limit: u64) -> Result<Vec<u8>, FileError> {
    // Asked before opening: opening a pipe would wait for a writer.
    let metadata = fs::metadata(path).map_err(FileError::Failed)?;
    if metadata.is_dir() {
        return Err(FileError::IsFolder);
    }
    if !metadata.is_file() {
        return Err(FileError::NotPlain);
    }
    let length = metadata.len();
    if length > limit {
        return Err(FileError::TooLong { length });
    }
    let mut bytes = Vec::new();
    let capacity = usize::try_from(length).unwrap_or(usize::MAX);
    let reserved = bytes.try_reserve_exact(capacity);
    reserved.map_err(|_| FileError::NoMemory { length })?;
    // The length may be a lie, as in /proc.
    let mut file = File::open(path).map_err(FileError::Failed)?.take(limit + 1);
    file.read_to_end(&mut bytes).map_err(FileError::Failed)?;
    match bytes.len() as u64 {
        length if length > limit => Err(FileError::TooLong { length }),
        _ => Ok(bytes),
    }
}

fn real(what: &str, dir: &Path) -> Result<PathBuf, ImportError> {
    dir.canonicalize().map_err(|error| {
        let todo = "Check that the folder exists";
        ImportError::Unreadable(fault(what, dir, &reason(&error), todo))
    })
}
