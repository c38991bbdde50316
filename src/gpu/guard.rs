//! Catches wgpu's own panics: `poll` and `submit` panic on a lost device (wgpu 30).

use std::{
    cell::Cell,
    panic::{AssertUnwindSafe, catch_unwind},
};

thread_local! {
    static GUARDED: Cell<bool> = const { Cell::new(false) };
}

/// Whether a panic of this thread would be caught and dealt with, so that a panic hook can keep
/// silent about it.
pub fn is_guarded() -> bool {
    GUARDED.get()
}

/// What `run` returns, or `Err` if it panicked.
pub(super) fn quiet<T>(run: impl FnOnce() -> T) -> Result<T, ()> {
    let before = GUARDED.replace(true);
    // What a panic leaves half done is the device's state, and that is thrown away with it.
    let result = catch_unwind(AssertUnwindSafe(run)).map_err(|_| ());
    GUARDED.set(before);
    result
}
