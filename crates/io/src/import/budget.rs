//! Bounds the memory that reading a file may take. It cannot be computed in advance: a line of eight
//! bytes may place three vertices. Importers therefore count the memory they hold and the memory that
//! later steps will need, and stop when it exceeds the file's budget.

use super::error::{Fault, ImportError};
use glimray_scene::bytes;

/// Bytes of memory per byte of the file.
const PER_BYTE: u64 = 8;

/// Bytes that every file may take in addition.
const ALWAYS: u64 = 64 << 20;

/// The memory budget of one file.
#[derive(Clone, Copy, Debug)]
pub(super) struct Budget {
    limit: u64,
}

impl Budget {
    /// The budget of a file of `length` bytes.
    pub fn of(length: usize) -> Self {
        Self {
            limit: ALWAYS.saturating_add(PER_BYTE.saturating_mul(length as u64)),
        }
    }

    /// Checks that `bytes` are within the budget.
    ///
    /// # Errors
    /// They are not: `refuse` adds the position to the reason and the remedy.
    pub fn check(
        self,
        bytes: u64,
        refuse: impl FnOnce(String, &str) -> ImportError,
    ) -> Result<(), ImportError> {
        if bytes <= self.limit {
            return Ok(());
        }
        let why = format!(
            "reading it would take more than {} of memory: {PER_BYTE} times the size of the file plus {}",
            bytes::size(self.limit),
            bytes::size(ALWAYS)
        );
        let fault: Box<Fault> = refuse(why, "Split it into several files").into_fault();
        Err(ImportError::TooBig(fault))
    }
}

/// The memory taken by `count` values of type `T`.
pub(super) fn size<T>(count: usize) -> u64 {
    (count as u64).saturating_mul(size_of::<T>() as u64)
}
