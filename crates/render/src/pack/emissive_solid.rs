//! Where emissive shapes are, and the areas of those that are curved or have several sides.

use crate::layout::{
    PackedShape, SHAPE_BOX, SHAPE_CAPPED, SHAPE_CONE, SHAPE_GLOBE, SHAPE_PLANE, SHAPE_SPHERE,
    SHAPE_TORUS,
};
use glam::{DVec3, Mat3, Vec3, vec3};
use std::f32::consts::PI;

/// A shape where it is canonical, and its transform to render space or to the space of its BLAS.
#[derive(Clone, Copy, Debug)]
pub struct EmissiveSolid {
    /// The image of the origin.
    pub center: Vec3,
    /// The images of x, y and z.
    pub columns: Mat3,
    kind: u32,
    sizes: [f32; 2],
    is_capped: bool,
}

impl EmissiveSolid {
    /// `None` for planes and globes, which are not sampled.
    pub fn of(shape: &PackedShape) -> Option<Self> {
        let rows = [shape.row_x, shape.row_y, shape.row_z];
        Some(Self {
            center: shape.position.into(),
            columns: match shape.kind {
                SHAPE_PLANE | SHAPE_GLOBE => return None,
                SHAPE_SPHERE => Mat3::from_diagonal(Vec3::splat(shape.size0)),
                _ => Mat3::from_cols_array_2d(&rows).transpose().inverse(),
            },
            kind: shape.kind,
            sizes: [shape.size0, shape.size1],
            is_capped: shape.flags & SHAPE_CAPPED != 0,
        })
    }

    /// The corners of a box around it.
    pub fn corners(&self) -> Vec<DVec3> {
        let (min, max) = match self.kind {
            SHAPE_CONE => (vec3(-1.0, 0.0, -1.0), Vec3::ONE),
            SHAPE_TORUS => {
                let [minor, _] = self.sizes;
                let reach = vec3(1.0 + minor, minor, 1.0 + minor);
                (-reach, reach)
            }
            _ => (Vec3::NEG_ONE, Vec3::ONE),
        };
        let corner = |index: u32| {
            let at = |axis: u32| [min, max][(index >> axis & 1) as usize][axis as usize];
            (self.center + self.columns * vec3(at(0), at(1), at(2))).as_dvec3()
        };
        (0..8).map(corner).collect()
    }

    /// The area after a transform: the sum of `areas_of` in `scene/shape_placement.wesl`.
    pub fn area(&self, linear: Mat3) -> f32 {
        let [x, y, z] = [0, 1, 2].map(|axis| linear * self.columns.col(axis));
        // The areas of the images of unit areas across x, y and z.
        let factors = vec3(
            y.cross(z).length(),
            z.cross(x).length(),
            x.cross(y).length(),
        );
        let squares = factors * factors;
        let [first, second] = self.sizes;
        match self.kind {
            SHAPE_BOX => 8.0 * factors.element_sum(),
            SHAPE_CONE => {
                let slope = second - first;
                let around = 0.5 * (squares.x + squares.z) + slope * slope * squares.y;
                let ends = match self.is_capped {
                    true => first * first + second * second,
                    false => 0.0,
                };
                PI * ((first + second) * around.sqrt() + ends * factors.y)
            }
            SHAPE_TORUS => {
                4.0 * PI * PI * first * (0.25 * (squares.x + squares.z) + 0.5 * squares.y).sqrt()
            }
            _ => 4.0 * PI * (squares.element_sum() / 3.0).sqrt(),
        }
    }
}
