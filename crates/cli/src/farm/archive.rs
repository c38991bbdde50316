//! Packs a scene with everything that it names into one archive, so that other machines need no shared sources.

use super::Folder;
use super::manifest::{PackedFile, hash};
use glimray_app::error::AppError;
use glimray_io::import::SCENE_MEMBER;
use glimray_io::output;
use std::fs;
use std::io::{self, Cursor, Write};
use std::path::{Path, PathBuf};
use zip::write::SimpleFileOptions;
use zip::{CompressionMethod, ZipWriter};

/// The name of the archive.
pub const NAME: &str = "scene.zip";

/// Writes the archive of `scene` and the files that it names. Missing ones, which the scene can do without, are left out.
///
/// # Errors
/// A file cannot be read, or the archive cannot be written.
pub fn pack(scene: &Path, files: &[PathBuf], folder: &Folder) -> Result<PackedFile, AppError> {
    let scene = in_real_folder(scene)?;
    let mut paths = vec![scene.clone()];
    for file in files.iter().filter(|file| file.is_file()) {
        let path = in_real_folder(file)?;
        if !paths.contains(&path) {
            paths.push(path);
        }
    }
    let root = root_of(&paths);
    let mut archive = ZipWriter::new(Cursor::new(Vec::new()));
    // Equal files give equal archives. Pictures and binary meshes hardly compress.
    let options = SimpleFileOptions::default().compression_method(CompressionMethod::Stored);
    let name_of = |path: &Path| {
        let inner = path.strip_prefix(&root).unwrap_or(path);
        let parts = inner
            .components()
            .map(|part| part.as_os_str().to_string_lossy());
        parts.collect::<Vec<_>>().join("/")
    };
    let broken = |error: zip::result::ZipError| AppError::Internal(format!("{NAME}: {error}"));
    archive.start_file(SCENE_MEMBER, options).map_err(broken)?;
    let written = archive.write_all(name_of(&scene).as_bytes());
    written.map_err(|error| AppError::Internal(format!("{NAME}: {error}")))?;
    for path in &paths {
        let bytes = fs::read(path).map_err(|error| unreadable(path, &error))?;
        archive.start_file(name_of(path), options).map_err(broken)?;
        let written = archive.write_all(&bytes);
        written.map_err(|error| AppError::Internal(format!("{NAME}: {error}")))?;
    }
    let bytes = archive.finish().map_err(broken)?.into_inner();
    store(NAME, &bytes, folder)
}

/// Copies a file into the folder, as `stem` with the file's own extension.
///
/// # Errors
/// The file cannot be read or written.
pub fn copy(file: &Path, stem: &str, folder: &Folder) -> Result<PackedFile, AppError> {
    let bytes = fs::read(file).map_err(|error| unreadable(file, &error))?;
    let ending = file.extension().unwrap_or_default().to_string_lossy();
    store(&format!("{stem}.{ending}"), &bytes, folder)
}

fn store(name: &str, bytes: &[u8], folder: &Folder) -> Result<PackedFile, AppError> {
    output::write(folder.path().join(name), bytes, true)?;
    Ok(described(name, bytes))
}

fn described(name: &str, bytes: &[u8]) -> PackedFile {
    PackedFile {
        file: name.into(),
        bytes: bytes.len() as u64,
        xxh3: hash(bytes),
    }
}

/// Checks that a packed file is there and whole, and returns its path.
///
/// # Errors
/// The file is missing, has another length or another checksum.
pub fn checked(packed: &PackedFile, folder: &Folder) -> Result<PathBuf, AppError> {
    let path = folder.path().join(&packed.file);
    let refused = |why: &str| {
        AppError::Refused(format!(
            "cannot use the farm ({}): {why}. Copy the folder again, or plan it again.",
            path.display()
        ))
    };
    let bytes = fs::read(&path).map_err(|error| refused(&error.to_string()))?;
    match described(&packed.file, &bytes) == *packed {
        true => Ok(path),
        false => Err(refused("the file is not the one that was planned")),
    }
}

/// The path without symbolic links, except that the file keeps its name: scenes are read from their real folder.
fn in_real_folder(path: &Path) -> Result<PathBuf, AppError> {
    let folder = match path.parent() {
        Some(parent) if parent != Path::new("") => parent,
        _ => Path::new("."),
    };
    let real = fs::canonicalize(folder).map_err(|error| unreadable(path, &error))?;
    Ok(real.join(path.file_name().unwrap_or_default()))
}

/// The folder that has all files in it.
fn root_of(paths: &[PathBuf]) -> PathBuf {
    let mut root = paths[0].parent().unwrap_or(Path::new("/")).to_owned();
    for path in paths {
        while !path.starts_with(&root) && root.pop() {}
    }
    root
}

fn unreadable(path: &Path, error: &io::Error) -> AppError {
    AppError::Refused(format!(
        "cannot pack the scene ({}): {error}. Check the file and its permissions.",
        path.display()
    ))
}
