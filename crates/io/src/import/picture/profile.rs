//! Colour spaces and orientations that PNG, JPEG and WebP files name, which are not followed: colours are taken for
//! sRGB.

use super::complete;
use super::opened::Ignored;
use image::metadata::Orientation;
use image::{ImageDecoder, ImageFormat};

/// Properties of the file in `bytes` that its picture does not follow, unless they are assumed anyway.
pub(super) fn ignored(
    bytes: &[u8],
    format: ImageFormat,
    decoder: &mut impl ImageDecoder,
) -> Vec<Ignored> {
    let mut ignored = Vec::new();
    let mut add = |clause: &str, is_of_colors| {
        ignored.push(Ignored {
            clause: clause.to_owned(),
            is_of_colors,
        });
    };
    let turned = decoder.orientation().unwrap_or(Orientation::NoTransforms);
    if turned != Orientation::NoTransforms {
        add(
            "is turned or mirrored by its Exif data, which is not applied",
            false,
        );
    }
    let profile = decoder.icc_profile().ok().flatten();
    let is_png = format == ImageFormat::Png;
    let coded = is_png
        .then(|| complete::png_chunk(bytes, b"cICP"))
        .flatten();
    match (coded, profile) {
        // ITU-T H.273: Rec. 709, sRGB, RGB in full range.
        (Some([1, 13, 0, 1]), _) => {}
        (Some(_), _) => add(
            "names a colour space by code points, which is not applied: sRGB is assumed",
            true,
        ),
        (None, Some(profile)) if is_srgb(&profile) => {}
        (None, Some(_)) => add(
            "has a colour profile, which is not applied: sRGB is assumed",
            true,
        ),
        (None, None) if is_png && complete::png_chunk(bytes, b"sRGB").is_none() => {
            if complete::png_chunk(bytes, b"gAMA").is_some_and(|gamma| !is_gamma_of_srgb(gamma)) {
                add(
                    "has a gamma of its own, which is not applied: sRGB is assumed",
                    true,
                );
            }
            if complete::png_chunk(bytes, b"cHRM").is_some_and(|points| !are_of_srgb(points)) {
                add(
                    "has primaries of its own, which are not applied: sRGB is assumed",
                    true,
                );
            }
        }
        (None, None) => {}
    }
    ignored
}

/// Whether a profile calls itself sRGB, in ASCII or UTF-16.
fn is_srgb(profile: &[u8]) -> bool {
    let has = |name: &[u8]| profile.windows(name.len()).any(|part| part == name);
    has(b"sRGB") || has(b"\0s\0R\0G\0B")
}

/// The numbers of a chunk, in hundred thousandths.
fn numbers(chunk: &[u8]) -> impl Iterator<Item = u32> {
    chunk
        .as_chunks()
        .0
        .iter()
        .map(|bytes| u32::from_be_bytes(*bytes))
}

fn is_gamma_of_srgb(chunk: &[u8]) -> bool {
    numbers(chunk).all(|gamma| gamma.abs_diff(45_455) < 1000)
}

/// White, red, green and blue.
fn are_of_srgb(chunk: &[u8]) -> bool {
    let own = [
        31_270, 32_900, 64_000, 33_000, 30_000, 60_000, 15_000, 6_000,
    ];
    numbers(chunk).zip(own).all(|(a, b)| a.abs_diff(b) < 1000)
}
