//! Textures and pictures in the output of `inspect`.

use crate::inspect::color;
use glimray_scene::{Pattern, Picture, Space, Texels, Texture, Wrap};
use schemars::JsonSchema;
use serde::Serialize;
use std::fmt::{self, Write};

/// A texture.
#[derive(Serialize, JsonSchema)]
pub struct TextureEntry {
    #[serde(flatten)]
    pattern: PatternEntry,
    /// `world`, `uv` or `second uv`.
    space: &'static str,
}

/// Colours are linear radiance.
#[derive(Serialize, JsonSchema)]
#[serde(tag = "pattern", rename_all = "lowercase")]
enum PatternEntry {
    Checker {
        a: [f32; 3],
        b: [f32; 3],
    },
    Stripes {
        a: [f32; 3],
        b: [f32; 3],
    },
    Gradient {
        a: [f32; 3],
        b: [f32; 3],
    },
    Noise {
        a: [f32; 3],
        b: [f32; 3],
        octaves: u32,
    },
    Picture {
        /// Index in `picture_list`.
        picture: usize,
        nearest: bool,
        minify: &'static str,
        /// Along u and v.
        wrap: [&'static str; 2],
    },
}

/// A picture.
#[derive(Serialize, JsonSchema)]
pub struct PictureEntry {
    /// Width and height in texels.
    size: [u32; 2],
    /// How texels are kept: `srgb8`, `linear8` or `float`.
    texels: &'static str,
}

impl From<&Texture> for TextureEntry {
    fn from(texture: &Texture) -> Self {
        let [a, b] = match texture.pattern {
            Pattern::Checker { a, b }
            | Pattern::Stripes { a, b }
            | Pattern::Gradient { a, b }
            | Pattern::Noise { a, b, .. } => [a.into(), b.into()],
            Pattern::Picture { .. } => [[0.0; 3]; 2],
        };
        let pattern = match texture.pattern {
            Pattern::Checker { .. } => PatternEntry::Checker { a, b },
            Pattern::Stripes { .. } => PatternEntry::Stripes { a, b },
            Pattern::Gradient { .. } => PatternEntry::Gradient { a, b },
            Pattern::Noise { octaves, .. } => PatternEntry::Noise { a, b, octaves },
            Pattern::Picture {
                picture,
                nearest,
                minify,
                wrap,
            } => PatternEntry::Picture {
                picture,
                nearest,
                minify: minify.name(),
                wrap: wrap.map(Wrap::name),
            },
        };
        Self {
            pattern,
            space: space(texture),
        }
    }
}

impl From<&Picture> for PictureEntry {
    fn from(picture: &Picture) -> Self {
        Self {
            size: [picture.width, picture.height],
            texels: kind(&picture.texels),
        }
    }
}

pub fn texture_text(out: &mut String, texture: &Texture) -> fmt::Result {
    write!(out, "{} over {}", pattern(texture), space(texture))?;
    match texture.pattern {
        Pattern::Checker { a, b }
        | Pattern::Stripes { a, b }
        | Pattern::Gradient { a, b }
        | Pattern::Noise { a, b, .. } => write!(out, ", {} and {}", color(a), color(b)),
        Pattern::Picture { picture, .. } => write!(out, ", picture {picture}"),
    }
}

pub fn picture_text(out: &mut String, picture: &Picture) -> fmt::Result {
    let (width, height) = (picture.width, picture.height);
    write!(out, "{width}×{height} texels, {}", kind(&picture.texels))
}

/// How texels are kept.
fn kind(texels: &Texels) -> &'static str {
    match texels {
        Texels::Srgb8(_) => "srgb8",
        Texels::Linear8(_) => "linear8",
        Texels::Float(_) => "float",
    }
}

fn pattern(texture: &Texture) -> &'static str {
    match texture.pattern {
        Pattern::Checker { .. } => "checker",
        Pattern::Stripes { .. } => "stripes",
        Pattern::Gradient { .. } => "gradient",
        Pattern::Noise { .. } => "noise",
        Pattern::Picture { .. } => "picture",
    }
}

fn space(texture: &Texture) -> &'static str {
    match texture.space {
        Space::World => "world",
        Space::Uv => "uv",
        Space::SecondUv => "second uv",
    }
}
