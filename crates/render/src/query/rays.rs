//! Rays of a query, what is asked of them, and what is found.

use crate::layout::NONE;
use glam::{DVec3, Vec3};

/// A ray in world space.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct QueryRay {
    /// Origin, finite.
    pub origin: DVec3,
    /// Direction, of unit length.
    pub direction: Vec3,
    /// Surfaces at this distance or beyond are ignored, in scene units. [`QueryRay::FAR`] has no limit.
    pub t_max: f32,
    /// Time in the shutter interval of the view, from 0 to 1; matters only if instances move.
    pub time: f32,
}

impl QueryRay {
    /// A `t_max` beyond every scene.
    pub const FAR: f32 = 3e38;

    /// A ray without a limit, at the time when the shutter opens.
    pub fn new(origin: DVec3, direction: Vec3) -> Self {
        Self {
            origin,
            direction,
            t_max: Self::FAR,
            time: 0.0,
        }
    }

    /// The two rows that the shader reads; it traces in render space, whose origin is `origin` in world space.
    pub(super) fn rows(&self, origin: DVec3) -> [[f32; 4]; 2] {
        let [x, y, z] = (self.origin - origin).as_vec3().to_array();
        let [dx, dy, dz] = self.direction.to_array();
        [[x, y, z, self.t_max], [dx, dy, dz, self.time]]
    }
}

/// The closest hit of a ray. [`crate::pack::PackedScene::object_at`] returns the object with these indices.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct QueryHit {
    /// Distance along the ray, above 0 and below its `t_max`, in scene units.
    pub t: f32,
    /// Index of the triangle in [`crate::pack::PackedScene::triangles`], or [`crate::layout::SHAPE`] with the index of
    /// a shape.
    pub primitive: u32,
    /// Index of an instance of the view, or [`crate::layout::NO_INSTANCE`].
    pub instance: u32,
    /// Barycentric weights of the second and third corner of a triangle, rounded to 16 bits. Meaningless for
    /// shapes.
    pub weights: [f32; 2],
}

impl QueryHit {
    pub(super) fn of([t, primitive, instance, weights]: [u32; 4]) -> Option<Self> {
        let weight = |bits: u32| (bits & 0xffff) as f32 / 65_535.0;
        (primitive != NONE).then(|| Self {
            t: f32::from_bits(t),
            primitive,
            instance,
            weights: [weight(weights), weight(weights >> 16)],
        })
    }
}

/// The traversal steps of a ray that is traced alone, or of a packet of rays.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct RaySteps {
    /// Nodes visited, in the TLAS and in BLASes.
    pub nodes: u32,
    /// Triangles and shapes tested, without planes.
    pub primitives: u32,
}

/// The question that a query answers.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum RayTest {
    /// The closest hit.
    Closest,
    /// Whether there is any hit.
    Any,
}

/// How much the rays of a batch that follow each other have in common. It affects the speed, not the result.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Coherence {
    /// They start close to each other or go to the same place, such as camera rays of neighbouring pixels, or shadow rays
    /// from them: adapters that can do so trace them in packets ([`crate::gpu::Gpu::traces_packets`]).
    #[default]
    Coherent,
    /// They visit different parts of the scene: each is traced alone.
    Incoherent,
}
