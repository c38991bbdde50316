//! `glimray view [SCENE]`: the interactive window. What renders is what renders everywhere; only who
//! asks for the next step, and where the picture goes, is this folder's.

pub mod bindings;
pub mod canvas;
pub mod command_line;
mod commands;
pub mod document;
pub mod editing;
pub mod files;
pub mod inspector;
pub mod layout;
mod loader;
pub mod look;
pub mod navigation;
mod notices;
pub mod objects;
pub mod order;
pub mod outline;
mod panels;
pub mod playback;
pub mod preferences;
mod presses;
pub mod question;
pub mod region;
pub mod render_thread;
pub mod replay;
pub mod session;
pub mod sheets;
mod textures;
pub mod tools;
pub mod viewer;
pub mod viewport;
pub mod window;

use super::cli::{Cli, Command, ViewArgs};
use super::error::AppError;
use clap::Parser;

/// Opens the window and returns when it is closed.
///
/// # Errors
/// There is no display, or no usable adapter.
pub fn run(arguments: ViewArgs) -> Result<(), AppError> {
    let choice = arguments.device.choice();
    let store = preferences::Store::of_this_system();
    window::run(session::Session::new(arguments, store)?, &choice)
}

/// A session as `glimray view WORDS…` begins it, with its preferences in `store`. For whoever opens a
/// window of their own; tests do.
///
/// # Errors
/// The words are no such command line.
pub fn session<'a>(
    words: impl IntoIterator<Item = &'a str>,
    store: preferences::Store,
) -> Result<session::Session, AppError> {
    let words = ["glimray", "view"].into_iter().chain(words);
    match Cli::try_parse_from(words) {
        Ok(Cli {
            command: Command::View(arguments),
        }) => session::Session::new(*arguments, store),
        Ok(_) => Err(AppError::Usage("not a `view`".into())),
        Err(error) => Err(AppError::Usage(error.to_string())),
    }
}
