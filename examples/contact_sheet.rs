//! Renders every scene and model below some folders, side by side in one picture, and lists them:
//! `cargo run --release --example contact_sheet -- OUT.png FOLDER…`
//!
//! The list says which row and column shows which file, and what was skipped. A file that is refused is
//! listed with its error and leaves no gap.

use glimray::gpu::{AdapterChoice, Gpu};
use glimray::image::Image;
use glimray::import::{self, Options, SCENE_ENDINGS};
use glimray::render::{ExecutionPolicy, RenderSettings, Renderer, Tone};
use glimray::{output, pack};
use std::error::Error;
use std::path::{Path, PathBuf};
use std::sync::Arc;

/// Width and height of a picture.
const SIZE: (u32, u32) = (320, 240);
/// Pictures side by side.
const COLUMNS: usize = 4;

fn main() -> Result<(), Box<dyn Error>> {
    let mut arguments = std::env::args().skip(1).map(PathBuf::from);
    let out = arguments
        .next()
        .ok_or("name the picture to write, and folders")?;
    let mut files = Vec::new();
    for folder in arguments {
        find(&folder, &mut files)?;
    }
    files.sort();
    let mut pictures = Vec::new();
    for file in files {
        match picture(&file) {
            Ok((picture, skipped)) => {
                let (row, column) = (pictures.len() / COLUMNS, pictures.len() % COLUMNS);
                println!("row {}, column {}: {}", row + 1, column + 1, file.display());
                skipped.iter().for_each(|note| println!("    {note}"));
                pictures.push(picture);
            }
            Err(error) => println!("refused: {error}"),
        }
    }
    if pictures.is_empty() {
        return Err("there is no scene or model in these folders".into());
    }
    output::save(&out, &Image::sheet(&pictures, COLUMNS))?;
    Ok(())
}

/// Adds the scenes and models in `folder` and below.
fn find(folder: &Path, files: &mut Vec<PathBuf>) -> Result<(), Box<dyn Error>> {
    for entry in std::fs::read_dir(folder)? {
        let path = entry?.path();
        let ending = path.extension().and_then(|ending| ending.to_str());
        if path.is_dir() {
            find(&path, files)?;
        } else if ending.is_some_and(|ending| SCENE_ENDINGS.contains(&ending)) {
            files.push(path);
        }
    }
    Ok(())
}

/// The picture of a file, and what was skipped.
fn picture(file: &Path) -> Result<(Image, Vec<String>), Box<dyn Error>> {
    let options = Options {
        size: Some(SIZE),
        ..Options::default()
    };
    let scene = import::load_with(file, &options)?;
    let packed = Arc::new(pack::scene(&scene)?);
    let view = packed.frame(&scene.frame(0.0))?;
    let settings = RenderSettings {
        size: SIZE,
        ..RenderSettings::from(&scene.output)
    };
    let gpu = Gpu::new(&AdapterChoice::default())?;
    let mut renderer = Renderer::new(gpu, packed, &view, settings, ExecutionPolicy::default())?;
    while !renderer.is_done() {
        renderer.step()?;
    }
    Ok((renderer.develop(&Tone::from(&scene.output))?, scene.skipped))
}
