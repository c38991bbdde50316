//! `lib/fresnel.wesl`: Snell's law and Fresnel's equations.

use crate::support::{
    harness::gpu,
    random::Random,
    verdict::{Tolerance, Verdict},
};
use glam::DVec3;

const BOUNDARY: &str = "
    import package::lib::fresnel::{fresnel, schlick};
    fn probe(cos_i: f32, eta: f32) -> vec4f {
        let exact = fresnel(cos_i, eta);
        return vec4f(exact.reflectance, exact.cos_t, select(0.0, 1.0, exact.total), schlick(cos_i, eta, exact));
    }
";

/// Enters the second medium and leaves it through a parallel boundary; and the reflected direction.
const SLAB: &str = "
    import package::lib::fresnel::{fresnel, mirrored, refracted};
    fn probe(direction: vec3f, n: vec3f, eta: f32) -> mat3x3f {
        let into = refracted(direction, n, eta, fresnel(-dot(direction, n), eta).cos_t);
        let back = refracted(into, n, 1.0 / eta, fresnel(-dot(into, n), 1.0 / eta).cos_t);
        return mat3x3f(into, back, mirrored(direction, n));
    }
";

fn boundaries(rows: &[(f32, f32)]) -> Vec<[f32; 4]> {
    gpu().map_source(BOUNDARY, rows)
}

/// Angles of incidence from 0 to 90°, and ratios of indices on both sides of 1.
fn slopes() -> Vec<(f32, f32)> {
    let etas = [
        0.2,
        0.4,
        1.0 / 1.5,
        0.75,
        0.99,
        1.0,
        1.01,
        1.33,
        1.5,
        2.4,
        10.0,
    ];
    let cosines = (0..=1000).map(|i| i as f32 / 1000.0);
    etas.iter()
        .flat_map(|&eta| cosines.clone().map(move |cos_i| (cos_i, eta)))
        .collect()
}

#[test]
fn reflected_and_transmitted_light_are_all_of_it() {
    let rows = slopes();
    let mut verdict = Verdict::on("R + T = 1");
    for (&(cos_i, eta), [r, _, total, _]) in rows.iter().zip(boundaries(&rows)) {
        let incidence = f64::from(cos_i).acos();
        let sin_t = f64::from(eta) * incidence.sin();
        // Fresnel's own form of 1823, in sines and tangents of sums and differences.
        let transmitted = if eta == 1.0 {
            1.0
        } else if sin_t >= 1.0 {
            0.0
        } else if incidence < 1e-6 {
            4.0 * f64::from(eta) / (1.0 + f64::from(eta)).powi(2)
        } else {
            let t = sin_t.asin();
            let (sum, difference) = (incidence + t, incidence - t);
            let t_s = (2.0 * incidence).sin() * (2.0 * t).sin() / sum.sin().powi(2);
            0.5 * (t_s + t_s / difference.cos().powi(2))
        };
        let name = format!("cos {cos_i}, eta {eta}");
        // At the critical angle the slope is infinite.
        let cos_t = (1.0 - sin_t * sin_t).max(1e-12).sqrt();
        let room = 1e-6 + 5e-7 * f64::from(eta * eta) / cos_t;
        let sum = f64::from(r) + transmitted;
        verdict.that(&name, (sum - 1.0).abs() <= room, || format!("{sum}"));
        verdict.that(&name, (0.0..=1.0).contains(&r), || format!("R = {r}"));
        verdict.that(
            &name,
            (total > 0.5) == (sin_t >= 1.0) || (sin_t - 1.0).abs() < 1e-5,
            || format!("total {total}, sin {sin_t}"),
        );
    }
    verdict.close();
}

#[test]
fn known_angles_have_their_known_reflectance() {
    let brewster = 1.5_f64.atan();
    // At Brewster's angle only one polarisation is reflected: sin² of the difference of the two angles, which
    // add up to 90°.
    let at_brewster = 0.5 * (2.0 * brewster - std::f64::consts::FRAC_PI_2).sin().powi(2);
    let rows = [
        ("straight into glass", 1.0, 1.0 / 1.5, 0.04),
        ("straight out of glass", 1.0, 1.5, 0.04),
        (
            "straight into diamond",
            1.0,
            1.0 / 2.4,
            (1.4_f64 / 3.4).powi(2),
        ),
        (
            "at Brewster's angle",
            brewster.cos() as f32,
            1.0 / 1.5,
            at_brewster,
        ),
        ("grazing", 0.0, 1.0 / 1.5, 1.0),
        ("beyond the critical angle", 0.5, 1.5, 1.0),
        ("between equal media", 0.3, 1.0, 0.0),
        ("grazing between equal media", 0.0, 1.0, 0.0),
    ];
    let inputs: Vec<_> = rows
        .iter()
        .map(|&(_, cos_i, eta, _)| (cos_i, eta))
        .collect();
    let mut verdict = Verdict::on("reflectance");
    for ((name, .., expected), [r, ..]) in rows.iter().zip(boundaries(&inputs)) {
        verdict.near(name, &r, expected, Tolerance::Absolute(2e-6));
    }
    verdict.close();
}

#[test]
fn schlick_is_exact_at_both_ends_and_near_between() {
    // Schlick's formula is intended for the indices of glass and water.
    let mut rows = slopes();
    rows.retain(|(_, eta)| [1.0 / 1.5, 0.75, 1.33, 1.5, 2.4].contains(eta));
    let mut verdict = Verdict::on("Schlick");
    for (&(cos_i, eta), [exact, _, total, schlick]) in rows.iter().zip(boundaries(&rows)) {
        let name = format!("cos {cos_i}, eta {eta}");
        let is_end = cos_i == 1.0 || total > 0.5;
        let room = if is_end { 1e-6 } else { 0.08 };
        verdict.that(name, (exact - schlick).abs() <= room, || {
            format!("{schlick} for {exact}")
        });
    }
    verdict.close();
}

#[test]
fn a_slab_returns_the_direction_and_snells_law_holds_inside() {
    let mut random = Random::new(5);
    let rows: Vec<([f32; 3], [f32; 3], f32)> = (0..20_000)
        .map(|_| {
            let n = random.direction();
            let direction = random.direction();
            let direction = if direction.dot(n) > 0.0 {
                -direction
            } else {
                direction
            };
            let eta = 1.0 / random.between(1.0, 3.0);
            let [d, n] = [direction, n].map(|v| v.as_vec3().to_array());
            (d, n, eta as f32)
        })
        .collect();
    let mut verdict = Verdict::on("slab");
    let results: Vec<[[f32; 3]; 3]> = gpu().map_source(SLAB, &rows);
    for ((direction, n, eta), result) in rows.iter().zip(results) {
        let wide = |v: [f32; 3]| DVec3::from(v.map(f64::from));
        let (direction, n) = (wide(*direction), wide(*n));
        let [into, back, mirrored] = result.map(wide);
        let name = format!("{direction} at {n}, eta {eta}");
        // At grazing incidence, the last bit of the refracted direction is worth more than that.
        let room = 1e-5_f64.max(2e-6 / direction.dot(n).abs());
        verdict.that(&name, back.distance(direction) < room, || {
            format!("out as {back}")
        });
        let sines = (direction.cross(n) * f64::from(*eta) - into.cross(n)).length();
        verdict.that(&name, sines < 1e-6 && into.dot(n) < 1e-6, || {
            format!("inside {into}")
        });
        let turned = mirrored.cross(n) - direction.cross(n);
        let is_mirrored =
            turned.length() < 1e-6 && (mirrored.dot(n) + direction.dot(n)).abs() < 1e-6;
        verdict.that(&name, is_mirrored, || format!("mirrored {mirrored}"));
    }
    verdict.close();
}

#[test]
fn schlick_goes_from_one_reflectance_to_the_other() {
    let fifth = |cos: f64| (1.0 - cos).powi(5);
    gpu().check(
        "lib::fresnel::schlick_weight",
        Tolerance::Relative(1e-5),
        &[
            ("along the normal", 1f32, 0f64),
            ("grazing", 0.0, 1.0),
            ("between", 0.3, fifth(0.3)),
            ("beyond", -0.5, 1.0),
        ],
    );
    let between = [0.1 + 0.7 * fifth(0.4), 0.2 - 0.1 * fifth(0.4), 0.5];
    gpu().check(
        "lib::fresnel::schlick_between",
        Tolerance::Absolute(1e-6),
        &[
            (
                "along the normal",
                ([0.1f32, 0.2, 0.5], [0.8f32, 0.1, 0.5], 1f32),
                [0.1f64, 0.2, 0.5],
            ),
            ("between", ([0.1, 0.2, 0.5], [0.8, 0.1, 0.5], 0.4), between),
        ],
    );
}
