//! The bytes of a text file as plain UTF-8 with line feeds, for all text formats: byte order marks, UTF-16, the line
//! ends of old Macintoshes, padding, and 8-bit encodings end here.

use std::borrow::Cow;

/// `bytes` without byte order mark and without padding at their end: zero bytes and the end marks of DOS. UTF-16 with a
/// byte order mark becomes UTF-8, and a carriage return without line feed becomes one, so that lines keep their numbers.
pub(super) fn unwrapped(mut bytes: Vec<u8>) -> Vec<u8> {
    match bytes[..] {
        [0xff, 0xfe, ..] => bytes = from_utf16(&bytes[2..], u16::from_le_bytes),
        [0xfe, 0xff, ..] => bytes = from_utf16(&bytes[2..], u16::from_be_bytes),
        [0xef, 0xbb, 0xbf, ..] => drop(bytes.drain(..3)),
        _ => {}
    }
    let padding = bytes.iter().rev().take_while(|b| matches!(b, 0 | 0x1a));
    bytes.truncate(bytes.len() - padding.count());
    for at in 0..bytes.len() {
        if bytes[at] == b'\r' && bytes.get(at + 1) != Some(&b'\n') {
            bytes[at] = b'\n';
        }
    }
    bytes
}

fn from_utf16(bytes: &[u8], unit: fn([u8; 2]) -> u16) -> Vec<u8> {
    let (pairs, _) = bytes.as_chunks::<2>();
    let characters = char::decode_utf16(pairs.iter().map(|&pair| unit(pair)));
    let text: String = characters
        .map(|c| c.unwrap_or(char::REPLACEMENT_CHARACTER))
        .collect();
    text.into_bytes()
}

/// `bytes` with every byte that is not UTF-8 as the character of Latin-1: names and comments of older programs.
pub(super) fn from_latin1(bytes: Vec<u8>) -> Vec<u8> {
    if std::str::from_utf8(&bytes).is_ok() {
        return bytes;
    }
    let mut text = String::with_capacity(bytes.len());
    for chunk in bytes.utf8_chunks() {
        text.push_str(chunk.valid());
        text.extend(chunk.invalid().iter().copied().map(char::from));
    }
    text.into_bytes()
}

/// Whether `bytes` are UTF-16 without a byte order mark, by the zero byte of their first character.
pub(super) fn is_unmarked_utf16(bytes: &[u8]) -> bool {
    matches!(*bytes, [a, b, ..] if (a == 0) != (b == 0))
}

/// `bytes` without byte order mark, UTF-16 as UTF-8, for formats that may go on in binary.
pub(super) fn without_mark(bytes: &[u8]) -> Cow<'_, [u8]> {
    match bytes {
        [0xff, 0xfe, ..] | [0xfe, 0xff, ..] => Cow::Owned(unwrapped(bytes.to_vec())),
        [0xef, 0xbb, 0xbf, rest @ ..] => Cow::Borrowed(rest),
        _ => Cow::Borrowed(bytes),
    }
}
