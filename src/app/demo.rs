//! `glimray demo`: renders the built-in showcase scene.

use super::cli::{DemoArgs, PartFlags, PictureFlags, SizeFlags};
use super::destination::Destination;
use super::error::AppError;
use super::job::{self, Job};
use super::picture;
use super::report::Draft;
use crate::import;
use crate::scene::Scene;
use std::path::Path;
use std::time::Instant;

/// The showcase scene: its name in reports, and its text.
const NAME: &str = "showcase.toml";
const TEXT: &str = include_str!(concat!(
    env!("CARGO_MANIFEST_DIR"),
    "/assets/scenes/showcase.toml"
));

pub fn run(arguments: &DemoArgs, started: Instant) -> Result<(), AppError> {
    let destination = Destination::new(&arguments.output, Path::new("glimray"));
    job::check_report_name(&arguments.log, destination.path(), |_| false)?;
    let path = destination.path();
    let mut draft = Draft::new("demo", &arguments.log, NAME.into(), path, started);
    let outcome = render(arguments, &destination, &mut draft);
    draft.finish(outcome)
}

fn render(
    arguments: &DemoArgs,
    destination: &Destination,
    draft: &mut Draft,
) -> Result<(), AppError> {
    let loading = Instant::now();
    let scene = scene()?;
    draft.seconds.load = loading.elapsed().as_secs_f64();
    draft.set_scene(&scene);
    let SizeFlags { size, samples } = arguments.size;
    let job = Job {
        scene,
        picture: &PictureFlags {
            size: SizeFlags { size, samples },
            ..PictureFlags::default()
        },
        device: &arguments.device,
        log: &arguments.log,
    };
    let part = PartFlags::default();
    picture::run(&job, destination, (0.0, 0.0), &part, draft)
}

/// Parses the showcase scene.
pub fn scene() -> Result<Scene, AppError> {
    Ok(import::parse(NAME, TEXT, &import::Options::default())?)
}
