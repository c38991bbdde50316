//! Writes files so that no reader, crash or full disk ever leaves half of one: a temporary file beside
//! the target is written, synced and renamed over it; then the folder is synced and the result checked.

use super::{OutputError, RemoveOnExit};
use std::fs::{self, File, OpenOptions, Permissions};
use std::io::{self, ErrorKind, Seek, Write};
use std::path::{Path, PathBuf};
use std::time::Duration;
use tempfile::NamedTempFile;

/// Separates a file's name from the id of the process that writes it.
const PART: &str = ".part-";

/// Most file systems limit names to 255 bytes; this leaves room for the additions.
const MAX_STEM: usize = 200;

/// Limit of chained links to a file that does not exist yet. Operating systems have similar limits.
const MAX_LINKS: usize = 40;

/// Where the bytes for a path are written.
enum Target {
    /// A file, new or existing, that is put in place by renaming.
    File {
        /// With symbolic links resolved, so that the link is kept and its target is replaced or created.
        path: PathBuf,
        /// Permissions of the existing file.
        permissions: Option<Permissions>,
    },
    /// A pipe, a device or a socket, which is written to directly.
    Stream,
}

/// A temporary file beside its target, registered for removal when the process ends.
type Part = (NamedTempFile, RemoveOnExit);

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

/// Like [`write`], for contents too large for memory: `fill` writes them piece by piece. If it fails, the
/// previous contents of `path` stay.
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

/// Refuses a symbolic link, except to a pipe or a device.
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

/// The target for a path that does not exist yet.
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

/// The path of the file, which does not exist yet, behind any chain of links.
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

/// Renames a complete temporary file to its target, and returns the number of bytes in it.
fn replace(
    path: &Path,
    (mut part, registered): Part,
    permissions: Option<Permissions>,
    clobber: bool,
) -> io::Result<u64> {
    if let Some(permissions) = permissions {
        part.as_file().set_permissions(permissions)?;
    }
    part.flush()?;
    part.as_file().sync_all()?;
    let length = part.stream_position()?;
    // From here on, an error drops and thereby removes the temporary file.
    if clobber {
        part.persist(path)?;
    } else {
        part.persist_noclobber(path)?;
    }
    drop(registered);
    sync_folder(folder_of(path));
    Ok(length)
}

/// A new empty file beside `path`, removed when dropped.
fn part_file(path: &Path) -> io::Result<Part> {
    let prefix = format!("{}{}-", part_prefix(path), std::process::id());
    let mut builder = tempfile::Builder::new();
    builder.prefix(&prefix);
    // Temporary files are private by default; this one becomes an ordinary file, with permissions
    // according to the umask.
    #[cfg(unix)]
    builder.permissions(std::os::unix::fs::PermissionsExt::from_mode(0o666));
    let make = || builder.tempfile_in(folder_of(path));
    RemoveOnExit::make(make, |part| part.path().to_owned())
}

fn part_prefix(path: &Path) -> String {
    let name = path.file_name().unwrap_or_default().to_string_lossy();
    let end = name.floor_char_boundary(MAX_STEM);
    format!(".{}{PART}", &name[..end])
}

/// Removes the temporary files that killed processes left for `path`. Errors are ignored.
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

/// Whether no process can still be writing the file. Without /proc, files older than a day count.
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

/// Syncs the folder so that the renaming survives a power failure, where the system supports it.
fn sync_folder(folder: &Path) {
    if let Ok(folder) = File::open(folder) {
        let _ = folder.sync_all();
    }
}

/// Checks the file after it was put in place.
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
