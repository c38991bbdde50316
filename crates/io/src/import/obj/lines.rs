//! The lines of OBJ and MTL files and their words. A backslash at the end of a line continues it.

use crate::import::source::Token;

/// An iterator over logical lines.
pub(super) struct Lines<'s> {
    bytes: &'s [u8],
    at: usize,
}

/// The remainder of one line.
pub(super) struct Line<'s> {
    bytes: &'s [u8],
    at: usize,
    end: usize,
}

impl<'s> Lines<'s> {
    pub fn new(bytes: &'s [u8]) -> Self {
        Self { bytes, at: 0 }
    }
}

impl<'s> Iterator for Lines<'s> {
    type Item = Line<'s>;

    fn next(&mut self) -> Option<Line<'s>> {
        let start = self.at;
        if start >= self.bytes.len() {
            return None;
        }
        let mut end = start;
        loop {
            let rest = &self.bytes[end..];
            let newline = rest.iter().position(|&b| b == b'\n');
            end += newline.unwrap_or(rest.len());
            self.at = end + 1;
            let line = &self.bytes[start..end];
            let line = line.strip_suffix(b"\r").unwrap_or(line);
            if newline.is_none() || !line.ends_with(b"\\") {
                return Some(Line {
                    bytes: self.bytes,
                    at: start,
                    end,
                });
            }
            end += 1;
        }
    }
}

impl<'s> Line<'s> {
    /// The next word, unless a comment starts first.
    pub fn word(&mut self) -> Option<Token<'s>> {
        self.skip_space();
        let mut end = self.at;
        while end < self.end && !self.is_space(end) {
            end += 1;
        }
        let token = Token {
            bytes: &self.bytes[self.at..end],
            at: self.at,
        };
        if matches!(token.bytes, [] | [b'#', ..]) {
            self.at = self.end;
            return None;
        }
        self.at = end;
        Some(token)
    }

    /// The rest of the line; does not consume it.
    pub fn rest(&self) -> Token<'s> {
        let rest = &self.bytes[self.at..self.end];
        let bytes = rest.trim_ascii_start();
        let at = self.at + rest.len() - bytes.len();
        Token {
            bytes: bytes.trim_ascii_end(),
            at,
        }
    }

    fn skip_space(&mut self) {
        while self.at < self.end && self.is_space(self.at) {
            self.at += 1;
        }
    }

    fn is_space(&self, at: usize) -> bool {
        match self.bytes[at] {
            b' ' | b'\t'..=b'\r' => true,
            b'\\' => matches!(self.bytes.get(at + 1), Some(b'\n' | b'\r')),
            _ => false,
        }
    }
}
