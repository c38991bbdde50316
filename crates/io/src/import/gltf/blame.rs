//! Errors about a glTF file. What is wrong is named by its place in the JSON, such as `accessors[3]`.

use super::document::ABSENT;
use crate::import::budget::Budget;
use crate::import::error::{ImportError, fault};
use std::cell::Cell;
use std::fmt::Display;
use std::path::Path;

const WHAT: &str = "bad model";

/// The file that errors are about.
#[derive(Clone, Copy)]
pub(super) struct Blame<'a> {
    pub path: &'a Path,
}

impl Blame<'_> {
    /// The whole file is at fault.
    pub fn file(self, why: &str, todo: &str) -> ImportError {
        ImportError::Malformed(fault(WHAT, self.path, why, todo))
    }

    /// The file is incomplete.
    pub fn truncated(self, why: &str) -> ImportError {
        self.file(why, "Check that it was written completely")
    }

    /// The JSON at `place` is wrong.
    pub fn bad(self, place: impl Display, why: impl Display) -> ImportError {
        let why = format!("{place}: {why}");
        self.file(&why, "Export the model again, or correct the file")
    }

    /// The JSON at `place` refers to an entry that does not exist.
    pub fn missing(self, place: impl Display, what: &str, index: usize) -> ImportError {
        match index {
            ABSENT => self.bad(place, format_args!("it names none of the {what}")),
            _ => self.bad(place, format_args!("{what}[{index}] does not exist")),
        }
    }

    /// The entry `index` of `list`, which is `what` and to which `place` refers.
    pub fn get<'l, T>(
        self,
        list: &'l [T],
        index: usize,
        what: &str,
        place: impl Display,
    ) -> Result<&'l T, ImportError> {
        list.get(index)
            .ok_or_else(|| self.missing(place, what, index))
    }
}

/// The memory that a model takes, which its budget bounds.
pub(super) struct Ledger<'a> {
    pub blame: Blame<'a>,
    pub budget: Budget,
    pub held: Cell<u64>,
    /// Whether it was exceeded.
    pub is_exceeded: Cell<bool>,
}

impl Ledger<'_> {
    /// Adds `bytes` that stay, and checks that `transient` bytes more can be had.
    ///
    /// # Errors
    /// The budget is exceeded by what is at `place`.
    pub fn take(&self, bytes: u64, transient: u64, place: impl Display) -> Result<(), ImportError> {
        let held = self.held.get().saturating_add(bytes);
        self.budget
            .check(held.saturating_add(transient), |why, todo| {
                self.is_exceeded.set(true);
                self.blame.file(&format!("{place}: {why}"), todo)
            })?;
        self.held.set(held);
        Ok(())
    }
}
