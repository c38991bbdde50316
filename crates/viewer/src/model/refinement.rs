//! Builds the usual BVHs of a scene in the background while it is shown with drafts of them.

use crate::worker::request::PreparedScene;
use glimray_render::pack::{self, PackError, PackedScene};
use glimray_scene::Scene;
use std::sync::Arc;
use std::sync::mpsc::{Receiver, TryRecvError, channel};

/// The work of a thread of its own. If it is dropped, the thread still finishes what it has begun, for nobody.
pub struct Refinement {
    news: Receiver<Result<PreparedScene, PackError>>,
}

/// How a [`Refinement`] is getting on.
pub enum Refined {
    /// The thread is at work.
    NotYet,
    /// The scene with the BVHs that [`pack::scene`] gives it.
    Scene(PreparedScene),
    /// The scene stays with its drafts.
    Never,
}

impl Refinement {
    /// Starts to pack a scene again. `draft` is a packing of it or of an earlier state of it.
    ///
    /// # Errors
    /// The system starts no thread.
    pub fn new(scene: Arc<Scene>, draft: Arc<PackedScene>) -> std::io::Result<Self> {
        let (sender, news) = channel();
        std::thread::Builder::new()
            .name("refine".into())
            .spawn(move || {
                let packed = pack::refined(&draft, &scene).map(Arc::new);
                // Nobody listens once the scene is closed.
                let _ = sender.send(packed.map(|packed| PreparedScene { scene, packed }));
            })?;
        Ok(Self { news })
    }

    /// The result, once.
    pub fn poll(&mut self) -> Refined {
        match self.news.try_recv() {
            Ok(Ok(prepared)) => Refined::Scene(prepared),
            Err(TryRecvError::Empty) => Refined::NotYet,
            Ok(Err(_)) | Err(TryRecvError::Disconnected) => Refined::Never,
        }
    }
}
