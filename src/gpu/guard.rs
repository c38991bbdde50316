//! Catches panics that a lost device is the cause of: `poll` and `submit` of wgpu 30 panic then, and so
//! does who draws with the device, as egui does.

use super::{Gpu, GpuError};
use std::{
    cell::{Cell, RefCell},
    panic::{AssertUnwindSafe, catch_unwind},
};

thread_local! {
    static GUARDED: Cell<bool> = const { Cell::new(false) };
    static DRAWS_WITH: RefCell<Option<Gpu>> = const { RefCell::new(None) };
}

/// Whether a panic of this thread would be caught and dealt with, so that a panic hook can keep
/// silent about it.
pub fn is_guarded() -> bool {
    GUARDED.get() || DRAWS_WITH.with_borrow(|gpu| gpu.as_ref().is_some_and(Gpu::is_lost))
}

/// What `draw` returns, which draws with the device of `gpu` on this thread and knows nothing of its
/// loss.
///
/// # Errors
/// [`GpuError::Lost`] if it panicked when the device was lost. Any other panic goes on.
pub fn surviving_loss<T>(gpu: &Gpu, draw: impl FnOnce() -> T) -> Result<T, GpuError> {
    let before = DRAWS_WITH.replace(Some(gpu.clone()));
    let result = catch_unwind(AssertUnwindSafe(draw));
    DRAWS_WITH.set(before);
    result.or_else(|panic| match gpu.is_lost() {
        true => Err(GpuError::Lost),
        false => std::panic::resume_unwind(panic),
    })
}

/// What `run` returns, or `Err` if it panicked.
pub(super) fn catch<T>(run: impl FnOnce() -> T) -> Result<T, ()> {
    let before = GUARDED.replace(true);
    // What a panic leaves half done is the device's state, and that is thrown away with it.
    let result = catch_unwind(AssertUnwindSafe(run)).map_err(|_| ());
    GUARDED.set(before);
    result
}
