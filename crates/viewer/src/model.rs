//! The window's model: documents, cameras, shortcuts, preferences. Nothing here draws.

pub mod adding;
pub mod bindings;
pub mod camera;
pub mod command_line;
pub mod document;
pub mod environment;
pub mod file_dialog;
pub mod gallery;
pub mod handles;
pub mod histogram;
pub mod listing;
pub mod loader;
pub mod messages;
pub mod modal;
pub mod objects;
pub mod outline;
pub mod playback;
pub mod preferences;
pub mod recording;
pub mod refinement;
pub mod region;
pub mod swatch;
pub mod tool;
pub mod view_settings;
pub mod viewport;
pub mod watch;
