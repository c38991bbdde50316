//! `glimray thumbnail MODEL`: a small picture, as file managers ask for it.

use crate::args::{
    DevelopFlags, LayerFlags, LogFlags, OutputFlags, PartFlags, PictureFlags, ProgressMode,
    SettingFlags, ThumbnailArgs,
};
use crate::destination::Destination;
use crate::device::Opening;
use crate::job::Job;
use crate::picture;
use crate::report::Draft;
use glimray_app::error::AppError;
use glimray_app::settings::PictureOverrides;
use glimray_io::import::{self, Baking, Options, Staging};
use glimray_io::output::Format;
use glimray_scene::{Antialias, LightTransport, Scene};
use std::path::Path;
use std::time::Instant;

/// Samples per pixel. Pictures by paths are denoised.
const SAMPLES: u32 = 4;

pub fn run(arguments: &ThumbnailArgs, started: Instant) -> Result<(), AppError> {
    let output = OutputFlags {
        path: Some(arguments.output.clone()),
        format: Some(Format::Png),
        quality: 90,
        no_clobber: false,
    };
    let log = LogFlags {
        report: None,
        count_rays: false,
        progress: ProgressMode::None,
        quiet: true,
        verbose: false,
    };
    let destination = Destination::new(&output, Path::new(""));
    let name = arguments.scene.display().to_string();
    let mut draft = Draft::new("thumbnail", &log, name, destination.path(), started);
    let opening = Opening::start(&arguments.device);
    let options = Options {
        up: arguments.axis.up,
        size: Some((arguments.size, arguments.size)),
        baking: Baking::IfClassical,
        staging: Staging {
            fit: true,
            ..Staging::default()
        },
        by_content: true,
        ..Options::default()
    };
    let scene = draft.load(&arguments.scene, &options, false)?;
    let is_path = scene.output.integrator == LightTransport::Path;
    let job = Job {
        picture: &PictureFlags {
            settings: SettingFlags {
                given: PictureOverrides {
                    size: Some(fitted(&scene, arguments.size)),
                    samples: Some(SAMPLES),
                    antialias: Some(Antialias::Stratified),
                    ..PictureOverrides::default()
                },
            },
            develop: DevelopFlags {
                denoise: is_path,
                ..DevelopFlags::default()
            },
        },
        device: &arguments.device,
        log: &log,
        layers: &LayerFlags::default(),
        scene,
    };
    let part = PartFlags::default();
    picture::run(&job, opening, &destination, (0.0, 0.0), &part, &mut draft)
}

/// The size of a picture that fits a square: the square for a model that is framed for it, else one of the proportions that
/// the scene's camera is made for.
fn fitted(scene: &Scene, side: u32) -> (u32, u32) {
    let (width, height) = scene.output.size;
    if import::is_framed(scene, (side, side)) {
        return (side, side);
    }
    let scale = f64::from(side) / f64::from(width.max(height));
    let scaled = |length: u32| ((f64::from(length) * scale).round() as u32).max(1);
    (scaled(width), scaled(height))
}
