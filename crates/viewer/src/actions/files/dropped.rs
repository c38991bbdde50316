//! Opens files by name: dropped, chosen, or next in the folder.

use crate::actions::files::{intend, is_picture, is_scene, short, surround};
use crate::state::files::Intent;
use crate::state::session::Session;
use glimray_io::import::SCENE_ENDINGS;
use std::collections::VecDeque;
use std::path::{Path, PathBuf};

/// Opens the first scene among the files and folders, or uses the first image as the environment. Reports
/// which one if there are several.
pub fn open(session: &mut Session, paths: Vec<PathBuf>) {
    let mut scenes = VecDeque::new();
    for path in &paths {
        match path.is_dir() {
            true => scenes.extend(scenes_in(path)),
            false if is_scene(path) => scenes.push_back(path.clone()),
            false => {}
        }
    }
    let pictures: Vec<&PathBuf> = paths.iter().filter(|path| is_picture(path)).collect();
    let count = scenes.len();
    if let Some(first) = scenes.pop_front() {
        session.files.notice = (count > 1).then(|| format!("Opened the first of {count} scenes"));
        session.files.candidates = scenes;
        intend(session, Intent::Open(first));
        return;
    }
    if let Some(first) = pictures.first() {
        if session.scene().is_none() {
            session.messages.warn(format!(
                "Cannot use {} as the environment: no scene is open. Open a scene first.",
                short(first)
            ));
            return;
        }
        if pictures.len() > 1 {
            let text = format!("Used the first of {} images", pictures.len());
            session.messages.notify(text);
        }
        surround(session, first.to_path_buf());
        return;
    }
    let what = match paths.as_slice() {
        [one] if one.is_dir() => format!("{}: the folder contains no scenes", one.display()),
        [one] if !one.exists() => format!("{}: the file does not exist", one.display()),
        [one] => format!("{}: {} isn't supported", one.display(), kind(one)),
        _ => format!("{} files: none is a supported scene or image", paths.len()),
    };
    session.messages.warn(format!(
        "Cannot open {what}. Convert to .{} for scenes and models, or to .hdr, .exr, .png or .jpg for \
         images.",
        SCENE_ENDINGS.join(", .")
    ));
}

/// The extension of a file with its dot, such as `.glb`.
fn kind(path: &Path) -> String {
    match path.extension() {
        Some(ending) => format!(".{}", ending.to_string_lossy()),
        None => "a file without an extension".to_owned(),
    }
}

/// Opens the scene `places` further in the folder; unreadable scenes are skipped.
pub fn step(session: &mut Session, places: isize) {
    let Some(path) = session.path.clone() else {
        let told = match session.is_untitled {
            true => "The new scene is not in a folder yet. Save it first",
            false => "The demo scene is not in a folder",
        };
        session.messages.notify(told);
        return;
    };
    let mut scenes = others(&path);
    if places < 0 {
        scenes.make_contiguous().reverse();
    }
    let Some(next) = scenes.pop_front() else {
        session
            .messages
            .notify("There is no other scene in this folder");
        return;
    };
    session.files.notice = None;
    session.files.candidates = scenes;
    intend(session, Intent::Open(next));
}

/// The other scenes in the folder of a scene: from the next one on, round the end.
pub(super) fn others(path: &Path) -> VecDeque<PathBuf> {
    let folder = match path.parent() {
        Some(folder) if !folder.as_os_str().is_empty() => folder,
        _ => Path::new("."),
    };
    let mut scenes = scenes_in(folder);
    let here = scenes
        .iter()
        .position(|scene| scene.file_name() == path.file_name());
    if let Some(here) = here {
        scenes.rotate_left(here);
        scenes.remove(0);
    }
    scenes.into()
}

/// The scenes directly in a folder, sorted by name.
fn scenes_in(folder: &Path) -> Vec<PathBuf> {
    let entries = std::fs::read_dir(folder).into_iter().flatten().flatten();
    let mut scenes: Vec<PathBuf> = entries
        .map(|entry| entry.path())
        .filter(|path| is_scene(path) && path.is_file())
        .collect();
    scenes.sort_by_key(|path| (short(path).to_lowercase(), path.clone()));
    scenes
}
