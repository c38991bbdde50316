//! The files that a scene may refer to, and errors about the others.

use super::error::{Fault, ImportError, fault};
use super::resolver::{FileError, Resolver};
use super::source::quote;
use glimray_scene::bytes::sizes;
use std::io;
use std::path::{Path, PathBuf};

/// Resolves the file names in a scene or in a file that it refers to.
pub(super) struct Files<'r> {
    /// `None` if it must not refer to files.
    resolver: Option<&'r dyn Resolver>,
    /// The folder of the referring file, to which names are relative.
    base: PathBuf,
}

/// Why a file may not be read.
#[derive(Clone)]
pub(super) enum Refusal {
    /// There is no such file.
    Missing(String),
    /// The file is outside the permitted folders.
    Outside(String),
    /// The name is invalid or is not that of a file that can be read.
    Unfit(String),
}

impl Refusal {
    /// Turns the refusal into an error about `what`; `malformed` adds the position.
    pub fn into_error(
        self,
        what: &str,
        malformed: impl FnOnce(String, &str) -> ImportError,
    ) -> ImportError {
        let (kind, why, todo): (fn(Box<Fault>) -> ImportError, _, _) = match self {
            Self::Outside(why) => (
                ImportError::OutsideFolder,
                why,
                "Name a file in it, or permit the other folder",
            ),
            Self::Missing(why) => (
                ImportError::Unreadable,
                why,
                "Check the name and the folder",
            ),
            Self::Unfit(why) => (
                ImportError::Unreadable,
                why,
                "Name a plain file in the scene folder",
            ),
        };
        let mut fault = malformed(why, todo).into_fault();
        fault.what = format!("{what} refused");
        kind(fault)
    }
}

impl<'r> Files<'r> {
    /// Files in the root of `resolver`.
    pub fn of(resolver: &'r dyn Resolver) -> Self {
        Self {
            resolver: Some(resolver),
            base: PathBuf::new(),
        }
    }

    /// No files at all.
    pub fn none() -> Self {
        Self {
            resolver: None,
            base: PathBuf::new(),
        }
    }

    /// Files referred to in the file at `path`, to which the scene itself refers.
    pub fn named_in(&self, path: &Path) -> Self {
        Self {
            resolver: self.resolver,
            base: path.parent().unwrap_or(Path::new("")).to_owned(),
        }
    }

    /// Resolves the plain file `name`. Both kinds of slashes separate folders.
    pub fn resolve(&self, name: &str) -> Result<PathBuf, Refusal> {
        let quoted = quote(name.as_bytes());
        let Some(resolver) = self.resolver else {
            return Err(Refusal::Unfit(format!(
                "{quoted}: a built-in scene has no folder"
            )));
        };
        if name.trim().is_empty() || name.contains('\0') || name.len() > 4096 {
            return Err(Refusal::Unfit(format!("{quoted} is not a file name")));
        }
        let found = match is_url_or_drive(name) {
            true => Err(FileError::Outside),
            false => resolver.resolve(&self.base, Path::new(&name.replace('\\', "/"))),
        };
        found.map_err(|error| match error {
            FileError::Missing => Refusal::Missing(format!("{quoted} does not exist")),
            FileError::Outside => {
                Refusal::Outside(format!("{quoted} points outside the scene folder"))
            }
            FileError::IsFolder | FileError::NotPlain => {
                Refusal::Unfit(format!("{quoted} is not a plain file"))
            }
            FileError::Failed(error) => Refusal::Unfit(format!("{quoted}: {}", reason(&error))),
            error => Refusal::Unfit(format!("{quoted}: {error}")),
        })
    }

    /// As [`Self::resolve`]; but if there is no such file, or it may not be read, as the path of another machine, the
    /// file of that name beside the referring one. Also returns whether it was found there.
    pub fn resolve_or_beside(&self, name: &str) -> Result<(PathBuf, bool), Refusal> {
        self.resolve(name).map(|path| (path, false)).or_else(|why| {
            let last = name.rsplit(['/', '\\']).next().unwrap_or_default();
            match last.len() < name.len() && !matches!(last, "" | "." | "..") {
                true => self.resolve(last).map(|path| (path, true)).map_err(|_| why),
                false => Err(why),
            }
        })
    }

    /// Reads the file at `path`, which was resolved.
    ///
    /// # Errors
    /// The file cannot be read, or exceeds `limit` bytes or the available memory.
    pub fn read(&self, path: &Path, limit: u64) -> Result<Vec<u8>, ImportError> {
        let read = match self.resolver {
            Some(resolver) => resolver.read(path, limit),
            None => Err(FileError::Missing),
        };
        read.map_err(|error| unreadable(path, &error, limit))
    }
}

/// The error for the file at `path`, whose size limit is `limit`.
pub(super) fn unreadable(path: &Path, error: &FileError, limit: u64) -> ImportError {
    let unreadable = |why: &str, todo: &str| {
        ImportError::Unreadable(fault("cannot read the file", path, why, todo))
    };
    let too_big =
        |why: &str, todo: &str| ImportError::TooBig(fault("file too big", path, why, todo));
    const CHECK: &str = "Check the path and its permissions";
    match error {
        FileError::Missing => unreadable("no such file or folder", CHECK),
        FileError::Failed(error) => unreadable(&reason(error), CHECK),
        FileError::IsFolder | FileError::NotPlain => unreadable(&error.to_string(), "Name a file"),
        FileError::Outside => unreadable(&error.to_string(), "Name a file in the scene folder"),
        FileError::TooLong { length } => {
            let [length, limit] = sizes([*length, limit]);
            too_big(
                &format!("{length}, but at most {limit} are read"),
                "Split the scene, or keep geometry in OBJ files",
            )
        }
        FileError::NoMemory { .. } => too_big(
            &error.to_string(),
            "Use a smaller file, or raise the memory limit (`ulimit -v`) if there is one",
        ),
    }
}

/// `C:…`, `http://…`, `file:…`: letters or digits before the first colon.
fn is_url_or_drive(name: &str) -> bool {
    name.split_once(':').is_some_and(|(scheme, _)| {
        !scheme.is_empty() && scheme.bytes().all(|b| b.is_ascii_alphanumeric())
    })
}

pub(super) fn reason(error: &io::Error) -> String {
    match error.kind() {
        io::ErrorKind::NotFound => "no such file or folder".to_owned(),
        io::ErrorKind::PermissionDenied => "permission denied".to_owned(),
        io::ErrorKind::NotADirectory => "part of the path is not a folder".to_owned(),
        _ => error.to_string(),
    }
}
