//! The state of each concern of the window, and the [`session::Session`] that owns them.

pub mod answer;
pub mod comparing;
pub mod cursor;
pub mod dialogs;
pub mod editing;
pub mod files;
pub mod histogram;
pub mod inspector;
pub mod layout;
pub mod session;
pub mod time_left;
