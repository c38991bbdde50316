//! The built-in scene: the window opens it without a file, and `glimray demo` renders its path-traced version.

use super::error::AppError;
use glimray_io::import;
use glimray_scene::Scene;

/// The scene's name in reports.
pub const NAME: &str = "showcase.toml";

const TEXT: &str = include_str!("showcase.toml");

/// Overrides of the version for paths. The sun lights the balls from behind, and light that is scattered takes the place
/// of ambient light. Balls of pearl take that of glass, and the lens is gone: both need more samples than a demo has time
/// for.
const PATH_TRACED: [&str; 10] = [
    "output.integrator=path",
    "output.size=[800, 450]",
    "output.samples=6",
    "output.antialias=stratified",
    "output.exposure_ev=0.3",
    "background={ bottom = [0.16, 0.085, 0.13], top = [0.025, 0.06, 0.22] }",
    "ambient=[0, 0, 0]",
    "camera={ look_from = [0.35, 3.0, 10.8], look_at = [0.0, 1.12, 0.1], fov_y_deg = 28 }",
    "materials.sun.emission=[2.6, 0.62, 0.11]",
    "materials.glass={ phong = { diffuse = [0.5, 0.44, 0.46] }, reflect = { fresnel = \"schlick\", ior = 2 } }",
];

/// Parses the built-in scene.
///
/// # Errors
/// The text that was compiled in is no scene.
pub fn scene() -> Result<Scene, AppError> {
    Ok(import::parse(NAME, TEXT, &import::Options::default())?)
}

/// The version for paths, which is to be denoised.
///
/// # Errors
/// The text that was compiled in is no scene.
pub fn path_traced() -> Result<Scene, AppError> {
    let options = import::Options {
        overrides: PATH_TRACED.map(str::to_owned).into(),
        ..import::Options::default()
    };
    Ok(import::parse(NAME, TEXT, &options)?)
}
