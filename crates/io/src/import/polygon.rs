//! Triangulates polygons: as fans if convex, otherwise by ear clipping (Meisters 1975, by the crate
//! `earcut`).

use earcut::Earcut;
use glam::{DVec2, DVec3};
use std::f64::consts::{PI, TAU};

/// Limit of corners of a polygon that is not convex: ear clipping may take quadratic time.
pub(super) const MAX_CONCAVE: usize = 16_384;

/// Polygons with more corners are checked for crossing edges before they are clipped: on such polygons
/// `earcut` takes cubic time.
const MAX_UNCHECKED: usize = 64;

/// Limit of the sum of squared corner counts over all polygons above [`MAX_UNCHECKED`].
const MAX_WORK: u64 = 1 << 30;

/// Why a polygon cannot be triangulated.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Defect {
    /// All corners are collinear, or the signed areas of its parts cancel.
    NoArea,
    /// The polygon intersects itself or winds around more than once.
    Crossing,
    /// The polygon is not convex, and clipping it, or all polygons so far, would take too long.
    TooMuchWork,
}

/// Triangulates the polygons of one file.
pub(super) struct Cutter {
    earcut: Earcut<f64>,
    work: u64,
}

/// Twice the area of the polygon along its normal (Newell's method).
pub(super) fn normal(points: &[DVec3]) -> DVec3 {
    let next = |i: usize| points[(i + 1) % points.len()];
    (0..points.len())
        .map(|i| (points[i] - points[0]).cross(next(i) - points[0]))
        .sum()
}

/// The fan from the first corner, which triangulates a convex polygon.
pub(super) fn fan(count: usize) -> Vec<[u32; 3]> {
    (1..count.max(2) as u32 - 1)
        .map(|i| [0, i, i + 1])
        .collect()
}

impl Cutter {
    pub fn new() -> Self {
        Self {
            earcut: Earcut::new(),
            work: 0,
        }
    }

    /// The triangles of the polygon as indices into `points`, with the same winding. Together they cover
    /// it once.
    pub fn triangles(&mut self, points: &[DVec3]) -> Result<Vec<[u32; 3]>, Defect> {
        let before = |i: usize| points[(i + points.len() - 1) % points.len()];
        let is_repeated = |i: usize| points[i] == before(i);
        if !(0..points.len()).any(is_repeated) {
            return self.triangles_of_distinct(points);
        }
        let kept: Vec<usize> = (0..points.len()).filter(|&i| !is_repeated(i)).collect();
        let distinct: Vec<DVec3> = kept.iter().map(|&i| points[i]).collect();
        let mut triangles = self.triangles_of_distinct(&distinct)?;
        for corner in triangles.as_flattened_mut() {
            *corner = kept[*corner as usize] as u32;
        }
        Ok(triangles)
    }

    /// [`Self::triangles`] for a polygon without equal consecutive corners.
    fn triangles_of_distinct(&mut self, points: &[DVec3]) -> Result<Vec<[u32; 3]>, Defect> {
        let count = points.len();
        let normal = normal(points);
        let reach = points.iter().map(|p| p.distance(points[0]));
        // An area whose square underflows is zero too.
        let reach = reach.fold(0.0, f64::max);
        if count < 3 || normal.length() <= 1e-12 * reach * reach {
            return Err(Defect::NoArea);
        }
        if count == 3 {
            return Ok(fan(3));
        }
        let flat = projected(points, normal);
        let corners = || (0..count).map(|i| [0, 1, 2].map(|k| flat[(i + k) % count]));
        let is_convex = corners().all(|[a, b, c]| turn(a, b, c) > 0.0);
        // Four corners cannot wind around twice.
        let round = if is_convex && count == 4 {
            TAU
        } else {
            corners().map(|[a, b, c]| exterior_angle(a, b, c)).sum()
        };
        if (round - TAU).abs() > PI / 2.0 {
            return Err(Defect::Crossing);
        }
        if is_convex {
            return Ok(fan(count));
        }
        if count > MAX_UNCHECKED {
            self.work = self.work.saturating_add((count * count) as u64);
            if count > MAX_CONCAVE || self.work > MAX_WORK {
                return Err(Defect::TooMuchWork);
            }
            if meets_itself(&flat) {
                return Err(Defect::Crossing);
            }
        }
        self.clip_ears(&flat)
    }

    fn clip_ears(&mut self, flat: &[DVec2]) -> Result<Vec<[u32; 3]>, Defect> {
        let mut indices: Vec<u32> = Vec::new();
        let corners = flat.iter().map(|p| p.to_array());
        self.earcut.earcut(corners, &[], &mut indices);
        let triangles: Vec<[u32; 3]> = indices.as_chunks().0.to_vec();
        // The areas of the clipped ears add up to the area of the polygon. If they do not, or an ear is
        // flipped, the polygon intersects itself and the result is not valid.
        let area =
            |[a, b, c]: &[u32; 3]| turn(flat[*a as usize], flat[*b as usize], flat[*c as usize]);
        let whole: f64 = fan(flat.len()).iter().map(area).sum();
        let sum: f64 = triangles.iter().map(area).sum();
        let is_turned = triangles.iter().any(|t| area(t) < -1e-9 * whole);
        if is_turned || (sum - whole).abs() > 1e-6 * whole {
            return Err(Defect::Crossing);
        }
        Ok(triangles)
    }
}

/// The polygon projected on the coordinate plane in which it is largest, counter-clockwise.
fn projected(points: &[DVec3], normal: DVec3) -> Vec<DVec2> {
    let size = normal.abs();
    let project = |p: &DVec3| {
        let p = *p - points[0];
        if size.z >= size.x && size.z >= size.y {
            DVec2::new(p.x * normal.z.signum(), p.y)
        } else if size.y >= size.x {
            DVec2::new(p.z * normal.y.signum(), p.x)
        } else {
            DVec2::new(p.y * normal.x.signum(), p.z)
        }
    };
    points.iter().map(project).collect()
}

/// Twice the signed area of the triangle.
fn turn(a: DVec2, b: DVec2, c: DVec2) -> f64 {
    (b - a).perp_dot(c - a)
}

/// The left turn in radians at `b` on the path from `a` over `b` to `c`, in [-π, π].
fn exterior_angle(a: DVec2, b: DVec2, c: DVec2) -> f64 {
    let (to, from) = (b - a, c - b);
    to.perp_dot(from).atan2(to.dot(from))
}

/// Whether two edges cross, or more corners than the two of a seam coincide.
fn meets_itself(points: &[DVec2]) -> bool {
    let mut sorted: Vec<_> = points.iter().map(|p| (p.x, p.y)).collect();
    sorted.sort_unstable_by(|a, b| a.0.total_cmp(&b.0).then(a.1.total_cmp(&b.1)));
    if sorted.windows(3).any(|same| same[0] == same[2]) {
        return true;
    }
    let edge = |i: usize| (points[i], points[(i + 1) % points.len()]);
    let mut edges: Vec<_> = (0..points.len()).map(edge).collect();
    let left = |(a, b): &(DVec2, DVec2)| a.x.min(b.x);
    edges.sort_unstable_by(|a, b| left(a).total_cmp(&left(b)));
    edges.iter().enumerate().any(|(i, one)| {
        let right = one.0.x.max(one.1.x);
        let beside = edges[i + 1..]
            .iter()
            .take_while(|other| left(other) <= right);
        beside.into_iter().any(|other| cross(*one, *other))
    })
}

/// Whether each segment's ends lie on opposite sides of the other.
fn cross((a, b): (DVec2, DVec2), (c, d): (DVec2, DVec2)) -> bool {
    a.y.min(b.y) <= c.y.max(d.y)
        && c.y.min(d.y) <= a.y.max(b.y)
        && turn(a, b, c) * turn(a, b, d) < 0.0
        && turn(c, d, a) * turn(c, d, b) < 0.0
}
