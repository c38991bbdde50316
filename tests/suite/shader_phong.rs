//! Level 3: `lib/phong.wesl`.

use crate::support::{
    harness::gpu,
    random::Random,
    types::Phong,
    verdict::{Tolerance, Verdict},
};

const PHONG: &str = "lib::phong::phong";

fn surface(diffuse: [f32; 3], specular: [f32; 3], shininess: f32) -> Phong {
    Phong {
        diffuse,
        specular,
        shininess,
        ambient: [9.0; 3],
        reflect: [9.0; 3],
    }
}

#[test]
fn light_is_reflected_as_phong_says() {
    // Diffuse reflection in the first two channels, the highlight in the last two.
    let with = |shininess| surface([0.5, 0.25, 0.0], [0.0, 0.25, 0.75], shininess);
    let n = [0f32, 1.0, 0.0];
    // Directions in the plane of the picture, by their angle from the normal.
    let at = |degrees: f64| {
        let (sin, cos) = degrees.to_radians().sin_cos();
        [sin as f32, cos as f32, 0.0]
    };
    let (half_root, tiny) = (0.5f64.sqrt(), 1e-20f32);
    let both =
        |cos: f64, highlight: f64| [0.5 * cos, 0.25 * cos + 0.25 * highlight, 0.75 * highlight];
    #[rustfmt::skip]
    gpu().check(PHONG, Tolerance::Absolute(1e-6), &[
        ("light and eye on the normal: k_d + k_s", (with(10.0), n, n, n), both(1.0, 1.0)),
        ("light at 60° halves the diffuse part", (with(10.0), n, at(60.0), at(-60.0)), both(0.5, 1.0)),
        ("light at 45°, the eye where the mirror sends it", (with(4.0), n, at(45.0), at(-45.0)), both(half_root, 1.0)),
        ("the eye 60° off the mirror ray: 2^-α", (with(3.0), n, at(30.0), at(30.0)), both(0.75f64.sqrt(), 0.125)),
        ("the eye 45° off the mirror ray: 2^(-α/2)", (with(6.0), n, at(0.0), at(45.0)), both(1.0, 0.125)),
        ("the eye more than 90° off sees no highlight", (with(1.0), n, at(60.0), at(60.0)), both(0.5, 0.0)),
        ("shininess 0 is a highlight everywhere", (with(0.0), n, at(60.0), at(-30.0)), both(0.5, 1.0)),
        ("shininess 0 and r·v = 0: 0^0 is 1", (with(0.0), n, n, [1.0, 0.0, 0.0]), both(1.0, 1.0)),
        ("shininess 0 and r·v < 0: clamped to 0, then 0^0", (with(0.0), n, n, [0.0, -1.0, 0.0]), both(1.0, 1.0)),
        ("r·v = 0 with shininess", (with(1.0), n, n, [1.0, 0.0, 0.0]), both(1.0, 0.0)),
        ("light exactly at the horizon gives nothing", (with(0.0), n, [1.0, 0.0, 0.0], [-1.0, 0.0, 0.0]), both(0.0, 0.0)),
        ("light at the horizon on the side of -0", (with(0.0), n, [1.0, -0.0, 0.0], [-1.0, 0.0, 0.0]), both(0.0, 0.0)),
        ("light a hair above the horizon", (with(1.0), n, [1.0, tiny, 0.0], [-1.0, tiny, 0.0]), both(0.0, 1.0)),
        ("light from below gives nothing", (with(0.0), n, at(120.0), at(-60.0)), both(0.0, 0.0)),
        ("light from behind gives nothing", (with(5.0), n, [0.0, -1.0, 0.0], n), both(0.0, 0.0)),
        ("a tilted surface", (with(1.0), at(30.0), at(30.0), at(90.0)), both(1.0, 0.5)),
        ("black stays black", (surface([0.0; 3], [0.0; 3], 10.0), n, n, n), [0.0; 3]),
    ]);
}

#[test]
fn a_mirrored_light_is_seen_at_the_angle_between_eye_and_mirror() {
    let n = [0f32, 1.0, 0.0];
    let at = |degrees: f64| {
        let (sin, cos) = degrees.to_radians().sin_cos();
        [sin as f32, cos as f32, 0.0]
    };
    #[rustfmt::skip]
    gpu().check("lib::phong::mirrored_cosine", Tolerance::Absolute(1e-6), &[
        ("the eye where the mirror sends the light", (n, at(40.0), at(-40.0)), 1.0),
        ("the eye 60° off", (n, at(30.0), at(30.0)), 0.5),
        ("the eye opposite", (n, at(80.0), at(100.0)), -1.0),
        ("a light from below has a mirror too", (n, at(120.0), at(-120.0)), 1.0),
        ("a tilted normal", (at(30.0), at(75.0), at(-45.0)), 30f64.to_radians().cos()),
    ]);
}

#[test]
fn powers_are_right_and_defined_at_zero() {
    #[rustfmt::skip]
    gpu().check("lib::phong::shininess_power", Tolerance::Absolute(1e-6), &[
        ("0^0 is 1", (0f32, 0f32), 1.0),
        ("0^1", (0.0, 1.0), 0.0),
        ("0^1000", (0.0, 1000.0), 0.0),
        ("1^0", (1.0, 0.0), 1.0),
        ("1 to a high power", (1.0, 1e6), 1.0),
        ("x^1 is x", (0.3, 1.0), f64::from(0.3f32)),
        ("(1/2)^10", (0.5, 10.0), 1.0 / 1024.0),
        ("(1/2)^1000 vanishes", (0.5, 1000.0), 0.0),
        ("(1/4)^(1/2)", (0.25, 0.5), 0.5),
        ("tiny^(1/2)", (1e-30, 0.5), 1e-15),
        ("subnormal^1 is as good as 0", (1e-40, 1.0), 0.0),
        ("subnormal^0", (1e-40, 0.0), 1.0),
    ]);
}

#[test]
fn high_powers_keep_their_digits() {
    let mut random = Random::new(15);
    let inputs: Vec<_> = (0..5000)
        .map(|_| {
            let shininess = 10f64.powf(random.between(-1.0, 4.0));
            // The range where the highlight falls from 1 to e^-5.
            let x = (-random.between(0.0, 5.0) / shininess).exp();
            (x as f32, shininess as f32)
        })
        .collect();
    let powers: Vec<f32> = gpu().map("lib::phong::shininess_power", &inputs);
    let mut verdict = Verdict::on("shininess_power");
    for (&(x, shininess), power) in inputs.iter().zip(&powers) {
        let expected = f64::from(x).powf(f64::from(shininess));
        // log2 near 1 is good to 2^-21 only (WGSL, accuracy of log2); shininess multiplies that.
        let most = 1e-5 + f64::from(shininess) * 0.7 / 2_097_152.0;
        verdict.near(
            format!("{x}^{shininess}"),
            power,
            &expected,
            Tolerance::Relative(most),
        );
    }
    verdict.close();
}

#[test]
fn nothing_is_negative_or_undefined_for_any_directions() {
    let mut random = Random::new(16);
    let mut direction = || random.direction().as_vec3().to_array();
    let inputs: Vec<_> = (0..20_000)
        .map(|i| {
            (
                surface([0.5; 3], [0.5; 3], [0.0, 1.0, 50.0, 1e5][i % 4]),
                direction(),
                direction(),
                direction(),
            )
        })
        .collect();
    let colors: Vec<[f32; 3]> = gpu().map(PHONG, &inputs);
    let mut verdict = Verdict::on("phong");
    for (input, color) in inputs.iter().zip(&colors) {
        // k_d + k_s is the maximum; rounding may raise r·v to a few steps above 1, and a shininess of 1e5
        // multiplies that.
        let defined = color.iter().all(|c| (0.0..=1.05).contains(c));
        verdict.that(format!("{input:?}"), defined, || format!("{color:?}"));
    }
    verdict.close();
}
