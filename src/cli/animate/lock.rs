//! One run at a time in a folder. The system lets go of the lock when a process ends, however it
//! ends, so that a killed run is in nobody's way.

use crate::app::console;
use crate::app::error::AppError;
use crate::output::{self, Litter, OutputError};
use std::fs::{self, File, OpenOptions, TryLockError};
use std::io::{self, ErrorKind};
use std::path::{Path, PathBuf};

const NAME: &str = ".glimray.lock";

/// Keeps other runs out of a folder until it is dropped.
pub struct Lock {
    path: PathBuf,
    /// `None` where the file system has no locks.
    file: Option<File>,
    _litter: Litter,
}

/// The file in `folder` that is locked.
pub fn path(folder: &Path) -> PathBuf {
    folder.join(NAME)
}

impl Lock {
    /// Locks `folder`.
    ///
    /// # Errors
    /// Another run has it, or no file can be written there.
    pub fn take(folder: &Path) -> Result<Self, AppError> {
        let path = path(folder);
        output::check_no_link(&path)?;
        loop {
            let failed = |source| OutputError::Io {
                path: path.clone(),
                source,
            };
            let file = OpenOptions::new()
                .create(true)
                .truncate(false)
                .write(true)
                .open(&path)
                .map_err(failed)?;
            let file = match file.try_lock() {
                Ok(()) => Some(file),
                Err(TryLockError::WouldBlock) => {
                    return Err(AppError::Unwritable(format!(
                        "cannot write frames (folder {}): another run is writing there. Wait until it \
                         has ended, or choose another folder.",
                        folder.display()
                    )));
                }
                Err(TryLockError::Error(error)) if error.kind() == ErrorKind::Unsupported => {
                    console::warning(format_args!(
                        "cannot lock the folder {}: its file system has no locks. Let no other run \
                         write there.",
                        folder.display()
                    ));
                    None
                }
                Err(TryLockError::Error(source)) => return Err(failed(source).into()),
            };
            // A run that ended in between has removed the file that we have locked.
            let is_current = (file.as_ref()).map_or(Ok(true), |file| is_same(file, &path));
            if is_current.map_err(failed)? {
                let listed = Litter::make(|| Ok(()), |()| path.clone());
                let ((), litter) = listed.map_err(failed)?;
                return Ok(Self {
                    path,
                    file,
                    _litter: litter,
                });
            }
        }
    }
}

impl Drop for Lock {
    /// Removes the file while it is still locked: whoever has opened it meanwhile looks again.
    fn drop(&mut self) {
        // Elsewhere an open file cannot be told from another one of its name, and stays.
        if cfg!(unix) || self.file.is_none() {
            let _ = fs::remove_file(&self.path);
        }
    }
}

/// Whether `file` is what `path` names.
#[cfg(unix)]
fn is_same(file: &File, path: &Path) -> io::Result<bool> {
    use std::os::unix::fs::MetadataExt as _;
    let ours = file.metadata()?;
    match fs::metadata(path) {
        Ok(found) => Ok((found.dev(), found.ino()) == (ours.dev(), ours.ino())),
        Err(error) if error.kind() == ErrorKind::NotFound => Ok(false),
        Err(error) => Err(error),
    }
}

#[cfg(not(unix))]
fn is_same(_: &File, _: &Path) -> io::Result<bool> {
    Ok(true)
}
