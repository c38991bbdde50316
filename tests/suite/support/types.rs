//! The structs of `shaders/types.wesl` and `shaders/types/` that functions take and return.

use super::verdict::{Expected, Tolerance};
use super::words::shader_struct;
use glimray::layout::{
    NO_INSTANCE, NONE, PackedCamera, PackedKey, PackedLight, PackedShape, PackedTone,
};

pub const T_FAR: f32 = 3e38;

#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Ray {
    pub origin: [f32; 3],
    pub t_max: f32,
    pub direction: [f32; 3],
    pub leaving: u32,
    pub leaving_instance: u32,
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

#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Candidate {
    pub hit: bool,
    pub t: f32,
    pub b1: f32,
    pub b2: f32,
}

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
    pub children: [u32; 4],
}

#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Phong {
    pub diffuse: [f32; 3],
    pub specular: [f32; 3],
    pub shininess: f32,
    pub ambient: [f32; 3],
    pub reflect: [f32; 3],
}

/// Neighbouring texels; see `lib/picture.wesl`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Neighbours {
    pub first: u32,
    pub second: u32,
    pub weight: f32,
}

#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Incident {
    pub direction: [f32; 3],
    pub distance: f32,
    pub radiance: [f32; 3],
}

/// See `lib/motion.wesl`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Moment {
    pub key: u32,
    pub fraction: f32,
}

/// See `lib/motion.wesl`. Matrices are lists of columns; used only as a result.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Space {
    pub translation: [f32; 3],
    pub linear: [[f32; 3]; 3],
    pub inverse: [[f32; 3]; 3],
}

/// See `lib/ray_cone.wesl`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Cone {
    pub width: f32,
    pub spread: f32,
}

/// A point on a canonical surface: see `shaders/lib/canonical.wesl`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CanonicalPoint {
    pub p: [f32; 3],
    pub n: [f32; 3],
    pub uv: [f32; 2],
}

shader_struct!(CanonicalPoint = "package::lib::canonical::CanonicalPoint" { p: [f32; 3], n: [f32; 3], uv: [f32; 2], });
shader_struct!(Cone = "package::types::tracing::Cone" { width: f32, spread: f32, });
shader_struct!(Moment = "package::lib::motion::Moment" { key: u32, fraction: f32, });
shader_struct!(Space = "package::lib::motion::Space" {
    translation: [f32; 3],
    linear: [[f32; 3]; 3],
    inverse: [[f32; 3]; 3],
});
shader_struct!(PackedKey = "package::types::PackedKey" {
    translation: [f32; 3],
    _pad0: u32,
    rotation: [f32; 4],
    stretch: [f32; 3],
    _pad1: u32,
    shear: [f32; 3],
    _pad2: u32,
});
shader_struct!(Ray = "package::types::tracing::Ray" {
    origin: [f32; 3],
    t_max: f32,
    direction: [f32; 3],
    leaving: u32,
    leaving_instance: u32,
});
shader_struct!(Candidate = "package::types::tracing::Candidate" { hit: bool, t: f32, b1: f32, b2: f32, });
shader_struct!(Node = "package::types::tracing::Node" {
    lo: [f32; 3],
    scale: [f32; 3],
    near_x: [f32; 4],
    far_x: [f32; 4],
    near_y: [f32; 4],
    far_y: [f32; 4],
    near_z: [f32; 4],
    far_z: [f32; 4],
    children: [u32; 4],
});
shader_struct!(Phong = "package::types::shading::Phong" {
    diffuse: [f32; 3],
    specular: [f32; 3],
    shininess: f32,
    ambient: [f32; 3],
    reflect: [f32; 3],
});
shader_struct!(Incident = "package::types::shading::Incident" {
    direction: [f32; 3],
    distance: f32,
    radiance: [f32; 3],
});
shader_struct!(Neighbours = "package::lib::picture::Neighbours" {
    first: u32,
    second: u32,
    weight: f32,
});
shader_struct!(PackedCamera = "package::types::PackedCamera" {
    origin: [f32; 3],
    lens_radius: f32,
    forward: [f32; 3],
    focus_distance: f32,
    right: [f32; 3],
    blade_rotation: f32,
    up: [f32; 3],
    blade_count: u32,
});
shader_struct!(PackedLight = "package::types::PackedLight" {
    position: [f32; 3],
    kind: u32,
    direction: [f32; 3],
    attenuation: u32,
    color: [f32; 3],
    cos_inner: f32,
    edge_u: [f32; 3],
    cos_outer: f32,
    edge_v: [f32; 3],
    radius: f32,
    sample_count: u32,
    chance: f32,
    place: u32,
    visible: u32,
});
shader_struct!(PackedShape = "package::types::PackedShape" {
    position: [f32; 3],
    kind: u32,
    row_x: [f32; 3],
    size0: f32,
    row_y: [f32; 3],
    size1: f32,
    row_z: [f32; 3],
    flags: u32,
    material: u32,
    id: u32,
    _pad0: u32,
    _pad1: u32,
});
shader_struct!(PackedTone = "package::types::PackedTone" {
    exposure_scale: f32,
    curve: u32,
    transfer: u32,
    view: u32,
    range: [f32; 2],
    has_range: u32,
    film_rows: u32,
});

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
