//! Files: opening, dropping, watching and saving scenes and pictures.

pub mod cameras;
mod closing;
mod dropped;
pub mod film;
pub mod neighbours;
pub mod parts;
pub mod pictures;
mod screenshot;
pub mod show;

use crate::model::file_dialog::{self, Reply, Request, ends_in};
use crate::model::watch::Change;
use crate::state::files::Broken;
use crate::state::files::{Intent, Part};
use crate::state::session::Session;
use crate::state::session::opening::{Opened, forget_parts};
pub use crate::worker::free_name::short;
use eframe::egui::{self, ViewportCommand};
use glimray_app::advice;
use glimray_app::error::AppError;
use glimray_app::overrides::CameraOverrides;
use glimray_io::import;
use std::path::{Path, PathBuf};
use std::sync::mpsc::{TryRecvError, channel};
use std::time::SystemTime;

/// Opens the next scene in the folder, or the previous one with −1.
pub fn open_next(session: &mut Session, step: isize) {
    dropped::step(session, step);
}

/// Reloads the scene; the built-in scene is only restarted.
pub fn reload(session: &mut Session) {
    match session.path.is_some() {
        true => intend(session, Intent::Reload),
        false => session.restart(),
    }
}

/// Pastes the camera of a command line.
pub fn paste_camera(session: &mut Session, ctx: &egui::Context) {
    match pasted(ctx) {
        Some(text) => cameras::paste(session, &text),
        None => {
            session.files.awaits_paste = 3;
            ctx.send_viewport_cmd(ViewportCommand::RequestPaste);
        }
    }
}

fn pasted(ctx: &egui::Context) -> Option<String> {
    ctx.input(|input| {
        input.events.iter().find_map(|event| match event {
            egui::Event::Paste(text) => Some(text.clone()),
            _ => None,
        })
    })
}

/// Performs an action that discards unsaved changes, after asking if there are any.
pub fn intend(session: &mut Session, intent: Intent) {
    match session.has_changes() {
        true => session.files.undecided = Some(intent),
        false => go_on(session, intent),
    }
}

/// Performs it without asking.
pub fn go_on(session: &mut Session, intent: Intent) {
    session.files.undecided = None;
    match intent {
        Intent::Open(path) => {
            take_back_choice(session);
            session.open(path);
        }
        Intent::New => show_without_file(session, Session::show_new),
        // The scene that is being opened replaces it.
        Intent::Reload | Intent::ReloadChanged | Intent::Choose(..) if session.is_opening() => {}
        Intent::Reload | Intent::ReloadChanged => {
            if session.files.have_changed() {
                session.editing.forget_written();
            }
            session.files.watch.accept();
            session.reload();
        }
        Intent::Choose(part, name) => {
            let options = &mut session.request.import;
            (session.files.before_choice).get_or_insert_with(|| options.clone());
            match part {
                Part::Clip => options.clip = name,
                Part::Variant => options.variant = name,
                Part::Scene => options.scene = name,
            }
            session.reload();
        }
        Intent::Close if session.files.waits_to_save() => {
            session.files.undecided = Some(Intent::CloseUnfinished);
        }
        Intent::Close | Intent::CloseUnfinished => {
            session.files.jobs.cancel_lasting();
            session.files.may_close = true;
        }
    }
}

/// Restores what was chosen of the scene that stays, because the file was not read with another choice.
fn take_back_choice(session: &mut Session) {
    if let Some(before) = session.files.before_choice.take() {
        session.request.import = before;
    }
}

/// Drops what belongs to the scene before, because another one is shown: pictures that wait for it, dialogs about it,
/// and files that are read for it.
fn left(session: &mut Session) {
    pictures::abandon(session);
    abandon_texture(session);
    let files = &mut session.files;
    files.saving = None;
    files.film = None;
    files.typed_model = None;
    files.asked_model = None;
    files.model = None;
    files.environment = None;
    files.neighbours.of = None;
    session.picture_menu = None;
}

/// Opens no picture for a material of a scene that is gone.
fn abandon_texture(session: &mut Session) {
    if session.files.texturing.opening.take().is_some() {
        let why = "The picture was not opened: another scene is shown. Open it again.";
        session.messages.warn(why.to_owned());
    }
}

/// Opens a scene, a folder of scenes, or an environment image.
pub fn open(session: &mut Session, paths: Vec<PathBuf>) {
    dropped::open(session, paths);
}

/// Stops loading. The current scene stays; without one the window is empty.
pub fn cancel_loading(session: &mut Session) {
    if let Some(path) = session.cancel_loading() {
        take_back_choice(session);
        session.files.candidates.clear();
        session.files.notice = None;
        let text = format!("Cancelled loading {}", short(&path));
        session.messages.notify(text);
    }
}

/// Shows the built-in scene.
pub fn open_built_in(session: &mut Session) {
    show_without_file(session, Session::show_built_in);
}

fn show_without_file(
    session: &mut Session,
    show: impl FnOnce(&mut Session) -> Result<(), AppError>,
) {
    // A scene that is still loading would replace it.
    session.cancel_loading();
    take_back_choice(session);
    match show(session) {
        Ok(()) => {
            left(session);
            session.path = None;
            session.files.broken = None;
            session.files.is_gone = false;
            session.editing.forget_written();
            // Changes of the files of the scene before are no longer of interest.
            session.files.to_watch = Some((Vec::new(), SystemTime::now()));
        }
        Err(error) => session.messages.warn(error.to_string()),
    }
}

/// Opens a file dialog.
pub fn ask(session: &mut Session, ctx: &egui::Context) {
    if session.files.asked.is_some() {
        return;
    }
    let folder = session.path.as_deref().and_then(Path::parent);
    let recent = || session.preferences.recent.first().and_then(|p| p.parent());
    let request = Request {
        saves: false,
        kind: None,
        title: "Open a scene, a model or an environment image".to_owned(),
        folder: folder.or_else(recent).map(Path::to_owned),
        name: None,
    };
    session.files.asked = Some(session.files.dialogs.ask(request, ctx));
}

/// Handles changes of files since the last frame.
pub fn update(session: &mut Session, ctx: &egui::Context) {
    take_reply(session);
    neighbours::update(session);
    let drops: Vec<PathBuf> = ctx.input(|input| {
        let files = input.raw.dropped_files.iter();
        files.map(|file| file.path().to_owned()).collect()
    });
    if !drops.is_empty() {
        dropped::open(session, drops);
    }
    if session.files.awaits_paste > 0 {
        session.files.awaits_paste -= 1;
        ctx.request_repaint();
        if let Some(text) = pasted(ctx) {
            session.files.awaits_paste = 0;
            cameras::paste(session, &text);
        }
    }
    take_environment(session);
    reload_changed(session, ctx);
    pictures::update(session, ctx);
    film::update(session);
    show::update(session);
    screenshot::update(session, ctx);
    closing::close(session, ctx);
    name(session, ctx);
}

fn take_reply(session: &mut Session) {
    match file_dialog::take_reply(&mut session.files.asked) {
        Some(Reply::Chosen(path)) => dropped::open(session, vec![path]),
        Some(Reply::Unavailable) => {
            session.messages.warn(NO_DIALOG.to_owned());
            session.files.typed = Some(String::new());
        }
        Some(Reply::Cancelled) | None => {}
    }
}

/// Message for desktops without file dialogs.
pub const NO_DIALOG: &str = "No file dialog is available on this desktop (no portal answers). Type the path, or drop a file onto the window.";

/// Loads an environment image.
fn surround(session: &mut Session, path: PathBuf) {
    let (sender, receiver) = channel();
    let from = path.clone();
    let read = move || {
        // The window may have been closed meanwhile.
        let _ = sender.send(import::environment(&from));
    };
    match std::thread::Builder::new().name("load".into()).spawn(read) {
        Ok(_) => session.files.environment = Some((path, receiver)),
        Err(error) => session
            .messages
            .warn(format!("Cannot read the image: {error}.")),
    }
}

fn take_environment(session: &mut Session) {
    let Some((path, outcome)) = &session.files.environment else {
        return;
    };
    let (path, outcome) = (path.clone(), outcome.try_recv());
    match outcome {
        Err(TryRecvError::Empty) => return,
        Err(TryRecvError::Disconnected) => {
            let path = path.display();
            let why = format!("Internal error while reading {path}. Please report it.");
            session.messages.warn(why);
        }
        Ok(Err(error)) => session.messages.warn(advice::import(&error)),
        Ok(Ok((picture, notes))) => {
            session.view.background = None;
            let mut halvings = 0;
            session.edit("change the background", |scene| {
                halvings = scene.set_environment(picture);
            });
            session.moved();
            let name = short(&path);
            session
                .messages
                .notify(format!("{name} is now the environment"));
            let smaller = (halvings > 0).then(|| import::smaller_pictures(halvings));
            for note in notes.into_iter().chain(smaller) {
                session.messages.warn(note);
            }
            session.files.surroundings.push(path);
        }
    }
    session.files.environment = None;
}

/// Handles the result of loading a scene.
pub fn loaded(session: &mut Session, opened: Opened) {
    let Opened {
        path,
        again,
        files,
        began,
        shown,
    } = opened;
    let is_first = session.scene().is_none();
    match shown {
        Ok(()) => {
            session.preferences.opened(&path);
            session.files.candidates.clear();
            session.files.before_choice = None;
            abandon_texture(session);
            if !again {
                session.editing.forget_written();
                left(session);
            }
            if let Some(notice) = session.files.notice.take() {
                session.messages.notify(notice);
            } else if again {
                session
                    .messages
                    .notify(format!("Reloaded {}", short(&path)));
            }
            // Keeps the error of a different file.
            (session.files.broken).take_if(|broken| !again || broken.path == path);
            session.path = Some(path);
        }
        Err(_) if !again && !session.files.candidates.is_empty() => {
            let next = session.files.candidates.pop_front();
            next.into_iter().for_each(|next| session.open_instead(next));
            return;
        }
        Err(trouble) => {
            take_back_choice(session);
            session.files.notice = None;
            session.files.broken = Some(Broken {
                path: path.clone(),
                trouble,
            });
            // A scene that was never shown is watched only if nothing else is.
            if !again && !is_first {
                return;
            }
            session.path = Some(path);
        }
    }
    session.files.is_gone = false;
    session.files.to_watch = Some((files, began));
}

/// Called after the scene was saved to these files, its own file last: they are watched from now on.
pub fn saved(session: &mut Session, files: Vec<PathBuf>) {
    // The file contains the overrides of the command line now.
    session.original = session.scene().cloned();
    session.request.overrides.camera = CameraOverrides::default();
    forget_parts(&mut session.request.import);
    session.files.before_choice = None;
    session.path = files.last().cloned();
    session.files.broken = None;
    session.files.is_gone = false;
    session.files.watch.accept();
    session.files.to_watch = Some((files, SystemTime::now()));
}

/// Reloads the scene when its files have changed.
fn reload_changed(session: &mut Session, ctx: &egui::Context) {
    if let Some((files, since)) = session.files.to_watch.take() {
        let waker = ctx.clone();
        let watched =
            (session.files.watch).set_files(&files, since, move || waker.request_repaint());
        if let Err(why) = watched {
            session.messages.warn(format!(
                "Cannot watch the scene's files: {why}. Reload the scene manually when they change."
            ));
        }
    }
    if session.is_opening() {
        return;
    }
    match session.files.watch.look() {
        Change::None => return,
        Change::Wait(time) => {
            ctx.request_repaint_after(time);
            return;
        }
        Change::Changed => session.editing.forget_written(),
    }
    let Some(path) = session.path.clone() else {
        return;
    };
    let was_gone = std::mem::replace(&mut session.files.is_gone, !path.exists());
    if session.files.is_gone {
        session.files.watch.accept();
        if !was_gone {
            session.messages.warn(format!(
                "{} was deleted or moved. The last picture stays visible, and the scene reloads when the \
                 file returns.",
                path.display()
            ));
        }
        ctx.request_repaint();
        return;
    }
    session.files.watch.accept();
    intend(session, Intent::ReloadChanged);
}

/// Updates the window's title.
fn name(session: &mut Session, ctx: &egui::Context) {
    let mark = if session.has_changes() { "*" } else { "" };
    let title = format!("{}{mark} · glimray", session.title());
    if session.files.title != title {
        ctx.send_viewport_cmd(ViewportCommand::Title(title.clone()));
        session.files.title = title;
    }
}

/// Whether the file name is that of a scene.
fn is_scene(path: &Path) -> bool {
    ends_in(path, import::SCENE_ENDINGS)
}

/// Whether the file name is that of an image.
fn is_picture(path: &Path) -> bool {
    ends_in(path, import::PICTURE_ENDINGS)
}
