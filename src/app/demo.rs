//! `glimray demo`: the showcase scene, which is part of the program, → a picture.

use super::cli::{DemoArgs, PictureFlags, SizeFlags};
use super::destination::Destination;
use super::exit::AppError;
use super::job::Job;
use super::picture;
use crate::import;
use crate::scene::Scene;
use std::path::Path;
use std::time::Instant;

/// The showcase: what reports call it, and its text.
const NAME: &str = "showcase.toml";
const TEXT: &str = include_str!(concat!(
    env!("CARGO_MANIFEST_DIR"),
    "/assets/scenes/showcase.toml"
));

pub fn run(arguments: &DemoArgs, started: Instant) -> Result<(), AppError> {
    let loading = Instant::now();
    let scene = scene()?;
    let SizeFlags { size, samples } = arguments.size;
    let job = Job {
        command: "demo",
        scene_path: NAME.into(),
        scene,
        background: None,
        picture: &PictureFlags {
            size: SizeFlags { size, samples },
            ..PictureFlags::default()
        },
        device: &arguments.device,
        log: &arguments.log,
        started,
        load_seconds: loading.elapsed().as_secs_f64(),
    };
    let destination = Destination::new(&arguments.output, Path::new("glimray"));
    picture::run(&job, &destination, (0.0, 0.0))
}

/// The showcase scene, read anew.
pub fn scene() -> Result<Scene, AppError> {
    Ok(import::parse(NAME, TEXT, &import::Options::default())?)
}
