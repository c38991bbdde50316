//! The `f` statement: corners of the form `v`, `v/vt`, `v//vn` or `v/vt/vn`, counted from 1, or
//! backwards from -1.

use super::lines::Line;
use crate::import::faults::Faults;
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

/// Reads the corners in `line` into `corners`, without their material; `counts` are the numbers of positions, texture
/// coordinates and normals so far. Returns whether all of them can be used; otherwise the face is to be skipped.
/// Texture coordinates and normals that do not exist are left out.
pub(super) fn read(
    source: &Source,
    faults: &mut Faults,
    line: &mut Line,
    counts: [usize; 3],
    corners: &mut Vec<Corner>,
) -> bool {
    corners.clear();
    while let Some(word) = line.word() {
        if corners.len() == MAX_FACE_CORNERS {
            let what = "faces with too many corners skipped";
            faults.add(("f", what), source, word.span(), || {
                let why = format!("a face has more than {MAX_FACE_CORNERS} corners");
                (why, "Split the face")
            });
            return false;
        }
        match corner(source, faults, word, counts) {
            Some(corner) => corners.push(corner),
            None => return false,
        }
    }
    true
}

fn corner(source: &Source, faults: &mut Faults, word: Token, counts: [usize; 3]) -> Option<Corner> {
    let mut indices = [NONE; 3];
    let mut at = word.at;
    for (place, digits) in word.bytes.split(|&b| b == b'/').enumerate() {
        let part = Token { bytes: digits, at };
        at += digits.len() + 1;
        let may_lack = place == 1 || place == 2 && !word.bytes.ends_with(b"//");
        if place > 2 || digits.is_empty() && !may_lack {
            let what = "faces with corners that cannot be read skipped";
            faults.add(("f", what), source, word.span(), || {
                let why = format!("{} is not a corner of a face", word.quote());
                (why, "Write V, V/VT, V//VN or V/VT/VN")
            });
            return None;
        }
        if digits.is_empty() {
            continue;
        }
        match index(part, counts[place]) {
            Some(index) => indices[place] = index,
            None => {
                faults.add(("f", LACKING[place].1), source, part.span(), || {
                    refusal(part, counts[place], LACKING[place].0)
                });
                if place == 0 {
                    return None;
                }
            }
        }
    }
    Some(Corner {
        position: indices[0],
        normal: indices[2],
        material: 0,
        uv: indices[1],
    })
}

/// The arrays that the indices of a corner point into, and what becomes of indices that do not exist.
const LACKING: [(&str, &str); 3] = [
    ("vertex", "faces with vertices that do not exist skipped"),
    (
        "texture coordinate",
        "texture coordinates that do not exist left out",
    ),
    ("normal", "normals that do not exist computed"),
];

/// `part` as a zero-based index into `count` elements.
fn index(part: Token, count: usize) -> Option<u32> {
    let number: i64 = std::str::from_utf8(part.bytes).ok()?.parse().ok()?;
    let index = match number < 0 {
        true => number.checked_add(count as i64)?,
        false => number.checked_sub(1)?,
    };
    (0..count as i64).contains(&index).then_some(index as u32)
}

/// Why `part` is not the index of an element called `name`.
fn refusal(part: Token, count: usize, name: &str) -> (String, &'static str) {
    let text = std::str::from_utf8(part.bytes).ok();
    match text.and_then(|text| text.parse::<i64>().ok()) {
        Some(number) => (
            format!("{name} {number} does not exist: {count} come before this face"),
            "Count from 1, or backwards from -1",
        ),
        None => (
            format!("{} is not the number of a {name}", part.quote()),
            "Write a whole number, counted from 1",
        ),
    }
}
