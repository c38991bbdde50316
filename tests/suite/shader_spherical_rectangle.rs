//! `lib/spherical_rectangle.wesl`: rectangles by their solid angle.

use crate::support::{
    harness::gpu,
    random::Random,
    statistics::{check_counts, square_points},
    verdict::Verdict,
};
use glam::DVec3;
use std::f64::consts::PI;

const VIEW: &str = "import package::lib::spherical_rectangle::{rectangle_point, rectangle_view};";

/// A rectangle, relative to the point that sees it: its centre and the halves of its edges.
fn rectangles() -> Vec<[DVec3; 3]> {
    let mut random = Random::new(5);
    (0..12)
        .map(|_| {
            let u = random.direction();
            let v = u.cross(random.direction()).normalize();
            let size = [random.between(0.3, 2.0), random.between(0.3, 2.0)];
            let away = u.cross(v)
                * random.between(0.3, 1.5)
                * if random.below(2) == 0 { 1.0 } else { -1.0 };
            let aside = u * random.between(-1.0, 1.0) + v * random.between(-1.0, 1.0);
            [away + aside, size[0] * u, size[1] * v]
        })
        .collect()
}

fn narrow(v: DVec3) -> [f32; 3] {
    v.as_vec3().to_array()
}

/// The integral of cos/d² over the rectangle `x0..x1` × `y0..y1` of its square from -1 to 1.
fn solid_angle(
    [center, u, v]: [DVec3; 3],
    [x0, x1]: [f64; 2],
    [y0, y1]: [f64; 2],
    parts: usize,
) -> f64 {
    let n = u.cross(v);
    let mut sum = 0.0;
    for i in 0..parts {
        for j in 0..parts {
            let at = |low: f64, high: f64, k: usize| {
                low + (high - low) * (k as f64 + 0.5) / parts as f64
            };
            let to = center + at(x0, x1, i) * u + at(y0, y1, j) * v;
            sum += n.dot(to).abs() / to.length().powi(3);
        }
    }
    sum * (x1 - x0) * (y1 - y0) / (parts * parts) as f64
}

#[test]
fn points_of_a_rectangle_are_uniform_over_its_solid_angle() {
    let mut verdict = Verdict::on("rectangles of random views");
    let angle = format!(
        "{VIEW} fn probe(c: vec3f, u: vec3f, v: vec3f) -> f32 {{ return rectangle_view(c, u, v).angle; }}"
    );
    let point = format!(
        "{VIEW} fn probe(c: vec3f, u: vec3f, v: vec3f, s: vec2f) -> vec3f {{ return rectangle_point(rectangle_view(c, u, v), s); }}"
    );
    let all = rectangles();
    let rows: Vec<_> = all
        .iter()
        .map(|r| (narrow(r[0]), narrow(r[1]), narrow(r[2])))
        .collect();
    let angles: Vec<f32> = gpu().map_source(&angle, &rows);
    const SAMPLES: usize = 20_000;
    const SIDE: usize = 6;
    for (&rectangle, found) in all.iter().zip(angles) {
        let [center, u, v] = rectangle;
        let expected = solid_angle(rectangle, [-1.0, 1.0], [-1.0, 1.0], 300);
        let name = format!("{center:.2}, {u:.2}, {v:.2}");
        let off = (f64::from(found) / expected - 1.0).abs();
        verdict.that(format!("angle: {name}"), off < 1e-3, || {
            format!("{found}, not {expected}")
        });
        let rows: Vec<_> = square_points(SAMPLES, 3)
            .into_iter()
            .map(|s| (narrow(center), narrow(u), narrow(v), s))
            .collect();
        let points: Vec<[f32; 3]> = gpu().map_source(&point, &rows);
        let mut counts = vec![0_u32; SIDE * SIDE];
        for p in points {
            let from_center = DVec3::from(p.map(f64::from)) - center;
            let place = [u, v].map(|edge| from_center.dot(edge) / edge.length_squared());
            let outside = place[0].abs().max(place[1].abs());
            verdict.that(format!("inside: {name}"), outside < 1.0 + 1e-4, || outside);
            let [i, j] = place.map(|x| (((0.5 + 0.5 * x) * SIDE as f64) as usize).min(SIDE - 1));
            counts[i * SIDE + j] += 1;
        }
        let cells: Vec<f64> = (0..SIDE * SIDE)
            .map(|k| {
                let ends = |k: usize| [k, k + 1].map(|k| 2.0 * k as f64 / SIDE as f64 - 1.0);
                SAMPLES as f64 * solid_angle(rectangle, ends(k / SIDE), ends(k % SIDE), 60)
                    / expected
            })
            .collect();
        check_counts(&mut verdict, format!("cells: {name}"), &counts, &cells);
    }
    // Half of all directions is an upper bound, and a square around the axis of a cube has a sixth of them.
    let cube: Vec<f32> = gpu().map_source(
        &angle,
        &[([0_f32, 0.0, 1.0], [1_f32, 0.0, 0.0], [0_f32, 1.0, 0.0])],
    );
    verdict.that(
        "a face of a cube",
        (f64::from(cube[0]) - 4.0 * PI / 6.0).abs() < 1e-5,
        || cube[0],
    );
    verdict.close();
}

/// Samples of an area light have the density that a path which hits the light finds, and the mean of its reciprocal is
/// the solid angle.
#[test]
fn samples_and_hits_of_a_light_agree_about_the_density() {
    let mut verdict = Verdict::on("area lights seen from the origin");
    let probe = |kind: &str| {
        format!(
            "import package::types::{{LIGHT_DISC, LIGHT_RECTANGLE, LIGHT_SPHERE, PackedLight}};
            import package::lib::spherical_rectangle::{{solid_density, solid_sample}};
            fn probe(c: vec3f, u: vec3f, v: vec3f, s: vec2f) -> vec2f {{
                var light: PackedLight;
                light.kind = {kind};
                light.position = c;
                light.edge_u = u;
                light.edge_v = v;
                light.direction = normalize(cross(v, u));
                light.radius = length(u);
                let found = solid_sample(light, vec3f(0.0), s);
                return vec2f(found.pdf, solid_density(light, vec3f(0.0), found.direction, found.distance));
            }}"
        )
    };
    // Near, and so far away that rectangles are sampled by area.
    for distance in [1.2, 30.0] {
        let [center, u, v] = [
            DVec3::new(0.3, 0.2, 1.0) * distance,
            DVec3::new(0.5, 0.1, 0.0),
            DVec3::new(-0.1, 0.5, 0.0),
        ];
        let cap = 1.0 - (1.0 - u.length_squared() / center.length_squared()).sqrt();
        let square = solid_angle([center, u, v], [-1.0, 1.0], [-1.0, 1.0], 400);
        let mut round = 0.0;
        for i in 0..400 {
            for j in 0..100 {
                let (radius, phi) = (
                    (f64::from(i) + 0.5) / 400.0,
                    2.0 * PI * (f64::from(j) + 0.5) / 100.0,
                );
                let to = center + radius * (phi.cos() * u + phi.sin() * v);
                round +=
                    u.cross(v).dot(to).abs() / to.length().powi(3) * radius * 2.0 * PI / 40_000.0;
            }
        }
        for (kind, expected) in [
            ("LIGHT_RECTANGLE", square),
            ("LIGHT_DISC", round),
            ("LIGHT_SPHERE", 2.0 * PI * cap),
        ] {
            let rows: Vec<_> = square_points(4096, 9)
                .into_iter()
                .map(|s| (narrow(center), narrow(u), narrow(v), s))
                .collect();
            let found: Vec<[f32; 2]> = gpu().map_source(&probe(kind), &rows);
            let name = format!("{kind} at {distance}");
            for [sampled, hit] in &found {
                let off = f64::from((sampled / hit - 1.0).abs());
                verdict.that(&name, off < 1e-3, || format!("{sampled} and {hit}"));
            }
            let mean = found
                .iter()
                .map(|[pdf, _]| 1.0 / f64::from(*pdf))
                .sum::<f64>()
                / 4096.0;
            verdict.that(&name, (mean / expected - 1.0).abs() < 3e-3, || {
                format!("{mean}, not {expected}")
            });
        }
    }
    verdict.close();
}
