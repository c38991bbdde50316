//! Values of a text file that cannot be used: they are repaired or left out, counted, and reported. A file is refused
//! only when it has nothing left to show, with the message for the first of them.

use super::error::ImportError;
use super::notes::Notes;
use super::number;
use super::source::{Source, Token};
use std::ops::Range;

pub(super) const NOT_NUMBERS: &str = "values that are not finite numbers skipped";
pub(super) const NOT_FINITE: &str = "values that are not finite, skipped or set to 0";
pub(super) const NEGATIVE: &str = "negative numbers set to 0";
pub(super) const CLAMPED: &str = "numbers out of range clamped";

/// The faults of one file.
#[derive(Default)]
pub(super) struct Faults {
    kinds: Vec<Kind>,
    first: Option<ImportError>,
}

struct Kind {
    key: &'static str,
    what: &'static str,
    count: usize,
    /// The line of the first such value.
    line: usize,
}

impl Faults {
    /// Counts a fault in a value of `key` at `span`. `what` says in the plural what became of it. `refusal` is the
    /// message if the file is refused for it.
    pub fn add(
        &mut self,
        (key, what): (&'static str, &'static str),
        source: &Source,
        span: Range<usize>,
        refusal: impl FnOnce() -> (String, &'static str),
    ) {
        let is_same = |kind: &&mut Kind| kind.key == key && kind.what == what;
        if let Some(kind) = self.kinds.iter_mut().find(is_same) {
            kind.count += 1;
            return;
        }
        // Finding a line takes time in proportion to the file, so it is done once for each kind.
        self.kinds.push(Kind {
            key,
            what,
            count: 1,
            line: source.position(span.start).line,
        });
        self.first.get_or_insert_with(|| {
            let (why, todo) = refusal();
            source.malformed(span, why, todo)
        });
    }

    /// The number in `word`, a value of `key`. A decimal comma counts as a point. `None` if it is not a number in the
    /// range of f32.
    pub fn number(&mut self, key: &'static str, source: &Source, word: Token) -> Option<f64> {
        if let Some(number) = number::read(word.bytes) {
            return Some(number);
        }
        let with_point: Vec<u8> = (word.bytes.iter().take(64))
            .map(|&b| if b == b',' { b'.' } else { b })
            .collect();
        let number = number::read(&with_point).filter(|_| word.bytes.len() <= 64);
        let what = match number {
            Some(_) => "decimal commas read as points",
            None => NOT_NUMBERS,
        };
        self.add((key, what), source, word.span(), || number::refusal(word));
        number
    }

    /// As [`Self::number`] for formats that people write by hand: NaN if it is out of range or not finite, and an error if
    /// it is not a number, which is a typing error.
    pub fn number_or_nan(
        &mut self,
        key: &'static str,
        source: &Source,
        word: Token,
    ) -> Result<f64, ImportError> {
        match number::read(word.bytes) {
            Some(number) => Ok(number),
            None if number::is_nonfinite(word.bytes) => {
                self.add((key, NOT_FINITE), source, word.span(), || {
                    number::refusal(word)
                });
                Ok(f64::NAN)
            }
            None => number::parse(source, word),
        }
    }

    /// Counts a negative number in `word`, a value of `key`, and returns it with 0 for the smallest. NaN stays.
    pub fn not_negative(
        &mut self,
        key: &'static str,
        source: &Source,
        word: Token,
        number: f64,
    ) -> f64 {
        if number < 0.0 {
            self.add((key, NEGATIVE), source, word.span(), || {
                let why = format!("{} in `{key}` is negative", word.quote());
                (why, "Write 0 or more")
            });
            return 0.0;
        }
        number
    }

    /// As [`Self::number`], with negative numbers set to 0.
    pub fn at_least_zero(
        &mut self,
        key: &'static str,
        source: &Source,
        word: Token,
    ) -> Option<f64> {
        let number = self.number(key, source, word)?;
        Some(self.not_negative(key, source, word, number))
    }

    /// The message for the first fault, if there is one.
    pub fn refusal(&mut self) -> Option<ImportError> {
        self.first.take()
    }

    /// Adds a note on each kind of fault to `notes`; `file` names the file if it is not the scene's own.
    pub fn note(self, notes: &mut Notes, file: Option<&str>) {
        let of = file.map_or(String::new(), |file| format!(" of {file}"));
        for Kind {
            key,
            what,
            count,
            line,
        } in self.kinds
        {
            let first = if count > 1 { "first in " } else { "" };
            notes.add(key, || {
                format!("`{key}`: {what}: {count} ({first}line {line}{of})")
            });
        }
    }
}
