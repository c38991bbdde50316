//! GIF: one palette for the whole video. Each frame stores only the rectangle that changed, with
//! unchanged pixels transparent.

use super::palette::{Dither, MAX_COLOURS, Palette, Samples};
use super::{FrameRate, Frames, Picture8, VideoFormat, VideoOptions, failed};
use crate::output::OutputError;
use ::gif::{DisposalMethod, Encoder, Frame, Repeat};
use std::borrow::Cow;
use std::fmt::Display;
use std::ops::Range;

/// Number of frames that the palette is trained on.
const TRAINED: usize = 32;

/// The index of unchanged pixels.
const UNCHANGED: u8 = MAX_COLOURS as u8;

/// The contents of the file.
pub(super) fn encode(mut frames: Frames, options: &VideoOptions) -> Result<Vec<u8>, OutputError> {
    let palette = palette(&mut frames)?;
    let side = |pixels: u32| u16::try_from(pixels).map_err(refused);
    let (width, height) = (side(frames.width)?, side(frames.height)?);
    // Full size, so that the table includes the index of unchanged pixels.
    let mut colours = palette.colours.clone();
    colours.resize(usize::from(UNCHANGED) + 1, [0; 3]);
    let mut file =
        Encoder::new(Vec::new(), width, height, colours.as_flattened()).map_err(refused)?;
    if options.repeat {
        file.set_repeat(Repeat::Infinite).map_err(refused)?;
    }
    let mut canvas = Canvas::new(&palette, usize::from(width));
    for index in 0..frames.count {
        let picture = frames.get(index)?;
        let delay = delay(options.rate, index);
        file.write_frame(&canvas.draw(picture, delay))
            .map_err(refused)?;
    }
    file.into_inner().map_err(refused)
}

fn palette(frames: &mut Frames) -> Result<Palette, OutputError> {
    let count = frames.count.min(TRAINED);
    let mut samples = Samples::new(count);
    for sample in 0..count {
        // The first, the last, and others evenly spaced between them.
        let index = sample * (frames.count - 1) / (count - 1).max(1);
        samples.add(&frames.get(index)?);
    }
    Ok(samples.palette())
}

/// The delay of frame `index` in hundredths of a second. The end times are rounded, so that errors do not
/// accumulate.
fn delay(rate: FrameRate, index: usize) -> u16 {
    let (frames, seconds) = rate.parts();
    let (frames, seconds) = (u128::from(frames), u128::from(seconds));
    let start = |index: u128| (200 * index * seconds + frames) / (2 * frames);
    let index = index as u128;
    u16::try_from(start(index + 1) - start(index)).unwrap_or(u16::MAX)
}

/// The image that a viewer shows.
struct Canvas<'a> {
    dither: Dither<'a>,
    width: usize,
    /// Indices; empty before the first frame.
    shown: Vec<u8>,
    picture: Picture8,
}

impl<'a> Canvas<'a> {
    fn new(palette: &'a Palette, width: usize) -> Self {
        Self {
            dither: Dither::new(palette),
            width,
            shown: Vec::new(),
            picture: Picture8::default(),
        }
    }

    /// Draws `picture` on the canvas, and returns the update that does so.
    fn draw(&mut self, picture: Picture8, delay: u16) -> Frame<'static> {
        let is_first = self.shown.is_empty();
        let indices = self.indices(&picture);
        let drawn: Vec<u8> = match is_first {
            true => indices.clone(),
            false => indices
                .iter()
                .zip(&self.shown)
                .map(|(&new, &old)| if new == old { UNCHANGED } else { new })
                .collect(),
        };
        (self.shown, self.picture) = (indices, picture);

        let (columns, rows) = changed(&drawn, self.width);
        let lines = drawn.chunks_exact(self.width);
        let buffer: Vec<u8> = lines
            .skip(rows.start)
            .take(rows.len())
            .flat_map(|line| &line[columns.clone()])
            .copied()
            .collect();
        Frame {
            delay,
            dispose: DisposalMethod::Keep,
            transparent: Some(UNCHANGED),
            left: columns.start as u16,
            top: rows.start as u16,
            width: columns.len() as u16,
            height: rows.len() as u16,
            buffer: Cow::Owned(buffer),
            ..Frame::default()
        }
    }

    /// Only pixels that differ from the last frame are dithered.
    fn indices(&mut self, picture: &Picture8) -> Vec<u8> {
        let pixels = picture.pixels.iter().enumerate();
        pixels
            .map(|(at, &colour)| {
                if self.picture.pixels.get(at) == Some(&colour) {
                    return self.shown[at];
                }
                let (x, y) = (at % self.width, at / self.width);
                self.dither.index(colour, x, y)
            })
            .collect()
    }
}

/// The range of columns and rows that are drawn; one pixel if there are none.
fn changed(drawn: &[u8], width: usize) -> (Range<usize>, Range<usize>) {
    let mut found: Option<(Range<usize>, Range<usize>)> = None;
    for (y, line) in drawn.chunks_exact(width).enumerate() {
        let is_drawn = |&index: &u8| index != UNCHANGED;
        let ends = (
            line.iter().position(is_drawn),
            line.iter().rposition(is_drawn),
        );
        if let (Some(first), Some(last)) = ends {
            let (columns, rows) = found.unwrap_or((first..last, y..y));
            let columns = columns.start.min(first)..columns.end.max(last + 1);
            found = Some((columns, rows.start..y + 1));
        }
    }
    found.unwrap_or((0..1, 0..1))
}

fn refused(error: impl Display) -> OutputError {
    failed(VideoFormat::Gif, error)
}
