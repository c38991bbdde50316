//! Files that must not outlive the process: temporary files and locks. Their owner removes them; if a
//! signal ends the process, they are removed here.

use std::fs;
use std::io;
use std::path::PathBuf;
use std::sync::{Mutex, PoisonError};
use std::time::Duration;

static UNFINISHED: Mutex<Vec<PathBuf>> = Mutex::new(Vec::new());

/// How often [`remove_unfinished_files`] tries to lock the list, and the pause between two attempts: a thread that
/// creates a file on a disk that does not respond holds the lock.
const ATTEMPTS: u32 = 50;
const PAUSE: Duration = Duration::from_millis(10);

/// A file that is removed when the process ends, unless this is dropped first.
#[derive(Debug)]
pub struct RemoveOnExit(PathBuf);

impl RemoveOnExit {
    /// Creates a file and registers it as `path`, atomically with respect to [`remove_unfinished_files`].
    ///
    /// # Errors
    /// The errors of `make`.
    pub fn make<T>(
        make: impl FnOnce() -> io::Result<T>,
        path: impl FnOnce(&T) -> PathBuf,
    ) -> io::Result<(T, Self)> {
        let mut listed = UNFINISHED.lock().unwrap_or_else(PoisonError::into_inner);
        let made = make()?;
        let path = path(&made);
        listed.push(path.clone());
        Ok((made, Self(path)))
    }
}

impl Drop for RemoveOnExit {
    fn drop(&mut self) {
        let mut listed = UNFINISHED.lock().unwrap_or_else(PoisonError::into_inner);
        if let Some(at) = listed.iter().position(|path| *path == self.0) {
            listed.swap_remove(at);
        }
    }
}

/// Removes all registered files and prevents new ones. Called when the process is about to end.
pub fn remove_unfinished_files() {
    for _ in 0..ATTEMPTS {
        if let Ok(listed) = UNFINISHED.try_lock() {
            for path in listed.iter() {
                let _ = fs::remove_file(path);
            }
            std::mem::forget(listed);
            return;
        }
        std::thread::sleep(PAUSE);
    }
}
