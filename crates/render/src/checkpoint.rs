//! Checkpoints: the exact state of a render between two submissions, so that another process can go on with it. The
//! picture then has the bytes of an undisturbed run.
//!
//! The file: a signature, the version, what the render is of, its counts, the round of adaptive sampling, the position,
//! the sums of the film tiles up to there, and a hash (binary.rs). Film tiles and lists of pixels are not stored: they
//! follow from the settings.

mod counts;
mod error;
mod identity;

pub use error::CheckpointError;

use super::{
    Cursor, RenderError, Renderer,
    binary::{ReadError, Reader, Writer},
    film_tile::FilmTile,
    film_tiles::FilmTiles,
    slice::Slice,
    sums::SAMPLE_BLOCK,
    work::Work,
};
use counts::Counts;
use identity::Identity;
use std::io::{self, Read, Write};
use xxhash_rust::xxh3::Xxh3;

const SIGNATURE: [u8; 8] = *b"glimckpt";
const VERSION: u32 = 2;

/// The state of a render, to be written to a file.
pub struct Checkpoint<'a>(&'a Renderer);

impl Renderer {
    /// The state of the render, with all samples taken so far, also of submitted work.
    ///
    /// # Errors
    /// The device failed. Between two [`Renderer::step`]s, also failed ones, that is impossible if the policy keeps
    /// host copies ([`super::ExecutionPolicy::host_copy`]).
    pub async fn checkpoint_async(&mut self) -> Result<Checkpoint<'_>, RenderError> {
        self.fetch_film().await?;
        Ok(Checkpoint(self))
    }

    /// Goes on from a checkpoint that [`Checkpoint::write`] wrote, up to the end of `input`. The counts of
    /// [`super::Stats`] become those of the checkpoint: samples, paths, rays and light, but not times, submissions,
    /// uploads and losses. Rays are not counted if either run does not count them.
    ///
    /// # Errors
    /// The input is not a checkpoint, has another version, is truncated or damaged, is of another picture, part of a
    /// picture, adapter or version of the program, or cannot be read. The render is then as before.
    pub fn resume(&mut self, input: impl Read) -> Result<(), CheckpointError> {
        let mut input = Reader {
            input,
            hash: Xxh3::new(),
            bytes: 0,
        };
        match input.array() {
            Ok(SIGNATURE) => {}
            Ok(_) | Err(ReadError::CutShort { .. }) => return Err(CheckpointError::NotACheckpoint),
            Err(error) => return Err(error.into()),
        }
        let found = input.number()?;
        if found != VERSION {
            return Err(CheckpointError::Version {
                found,
                known: VERSION,
            });
        }
        Identity::of(self).check_same(&Identity::read(&mut input)?)?;
        let counts = Counts::read(&mut input)?;
        let mut tiles = self.new_tiles();
        tiles.read_round(&mut input)?;
        let position = Position::read(&mut input, &tiles)?;
        let Cursor { tile, sample, .. } = position.cursor;
        tiles.read_sums(&mut input, tile, sample)?;
        let current = tiles.list.get(tile);
        if current.is_some_and(|tile| tile.sums.is_empty() && position.needs_sums(tile)) {
            return Err(damaged("it lacks sums").into());
        }
        input.finish()?;
        self.tiles = tiles;
        self.cursor = position.cursor;
        self.work = (position.unfinished).map(|(slice, parts)| Work::left(slice, parts));
        self.device.loaded_tile = None;
        counts.put(&mut self.stats, self.policy.count_rays);
        Ok(())
    }
}

impl Checkpoint<'_> {
    /// Writes the checkpoint.
    ///
    /// # Errors
    /// `out` fails.
    pub fn write(&self, out: impl Write) -> io::Result<()> {
        let Self(renderer) = self;
        let mut out = Writer {
            out,
            hash: Xxh3::new(),
        };
        out.bytes(&SIGNATURE)?;
        out.number(VERSION)?;
        Identity::of(renderer).write(&mut out)?;
        Counts::of(&renderer.stats).write(&mut out)?;
        renderer.tiles.write_round(&mut out)?;
        Position::of(renderer).write(&mut out)?;
        renderer.tiles.write_sums(&mut out, renderer.cursor.tile)?;
        out.finish()
    }
}

/// How far the render is.
struct Position {
    cursor: Cursor,
    /// The slice in progress, if any, and the parts of it that are left.
    unfinished: Option<(Slice, Vec<Slice>)>,
}

impl Position {
    fn of(renderer: &Renderer) -> Self {
        // After the last round of adaptive sampling there are no tiles left.
        let tile = renderer.cursor.tile.min(renderer.tiles.list.len());
        Self {
            cursor: Cursor {
                tile,
                ..renderer.cursor
            },
            unfinished: renderer.work.as_ref().map(Work::unfinished),
        }
    }

    /// Whether some samples of the current block of this tile have been taken, or may have been. A list has positions, too.
    fn needs_sums(&self, tile: &FilmTile) -> bool {
        let Cursor { group, sample, .. } = self.cursor;
        let block = tile.samples.start.max(sample - sample % SAMPLE_BLOCK);
        let is_begun = |(slice, parts): &(Slice, Vec<Slice>)| {
            parts.iter().map(Slice::work).sum::<f64>() < slice.work()
        };
        let is_in_slice = |unfinished| !tile.places().is_empty() || is_begun(unfinished);
        group > 0 || sample > block || self.unfinished.as_ref().is_some_and(is_in_slice)
    }

    fn write<W: Write>(&self, out: &mut Writer<W>) -> io::Result<()> {
        let Cursor {
            tile,
            group,
            sample,
            sweep_samples,
        } = self.cursor;
        for number in [tile as u32, group, sample, sweep_samples] {
            out.number(number)?;
        }
        let (slice, parts) = match &self.unfinished {
            None => return out.number(0),
            Some((slice, parts)) => (slice, parts),
        };
        out.number(1 + parts.len() as u32)?;
        for part in [slice].into_iter().chain(parts) {
            for number in [
                part.first_group,
                part.end_group,
                part.first_sample,
                part.end_sample,
            ] {
                out.number(number)?;
            }
        }
        Ok(())
    }

    fn read<R: Read>(input: &mut Reader<R>, tiles: &FilmTiles) -> Result<Self, ReadError> {
        let cursor = Cursor {
            tile: input.number()? as usize,
            group: input.number()?,
            sample: input.number()?,
            sweep_samples: input.number()?,
        };
        let mut slices = Vec::new();
        for _ in 0..input.number()? {
            let slice = Slice {
                first_group: input.number()?,
                end_group: input.number()?,
                first_sample: input.number()?,
                end_sample: input.number()?,
            };
            input.push(&mut slices, slice)?;
        }
        let unfinished = match slices.as_slice() {
            [] => None,
            [slice, parts @ ..] => Some((*slice, parts.to_vec())),
        };
        let position = Self { cursor, unfinished };
        match position.is_valid(tiles) {
            true => Ok(position),
            false => Err(damaged("its position is outside of the picture")),
        }
    }

    fn is_valid(&self, tiles: &FilmTiles) -> bool {
        let Cursor {
            tile,
            group,
            sample,
            sweep_samples,
        } = self.cursor;
        let Some(current) = tiles.list.get(tile) else {
            let is_end = (tiles.list.last()).is_none_or(|last| last.samples.end == sample);
            return tile == tiles.list.len() && is_end && group == 0 && self.unfinished.is_none();
        };
        let groups = current.group_count();
        if group >= groups || !current.samples.contains(&sample) {
            return false;
        }
        let left = current.samples.end - sample;
        let in_sweep = 1..=left.min(SAMPLE_BLOCK - sample % SAMPLE_BLOCK);
        let whole = match &self.unfinished {
            None => return group == 0 || in_sweep.contains(&sweep_samples),
            Some(_) if !in_sweep.contains(&sweep_samples) => return false,
            Some(_) => Slice {
                first_group: group,
                end_group: groups,
                first_sample: sample,
                end_sample: sample + sweep_samples,
            },
        };
        self.unfinished.as_ref().is_some_and(|(slice, parts)| {
            let begins = slice.first_group == group
                && (slice.first_sample, slice.end_sample) == (whole.first_sample, whole.end_sample);
            begins && whole.contains(slice) && parts.iter().all(|part| slice.contains(part))
        })
    }
}

fn damaged(why: &'static str) -> ReadError {
    ReadError::Damaged { why }
}
