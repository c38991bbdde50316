//! The samples of each pixel of a picture, in a canonical form: two films with the same coverage compare equal,
//! however they were made.

use super::super::sums::SAMPLE_BLOCK;
use std::ops::Range;

/// Ranges of samples in ascending order, with gaps between them.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct SampleSet(Vec<Range<u32>>);

impl SampleSet {
    /// The set of one range, unless it is empty.
    pub fn new(range: Range<u32>) -> Self {
        let mut set = Self::default();
        set.push(range);
        set
    }

    /// The ranges.
    pub fn ranges(&self) -> &[Range<u32>] {
        &self.0
    }

    /// Appends a range, which must not start before the end of the last one. Returns whether that holds.
    pub fn push(&mut self, range: Range<u32>) -> bool {
        match self.0.last_mut() {
            _ if range.is_empty() => {}
            Some(last) if range.start < last.end => return false,
            Some(last) if range.start == last.end => last.end = range.end,
            _ => self.0.push(range),
        }
        true
    }

    pub fn is_empty(&self) -> bool {
        self.0.is_empty()
    }

    /// Number of samples.
    pub fn len(&self) -> u32 {
        self.0.iter().map(|range| range.end - range.start).sum()
    }

    /// Number of sample blocks.
    pub fn block_count(&self) -> u32 {
        let blocks = |range: &Range<u32>| (range.end - range.start).div_ceil(SAMPLE_BLOCK);
        self.0.iter().map(blocks).sum()
    }

    /// The first range that both have.
    fn common(&self, other: &Self) -> Option<Range<u32>> {
        let mut others = other.0.iter().peekable();
        for own in &self.0 {
            while others.next_if(|range| range.end <= own.start).is_some() {}
            if let Some(range) = others.peek().filter(|range| range.start < own.end) {
                return Some(own.start.max(range.start)..own.end.min(range.end));
            }
        }
        None
    }

    /// The union, or the first range that both have.
    fn union(&self, other: &Self) -> Result<Self, Range<u32>> {
        if let Some(common) = self.common(other) {
            return Err(common);
        }
        let mut ranges: Vec<_> = self.0.iter().chain(&other.0).cloned().collect();
        ranges.sort_by_key(|range| range.start);
        let mut set = Self::default();
        for range in ranges {
            set.push(range);
        }
        Ok(set)
    }

    /// The difference: samples of this one that the other lacks.
    fn without(&self, other: &Self) -> Self {
        let mut set = Self::default();
        for own in &self.0 {
            let mut start = own.start;
            for range in &other.0 {
                set.push(start..range.start.min(own.end).max(start));
                start = start.max(range.end.min(own.end));
            }
            set.push(start..own.end);
        }
        set
    }
}

/// A run of pixels with the same samples, in one or several rows.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Run {
    pub x: Range<u32>,
    pub samples: SampleSet,
}

/// Rows with the same runs.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Band {
    pub y: Range<u32>,
    /// From left to right; adjacent runs have different samples.
    pub runs: Vec<Run>,
    /// Number of runs in the bands above.
    first: usize,
}

/// Bands from top to bottom; adjacent bands have different runs. A patch is a run with all the rows of its
/// band.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Coverage {
    bands: Vec<Band>,
}

/// A rectangle of the picture (x, y, width, height) and samples that two films have in common.
pub type Overlap = ([u32; 4], Range<u32>);

impl Coverage {
    /// The coverage of one rectangle: x, y, width, height.
    pub fn rectangle([x, y, width, height]: [u32; 4], samples: SampleSet) -> Self {
        let mut coverage = Self::default();
        if width > 0 && height > 0 && !samples.is_empty() {
            let x = x..x + width;
            coverage.push(y..y + height, vec![Run { x, samples }]);
        }
        coverage
    }

    pub fn bands(&self) -> &[Band] {
        &self.bands
    }

    /// The rectangles (x, y, width, height) of the patches and their samples, in index order.
    pub fn patches(&self) -> impl Iterator<Item = ([u32; 4], &SampleSet)> {
        self.bands.iter().flat_map(|band| {
            (band.runs.iter()).map(|run| (rectangle(&run.x, &band.y), &run.samples))
        })
    }

    /// The rectangles of the patches with the ranges of their samples.
    pub fn parts(&self) -> impl Iterator<Item = ([u32; 4], &[Range<u32>])> {
        (self.patches()).map(|(region, samples)| (region, samples.ranges()))
    }

    /// The bounding rectangle: x, y, width, height.
    pub fn bounds(&self) -> [u32; 4] {
        let (Some(first), Some(last)) = (self.bands.first(), self.bands.last()) else {
            return [0; 4];
        };
        let runs = || self.bands.iter().flat_map(|band| &band.runs);
        let left = runs().map(|run| run.x.start).min().unwrap_or(0);
        let right = runs().map(|run| run.x.end).max().unwrap_or(0);
        rectangle(&(left..right), &(first.y.start..last.y.end))
    }

    /// Index and rectangle of the patch at a pixel.
    pub fn patch_at(&self, x: u32, y: u32) -> Option<(usize, [u32; 4])> {
        let band = self.band_at(y)?;
        let index = band.runs.partition_point(|run| run.x.end <= x);
        let run = band.runs.get(index).filter(|run| run.x.start <= x)?;
        Some((band.first + index, rectangle(&run.x, &band.y)))
    }

    /// The union, or the first samples that both have.
    pub fn union(&self, other: &Self) -> Result<Self, Overlap> {
        self.combined(other, SampleSet::union)
    }

    /// The difference: samples of this one that the other lacks.
    pub fn without(&self, other: &Self) -> Self {
        let without = |own: &SampleSet, other: &SampleSet| Ok(own.without(other));
        self.combined(other, without).unwrap_or_default()
    }

    fn combined(
        &self,
        other: &Self,
        combine: impl Fn(&SampleSet, &SampleSet) -> Result<SampleSet, Range<u32>>,
    ) -> Result<Self, Overlap> {
        let nothing = SampleSet::default();
        let mut combined = Self::default();
        let edges = |runs: &[Run]| -> Vec<u32> {
            runs.iter()
                .flat_map(|run| [run.x.start, run.x.end])
                .collect()
        };
        let bands = self.bands.iter().chain(&other.bands);
        for y in cells(bands.flat_map(|band| [band.y.start, band.y.end]).collect()) {
            let [own, others] = [self, other].map(|coverage| {
                let band = coverage.band_at(y.start);
                band.map_or(&[][..], |band| &band.runs)
            });
            let mut runs: Vec<Run> = Vec::new();
            for x in cells([edges(own), edges(others)].concat()) {
                let of = |runs| samples_at(runs, x.start).unwrap_or(&nothing);
                let samples =
                    combine(of(own), of(others)).map_err(|common| (rectangle(&x, &y), common))?;
                match runs.last_mut() {
                    _ if samples.is_empty() => {}
                    Some(last) if last.x.end == x.start && last.samples == samples => {
                        last.x.end = x.end;
                    }
                    _ => runs.push(Run { x, samples }),
                }
            }
            combined.push(y, runs);
        }
        Ok(combined)
    }

    /// Appends rows, which must be below all others and have valid runs. Returns whether that holds.
    pub fn push(&mut self, y: Range<u32>, runs: Vec<Run>) -> bool {
        let in_order = |pair: &[Run]| {
            let (before, after) = (&pair[0], &pair[1]);
            before.x.end < after.x.start
                || before.x.end == after.x.start && before.samples != after.samples
        };
        let is_empty = |run: &Run| run.x.is_empty() || run.samples.is_empty();
        if y.is_empty() || !runs.windows(2).all(in_order) || runs.iter().any(is_empty) {
            return false;
        }
        match self.bands.last_mut() {
            _ if runs.is_empty() => {}
            Some(last) if last.y.end > y.start => return false,
            Some(last) if last.y.end == y.start && last.runs == runs => last.y.end = y.end,
            last => {
                let first = last.map_or(0, |last| last.first + last.runs.len());
                self.bands.push(Band { y, runs, first });
            }
        }
        true
    }

    fn band_at(&self, y: u32) -> Option<&Band> {
        let index = self.bands.partition_point(|band| band.y.end <= y);
        self.bands.get(index).filter(|band| band.y.start <= y)
    }
}

fn samples_at(runs: &[Run], x: u32) -> Option<&SampleSet> {
    let index = runs.partition_point(|run| run.x.end <= x);
    let run = runs.get(index).filter(|run| run.x.start <= x)?;
    Some(&run.samples)
}

/// The ranges between neighbouring edges.
fn cells(mut edges: Vec<u32>) -> impl Iterator<Item = Range<u32>> {
    edges.sort_unstable();
    edges.dedup();
    let ends = edges.clone().into_iter().skip(1);
    edges.into_iter().zip(ends).map(|(start, end)| start..end)
}

fn rectangle(x: &Range<u32>, y: &Range<u32>) -> [u32; 4] {
    [x.start, y.start, x.end - x.start, y.end - y.start]
}
