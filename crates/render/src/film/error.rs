//! Errors of merging and reading films.

use super::super::sums::SAMPLE_BLOCK;
use glimray_scene::bytes::size;
use std::{io, ops::Range};

/// Errors of merging and reading films.
#[derive(Debug, thiserror::Error)]
pub enum FilmError {
    /// They are not of the same picture.
    #[error(
        "the films are not of the same picture: they differ in the {what}, {first} and {second}. Merge parts of one picture only."
    )]
    Differs {
        /// The part in which they differ.
        what: &'static str,
        /// The value in the first film.
        first: String,
        /// The value in the other film.
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
    /// A range of samples that does not consist of whole blocks.
    #[error(
        "samples {} to {} are not whole blocks: a range must start and end at multiples of {SAMPLE_BLOCK}, or at the end of the picture's samples. Choose other ends.",
        samples.start, samples.end.saturating_sub(1)
    )]
    Unaligned {
        /// The range.
        samples: Range<u32>,
    },
    /// A range of samples of an adaptive picture.
    #[error(
        "adaptive sampling cannot be split by samples: the number of samples of a pixel depends on its first ones. Split the picture into regions instead, or choose stratified sampling."
    )]
    Adaptive,
    /// An adaptive picture that is not finished.
    #[error("an adaptive picture has no film before it is finished. Let it finish.")]
    Unfinished,
    /// The file is not a film.
    #[error("the file is not a film. Choose a file that ends in .film.")]
    NotAFilm,
    /// An unknown version of the format.
    #[error(
        "the film has version {found}, but this program reads version {known}. Render it again, or use the program that wrote it."
    )]
    Version {
        /// The film's version.
        found: u32,
        /// The one that can be read.
        known: u32,
    },
    /// The file is truncated.
    #[error("the film is cut short: it ends after {}. Copy or render it again.", size(*bytes))]
    CutShort {
        /// The file's length.
        bytes: u64,
    },
    /// The contents are invalid.
    #[error("the film is damaged: {why}. Copy or render it again.")]
    Damaged {
        /// The fault.
        why: &'static str,
    },
    /// Out of memory while reading.
    #[error("the film is too big: memory ran out after {}.", size(*bytes))]
    TooBig {
        /// Bytes read so far.
        bytes: u64,
    },
    /// An input or output error.
    #[error("the film cannot be read: {0}. Check the file and its folder.")]
    Io(#[from] io::Error),
}
