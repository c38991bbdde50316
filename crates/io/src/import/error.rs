//! Errors of importers and their text.

use glimray_scene::text::one_line;
use std::fmt;
use std::ops::Range;
use std::path::{Path, PathBuf};

/// Why a scene was refused. The variants differ in how a program may react; the text is in the [`Fault`].
/// `Display` is one line: `WHAT (FILE:LINE:COLUMN): WHY. WHAT TO DO.`
#[derive(Debug, thiserror::Error)]
pub enum ImportError {
    /// A file is missing, is not a plain file, or cannot be read.
    #[error("{0}")]
    Unreadable(Box<Fault>),
    /// The file extension is not supported.
    #[error("{0}")]
    UnknownFormat(Box<Fault>),
    /// A scene refers to a file outside its folder.
    #[error("{0}")]
    OutsideFolder(Box<Fault>),
    /// The contents do not conform to the format.
    #[error("{0}")]
    Malformed(Box<Fault>),
    /// Reading the file would exceed the memory budget or the size limit.
    #[error("{0}")]
    TooBig(Box<Fault>),
}

/// One error in its parts. A program may change the wording before it shows the fault.
#[derive(Clone, Debug)]
pub struct Fault {
    /// The failure, such as "bad scene".
    pub what: String,
    /// The file at fault; empty if an override is ([`super::Options::overrides`]).
    pub path: PathBuf,
    /// Position in the file, or in the text of the override; `None` if the whole file is at fault.
    pub position: Option<Position>,
    /// Why, as a clause without a full stop.
    pub why: String,
    /// The remedy for the user, as a sentence without a full stop.
    pub todo: String,
    /// The line at fault; `None` if `position` is.
    pub excerpt: Option<Excerpt>,
}

/// A position in a text file, counted from 1; columns count characters.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Position {
    /// From the top.
    pub line: usize,
    /// From the left.
    pub column: usize,
}

/// The part of the line around the fault: without control characters, `…` where it is truncated.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Excerpt {
    /// The text.
    pub text: String,
    /// Bytes of `text` to mark.
    pub span: Range<usize>,
}

/// A fault that concerns a whole file.
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
    /// Whether the scene was refused because of its size.
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

    /// Whether an override is at fault rather than a file.
    pub fn is_in_override(&self) -> bool {
        self.path.as_os_str().is_empty()
    }

    /// The file at fault, or "override", on one line.
    pub fn place(&self) -> String {
        match self.is_in_override() {
            true => "override".to_owned(),
            false => one_line(&self.path.to_string_lossy()),
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
        write!(
            f,
            "): {}{stop} {}.",
            one_line(&self.why),
            one_line(&self.todo)
        )
    }
}
