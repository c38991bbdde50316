//! The histogram in the window.

use crate::model::histogram::Histogram;
use crate::state::asked::Asked;

/// The histogram of the main picture.
#[derive(Debug, Default)]
pub struct HistogramView {
    /// The histogram of the last picture that was measured.
    pub latest: Option<Box<Histogram>>,
    /// Whether the height of its bars is logarithmic.
    pub is_logarithmic: bool,
    asked: Asked,
    /// Whether the answer may still be about another scene.
    is_outdated: bool,
}

impl HistogramView {
    /// Drops the request to the previous renderer.
    pub fn reopened(&mut self) {
        self.asked = Asked::default();
        self.is_outdated = false;
    }

    /// Forgets the histogram of another scene.
    pub(crate) fn forget(&mut self) {
        self.latest = None;
        self.is_outdated = self.asked.is_awaited();
    }

    /// Whether the presentation with this number is to be measured now: only the newest is, one at a time.
    pub(crate) fn is_due(&mut self, look: u64) -> bool {
        self.asked.is_due(look)
    }

    /// Takes the answer.
    pub(crate) fn set(&mut self, histogram: Option<Box<Histogram>>) {
        self.asked.answered();
        let is_outdated = std::mem::take(&mut self.is_outdated);
        if histogram.is_some() && !is_outdated {
            self.latest = histogram;
        }
    }
}
