//! Changes files at random, in the same way in every run: words and lines of text, bytes and numbers of binary files, and
//! the contents of containers, whose lengths and checksums are put right so that readers look inside.

use crate::import::writing::archive;
use crate::support::random::Random;
use glimray::import::{Archive, Resolver};

/// Numbers and words in place of others.
const WORDS: [&str; 28] = [
    "0",
    "-1",
    "1",
    "2",
    "255",
    "256",
    "65536",
    "4294967295",
    "4294967296",
    "-2147483649",
    "18446744073709551616",
    "1e9",
    "1e30",
    "-1e38",
    "1e39",
    "1e308",
    "1e400",
    "1e-30",
    "1e-45",
    "1e-320",
    "nan",
    "inf",
    "-inf",
    "",
    "0x10",
    "1,5",
    "true",
    "\u{202e}\u{1b}[2J",
];

/// Numbers in place of those of binary files.
const NUMBERS: [u64; 14] = [
    0,
    1,
    0x7f,
    0x80,
    0xff,
    0xffff,
    0x7fff_ffff,
    0x8000_0000,
    0xffff_ffff,
    // NaN, infinity, the largest and the smallest of f32.
    0x7fc0_0000,
    0x7f80_0000,
    0x7f7f_ffff,
    0x0000_0001,
    u64::MAX,
];

/// `bytes`, a file of this kind, with one to several changes. Some are parts of `other`, a file of the same kind.
pub fn mutated(kind: &str, bytes: &[u8], other: &[u8], random: &mut Random) -> Vec<u8> {
    let plain = random.below(4) == 0;
    match kind {
        "glb" if !plain => in_glb(bytes, other, random),
        "zip" if !plain => in_archive(bytes, random),
        "picture" if !plain => with_checksums(changed(bytes, other, random)),
        _ => changed(bytes, other, random),
    }
}

fn changed(bytes: &[u8], other: &[u8], random: &mut Random) -> Vec<u8> {
    let mut bytes = bytes.to_vec();
    let count = 1 + random.below(2) * random.below(5);
    for _ in 0..count {
        match std::str::from_utf8(&bytes) {
            Ok(text) if !bytes.contains(&0) => bytes = changed_text(text, other, random),
            _ => change_bytes(&mut bytes, other, random),
        }
    }
    bytes
}

/// The words of a text: runs of letters, digits, signs and points.
fn words(text: &str) -> Vec<std::ops::Range<usize>> {
    let is_part = |c: char| c.is_alphanumeric() || "+-._".contains(c);
    let mut words = Vec::new();
    let mut start = None;
    for (at, c) in text.char_indices().chain([(text.len(), ' ')]) {
        match (is_part(c), start) {
            (true, None) => start = Some(at),
            (false, Some(from)) => {
                words.push(from..at);
                start = None;
            }
            _ => {}
        }
    }
    words
}

fn changed_text(text: &str, other: &[u8], random: &mut Random) -> Vec<u8> {
    let lines: Vec<_> = text.split_inclusive('\n').collect();
    let places = words(text);
    if places.is_empty() || text.is_empty() {
        return WORDS[random.below(WORDS.len())].into();
    }
    let word = places[random.below(places.len())].clone();
    let with = |new: &str| [&text[..word.start], new, &text[word.end..]].concat();
    let line = random.below(lines.len());
    let new = match random.below(10) {
        0..=3 => with(WORDS[random.below(WORDS.len())]),
        4 => with(&text[places[random.below(places.len())].clone()]),
        5 => {
            let other = String::from_utf8_lossy(other);
            let words = words(&other);
            with(
                words
                    .get(random.below(words.len().max(1)))
                    .map_or("", |word| &other[word.clone()]),
            )
        }
        6 => {
            // A line less, or many times.
            let times = [0, 0, 2, 3, 100][random.below(5)];
            let repeated = lines[line].repeat(times);
            lines[..line].concat() + &repeated + &lines[line + 1..].concat()
        }
        7 => {
            let from = random.below(lines.len());
            [
                &lines[..line].concat(),
                lines[from],
                &lines[line..].concat(),
            ]
            .concat()
        }
        8 => text[..word.end].to_owned(),
        _ => {
            // An odd byte, perhaps in the midst of a character.
            let mut bytes = text.as_bytes().to_vec();
            let at = random.below(bytes.len());
            bytes[at] = random.word() as u8;
            return bytes;
        }
    };
    new.into_bytes()
}

fn change_bytes(bytes: &mut Vec<u8>, other: &[u8], random: &mut Random) {
    if bytes.is_empty() {
        bytes.push(random.word() as u8);
        return;
    }
    // Most of what decides is at the beginning.
    let limit = if random.below(2) == 0 {
        bytes.len()
    } else {
        bytes.len().min(256)
    };
    let at = random.below(limit);
    let end = (at + 1 + random.below(32)).min(bytes.len());
    match random.below(9) {
        0 => bytes[at] ^= 1 << random.below(8),
        1 => bytes[at] = random.word() as u8,
        2..=4 => {
            let number = NUMBERS[random.below(NUMBERS.len())].to_le_bytes();
            let mut number = number[..1 << random.below(4)].to_vec();
            if random.below(4) == 0 {
                number.reverse();
            }
            let at = if random.below(2) == 0 { at } else { at & !3 };
            let end = (at + number.len()).min(bytes.len());
            bytes[at..end].copy_from_slice(&number[..end - at]);
        }
        5 => _ = bytes.drain(at..end),
        6 => {
            let piece = bytes[at..end].to_vec();
            let piece = piece.repeat([1, 2, 50][random.below(3)]);
            bytes.splice(at..at, piece);
        }
        7 => bytes.truncate(at),
        _ => {
            let from = random.below(other.len().max(1)).min(other.len());
            let piece = &other[from..(from + end - at).min(other.len())];
            bytes[at..at + piece.len().min(end - at)].copy_from_slice(piece);
        }
    }
}

/// Changes the JSON of a GLB, whose lengths are put right, or its binary part.
fn in_glb(bytes: &[u8], other: &[u8], random: &mut Random) -> Vec<u8> {
    let length = bytes.get(12..16).and_then(|length| length.try_into().ok());
    let end = 20 + length.map_or(0, u32::from_le_bytes) as usize;
    if end > bytes.len() || bytes.len() < 20 {
        return changed(bytes, other, random);
    }
    let (json, rest) = (&bytes[20..end], &bytes[end..]);
    let (mut json, mut rest) = (json.to_vec(), rest.to_vec());
    match random.below(4) {
        0 if rest.len() > 8 => {
            let mut contents = rest.split_off(8);
            change_bytes(&mut contents, other, random);
            rest.extend(contents);
        }
        _ => json = changed(&json, &[], random),
    }
    while json.len() % 4 != 0 {
        json.push(b' ');
    }
    let mut made = bytes[..8].to_vec();
    made.extend((20 + json.len() as u32 + rest.len() as u32).to_le_bytes());
    made.extend((json.len() as u32).to_le_bytes());
    made.extend(b"JSON");
    made.extend(json);
    made.extend(rest);
    made
}

/// Changes one of the files of an archive.
fn in_archive(bytes: &[u8], random: &mut Random) -> Vec<u8> {
    let Ok(files) = Archive::new(bytes.to_vec()) else {
        return changed(bytes, &[], random);
    };
    let mut files: Vec<_> = (files.names())
        .filter_map(|name| {
            Some((
                name.to_string_lossy().into_owned(),
                files.read(name, 1 << 24).ok()?,
            ))
        })
        .collect();
    if files.is_empty() {
        return changed(bytes, &[], random);
    }
    let at = random.below(files.len());
    let new = changed(&files[at].1, &[], random);
    files[at].1 = new;
    let files: Vec<_> = files
        .iter()
        .map(|(name, bytes)| (name.as_str(), &bytes[..]))
        .collect();
    archive(&files)
}

/// A PNG with the checksums of its chunks put right, as far as there are chunks.
fn with_checksums(mut bytes: Vec<u8>) -> Vec<u8> {
    let mut at = 8;
    while bytes.starts_with(b"\x89PNG") && at + 12 <= bytes.len() {
        let length: [u8; 4] = bytes[at..at + 4].try_into().expect("four bytes");
        let end = at + 8 + u32::from_be_bytes(length) as usize;
        if end + 4 > bytes.len() {
            break;
        }
        let sum = crc32(&bytes[at + 4..end]);
        bytes[end..end + 4].copy_from_slice(&sum.to_be_bytes());
        at = end + 4;
    }
    bytes
}

/// CRC-32 of ISO 3309, as PNG defines it in annex D.
fn crc32(bytes: &[u8]) -> u32 {
    let mut crc = u32::MAX;
    for &byte in bytes {
        crc ^= u32::from(byte);
        for _ in 0..8 {
            crc = (crc >> 1) ^ (0xedb8_8320 * (crc & 1));
        }
    }
    !crc
}

#[test]
fn checksums_are_those_of_png() {
    // The last chunk of every PNG.
    assert_eq!(crc32(b"IEND"), 0xae42_6082);
    let png = include_bytes!("../../fuzz/seeds/picture/rgba.png");
    assert!(with_checksums(png.to_vec()) == png);
}
