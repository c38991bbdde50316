//! How a surface reflects the light of one lamp, in the terms of Phong's model.

use crate::layout::{PackedRay, RAY_UNTRACED};
use schemars::JsonSchema;
use serde::Serialize;

/// The terms of Phong's model for one light, or for one point of a light with an extent:
/// `L (k_d max(l·n, 0) + k_s max(r·v, 0)^α)` with `r = 2 (l·n) n − l`, and 0 where `l·n` is not above 0.
#[derive(Clone, Debug, PartialEq, Serialize, JsonSchema)]
pub struct PhongTerms {
    /// `L`: linear radiance that arrives without shadow, after fading with distance and a spot's cone.
    pub light: [f32; 3],
    /// `l·n`, the cosine between the direction to the light and the shading normal.
    pub l_dot_n: f32,
    /// `r·v`, the cosine between the mirrored direction to the light and the direction to the eye.
    pub r_dot_v: f32,
    /// `k_d` after textures, less what the surface reflects or transmits.
    pub k_d: [f32; 3],
    /// `k_s`, likewise; 0 if nothing in the scene has highlights.
    pub k_s: [f32; 3],
    /// `α`; 0 if nothing in the scene has highlights.
    pub alpha: f32,
    /// `L k_d max(l·n, 0)`.
    pub diffuse: [f32; 3],
    /// `L k_s max(r·v, 0)^α`, or 0 where `l·n` is not above 0. It adds up with `diffuse` to
    /// [`super::ShadowRay::unshadowed`].
    pub highlight: [f32; 3],
    /// Whether a shadow ray was traced. It is not if the surface reflects nothing of this light.
    pub traced: bool,
}

impl PhongTerms {
    pub(super) fn of(record: &PackedRay) -> Self {
        let is_above = record.own_pdf > 0.0;
        let cosine = if is_above { record.own_pdf } else { 0.0 };
        let power = if is_above { record.chance } else { 0.0 };
        let [light, k_d, k_s] = [record.emission, record.reflect, record.value];
        Self {
            light,
            l_dot_n: record.own_pdf,
            r_dot_v: record.other_pdf,
            k_d,
            k_s,
            alpha: record.pdf,
            diffuse: [0, 1, 2].map(|k| light[k] * k_d[k] * cosine),
            highlight: [0, 1, 2].map(|k| light[k] * k_s[k] * power),
            traced: record.flags & RAY_UNTRACED == 0,
        }
    }
}
