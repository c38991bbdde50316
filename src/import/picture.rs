//! Images that scenes refer to: PNG, JPEG, Radiance HDR and OpenEXR, recognised by their first bytes.
//!
//! PNG and JPEG are sRGB and keep their 8 bits, or become floats if they have 16; HDR and EXR are linear Rec.
//! 709. A truncated file is refused even if its decoder would accept it.

mod complete;

use super::error::{Fault, ImportError, one_line};
use super::paths::{Files, Refusal};
use super::source::quote;
pub(super) use crate::scene::linear_from_srgb;
use crate::scene::{Picture, Texels};
use glam::Vec4;
use image::{DynamicImage, ImageError, ImageReader, Limits};
use std::collections::HashMap;
use std::io::Cursor;
use std::path::{Path, PathBuf};
use std::sync::Arc;

/// Size limit of an image file in bytes.
pub(super) const MAX_BYTES: u64 = 512 << 20;

/// Limit of the number of texels of an image: 8192×8192.
const MAX_TEXELS: u64 = 1 << 26;

/// Limit of the bytes of all images of a scene together, as they are kept.
const MAX_KEPT_BYTES: u64 = 4 << 30;

/// Memory limit for decoding: four floats per texel.
const MAX_DECODED_BYTES: u64 = MAX_TEXELS * 16;

/// The images of a scene; each file is read once for each role.
#[derive(Default)]
pub(super) struct Pictures {
    pub pictures: Vec<Arc<Picture>>,
    indices: HashMap<(PathBuf, Role), usize>,
}

/// What the values of an image stand for, which decides how those of PNG and JPEG are decoded.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub(super) enum Role {
    /// Colours in sRGB.
    Color,
    /// Numbers, such as the coordinates of normals.
    Data,
    /// A mask: the image's alpha, or its brightness if it has none, becomes the alpha of a white picture.
    Alpha,
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
    pub fn read(&mut self, files: &Files, name: &str, role: Role) -> Result<usize, Refused> {
        let key = (files.resolve(name).map_err(Refused::File)?, role);
        if let Some(&index) = self.indices.get(&key) {
            return Ok(index);
        }
        let taken = (self.pictures.iter())
            .map(|picture| picture.texels.byte_len() as u64)
            .sum();
        let picture = decode(files, &key.0, name, role, taken)?;
        self.pictures.push(Arc::new(picture));
        self.indices.insert(key, self.pictures.len() - 1);
        Ok(self.pictures.len() - 1)
    }
}

/// Reads the image at `path`; `taken` bytes of texels are already kept.
fn decode(
    files: &Files,
    path: &Path,
    name: &str,
    role: Role,
    taken: u64,
) -> Result<Picture, Refused> {
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
    let image = open(&bytes, &quoted)?;
    let (width, height) = (image.width(), image.height());
    let texels = texels(image, role);
    let bytes = texels.byte_len() as u64;
    if taken + bytes > MAX_KEPT_BYTES {
        let why = format!(
            "takes {bytes} bytes, the others {taken}, but the limit for all is {MAX_KEPT_BYTES}"
        );
        return Err(too_big(why));
    }
    Ok(Picture {
        width,
        height,
        texels,
    })
}

/// The image in `bytes`, which messages call `quoted`.
pub(super) fn open(bytes: &[u8], quoted: &str) -> Result<DynamicImage, Refused> {
    let too_big = |why: String| Refused::Unfit {
        kind: ImportError::TooBig,
        why: format!("{quoted} {why}"),
        todo: "Use a smaller picture".to_owned(),
    };
    let unfit = |why: String, todo: &str| Refused::Unfit {
        kind: ImportError::Malformed,
        why: format!("{quoted} {why}"),
        todo: todo.to_owned(),
    };
    let reader = || {
        let reader = ImageReader::new(Cursor::new(bytes)).with_guessed_format();
        reader.ok().filter(|reader| reader.format().is_some())
    };
    let explain = |error: ImageError| match error {
        ImageError::Limits(_) => too_big("takes too much memory to decode".to_owned()),
        ImageError::Unsupported(_) => {
            let why = "is an image of an unsupported kind";
            unfit(why.to_owned(), "Save it as PNG, JPEG, HDR or EXR")
        }
        error => {
            let why = format!("is damaged: {}", clause(&error.to_string()));
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
    if count > MAX_TEXELS {
        let why = format!("has {width} × {height} texels, but the limit is {MAX_TEXELS} of them");
        return Err(too_big(why));
    }
    if let Some(format) = body.format() {
        complete::check(format, bytes, count)
            .map_err(|why| unfit(why, "Check that it was written completely"))?;
    }
    let mut limits = Limits::no_limits();
    limits.max_alloc = Some(MAX_DECODED_BYTES);
    body.limits(limits);
    body.decode().map_err(explain)
}

/// The texels of `image`, row by row from the top left. Floats are finite and 0 or more.
fn texels(image: DynamicImage, role: Role) -> Texels {
    let channels = usize::from(image.color().channel_count());
    let is_narrow = usize::from(image.color().bytes_per_pixel()) == channels;
    if role == Role::Alpha {
        let white = |alpha| [u8::MAX, u8::MAX, u8::MAX, alpha];
        return Texels::Linear8(match image.color().has_alpha() {
            true => image.into_rgba8().pixels().map(|p| white(p.0[3])).collect(),
            false => image.into_luma8().pixels().map(|p| white(p.0[0])).collect(),
        });
    }
    match image {
        DynamicImage::ImageRgb32F(_) | DynamicImage::ImageRgba32F(_) => {
            let value = |c: f32| if c > 0.0 { c.min(f32::MAX) } else { 0.0 };
            let texel = |p: &image::Rgba<f32>| {
                let [r, g, b, a] = p.0.map(value);
                Vec4::new(r, g, b, a.min(1.0))
            };
            Texels::Float(image.into_rgba32f().pixels().map(texel).collect())
        }
        image if is_narrow => {
            let texel = |p: &[u8]| match *p {
                [r, g, b, a] => [r, g, b, a],
                [r, g, b] => [r, g, b, u8::MAX],
                [grey, alpha] => [grey, grey, grey, alpha],
                _ => [p[0], p[0], p[0], u8::MAX],
            };
            let texels = image.as_bytes().chunks_exact(channels).map(texel);
            match role {
                Role::Color => Texels::Srgb8(texels.collect()),
                Role::Data | Role::Alpha => Texels::Linear8(texels.collect()),
            }
        }
        image => {
            let value = |code: u16| f64::from(code) / f64::from(u16::MAX);
            let curve: Vec<f32> = (0..=u16::MAX)
                .map(|code| match role {
                    Role::Color => linear_from_srgb(value(code)) as f32,
                    Role::Data | Role::Alpha => value(code) as f32,
                })
                .collect();
            let texel = |p: &image::Rgba<u16>| {
                let [r, g, b, a] = p.0;
                let [r, g, b] = [r, g, b].map(|code| curve[usize::from(code)]);
                Vec4::new(r, g, b, value(a) as f32)
            };
            Texels::Float(image.into_rgba16().pixels().map(texel).collect())
        }
    }
}

/// A decoder's message as a clause on one line.
fn clause(message: &str) -> String {
    const LONGEST: usize = 160;
    let start: String = message.chars().take(LONGEST).collect();
    one_line(&start).trim_end_matches('.').to_owned()
}
