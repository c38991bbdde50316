//! Times of GPU work, from timestamps that the adapter writes.

use super::{Gpu, GpuError, Source};
use bytemuck::pod_collect_to_vec;

/// Two timestamps: the beginning of a pass, and the end of it or of a later one.
pub(crate) struct Timer {
    queries: wgpu::QuerySet,
    resolved: wgpu::Buffer,
    /// Nanoseconds of a tick.
    period: f64,
}

impl Gpu {
    /// A timer; `None` if the adapter has no timestamps.
    pub(crate) fn timer(&self) -> Result<Option<Timer>, GpuError> {
        let features = self.device.features();
        if !features.contains(wgpu::Features::TIMESTAMP_QUERY) {
            return Ok(None);
        }
        let usage = wgpu::BufferUsages::QUERY_RESOLVE | wgpu::BufferUsages::COPY_SRC;
        let resolved = self.allocate("timestamps", Timer::BYTES as u64, usage)?;
        let queries = self.scoped("timestamps", || {
            self.device.create_query_set(&wgpu::QuerySetDescriptor {
                label: Some("timestamps"),
                ty: wgpu::QueryType::Timestamp,
                count: 2,
            })
        })?;
        Ok(Some(Timer {
            queries,
            resolved,
            period: self.queue.get_timestamp_period().into(),
        }))
    }
}

impl Timer {
    /// Bytes of its source.
    pub const BYTES: usize = 16;

    /// For the descriptor of the only pass.
    pub fn writes(&self) -> wgpu::ComputePassTimestampWrites<'_> {
        self.writes_of(true, true)
    }

    /// For the descriptor of a pass that is the first of several, or the last.
    pub fn writes_of(&self, is_first: bool, is_last: bool) -> wgpu::ComputePassTimestampWrites<'_> {
        wgpu::ComputePassTimestampWrites {
            query_set: &self.queries,
            beginning_of_pass_write_index: is_first.then_some(0),
            end_of_pass_write_index: is_last.then_some(1),
        }
    }

    /// Makes the timestamps readable after the passes.
    pub fn resolve(&self, encoder: &mut wgpu::CommandEncoder) {
        encoder.resolve_query_set(&self.queries, 0..2, &self.resolved, 0);
    }

    /// The resolved timestamps, to be read back.
    pub fn source(&self) -> Source<'_> {
        Source {
            buffer: &self.resolved,
            offset: 0,
            bytes: Self::BYTES as u64,
        }
    }

    /// Seconds between the timestamps in `bytes`.
    pub fn seconds(&self, bytes: &[u8]) -> f64 {
        let ticks: Vec<u64> = pod_collect_to_vec(bytes);
        ticks[1].saturating_sub(ticks[0]) as f64 * self.period * 1e-9
    }
}
