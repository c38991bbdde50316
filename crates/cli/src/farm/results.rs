//! Results of parts: whether they exist, are whole, and belong to this farm.

use super::manifest::{self, Manifest, Part};
use super::{Done, Folder, numbered};
use glimray_io::output::Format;
use glimray_render::{Film, FilmError, FilmHeader, FilmOutline};
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

/// The state of a part.
pub enum State {
    /// The part has no mark.
    Absent,
    Done,
    /// The part has its mark, but its result is unusable, for this reason.
    Invalid(String),
}

/// How much of a result is looked at.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Depth {
    /// The headers and lengths of films, and whether frames are there: for a look at many parts.
    Outline,
    /// All bytes.
    Whole,
}

/// The state of a part.
pub fn state(folder: &Folder, manifest: &Manifest, number: u32, depth: Depth) -> State {
    let Some(done) = folder.done(number) else {
        return State::Absent;
    };
    let why = match manifest.parts[number as usize].is_film() {
        true => invalid_film(folder, manifest, number, depth),
        false => invalid_frames(folder, manifest, number, &done, depth),
    };
    why.map_or(State::Done, State::Invalid)
}

fn invalid_film(folder: &Folder, manifest: &Manifest, number: u32, depth: Depth) -> Option<String> {
    let path = folder.film(number);
    let film = match depth {
        Depth::Outline => read_film(&path, FilmOutline::read).and_then(|film| is_long(&path, film)),
        Depth::Whole => read_film(&path, |input| Ok(Film::read(input)?.outline())),
    };
    let film = match film {
        Ok(film) => film,
        Err(why) => return Some(why),
    };
    if let Some(why) = other_picture(manifest, film.header(), &path) {
        return Some(why);
    }
    let part = &manifest.parts[number as usize];
    let [width, height] = manifest.size;
    let [x0, y0, x1, y1] = part.crop.unwrap_or([0, 0, width, height]);
    let [start, end] = part.samples.unwrap_or([0, manifest.samples]);
    let region = [x0, y0, x1 - x0, y1 - y0];
    let wanted = start..end;
    let is_whole = film.parts().eq([(region, std::slice::from_ref(&wanted))]);
    (!is_whole).then(|| format!("{} is of other samples", path.display()))
}

/// The outline of a film if the file is long enough for its sums.
fn is_long(path: &Path, film: FilmOutline) -> Result<FilmOutline, String> {
    let length = fs::metadata(path).map_or(0, |file| file.len());
    match length > film.bytes() {
        true => Ok(film),
        false => Err(format!("the film is cut short ({})", path.display())),
    }
}

/// Why the film of a part cannot be merged, from its header alone: its sums are read later.
pub fn foreign(folder: &Folder, manifest: &Manifest, number: u32) -> Option<String> {
    let path = folder.film(number);
    match read_film(&path, FilmOutline::read) {
        Ok(outline) => other_picture(manifest, outline.header(), &path),
        Err(why) => Some(why),
    }
}

/// Reads a film, or a part of it; the error is the end of a sentence.
fn read_film<T>(
    path: &Path,
    read: impl FnOnce(BufReader<File>) -> Result<T, FilmError>,
) -> Result<T, String> {
    let file = File::open(path).map_err(FilmError::from);
    let film = file.and_then(|file| read(BufReader::new(file)));
    film.map_err(|error| {
        let error = error.to_string();
        format!("{} ({})", error.trim_end_matches('.'), path.display())
    })
}

/// Why a film is neither of the picture nor of a frame of the animation; `None` if it is.
fn other_picture(manifest: &Manifest, header: &FilmHeader, path: &Path) -> Option<String> {
    let is_view = |wanted: &String| header.view.to_string() == *wanted;
    let is_own = header.scene.to_string() == manifest.scene_fingerprint
        && header.settings.to_string() == manifest.settings_fingerprint
        && manifest.view_fingerprint.as_ref().is_none_or(is_view);
    (!is_own).then(|| format!("{} is of another picture", path.display()))
}

fn invalid_frames(
    folder: &Folder,
    manifest: &Manifest,
    number: u32,
    done: &Done,
    depth: Depth,
) -> Option<String> {
    let files = frame_files(folder, manifest, number);
    let wrong = files.iter().enumerate().find_map(|(index, (_, path))| {
        if depth == Depth::Outline {
            return (!path.is_file()).then_some((path, "is missing"));
        }
        let hash = fs::read(path).ok().map(|bytes| manifest::hash(&bytes));
        match (hash, done.frames.get(index)) {
            (None, _) => Some((path, "is missing")),
            (Some(hash), Some(wanted)) if hash == *wanted => None,
            _ => Some((path, "is not what was rendered")),
        }
    });
    wrong.map(|(path, why)| format!("{} {why}", path.display()))
}

/// The frames of a part in order, with their numbers; none for a film.
pub fn frame_files(folder: &Folder, manifest: &Manifest, number: u32) -> Vec<(u32, PathBuf)> {
    let part = &manifest.parts[number as usize];
    let (Some(frames), Some([first, last]), false) =
        (&manifest.frames, part.frames, part.is_film())
    else {
        return Vec::new();
    };
    let ending = frame_ending(&manifest.output);
    (first..=last)
        .step_by(frames.step as usize)
        .map(|frame| (frame, folder.frame(number, frame, &ending)))
        .collect()
}

/// The parts that are not done, or whose result is gone.
pub fn unfinished(folder: &Folder, manifest: &Manifest) -> Vec<u32> {
    let is_there = |number: u32, part: &Part| match part.is_film() {
        true => folder.film(number).is_file(),
        false => frame_files(folder, manifest, number)
            .iter()
            .all(|(_, file)| file.is_file()),
    };
    numbered(manifest)
        .filter(|(number, part)| folder.done(*number).is_none() || !is_there(*number, part))
        .map(|(number, _)| number)
        .collect()
}
