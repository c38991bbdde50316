//! Pipelines of the kernels that trace rays.

use super::{layouts::Layouts, overrides, policy::Fetch, task::Task};
use crate::gpu::{Compiled, Gpu, GpuError, Kernel, Overrides, Variant};

/// The number of materials from which on packet kernels cannot store their indices in 16 bits.
const MAX_PACKET_MATERIALS: usize = 0xffff;

/// A pipeline for bind groups 0 to 2 of the kernel of the task's integrator.
pub fn rendering(
    gpu: &Gpu,
    fetch: Fetch,
    layouts: &Layouts,
    task: Task,
) -> Result<Compiled, GpuError> {
    let kernel = task.settings.integrator.entry().kernel;
    let variant = match kernel.has(Variant::Packet) && gpu.traces_packets() && suits_packets(task) {
        true => Variant::Packet,
        false => variant_of(fetch),
    };
    tracing(gpu, variant, layouts, kernel, overrides::of(task))
}

/// A pipeline for bind groups 0 to 2 of the portable variant of a kernel, specialised by these overrides.
pub fn portable(
    gpu: &Gpu,
    fetch: Fetch,
    layouts: &Layouts,
    kernel: Kernel,
    overrides: Overrides,
) -> Result<Compiled, GpuError> {
    tracing(gpu, variant_of(fetch), layouts, kernel, overrides)
}

fn tracing(
    gpu: &Gpu,
    variant: Variant,
    layouts: &Layouts,
    kernel: Kernel,
    overrides: Overrides,
) -> Result<Compiled, GpuError> {
    let groups = [&layouts.scene, &layouts.frame, &layouts.film].map(Some);
    gpu.pipeline(&kernel, variant, &groups, overrides)
}

fn variant_of(fetch: Fetch) -> Variant {
    match fetch {
        Fetch::Image => Variant::Image,
        _ => Variant::Buffer,
    }
}

/// Whether all rays of a packet can share nodes: nothing moves while the shutter is open.
fn suits_packets(task: Task) -> bool {
    let Task {
        scene,
        view,
        settings,
        policy,
        ..
    } = task;
    policy.fetch == Fetch::Auto
        && !settings.brute_force
        && !view.has_moving_instances()
        && view.frame.light_key_count == 1
        && scene.materials.len() < MAX_PACKET_MATERIALS
}
