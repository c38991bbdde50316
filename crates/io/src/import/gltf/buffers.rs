//! Buffers, and the URIs that they and images have: files beside the model or `data:` URIs.

use super::blame::Blame;
use super::document::Document;
use crate::import::error::ImportError;
use crate::import::paths::{Files, Refusal};
use crate::import::source::quote;
use std::collections::HashMap;
use std::ops::Range;
use std::path::PathBuf;

/// The bytes of all buffers. Several buffers in one file share its bytes.
pub(super) struct Buffers {
    blocks: Vec<Vec<u8>>,
    /// For each buffer the block, and the part of it.
    places: Vec<(usize, Range<usize>)>,
}

impl Buffers {
    /// Reads the buffers of `document`. `file` is the whole file and `bin` the part of it that is the
    /// first buffer without a URI.
    ///
    /// One that is missing or damaged is empty, and one that is too short ends early; `report` gets the faults.
    ///
    /// # Errors
    /// A buffer is not permitted.
    pub fn read(
        document: &Document,
        file: Vec<u8>,
        bin: Option<Range<usize>>,
        files: &Files,
        blame: Blame,
        report: &mut dyn FnMut(ImportError),
    ) -> Result<Self, ImportError> {
        let mut blocks = vec![file];
        let mut places = Vec::with_capacity(document.buffers.len());
        let mut known: HashMap<PathBuf, usize> = HashMap::new();
        for (index, buffer) in document.buffers.iter().enumerate() {
            let place = || format!("buffers[{index}]");
            let (block, range) = match &buffer.uri {
                None => {
                    let bin = bin.clone().filter(|_| index == 0);
                    let Some(bin) = bin else {
                        // The buffer of an extension that has a copy of its own.
                        places.push((0, 0..0));
                        continue;
                    };
                    (0, bin)
                }
                Some(uri) => {
                    let found = Self::outside(uri, &mut blocks, &mut known, files, blame, &place());
                    match found {
                        Ok(block) => (block, 0..blocks[block].len()),
                        Err(error @ (ImportError::Malformed(_) | ImportError::Unreadable(_))) => {
                            report(error);
                            places.push((0, 0..0));
                            continue;
                        }
                        Err(error) => return Err(error),
                    }
                }
            };
            let have = range.len() as u64;
            if buffer.byte_length > have {
                let why = format!(
                    "byteLength is {}, but only {have} bytes are there",
                    buffer.byte_length
                );
                report(blame.bad(place(), why));
            }
            let length = buffer.byte_length.min(have) as usize;
            places.push((block, range.start..range.start + length));
        }
        Ok(Self { blocks, places })
    }

    /// The block with the contents of `uri`, which is that of the buffer at `place`.
    fn outside(
        uri: &str,
        blocks: &mut Vec<Vec<u8>>,
        known: &mut HashMap<PathBuf, usize>,
        files: &Files,
        blame: Blame,
        place: &str,
    ) -> Result<usize, ImportError> {
        let bytes = match source(uri, blame, place)? {
            Source::Bytes(bytes) => bytes,
            Source::File(name) => {
                let path = files.resolve(&name);
                let path = path.map_err(|refusal| refused(refusal, "buffer", blame, place))?;
                if let Some(&block) = known.get(&path) {
                    return Ok(block);
                }
                let bytes = files.read(&path, crate::import::MAX_GEOMETRY_BYTES)?;
                known.insert(path, blocks.len());
                bytes
            }
        };
        blocks.push(bytes);
        Ok(blocks.len() - 1)
    }

    /// The bytes of all buffers and of the file together.
    pub fn total(&self) -> usize {
        self.blocks.iter().map(Vec::len).sum()
    }

    /// The bytes of `bufferViews[index]`, to which `place` refers, and its stride if it has one.
    ///
    /// # Errors
    /// The view or its buffer does not exist, or it lies outside the buffer.
    pub fn view(
        &self,
        document: &Document,
        index: usize,
        place: &str,
        blame: Blame,
    ) -> Result<(&[u8], Option<u64>), ImportError> {
        let view = blame.get(&document.buffer_views, index, "bufferViews", place)?;
        let here = format!("bufferViews[{index}]");
        let (offset, length) = (view.byte_offset, view.byte_length);
        let bytes = self.range(view.buffer, offset, length, &here, blame)?;
        Ok((bytes, view.byte_stride.filter(|stride| *stride > 0)))
    }

    /// `length` bytes of `buffers[index]` from byte `offset`, to which `here` refers.
    ///
    /// # Errors
    /// The buffer does not exist, or they lie outside it.
    pub fn range(
        &self,
        index: usize,
        offset: u64,
        length: u64,
        here: &str,
        blame: Blame,
    ) -> Result<&[u8], ImportError> {
        let (block, range) = blame.get(&self.places, index, "buffers", here)?;
        let buffer = &self.blocks[*block][range.clone()];
        let end = offset.checked_add(length);
        match end.filter(|end| *end <= buffer.len() as u64) {
            Some(end) => Ok(&buffer[offset as usize..end as usize]),
            None => {
                let have = buffer.len();
                let why = format!(
                    "{length} bytes from byte {offset} lie outside buffers[{index}], which has {have} bytes"
                );
                Err(blame.bad(here, why))
            }
        }
    }

    /// Adds a buffer and returns its index.
    pub fn push(&mut self, bytes: Vec<u8>) -> usize {
        self.places.push((self.blocks.len(), 0..bytes.len()));
        self.blocks.push(bytes);
        self.places.len() - 1
    }
}

/// The data or the file that a URI stands for.
pub(super) enum Source {
    /// The contents of a `data:` URI.
    Bytes(Vec<u8>),
    /// The name of a file, relative to the model's folder.
    File(String),
}

/// The data or the file that `uri`, which is at `place`, stands for (RFC 2397, RFC 3986).
///
/// # Errors
/// `uri` is a `data:` URI with invalid base64, or its percent encoding is not UTF-8.
pub(super) fn source(uri: &str, blame: Blame, place: &str) -> Result<Source, ImportError> {
    if let Some(rest) = uri
        .get(..5)
        .filter(|head| head.eq_ignore_ascii_case("data:"))
    {
        let rest = &uri[rest.len()..];
        let bytes = rest.split_once(',').and_then(|(head, body)| {
            let is_base64 = head.to_ascii_lowercase().ends_with(";base64");
            match is_base64 {
                true => base64(body),
                false => Some(percent_decoded(body)),
            }
        });
        let why = "the data: URI is damaged: it is not base64";
        return bytes
            .map(Source::Bytes)
            .ok_or_else(|| blame.bad(place, why));
    }
    match String::from_utf8(percent_decoded(uri)) {
        Ok(name) => Ok(Source::File(name)),
        Err(_) => {
            let why = format!("the URI {} is not UTF-8", quote(uri.as_bytes()));
            Err(blame.bad(place, why))
        }
    }
}

/// The error for a file that may not be read.
pub(super) fn refused(refusal: Refusal, what: &str, blame: Blame, place: &str) -> ImportError {
    refusal.into_error(what, |why, todo| {
        blame.file(&format!("{place}: {why}"), todo)
    })
}

/// `text` with `%XX` replaced by the byte XX. Other percent signs stay.
fn percent_decoded(text: &str) -> Vec<u8> {
    let digit = |byte: Option<&u8>| char::from(*byte?).to_digit(16);
    let bytes = text.as_bytes();
    let mut decoded = Vec::with_capacity(bytes.len());
    let mut at = 0;
    while let Some(&byte) = bytes.get(at) {
        let code = match (byte, digit(bytes.get(at + 1)), digit(bytes.get(at + 2))) {
            (b'%', Some(high), Some(low)) => Some((16 * high + low) as u8),
            _ => None,
        };
        decoded.push(code.unwrap_or(byte));
        at += if code.is_some() { 3 } else { 1 };
    }
    decoded
}

/// The bytes that `text` encodes (RFC 4648, section 4; also with the letters of section 5); `None` if
/// it has other characters. White space and padding are ignored.
fn base64(text: &str) -> Option<Vec<u8>> {
    let mut bytes = Vec::with_capacity(text.len() / 4 * 3 + 3);
    let (mut bits, mut count) = (0_u32, 0);
    for letter in text.bytes() {
        let value = match letter {
            b'A'..=b'Z' => letter - b'A',
            b'a'..=b'z' => letter - b'a' + 26,
            b'0'..=b'9' => letter - b'0' + 52,
            b'+' | b'-' => 62,
            b'/' | b'_' => 63,
            b'=' | b' ' | b'\t' | b'\r' | b'\n' => continue,
            _ => return None,
        };
        bits = bits << 6 | u32::from(value);
        count += 6;
        if count >= 8 {
            count -= 8;
            bytes.push((bits >> count) as u8);
            bits &= (1 << count) - 1;
        }
    }
    Some(bytes)
}
