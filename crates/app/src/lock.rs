//! Allows one run at a time per folder of frames and per checkpoint. The system releases the lock when a process ends,
//! however it ends, so a killed run blocks nobody.

use super::console;
use super::error::AppError;
use glimray_io::output::{self, OutputError, RemoveOnExit};
use std::fs::{self, File, OpenOptions, TryLockError};
use std::io::{self, ErrorKind};
use std::path::{Path, PathBuf};

const NAME: &str = ".glimray.lock";

/// Keeps other runs out of a folder, or away from a checkpoint, until it is dropped.
pub struct Lock {
    path: PathBuf,
    /// `None` if the file system has no locks.
    file: Option<File>,
    _remove_on_exit: RemoveOnExit,
}

/// The lock file of `folder`.
pub fn path(folder: &Path) -> PathBuf {
    folder.join(NAME)
}

impl Lock {
    /// Locks `folder`.
    ///
    /// # Errors
    /// Another run holds the lock, or the lock file cannot be written.
    pub fn of_folder(folder: &Path) -> Result<Self, AppError> {
        let name = format!("the folder {}", folder.display());
        Self::acquire(path(folder), &name, || {
            format!(
                "cannot write frames (folder {}): another run is writing there. Wait until it ends, or choose another \
                 folder.",
                folder.display()
            )
        })
    }

    /// Locks `checkpoint`, whose lock file is beside it.
    ///
    /// # Errors
    /// As [`Self::of_folder`], or there is another file in place of the lock file.
    pub fn of_checkpoint(checkpoint: &Path) -> Result<Self, AppError> {
        let name = checkpoint.display();
        let mut path = checkpoint.as_os_str().to_owned();
        path.push(".lock");
        if fs::metadata(&path).is_ok_and(|found| found.len() > 0) {
            return Err(AppError::Unwritable(format!(
                "cannot lock the checkpoint ({}): the file is not a lock. Move it away, or name another checkpoint.",
                path.display()
            )));
        }
        Self::acquire(path.into(), &format!("the checkpoint {name}"), || {
            format!(
                "cannot keep a checkpoint ({name}): another run is writing there. Wait until it ends, or name another \
                 file with --checkpoint."
            )
        })
    }

    /// Locks what `name` describes with the file `path`. `busy` is the error if another run holds it.
    fn acquire(path: PathBuf, name: &str, busy: impl FnOnce() -> String) -> Result<Self, AppError> {
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
                    return Err(AppError::Unwritable(busy()));
                }
                Err(TryLockError::Error(error)) if error.kind() == ErrorKind::Unsupported => {
                    console::warning(format_args!(
                        "cannot lock {name}: the file system has no locks. Make sure that no other run writes there."
                    ));
                    None
                }
                Err(TryLockError::Error(source)) => return Err(failed(source).into()),
            };
            // Another run may have ended meanwhile and removed the file that is locked now.
            let is_current = (file.as_ref()).map_or(Ok(true), |file| is_same(file, &path));
            if is_current.map_err(failed)? {
                let listed = RemoveOnExit::make(|| Ok(()), |()| path.clone());
                let ((), registered) = listed.map_err(failed)?;
                return Ok(Self {
                    path,
                    file,
                    _remove_on_exit: registered,
                });
            }
        }
    }
}

impl Drop for Lock {
    /// Removes the file while it is still locked. A run that has opened it meanwhile opens it again.
    fn drop(&mut self) {
        // Other systems cannot tell an open file from a new one of the same name, so the file stays.
        if cfg!(unix) || self.file.is_none() {
            let _ = fs::remove_file(&self.path);
        }
    }
}

/// Whether `path` still leads to `file`.
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
