//! Catches panics caused by a lost device: `poll` and `submit` of wgpu 30 panic then, and so does code that
//! draws with the device, such as egui.

use super::{Gpu, GpuError};
use std::{
    cell::{Cell, RefCell},
    panic::{AssertUnwindSafe, catch_unwind},
};

thread_local! {
    static GUARDED: Cell<bool> = const { Cell::new(false) };
    static DRAWS_WITH: RefCell<Option<Gpu>> = const { RefCell::new(None) };
}

/// Whether a panic of this thread would be caught and handled, so that a panic hook can stay silent.
pub fn is_guarded() -> bool {
    GUARDED.get() || DRAWS_WITH.with_borrow(|gpu| gpu.as_ref().is_some_and(Gpu::is_lost))
}

/// Runs `draw`, which draws with the device of `gpu` on this thread and does not handle its loss.
///
/// # Errors
/// [`GpuError::Lost`] if it panicked and the device is lost. Any other panic is resumed.
pub fn surviving_loss<T>(gpu: &Gpu, draw: impl FnOnce() -> T) -> Result<T, GpuError> {
    let before = DRAWS_WITH.replace(Some(gpu.clone()));
    let result = catch_unwind(AssertUnwindSafe(draw));
    DRAWS_WITH.set(before);
    result.or_else(|panic| match gpu.is_lost() {
        true => Err(GpuError::Lost),
        false => std::panic::resume_unwind(panic),
    })
}

/// Runs `run`; `Err` if it panicked.
pub(super) fn catch<T>(run: impl FnOnce() -> T) -> Result<T, ()> {
    let before = GUARDED.replace(true);
    // A panic leaves only the state of the device inconsistent, and that is discarded with it.
    let result = catch_unwind(AssertUnwindSafe(run)).map_err(|_| ());
    GUARDED.set(before);
    result
}
