//! How much work one sample of a pixel may be, as far as it is known before: a submission cannot do less
//! than one sample of one group, and drivers reset a GPU that takes too long over one.

use super::{FilmError, RenderError, RenderSettings};
use crate::{
    layout::LIGHT_RECTANGLE,
    pack::{PackedScene, PackedView},
};
use std::fmt;

/// Most shadow rays from one point: what one light of any format may ask for. In a lane of its own a GPU
/// takes a good part of a second for so many.
pub const MAX_SHADOW_RAYS: u64 = 1 << 16;

/// More rays than this can end a driver's loops without anything else that is unusual.
const MANY_RAYS: u64 = 512;
/// More primitives than this can, if every ray tests all of them.
const MANY_PRIMITIVES: u64 = 4096;

/// What makes a sample too much work for the loops of a driver.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum LongPath {
    /// Every ray tests all primitives.
    BruteForce {
        /// Triangles and shapes, instances not counted.
        primitives: u64,
    },
    /// The lights.
    ShadowRays {
        /// Of all lights.
        lights: u64,
        /// From every point that a ray meets.
        rays: u64,
    },
    /// Mirrored and refracted rays.
    Depth {
        /// The most that lead to a ray.
        bounces: u32,
    },
    /// Nothing of these: rays meet the boxes of very many primitives.
    Crowded,
}

impl LongPath {
    /// What it most likely is.
    pub fn of(scene: &PackedScene, view: &PackedView, settings: &RenderSettings) -> Self {
        let primitives = (scene.triangles.len() + scene.shapes.len()) as u64;
        let shadow = shadow_rays(view, settings);
        let bounces = bounces(scene, settings);
        let tree = match scene.features.reflection && scene.features.refraction {
            true => 2_u64.saturating_pow(bounces.saturating_add(1)),
            false => u64::from(bounces) + 1,
        };
        let rays = tree.saturating_mul(1 + shadow);
        if settings.brute_force && primitives.saturating_mul(rays) > MANY_PRIMITIVES {
            Self::BruteForce { primitives }
        } else if rays <= MANY_RAYS {
            Self::Crowded
        } else if shadow > u64::from(bounces) {
            Self::ShadowRays {
                lights: u64::from(view.frame.light_count),
                rays: shadow,
            }
        } else {
            Self::Depth { bounces }
        }
    }
}

impl fmt::Display for LongPath {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        match self {
            Self::BruteForce { primitives } => {
                write!(f, "every ray tests {primitives} primitives")
            }
            Self::ShadowRays { lights, rays } => {
                write!(f, "{lights} lights, {rays} shadow rays from each point")
            }
            Self::Depth { bounces } => write!(f, "up to {bounces} bounces"),
            Self::Crowded => write!(
                f,
                "very many surfaces in one place, such as coincident triangles"
            ),
        }
    }
}

/// Shadow rays from one point that a camera ray meets: one for each light, or for each of its samples.
pub fn shadow_rays(view: &PackedView, settings: &RenderSettings) -> u64 {
    if !view.has_lights || !settings.integrator.entry().is_lit {
        return 0;
    }
    // As in `scene/direct.wesl`.
    let of = |kind: u32, samples: u32| match kind >= LIGHT_RECTANGLE {
        true => (f64::from(samples) * f64::from(settings.light_samples)).round() as u64,
        false => 1,
    };
    let lights = view.lights.iter().take(view.frame.light_count as usize);
    lights
        .map(|light| of(light.kind, light.sample_count).max(1))
        .fold(0, u64::saturating_add)
}

/// Refuses lights that take too many shadow rays from one point, and ranges of samples that cannot be told
/// before the first ones are there.
pub fn check(view: &PackedView, settings: &RenderSettings) -> Result<(), RenderError> {
    if settings.is_adaptive() && settings.sample_range.is_some() {
        return Err(FilmError::Adaptive.into());
    }
    let rays = shadow_rays(view, settings);
    if rays > MAX_SHADOW_RAYS {
        return Err(RenderError::TooManyShadowRays {
            lights: u64::from(view.frame.light_count),
            rays,
            limit: MAX_SHADOW_RAYS,
        });
    }
    Ok(())
}

/// The most bounces that lead to a ray.
fn bounces(scene: &PackedScene, settings: &RenderSettings) -> u32 {
    let sends_on = scene.features.reflection || scene.features.refraction;
    match sends_on && settings.integrator.entry().is_lit {
        true => settings.max_depth,
        false => 0,
    }
}
