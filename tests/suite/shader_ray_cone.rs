//! `lib/ray_cone.wesl`: the widths of rays, and footprints on surfaces and in pictures.

use crate::support::{
    harness::gpu,
    random::Random,
    types::Cone,
    verdict::{Tolerance, Verdict},
};
use glam::{DVec2, DVec3};
use std::f64::consts::SQRT_2;

#[test]
fn the_level_of_a_footprint_is_the_logarithm_of_its_width_in_texels() {
    let mut verdict = Verdict::on("filtering");
    let rows = [
        ("one texel", [1f32, 0.0], [0f32, 1.0], 0.0, 1),
        ("turned", [0.8, 0.6], [-0.6, 0.8], 0.0, 1),
        ("four texels", [4.0, 0.0], [0.0, 4.0], 2.0, 1),
        ("between", [0.0, 3.0], [3.0, 0.0], 3f64.log2(), 1),
        ("magnified", [0.25, 0.0], [0.0, 0.25], -2.0, 1),
        ("longer than wide", [16.0, 0.0], [0.0, 4.0], 2.0, 4),
        ("wider than long", [0.0, 2.0], [6.0, 0.0], 1.0, 3),
        ("very long", [0.0, 1024.0], [1.0, 0.0], 7.0, 8),
        ("long and magnified", [3.0, 0.0], [0.0, 0.1], 0.0, 3),
    ];
    let inputs: Vec<_> = rows.iter().map(|row| (row.1, row.2)).collect();
    let source = "
        import package::lib::ray_cone::filtering;
        fn probe(a: vec2f, b: vec2f) -> vec4f {
            let plan = filtering(a, b);
            return vec4f(plan.level, f32(plan.tap_count), plan.way);
        }";
    let found: Vec<[f32; 4]> = gpu().map_source(source, &inputs);
    for ((name, a, b, level, taps), [got, count, x, y]) in rows.iter().zip(found) {
        verdict.that(*name, (f64::from(got) - level).abs() < 1e-5, || {
            format!("level {got}, not {level}")
        });
        verdict.that(*name, count == *taps as f32, || {
            format!("{count} lookups, not {taps}")
        });
        let longer =
            if DVec2::from(a.map(f64::from)).length() >= DVec2::from(b.map(f64::from)).length() {
                a
            } else {
                b
            };
        let way = if *taps > 1 { *longer } else { [0.0; 2] };
        verdict.that(*name, [x, y] == way, || format!("along {x} {y}"));
    }
    verdict.close();
}

#[test]
fn a_cone_meets_a_plane_in_an_ellipse_as_long_as_the_plane_is_slanted() {
    let mut random = Random::new(3);
    let rows: Vec<([f32; 3], [f32; 3], f32)> = (0..2000)
        .map(|_| {
            let [direction, n] = [0; 2].map(|_| random.direction().as_vec3().to_array());
            (direction, n, random.between(-2.0, 2.0) as f32)
        })
        .collect();
    let source = "
        import package::lib::ray_cone::footprint_axes;
        fn probe(direction: vec3f, n: vec3f, width: f32) -> mat2x3f {
            return footprint_axes(direction, n, width);
        }";
    let found: Vec<[[f32; 3]; 2]> = gpu().map_source(source, &rows);
    let mut verdict = Verdict::on("footprint_axes");
    for ((direction, n, width), axes) in rows.iter().zip(found) {
        let wide = |v: &[f32; 3]| DVec3::from(v.map(f64::from));
        let (direction, n, width) = (wide(direction), wide(n), f64::from(width.abs()));
        let [along, across] = axes.each_ref().map(wide);
        let cosine = direction.dot(n).abs().max(1e-3);
        let near = |a: f64, b: f64| (a - b).abs() <= 1e-4 * b.abs() + 1e-6;
        let name = format!("{direction} {n} {width}");
        verdict.that(&name, near(along.length(), width / cosine), || {
            format!("{} long", along.length())
        });
        verdict.that(&name, near(across.length(), width), || {
            format!("{} wide", across.length())
        });
        let flat = along.dot(n).abs() < 1e-4 * along.length() && across.dot(n).abs() < 1e-4 * width;
        verdict.that(&name, flat, || format!("{along} {across} leave the plane"));
        let square = across.dot(direction).abs() < 1e-4 * width.max(1e-3);
        verdict.that(&name, square, || format!("{across} is not across"));
    }
    verdict.close();
}

/// The lines of two rays that were at the heights ±h, near the axis of a sphere around `center` of this radius, after
/// `event` there. Returns their distance at the sphere's point on the axis, and how much it grows in a unit of length.
fn pair(radius: f64, cone: (f64, f64), event: impl Fn(DVec2, DVec2) -> DVec2) -> (f64, f64) {
    let h = 1e-4;
    let (width, spread) = cone;
    // The ray comes along +x and meets the sphere at the origin; scaled down to be near the axis.
    let (y, slope) = (h * width / 2.0, h * spread / 2.0);
    let center = DVec2::new(radius, 0.0);
    let x = radius - radius.signum() * (radius * radius - y * y).sqrt();
    let point = DVec2::new(x, y + slope * x);
    let outwards = (point - center).normalize() * radius.signum();
    let direction = event(DVec2::new(1.0, slope).normalize(), outwards);
    let way = direction.x.signum();
    (2.0 * point.y / h, 2.0 * way * direction.y / direction.x / h)
}

#[test]
fn mirrored_and_refracted_cones_follow_two_rays_near_the_axis() {
    let mirror = |d: DVec2, n: DVec2| d - 2.0 * d.dot(n) * n;
    let refract = |eta: f64| {
        move |d: DVec2, n: DVec2| {
            let cos_i = -d.dot(n);
            let cos_t = (1.0 - eta * eta * (1.0 - cos_i * cos_i)).sqrt();
            eta * d + (eta * cos_i - cos_t) * n
        }
    };
    let mut verdict = Verdict::on("cones");
    let mut rows = Vec::new();
    for radius in [1f64, -1.0, 0.3, -5.0] {
        for cone in [(1.0, 0.0), (0.2, 0.5), (1.0, -0.7)] {
            rows.push((radius, cone));
        }
    }
    let single = |(width, spread): (f64, f64)| Cone {
        width: width as f32,
        spread: spread as f32,
    };
    let inputs: Vec<_> = rows
        .iter()
        .map(|(radius, cone)| (single(*cone), (1.0 / *radius) as f32))
        .collect();
    let mirrored: Vec<Cone> = gpu().map("lib::ray_cone::mirrored_cone", &inputs);
    for ((radius, cone), got) in rows.iter().zip(mirrored) {
        let (width, spread) = pair(*radius, *cone, mirror);
        let name = format!("mirrored at {radius}: {cone:?}");
        let close = (f64::from(got.width) - width).abs() < 1e-3;
        verdict.that(&name, close, || format!("{got:?}, not {width}"));
        let close = (f64::from(got.spread) - spread).abs() < 1e-3;
        verdict.that(&name, close, || format!("{got:?}, not {spread}"));
    }
    for eta in [1.0 / 1.5, 1.33, 1.0] {
        let inputs: Vec<_> = (inputs.iter())
            .map(|(cone, curvature)| (*cone, *curvature, eta as f32))
            .collect();
        let refracted: Vec<Cone> = gpu().map("lib::ray_cone::refracted_cone", &inputs);
        for ((radius, cone), got) in rows.iter().zip(refracted) {
            let (_, spread) = pair(*radius, *cone, refract(eta));
            let close = (f64::from(got.spread) - spread).abs() < 1e-3;
            verdict.that(
                format!("refracted by {eta} at {radius}: {cone:?}"),
                close,
                || format!("{got:?}, not {spread}"),
            );
        }
    }
    verdict.close();
}

#[test]
fn a_cone_grows_with_the_distance() {
    let cone = |width, spread| Cone { width, spread };
    let rows = [
        ("from a point", (cone(0.0, 0.01), 50f32), [0.5, 0.01]),
        ("from a width", (cone(2.0, 0.5), 4.0), [4.0, 0.5]),
        ("to behind a focus", (cone(1.0, -0.5), 4.0), [-1.0, -0.5]),
        ("parallel", (cone(3.0, 0.0), 1e9), [3.0, 0.0]),
    ];
    let inputs: Vec<_> = rows.iter().map(|row| row.1).collect();
    let found: Vec<Cone> = gpu().map("lib::ray_cone::cone_at", &inputs);
    for ((name, _, expected), got) in rows.iter().zip(found) {
        assert_eq!([got.width, got.spread], *expected, "{name}");
    }
}

#[test]
fn vectors_in_a_triangle_have_the_u_and_v_of_an_affine_map() {
    let mut random = Random::new(9);
    let mut vector = |size: f64| size * random.in_cube();
    let rows: Vec<_> = (0..1000)
        .map(|i| {
            let size = [1e-6, 1.0, 1e5][i % 3];
            let (e1, e2) = (vector(size), vector(size));
            let (d1, d2) = (vector(1.0).truncate(), vector(1.0).truncate());
            let weights = vector(3.0);
            let v = weights.x * e1 + weights.y * e2;
            let input = (
                v.as_vec3().to_array(),
                e1.as_vec3().to_array(),
                e2.as_vec3().to_array(),
                d1.as_vec2().to_array(),
                d2.as_vec2().to_array(),
            );
            (e1, e2, weights.x * d1 + weights.y * d2, input)
        })
        .collect();
    let inputs: Vec<_> = rows.iter().map(|row| row.3).collect();
    let found: Vec<[f32; 2]> = gpu().map("lib::ray_cone::uv_along", &inputs);
    let mut verdict = Verdict::on("uv_along");
    for ((e1, e2, expected, _), got) in rows.iter().zip(found) {
        let sine = e1.cross(*e2).length() / (e1.length() * e2.length());
        let off = (DVec2::from(got.map(f64::from)) - *expected).length();
        verdict.that(
            format!("{e1} {e2}"),
            off < 1e-4 / sine.max(1e-3).powi(2),
            || format!("{got:?}, not {expected}"),
        );
    }
    verdict.close();
}

#[test]
fn edges_of_a_sphere_have_its_curvature() {
    gpu().check(
        "lib::ray_cone::curvature_along",
        Tolerance::Absolute(1e-6),
        &[
            ("radius 1", ([1f32, -1.0, 0.0], [1f32, -1.0, 0.0]), 1.0),
            ("radius 2", ([2.0, -2.0, 0.0], [1.0, -1.0, 0.0]), 0.5),
            ("hollow", ([1.0, 0.0, 1.0], [-0.5, 0.0, -0.5]), -0.5),
            ("flat", ([3.0, 1.0, 0.0], [0.0, 0.0, 0.0]), 0.0),
            (
                "a cylinder",
                ([1.0, -1.0, SQRT_2 as f32], [1.0, -1.0, 0.0]),
                0.5,
            ),
            ("no edge", ([0.0; 3], [1.0, 0.0, 0.0]), 0.0),
        ],
    );
}
