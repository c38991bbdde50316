//! The overrides of `kernels/debug_view.wesl`.

use super::{
    device::Task,
    settings::Integrator,
    whitted::{self, Overrides},
};
use crate::layout::{VIEW_DEPTH, VIEW_HEAT, VIEW_IDS, VIEW_NORMALS, VIEW_UV};

/// Those of every tracing kernel, and which view to show.
pub fn overrides(task: Task) -> Overrides {
    let view = match task.settings.integrator {
        Integrator::Depth => VIEW_DEPTH,
        Integrator::Ids => VIEW_IDS,
        Integrator::Heat => VIEW_HEAT,
        Integrator::Uv => VIEW_UV,
        Integrator::Normals | Integrator::Whitted | Integrator::Samples => VIEW_NORMALS,
    };
    let mut overrides = whitted::tracing(task);
    overrides.push(("VIEW", f64::from(view)));
    overrides
}
