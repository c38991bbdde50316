//! Changes of the session by commands, tools and time.

pub mod adding;
pub mod answers;
pub mod box_select;
pub(crate) mod commands;
pub mod comparing;
pub mod cursor;
pub mod dialogs;
pub mod editing;
pub mod files;
pub mod histogram;
pub mod inspector;
mod keyboard;
pub mod lighting;
pub mod measuring;
pub mod modal;
pub mod output_defaults;
pub mod pixel_values;
pub mod region;
pub mod saving;
pub mod selecting;
pub mod settings;
pub mod sight;
mod surface;
pub mod texturing;
pub mod tools;
pub mod update;
pub mod walk;
