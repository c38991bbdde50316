//! Another program in whose process a command runs, such as a Python interpreter. A command of `glimray` itself has none:
//! it talks to a terminal, reads files from disks, opens its own device and ends at a signal.
//!
//! A host belongs to the thread that runs the command. Threads that the command starts have none.

use crate::error::AppError;
use glimray_io::import::Resolver;
use glimray_render::gpu::{AdapterChoice, Gpu};
use glimray_render::pack::PackedScene;
use glimray_scene::Scene;
use std::cell::RefCell;
use std::rc::Rc;
use std::sync::Arc;

/// A scene and what it was packed to.
pub type Packed = Arc<(Scene, Arc<PackedScene>)>;

/// Answers what a command asks of its surroundings.
pub trait Host {
    /// Takes a warning: sentences without a label.
    fn warn(&self, text: &str);

    /// Takes the finished fraction of the work, 0 to 1.
    fn progress(&self, done: f64);

    /// Takes what the command prints to standard output.
    fn print(&self, bytes: &[u8]);

    /// Takes the report of a finished run, as JSON.
    fn report(&self, json: &str);

    /// Whether the work is to stop. Asked between two submissions.
    fn is_stopped(&self) -> bool;

    /// The files of the scene, if they are not on a disk.
    fn files(&self) -> Option<&dyn Resolver>;

    /// The scene that was packed last, whose BVHs and pictures a scene with equal parts uses again.
    fn packed(&self) -> Option<Packed>;

    /// Takes a scene that was packed.
    fn keep_packed(&self, packed: Packed);

    /// The device on this adapter, which later commands may use again.
    ///
    /// # Errors
    /// There is no such adapter, or it cannot be opened.
    fn gpu(&self, choice: &AdapterChoice) -> Result<Gpu, AppError>;
}

thread_local! {
    static HOST: RefCell<Option<Rc<dyn Host>>> = const { RefCell::new(None) };
}

/// The host of the command that this thread runs.
pub fn current() -> Option<Rc<dyn Host>> {
    HOST.with_borrow(Clone::clone)
}

/// Runs a command on behalf of `host`.
pub fn with<T>(host: Rc<dyn Host>, command: impl FnOnce() -> T) -> T {
    struct Restored(Option<Rc<dyn Host>>);
    impl Drop for Restored {
        fn drop(&mut self) {
            HOST.set(self.0.take());
        }
    }
    let _restored = Restored(HOST.replace(Some(host)));
    command()
}
