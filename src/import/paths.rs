//! Confined file access: what a scene names must lie in its folder, be a plain file, and fit.

use super::error::{Fault, ImportError, fault};
use super::source::quote;
use std::cell::RefCell;
use std::fs::{self, File};
use std::io::{self, Read};
use std::path::{Component, Path, PathBuf};
use std::rc::Rc;

/// How many files are kept in mind; nobody watches more.
const MAX_SEEN: usize = 4096;

/// Every file that was looked for, each once, up to [`MAX_SEEN`].
#[derive(Clone, Default)]
pub(super) struct Seen(Rc<RefCell<Vec<PathBuf>>>);

impl Seen {
    /// Notes a file.
    pub fn note(&self, path: &Path) {
        let mut paths = self.0.borrow_mut();
        if paths.len() < MAX_SEEN && !paths.iter().any(|known| known == path) {
            paths.push(path.to_owned());
        }
    }

    /// All that were noted, in their order.
    pub fn paths(&self) -> Vec<PathBuf> {
        self.0.borrow().clone()
    }
}

/// The files that a scene, or a file of it, may name.
pub(super) struct Files {
    /// The scene's folder, resolved; `None` when it may name no files at all.
    folder: Option<PathBuf>,
    /// What names are relative to: the folder of the file that they stand in.
    base: PathBuf,
    allowed: Vec<PathBuf>,
    seen: Seen,
}

/// Why a named file may not be read.
pub(super) enum Refusal {
    /// There is no such file.
    Missing(String),
    /// It may not be asked for.
    Outside(String),
    /// It is no name, or there is something else than a file that can be read.
    Unfit(String),
}

impl Refusal {
    /// The refusal as an error about `what`, which `malformed` puts in its place.
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

impl Files {
    /// Those in the folder of the scene at `path` and in `allow_dirs`.
    ///
    /// # Errors
    /// One of the folders does not exist.
    pub fn beside(path: &Path, allow_dirs: &[PathBuf], seen: &Seen) -> Result<Self, ImportError> {
        let resolve = |what: &str, dir: &Path| {
            dir.canonicalize().map_err(|error| {
                let todo = "Check that the folder exists";
                ImportError::Unreadable(fault(what, dir, &reason(&error), todo))
            })
        };
        let folder = resolve("cannot find the scene folder", parent(path))?;
        let allowed = allow_dirs
            .iter()
            .map(|dir| resolve("cannot use the permitted folder", dir));
        Ok(Self {
            base: folder.clone(),
            folder: Some(folder),
            allowed: allowed.collect::<Result<_, _>>()?,
            seen: seen.clone(),
        })
    }

    /// None.
    pub fn none() -> Self {
        Self {
            folder: None,
            base: PathBuf::new(),
            allowed: Vec::new(),
            seen: Seen::default(),
        }
    }

    /// Those that the file at `path`, itself named by the scene, may name.
    pub fn named_in(&self, path: &Path) -> Self {
        Self {
            folder: self.folder.clone(),
            base: parent(path).to_owned(),
            allowed: self.allowed.clone(),
            seen: self.seen.clone(),
        }
    }

    /// The plain file that is called `name`. Both kinds of slashes part folders.
    pub fn resolve(&self, name: &str) -> Result<PathBuf, Refusal> {
        let quoted = quote(name.as_bytes());
        let Some(folder) = &self.folder else {
            return Err(Refusal::Unfit(format!(
                "{quoted}: a built-in scene has no folder"
            )));
        };
        let outside = || Refusal::Outside(format!("{quoted} points outside the scene folder"));
        if name.trim().is_empty() || name.contains('\0') || name.len() > 4096 {
            return Err(Refusal::Unfit(format!("{quoted} is not a file name")));
        }
        if is_url_or_drive(name) {
            return Err(outside());
        }
        // Decided by name alone, so that nothing outside is even looked at.
        let path = PathBuf::from(name.replace('\\', "/"));
        let goes_down = |c| matches!(c, Component::Normal(_) | Component::CurDir);
        let wanted = normalized(&self.base.join(&path));
        if !(path.components().all(goes_down) || self.is_allowed(&wanted)) {
            return Err(outside());
        }
        let real = wanted.canonicalize().map_err(|error| {
            self.seen.note(&wanted);
            match error.kind() {
                io::ErrorKind::NotFound => Refusal::Missing(format!("{quoted} does not exist")),
                _ => Refusal::Unfit(format!("{quoted}: {}", reason(&error))),
            }
        })?;
        // Decided again once links are resolved.
        if !(real.starts_with(folder) || self.is_allowed(&real)) {
            return Err(outside());
        }
        self.seen.note(&real);
        if !real.is_file() {
            return Err(Refusal::Unfit(format!("{quoted} is not a plain file")));
        }
        Ok(real)
    }

    fn is_allowed(&self, path: &Path) -> bool {
        self.allowed.iter().any(|dir| path.starts_with(dir))
    }
}

/// The bytes of the plain file at `path`.
///
/// # Errors
/// It is no plain file, cannot be read, or is longer than `limit` bytes or than the memory.
pub(super) fn read(path: &Path, limit: u64) -> Result<Vec<u8>, ImportError> {
    let unreadable = |why: &str, todo: &str| {
        ImportError::Unreadable(fault("cannot read the file", path, why, todo))
    };
    let failed = |error: io::Error| {
        let todo = "Check the path and its permissions";
        unreadable(&reason(&error), todo)
    };
    // Asked before opening: opening a pipe would wait for a writer.
    let metadata = fs::metadata(path).map_err(failed)?;
    if !metadata.is_file() {
        let what = if metadata.is_dir() {
            "it is a folder"
        } else {
            "it is not a plain file"
        };
        return Err(unreadable(what, "Name a scene file"));
    }
    let too_big = |length: u64| {
        let why = format!("{length} bytes, but at most {limit} are read");
        let todo = "Split the scene, or keep geometry in OBJ files";
        ImportError::TooBig(fault("file too big", path, &why, todo))
    };
    if metadata.len() > limit {
        return Err(too_big(metadata.len()));
    }
    let mut bytes = Vec::new();
    let capacity = usize::try_from(metadata.len()).unwrap_or(usize::MAX);
    bytes.try_reserve_exact(capacity).map_err(|_| {
        let why = format!("{capacity} bytes do not fit into the memory");
        let todo = "Use a smaller file, or raise the memory limit (`ulimit -v`) if there is one";
        ImportError::TooBig(fault("file too big", path, &why, todo))
    })?;
    // The length may be a lie, as in /proc.
    let mut file = File::open(path).map_err(failed)?.take(limit + 1);
    file.read_to_end(&mut bytes).map_err(failed)?;
    match bytes.len() as u64 > limit {
        true => Err(too_big(bytes.len() as u64)),
        false => Ok(bytes),
    }
}

/// `C:…`, `http://…`, `file:…`: a colon after nothing but letters.
fn is_url_or_drive(name: &str) -> bool {
    name.split_once(':').is_some_and(|(scheme, _)| {
        !scheme.is_empty() && scheme.bytes().all(|b| b.is_ascii_alphanumeric())
    })
}

fn parent(path: &Path) -> &Path {
    match path.parent() {
        Some(parent) if parent != Path::new("") => parent,
        _ => Path::new("."),
    }
}

/// `path` with its `.` and `..` carried out by name alone.
fn normalized(path: &Path) -> PathBuf {
    let mut result = PathBuf::new();
    for component in path.components() {
        match component {
            Component::CurDir => {}
            Component::ParentDir => {
                result.pop();
            }
            other => result.push(other),
        }
    }
    result
}

fn reason(error: &io::Error) -> String {
    match error.kind() {
        io::ErrorKind::NotFound => "no such file or folder".to_owned(),
        io::ErrorKind::PermissionDenied => "permission denied".to_owned(),
        io::ErrorKind::NotADirectory => "part of the path is not a folder".to_owned(),
        _ => error.to_string(),
    }
}
