//! Reports which file an import is at.

use super::resolver::{FileError, Resolver};
use std::path::{Path, PathBuf};

/// A step of an import: each file of a scene is read, then imported.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Step<'p> {
    /// This file is read.
    Reading(&'p Path),
    /// The contents of this file are imported.
    Importing(&'p Path),
}

/// A resolver that reports the files that are read from it.
pub(super) struct Reporting<'r> {
    pub resolver: &'r dyn Resolver,
    pub report: &'r dyn Fn(Step),
}

impl Resolver for Reporting<'_> {
    fn resolve(&self, base: &Path, name: &Path) -> Result<PathBuf, FileError> {
        self.resolver.resolve(base, name)
    }

    fn read(&self, path: &Path, limit: u64) -> Result<Vec<u8>, FileError> {
        read(path, self.report, || self.resolver.read(path, limit))
    }
}

/// Reports the file at `path` before and after it is read.
pub(super) fn read(
    path: &Path,
    report: &dyn Fn(Step),
    read: impl FnOnce() -> Result<Vec<u8>, FileError>,
) -> Result<Vec<u8>, FileError> {
    report(Step::Reading(path));
    let bytes = read()?;
    report(Step::Importing(path));
    Ok(bytes)
}
