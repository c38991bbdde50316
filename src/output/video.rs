//! Stands in for the video writers until they are merged: Y4M with all chroma, nothing else.
#![allow(missing_docs)]

use super::{OutputError, atomic};
use crate::image::Image;
use std::io::{self, Write};
use std::path::Path;

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum VideoFormat {
    Mp4,
    Gif,
    Y4m,
}

impl VideoFormat {
    pub const ENDINGS: &str = ".mp4, .gif, .y4m";

    pub fn from_path(path: &Path) -> Option<Self> {
        match path.extension()?.to_str()?.to_ascii_lowercase().as_str() {
            "mp4" => Some(Self::Mp4),
            "gif" => Some(Self::Gif),
            "y4m" => Some(Self::Y4m),
            _ => None,
        }
    }
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct FrameRate {
    pub numerator: u32,
    pub denominator: u32,
}

impl FrameRate {
    pub fn from_f64(fps: f64) -> Option<Self> {
        (fps > 0.0).then_some(Self {
            numerator: (fps * 1000.0).round() as u32,
            denominator: 1000,
        })
    }
}

#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Picture8 {
    pub width: u32,
    pub height: u32,
    pub pixels: Vec<[u8; 3]>,
}

impl From<&Image> for Picture8 {
    fn from(image: &Image) -> Self {
        let level = |v: f32| (v.clamp(0.0, 1.0) * 255.0).round() as u8;
        Self {
            width: image.width,
            height: image.height,
            pixels: (image.pixels.iter())
                .map(|&[r, g, b, _]| [level(r), level(g), level(b)])
                .collect(),
        }
    }
}

#[derive(Clone, Copy, Debug)]
pub struct VideoOptions {
    pub rate: FrameRate,
    pub quality: u8,
    pub repeat: bool,
    pub clobber: bool,
}

pub fn read_frame(path: &Path) -> Result<Picture8, OutputError> {
    let failed = |error: ::image::ImageError| OutputError::Io {
        path: path.into(),
        source: io::Error::other(error),
    };
    let image = ::image::open(path).map_err(failed)?.into_rgb8();
    Ok(Picture8 {
        width: image.width(),
        height: image.height(),
        pixels: image.pixels().map(|p| p.0).collect(),
    })
}

pub fn check(
    path: &Path,
    _: VideoFormat,
    options: &VideoOptions,
    _: u32,
    _: u32,
) -> Result<(), OutputError> {
    atomic::check(path, options.clobber)
}

pub fn encode(
    path: &Path,
    _: VideoFormat,
    options: &VideoOptions,
    count: usize,
    frame: &mut dyn FnMut(usize) -> Result<Picture8, OutputError>,
) -> Result<(), OutputError> {
    let first = frame(0)?;
    let mut bytes = Vec::new();
    let mut writer = Y4mWriter::new(&mut bytes, first.width, first.height, options.rate)
        .expect("memory takes all");
    for index in 0..count {
        writer.write(&frame(index)?).expect("memory takes all");
    }
    writer.finish().expect("memory takes all");
    atomic::write(path, &bytes, options.clobber)
}

pub struct Y4mWriter<W: Write>(W);

impl<W: Write> Y4mWriter<W> {
    pub fn new(mut writer: W, width: u32, height: u32, rate: FrameRate) -> io::Result<Self> {
        let FrameRate {
            numerator,
            denominator,
        } = rate;
        writeln!(
            writer,
            "YUV4MPEG2 W{width} H{height} F{numerator}:{denominator} Ip A1:1 C444"
        )?;
        Ok(Self(writer))
    }

    pub fn write(&mut self, picture: &Picture8) -> io::Result<()> {
        self.0.write_all(b"FRAME\n")?;
        for channel in 0..3 {
            let plane: Vec<u8> = picture.pixels.iter().map(|p| p[channel]).collect();
            self.0.write_all(&plane)?;
        }
        Ok(())
    }

    pub fn finish(mut self) -> io::Result<()> {
        self.0.flush()
    }
}
