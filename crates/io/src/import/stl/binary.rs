//! Binary STL: 80 bytes of free text, the number of facets, and 50 bytes for each: normal, three corners, and
//! two bytes that some programs use for a colour. All numbers are little-endian.

use super::Solid;
use crate::import::error::{ImportError, fault};
use crate::import::tint::Rgb;
use glam::Vec3;
use std::path::Path;

/// Length of the free text in bytes.
const TEXT: usize = 80;

/// Length of the text and the number of facets in bytes.
const HEADER: usize = TEXT + 4;

/// Length of a facet in bytes.
const FACET: usize = 50;

/// The bit that marks colours of VisCAM and SolidView, or facets without a colour of Magics.
const MARK: u16 = 1 << 15;

/// The number of facets if `bytes` are a binary file: its length follows from it. Files that begin with
/// `solid` may be binary too. Bytes after the last facet are allowed where the text cannot be an STL text.
pub(super) fn header(bytes: &[u8]) -> Option<usize> {
    let count = u32::from_le_bytes(count_bytes(bytes)?) as usize;
    let length = facets_end(count);
    // Programs that write while they compute may leave a 0.
    let is_left_out = count == 0 && room(bytes).is_some();
    let fits = match super::text::is_text(bytes) {
        true => length == bytes.len() as u64,
        false => length <= bytes.len() as u64,
    };
    (fits && !is_left_out).then_some(count)
}

/// The number of facets that a file has room for whose header announces another number, as if it was cut off or never
/// completed. Their normals tell whether it is an STL file: nearly all have the length 1 or 0.
pub(super) fn room(bytes: &[u8]) -> Option<usize> {
    if is_big_endian(bytes) {
        return None;
    }
    let facets = bytes.get(HEADER..)?.chunks_exact(FACET);
    let count = facets.len();
    let is_sound = |facet: &&[u8]| {
        let length = vector(facet, 0).length();
        length == 0.0 || (length - 1.0).abs() < 1e-2
    };
    let sound = facets.filter(is_sound).count();
    (count > 0 && 10 * sound >= 9 * count).then_some(count)
}

/// The normal of a facet, or one of its corners, counted from 1.
fn vector(facet: &[u8], place: usize) -> Vec3 {
    let number = |k: usize| {
        let at = 12 * place + 4 * k;
        f32::from_le_bytes([facet[at], facet[at + 1], facet[at + 2], facet[at + 3]])
    };
    Vec3::new(number(0), number(1), number(2))
}

fn count_bytes(bytes: &[u8]) -> Option<[u8; 4]> {
    bytes.get(TEXT..HEADER)?.try_into().ok()
}

fn is_big_endian(bytes: &[u8]) -> bool {
    let count = count_bytes(bytes).map_or(0, u32::from_be_bytes);
    count > 0 && facets_end(count as usize) == bytes.len() as u64
}

fn facets_end(count: usize) -> u64 {
    HEADER as u64 + FACET as u64 * count as u64
}

/// The error for a file that is neither text nor binary.
pub(super) fn refuse(path: &Path, bytes: &[u8]) -> ImportError {
    let length = bytes.len() as u64;
    let (why, todo) = match count_bytes(bytes) {
        None if bytes.is_empty() => (
            "the file is empty".to_owned(),
            "Check that it was written completely",
        ),
        None => (
            format!("it has {length} bytes: neither the text `solid` nor a binary header"),
            "Name an STL file",
        ),
        Some(_) if is_big_endian(bytes) => (
            "its numbers are big-endian, but those of STL are little-endian".to_owned(),
            "Save it again as binary STL",
        ),
        Some(count) => {
            let count = u32::from_le_bytes(count);
            let found = (length - HEADER as u64) / FACET as u64;
            (
                format!("its header announces {count} facets, but it has room for {found}"),
                "Check that it was written completely",
            )
        }
    };
    ImportError::Malformed(fault("bad model", path, &why, todo))
}

/// The first `count` facets in `bytes`, which have room for them.
pub(super) fn read(bytes: &[u8], count: usize) -> Solid {
    let facets = &bytes[HEADER..HEADER + FACET * count];
    let mut solid = Solid::new();
    solid.triangles.reserve_exact(count);
    let facets = facets.chunks_exact(FACET);
    let magics = magics_color(&bytes[..TEXT]);
    let has_colors = match magics {
        Some(_) => facets.clone().any(|facet| attribute(facet) & MARK == 0),
        None => facets.clone().any(|facet| attribute(facet) & MARK != 0),
    };
    solid.color = magics;
    for facet in facets {
        let corner = |i: usize| vector(facet, i + 1);
        if solid.add(vector(facet, 0), [corner(0), corner(1), corner(2)]) && has_colors {
            solid.colors.push(color(attribute(facet), magics.is_some()));
        }
    }
    let announced = count_bytes(bytes).map_or(0, u32::from_le_bytes);
    if announced as usize != count {
        solid.notes.add("ends", || {
            format!(
                "the header announces {announced} facets, but the file has {count}: it may be truncated"
            )
        });
    }
    let rest = bytes.len() - HEADER - FACET * count;
    if rest > 0 {
        let notes = &mut solid.notes;
        notes.add("bytes", || {
            format!("bytes after the last facet skipped: {rest}")
        });
    }
    if find(&bytes[..TEXT], b"MATERIAL=").is_some() {
        let note = "the material in the header skipped: only its colour is read";
        solid.notes.add("materials", || note.to_owned());
    }
    solid
}

/// The last two bytes of a facet.
fn attribute(facet: &[u8]) -> u16 {
    u16::from_le_bytes([facet[FACET - 2], facet[FACET - 1]])
}

/// The colour of a facet with this attribute: of Magics red has the lowest bits, otherwise blue.
fn color(attribute: u16, is_magics: bool) -> Option<Rgb> {
    // 31 becomes 255.
    let channel = |shift: u32| ((u32::from(attribute >> shift & 31) * 255 + 15) / 31) as u8;
    let [low, middle, high] = [0, 5, 10].map(channel);
    match (is_magics, attribute & MARK != 0) {
        (true, false) => Some([low, middle, high]),
        (false, true) => Some([high, middle, low]),
        _ => None,
    }
}

/// The colour of the whole part in the free text of Magics: `COLOR=` and red, green, blue and opacity, one
/// byte each.
fn magics_color(text: &[u8]) -> Option<Rgb> {
    const KEY: &[u8] = b"COLOR=";
    let at = find(text, KEY)? + KEY.len();
    text.get(at..at + 3)?.try_into().ok()
}

fn find(text: &[u8], key: &[u8]) -> Option<usize> {
    text.windows(key.len()).position(|window| window == key)
}
