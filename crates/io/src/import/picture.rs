//! Images that scenes refer to: PNG, JPEG, WebP, Radiance HDR and OpenEXR, recognised by their first bytes.
//!
//! `opening.rs` says what the numbers of each format mean. A truncated file is refused even if its decoder would accept it.

mod complete;
mod height;
#[cfg(feature = "basis")]
mod ktx2;
mod opened;
mod openexr;
mod opening;
mod pixels;
mod primaries;
mod profile;
mod radiance;
mod repair;
mod store;
mod texels;

pub use pixels::{Pixels, pixels};
#[cfg(not(target_arch = "wasm32"))]
pub use store::smaller_pictures;
pub(super) use store::{Pictures, Place, Read};

use super::error::{Fault, ImportError};
use super::paths::{Files, Refusal};
use glam::Vec4;
pub(super) use glimray_scene::linear_from_srgb;
use glimray_scene::text::one_line;
use glimray_scene::{Origin, Picture};
use opened::Unfit;
use std::borrow::Cow;
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

/// Meaning of the values of a texture's picture, which decides how a file is read.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Meaning {
    /// Colours, of PNG, JPEG and WebP in sRGB.
    Color,
    /// Numbers, such as roughness.
    Numbers,
    /// Normals of small bumps. A grey image gives their heights, white above black by the width of a texel.
    Normals,
    /// How much of the surface is there: the image's alpha, or its brightness if it has none.
    Coverage,
}

impl From<Meaning> for Role {
    fn from(meaning: Meaning) -> Self {
        match meaning {
            Meaning::Color => Self::Color,
            Meaning::Numbers => Self::Data,
            Meaning::Normals => Self::Height,
            Meaning::Coverage => Self::Alpha,
        }
    }
}

/// Meaning of an image's values, which decides how those of PNG, JPEG and WebP are decoded.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub(super) enum Role {
    /// Colours in sRGB.
    Color,
    /// As [`Role::Color`], around the whole scene: twice as wide as high. Floats may be above [`glimray_scene::LARGEST_TEXEL`].
    Environment,
    /// Numbers, such as the coordinates of normals.
    Data,
    /// The height of a surface, white above black by the width of a texel: becomes the normal map of that surface.
    /// An image with colours is taken for a normal map: many files name one so.
    Height,
    /// As [`Role::Height`], but white below black.
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

    /// As a clause for [`glimray_scene::Scene::skipped`].
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
/// The file cannot be read, or is too large.
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

/// A function that reads pictures out of files.
pub(super) fn reader(
    files: &Files,
) -> impl Fn(&Place, &str) -> Result<Cow<'static, [u8]>, Refused> {
    |place, name| match place {
        Place::File(path) => file(files, path, name).map(Cow::Owned),
        Place::Part(_) => Err(Refused::unreadable(format!("{name} is in no file"))),
    }
}

/// A picture in a role, and notes on its file.
type Noted = (Picture, Vec<String>);

/// The pictures of the image in `bytes` for each role; messages call it `name`.
/// Notes on colour spaces are left out unless `has_profiles`.
fn decode(
    bytes: &[u8],
    name: &str,
    roles: &[Role],
    has_profiles: bool,
) -> Result<Vec<Noted>, Refused> {
    let unfit = Unfit {
        name,
        most_texels: MAX_TEXELS,
    };
    let mut opened = opening::open(bytes, opening::head(bytes, &unfit)?, &unfit)?;
    let (width, height) = (opened.width, opened.height);
    if roles.contains(&Role::Environment) && u64::from(width) != 2 * u64::from(height) {
        let why = format!(
            "has {width} × {height} texels, but an environment must be twice as wide as high"
        );
        return Err(unfit.as_it_is(&why, "Name an equirectangular panorama"));
    }
    let plain = |texels| Picture {
        width,
        height,
        texels,
        origin: Origin::Texels,
    };
    let mut picture = |role, is_last| {
        let (texels, repairs) = texels::of(&mut opened, role, is_last);
        let has_colors = has_profiles && matches!(role, Role::Color | Role::Environment);
        let told = (opened.ignored.iter()).filter(|it| has_colors || !it.is_of_colors);
        let told = told.map(|it| format!("{name} {}", it.clause));
        let notes = told.chain(repairs.lines(name)).collect();
        let amount = match role {
            Role::Height => 1.0,
            Role::Depth => -1.0,
            Role::Color | Role::Environment | Role::Data | Role::Alpha => {
                return (plain(texels), notes);
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
        (picture, notes)
    };
    let last = roles.len().saturating_sub(1);
    let roles = roles.iter().enumerate();
    Ok(roles
        .map(|(index, &role)| picture(role, index == last))
        .collect())
}

/// The picture of the environment in `bytes`, which messages call `name`, and notes on it.
///
/// # Errors
/// The picture is empty, damaged, too large, of an unsupported kind, or not twice as wide as high.
#[cfg(not(target_arch = "wasm32"))]
pub(super) fn environment(bytes: &[u8], name: &str) -> Result<Noted, Refused> {
    let mut pictures = decode(bytes, name, &[Role::Environment], true)?;
    let gone = || Refused::unreadable(format!("{name} was not decoded"));
    pictures.pop().ok_or_else(gone)
}

/// Size and kind of values that the header of an image announces; nothing if it is invalid.
#[derive(Clone, Copy, Debug, Default)]
struct Announced {
    width: u32,
    height: u32,
    has_floats: bool,
}

impl Announced {
    fn of(bytes: &[u8]) -> Self {
        let unfit = Unfit {
            name: "",
            most_texels: MAX_TEXELS,
        };
        opening::head(bytes, &unfit).map_or_else(
            |_| Self::default(),
            |head| Self {
                width: head.width,
                height: head.height,
                has_floats: head.has_floats,
            },
        )
    }

    /// Bytes of the texels of its picture in a role, halved so many times.
    fn bytes(self, role: Role, halvings: u32) -> u64 {
        let side = |side: u32| u64::from((side >> halvings).max(side.min(1)));
        let is_relief = matches!(role, Role::Height | Role::Depth);
        let texel_bytes = match self.has_floats || is_relief {
            true => size_of::<Vec4>(),
            false => size_of::<[u8; 4]>(),
        };
        side(self.width) * side(self.height) * texel_bytes as u64
    }
}

/// A decoder's message as a clause on one line.
fn clause(message: &str) -> String {
    const LONGEST: usize = 160;
    let start: String = message.chars().take(LONGEST).collect();
    one_line(&start).trim_end_matches('.').to_owned()
}
