//! The words of a course file: separated by white space, without comments.

use crate::import::source::Token;

/// All keywords; those of `Key` come first.
pub(in crate::import) const KEYS: [&str; 16] = [
    "pos:",
    "nor:",
    "dif:",
    "spe:",
    "shi:",
    "rad:",
    "col:",
    "amb:",
    "sphere",
    "triangle",
    "light",
    "ref:",
    "area_light:",
    "area_u:",
    "area_v:",
    "samples:",
];

/// An iterator over the words.
pub(super) struct Tokens<'s> {
    bytes: &'s [u8],
    at: usize,
}

impl<'s> Tokens<'s> {
    pub fn new(bytes: &'s [u8]) -> Self {
        Self { bytes, at: 0 }
    }

    /// The empty word after the last one.
    pub fn end(&self) -> Token<'s> {
        let at = self.bytes.trim_ascii_end().len();
        Token { bytes: &[], at }
    }

    fn rest(&self) -> &'s [u8] {
        &self.bytes[self.at..]
    }

    fn skip_space_and_comments(&mut self) {
        loop {
            let space = self.rest().iter().take_while(|b| is_space(**b)).count();
            self.at += space;
            if !begins_comment(self.rest()) {
                return;
            }
            let line = self.rest().iter().take_while(|&&b| b != b'\n').count();
            self.at += line;
        }
    }
}

impl<'s> Iterator for Tokens<'s> {
    type Item = Token<'s>;

    fn next(&mut self) -> Option<Token<'s>> {
        self.skip_space_and_comments();
        let rest = self.rest();
        let length = word_length(rest);
        let token = Token {
            bytes: &rest[..length],
            at: self.at,
        };
        self.at += length;
        (length > 0).then_some(token)
    }
}

/// Bytes up to the next space or comment.
fn word_length(bytes: &[u8]) -> usize {
    let may_end = |&byte: &u8| is_space(byte) || byte == b'#' || byte == b'/';
    let mut length = 0;
    while let Some(found) = bytes[length..].iter().position(may_end) {
        length += found;
        if bytes[length] != b'/' || begins_comment(&bytes[length..]) {
            return length;
        }
        length += 1;
    }
    bytes.len()
}

/// C's `isspace`.
fn is_space(byte: u8) -> bool {
    matches!(byte, b' ' | b'\t'..=b'\r')
}

fn begins_comment(bytes: &[u8]) -> bool {
    bytes.starts_with(b"#") || bytes.starts_with(b"//")
}
