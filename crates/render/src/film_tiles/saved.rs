//! The film tiles in checkpoints. Their rectangles and lists of pixels follow from the settings and, with adaptive
//! sampling, from the statistics of the rounds before; only the sums are stored.

use super::FilmTiles;
use crate::binary::{ReadError, Reader, Writer};
use std::io::{self, Read, Write};

impl FilmTiles {
    /// Writes what the tiles of this round follow from, besides the settings.
    pub fn write_round<W: Write>(&self, out: &mut Writer<W>) -> io::Result<()> {
        match &self.adaptive {
            None => Ok(()),
            Some(adaptive) => adaptive.write_round(out),
        }
    }

    /// Puts new tiles into the round that [`Self::write_round`] wrote.
    pub fn read_round<R: Read>(&mut self, input: &mut Reader<R>) -> Result<(), ReadError> {
        if let Some(adaptive) = &mut self.adaptive
            && let Some(list) = adaptive.read_round(input)?
        {
            self.list = list;
        }
        Ok(())
    }

    /// Writes the sums: all of the first `done` tiles, and those of the next one so far.
    pub fn write_sums<W: Write>(&self, out: &mut Writer<W>, done: usize) -> io::Result<()> {
        for (index, tile) in self.list.iter().take(done + 1).enumerate() {
            if let Some(closed) = &tile.closed {
                out.sums(closed)?;
            }
            if index == done {
                out.number((!tile.sums.is_empty()).into())?;
            }
            out.block(&tile.sums)?;
        }
        Ok(())
    }

    /// Reads what [`Self::write_sums`] wrote before `sample` of the tile after the `done` ones, into tiles without sums.
    pub fn read_sums<R: Read>(
        &mut self,
        input: &mut Reader<R>,
        done: usize,
        sample: u32,
    ) -> Result<(), ReadError> {
        for (index, tile) in self.list.iter_mut().take(done + 1).enumerate() {
            let rows = tile.row_count() as u64;
            let is_current = index == done;
            let blocks = tile.closed_blocks(match is_current {
                true => sample,
                false => tile.samples.end,
            });
            if blocks > 0 {
                tile.closed = Some(input.sums(rows, blocks)?);
            }
            if !is_current || input.number()? != 0 {
                tile.sums = input.block(rows)?;
            }
        }
        Ok(())
    }
}
