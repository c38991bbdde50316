//! Images that scenes refer to: PNG, JPEG, WebP, Radiance HDR and OpenEXR, recognised by their first bytes.
//!
//! PNG, JPEG and WebP are sRGB and keep their 8 bits, or become floats if they have 16; HDR and EXR are linear Rec.
//! 709. A truncated file is refused even if its decoder would accept it.

mod complete;
mod height;
#[cfg(feature = "basis")]
mod ktx2;
mod luminance;
mod repair;
mod store;

pub(super) use repair::Repairs;
pub(super) use store::{Pictures, Place, Read};

use super::error::{Fault, ImportError};
use super::paths::{Files, Refusal};
pub(super) use crate::scene::linear_from_srgb;
use crate::scene::{Origin, Picture, Texels};
use crate::text::one_line;
use glam::Vec4;
use image::{DynamicImage, ImageError, ImageFormat, ImageReader, Limits};
use std::borrow::Cow;
use std::io::Cursor;
use std::path::Path;
use std::sync::Arc;

/// Size limit of an image file in bytes.
pub(super) const MAX_BYTES: u64 = 512 << 20;

/// Limit of the number of texels of an image: 8192×8192.
const MAX_TEXELS: u64 = 1 << 26;

/// The kinds of images.
const KINDS: &str = if cfg!(feature = "basis") {
    "PNG, JPEG, WebP, KTX2, HDR or EXR"
} else {
    "PNG, JPEG, WebP, HDR or EXR"
};

/// Memory limit for decoding: four floats per texel.
const MAX_DECODED_BYTES: u64 = MAX_TEXELS * 16;

/// What the values of an image stand for, which decides how those of PNG, JPEG and WebP are decoded.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub(super) enum Role {
    /// Colours in sRGB.
    Color,
    /// The same around the whole scene: twice as wide as high. Floats may be above [`crate::scene::LARGEST_TEXEL`].
    Environment,
    /// Numbers, such as the coordinates of normals.
    Data,
    /// The height of a surface, white above black by the width of a texel: becomes the normal map of that surface.
    /// An image with colours is taken for a normal map: many files name one so.
    Height,
    /// The same, white below black.
    Depth,
    /// A mask: the image's alpha, or its brightness if it has none, becomes the alpha of a white picture.
    Alpha,
}

/// Why an image could not be read.
#[derive(Clone)]
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
    fn too_big(why: String) -> Self {
        Self::Unfit {
            kind: ImportError::TooBig,
            why,
            todo: "Use a smaller picture".to_owned(),
        }
    }

    /// There is no file to read; `why` names it.
    pub fn unreadable(why: String) -> Self {
        Self::Unfit {
            kind: ImportError::Unreadable,
            why,
            todo: "Check the name and the folder".to_owned(),
        }
    }

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

/// The bytes of the image file at `path`, which messages call `name`.
///
/// # Errors
/// It cannot be read, or is too large.
pub(super) fn file(files: &Files, path: &Path, name: &str) -> Result<Vec<u8>, Refused> {
    files.read(path, MAX_BYTES).map_err(|error| {
        let is_too_big = error.is_too_big();
        let fault = error.into_fault();
        match is_too_big {
            true => Refused::too_big(format!("{name} has {}", fault.why)),
            false => Refused::Unfit {
                kind: ImportError::Unreadable,
                why: format!("{name}: {}", fault.why),
                todo: fault.todo,
            },
        }
    })
}

/// What reads pictures out of files.
pub(super) fn reader(
    files: &Files,
) -> impl Fn(&Place, &str) -> Result<Cow<'static, [u8]>, Refused> {
    |place, name| match place {
        Place::File(path) => file(files, path, name).map(Cow::Owned),
        Place::Part(_) => Err(Refused::unreadable(format!("{name} is in no file"))),
    }
}

/// The pictures of the image in `bytes` for each role, and what was repaired; messages call it `name`.
fn decode(bytes: &[u8], name: &str, roles: &[Role]) -> Result<Vec<(Picture, Repairs)>, Refused> {
    let image = open(bytes, name)?;
    let (width, height) = (image.width(), image.height());
    if roles.contains(&Role::Environment) && u64::from(width) != 2 * u64::from(height) {
        let why = format!(
            "has {width} × {height} texels, but an environment must be twice as wide as high"
        );
        return Err(Unfit { name }.as_it_is(&why, "Name an equirectangular panorama"));
    }
    let plain = |texels| Picture {
        width,
        height,
        texels,
        origin: Origin::Texels,
    };
    let picture = |image, role| {
        let (texels, repairs) = texels(image, role);
        let amount = match role {
            Role::Height => 1.0,
            Role::Depth => -1.0,
            Role::Color | Role::Environment | Role::Data | Role::Alpha => {
                return (plain(texels), repairs);
            }
        };
        let picture = match height::normals(&texels, [width, height], amount) {
            None => plain(texels),
            Some(normals) => Picture {
                origin: Origin::Heights {
                    heights: Arc::new(plain(texels)),
                    are_depths: role == Role::Depth,
                },
                ..plain(normals)
            },
        };
        (picture, repairs)
    };
    let Some((last, others)) = roles.split_last() else {
        return Ok(Vec::new());
    };
    let mut pictures: Vec<_> = (others.iter())
        .map(|&role| picture(image.clone(), role))
        .collect();
    pictures.push(picture(image, *last));
    Ok(pictures)
}

/// The picture of the environment in `bytes`, which messages call `name`, and what was repaired.
///
/// # Errors
/// It is empty, damaged, too large, of an unsupported kind, or not twice as wide as high.
#[cfg(not(target_arch = "wasm32"))]
pub(super) fn environment(bytes: &[u8], name: &str) -> Result<(Picture, Repairs), Refused> {
    let mut pictures = decode(bytes, name, &[Role::Environment])?;
    let gone = || Refused::unreadable(format!("{name} was not decoded"));
    pictures.pop().ok_or_else(gone)
}

/// The number of texels that the header of an image announces, times four if it has floats; 0 if it is invalid.
fn dimensions(bytes: &[u8]) -> u64 {
    let texels = |(width, height)| u64::from(width) * u64::from(height);
    #[cfg(feature = "basis")]
    if bytes.starts_with(ktx2::MAGIC) {
        return ktx2::dimensions(bytes).map_or(0, texels).min(MAX_TEXELS);
    }
    let reader = ImageReader::new(Cursor::new(bytes)).with_guessed_format();
    let Ok(reader) = reader else { return 0 };
    let has_floats = matches!(
        reader.format(),
        Some(ImageFormat::Hdr | ImageFormat::OpenExr)
    );
    let count = reader.into_dimensions().map_or(0, texels);
    count.min(MAX_TEXELS) * if has_floats { 4 } else { 1 }
}

/// What is wrong with the image in a file.
struct Unfit<'n> {
    /// What messages call it.
    name: &'n str,
}

impl Unfit<'_> {
    fn as_it_is(&self, why: &str, todo: &str) -> Refused {
        Refused::Unfit {
            kind: ImportError::Malformed,
            why: format!("{} {why}", self.name),
            todo: todo.to_owned(),
        }
    }

    fn too_big(&self, why: &str) -> Refused {
        Refused::too_big(format!("{} {why}", self.name))
    }

    fn damaged(&self, why: &str) -> Refused {
        self.as_it_is(why, "Check that it was written completely")
    }

    fn unsupported(&self, why: &str) -> Refused {
        self.as_it_is(why, &format!("Save it as {KINDS}"))
    }

    /// The number of texels of a picture of this size.
    fn count(&self, width: u32, height: u32) -> Result<u64, Refused> {
        match u64::from(width) * u64::from(height) {
            0 => Err(self.as_it_is("has no texels", "Save it again")),
            count if count > MAX_TEXELS => Err(self.too_big(&format!(
                "has {width} × {height} texels, but the limit is {MAX_TEXELS} of them"
            ))),
            count => Ok(count),
        }
    }
}

/// The image in `bytes`, which messages call `name`.
fn open(bytes: &[u8], name: &str) -> Result<DynamicImage, Refused> {
    let unfit = Unfit { name };
    if bytes.is_empty() {
        return Err(unfit.damaged("is empty"));
    }
    #[cfg(feature = "basis")]
    if bytes.starts_with(ktx2::MAGIC) {
        let refuse = |fault| match fault {
            ktx2::Fault::Damaged(why) => unfit.damaged(&why),
            ktx2::Fault::Unsupported(why) => unfit.unsupported(&why),
        };
        let (width, height) = ktx2::dimensions(bytes).map_err(refuse)?;
        unfit.count(width, height)?;
        return ktx2::decode(bytes, (width, height)).map_err(refuse);
    }
    if let Some(grey) = luminance::open(bytes, &unfit) {
        return grey;
    }
    let reader = || {
        let reader = ImageReader::new(Cursor::new(bytes)).with_guessed_format();
        reader.ok().filter(|reader| reader.format().is_some())
    };
    let explain = |error: ImageError| match error {
        ImageError::Limits(_) => unfit.too_big("takes too much memory to decode"),
        ImageError::Unsupported(_) => unfit.unsupported("is an image of an unsupported kind"),
        error => unfit.damaged(&format!("is damaged: {}", clause(&error.to_string()))),
    };
    let (Some(head), Some(mut body)) = (reader(), reader()) else {
        let todo = format!("Name a {KINDS} file");
        return Err(unfit.as_it_is("is not a supported image", &todo));
    };
    // Check the header first: it may claim any size.
    let (width, height) = head.into_dimensions().map_err(explain)?;
    let count = unfit.count(width, height)?;
    if let Some(format) = body.format() {
        complete::check(format, bytes, count).map_err(|why| unfit.damaged(&why))?;
    }
    let mut limits = Limits::no_limits();
    limits.max_alloc = Some(MAX_DECODED_BYTES);
    body.limits(limits);
    body.decode().map_err(explain)
}

/// The texels of `image`, row by row from the top left, and what was repaired. Floats are finite and 0 or more.
fn texels(image: DynamicImage, role: Role) -> (Texels, Repairs) {
    let channels = usize::from(image.color().channel_count());
    let is_narrow = usize::from(image.color().bytes_per_pixel()) == channels;
    if role == Role::Alpha {
        let white = |alpha| [u8::MAX, u8::MAX, u8::MAX, alpha];
        let texels = match image.color().has_alpha() {
            true => image.into_rgba8().pixels().map(|p| white(p.0[3])).collect(),
            false => image.into_luma8().pixels().map(|p| white(p.0[0])).collect(),
        };
        return (Texels::Linear8(texels), Repairs::default());
    }
    let texels = match image {
        DynamicImage::ImageRgb32F(_) | DynamicImage::ImageRgba32F(_) => {
            let width = image.width();
            let pixels = image.into_rgba32f();
            let mut texels: Vec<Vec4> = pixels.pixels().map(|p| Vec4::from(p.0)).collect();
            let repairs = repair::repair(&mut texels, width, role);
            return (Texels::Float(texels), repairs);
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
                Role::Color | Role::Environment => Texels::Srgb8(texels.collect()),
                Role::Data | Role::Alpha | Role::Height | Role::Depth => {
                    Texels::Linear8(texels.collect())
                }
            }
        }
        image => {
            let value = |code: u16| f64::from(code) / f64::from(u16::MAX);
            let curve: Vec<f32> = (0..=u16::MAX)
                .map(|code| match role {
                    Role::Color | Role::Environment => linear_from_srgb(value(code)) as f32,
                    _ => value(code) as f32,
                })
                .collect();
            let texel = |p: &image::Rgba<u16>| {
                let [r, g, b, a] = p.0;
                let [r, g, b] = [r, g, b].map(|code| curve[usize::from(code)]);
                Vec4::new(r, g, b, value(a) as f32)
            };
            Texels::Float(image.into_rgba16().pixels().map(texel).collect())
        }
    };
    (texels, Repairs::default())
}

/// A decoder's message as a clause on one line.
fn clause(message: &str) -> String {
    const LONGEST: usize = 160;
    let start: String = message.chars().take(LONGEST).collect();
    one_line(&start).trim_end_matches('.').to_owned()
}
