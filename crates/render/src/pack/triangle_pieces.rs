//! Divides long triangles into pieces for the BVH: the box of a long oblique triangle is mostly empty, the boxes of
//! its pieces are not (Ernst and Greiner, Early Split Clipping for Bounding Volume Hierarchies, 2007). The triangle
//! is stored once; each piece is a leaf that refers to it.

use super::divided::Divided;
use crate::bvh::{Aabb, threads};
use glam::Vec3;

/// A triangle may be divided if its box is larger than the mean of all boxes by this factor.
const LARGE: f32 = 1.0;

/// A division must reduce the area of the boxes by this factor.
const GAIN: f32 = 1.4;

/// Halvings of one triangle.
const MOST_HALVINGS: u32 = 6;

/// At most one piece for this many triangles of the mesh.
const TRIANGLES_PER_PIECE: usize = 4;

/// A slice of a triangle, parallel to its shortest edge.
#[derive(Clone, Copy, Debug)]
pub struct TrianglePiece {
    /// The triangle that it is a part of.
    pub triangle: u32,
    /// The corner opposite the shortest edge: 0, 1 or 2.
    apex: u32,
    /// Where the slice begins and ends, as fractions of the way from the apex to the shortest edge. They are the
    /// same wherever the mesh is placed.
    extent: [f32; 2],
}

impl TrianglePiece {
    fn whole(triangle: u32, corners: [Vec3; 3]) -> Self {
        let opposite = |apex: usize| {
            let [b, c] = [1, 2].map(|step| corners[(apex + step) % 3]);
            b.distance_squared(c)
        };
        let shorter = |best, apex| match opposite(apex) < opposite(best) {
            true => apex,
            false => best,
        };
        Self {
            triangle,
            apex: (1..3).fold(0, shorter) as u32,
            extent: [0.0, 1.0],
        }
    }

    /// A box round the piece, where the triangle has these corners.
    pub fn aabb(&self, corners: [Vec3; 3]) -> Aabb {
        let [a, b, c] = [0, 1, 2].map(|step| corners[(self.apex as usize + step) % 3]);
        let all = Aabb::of(corners);
        let end = |at: f32| Aabb::of([a + (b - a) * at, a + (c - a) * at, a + (b - a) * at]);
        let own = end(self.extent[0]).union(end(self.extent[1]));
        // For the rounding of the ends.
        let slack = all.min.abs().max(all.max.abs()) * (8.0 * f32::EPSILON);
        Aabb {
            min: (own.min - slack).max(all.min),
            max: (own.max + slack).min(all.max),
        }
    }

    fn halves(&self) -> [Self; 2] {
        let [from, to] = self.extent;
        let middle = (from + to) * 0.5;
        [[from, middle], [middle, to]].map(|extent| Self { extent, ..*self })
    }
}

/// The boxes of triangles, given with the corners of each, long ones in pieces.
pub fn divide_all(
    boxes: Vec<Aabb>,
    corners: impl Fn(u32) -> [Vec3; 3] + Sync,
) -> Divided<TrianglePiece> {
    let pieces = pieces(&boxes, &corners);
    let aabb = |piece: &TrianglePiece| piece.aabb(corners(piece.triangle));
    Divided::new(boxes, pieces, aabb, |piece| &mut piece.triangle)
}

/// The pieces of all triangles worth dividing, triangle by triangle.
fn pieces(boxes: &[Aabb], corners: &(impl Fn(u32) -> [Vec3; 3] + Sync)) -> Vec<TrianglePiece> {
    let total: f64 = boxes.iter().map(|aabb| f64::from(aabb.half_area())).sum();
    let mean = (total / boxes.len() as f64) as f32;
    let pays = threads::collect(boxes.len(), |index| {
        let triangle = index as u32;
        let is_large = boxes[index].half_area() > LARGE * mean;
        is_large && {
            let corners = corners(triangle);
            pays(&TrianglePiece::whole(triangle, corners), corners)
        }
    });
    let worth = |least: f32| {
        let triangles = (0u32..).zip(boxes).zip(&pays);
        triangles.filter_map(move |((triangle, aabb), pays)| {
            (*pays && aabb.half_area() > least).then_some(triangle)
        })
    };
    let mut least = LARGE * mean;
    let (mut pieces, mut open) = (Vec::new(), Vec::new());
    loop {
        pieces.clear();
        let is_full = |pieces: &[TrianglePiece]| pieces.len() > boxes.len() / TRIANGLES_PER_PIECE;
        for triangle in worth(least) {
            divide(triangle, corners(triangle), least, &mut pieces, &mut open);
            if is_full(&pieces) {
                break;
            }
        }
        if !is_full(&pieces) {
            return pieces;
        }
        least *= 2.0;
    }
}

/// Whether both halves of a piece have much smaller boxes than the piece.
fn pays(piece: &TrianglePiece, corners: [Vec3; 3]) -> bool {
    let [left, right] = piece.halves().map(|half| half.aabb(corners).half_area());
    (left + right) * GAIN < piece.aabb(corners).half_area()
}

/// Adds the pieces of a triangle. Pieces with smaller boxes than `least` are not divided further. `open` is working
/// memory.
fn divide(
    triangle: u32,
    corners: [Vec3; 3],
    least: f32,
    pieces: &mut Vec<TrianglePiece>,
    open: &mut Vec<(TrianglePiece, u32)>,
) {
    open.push((TrianglePiece::whole(triangle, corners), 0));
    while let Some((piece, depth)) = open.pop() {
        let is_large = piece.aabb(corners).half_area() > least;
        match depth < MOST_HALVINGS && is_large && pays(&piece, corners) {
            true => open.extend(piece.halves().map(|half| (half, depth + 1))),
            false => pieces.push(piece),
        }
    }
}
