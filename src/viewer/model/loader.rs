//! Reading scenes while the window goes on.

use crate::app::advice;
use crate::import::{self, Fault, ImportError};
use crate::scene::Scene;
use std::ops::Range;
use std::path::PathBuf;
use std::sync::mpsc::{Receiver, TryRecvError, channel};
use std::time::SystemTime;

/// A scene that is being read on a thread of its own.
pub struct Loader {
    pub path: PathBuf,
    /// Whether it is the one on screen, of which camera, look and time stay.
    pub again: bool,
    /// Whether what the command line says of a scene is meant for it.
    pub is_own: bool,
    outcome: Receiver<Loaded>,
}

/// What came of it.
pub struct Loaded {
    /// The scene, or why there is none.
    pub outcome: Result<Scene, Trouble>,
    /// The scene's file and those that it refers to, as far as they are known.
    pub files: Vec<PathBuf>,
    /// When it was begun: what was written later may not be in it.
    pub began: SystemTime,
}

/// Why a scene was refused.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Trouble {
    /// In one line.
    pub message: String,
    /// What the file says there.
    pub line: Option<SourceLine>,
}

/// The line of a file that is at fault, or the part of it that matters.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct SourceLine {
    /// Counted from 1.
    pub number: usize,
    /// Without its end.
    pub text: String,
    /// Bytes of `text` to point at.
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
    /// Begins to read; `wake` is called when it is done.
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
                // Nobody waits any more when the window was closed meanwhile.
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

    /// What was read, once it is.
    pub fn outcome(&self) -> Option<Loaded> {
        match self.outcome.try_recv() {
            Ok(loaded) => Some(loaded),
            Err(TryRecvError::Empty) => None,
            Err(TryRecvError::Disconnected) => {
                let path = self.path.display();
                let why = format!("internal fault (reading {path}). Please report it.");
                Some(Loaded {
                    outcome: Err(why.into()),
                    files: vec![self.path.clone()],
                    began: SystemTime::now(),
                })
            }
        }
    }
}
