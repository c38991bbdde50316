//! Files that must not outlive the process: parts of files that are being written, and locks. Each is
//! removed by whoever made it; a process that a signal ends has them cleared away here.

use std::fs;
use std::io;
use std::path::PathBuf;
use std::sync::{Mutex, PoisonError};
use std::time::Duration;

static LITTER: Mutex<Vec<PathBuf>> = Mutex::new(Vec::new());

/// How often [`clear_away`] tries to get at the list, and the pause between two attempts: a thread that
/// makes a file on a disk that does not answer holds it.
const ATTEMPTS: u32 = 50;
const PAUSE: Duration = Duration::from_millis(10);

/// A file that is cleared away with the process until this is dropped.
#[derive(Debug)]
pub struct Litter(PathBuf);

impl Litter {
    /// Makes a file and lists it at `path`, as one step for [`clear_away`].
    ///
    /// # Errors
    /// Those of `make`.
    pub fn make<T>(
        make: impl FnOnce() -> io::Result<T>,
        path: impl FnOnce(&T) -> PathBuf,
    ) -> io::Result<(T, Self)> {
        let mut listed = LITTER.lock().unwrap_or_else(PoisonError::into_inner);
        let made = make()?;
        let path = path(&made);
        listed.push(path.clone());
        Ok((made, Self(path)))
    }
}

impl Drop for Litter {
    fn drop(&mut self) {
        let mut listed = LITTER.lock().unwrap_or_else(PoisonError::into_inner);
        if let Some(at) = listed.iter().position(|path| *path == self.0) {
            listed.swap_remove(at);
        }
    }
}

/// Removes all files that are listed, and lets nobody make another one: to be called by a process that
/// is about to end.
pub fn clear_away() {
    for _ in 0..ATTEMPTS {
        if let Ok(listed) = LITTER.try_lock() {
            for path in listed.iter() {
                let _ = fs::remove_file(path);
            }
            std::mem::forget(listed);
            return;
        }
        std::thread::sleep(PAUSE);
    }
}
