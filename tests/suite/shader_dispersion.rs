//! `lib/dispersion.wesl`: the index of refraction by wavelength, and the direction of anisotropy.

use crate::support::{
    harness::gpu,
    random::Random,
    verdict::{Tolerance, Verdict},
};
use std::f64::consts::{FRAC_1_SQRT_2, FRAC_PI_2};

/// Fraunhofer's lines F, d and C in nm, by which Abbe's number is defined.
const LINES: [f32; 3] = [486.13, 587.56, 656.27];

#[test]
fn indices_of_glasses_are_those_of_their_data_sheets() {
    // n_d, Abbe's number, n_F and n_C of Schott's N-BK7, N-SF11 and N-FK51A.
    let glasses = [
        (1.5168_f32, 64.17_f32, 1.52238, 1.51432),
        (1.78472, 25.68, 1.80645, 1.77596),
        (1.48656, 84.47, 1.49056, 1.48480),
    ];
    let mut verdict = Verdict::on("dispersed_ior");
    for (ior, abbe, blue, red) in glasses {
        let rows = LINES.map(|line| (ior, 20.0 / abbe, line));
        let got: Vec<f32> = gpu().map("lib::dispersion::dispersed_ior", &rows);
        // Cauchy's equation has one term less than glass.
        for (got, expected) in got.iter().zip([blue, f64::from(ior), red]) {
            verdict.near(ior, got, &expected, Tolerance::Absolute(1.5e-3));
        }
        let defined = f64::from(got[1] - 1.0) / f64::from(got[0] - got[2]);
        let off = (defined / f64::from(abbe) - 1.0).abs();
        verdict.that(format!("Abbe's number of {ior}"), off < 2e-3, || defined);
    }
    verdict.close();
}

#[test]
fn without_dispersion_or_refraction_all_wavelengths_are_alike() {
    gpu().check(
        "lib::dispersion::dispersed_ior",
        Tolerance::Absolute(1e-6),
        &[
            ("no dispersion", (1.5f32, 0.0f32, 450.0f32), 1.5),
            ("air", (1.0, 5.0, 450.0), 1.0),
            ("never below air", (1.1, 1000.0, 700.0), 1.0),
        ],
    );
}

#[test]
fn strength_widens_microfacets_along_the_tangent_alone() {
    gpu().check(
        "lib::dispersion::anisotropic_alpha",
        Tolerance::Absolute(1e-6),
        &[
            ("none", (0.25f32, 0.0f32), [0.25, 0.25]),
            ("half", (0.25, 0.5), [0.4375, 0.25]),
            ("all", (0.25, 1.0), [1.0, 0.25]),
        ],
    );
}

#[test]
fn rotations_of_material_and_texture_add_up() {
    let half = FRAC_1_SQRT_2;
    let right = FRAC_PI_2 as f32;
    gpu().check(
        "lib::dispersion::anisotropy_tangent",
        Tolerance::Absolute(1e-6),
        &[
            ("along the tangent", (0f32, [1f32, 0.0]), [1.0, 0.0]),
            ("a right angle", (right, [1.0, 0.0]), [0.0, 1.0]),
            ("by the texture", (0.0, [0.0, -0.5]), [0.0, -1.0]),
            ("by both", (0.5 * right, [0.0, 1.0]), [-half, half]),
        ],
    );
}

#[test]
fn directions_along_the_tangent_turn_there_and_back() {
    let source = "
        import package::lib::dispersion::{along_tangent, from_tangent};
        fn probe(w: vec3f, tangent: vec2f) -> mat2x3f {
            let turned = along_tangent(w, tangent);
            return mat2x3f(turned, from_tangent(turned, tangent));
        }";
    let mut random = Random::new(9);
    let mut rows: Vec<([f32; 3], [f32; 2])> = Vec::new();
    for _ in 0..500 {
        let (sin, cos) = random.between(-4.0, 4.0).sin_cos();
        rows.push((
            random.direction().as_vec3().to_array(),
            [cos as f32, sin as f32],
        ));
    }
    let mut verdict = Verdict::on("along_tangent");
    let found: Vec<[[f32; 3]; 2]> = gpu().map_source(source, &rows);
    for ((w, t), [turned, back]) in rows.iter().zip(found) {
        let [x, y, z] = w.map(f64::from);
        let [cos, sin] = t.map(f64::from);
        let expected = [x * cos + y * sin, y * cos - x * sin, z];
        verdict.near(
            format!("{w:?}"),
            &turned,
            &expected,
            Tolerance::Absolute(1e-6),
        );
        verdict.near(
            format!("{w:?} back"),
            &back,
            &[x, y, z],
            Tolerance::Absolute(1e-6),
        );
    }
    verdict.close();
}
