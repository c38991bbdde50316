//! The stills that the picture is compared with, and the reference picture that is being opened.

use crate::app::error::AppError;
use crate::app::picture_file::Picture;
use crate::viewer::model::file_dialog::Reply;
use crate::viewer::model::gallery::Gallery;
use std::path::PathBuf;
use std::sync::mpsc::Receiver;

/// A reference picture on its way from the disk.
pub struct Reading {
    pub(in crate::viewer) path: PathBuf,
    pub(in crate::viewer) outcome: Receiver<Result<Picture, AppError>>,
}

/// The state of comparisons.
#[derive(Default)]
pub struct Comparing {
    /// The stills.
    pub gallery: Gallery,
    /// The typed path of a reference picture.
    pub typed: Option<String>,
    /// The pending reply of the file dialog.
    pub(in crate::viewer) asked: Option<Receiver<Reply>>,
    pub(in crate::viewer) reading: Option<Reading>,
}

impl Comparing {
    /// Whether a reference picture is being read.
    pub fn is_busy(&self) -> bool {
        self.reading.is_some()
    }
}
