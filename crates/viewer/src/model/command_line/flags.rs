//! The flag for each difference.

use crate::model::command_line::{Pasted, Shown};
use glam::DVec3;
use glimray_app::value_names::{
    ANTIALIAS, BSDF_MODELS, FILTERS, INTEGRATORS, TONES, TRANSFERS, TRIANGLE_TESTS,
};
use glimray_scene::{Backdrop, Background, Camera, Scene, Shutter};

/// A difference between a line and the view.
pub(super) struct Difference {
    /// The differing property, in a few words.
    pub what: &'static str,
    /// The flags to add; empty if no flag can express it.
    pub flags: Vec<(&'static str, String)>,
}

/// All differences; those that others depend on come first.
pub(super) fn all(
    shown: &Shown,
    scene: &Scene,
    parsed: &Pasted,
) -> impl Iterator<Item = Difference> {
    let checks = camera(shown, scene, parsed)
        .into_iter()
        .chain(settings(shown, parsed))
        .chain(look(shown, parsed));
    checks
        .filter(|(differs, ..)| *differs)
        .map(|(_, what, flags)| Difference { what, flags })
}

/// Whether the values differ, the name, and the flags that set it.
type Check = (bool, &'static str, Vec<(&'static str, String)>);

fn one(differs: bool, what: &'static str, flag: &'static str, value: String) -> Check {
    (differs, what, vec![(flag, value)])
}

fn camera(shown: &Shown, scene: &Scene, parsed: &Pasted) -> Vec<Check> {
    let (wanted, camera) = (shown.camera, &parsed.camera);
    let time = one(
        shown.time != parsed.time,
        "the time",
        "--time",
        shown.time.to_string(),
    );
    // A lens is only available through the camera that has it.
    let has_lens = |index: &usize| {
        let mut scene = scene.clone();
        scene.camera_index = *index;
        scene.frame(shown.time).camera.lens == wanted.lens
    };
    let lens = (wanted.lens != camera.lens)
        .then(|| (0..scene.cameras.len()).find(has_lens))
        .flatten();
    let chosen = lens.map(|index| ("--camera", index.to_string()));
    let projection = match wanted.orthographic_height {
        Some(height) => ("--orthographic", height.to_string()),
        None => ("--fov-y", degrees(wanted.fov_y).to_string()),
    };
    vec![
        time,
        (
            wanted.lens != camera.lens,
            "the camera's lens",
            chosen.into_iter().collect(),
        ),
        place(wanted, camera),
        (
            !same_projection(wanted, camera),
            "the camera's angle of view",
            vec![projection],
        ),
    ]
}

/// All three at once, because animated values must not remain.
fn place(wanted: &Camera, camera: &Camera) -> Check {
    let pairs = [
        (wanted.look_from, camera.look_from, "--look-from"),
        (wanted.look_at, camera.look_at, "--look-at"),
        (wanted.up, camera.up, "--up"),
    ];
    let differs = pairs.iter().any(|(wanted, parsed, _)| wanted != parsed);
    let flags = pairs.map(|(wanted, _, flag)| (flag, vector(wanted)));
    (differs, "the camera position", flags.to_vec())
}

fn same_projection(a: &Camera, b: &Camera) -> bool {
    a.orthographic_height == b.orthographic_height
        && (a.orthographic_height.is_some() || a.fov_y == b.fov_y)
}

fn settings(shown: &Shown, parsed: &Pasted) -> Vec<Check> {
    let (wanted, parsed) = (shown.settings, &parsed.settings);
    let (width, height) = wanted.size;
    let crop = wanted.crop.map(|edges| edges.map(|edge| edge.to_string()));
    let crop = crop.map(|edges| ("--crop", edges.join(",")));
    let switch = |is_on: bool, name| is_on.then(|| (name, String::new())).into_iter();
    vec![
        one(
            wanted.size != parsed.size,
            "the size",
            "--size",
            format!("{width}x{height}"),
        ),
        (
            wanted.crop != parsed.crop,
            "the region",
            crop.into_iter().collect(),
        ),
        one(
            wanted.samples != parsed.samples,
            "the samples",
            "--samples",
            wanted.samples.to_string(),
        ),
        one(
            wanted.antialias != parsed.antialias,
            "the sample placement",
            "--antialias",
            ANTIALIAS.name(&wanted.antialias).to_owned(),
        ),
        one(
            wanted.noise != parsed.noise,
            "the noise limit",
            "--noise",
            wanted.noise.to_string(),
        ),
        one(
            wanted.filter != parsed.filter,
            "the filter",
            "--filter",
            FILTERS.name(&wanted.filter).to_owned(),
        ),
        one(
            wanted.filter_radius != parsed.filter_radius,
            "the filter's radius",
            "--filter-radius",
            wanted.filter_radius.to_string(),
        ),
        one(
            wanted.light_samples != parsed.light_samples,
            "the light samples",
            "--light-samples",
            wanted.light_samples.to_string(),
        ),
        one(
            wanted.integrator != parsed.integrator,
            "the integrator",
            "--integrator",
            INTEGRATORS.name(&wanted.integrator).to_owned(),
        ),
        one(
            wanted.triangle_test != parsed.triangle_test,
            "the triangle test",
            "--triangle-test",
            TRIANGLE_TESTS.name(&wanted.triangle_test).to_owned(),
        ),
        one(
            wanted.offset != parsed.offset,
            "the ray offset",
            "--offset",
            wanted.offset.to_string(),
        ),
        (
            wanted.brute_force != parsed.brute_force,
            "brute force",
            switch(wanted.brute_force, "--no-bvh").collect(),
        ),
        one(
            wanted.seed != parsed.seed,
            "the seed",
            "--seed",
            wanted.seed.to_string(),
        ),
        one(
            wanted.max_depth != parsed.max_depth,
            "the depth",
            "--max-depth",
            wanted.max_depth.to_string(),
        ),
        one(
            wanted.min_throughput != parsed.min_throughput,
            "the minimum throughput",
            "--min-throughput",
            wanted.min_throughput.to_string(),
        ),
        (
            wanted.transparent_shadows != parsed.transparent_shadows,
            "transparent shadows",
            switch(wanted.transparent_shadows, "--transparent-shadows").collect(),
        ),
        one(
            wanted.bsdf != parsed.bsdf,
            "the way materials scatter",
            "--bsdf",
            BSDF_MODELS.name(&wanted.bsdf).to_owned(),
        ),
        one(
            wanted.backdrop != parsed.backdrop,
            "the backdrop",
            "--background",
            match wanted.backdrop {
                Backdrop::Color(color) => color.to_array().map(|c| c.to_string()).join(","),
                Backdrop::Background | Backdrop::Transparent => "transparent".to_owned(),
            },
        ),
        (
            wanted.clamp_indirect != parsed.clamp_indirect,
            "the clamp of indirect light",
            (wanted
                .clamp_indirect
                .map(|limit| ("--clamp-indirect", limit.to_string())))
            .into_iter()
            .collect(),
        ),
    ]
}

fn look(shown: &Shown, parsed: &Pasted) -> Vec<Check> {
    let (wanted, tone) = (shown.tone, parsed.tone);
    let background = match shown.background {
        Background::Color(color) => {
            vec![(
                "--background",
                color.to_array().map(|c| c.to_string()).join(","),
            )]
        }
        _ => Vec::new(),
    };
    let Shutter { open, close } = shown.shutter;
    let shutter = if open == 0.0 && close >= 0.0 {
        close.to_string()
    } else {
        format!("{open}..{close}")
    };
    vec![
        (
            *shown.background != parsed.background,
            "the background",
            background,
        ),
        one(
            (wanted.exposure_ev, wanted.auto_exposure) != (tone.exposure_ev, tone.auto_exposure),
            "the exposure",
            "--exposure",
            match wanted.auto_exposure {
                true => format!("auto{:+}", wanted.exposure_ev),
                false => wanted.exposure_ev.to_string(),
            },
        ),
        one(
            wanted.curve != tone.curve,
            "the tone curve",
            "--tone",
            TONES.name(&wanted.curve).to_owned(),
        ),
        one(
            wanted.transfer != tone.transfer,
            "the transfer function",
            "--transfer",
            TRANSFERS.name(&wanted.transfer).to_owned(),
        ),
        (
            wanted.denoise != tone.denoise,
            "denoising",
            match wanted.denoise {
                true => vec![("--denoise", String::new())],
                false => vec![("--no-denoise", String::new())],
            },
        ),
        one(
            shown.fps != parsed.fps,
            "the frame rate",
            "--fps",
            shown.fps.to_string(),
        ),
        one(
            shown.shutter != parsed.shutter,
            "the shutter",
            "--shutter",
            shutter,
        ),
    ]
}

fn vector(v: DVec3) -> String {
    v.to_array().map(|c| c.to_string()).join(",")
}

/// The number of degrees that converts back to exactly these radians, if there is one; else the nearest.
fn degrees(radians: f64) -> f64 {
    let middle = radians.to_degrees();
    let near = [
        middle,
        middle.next_up(),
        middle.next_down(),
        middle.next_up().next_up(),
        middle.next_down().next_down(),
    ];
    let exact = near
        .into_iter()
        .find(|degrees| degrees.to_radians() == radians);
    // Prefers round numbers among several that convert to the same radians.
    let round = (middle * 1e6).round() / 1e6;
    if round.to_radians() == radians {
        return round;
    }
    exact.unwrap_or(middle)
}
