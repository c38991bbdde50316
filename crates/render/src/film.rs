//! The film: the accumulated samples of a picture as a value that can be written, read, merged with other parts
//! of the same picture, and developed.
//!
//! Sums are stored for each pixel, independent of film tiles and submissions, and blocks of samples are added
//! exactly ([`SAMPLE_BLOCK`]). Parts of a picture, split anywhere between pixels and between blocks, therefore
//! merge in any order to the same film as a single run.

mod coverage;
mod develop;
mod error;
mod features;
mod file;
mod gather;
mod outline;

pub use error::FilmError;
pub use outline::FilmOutline;

use super::{
    Fingerprint, Integrator, Tone,
    layers::{self, Layer},
    sums::{SAMPLE_BLOCK, Sums},
};
use coverage::{Coverage, SampleSet};
use std::{collections::BTreeSet, ops::Range};

/// The picture that a film is a part of. Films can be merged only if their headers differ at most in the
/// adapters.
#[derive(Clone, Debug, PartialEq)]
pub struct FilmHeader {
    /// The version of glimray that rendered it; another version may compute other samples.
    pub program: String,
    /// Fingerprint of the packed scene.
    pub scene: Fingerprint,
    /// Fingerprint of the packed frame: camera, lights and instances.
    pub view: Fingerprint,
    /// Fingerprint of the settings of the whole picture.
    pub settings: Fingerprint,
    /// The integrator.
    pub integrator: Integrator,
    /// Width and height of the whole picture in pixels.
    pub size: (u32, u32),
    /// Samples of each pixel in the whole picture; with adaptive sampling the maximum.
    pub samples: u32,
    /// The layers of each pixel.
    pub layers: &'static [&'static Layer],
    /// The default tone for developing the picture.
    pub tone: Tone,
    /// The adapters that took part, as [`crate::gpu::AdapterReport::identity`]; different ones may round differently.
    pub adapters: BTreeSet<String>,
}

/// A part of a picture, or all of it: sums of samples that are written, read and merged. However the samples of a picture
/// are cut, the parts merge to the bytes of one run:
///
/// ```
/// # std::env::set_current_dir(concat!(env!("CARGO_MANIFEST_DIR"), "/../.."))?;
/// use glimray::gpu::{AdapterChoice, Gpu};
/// use glimray::render::{ExecutionPolicy, Film, RenderSettings, Renderer, SAMPLE_BLOCK};
/// use glimray::{import, pack};
/// use std::{path::Path, sync::Arc};
///
/// let scene = import::load(Path::new("assets/scenes/carousel.toml"))?;
/// let packed = Arc::new(pack::scene(&scene)?);
/// let view = packed.frame(&scene.frame(0.0))?;
/// let render = |sample_range| -> Result<Film, Box<dyn std::error::Error>> {
///     let settings = RenderSettings {
///         size: (16, 9),
///         samples: 3 * SAMPLE_BLOCK,
///         sample_range,
///         ..RenderSettings::from(&scene.output)
///     };
///     let gpu = Gpu::new(&AdapterChoice::default())?;
///     let policy = ExecutionPolicy::default();
///     let mut renderer = Renderer::new(gpu, packed.clone(), &view, settings, policy)?;
///     while !renderer.is_done() {
///         renderer.step()?;
///     }
///     Ok(renderer.film()?)
/// };
/// // Two machines render the halves, and a third one merges their files.
/// let mut file = Vec::new();
/// render(Some(0..SAMPLE_BLOCK))?.write(&mut file)?;
/// let merged = Film::read(file.as_slice())?.merge(&render(Some(SAMPLE_BLOCK..3 * SAMPLE_BLOCK))?)?;
/// assert!(merged.missing().is_empty());
/// assert_eq!(merged, render(None)?);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct Film {
    header: FilmHeader,
    coverage: Coverage,
    /// For each patch of the coverage, its pixels row by row.
    sums: Vec<Sums>,
}

/// Pixels and samples that a film lacks.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Missing {
    /// x, y, width and height in pixels of the whole picture.
    pub region: [u32; 4],
    /// The samples missing in each of its pixels.
    pub samples: Range<u32>,
}

/// The sums of a rectangle, row by row, and the range of their samples.
pub(super) struct Piece {
    pub region: [u32; 4],
    pub samples: Range<u32>,
    pub sums: Sums,
}

impl FilmHeader {
    /// Whether sampling was adaptive. A pixel then stores the mean and the number of its samples, and samples
    /// cannot be split.
    pub fn is_adaptive(&self) -> bool {
        self.layers.contains(&&layers::COUNT)
    }

    /// Whether the picture has opacity: see [`super::RenderSettings::has_opacity`].
    pub fn has_opacity(&self) -> bool {
        self.layers.contains(&&layers::OPACITY)
    }

    /// The whole picture as a rectangle: x, y, width, height.
    fn whole(&self) -> [u32; 4] {
        [0, 0, self.size.0, self.size.1]
    }

    /// Whether these samples are stored as a single block.
    fn is_block(&self, samples: &SampleSet) -> bool {
        self.is_adaptive() || samples.block_count() == 1
    }

    /// A range of samples, if it consists of whole blocks.
    fn blocks(&self, samples: Range<u32>) -> Result<SampleSet, FilmError> {
        let ends = samples.end.is_multiple_of(SAMPLE_BLOCK) || samples.end == self.samples;
        match samples.start.is_multiple_of(SAMPLE_BLOCK) && ends {
            true => Ok(SampleSet::new(samples)),
            false => Err(FilmError::Unaligned { samples }),
        }
    }

    /// Rejects the header of another picture.
    fn check_same(&self, other: &Self) -> Result<(), FilmError> {
        fn same<T: PartialEq>(
            what: &'static str,
            (a, b): (&T, &T),
            text: impl Fn(&T) -> String,
        ) -> Result<(), FilmError> {
            match a == b {
                true => Ok(()),
                false => Err(FilmError::Differs {
                    what,
                    first: text(a),
                    second: text(b),
                }),
            }
        }
        let Self {
            program,
            scene,
            view,
            settings,
            integrator,
            size,
            samples,
            layers,
            tone,
            adapters: _,
        } = self;
        let size_text = |(width, height): &(u32, u32)| format!("{width}×{height}");
        let name = |integrator: &Integrator| integrator.entry().name.to_owned();
        let names = |layers: &&[&Layer]| {
            let names: Vec<_> = layers.iter().map(|layer| layer.name).collect();
            names.join(",")
        };
        same(
            "version of glimray",
            (program, &other.program),
            String::clone,
        )?;
        same("size", (size, &other.size), size_text)?;
        same("integrator", (integrator, &other.integrator), name)?;
        same(
            "number of samples",
            (samples, &other.samples),
            u32::to_string,
        )?;
        same("layers", (layers, &other.layers), names)?;
        same("scene", (scene, &other.scene), Fingerprint::to_string)?;
        same("view", (view, &other.view), Fingerprint::to_string)?;
        same(
            "settings",
            (settings, &other.settings),
            Fingerprint::to_string,
        )?;
        same("tone", (tone, &other.tone), Tone::to_string)
    }
}

impl Film {
    /// A film of pieces that do not overlap.
    pub(super) fn new(header: FilmHeader, pieces: Vec<Piece>) -> Result<Self, FilmError> {
        let mut coverage = Coverage::default();
        for piece in &pieces {
            let own = Coverage::rectangle(piece.region, header.blocks(piece.samples.clone())?);
            coverage = united(&coverage, &own)?;
        }
        let outline = FilmOutline { header, coverage };
        // A single piece is the film.
        if pieces.len() == 1 {
            let sums = pieces.into_iter().map(|piece| piece.sums).collect();
            return Ok(outline.with_sums(sums));
        }
        let mut film = outline.blank();
        for piece in &pieces {
            film.add_rectangle(piece.region, &piece.sums);
        }
        Ok(film)
    }

    /// The header.
    pub fn header(&self) -> &FilmHeader {
        &self.header
    }

    /// Sets the default tone for developing the picture.
    pub fn set_tone(&mut self, tone: Tone) {
        self.header.tone = tone;
    }

    /// The bounding rectangle of all pixels with samples: x, y, width, height.
    pub fn region(&self) -> [u32; 4] {
        self.coverage.bounds()
    }

    /// The film's rectangles (x, y, width, height) and their ranges of samples, from top to bottom and left to right.
    pub fn parts(&self) -> impl Iterator<Item = ([u32; 4], &[Range<u32>])> {
        self.coverage.parts()
    }

    /// The picture this film belongs to and the region it covers.
    pub fn outline(&self) -> FilmOutline {
        FilmOutline {
            header: self.header.clone(),
            coverage: self.coverage.clone(),
        }
    }

    /// Merges two films. For many, [`FilmOutline::blank`] and [`Film::add`] take less memory and time.
    ///
    /// # Errors
    /// They are not of the same picture, or have samples in common.
    pub fn merge(&self, other: &Self) -> Result<Self, FilmError> {
        let mut film = self.outline().merge(&other.outline())?.blank();
        film.add(self);
        film.add(other);
        Ok(film)
    }

    /// Adds the sums of a part to a film that was [blank](FilmOutline::blank) and whose outline has the part. Each part is
    /// added once, in any order.
    pub fn add(&mut self, part: &Self) {
        for ((region, _), sums) in part.coverage.patches().zip(&part.sums) {
            self.add_rectangle(region, sums);
        }
    }

    /// Adds the sums of a rectangle within the coverage.
    fn add_rectangle(&mut self, [x, y, width, height]: [u32; 4], part: &Sums) {
        let pixel_rows = layers::pixel_rows(self.header.layers);
        let rows = pixel_rows.count;
        for row in 0..height {
            let mut column = 0;
            while column < width {
                let found = self.coverage.patch_at(x + column, y + row);
                let Some((index, [left, top, across, _])) = found else {
                    break;
                };
                let count = (left + across - (x + column)).min(width - column);
                let to = (y + row - top) as usize * across as usize + (x + column - left) as usize;
                let from = row as usize * width as usize + column as usize;
                let added = rows * count as usize;
                self.sums[index].add(rows * to, part, rows * from, added, pixel_rows);
                column += count;
            }
        }
    }

    /// The missing parts of the whole picture; empty if the film is complete.
    pub fn missing(&self) -> Vec<Missing> {
        self.missing_of(self.header.whole())
    }

    /// The missing parts of a rectangle of the picture: x, y, width, height.
    pub fn missing_of(&self, region: [u32; 4]) -> Vec<Missing> {
        outline::missing(&self.header, &self.coverage, region)
    }

    /// Rows per pixel.
    fn rows(&self) -> usize {
        layers::rows(self.header.layers)
    }
}

fn united(first: &Coverage, second: &Coverage) -> Result<Coverage, FilmError> {
    let overlap = |(region, samples)| FilmError::Overlap { region, samples };
    first.union(second).map_err(overlap)
}
