//! Loads scenes in the background.

use crate::app::advice;
use crate::import::{self, Fault, ImportError};
use crate::scene::Scene;
use std::ops::Range;
use std::path::PathBuf;
use std::sync::mpsc::{Receiver, TryRecvError, channel};
use std::time::SystemTime;

/// A scene that is loading on its own thread.
pub struct Loader {
    /// The file.
    pub path: PathBuf,
    /// Whether it is a reload, which keeps camera, view settings and time.
    pub again: bool,
    /// Whether the flags of the command line apply to it.
    pub is_own: bool,
    outcome: Receiver<Loaded>,
}

/// The result of loading.
pub struct Loaded {
    /// The scene, or why it cannot be read.
    pub outcome: Result<Scene, Trouble>,
    /// The scene's file and the files that it refers to, as far as known.
    pub files: Vec<PathBuf>,
    /// When loading started: later changes may be missing.
    pub began: SystemTime,
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

impl Loader {
    /// Starts loading; `wake` is called at the end.
    pub fn new(
        path: PathBuf,
        options: import::Options,
        again: bool,
        wake: impl FnOnce() + Send + 'static,
    ) -> std::io::Result<Self> {
        let (sender, outcome) = channel();
        let from = path.clone();
        std::thread::Builder::new()
            .name("load".into())
            .spawn(move || {
                let began = SystemTime::now();
                let (scene, files) = import::load_watched(&from, &options);
                let outcome = scene.map_err(|error| Trouble::from(&error));
                // The window may have been closed meanwhile.
                let _ = sender.send(Loaded {
                    outcome,
                    files,
                    began,
                });
                wake();
            })?;
        Ok(Self {
            path,
            again,
            is_own: again,
            outcome,
        })
    }

    /// The result, once loading has finished.
    pub fn outcome(&self) -> Option<Loaded> {
        match self.outcome.try_recv() {
            Ok(loaded) => Some(loaded),
            Err(TryRecvError::Empty) => None,
            Err(TryRecvError::Disconnected) => {
                let path = self.path.display();
                let why = format!("Internal error while reading {path}. Please report it.");
                Some(Loaded {
                    outcome: Err(why.into()),
                    files: vec![self.path.clone()],
                    began: SystemTime::now(),
                })
            }
        }
    }
}
