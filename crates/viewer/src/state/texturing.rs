//! A picture on its way from the disk to a material.

use crate::model::file_dialog::Reply;
use crate::model::texture_slots::TextureSlot;
use glimray_io::import::ImportError;
use glimray_scene::Picture;
use std::path::PathBuf;
use std::sync::mpsc::Receiver;
use std::sync::{Arc, Weak};

/// An image, or why it cannot be read.
pub type PictureRead = Result<(Arc<Picture>, Vec<String>), ImportError>;

/// Where a picture goes: a slot of materials.
pub struct TexturePlace {
    pub(crate) slot: &'static TextureSlot,
    /// Indices of materials and their labels.
    pub(crate) materials: Vec<(usize, String)>,
}

/// The state of opening pictures for materials.
#[derive(Default)]
pub struct Texturing {
    pub(crate) opening: Option<(TexturePlace, Stage)>,
    /// The names of the files of pictures that were opened.
    pub(crate) names: Vec<(Weak<Picture>, String)>,
}

/// How far it has come.
pub enum Stage {
    /// The file dialog is open.
    Asked(Receiver<Reply>),
    /// The path is being typed.
    Typed(Option<String>),
    /// The file is read.
    Reading(PathBuf, Receiver<PictureRead>),
}

impl Texturing {
    /// Whether a file is being read.
    pub fn is_busy(&self) -> bool {
        matches!(self.opening, Some((_, Stage::Reading(..))))
    }

    /// Whether the path is being typed.
    pub fn is_typing(&self) -> bool {
        matches!(self.opening, Some((_, Stage::Typed(_))))
    }

    /// The path that is being typed.
    pub fn typed(&mut self) -> Option<&mut Option<String>> {
        match &mut self.opening {
            Some((_, Stage::Typed(text))) => Some(text),
            _ => None,
        }
    }

    /// The names of the files of pictures that were opened.
    pub fn names(&self) -> &[(Weak<Picture>, String)] {
        &self.names
    }
}
