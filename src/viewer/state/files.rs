//! What the window has to do with files: what is open, watched, asked for and being written.

use crate::app::inputs::Inputs;
use crate::image::Image;
use crate::import::ImportError;
use crate::output::Format;
use crate::scene::Picture;
use crate::viewer::model::file_dialog::{FileDialogs, Reply};
use crate::viewer::model::loader::Trouble;
use crate::viewer::model::watch::Watch;
use eframe::egui::ColorImage;
use std::collections::VecDeque;
use std::path::PathBuf;
use std::sync::Arc;
use std::sync::atomic::AtomicBool;
use std::sync::mpsc::Receiver;
use std::time::SystemTime;

/// A picture, or why it cannot be read.
pub type PictureRead = Result<Arc<Picture>, ImportError>;

/// What the window has to do with files.
#[derive(Default)]
pub struct Files {
    /// Who is asked for names.
    pub dialogs: FileDialogs,
    /// The scene that was refused, until it is mended.
    pub broken: Option<Broken>,
    /// A name that is being typed, of what is to be opened.
    pub typed: Option<String>,
    /// The picture that is about to be saved.
    pub saving: Option<SaveDialog>,
    /// What waits until the person says what becomes of unsaved changes.
    pub undecided: Option<Intent>,
    /// The reply to what is to be opened.
    pub(in crate::viewer) asked: Option<Receiver<Reply>>,
    /// What to try next when a scene cannot be read, and what to say when one is.
    pub(in crate::viewer) candidates: VecDeque<PathBuf>,
    pub(in crate::viewer) said: Option<String>,
    pub(in crate::viewer) pending: Pending,
    /// Surroundings that are being read, and where they will come.
    pub(in crate::viewer) environment: Option<(PathBuf, Receiver<PictureRead>)>,
    /// Pictures of surroundings that were read.
    pub(in crate::viewer) surroundings: Vec<PathBuf>,
    pub(in crate::viewer) watch: Watch,
    /// What to watch from now on.
    pub(in crate::viewer) to_watch: Option<(Vec<PathBuf>, SystemTime)>,
    /// Whether the scene's file is not there any more.
    pub(in crate::viewer) is_gone: bool,
    /// For how many frames yet what is pasted is a camera: none comes from an empty clipboard.
    pub(in crate::viewer) awaits_paste: u8,
    pub(in crate::viewer) may_close: bool,
    pub(in crate::viewer) title: String,
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

/// Where a picture goes.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Target {
    /// The file.
    pub path: PathBuf,
    /// By its ending.
    pub format: Format,
    /// Of a JPEG, 1 to 100.
    pub quality: u8,
    /// Whether a file of that name is to be replaced.
    pub replaces: bool,
}

/// The size of a picture that is saved.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum SaveSize {
    /// The picture in the window, with the samples that it has.
    #[default]
    Window,
    /// The scene's size.
    Scene,
    /// Twice the scene's width and height.
    Twice,
}

impl SaveSize {
    /// All, in the order of the dialog.
    pub const ALL: [Self; 3] = [Self::Window, Self::Scene, Self::Twice];

    /// In words.
    pub fn title(self) -> &'static str {
        match self {
            Self::Window => "Window",
            Self::Scene => "Scene size",
            Self::Twice => "Scene size ×2",
        }
    }
}

/// A picture that is rendered for a file.
pub struct Rendering {
    /// What became of it: a message, nothing if it was cancelled, or what went wrong.
    pub(in crate::viewer) receiver: Receiver<Result<Option<String>, String>>,
    /// Set to give it up.
    pub(in crate::viewer) is_cancelled: Arc<AtomicBool>,
}

/// What a person says about a picture that is to be saved.
pub struct SaveDialog {
    /// The file, as it is typed.
    pub path: String,
    /// Of a JPEG, 1 to 100.
    pub quality: u8,
    /// Whether what is drawn over the picture is part of it.
    pub overlays: bool,
    /// The size.
    pub size: SaveSize,
    /// Whether the name is yet to be put under the keys.
    pub is_new: bool,
    /// What no picture may replace: the files of the scene.
    pub(in crate::viewer) inputs: Inputs,
    /// The name that a dialog gave, after asking whether to replace what is there.
    pub(in crate::viewer) agreed: Option<PathBuf>,
    pub(in crate::viewer) asked: Option<Receiver<Reply>>,
}

/// A picture for a file, and what is said about it.
#[derive(Debug)]
pub struct Taken {
    /// `None` while it is not finished, if it is to be.
    pub(in crate::viewer) image: Result<Option<Image>, String>,
    pub(in crate::viewer) samples: u32,
    pub(in crate::viewer) of: u32,
    pub(in crate::viewer) target: Target,
    /// When it waits to be finished: for which scene, counted.
    pub(in crate::viewer) waits: Option<u32>,
}

/// What is on its way to the disk.
#[derive(Default)]
pub struct Pending {
    /// To be saved when the picture is finished.
    pub(in crate::viewer) waiting: Vec<Target>,
    /// For which scene, counted.
    pub(in crate::viewer) turn: u32,
    /// How many are asked of the render thread.
    pub(in crate::viewer) asked: u32,
    pub(in crate::viewer) pose: Option<Pose>,
    pub(in crate::viewer) writing: Vec<Receiver<Result<String, String>>>,
    pub(in crate::viewer) rendering: Vec<Rendering>,
    pub(in crate::viewer) quality: Option<u8>,
    pub(in crate::viewer) folder: Option<PathBuf>,
}

impl Pending {
    /// Tells that the renderer is another one, which answers nothing that the last one was asked.
    pub fn begin(&mut self) {
        self.asked = 0;
        self.pose = None;
    }

    pub fn is_writing(&self) -> bool {
        !self.writing.is_empty()
            || !self.rendering.is_empty()
            || self.asked > 0
            || self.pose.is_some()
    }

    pub fn is_posing(&self) -> bool {
        self.pose.is_some()
    }

    pub fn waits(&self) -> bool {
        !self.waiting.is_empty() || !self.rendering.is_empty()
    }
}

impl SaveDialog {
    /// Where it would go, or why it cannot.
    pub fn target(&self) -> Result<Target, String> {
        let path = PathBuf::from(self.path.trim());
        if path.as_os_str().is_empty() {
            return Err("Type a name, such as picture.png.".to_owned());
        }
        let Some(format) = Format::from_path(&path) else {
            return Err(format!("The name must end in one of {}.", Format::ENDINGS));
        };
        if self.overlays && format.is_linear() {
            return Err("What is drawn over the picture fits .png and .jpg only.".to_owned());
        }
        if path.is_dir() {
            return Err("That is a folder.".to_owned());
        }
        let folder = (path.parent()).filter(|folder| !folder.as_os_str().is_empty());
        if folder.is_some_and(|folder| !folder.is_dir()) {
            return Err("There is no such folder.".to_owned());
        }
        if self.inputs.contain(&path) {
            return Err("The scene reads that file. Choose another name.".to_owned());
        }
        Ok(Target {
            replaces: path.exists(),
            path,
            format,
            quality: self.quality,
        })
    }

    /// Whether a file would be replaced that the person was not asked about.
    pub fn must_ask(&self, target: &Target) -> bool {
        target.replaces && self.agreed.as_ref() != Some(&target.path)
    }
}

/// Frames that sheets and notices need to be out of the way.
const FRAMES: u32 = 2;

/// A photograph that is being taken.
pub struct Pose {
    pub(in crate::viewer) target: Target,
    pub(in crate::viewer) frames: u32,
    pub(in crate::viewer) shot: Option<Receiver<Arc<ColorImage>>>,
}

impl Pose {
    pub fn new(target: Target) -> Self {
        Self {
            target,
            frames: FRAMES,
            shot: None,
        }
    }
}
