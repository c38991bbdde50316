//! What to do with files that come by name: dropped, chosen, or next in the folder.

use crate::viewer::actions::files::{intend, is_picture, is_scene, short, surround};
use crate::viewer::state::files::Intent;
use crate::viewer::state::session::Session;
use std::collections::VecDeque;
use std::path::{Path, PathBuf};

/// Opens the first scene among the files and folders, or puts the first picture all round. Where
/// there are several, says which it was.
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
        session.files.said = (count > 1).then(|| format!("opened the first of {count} scenes"));
        session.files.candidates = scenes;
        intend(session, Intent::Open(first));
        return;
    }
    if let Some(first) = pictures.first() {
        if session.scene().is_none() {
            session.messages.warn(format!(
                "cannot put {} round the scene: there is none yet. Open a scene first.",
                short(first)
            ));
            return;
        }
        if pictures.len() > 1 {
            let text = format!("took the first of {} pictures", pictures.len());
            session.messages.tell(text);
        }
        surround(session, first.to_path_buf());
        return;
    }
    let what = match paths.as_slice() {
        [one] if one.is_dir() => format!("{}): there is no scene in the folder", one.display()),
        [one] if !one.exists() => format!("{}): there is no such file", one.display()),
        [one] => format!("{}): it is neither a scene nor a picture", one.display()),
        _ => format!("{} files): none is a scene or a picture", paths.len()),
    };
    session.messages.warn(format!(
        "cannot open this ({what}. Scenes end in .toml, .scene, .nff or .obj, pictures in .hdr, .exr, \
         .png or .jpg."
    ));
}

/// Opens the scene that is so many places further on in the folder; what cannot be read is passed over.
pub fn step(session: &mut Session, places: isize) {
    let Some(path) = session.path.clone() else {
        session.messages.tell("the demo is in no folder");
        return;
    };
    let folder = match path.parent() {
        Some(folder) if !folder.as_os_str().is_empty() => folder,
        _ => Path::new("."),
    };
    let mut scenes = scenes_in(folder);
    let here = scenes
        .iter()
        .position(|scene| scene.file_name() == path.file_name());
    if let Some(here) = here {
        // From the next one on, all round, and not this one.
        scenes.rotate_left(here);
        scenes.remove(0);
    }
    if places < 0 {
        scenes.reverse();
    }
    let mut scenes = VecDeque::from(scenes);
    let Some(next) = scenes.pop_front() else {
        session
            .messages
            .tell("there is no other scene in this folder");
        return;
    };
    session.files.said = None;
    session.files.candidates = scenes;
    intend(session, Intent::Open(next));
}

/// The scenes in a folder by their names, not in folders below.
fn scenes_in(folder: &Path) -> Vec<PathBuf> {
    let entries = std::fs::read_dir(folder).into_iter().flatten().flatten();
    let mut scenes: Vec<PathBuf> = entries
        .map(|entry| entry.path())
        .filter(|path| is_scene(path) && path.is_file())
        .collect();
    scenes.sort_by_key(|path| (short(path).to_lowercase(), path.clone()));
    scenes
}
