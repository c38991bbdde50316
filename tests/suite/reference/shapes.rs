//! Canonical shapes in f64, by other methods than the shaders: implicit functions, their signs along the ray,
//! and finite differences for normals.

use glam::{DAffine3, DVec3};
use glimray::scene::CanonicalShape;

/// Steps of the search for a torus along a ray.
const STEPS: usize = 160;

/// All distances at which the ray hits the placed shape, in ascending order. Flat shapes seen edge-on are
/// missed.
pub fn crossings(
    canonical: CanonicalShape,
    world_from_canonical: DAffine3,
    origin: DVec3,
    direction: DVec3,
) -> Vec<f64> {
    let canonical_from_world = world_from_canonical.inverse();
    let o = canonical_from_world.transform_point3(origin);
    let d = canonical_from_world.transform_vector3(direction);
    canonical_crossings(canonical, o, d)
}

/// [`crossings`] in the canonical space.
pub fn canonical_crossings(canonical: CanonicalShape, o: DVec3, d: DVec3) -> Vec<f64> {
    let at = |t: f64| o + t * d;
    let mut found: Vec<f64> = match canonical {
        CanonicalShape::Disc { hole } => level(o, d, 0.0)
            .into_iter()
            .filter(|&t| (hole..=1.0).contains(&off_axis(at(t))))
            .collect(),
        CanonicalShape::Rectangle => level(o, d, 0.0)
            .into_iter()
            .filter(|&t| at(t).x.abs() <= 1.0 && at(t).z.abs() <= 1.0)
            .collect(),
        CanonicalShape::Box => (0..3)
            .flat_map(|axis| [-1.0, 1.0].map(|side| (axis, side)))
            .map(|(axis, side)| (axis, (side - o[axis]) / d[axis]))
            .filter(|&(axis, t)| {
                t.is_finite() && (0..3).all(|i| i == axis || at(t)[i].abs() <= 1.0)
            })
            .map(|(_, t)| t)
            .collect(),
        CanonicalShape::Ellipsoid => {
            quadratic(d.length_squared(), o.dot(d), o.length_squared() - 1.0)
        }
        CanonicalShape::Cone {
            bottom,
            top,
            capped,
        } => {
            let slope = top - bottom;
            let radius = bottom + slope * o.y;
            let flat = |a: DVec3, b: DVec3| a.x * b.x + a.z * b.z;
            let side = quadratic(
                flat(d, d) - (slope * d.y).powi(2),
                flat(o, d) - slope * radius * d.y,
                flat(o, o) - radius * radius,
            );
            let side = (side.into_iter()).filter(|&t| (0.0..=1.0).contains(&at(t).y));
            let ends = [(0.0, bottom), (1.0, top)].into_iter().flat_map(|(y, r)| {
                (level(o, d, y).into_iter()).filter(move |&t| off_axis(at(t)) <= r)
            });
            side.chain(ends.filter(|_| capped)).collect()
        }
        CanonicalShape::Torus { minor } => torus(minor, o, d),
    };
    found.sort_by(f64::total_cmp);
    found
}

/// The outward unit normal at a point of the placed shape; of flat shapes towards +y.
pub fn normal(canonical: CanonicalShape, world_from_canonical: DAffine3, p: DVec3) -> DVec3 {
    let local = world_from_canonical.inverse().transform_point3(p);
    let turn = world_from_canonical.matrix3.inverse().transpose();
    (turn * canonical_normal(canonical, local)).normalize()
}

/// [`normal`] in the canonical space, not of unit length.
pub fn canonical_normal(canonical: CanonicalShape, p: DVec3) -> DVec3 {
    let nearest_face = || {
        let size = p.abs();
        let axis = (0..3).max_by(|&a, &b| size[a].total_cmp(&size[b]));
        let mut n = DVec3::ZERO;
        n[axis.unwrap_or(0)] = p[axis.unwrap_or(0)].signum();
        n
    };
    match canonical {
        CanonicalShape::Disc { .. } | CanonicalShape::Rectangle => DVec3::Y,
        CanonicalShape::Box => nearest_face(),
        CanonicalShape::Ellipsoid => p,
        CanonicalShape::Cone {
            bottom,
            top,
            capped,
        } => {
            let side = |p: DVec3| off_axis(p) - (bottom + (top - bottom) * p.y);
            let (below, above) = (p.y.abs(), (p.y - 1.0).abs());
            if capped && below.min(above) < side(p).abs() {
                return if below < above { -DVec3::Y } else { DVec3::Y };
            }
            slope_of(side, p)
        }
        CanonicalShape::Torus { minor } => slope_of(|p| tube(minor, p), p),
    }
}

/// Signed distance from the surface of a torus, negative inside its tube.
pub fn tube(minor: f64, p: DVec3) -> f64 {
    (off_axis(p) - 1.0).hypot(p.y) - minor
}

fn off_axis(p: DVec3) -> f64 {
    p.x.hypot(p.z)
}

/// By finite differences.
fn slope_of(f: impl Fn(DVec3) -> f64, p: DVec3) -> DVec3 {
    let step = 1e-6;
    let along = |axis: DVec3| (f(p + step * axis) - f(p - step * axis)) / (2.0 * step);
    DVec3::new(along(DVec3::X), along(DVec3::Y), along(DVec3::Z))
}

fn level(o: DVec3, d: DVec3, y: f64) -> Option<f64> {
    Some((y - o.y) / d.y).filter(|t| t.is_finite())
}

/// a t² + 2 b t + c = 0.
fn quadratic(a: f64, b: f64, c: f64) -> Vec<f64> {
    if a == 0.0 {
        return Some(-c / (2.0 * b))
            .filter(|t| t.is_finite())
            .into_iter()
            .collect();
    }
    let root = (b * b - a * c).sqrt();
    // Without real roots both are NaN.
    [(-b - root) / a, (-b + root) / a]
        .into_iter()
        .filter(|t| t.is_finite())
        .collect()
}

/// The sign changes of the distance between small steps, and double crossings within a step.
fn torus(minor: f64, o: DVec3, d: DVec3) -> Vec<f64> {
    let reach = (1.0 + minor) * 1.001;
    let chord = quadratic(
        d.length_squared(),
        o.dot(d),
        o.length_squared() - reach * reach,
    );
    let [start, end] = chord[..] else {
        return Vec::new();
    };
    let f = |t: f64| tube(minor, o + t * d);
    let step = (end - start) / STEPS as f64;
    let mut ends = Vec::new();
    for i in 0..STEPS {
        let (a, b) = (start + step * i as f64, start + step * (i + 1) as f64);
        if (f(a) > 0.0) != (f(b) > 0.0) {
            ends.push((a, b));
            continue;
        }
        // The extremum towards zero, if it is inside the step.
        let steep = step * d.length();
        if f(a).abs().min(f(b).abs()) < steep {
            let sign = f(a).signum();
            let middle = least(|t| sign * f(t), a, b);
            if sign * f(middle) < 0.0 {
                ends.extend([(a, middle), (middle, b)]);
            }
        }
    }
    ends.into_iter().map(|(a, b)| bisect(f, a, b)).collect()
}

fn least(f: impl Fn(f64) -> f64, mut a: f64, mut b: f64) -> f64 {
    for _ in 0..60 {
        let (low, high) = (a + (b - a) * 0.382, a + (b - a) * 0.618);
        if f(low) < f(high) {
            b = high;
        } else {
            a = low;
        }
    }
    (a + b) / 2.0
}

fn bisect(f: impl Fn(f64) -> f64, mut a: f64, mut b: f64) -> f64 {
    let side = f(a) > 0.0;
    for _ in 0..60 {
        let middle = (a + b) / 2.0;
        if (f(middle) > 0.0) == side {
            a = middle;
        } else {
            b = middle;
        }
    }
    (a + b) / 2.0
}
