//! The overrides of `kernels/debug_view.wesl`.

use super::{device::Task, settings::Integrator, whitted};
use crate::layout::{VIEW_DEPTH, VIEW_HEAT, VIEW_IDS, VIEW_NORMALS};

/// Those of the Whitted kernel and which view to show. It counts no rays.
pub fn overrides(task: Task) -> Vec<(&'static str, f64)> {
    let view = match task.settings.integrator {
        Integrator::Depth => VIEW_DEPTH,
        Integrator::Ids => VIEW_IDS,
        Integrator::Heat => VIEW_HEAT,
        Integrator::Normals | Integrator::Whitted => VIEW_NORMALS,
    };
    let mut overrides = whitted::overrides(task, true);
    overrides.push(("9", f64::from(view)));
    overrides
}
