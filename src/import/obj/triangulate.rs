//! Polygons into triangles: fans where the polygon is convex, ear clipping (Meisters 1975) where it
//! is not.

use glam::{DVec2, DVec3};

/// Polygons of more corners are always cut into fans: ear clipping takes quadratic time.
const MAX_CLIPPED: usize = 512;

/// Twice the area of the polygon along its normal (Newell's method).
pub(super) fn normal(points: &[DVec3]) -> DVec3 {
    let next = |i: usize| points[(i + 1) % points.len()];
    (0..points.len())
        .map(|i| (points[i] - points[0]).cross(next(i) - points[0]))
        .sum()
}

/// The triangles of the polygon, as indices into `points`, wound the same way.
pub(super) fn triangles(points: &[DVec3]) -> Vec<[u32; 3]> {
    let count = points.len() as u32;
    let fan = |_| (1..count.max(2) - 1).map(|i| [0, i, i + 1]).collect();
    if count == 3 || points.len() > MAX_CLIPPED {
        return fan(());
    }
    let flat = projected(points);
    if is_convex(&flat) {
        fan(())
    } else {
        clip_ears(&flat)
    }
}

/// The polygon on the coordinate plane in which it is largest, counter-clockwise.
fn projected(points: &[DVec3]) -> Vec<DVec2> {
    let normal = normal(points);
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

fn is_convex(points: &[DVec2]) -> bool {
    let at = |i: usize| points[i % points.len()];
    (0..points.len()).all(|i| turn(at(i), at(i + 1), at(i + 2)) >= 0.0)
}

/// Twice the signed area of the triangle.
fn turn(a: DVec2, b: DVec2, c: DVec2) -> f64 {
    (b - a).perp_dot(c - a)
}

fn clip_ears(points: &[DVec2]) -> Vec<[u32; 3]> {
    let mut left: Vec<u32> = (0..points.len() as u32).collect();
    let mut triangles = Vec::with_capacity(points.len() - 2);
    while left.len() > 3 {
        let ear = (0..left.len()).find(|&i| is_ear(points, &left, i));
        // A polygon that crosses itself may have none: any corner will do then.
        let i = ear.unwrap_or(0);
        triangles.push(around(&left, i));
        left.remove(i);
    }
    triangles.push([left[0], left[1], left[2]]);
    triangles
}

/// The corner `i` between its neighbours.
fn around(left: &[u32], i: usize) -> [u32; 3] {
    let count = left.len();
    [
        left[(i + count - 1) % count],
        left[i],
        left[(i + 1) % count],
    ]
}

/// Whether the corner `i` points outwards and nothing of the polygon lies in its triangle.
fn is_ear(points: &[DVec2], left: &[u32], i: usize) -> bool {
    let corners = around(left, i);
    let [a, b, c] = corners.map(|i| points[i as usize]);
    let is_inside = |p: DVec2| turn(a, b, p) >= 0.0 && turn(b, c, p) >= 0.0 && turn(c, a, p) >= 0.0;
    let others = left
        .iter()
        .filter(|i| !corners.contains(i))
        .map(|&i| points[i as usize]);
    turn(a, b, c) > 0.0 && !others.into_iter().any(is_inside)
}
