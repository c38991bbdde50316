//! The only way back from the GPU.

use super::{Gpu, GpuError, guard};
use std::sync::{Arc, Mutex};

/// A part of a buffer to be read.
pub(crate) struct Source<'a> {
    pub buffer: &'a wgpu::Buffer,
    pub offset: u64,
    pub bytes: u64,
}

impl Gpu {
    /// Submits `encoder` and hands `read` what is in `sources` when it is done, one after the other.
    /// `staging` must be mappable for reading and hold them all.
    pub(crate) fn submit_and_read<T>(
        &self,
        mut encoder: wgpu::CommandEncoder,
        sources: &[Source],
        staging: &wgpu::Buffer,
        read: impl FnOnce(&[u8]) -> T,
    ) -> Result<T, GpuError> {
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
        let commands = guard::quiet(|| encoder.finish()).map_err(|()| GpuError::Lost)?;
        self.submit(commands)?;

        let outcome = Arc::new(Mutex::new(None));
        let on_mapped = outcome.clone();
        let slice = staging.slice(0..bytes);
        guard::quiet(|| {
            slice.map_async(wgpu::MapMode::Read, move |result| {
                if let Ok(mut outcome) = on_mapped.lock() {
                    *outcome = Some(result);
                }
            });
            self.device.poll(wgpu::PollType::Poll)
        })
        .map_err(|()| GpuError::Lost)?
        .map_err(|_| GpuError::Lost)?;
        self.check()?;
        let mapped = outcome.lock().ok().and_then(|mut outcome| outcome.take());
        if !matches!(mapped, Some(Ok(()))) {
            return Err(GpuError::Lost);
        }
        let contents = slice
            .get_mapped_range()
            .map(|view| read(&view))
            .map_err(|_| GpuError::Lost);
        staging.unmap();
        contents
    }
}
