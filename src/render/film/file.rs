//! The file format of films. All numbers are little-endian.
//!
//! A signature, the version, the header, the coverage band by band, the sums patch by patch, and a 128-bit XXH3
//! hash of everything before it. Memory grows with the data that is read, not with counts that the file claims.

use super::{
    super::{
        Fingerprint, Integrator, Tone, layers,
        sums::{LARGEST, SAMPLE_BLOCK, Sums},
    },
    Film, FilmError, FilmHeader, FilmOutline,
    coverage::{Coverage, Run, SampleSet},
};
use bytemuck::{cast_slice, pod_collect_to_vec};
use std::{
    collections::BTreeSet,
    io::{self, ErrorKind, Read, Write},
};
use xxhash_rust::xxh3::Xxh3;

const SIGNATURE: [u8; 8] = *b"glimfilm";
const VERSION: u32 = 2;
/// Maximum number of bytes read at once.
const STEP: usize = 1 << 16;

impl Film {
    /// Writes the film. Equal films give the same bytes.
    ///
    /// # Errors
    /// Those of `out`.
    pub fn write(&self, out: impl Write) -> io::Result<()> {
        let mut out = Writer {
            out,
            hash: Xxh3::new(),
        };
        out.bytes(&SIGNATURE)?;
        out.number(VERSION)?;
        let FilmHeader {
            program,
            scene,
            view,
            settings,
            integrator,
            size,
            samples,
            layers,
            tone,
            adapters,
        } = &self.header;
        out.text(program)?;
        for Fingerprint(fingerprint) in [scene, view, settings] {
            out.bytes(&fingerprint.to_le_bytes())?;
        }
        for number in [size.0, size.1, *samples, SAMPLE_BLOCK] {
            out.number(number)?;
        }
        out.text(integrator.entry().name)?;
        out.number(layers.len() as u32)?;
        for layer in *layers {
            out.text(layer.name)?;
        }
        for number in tone.numbers() {
            out.number(number)?;
        }
        out.number(adapters.len() as u32)?;
        for adapter in adapters {
            out.text(adapter)?;
        }
        out.number(self.coverage.bands().len() as u32)?;
        for band in self.coverage.bands() {
            for number in [band.y.start, band.y.end, band.runs.len() as u32] {
                out.number(number)?;
            }
            for Run { x, samples } in &band.runs {
                let ranges = samples.ranges();
                for number in [x.start, x.end, ranges.len() as u32] {
                    out.number(number)?;
                }
                for range in ranges {
                    out.number(range.start)?;
                    out.number(range.end)?;
                }
            }
        }
        for sums in &self.sums {
            match sums {
                Sums::Block(rows) => out.words(rows.as_flattened(), f32::to_le_bytes)?,
                Sums::Totals(rows) => out.words(rows.as_flattened(), i128::to_le_bytes)?,
            }
        }
        let digest = out.hash.digest128();
        out.out.write_all(&digest.to_le_bytes())?;
        out.out.flush()
    }

    /// Reads a film written by [`Film::write`], up to the end of `input`.
    ///
    /// # Errors
    /// The input is not a film, has another version, is truncated or damaged, or cannot be read.
    pub fn read(input: impl Read) -> Result<Self, FilmError> {
        let mut input = Reader {
            input,
            hash: Xxh3::new(),
            bytes: 0,
        };
        let FilmOutline { header, coverage } = outline(&mut input)?;
        let mut sums = Vec::new();
        for ([.., width, height], samples) in coverage.patches() {
            let pixels = u64::from(width) * u64::from(height);
            let numbers = pixels * 4 * layers::rows(header.layers) as u64;
            let sum = match header.is_block(samples) {
                true => Sums::Block(block(&input.words(numbers, f32::from_le_bytes)?)?),
                false => {
                    let most = LARGEST * i128::from(samples.block_count());
                    Sums::Totals(totals(&input.words(numbers, i128::from_le_bytes)?, most)?)
                }
            };
            input.push(&mut sums, sum)?;
        }
        let digest = input.hash.digest128();
        if u128::from_le_bytes(input.array()?) != digest {
            return Err(damaged("its checksum is wrong"));
        }
        match input.array::<1>() {
            Err(FilmError::CutShort { .. }) => {}
            Err(error) => return Err(error),
            Ok(_) => return Err(damaged("there is data after its end")),
        }
        Ok(Self {
            header,
            coverage,
            sums,
        })
    }
}

impl FilmOutline {
    /// Reads the beginning of a film. Its sums are not read, so its checksum is not checked: [`Film::read`] does that.
    ///
    /// # Errors
    /// The input is not a film, has another version, is truncated or damaged, or cannot be read.
    pub fn read(input: impl Read) -> Result<Self, FilmError> {
        outline(&mut Reader {
            input,
            hash: Xxh3::new(),
            bytes: 0,
        })
    }
}

fn outline<R: Read>(input: &mut Reader<R>) -> Result<FilmOutline, FilmError> {
    if input.array().map_err(no_film)? != SIGNATURE {
        return Err(FilmError::NotAFilm);
    }
    let found = input.number()?;
    if found != VERSION {
        return Err(FilmError::Version {
            found,
            known: VERSION,
        });
    }
    let header = header(input)?;
    let coverage = coverage(input, &header)?;
    Ok(FilmOutline { header, coverage })
}

fn header<R: Read>(input: &mut Reader<R>) -> Result<FilmHeader, FilmError> {
    let program = input.text()?;
    let mut fingerprints = [Fingerprint(0); 3];
    for fingerprint in &mut fingerprints {
        fingerprint.0 = u128::from_le_bytes(input.array()?);
    }
    let [scene, view, settings] = fingerprints;
    let size = (input.number()?, input.number()?);
    let samples = input.number()?;
    if input.number()? != SAMPLE_BLOCK || samples == 0 {
        return Err(damaged("its number of samples is invalid"));
    }
    let name = input.text()?;
    let integrator = Integrator::named(&name).ok_or(damaged("its integrator is unknown"))?;
    let mut names = Vec::new();
    for _ in 0..input.number()? {
        let name = input.text()?;
        input.push(&mut names, name)?;
    }
    let layers = layers::named(&names).ok_or(damaged("its layers are unknown"))?;
    let mut numbers = [0; 6];
    for number in &mut numbers {
        *number = input.number()?;
    }
    let tone = Tone::from_numbers(numbers).ok_or(damaged("its tone is unknown"))?;
    let mut adapters = BTreeSet::new();
    for _ in 0..input.number()? {
        let adapter = input.text()?;
        if adapters.last().is_some_and(|last| *last >= adapter) {
            return Err(damaged("its adapters are not in order"));
        }
        adapters.insert(adapter);
    }
    Ok(FilmHeader {
        program,
        scene,
        view,
        settings,
        integrator,
        size,
        samples,
        layers,
        tone,
        adapters,
    })
}

fn coverage<R: Read>(input: &mut Reader<R>, header: &FilmHeader) -> Result<Coverage, FilmError> {
    let mut coverage = Coverage::default();
    for index in 0..input.number()? as usize {
        let y = input.number()?..input.number()?;
        let mut runs = Vec::new();
        for _ in 0..input.number()? {
            let x = input.number()?..input.number()?;
            let samples = samples(input, header)?;
            if x.end > header.size.0 {
                return Err(damaged("it has pixels outside of the picture"));
            }
            input.push(&mut runs, Run { x, samples })?;
        }
        let is_inside = y.end <= header.size.1 && !runs.is_empty();
        if !is_inside || !coverage.push(y, runs) || coverage.bands().len() != index + 1 {
            return Err(damaged("its rows are not in order"));
        }
    }
    Ok(coverage)
}

fn samples<R: Read>(input: &mut Reader<R>, header: &FilmHeader) -> Result<SampleSet, FilmError> {
    let mut samples = SampleSet::default();
    for index in 0..input.number()? as usize {
        let (start, end) = (input.number()?, input.number()?);
        let is_cut_well = start.is_multiple_of(SAMPLE_BLOCK)
            && (end.is_multiple_of(SAMPLE_BLOCK) || end == header.samples);
        let is_whole = start == 0 && end == header.samples;
        if end > header.samples || !is_cut_well || header.is_adaptive() && !is_whole {
            return Err(damaged("it has samples that the picture does not have"));
        }
        if !samples.push(start..end) || samples.ranges().len() != index + 1 {
            return Err(damaged("its samples are not in order"));
        }
    }
    if samples.is_empty() {
        return Err(damaged("it has pixels without samples"));
    }
    Ok(samples)
}

fn block(numbers: &[f32]) -> Result<Vec<[f32; 4]>, FilmError> {
    match numbers.iter().all(|number| number.is_finite()) {
        true => Ok(pod_collect_to_vec(numbers)),
        false => Err(damaged("it has sums that are not finite")),
    }
}

fn totals(numbers: &[i128], most: i128) -> Result<Vec<[i128; 4]>, FilmError> {
    match numbers.iter().all(|number| (-most..=most).contains(number)) {
        true => Ok(cast_slice(numbers).to_vec()),
        false => Err(damaged("it has sums that are too large")),
    }
}

fn damaged(why: &'static str) -> FilmError {
    FilmError::Damaged { why }
}

/// A file too short for the signature is not a film.
fn no_film(error: FilmError) -> FilmError {
    match error {
        FilmError::CutShort { .. } => FilmError::NotAFilm,
        other => other,
    }
}

struct Writer<W> {
    out: W,
    hash: Xxh3,
}

impl<W: Write> Writer<W> {
    fn bytes(&mut self, bytes: &[u8]) -> io::Result<()> {
        self.hash.update(bytes);
        self.out.write_all(bytes)
    }

    fn number(&mut self, number: u32) -> io::Result<()> {
        self.bytes(&number.to_le_bytes())
    }

    fn text(&mut self, text: &str) -> io::Result<()> {
        self.number(text.len() as u32)?;
        self.bytes(text.as_bytes())
    }

    fn words<T: Copy, const N: usize>(
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
}

struct Reader<R> {
    input: R,
    hash: Xxh3,
    /// Bytes read so far.
    bytes: u64,
}

impl<R: Read> Reader<R> {
    fn array<const N: usize>(&mut self) -> Result<[u8; N], FilmError> {
        let mut array = [0; N];
        self.fill(&mut array)?;
        Ok(array)
    }

    fn number(&mut self) -> Result<u32, FilmError> {
        Ok(u32::from_le_bytes(self.array()?))
    }

    fn text(&mut self) -> Result<String, FilmError> {
        let length = self.number()?;
        let bytes = self.words(length.into(), |[byte]: [u8; 1]| byte)?;
        String::from_utf8(bytes).map_err(|_| damaged("it has a name that is not valid text"))
    }

    /// Reads `count` words, allocating memory only for those present.
    fn words<T, const N: usize>(
        &mut self,
        count: u64,
        word: fn([u8; N]) -> T,
    ) -> Result<Vec<T>, FilmError> {
        let mut words = Vec::new();
        let mut left = count;
        let mut buffer = vec![0; STEP.min(N * count.min(STEP as u64) as usize)];
        while left > 0 {
            let now = left.min((STEP / N) as u64) as usize;
            let part = &mut buffer[..N * now];
            self.fill(part)?;
            let too_big = FilmError::TooBig { bytes: self.bytes };
            words.try_reserve(now).map_err(|_| too_big)?;
            words.extend(part.as_chunks::<N>().0.iter().map(|bytes| word(*bytes)));
            left -= now as u64;
        }
        Ok(words)
    }

    fn push<T>(&self, list: &mut Vec<T>, item: T) -> Result<(), FilmError> {
        let too_big = FilmError::TooBig { bytes: self.bytes };
        list.try_reserve(1).map_err(|_| too_big)?;
        list.push(item);
        Ok(())
    }

    fn fill(&mut self, part: &mut [u8]) -> Result<(), FilmError> {
        let mut filled = 0;
        while filled < part.len() {
            match self.input.read(&mut part[filled..]) {
                Ok(0) => return Err(FilmError::CutShort { bytes: self.bytes }),
                Ok(count) => {
                    filled += count;
                    self.bytes += count as u64;
                }
                Err(error) if error.kind() == ErrorKind::Interrupted => {}
                Err(error) => return Err(error.into()),
            }
        }
        self.hash.update(part);
        Ok(())
    }
}
