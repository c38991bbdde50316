//! The thread that renders what the session wants.

pub mod classical;
pub mod comparison;
pub mod error_map;
pub mod film;
pub mod free_name;
pub mod job;
pub mod progressive_image;
pub mod render_thread;
pub mod request;
pub mod stage;
pub mod still;
