//! The `f` statement: corners of the form `v`, `v/vt`, `v//vn` or `v/vt/vn`, counted from 1, or
//! backwards from -1.

use super::lines::Line;
use crate::import::error::ImportError;
use crate::import::source::{Source, Token};

/// The normal index of a corner without normal.
pub(super) const NONE: u32 = u32::MAX;

/// Marks indices of computed normals, which are not in the file.
pub(super) const MADE: u32 = 1 << 31;

/// Marks indices of faces in smoothing groups, whose normals are computed later.
pub(super) const SMOOTH: u32 = 1 << 30;

/// Limit of corners of all faces: indices are u32, and some bits are marks.
pub(super) const MAX_CORNERS: usize = MADE as usize - 1;

/// Limit of corners of one face.
const MAX_FACE_CORNERS: usize = 65_536;

/// The texture coordinate index of a corner that has none or needs none.
pub(super) const NO_UV: u32 = NONE;

/// One corner of a face.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(super) struct Corner {
    /// Index of a `vn`, or [`NONE`], or an index with [`MADE`] or [`SMOOTH`].
    pub normal: u32,
    /// Index of a `v`.
    pub position: u32,
    pub material: u32,
    /// Index of a `vt`, or [`NO_UV`].
    pub uv: u32,
}

/// The face that a corner's computed normal belongs to, if any.
pub(super) fn smooth_index(normal: u32) -> Option<usize> {
    (normal & MADE == 0 && normal & SMOOTH != 0).then_some((normal & !SMOOTH) as usize)
}

/// The corners in `line`, without their material; `counts` are the numbers of positions, texture
/// coordinates and normals so far.
pub(super) fn read(
    source: &Source,
    keyword: Token,
    line: &mut Line,
    counts: [usize; 3],
) -> Result<Vec<Corner>, ImportError> {
    let mut corners = Vec::new();
    while let Some(word) = line.word() {
        if corners.len() == MAX_FACE_CORNERS {
            let why = format!("a face has more than {MAX_FACE_CORNERS} corners");
            return Err(source.malformed(word.span(), why, "Split the face"));
        }
        corners.push(corner(source, word, counts)?);
    }
    if corners.is_empty() {
        let why = "a face has no corners".to_owned();
        return Err(source.malformed(keyword.span(), why, "Check that the file is complete"));
    }
    Ok(corners)
}

fn corner(source: &Source, word: Token, counts: [usize; 3]) -> Result<Corner, ImportError> {
    const NAMES: [&str; 3] = ["vertex", "texture coordinate", "normal"];
    let mut indices = [NONE; 3];
    let mut at = word.at;
    for (place, digits) in word.bytes.split(|&b| b == b'/').enumerate() {
        let part = Token { bytes: digits, at };
        at += digits.len() + 1;
        let may_lack = place == 1 || place == 2 && !word.bytes.ends_with(b"//");
        if place > 2 || digits.is_empty() && !may_lack {
            let why = format!("{} is not a corner of a face", word.quote());
            return Err(source.malformed(word.span(), why, "Write V, V/VT, V//VN or V/VT/VN"));
        }
        if !digits.is_empty() {
            indices[place] = index(source, part, counts[place], NAMES[place])?;
        }
    }
    Ok(Corner {
        position: indices[0],
        normal: indices[2],
        material: 0,
        uv: indices[1],
    })
}

/// `part` as a zero-based index into `count` elements called `name`.
fn index(source: &Source, part: Token, count: usize, name: &str) -> Result<u32, ImportError> {
    let text = std::str::from_utf8(part.bytes).ok();
    let Some(number) = text.and_then(|text| text.parse::<i64>().ok()) else {
        let why = format!("{} is not the number of a {name}", part.quote());
        return Err(source.malformed(part.span(), why, "Write a whole number, counted from 1"));
    };
    let index = if number < 0 {
        number.checked_add(count as i64)
    } else {
        number.checked_sub(1)
    };
    match index {
        Some(index) if (0..count as i64).contains(&index) => Ok(index as u32),
        _ => {
            let why = format!("{name} {number} does not exist: {count} come before this face");
            Err(source.malformed(part.span(), why, "Count from 1, or backwards from -1"))
        }
    }
}
