//! How much memory of the host a file may take while it is read. What a file needs can only be told
//! while it is read: a line of eight bytes may place three vertices. So importers count what they
//! hold, with what is still to be made of it, and stop when it is out of proportion to the file.

use super::error::{Fault, ImportError};

/// Bytes of memory for each byte of a file.
const PER_BYTE: u64 = 8;

/// Bytes that every file may take.
const ALWAYS: u64 = 64 << 20;

/// The memory that one file may take.
#[derive(Clone, Copy, Debug)]
pub(super) struct Budget {
    limit: u64,
}

impl Budget {
    /// Of a file of `length` bytes.
    pub fn of(length: usize) -> Self {
        Self {
            limit: ALWAYS.saturating_add(PER_BYTE.saturating_mul(length as u64)),
        }
    }

    /// Checks that `bytes` are within it.
    ///
    /// # Errors
    /// They are not: `refuse` says where, given why and what to do.
    pub fn check(
        self,
        bytes: u64,
        refuse: impl FnOnce(String, &str) -> ImportError,
    ) -> Result<(), ImportError> {
        if bytes <= self.limit {
            return Ok(());
        }
        let why = format!(
            "reading on would take more than {} MiB of memory, which is {PER_BYTE} times the size of the \
             file and {} MiB",
            self.limit >> 20,
            ALWAYS >> 20
        );
        let fault: Box<Fault> = refuse(why, "Split it into several files").into_fault();
        Err(ImportError::TooBig(fault))
    }
}

/// The memory that `count` values of the type `T` take.
pub(super) fn size<T>(count: usize) -> u64 {
    (count as u64).saturating_mul(size_of::<T>() as u64)
}
