//! Files in a ZIP archive.

use super::resolver::{FileError, Resolver, goes_down, located, normalized};
use std::cell::RefCell;
use std::collections::BTreeMap;
use std::io::{self, Cursor, Read};
use std::path::{Path, PathBuf};
use zip::ZipArchive;
use zip::result::ZipError;

/// A ZIP archive in memory. Files refer to each other as in folders, and nothing is unpacked to disk. A
/// file is read up to the requested limit, whatever length the archive claims.
#[derive(Debug)]
pub struct Archive {
    /// Reading moves its cursor.
    archive: RefCell<ZipArchive<Cursor<Vec<u8>>>>,
    /// Indices of entries by name, without names that point outside the archive.
    files: BTreeMap<PathBuf, usize>,
}

impl Archive {
    /// Opens the archive in `bytes`.
    ///
    /// # Errors
    /// [`FileError::Failed`] if `bytes` are not a ZIP archive or it is damaged.
    pub fn new(bytes: Vec<u8>) -> Result<Self, FileError> {
        let mut archive = ZipArchive::new(Cursor::new(bytes)).map_err(failed)?;
        let mut files = BTreeMap::new();
        for index in 0..archive.len() {
            let file = archive.by_index_raw(index).map_err(failed)?;
            let name = file.name().map_err(failed)?.replace('\\', "/");
            if file.is_file() && goes_down(Path::new(&name)) {
                files.insert(normalized(Path::new(&name)), index);
            }
        }
        Ok(Self {
            archive: RefCell::new(archive),
            files,
        })
    }

    /// Names of the files in the archive, sorted.
    pub fn names(&self) -> impl Iterator<Item = &Path> {
        self.files.keys().map(PathBuf::as_path)
    }
}

impl Resolver for Archive {
    fn resolve(&self, base: &Path, name: &Path) -> Result<PathBuf, FileError> {
        located(&self.files, base, name)
    }

    fn read(&self, path: &Path, limit: u64) -> Result<Vec<u8>, FileError> {
        let index = *self.files.get(path).ok_or(FileError::Missing)?;
        let mut archive = self.archive.borrow_mut();
        let file = archive.by_index(index).map_err(failed)?;
        let length = file.size();
        if length > limit {
            return Err(FileError::TooLong { length });
        }
        let mut bytes = Vec::new();
        let mut file = file.take(limit.saturating_add(1));
        file.read_to_end(&mut bytes).map_err(FileError::Failed)?;
        match bytes.len() as u64 {
            length if length > limit => Err(FileError::TooLong { length }),
            _ => Ok(bytes),
        }
    }
}

fn failed(error: ZipError) -> FileError {
    FileError::Failed(match error {
        ZipError::Io(error) => error,
        other => io::Error::new(io::ErrorKind::InvalidData, other),
    })
}
