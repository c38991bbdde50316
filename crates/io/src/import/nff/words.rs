//! The words of an NFF file: separated by white space, without comments.

use crate::import::source::Token;

/// All keywords.
pub(in crate::import) const KEYS: [&str; 14] = [
    "v",
    "from",
    "at",
    "up",
    "angle",
    "hither",
    "resolution",
    "b",
    "l",
    "f",
    "s",
    "c",
    "p",
    "pp",
];

/// An iterator over the words with one word of lookahead.
pub(super) struct Words<'s> {
    bytes: &'s [u8],
    at: usize,
}

impl<'s> Words<'s> {
    pub fn new(bytes: &'s [u8]) -> Self {
        Self { bytes, at: 0 }
    }

    /// The empty word after the last one.
    pub fn end(&self) -> Token<'s> {
        let at = self.bytes.trim_ascii_end().len();
        Token { bytes: &[], at }
    }

    /// The word that [`Self::next`] will return.
    pub fn peek(&mut self) -> Option<Token<'s>> {
        loop {
            let rest = &self.bytes[self.at..];
            let space = rest.iter().take_while(|b| is_space(**b)).count();
            self.at += space;
            let rest = &rest[space..];
            if !rest.starts_with(b"#") {
                let length = rest.iter().take_while(|b| !ends_word(**b)).count();
                let token = Token {
                    bytes: &rest[..length],
                    at: self.at,
                };
                return (length > 0).then_some(token);
            }
            self.at += rest.iter().take_while(|&&b| b != b'\n').count();
        }
    }
}

impl<'s> Iterator for Words<'s> {
    type Item = Token<'s>;

    fn next(&mut self) -> Option<Token<'s>> {
        let token = self.peek()?;
        self.at += token.bytes.len();
        Some(token)
    }
}

/// C's `isspace`.
fn is_space(byte: u8) -> bool {
    matches!(byte, b' ' | b'\t'..=b'\r')
}

fn ends_word(byte: u8) -> bool {
    is_space(byte) || byte == b'#'
}
