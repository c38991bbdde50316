//! Waiting for the device, for programs whose threads may wait. In a browser none may.

use super::{AdapterChoice, AdapterReport, Gpu, GpuError, adapters_async, guard};
use std::{
    cell::RefCell,
    pin::pin,
    task::{Context, Poll, Waker},
    thread,
    time::Duration,
};

/// Time limit of one wait for the device.
const WAIT: Duration = Duration::from_secs(10);

thread_local! {
    /// The work for which the pending future of this thread waits.
    static AWAITED: RefCell<Option<(wgpu::Device, wgpu::SubmissionIndex)>> = const { RefCell::new(None) };
}

/// Notes that a future of this thread waits for this work.
pub(super) fn note(device: &wgpu::Device, index: &wgpu::SubmissionIndex) {
    AWAITED.set(Some((device.clone(), index.clone())));
}

/// The output of a future of this library. This thread sleeps while the GPU works.
pub fn wait<T>(future: impl Future<Output = T>) -> T {
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
            // Another thread may be about to report what it polled.
            None => thread::yield_now(),
        }
    }
}

/// Awaits [`adapters_async`].
pub fn adapters(choice: &AdapterChoice) -> Vec<AdapterReport> {
    wait(adapters_async(choice))
}

impl Gpu {
    /// Awaits [`Gpu::open`].
    ///
    /// # Errors
    /// There is no such adapter, or it cannot be opened.
    pub fn new(choice: &AdapterChoice) -> Result<Self, GpuError> {
        wait(Self::open(choice))
    }

    /// Awaits [`Gpu::open_with_all_limits`].
    ///
    /// # Errors
    /// As [`Gpu::new`].
    pub fn with_all_limits(choice: &AdapterChoice) -> Result<Self, GpuError> {
        wait(Self::open_with_all_limits(choice))
    }
}
