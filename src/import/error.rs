//! What can go wrong on the way from a file to a scene, and how it reads.

use std::fmt;
use std::ops::Range;
use std::path::{Path, PathBuf};

/// Why a scene was refused. The kinds differ in what a program may want to do about them; the text
/// is in the [`Fault`], and `Display` is one line: `WHAT (FILE:LINE:COLUMN): WHY. WHAT TO DO.`
#[derive(Debug, thiserror::Error)]
pub enum ImportError {
    /// A file is missing, is no file, or the system would not let us read it.
    #[error("{0}")]
    Unreadable(Box<Fault>),
    /// No importer knows the file's ending.
    #[error("{0}")]
    UnknownFormat(Box<Fault>),
    /// A scene names a file outside its folder.
    #[error("{0}")]
    OutsideFolder(Box<Fault>),
    /// The contents are not what the format says.
    #[error("{0}")]
    Malformed(Box<Fault>),
    /// Reading on would take more memory than we allow.
    #[error("{0}")]
    TooBig(Box<Fault>),
}

/// One error, in the parts that a report is made of. A program may put its own words into them before
/// it shows the fault.
#[derive(Clone, Debug)]
pub struct Fault {
    /// What failed: "bad scene".
    pub what: String,
    /// The file at fault; empty where an override is ([`super::Options::overrides`]).
    pub path: PathBuf,
    /// In the file, or in the text of the override. Absent when the whole file is at fault.
    pub position: Option<Position>,
    /// Why, as a clause without a full stop.
    pub why: String,
    /// What the user can do, as a sentence without a full stop.
    pub todo: String,
    /// The line at fault. Absent where `position` is.
    pub excerpt: Option<Excerpt>,
}

/// A place in a text file, counted from 1; columns count characters.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Position {
    /// From the top.
    pub line: usize,
    /// From the left.
    pub column: usize,
}

/// The line at fault, as far as it is near to the fault: without control characters, `…` in place of
/// what is cut off.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Excerpt {
    /// The text.
    pub text: String,
    /// Bytes of `text` to point at.
    pub span: Range<usize>,
}

/// A fault of a whole file.
pub(super) fn fault(what: &str, path: &Path, why: &str, todo: &str) -> Box<Fault> {
    Box::new(Fault {
        what: what.to_owned(),
        path: path.to_owned(),
        position: None,
        why: why.to_owned(),
        todo: todo.to_owned(),
        excerpt: None,
    })
}

impl ImportError {
    /// Whether the scene was refused for its size alone.
    pub fn is_too_big(&self) -> bool {
        matches!(self, Self::TooBig(_))
    }

    /// The parts of the message.
    pub fn fault(&self) -> &Fault {
        match self {
            Self::Unreadable(fault)
            | Self::UnknownFormat(fault)
            | Self::OutsideFolder(fault)
            | Self::Malformed(fault)
            | Self::TooBig(fault) => fault,
        }
    }

    pub(super) fn into_fault(self) -> Box<Fault> {
        match self {
            Self::Unreadable(fault)
            | Self::UnknownFormat(fault)
            | Self::OutsideFolder(fault)
            | Self::Malformed(fault)
            | Self::TooBig(fault) => fault,
        }
    }
}

impl Fault {
    pub(super) fn at(mut self: Box<Self>, position: Position, excerpt: Excerpt) -> Box<Self> {
        self.position = Some(position);
        self.excerpt = Some(excerpt);
        self
    }

    /// Whether an override is at fault, not a file.
    pub fn is_in_override(&self) -> bool {
        self.path.as_os_str().is_empty()
    }

    /// The file at fault, or "override", as text that keeps to one line.
    pub fn place(&self) -> String {
        match self.is_in_override() {
            true => "override".to_owned(),
            false => one_line(&self.path),
        }
    }
}

impl fmt::Display for Fault {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{} ({}", self.what, self.place())?;
        if let Some(Position { line, column }) = self.position {
            write!(f, ":{line}:{column}")?;
        }
        let stop = if self.why.ends_with('?') { "" } else { "." };
        write!(f, "): {}{stop} {}.", self.why, self.todo)
    }
}

/// A path as text that keeps to one line, whatever characters are in it.
fn one_line(path: &Path) -> String {
    let visible = |c: char| if c.is_control() { '\u{fffd}' } else { c };
    path.to_string_lossy().chars().map(visible).collect()
}
