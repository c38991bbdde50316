//! Checks whether an image file can contain what its header announces, before memory is allocated.
//! Decoders fill the missing part of a truncated JPEG with grey, and allocate whatever a header claims.

use glimray_scene::bytes::size;
use image::ImageFormat;

/// The message for a file that ends too early.
pub(super) const CUT: &str = "is truncated: its end is missing";

/// Most texels that one byte of a PNG file can represent: deflate compresses 1032 bytes to one, and a
/// byte holds eight texels of one bit.
const PNG_TEXELS: u64 = 1032 * 8;

/// Most texels per byte of a Radiance HDR file, whose oldest encoding repeats a texel 65,535 times in eight bytes.
const HDR_TEXELS: u64 = 8192;

/// Most texels per byte of an OpenEXR file: deflate again, and at least two bytes per texel.
const EXR_TEXELS: u64 = 1032 / 2;

/// Checks that `bytes`, an image of `texels` texels, are complete and can represent that many.
///
/// # Errors
/// The problem as a clause.
pub(super) fn check(format: ImageFormat, bytes: &[u8], texels: u64) -> Result<(), String> {
    let most = match format {
        ImageFormat::Jpeg => return jpeg(bytes),
        ImageFormat::Png => {
            png(bytes)?;
            PNG_TEXELS
        }
        // A picture of a single colour may have no bits for its texels.
        ImageFormat::WebP => return webp(bytes),
        ImageFormat::OpenExr => EXR_TEXELS,
        _ => HDR_TEXELS,
    };
    match texels > most.saturating_mul(bytes.len() as u64) {
        true => Err(too_short(bytes.len(), texels, "texels")),
        false => Ok(()),
    }
}

fn too_short(length: usize, count: u64, what: &str) -> String {
    let length = size(length as u64);
    format!("is truncated: {length} cannot hold the {count} {what} that its header announces")
}

/// Compares the length of a WebP file with the one in its header (RFC 9649, section 2.4).
fn webp(bytes: &[u8]) -> Result<(), String> {
    let length = bytes.get(4..8).ok_or(CUT)?;
    let length = u32::from_le_bytes([length[0], length[1], length[2], length[3]]);
    match bytes.len() as u64 - 8 < u64::from(length) {
        true => Err(CUT.to_owned()),
        false => Ok(()),
    }
}

/// Follows the chunks of a PNG file to the last one.
fn png(bytes: &[u8]) -> Result<(), String> {
    let mut rest = bytes.get(8..).unwrap_or_default();
    loop {
        let Some((head, body)) = rest.split_at_checked(8) else {
            return Err(CUT.to_owned());
        };
        let length = u32::from_be_bytes([head[0], head[1], head[2], head[3]]);
        // A checksum follows the data.
        let Some(next) = body.get(length as usize..).and_then(|body| body.get(4..)) else {
            return Err(CUT.to_owned());
        };
        if head.ends_with(b"IEND") {
            return Ok(());
        }
        rest = next;
    }
}

/// Data of the first chunk of this name of a PNG file, before its texels.
pub(super) fn png_chunk<'b>(bytes: &'b [u8], name: &[u8; 4]) -> Option<&'b [u8]> {
    let mut rest = bytes.get(8..)?;
    loop {
        let (head, body) = rest.split_at_checked(8)?;
        let length = u32::from_be_bytes([head[0], head[1], head[2], head[3]]) as usize;
        match &head[4..] {
            found if found == name => return body.get(..length),
            b"IDAT" => return None,
            // A checksum follows the data.
            _ => rest = body.get(length..)?.get(4..)?,
        }
    }
}

/// Follows the markers of a JPEG file (ITU-T T.81, annex B) to the end of the image, and compares the
/// length of its scans with the number of blocks, each of which takes at least one bit for its mean.
fn jpeg(bytes: &[u8]) -> Result<(), String> {
    let cut = || CUT.to_owned();
    let (mut at, mut scanned, mut blocks) = (2, 0, 0);
    loop {
        let rest = bytes.get(at..).unwrap_or_default();
        let before = rest.iter().position(|&b| b == 0xff).ok_or_else(cut)?;
        let fill = rest[before..].iter().take_while(|&&b| b == 0xff).count();
        let marker = *rest.get(before + fill).ok_or_else(cut)?;
        scanned += before as u64;
        at += before + fill + 1;
        match marker {
            // A byte 255 of a scan, a restart, or a marker without a segment.
            0x00 => scanned += 1,
            0x01 | 0xd0..=0xd8 => {}
            0xd9 => break,
            _ => {
                let length = bytes.get(at..at + 2).ok_or_else(cut)?;
                let length = usize::from(u16::from_be_bytes([length[0], length[1]]));
                let segment = bytes.get(at + 2..at + length.max(2)).ok_or_else(cut)?;
                // Start of frame; 0xc4, 0xc8 and 0xcc have other meanings.
                if matches!(marker, 0xc0..=0xcf) && !matches!(marker, 0xc4 | 0xc8 | 0xcc) {
                    blocks = frame_blocks(segment).max(blocks);
                }
                at += length.max(2);
            }
        }
    }
    match blocks > 8 * scanned {
        true => Err(too_short(bytes.len(), blocks, "blocks")),
        false => Ok(()),
    }
}

/// The number of 8 × 8 blocks in all components of a frame; 0 if the header is invalid, which the decoder
/// reports.
fn frame_blocks(segment: &[u8]) -> u64 {
    let Some((&[_, h1, h0, w1, w0, _], components)) = segment.split_first_chunk::<6>() else {
        return 0;
    };
    let (height, width) = (u16::from_be_bytes([h1, h0]), u16::from_be_bytes([w1, w0]));
    // Each component has three bytes, of which the second holds both sampling factors.
    let factors = || {
        components
            .as_chunks::<3>()
            .0
            .iter()
            .map(|c| (c[1] >> 4, c[1] & 15))
    };
    let most = factors().fold((1, 1), |most, f| (most.0.max(f.0), most.1.max(f.1)));
    let along = |size: u16, factor: u8, most: u8| {
        (u64::from(size) * u64::from(factor)).div_ceil(8 * u64::from(most))
    };
    let count = |(h, v): (u8, u8)| along(width, h, most.0) * along(height, v, most.1);
    factors().map(count).sum()
}
