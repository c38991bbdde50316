//! `glimray view [SCENE]`: the interactive window. The same renderer as everywhere renders; the window
//! decides what is asked of it and where the picture goes.
//!
//! Tiers import downwards only: window → ui → actions → state → model → worker.

pub mod actions;
pub mod bench;
pub mod model;
pub mod state;
pub mod ui;
pub mod window;
pub mod worker;

use glimray_app::error::AppError;
use glimray_app::window::{ViewRequest, Window};
use model::preferences::Store;
use state::session::Session;

/// The window as the command line sees it.
pub const WINDOW: Window = Window {
    has_display: window::has_display,
    open,
    bench: bench::run,
};

/// Opens the window and returns when it is closed.
///
/// # Errors
/// There is no display, or no usable adapter.
pub fn open(request: ViewRequest) -> Result<(), AppError> {
    let adapter = request.adapter.clone();
    window::run(Session::new(request, Store::of_this_system())?, &adapter)
}
