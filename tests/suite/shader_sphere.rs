//! Level 2: `lib/intersect/sphere.wesl` against exact roots.

use crate::support::{
    harness::gpu,
    random::Random,
    types::{Candidate, Ray, ray},
    verdict::{Tolerance, Verdict, ulp},
};
use glam::{DVec3, Vec3};

const INTERSECT: &str = "lib::intersect::sphere::intersect_sphere";
/// 2^-20, exact in f32.
const HAIR: f32 = 1.0 / 1_048_576.0;

/// Some((near, far)) roots in f64, of the same numbers that the shader gets.
fn roots(ray: &Ray, center: [f32; 3], radius: f32) -> Option<(f64, f64)> {
    let d = DVec3::from(ray.direction.map(f64::from));
    let f = DVec3::from(ray.origin.map(f64::from)) - DVec3::from(center.map(f64::from));
    let middle = -f.dot(d) / d.length_squared();
    let half_chord = f64::from(radius).powi(2) - (f + middle * d).length_squared();
    let half = (half_chord.max(0.0) / d.length_squared()).sqrt();
    (half_chord >= 0.0).then_some((middle - half, middle + half))
}

#[test]
fn a_sphere_is_hit_where_it_should_be() {
    let from = |origin, direction| ray(origin, direction);
    let ahead = [0.0, 0.0, -1.0];
    let o = [0.0; 3];
    let five = [0f32, 0.0, -5.0];
    #[rustfmt::skip]
    gpu().check(INTERSECT, Tolerance::Ulps(2.0), &[
        ("head on", (from(o, ahead), five, 1f32), Some(4.0)),
        ("from behind it is not hit", (from([0.0, 0.0, -7.0], ahead), five, 1.0), None),
        ("well beside it", (from([0.0, 2.0, 0.0], ahead), five, 1.0), None),
        ("at 3/5 of the radius the chord is 4/5", (from([3.0, 0.0, 0.0], ahead), [0.0, 0.0, -9.0], 5.0), Some(5.0)),
        ("a tangent touches", (from([0.0, 1.0, 0.0], ahead), five, 1.0), Some(5.0)),
        ("a tangent in a corner of the picture", (from([3.0, 4.0, 0.0], ahead), five, 5.0), Some(5.0)),
        ("a hair outside the tangent", (from([0.0, 1.0 + HAIR, 0.0], ahead), five, 1.0), None),
        ("from the centre to the surface", (from(five, ahead), five, 2.0), Some(2.0)),
        ("from inside the root is the far one", (from([0.0, 0.0, -4.5], ahead), five, 1.0), Some(1.5)),
        ("from inside across", (from([0.0, 3.0, -5.0], ahead), five, 5.0), Some(4.0)),
        ("from the surface inwards through the centre", (from([0.0, 0.0, -4.0], ahead), five, 1.0), Some(2.0)),
        ("from the surface outwards", (from([0.0, 0.0, -6.0], ahead), five, 1.0), None),
        ("from the surface along it", (from([0.0, 1.0, -5.0], ahead), five, 1.0), None),
        ("from the surface inwards aslant", (from([0.0, 3.0, -1.0], ahead), five, 5.0), Some(8.0)),
        ("a tiny sphere", (from([0.0, 0.0, 1e-10], ahead), [0.0; 3], 5e-11), Some(f64::from(1e-10f32) - f64::from(5e-11f32))),
        ("a huge sphere", (from([0.0, 0.0, 3e9], ahead), [0.0; 3], 1e9), Some(2e9)),
        ("a million radii away", (from(o, ahead), [0.0, 0.0, -1e6], 1.0), Some(999_999.0)),
        ("a direction of length 2 halves t", (from(o, [0.0, 0.0, -2.0]), five, 1.0), Some(2.0)),
    ]);
}

#[test]
fn a_hair_inside_the_tangent_hits() {
    let t: Vec<Candidate> = gpu().map(
        INTERSECT,
        &[(
            ray([0.0, 1.0 - HAIR, 0.0], [0.0, 0.0, -1.0]),
            [0f32, 0.0, -5.0],
            1f32,
        )],
    );
    // The half chord is √(2 · 2^-20), and only a few digits of it remain.
    let expected = 5.0 - (2.0f64 / 1_048_576.0).sqrt();
    assert!(
        t[0].hit && (f64::from(t[0].t) - expected).abs() < 1e-4,
        "{:?}",
        t[0]
    );
}

#[test]
fn far_spheres_are_hit_and_t_is_right_to_a_few_roundings() {
    let mut verdict = Verdict::on("a sphere of radius 1 at a distance");
    for distance in [1e1, 1e2, 1e3, 1e4, 1e5, 1e6] {
        let mut random = Random::new(5);
        let inputs: Vec<_> = (0..400)
            .map(|_| {
                let toward = random.direction();
                let center = (toward * distance).as_vec3();
                let target = center.as_dvec3() + 0.9 * random.in_cube().clamp_length_max(1.0);
                (
                    ray([0.0; 3], target.normalize().as_vec3().into()),
                    center.to_array(),
                    1f32,
                )
            })
            .collect();
        let candidates: Vec<Candidate> = gpu().map(INTERSECT, &inputs);
        for (i, ((ray, center, radius), got)) in inputs.iter().zip(&candidates).enumerate() {
            let t = roots(ray, *center, *radius).map(|(near, _)| near);
            // Rounding the direction alone moves the distant rays by more than the rest of the radius.
            if t.is_some() {
                verdict.near(
                    format!("distance {distance}, ray {i}"),
                    got,
                    &t,
                    Tolerance::Ulps(4.0),
                );
            }
        }
    }
    verdict.close();
}

#[test]
fn an_earth_at_the_feet_is_hit_to_the_rounding_of_its_radius() {
    // c = |f|² - r² cannot be more accurate than the coordinates: half a metre here.
    let radius = 6.4e6f32;
    let mut random = Random::new(6);
    let inputs: Vec<_> = (0..400)
        .map(|i| {
            let height = [0.0, 2.0, 100.0, 1e4][i % 4];
            let down = random.direction();
            let center = (down * (f64::from(radius) + height)).as_vec3();
            let direction = (down + 0.9 * random.direction()).normalize();
            (
                ray([0.0; 3], direction.as_vec3().into()),
                center.to_array(),
                radius,
            )
        })
        .collect();
    let candidates: Vec<Candidate> = gpu().map(INTERSECT, &inputs);
    let mut verdict = Verdict::on("a sphere of radius 6.4e6 near the origin");
    let most = 4.0 * ulp(f64::from(radius));
    for (i, ((ray, center, radius), got)) in inputs.iter().zip(&candidates).enumerate() {
        let Some((near, far)) = roots(ray, *center, *radius) else {
            continue;
        };
        let height = DVec3::from(center.map(f64::from)).length() - f64::from(*radius);
        let cos = ((near + far) / 2.0).abs() / f64::from(*radius);
        let error = (f64::from(got.t) - near)
            .abs()
            .min((f64::from(got.t) - far).abs());
        // The rounding of c reaches t divided by the cosine at which the ray meets the ground.
        let name = format!("ray {i} from {height:.1} m, cosine {cos:.3}");
        verdict.that(name, !got.hit || error * cos <= most, || {
            format!("{got:?}, roots {near} and {far}")
        });
        if near > most / cos {
            verdict.that(format!("ray {i} hits"), got.hit, || {
                format!("{got:?}, roots {near} and {far}")
            });
        }
    }
    verdict.close();
}

#[test]
fn a_ray_that_leaves_a_sphere_does_not_hit_it_again() {
    const LEAVE: &str = "
        import package::types::{NONE, NO_INSTANCE};
        import package::types::tracing::Ray;
        import package::lib::intersect::sphere::intersect_sphere;
        import package::lib::numeric::normalize_or;
        import package::lib::offset::{offset_origin, sphere_error};
        fn probe(toward: vec3f, center: vec3f, radius: f32, direction: vec3f) -> bool {
            let ng = normalize_or(toward, vec3f(0.0, 1.0, 0.0));
            let p = center + radius * ng;
            let origin = offset_origin(p, sphere_error(center, radius), ng, direction);
            return intersect_sphere(Ray(origin, 3e38, direction, NONE, NO_INSTANCE), center, radius).hit;
        }
    ";
    let mut random = Random::new(7);
    let mut inputs = Vec::new();
    for _ in 0..1000 {
        let radius = 10f64.powf(random.between(-8.0, 8.0));
        let center = random.in_cube() * radius * 10f64.powf(random.between(-2.0, 3.0));
        for i in 0..100 {
            let n = random.direction();
            let aside = n.cross(random.direction()).normalize();
            // Every tenth ray grazes, down to a cosine of 10^-6.
            let cos = if i % 10 == 0 {
                1e-6
            } else {
                10f64.powf(random.between(-6.0, 0.0))
            };
            let direction = (aside * (1.0 - cos * cos).sqrt() + cos * n).normalize();
            inputs.push((
                n.as_vec3().to_array(),
                center.as_vec3().to_array(),
                radius as f32,
                direction.as_vec3().to_array(),
            ));
        }
    }
    let hits: Vec<bool> = gpu().map_source(LEAVE, &inputs);
    let mut verdict = Verdict::on("rays that leave a sphere");
    for ((n, center, radius, direction), hit) in inputs.iter().zip(&hits) {
        verdict.that(format!("sphere {center:?}, radius {radius}"), !hit, || {
            format!(
                "hit again in direction {direction:?}, cosine {}",
                Vec3::from(*n).dot(Vec3::from(*direction))
            )
        });
    }
    verdict.close();
}
