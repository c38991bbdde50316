//! A text file in memory, and error positions in it.

use super::encoding;
use super::error::{Excerpt, ImportError, Position, fault};
use glimray_scene::text::one_line;
use std::ops::Range;
use std::path::{Path, PathBuf};

/// Number of bytes that an error shows on either side of the fault.
const EXCERPT_REACH: usize = 60;

/// The text of one file, or of an override, without its byte order mark.
pub(super) struct Source {
    /// The heading of errors, such as "bad scene".
    what: &'static str,
    /// Empty for an override.
    pub path: PathBuf,
    pub bytes: Vec<u8>,
}

/// Some bytes of a [`Source`] and their position.
#[derive(Clone, Copy)]
pub(super) struct Token<'s> {
    pub bytes: &'s [u8],
    pub at: usize,
}

impl Token<'_> {
    /// The range of the token in the source.
    pub fn span(&self) -> Range<usize> {
        self.at..self.at + self.bytes.len()
    }

    /// The token as shown in errors.
    pub fn quote(&self) -> String {
        quote(self.bytes)
    }
}

impl Source {
    /// The text in `bytes`; see [`encoding::unwrapped`].
    ///
    /// # Errors
    /// `bytes` are empty, binary, or UTF-16 that does not say so.
    pub fn new(what: &'static str, path: &Path, bytes: Vec<u8>) -> Result<Self, ImportError> {
        let refuse = |why, todo| Err(ImportError::Malformed(fault(what, path, why, todo)));
        if bytes.is_empty() {
            return refuse("the file is empty", "Check that it was written completely");
        }
        if encoding::is_unmarked_utf16(&bytes) {
            return refuse("the file is UTF-16", "Save it as UTF-8");
        }
        let source = Self {
            what,
            path: path.to_owned(),
            bytes: encoding::unwrapped(bytes),
        };
        if source.bytes.is_empty() {
            let todo = "Check that it was written completely";
            return refuse("the file has nothing but padding", todo);
        }
        match source.bytes.iter().position(|&b| b == 0) {
            Some(at) => {
                let why = "a zero byte: the file is binary, not text".to_owned();
                Err(source.malformed(at..at + 1, why, "Name a text file"))
            }
            None => Ok(source),
        }
    }

    /// As [`Self::new`], for formats that do not say what their encoding is: see [`encoding::from_latin1`].
    pub fn of_any_encoding(
        what: &'static str,
        path: &Path,
        bytes: Vec<u8>,
    ) -> Result<Self, ImportError> {
        let source = Self::new(what, path, bytes)?;
        Ok(Self {
            bytes: encoding::from_latin1(source.bytes),
            ..source
        })
    }

    /// # Errors
    /// The bytes are not UTF-8.
    pub fn text(&self) -> Result<&str, ImportError> {
        std::str::from_utf8(&self.bytes).map_err(|error| {
            let at = error.valid_up_to();
            let why = format!("the byte {:#04x} is not UTF-8", self.bytes[at]);
            self.malformed(at..at + 1, why, "Save the file as UTF-8")
        })
    }

    /// An error about `span`. `why` is a clause without a full stop (or a question with its mark), `todo`
    /// a sentence without a full stop.
    pub fn malformed(&self, span: Range<usize>, why: String, todo: &str) -> ImportError {
        let fault = fault(self.what, &self.path, &why, todo);
        ImportError::Malformed(fault.at(self.position(span.start), self.excerpt(span)))
    }

    /// The excerpt around `span`, which may end, but not begin, beyond the text.
    fn excerpt(&self, span: Range<usize>) -> Excerpt {
        let at = span.start.min(self.bytes.len());
        let line = self.line_around(at);
        let from = line.start.max(at.saturating_sub(EXCERPT_REACH));
        let to = line.end.min(at + EXCERPT_REACH);
        let cut = |is_cut| if is_cut { "…" } else { "" };
        let before = format!(
            "{}{}",
            cut(from > line.start),
            visible(&self.bytes[from..at])
        );
        let marked = visible(&self.bytes[at..span.end.clamp(at, to)]);
        let after = visible(&self.bytes[at.max(span.end.clamp(at, to))..to]);
        Excerpt {
            span: before.len()..before.len() + marked.len(),
            text: format!("{before}{marked}{after}{}", cut(to < line.end)),
        }
    }

    /// The line and column of the byte `at`, or of the end of the text if that comes first.
    pub fn position(&self, at: usize) -> Position {
        let at = at.min(self.bytes.len());
        let start = self.line_around(at).start;
        let is_newline = |b: &&u8| **b == b'\n';
        let begins_character = |b: &&u8| **b & 0xc0 != 0x80;
        Position {
            line: 1 + self.bytes[..start].iter().filter(is_newline).count(),
            column: 1 + self.bytes[start..at]
                .iter()
                .filter(begins_character)
                .count(),
        }
    }

    fn line_around(&self, at: usize) -> Range<usize> {
        let (before, after) = self.bytes.split_at(at);
        let start = before
            .iter()
            .rposition(|&b| b == b'\n')
            .map_or(0, |i| i + 1);
        let length = after.iter().position(|&b| b == b'\n' || b == b'\r');
        start..length.map_or(self.bytes.len(), |length| at + length)
    }
}

/// `bytes` in backquotes, truncated if long, without control characters.
pub(super) fn quote(bytes: &[u8]) -> String {
    quote_up_to(32, bytes)
}

/// As [`quote`], for at most `longest` bytes.
pub(super) fn quote_up_to(longest: usize, bytes: &[u8]) -> String {
    let mut quoted = String::from("`");
    for c in String::from_utf8_lossy(&bytes[..bytes.len().min(longest)]).chars() {
        match c {
            '\\' | '\'' | '"' => quoted.push(c),
            c => quoted.extend(c.escape_debug()),
        }
    }
    quoted.push_str(if bytes.len() > longest { "…`" } else { "`" });
    quoted
}

fn visible(bytes: &[u8]) -> String {
    one_line(&String::from_utf8_lossy(bytes).replace('\t', " "))
}
