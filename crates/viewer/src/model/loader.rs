//! Loads scenes in the background.

use crate::worker::stage::{Activity, Stage};
use glimray_app::advice;
use glimray_io::import::{self, Fault, ImportError, Step};
use glimray_render::pack::{self, PackedScene};
use glimray_scene::Scene;
use std::ops::Range;
use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::sync::mpsc::{Receiver, TryRecvError, channel};
use std::time::{Instant, SystemTime};

/// A scene that is loading on its own thread. Loading is cancelled when it is dropped.
pub struct Loader {
    /// The file.
    pub path: PathBuf,
    /// Whether it is a reload, which keeps camera, view settings and time.
    pub again: bool,
    /// Whether the flags of the command line apply to it.
    pub is_own: bool,
    /// The current stage, as of the last call of [`Loader::poll`], and the start of loading.
    pub activity: Activity,
    news: Receiver<News>,
}

/// A message of the loading thread.
enum News {
    Stage(Stage),
    Loaded(Box<Loaded>),
}

/// The result of loading.
pub struct Loaded {
    /// The scene, or why it cannot be read.
    pub outcome: Result<Imported, Trouble>,
    /// The scene's file and the files that it refers to, as far as known.
    pub files: Vec<PathBuf>,
    /// When loading started: later changes may be missing.
    pub began: SystemTime,
}

/// A scene, and the same scene packed.
pub struct Imported {
    /// The scene.
    pub scene: Scene,
    /// Packed for rendering, so that the window stays usable while the BVH is built; large meshes with drafts of theirs.
    pub packed: Arc<PackedScene>,
}

/// Why a scene cannot be read.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Trouble {
    /// The error in one line.
    pub message: String,
    /// The line of the file with the error.
    pub line: Option<SourceLine>,
}

/// The line of a file that contains the error, or the relevant part of it.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct SourceLine {
    /// Line number, from 1.
    pub number: usize,
    /// The text without its line end.
    pub text: String,
    /// Byte range of the error in `text`.
    pub span: Range<usize>,
}

impl From<String> for Trouble {
    fn from(message: String) -> Self {
        let line = None;
        Self { message, line }
    }
}

impl From<&ImportError> for Trouble {
    fn from(error: &ImportError) -> Self {
        Self {
            message: advice::import(error),
            line: source_line(error.fault()),
        }
    }
}

fn source_line(fault: &Fault) -> Option<SourceLine> {
    let (position, excerpt) = (fault.position?, fault.excerpt.as_ref()?);
    Some(SourceLine {
        number: position.line,
        span: excerpt.span.clone(),
        text: excerpt.text.clone(),
    })
}

/// Reads, imports and packs a scene. `report` is called before each stage and returns whether to go on;
/// `None` if it was cancelled.
pub fn load(
    path: &Path,
    options: &import::Options,
    report: &dyn Fn(Stage) -> bool,
) -> Option<Loaded> {
    let began = SystemTime::now();
    let (scene, files) = import::load_watched(path, options, &|step| {
        // An import is not interrupted; the next stage is.
        let _ = report(match step {
            Step::Reading(path) => Stage::Reading(path.to_owned()),
            Step::Importing(path) => Stage::Importing(path.to_owned()),
        });
    });
    let outcome = match scene {
        Err(error) => Err(Trouble::from(&error)),
        Ok(scene) => {
            let triangles = scene.triangle_count();
            if !report(Stage::BuildingBvh { triangles }) {
                return None;
            }
            match pack::draft(&scene).map(Arc::new) {
                Ok(packed) => Ok(Imported { scene, packed }),
                Err(error) => Err(Trouble::from(error.to_string())),
            }
        }
    };
    Some(Loaded {
        outcome,
        files,
        began,
    })
}

impl Loader {
    /// Starts loading.
    ///
    /// # Errors
    /// The system starts no thread.
    pub fn new(path: PathBuf, options: import::Options, again: bool) -> std::io::Result<Self> {
        let (sender, news) = channel();
        let from = path.clone();
        std::thread::Builder::new()
            .name("load".into())
            .spawn(move || {
                // Sending fails once the loader is dropped: loading was cancelled, or the window closed.
                let report = |stage| sender.send(News::Stage(stage)).is_ok();
                if let Some(loaded) = load(&from, &options, &report) {
                    let _ = sender.send(News::Loaded(Box::new(loaded)));
                }
            })?;
        Ok(Self {
            activity: Activity {
                stage: Stage::Reading(path.clone()),
                since: Instant::now(),
            },
            path,
            again,
            is_own: again,
            news,
        })
    }

    /// Updates the stage. Returns the result once loading has finished.
    pub fn poll(&mut self) -> Option<Loaded> {
        loop {
            match self.news.try_recv() {
                Ok(News::Stage(stage)) => self.activity.stage = stage,
                Ok(News::Loaded(loaded)) => return Some(*loaded),
                Err(TryRecvError::Empty) => return None,
                Err(TryRecvError::Disconnected) => {
                    let path = self.path.display();
                    let why = format!("Internal error while reading {path}. Please report it.");
                    return Some(Loaded {
                        outcome: Err(why.into()),
                        files: vec![self.path.clone()],
                        began: SystemTime::now(),
                    });
                }
            }
        }
    }
}
