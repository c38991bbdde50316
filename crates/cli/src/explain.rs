//! `glimray explain SCENE --pixel X,Y`: the ray tree or the paths of a pixel as text, JSON or OBJ lines.

use crate::args::ExplainArgs;
use crate::device;
use crate::idle_flags;
use crate::interrupt::Interrupt;
use crate::job;
use crate::memory;
use crate::scene_file;
use glimray_app::clock::Clock;
use glimray_app::console;
use glimray_app::error::AppError;
use glimray_app::overrides::picture_size;
use glimray_app::value_names::INTEGRATORS;
use glimray_app::{ray_lines, ray_text};
use glimray_io::output;
use glimray_render::{Integrator, RenderSettings, Renderer};
use std::ops::Range;

pub fn run(arguments: &ExplainArgs) -> Result<(), AppError> {
    Interrupt::install()?;
    idle_flags::check(&arguments.reading, &arguments.scene)?;
    let options = (arguments.camera).import_options(&arguments.reading, &arguments.picture);
    let (scene, inputs) = scene_file::load(&arguments.scene, &options, arguments.reading.strict);
    let mut scene = scene?;
    arguments
        .camera
        .overrides(&arguments.reading)
        .apply(&mut scene)?;
    let settings = arguments.picture.overrides().settings(&scene.output);
    check(arguments.pixel, &settings)?;
    if let Some(path) = &arguments.obj {
        inputs.refuse_overwrite(path, "rays", "--obj")?;
        output::check_file(path, true)?;
    }
    for skipped in &scene.skipped {
        console::warning(skipped);
    }
    idle_flags::warn(&arguments.picture, &settings)?;
    let clock = Clock::new(&scene.output, &arguments.motion.overrides());
    let shutter = clock.moment(&arguments.moment.moment());
    memory::check_scene(
        &scene,
        &arguments.scene.display().to_string(),
        settings.size,
    )?;
    let gpu = device::open(&arguments.device)?;
    let policy = job::policy(&arguments.device, false);
    let mut renderer = device::renderer(gpu, &scene, shutter, settings.clone(), policy)?;
    let samples = samples(arguments, &settings, &mut renderer)?;
    let tree = renderer.explain(arguments.pixel, samples)?;
    if let Some(path) = &arguments.obj {
        output::write(path, ray_lines::of(&tree).as_bytes(), true)?;
    }
    if arguments.json {
        return console::print_bytes(ray_text::json(&tree, settings.size)?.as_bytes());
    }
    let text = ray_text::of(&tree, settings.size)
        .map_err(|error| AppError::Internal(format!("explain: {error}")))?;
    console::print(&text)
}

/// Refuses a pixel outside the picture, and views that trace camera rays only.
fn check(pixel: [u32; 2], settings: &RenderSettings) -> Result<(), AppError> {
    if !matches!(settings.integrator, Integrator::Whitted | Integrator::Path) {
        let name = INTEGRATORS.name(&settings.integrator);
        return Err(AppError::Usage(format!(
            "cannot explain (--integrator {name}): only whitted and path trace rays. Choose one of them."
        )));
    }
    picture_size(settings)?;
    let [x0, y0, width, height] = settings.region();
    let ([x, y], [x1, y1]) = (pixel, [x0 + width, y0 + height]);
    if (x0..x1).contains(&x) && (y0..y1).contains(&y) {
        return Ok(());
    }
    let what = match settings.crop {
        None => "the picture",
        Some(_) => "the --crop region",
    };
    Err(AppError::Usage(format!(
        "no such pixel (--pixel {x},{y}): {what} has columns {x0} to {} and rows {y0} to {}. \
         Choose a pixel inside.",
        x1 - 1,
        y1 - 1,
    )))
}

/// The samples to explain. The number that adaptive sampling takes depends on the whole picture, which is
/// therefore rendered first.
fn samples(
    arguments: &ExplainArgs,
    settings: &RenderSettings,
    renderer: &mut Renderer,
) -> Result<Range<u32>, AppError> {
    while settings.is_adaptive() && !renderer.is_done() {
        renderer.step()?;
    }
    let count = renderer.samples_at(arguments.pixel);
    match arguments.sample {
        None => Ok(0..count),
        Some(sample) if sample < count => Ok(sample..sample + 1),
        Some(sample) => Err(AppError::Usage(format!(
            "no such sample (--sample {sample}): the pixel has {count}, from 0 to {}. \
             Choose one of these, or raise --samples.",
            count.saturating_sub(1)
        ))),
    }
}
