//! Files on disk: a scene may only refer to plain files in its folder.

use super::error::{ImportError, fault};
use super::paths::reason;
use super::resolver::{FileError, Resolver, goes_down, normalized};
use std::cell::RefCell;
use std::fs::{self, File};
use std::io::{self, Read};
use std::path::{Path, PathBuf};

/// The number of files that are recorded for watching.
const MAX_REQUESTED: usize = 4096;

/// A folder on disk, and permitted folders besides it. Names and symbolic links that point outside them
/// are refused.
#[derive(Debug)]
pub struct Folder {
    /// Canonical path.
    root: PathBuf,
    /// Canonical paths.
    allowed: Vec<PathBuf>,
    requested: RefCell<Vec<PathBuf>>,
}

impl Folder {
    /// The folder at `path`.
    ///
    /// # Errors
    /// The folder does not exist.
    pub fn new(path: &Path) -> Result<Self, ImportError> {
        Ok(Self {
            root: real("cannot find the scene folder", path)?,
            allowed: Vec::new(),
            requested: RefCell::default(),
        })
    }

    /// The folder that contains the file at `path`.
    ///
    /// # Errors
    /// The folder does not exist.
    pub fn of(path: &Path) -> Result<Self, ImportError> {
        match path.parent() {
            Some(parent) if parent != Path::new("") => Self::new(parent),
            _ => Self::new(Path::new(".")),
        }
    }

    /// Also permits the folders `dirs`, whose files may be named by absolute paths or with `..`.
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

    /// Every file that was looked up, once each, including missing ones.
    pub fn requested(&self) -> Vec<PathBuf> {
        self.requested.borrow().clone()
    }

    fn record(&self, path: &Path) {
        let mut requested = self.requested.borrow_mut();
        if requested.len() < MAX_REQUESTED && !requested.iter().any(|known| known == path) {
            requested.push(path.to_owned());
        }
    }

    fn is_allowed(&self, path: &Path) -> bool {
        self.allowed.iter().any(|dir| path.starts_with(dir))
    }
}

impl Resolver for Folder {
    fn resolve(&self, base: &Path, name: &Path) -> Result<PathBuf, FileError> {
        // Decide by name alone first, so that nothing outside is even accessed.
        let wanted = normalized(&self.root.join(base).join(name));
        if !(goes_down(name) || self.is_allowed(&wanted)) {
            return Err(FileError::Outside);
        }
        let real = wanted.canonicalize().map_err(|error| {
            self.record(&wanted);
            match error.kind() {
                io::ErrorKind::NotFound => FileError::Missing,
                _ => FileError::Failed(error),
            }
        })?;
        // Decide again after resolving symbolic links.
        if !(real.starts_with(&self.root) || self.is_allowed(&real)) {
            return Err(FileError::Outside);
        }
        self.record(&real);
        // The name that the scene knows it by, behind a symbolic link.
        self.record(&wanted);
        match real.is_file() {
            true => Ok(real),
            false => Err(FileError::NotPlain),
        }
    }

    fn read(&self, path: &Path, limit: u64) -> Result<Vec<u8>, FileError> {
        read(path, limit)
    }
}

/// Reads the plain file at `path`, at most `limit` bytes.
pub(super) fn read(path: &Path, limit: u64) -> Result<Vec<u8>, FileError> {
    // Check before opening: opening a pipe would block until there is a writer.
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
    // The reported length may be wrong, as in /proc.
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
