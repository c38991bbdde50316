//! Why films do not go together, or cannot be read.

use super::super::sums::SAMPLE_BLOCK;
use std::{io, ops::Range};

/// Why films do not go together, or cannot be read.
#[derive(Debug, thiserror::Error)]
pub enum FilmError {
    /// They are not of the same picture.
    #[error(
        "the films are not of the same picture: they differ in the {what}, {first} and {second}. Merge parts of one picture only."
    )]
    Differs {
        /// In what.
        what: &'static str,
        /// Of the first film.
        first: String,
        /// Of the other.
        second: String,
    },
    /// Some samples are in both.
    #[error(
        "the films overlap: both have samples {} to {} of {}×{} pixels at {},{}. Leave one of them out.",
        samples.start, samples.end - 1, region[2], region[3], region[0], region[1]
    )]
    Overlap {
        /// A rectangle of the picture: x, y, width, height.
        region: [u32; 4],
        /// The first samples of its pixels that both have.
        samples: Range<u32>,
    },
    /// A range of samples that is not made of blocks.
    #[error(
        "samples {} to {} are no whole blocks: a range begins and ends at multiples of {SAMPLE_BLOCK}, or at the end of the picture's samples. Choose other ends.",
        samples.start, samples.end.saturating_sub(1)
    )]
    Unaligned {
        /// The range.
        samples: Range<u32>,
    },
    /// A range of samples of an adaptive picture.
    #[error(
        "adaptive sampling cannot be cut by samples: how many a pixel gets depends on its first ones. Cut the picture into regions instead, or choose stratified sampling."
    )]
    Adaptive,
    /// An adaptive picture that is not done.
    #[error("an adaptive picture has no film before all its samples are there. Let it finish.")]
    Unfinished,
    /// It is something else.
    #[error("it is not a film. Choose a file that ends in .film.")]
    NotAFilm,
    /// Another form.
    #[error(
        "it is a film of version {found}, and this program reads version {known}. Render it again, or use the program that wrote it."
    )]
    Version {
        /// Its version.
        found: u32,
        /// The one that can be read.
        known: u32,
    },
    /// It ends too early.
    #[error("the film is cut short: it ends after {bytes} bytes. Copy or render it again.")]
    CutShort {
        /// Its length.
        bytes: u64,
    },
    /// It is not what was written.
    #[error("the film is damaged: {why}. Copy or render it again.")]
    Damaged {
        /// What is wrong.
        why: &'static str,
    },
    /// There is not enough memory for it.
    #[error("the film is too big: there is no memory left after {bytes} bytes of it.")]
    TooBig {
        /// What was read.
        bytes: u64,
    },
    /// It cannot be read or written.
    #[error("it cannot be read: {0}. Check the file and its folder.")]
    Io(#[from] io::Error),
}
