//! `lib/shape_sampling.wesl`: points of shapes, to sample their light.

use crate::support::{
    harness::gpu,
    random::Random,
    statistics::{check_counts, square_points},
    verdict::Verdict,
};
use glam::{DMat3, DVec3, dvec3};
use std::f64::consts::PI;

const SAMPLES: usize = 40_000;
/// Cells around a shape and along it.
const AROUND: usize = 8;
const ALONG: usize = 4;

/// A shape where it is canonical. Its factors are those of a transform that stretches it.
#[derive(Clone, Copy, Debug)]
enum Kind {
    Ball,
    Ring {
        hole: f64,
    },
    Box,
    Cone {
        bottom: f64,
        top: f64,
        is_capped: bool,
    },
    Torus {
        minor: f64,
    },
}

/// A part of a surface: equal cells around and along, of these areas.
struct Cells {
    areas: Vec<f64>,
    counts: Vec<u32>,
}

fn kinds() -> Vec<Kind> {
    let cone = |bottom, top, is_capped| Kind::Cone {
        bottom,
        top,
        is_capped,
    };
    vec![
        Kind::Ball,
        Kind::Ring { hole: 0.0 },
        Kind::Ring { hole: 0.7 },
        Kind::Box,
        cone(1.0, 1.0, true),
        cone(1.0, 0.0, true),
        cone(0.0, 1.0, false),
        cone(0.4, 1.0, true),
        Kind::Torus { minor: 0.2 },
        Kind::Torus { minor: 1.0 },
    ]
}

/// Factors of a transform: the areas of the images of unit areas across x, y and z.
fn factors(transform: DMat3) -> DVec3 {
    let [x, y, z] = [transform.x_axis, transform.y_axis, transform.z_axis];
    dvec3(
        y.cross(z).length(),
        z.cross(x).length(),
        x.cross(y).length(),
    )
}

impl Kind {
    /// WESL for its areas, a point of it, and the density at a normal n.
    fn source(self) -> [String; 3] {
        let own =
            |areas: &str, point: &str, density: &str| [areas, point, density].map(String::from);
        match self {
            Self::Ball => own(
                "vec3f(ball_area(factors), 0.0, 0.0)",
                "ball_point(u)",
                "ball_density()",
            ),
            Self::Ring { hole } => [
                format!("vec3f(ring_area({hole:?}, factors), 0.0, 0.0)"),
                format!("ring_point({hole:?}, u)"),
                format!("ring_density({hole:?})"),
            ],
            Self::Box => own(
                "box_areas(factors)",
                "box_side_point(areas, u)",
                "box_density(areas, point.part)",
            ),
            Self::Cone {
                bottom,
                top,
                is_capped,
            } => [
                format!("cone_areas({bottom:?}, {top:?}, {is_capped}, factors)"),
                format!("cone_surface_point({bottom:?}, {top:?}, areas, u)"),
                format!("cone_density({bottom:?}, {top:?}, areas, point.part)"),
            ],
            Self::Torus { minor } => [
                format!("vec3f(torus_area({minor:?}, factors), 0.0, 0.0)"),
                format!("torus_surface_point({minor:?}, u)"),
                format!("torus_density({minor:?})"),
            ],
        }
    }

    /// Evaluates `what` for points of the shape.
    fn map(self, what: &str, factors: DVec3, points: &[[f32; 2]]) -> Vec<[f32; 4]> {
        let [areas, point, density] = self.source();
        let source = format!(
            "import package::lib::shape_sampling::{{
                ball_area, ball_density, ball_point, box_areas, box_density, box_side_point, cone_areas, cone_density,
                cone_surface_point, ring_area, ring_density, ring_point, torus_area, torus_density, torus_surface_point,
            }};
            fn probe(factors: vec3f, u: vec2f) -> vec4f {{
                let areas = {areas};
                let point = {point};
                let density = {density};
                return {what};
            }}"
        );
        let factors = factors.as_vec3().to_array();
        let rows: Vec<_> = points.iter().map(|&u| (factors, u)).collect();
        gpu().map_source(&source, &rows)
    }

    /// The normal at a point of a part, from its definition.
    fn normal(self, p: DVec3, part: usize) -> DVec3 {
        let out = dvec3(p.x, 0.0, p.z).normalize_or(DVec3::X);
        match self {
            Self::Ball => p,
            Self::Ring { .. } => DVec3::Y,
            Self::Box => {
                let sign = if part >= 3 { 1.0 } else { -1.0 };
                sign * DVec3::AXES[part % 3]
            }
            Self::Cone { bottom, top, .. } => match part {
                0 => (out - (top - bottom) * DVec3::Y).normalize(),
                1 => -DVec3::Y,
                _ => DVec3::Y,
            },
            Self::Torus { .. } => (p - out).normalize(),
        }
    }

    /// How far a point is from a part.
    fn distance(self, p: DVec3, part: usize) -> f64 {
        let radius = p.x.hypot(p.z);
        match self {
            Self::Ball => (p.length() - 1.0).abs(),
            Self::Ring { hole } => p.y.abs().max(radius - 1.0).max(hole - radius),
            Self::Box => {
                let normal = self.normal(p, part);
                (p.dot(normal) - 1.0).abs().max(p.abs().max_element() - 1.0)
            }
            Self::Cone { bottom, top, .. } => match part {
                0 => (radius - bottom - (top - bottom) * p.y).abs(),
                1 => p.y.abs().max(radius - bottom),
                _ => (p.y - 1.0).abs().max(radius - top),
            },
            Self::Torus { minor } => ((radius - 1.0).hypot(p.y) - minor).abs(),
        }
    }

    /// The cells of a part, whose areas follow from closed forms.
    fn cells(self, part: usize) -> Vec<f64> {
        let step = 2.0 * PI / AROUND as f64;
        let of_disc = |from: f64, to: f64| step * (to * to - from * from) / 2.0 / ALONG as f64;
        let along = |k: usize| {
            let [low, high] = [k, k + 1].map(|k| k as f64 / ALONG as f64);
            match (self, part) {
                (Self::Ball, _) => step * 2.0 * (high - low),
                (Self::Ring { hole }, _) => of_disc(hole, 1.0),
                (Self::Box, _) => 4.0 / (AROUND * ALONG) as f64,
                (Self::Cone { bottom, .. }, 1) => of_disc(0.0, bottom),
                (Self::Cone { top, .. }, 2) => of_disc(0.0, top),
                (Self::Cone { bottom, top, .. }, _) => {
                    let slope = top - bottom;
                    let circles = bottom * (high - low) + slope * (high * high - low * low) / 2.0;
                    step * circles * slope.hypot(1.0)
                }
                (Self::Torus { minor }, _) => {
                    let [low, high] = [low, high].map(|k| 2.0 * PI * k);
                    step * minor * (high - low + minor * (high.sin() - low.sin()))
                }
            }
        };
        (0..AROUND * ALONG)
            .map(|cell| along(cell % ALONG))
            .collect()
    }

    /// The cell of a point of a part.
    fn cell(self, p: DVec3, part: usize) -> usize {
        let angle = |y: f64, x: f64| y.atan2(x).rem_euclid(2.0 * PI) / (2.0 * PI);
        let radius2 = p.x * p.x + p.z * p.z;
        let around = angle(p.z, p.x);
        let [around, along] = match (self, part) {
            (Self::Ball, _) => [around, 0.5 + 0.5 * p.y],
            (Self::Ring { hole }, _) => [around, (radius2 - hole * hole) / (1.0 - hole * hole)],
            (Self::Box, _) => {
                let axis = part % 3;
                [(axis + 1) % 3, (axis + 2) % 3].map(|other| 0.5 + 0.5 * p[other])
            }
            (Self::Cone { bottom, .. }, 1) => [around, radius2 / (bottom * bottom)],
            (Self::Cone { top, .. }, 2) => [around, radius2 / (top * top)],
            (Self::Cone { .. }, _) => [around, p.y],
            (Self::Torus { .. }, _) => [around, angle(p.y, radius2.sqrt() - 1.0)],
        };
        let at = |x: f64, count: usize| ((x * count as f64) as usize).min(count - 1);
        at(around, AROUND) * ALONG + at(along, ALONG)
    }

    /// The area after a transform, by many small parts of its surface.
    fn placed_area(self, transform: DMat3, parts: &[usize]) -> f64 {
        let steps = 300;
        let mut sum = 0.0;
        for &part in parts {
            for i in 0..steps {
                for j in 0..steps {
                    let [a, b] = [i, j].map(|k| (f64::from(k) + 0.5) / f64::from(steps));
                    let (sin, cos) = (2.0 * PI * a).sin_cos();
                    let out = dvec3(cos, 0.0, sin);
                    // A point, and the area of the surface for each of a and b.
                    let (p, size) = match (self, part) {
                        (Self::Ball, _) => {
                            let y = 2.0 * b - 1.0;
                            (((1.0 - y * y).sqrt() * out) + y * DVec3::Y, 4.0 * PI)
                        }
                        (Self::Cone { bottom, top, .. }, 0) => {
                            let radius = bottom + (top - bottom) * b;
                            let size = 2.0 * PI * radius * (top - bottom).hypot(1.0);
                            (radius * out + b * DVec3::Y, size)
                        }
                        (Self::Torus { minor }, _) => {
                            let (up, aside) = (2.0 * PI * b).sin_cos();
                            let ring = 1.0 + minor * aside;
                            let size = 4.0 * PI * PI * minor * ring;
                            (ring * out + minor * up * DVec3::Y, size)
                        }
                        // Flat parts of this area.
                        _ => (DVec3::Y, self.cells(part).iter().sum()),
                    };
                    let n = self.normal(p, part);
                    let across = transform.determinant() * (transform.inverse().transpose() * n);
                    sum += size * across.length();
                }
            }
        }
        sum / f64::from(steps * steps)
    }
}

#[test]
fn points_lie_on_their_shape_with_the_density_of_their_cell() {
    let mut verdict = Verdict::on("points of shapes");
    // Independent points, and those on the edges of the square.
    let mut points = square_points(SAMPLES, 11);
    let ends = [0.0, 0.5, 0.99999994];
    points.extend(ends.iter().flat_map(|&x| ends.map(|y| [x, y])));
    let stretch = factors(DMat3::from_diagonal(dvec3(0.5, 2.0, 1.5)));
    for kind in kinds() {
        let places = kind.map("vec4f(point.p, point.density)", stretch, &points);
        let normals = kind.map("vec4f(point.n, point.part)", stretch, &points);
        let densities = kind.map("vec4f(density)", stretch, &points);
        let mut parts: Vec<Option<(Cells, f64)>> = (0..6).map(|_| None).collect();
        for ((place, normal), again) in places.iter().zip(&normals).zip(&densities) {
            let [x, y, z, density] = place.map(f64::from);
            let p = dvec3(x, y, z);
            let part = normal[3] as usize;
            let n = DVec3::from_slice(&normal.map(f64::from));
            verdict.that(
                format!("{kind:?}: on it"),
                kind.distance(p, part) < 2e-6,
                || format!("{p} of part {part}"),
            );
            // Next to the apex of a cone the direction from its axis is rounded.
            let is_apex = matches!(kind, Kind::Cone { .. }) && p.x.hypot(p.z) < 0.01;
            let off = (n - kind.normal(p, part)).length();
            verdict.that(
                format!("{kind:?}: its normal"),
                off < 1e-4 || is_apex,
                || format!("{n} at {p} of part {part}"),
            );
            let ratio = f64::from(again[0]) / density;
            verdict.that(
                format!("{kind:?}: its density"),
                (ratio - 1.0).abs() < 1e-5,
                || format!("{ratio} at {p} of part {part}"),
            );
            let (cells, _) = parts[part].get_or_insert_with(|| {
                let areas = kind.cells(part);
                let counts = vec![0; areas.len()];
                (Cells { areas, counts }, density)
            });
            cells.counts[kind.cell(p, part)] += 1;
        }
        let (mut counts, mut expected) = (Vec::new(), Vec::new());
        for (cells, density) in parts.into_iter().flatten() {
            counts.extend(cells.counts);
            expected.extend(
                cells
                    .areas
                    .iter()
                    .map(|area| points.len() as f64 * density * area),
            );
        }
        let total = expected.iter().sum::<f64>() / points.len() as f64;
        verdict.that(
            format!("{kind:?}: the whole"),
            (total - 1.0).abs() < 1e-5,
            || total,
        );
        check_counts(&mut verdict, format!("{kind:?}: cells"), &counts, &expected);
    }
    verdict.close();
}

/// Areas decide how often a shape is chosen. Those of flat parts are exact, others need only be near.
#[test]
fn areas_are_those_of_placed_shapes() {
    let mut verdict = Verdict::on("areas of placed shapes");
    let mut random = Random::new(3);
    for kind in kinds() {
        let parts: &[usize] = match kind {
            Kind::Box => &[0, 1, 2, 3, 4, 5],
            Kind::Cone {
                is_capped: true, ..
            } => &[0, 1, 2],
            _ => &[0],
        };
        let is_flat = matches!(kind, Kind::Box | Kind::Ring { .. });
        for round in 0..6 {
            let transform = match round {
                0 => DMat3::from_diagonal(DVec3::splat(0.3)),
                _ => DMat3::from_cols(random.in_cube(), random.in_cube(), random.in_cube()),
            };
            let [found, ..] = kind.map("vec4f(areas, 0.0)", factors(transform), &[[0.5; 2]])[0..1]
            else {
                panic!("one row");
            };
            let found: f64 = found.iter().map(|&area| f64::from(area)).sum();
            let ratio = found / kind.placed_area(transform, parts);
            let most = match (is_flat, round) {
                (true, _) => 1e-5,
                // The middles of the small parts of an apex miss some of it.
                (false, 0) => 3e-2,
                (false, _) => 0.25,
            };
            verdict.that(format!("{kind:?}"), (ratio - 1.0).abs() < most, || {
                format!("{ratio} of that of {transform}")
            });
        }
    }
    verdict.close();
}
