//! `lib/offset.wesl`: leaving a surface on the right side of it, and not too far.

use crate::support::{
    harness::gpu,
    random::Random,
    verdict::{Tolerance, Verdict, ulp},
};
use glam::DVec3;

/// The point, as the shader makes it from a hit, and the origin of a ray that leaves it.
const LEAVE: &str = "
    import package::lib::numeric::normalize_or;
    import package::lib::offset::{offset_origin, triangle_error};
    fn probe(v0: vec3f, v1: vec3f, v2: vec3f, weights: vec2f, direction: vec3f) -> vec3f {
        let p = (1.0 - weights.x - weights.y) * v0 + weights.x * v1 + weights.y * v2;
        let ng = normalize_or(cross(v1 - v0, v2 - v0), -direction);
        return offset_origin(p, triangle_error(v0, v1, v2, weights.x, weights.y), ng, direction);
    }
";

type Leave = ([f32; 3], [f32; 3], [f32; 3], [f32; 2], [f32; 3]);

/// Rays of all slopes that leave 1000 triangles, 100 each; every tenth one grazes.
fn rays_that_leave(mut triangle: impl FnMut(&mut Random) -> [DVec3; 3]) -> Vec<Leave> {
    let mut random = Random::new(17);
    let mut rows = Vec::new();
    while rows.len() < 100_000 {
        let corners = triangle(&mut random).map(|v| v.as_vec3());
        let [v0, v1, v2] = corners.map(|v| v.as_dvec3());
        let n = (v1 - v0).cross(v2 - v0).normalize();
        for i in 0..100 {
            let (u, v) = (random.between(0.0, 1.0), random.between(0.0, 1.0));
            let aside = n.cross(random.direction()).normalize();
            let cos = if i % 10 == 0 {
                1e-6
            } else {
                10f64.powf(random.between(-6.0, 0.0))
            };
            let side = if random.below(2) == 0 { n } else { -n };
            let direction = (aside * (1.0 - cos * cos).sqrt() + cos * side).normalize();
            let [a, b, c] = corners.map(|v| v.to_array());
            rows.push((
                a,
                b,
                c,
                [(u * (1.0 - v)) as f32, v as f32],
                direction.as_vec3().to_array(),
            ));
        }
    }
    rows
}

/// How far each origin is from the triangle's plane, on the side to which the ray goes, and the
/// rounding of the triangle's coordinates.
fn clearances(rows: &[Leave]) -> Vec<(f64, f64)> {
    let origins: Vec<[f32; 3]> = gpu().map_source(LEAVE, rows);
    let distance = |(row, origin): (&Leave, &[f32; 3])| {
        let (a, b, c, _, direction) = row;
        let [a, b, c, direction, origin] =
            [a, b, c, direction, origin].map(|v| DVec3::from(v.map(f64::from)));
        let n = (b - a).cross(c - a).normalize();
        let largest = a.abs().max(b.abs()).max(c.abs()).max_element();
        (
            (origin - a).dot(n) * n.dot(direction).signum(),
            ulp(largest),
        )
    };
    rows.iter().zip(&origins).map(distance).collect()
}

#[test]
fn a_ray_leaves_a_triangle_on_its_own_side_at_every_scale() {
    let rows = rays_that_leave(|random| {
        loop {
            let scale = 10f64.powf(random.between(-8.0, 8.0));
            let corners = std::array::from_fn(|_| scale * random.in_cube());
            let [a, b, c]: [DVec3; 3] = corners;
            // Where the triangle is so thin that its normal is noise, no point is on its right side.
            if (b - a).cross(c - a).length() > 1e-3 * (b - a).length() * (c - a).length() {
                return corners;
            }
        }
    });
    let mut verdict = Verdict::on("offset_origin");
    for (row, (clearance, ulp)) in rows.iter().zip(clearances(&rows)) {
        verdict.that(format!("{row:?}"), clearance > 0.0, || {
            format!("{} ulp", clearance / ulp)
        });
        // Error bounds of three coordinates, 16 half steps each and some for the sum.
        verdict.that(format!("{row:?} is near"), clearance < 32.0 * ulp, || {
            format!("{} ulp", clearance / ulp)
        });
    }
    verdict.close();
}

#[test]
fn a_ray_leaves_a_triangle_far_from_the_origin() {
    let rows = rays_that_leave(|random| {
        let place = 1e4 * random.direction();
        let size = 10f64.powf(random.between(-1.0, 3.0));
        loop {
            let corners = std::array::from_fn(|_| place + size * random.in_cube());
            let [a, b, c]: [DVec3; 3] = corners;
            if (b - a).cross(c - a).length() > 0.1 * (b - a).length() * (c - a).length() {
                return corners;
            }
        }
    });
    let mut verdict = Verdict::on("offset_origin");
    for (row, (clearance, ulp)) in rows.iter().zip(clearances(&rows)) {
        let holds = clearance > 0.0 && clearance < 32.0 * ulp;
        verdict.that(format!("{row:?}"), holds, || {
            format!("{} ulp", clearance / ulp)
        });
    }
    verdict.close();
}

/// A ray that leaves a plane sees what is a little above it: the offset does not jump over.
#[test]
fn a_ray_from_a_plane_sees_another_just_above_it() {
    const LOOK_UP: &str = "
        import package::types::{NONE, NO_INSTANCE, Ray};
        import package::lib::intersect::plane::intersect_plane;
        import package::lib::offset::{offset_origin, plane_error};
        fn probe(p: vec3f, above: vec3f) -> bool {
            let n = vec3f(0.0, 0.0, 1.0);
            let origin = offset_origin(p, plane_error(p, p), n, n);
            return intersect_plane(Ray(origin, 3e38, n, NONE, NO_INSTANCE), above, n).hit;
        }
    ";
    let mut rows = Vec::new();
    for z in [1e-3f32, 1.0, 1e3, 1e5] {
        for gap in [1, 4, 64, 1024] {
            let above = f32::from_bits(z.to_bits() + gap);
            rows.push((gap, ([3.0f32, -7.0, z], [3.0f32, -7.0, above])));
        }
    }
    let inputs: Vec<_> = rows.iter().map(|(_, input)| *input).collect();
    let seen: Vec<bool> = gpu().map_source(LOOK_UP, &inputs);
    let mut verdict = Verdict::on("a plane above another");
    for ((gap, (p, _)), seen) in rows.iter().zip(&seen) {
        // Nearer than the error bound, the two count as one surface.
        if *gap >= 64 {
            verdict.near(
                format!("{gap} ulp above z = {}", p[2]),
                seen,
                &true,
                Tolerance::Exact,
            );
        }
    }
    verdict.close();
}

#[test]
fn offsets_follow_the_normal_to_the_side_of_the_ray() {
    let error = [1e-3f32, 2e-3, 4e-3];
    let o = [0f32; 3];
    #[rustfmt::skip]
    gpu().check("lib::offset::offset_origin", Tolerance::Relative(1e-6), &[
        ("up, by the error along the normal", (o, error, [0f32, 1.0, 0.0], [0f32, 1.0, 0.0]), [0.0, 2e-3, 0.0]),
        ("down for a ray that goes down", (o, error, [0.0, 1.0, 0.0], [0.6, -0.8, 0.0]), [0.0, -2e-3, 0.0]),
        ("the sign of the normal does not matter", (o, error, [0.0, 0.0, -1.0], [0.0, 0.0, 1.0]), [0.0, 0.0, 4e-3]),
        ("a slanted normal adds the errors up", (o, error, [0.6, 0.0, 0.8], [1.0, 0.0, 0.0]), [0.6 * 3.8e-3, 0.0, 0.8 * 3.8e-3]),
        ("without error a point at the origin stays", (o, [0.0; 3], [0.0, 1.0, 0.0], [0.0, 1.0, 0.0]), [0.0; 3]),
    ]);
}
