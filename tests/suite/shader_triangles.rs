//! Level 2: the three triangle tests on the same inputs, and the properties of the watertight one.

use crate::support::{
    harness::{gpu, probe},
    random::Random,
    types::{Candidate, Ray, ray},
    verdict::{Tolerance, Verdict},
};
use glam::{DMat3, DVec3, Vec3};
use std::f64::consts::{PI, TAU};

type Triangle = [[f32; 3]; 3];

/// The tests and the call of each on (ray, v0, v1, v2).
const METHODS: [(&str, &str); 3] = [
    ("plane", "intersect_triangle_plane(ray, v0, v1, v2)"),
    (
        "moller-trumbore",
        "intersect_triangle_moller_trumbore(ray, v0, v1, v2)",
    ),
    (
        "watertight",
        "intersect_triangle_watertight(ray.origin, shear_of(ray.direction), v0, v1, v2)",
    ),
];
const WATERTIGHT: &str = METHODS[2].1;

const IMPORTS: &str = "
    import package::types::tracing::{Candidate, Ray};
    import package::lib::intersect::triangle_moller_trumbore::intersect_triangle_moller_trumbore;
    import package::lib::intersect::triangle_plane::intersect_triangle_plane;
    import package::lib::intersect::triangle_watertight::{intersect_triangle_watertight, shear_of};
";

/// One ray and one triangle in each row.
fn intersect(call: &str, rows: &[(Ray, Triangle)]) -> Vec<Candidate> {
    let source = format!(
        "{IMPORTS} fn probe(ray: Ray, v0: vec3f, v1: vec3f, v2: vec3f) -> Candidate {{ return {call}; }}"
    );
    let inputs: Vec<_> = rows
        .iter()
        .map(|&(ray, [v0, v1, v2])| (ray, v0, v1, v2))
        .collect();
    gpu().map_source(&source, &inputs)
}

/// The number of triangles of a mesh that each ray hits.
fn count_hits(call: &str, mesh: &[Triangle], rays: &[Ray]) -> Vec<u32> {
    let source = format!(
        "{IMPORTS}
        @group(0) @binding(0) var<storage, read> table: array<f32>;
        fn corner(i: u32) -> vec3f {{ return vec3f(table[3u * i], table[3u * i + 1u], table[3u * i + 2u]); }}
        fn probe(ray: Ray) -> u32 {{
            var hits = 0u;
            for (var i = 0u; i < {}u; i += 3u) {{
                let v0 = corner(i);
                let v1 = corner(i + 1u);
                let v2 = corner(i + 2u);
                hits += u32(({call}).hit);
            }}
            return hits;
        }}",
        3 * mesh.len(),
    );
    let table: Vec<f32> = mesh.iter().flatten().flatten().copied().collect();
    gpu().map_shader(&probe(&source).buffer("table", &table), rays)
}

/// Rows for all methods: (name, ray, triangle, t and weights of the second and third corner).
type Row = (&'static str, Ray, Triangle, Option<[f64; 3]>);

fn check_with_every_method(tolerance: Tolerance, rows: &[Row]) {
    let inputs: Vec<_> = rows
        .iter()
        .map(|&(_, ray, triangle, _)| (ray, triangle))
        .collect();
    let mut verdict = Verdict::on("triangle tests");
    for (method, call) in METHODS {
        for ((name, .., expected), got) in rows.iter().zip(intersect(call, &inputs)) {
            verdict.near(format!("{method}: {name}"), &got, expected, tolerance);
        }
    }
    verdict.close();
}

#[test]
fn a_triangle_is_hit_where_it_should_be() {
    // Corners with integer coordinates: weights are quarters, and everything except rounded directions is
    // exact.
    let t = [[-1.0, -1.0, -3.0], [3.0, -1.0, -3.0], [-1.0, 3.0, -3.0]];
    let large = [[-4.0, -4.0, -4.0], [12.0, -4.0, -4.0], [-4.0, 12.0, -4.0]];
    let far = t.map(|v: [f32; 3]| v.map(|c| c * 1e6));
    let ahead = [0.0, 0.0, -1.0];
    let down = |x: f32, y: f32| ray([x, y, 0.0], ahead);
    let hair = 1.0 / 1_048_576.0;
    let (tilted, tilted_t) = ([0.6, 0.0, -0.8], 4.0 / f64::from(0.8f32));
    let tilted_b1 = (4.0 + tilted_t * f64::from(0.6f32)) / 16.0;
    #[rustfmt::skip]
    check_with_every_method(Tolerance::Ulps(4.0), &[
        ("inside", down(0.0, 0.0), t, Some([3.0, 0.25, 0.25])),
        ("near the second corner", down(1.5, -0.5), t, Some([3.0, 0.625, 0.125])),
        ("from behind", ray([0.0, 0.0, -6.0], [0.0, 0.0, 1.0]), t, Some([3.0, 0.25, 0.25])),
        ("with the corners turned round", down(0.0, 0.5), [t[0], t[2], t[1]], Some([3.0, 0.375, 0.25])),
        ("aslant", ray([0.0; 3], tilted), large, Some([tilted_t, tilted_b1, 0.25])),
        ("a million times as large and as far", ray([0.0; 3], ahead), far, Some([3e6, 0.25, 0.25])),
        ("it lies behind", ray([0.0, 0.0, -4.0], ahead), t, None),
        ("the ray points away", ray([0.0; 3], [0.0, 0.0, 1.0]), t, None),
        ("a parallel ray", ray([0.0; 3], [1.0, 0.0, 0.0]), t, None),
        ("a ray within the plane", ray([-5.0, 0.0, -3.0], [1.0, 0.0, 0.0]), t, None),
        ("a ray along an edge", ray([-5.0, -1.0, -3.0], [1.0, 0.0, 0.0]), t, None),
        ("a ray that starts on it", ray([0.0, 0.0, -3.0], ahead), t, None),
        ("beyond the left edge", down(-1.5, 0.0), t, None),
        ("beyond the lower edge", down(0.0, -1.5), t, None),
        ("beyond the long edge", down(1.5, 1.0), t, None),
        ("a hair beyond the left edge", down(-1.0 - hair, 0.0), t, None),
        ("a hair beyond the lower edge", down(0.0, -1.0 - hair), t, None),
        ("a hair beyond the long edge", down(1.0, 1.0 + 4.0 * hair), t, None),
        ("through the first corner", down(-1.0, -1.0), t, Some([3.0, 0.0, 0.0])),
        ("through the second corner", down(3.0, -1.0), t, Some([3.0, 1.0, 0.0])),
        ("through the third corner", down(-1.0, 3.0), t, Some([3.0, 0.0, 1.0])),
        ("through the middle of the lower edge", down(1.0, -1.0), t, Some([3.0, 0.5, 0.0])),
        ("through the middle of the left edge", down(-1.0, 1.0), t, Some([3.0, 0.0, 0.5])),
        ("through the middle of the long edge", down(1.0, 1.0), t, Some([3.0, 0.5, 0.5])),
    ]);
}

#[test]
fn triangles_of_every_size_are_hit() {
    let mut verdict = Verdict::on("triangles by size");
    // Powers of two, so that only the exponents change: 1e-8 to 1e8.
    let sizes: Vec<f32> = (-27..=27).map(|k| 2f32.powi(k)).collect();
    let at = |size: f32| {
        let triangle = [[-1.0, -1.0, -3.0], [3.0, -1.0, -3.0], [-1.0, 3.0, -3.0]];
        (
            ray([0.0; 3], [0.0, 0.0, -1.0]),
            triangle.map(|v: [f32; 3]| v.map(|c| c * size)),
        )
    };
    let inputs: Vec<_> = sizes.iter().map(|size| at(*size)).collect();
    for (method, call) in METHODS {
        for (size, got) in sizes.iter().zip(intersect(call, &inputs)) {
            let expected = Some([3.0 * f64::from(*size), 0.25, 0.25]);
            verdict.near(
                format!("{method}: {size:e} metres"),
                &got,
                &expected,
                Tolerance::Ulps(4.0),
            );
        }
    }
    verdict.close();
}

#[test]
fn axis_parallel_rays_hit_with_either_sign_of_zero() {
    let mut inputs = Vec::new();
    for axis in 0..3 {
        for sign in [1f32, -1.0] {
            for zeros in 0..4 {
                let zero = |bit: usize| if zeros >> bit & 1 == 1 { -0.0 } else { 0.0 };
                let turned = |along, u, v| {
                    let mut p = [0f32; 3];
                    (p[axis], p[(axis + 1) % 3], p[(axis + 2) % 3]) = (along, u, v);
                    p
                };
                let triangle = [
                    turned(2.0 * sign, -1.0, -1.0),
                    turned(2.0 * sign, 3.0, -1.0),
                    turned(2.0 * sign, -1.0, 3.0),
                ];
                inputs.push((ray([0.0; 3], turned(sign, zero(0), zero(1))), triangle));
            }
        }
    }
    let mut verdict = Verdict::on("axis-parallel rays");
    for (method, call) in METHODS {
        for ((ray, _), got) in inputs.iter().zip(intersect(call, &inputs)) {
            let name = format!("{method}: along {:?}", ray.direction);
            verdict.near(name, &got, &Some([2.0, 0.25, 0.25]), Tolerance::Exact);
        }
    }
    verdict.close();
}

#[test]
fn slivers_are_hit() {
    // 8 units long and 2^-20 wide: one to eight million.
    let w = 1.0 / 1_048_576.0f32;
    let needle = [[0.0, 0.0, -1.0], [8.0, 0.0, -1.0], [0.0, w, -1.0]];
    let ahead = [0.0, 0.0, -1.0];
    #[rustfmt::skip]
    check_with_every_method(Tolerance::Ulps(4.0), &[
        ("in its middle", ray([2.0, 0.25 * w, 0.0], ahead), needle, Some([1.0, 0.25, 0.25])),
        ("at its tip", ray([8.0, 0.0, 0.0], ahead), needle, Some([1.0, 1.0, 0.0])),
        ("beside it", ray([2.0, w, 0.0], ahead), needle, None),
        ("below it", ray([2.0, -0.25 * w, 0.0], ahead), needle, None),
        ("beyond its tip", ray([8.5, 0.0, 0.0], ahead), needle, None),
    ]);
}

#[test]
fn random_triangles_agree_with_exact_arithmetic() {
    let mut random = Random::new(8);
    let mut rows = Vec::new();
    while rows.len() < 5000 {
        let corners: [Vec3; 3] = std::array::from_fn(|_| random.in_cube().as_vec3());
        let [v0, v1, v2] = corners.map(|v| v.as_dvec3());
        let origin = (3.0 * random.in_cube()).as_vec3();
        let (u, v) = (random.between(0.0, 1.0), random.between(0.0, 1.0));
        let target = v0 + u * (1.0 - v) * (v1 - v0) + v * (v2 - v0);
        let d = (target - origin.as_dvec3()).normalize().as_vec3();
        // t (-d) + b1 e1 + b2 e2 = origin - v0, for the rounded numbers that the shader gets.
        let system = DMat3::from_cols(-d.as_dvec3(), v1 - v0, v2 - v0);
        let [t, b1, b2] = (system.inverse() * (origin.as_dvec3() - v0)).to_array();
        let n = (v1 - v0).cross(v2 - v0);
        let edge_on = n.normalize().dot(d.as_dvec3()).abs() < 0.1;
        let is_sliver = n.length() < 0.05;
        let is_clear = b1.min(b2).min(1.0 - b1 - b2) > 1e-3 && t > 1e-2;
        if !edge_on && !is_sliver && is_clear {
            rows.push((
                (ray(origin.into(), d.into()), corners.map(Into::into)),
                Some([t, b1, b2]),
            ));
        }
    }
    let inputs: Vec<_> = rows.iter().map(|(input, _)| *input).collect();
    let mut verdict = Verdict::on("random triangles");
    for (method, call) in METHODS {
        for ((input, expected), got) in rows.iter().zip(intersect(call, &inputs)) {
            // Thirty roundings of numbers around 4, through a system with a condition number below 200.
            verdict.near(
                format!("{method}: {input:?}"),
                &got,
                expected,
                Tolerance::Absolute(gpu().bound(2e-5, 4e-5)),
            );
        }
    }
    verdict.close();
}

#[test]
fn triangles_without_area_are_never_hit() {
    let mut random = Random::new(9);
    let mut inputs = Vec::new();
    for i in 0..20_000 {
        let a = random.in_cube().as_vec3();
        let b = random.in_cube().as_vec3();
        let triangle = match i % 4 {
            0 => [a, a, a],
            1 => [a, b, b],
            2 => [a, b, a],
            _ => [a, a, b],
        };
        let origin = 2.0 * random.in_cube();
        let target = a.lerp(b, random.between(0.0, 1.0) as f32).as_dvec3();
        let direction = (target - origin).normalize().as_vec3();
        inputs.push((
            ray(origin.as_vec3().into(), direction.into()),
            triangle.map(Into::into),
        ));
    }
    let mut verdict = Verdict::on("triangles without area");
    for (method, call) in METHODS {
        for ((ray, triangle), got) in inputs.iter().zip(intersect(call, &inputs)) {
            verdict.that(format!("{method}: {triangle:?}"), !got.hit, || {
                format!("{ray:?} gives {got:?}")
            });
        }
    }
    verdict.close();
}

/// A closed surface around the origin like a crumpled ball: the vertices of a sphere of 16 by 16 faces, moved
/// radially at random, and all of it translated by `shift`.
fn crumpled_ball(shift: DVec3) -> Vec<Triangle> {
    const N: usize = 16;
    let mut random = Random::new(10);
    let mut corner = |ring: usize, step: usize| {
        let theta = PI * ring as f64 / N as f64;
        let phi = TAU * step as f64 / N as f64;
        let direction = DVec3::new(
            theta.sin() * phi.cos(),
            theta.cos(),
            theta.sin() * phi.sin(),
        );
        (shift + direction * random.between(1.0, 1.5))
            .as_vec3()
            .to_array()
    };
    // The poles are single vertices, and the last vertex of a ring is its first.
    let rings: Vec<Vec<[f32; 3]>> = (0..=N)
        .map(|ring| {
            let count = if ring == 0 || ring == N { 1 } else { N };
            (0..count).map(|step| corner(ring, step)).collect()
        })
        .collect();
    let at = |ring: usize, step: usize| rings[ring][step % rings[ring].len()];
    let quads = (0..N).flat_map(|ring| (0..N).map(move |step| (ring, step)));
    quads
        .flat_map(|(ring, step)| {
            let [a, b] = [at(ring, step), at(ring, step + 1)];
            let [c, d] = [at(ring + 1, step), at(ring + 1, step + 1)];
            [[a, c, d], [a, d, b]]
        })
        .filter(|[a, b, c]| a != b && b != c && c != a)
        .collect()
}

/// Rays from inside the ball: half of them at vertices, a quarter at the midpoints of edges and a quarter at
/// random points of an edge.
fn rays_at_corners_and_edges(mesh: &[Triangle], shift: DVec3, count: usize) -> Vec<Ray> {
    let mut random = Random::new(11);
    (0..count)
        .map(|i| {
            let origin = (shift + 0.5 * random.in_cube().clamp_length_max(1.0)).as_vec3();
            let triangle = mesh[random.below(mesh.len())];
            let side = random.below(3);
            let a = Vec3::from(triangle[side]).as_dvec3();
            let b = Vec3::from(triangle[(side + 1) % 3]).as_dvec3();
            let target = match i % 4 {
                0 | 1 => a,
                2 => 0.5 * (a + b),
                _ => a.lerp(b, random.between(0.0, 1.0)),
            };
            ray(
                origin.into(),
                (target - origin.as_dvec3()).normalize().as_vec3().into(),
            )
        })
        .collect()
}

#[test]
fn no_ray_leaks_from_a_closed_mesh_through_edges_or_corners() {
    let mesh = crumpled_ball(DVec3::ZERO);
    let rays = rays_at_corners_and_edges(&mesh, DVec3::ZERO, 100_000);
    let leaks = METHODS.map(|(method, call)| {
        let leaks = count_hits(call, &mesh, &rays)
            .iter()
            .filter(|hits| **hits == 0)
            .count();
        // The other two tests do leak, which is why they are not the default.
        println!("{method}: {leaks} of {} rays leak", rays.len());
        leaks
    });
    assert_eq!(leaks[2], 0, "the watertight test leaks");
}

#[test]
fn no_ray_leaks_from_a_closed_mesh_far_from_the_origin() {
    // The position is from Embree, where f32 has steps of 1/64.
    let shift = DVec3::new(148_376.0, 1_234.0, -223_423.0);
    let mesh = crumpled_ball(shift);
    let rays = rays_at_corners_and_edges(&mesh, shift, 20_000);
    let hits = count_hits(WATERTIGHT, &mesh, &rays);
    let leaks = hits.iter().filter(|hits| **hits == 0).count();
    assert_eq!(leaks, 0, "{leaks} of {} rays leak", rays.len());
}

#[test]
fn a_quad_is_hit_all_along_its_diagonal() {
    let [a, b, c, d] = [
        [-1.3, -0.7, -2.1],
        [1.9, -0.8, -1.7],
        [1.6, 1.2, -2.9],
        [-1.1, 1.4, -2.3],
    ];
    let quad = [[a, b, c], [a, c, d]];
    let mut random = Random::new(12);
    let (from, to) = (Vec3::from(a).as_dvec3(), Vec3::from(c).as_dvec3());
    let rays: Vec<_> = (0..100_000)
        .map(|_| {
            let origin = random.in_cube().as_vec3();
            let target = from.lerp(to, random.between(0.0, 1.0));
            ray(
                origin.into(),
                (target - origin.as_dvec3()).normalize().as_vec3().into(),
            )
        })
        .collect();
    let misses = count_hits(WATERTIGHT, &quad, &rays)
        .iter()
        .filter(|hits| **hits == 0)
        .count();
    assert_eq!(misses, 0, "{misses} rays pass between the halves");
}
