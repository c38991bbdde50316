//! What parts leave behind: whether it is there, whole, and of this farm.

use super::manifest::{Manifest, Part};
use super::{Done, Folder, archive, numbered};
use crate::output::Format;
use crate::render::{Film, FilmHeader, FilmOutline};
use std::fs::{self, File};
use std::io::BufReader;
use std::path::{Path, PathBuf};

/// The extension of the frames of an animation: that of the pattern, or PNG for a video.
pub fn frame_ending(output: &Path) -> String {
    match Format::from_path(output) {
        Some(_) => output
            .extension()
            .unwrap_or_default()
            .to_string_lossy()
            .into(),
        None => "png".into(),
    }
}

/// Why the result of a part that is done cannot be used; `None` if it can.
pub fn invalid(folder: &Folder, manifest: &Manifest, number: u32, done: &Done) -> Option<String> {
    match manifest.parts[number as usize].is_film() {
        true => invalid_film(folder, manifest, number),
        false => invalid_frames(folder, manifest, number, done),
    }
}

fn invalid_film(folder: &Folder, manifest: &Manifest, number: u32) -> Option<String> {
    let part = &manifest.parts[number as usize];
    let path = folder.film(number);
    let film = File::open(&path)
        .map_err(Into::into)
        .and_then(|file| Film::read(BufReader::new(file)));
    let film = match film {
        Ok(film) => film,
        Err(error) => {
            return Some(format!(
                "{} ({})",
                error.to_string().trim_end_matches('.'),
                path.display()
            ));
        }
    };
    if !is_of(manifest, film.header()) {
        return Some(format!("{} is of another picture", path.display()));
    }
    let [width, height] = manifest.size;
    let [x0, y0, x1, y1] = part.crop.unwrap_or([0, 0, width, height]);
    let [start, end] = part.samples.unwrap_or([0, manifest.samples]);
    let region = [x0, y0, x1 - x0, y1 - y0];
    let wanted = start..end;
    let is_whole = film.parts().eq([(region, std::slice::from_ref(&wanted))]);
    (!is_whole).then(|| format!("{} is of other samples", path.display()))
}

/// Why the film of a part cannot be merged, from its header alone: its sums are read later.
pub fn foreign(folder: &Folder, manifest: &Manifest, number: u32) -> Option<String> {
    let path = folder.film(number);
    let outline = File::open(&path)
        .map_err(Into::into)
        .and_then(|file| FilmOutline::read(BufReader::new(file)));
    match outline {
        Ok(outline) if is_of(manifest, outline.header()) => None,
        Ok(_) => Some(format!("{} is of another picture", path.display())),
        Err(error) => Some(format!(
            "{} ({})",
            error.to_string().trim_end_matches('.'),
            path.display()
        )),
    }
}

/// Whether a film is of the picture, or of a frame of the animation.
fn is_of(manifest: &Manifest, header: &FilmHeader) -> bool {
    let is_view = |wanted: &String| header.view.to_string() == *wanted;
    header.scene.to_string() == manifest.scene_fingerprint
        && header.settings.to_string() == manifest.settings_fingerprint
        && manifest.view_fingerprint.as_ref().is_none_or(is_view)
}

fn invalid_frames(
    folder: &Folder,
    manifest: &Manifest,
    number: u32,
    done: &Done,
) -> Option<String> {
    let files = frame_files(folder, manifest, number);
    let wrong = files.iter().enumerate().find_map(|(index, path)| {
        let hash = fs::read(path).ok().map(|bytes| archive::hash(&bytes));
        match (hash, done.frames.get(index)) {
            (None, _) => Some((path, "is missing")),
            (Some(hash), Some(wanted)) if hash == *wanted => None,
            _ => Some((path, "is not what was rendered")),
        }
    });
    wrong.map(|(path, why)| format!("{} {why}", path.display()))
}

/// The frames of a part, in order; none for a film.
pub fn frame_files(folder: &Folder, manifest: &Manifest, number: u32) -> Vec<PathBuf> {
    let part = &manifest.parts[number as usize];
    let Some(frames) = manifest.frames.as_ref().filter(|_| !part.is_film()) else {
        return Vec::new();
    };
    let [first, last] = part.frames.unwrap_or_default();
    let ending = frame_ending(&manifest.output);
    (frames.numbers())
        .filter(|frame| (first..=last).contains(frame))
        .map(|frame| folder.frame(number, frame, &ending))
        .collect()
}

/// The parts that are not done, or whose result is gone.
pub fn unfinished(folder: &Folder, manifest: &Manifest) -> Vec<u32> {
    let is_there = |number: u32, part: &Part| match part.is_film() {
        true => folder.film(number).is_file(),
        false => frame_files(folder, manifest, number)
            .iter()
            .all(|file| file.is_file()),
    };
    numbered(manifest)
        .filter(|(number, part)| folder.done(*number).is_none() || !is_there(*number, part))
        .map(|(number, _)| number)
        .collect()
}
