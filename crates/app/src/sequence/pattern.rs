//! Name patterns of numbered files: `walk_%04d.png` or `walk_####.png`.

use crate::inputs::is_same;
use std::path::{Path, PathBuf};

/// A file name with a placeholder for a number, in a folder.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Pattern {
    /// The pattern as given.
    text: PathBuf,
    folder: PathBuf,
    before: String,
    /// Minimum number of digits.
    digits: usize,
    after: String,
}

impl Pattern {
    /// Parses a pattern: its name has one `%d`, `%04d` or run of `#` for the number; `%%` is a percent sign.
    /// With a `%d`, a `#` is an ordinary character.
    ///
    /// # Errors
    /// The reason and the remedy, as the end of a sentence.
    pub fn parse(path: &Path) -> Result<Self, String> {
        let name = path.file_name().and_then(|name| name.to_str());
        let name = name.ok_or("the name is not valid Unicode. Choose another one.")?;
        let folder = path.parent().unwrap_or(Path::new(""));
        let (before, digits, after) = match percent(name)? {
            Found::One(parts) => parts,
            Found::None(plain) => hashes(&plain)?,
        };
        Ok(Self {
            text: path.into(),
            folder: folder.into(),
            before,
            digits,
            after,
        })
    }

    /// The pattern `NAME_%04d.png` in `folder`.
    pub fn in_folder(folder: &Path, before: &str, after: &str) -> Self {
        Self {
            text: folder.join(format!("{before}%04d{after}")),
            folder: folder.into(),
            before: before.into(),
            digits: 4,
            after: after.into(),
        }
    }

    /// The pattern as given.
    pub fn text(&self) -> &Path {
        &self.text
    }

    /// The folder of the files; never empty.
    pub fn folder(&self) -> &Path {
        if self.folder.as_os_str().is_empty() {
            Path::new(".")
        } else {
            &self.folder
        }
    }

    /// The name of file `number`, without its folder.
    pub fn name(&self, number: u32) -> String {
        let Self {
            before,
            digits,
            after,
            ..
        } = self;
        format!("{before}{number:0digits$}{after}")
    }

    /// The path of file `number`.
    pub fn path(&self, number: u32) -> PathBuf {
        self.folder.join(self.name(number))
    }

    /// Whether `path` is a file of the pattern, with any number, or the journal.
    pub fn names(&self, path: &Path) -> bool {
        let name = path.file_name().and_then(|name| name.to_str());
        let number = name
            .and_then(|name| name.strip_prefix(&self.before))
            .and_then(|name| name.strip_suffix(&self.after))
            .and_then(|number| number.parse().ok());
        let file = number.map(|number| self.path(number));
        file.into_iter()
            .chain([self.journal()])
            .any(|file| is_same(&file, path))
    }

    /// The path of the files' journal.
    pub fn journal(&self) -> PathBuf {
        let Self { before, after, .. } = self;
        self.folder.join(format!("{before}journal{after}.jsonl"))
    }
}

enum Found {
    One((String, usize, String)),
    /// The name with `%%` read as `%`.
    None(String),
}

fn percent(name: &str) -> Result<Found, String> {
    let mut before = None;
    let mut text = String::new();
    let mut rest = name;
    while let Some(at) = rest.find('%') {
        text.push_str(&rest[..at]);
        rest = &rest[at + 1..];
        if let Some(after) = rest.strip_prefix('%') {
            text.push('%');
            rest = after;
            continue;
        }
        let (digits, after) = placeholder(rest).ok_or_else(|| {
            format!(
                "`%{}` is not a placeholder. Write %04d for the frame number, or %% for a percent sign.",
                rest.chars().next().map(String::from).unwrap_or_default()
            )
        })?;
        if before.is_some() {
            return Err("the name has more than one placeholder. Keep one.".into());
        }
        before = Some((std::mem::take(&mut text), digits));
        rest = after;
    }
    text.push_str(rest);
    Ok(match before {
        Some((before, digits)) => Found::One((before, digits, text)),
        None => Found::None(text),
    })
}

/// Parses `d`, `4d` or `04d` after a percent sign: the minimum number of digits, and the rest of the name.
fn placeholder(rest: &str) -> Option<(usize, &str)> {
    let (width, after) = rest.split_once('d')?;
    let digits = match width.strip_prefix('0').unwrap_or(width) {
        "" => 1,
        // More digits than a number can have are an error.
        width => width
            .parse()
            .ok()
            .filter(|digits| (1..=18).contains(digits))?,
    };
    Some((digits, after))
}

fn hashes(name: &str) -> Result<(String, usize, String), String> {
    let start = name
        .find('#')
        .ok_or("the name has no placeholder for the frame number.")?;
    let rest = &name[start..];
    let digits = rest.find(|c| c != '#').unwrap_or(rest.len());
    let after = &rest[digits..];
    if after.contains('#') {
        return Err("the name has more than one placeholder. Keep one.".into());
    }
    if digits > 18 {
        return Err("the number has too many digits. Write fewer #.".into());
    }
    Ok((name[..start].into(), digits, after.into()))
}
