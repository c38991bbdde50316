//! The state of each concern of the window, and the [`session::Session`] that owns them.

pub mod answer;
pub mod asked;
pub mod comparing;
pub mod cursor;
pub mod dialogs;
pub mod dropping;
pub mod editing;
pub mod files;
pub mod film;
pub mod histogram;
pub mod inspector;
pub mod jobs;
pub mod layout;
pub mod neighbours;
pub mod picture_menu;
pub mod pixel_values;
pub mod session;
pub mod sight;
pub mod target;
pub mod texturing;
pub mod time_left;
pub mod walk;
