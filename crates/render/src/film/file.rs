//! The file format of films. All numbers are little-endian.
//!
//! A signature, the version, the header, the coverage band by band, the sums patch by patch, and a 128-bit XXH3
//! hash of everything before it.

use super::{
    super::{
        Fingerprint, Integrator, Tone,
        binary::{ReadError, Reader, Writer},
        layers,
        settings::MAX_SIDE,
        sums::SAMPLE_BLOCK,
    },
    Film, FilmError, FilmHeader, FilmOutline,
    coverage::{Coverage, Run, SampleSet},
};
use std::{
    collections::BTreeSet,
    io::{self, Read, Write},
};
use xxhash_rust::xxh3::Xxh3;

const SIGNATURE: [u8; 8] = *b"glimfilm";
const VERSION: u32 = 3;

impl Film {
    /// Writes the film. Equal films give the same bytes.
    ///
    /// # Errors
    /// `out` fails.
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
            out.sums(sums)?;
        }
        out.finish()
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
            let rows = pixels * layers::rows(header.layers) as u64;
            let blocks = match header.is_block(samples) {
                true => 1,
                false => samples.block_count(),
            };
            let sum = input.sums(rows, blocks)?;
            input.push(&mut sums, sum)?;
        }
        input.finish()?;
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
    let sides = 1..=MAX_SIDE;
    if !sides.contains(&size.0) || !sides.contains(&size.1) {
        return Err(damaged("its size is invalid"));
    }
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

fn damaged(why: &'static str) -> FilmError {
    FilmError::Damaged { why }
}

/// A file too short for the signature is not a film.
fn no_film(error: ReadError) -> FilmError {
    match error {
        ReadError::CutShort { .. } => FilmError::NotAFilm,
        other => other.into(),
    }
}

impl From<ReadError> for FilmError {
    fn from(error: ReadError) -> Self {
        match error {
            ReadError::CutShort { bytes } => Self::CutShort { bytes },
            ReadError::Damaged { why } => Self::Damaged { why },
            ReadError::TooBig { bytes } => Self::TooBig { bytes },
            ReadError::Io(error) => Self::Io(error),
        }
    }
}
