//! Level 2: the canonical shapes of `lib/intersect/`, against the f64 ones of `reference/shapes.rs`.

use crate::reference::shapes::{canonical_crossings, canonical_normal, tube};
use crate::support::{
    harness::gpu,
    random::Random,
    types::{Candidate, CanonicalPoint, Ray, ray},
    verdict::{Tolerance, Verdict},
};
use glam::{DAffine3, DMat3, DQuat, DVec2, DVec3};
use glimray::layout::{
    PackedShape, SHAPE_BOX, SHAPE_CONE, SHAPE_DISC, SHAPE_ELLIPSOID, SHAPE_RECTANGLE, SHAPE_TORUS,
};
use glimray::pack;
use glimray::scene::{CanonicalShape, Geometry, Scene, Shape};
use glimray_shader_test::Plain;
use std::f64::consts::{PI, TAU};

/// Half an f32 step at 1.
const ROUNDING: f64 = 1.0 / (1 << 24) as f64;

const fn cone(bottom: f64, top: f64, capped: bool) -> CanonicalShape {
    CanonicalShape::Cone {
        bottom,
        top,
        capped,
    }
}

/// Sizes are exact in f32.
const CANONICAL_SHAPES: [CanonicalShape; 15] = [
    CanonicalShape::Disc { hole: 0.0 },
    CanonicalShape::Disc { hole: 0.5 },
    CanonicalShape::Rectangle,
    CanonicalShape::Box,
    CanonicalShape::Ellipsoid,
    cone(1.0, 1.0, true),
    cone(1.0, 1.0, false),
    cone(1.0, 0.0, true),
    cone(1.0, 0.0, false),
    cone(0.0, 1.0, true),
    cone(0.25, 1.0, false),
    cone(1.0, 0.5, true),
    CanonicalShape::Torus { minor: 0.25 },
    CanonicalShape::Torus { minor: 1.0 },
    CanonicalShape::Torus { minor: 0.03125 },
];

/// Wraps the shader functions of all shapes as `test` and `point`.
const CANONICAL: &str = "
    import package::types::{
        NONE, NO_INSTANCE, PackedShape, SHAPE_BOX, SHAPE_CAPPED, SHAPE_CONE, SHAPE_DISC, SHAPE_RECTANGLE, SHAPE_TORUS,
    };
    import package::types::tracing::{Candidate, Ray};
    import package::lib::canonical::{CanonicalPoint, PlacedPoint, canonical_ray, canonical_vector, placed_point};
    import package::lib::offset::offset_origin;
    import package::lib::intersect::box::{box_point, intersect_box};
    import package::lib::intersect::cone::{cone_point, intersect_cone};
    import package::lib::intersect::disc::{disc_point, intersect_disc};
    import package::lib::intersect::ellipsoid::{ellipsoid_point, intersect_ellipsoid};
    import package::lib::intersect::rectangle::{intersect_rectangle, rectangle_point};
    import package::lib::intersect::torus::{intersect_torus, torus_point};
    fn test(ray: Ray, kind: u32, sizes: vec3f) -> Candidate {
        if (kind == SHAPE_DISC) { return intersect_disc(ray, sizes.x); }
        if (kind == SHAPE_RECTANGLE) { return intersect_rectangle(ray); }
        if (kind == SHAPE_BOX) { return intersect_box(ray); }
        if (kind == SHAPE_CONE) { return intersect_cone(ray, sizes.x, sizes.y, sizes.z != 0.0); }
        if (kind == SHAPE_TORUS) { return intersect_torus(ray, sizes.x); }
        return intersect_ellipsoid(ray);
    }
    fn point(p: vec3f, kind: u32, sizes: vec3f, part: f32) -> CanonicalPoint {
        if (kind == SHAPE_DISC) { return disc_point(p); }
        if (kind == SHAPE_RECTANGLE) { return rectangle_point(p); }
        if (kind == SHAPE_BOX) { return box_point(p, part); }
        if (kind == SHAPE_CONE) { return cone_point(p, sizes.x, sizes.y, part); }
        if (kind == SHAPE_TORUS) { return torus_point(p, sizes.x); }
        return ellipsoid_point(p);
    }
    fn sizes_of(shape: PackedShape) -> vec3f {
        return vec3f(shape.size0, shape.size1, select(0.0, 1.0, (shape.flags & SHAPE_CAPPED) != 0u));
    }
    fn placed(ray: Ray, shape: PackedShape, hit: Candidate) -> PlacedPoint {
        let reached = ray.origin + hit.t * ray.direction;
        let p = canonical_vector(shape, reached - shape.position);
        return placed_point(shape, reached, point(p, shape.kind, sizes_of(shape), hit.b1));
    }
";

fn kind_and_sizes(canonical: CanonicalShape) -> (u32, [f32; 3]) {
    match canonical {
        CanonicalShape::Disc { hole } => (SHAPE_DISC, [hole as f32, 0.0, 0.0]),
        CanonicalShape::Rectangle => (SHAPE_RECTANGLE, [0.0; 3]),
        CanonicalShape::Box => (SHAPE_BOX, [0.0; 3]),
        CanonicalShape::Ellipsoid => (SHAPE_ELLIPSOID, [0.0; 3]),
        CanonicalShape::Cone {
            bottom,
            top,
            capped,
        } => {
            let sizes = [bottom as f32, top as f32, f32::from(u8::from(capped))];
            (SHAPE_CONE, sizes)
        }
        CanonicalShape::Torus { minor } => (SHAPE_TORUS, [minor as f32, 0.0, 0.0]),
    }
}

fn hits(canonical: CanonicalShape, rays: &[Ray]) -> Vec<Candidate> {
    let (kind, sizes) = kind_and_sizes(canonical);
    let inputs: Vec<_> = rays.iter().map(|&ray| (ray, kind, sizes)).collect();
    let source = format!(
        "{CANONICAL} fn probe(ray: Ray, kind: u32, sizes: vec3f) -> Candidate {{ return test(ray, kind, sizes); }}"
    );
    gpu().map_source(&source, &inputs)
}

/// A point of the surface.
fn on_surface(canonical: CanonicalShape, random: &mut Random) -> DVec3 {
    let angle = random.between(0.0, TAU);
    let turned = |r: f64, y: f64| DVec3::new(r * angle.sin(), y, r * angle.cos());
    match canonical {
        CanonicalShape::Disc { hole } => turned(random.between(hole, 1.0), 0.0),
        CanonicalShape::Rectangle => random.in_cube() * DVec3::new(1.0, 0.0, 1.0),
        CanonicalShape::Box => {
            let mut p = random.in_cube();
            let axis = random.below(3);
            p[axis] = p[axis].signum();
            p
        }
        CanonicalShape::Ellipsoid => random.direction(),
        CanonicalShape::Cone {
            bottom,
            top,
            capped,
        } => match random.below(if capped { 4 } else { 2 }) {
            // A cone with an apex has no end there.
            2 if bottom > 0.0 => turned(bottom * random.between(0.0, 1.0), 0.0),
            3 if top > 0.0 => turned(top * random.between(0.0, 1.0), 1.0),
            _ => {
                let y = random.between(0.0, 1.0);
                turned(bottom + (top - bottom) * y, y)
            }
        },
        CanonicalShape::Torus { minor } => {
            let (sin, cos) = random.between(0.0, TAU).sin_cos();
            turned(1.0 + minor * cos, minor * sin)
        }
    }
}

/// The distance of a point from the surface.
fn off_surface(canonical: CanonicalShape, p: DVec3) -> f64 {
    let off_axis = p.x.hypot(p.z);
    let beyond = |x: f64, most: f64| (x - most).max(0.0);
    match canonical {
        CanonicalShape::Disc { hole } => {
            p.y.abs()
                .max(beyond(off_axis, 1.0))
                .max(beyond(hole, off_axis))
        }
        CanonicalShape::Rectangle => p.y.abs().max(beyond(p.abs().max_element(), 1.0)),
        CanonicalShape::Box => (p.abs().max_element() - 1.0).abs(),
        CanonicalShape::Ellipsoid => (p.length() - 1.0).abs(),
        CanonicalShape::Torus { minor } => tube(minor, p).abs(),
        CanonicalShape::Cone {
            bottom,
            top,
            capped,
        } => {
            let radius = bottom + (top - bottom) * p.y.clamp(0.0, 1.0);
            let in_slab = beyond(p.y, 1.0).max(beyond(0.0, p.y));
            let side =
                ((off_axis - radius).abs() / (1.0 + (top - bottom).powi(2)).sqrt()).max(in_slab);
            let end = |y: f64, r: f64| (p.y - y).abs().max(beyond(off_axis, r));
            if capped {
                side.min(end(0.0, bottom)).min(end(1.0, top))
            } else {
                side
            }
        }
    }
}

fn single(v: DVec3) -> [f32; 3] {
    v.as_vec3().to_array()
}

fn double(v: [f32; 3]) -> DVec3 {
    DVec3::from(v.map(f64::from))
}

/// Rays of all kinds at a shape: from far and near, from inside, along axes, through edges, grazing. Directions
/// have any length.
fn rays_at(canonical: CanonicalShape, count: usize, random: &mut Random) -> Vec<Ray> {
    let middle = if matches!(canonical, CanonicalShape::Cone { .. }) {
        DVec3::new(0.0, 0.5, 0.0)
    } else {
        DVec3::ZERO
    };
    let reach = if let CanonicalShape::Torus { minor } = canonical {
        1.0 + minor
    } else {
        1.0
    };
    let within = |random: &mut Random| middle + reach * random.in_cube();
    let mut rays = Vec::new();
    while rays.len() < count {
        let target = match random.below(3) {
            0 => within(random),
            _ => on_surface(canonical, random),
        };
        let from = middle + random.direction() * 10f64.powf(random.between(0.3, 3.0));
        let mut axis = DVec3::ZERO;
        axis[random.below(3)] = [-1.0, 1.0][random.below(2)];
        let (origin, direction) = match random.below(5) {
            0 => (from, target - from),
            1 => (within(random), random.direction()),
            2 => (target + 3.0 * axis, -axis),
            3 => {
                // Slightly, or more, beside a tangent.
                let n = canonical_normal(canonical, target).normalize_or(DVec3::Y);
                let aside = n.cross(random.direction()).normalize();
                let lift =
                    n * 10f64.powf(random.between(-6.0, -1.0)) * [-1.0, 1.0][random.below(2)];
                let back = 10f64.powf(random.between(-1.0, 2.0));
                (target + lift - back * aside, aside)
            }
            _ => {
                let beside = target + 0.3 * random.direction();
                (beside, target - beside)
            }
        };
        let scale = 10f64.powf(random.between(-3.0, 3.0));
        let direction = direction.normalize_or(DVec3::X) * scale;
        rays.push(ray(single(origin), single(direction)));
    }
    rays
}

/// Distances, in canonical space, of the first hit of the ray and of rays that differ from it by `tolerance`;
/// `None` for a miss.
fn answers(canonical: CanonicalShape, ray: &Ray, tolerance: f64, around: bool) -> Vec<Option<f64>> {
    let (o, d) = (double(ray.origin), double(ray.direction));
    let length = d.length();
    let d = d / length;
    let u = d.any_orthonormal_vector();
    let v = d.cross(u);
    let mut offsets = vec![DVec3::ZERO];
    if around {
        for i in 0..8 {
            let (sin, cos) = (f64::from(i) * PI / 4.0).sin_cos();
            offsets.push(u * cos + v * sin);
        }
        offsets.extend([d, -d]);
    }
    let first = |offset: DVec3| {
        let crossings = canonical_crossings(canonical, o + tolerance * offset, d);
        crossings.into_iter().find(|&t| t > 0.0)
    };
    offsets.into_iter().map(first).collect()
}

fn check_hits(canonical: CanonicalShape) {
    let rays = rays_at(canonical, 6000, &mut Random::new(11));
    let mut verdict = Verdict::on(format!("{canonical:?}"));
    let mut hit_count = 0;
    for (i, (ray, got)) in rays.iter().zip(hits(canonical, &rays)).enumerate() {
        let (o, d) = (double(ray.origin), double(ray.direction));
        let tolerance = 12.0 * ROUNDING * (2.0 + o.length());
        let s = f64::from(got.t) * d.length();
        let fits = |answers: &[Option<f64>]| {
            let found = answers.iter().flatten().copied();
            let (least, most) = found.fold((f64::INFINITY, 0f64), |(a, b), s| (a.min(s), b.max(s)));
            // If some miss, the others reach almost to the tangent point, half a chord away.
            let tangent = answers.iter().any(Option::is_none);
            let half_chord = if tangent { 2.0 * tolerance.sqrt() } else { 0.0 };
            if got.hit {
                (least - tolerance..=most + tolerance + half_chord).contains(&s)
            } else {
                tangent
            }
        };
        let plain = answers(canonical, ray, tolerance, false);
        let fine = fits(&plain) || fits(&answers(canonical, ray, tolerance, true));
        hit_count += usize::from(got.hit);
        verdict.that(format!("ray {i}"), fine, || {
            format!("{ray:?}\n    {got:?} at {s}, expected {plain:?} within {tolerance}")
        });
        if got.hit {
            let p = o + f64::from(got.t) * d;
            let off = off_surface(canonical, p);
            // f32 cannot distinguish a line along the side of a cone from one next to its apex.
            let tip = match canonical {
                CanonicalShape::Cone { bottom, top, .. } if bottom.min(top) == 0.0 => {
                    p.x.hypot(p.z) < 0.01
                }
                _ => false,
            };
            let most = if tip { 1e-3 } else { 2.0 * tolerance };
            verdict.that(format!("ray {i} ends on it"), off <= most, || {
                format!("{ray:?}\n    {got:?} is off by {off:e}, {tolerance:e} allowed")
            });
        }
    }
    verdict.close();
    assert!(hit_count > rays.len() / 3, "{hit_count} hits");
}

#[test]
fn discs_and_rectangles_are_hit_where_f64_says() {
    CANONICAL_SHAPES[..3]
        .iter()
        .for_each(|&canonical| check_hits(canonical));
}

#[test]
fn boxes_and_ellipsoids_are_hit_where_f64_says() {
    CANONICAL_SHAPES[3..5]
        .iter()
        .for_each(|&canonical| check_hits(canonical));
}

#[test]
fn cylinders_cones_and_frusta_are_hit_where_f64_says() {
    CANONICAL_SHAPES[5..12]
        .iter()
        .for_each(|&canonical| check_hits(canonical));
}

#[test]
fn tori_are_hit_where_f64_says() {
    CANONICAL_SHAPES[12..]
        .iter()
        .for_each(|&canonical| check_hits(canonical));
}

#[test]
fn shapes_are_hit_at_distances_known_in_closed_form() {
    let half = 0.5f64.sqrt();
    let o = [0f32, 0.0, 0.0];
    let rows: [(&str, CanonicalShape, Ray, Option<f64>); 25] = [
        (
            "a disc from above",
            CANONICAL_SHAPES[0],
            ray([0.5, 3.0, 0.0], [0.0, -1.0, 0.0]),
            Some(3.0),
        ),
        (
            "a disc beside its edge",
            CANONICAL_SHAPES[0],
            ray([0.8, 3.0, 0.8], [0.0, -1.0, 0.0]),
            None,
        ),
        (
            "a disc edge-on",
            CANONICAL_SHAPES[0],
            ray([-3.0, 0.0, 0.0], [1.0, 0.0, 0.0]),
            None,
        ),
        (
            "a ring through its hole",
            CANONICAL_SHAPES[1],
            ray([0.3, 3.0, 0.3], [0.0, -1.0, 0.0]),
            None,
        ),
        (
            "a ring from below",
            CANONICAL_SHAPES[1],
            ray([0.0, -2.0, 0.6], [0.0, 2.0, 0.0]),
            Some(1.0),
        ),
        (
            "a corner of a rectangle",
            CANONICAL_SHAPES[2],
            ray([1.0, 1.0, 1.0], [0.0, -1.0, 0.0]),
            Some(1.0),
        ),
        (
            "a box head on",
            CANONICAL_SHAPES[3],
            ray([0.0, 0.0, 4.0], [0.0, 0.0, -1.0]),
            Some(3.0),
        ),
        (
            "a box from its middle",
            CANONICAL_SHAPES[3],
            ray(o, [0.0, 0.5, 0.0]),
            Some(2.0),
        ),
        (
            "a box behind",
            CANONICAL_SHAPES[3],
            ray([0.0, 0.0, 4.0], [0.0, 0.0, 1.0]),
            None,
        ),
        (
            "a box from 10^18 away",
            CANONICAL_SHAPES[3],
            ray([0.0, 0.0, 1e18], [0.0, 0.0, -1.0]),
            Some(1e18),
        ),
        (
            "the unit sphere from a million away",
            CANONICAL_SHAPES[4],
            ray([0.0, 0.0, 1e6], [0.0, 0.0, -1.0]),
            Some(999_999.0),
        ),
        (
            "the unit sphere from its middle",
            CANONICAL_SHAPES[4],
            ray(o, [0.0, 0.0, -1.0]),
            Some(1.0),
        ),
        (
            "a cylinder through both ends",
            CANONICAL_SHAPES[5],
            ray([0.5, 3.0, 0.0], [0.0, -1.0, 0.0]),
            Some(2.0),
        ),
        (
            "an open one lets it through",
            CANONICAL_SHAPES[6],
            ray([0.5, 3.0, 0.0], [0.0, -1.0, 0.0]),
            None,
        ),
        (
            "an open one from within",
            CANONICAL_SHAPES[6],
            ray([0.0, 0.5, 0.0], [0.0, 0.0, 1.0]),
            Some(1.0),
        ),
        (
            "an open one from above, on its inside",
            CANONICAL_SHAPES[6],
            ray([0.0, 1.5, 0.0], [1.0, -1.0, 0.0]),
            Some(1.0),
        ),
        (
            "a cone at half its height",
            CANONICAL_SHAPES[7],
            ray([3.0, 0.5, 0.0], [-1.0, 0.0, 0.0]),
            Some(2.5),
        ),
        (
            "a cone on its tip",
            CANONICAL_SHAPES[7],
            ray([0.0, 3.0, 0.0], [0.0, -1.0, 0.0]),
            Some(2.0),
        ),
        (
            "a cone parallel to its side",
            CANONICAL_SHAPES[7],
            ray([1.5, -1.0, 0.0], [-1.0, 1.0, 0.0]),
            Some(1.0),
        ),
        (
            "an open one parallel to its side",
            CANONICAL_SHAPES[8],
            ray([1.5, -1.0, 0.0], [-1.0, 1.0, 0.0]),
            Some(1.75),
        ),
        (
            "the other half of the double cone is not there",
            CANONICAL_SHAPES[7],
            ray([3.0, 1.5, 0.0], [-1.0, 0.0, 0.0]),
            None,
        ),
        (
            "a torus from outside",
            CANONICAL_SHAPES[12],
            ray([3.0, 0.0, 0.0], [-1.0, 0.0, 0.0]),
            Some(1.75),
        ),
        (
            "a torus from the middle of its hole",
            CANONICAL_SHAPES[12],
            ray(o, [0.0, 0.0, 1.0]),
            Some(0.75),
        ),
        (
            "a torus along its axis",
            CANONICAL_SHAPES[12],
            ray([0.0, 3.0, 0.0], [0.0, -1.0, 0.0]),
            None,
        ),
        (
            "a torus from within its tube",
            CANONICAL_SHAPES[12],
            ray([1.0, 0.0, 0.0], [half as f32, half as f32, 0.0]),
            Some(0.25 / (half as f32 as f64 * 2f64.sqrt())),
        ),
    ];
    let mut verdict = Verdict::on("canonical shapes");
    for (name, canonical, ray, expected) in rows {
        let got = hits(canonical, &[ray]);
        verdict.near(name, &got[0], &expected, Tolerance::Ulps(4.0));
    }
    verdict.close();
}

#[test]
fn surfaces_have_the_normal_of_their_slope_and_u_and_v_from_0_to_1() {
    for canonical in CANONICAL_SHAPES {
        let (kind, sizes) = kind_and_sizes(canonical);
        let rays = rays_at(canonical, 3000, &mut Random::new(12));
        let found = hits(canonical, &rays);
        let hit = rays.iter().zip(&found).filter(|(_, got)| got.hit);
        let at = |(ray, got): (&Ray, &Candidate)| {
            let p = double(ray.origin) + f64::from(got.t) * double(ray.direction);
            (single(p), kind, sizes, got.b1)
        };
        let inputs: Vec<_> = hit.map(at).collect();
        let source = format!(
            "{CANONICAL} fn probe(p: vec3f, kind: u32, sizes: vec3f, part: f32) -> CanonicalPoint {{ return point(p, kind, sizes, part); }}"
        );
        let points: Vec<CanonicalPoint> = gpu().map_source(&source, &inputs);
        let mut verdict = Verdict::on(format!("{canonical:?}"));
        for ((reached, _, _, part), got) in inputs.iter().zip(&points) {
            let (p, n, reached) = (double(got.p), double(got.n), double(*reached));
            let show = || format!("{got:?}, reached {reached}, part {part}");
            let in_unit = got.uv.iter().all(|x| (0.0..=1.0).contains(x));
            verdict.that("u and v are in 0..=1", in_unit, show);
            // Discs and rectangles do not clamp points slightly beyond their edges.
            let most = if matches!(
                canonical,
                CanonicalShape::Disc { .. } | CanonicalShape::Rectangle | CanonicalShape::Box
            ) {
                1e-3
            } else {
                4.0 * ROUNDING
            };
            verdict.that(
                "it lies on the surface",
                off_surface(canonical, p) <= most,
                show,
            );
            verdict.that("it is near", p.distance(reached) < 2e-3, show);
            let n_ref = canonical_normal(canonical, p).normalize();
            // Next to a rim or an apex the reference may be on the other part.
            let rim = match canonical {
                CanonicalShape::Cone { bottom, top, .. } => {
                    let off_axis = p.x.hypot(p.z);
                    p.y.min(1.0 - p.y).abs() < 2e-5
                        && [(0.0, bottom), (1.0, top)]
                            .iter()
                            .any(|&(y, r)| (p.y - y).abs() < 0.5 && (off_axis - r).abs() < 2e-5)
                        || off_axis < 1e-4
                }
                CanonicalShape::Box => {
                    let size = p.abs();
                    size.to_array().iter().filter(|&&x| x > 1.0 - 2e-3).count() > 1
                }
                CanonicalShape::Torus { minor } => minor == 1.0 && p.length() < 1e-2,
                _ => false,
            };
            verdict.that(
                "the normal follows the slope",
                rim || n.distance(n_ref) < 2e-5,
                || format!("{}, expected {n_ref}", show()),
            );
        }
        verdict.close();
    }
}

/// u and v of points on the part of a shape with this number.
fn uvs(canonical: CanonicalShape, points: &[(DVec3, f32)]) -> Vec<[f32; 2]> {
    let (kind, sizes) = kind_and_sizes(canonical);
    let inputs: Vec<_> = (points.iter())
        .map(|&(p, part)| (single(p), kind, sizes, part))
        .collect();
    let source = format!(
        "{CANONICAL} fn probe(p: vec3f, kind: u32, sizes: vec3f, part: f32) -> vec2f {{ return point(p, kind, sizes, part).uv; }}"
    );
    gpu().map_source(&source, &inputs)
}

#[test]
fn u_and_v_are_where_the_docs_say() {
    let at = DVec3::new;
    let half = 0.5f64.sqrt();
    #[rustfmt::skip]
    let rows: [(&str, CanonicalShape, DVec3, f32, [f64; 2]); 26] = [
        ("a disc's right edge", CANONICAL_SHAPES[0], at(1.0, 0.0, 0.0), 0.0, [1.0, 0.5]),
        ("a disc's far edge", CANONICAL_SHAPES[0], at(0.0, 0.0, -1.0), 0.0, [0.5, 1.0]),
        ("a rectangle's near left corner", CANONICAL_SHAPES[2], at(-1.0, 0.0, 1.0), 0.0, [0.0, 0.0]),
        ("a rectangle's far right corner", CANONICAL_SHAPES[2], at(1.0, 0.0, -1.0), 0.0, [1.0, 1.0]),
        ("a box's front, upper right", CANONICAL_SHAPES[3], at(1.0, 1.0, 1.0), 5.0, [1.0, 1.0]),
        ("a box's back, seen from there: upper left", CANONICAL_SHAPES[3], at(1.0, 1.0, -1.0), 2.0, [0.0, 1.0]),
        ("a box's right side: upper left", CANONICAL_SHAPES[3], at(1.0, 1.0, 1.0), 3.0, [0.0, 1.0]),
        ("a box's left side: upper right", CANONICAL_SHAPES[3], at(-1.0, 1.0, 1.0), 0.0, [1.0, 1.0]),
        ("a box's top: near right", CANONICAL_SHAPES[3], at(1.0, 1.0, 1.0), 4.0, [1.0, 0.0]),
        ("a box's bottom: near right", CANONICAL_SHAPES[3], at(1.0, -1.0, 1.0), 1.0, [1.0, 1.0]),
        ("the sphere's front", CANONICAL_SHAPES[4], at(0.0, 0.0, 1.0), 0.0, [0.5, 0.5]),
        ("the sphere's right", CANONICAL_SHAPES[4], at(1.0, 0.0, 0.0), 0.0, [0.75, 0.5]),
        ("the sphere's left", CANONICAL_SHAPES[4], at(-1.0, 0.0, 0.0), 0.0, [0.25, 0.5]),
        ("the sphere's north pole", CANONICAL_SHAPES[4], at(0.0, 1.0, 0.0), 0.0, [0.5, 1.0]),
        ("the sphere's south pole", CANONICAL_SHAPES[4], at(0.0, -1.0, 0.0), 0.0, [0.5, 0.0]),
        ("the sphere at 45° north", CANONICAL_SHAPES[4], at(half, half, 0.0), 0.0, [0.75, 0.75]),
        ("just east of the seam", CANONICAL_SHAPES[4], at(-1e-4, 0.0, -1.0), 0.0, [1e-4 / TAU, 0.5]),
        ("a cylinder's front, half way up", CANONICAL_SHAPES[5], at(0.0, 0.5, 1.0), 0.0, [0.5, 0.5]),
        ("a cylinder's right, at the top", CANONICAL_SHAPES[5], at(1.0, 1.0, 0.0), 0.0, [0.75, 1.0]),
        ("its top end: far edge", CANONICAL_SHAPES[5], at(0.0, 1.0, -1.0), 2.0, [0.5, 1.0]),
        ("its bottom end: far edge", CANONICAL_SHAPES[5], at(0.0, 0.0, -1.0), 1.0, [0.5, 0.0]),
        ("a frustum's smaller end: right edge", CANONICAL_SHAPES[11], at(0.5, 1.0, 0.0), 2.0, [1.0, 0.5]),
        ("a torus' outer equator in front", CANONICAL_SHAPES[12], at(0.0, 0.0, 1.25), 0.0, [0.5, 0.5]),
        ("a torus' top on the right", CANONICAL_SHAPES[12], at(1.0, 0.25, 0.0), 0.0, [0.75, 0.75]),
        ("a torus' underside", CANONICAL_SHAPES[12], at(1.0, -0.25, 0.0), 0.0, [0.75, 0.25]),
        ("just above its inner equator", CANONICAL_SHAPES[12], at(0.75, 1e-5, 0.0), 0.0, [0.75, 1.0]),
    ];
    let mut verdict = Verdict::on("u and v");
    for (name, canonical, p, part, expected) in rows {
        let got = uvs(canonical, &[(p, part)]);
        verdict.near(name, &got[0], &expected, Tolerance::Absolute(1e-5));
    }
    verdict.close();
}

#[test]
fn u_and_v_have_no_jumps_but_at_seams() {
    for canonical in CANONICAL_SHAPES {
        let mut random = Random::new(13);
        let mut points = Vec::new();
        let mut gaps = Vec::new();
        for _ in 0..1000 {
            let p = on_surface(canonical, &mut random);
            let q = p + 1e-3 * random.direction();
            let n = canonical_normal(canonical, p);
            let part = match canonical {
                CanonicalShape::Box => {
                    let axis = n.abs().max_position() as f32;
                    axis + if n.max_element() > 0.5 { 3.0 } else { 0.0 }
                }
                CanonicalShape::Cone { capped: true, .. } if n.y < -0.999 => 1.0,
                CanonicalShape::Cone { capped: true, .. } if n.y > 0.999 => 2.0,
                _ => 0.0,
            };
            points.extend([(p, part), (q, part)]);
            gaps.push((p, p.x.hypot(p.z)));
        }
        let mut verdict = Verdict::on(format!("{canonical:?}"));
        for (pair, (p, off_axis)) in uvs(canonical, &points).chunks(2).zip(gaps) {
            let [a, b] = [pair[0], pair[1]].map(|uv| DVec2::from(uv.map(f64::from)));
            // A full turn ends where it started.
            let way = (a - b).abs();
            let way = way.min(DVec2::ONE - way);
            let tube = match canonical {
                CanonicalShape::Torus { minor } => minor,
                _ => 1.0,
            };
            let most = 1e-3 * (0.6 + 0.2 / off_axis.max(1e-6) + 0.2 / tube);
            let holds = off_axis < 2e-2 || way.max_element() <= most;
            verdict.that(format!("at {p}"), holds, || format!("{a} and {b}"));
        }
        verdict.close();
    }
}

/// A shape as the renderer packs it, with the render origin at the origin.
fn packed(canonical: CanonicalShape, world_from_canonical: DAffine3) -> Plain<PackedShape> {
    let geometry = Geometry::Placed {
        canonical,
        world_from_canonical,
    };
    let scene = Scene {
        cameras: vec![Default::default()],
        materials: vec![Default::default()],
        shapes: vec![Shape {
            geometry,
            material: 0,
            node: None,
            name: String::new(),
        }],
        ..Scene::default()
    };
    Plain(pack::scene(&scene).expect("a scene").shapes[0])
}

/// A canonical shape at a random position, of any size, rotated, scaled non-uniformly and possibly mirrored.
fn placement(random: &mut Random) -> DAffine3 {
    let size = 10f64.powf(random.between(-6.0, 6.0));
    let mut scale = DVec3::splat(size);
    for i in 0..3 {
        scale[i] *= 10f64.powf(random.between(-1.0, 0.0)) * [-1.0, 1.0][random.below(2)];
    }
    let turn = DQuat::from_axis_angle(random.direction(), random.between(0.0, TAU));
    let place = random.in_cube() * size * 10f64.powf(random.between(-1.0, 2.0));
    DAffine3::from_scale_rotation_translation(scale, turn, place)
}

/// Whether an outward ray from here can only escape: true for convex shapes and for the outer half of a torus.
fn is_convex_at(canonical: CanonicalShape, p: DVec3) -> bool {
    match canonical {
        CanonicalShape::Torus { .. } => p.x.hypot(p.z) > 1.0,
        CanonicalShape::Cone { capped, .. } => capped,
        CanonicalShape::Disc { .. } | CanonicalShape::Rectangle => false,
        _ => true,
    }
}

#[test]
fn a_ray_that_leaves_a_shape_does_not_hit_it_again_at_any_scale() {
    // (hit at all, hit again)
    const LEAVE: &str = "
        fn probe(shape: PackedShape, ray: Ray, aside: vec3f, cosine: f32) -> vec2u {
            let hit = test(canonical_ray(ray, shape), shape.kind, sizes_of(shape));
            let at = placed(ray, shape, hit);
            let tangent = normalize(aside - dot(aside, at.ng) * at.ng);
            let direction = normalize(tangent * sqrt(1.0 - cosine * cosine) + cosine * at.ng);
            let origin = offset_origin(at.p, at.error, at.ng, direction);
            let again = test(canonical_ray(Ray(origin, 3e38, direction, NONE, NO_INSTANCE), shape), shape.kind, sizes_of(shape));
            // Rounding may move a grazing ray to the other side.
            return vec2u(u32(hit.hit & (dot(at.ng, direction) > 0.0)), u32(again.hit));
        }
    ";
    for canonical in CANONICAL_SHAPES {
        let mut random = Random::new(14);
        let mut inputs = Vec::new();
        while inputs.len() < 20_000 {
            let world_from_canonical = placement(&mut random);
            let shape = packed(canonical, world_from_canonical);
            for i in 0..40 {
                let local = on_surface(canonical, &mut random);
                if !is_convex_at(canonical, local) {
                    continue;
                }
                let p = world_from_canonical.transform_point3(local);
                let turn = world_from_canonical.matrix3.inverse().transpose();
                let n = (turn * canonical_normal(canonical, local)).normalize();
                let away = (n + 0.8 * random.direction()).normalize();
                let distance = world_from_canonical.matrix3.x_axis.length()
                    * 10f64.powf(random.between(-1.0, 2.0));
                let ray = ray(single(p + distance * away), single(-away));
                let cosine = if i % 10 == 0 {
                    1e-6
                } else {
                    10f64.powf(random.between(-6.0, 0.0))
                };
                inputs.push((shape, ray, single(random.direction()), cosine as f32));
            }
            if matches!(
                canonical,
                CanonicalShape::Cone { capped: false, .. }
                    | CanonicalShape::Disc { .. }
                    | CanonicalShape::Rectangle
            ) {
                break;
            }
        }
        if inputs.is_empty() {
            continue;
        }
        let results: Vec<[u32; 2]> = gpu().map_source(&format!("{CANONICAL}{LEAVE}"), &inputs);
        let mut verdict = Verdict::on(format!("{canonical:?}"));
        let count = results.iter().filter(|[hit, _]| *hit == 1).count();
        verdict.that("most rays hit", count > inputs.len() * 8 / 10, || count);
        for ((shape, ray, _, cosine), [hit, again]) in inputs.iter().zip(&results) {
            verdict.that("not again", *hit == 0 || *again == 0, || {
                format!("{shape:?} {ray:?} cosine {cosine}")
            });
        }
        verdict.close();
    }
}

#[test]
fn a_ray_into_a_closed_shape_comes_out_of_it() {
    const ENTER: &str = "
        fn probe(shape: PackedShape, ray: Ray, aside: vec3f, cosine: f32) -> vec2u {
            let hit = test(canonical_ray(ray, shape), shape.kind, sizes_of(shape));
            let at = placed(ray, shape, hit);
            let tangent = normalize(aside - dot(aside, at.ng) * at.ng);
            let direction = normalize(tangent * sqrt(1.0 - cosine * cosine) - cosine * at.ng);
            let origin = offset_origin(at.p, at.error, at.ng, direction);
            let out = test(canonical_ray(Ray(origin, 3e38, direction, NONE, NO_INSTANCE), shape), shape.kind, sizes_of(shape));
            return vec2u(u32(hit.hit), u32(out.hit));
        }
    ";
    for canonical in CANONICAL_SHAPES {
        if !matches!(
            canonical,
            CanonicalShape::Box
                | CanonicalShape::Ellipsoid
                | CanonicalShape::Torus { .. }
                | CanonicalShape::Cone { capped: true, .. }
        ) {
            continue;
        }
        let mut random = Random::new(15);
        let mut inputs = Vec::new();
        while inputs.len() < 10_000 {
            let world_from_canonical = placement(&mut random);
            let shape = packed(canonical, world_from_canonical);
            for _ in 0..40 {
                let p = world_from_canonical.transform_point3(on_surface(canonical, &mut random));
                let away = random.direction();
                let distance = world_from_canonical.matrix3.x_axis.length() * 10.0;
                let ray = ray(single(p + distance * away), single(-away));
                let cosine = 10f64.powf(random.between(-3.0, 0.0)) as f32;
                inputs.push((shape, ray, single(random.direction()), cosine));
            }
        }
        let results: Vec<[u32; 2]> = gpu().map_source(&format!("{CANONICAL}{ENTER}"), &inputs);
        // A point within its error of an edge may lie beyond the other face.
        let lost = results
            .iter()
            .filter(|[hit, out]| *hit == 1 && *out == 0)
            .count();
        assert!(
            lost <= inputs.len() / 1000,
            "{canonical:?}: {lost} of {}",
            inputs.len()
        );
    }
}

#[test]
fn the_point_of_a_hit_is_within_its_error_of_the_surface() {
    // p, ng, error, each a row.
    const WHERE: &str = "
        fn probe(shape: PackedShape, ray: Ray, row: u32) -> vec3f {
            let hit = test(canonical_ray(ray, shape), shape.kind, sizes_of(shape));
            let at = placed(ray, shape, hit);
            return select(select(select(at.error, at.ng, row == 1u), at.p, row == 0u), vec3f(f32(hit.hit)), row == 3u);
        }
    ";
    for canonical in CANONICAL_SHAPES {
        let mut random = Random::new(16);
        let mut inputs = Vec::new();
        let mut placements = Vec::new();
        for _ in 0..100 {
            let world_from_canonical = placement(&mut random);
            let shape = packed(canonical, world_from_canonical);
            for _ in 0..20 {
                let p = world_from_canonical.transform_point3(on_surface(canonical, &mut random));
                let away = random.direction();
                let distance = world_from_canonical.matrix3.x_axis.length()
                    * 10f64.powf(random.between(-1.0, 3.0));
                let ray = ray(single(p + distance * away), single(-away));
                inputs.extend([0u32, 1, 2, 3].map(|row| (shape, ray, row)));
                placements.push(world_from_canonical);
            }
        }
        let results: Vec<[f32; 3]> = gpu().map_source(&format!("{CANONICAL}{WHERE}"), &inputs);
        let mut verdict = Verdict::on(format!("{canonical:?}"));
        for ((got, world_from_canonical), input) in
            results.chunks(4).zip(&placements).zip(inputs.chunks(4))
        {
            let [p, ng, error, hit] = [got[0], got[1], got[2], got[3]].map(double);
            if hit.x == 0.0 {
                continue;
            }
            // The canonical shape as the shader sees it: its position and rows are rounded.
            let shape = &input[0].0;
            let rows = DMat3::from_cols(
                double(shape.row_x),
                double(shape.row_y),
                double(shape.row_z),
            )
            .transpose();
            let local = rows * (p - double(shape.position));
            let local_ref = match canonical {
                CanonicalShape::Cone {
                    bottom,
                    top,
                    capped,
                } => {
                    let wide = bottom.max(top);
                    cone(bottom / wide, top / wide, capped)
                }
                canonical => canonical,
            };
            let off = off_surface(local_ref, local);
            // Along the normal, in render space.
            let slope =
                (rows.transpose() * canonical_normal(local_ref, local).normalize()).length();
            let allowed = ng.abs().dot(error);
            verdict.that(
                "on the surface",
                off / slope <= allowed || off > 0.5e-3,
                || {
                    format!(
                        "{p} is off by {} of {allowed}, placed by {world_from_canonical:?}",
                        off / slope
                    )
                },
            );
            verdict.that("of unit length", (ng.length() - 1.0).abs() < 1e-5, || ng);
        }
        verdict.close();
    }
}

#[test]
fn shapes_fill_their_bounds_and_keep_within_them() {
    let mut verdict = Verdict::on("Geometry::bounds");
    for canonical in CANONICAL_SHAPES {
        let mut random = Random::new(18);
        for _ in 0..20 {
            let world_from_canonical = placement(&mut random);
            let geometry = Geometry::Placed {
                canonical,
                world_from_canonical,
            };
            let (min, max) = geometry.bounds().expect("bounds");
            let size = (max - min).max_element();
            let (mut low, mut high) = (DVec3::INFINITY, DVec3::NEG_INFINITY);
            for _ in 0..4000 {
                let p = world_from_canonical.transform_point3(on_surface(canonical, &mut random));
                (low, high) = (low.min(p), high.max(p));
            }
            let slack = 1e-12 * (size + max.abs().max_element());
            let within =
                (low - min).min_element() >= -slack && (max - high).min_element() >= -slack;
            verdict.that(format!("{canonical:?} keeps within"), within, || {
                format!("{low} to {high} in {min} to {max}")
            });
            let filled = (low - min).max(max - high) / (max - min).max(DVec3::splat(1e-300));
            verdict.that(
                format!("{canonical:?} fills"),
                filled.max_element() < 0.1,
                || format!("{low} to {high} in {min} to {max}"),
            );
        }
    }
    verdict.close();
}
