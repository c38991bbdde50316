//! Estimates the work of one sample of a pixel in advance: a submission cannot do less than one sample of one
//! workgroup, and drivers reset a GPU that takes too long.

use super::{FilmError, Integrator, RenderError, RenderSettings, task::Task};
use crate::{
    layout::LIGHT_RECTANGLE,
    pack::{PackedScene, PackedView},
};
use std::fmt;

/// Maximum number of shadow rays from one point, which is also the maximum that a single light of any format
/// may request. For this many a GPU takes a good part of a second in a single lane.
pub const MAX_SHADOW_RAYS: u64 = 1 << 16;

/// More rays than this can exceed a driver's loop limit on their own.
const MANY_RAYS: u64 = 512;
/// More primitives than this can, if every ray tests all of them.
const MANY_PRIMITIVES: u64 = 4096;

/// Why a sample exceeds the loop limit of a driver.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum LongPath {
    /// Every ray tests all primitives.
    BruteForce {
        /// Triangles and shapes, instances not counted.
        primitives: u64,
    },
    /// Many shadow rays.
    ShadowRays {
        /// Number of lights.
        lights: u64,
        /// Shadow rays from every hit point.
        rays: u64,
    },
    /// Reflected and refracted rays.
    Depth {
        /// Maximum number of bounces of a path.
        bounces: u32,
    },
    /// No other reason: rays hit the boxes of very many primitives.
    Crowded,
}

impl LongPath {
    /// The most likely cause.
    pub fn of(scene: &PackedScene, view: &PackedView, settings: &RenderSettings) -> Self {
        let primitives = (scene.triangles.len() + scene.shapes.len()) as u64;
        let shadow = shadow_rays(view, settings);
        let bounces = bounces(scene, settings);
        let tree = match scene.features.reflection && scene.features.refraction {
            true => 2_u64.saturating_pow(bounces.saturating_add(1)),
            false => u64::from(bounces) + 1,
        };
        let rays = tree.saturating_mul(1 + shadow);
        let is_exhaustive = settings.brute_force || settings.integrator == Integrator::Lecture;
        if is_exhaustive && primitives.saturating_mul(rays) > MANY_PRIMITIVES {
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

/// Shadow rays from the hit point of a camera ray: one for each light, or for each sample of an area light.
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

/// Whether surfaces send rays on.
pub fn has_trees(scene: &PackedScene, settings: &RenderSettings) -> bool {
    let features = &scene.features;
    let bends = features.reflection || features.refraction;
    features.coverage || bends && settings.max_depth > 0
}

/// Whether the ray trees of [`Integrator::Whitted`] differ in size, but hardly the work of each ray: lights with several samples
/// take fewer of them for weaker rays.
pub fn has_uneven_trees(task: Task) -> bool {
    task.settings.integrator == Integrator::Whitted
        && has_trees(task.scene, task.settings)
        && shadow_rays(task.view, task.settings) <= u64::from(task.view.frame.light_count)
}

/// The rays of `picture_count` pictures if every camera ray hits an opaque surface.
pub fn least_rays(view: &PackedView, settings: &RenderSettings, picture_count: u32) -> u64 {
    let [.., width, height] = settings.region();
    let pixels = u64::from(width) * u64::from(height);
    let of_pixel = shadow_rays(view, settings).saturating_add(1);
    let of_picture = (pixels * u64::from(settings.samples)).saturating_mul(of_pixel);
    of_picture.saturating_mul(u64::from(picture_count))
}

/// Rejects lights that need too many shadow rays from one point, and sample ranges with adaptive sampling,
/// where they are not known in advance.
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

/// Maximum number of bounces of a path.
fn bounces(scene: &PackedScene, settings: &RenderSettings) -> u32 {
    let sends_on = scene.features.reflection || scene.features.refraction;
    match sends_on && settings.integrator.entry().is_lit {
        true => settings.max_depth,
        false => 0,
    }
}
