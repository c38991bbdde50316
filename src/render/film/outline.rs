//! The outline of a film: which picture it is a part of, and which part. Enough to tell whether parts belong together,
//! overlap or are missing, before their sums are read.

use super::{
    super::sums::Sums,
    Film, FilmError, FilmHeader, Missing,
    coverage::{Coverage, SampleSet},
    united,
};
use crate::render::layers;

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

    /// The missing parts of the whole picture.
    pub fn missing(&self) -> Vec<Missing> {
        missing(&self.header, &self.coverage, self.header.whole())
    }

    /// A film of zeros, to which the parts of this outline are [added](Film::add). Its sums take 16 bytes for each row of a
    /// pixel with one block of samples, and 64 with more, however many parts there are.
    pub fn blank(self) -> Film {
        let Self { header, coverage } = self;
        let rows = layers::rows(header.layers);
        let zeros = |([.., width, height], samples): ([u32; 4], &SampleSet)| {
            let pixels = width as usize * height as usize;
            Sums::zeros(rows * pixels, header.is_block(samples))
        };
        let sums = coverage.patches().map(zeros).collect();
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
