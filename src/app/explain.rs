//! `glimray explain SCENE --pixel X,Y`: the ray tree of a pixel as text, JSON or OBJ lines.

pub mod lines;
pub mod text;

use super::cli::{ExplainArgs, INTEGRATORS};
use super::clock::Clock;
use super::console;
use super::device;
use super::error::AppError;
use super::interrupt::Interrupt;
use super::job;
use super::memory;
use super::overrides;
use super::scene_file;
use crate::gpu::Gpu;
use crate::output;
use crate::render::{Integrator, RayTree, RenderSettings, Renderer};
use serde_json::json;
use std::ops::Range;

pub fn run(arguments: &ExplainArgs) -> Result<(), AppError> {
    Interrupt::install()?;
    let (scene, inputs) = scene_file::load(&arguments.scene, &arguments.reading);
    let mut scene = scene?;
    overrides::apply(&mut scene, &arguments.camera)?;
    let settings = job::picture_settings(&scene.output, &arguments.picture);
    check(arguments.pixel, &settings)?;
    if let Some(path) = &arguments.obj {
        inputs.spare(path, "rays", "--obj")?;
        output::check_file(path, true)?;
    }
    for skipped in &scene.skipped {
        console::warning(skipped);
    }
    let shot = Clock::new(&scene.output, &arguments.motion).moment(&arguments.moment);
    memory::check_scene(
        &scene,
        &arguments.scene.display().to_string(),
        settings.size,
    )?;
    let gpu = Gpu::new(&arguments.device.choice())?;
    let policy = job::policy(&arguments.device, false);
    let (mut renderer, _) = device::renderer(gpu, &scene, shot, settings.clone(), policy)?;
    let samples = samples(arguments, &settings, &mut renderer)?;
    let tree = renderer.explain(arguments.pixel, samples)?;
    if let Some(path) = &arguments.obj {
        output::write(path, lines::of(&tree).as_bytes(), true)?;
    }
    if arguments.json {
        return console::print_bytes(json(&tree, settings.size)?.as_bytes());
    }
    let text = text::of(&tree, settings.size)
        .map_err(|error| AppError::Internal(format!("explain: {error}")))?;
    console::print(&text)
}

/// Refuses a pixel outside the picture, and integrators without a ray tree.
fn check(pixel: [u32; 2], settings: &RenderSettings) -> Result<(), AppError> {
    if settings.integrator != Integrator::Whitted {
        let word = INTEGRATORS.word(&settings.integrator);
        return Err(AppError::Usage(format!(
            "cannot explain (--integrator {word}): only whitted has a ray tree. Omit --integrator."
        )));
    }
    job::picture_size(settings)?;
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

/// The output of `--json`: the tree with the picture's size and the weighted sum.
///
/// # Errors
/// The tree cannot be serialized, which would be a bug.
pub fn json(tree: &RayTree, (width, height): (u32, u32)) -> Result<String, AppError> {
    let mut value = serde_json::to_value(tree)
        .map_err(|error| AppError::Internal(format!("explain: {error}")))?;
    value["size"] = json!([width, height]);
    value["sum"] = json!(text::weighted_sum(tree).to_array());
    Ok(format!("{value:#}\n"))
}
