//! The outline of a film: which picture it is a part of, and which part. Enough to tell whether parts belong together,
//! overlap or are missing, before their sums are read.

use super::{
    super::sums::Sums,
    Film, FilmError, FilmHeader, Missing,
    coverage::{Coverage, SampleSet},
    united,
};
use crate::layers;
use std::ops::Range;

/// The header of a film, and the pixels and samples that it has.
#[derive(Clone, Debug, PartialEq)]
pub struct FilmOutline {
    pub(super) header: FilmHeader,
    pub(super) coverage: Coverage,
}

impl FilmOutline {
    /// The header.
    pub fn header(&self) -> &FilmHeader {
        &self.header
    }

    /// The film's rectangles (x, y, width, height) and their ranges of samples, from top to bottom and left to right.
    pub fn parts(&self) -> impl Iterator<Item = ([u32; 4], &[Range<u32>])> {
        self.coverage.parts()
    }

    /// The outline of both films together.
    ///
    /// # Errors
    /// They are not of the same picture, or have samples in common.
    pub fn merge(&self, other: &Self) -> Result<Self, FilmError> {
        self.header.check_same(&other.header)?;
        let mut header = self.header.clone();
        header
            .adapters
            .extend(other.header.adapters.iter().cloned());
        let coverage = united(&self.coverage, &other.coverage)?;
        Ok(Self { header, coverage })
    }

    /// The outline of another part of the picture: these samples of a rectangle (x, y, width, height).
    ///
    /// # Errors
    /// The samples are not whole blocks ([`crate::SAMPLE_BLOCK`]).
    pub fn part(&self, region: [u32; 4], samples: Range<u32>) -> Result<Self, FilmError> {
        let header = self.header.clone();
        let coverage = Coverage::rectangle(region, header.blocks(samples)?);
        Ok(Self { header, coverage })
    }

    /// Size of the film in bytes, in memory and in a file, where a header of some hundred bytes comes on top.
    pub fn bytes(&self) -> u64 {
        let rows = layers::rows(self.header.layers) as u64;
        let of_patch = |([.., width, height], samples): ([u32; 4], &SampleSet)| {
            let pixels = u64::from(width) * u64::from(height);
            rows * pixels * Sums::row_bytes(self.header.is_block(samples))
        };
        self.coverage.patches().map(of_patch).sum()
    }

    /// The missing parts of a rectangle of the picture: x, y, width, height.
    pub fn missing_of(&self, region: [u32; 4]) -> Vec<Missing> {
        missing(&self.header, &self.coverage, region)
    }

    /// A film of zeros, to which the parts of this outline are [added](Film::add). Its [size](Self::bytes) does not depend on
    /// the number of parts.
    pub fn blank(self) -> Film {
        let Self { header, coverage } = self;
        let rows = layers::rows(header.layers);
        let zeros = |([.., width, height], samples): ([u32; 4], &SampleSet)| {
            let pixels = width as usize * height as usize;
            Sums::zeros(rows * pixels, header.is_block(samples))
        };
        let sums = coverage.patches().map(zeros).collect();
        Self { header, coverage }.with_sums(sums)
    }

    /// The film with these sums, for each patch of the coverage.
    pub(super) fn with_sums(self, sums: Vec<Sums>) -> Film {
        let Self { header, coverage } = self;
        Film {
            header,
            coverage,
            sums,
        }
    }
}

/// The parts of a rectangle of the picture (x, y, width, height) that a coverage lacks.
pub(super) fn missing(header: &FilmHeader, coverage: &Coverage, region: [u32; 4]) -> Vec<Missing> {
    let all = SampleSet::new(0..header.samples);
    let lacking = Coverage::rectangle(region, all).without(coverage);
    let each = |(region, samples): ([u32; 4], &SampleSet)| {
        let ranges = samples.ranges().to_vec().into_iter();
        ranges.map(move |samples| Missing { region, samples })
    };
    lacking.patches().flat_map(each).collect()
}
