//! STL as text: `solid NAME`, facets of a normal and three corners, `endsolid`. One file may have several
//! solids. Keywords may have any case.

use super::Solid;
use crate::import::error::ImportError;
use crate::import::number;
use crate::import::source::{Source, Token};
use glam::Vec3;

/// How far into a file its first facet is looked for, in bytes.
const START: usize = 4096;

/// Whether `bytes` look like text: they begin with `solid`, soon name a facet or the end, and have no zero
/// byte until then.
pub(super) fn is_text(bytes: &[u8]) -> bool {
    let start = bytes[..bytes.len().min(START)].to_ascii_lowercase();
    let start = start.strip_prefix(b"\xef\xbb\xbf").unwrap_or(&start);
    let start = start.trim_ascii_start();
    let find = |word: &[u8]| start.windows(word.len()).position(|window| window == word);
    let first = find(b"facet").or(find(b"endsolid"));
    let is_short = bytes.len() < START && !start.contains(&0);
    start.starts_with(b"solid")
        && (is_short || first.is_some_and(|first| !start[..first].contains(&0)))
}

/// The facets in `source`.
pub(super) fn read(source: &Source) -> Result<Solid, ImportError> {
    let mut words = Words { source, at: 0 };
    let mut solid = Solid::new();
    let mut is_open = false;
    while let Some(word) = words.next() {
        if !is_open && word.bytes.eq_ignore_ascii_case(b"solid") {
            words.skip_line();
            is_open = true;
        } else if is_open && word.bytes.eq_ignore_ascii_case(b"endsolid") {
            words.skip_line();
            is_open = false;
        } else if is_open && word.bytes.eq_ignore_ascii_case(b"facet") {
            solid.add(words.facet()?);
        } else {
            let expected = if is_open {
                "`facet` or `endsolid`"
            } else {
                "`solid`"
            };
            let why = format!("expected {expected}, found {}", word.quote());
            return Err(source.malformed(word.span(), why, TODO));
        }
    }
    if is_open {
        let note = "`endsolid` is missing: the file may be truncated";
        solid.notes.add("ends", || note.to_owned());
    }
    Ok(solid)
}

const TODO: &str = "Check that this is an STL file that was written completely";

struct Words<'s> {
    source: &'s Source,
    at: usize,
}

impl<'s> Words<'s> {
    fn next(&mut self) -> Option<Token<'s>> {
        let rest = &self.source.bytes[self.at..];
        let start = rest.iter().position(|b| !b.is_ascii_whitespace())?;
        let length = rest[start..].iter().position(u8::is_ascii_whitespace);
        let end = length.map_or(rest.len(), |length| start + length);
        let token = Token {
            bytes: &rest[start..end],
            at: self.at + start,
        };
        self.at += end;
        Some(token)
    }

    /// Skips the name of a solid, which may have any characters.
    fn skip_line(&mut self) {
        let rest = &self.source.bytes[self.at..];
        let end = rest.iter().position(|b| matches!(b, b'\n' | b'\r'));
        self.at += end.unwrap_or(rest.len());
    }

    /// What follows the word `facet`.
    fn facet(&mut self) -> Result<[Vec3; 3], ImportError> {
        self.expect("normal")?;
        for _ in 0..3 {
            // Some programs write `nan` for the normals of facets without area.
            self.word("a number")?;
        }
        self.expect("outer")?;
        self.expect("loop")?;
        let mut corners = [Vec3::ZERO; 3];
        for corner in &mut corners {
            self.expect("vertex")?;
            for value in corner.as_mut() {
                *value = number::parse(self.source, self.word("a number")?)? as f32;
            }
        }
        self.expect("endloop")?;
        self.expect("endfacet")?;
        Ok(corners)
    }

    fn word(&mut self, what: &str) -> Result<Token<'s>, ImportError> {
        self.next().ok_or_else(|| {
            let end = self.source.bytes.len();
            let why = format!("the file ends where {what} should be");
            self.source.malformed(end..end, why, TODO)
        })
    }

    fn expect(&mut self, keyword: &str) -> Result<(), ImportError> {
        let word = self.word(&format!("`{keyword}`"))?;
        if word.bytes.eq_ignore_ascii_case(keyword.as_bytes()) {
            return Ok(());
        }
        let why = format!("expected `{keyword}`, found {}", word.quote());
        Err(self.source.malformed(word.span(), why, TODO))
    }
}
