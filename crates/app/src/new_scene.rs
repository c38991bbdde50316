//! The scene that File › New makes, and that an empty file stands for in the window: a sky, and a camera that looks at the
//! origin.

use super::error::AppError;
use glimray_io::import;
use glimray_scene::Scene;

/// The scene in the native format.
pub const TEXT: &str = "\
background = \"sky\"

[output]
integrator = \"path\"

[camera]
look_from = [2.5, 1.2, 7.0]
look_at = [0.0, 0.0, 0.0]
fov_y_deg = 40
";

/// Parses the scene.
///
/// # Errors
/// The text that was compiled in is no scene.
pub fn scene() -> Result<Scene, AppError> {
    Ok(import::parse(
        "new.toml",
        TEXT,
        &import::Options::default(),
    )?)
}
