//! The only way back from the GPU.

use super::{Gpu, GpuError, guard};
use std::sync::{Arc, Mutex};

/// A part of a buffer to be read.
pub(crate) struct Source<'a> {
    pub buffer: &'a wgpu::Buffer,
    pub offset: u64,
    pub bytes: u64,
}

/// Work that was submitted, and what is to be read of it. Dropping it gives the result up; the work
/// itself still runs.
pub(crate) struct Reading {
    staging: wgpu::Buffer,
    bytes: u64,
    submission: wgpu::SubmissionIndex,
    /// Set by wgpu once the staging buffer can be read.
    mapped: Arc<Mutex<Option<Result<(), wgpu::BufferAsyncError>>>>,
}

impl Reading {
    /// Whether the bytes are there.
    fn outcome(&self) -> Option<Result<(), GpuError>> {
        let mapped = self.mapped.lock().ok()?;
        let outcome = mapped.as_ref()?;
        Some(outcome.as_ref().map_err(|_| GpuError::Lost).copied())
    }
}

impl Drop for Reading {
    fn drop(&mut self) {
        // Also takes back a request that was not answered yet: a mapped buffer takes no copies.
        let _ = guard::catch(|| self.staging.unmap());
    }
}

impl Gpu {
    /// Submits `encoder` and asks for what is in `sources` when it is done, one after the other. Does not
    /// wait. `staging` must be mappable for reading, hold them all, and belong to no other reading.
    pub(crate) fn submit_reading(
        &self,
        mut encoder: wgpu::CommandEncoder,
        sources: &[Source],
        staging: &wgpu::Buffer,
    ) -> Result<Reading, GpuError> {
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
        let mapped = Arc::new(Mutex::new(None));
        let on_mapped = mapped.clone();
        guard::catch(|| {
            staging.map_async(wgpu::MapMode::Read, 0..bytes, move |result| {
                if let Ok(mut outcome) = on_mapped.lock() {
                    *outcome = Some(result);
                }
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

    /// Whether the work is done and its results can be read. Does not wait.
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

    /// Waits until the work is done and hands `read` its results.
    pub(crate) fn read<T>(
        &self,
        reading: Reading,
        read: impl FnOnce(&[u8]) -> T,
    ) -> Result<T, GpuError> {
        self.wait(reading.submission.clone())?;
        // The driver may be done before wgpu has said so.
        if reading.outcome().is_none() && !self.is_readable(&reading)? {
            return Err(GpuError::Lost);
        }
        reading.outcome().unwrap_or(Err(GpuError::Lost))?;
        let slice = reading.staging.slice(0..reading.bytes);
        (slice.get_mapped_range())
            .map(|view| read(&view))
            .map_err(|_| GpuError::Lost)
    }

    /// The three in one.
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
