//! `lib/pattern.wesl` and `lib/noise.wesl` against hand-computed values, an f64 implementation, and known
//! properties of gradient noise.

use crate::reference::textures;
use crate::support::{
    harness::gpu,
    random::Random,
    verdict::{Tolerance, Verdict},
};
use glam::DVec3;

const OCTAVES: &str = "
    import package::lib::noise::noise_octaves;
    fn probe(p: vec3f, count: u32) -> f32 { return noise_octaves(p, count).sum; }
";

/// The sum of octaves at each point.
fn noise(points: &[DVec3], octaves: u32) -> Vec<f64> {
    let inputs: Vec<_> = (points.iter())
        .map(|p| (p.as_vec3().to_array(), octaves))
        .collect();
    let sums: Vec<f32> = gpu().map_source(OCTAVES, &inputs);
    sums.into_iter().map(f64::from).collect()
}

fn points(seed: u64, count: usize, reach: f64) -> Vec<DVec3> {
    let mut random = Random::new(seed);
    (0..count).map(|_| reach * random.in_cube()).collect()
}

#[test]
fn cubes_of_a_checker_take_turns() {
    gpu().check(
        "lib::pattern::checker",
        Tolerance::Exact,
        &[
            ("the first cube", [0.5f32, 0.5, 0.5], 0.0),
            ("its neighbour along x", [1.5, 0.5, 0.5], 1.0),
            ("along y", [0.5, 1.5, 0.5], 1.0),
            ("along z", [0.5, 0.5, 1.5], 1.0),
            ("along x and y", [1.5, 1.5, 0.5], 0.0),
            ("along all three", [1.5, 1.5, 1.5], 1.0),
            ("below 0", [-0.5, 0.5, 0.5], 1.0),
            ("below 0 twice", [-0.5, -0.5, 0.5], 0.0),
            ("two further is the same", [-1.5, 0.5, 0.5], 0.0),
            ("just past a boundary", [1.001, 0.5, 0.5], 1.0),
            ("just before it", [0.999, 0.5, 0.5], 0.0),
            ("far away", [1_000_000.5, 0.5, 0.5], 0.0),
            ("as far as it is asked", [1e8, 1e8, 1e8], 0.0),
            ("and on the other side", [-1e8, -1e8, -1e8], 0.0),
        ],
    );
}

#[test]
fn a_plane_between_two_layers_of_a_checker_shows_no_speckles() {
    const LIFTED: &str = "
        import package::lib::pattern::checker;
        fn probe(p: vec3f, axis: u32) -> vec2f {
            let flat = vec3f(p.x, 0.0, p.z);
            let on = select(select(p.xyz, p.yxz, axis == 0u), p.xzy, axis == 2u);
            let base = select(select(flat.xyz, flat.yxz, axis == 0u), flat.xzy, axis == 2u);
            return vec2f(checker(on), checker(base));
        }
    ";
    let mut random = Random::new(31);
    let mut inputs = Vec::new();
    for i in 0..30_000u32 {
        // As far off its plane as the rounding error of points some thousand cells away.
        let off = random.between(-2.5e-4, 2.5e-4) as f32;
        let [x, z] = [0, 1].map(|_| random.between(-300.0, 300.0) as f32);
        inputs.push(([x, off, z], i % 3));
    }
    let cells: Vec<[f32; 2]> = gpu().map_source(LIFTED, &inputs);
    let mut verdict = Verdict::on("a checker on a boundary");
    for ((p, axis), [on, base]) in inputs.iter().zip(cells) {
        verdict.that(format!("{p:?}, axis {axis}"), on == base, || on);
    }
    verdict.close();
}

#[test]
fn stripes_are_half_and_half_along_x() {
    gpu().check(
        "lib::pattern::stripes",
        Tolerance::Exact,
        &[
            ("the first half", [0.25f32, 9.7, -3.1], 0.0),
            ("the other half", [0.75, 9.7, -3.1], 1.0),
            ("its beginning", [0.501, 0.0, 0.0], 1.0),
            ("a unit further", [1.25, 0.0, 0.0], 0.0),
            ("below 0", [-0.25, 0.0, 0.0], 1.0),
            ("further below", [-0.75, 0.0, 0.0], 0.0),
            ("on the boundary", [0.0, 0.0, 0.0], 0.0),
            ("a rounding below it", [-1e-6, 0.0, 0.0], 0.0),
            ("on the middle", [0.5, 0.0, 0.0], 1.0),
            ("a rounding below it", [0.499_999, 0.0, 0.0], 1.0),
        ],
    );
}

#[test]
fn a_gradient_goes_along_x_and_stays_at_its_ends() {
    gpu().check(
        "lib::pattern::gradient",
        Tolerance::Exact,
        &[
            ("before", [-7.0f32, 1.0, 1.0], 0.0),
            ("its start", [0.0, 1.0, 1.0], 0.0),
            ("a quarter", [0.25, -5.0, 2.0], 0.25),
            ("its end", [1.0, 1.0, 1.0], 1.0),
            ("beyond", [1e8, 1.0, 1.0], 1.0),
        ],
    );
}

#[test]
fn clouds_are_half_where_the_noise_is_zero_and_reach_both_colours() {
    gpu().check(
        "lib::pattern::clouds",
        Tolerance::Exact,
        &[
            ("no noise", 0.0f32, 0.5),
            ("some", 0.5, 0.75),
            ("much", 1.5, 1.0),
            ("the other way", -3.0, 0.0),
        ],
    );
}

#[test]
fn noise_is_what_perlins_formula_gives_in_f64() {
    let mut verdict = Verdict::on("noise_octaves");
    for octaves in [1, 2, 5, 16] {
        let points = points(u64::from(octaves), 4000, 120.0);
        for (p, got) in points.iter().zip(noise(&points, octaves)) {
            let p = p.as_vec3().as_dvec3();
            let expected = textures::noise_octaves(p, octaves);
            // Below the cells of the finest octave f32 has no precision left; those octaves are also the
            // weakest.
            let off = (got - expected).abs();
            verdict.that(format!("{p}, {octaves} octaves"), off < 2e-4, || {
                format!("got {got}, expected {expected}")
            });
        }
    }
    verdict.close();
}

#[test]
fn one_octave_vanishes_on_the_lattice() {
    let corners: Vec<_> = (points(5, 2000, 500.0).iter()).map(|p| p.floor()).collect();
    assert!(noise(&corners, 1).iter().all(|value| *value == 0.0));
}

#[test]
fn noise_keeps_to_its_range_and_fills_most_of_it() {
    // The maximum of an octave is 1.0364; all octaves together have less than twice that.
    for (octaves, least, most) in [(1, 0.85, 1.04), (16, 1.0, 2.08)] {
        let values = noise(&points(6, 400_000, 128.0), octaves);
        let (low, high) = values.iter().fold((0f64, 0f64), |(low, high), &value| {
            (low.min(value), high.max(value))
        });
        assert!(
            low < -least && low > -most,
            "{octaves} octaves: down to {low}"
        );
        assert!(
            high > least && high < most,
            "{octaves} octaves: up to {high}"
        );
    }
}

#[test]
fn noise_has_a_mean_of_zero() {
    for octaves in [1, 4, 16] {
        let values = noise(&points(7, 400_000, 128.0), octaves);
        let mean = values.iter().sum::<f64>() / values.len() as f64;
        let spread = values.iter().map(|v| v * v).sum::<f64>() / values.len() as f64;
        // Neighbouring points are correlated: there are as many independent ones as cells, 2^24.
        let error = (spread / values.len() as f64).sqrt();
        assert!(
            mean.abs() < 5.0 * error,
            "{octaves} octaves: {mean}, error {error}"
        );
    }
}

#[test]
fn noise_is_continuous_with_its_slope() {
    const STEP: f64 = 1.0 / 1024.0;
    // Across cells of all octaves, along a slanted line.
    let line: Vec<_> = (0..20_000)
        .map(|i| f64::from(i) * STEP * DVec3::new(1.0, 0.5, 0.25))
        .collect();
    let values = noise(&line, 1);
    let slopes: Vec<_> = values.windows(2).map(|v| (v[1] - v[0]) / STEP).collect();
    let steepest = slopes
        .iter()
        .fold(0f64, |most, slope| most.max(slope.abs()));
    assert!(steepest < 6.0, "slope {steepest}");
    let bends = slopes.windows(2).map(|s| (s[1] - s[0]).abs());
    let sharpest = bends.fold(0f64, f64::max);
    assert!(sharpest < 60.0 * STEP, "bend {sharpest}");
}

#[test]
fn noise_repeats_after_its_period() {
    let near = points(8, 2000, 1.0);
    let far: Vec<_> = near
        .iter()
        .map(|p| *p + 256.0 * DVec3::new(1.0, -2.0, 3.0))
        .collect();
    // As rounded to f32, so that both are at the same positions in their cells.
    let far: Vec<_> = far.iter().map(|p| p.as_vec3().as_dvec3()).collect();
    let near: Vec<_> = far
        .iter()
        .map(|p| *p - 256.0 * DVec3::new(1.0, -2.0, 3.0))
        .collect();
    for octaves in [1, 7] {
        let pairs = noise(&near, octaves).into_iter().zip(noise(&far, octaves));
        for (near, far) in pairs {
            assert!((near - far).abs() < 1e-4, "{near} and {far}");
        }
    }
}
