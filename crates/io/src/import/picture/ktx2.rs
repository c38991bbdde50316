//! KTX2 containers (Khronos Texture 2.0): the first level of a flat picture with a Basis Universal payload (ETC1S, or
//! UASTC in 4 × 4 blocks) or without compression (8 bits per channel).
//!
//! The container is read here, so that no size in it is believed; the blocks are decoded by the crate `basisu`, of
//! which only the decoders to RGBA are used: the others would bring megabytes of tables.

use super::opened::{Ignored, Unfit};
use super::{Refused, complete};
use basisu::basislz::etc1s::Etc1sTranscoder;
use basisu::uastc::unpack::unpack_uastc;
use glimray_scene::bytes::sizes;
use image::{DynamicImage, RgbImage, RgbaImage};
use std::borrow::Cow;
use std::io::Read;

/// The first bytes of each file.
pub(super) const MAGIC: &[u8] = b"\xabKTX 20\xbb\r\n\x1a\n";

/// Why a picture is refused, as a clause.
pub(super) enum Fault {
    Damaged(String),
    Unsupported(String),
}

impl Fault {
    /// As a refusal of the picture that is `unfit`.
    pub fn of(self, unfit: &Unfit) -> Refused {
        match self {
            Self::Damaged(why) => unfit.damaged(&why),
            Self::Unsupported(why) => unfit.unsupported(&why),
        }
    }
}

/// A part of a file that has to be there.
fn part(bytes: &[u8], offset: u64, length: u64) -> Result<&[u8], Fault> {
    let end = offset.checked_add(length);
    end.and_then(|end| bytes.get(usize::try_from(offset).ok()?..usize::try_from(end).ok()?))
        .ok_or_else(|| Fault::Damaged(complete::CUT.to_owned()))
}

fn u16_at(bytes: &[u8], at: u64) -> Result<u32, Fault> {
    let bytes = part(bytes, at, 2)?;
    Ok(u32::from(u16::from_le_bytes([bytes[0], bytes[1]])))
}

fn u32_at(bytes: &[u8], at: u64) -> Result<u32, Fault> {
    let bytes = part(bytes, at, 4)?;
    Ok(u32::from_le_bytes([bytes[0], bytes[1], bytes[2], bytes[3]]))
}

fn u64_at(bytes: &[u8], at: u64) -> Result<u64, Fault> {
    Ok(u64::from(u32_at(bytes, at)?) | u64::from(u32_at(bytes, at + 4)?) << 32)
}

fn damaged(why: &str) -> Fault {
    Fault::Damaged(format!("is damaged: {why}"))
}

/// Width and height of the picture in `bytes`.
pub(super) fn dimensions(bytes: &[u8]) -> Result<(u32, u32), Fault> {
    Ok((u32_at(bytes, 20)?, u32_at(bytes, 24)?))
}

/// Properties of the file in `bytes` that its picture does not follow.
pub(super) fn ignored(bytes: &[u8]) -> Vec<Ignored> {
    let section = |at| {
        let (offset, length) = (u32_at(bytes, at)?, u32_at(bytes, at + 4)?);
        part(bytes, offset.into(), length.into())
    };
    let mut ignored = Vec::new();
    let mut add = |clause: &str, is_of_colors| {
        ignored.push(Ignored {
            clause: clause.to_owned(),
            is_of_colors,
        });
    };
    let words = section(48).and_then(|descriptor| u32_at(descriptor, 12));
    let [_, primaries, _, flags] = words.unwrap_or_default().to_le_bytes();
    // Unspecified, or those of Rec. 709.
    if primaries > 1 {
        add(
            "has primaries of its own, which are not applied: sRGB is assumed",
            true,
        );
    }
    if flags & 1 != 0 {
        add(
            "has colours multiplied by alpha, which are taken as they are",
            false,
        );
    }
    let keys = section(56).unwrap_or_default();
    let key = b"KTXorientation\0";
    let value = keys.windows(key.len()).position(|part| part == key);
    let value = value.map(|at| &keys[at + key.len()..]);
    if value.is_some_and(|value| !value.starts_with(b"rd")) {
        add(
            "is turned or mirrored by its orientation, which is not applied",
            false,
        );
    }
    ignored
}

/// The picture in `bytes`, of this many texels, which are few enough to be held in memory.
pub(super) fn decode(bytes: &[u8], (width, height): (u32, u32)) -> Result<DynamicImage, Fault> {
    let format = u32_at(bytes, 12)?;
    let [depth, layers, faces] = [28, 32, 36].map(|at| u32_at(bytes, at));
    if depth? > 1 || layers? > 1 || faces? != 1 {
        let why = "is not a flat picture: it has depth, layers or faces of a cube";
        return Err(Fault::Unsupported(why.to_owned()));
    }
    let scheme = u32_at(bytes, 44)?;
    let descriptor = u64::from(u32_at(bytes, 48)?);
    let descriptor = part(bytes, descriptor, u64::from(u32_at(bytes, 52)?))?;
    let words = u32_at(descriptor, 12)?;
    let (model, is_srgb) = (words & 0xff, words >> 16 & 0xff == 2);
    // The level index begins with the largest level.
    let (offset, length) = (u64_at(bytes, 80)?, u64_at(bytes, 88)?);
    let level = part(bytes, offset, length)?;
    let blocks = [width, height].map(|side| u64::from(side.div_ceil(4)));
    let texel_count = u64::from(width) * u64::from(height);
    let texels = match (format, model) {
        (0, 163) => {
            let globals = part(bytes, u64_at(bytes, 64)?, u64_at(bytes, 72)?)?;
            let second = match descriptor.len() {
                60.. => Some(u32_at(descriptor, 44)? >> 24 & 15),
                _ => None,
            };
            etc1s(globals, level, (width, height), u32_at(bytes, 40)?, second)?
        }
        (0, 166) => {
            let level = inflated(level, scheme, blocks[0] * blocks[1] * 16)?;
            let channels = u32_at(descriptor, 28)? >> 24 & 15;
            uastc(&level, (width, height), is_srgb, channels)?
        }
        // R8, R8G8B8 and R8G8B8A8, each as UNORM and as sRGB.
        (9 | 15, _) => {
            let grey = inflated(level, scheme, texel_count)?;
            let texel = |&grey| [grey, grey, grey, u8::MAX];
            Texels::new(grey.iter().map(texel).collect(), false)
        }
        (23 | 29, _) => {
            let level = inflated(level, scheme, 3 * texel_count)?;
            let texel = |&[r, g, b]: &[u8; 3]| [r, g, b, u8::MAX];
            Texels::new(level.as_chunks().0.iter().map(texel).collect(), false)
        }
        (37 | 43, _) => {
            let level = inflated(level, scheme, 4 * texel_count)?;
            Texels::new(level.as_chunks().0.to_vec(), true)
        }
        _ => {
            let why = format!(
                "has the format {format} with colour model {model}; of KTX2, ETC1S, UASTC, R8, RGB8 and RGBA8 are read"
            );
            return Err(Fault::Unsupported(why));
        }
    };
    let image = texels.into_image(width, height);
    image.ok_or_else(|| damaged("it has too few texels"))
}

/// The texels of a picture.
struct Texels {
    rgba: Vec<[u8; 4]>,
    has_alpha: bool,
}

impl Texels {
    fn new(rgba: Vec<[u8; 4]>, has_alpha: bool) -> Self {
        Self { rgba, has_alpha }
    }

    fn into_image(self, width: u32, height: u32) -> Option<DynamicImage> {
        if self.has_alpha {
            let texels = self.rgba.into_flattened();
            return RgbaImage::from_raw(width, height, texels).map(Into::into);
        }
        let texels = self.rgba.iter().flat_map(|&[r, g, b, _]| [r, g, b]);
        RgbImage::from_raw(width, height, texels.collect()).map(Into::into)
    }
}

/// The `length` bytes of a level without its supercompression: none, Zstandard or zlib.
fn inflated(level: &[u8], scheme: u32, length: u64) -> Result<Cow<'_, [u8]>, Fault> {
    let bytes = match scheme {
        0 => Cow::Borrowed(level),
        2 => {
            let source = ruzstd::decoding::StreamingDecoder::new(level)
                .map_err(|_| damaged("its Zstandard stream is invalid"))?;
            let mut bytes = Vec::new();
            // The buffer grows with the data that is there.
            (source.take(length + 1).read_to_end(&mut bytes))
                .map_err(|_| damaged("its Zstandard stream is invalid"))?;
            Cow::Owned(bytes)
        }
        3 => {
            let limit = usize::try_from(length).unwrap_or(usize::MAX);
            let bytes = miniz_oxide::inflate::decompress_to_vec_zlib_with_limit(level, limit);
            Cow::Owned(bytes.map_err(|_| damaged("its zlib stream is invalid"))?)
        }
        _ => {
            let why = format!("has the supercompression {scheme}, which is not supported");
            return Err(Fault::Unsupported(why));
        }
    };
    match bytes.len() as u64 == length {
        true => Ok(bytes),
        false => {
            let [found, length] = sizes([bytes.len() as u64, length]);
            Err(damaged(&format!(
                "its first level has {found} instead of {length}"
            )))
        }
    }
}

/// Decodes BasisLZ. `second` is the channel of the second slice, if there is one.
fn etc1s(
    globals: &[u8],
    level: &[u8],
    (width, height): (u32, u32),
    level_count: u32,
    second: Option<u32>,
) -> Result<Texels, Fault> {
    let (endpoints, selectors) = (u16_at(globals, 0)?, u16_at(globals, 2)?);
    let endpoint_bytes = u64::from(u32_at(globals, 4)?);
    let selector_bytes = u64::from(u32_at(globals, 8)?);
    let table_bytes = u64::from(u32_at(globals, 12)?);
    let slice = |at: u64| -> Result<&[u8], Fault> {
        let (offset, length) = (u32_at(globals, at)?, u32_at(globals, at + 4)?);
        part(level, offset.into(), length.into())
    };
    let (first_slice, second_slice) = (slice(24)?, second.map(|_| slice(32)).transpose()?);
    // The codebooks follow the descriptions of all images, of which there is one for each level.
    let start = 20 + 20 * u64::from(level_count.max(1));
    let mut codes = Etc1sTranscoder::new();
    let is_valid = endpoints > 0
        && selectors > 0
        && codes.decode_palettes(
            endpoints,
            part(globals, start, endpoint_bytes)?,
            selectors,
            part(globals, start + endpoint_bytes, selector_bytes)?,
        )
        && codes.decode_tables(part(
            globals,
            start + endpoint_bytes + selector_bytes,
            table_bytes,
        )?);
    if !is_valid {
        return Err(damaged("its codebooks are invalid"));
    }
    let mut texels = vec![[0; 4]; width as usize * height as usize];
    let (across, down) = (width.div_ceil(4), height.div_ceil(4));
    let decoded = match second_slice {
        Some(second) => codes.transcode_image_rgba32(
            first_slice,
            second,
            across,
            down,
            width,
            height,
            None,
            texels.as_flattened_mut(),
        ),
        None => codes.transcode_slice_rgba32(
            first_slice,
            across,
            down,
            width,
            height,
            None,
            texels.as_flattened_mut(),
        ),
    };
    decoded.ok_or_else(|| damaged("its blocks are invalid"))?;
    let mut texels = Texels::new(texels, second.is_some());
    // The channel GGG.
    if second == Some(4) {
        texels.spread_green();
    }
    Ok(texels)
}

/// Decodes UASTC. `channels` says what the channels stand for.
fn uastc(
    level: &[u8],
    (width, height): (u32, u32),
    is_srgb: bool,
    channels: u32,
) -> Result<Texels, Fault> {
    let mut rgba = vec![[0; 4]; width as usize * height as usize];
    let across = width.div_ceil(4) as usize;
    let (width, height) = (width as usize, height as usize);
    for (i, block) in level.as_chunks::<16>().0.iter().enumerate() {
        let colors = unpack_uastc(block, is_srgb).ok_or_else(|| damaged("a block is invalid"))?;
        let (x, y) = (i % across * 4, i / across * 4);
        for (row, colors) in colors.as_chunks::<4>().0.iter().enumerate() {
            if y + row < height {
                let first = (y + row) * width + x;
                for (texel, color) in rgba[first..][..(width - x).min(4)].iter_mut().zip(colors) {
                    *texel = color.c;
                }
            }
        }
    }
    // RGBA and RRRG.
    let mut texels = Texels::new(rgba, channels == 3);
    if channels == 5 {
        texels.spread_green();
    }
    Ok(texels)
}

impl Texels {
    /// Moves the second of two channels from alpha to green.
    fn spread_green(&mut self) {
        for texel in &mut self.rgba {
            *texel = [texel[0], texel[3], 0, u8::MAX];
        }
        self.has_alpha = false;
    }
}
