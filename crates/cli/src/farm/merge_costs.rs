//! Costs of merging on this machine: reading films and adding their sums, developing and writing pictures, and encoding
//! a video. The time of the disk comes on top. Frames are merged by the machines that render their films.

use super::manifest::Part;
use super::results::frame_ending;
use super::work::Work;
use glimray_app::error::AppError;
use glimray_io::output::video::{self, FrameRate, VideoFormat, VideoOptions};
use glimray_io::output::{self, OutputError, SaveOptions};
use glimray_render::gpu::Gpu;
use glimray_render::{Film, FilmError, FilmOutline, SAMPLE_BLOCK, Tone};
use glimray_scene::image::Image;
use std::collections::BTreeSet;
use std::hint::black_box;
use std::path::Path;
use std::time::Instant;

/// Pixels of the picture that is measured.
const PIXELS: u32 = 1 << 20;

/// Frames of the video that is measured.
const FRAMES: usize = 4;

/// Bytes of a pixel that is being developed: its sums in f64 and f32, three buffers of the device, and the picture.
const DEVELOPED_BYTES: u64 = (size_of::<[f64; 4]>() + 5 * size_of::<[f32; 4]>()) as u64;

/// Costs of merging.
pub struct MergeCosts {
    /// Seconds to read a byte of a film of one block of samples and to add it.
    block: f64,
    /// Seconds per byte for films of several blocks.
    totals: f64,
    /// Seconds to develop a pixel and to write it.
    finish: f64,
    /// Seconds to read a pixel of a frame and to encode it; 0 if the result is not a video.
    encode: f64,
}

/// Memory and time to merge parts.
pub struct Merging {
    /// Size of the largest film.
    pub largest_bytes: u64,
    /// Size of all films.
    pub read_bytes: u64,
    /// Sums of the picture, one film, and the developed picture.
    pub memory_bytes: u64,
    /// Seconds that each part adds for the merge of its frame, which is done by the machines that render.
    pub part_seconds: f64,
    /// Seconds of the process that merges all, without those of the disk.
    pub seconds: f64,
}

impl MergeCosts {
    /// Measures them with pixels of a picture like `sample`, which goes to `output`.
    ///
    /// # Errors
    /// The device fails, or there is no place for temporary files.
    pub fn measure(
        film: &FilmOutline,
        sample: &Image,
        gpu: &Gpu,
        (output, quality): (&Path, u8),
    ) -> Result<Self, AppError> {
        let (width, height) = film.header().size;
        let region = [0, 0, width, height.min((PIXELS / width).max(1))];
        let pixels = f64::from(width) * f64::from(region[3]);
        let fault = |error: FilmError| AppError::Internal(format!("a part: {error}"));
        let all = film.header().samples;
        let whole = film.part(region, 0..all).map_err(fault)?;
        let add = |samples: u32| {
            let part = film.part(region, 0..samples.min(all))?;
            let bytes = part.bytes() as f64;
            let mut file = Vec::new();
            part.blank().write(&mut file)?;
            let mut sum = whole.clone().blank();
            let started = Instant::now();
            sum.add(&Film::read(&*file)?);
            let seconds = started.elapsed().as_secs_f64();
            black_box(sum);
            Ok(seconds / bytes)
        };
        let block = add(SAMPLE_BLOCK).map_err(fault)?;
        let totals = add(2 * SAMPLE_BLOCK).map_err(fault)?;

        let started = Instant::now();
        black_box(whole.blank().develop(gpu, &Tone::LINEAR)?);
        let developed = started.elapsed().as_secs_f64();
        let image = repeated(sample, width, region[3]);
        let folder = tempfile::tempdir().map_err(|source| OutputError::Io {
            path: std::env::temp_dir(),
            source,
        })?;
        let frame = folder
            .path()
            .join(format!("frame.{}", frame_ending(output)));
        let options = SaveOptions {
            quality,
            ..SaveOptions::default()
        };
        let started = Instant::now();
        output::save_with(&frame, &image, &options)?;
        let saved = started.elapsed().as_secs_f64();
        let encode = match VideoFormat::from_path(output) {
            None => 0.0,
            Some(format) => {
                let options = VideoOptions {
                    rate: FrameRate::FILM,
                    quality,
                    ..VideoOptions::default()
                };
                let path = folder.path().join("video");
                let started = Instant::now();
                video::encode(&path, format, &options, FRAMES, &mut |_| {
                    video::read_frame(&frame)
                })?;
                started.elapsed().as_secs_f64() / FRAMES as f64 / pixels
            }
        };
        Ok(Self {
            block,
            totals,
            finish: (developed + saved) / pixels,
            encode,
        })
    }

    /// Memory and time to merge these parts.
    ///
    /// # Errors
    /// A fault in a cut.
    pub fn of(&self, work: &Work, parts: &[Part]) -> Result<Merging, AppError> {
        let mut merging = Merging {
            largest_bytes: 0,
            read_bytes: 0,
            memory_bytes: 0,
            part_seconds: 0.0,
            seconds: 0.0,
        };
        let mut films_seconds = 0.0;
        let [.., width, height] = work.settings.region();
        let pixels = u64::from(width) * u64::from(height);
        let mut pictures = BTreeSet::new();
        for part in parts {
            let Some(film) = work.film(part)? else {
                continue;
            };
            let bytes = film.bytes();
            merging.largest_bytes = merging.largest_bytes.max(bytes);
            merging.read_bytes += bytes;
            let samples = part
                .samples
                .map_or(film.header().samples, |[start, end]| end - start);
            let is_block = film.header().is_adaptive() || samples <= SAMPLE_BLOCK;
            films_seconds += bytes as f64 * if is_block { self.block } else { self.totals };
            pictures.insert(part.frames);
        }
        films_seconds += pictures.len() as f64 * pixels as f64 * self.finish;
        merging.memory_bytes = pixels * DEVELOPED_BYTES;
        if !pictures.is_empty() {
            merging.memory_bytes += work.whole_film()?.bytes() + merging.largest_bytes;
        }
        match &work.timeline {
            None => merging.seconds = films_seconds,
            Some(timeline) => {
                merging.part_seconds = films_seconds / parts.len() as f64;
                merging.seconds = timeline.count as f64 * pixels as f64 * self.encode;
            }
        }
        Ok(merging)
    }
}

/// A picture of this size with the rows of `image`, over and over.
fn repeated(image: &Image, width: u32, height: u32) -> Image {
    let pixels = image.pixels.iter().copied().cycle();
    Image {
        width,
        height,
        pixels: pixels.take(width as usize * height as usize).collect(),
    }
}
