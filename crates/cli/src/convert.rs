//! `glimray convert SCENE`: converts a scene in any format to the native one.

use crate::args::{ConvertArgs, PictureFlags};
use crate::idle_flags;
use crate::interrupt::Interrupt;
use crate::scene_file;
use glimray_app::console;
use glimray_app::error::AppError;
use glimray_app::inputs::Inputs;
use glimray_app::scene_file::save;
use glimray_io::import::{Baking, Options};
use glimray_scene::Scene;
use std::path::PathBuf;

/// The scene to convert, and the files that it was read from. Warns about what a native scene cannot keep.
///
/// # Errors
/// The scene is refused.
pub fn scene(arguments: &ConvertArgs) -> Result<(Scene, Inputs), AppError> {
    idle_flags::check(&arguments.reading, &arguments.scene)?;
    let options = Options {
        baking: Baking::Never,
        ..(arguments.reading).import_options(arguments.axis.up, false, &PictureFlags::default())
    };
    let (scene, inputs) = scene_file::load(&arguments.scene, &options, arguments.reading.strict);
    let scene = scene?;
    if !scene.deformations.is_empty() {
        console::warning(
            "meshes with skins or animated morph targets are written in their pose at time 0: a native \
             scene has no deforming meshes",
        );
    }
    Ok((scene, inputs))
}

pub fn run(arguments: &ConvertArgs) -> Result<(), AppError> {
    Interrupt::install()?;
    let stem = arguments.scene.file_stem().unwrap_or("scene".as_ref());
    // `with_extension` would cut a stem that contains a dot.
    let default = || {
        let mut name = stem.to_owned();
        name.push(".toml");
        PathBuf::from(name)
    };
    let path: PathBuf = arguments.output.clone().unwrap_or_else(default);
    let is_native = path
        .extension()
        .is_some_and(|ending| ending.eq_ignore_ascii_case("toml"));
    if !is_native {
        return Err(AppError::Usage(format!(
            "cannot convert (-o {}): the output is a native scene, whose name must end in .toml. \
             Choose such a name.",
            path.display()
        )));
    }
    let (scene, inputs) = scene(arguments)?;
    inputs.refuse_overwrite(&path, "scene", "-o")?;
    let files = save(&path, &scene, !arguments.no_clobber)?;
    let list = files.iter().map(|path| format!("{}\n", path.display()));
    console::print(&list.collect::<String>())
}
