//! Overrides: `KEY=VALUE` replaces one value of a native scene before it is checked.

use crate::import::error::ImportError;
use crate::import::source::{Source, quote};
use std::borrow::Cow;
use std::ops::Range;
use std::path::Path;
use toml::Spanned;
use toml::de::{DeTable, DeValue};

/// One override, located as if it followed the scene's text: that keeps the spans of its values distinct
/// from the file's.
pub(super) struct Override {
    /// `KEY=VALUE`.
    source: Source,
    /// Position of `source` in that combined text.
    start: usize,
    key: Vec<String>,
    /// The value in a TOML document, padded so that its spans refer to the combined text.
    document: String,
}

impl Override {
    /// The overrides in `texts`, behind a scene of `scene_length` bytes.
    pub fn parse_all(texts: &[String], scene_length: usize) -> Result<Vec<Self>, ImportError> {
        // One byte between the texts, so that the end of one is not the start of the next.
        let mut start = scene_length + 1;
        let mut overrides = Vec::new();
        for text in texts {
            overrides.push(Self::parse(text, start)?);
            start += text.len() + 1;
        }
        Ok(overrides)
    }

    fn parse(text: &str, start: usize) -> Result<Self, ImportError> {
        let bytes = text.as_bytes().to_vec();
        let source = Source::new("override refused", Path::new(""), bytes)?;
        let todo = "Write KEY=VALUE, such as camera.fov_y_deg=30";
        let Some((key, value)) = text.split_once('=') else {
            let why = format!("{} has no `=`", quote(text.as_bytes()));
            return Err(source.malformed(0..text.len(), why, todo));
        };
        let key: Vec<String> = key.trim().split('.').map(str::to_owned).collect();
        if key.iter().any(String::is_empty) || key.len() > super::MAX_DEPTH {
            let why = format!("{} is not a key", quote(key.join(".").as_bytes()));
            return Err(source.malformed(0..text.len(), why, todo));
        }
        let value_start = start + text.len() - value.len();
        // `start` is at least 1, and the key and its `=` take two more bytes: there is room for "v=".
        let document = format!("{}v={value}", " ".repeat(value_start - 2));
        Ok(Self {
            source,
            start,
            key,
            document,
        })
    }

    /// The value; a bare word is a string.
    fn value(&self) -> Result<Spanned<DeValue<'_>>, ImportError> {
        let start = self.document.len() - self.document.trim_start().len() + "v=".len();
        let text = &self.document[start..];
        let is_word = |c: char| c.is_ascii_alphanumeric() || "_-#".contains(c);
        let parsed = DeTable::parse(&self.document).ok().map(Spanned::into_inner);
        match parsed
            .filter(|table| table.len() == 1)
            .and_then(|mut table| table.remove("v"))
        {
            Some(value) => Ok(value),
            None if !text.is_empty() && text.chars().all(is_word) => Ok(Spanned::new(
                start..self.document.len(),
                DeValue::String(text.into()),
            )),
            None => {
                let why = format!("{} is not a TOML value", quote(text.as_bytes()));
                let todo = "Write it as in a scene file, strings in quotes";
                Err(self.malformed(start..self.document.len(), why, todo))
            }
        }
    }

    /// Sets the value in the scene, creating tables on the path to it if necessary.
    pub fn apply<'s>(&'s self, root: &mut DeTable<'s>) -> Result<(), ImportError> {
        let [tables @ .., last] = &self.key[..] else {
            return Ok(());
        };
        let value = self.value()?;
        let mut table = root;
        let mut segments = tables.iter();
        while let Some(segment) = segments.next() {
            let empty = || Spanned::new(value.span(), DeValue::Table(DeTable::new()));
            let mut inner = table
                .entry(Spanned::new(value.span(), Cow::Owned(segment.clone())))
                .or_insert_with(empty)
                .get_mut();
            while let DeValue::Array(array) = inner {
                let count = array.len();
                let Some(index) = segments.next() else {
                    return Err(self.refuse(format!("{} is a list", quote(segment.as_bytes()))));
                };
                inner = match index.parse::<usize>().ok().and_then(|i| array.get_mut(i)) {
                    Some(entry) => entry.get_mut(),
                    None => {
                        let entry = quote(format!("{segment}.{index}").as_bytes());
                        let why =
                            format!("there is no {entry}: the list has {count}, counted from 0");
                        return Err(self.refuse(why));
                    }
                };
            }
            let DeValue::Table(inner) = inner else {
                return Err(self.refuse(format!(
                    "{} is a value, not a table",
                    quote(segment.as_bytes())
                )));
            };
            table = inner;
        }
        let key = Spanned::new(
            self.start..self.start + self.source.bytes.len(),
            Cow::Owned(last.clone()),
        );
        // Remove it first: otherwise the map keeps the old key with its span.
        table.remove(last.as_str());
        table.insert(key, value);
        Ok(())
    }

    fn refuse(&self, why: String) -> ImportError {
        self.source.malformed(
            0..self.source.bytes.len(),
            why,
            "See the scene for its keys",
        )
    }

    /// Whether `span` lies in this override.
    pub fn contains(&self, span: &Range<usize>) -> bool {
        (self.start..=self.start + self.source.bytes.len()).contains(&span.start)
    }

    /// An error about `span`, which this override contains.
    pub fn malformed(&self, span: Range<usize>, why: String, todo: &str) -> ImportError {
        let local = span.start - self.start..span.end.saturating_sub(self.start);
        self.source.malformed(local, why, todo)
    }
}
