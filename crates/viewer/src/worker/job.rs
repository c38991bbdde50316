//! The control of a job, which its thread and the window share.

use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};
use std::time::Instant;

/// Seconds of work before the rest is estimated.
const MEASURED: f64 = 1.0;

/// The progress of a job, and the wish to end it. Clones share one state.
#[derive(Clone, Debug, Default)]
pub struct JobControl(Arc<Shared>);

#[derive(Debug, Default)]
struct Shared {
    is_cancelled: AtomicBool,
    progress: Mutex<JobProgress>,
}

/// The progress of a job.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct JobProgress {
    /// The finished share, in 0..=1.
    pub share: f64,
    /// The current step for people, such as `frame 3 of 24`; empty if there is only one.
    pub step: String,
    /// Whether a thread works on it.
    has_begun: bool,
    /// When the share was published first, and the share that was finished before.
    began: Option<(Instant, f64)>,
}

impl JobControl {
    /// Asks the job to end. It notices between two steps.
    pub fn cancel(&self) {
        self.0.is_cancelled.store(true, Ordering::Relaxed);
    }

    /// Whether the job was asked to end.
    pub fn is_cancelled(&self) -> bool {
        self.0.is_cancelled.load(Ordering::Relaxed)
    }

    /// Tells that a thread works on the job from now on, which will send the outcome.
    pub fn begin(&self) {
        self.lock().has_begun = true;
    }

    /// Publishes the finished share, in 0..=1. The time left is measured from the first call.
    pub fn report(&self, share: f64) {
        let mut progress = self.lock();
        progress.has_begun = true;
        progress
            .began
            .get_or_insert_with(|| (Instant::now(), share));
        progress.share = share;
    }

    /// Publishes the current step, for people.
    pub fn begin_step(&self, step: String) {
        self.lock().step = step;
    }

    /// The progress so far.
    pub fn progress(&self) -> JobProgress {
        self.lock().clone()
    }

    fn lock(&self) -> MutexGuard<'_, JobProgress> {
        (self.0.progress.lock()).unwrap_or_else(PoisonError::into_inner)
    }
}

impl JobProgress {
    /// Whether work has begun.
    pub fn has_begun(&self) -> bool {
        self.has_begun
    }

    /// Estimated seconds left; `None` until there is something to estimate from.
    pub fn seconds_left(&self) -> Option<f64> {
        let (since, before) = self.began?;
        seconds_left(since.elapsed().as_secs_f64(), [before, self.share])
    }
}

/// The seconds of work that are left after `seconds` in which the finished share rose from the first of `shares` to the second.
/// `None` in the first second, and once everything is done.
pub fn seconds_left(seconds: f64, [before, share]: [f64; 2]) -> Option<f64> {
    let gained = share - before;
    let is_measured = seconds >= MEASURED && gained > 0.0 && share < 1.0;
    is_measured.then(|| seconds * (1.0 - share) / gained)
}
