//! The rounds of adaptive sampling in checkpoints: the statistics of all pixels before the round in progress. The
//! pixels of the round follow from them.

use super::{Adaptive, FilmTile, PixelStatistics};
use crate::{
    binary::{ReadError, Reader, Writer},
    layers,
};
use glimray_scene::threads;
use std::io::{self, Read, Write};

/// More rounds than there can be: each doubles the samples.
const MOST_ROUNDS: u32 = 64;

/// Bytes of the statistics of a pixel.
const PIXEL_BYTES: usize = 44;

impl Adaptive {
    pub fn write_round<W: Write>(&self, out: &mut Writer<W>) -> io::Result<()> {
        out.number(self.rounds)?;
        if self.is_in_first_round() {
            return Ok(());
        }
        out.number(self.front.start)?;
        out.words(&self.pixels, PixelStatistics::to_bytes)?;
        out.words(self.features.as_flattened(), f64::to_le_bytes)
    }

    /// Continues in the round that [`Self::write_round`] wrote and returns its tiles; `None` in the first one.
    pub fn read_round<R: Read>(
        &mut self,
        input: &mut Reader<R>,
    ) -> Result<Option<Vec<FilmTile>>, ReadError> {
        let damaged = |why| Err(ReadError::Damaged { why });
        let rounds = input.number()?;
        if rounds == 0 {
            return Ok(None);
        }
        let front = input.number()?;
        if rounds > MOST_ROUNDS || front > self.samples {
            return damaged("it has more rounds than the picture");
        }
        self.pixels = input.words(self.pixels.len() as u64, PixelStatistics::from_bytes)?;
        if !(self.pixels.iter()).all(|pixel| pixel.is_finite() && pixel.count <= self.samples) {
            return damaged("its statistics are invalid");
        }
        let features = input.words(4 * self.features.len() as u64, f64::from_le_bytes)?;
        if !features.iter().all(|number| number.is_finite()) {
            return damaged("its features are not finite");
        }
        self.features = features.as_chunks().0.to_vec();
        // As before the round. The last one may have sampled any group.
        let (count, opacity) = (
            layers::rows(self.layers),
            layers::rows_of_noisy_opacity(self.layers),
        );
        let estimate = |index: usize| {
            let features = self.features.get(index * count..).unwrap_or_default();
            (self.measure).estimate(&self.pixels[index], &features[opacity.clone()])
        };
        self.estimates = threads::collect(self.pixels.len(), estimate);
        self.sampled.fill(true);
        self.rounds = rounds - 1;
        self.front = front..front;
        Ok(Some(self.next_round()))
    }
}

impl PixelStatistics {
    fn to_bytes(self) -> [u8; PIXEL_BYTES] {
        let [r, g, b] = self.sum;
        let mut bytes = [0; PIXEL_BYTES];
        let (numbers, count) = bytes.as_chunks_mut::<8>();
        for (bytes, number) in numbers.iter_mut().zip([r, g, b, self.weight, self.squares]) {
            *bytes = number.to_le_bytes();
        }
        count.copy_from_slice(&self.count.to_le_bytes());
        bytes
    }

    fn from_bytes(bytes: [u8; PIXEL_BYTES]) -> Self {
        let (numbers, _) = bytes.as_chunks::<8>();
        let number = |index: usize| f64::from_le_bytes(numbers[index]);
        let [.., a, b, c, d] = bytes;
        Self {
            sum: [number(0), number(1), number(2)],
            weight: number(3),
            squares: number(4),
            count: u32::from_le_bytes([a, b, c, d]),
        }
    }

    fn is_finite(&self) -> bool {
        let numbers = self.sum.iter().chain([&self.weight, &self.squares]);
        numbers.into_iter().all(|number| number.is_finite())
    }
}
