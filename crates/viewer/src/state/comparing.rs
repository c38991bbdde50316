//! The stills that the picture is compared with, and the reference picture that is being opened.

use crate::model::file_dialog::Reply;
use crate::model::gallery::{Gallery, StillId};
use glimray_app::error::AppError;
use glimray_app::picture_file::Picture;
use std::path::PathBuf;
use std::sync::mpsc::Receiver;

/// A reference picture on its way from the disk.
pub struct Reading {
    pub(crate) path: PathBuf,
    pub(crate) outcome: Receiver<Result<Picture, AppError>>,
}

/// The state of comparisons.
#[derive(Default)]
pub struct Comparing {
    /// The stills.
    pub gallery: Gallery,
    /// The still that is given another name, and what is typed so far.
    pub renaming: Option<(StillId, String)>,
    /// The typed path of a reference picture.
    pub typed: Option<String>,
    /// The pending reply of the file dialog.
    pub(crate) asked: Option<Receiver<Reply>>,
    pub(crate) reading: Option<Reading>,
}

impl Comparing {
    /// Whether a reference picture is being read.
    pub fn is_busy(&self) -> bool {
        self.reading.is_some()
    }
}
