//! Native file dialogs, opened without blocking. Tests replace them.

use eframe::egui;
use glimray_io::import;
use std::path::{Path, PathBuf};
use std::sync::mpsc::{Receiver, TryRecvError, channel};
use std::time::{Duration, Instant};

/// A reply this soon means that the dialog did not open.
const NOBODY: Duration = Duration::from_millis(150);

/// A kind of files: its title and the file name extensions.
pub type Kind = (&'static str, &'static [&'static str]);

/// The formats of saved pictures.
pub const PICTURES: Kind = ("Pictures", &["png", "jpg", "jpeg", "exr", "hdr"]);

/// The formats of films: videos, and pictures for single frames.
pub const FILMS: Kind = (
    "Films",
    &["mp4", "gif", "y4m", "png", "jpg", "jpeg", "exr", "hdr"],
);

/// Scenes that can be saved.
pub const SCENES: Kind = ("Scenes", &["toml"]);

/// A request for a file name.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Request {
    /// Whether a new file is saved rather than an existing one opened.
    pub saves: bool,
    /// The kind of the file; `None` for everything that the window opens.
    pub kind: Option<Kind>,
    /// The title of the dialog.
    pub title: String,
    /// The folder to start in.
    pub folder: Option<PathBuf>,
    /// The suggested name.
    pub name: Option<String>,
}

impl Request {
    /// A request for the name of a new file, with `path` as the suggestion.
    pub fn save(title: &str, kind: Kind, path: &Path) -> Self {
        let folder = path.parent().filter(|folder| folder.is_dir());
        Self {
            saves: true,
            kind: Some(kind),
            title: title.to_owned(),
            folder: folder.map(Path::to_owned),
            name: path.file_name().map(|n| n.to_string_lossy().into_owned()),
        }
    }
}

/// The reply of a dialog.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Reply {
    /// The chosen file. For a new one, replacing an existing file was confirmed.
    Chosen(PathBuf),
    /// The dialog was cancelled.
    Cancelled,
    /// No dialog is available on this desktop.
    Unavailable,
}

/// Takes the reply of a dialog, once there is one. A dialog that ended without a reply was not available.
pub fn take_reply(asked: &mut Option<Receiver<Reply>>) -> Option<Reply> {
    let reply = match asked.as_ref()?.try_recv() {
        Err(TryRecvError::Empty) => return None,
        Err(TryRecvError::Disconnected) => Reply::Unavailable,
        Ok(reply) => reply,
    };
    *asked = None;
    Some(reply)
}

/// The source of replies.
pub struct FileDialogs(Box<Ask>);

/// Opens a dialog and returns the channel of its reply.
type Ask = dyn Fn(Request, &egui::Context) -> Receiver<Reply>;

impl Default for FileDialogs {
    /// The native dialogs.
    fn default() -> Self {
        Self(Box::new(desktop))
    }
}

impl FileDialogs {
    /// Dialogs that reply at once, for tests.
    pub fn answering(answer: impl Fn(Request) -> Reply + 'static) -> Self {
        Self(Box::new(move |request, _| {
            let (sender, receiver) = channel();
            // The receiver still exists here.
            let _ = sender.send(answer(request));
            receiver
        }))
    }

    /// Opens a dialog. The reply comes later and requests a repaint of `ctx`.
    pub fn ask(&self, request: Request, ctx: &egui::Context) -> Receiver<Reply> {
        (self.0)(request, ctx)
    }
}

fn desktop(request: Request, ctx: &egui::Context) -> Receiver<Reply> {
    let mut dialog = rfd::AsyncFileDialog::new().set_title(&request.title);
    if let Some(folder) = request
        .folder
        .as_deref()
        .and_then(|f| f.canonicalize().ok())
    {
        dialog = dialog.set_directory(folder);
    }
    if let Some(name) = &request.name {
        dialog = dialog.set_file_name(name);
    }
    if let Some((name, endings)) = request.kind {
        dialog = dialog.add_filter(name, endings);
    }
    let (sender, receiver) = channel();
    let ctx = ctx.clone();
    // macOS requires that dialogs are created on this thread; waiting works anywhere.
    let answer: Box<dyn FnOnce() -> Option<rfd::FileHandle> + Send> = match request.saves {
        true => {
            let dialog = dialog.save_file();
            Box::new(move || pollster::block_on(dialog))
        }
        false => {
            let endings = [import::SCENE_ENDINGS, import::PICTURE_ENDINGS].concat();
            if request.kind.is_none() {
                dialog = dialog
                    .add_filter("Scenes, models and images", &endings)
                    .add_filter("Scenes and models", import::SCENE_ENDINGS)
                    .add_filter("Environment images", import::PICTURE_ENDINGS);
            }
            let dialog = dialog.pick_file();
            Box::new(move || pollster::block_on(dialog))
        }
    };
    let wait = move || {
        let start = Instant::now();
        let reply = match answer() {
            Some(file) => Reply::Chosen(file.path().to_owned()),
            None if start.elapsed() < NOBODY || !has_dialogs() => Reply::Unavailable,
            None => Reply::Cancelled,
        };
        // The window may have been closed meanwhile.
        let _ = sender.send(reply);
        ctx.request_repaint();
    };
    // Without a thread the sender is dropped, which counts as an unavailable dialog.
    let _ = std::thread::Builder::new()
        .name("dialog".into())
        .spawn(wait);
    receiver
}

/// Whether this desktop can show dialogs: on Linux they need a session bus or zenity.
fn has_dialogs() -> bool {
    if !cfg!(target_os = "linux") {
        return true;
    }
    let folder = std::env::var_os("XDG_RUNTIME_DIR").map(PathBuf::from);
    let has_bus = std::env::var_os("DBUS_SESSION_BUS_ADDRESS").is_some()
        || folder.is_some_and(|folder| folder.join("bus").exists());
    let is_there = |folder: PathBuf| folder.join("zenity").is_file();
    let path = std::env::var_os("PATH").unwrap_or_default();
    has_bus || std::env::split_paths(&path).any(is_there)
}

/// Whether a file name has one of these extensions, ignoring case.
pub fn ends_in(path: &Path, endings: &[&str]) -> bool {
    let ending = path.extension().map(|e| e.to_ascii_lowercase());
    ending.is_some_and(|found| endings.iter().any(|known| *known == found))
}
