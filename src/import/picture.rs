//! Images that scenes refer to: PNG, JPEG, Radiance HDR and OpenEXR, recognised by their first bytes.
//!
//! PNG and JPEG are decoded as sRGB, HDR and EXR as linear Rec. 709. Transparency is ignored. A truncated
//! file is refused even if its decoder would accept it.

mod complete;

use super::error::{Fault, ImportError};
use super::paths::{Files, Refusal};
use super::source::quote;
use crate::scene::Picture;
pub(super) use crate::scene::linear_from_srgb;
use glam::Vec3;
use image::{DynamicImage, ImageError, ImageReader, Limits};
use std::collections::HashMap;
use std::io::Cursor;
use std::path::{Path, PathBuf};
use std::sync::Arc;

/// Size limit of an image file in bytes.
const MAX_BYTES: u64 = 512 << 20;

/// Limit of the number of texels of all images of a scene together, from the GPU's texel buffer.
const MAX_TEXELS: u64 = (8192 << 12) - 1;

/// Memory limit for decoding: four floats per texel.
const MAX_DECODED_BYTES: u64 = (MAX_TEXELS + 1) * 16;

/// The images of a scene; each file is read once.
#[derive(Default)]
pub(super) struct Pictures {
    pub pictures: Vec<Arc<Picture>>,
    indices: HashMap<PathBuf, usize>,
}

/// Why an image could not be read.
pub(super) enum Refused {
    /// The name does not resolve to a readable file.
    File(Refusal),
    /// The file exists but is not a usable image.
    Unfit {
        kind: fn(Box<Fault>) -> ImportError,
        why: String,
        todo: String,
    },
}

impl Refused {
    /// As an error; `malformed` adds the position.
    pub fn into_error(self, malformed: impl FnOnce(String, &str) -> ImportError) -> ImportError {
        const WHAT: &str = "picture refused";
        match self {
            Self::File(refusal) => refusal.into_error("picture", malformed),
            Self::Unfit { kind, why, todo } => {
                let mut fault = malformed(why, &todo).into_fault();
                fault.what = WHAT.to_owned();
                kind(fault)
            }
        }
    }

    /// As a clause for [`crate::scene::Scene::skipped`].
    pub fn into_note(self) -> String {
        match self {
            Self::File(Refusal::Missing(why) | Refusal::Outside(why) | Refusal::Unfit(why)) => why,
            Self::Unfit { why, .. } => why,
        }
    }
}

impl Pictures {
    /// The index of the image in the file `name`.
    ///
    /// # Errors
    /// The file is missing or inaccessible, is not an image, or is too large.
    pub fn read(&mut self, files: &Files, name: &str) -> Result<usize, Refused> {
        let path = files.resolve(name).map_err(Refused::File)?;
        if let Some(&index) = self.indices.get(&path) {
            return Ok(index);
        }
        let taken = self.pictures.iter().map(|p| p.texels.len() as u64).sum();
        let picture = decode(files, &path, name, taken)?;
        self.pictures.push(Arc::new(picture));
        self.indices.insert(path, self.pictures.len() - 1);
        Ok(self.pictures.len() - 1)
    }
}

/// Reads the image at `path`; `taken` texels are already in use.
fn decode(files: &Files, path: &Path, name: &str, taken: u64) -> Result<Picture, Refused> {
    let quoted = quote(name.as_bytes());
    let too_big = |why: String| Refused::Unfit {
        kind: ImportError::TooBig,
        why: format!("{quoted} {why}"),
        todo: "Use a smaller picture".to_owned(),
    };
    let bytes = files.read(path, MAX_BYTES).map_err(|error| {
        let is_too_big = error.is_too_big();
        let fault = error.into_fault();
        match is_too_big {
            true => too_big(format!("has {}", fault.why)),
            false => Refused::Unfit {
                kind: ImportError::Unreadable,
                why: format!("{quoted}: {}", fault.why),
                todo: fault.todo,
            },
        }
    })?;
    let unfit = |why: String, todo: &str| Refused::Unfit {
        kind: ImportError::Malformed,
        why: format!("{quoted} {why}"),
        todo: todo.to_owned(),
    };
    let reader = || {
        let reader = ImageReader::new(Cursor::new(&bytes)).with_guessed_format();
        reader.ok().filter(|reader| reader.format().is_some())
    };
    let explain = |error: ImageError| match error {
        ImageError::Limits(_) => too_big("takes too much memory to decode".to_owned()),
        ImageError::Unsupported(_) => {
            let why = "is an image of an unsupported kind";
            unfit(why.to_owned(), "Save it as PNG, JPEG, HDR or EXR")
        }
        error => {
            let why = format!("is damaged: {}", one_line(&error.to_string()));
            unfit(why, "Check that it was written completely")
        }
    };
    let (Some(head), Some(mut body)) = (reader(), reader()) else {
        let why = "is not a supported image";
        return Err(unfit(why.to_owned(), "Name a PNG, JPEG, HDR or EXR file"));
    };
    // Check the header first: it may claim any size.
    let (width, height) = head.into_dimensions().map_err(explain)?;
    let count = u64::from(width) * u64::from(height);
    if count == 0 {
        return Err(unfit("has no texels".to_owned(), "Save it again"));
    }
    if taken + count > MAX_TEXELS {
        let others = match taken {
            0 => String::new(),
            _ => format!(", the others {taken} texels"),
        };
        let why = format!("has {width} × {height}{others}, but the limit is {MAX_TEXELS} texels");
        return Err(too_big(why));
    }
    if let Some(format) = body.format() {
        complete::check(format, &bytes, count)
            .map_err(|why| unfit(why, "Check that it was written completely"))?;
    }
    let mut limits = Limits::no_limits();
    limits.max_alloc = Some(MAX_DECODED_BYTES);
    body.limits(limits);
    let image = body.decode().map_err(explain)?;
    let texels = linear(image);
    Ok(Picture {
        width,
        height,
        texels,
    })
}

/// The texels of `image`, row by row from the top left, as finite linear colours, 0 or more.
fn linear(image: DynamicImage) -> Vec<Vec3> {
    let as_they_are = |c: f32| if c > 0.0 { c.min(f32::MAX) } else { 0.0 };
    match image {
        DynamicImage::ImageRgb32F(_) | DynamicImage::ImageRgba32F(_) => {
            let image = image.into_rgb32f();
            image
                .pixels()
                .map(|p| Vec3::from(p.0.map(as_they_are)))
                .collect()
        }
        image => {
            let curve: Vec<f32> = (0..=u16::MAX)
                .map(|code| linear_from_srgb(f64::from(code) / f64::from(u16::MAX)) as f32)
                .collect();
            let texel = |p: &[u16; 3]| Vec3::from(p.map(|code| curve[usize::from(code)]));
            let channels = usize::from(image.color().channel_count());
            if usize::from(image.color().bytes_per_pixel()) == channels {
                // 8 bits convert to 16 without loss: 65535 is 255 times 257.
                let wide = |byte: u8| 257 * u16::from(byte);
                let texels = image.as_bytes().chunks_exact(channels);
                return texels
                    .map(|p| match *p {
                        [r, g, b] | [r, g, b, _] => texel(&[r, g, b].map(wide)),
                        _ => texel(&[wide(p[0]); 3]),
                    })
                    .collect();
            }
            image.into_rgb16().pixels().map(|p| texel(&p.0)).collect()
        }
    }
}

/// A decoder's message as a clause on one line.
fn one_line(message: &str) -> String {
    const LONGEST: usize = 160;
    let visible = |c: char| if c.is_control() { ' ' } else { c };
    let line: String = message.chars().take(LONGEST).map(visible).collect();
    line.trim_end_matches('.').to_owned()
}
