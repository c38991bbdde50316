//! Times of GPU work, from timestamps that the adapter writes.

use super::{Gpu, GpuError, Source};
use bytemuck::pod_collect_to_vec;

/// Two timestamps: the beginning of a pass, and the end of it or of a later one. Where the adapter has no timestamps,
/// nothing is written and nothing measured.
pub(crate) struct Timer(Option<Timestamps>);

struct Timestamps {
    queries: wgpu::QuerySet,
    resolved: wgpu::Buffer,
    /// Nanoseconds of a tick.
    period: f64,
}

impl Gpu {
    /// A timer.
    pub(crate) fn timer(&self) -> Result<Timer, GpuError> {
        let features = self.device.features();
        if !features.contains(wgpu::Features::TIMESTAMP_QUERY) {
            return Ok(Timer(None));
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
        Ok(Timer(Some(Timestamps {
            queries,
            resolved,
            period: self.queue.get_timestamp_period().into(),
        })))
    }
}

impl Timer {
    /// Bytes of its source, if it has one.
    pub const BYTES: usize = 16;

    /// For the descriptor of the only pass.
    pub fn writes(&self) -> Option<wgpu::ComputePassTimestampWrites<'_>> {
        self.writes_of(true, true)
    }

    /// For the descriptor of a pass that may be the first of several, or the last.
    pub fn writes_of(
        &self,
        is_first: bool,
        is_last: bool,
    ) -> Option<wgpu::ComputePassTimestampWrites<'_>> {
        let stamps = self.0.as_ref().filter(|_| is_first || is_last)?;
        Some(wgpu::ComputePassTimestampWrites {
            query_set: &stamps.queries,
            beginning_of_pass_write_index: is_first.then_some(0),
            end_of_pass_write_index: is_last.then_some(1),
        })
    }

    /// Makes the timestamps readable after the passes: returns the source to read back.
    pub fn resolve(&self, encoder: &mut wgpu::CommandEncoder) -> Option<Source<'_>> {
        let stamps = self.0.as_ref()?;
        encoder.resolve_query_set(&stamps.queries, 0..2, &stamps.resolved, 0);
        Some(Source {
            buffer: &stamps.resolved,
            offset: 0,
            bytes: Self::BYTES as u64,
        })
    }

    /// The seconds between the timestamps with which `bytes` start, and what follows them.
    pub fn split<'a>(&self, bytes: &'a [u8]) -> (Option<f64>, &'a [u8]) {
        let Some(stamps) = &self.0 else {
            return (None, bytes);
        };
        let (ticks, rest) = bytes.split_at(Self::BYTES);
        let ticks: Vec<u64> = pod_collect_to_vec(ticks);
        let passed = ticks[1].saturating_sub(ticks[0]) as f64;
        (Some(passed * stamps.period * 1e-9), rest)
    }
}
