//! Waiting for the device, for programs whose threads may wait. In a browser none may.

use super::{AdapterChoice, AdapterReport, Gpu, GpuError, adapters_async, guard};
use std::{
    cell::{Cell, RefCell},
    pin::pin,
    task::{Context, Poll, Waker},
    thread,
    time::Duration,
};

/// Time limit of one wait for the device.
const WAIT: Duration = Duration::from_secs(10);

thread_local! {
    /// The number of calls of [`wait`] that this thread is in.
    static WAITING: Cell<u32> = const { Cell::new(0) };
    /// The work for which the pending future of this thread waits.
    static AWAITED: RefCell<Option<(wgpu::Device, wgpu::SubmissionIndex)>> = const { RefCell::new(None) };
}

/// Notes that a future of this thread waits for this work. Other executors do not ask, and a note would keep the device.
pub(super) fn note(device: &wgpu::Device, index: &wgpu::SubmissionIndex) {
    if WAITING.get() > 0 {
        AWAITED.set(Some((device.clone(), index.clone())));
    }
}

/// A call of [`wait`], to its end or panic.
struct Call;

impl Call {
    fn begin() -> Self {
        WAITING.set(WAITING.get() + 1);
        Self
    }
}

impl Drop for Call {
    fn drop(&mut self) {
        WAITING.set(WAITING.get() - 1);
    }
}

/// Runs a future of this library to its end, and returns its output. The thread sleeps while the GPU works. A future of
/// another library is polled once per millisecond.
pub fn wait<T>(future: impl Future<Output = T>) -> T {
    let _call = Call::begin();
    let mut future = pin!(future);
    let mut context = Context::from_waker(Waker::noop());
    loop {
        if let Poll::Ready(output) = future.as_mut().poll(&mut context) {
            return output;
        }
        match AWAITED.take() {
            Some((device, index)) => {
                let poll = wgpu::PollType::Wait {
                    submission_index: Some(index),
                    timeout: Some(WAIT),
                };
                // The future finds out what went wrong.
                let _ = guard::catch(|| device.poll(poll));
            }
            // Nothing here can wake the thread.
            None => thread::sleep(Duration::from_millis(1)),
        }
    }
}

/// All adapters that can run compute shaders, in the order of their indices.
pub fn adapters(choice: &AdapterChoice) -> Vec<AdapterReport> {
    wait(adapters_async(choice))
}

impl Gpu {
    /// Opens the adapter that `choice` names, or the fastest kind available, with the default limits of WebGPU.
    ///
    /// # Errors
    /// There is no such adapter, or it cannot be opened.
    pub fn new(choice: &AdapterChoice) -> Result<Self, GpuError> {
        wait(Self::open(choice))
    }

    /// Opens an adapter with its maximum buffer and texture limits, for a device that is shared with other code.
    ///
    /// # Errors
    /// As [`Gpu::new`].
    pub fn with_all_limits(choice: &AdapterChoice) -> Result<Self, GpuError> {
        wait(Self::open_with_all_limits(choice))
    }
}
