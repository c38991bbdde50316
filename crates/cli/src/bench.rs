//! `glimray bench`: whole renders of built-in workloads, ray sets in procedural scenes, a skinned figure that plays,
//! the denoiser, and the time to the first picture. Everything is measured once, then again, so that a change of the machine's speed affects all alike;
//! medians are reported.

mod comparison;
mod denoiser;
mod export;
mod figure;
mod first_picture;
mod playing;
mod random;
pub mod ray_sets;
mod renders;
mod scene_runs;
pub mod scenes;
mod walk;
mod workloads;

use crate::args::BenchArgs;
use crate::device;
use crate::interrupt::Interrupt;
use crate::job;
use comparison::Baseline;
use denoiser::Denoiser;
use glimray_app::console;
use glimray_app::error::AppError;
use glimray_app::window::{BenchRequest, Window};
use playing::Playing;
use renders::Renders;
use scene_runs::SceneRuns;

pub(super) fn run(arguments: &BenchArgs, program: Option<&Window>) -> Result<(), AppError> {
    Interrupt::install()?;
    let is_quick = arguments.quick;
    let is_selected = |name: &str| match &arguments.only {
        Some(part) => name.contains(part.as_str()),
        None => true,
    };
    let procedural: Vec<_> = (scenes::ALL.iter())
        .filter(|scene| is_selected(scene.name) && !(is_quick && scene.is_large))
        .collect();
    if let Some(folder) = &arguments.export_rays {
        return match (&procedural[..], &arguments.only) {
            ([], Some(part)) => Err(nothing_named(part, "no scene")),
            (scenes, _) => export::write(folder, scenes, is_quick),
        };
    }
    let baseline = match &arguments.compare {
        Some(path) => Some((path, Baseline::read(path, is_quick)?)),
        None => None,
    };
    let gpu = device::open(&arguments.device)?;
    let mut pictures = first_picture::selected(is_selected, &arguments.device)?;
    let mut renders: Vec<_> = workloads::all(is_quick)?
        .into_iter()
        .filter(|workload| is_selected(workload.name))
        .map(Renders::new)
        .collect();
    let mut scenes: Vec<_> = (procedural.into_iter())
        .map(|scene| SceneRuns::new(scene, is_quick))
        .collect();
    let mut playing = match is_selected(playing::NAME) {
        true => Some(Playing::new(is_quick)?),
        false => None,
    };
    let mut denoiser = match is_selected(denoiser::NAME) {
        true => Some(Denoiser::new(&gpu, is_quick)?),
        false => None,
    };
    let program = program.filter(|_| is_selected("viewer"));
    let has_none = pictures.is_empty()
        && renders.is_empty()
        && scenes.is_empty()
        && playing.is_none()
        && denoiser.is_none();
    if let (true, None, Some(part)) = (has_none, program, &arguments.only) {
        return Err(nothing_named(part, "no measurement"));
    }
    for _ in 0..arguments.repeats() {
        pictures.iter_mut().try_for_each(|picture| picture.run())?;
        (renders.iter_mut()).try_for_each(|workload| workload.run(arguments))?;
        (scenes.iter_mut()).try_for_each(|scene| scene.run(&gpu, arguments))?;
        (playing.iter_mut()).try_for_each(|playing| playing.run(&gpu, arguments))?;
        (denoiser.iter_mut()).try_for_each(|denoiser| denoiser.run(&gpu))?;
    }
    let pictures: Vec<_> = pictures.iter().map(|picture| picture.row()).collect();
    let renders: Vec<_> = renders.iter().map(Renders::row).collect();
    let scenes: Vec<_> = scenes.iter().map(SceneRuns::row).collect();
    let playing: Vec<_> = playing.iter().map(Playing::row).collect();
    let denoiser: Vec<_> = denoiser.iter().map(Denoiser::row).collect();
    let window = window(arguments, program)?;
    let (viewer, viewer_text) = window.unzip();

    let mut run = serde_json::json!({
        "glimray": env!("CARGO_PKG_VERSION"),
        "adapter": crate::report::Adapter::from(gpu.adapter()),
        "repeats": arguments.repeats(),
        "quick": is_quick,
        "first_pictures": pictures,
        "workloads": renders,
        "scenes": scenes,
        "playing": playing,
        "denoiser": denoiser,
        "viewer": viewer,
    });
    let compared = baseline.map(|(path, baseline)| (path, baseline.compare(&run, is_selected)));
    if arguments.json {
        if let Some((_, comparison)) = &compared {
            run["compared"] = serde_json::json!(comparison.ratios);
            run["compared_with"] = serde_json::json!(comparison.sides);
        }
        return console::print_json(&run);
    }
    let mut text = format!("{}\n", device::describe(gpu.adapter()));
    text.extend(pictures.iter().map(first_picture::Row::text));
    if !renders.is_empty() {
        text.push_str(renders::HEADER);
    }
    text.extend(renders.iter().map(renders::Row::text));
    text.extend(scenes.iter().map(scene_runs::Row::text));
    text.extend(playing.iter().map(playing::Row::text));
    text.extend(denoiser.iter().map(denoiser::Row::text));
    text.extend(viewer_text);
    text.extend(compared.map(|(path, comparison)| comparison.text(path)));
    console::print(&text)
}

fn nothing_named(part: &str, which: &str) -> AppError {
    AppError::Usage(format!(
        "nothing to measure (--only {part}): {which} has such a name. `glimray bench --quick` prints most names."
    ))
}

/// Measures the window: as JSON, and as a line for people.
fn window(
    arguments: &BenchArgs,
    program: Option<&Window>,
) -> Result<Option<(serde_json::Value, String)>, AppError> {
    let measure = |program: &Window| {
        (program.bench)(BenchRequest {
            repeats: arguments.repeats(),
            adapter: arguments.device.choice(),
            policy: job::policy(&arguments.device, false),
            crowd: workloads::thousand(),
        })
    };
    program.map(measure).transpose()
}
