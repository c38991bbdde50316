//! Binary files that end with a hash of everything before it: films and checkpoints. All numbers are little-endian.
//!
//! Memory grows with the data that is read, not with counts that a file claims.

use super::sums::{LARGEST, Sums};
use bytemuck::{cast_slice, pod_collect_to_vec};
use std::io::{self, ErrorKind, Read, Write};
use xxhash_rust::xxh3::Xxh3;

/// Maximum number of bytes read at once.
const STEP: usize = 1 << 16;

/// Why a file could not be read.
#[derive(Debug)]
pub enum ReadError {
    /// The file ends after so many bytes.
    CutShort { bytes: u64 },
    /// The contents are invalid.
    Damaged { why: &'static str },
    /// Memory ran out after so many bytes.
    TooBig { bytes: u64 },
    /// The input failed.
    Io(io::Error),
}

/// Writes the parts of a file and hashes them.
pub struct Writer<W> {
    pub out: W,
    pub hash: Xxh3,
}

impl<W: Write> Writer<W> {
    pub fn bytes(&mut self, bytes: &[u8]) -> io::Result<()> {
        self.hash.update(bytes);
        self.out.write_all(bytes)
    }

    pub fn number(&mut self, number: u32) -> io::Result<()> {
        self.bytes(&number.to_le_bytes())
    }

    pub fn text(&mut self, text: &str) -> io::Result<()> {
        self.number(text.len() as u32)?;
        self.bytes(text.as_bytes())
    }

    pub fn words<T: Copy, const N: usize>(
        &mut self,
        words: &[T],
        bytes: fn(T) -> [u8; N],
    ) -> io::Result<()> {
        for part in words.chunks(STEP / N) {
            let part: Vec<u8> = part.iter().flat_map(|word| bytes(*word)).collect();
            self.bytes(&part)?;
        }
        Ok(())
    }

    /// Writes rows without their number.
    pub fn sums(&mut self, sums: &Sums) -> io::Result<()> {
        match sums {
            Sums::Block(rows) => self.block(rows),
            Sums::Totals(rows) => self.words(rows.as_flattened(), i128::to_le_bytes),
        }
    }

    /// Writes the rows of one block without their number.
    pub fn block(&mut self, rows: &[[f32; 4]]) -> io::Result<()> {
        self.words(rows.as_flattened(), f32::to_le_bytes)
    }

    /// Ends the file with the hash.
    pub fn finish(mut self) -> io::Result<()> {
        let digest = self.hash.digest128();
        self.out.write_all(&digest.to_le_bytes())?;
        self.out.flush()
    }
}

/// Reads the parts of a file and hashes them.
pub struct Reader<R> {
    pub input: R,
    pub hash: Xxh3,
    /// Bytes read so far.
    pub bytes: u64,
}

impl<R: Read> Reader<R> {
    pub fn array<const N: usize>(&mut self) -> Result<[u8; N], ReadError> {
        let mut array = [0; N];
        self.fill(&mut array)?;
        Ok(array)
    }

    pub fn number(&mut self) -> Result<u32, ReadError> {
        Ok(u32::from_le_bytes(self.array()?))
    }

    pub fn text(&mut self) -> Result<String, ReadError> {
        let length = self.number()?;
        let bytes = self.words(length.into(), |[byte]: [u8; 1]| byte)?;
        String::from_utf8(bytes).map_err(|_| ReadError::Damaged {
            why: "it has a name that is not valid text",
        })
    }

    /// Reads `count` words, allocating memory only for those present.
    pub fn words<T, const N: usize>(
        &mut self,
        count: u64,
        word: fn([u8; N]) -> T,
    ) -> Result<Vec<T>, ReadError> {
        let mut words = Vec::new();
        let mut left = count;
        let mut buffer = vec![0; STEP.min(N * count.min(STEP as u64) as usize)];
        while left > 0 {
            let now = left.min((STEP / N) as u64) as usize;
            let part = &mut buffer[..N * now];
            self.fill(part)?;
            let too_big = ReadError::TooBig { bytes: self.bytes };
            words.try_reserve(now).map_err(|_| too_big)?;
            words.extend(part.as_chunks::<N>().0.iter().map(|bytes| word(*bytes)));
            left -= now as u64;
        }
        Ok(words)
    }

    /// Reads as many rows: the sums of so many blocks of samples.
    pub fn sums(&mut self, rows: u64, blocks: u32) -> Result<Sums, ReadError> {
        if blocks == 1 {
            return Ok(Sums::Block(self.block(rows)?));
        }
        let numbers = self.words(4 * rows, i128::from_le_bytes)?;
        let most = LARGEST * i128::from(blocks);
        match numbers.iter().all(|number| (-most..=most).contains(number)) {
            true => Ok(Sums::Totals(cast_slice(&numbers).to_vec())),
            false => Err(ReadError::Damaged {
                why: "it has sums that are too large",
            }),
        }
    }

    /// Reads as many rows of one block.
    pub fn block(&mut self, rows: u64) -> Result<Vec<[f32; 4]>, ReadError> {
        let numbers = self.words(4 * rows, f32::from_le_bytes)?;
        match numbers.iter().all(|number| number.is_finite()) {
            true => Ok(pod_collect_to_vec(&numbers)),
            false => Err(ReadError::Damaged {
                why: "it has sums that are not finite",
            }),
        }
    }

    pub fn push<T>(&self, list: &mut Vec<T>, item: T) -> Result<(), ReadError> {
        let too_big = ReadError::TooBig { bytes: self.bytes };
        list.try_reserve(1).map_err(|_| too_big)?;
        list.push(item);
        Ok(())
    }

    /// Checks the hash, and that nothing follows it.
    pub fn finish(mut self) -> Result<(), ReadError> {
        let digest = self.hash.digest128();
        if u128::from_le_bytes(self.array()?) != digest {
            return Err(ReadError::Damaged {
                why: "its checksum is wrong",
            });
        }
        match self.array::<1>() {
            Err(ReadError::CutShort { .. }) => Ok(()),
            Err(error) => Err(error),
            Ok(_) => Err(ReadError::Damaged {
                why: "there is data after its end",
            }),
        }
    }

    fn fill(&mut self, part: &mut [u8]) -> Result<(), ReadError> {
        let mut filled = 0;
        while filled < part.len() {
            match self.input.read(&mut part[filled..]) {
                Ok(0) => return Err(ReadError::CutShort { bytes: self.bytes }),
                Ok(count) => {
                    filled += count;
                    self.bytes += count as u64;
                }
                Err(error) if error.kind() == ErrorKind::Interrupted => {}
                Err(error) => return Err(ReadError::Io(error)),
            }
        }
        self.hash.update(part);
        Ok(())
    }
}
