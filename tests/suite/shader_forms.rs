//! Level 2: the canonical shapes of `lib/intersect/`, against the f64 ones of `reference/shapes.rs`.

use crate::reference::shapes::{form_crossings, form_normal, tube};
use crate::support::{
    harness::gpu,
    random::Random,
    types::{Candidate, FormPoint, Ray, ray},
    verdict::{Tolerance, Verdict},
};
use glam::{DAffine3, DMat3, DQuat, DVec2, DVec3};
use glimray::layout::{
    PackedShape, SHAPE_BOX, SHAPE_CONE, SHAPE_DISC, SHAPE_ELLIPSOID, SHAPE_RECTANGLE, SHAPE_TORUS,
};
use glimray::pack;
use glimray::scene::{Form, Geometry, Scene, Shape};
use std::f64::consts::{PI, TAU};

/// Half an f32 step at 1.
const ROUNDING: f64 = 1.0 / (1 << 24) as f64;

const fn cone(bottom: f64, top: f64, capped: bool) -> Form {
    Form::Cone {
        bottom,
        top,
        capped,
    }
}

/// Sizes are exact in f32.
const FORMS: [Form; 15] = [
    Form::Disc { hole: 0.0 },
    Form::Disc { hole: 0.5 },
    Form::Rectangle,
    Form::Box,
    Form::Ellipsoid,
    cone(1.0, 1.0, true),
    cone(1.0, 1.0, false),
    cone(1.0, 0.0, true),
    cone(1.0, 0.0, false),
    cone(0.0, 1.0, true),
    cone(0.25, 1.0, false),
    cone(1.0, 0.5, true),
    Form::Torus { minor: 0.25 },
    Form::Torus { minor: 1.0 },
    Form::Torus { minor: 0.03125 },
];

/// Wraps the shader functions of all shapes as `test` and `point`.
const FORM: &str = "
    import package::types::{Candidate, NONE, NO_INSTANCE, PackedShape, Ray, SHAPE_BOX, SHAPE_CAPPED, SHAPE_CONE, SHAPE_DISC, SHAPE_RECTANGLE, SHAPE_TORUS};
    import package::lib::form::{FormPoint, PlacedPoint, form_ray, form_vector, placed_point};
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
    fn point(p: vec3f, kind: u32, sizes: vec3f, part: f32) -> FormPoint {
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
        let p = form_vector(shape, reached - shape.position);
        return placed_point(shape, reached, point(p, shape.kind, sizes_of(shape), hit.b1));
    }
";

fn kind_and_sizes(form: Form) -> (u32, [f32; 3]) {
    match form {
        Form::Disc { hole } => (SHAPE_DISC, [hole as f32, 0.0, 0.0]),
        Form::Rectangle => (SHAPE_RECTANGLE, [0.0; 3]),
        Form::Box => (SHAPE_BOX, [0.0; 3]),
        Form::Ellipsoid => (SHAPE_ELLIPSOID, [0.0; 3]),
        Form::Cone {
            bottom,
            top,
            capped,
        } => {
            let sizes = [bottom as f32, top as f32, f32::from(u8::from(capped))];
            (SHAPE_CONE, sizes)
        }
        Form::Torus { minor } => (SHAPE_TORUS, [minor as f32, 0.0, 0.0]),
    }
}

fn hits(form: Form, rays: &[Ray]) -> Vec<Candidate> {
    let (kind, sizes) = kind_and_sizes(form);
    let inputs: Vec<_> = rays.iter().map(|&ray| (ray, kind, sizes)).collect();
    let source = format!(
        "{FORM} fn probe(ray: Ray, kind: u32, sizes: vec3f) -> Candidate {{ return test(ray, kind, sizes); }}"
    );
    gpu().map_source(&source, &inputs)
}

/// A point of the surface.
fn on_surface(form: Form, random: &mut Random) -> DVec3 {
    let angle = random.between(0.0, TAU);
    let turned = |r: f64, y: f64| DVec3::new(r * angle.sin(), y, r * angle.cos());
    match form {
        Form::Disc { hole } => turned(random.between(hole, 1.0), 0.0),
        Form::Rectangle => random.in_cube() * DVec3::new(1.0, 0.0, 1.0),
        Form::Box => {
            let mut p = random.in_cube();
            let axis = random.below(3);
            p[axis] = p[axis].signum();
            p
        }
        Form::Ellipsoid => random.direction(),
        Form::Cone {
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
        Form::Torus { minor } => {
            let (sin, cos) = random.between(0.0, TAU).sin_cos();
            turned(1.0 + minor * cos, minor * sin)
        }
    }
}

/// The distance of a point from the surface.
fn off_surface(form: Form, p: DVec3) -> f64 {
    let off_axis = p.x.hypot(p.z);
    let beyond = |x: f64, most: f64| (x - most).max(0.0);
    match form {
        Form::Disc { hole } => {
            p.y.abs()
                .max(beyond(off_axis, 1.0))
                .max(beyond(hole, off_axis))
        }
        Form::Rectangle => p.y.abs().max(beyond(p.abs().max_element(), 1.0)),
        Form::Box => (p.abs().max_element() - 1.0).abs(),
        Form::Ellipsoid => (p.length() - 1.0).abs(),
        Form::Torus { minor } => tube(minor, p).abs(),
        Form::Cone {
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
fn rays_at(form: Form, count: usize, random: &mut Random) -> Vec<Ray> {
    let middle = if matches!(form, Form::Cone { .. }) {
        DVec3::new(0.0, 0.5, 0.0)
    } else {
        DVec3::ZERO
    };
    let reach = if let Form::Torus { minor } = form {
        1.0 + minor
    } else {
        1.0
    };
    let within = |random: &mut Random| middle + reach * random.in_cube();
    let mut rays = Vec::new();
    while rays.len() < count {
        let target = match random.below(3) {
            0 => within(random),
            _ => on_surface(form, random),
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
                let n = form_normal(form, target).normalize_or(DVec3::Y);
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

/// Distances, in units of the shape, of the first hit of the ray and of rays that differ from it by
/// `tolerance`; `None` for a miss.
fn answers(form: Form, ray: &Ray, tolerance: f64, around: bool) -> Vec<Option<f64>> {
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
        let crossings = form_crossings(form, o + tolerance * offset, d);
        crossings.into_iter().find(|&t| t > 0.0)
    };
    offsets.into_iter().map(first).collect()
}

fn check_hits(form: Form) {
    let rays = rays_at(form, 6000, &mut Random::new(11));
    let mut verdict = Verdict::on(format!("{form:?}"));
    let mut hit_count = 0;
    for (i, (ray, got)) in rays.iter().zip(hits(form, &rays)).enumerate() {
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
        let plain = answers(form, ray, tolerance, false);
        let fine = fits(&plain) || fits(&answers(form, ray, tolerance, true));
        hit_count += usize::from(got.hit);
        verdict.that(format!("ray {i}"), fine, || {
            format!("{ray:?}\n    {got:?} at {s}, expected {plain:?} within {tolerance}")
        });
        if got.hit {
            let p = o + f64::from(got.t) * d;
            let off = off_surface(form, p);
            // f32 cannot distinguish a line along the side of a cone from one next to its apex.
            let tip = match form {
                Form::Cone { bottom, top, .. } if bottom.min(top) == 0.0 => p.x.hypot(p.z) < 0.01,
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
    FORMS[..3].iter().for_each(|&form| check_hits(form));
}

#[test]
fn boxes_and_ellipsoids_are_hit_where_f64_says() {
    FORMS[3..5].iter().for_each(|&form| check_hits(form));
}

#[test]
fn cylinders_cones_and_frusta_are_hit_where_f64_says() {
    FORMS[5..12].iter().for_each(|&form| check_hits(form));
}

#[test]
fn tori_are_hit_where_f64_says() {
    FORMS[12..].iter().for_each(|&form| check_hits(form));
}

#[test]
fn forms_are_hit_at_distances_known_in_closed_form() {
    let half = 0.5f64.sqrt();
    let o = [0f32, 0.0, 0.0];
    let rows: [(&str, Form, Ray, Option<f64>); 25] = [
        (
            "a disc from above",
            FORMS[0],
            ray([0.5, 3.0, 0.0], [0.0, -1.0, 0.0]),
            Some(3.0),
        ),
        (
            "a disc beside its edge",
            FORMS[0],
            ray([0.8, 3.0, 0.8], [0.0, -1.0, 0.0]),
            None,
        ),
        (
            "a disc edge-on",
            FORMS[0],
            ray([-3.0, 0.0, 0.0], [1.0, 0.0, 0.0]),
            None,
        ),
        (
            "a ring through its hole",
            FORMS[1],
            ray([0.3, 3.0, 0.3], [0.0, -1.0, 0.0]),
            None,
        ),
        (
            "a ring from below",
            FORMS[1],
            ray([0.0, -2.0, 0.6], [0.0, 2.0, 0.0]),
            Some(1.0),
        ),
        (
            "a corner of a rectangle",
            FORMS[2],
            ray([1.0, 1.0, 1.0], [0.0, -1.0, 0.0]),
            Some(1.0),
        ),
        (
            "a box head on",
            FORMS[3],
            ray([0.0, 0.0, 4.0], [0.0, 0.0, -1.0]),
            Some(3.0),
        ),
        (
            "a box from its middle",
            FORMS[3],
            ray(o, [0.0, 0.5, 0.0]),
            Some(2.0),
        ),
        (
            "a box behind",
            FORMS[3],
            ray([0.0, 0.0, 4.0], [0.0, 0.0, 1.0]),
            None,
        ),
        (
            "a box from 10^18 away",
            FORMS[3],
            ray([0.0, 0.0, 1e18], [0.0, 0.0, -1.0]),
            Some(1e18),
        ),
        (
            "the unit sphere from a million away",
            FORMS[4],
            ray([0.0, 0.0, 1e6], [0.0, 0.0, -1.0]),
            Some(999_999.0),
        ),
        (
            "the unit sphere from its middle",
            FORMS[4],
            ray(o, [0.0, 0.0, -1.0]),
            Some(1.0),
        ),
        (
            "a cylinder through both ends",
            FORMS[5],
            ray([0.5, 3.0, 0.0], [0.0, -1.0, 0.0]),
            Some(2.0),
        ),
        (
            "an open one lets it through",
            FORMS[6],
            ray([0.5, 3.0, 0.0], [0.0, -1.0, 0.0]),
            None,
        ),
        (
            "an open one from within",
            FORMS[6],
            ray([0.0, 0.5, 0.0], [0.0, 0.0, 1.0]),
            Some(1.0),
        ),
        (
            "an open one from above, on its inside",
            FORMS[6],
            ray([0.0, 1.5, 0.0], [1.0, -1.0, 0.0]),
            Some(1.0),
        ),
        (
            "a cone at half its height",
            FORMS[7],
            ray([3.0, 0.5, 0.0], [-1.0, 0.0, 0.0]),
            Some(2.5),
        ),
        (
            "a cone on its tip",
            FORMS[7],
            ray([0.0, 3.0, 0.0], [0.0, -1.0, 0.0]),
            Some(2.0),
        ),
        (
            "a cone parallel to its side",
            FORMS[7],
            ray([1.5, -1.0, 0.0], [-1.0, 1.0, 0.0]),
            Some(1.0),
        ),
        (
            "an open one parallel to its side",
            FORMS[8],
            ray([1.5, -1.0, 0.0], [-1.0, 1.0, 0.0]),
            Some(1.75),
        ),
        (
            "the other half of the double cone is not there",
            FORMS[7],
            ray([3.0, 1.5, 0.0], [-1.0, 0.0, 0.0]),
            None,
        ),
        (
            "a torus from outside",
            FORMS[12],
            ray([3.0, 0.0, 0.0], [-1.0, 0.0, 0.0]),
            Some(1.75),
        ),
        (
            "a torus from the middle of its hole",
            FORMS[12],
            ray(o, [0.0, 0.0, 1.0]),
            Some(0.75),
        ),
        (
            "a torus along its axis",
            FORMS[12],
            ray([0.0, 3.0, 0.0], [0.0, -1.0, 0.0]),
            None,
        ),
        (
            "a torus from within its tube",
            FORMS[12],
            ray([1.0, 0.0, 0.0], [half as f32, half as f32, 0.0]),
            Some(0.25 / (half as f32 as f64 * 2f64.sqrt())),
        ),
    ];
    let mut verdict = Verdict::on("forms");
    for (name, form, ray, expected) in rows {
        let got = hits(form, &[ray]);
        verdict.near(name, &got[0], &expected, Tolerance::Ulps(4.0));
    }
    verdict.close();
}

#[test]
fn surfaces_have_the_normal_of_their_slope_and_u_and_v_from_0_to_1() {
    for form in FORMS {
        let (kind, sizes) = kind_and_sizes(form);
        let rays = rays_at(form, 3000, &mut Random::new(12));
        let found = hits(form, &rays);
        let hit = rays.iter().zip(&found).filter(|(_, got)| got.hit);
        let at = |(ray, got): (&Ray, &Candidate)| {
            let p = double(ray.origin) + f64::from(got.t) * double(ray.direction);
            (single(p), kind, sizes, got.b1)
        };
        let inputs: Vec<_> = hit.map(at).collect();
        let source = format!(
            "{FORM} fn probe(p: vec3f, kind: u32, sizes: vec3f, part: f32) -> FormPoint {{ return point(p, kind, sizes, part); }}"
        );
        let points: Vec<FormPoint> = gpu().map_source(&source, &inputs);
        let mut verdict = Verdict::on(format!("{form:?}"));
        for ((reached, _, _, part), got) in inputs.iter().zip(&points) {
            let (p, n, reached) = (double(got.p), double(got.n), double(*reached));
            let show = || format!("{got:?}, reached {reached}, part {part}");
            let in_unit = got.uv.iter().all(|x| (0.0..=1.0).contains(x));
            verdict.that("u and v are in 0..=1", in_unit, show);
            // Discs and rectangles do not clamp points slightly beyond their edges.
            let most = if matches!(form, Form::Disc { .. } | Form::Rectangle | Form::Box) {
                1e-3
            } else {
                4.0 * ROUNDING
            };
            verdict.that("it lies on the surface", off_surface(form, p) <= most, show);
            verdict.that("it is near", p.distance(reached) < 2e-3, show);
            let n_ref = form_normal(form, p).normalize();
            // Next to a rim or an apex the reference may be on the other part.
            let rim = match form {
                Form::Cone { bottom, top, .. } => {
                    let off_axis = p.x.hypot(p.z);
                    p.y.min(1.0 - p.y).abs() < 2e-5
                        && [(0.0, bottom), (1.0, top)]
                            .iter()
                            .any(|&(y, r)| (p.y - y).abs() < 0.5 && (off_axis - r).abs() < 2e-5)
                        || off_axis < 1e-4
                }
                Form::Box => {
                    let size = p.abs();
                    size.to_array().iter().filter(|&&x| x > 1.0 - 2e-3).count() > 1
                }
                Form::Torus { minor } => minor == 1.0 && p.length() < 1e-2,
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
fn uvs(form: Form, points: &[(DVec3, f32)]) -> Vec<[f32; 2]> {
    let (kind, sizes) = kind_and_sizes(form);
    let inputs: Vec<_> = (points.iter())
        .map(|&(p, part)| (single(p), kind, sizes, part))
        .collect();
    let source = format!(
        "{FORM} fn probe(p: vec3f, kind: u32, sizes: vec3f, part: f32) -> vec2f {{ return point(p, kind, sizes, part).uv; }}"
    );
    gpu().map_source(&source, &inputs)
}

#[test]
fn u_and_v_are_where_the_docs_say() {
    let at = DVec3::new;
    let half = 0.5f64.sqrt();
    #[rustfmt::skip]
    let rows: [(&str, Form, DVec3, f32, [f64; 2]); 26] = [
        ("a disc's right edge", FORMS[0], at(1.0, 0.0, 0.0), 0.0, [1.0, 0.5]),
        ("a disc's far edge", FORMS[0], at(0.0, 0.0, -1.0), 0.0, [0.5, 1.0]),
        ("a rectangle's near left corner", FORMS[2], at(-1.0, 0.0, 1.0), 0.0, [0.0, 0.0]),
        ("a rectangle's far right corner", FORMS[2], at(1.0, 0.0, -1.0), 0.0, [1.0, 1.0]),
        ("a box's front, upper right", FORMS[3], at(1.0, 1.0, 1.0), 5.0, [1.0, 1.0]),
        ("a box's back, seen from there: upper left", FORMS[3], at(1.0, 1.0, -1.0), 2.0, [0.0, 1.0]),
        ("a box's right side: upper left", FORMS[3], at(1.0, 1.0, 1.0), 3.0, [0.0, 1.0]),
        ("a box's left side: upper right", FORMS[3], at(-1.0, 1.0, 1.0), 0.0, [1.0, 1.0]),
        ("a box's top: near right", FORMS[3], at(1.0, 1.0, 1.0), 4.0, [1.0, 0.0]),
        ("a box's bottom: near right", FORMS[3], at(1.0, -1.0, 1.0), 1.0, [1.0, 1.0]),
        ("the sphere's front", FORMS[4], at(0.0, 0.0, 1.0), 0.0, [0.5, 0.5]),
        ("the sphere's right", FORMS[4], at(1.0, 0.0, 0.0), 0.0, [0.75, 0.5]),
        ("the sphere's left", FORMS[4], at(-1.0, 0.0, 0.0), 0.0, [0.25, 0.5]),
        ("the sphere's north pole", FORMS[4], at(0.0, 1.0, 0.0), 0.0, [0.5, 1.0]),
        ("the sphere's south pole", FORMS[4], at(0.0, -1.0, 0.0), 0.0, [0.5, 0.0]),
        ("the sphere at 45° north", FORMS[4], at(half, half, 0.0), 0.0, [0.75, 0.75]),
        ("just east of the seam", FORMS[4], at(-1e-4, 0.0, -1.0), 0.0, [1e-4 / TAU, 0.5]),
        ("a cylinder's front, half way up", FORMS[5], at(0.0, 0.5, 1.0), 0.0, [0.5, 0.5]),
        ("a cylinder's right, at the top", FORMS[5], at(1.0, 1.0, 0.0), 0.0, [0.75, 1.0]),
        ("its top end: far edge", FORMS[5], at(0.0, 1.0, -1.0), 2.0, [0.5, 1.0]),
        ("its bottom end: far edge", FORMS[5], at(0.0, 0.0, -1.0), 1.0, [0.5, 0.0]),
        ("a frustum's smaller end: right edge", FORMS[11], at(0.5, 1.0, 0.0), 2.0, [1.0, 0.5]),
        ("a torus' outer equator in front", FORMS[12], at(0.0, 0.0, 1.25), 0.0, [0.5, 0.5]),
        ("a torus' top on the right", FORMS[12], at(1.0, 0.25, 0.0), 0.0, [0.75, 0.75]),
        ("a torus' underside", FORMS[12], at(1.0, -0.25, 0.0), 0.0, [0.75, 0.25]),
        ("just above its inner equator", FORMS[12], at(0.75, 1e-5, 0.0), 0.0, [0.75, 1.0]),
    ];
    let mut verdict = Verdict::on("u and v");
    for (name, form, p, part, expected) in rows {
        let got = uvs(form, &[(p, part)]);
        verdict.near(name, &got[0], &expected, Tolerance::Absolute(1e-5));
    }
    verdict.close();
}

#[test]
fn u_and_v_have_no_jumps_but_at_seams() {
    for form in FORMS {
        let mut random = Random::new(13);
        let mut points = Vec::new();
        let mut gaps = Vec::new();
        for _ in 0..1000 {
            let p = on_surface(form, &mut random);
            let q = p + 1e-3 * random.direction();
            let n = form_normal(form, p);
            let part = match form {
                Form::Box => {
                    let axis = n.abs().max_position() as f32;
                    axis + if n.max_element() > 0.5 { 3.0 } else { 0.0 }
                }
                Form::Cone { capped: true, .. } if n.y < -0.999 => 1.0,
                Form::Cone { capped: true, .. } if n.y > 0.999 => 2.0,
                _ => 0.0,
            };
            points.extend([(p, part), (q, part)]);
            gaps.push((p, p.x.hypot(p.z)));
        }
        let mut verdict = Verdict::on(format!("{form:?}"));
        for (pair, (p, off_axis)) in uvs(form, &points).chunks(2).zip(gaps) {
            let [a, b] = [pair[0], pair[1]].map(|uv| DVec2::from(uv.map(f64::from)));
            // A full turn ends where it started.
            let way = (a - b).abs();
            let way = way.min(DVec2::ONE - way);
            let tube = match form {
                Form::Torus { minor } => minor,
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
fn packed(form: Form, world_from_form: DAffine3) -> PackedShape {
    let geometry = Geometry::Placed {
        form,
        world_from_form,
    };
    let scene = Scene {
        cameras: vec![Default::default()],
        materials: vec![Default::default()],
        shapes: vec![Shape {
            geometry,
            material: 0,
            node: None,
        }],
        ..Scene::default()
    };
    pack::scene(&scene).expect("a scene").shapes[0]
}

/// A shape at a random position, of any size, rotated, scaled non-uniformly and possibly mirrored.
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
fn is_convex_at(form: Form, p: DVec3) -> bool {
    match form {
        Form::Torus { .. } => p.x.hypot(p.z) > 1.0,
        Form::Cone { capped, .. } => capped,
        Form::Disc { .. } | Form::Rectangle => false,
        _ => true,
    }
}

#[test]
fn a_ray_that_leaves_a_form_does_not_hit_it_again_at_any_scale() {
    // (hit at all, hit again)
    const LEAVE: &str = "
        fn probe(shape: PackedShape, ray: Ray, aside: vec3f, cosine: f32) -> vec2u {
            let hit = test(form_ray(ray, shape), shape.kind, sizes_of(shape));
            let at = placed(ray, shape, hit);
            let tangent = normalize(aside - dot(aside, at.ng) * at.ng);
            let direction = normalize(tangent * sqrt(1.0 - cosine * cosine) + cosine * at.ng);
            let origin = offset_origin(at.p, at.error, at.ng, direction);
            let again = test(form_ray(Ray(origin, 3e38, direction, NONE, NO_INSTANCE), shape), shape.kind, sizes_of(shape));
            // Rounding may move a grazing ray to the other side.
            return vec2u(u32(hit.hit & (dot(at.ng, direction) > 0.0)), u32(again.hit));
        }
    ";
    for form in FORMS {
        let mut random = Random::new(14);
        let mut inputs = Vec::new();
        while inputs.len() < 20_000 {
            let world_from_form = placement(&mut random);
            let shape = packed(form, world_from_form);
            for i in 0..40 {
                let local = on_surface(form, &mut random);
                if !is_convex_at(form, local) {
                    continue;
                }
                let p = world_from_form.transform_point3(local);
                let turn = world_from_form.matrix3.inverse().transpose();
                let n = (turn * form_normal(form, local)).normalize();
                let away = (n + 0.8 * random.direction()).normalize();
                let distance =
                    world_from_form.matrix3.x_axis.length() * 10f64.powf(random.between(-1.0, 2.0));
                let ray = ray(single(p + distance * away), single(-away));
                let cosine = if i % 10 == 0 {
                    1e-6
                } else {
                    10f64.powf(random.between(-6.0, 0.0))
                };
                inputs.push((shape, ray, single(random.direction()), cosine as f32));
            }
            if matches!(
                form,
                Form::Cone { capped: false, .. } | Form::Disc { .. } | Form::Rectangle
            ) {
                break;
            }
        }
        if inputs.is_empty() {
            continue;
        }
        let results: Vec<[u32; 2]> = gpu().map_source(&format!("{FORM}{LEAVE}"), &inputs);
        let mut verdict = Verdict::on(format!("{form:?}"));
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
fn a_ray_into_a_closed_form_comes_out_of_it() {
    const ENTER: &str = "
        fn probe(shape: PackedShape, ray: Ray, aside: vec3f, cosine: f32) -> vec2u {
            let hit = test(form_ray(ray, shape), shape.kind, sizes_of(shape));
            let at = placed(ray, shape, hit);
            let tangent = normalize(aside - dot(aside, at.ng) * at.ng);
            let direction = normalize(tangent * sqrt(1.0 - cosine * cosine) - cosine * at.ng);
            let origin = offset_origin(at.p, at.error, at.ng, direction);
            let out = test(form_ray(Ray(origin, 3e38, direction, NONE, NO_INSTANCE), shape), shape.kind, sizes_of(shape));
            return vec2u(u32(hit.hit), u32(out.hit));
        }
    ";
    for form in FORMS {
        if !matches!(
            form,
            Form::Box | Form::Ellipsoid | Form::Torus { .. } | Form::Cone { capped: true, .. }
        ) {
            continue;
        }
        let mut random = Random::new(15);
        let mut inputs = Vec::new();
        while inputs.len() < 10_000 {
            let world_from_form = placement(&mut random);
            let shape = packed(form, world_from_form);
            for _ in 0..40 {
                let p = world_from_form.transform_point3(on_surface(form, &mut random));
                let away = random.direction();
                let distance = world_from_form.matrix3.x_axis.length() * 10.0;
                let ray = ray(single(p + distance * away), single(-away));
                let cosine = 10f64.powf(random.between(-3.0, 0.0)) as f32;
                inputs.push((shape, ray, single(random.direction()), cosine));
            }
        }
        let results: Vec<[u32; 2]> = gpu().map_source(&format!("{FORM}{ENTER}"), &inputs);
        // A point within its error of an edge may lie beyond the other face.
        let lost = results
            .iter()
            .filter(|[hit, out]| *hit == 1 && *out == 0)
            .count();
        assert!(
            lost <= inputs.len() / 1000,
            "{form:?}: {lost} of {}",
            inputs.len()
        );
    }
}

#[test]
fn the_point_of_a_hit_is_within_its_error_of_the_surface() {
    // p, ng, error, each a row.
    const WHERE: &str = "
        fn probe(shape: PackedShape, ray: Ray, row: u32) -> vec3f {
            let hit = test(form_ray(ray, shape), shape.kind, sizes_of(shape));
            let at = placed(ray, shape, hit);
            return select(select(select(at.error, at.ng, row == 1u), at.p, row == 0u), vec3f(f32(hit.hit)), row == 3u);
        }
    ";
    for form in FORMS {
        let mut random = Random::new(16);
        let mut inputs = Vec::new();
        let mut placements = Vec::new();
        for _ in 0..100 {
            let world_from_form = placement(&mut random);
            let shape = packed(form, world_from_form);
            for _ in 0..20 {
                let p = world_from_form.transform_point3(on_surface(form, &mut random));
                let away = random.direction();
                let distance =
                    world_from_form.matrix3.x_axis.length() * 10f64.powf(random.between(-1.0, 3.0));
                let ray = ray(single(p + distance * away), single(-away));
                inputs.extend([0u32, 1, 2, 3].map(|row| (shape, ray, row)));
                placements.push(world_from_form);
            }
        }
        let results: Vec<[f32; 3]> = gpu().map_source(&format!("{FORM}{WHERE}"), &inputs);
        let mut verdict = Verdict::on(format!("{form:?}"));
        for ((got, world_from_form), input) in
            results.chunks(4).zip(&placements).zip(inputs.chunks(4))
        {
            let [p, ng, error, hit] = [got[0], got[1], got[2], got[3]].map(double);
            if hit.x == 0.0 {
                continue;
            }
            // The shape as the shader sees it: its position and rows are rounded.
            let shape = &input[0].0;
            let rows = DMat3::from_cols(
                double(shape.row_x),
                double(shape.row_y),
                double(shape.row_z),
            )
            .transpose();
            let local = rows * (p - double(shape.position));
            let local_ref = match form {
                Form::Cone {
                    bottom,
                    top,
                    capped,
                } => {
                    let wide = bottom.max(top);
                    cone(bottom / wide, top / wide, capped)
                }
                form => form,
            };
            let off = off_surface(local_ref, local);
            // Along the normal, in render space.
            let slope = (rows.transpose() * form_normal(local_ref, local).normalize()).length();
            let allowed = ng.abs().dot(error);
            verdict.that(
                "on the surface",
                off / slope <= allowed || off > 0.5e-3,
                || {
                    format!(
                        "{p} is off by {} of {allowed}, placed by {world_from_form:?}",
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
fn forms_fill_their_bounds_and_keep_within_them() {
    let mut verdict = Verdict::on("Geometry::bounds");
    for form in FORMS {
        let mut random = Random::new(18);
        for _ in 0..20 {
            let world_from_form = placement(&mut random);
            let geometry = Geometry::Placed {
                form,
                world_from_form,
            };
            let (min, max) = geometry.bounds().expect("bounds");
            let size = (max - min).max_element();
            let (mut low, mut high) = (DVec3::INFINITY, DVec3::NEG_INFINITY);
            for _ in 0..4000 {
                let p = world_from_form.transform_point3(on_surface(form, &mut random));
                (low, high) = (low.min(p), high.max(p));
            }
            let slack = 1e-12 * (size + max.abs().max_element());
            let within =
                (low - min).min_element() >= -slack && (max - high).min_element() >= -slack;
            verdict.that(format!("{form:?} keeps within"), within, || {
                format!("{low} to {high} in {min} to {max}")
            });
            let filled = (low - min).max(max - high) / (max - min).max(DVec3::splat(1e-300));
            verdict.that(
                format!("{form:?} fills"),
                filled.max_element() < 0.1,
                || format!("{low} to {high} in {min} to {max}"),
            );
        }
    }
    verdict.close();
}
