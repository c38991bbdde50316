//! The two containers of glTF 2.0: plain JSON, and binary GLB (section 4 of the specification).

use super::blame::Blame;
use crate::import::error::ImportError;
use std::ops::Range;

const MAGIC: &[u8] = b"glTF";
const JSON: u32 = 0x4e4f_534a;
const BIN: u32 = 0x004e_4942;

/// Where the parts of a file are.
pub(super) struct Parts {
    pub json: Range<usize>,
    /// The first buffer, if the file contains it.
    pub bin: Option<Range<usize>>,
}

/// The parts of the file `bytes`, which is a GLB if it begins like one.
///
/// # Errors
/// A GLB is of another version, its lengths do not fit, or its first chunk is not JSON.
pub(super) fn parts(bytes: &[u8], blame: Blame) -> Result<Parts, ImportError> {
    if !bytes.starts_with(MAGIC) {
        let mark = if bytes.starts_with(b"\xef\xbb\xbf") {
            3
        } else {
            0
        };
        return Ok(Parts {
            json: mark..bytes.len(),
            bin: None,
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
    if length > bytes.len() {
        let have = bytes.len();
        return Err(blame.truncated(&format!("{have} of {length} bytes are there")));
    }
    let mut json = None;
    let mut bin = None;
    let mut at = 12;
    while let (Some(size), Some(kind)) = (word(at), word(at + 4)) {
        let chunk = at + 8..(at + 8).saturating_add(size as usize);
        if chunk.end > length {
            return Err(blame.truncated("a chunk is longer than the file"));
        }
        at = chunk.end;
        match kind {
            JSON if json.is_none() => json = Some(chunk),
            _ if json.is_none() => break,
            BIN if bin.is_none() => bin = Some(chunk),
            _ => {}
        }
    }
    match json {
        Some(json) => Ok(Parts { json, bin }),
        None => Err(blame.truncated("the first chunk is not JSON")),
    }
}
