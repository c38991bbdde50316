//! Scenes and pictures on the disk: opening, dropping, watching, saving.

pub mod cameras;
mod closing;
pub mod dialogs;
mod dropped;
pub mod pictures;
mod screenshot;
pub mod watch;

use super::bindings::Action;
use super::loader::Trouble;
use super::session::Session;
use crate::app::advice;
use crate::app::cli::CameraFlags;
use crate::app::inputs::Inputs;
use crate::import::{self, ImportError};
use crate::scene::{Background, Picture};
use dialogs::{Dialogs, Reply, Request, ends_in};
use eframe::egui::{self, ViewportCommand};
use pictures::{Pending, SaveSheet};
use std::collections::VecDeque;
use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::sync::mpsc::{Receiver, TryRecvError, channel};
use std::time::SystemTime;
use watch::{Change, Watch};

/// A picture, or why it cannot be read.
type PictureRead = Result<Arc<Picture>, ImportError>;

/// What the window has to do with files.
#[derive(Default)]
pub struct Files {
    /// Who is asked for names.
    pub dialogs: Dialogs,
    /// The scene that was refused, until it is mended.
    pub broken: Option<Broken>,
    /// A name that is being typed, of what is to be opened.
    pub typed: Option<String>,
    /// The picture that is about to be saved.
    pub saving: Option<SaveSheet>,
    /// What waits until the person says what becomes of unsaved changes.
    pub undecided: Option<Intent>,
    /// The reply to what is to be opened.
    asked: Option<Receiver<Reply>>,
    /// What to try next when a scene cannot be read, and what to say when one is.
    candidates: VecDeque<PathBuf>,
    said: Option<String>,
    pending: Pending,
    /// Surroundings that are being read, and where they will come.
    environment: Option<(PathBuf, Receiver<PictureRead>)>,
    /// Pictures of surroundings that were read.
    surroundings: Vec<PathBuf>,
    watch: Watch,
    /// What to watch from now on.
    to_watch: Option<(Vec<PathBuf>, SystemTime)>,
    /// Whether the scene's file is not there any more.
    is_gone: bool,
    /// For how many frames yet what is pasted is a camera: none comes from an empty clipboard.
    awaits_paste: u8,
    may_close: bool,
    title: String,
}

/// A scene that was refused.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Broken {
    /// Its file.
    pub path: PathBuf,
    /// Why.
    pub trouble: Trouble,
}

/// Something that would lose unsaved changes.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Intent {
    /// To open another scene.
    Open(PathBuf),
    /// To read the scene again.
    Reload,
    /// To read the scene again, because its file has changed.
    Follow,
    /// To close the window.
    Close,
    /// To close it although a picture is to be saved that is not finished.
    CloseUnfinished,
}

impl Files {
    /// Tells that the window is another one, which nothing was told yet.
    pub fn begin(&mut self) {
        self.title.clear();
        self.pending.begin();
        let files = self.watch.files();
        if !files.is_empty() {
            self.to_watch = Some((files, SystemTime::now()));
            // The old one would wake a window that is gone.
            self.watch = Watch::default();
        }
    }

    /// Whether something is under way that will change what is to be seen or told.
    pub fn is_busy(&self) -> bool {
        self.watch.is_busy()
            || self.to_watch.is_some()
            || self.environment.is_some()
            || self.pending.is_writing()
    }

    /// Whether someone else has changed a file of the scene and it was not read again yet.
    pub fn have_changed(&self) -> bool {
        self.watch.has_changed()
    }

    /// What the scene on screen comes from, which no picture may replace.
    pub fn inputs(&self) -> Inputs {
        Inputs::new(self.watch.files().iter().chain(&self.surroundings))
    }

    /// Whether the window is about to be photographed, so that nothing should lie over the picture.
    pub fn is_posing(&self) -> bool {
        self.pending.is_posing()
    }

    /// Whether a picture is to be saved when it is finished.
    pub fn waits_to_save(&self) -> bool {
        self.pending.waits()
    }
}

/// Carries out a command that has to do with files. Whether it does.
pub fn perform(action: Action, session: &mut Session, ctx: &egui::Context) -> bool {
    match action {
        Action::Open => ask(session, ctx),
        Action::OpenNext => dropped::step(session, 1),
        Action::OpenPrevious => dropped::step(session, -1),
        Action::Reload => match session.path.is_some() {
            true => intend(session, Intent::Reload),
            false => session.restart(),
        },
        Action::SavePicture => pictures::open(session, false),
        Action::SavePictureWithOverlays => pictures::open(session, true),
        Action::SaveCamera => cameras::keep(session),
        Action::NextCamera => cameras::step(session, 1),
        Action::PreviousCamera => cameras::step(session, -1),
        Action::CopyCamera => cameras::copy(session, ctx),
        Action::PasteCamera => match pasted(ctx) {
            Some(text) => cameras::paste(session, &text),
            None => {
                session.files.awaits_paste = 3;
                ctx.send_viewport_cmd(ViewportCommand::RequestPaste);
            }
        },
        _ => return false,
    }
    true
}

fn pasted(ctx: &egui::Context) -> Option<String> {
    ctx.input(|input| {
        input.events.iter().find_map(|event| match event {
            egui::Event::Paste(text) => Some(text.clone()),
            _ => None,
        })
    })
}

/// Does what may lose unsaved changes, or asks first.
pub fn intend(session: &mut Session, intent: Intent) {
    match session.has_changes() {
        true => session.files.undecided = Some(intent),
        false => go_on(session, intent),
    }
}

/// Does it, whatever is lost.
pub fn go_on(session: &mut Session, intent: Intent) {
    session.files.undecided = None;
    match intent {
        Intent::Open(path) => session.open(path),
        // The scene that is being opened takes its place.
        Intent::Reload | Intent::Follow if session.is_opening() => {}
        Intent::Reload | Intent::Follow => {
            if session.files.have_changed() {
                session.editing.forget_written();
            }
            session.files.watch.accept();
            session.reload();
        }
        Intent::Close if session.files.waits_to_save() => {
            session.files.undecided = Some(Intent::CloseUnfinished);
        }
        Intent::Close | Intent::CloseUnfinished => {
            pictures::cancel(session);
            session.files.may_close = true;
        }
    }
}

/// Opens whatever it is: a scene, a folder of scenes, or a picture of the surroundings.
pub fn open(session: &mut Session, paths: Vec<PathBuf>) {
    dropped::open(session, paths);
}

/// Asks the desktop for something to open.
fn ask(session: &mut Session, ctx: &egui::Context) {
    if session.files.asked.is_some() {
        return;
    }
    let folder = session.path.as_deref().and_then(Path::parent);
    let recent = || session.preferences.recent.first().and_then(|p| p.parent());
    let request = Request {
        saves: false,
        kind: None,
        title: "Open a scene, a model or a picture of the surroundings".to_owned(),
        folder: folder.or_else(recent).map(Path::to_owned),
        name: None,
    };
    session.files.asked = Some(session.files.dialogs.ask(request, ctx));
}

/// What happened to files since the last frame.
pub fn update(session: &mut Session, ctx: &egui::Context) {
    take_reply(session);
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
    follow(session, ctx);
    pictures::update(session, ctx);
    closing::close(session, ctx);
    name(session, ctx);
}

fn take_reply(session: &mut Session) {
    let Some(reply) = session.files.asked.as_ref().map(Receiver::try_recv) else {
        return;
    };
    match reply {
        Err(TryRecvError::Empty) => return,
        Ok(Reply::Chosen(path)) => dropped::open(session, vec![path]),
        Ok(Reply::Cancelled) => {}
        Ok(Reply::Unavailable) | Err(TryRecvError::Disconnected) => {
            session.notices.warn(NO_DIALOG.to_owned());
            session.files.typed = Some(String::new());
        }
    }
    session.files.asked = None;
}

/// What to say where the desktop has no dialogs.
pub const NO_DIALOG: &str = "this desktop has no file dialog (no portal answers). Type the path, or drop a file on the window.";

/// Reads a picture of the surroundings.
fn surround(session: &mut Session, path: PathBuf) {
    let (sender, receiver) = channel();
    let from = path.clone();
    let read = move || {
        // The window may have been closed meanwhile.
        let _ = sender.send(import::picture(&from));
    };
    match std::thread::Builder::new().name("load".into()).spawn(read) {
        Ok(_) => session.files.environment = Some((path, receiver)),
        Err(error) => session
            .notices
            .warn(format!("cannot read a picture: {error}.")),
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
            let why = format!("internal fault (reading {path}). Please report it.");
            session.notices.warn(why);
        }
        Ok(Err(error)) => session.notices.warn(advice::import(&error)),
        Ok(Ok(picture)) => {
            session.look.background = None;
            session.edit("Change the background", |scene| {
                scene.pictures.push(picture);
                scene.background = Background::Picture {
                    picture: scene.pictures.len() - 1,
                    strength: 1.0,
                    rotation: 0.0,
                };
            });
            session.moved();
            let name = short(&path);
            session.notices.tell(format!("{name} is all round now"));
            session.files.surroundings.push(path);
        }
    }
    session.files.environment = None;
}

/// Takes up what became of a scene that was read.
pub fn loaded(
    session: &mut Session,
    path: PathBuf,
    again: bool,
    (files, began): (&[PathBuf], SystemTime),
    shown: Result<(), Trouble>,
) {
    let is_first = session.scene().is_none();
    match shown {
        Ok(()) => {
            session.preferences.opened(&path);
            session.files.candidates.clear();
            if !again {
                session.editing.forget_written();
                pictures::abandon(session);
            }
            if let Some(said) = session.files.said.take() {
                session.notices.tell(said);
            } else if again {
                session.notices.tell(format!("read {} again", short(&path)));
            }
            // What is wrong with another file is not mended by this one.
            (session.files.broken).take_if(|broken| !again || broken.path == path);
            session.path = Some(path);
        }
        Err(_) if !again && !session.files.candidates.is_empty() => {
            let next = session.files.candidates.pop_front();
            next.into_iter().for_each(|next| session.open_instead(next));
            return;
        }
        Err(trouble) => {
            session.files.said = None;
            session.files.broken = Some(Broken {
                path: path.clone(),
                trouble,
            });
            // What was never on screen is watched only if nothing else is.
            if !again && !is_first {
                return;
            }
            session.path = Some(path);
        }
    }
    session.files.is_gone = false;
    session.files.to_watch = Some((files.to_vec(), began));
}

/// Takes up that the scene was saved to these files, that of the scene last: they are watched from now
/// on, as they are.
pub fn saved(session: &mut Session, files: Vec<PathBuf>) {
    // The file has what the command line said of the scene.
    session.original = session.scene().cloned();
    session.flags.camera = CameraFlags::default();
    session.flags.options.overrides.clear();
    session.path = files.last().cloned();
    session.files.broken = None;
    session.files.is_gone = false;
    session.files.watch.accept();
    session.files.to_watch = Some((files, SystemTime::now()));
}

/// Reads the scene again when its files have changed.
fn follow(session: &mut Session, ctx: &egui::Context) {
    if let Some((files, since)) = session.files.to_watch.take() {
        let waker = ctx.clone();
        let followed = (session.files.watch).follow(&files, since, move || waker.request_repaint());
        if let Err(why) = followed {
            session.notices.warn(format!(
                "cannot watch the scene's files: {why}. Read the scene again by hand when they change."
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
            session.notices.warn(format!(
                "{} was deleted or moved: the last picture stays, and the scene is read again when it \
                 comes back",
                path.display()
            ));
        }
        ctx.request_repaint();
        return;
    }
    session.files.watch.accept();
    intend(session, Intent::Follow);
}

/// Writes what is on screen into the window's title.
fn name(session: &mut Session, ctx: &egui::Context) {
    let mark = if session.has_changes() { "*" } else { "" };
    let title = format!("{}{mark} · glimray", session.title());
    if session.files.title != title {
        ctx.send_viewport_cmd(ViewportCommand::Title(title.clone()));
        session.files.title = title;
    }
}

/// A file's own name, for sentences.
pub fn short(path: &Path) -> String {
    let name = path.file_name().unwrap_or(path.as_os_str());
    name.to_string_lossy().into_owned()
}

/// Whether a file's name is one of a scene.
fn is_scene(path: &Path) -> bool {
    ends_in(path, import::SCENE_ENDINGS)
}

/// Whether a file's name is one of a picture.
fn is_picture(path: &Path) -> bool {
    ends_in(path, import::PICTURE_ENDINGS)
}
