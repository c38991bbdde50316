//! STL as text: `solid NAME`, facets of a normal and three corners, `endsolid`. One file may have several
//! solids. Keywords may have any case.

use super::Solid;
use crate::import::encoding;
use crate::import::error::ImportError;
use crate::import::faults::Faults;
use crate::import::number;
use crate::import::source::{Source, Token};
use glam::Vec3;

/// How far into a file its first facet is looked for, in bytes.
const START: usize = 4096;

/// Whether `bytes` look like text: they begin with `solid`, soon name a facet or the end, and have no zero
/// byte until then.
pub(super) fn is_text(bytes: &[u8]) -> bool {
    let start = encoding::unwrapped(bytes[..bytes.len().min(START)].to_vec());
    let start = start.to_ascii_lowercase();
    let start = start.trim_ascii_start();
    let find = |word: &[u8]| start.windows(word.len()).position(|window| window == word);
    let first = find(b"facet").or(find(b"endsolid"));
    let is_short = bytes.len() < START && !start.contains(&0);
    start.starts_with(b"solid")
        && (is_short || first.is_some_and(|first| !start[..first].contains(&0)))
}

/// The facets in `source`.
pub(super) fn read(source: &Source) -> Result<Solid, ImportError> {
    let mut words = Words {
        source,
        at: 0,
        faults: Faults::default(),
    };
    let mut solid = Solid::new();
    let mut is_open = false;
    while let Some(word) = words.next() {
        if !is_open && is(word, "solid") {
            words.skip_line();
            is_open = true;
        } else if is_open && is(word, "endsolid") {
            words.skip_line();
            is_open = false;
        } else if is_open && is(word, "facet") {
            if let Some((normal, corners)) = words.facet() {
                solid.add(normal, corners);
            }
        } else {
            let expected = match is_open {
                true => "`facet` or `endsolid`",
                false => "`solid`",
            };
            words.fault("words that do not belong there skipped", word, || {
                format!("expected {expected}, found {}", word.quote())
            });
            words.skip_to_facet();
        }
    }
    if solid.triangles.is_empty()
        && let Some(refusal) = words.faults.refusal()
    {
        return Err(refusal);
    }
    if is_open {
        let note = "`endsolid` is missing: the file may be truncated";
        solid.notes.add("ends", || note.to_owned());
    }
    words.faults.note(&mut solid.notes, None);
    Ok(solid)
}

fn is(word: Token, keyword: &str) -> bool {
    word.bytes.eq_ignore_ascii_case(keyword.as_bytes())
}

const TODO: &str = "Check that this is an STL file that was written completely";

const INCOMPLETE: &str = "facets that are not whole triangles skipped";

struct Words<'s> {
    source: &'s Source,
    at: usize,
    faults: Faults,
}

impl<'s> Words<'s> {
    fn next(&mut self) -> Option<Token<'s>> {
        let token = self.peek()?;
        self.at = token.span().end;
        Some(token)
    }

    fn peek(&self) -> Option<Token<'s>> {
        let rest = &self.source.bytes[self.at..];
        let start = rest.iter().position(|b| !b.is_ascii_whitespace())?;
        let length = rest[start..].iter().position(u8::is_ascii_whitespace);
        let end = length.map_or(rest.len(), |length| start + length);
        Some(Token {
            bytes: &rest[start..end],
            at: self.at + start,
        })
    }

    /// Skips to the next facet or end.
    fn skip_to_facet(&mut self) {
        while let Some(word) = self.peek() {
            if ["facet", "endsolid", "solid"].iter().any(|it| is(word, it)) {
                return;
            }
            self.next();
        }
    }

    fn fault(&mut self, what: &'static str, word: Token, why: impl FnOnce() -> String) {
        let refusal = || (why(), TODO);
        self.faults
            .add(("facet", what), self.source, word.span(), refusal);
    }

    /// Skips the name of a solid, which may have any characters.
    fn skip_line(&mut self) {
        let rest = &self.source.bytes[self.at..];
        let end = rest.iter().position(|b| matches!(b, b'\n' | b'\r'));
        self.at += end.unwrap_or(rest.len());
    }

    /// The normal and the corners after the word `facet`, if it is a whole triangle; otherwise counts a fault.
    fn facet(&mut self) -> Option<(Vec3, [Vec3; 3])> {
        self.expect("normal")?;
        let mut normal = Vec3::ZERO;
        for value in normal.as_mut() {
            // Some programs write `nan` for the normals of facets without area.
            let number = number::read(self.word("a number")?.bytes);
            *value = number.unwrap_or_default() as f32;
        }
        self.expect("outer")?;
        self.expect("loop")?;
        let mut corners = [Vec3::ZERO; 3];
        let mut are_numbers = true;
        for corner in &mut corners {
            self.expect("vertex")?;
            for value in corner.as_mut() {
                let word = self.word("a number")?;
                match self.faults.number("vertex", self.source, word) {
                    Some(number) => *value = number as f32,
                    None => are_numbers = false,
                }
            }
        }
        self.expect("endloop")?;
        self.expect("endfacet")?;
        are_numbers.then_some((normal, corners))
    }

    fn word(&mut self, what: &str) -> Option<Token<'s>> {
        let word = self.next();
        if word.is_none() {
            let at = self.source.bytes.len();
            self.fault(INCOMPLETE, Token { bytes: &[], at }, || {
                format!("the file ends where {what} should be")
            });
        }
        word
    }

    fn expect(&mut self, keyword: &str) -> Option<()> {
        let word = self.word(&format!("`{keyword}`"))?;
        if is(word, keyword) {
            return Some(());
        }
        self.fault(INCOMPLETE, word, || {
            format!("expected `{keyword}`, found {}", word.quote())
        });
        // The word may begin what comes next.
        self.at = word.at;
        self.skip_to_facet();
        None
    }
}
