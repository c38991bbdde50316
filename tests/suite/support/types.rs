//! The structs of `shaders/types.wesl` and `shaders/types/` that functions take and return.

use super::verdict::{Expected, Tolerance};
use glimray::layout::{NO_INSTANCE, NONE};
use glimray_shader_test::shader_struct;

pub const T_FAR: f32 = 3e38;

shader_struct! {
    #[derive(Clone, Copy, Debug, PartialEq)]
    pub struct Ray {
        pub origin: [f32; 3],
        pub t_max: f32,
        pub direction: [f32; 3],
        pub leaving: u32,
        pub leaving_instance: u32,
    }
}

/// A ray of unlimited length.
pub fn ray(origin: [f32; 3], direction: [f32; 3]) -> Ray {
    Ray {
        origin,
        t_max: T_FAR,
        direction,
        leaving: NONE,
        leaving_instance: NO_INSTANCE,
    }
}

shader_struct! {
    #[derive(Clone, Copy, Debug, PartialEq)]
    pub struct Candidate {
        pub hit: bool,
        pub t: f32,
        pub b1: f32,
        pub b2: f32,
    }
}

shader_struct! {
    #[derive(Clone, Copy, Debug, PartialEq)]
    pub struct Node {
        pub lo: [f32; 3],
        pub scale: [f32; 3],
        pub near_x: [f32; 4],
        pub far_x: [f32; 4],
        pub near_y: [f32; 4],
        pub far_y: [f32; 4],
        pub near_z: [f32; 4],
        pub far_z: [f32; 4],
        pub child_count: u32,
    }
}

shader_struct! {
    #[derive(Clone, Copy, Debug, PartialEq)]
    pub struct Phong {
        pub diffuse: [f32; 3],
        pub specular: [f32; 3],
        pub shininess: f32,
        pub ambient: [f32; 3],
        pub reflect: [f32; 3],
    }
}

shader_struct! {
    /// Neighbouring texels; see `lib/picture.wesl`.
    #[derive(Clone, Copy, Debug, PartialEq)]
    pub struct Neighbours {
        pub first: u32,
        pub second: u32,
        pub weight: f32,
    }
}

shader_struct! {
    #[derive(Clone, Copy, Debug, PartialEq)]
    pub struct Incident {
        pub direction: [f32; 3],
        pub distance: f32,
        pub radiance: [f32; 3],
    }
}

shader_struct! {
    /// See `lib/motion.wesl`.
    #[derive(Clone, Copy, Debug, PartialEq)]
    pub struct Moment {
        pub key: u32,
        pub fraction: f32,
    }
}

shader_struct! {
    /// See `lib/motion.wesl`. Matrices are lists of columns; used only as a result.
    #[derive(Clone, Copy, Debug, PartialEq)]
    pub struct Space {
        pub translation: [f32; 3],
        pub linear: [[f32; 3]; 3],
        pub inverse: [[f32; 3]; 3],
    }
}

shader_struct! {
    /// See `lib/ray_cone.wesl`.
    #[derive(Clone, Copy, Debug, PartialEq)]
    pub struct Cone {
        pub width: f32,
        pub spread: f32,
    }
}

shader_struct! {
    /// A point on a canonical surface: see `shaders/lib/canonical.wesl`.
    #[derive(Clone, Copy, Debug, PartialEq)]
    pub struct CanonicalPoint {
        pub p: [f32; 3],
        pub n: [f32; 3],
        pub uv: [f32; 2],
    }
}

/// The distance of a hit.
impl Expected for Option<f64> {
    type Got = Candidate;
    fn is_met(&self, got: &Candidate, tolerance: Tolerance) -> bool {
        got.hit == self.is_some() && self.is_none_or(|t| tolerance.allows(got.t, t))
    }
}

/// Distance and barycentric weights of a hit.
impl Expected for Option<[f64; 3]> {
    type Got = Candidate;
    fn is_met(&self, got: &Candidate, tolerance: Tolerance) -> bool {
        let hit = |expected: &[f64; 3]| expected.is_met(&[got.t, got.b1, got.b2], tolerance);
        got.hit == self.is_some() && self.as_ref().is_none_or(hit)
    }
}
