//! The estimate of the time until the picture is done.

use crate::worker::job::seconds_left;
use crate::worker::progressive_image::Progress;

/// Time constant with which the estimate follows the last figure, in seconds of tracing.
const FOLLOWS: f64 = 4.0;

/// The smoothed estimate of the seconds of tracing that are left.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct TimeLeft {
    seconds: Option<f64>,
    /// Seconds of tracing and share of the work at the last update.
    traced: f64,
    share: f64,
    is_held: bool,
}

impl TimeLeft {
    /// Takes the progress of the picture. `paused` says that it does not go on.
    pub fn update(&mut self, progress: &Progress, paused: bool) {
        let Progress {
            share,
            trace_seconds: traced,
            ..
        } = *progress;
        let is_other = traced < self.traced || share < self.share;
        let goes_on = !progress.is_coarse && !progress.is_done;
        let latest = seconds_left(traced, [0.0, share]).filter(|_| goes_on);
        let passed = traced - self.traced;
        self.seconds = match (self.seconds.filter(|_| !is_other), latest) {
            (Some(before), Some(latest)) => {
                let expected = (before - passed).max(0.0);
                Some(expected + (latest - expected) * -(-passed / FOLLOWS).exp_m1())
            }
            (_, latest) => latest,
        };
        (self.traced, self.share) = (traced, share);
        self.is_held = paused;
    }

    /// The estimate in seconds; `None` in the first second, while the picture is paused, and once it is done.
    pub fn seconds(&self) -> Option<f64> {
        self.seconds.filter(|_| !self.is_held)
    }
}
