//! The state of files: open, watched, requested and being written.

use crate::model::file_dialog::{FileDialogs, Reply};
use crate::model::file_manager::FileManager;
use crate::model::loader::Trouble;
use crate::model::preferences::SavedCamera;
use crate::model::watch::Watch;
use crate::state::film::FilmDialog;
use crate::state::jobs::{JobId, JobOutcome, Jobs};
use crate::state::neighbours::Neighbours;
use crate::state::target::Target;
use crate::state::texturing::{PictureRead, Texturing};
use crate::worker::still::Still;
use eframe::egui::ColorImage;
use glimray_app::inputs::Inputs;
use glimray_io::import::{ImportError, Options};
use glimray_io::output::Format;
use glimray_scene::Scene;
use glimray_scene::image::ScreenImage;
use std::collections::VecDeque;
use std::path::PathBuf;
use std::sync::Arc;
use std::sync::mpsc::{Receiver, Sender};
use std::time::SystemTime;

/// The state of files.
#[derive(Default)]
pub struct Files {
    /// The source of file dialogs.
    pub dialogs: FileDialogs,
    /// The file manager.
    pub manager: FileManager,
    /// The pending outcome of the file manager.
    pub(crate) shown_in_folder: Option<Receiver<Result<(), String>>>,
    /// The scene that could not be read.
    pub broken: Option<Broken>,
    /// The typed path of a file to open.
    pub typed: Option<String>,
    /// The typed path of a model to add.
    pub typed_model: Option<String>,
    /// The dialog for saving the picture.
    pub saving: Option<SaveDialog>,
    /// The last bookmark, which waits for its small picture, and the key of its scene.
    pub(crate) unpictured: Option<(PathBuf, SavedCamera)>,
    /// A picture for the clipboard.
    pub(crate) copied: Option<Box<ScreenImage>>,
    /// The dialog for a film.
    pub film: Option<FilmDialog>,
    /// Files that are being rendered or written, and those that were.
    pub jobs: Jobs,
    /// The action that waits for an answer about unsaved changes.
    pub undecided: Option<Intent>,
    /// The pending reply of the open dialog.
    pub(crate) asked: Option<Receiver<Reply>>,
    /// The pending reply of the dialog for a model to add.
    pub(crate) asked_model: Option<Receiver<Reply>>,
    /// The model to add that is being read.
    pub(crate) model: Option<(PathBuf, Receiver<Result<Scene, ImportError>>)>,
    /// The picture that is being opened for a material.
    pub texturing: Texturing,
    /// The options of the scene that is shown, while it is read again with another choice of a part.
    pub(crate) before_choice: Option<Options>,
    /// Scenes to try next if one cannot be read, and the message if one can.
    pub(crate) candidates: VecDeque<PathBuf>,
    pub(crate) notice: Option<String>,
    pub(crate) pending: Pending,
    /// The scenes beside this one in its folder.
    pub neighbours: Neighbours,
    /// The environment image that is loading.
    pub(crate) environment: Option<(PathBuf, Receiver<PictureRead>)>,
    /// Environment images loaded so far.
    pub(crate) surroundings: Vec<PathBuf>,
    pub(crate) watch: Watch,
    /// The files to watch from now on.
    pub(crate) to_watch: Option<(Vec<PathBuf>, SystemTime)>,
    /// Whether the scene's file does not exist any more.
    pub(crate) is_gone: bool,
    /// Number of frames in which a paste is taken as a camera; an empty clipboard gives none.
    pub(crate) awaits_paste: u8,
    pub(crate) may_close: bool,
    pub(crate) title: String,
}

/// A scene that cannot be read.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Broken {
    /// The scene's file.
    pub path: PathBuf,
    /// The error.
    pub trouble: Trouble,
}

/// A part of a model's file of which one is shown.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Part {
    /// An animation.
    Clip,
    /// A variant of the materials.
    Variant,
    /// A scene.
    Scene,
}

impl Part {
    /// Label in the window.
    pub fn title(self) -> &'static str {
        match self {
            Self::Clip => "Clip",
            Self::Variant => "Variant",
            Self::Scene => "Scene",
        }
    }

    /// The choice that leaves it to the file.
    pub fn left_to_the_file(self) -> &'static str {
        match self {
            Self::Clip => "All that fit together",
            Self::Variant => "Without variant",
            Self::Scene => "The file's own",
        }
    }

    /// Explains the choice.
    pub fn tip(self) -> &'static str {
        match self {
            Self::Clip => {
                "The animation that is played. Of several that move the same, the first is played"
            }
            Self::Variant => "The variant of the model's materials",
            Self::Scene => "The scene of the file that is shown",
        }
    }
}

/// An action that discards unsaved changes.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Intent {
    /// Open another scene.
    Open(PathBuf),
    /// Make a new scene.
    New,
    /// Reload the scene.
    Reload,
    /// Reload the scene because its file has changed.
    ReloadChanged,
    /// Read the scene again with another choice of a part, by name or number; `None` leaves it to the file.
    Choose(Part, Option<String>),
    /// Close the window.
    Close,
    /// Close the window although a picture waits to be saved.
    CloseUnfinished,
}

impl Files {
    /// Resets what was applied to the previous window.
    pub fn reopened(&mut self) {
        self.title.clear();
        self.pending.reopened();
        let files = self.watch.files();
        if !files.is_empty() {
            self.to_watch = Some((files, SystemTime::now()));
            // The old watcher would wake a closed window.
            self.watch = Watch::default();
        }
    }

    /// Whether pending work will change the window.
    pub fn is_busy(&self) -> bool {
        self.watch.is_busy()
            || self.to_watch.is_some()
            || self.environment.is_some()
            || self.model.is_some()
            || self.texturing.is_busy()
            || self.neighbours.rendering.is_some()
            || self.pending.is_posing()
    }

    /// Whether a picture is being fetched, rendered or written.
    pub fn is_writing(&self) -> bool {
        self.pending.is_posing() || self.jobs.is_busy()
    }

    /// Whether a file of the scene has changed and was not reloaded yet.
    pub fn have_changed(&self) -> bool {
        self.watch.has_changed()
    }

    /// The input files of the scene, which no picture may replace.
    pub fn inputs(&self) -> Inputs {
        Inputs::new(self.watch.files().iter().chain(&self.surroundings))
    }

    /// Whether a screenshot is about to be taken, so that nothing may cover the picture.
    pub fn is_posing(&self) -> bool {
        self.pending.is_posing()
    }

    /// Whether a file is being rendered, or a picture is to be saved when it is finished.
    pub fn waits_to_save(&self) -> bool {
        self.jobs.lasting().next().is_some()
    }
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

    /// Label in the dialog.
    pub fn title(self) -> &'static str {
        match self {
            Self::Window => "Window",
            Self::Scene => "Scene size",
            Self::Twice => "Scene size ×2",
        }
    }
}

/// The state of the dialog for saving the picture.
pub struct SaveDialog {
    /// The typed path.
    pub path: String,
    /// JPEG quality, 1 to 100.
    pub quality: u8,
    /// Whether overlays are included.
    pub overlays: bool,
    /// The size.
    pub size: SaveSize,
    /// Whether the name field has not been focused yet.
    pub is_new: bool,
    /// The input files of the scene, which no picture may replace.
    pub(crate) inputs: Inputs,
    /// The path from a file dialog, which has confirmed replacing it.
    pub(crate) agreed: Option<PathBuf>,
    pub(crate) asked: Option<Receiver<Reply>>,
}

/// A picture from the render thread, with its target.
#[derive(Debug)]
pub struct Captured {
    /// `None` if the picture must be finished first.
    pub(crate) still: Result<Option<Still>, String>,
    pub(crate) samples: u32,
    pub(crate) of: u32,
    pub(crate) target: Target,
    /// For a picture that waits: the index of its scene.
    pub(crate) waits: Option<u32>,
    /// The job, and the way to end it.
    pub(crate) job: JobId,
    pub(crate) sender: Sender<JobOutcome>,
}

/// Pictures on their way to the disk.
#[derive(Default)]
pub struct Pending {
    /// Index of the current scene.
    pub(crate) turn: u32,
    pub(crate) pose: Option<Pose>,
    pub(crate) quality: Option<u8>,
    pub(crate) folder: Option<PathBuf>,
}

impl Pending {
    /// Drops the screenshot of the previous window.
    pub fn reopened(&mut self) {
        self.pose = None;
    }

    /// Whether the window is about to be captured.
    pub fn is_posing(&self) -> bool {
        self.pose.is_some()
    }
}

impl SaveDialog {
    /// The target, or why it is invalid.
    ///
    /// # Errors
    /// One line for the user.
    pub fn target(&self) -> Result<Target, String> {
        let path = PathBuf::from(self.path.trim());
        if path.as_os_str().is_empty() {
            return Err("Enter a name, such as picture.png.".to_owned());
        }
        let Some(format) = Format::from_path(&path) else {
            return Err(format!("The name must end in one of {}.", Format::ENDINGS));
        };
        if self.overlays && format.is_linear() {
            return Err("Overlays can only be saved as .png or .jpg.".to_owned());
        }
        if path.is_dir() {
            return Err("This is a folder.".to_owned());
        }
        let folder = (path.parent()).filter(|folder| !folder.as_os_str().is_empty());
        if folder.is_some_and(|folder| !folder.is_dir()) {
            return Err("The folder does not exist.".to_owned());
        }
        if self.inputs.contain(&path) {
            return Err("The scene uses this file. Choose another name.".to_owned());
        }
        Ok(Target {
            replaces: path.exists(),
            path,
            format,
            quality: self.quality,
            // Known when the picture is taken.
            opacity: false,
        })
    }

    /// Whether replacing an existing file must be confirmed.
    pub fn must_ask(&self, target: &Target) -> bool {
        target.replaces && self.agreed.as_ref() != Some(&target.path)
    }
}

/// Number of frames until dialogs and messages are hidden.
const FRAMES: u32 = 2;

/// A screenshot in progress.
pub struct Pose {
    pub(crate) target: Target,
    pub(crate) frames: u32,
    pub(crate) screenshot: Option<Receiver<Arc<ColorImage>>>,
}

impl Pose {
    /// Prepares a screenshot of the picture with its overlays for `target`.
    pub fn new(target: Target) -> Self {
        Self {
            target,
            frames: FRAMES,
            screenshot: None,
        }
    }
}
