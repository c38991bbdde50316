//! The two containers of glTF 2.0: plain JSON, and binary GLB (section 4 of the specification).

use super::blame::Blame;
use crate::import::error::ImportError;
use glimray_scene::bytes::sizes;
use std::ops::Range;

const MAGIC: &[u8] = b"glTF";
const JSON: u32 = 0x4e4f_534a;
const BIN: u32 = 0x004e_4942;

/// Where the parts of a file are.
pub(super) struct Parts {
    pub json: Range<usize>,
    /// The first buffer, if the file contains it.
    pub bin: Option<Range<usize>>,
    /// Why it is incomplete, if it is.
    pub cut: Option<ImportError>,
}

/// The parts of the file `bytes`, which is a GLB if it begins like one.
///
/// # Errors
/// A GLB is of another version, or its first chunk is not JSON.
pub(super) fn parts(bytes: &[u8], blame: Blame) -> Result<Parts, ImportError> {
    if !bytes.starts_with(MAGIC) {
        return Ok(Parts {
            json: text(bytes, 0..bytes.len()),
            bin: None,
            cut: None,
        });
    }
    let word = |at: usize| {
        let bytes = bytes.get(at..at + 4)?;
        Some(u32::from_le_bytes([bytes[0], bytes[1], bytes[2], bytes[3]]))
    };
    let (Some(version), Some(length)) = (word(4), word(8)) else {
        return Err(blame.truncated("the file ends in its header"));
    };
    if version != 2 {
        let why = format!("it is a GLB of version {version}, but only version 2 is read");
        return Err(blame.file(&why, "Convert it to glTF 2.0"));
    }
    let length = length as usize;
    let cut = |why: String| Some(blame.truncated(&why));
    let mut parts = Parts {
        json: 0..0,
        bin: None,
        cut: None,
    };
    if length > bytes.len() {
        let [there, length] = sizes([bytes.len() as u64, length as u64]);
        parts.cut = cut(format!("{there} of {length} are there"));
    }
    let mut at = 12;
    // Bytes beyond the length in the header are not part of the model.
    while let (true, Some(size), Some(kind)) = (at < length, word(at), word(at + 4)) {
        let mut chunk = at + 8..(at + 8).saturating_add(size as usize);
        if chunk.end > bytes.len() {
            let why = "a chunk is longer than the file".to_owned();
            parts.cut = parts.cut.or_else(|| cut(why));
            chunk.end = bytes.len();
        }
        at = chunk.end;
        match kind {
            JSON if parts.json.is_empty() => parts.json = text(bytes, chunk),
            _ if parts.json.is_empty() => break,
            BIN if parts.bin.is_none() => parts.bin = Some(chunk),
            _ => {}
        }
        // Some programs pad a chunk and do not count it.
        let is_chunk = |at: usize| matches!(word(at + 4), Some(JSON | BIN));
        let padded = at.next_multiple_of(4);
        if !is_chunk(at) && is_chunk(padded) {
            at = padded;
        }
    }
    match (parts.json.is_empty(), parts.cut.take()) {
        (true, Some(cut)) => Err(cut),
        (true, None) => Err(blame.truncated("the first chunk is not JSON")),
        (false, cut) => Ok(Parts { cut, ..parts }),
    }
}

/// The part of `range` without a byte order mark and the zero bytes with which some programs fill up.
fn text(bytes: &[u8], range: Range<usize>) -> Range<usize> {
    let part = &bytes[range.clone()];
    let mark = usize::from(part.starts_with(b"\xef\xbb\xbf")) * 3;
    let filled = part.iter().rev().take_while(|&&byte| byte == 0).count();
    range.start + mark..(range.end - filled).max(range.start + mark)
}
