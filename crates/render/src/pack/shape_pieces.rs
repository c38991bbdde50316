//! Divides long oblique shapes into pieces for the BVH, as `triangle_pieces` does triangles: slices across the longest axis.

use super::divided::Divided;
use crate::bvh::Aabb;
use glam::{DAffine3, DVec3, Vec3Swizzles};
use glimray_scene::{CanonicalShape, Geometry};

/// A division must reduce the area of the boxes by this factor.
const GAIN: f64 = 1.2;

/// The number of pieces, as a fraction of the number with the least area: each takes room and a leaf.
const SHARE: f64 = 0.75;

/// Pieces of one shape.
const MOST_PIECES: u32 = 8;

/// Pieces of all shapes.
const MOST_IN_ALL: usize = 1 << 16;

/// A piece of a shape, in its box.
#[derive(Clone, Copy, Debug)]
pub struct ShapePiece {
    pub shape: u32,
    pub aabb: Aabb,
}

/// The boxes of shapes, divided into these pieces. If they are too many, those of the smaller shapes are left out.
pub fn divide_all(boxes: Vec<Aabb>, mut pieces: Vec<ShapePiece>) -> Divided<ShapePiece> {
    if pieces.len() > MOST_IN_ALL {
        let area = |piece: &ShapePiece| boxes[piece.shape as usize].half_area();
        let mut areas: Vec<_> = pieces.iter().map(area).collect();
        let (_, &mut least, _) = areas.select_nth_unstable_by(MOST_IN_ALL, |a, b| b.total_cmp(a));
        pieces.retain(|piece| area(piece) > least);
    }
    Divided::new(boxes, pieces, |piece| piece.aabb, |piece| &mut piece.shape)
}

/// The pieces of a shape: shapes of the same kind, whose bounds together bound it. None if it is not worth dividing.
pub fn pieces(geometry: &Geometry) -> Vec<Geometry> {
    let (Some(axis), Some((min, max))) = (Axis::of(geometry), geometry.bounds()) else {
        return Vec::new();
    };
    let length = axis.way.abs();
    let rest = (max - min - length).max(DVec3::ZERO);
    // All together have the area n A(length / n + rest), which is least where n² A(rest) = A(length).
    let area = |count: f64| count * half_area(length / count + rest);
    let best = (half_area(length) / half_area(rest).max(f64::MIN_POSITIVE)).sqrt();
    let count = (SHARE * best).floor().min(f64::from(MOST_PIECES));
    if count < 2.0 || area(count) * GAIN > area(1.0) {
        return Vec::new();
    }
    let ends = |index| [f64::from(index) / count, f64::from(index + 1) / count];
    (0..count as u32)
        .map(|index| axis.slice(ends(index)))
        .collect()
}

/// Half of the surface area of a box.
fn half_area(extent: DVec3) -> f64 {
    extent.dot(extent.yzx())
}

/// The axis across which a shape is divided.
struct Axis {
    canonical: CanonicalShape,
    world_from_canonical: DAffine3,
    /// Index of the axis of the canonical space: 0, 1 or 2.
    index: usize,
    /// From one end of the shape to the other.
    way: DVec3,
    /// The fraction of the way at which the canonical origin is.
    origin: f64,
}

impl Axis {
    /// The longest one; `None` for shapes that are not divided.
    fn of(geometry: &Geometry) -> Option<Self> {
        let &Geometry::Placed {
            canonical,
            world_from_canonical,
        } = geometry
        else {
            return None;
        };
        let column = |index| world_from_canonical.matrix3.col(index);
        let longer = |a: usize, b: usize| match column(a).length() < column(b).length() {
            true => b,
            false => a,
        };
        let (index, origin) = match canonical {
            CanonicalShape::Cone { .. } => (1, 0.0),
            CanonicalShape::Rectangle => (longer(0, 2), 0.5),
            CanonicalShape::Box => (longer(longer(0, 1), 2), 0.5),
            _ => return None,
        };
        Some(Self {
            canonical,
            world_from_canonical,
            index,
            way: column(index) / (1.0 - origin),
            origin,
        })
    }

    /// The part of the shape between two fractions of the way.
    fn slice(&self, [from, to]: [f64; 2]) -> Geometry {
        let mut canonical = self.canonical;
        if let CanonicalShape::Cone { bottom, top, .. } = &mut canonical {
            let radius = |at: f64| *bottom + (*top - *bottom) * at;
            (*bottom, *top) = (radius(from), radius(to));
        }
        let size = to - from;
        let mut world_from_canonical = self.world_from_canonical;
        *world_from_canonical.matrix3.col_mut(self.index) *= size;
        world_from_canonical.translation += self.way * (from - self.origin * (1.0 - size));
        Geometry::Placed {
            canonical,
            world_from_canonical,
        }
    }
}
