//! Readback from the GPU; all of it happens here.

use super::{Gpu, GpuError, guard};
use glimray_scene::bytes::sizes;
use std::sync::{Arc, Condvar, Mutex};
use std::time::Duration;

/// Time between two looks whether the device is lost while another thread reports.
const LOOK: Duration = Duration::from_millis(100);

/// A range of a buffer to read back.
pub(crate) struct Source<'a> {
    pub buffer: &'a wgpu::Buffer,
    pub offset: u64,
    pub bytes: u64,
}

/// Submitted work whose results will be read back. Dropping it discards the results; the work itself still
/// runs.
pub(crate) struct Reading {
    staging: wgpu::Buffer,
    bytes: u64,
    submission: wgpu::SubmissionIndex,
    mapped: Arc<Mapped>,
}

/// The outcome of mapping a staging buffer. The thread that polls the device reports it.
#[derive(Default)]
struct Mapped {
    outcome: Mutex<Option<Result<(), wgpu::BufferAsyncError>>>,
    reported: Condvar,
}

impl Mapped {
    fn report(&self, outcome: Result<(), wgpu::BufferAsyncError>) {
        if let Ok(mut slot) = self.outcome.lock() {
            *slot = Some(outcome);
        }
        self.reported.notify_all();
    }

    /// Returns once it is reported, or after [`LOOK`].
    fn wait(&self) {
        if let Ok(slot) = self.outcome.lock() {
            let _ = (self.reported).wait_timeout_while(slot, LOOK, |slot| slot.is_none());
        }
    }
}

impl Reading {
    /// The result of the mapping, once it has completed.
    fn outcome(&self) -> Option<Result<(), GpuError>> {
        let mapped = self.mapped.outcome.lock().ok()?;
        let outcome = mapped.as_ref()?;
        Some(outcome.as_ref().map_err(|_| GpuError::Lost).copied())
    }
}

impl Drop for Reading {
    fn drop(&mut self) {
        // This also cancels a pending request: copies to a mapped buffer are not allowed.
        let _ = guard::catch(|| self.staging.unmap());
    }
}

impl Gpu {
    /// Submits `encoder`, followed by copies of `sources`, one after the other, to `staging`, and requests its
    /// mapping. Does not wait. `staging` must be mappable for reading, large enough, and not used by another
    /// reading.
    pub(crate) fn submit_reading(
        &self,
        mut encoder: wgpu::CommandEncoder,
        sources: &[Source],
        staging: &wgpu::Buffer,
    ) -> Result<Reading, GpuError> {
        let all: u64 = sources.iter().map(|source| source.bytes).sum();
        if all > staging.size() {
            let [has, all] = sizes([staging.size(), all]);
            let what = format!("a staging buffer of {has} is for {all}");
            return Err(GpuError::Internal { what });
        }
        let mut bytes = 0;
        for source in sources {
            encoder.copy_buffer_to_buffer(
                source.buffer,
                source.offset,
                staging,
                bytes,
                source.bytes,
            );
            bytes += source.bytes;
        }
        let commands = guard::catch(|| encoder.finish()).map_err(|()| GpuError::Lost)?;
        let submission = self.enqueue(commands)?;
        let mapped = Arc::new(Mapped::default());
        let on_mapped = mapped.clone();
        guard::catch(|| {
            staging.map_async(wgpu::MapMode::Read, 0..bytes, move |outcome| {
                on_mapped.report(outcome);
            });
        })
        .map_err(|()| GpuError::Lost)?;
        Ok(Reading {
            staging: staging.clone(),
            bytes,
            submission,
            mapped,
        })
    }

    /// Whether the results can be read. Does not wait.
    pub(crate) fn is_readable(&self, reading: &Reading) -> Result<bool, GpuError> {
        let polled = guard::catch(|| self.device.poll(wgpu::PollType::Poll));
        polled
            .map_err(|()| GpuError::Lost)?
            .map_err(|_| GpuError::Lost)?;
        self.check()?;
        reading
            .outcome()
            .map_or(Ok(false), |read| read.map(|()| true))
    }

    /// Waits for completion and passes the results to `read`.
    pub(crate) fn read<T>(
        &self,
        reading: Reading,
        read: impl FnOnce(&[u8]) -> T,
    ) -> Result<T, GpuError> {
        self.wait(reading.submission.clone())?;
        // The driver may have finished before wgpu reports it, and another thread may be about to report what it polled.
        let mut looks = self.adapter().steps_of_patience(LOOK);
        while !self.is_readable(&reading)? {
            // A browser's thread cannot wait.
            if cfg!(target_arch = "wasm32") || looks == 0 {
                return Err(GpuError::Lost);
            }
            looks -= 1;
            reading.mapped.wait();
        }
        let slice = reading.staging.slice(0..reading.bytes);
        (slice.get_mapped_range())
            .map(|view| read(&view))
            .map_err(|_| GpuError::Lost)
    }

    /// Submits, waits and reads.
    pub(crate) fn submit_and_read<T>(
        &self,
        encoder: wgpu::CommandEncoder,
        sources: &[Source],
        staging: &wgpu::Buffer,
        read: impl FnOnce(&[u8]) -> T,
    ) -> Result<T, GpuError> {
        let reading = self.submit_reading(encoder, sources, staging)?;
        self.read(reading, read)
    }
}
