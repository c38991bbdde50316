//! Submitted work, and readback from the GPU. Nothing here waits: callbacks report when work is done, in a browser by
//! themselves and elsewhere while the device is polled.

#[cfg(not(target_arch = "wasm32"))]
use super::blocking;
use super::{Gpu, GpuError, guard};
use glimray_scene::{bytes::sizes, clock::Instant};
use std::{
    future::poll_fn,
    sync::{Arc, Mutex, PoisonError},
    task::{Poll, Waker},
};

/// A range of a buffer to read back.
pub(crate) struct Source<'a> {
    pub buffer: &'a wgpu::Buffer,
    pub offset: u64,
    pub bytes: u64,
}

/// Submitted work.
pub(crate) struct Submitted {
    #[cfg_attr(target_arch = "wasm32", expect(dead_code, reason = "no thread waits"))]
    index: wgpu::SubmissionIndex,
    at: Instant,
    report: Report,
}

impl Submitted {
    /// The seconds from its submission to its end, or until now.
    pub(crate) fn seconds(&self) -> f64 {
        self.seconds_since(self.at)
    }

    /// The seconds from a moment to its end, or until now.
    pub(crate) fn seconds_since(&self, start: Instant) -> f64 {
        let end = self.report.change(|reported| reported.end);
        let end = end.unwrap_or_else(Instant::now);
        end.saturating_duration_since(start).as_secs_f64()
    }
}

/// The report of a callback about submitted work.
#[derive(Clone, Default)]
struct Report(Arc<Mutex<Reported>>);

#[derive(Default)]
struct Reported {
    /// Whether it ended well.
    outcome: Option<bool>,
    /// When it was reported: a browser may ask much later, once for each frame.
    end: Option<Instant>,
    waker: Option<Waker>,
}

impl Report {
    fn change<T>(&self, change: impl FnOnce(&mut Reported) -> T) -> T {
        change(&mut self.0.lock().unwrap_or_else(PoisonError::into_inner))
    }

    fn set(&self, outcome: bool) {
        let waker = self.change(|reported| {
            reported.outcome = Some(outcome);
            reported.end = Some(Instant::now());
            reported.waker.take()
        });
        if let Some(waker) = waker {
            waker.wake();
        }
    }
}

/// Submitted work whose results will be read back. Dropping it discards the results; the work itself still
/// runs.
pub(crate) struct Reading {
    staging: wgpu::Buffer,
    bytes: u64,
    pub work: Submitted,
}

impl Drop for Reading {
    fn drop(&mut self) {
        // This also cancels a pending request: copies to a mapped buffer are not allowed.
        let _ = guard::catch(|| self.staging.unmap());
    }
}

impl Gpu {
    /// Submits work without results. Does not wait.
    pub(crate) fn submit(&self, commands: wgpu::CommandBuffer) -> Result<Submitted, GpuError> {
        let index = self.enqueue(commands)?;
        self.watched(index, |report| {
            self.queue.on_submitted_work_done(move || report.set(true));
        })
    }

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
        let index = self.enqueue(commands)?;
        let work = self.watched(index, |report| {
            staging.map_async(wgpu::MapMode::Read, 0..bytes, move |outcome| {
                report.set(outcome.is_ok());
            });
        })?;
        Ok(Reading {
            staging: staging.clone(),
            bytes,
            work,
        })
    }

    /// Work whose end the callback that `watch` sets will report.
    fn watched(
        &self,
        index: wgpu::SubmissionIndex,
        watch: impl FnOnce(Report),
    ) -> Result<Submitted, GpuError> {
        let (at, report) = (Instant::now(), Report::default());
        guard::catch(|| watch(report.clone())).map_err(|()| GpuError::Lost)?;
        Ok(Submitted { index, at, report })
    }

    /// Whether the work is done. Does not wait. Work that takes longer than the adapter's patience is lost with the device.
    pub(crate) fn is_done(&self, work: &Submitted) -> Result<bool, GpuError> {
        let polled = guard::catch(|| self.device.poll(wgpu::PollType::Poll));
        polled
            .map_err(|()| GpuError::Lost)?
            .map_err(|_| GpuError::Lost)?;
        self.check()?;
        match work.report.change(|reported| reported.outcome) {
            Some(true) => Ok(true),
            Some(false) => Err(GpuError::Lost),
            None if work.at.elapsed() > self.adapter().patience() => Err(GpuError::Lost),
            None => Ok(false),
        }
    }

    /// Ends when the work is done.
    pub(crate) async fn done(&self, work: &Submitted) -> Result<(), GpuError> {
        poll_fn(|context| {
            let waker = context.waker().clone();
            work.report.change(|reported| reported.waker = Some(waker));
            match self.is_done(work) {
                Ok(false) => {
                    // Without a browser nothing reports unless somebody polls: this asks to be polled again.
                    #[cfg(not(target_arch = "wasm32"))]
                    {
                        blocking::note(&self.device, &work.index);
                        context.waker().wake_by_ref();
                    }
                    Poll::Pending
                }
                done => Poll::Ready(done.map(drop)),
            }
        })
        .await
    }

    /// Passes the results of work that is done to `read`.
    pub(crate) fn take<T>(
        &self,
        reading: Reading,
        read: impl FnOnce(&[u8]) -> T,
    ) -> Result<T, GpuError> {
        let slice = reading.staging.slice(0..reading.bytes);
        (slice.get_mapped_range())
            .map(|view| read(&view))
            .map_err(|_| GpuError::Lost)
    }

    /// Passes the results to `read` once the work is done.
    pub(crate) async fn read<T>(
        &self,
        reading: Reading,
        read: impl FnOnce(&[u8]) -> T,
    ) -> Result<T, GpuError> {
        self.done(&reading.work).await?;
        self.take(reading, read)
    }

    /// Submits, and reads once the work is done.
    pub(crate) async fn submit_and_read<T>(
        &self,
        encoder: wgpu::CommandEncoder,
        sources: &[Source<'_>],
        staging: &wgpu::Buffer,
        read: impl FnOnce(&[u8]) -> T,
    ) -> Result<T, GpuError> {
        let reading = self.submit_reading(encoder, sources, staging)?;
        self.read(reading, read).await
    }
}
