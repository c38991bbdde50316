//! The overrides of `kernels/debug_view.wesl`.

use super::settings::{Integrator, Settings};
use crate::{
    layout::{VIEW_DEPTH, VIEW_HEAT, VIEW_IDS, VIEW_NORMALS},
    pack::PackedScene,
};

/// Those of the Whitted kernel and which view to show. It counts no rays.
pub fn overrides(scene: &PackedScene, settings: &Settings) -> Vec<(&'static str, f64)> {
    let view = match settings.integrator {
        Integrator::Depth => VIEW_DEPTH,
        Integrator::Ids => VIEW_IDS,
        Integrator::Heat => VIEW_HEAT,
        Integrator::Normals | Integrator::Whitted => VIEW_NORMALS,
    };
    let mut overrides = super::whitted::overrides(scene, settings, true);
    overrides.push(("9", f64::from(view)));
    overrides
}
