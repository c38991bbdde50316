//! The companion files of a scene file.

use super::ExportFile;

/// Companion files of a scene file.
pub(super) struct Beside<'a> {
    stem: &'a str,
    is_taken: &'a dyn Fn(&str, &[u8]) -> bool,
    pub files: Vec<ExportFile>,
}

impl<'a> Beside<'a> {
    pub fn new(stem: &'a str, is_taken: &'a dyn Fn(&str, &[u8]) -> bool) -> Self {
        Self {
            stem,
            is_taken,
            files: Vec::new(),
        }
    }

    /// Adds a file and returns its name.
    pub fn add(&mut self, what: &str, ending: &str, bytes: Vec<u8>) -> String {
        let plain = |c: char| {
            if c.is_alphanumeric() || c == '-' {
                c
            } else {
                '_'
            }
        };
        let what: String = what.chars().take(64).map(plain).collect();
        let stem: String = self.stem.chars().map(plain).collect();
        let mut number = 1;
        let name = loop {
            let name = match number {
                1 => format!("{stem}-{what}.{ending}"),
                _ => format!("{stem}-{what}-{number}.{ending}"),
            };
            let is_ours = self
                .files
                .iter()
                .any(|file| file.name.eq_ignore_ascii_case(&name));
            if !is_ours && !(self.is_taken)(&name, &bytes) {
                break name;
            }
            number += 1;
        };
        self.files.push(ExportFile {
            name: name.clone(),
            bytes,
        });
        name
    }
}
