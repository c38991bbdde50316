//! `lib/tone.wesl`: from linear radiance to display values.

use crate::support::{
    harness::gpu,
    verdict::{Tolerance, Verdict},
};
use glimray::layout::{
    PackedTone, TONE_ACES, TONE_AGX, TONE_NEUTRAL, TONE_NONE, TONE_REINHARD, TRANSFER_LINEAR,
    TRANSFER_SRGB,
};
use glimray_shader_test::Plain;

fn tone(exposure_scale: f32, curve: u32, transfer: u32) -> Plain<PackedTone> {
    Plain(PackedTone {
        exposure_scale,
        curve,
        transfer,
        ..Default::default()
    })
}

/// The inverse of IEC 61966-2-1: the light of a display level.
fn linear_from_srgb(level: f64) -> f64 {
    if level <= 0.04045 {
        level / 12.92
    } else {
        ((level + 0.055) / 1.055).powf(2.4)
    }
}

#[test]
fn srgb_gives_every_level_of_8_bits_for_the_light_it_stands_for() {
    let levels: Vec<f64> = (0..=255).map(|level| f64::from(level) / 255.0).collect();
    let inputs: Vec<[f32; 3]> = levels
        .iter()
        .map(|level| [linear_from_srgb(*level) as f32; 3])
        .collect();
    let shown: Vec<[f32; 3]> = gpu().map("lib::tone::srgb_from_linear", &inputs);
    let mut verdict = Verdict::on("srgb_from_linear");
    for (level, shown) in levels.iter().zip(&shown) {
        verdict.near(
            format!("level {:.0}", level * 255.0),
            shown,
            &[*level; 3],
            Tolerance::Absolute(1e-5),
        );
    }
    verdict.close();
}

#[test]
fn srgb_has_the_constants_of_the_standard() {
    #[rustfmt::skip]
    gpu().check("lib::tone::srgb_from_linear", Tolerance::Absolute(1e-5), &[
        ("black and white, and the step where line and power meet", [0f32, 1.0, 0.003_130_8], [0.0, 1.0, 0.040_449_936]),
        ("middle grey, 18 %, 50 %", [0.214_041_14, 0.18, 0.5], [0.5, 0.461_356_13, 0.735_356_98]),
        ("on the line", [0.001, 0.002, 0.003], [0.012_92, 0.025_84, 0.038_76]),
    ]);
}

#[test]
fn aces_is_narkowicz_fit() {
    #[rustfmt::skip]
    gpu().check("lib::tone::aces", Tolerance::Absolute(1e-6), &[
        ("black, one, two", [0f32, 1.0, 2.0], [0.0, 254.0 / 316.0, 1010.0 / 1104.0]),
        ("a half, a tenth, ten", [0.5, 0.1, 10.0], [6425.0 / 10_425.0, 281.0 / 2_233.0, 25_130.0 / 24_904.0]),
    ]);
}

#[test]
fn reinhard_maps_luminance_and_keeps_hue() {
    #[rustfmt::skip]
    gpu().check("lib::tone::reinhard", Tolerance::Relative(1e-6), &[
        ("grey 1 becomes a half", [1f32; 3], [0.5; 3]),
        ("grey 3 becomes three quarters", [3.0; 3], [0.75; 3]),
        ("black stays black", [0.0; 3], [0.0; 3]),
        ("pure green of luminance 1", [0.0, 1.0 / 0.7152, 0.0], [0.0, 0.5 / 0.7152, 0.0]),
        ("ratios of channels stay", [4.0, 2.0, 1.0], [4.0, 2.0, 1.0].map(|c| c / (1.0 + 0.8504 + 1.4304 + 0.0722))),
    ]);
}

#[test]
fn agx_of_greys_is_its_published_polynomial() {
    // Starting with the highest power, over 16.5 stops that end 4.026069 above 1.
    let curve = |x: f64| {
        let v = ((x.log2() + 12.47393) / 16.5).clamp(0.0, 1.0);
        let coefficients = [15.5, -40.14, 31.96, -6.868, 0.4298, 0.1191, -0.00232];
        coefficients
            .into_iter()
            .fold(0.0, |sum, c| sum * v + c)
            .max(0.0)
            .powf(2.2)
    };
    let greys: Vec<f64> = (-14..=6)
        .map(|stop| f64::from(stop).exp2())
        .chain([0.18])
        .collect();
    let inputs: Vec<[f32; 3]> = greys.iter().map(|grey| [*grey as f32; 3]).collect();
    let shown: Vec<[f32; 3]> = gpu().map("lib::tone::agx", &inputs);
    let mut verdict = Verdict::on("agx");
    for (grey, shown) in greys.iter().zip(&shown) {
        // The published matrices preserve grey to three digits.
        verdict.near(
            format!("grey {grey}"),
            shown,
            &[curve(*grey); 3],
            Tolerance::Absolute(1e-3),
        );
    }
    verdict.close();
}

/// Values of the definition (https://github.com/KhronosGroup/ToneMapping, PBR_Neutral).
#[test]
fn neutral_shifts_colours_by_the_reflection_of_a_dielectric_up_to_its_knee() {
    // The largest channel p is shown as 1 − 0.24²/(p − 0.52) above the knee at 0.76.
    let compressed = |p: f64| 1.0 - 0.0576 / (p - 0.52);
    let faded = |p: f64| 1.0 / (1.0 + 0.15 * (p - compressed(p)));
    let red = |p: f64| {
        [
            compressed(p),
            compressed(p) * (1.0 - faded(p)),
            compressed(p) * (1.0 - faded(p)),
        ]
    };
    #[rustfmt::skip]
    gpu().check("lib::tone::neutral", Tolerance::Absolute(1e-6), &[
        ("black stays black", [0f32; 3], [0.0; 3]),
        ("medium grey loses 4 %", [0.18; 3], [0.14; 3]),
        ("a base colour of half with 4 % reflected", [0.54, 0.29, 0.165], [0.5, 0.25, 0.125]),
        ("the knee", [0.8; 3], [0.76; 3]),
        ("the toe ends at 8 %", [0.08; 3], [0.04; 3]),
        ("grey in the toe is squared", [0.04; 3], [0.01; 3]),
        ("pure colours below the knee stay", [0.0, 0.75, 0.0], [0.0, 0.75, 0.0]),
        ("a channel that a filter made negative", [-0.25, 0.5, 0.5], [-0.25, 0.5, 0.5]),
        ("white", [1.0; 3], [compressed(0.96); 3]),
        ("a white of 100", [100.04; 3], [compressed(100.0); 3]),
        ("pure red of 1", [1.0, 0.0, 0.0], red(1.0)),
        ("pure red of 8", [8.0, 0.0, 0.0], red(8.0)),
    ]);
}

/// Fading to white, scaling and offsets leave the place of the middle channel between the others.
#[test]
fn neutral_keeps_hues_of_saturated_light_and_never_exceeds_white() {
    let levels = [0.0, 0.02, 0.07, 0.1, 0.3, 0.6, 0.9, 1.5, 4.0, 20.0, 500.0];
    let mut inputs = Vec::new();
    for [r, g, b] in levels.iter().flat_map(|r| levels.map(|g| [*r, g, 0.7])) {
        inputs.extend([[r, g, b], [g, b, r], [b, r, g]]);
    }
    let shown: Vec<[f32; 3]> = gpu().map("lib::tone::neutral", &inputs);
    let ordered = |mut c: [f32; 3]| {
        c.sort_by(f32::total_cmp);
        c.map(f64::from)
    };
    let mut verdict = Verdict::on("neutral");
    for (input, shown) in inputs.iter().zip(&shown) {
        let ([low, mid, high], [least, middle, most]) = (ordered(*input), ordered(*shown));
        verdict.that(
            format!("{input:?} in range"),
            least >= 0.0 && most <= 1.0,
            || format!("{shown:?}"),
        );
        let place = (mid - low) / (high - low);
        // Where all but white is lost, the rest is rounding.
        let is_kept = (middle - least - place * (most - least)).abs() < 1e-5;
        let has_order =
            (0..3).all(|a| (0..3).all(|b| input[a] >= input[b] || shown[a] <= shown[b]));
        verdict.that(format!("hue of {input:?}"), is_kept && has_order, || {
            format!("{shown:?}")
        });
    }
    verdict.close();
}

#[test]
fn tone_curves_never_fall_and_stay_in_range() {
    let stops: Vec<f32> = (0..400)
        .map(|i| ((f64::from(i) - 200.0) / 10.0).exp2() as f32)
        .collect();
    let mut verdict = Verdict::on("develop");
    for (name, curve) in [
        ("none", TONE_NONE),
        ("aces", TONE_ACES),
        ("agx", TONE_AGX),
        ("reinhard", TONE_REINHARD),
        ("neutral", TONE_NEUTRAL),
    ] {
        let inputs: Vec<_> = stops
            .iter()
            .map(|x| ([*x, *x, *x], tone(1.0, curve, TRANSFER_SRGB)))
            .collect();
        let shown: Vec<[f32; 3]> = gpu().map("lib::tone::develop", &inputs);
        for (x, pair) in stops.iter().zip(shown.windows(2)) {
            let rises = pair[0].iter().zip(pair[1]).all(|(a, b)| *a <= b + 1e-5);
            let inside = pair[1].iter().all(|c| (0.0..=1.0).contains(c));
            verdict.that(format!("{name} at {x}"), rises && inside, || {
                format!("{pair:?}")
            });
        }
    }
    verdict.close();
}

#[test]
fn develop_exposes_then_curves_then_transfers() {
    let grey = |x: f32| [x; 3];
    #[rustfmt::skip]
    gpu().check("lib::tone::develop", Tolerance::Absolute(1e-5), &[
        ("without anything it stays as it is", ([-2f32, 0.5, 100.0], tone(1.0, TONE_NONE, TRANSFER_LINEAR)), [-2.0, 0.5, 100.0]),
        ("exposure multiplies", (grey(3.0), tone(0.25, TONE_NONE, TRANSFER_LINEAR)), [0.75; 3]),
        ("transfer", (grey(0.5), tone(1.0, TONE_NONE, TRANSFER_SRGB)), [0.735_356_98; 3]),
        ("transfer cuts off below and above", ([-1.0, 2.0, 1e30], tone(1.0, TONE_NONE, TRANSFER_SRGB)), [0.0, 1.0, 1.0]),
        ("exposure comes before the curve", (grey(0.25), tone(4.0, TONE_REINHARD, TRANSFER_LINEAR)), [0.5; 3]),
        ("the curve comes before the transfer", (grey(1.0), tone(1.0, TONE_REINHARD, TRANSFER_SRGB)), [0.735_356_98; 3]),
        ("aces by its tag", (grey(1.0), tone(1.0, TONE_ACES, TRANSFER_LINEAR)), [254.0 / 316.0; 3]),
        ("neutral by its tag", (grey(0.36), tone(0.5, TONE_NEUTRAL, TRANSFER_LINEAR)), [0.14; 3]),
        ("black stays black with neutral", (grey(0.0), tone(1.0, TONE_NEUTRAL, TRANSFER_SRGB)), [0.0; 3]),
        ("black stays black with agx", (grey(0.0), tone(1.0, TONE_AGX, TRANSFER_SRGB)), [0.0; 3]),
        ("no light, no exposure", (grey(0.0), tone(0.0, TONE_NONE, TRANSFER_SRGB)), [0.0; 3]),
    ]);
}
