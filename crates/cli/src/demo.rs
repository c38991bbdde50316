//! `glimray demo`: renders the built-in showcase scene by path tracing.

use crate::args::{DemoArgs, DevelopFlags, LayerFlags, PartFlags, PictureFlags, SettingFlags};
use crate::destination::Destination;
use crate::device::Opening;
use crate::job;
use crate::job::Job;
use crate::picture;
use crate::report::Draft;
use glimray_app::error::AppError;
use glimray_app::showcase;
use std::path::Path;
use std::time::Instant;

pub fn run(arguments: &DemoArgs, started: Instant) -> Result<(), AppError> {
    let destination = Destination::new(&arguments.output, Path::new("glimray"));
    job::check_report_name(&arguments.log, destination.path(), |_| false)?;
    let path = destination.path();
    let mut draft = Draft::new("demo", &arguments.log, showcase::NAME.into(), path, started);
    let outcome = render(arguments, &destination, &mut draft);
    draft.finish(outcome)
}

fn render(
    arguments: &DemoArgs,
    destination: &Destination,
    draft: &mut Draft,
) -> Result<(), AppError> {
    let opening = Opening::start(&arguments.device);
    let loading = Instant::now();
    let scene = showcase::path_traced()?;
    draft.seconds.load = loading.elapsed().as_secs_f64();
    draft.set_scene(&scene);
    let job = Job {
        scene,
        picture: &PictureFlags {
            settings: SettingFlags {
                given: arguments.size.given.clone(),
            },
            develop: DevelopFlags {
                denoise: true,
                ..DevelopFlags::default()
            },
        },
        device: &arguments.device,
        log: &arguments.log,
        layers: &LayerFlags::default(),
    };
    let part = PartFlags::default();
    picture::run(&job, opening, destination, (0.0, 0.0), &part, draft)
}
