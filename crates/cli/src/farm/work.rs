//! The work to cut: a picture or an animation with its costs.

use super::cut::{self, Picture};
use super::manifest::Part;
use super::measure::Costs;
use crate::animate::Timeline;
use glimray_app::error::AppError;
use glimray_render::{FilmOutline, RenderSettings};
use std::ops::Range;

/// The work to cut.
pub struct Work<'a> {
    pub settings: &'a RenderSettings,
    pub timeline: Option<Timeline>,
    pub costs: Costs,
}

impl Work<'_> {
    /// Seconds of rendering.
    pub fn seconds(&self) -> f64 {
        self.costs.frames.iter().sum()
    }

    /// At least `count` parts, or as many as there can be.
    pub fn cut(&self, count: usize) -> Vec<Part> {
        let Some(timeline) = &self.timeline else {
            return self.pieces(None, self.costs.frames[0], count);
        };
        let numbers: Vec<u32> = timeline.numbers().collect();
        if count <= numbers.len() {
            let ranges = cut::even(&self.costs.frames, count);
            let part = |range: Range<usize>| Part {
                frames: Some([numbers[range.start], numbers[range.end - 1]]),
                samples: None,
                crop: None,
                seconds: self.costs.frames[range].iter().sum(),
            };
            return ranges.into_iter().map(part).collect();
        }
        let each = count.div_ceil(numbers.len());
        (numbers.iter().zip(&self.costs.frames))
            .flat_map(|(number, seconds)| self.pieces(Some(*number), *seconds, each))
            .collect()
    }

    /// The outline of the film of a part; `None` for whole frames.
    ///
    /// # Errors
    /// The part's samples are not whole blocks: a fault.
    pub fn film(&self, part: &Part) -> Result<Option<FilmOutline>, AppError> {
        if !part.is_film() {
            return Ok(None);
        }
        let (width, height) = self.settings.size;
        let [x0, y0, x1, y1] = part.crop.unwrap_or([0, 0, width, height]);
        let [start, end] = part.samples.unwrap_or([0, self.settings.samples]);
        self.outline([x0, y0, x1 - x0, y1 - y0], start..end)
            .map(Some)
    }

    /// The outline of the film that the merge makes of a picture.
    ///
    /// # Errors
    /// The picture's samples are not whole blocks: a fault.
    pub fn whole_film(&self) -> Result<FilmOutline, AppError> {
        self.outline(self.settings.region(), 0..self.settings.samples)
    }

    fn outline(&self, region: [u32; 4], samples: Range<u32>) -> Result<FilmOutline, AppError> {
        let outline = self.costs.film.part(region, samples);
        outline.map_err(|error| AppError::Internal(format!("a part: {error}")))
    }

    /// The parts of one picture, which takes `seconds`.
    fn pieces(&self, frame: Option<u32>, seconds: f64, count: usize) -> Vec<Part> {
        let [x, y, width, height] = self.settings.region();
        let region = [x, y, x + width, y + height];
        let known: f64 = self.costs.rows.iter().sum();
        let factor = if known > 0.0 { seconds / known } else { 0.0 };
        let picture = Picture {
            region,
            samples: self.settings.samples,
            has_blocks: !self.settings.is_adaptive(),
            rows: self.costs.rows.iter().map(|row| row * factor).collect(),
        };
        let pieces = picture.cut(count);
        // A frame that is not cut is rendered as a frame.
        let is_whole_frame = frame.is_some() && pieces.len() == 1;
        let whole = [0, 0, self.settings.size.0, self.settings.size.1];
        let part = |piece: cut::Piece| Part {
            frames: frame.map(|frame| [frame, frame]),
            samples: (!is_whole_frame && piece.samples != (0..self.settings.samples))
                .then_some([piece.samples.start, piece.samples.end]),
            crop: (!is_whole_frame && piece.crop != whole).then_some(piece.crop),
            seconds: piece.seconds,
        };
        pieces.into_iter().map(part).collect()
    }
}
