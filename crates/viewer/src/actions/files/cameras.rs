//! Cameras and bookmarks, and copying and pasting them as command lines.

use crate::actions::files::short;
use crate::model::command_line;
use crate::model::command_line::Shown;
use crate::model::modal::DIGITS;
use crate::model::preferences::{SavedCamera, Thumbnail};
use crate::state::answer::Answer;
use crate::state::dialogs::Dialog;
use crate::state::session::Session;
use crate::state::session::opening::UNTITLED;
use crate::worker::progressive_image::{PictureSlot, Progress};
use eframe::egui::{self, Event, Key, Modifiers};
use glimray_app::advice;
use glimray_scene::Camera;
use std::path::{Path, PathBuf};

/// The key of the demo's bookmarks; no file has this name.
const DEMO: &str = "/glimray demo/";
/// The demo's file name in a command line.
const DEMO_FILE: &str = "showcase.toml";

/// The key of the current scene's bookmarks.
pub fn key(session: &Session) -> PathBuf {
    let without_file = if session.is_untitled { UNTITLED } else { DEMO };
    session.path.clone().unwrap_or_else(|| without_file.into())
}

/// A camera of the scene or a bookmark.
#[derive(Clone, Debug, PartialEq)]
pub struct View {
    /// The camera's label.
    pub name: String,
    /// The camera in world space at the current time.
    pub camera: Camera,
    /// Whether it is a bookmark.
    pub is_bookmark: bool,
    /// The small picture of a bookmark.
    pub picture: Option<Thumbnail>,
    /// Whether it looks at a point: see [`Camera::has_aim`].
    pub has_aim: bool,
}

/// The scene's cameras at the current time, then the bookmarks.
pub fn all(session: &Session) -> Vec<View> {
    let Some(scene) = session.scene() else {
        return Vec::new();
    };
    let mut scene = command_line::without_geometry(scene);
    let own = (0..scene.cameras.len()).map(|index| {
        scene.camera_index = index;
        let camera = scene.frame(session.playback.time).camera;
        let name = match camera.name.is_empty() {
            true => format!("Scene camera {}", index + 1),
            false => camera.name.clone(),
        };
        View {
            name,
            camera,
            is_bookmark: false,
            picture: None,
            has_aim: scene.cameras[index].has_aim(),
        }
    });
    let mut cameras: Vec<_> = own.collect();
    let bookmarks = session.preferences.cameras_of(&key(session)).iter();
    cameras.extend(bookmarks.map(|saved| View {
        name: saved.name.clone(),
        camera: saved.camera.clone(),
        is_bookmark: true,
        picture: saved.picture.clone(),
        has_aim: true,
    }));
    cameras
}

/// Bookmarks the current view, or the one that the camera is moving to, under a free name.
pub fn bookmark(session: &mut Session) {
    let Some(controller) = &session.controller else {
        return;
    };
    let camera = controller.destination();
    let key = key(session);
    let names = session.preferences.cameras_of(&key).iter().map(|c| &c.name);
    let names: Vec<_> = names.cloned().collect();
    let mut number = names.len() + 1;
    while names.contains(&format!("View {number}")) {
        number += 1;
    }
    let name = format!("View {number}");
    session.messages.notify(format!("Bookmarked as {name}"));
    let saved = SavedCamera {
        name,
        camera,
        picture: None,
    };
    session.preferences.save_camera(&key, saved.clone());
    session.files.unpictured = Some((key, saved));
}

/// Asks for the small picture of the bookmark that was made last, as soon as its view has samples.
pub fn picture(session: &mut Session, progress: &Progress) {
    if progress.samples == 0 || progress.is_coarse || session.is_moving() {
        return;
    }
    let bookmark = session.files.unpictured.take();
    let camera = session.camera();
    let Some((key, saved)) = bookmark.filter(|it| Some(&it.1.camera) == camera.as_ref()) else {
        return;
    };
    session.ask(move |frame| match frame.screen_image() {
        Ok(picture) => Answer::Bookmarked(
            key,
            Box::new(SavedCamera {
                picture: picture.as_ref().and_then(Thumbnail::of),
                ..saved
            }),
        ),
        Err(error) => Answer::Failed(advice::render(&error)),
    });
}

/// The keys of the first bookmarks while their dialog is open.
pub const NUMBERS: &[Key] = DIGITS.split_at(1).1;

/// Goes to a bookmark by its number, if their dialog is open. Returns whether the key is such a number.
pub fn take_number(session: &mut Session, event: &Event) -> bool {
    let &Event::Key {
        key,
        pressed: true,
        modifiers: Modifiers::NONE,
        ..
    } = event
    else {
        return false;
    };
    let number = NUMBERS.iter().position(|known| *known == key);
    let (Some(number), true) = (number, session.dialogs.is_open(Dialog::Cameras)) else {
        return false;
    };
    let bookmark = all(session)
        .into_iter()
        .filter(|view| view.is_bookmark)
        .nth(number);
    match bookmark {
        Some(view) => go(session, &view),
        None => (session.messages).notify(format!("There is no bookmark {}", number + 1)),
    }
    true
}

/// Renames a bookmark if the name is free. Returns whether it is.
pub fn rename(session: &mut Session, name: &str, to: &str) -> bool {
    let (key, to) = (key(session), to.trim());
    let mut cameras = session.preferences.cameras_of(&key).to_vec();
    if to.is_empty() || cameras.iter().any(|camera| camera.name == to) {
        return false;
    }
    let Some(camera) = cameras.iter_mut().find(|camera| camera.name == name) else {
        return false;
    };
    camera.name = to.to_owned();
    let names = session
        .preferences
        .cameras_of(&key)
        .iter()
        .map(|c| c.name.clone());
    for name in names.collect::<Vec<_>>() {
        session.preferences.remove_camera(&key, &name);
    }
    for camera in cameras {
        session.preferences.save_camera(&key, camera);
    }
    true
}

/// Deletes a bookmark.
pub fn delete(session: &mut Session, name: &str) {
    let key = key(session);
    session.preferences.remove_camera(&key, name);
}

/// Moves to a view, animated.
pub fn go(session: &mut Session, view: &View) {
    if let Some(controller) = &mut session.controller {
        match view.has_aim {
            true => controller.go_to(&view.camera),
            false => controller.go_to_without_aim(&view.camera),
        }
    }
    session.moved();
}

/// Moves to the next or previous camera.
pub fn step(session: &mut Session, places: isize) {
    let cameras = all(session);
    let Some(destination) = session
        .controller
        .as_ref()
        .map(|controller| controller.destination())
    else {
        return;
    };
    let is_here = |place: &View| same_view(&place.camera, &destination);
    let here = cameras.iter().position(is_here);
    let count = cameras.len() as isize;
    let next = match here {
        Some(_) if count == 1 => {
            let text = "There is no other camera. Bookmark views to switch between them";
            session.messages.notify(text);
            return;
        }
        Some(here) => (here as isize + places).rem_euclid(count),
        None if places > 0 => 0,
        None => count - 1,
    };
    if let Some(place) = cameras.get(next as usize) {
        session.messages.notify(place.name.clone());
        go(session, place);
    }
}

/// Whether both show the same view, whatever their names.
fn same_view(a: &Camera, b: &Camera) -> bool {
    let unnamed = |camera: &Camera| Camera {
        name: String::new(),
        node: None,
        target: None,
        ..camera.clone()
    };
    unnamed(a) == unnamed(b)
}

/// Copies the current view as a command line.
pub fn copy(session: &mut Session, ctx: &egui::Context) {
    let requests = session.requests();
    let Some(request) = &requests.pictures[PictureSlot::Main as usize] else {
        session.messages.notify("There is no picture yet");
        return;
    };
    let (Some(original), Some(camera)) = (&session.original, session.camera()) else {
        return;
    };
    let path = session.path.clone();
    if path.is_none() && session.is_untitled {
        (session.messages).notify("The new scene has no file yet. Save it first.");
        return;
    }
    let shown = Shown {
        path: path.as_deref().unwrap_or(Path::new(DEMO_FILE)),
        options: &session.request.import,
        scene: original,
        camera: &camera,
        background: (request.background.as_ref()).unwrap_or(&request.scene.background),
        section: request.scene.section,
        settings: &request.settings,
        tone: request.tone,
        time: session.playback.time,
        fps: session.playback.clock.fps,
        shutter: session.playback.shutter(),
        edited: session.has_changes(),
    };
    let mut copied = command_line::copy(&shown);
    if path.is_none() {
        let text = "the built-in demo scene, which has no file";
        copied.left_out.push(text.to_owned());
    }
    ctx.copy_text(copied.line.clone());
    match copied.left_out.as_slice() {
        [] => session
            .messages
            .notify("Copied a command line that renders this picture"),
        left_out => session.messages.warn(format!(
            "Copied a command line. It cannot express: {}",
            left_out.join("; ")
        )),
    }
}

/// Pastes camera and time from a command line.
pub fn paste(session: &mut Session, text: &str) {
    let Some(original) = &session.original else {
        return;
    };
    let pasted = match command_line::paste(session.request.parse, text, original) {
        Ok(pasted) => pasted,
        Err(why) => {
            session.messages.warn(why);
            return;
        }
    };
    let is_other = |path: &PathBuf| match &session.path {
        Some(own) => path.file_name() != own.file_name(),
        None => session.is_untitled || path != Path::new(DEMO_FILE),
    };
    let notice = match pasted.path.filter(is_other) {
        Some(path) => format!("Pasted the camera of {}", short(&path)),
        None => "Pasted the camera".to_owned(),
    };
    session.messages.notify(notice);
    session.playback.time = pasted.time.max(0.0);
    if let Some(controller) = &mut session.controller {
        controller.go_to(&pasted.camera);
    }
    session.moved();
}
