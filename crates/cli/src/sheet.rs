//! `glimray sheet MODEL`: named views of a model in one picture, with axes and a scale bar. One renderer renders all of
//! them, so that the scene is packed and uploaded once.

mod canvas;
mod page;
mod shot;

use crate::args::{LayerFlags, PictureFlags, SettingFlags, SheetArgs, VIEWS};
use crate::destination::Destination;
use crate::device::{self, Opening};
use crate::idle_flags;
use crate::interrupt::Interrupt;
use crate::job::{self, Job};
use crate::layers::Finished;
use crate::progress::Progress;
use crate::report::{Draft, SceneReport};
use glam::Vec3;
use glimray_app::error::AppError;
use glimray_app::inputs;
use glimray_app::overrides::SectionChoice;
use glimray_render::{ExecutionPolicy, Integrator};
use glimray_scene::{Backdrop, Background, Geometry, Scene, Shape};
use page::Page;
use shot::Shots;
use std::path::Path;
use std::slice;
use std::time::Instant;

/// The colour behind the model: white and black ones show before it.
const BACKDROP: Vec3 = Vec3::splat(0.45);

/// Samples per pixel of models, and the least share of a reflected or refracted ray: glass makes many faint ones.
const SAMPLES: u32 = 4;
const MIN_THROUGHPUT: f32 = 0.05;

pub fn run(arguments: &SheetArgs, started: Instant) -> Result<(), AppError> {
    let stem = arguments.scene.file_stem().unwrap_or("sheet".as_ref());
    let destination = Destination::new(&arguments.output, Path::new(stem));
    job::check_report_name(&arguments.log, destination.path(), |_| false)?;
    let name = arguments.scene.display().to_string();
    let mut draft = Draft::new("sheet", &arguments.log, name, destination.path(), started);
    let outcome = render(arguments, &destination, &mut draft);
    draft.finish(outcome)
}

fn render(
    arguments: &SheetArgs,
    destination: &Destination,
    draft: &mut Draft,
) -> Result<(), AppError> {
    idle_flags::check(&arguments.reading, &arguments.scene)?;
    if destination.is_film() || destination.is_linear() {
        return Err(AppError::Usage(format!(
            "cannot write a sheet ({}): its letters are no light. Choose a name that ends in .png or .jpg.",
            destination.path().display()
        )));
    }
    let opening = Opening::start(&arguments.device);
    let picture = picture(arguments);
    let (axis, reading) = (&arguments.axis, &arguments.reading);
    let mut scene = draft.load(
        &arguments.scene,
        &reading.import_options(axis.up, true, &picture),
        reading.strict,
    )?;
    let side = arguments.views.size;
    let all: Vec<_> = VIEWS.0.iter().map(|(.., view)| *view).collect();
    let views = match &*arguments.views.views {
        [] => &*all,
        chosen => chosen,
    };
    set_scene(arguments, &picture, &mut scene);
    let shots = Shots::new(&mut scene, views, side)?;
    let job = Job {
        scene,
        picture: &picture,
        device: &arguments.device,
        log: &arguments.log,
        layers: &LayerFlags::default(),
    };

    let interrupt = Interrupt::install()?;
    job.warn_of_skipped()?;
    let settings = job.settings();
    job.check_format(&settings, destination.path(), false, true)?;
    let size = page::size(side, views.len());
    draft.set_image(job.image(destination.path(), &settings, size));
    draft
        .inputs
        .refuse_overwrite(destination.path(), "picture", "-o")?;
    destination.check(size.0, size.1)?;
    job.check_report(draft)?;
    job.check_memory(size, draft)?;
    let mut page = Page::new(side, &shots);
    let policy = ExecutionPolicy {
        picture_count: views.len() as u32,
        ..job.policy()
    };
    let what = format!("{} views of ", views.len());
    let (gpu, packed) = job.pack(opening, (0.0, 0.0), &what, (&settings, &policy), draft)?;
    let (scene, mut view) = packed.clone();
    let tone = job.tone(&settings, false);
    let mut renderer = device::prepared(gpu, packed, settings.clone(), policy, Some(tone))?;
    draft.fetch = Some(device::fetch_report(&renderer)?);

    let _deferred = interrupt.defer();
    let mut progress = Progress::new(job.log);
    let mut black = 0;
    for (index, shot) in shots.list.iter().enumerate() {
        if index > 0 {
            view = scene.view_from(Some(&view), slice::from_ref(&shot.frame))?;
            renderer.set_frame(&view)?;
        }
        while !renderer.is_done() {
            interrupt.check()?;
            renderer.step()?;
            progress.update((index as f64 + renderer.progress()) / views.len() as f64);
        }
        draft.catcher_light += renderer.catcher_light()?;
        let picture = job.finish(&mut renderer, &tone, false)?;
        if let Some(seconds) = picture.denoise_seconds() {
            *draft.seconds.denoise.get_or_insert_default() += seconds;
        }
        black += usize::from(job.is_black(&picture.image, &tone, &settings));
        page.place(index, shot, &picture.image);
    }
    drop(progress);
    interrupt.check()?;
    if black == views.len() {
        job.warn_of_darkness(&tone, &settings);
    }
    let name = arguments.scene.file_name().unwrap_or_default();
    page.write_title(
        &name.to_string_lossy(),
        &SceneReport::new("", &job.scene),
        shots.extent,
    );
    page.draw_scale(&shots);
    let report = page.report(&shots);
    let writing = Instant::now();
    destination.save(&Finished::plain(page.into_image(), false))?;
    draft.seconds.write = writing.elapsed().as_secs_f64();

    let pixels = views.len() as u64 * u64::from(side) * u64::from(side);
    let made = (destination.path(), size, pixels);
    job.conclude(&settings, made, &renderer, Some(report), draft)
}

/// The flags of the picture of a view. A model is rendered by classical rays: they are quick, and show shapes without noise.
fn picture(arguments: &SheetArgs) -> PictureFlags {
    let mut given = arguments.settings.given.clone();
    let side = arguments.views.size;
    given.size = Some((side, side));
    let is_lit = arguments.reading.environment.is_some();
    if inputs::may_be_model(&arguments.scene) && given.integrator.is_none() && !is_lit {
        given.integrator = Some(Integrator::Whitted);
        given.samples.get_or_insert(SAMPLES);
        given.min_throughput.get_or_insert(MIN_THROUGHPUT);
    }
    PictureFlags {
        settings: SettingFlags { given },
        develop: arguments.develop.clone(),
    }
}

/// Puts the scene before one colour, and leaves out the ground that hides a bare model from below.
fn set_scene(arguments: &SheetArgs, picture: &PictureFlags, scene: &mut Scene) {
    let shown = &arguments.views.shown;
    if let Some(SectionChoice(section)) = shown.section {
        scene.section = section;
    }
    if scene.staged && arguments.reading.ground.is_none() {
        let is_ground = |shape: &Shape| matches!(shape.geometry, Geometry::Plane { .. });
        scene.shapes.retain(|shape| !is_ground(shape));
    }
    let color = shown.background.unwrap_or(BACKDROP);
    match picture.overrides().settings(&scene.output).integrator {
        // The light of the background, which mirrors show, stays.
        Integrator::Path => scene.output.backdrop = Backdrop::Color(color),
        _ => {
            scene.output.backdrop = Backdrop::Background;
            scene.background = Background::Color(color);
        }
    }
}
