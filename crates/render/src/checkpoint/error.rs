//! Why a checkpoint cannot be used.

use super::ReadError;
use glimray_scene::bytes::size;
use std::io;

/// Why a checkpoint cannot be used.
#[derive(Debug, thiserror::Error)]
pub enum CheckpointError {
    /// The file is not a checkpoint.
    #[error("the file is not a checkpoint.")]
    NotACheckpoint,
    /// An unknown version of the format.
    #[error("the checkpoint has version {found}, but this program reads version {known}.")]
    Version {
        /// The checkpoint's version.
        found: u32,
        /// The one that can be read.
        known: u32,
    },
    /// The checkpoint belongs to other work.
    #[error("the checkpoint is of other work: it differs in the {}.", differing.join(", "))]
    Differs {
        /// The differing parts, such as "scene" and "settings".
        differing: Vec<&'static str>,
    },
    /// The file is truncated.
    #[error("the checkpoint is cut short: it ends after {}.", size(*bytes))]
    CutShort {
        /// The file's length.
        bytes: u64,
    },
    /// The contents are invalid.
    #[error("the checkpoint is damaged: {why}.")]
    Damaged {
        /// The fault.
        why: &'static str,
    },
    /// Out of memory while reading.
    #[error("the checkpoint is too big: memory ran out after {}.", size(*bytes))]
    TooBig {
        /// Bytes read so far.
        bytes: u64,
    },
    /// An input error.
    #[error("the checkpoint cannot be read: {0}.")]
    Io(io::Error),
}

impl From<ReadError> for CheckpointError {
    fn from(error: ReadError) -> Self {
        match error {
            ReadError::CutShort { bytes } => Self::CutShort { bytes },
            ReadError::Damaged { why } => Self::Damaged { why },
            ReadError::TooBig { bytes } => Self::TooBig { bytes },
            ReadError::Io(error) => Self::Io(error),
        }
    }
}
