//! Questions about each presentation of the main picture.

/// Which presentation was asked about last, one at a time.
#[derive(Debug, Default)]
pub struct Asked {
    last: Option<u64>,
    is_awaited: bool,
}

impl Asked {
    /// Whether the presentation with this number is to be asked about now: only the newest is.
    pub(crate) fn is_due(&mut self, look: u64) -> bool {
        let is_due = !self.is_awaited && self.last != Some(look);
        if is_due {
            self.last = Some(look);
            self.is_awaited = true;
        }
        is_due
    }

    /// Whether the answer is still to come.
    pub(crate) fn is_awaited(&self) -> bool {
        self.is_awaited
    }

    /// Notes that the answer has come.
    pub(crate) fn answered(&mut self) {
        self.is_awaited = false;
    }
}
