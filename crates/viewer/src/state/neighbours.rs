//! Small pictures of the scenes beside the present one in its folder.

use glimray_scene::image::ScreenImage;
use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::sync::mpsc::Receiver;

/// A small picture on its way.
#[derive(Clone, Debug, PartialEq)]
pub enum Preview {
    /// The picture waits, or is being rendered.
    Awaited,
    /// The file cannot be rendered, or is too large to be read for this.
    Missing,
    /// The picture.
    Picture(Arc<ScreenImage>),
}

/// The scenes beside the present one, and their small pictures.
#[derive(Default)]
pub struct Neighbours {
    /// A scene, and the next and the previous one of its folder.
    pub(crate) of: Option<(PathBuf, [Option<PathBuf>; 2])>,
    /// Pictures of files, the latest last.
    pub(crate) known: Vec<(PathBuf, Preview)>,
    /// The picture that is being rendered. One is at a time.
    pub(crate) rendering: Option<(PathBuf, Receiver<Option<ScreenImage>>)>,
}

impl Neighbours {
    /// The small picture of a file, as far as it is known.
    pub fn preview(&self, path: &Path) -> Preview {
        let known = self.known.iter().find(|(known, _)| known == path);
        known.map_or(Preview::Awaited, |(_, preview)| preview.clone())
    }
}
