//! Small pictures of bookmarked views: JPEG files, as hexadecimal digits in the settings.

use crate::model::small::small;
use glimray_scene::image::ScreenImage;
use image::codecs::jpeg::JpegEncoder;
use image::{DynamicImage, ImageFormat, RgbImage};
use serde::{Deserialize, Serialize};

/// Most pixels of a side.
pub const THUMBNAIL: [u32; 2] = [120, 80];
/// Quality of the JPEG file, of 100.
const QUALITY: u8 = 80;
/// Most bytes of the file: larger ones are not of this program.
const MOST_BYTES: usize = 64 << 10;

/// A small picture.
#[derive(Clone, Debug, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(try_from = "String", into = "String")]
pub struct Thumbnail {
    jpeg: Vec<u8>,
}

impl Thumbnail {
    /// The picture, made smaller, in front of black; `None` without pixels.
    pub fn of(picture: &ScreenImage) -> Option<Self> {
        let small = DynamicImage::from(small(picture, THUMBNAIL)?).into_rgb8();
        let mut jpeg = Vec::new();
        small
            .write_with_encoder(JpegEncoder::new_with_quality(&mut jpeg, QUALITY))
            .ok()?;
        Some(Self { jpeg })
    }

    /// The picture in 8 bits per channel; `None` if its file is damaged.
    pub fn pixels(&self) -> Option<RgbImage> {
        let picture = image::load_from_memory_with_format(&self.jpeg, ImageFormat::Jpeg);
        let picture = picture.ok()?.into_rgb8();
        let is_small = picture.width() <= THUMBNAIL[0] && picture.height() <= THUMBNAIL[1];
        is_small.then_some(picture)
    }
}

impl From<Thumbnail> for String {
    fn from(thumbnail: Thumbnail) -> Self {
        thumbnail
            .jpeg
            .iter()
            .map(|byte| format!("{byte:02x}"))
            .collect()
    }
}

impl TryFrom<String> for Thumbnail {
    type Error = &'static str;

    fn try_from(text: String) -> Result<Self, Self::Error> {
        let is_hex = text.bytes().all(|byte| byte.is_ascii_hexdigit());
        if !is_hex || !text.len().is_multiple_of(2) || text.len() > 2 * MOST_BYTES {
            return Err("`picture` must be the hexadecimal digits of a small JPEG file");
        }
        let byte = |at: usize| u8::from_str_radix(&text[at..at + 2], 16).unwrap_or_default();
        let jpeg = (0..text.len()).step_by(2).map(byte).collect();
        Ok(Self { jpeg })
    }
}
