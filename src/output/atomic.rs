//! Bytes → file, so that a reader, a crash or a full disk never sees half of it: a new file beside
//! the old one, written, synced, renamed over it; then the folder synced and the result looked at.

use super::{Litter, OutputError};
use std::fs::{self, File, OpenOptions, Permissions};
use std::io::{self, ErrorKind, Seek, Write};
use std::path::{Path, PathBuf};
use std::time::Duration;
use tempfile::NamedTempFile;

/// Between a file's name and the process that was writing it.
const PART: &str = ".part-";

/// Names of files end at 255 bytes nearly everywhere; this leaves room for what is put round them.
const MAX_STEM: usize = 200;

/// Links in a row that lead to a file that is yet to be made. Systems give up at about as many.
const MAX_LINKS: usize = 40;

/// Where bytes for a path really go.
enum Target {
    /// A file, new or old, to be put in place by renaming.
    File {
        /// With symbolic links resolved, so that a link survives and its file is replaced or made.
        path: PathBuf,
        /// Of the file that is there.
        permissions: Option<Permissions>,
    },
    /// A pipe, a device or a socket: to be written to as it is.
    Stream,
}

/// A part of a file beside its place, and its entry among what is cleared away with the process.
type Part = (NamedTempFile, Litter);

pub(super) fn check(path: &Path, clobber: bool, follow_links: bool) -> Result<(), OutputError> {
    if let Target::File { path: file, .. } = target(path, clobber, follow_links)? {
        remove_leftovers(&file);
        part_file(&file).map_err(|source| failed(path, source))?;
    }
    Ok(())
}

pub(super) fn write(
    path: &Path,
    bytes: &[u8],
    clobber: bool,
    follow_links: bool,
) -> Result<(), OutputError> {
    write_with(path, clobber, follow_links, |file| {
        file.write_all(bytes).map_err(|source| failed(path, source))
    })
}

/// Like [`write`], for what is too long to be held in memory: `fill` writes it bit by bit. Its
/// errors leave what was at `path` as it was.
pub(super) fn write_with(
    path: &Path,
    clobber: bool,
    follow_links: bool,
    fill: impl FnOnce(&mut dyn Write) -> Result<(), OutputError>,
) -> Result<(), OutputError> {
    match target(path, clobber, follow_links)? {
        Target::Stream => {
            let mut stream = OpenOptions::new()
                .write(true)
                .open(path)
                .map_err(|source| failed(path, source))?;
            fill(&mut stream)?;
            stream.flush().map_err(|source| failed(path, source))
        }
        Target::File {
            path: file,
            permissions,
        } => {
            let mut part = part_file(&file).map_err(|source| failed(path, source))?;
            fill(&mut part.0)?;
            let length =
                replace(&file, part, permissions, clobber).map_err(|source| {
                    match source.kind() {
                        ErrorKind::AlreadyExists if !clobber => {
                            OutputError::Exists { path: path.into() }
                        }
                        _ => failed(path, source),
                    }
                })?;
            verify(path, &file, length)
        }
    }
}

/// Refuses a link, unless it is one to a pipe or a device.
pub(super) fn check_no_link(path: &Path) -> Result<(), OutputError> {
    let is_link = fs::symlink_metadata(path).is_ok_and(|found| found.is_symlink());
    let is_stream = || fs::metadata(path).is_ok_and(|found| !found.is_file() && !found.is_dir());
    match is_link && !is_stream() {
        true => Err(OutputError::Link { path: path.into() }),
        false => Ok(()),
    }
}

fn target(path: &Path, clobber: bool, follow_links: bool) -> Result<Target, OutputError> {
    if !follow_links {
        check_no_link(path)?;
    }
    let found = match fs::metadata(path) {
        Ok(found) => found,
        Err(error) if error.kind() == ErrorKind::NotFound => return new_target(path),
        Err(source) => return Err(failed(path, source)),
    };
    if found.is_dir() {
        return Err(OutputError::IsFolder { path: path.into() });
    }
    if !found.is_file() {
        return Ok(Target::Stream);
    }
    if !clobber {
        return Err(OutputError::Exists { path: path.into() });
    }
    if found.permissions().readonly() {
        return Err(OutputError::Protected { path: path.into() });
    }
    Ok(Target::File {
        path: fs::canonicalize(path).map_err(|source| failed(path, source))?,
        permissions: Some(found.permissions()),
    })
}

/// Of a path at which there is nothing yet.
fn new_target(path: &Path) -> Result<Target, OutputError> {
    let ends_in_separator = path.to_string_lossy().ends_with(std::path::is_separator);
    let file = end_of_links(path).map_err(|source| failed(path, source))?;
    let folder = if ends_in_separator {
        path
    } else {
        folder_of(&file)
    };
    if path.file_name().is_none() || !folder.exists() {
        return Err(OutputError::MissingFolder {
            path: path.into(),
            folder: folder.into(),
        });
    }
    Ok(Target::File {
        path: file,
        permissions: None,
    })
}

/// The file, which does not exist, that a path leads to over any links.
fn end_of_links(path: &Path) -> io::Result<PathBuf> {
    let mut path = path.to_owned();
    for _ in 0..MAX_LINKS {
        match fs::read_link(&path) {
            Ok(next) => path = folder_of(&path).join(next),
            Err(_) => return Ok(path),
        }
    }
    Err(ErrorKind::InvalidFilename.into())
}

/// Puts a part that has been filled in its place, and returns how many bytes went into it.
fn replace(
    path: &Path,
    (mut part, litter): Part,
    permissions: Option<Permissions>,
    clobber: bool,
) -> io::Result<u64> {
    if let Some(permissions) = permissions {
        part.as_file().set_permissions(permissions)?;
    }
    part.flush()?;
    part.as_file().sync_all()?;
    let length = part.stream_position()?;
    // An error from here on drops, and thereby removes, the part.
    if clobber {
        part.persist(path)?;
    } else {
        part.persist_noclobber(path)?;
    }
    drop(litter);
    sync_folder(folder_of(path));
    Ok(length)
}

/// A new empty file beside `path`, gone when it is dropped.
fn part_file(path: &Path) -> io::Result<Part> {
    let prefix = format!("{}{}-", part_prefix(path), std::process::id());
    let mut builder = tempfile::Builder::new();
    builder.prefix(&prefix);
    // Temporary files are private by default; this one is to become an ordinary file, for which
    // the system takes the umask off.
    #[cfg(unix)]
    builder.permissions(std::os::unix::fs::PermissionsExt::from_mode(0o666));
    let make = || builder.tempfile_in(folder_of(path));
    Litter::make(make, |part| part.path().to_owned())
}

fn part_prefix(path: &Path) -> String {
    let name = path.file_name().unwrap_or_default().to_string_lossy();
    let end = name.floor_char_boundary(MAX_STEM);
    format!(".{}{PART}", &name[..end])
}

/// Removes the parts that killed processes left for `path`. What cannot be removed stays.
fn remove_leftovers(path: &Path) {
    let prefix = part_prefix(path);
    let Ok(entries) = fs::read_dir(folder_of(path)) else {
        return;
    };
    for entry in entries.flatten() {
        let name = entry.file_name();
        let writer = name
            .to_str()
            .and_then(|name| name.strip_prefix(&prefix))
            .and_then(|rest| rest.split_once('-'))
            .and_then(|(process, _)| process.parse::<u32>().ok());
        if writer.is_some_and(|process| is_abandoned(process, &entry)) {
            let _ = fs::remove_file(entry.path());
        }
    }
}

/// Whether nobody can still be writing the file. Without a /proc to ask, a day settles it.
fn is_abandoned(process: u32, entry: &fs::DirEntry) -> bool {
    let processes = Path::new("/proc");
    if processes.join("self").exists() {
        return !processes.join(process.to_string()).exists();
    }
    entry
        .metadata()
        .and_then(|found| found.modified())
        .is_ok_and(|time| {
            time.elapsed()
                .is_ok_and(|age| age > Duration::from_hours(24))
        })
}

/// Makes the renaming itself last through a power cut, where the system lets folders be synced.
fn sync_folder(folder: &Path) {
    if let Ok(folder) = File::open(folder) {
        let _ = folder.sync_all();
    }
}

/// Looks at the file that is now at its place.
fn verify(path: &Path, file: &Path, expected: u64) -> Result<(), OutputError> {
    let found = File::open(file)
        .and_then(|file| file.metadata())
        .map_err(|source| failed(path, source))?
        .len();
    if found == expected {
        return Ok(());
    }
    Err(OutputError::Incomplete {
        path: path.into(),
        expected,
        found,
    })
}

fn folder_of(path: &Path) -> &Path {
    match path.parent() {
        Some(folder) if !folder.as_os_str().is_empty() => folder,
        _ => Path::new("."),
    }
}

fn failed(path: &Path, source: io::Error) -> OutputError {
    OutputError::Io {
        path: path.into(),
        source,
    }
}
