//! The built-in scene, which `glimray demo` renders and the window opens without a file.

use super::error::AppError;
use crate::import;
use crate::scene::Scene;

/// Its name in reports.
pub const NAME: &str = "showcase.toml";

const TEXT: &str = include_str!(concat!(
    env!("CARGO_MANIFEST_DIR"),
    "/assets/scenes/showcase.toml"
));

/// Parses the built-in scene.
///
/// # Errors
/// The text that was compiled in is no scene.
pub fn scene() -> Result<Scene, AppError> {
    Ok(import::parse(NAME, TEXT, &import::Options::default())?)
}
