//! Textures and pictures in the output of `inspect`.

use crate::cli::inspect::{color, color_json};
use crate::scene::{Pattern, Picture, Space, Texels, Texture, Wrap};
use serde_json::{Value, json};
use std::fmt::{self, Write};

pub fn texture_json(texture: &Texture) -> Value {
    let pair = |a, b| json!({ "a": color_json(a), "b": color_json(b) });
    let mut value = match texture.pattern {
        Pattern::Checker { a, b } | Pattern::Stripes { a, b } | Pattern::Gradient { a, b } => {
            pair(a, b)
        }
        Pattern::Noise { a, b, octaves } => {
            let mut noise = pair(a, b);
            noise["octaves"] = json!(octaves);
            noise
        }
        Pattern::Picture {
            picture,
            nearest,
            minify,
            wrap,
        } => json!({
            "picture": picture,
            "nearest": nearest,
            "minify": minify.name(),
            "wrap": wrap.map(Wrap::name),
        }),
    };
    value["pattern"] = json!(pattern(texture));
    value["space"] = json!(space(texture));
    value
}

pub fn picture_json(picture: &Picture) -> Value {
    json!({ "size": [picture.width, picture.height], "texels": kind(&picture.texels) })
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
