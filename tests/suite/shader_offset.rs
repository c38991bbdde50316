//! `lib/offset.wesl`: rays start on the correct side of a surface, and close to it.

use crate::support::{
    harness::gpu,
    random::Random,
    types::ray,
    verdict::{Tolerance, Verdict, ulp},
};
use glam::DVec3;

/// The hit point as computed by the shader, and the origin of a ray that leaves it.
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

/// The distance of each origin from the plane of the triangle, on the side of the ray, and the rounding error
/// of the coordinates of the triangle.
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
            // If a triangle is so thin that its normal is noise, no side is correct.
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

/// A ray that leaves a plane sees an object slightly above it: the offset does not skip it.
#[test]
fn a_ray_from_a_plane_sees_another_just_above_it() {
    const LOOK_UP: &str = "
        import package::types::{NONE, NO_INSTANCE};
        import package::types::tracing::Ray;
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
        // Closer than the error bound, the two count as one surface.
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

#[test]
fn a_fixed_offset_has_its_length_on_the_side_of_the_ray() {
    let up = [0f32, 1.0, 0.0];
    let p = [1f32, 2.0, 3.0];
    #[rustfmt::skip]
    gpu().check("lib::offset::fixed_origin", Tolerance::Relative(1e-6), &[
        ("up, for a ray that goes up", (p, up, [0.6f32, 0.8, 0.0], 0.25f32), [1.0, 2.25, 3.0]),
        ("down, for a ray that goes down", (p, up, [0.6, -0.8, 0.0], 0.25), [1.0, 1.75, 3.0]),
        ("the sign of the normal does not matter", (p, [0.0, -1.0, 0.0], [0.6, 0.8, 0.0], 0.25), [1.0, 2.25, 3.0]),
        ("along a slanted normal", (p, [0.6, 0.0, 0.8], [0.0, 0.0, 1.0], 10.0), [7.0, 2.0, 11.0]),
        ("a grazing ray goes to the back", (p, up, [1.0, 0.0, 0.0], 0.5), [1.0, 1.5, 3.0]),
    ]);
}

#[test]
fn a_reflected_ray_starts_on_the_path_of_the_incoming_ray() {
    let error = [0f32, 1e-3, 0.0];
    let (up, o) = ([0f32, 1.0, 0.0], [0f32; 3]);
    let slanted = |length: f32| ray([-0.6 * length, 0.8 * length, 0.0], [0.6, -0.8, 0.0]);
    const RETREAT: &str = "
        import package::types::tracing::Ray;
        import package::lib::offset::mirrored_origin;
        fn probe(error: vec3f, ng: vec3f, arriving: Ray, distance: f32, is_flat: bool) -> vec3f {
            return mirrored_origin(vec3f(0.0), error, ng, arriving, distance, is_flat);
        }
    ";
    let down = [0f32, -1.0, 0.0];
    #[rustfmt::skip]
    let rows = [
        ("head on, straight back by the error", (error, up, ray(up, down), 1f32, true), [0.0, 1e-3, 0.0]),
        ("the sign of the normal does not matter", (error, down, ray(up, down), 1.0, true), [0.0, 1e-3, 0.0]),
        ("aslant, to the same height", (error, up, slanted(1.0), 1.0, true), [-0.75e-3, 1e-3, 0.0]),
        ("from too near a flat surface, where the other ray started", (error, up, slanted(2e-3), 2e-3, true), [-1.2e-3, 1.6e-3, 0.0]),
        ("from too near a curved surface, along the normal", (error, up, slanted(2e-3), 2e-3, false), [0.0, 1e-3, 0.0]),
        ("without error it starts where the other ends", (o, up, slanted(1.0), 1.0, true), [0.0; 3]),
    ];
    let inputs: Vec<_> = rows.iter().map(|row| row.1).collect();
    let origins: Vec<[f32; 3]> = gpu().map_source(RETREAT, &inputs);
    let mut verdict = Verdict::on("mirrored_origin");
    for ((name, _, expected), got) in rows.iter().zip(&origins) {
        verdict.near(name, got, expected, Tolerance::Absolute(1e-9));
    }
    verdict.close();
}

/// Two triangles that meet at a sharp edge; a ray from between them is reflected close to it.
#[test]
fn a_reflected_ray_starts_between_the_two_faces_of_a_sharp_edge() {
    const MIRROR: &str = "
        import package::types::{NONE, NO_INSTANCE};
        import package::types::tracing::Ray;
        import package::lib::numeric::normalize_or;
        import package::lib::offset::{mirrored_origin, triangle_error};
        fn probe(v0: vec3f, v1: vec3f, v2: vec3f, weights: vec2f, origin: vec3f) -> vec3f {
            let p = (1.0 - weights.x - weights.y) * v0 + weights.x * v1 + weights.y * v2;
            let ng = normalize_or(cross(v1 - v0, v2 - v0), v0);
            let direction = normalize(p - origin);
            let arriving = Ray(origin, 3e38, direction, NONE, NO_INSTANCE);
            let error = triangle_error(v0, v1, v2, weights.x, weights.y);
            return mirrored_origin(p, error, ng, arriving, length(p - origin), true);
        }
    ";
    let mut random = Random::new(18);
    let mut rows = Vec::new();
    let mut others = Vec::new();
    for _ in 0..50_000 {
        let scale = 10f64.powf(random.between(-6.0, 6.0));
        let place = scale * random.in_cube();
        let (x, aside) = (random.direction(), random.direction());
        let y = x.cross(aside).normalize();
        let z = x.cross(y);
        let angle = random.between(0.01, 1.5);
        let single = |v: DVec3| (place + scale * v).as_vec3();
        let [v0, v1, v2] = [-x, x, y].map(single);
        let other = single(angle.cos() * y + angle.sin() * z);
        let (turn, far) = (angle * random.between(0.2, 0.8), random.between(0.1, 0.5));
        let origin =
            single(far * (turn.cos() * y + turn.sin() * z) + random.between(-0.2, 0.2) * x);
        let from_edge = 10f64.powf(random.between(-7.0, -2.0)) as f32;
        rows.push((
            v0.to_array(),
            v1.to_array(),
            v2.to_array(),
            [random.between(0.3, 0.6) as f32, from_edge],
            origin.to_array(),
        ));
        others.push(other.as_dvec3());
    }
    let origins: Vec<[f32; 3]> = gpu().map_source(MIRROR, &rows);
    let mut verdict = Verdict::on("rays mirrored in an edge");
    for ((row, other), got) in rows.iter().zip(&others).zip(&origins) {
        let [a, b, c, from, got] =
            [row.0, row.1, row.2, row.4, *got].map(|v| DVec3::from(v.map(f64::from)));
        let largest = a.abs().max(b.abs()).max(c.abs()).max_element();
        for (face, corner) in [("its own", c), ("the other", *other)] {
            let n = (b - a).cross(corner - a).normalize();
            let side = n.dot(from - a).signum();
            let clearance = side * n.dot(got - a) / ulp(largest);
            verdict.that(format!("{face} face, {row:?}"), clearance > -4.0, || {
                format!("{clearance} ulp inside")
            });
        }
    }
    verdict.close();
}
