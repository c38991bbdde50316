//! The desktop's own dialogs, asked without waiting for them. Tests answer in their place.

use crate::import;
use eframe::egui;
use std::path::{Path, PathBuf};
use std::sync::mpsc::{Receiver, channel};
use std::time::{Duration, Instant};

/// Nobody closes a dialog this soon: one that did not come up did.
const NOBODY: Duration = Duration::from_millis(150);

/// What files of a kind are called together, and how their names may end.
pub type Kind = (&'static str, &'static [&'static str]);

/// Pictures as they are saved.
pub const PICTURES: Kind = ("Pictures", &["png", "jpg", "jpeg", "exr", "hdr"]);

/// Scenes as they are saved.
pub const SCENES: Kind = ("Scenes", &["toml"]);

/// What a dialog is to find out.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Request {
    /// Whether a new file is wanted, rather than one that is there.
    pub saves: bool,
    /// What a new file is called and how its name may end.
    pub kind: Option<Kind>,
    /// What it is for.
    pub title: String,
    /// Where to begin.
    pub folder: Option<PathBuf>,
    /// What to suggest.
    pub name: Option<String>,
}

/// What it found out.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Reply {
    /// A file; for a new one the person has agreed to replace what has that name.
    Chosen(PathBuf),
    /// None is wanted.
    Cancelled,
    /// There is no such dialog on this desktop.
    Unavailable,
}

/// Who is asked.
pub struct FileDialogs(Box<Ask>);

/// Asks, and says where the reply will come.
type Ask = dyn Fn(Request, &egui::Context) -> Receiver<Reply>;

impl Default for FileDialogs {
    /// The desktop.
    fn default() -> Self {
        Self(Box::new(desktop))
    }
}

impl FileDialogs {
    /// Someone who answers at once.
    pub fn answering(answer: impl Fn(Request) -> Reply + 'static) -> Self {
        Self(Box::new(move |request, _| {
            let (sender, receiver) = channel();
            // The receiver is right here.
            let _ = sender.send(answer(request));
            receiver
        }))
    }

    /// Asks; the reply comes some time later, and `ctx` is woken for it.
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
    let (sender, receiver) = channel();
    let ctx = ctx.clone();
    // On a Mac the dialog must be made here, and may be waited for anywhere.
    let answer: Box<dyn FnOnce() -> Option<rfd::FileHandle> + Send> = match request.saves {
        true => {
            if let Some((name, endings)) = request.kind {
                dialog = dialog.add_filter(name, endings);
            }
            let dialog = dialog.save_file();
            Box::new(move || pollster::block_on(dialog))
        }
        false => {
            let endings = [import::SCENE_ENDINGS, import::PICTURE_ENDINGS].concat();
            let dialog = dialog
                .add_filter("Scenes, models and pictures", &endings)
                .add_filter("Scenes and models", import::SCENE_ENDINGS)
                .add_filter("Pictures of the surroundings", import::PICTURE_ENDINGS)
                .pick_file();
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
    // Without a thread the sender is dropped, and that is taken for a dialog that is not there.
    let _ = std::thread::Builder::new()
        .name("dialog".into())
        .spawn(wait);
    receiver
}

/// Whether this desktop can have dialogs at all: on Linux they come over its bus, or from a program.
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

/// Whether a file's name ends in one of these, in upper or lower case.
pub fn ends_in(path: &Path, endings: &[&str]) -> bool {
    let ending = path.extension().map(|e| e.to_ascii_lowercase());
    ending.is_some_and(|found| endings.iter().any(|known| *known == found))
}
