//! Frames of an animation that are cut into films. Whoever finishes the last film of a frame merges the frame, so many
//! machines merge at a time. [`super::merge`] merges those that are left.

use super::manifest::{self, Manifest};
use super::results::frame_ending;
use super::{Folder, failed_io, flags, numbered, read, write};
use crate::args::{Cli, Command};
use crate::merge;
use clap::Parser;
use glimray_app::error::AppError;
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;
use std::ffi::OsString;
use std::fs::{self, File};
use std::io::{self, Read, Seek, SeekFrom};
use std::path::{Path, PathBuf};

/// The record of a merged frame, beside it.
#[derive(Debug, Serialize, Deserialize)]
struct Merged {
    /// The hashes at the ends of its films, in the order of the parts.
    films: Vec<String>,
    /// The hash of the picture.
    picture: String,
}

/// The parts of each frame that is cut into films.
pub fn cut(manifest: &Manifest) -> BTreeMap<u32, Vec<u32>> {
    let mut frames: BTreeMap<u32, Vec<u32>> = BTreeMap::new();
    for (number, part) in numbered(manifest).filter(|(_, part)| part.is_film()) {
        if let Some([frame, _]) = part.frames {
            frames.entry(frame).or_default().push(number);
        }
    }
    frames
}

/// Merges a frame from the films of its parts, unless that was done, and returns the path of its picture.
///
/// # Errors
/// The films cannot be read, do not belong together, or are of different adapters although `mixes_adapters` is false;
/// the picture cannot be written.
pub fn merge(
    folder: &Folder,
    manifest: &Manifest,
    (frame, parts): (u32, &[u32]),
    mixes_adapters: bool,
) -> Result<PathBuf, AppError> {
    let path = folder.merged_frame(frame, &frame_ending(&manifest.output));
    let mark = folder.merged_frame(frame, "json");
    let films: Vec<PathBuf> = parts.iter().map(|&part| folder.film(part)).collect();
    let hash = |film: &PathBuf| last_hash(film).map_err(|error| failed_io(film, error));
    let hashes = films.iter().map(hash).collect::<Result<Vec<_>, _>>()?;
    let picture = || fs::read(&path).map(|bytes| manifest::hash(&bytes));
    if let Some(merged) = read::<Merged>(&mark)
        && merged.films == hashes
        && picture().is_ok_and(|picture| picture == merged.picture)
    {
        return Ok(path);
    }
    let extra: &[&str] = match mixes_adapters {
        true => &[],
        false => &["--same-adapter"],
    };
    merge_films(manifest, films, extra, &path)?;
    let merged = Merged {
        films: hashes,
        picture: picture().map_err(|error| failed_io(&path, error))?,
    };
    write(&mark, &merged)?;
    Ok(path)
}

/// The hash at the end of a film, in hexadecimal. It is not compared with the film's contents.
fn last_hash(film: &Path) -> io::Result<String> {
    let mut hash = [0; size_of::<u128>()];
    let mut file = File::open(film)?;
    file.seek(SeekFrom::End(-(hash.len() as i64)))?;
    file.read_exact(&mut hash)?;
    Ok(glimray_render::Fingerprint(u128::from_le_bytes(hash)).to_string())
}

/// Merges films to a picture, as `glimray merge` does.
///
/// # Errors
/// Errors of `glimray merge`.
pub fn merge_films(
    manifest: &Manifest,
    films: Vec<PathBuf>,
    extra: &[&str],
    output: &Path,
) -> Result<(), AppError> {
    let mut words: Vec<OsString> = vec!["glimray".into(), "merge".into()];
    words.extend(flags::finishing(&manifest.flags).map(OsString::from));
    words.extend(extra.iter().map(OsString::from));
    words.push(format!("--quality={}", manifest.quality).into());
    let mut target = OsString::from("--output=");
    target.push(output);
    words.extend([target, "--".into()]);
    words.extend(films.into_iter().map(OsString::from));
    let parsed = Cli::try_parse_from(words)
        .map_err(|error| AppError::Internal(format!("merge: {error}")))?;
    match parsed.command {
        Command::Merge(arguments) => merge::run(&arguments),
        _ => Err(AppError::Internal("merge: no command".into())),
    }
}
