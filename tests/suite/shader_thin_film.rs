//! `lib/thin_film.wesl`: interference in a thin film.

use crate::support::{
    harness::gpu,
    verdict::{Tolerance, Verdict},
};
use std::f64::consts::TAU;

type Film = (f32, f32, f32, f32, [f32; 3]);

fn reflectances(films: &[Film]) -> Vec<[f32; 3]> {
    gpu().map("lib::thin_film::thin_film", films)
}

fn schlick(f0: f64, cos: f64) -> f64 {
    f0 + (1.0 - f0) * (1.0 - cos).powi(5)
}

fn f0(n1: f64, n2: f64) -> f64 {
    ((n1 - n2) / (n1 + n2)).powi(2)
}

/// The colour matching functions of 1931 (Wyman, Sloan and Shirley 2013, Simple Analytic Approximations to the CIE XYZ
/// Color Matching Functions, equation 4).
fn matching(wavelength: f64) -> [f64; 3] {
    let lobe = |height: f64, middle: f64, left: f64, right: f64| {
        let width = if wavelength < middle { left } else { right };
        height * (-0.5 * ((wavelength - middle) / width).powi(2)).exp()
    };
    [
        lobe(1.056, 599.8, 37.9, 31.0) + lobe(0.362, 442.0, 16.0, 26.7)
            - lobe(0.065, 501.1, 20.4, 26.2),
        lobe(0.821, 568.8, 46.9, 40.5) + lobe(0.286, 530.9, 16.3, 31.1),
        lobe(1.217, 437.0, 11.8, 36.0) + lobe(0.681, 459.0, 26.0, 13.8),
    ]
}

/// The two reflectances, the length of the path in the film, and whether the two waves are inverted alike.
fn parts(cos: f64, outside: f64, film: f64, thickness: f64, base_f0: f64) -> (f64, f64, f64, bool) {
    let base = (1.0 + base_f0.sqrt()) / (1.0 - base_f0.sqrt());
    let sin = outside / film * (1.0 - cos * cos).sqrt();
    let cos_t = (1.0 - sin * sin).sqrt();
    let across = (outside * cos - film * cos_t) / (outside * cos + film * cos_t);
    let along = (film * cos - outside * cos_t) / (film * cos + outside * cos_t);
    let alike = (film > outside) == (base > film);
    (
        0.5 * (across.powi(2) + along.powi(2)),
        schlick(f0(film, base), cos_t),
        2.0 * film * thickness * cos_t,
        alike,
    )
}

/// Airy's formula over the spectrum, as a colour. The mean of all phases is a constant spectrum, and is shown as grey.
fn airy(cos: f64, outside: f64, film: f64, thickness: f64, base_f0: f64) -> [f64; 3] {
    let (r, s, path, alike) = parts(cos, outside, film, thickness, base_f0);
    let mean = (r + s - 2.0 * r * s) / (1.0 - r * s);
    let (mut xyz, mut white) = ([0.0; 3], [0.0; 3]);
    for nm in 360..830 {
        let wavelength = f64::from(nm);
        let wave = (TAU * path / wavelength).cos() * if alike { 1.0 } else { -1.0 };
        let both = 2.0 * (r * s).sqrt() * wave;
        let reflected = (r + s + both) / (1.0 + r * s + both);
        for (i, matching) in matching(wavelength).into_iter().enumerate() {
            xyz[i] += (reflected - mean) * matching;
            white[i] += matching;
        }
    }
    let [x, y, z] = [0, 1, 2].map(|i| xyz[i] / white[i]);
    // ITU-R BT.709 with D65, as in IEC 61966-2-1.
    [
        3.2406 * x - 1.5372 * y - 0.4986 * z,
        -0.9689 * x + 1.8758 * y + 0.0415 * z,
        0.0557 * x - 0.2040 * y + 1.0570 * z,
    ]
    .map(|part| (mean + part).clamp(0.0, 1.0))
}

#[test]
fn colours_of_films_are_those_of_airys_formula() {
    let mut films = Vec::new();
    for cos in [1.0, 0.7, 0.4] {
        for film in [1.2, 1.33, 1.8] {
            for step in 0..20 {
                films.push((cos, 1.0, film, 100.0 + 40.0 * step as f32, [0.04, 0.2, 0.6]));
            }
        }
    }
    let mut verdict = Verdict::on("thin_film");
    let mut squares = 0.0;
    for (&(cos, outside, film, thickness, base), got) in films.iter().zip(reflectances(&films)) {
        for channel in 0..3 {
            let [cos, outside, film, thickness] = [cos, outside, film, thickness].map(f64::from);
            let expected = airy(cos, outside, film, thickness, f64::from(base[channel]))[channel];
            let off = (f64::from(got[channel]) - expected).abs();
            squares += off * off;
            verdict.that(
                format!("cos {cos}, film {film} of {thickness} nm, channel {channel}"),
                off < 0.05,
                || format!("{}, not {expected}", got[channel]),
            );
        }
    }
    let deviation = (squares / (3 * films.len()) as f64).sqrt();
    verdict.that("standard deviation", deviation < 0.006, || deviation);
    verdict.close();
}

#[test]
fn a_film_without_effect_leaves_the_base() {
    let mut films = Vec::new();
    for cos in [1.0f32, 0.6, 0.2, 0.0] {
        let base = [0.04f32, 0.5, 0.95];
        films.push((cos, 1.0f32, 1.5, 0.0, base));
        films.push((cos, 1.0, 1.0, 400.0, base));
    }
    let mut verdict = Verdict::on("no film");
    for (film, got) in films.iter().zip(reflectances(&films)) {
        let expected = film.4.map(|f0| schlick(f64::from(f0), f64::from(film.0)));
        verdict.near(
            format!("{film:?}"),
            &got,
            &expected,
            Tolerance::Absolute(1e-5),
        );
    }
    verdict.close();
}

#[test]
fn a_quarter_wave_of_the_right_index_does_not_reflect_green() {
    let film = 1.5_f32.sqrt();
    let glass = 0.04;
    let [[_, green, _], [_, twice, _]] = reflectances(&[
        (1.0, 1.0, film, 550.0 / (4.0 * film), [glass; 3]),
        (1.0, 1.0, film, 550.0 / (2.0 * film), [glass; 3]),
    ])[..] else {
        panic!("two rows");
    };
    assert!(green < 0.002, "{green} with a quarter of a wave");
    assert!(twice > 0.035, "{twice} with half of it");
}

#[test]
fn thick_films_have_no_colour_and_every_film_reflects_a_fraction() {
    let mut verdict = Verdict::on("thin_film");
    let thick = (0.8, 1.0, 1.5, 20_000.0, [0.3f32; 3]);
    let (r, s, ..) = parts(f64::from(thick.0), 1.0, 1.5, 0.0, f64::from(0.3f32));
    let mean = (r + s - 2.0 * r * s) / (1.0 - r * s);
    let [got] = reflectances(&[thick])[..] else {
        panic!("one row");
    };
    verdict.near("20 μm", &got, &[mean; 3], Tolerance::Absolute(1e-4));
    let mut films: Vec<Film> = Vec::new();
    for cos in [0.0, 1e-4, 0.3, 1.0] {
        for outside in [1.0, 1.5, 2.5] {
            for film in [1.0, 1.3, 2.5] {
                for thickness in [0.0, 0.01, 1.0, 350.0, 1e6] {
                    films.push((cos, outside, film, thickness, [0.0, 0.5, 1.0]));
                }
            }
        }
    }
    for (film, got) in films.iter().zip(reflectances(&films)) {
        let is_fraction = got.iter().all(|r| (0.0..=1.0).contains(r));
        verdict.that(format!("{film:?}"), is_fraction, || format!("{got:?}"));
    }
    let [inside] = reflectances(&[(0.2, 1.5, 1.0, 300.0, [0.04; 3])])[..] else {
        panic!("one row");
    };
    verdict.near("total reflection", &inside, &[1.0; 3], Tolerance::Exact);
    verdict.close();
}
