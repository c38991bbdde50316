//! Pipelines of the kernels that trace rays.

use super::{
    Integrator, effort,
    layouts::Layouts,
    overrides,
    policy::{ExecutionPolicy, Fetch, Stack},
    settings::RenderSettings,
    task::Task,
};
use crate::{
    gpu::{Compiled, EarlyModule, Gpu, GpuError, Kernel, Overrides, Variant},
    pack::{PackedScene, PackedView},
};
use std::sync::Arc;
use wgpu::{BindGroupLayout, ComputePipeline};

/// The number of materials from which on packet kernels cannot store their indices in 16 bits.
const MAX_PACKET_MATERIALS: usize = 0xffff;

/// Minimum ray count at which packets amortise their longer compile time: among triangles, and among shapes, for which they
/// save a quarter of that.
const MIN_PACKET_RAYS: u64 = 2_000_000;
const MIN_PACKET_RAYS_OF_SHAPES: u64 = 10_000_000;

/// Samples of a lane whose ray trees differ in size. They share the 65,535 rounds of a loop of Mesa 22.3, and have at most
/// 1,024 rays each.
const TREES_PER_LANE: u32 = 4;

/// The kernel of a task, and how it is specialised.
struct TaskKernel {
    kernel: Kernel,
    variant: Variant,
    overrides: Overrides,
    /// The samples that its lanes should take one after the other.
    lane_samples: u32,
}

impl TaskKernel {
    /// `packets` gives the variant for rays that are worth packets.
    fn new(task: Task, fetch: Fetch, packets: impl FnOnce() -> Variant) -> Self {
        let kernel = task.settings.integrator.entry().kernel;
        let as_packets = match task.policy.fetch {
            Fetch::Auto => least_rays(task) >= min_packet_rays(task) && !waits_for_few_lanes(task),
            fetch => fetch.allows_packets(),
        };
        let as_packets = as_packets
            && !task.settings.brute_force
            && !task.settings.has_features()
            && task.scene.materials.len() < MAX_PACKET_MATERIALS;
        let variant = match as_packets && kernel.has(Variant::Packet) {
            true => packets(),
            false => portable(fetch),
        };
        // Lanes of a vector wait for the largest of their trees, unless each has several. GPUs have not been measured.
        let refills = variant == Variant::Image && effort::has_uneven_trees(task);
        let mut overrides = overrides::of(task);
        overrides.extend(overrides::REFILLS_LANES(refills));
        Self {
            kernel,
            variant,
            overrides,
            lane_samples: if refills { TREES_PER_LANE } else { 1 },
        }
    }
}

/// A pipeline for bind groups 0 to 2 of the kernel of the task's integrator, and the samples that its lanes should take one
/// after the other.
pub fn rendering(
    gpu: &Gpu,
    fetch: Fetch,
    layouts: &Layouts,
    task: Task,
) -> Result<(Compiled, u32), GpuError> {
    let packets = || tracing_variant(gpu, fetch, task.view);
    let TaskKernel {
        kernel,
        variant,
        overrides,
        lane_samples,
    } = TaskKernel::new(task, fetch, packets);
    let kernel = (kernel, task.policy.stack);
    let compiled = tracing(gpu, variant, layouts, kernel, overrides)?;
    Ok((compiled, lane_samples))
}

/// Starts to make the module of the kernel for a picture, as lavapipe needs it, while the device is being opened; for
/// [`Gpu::with_early_module`]. `None` if rays will be traced in packets, whose kernel depends on the adapter.
pub fn early_module(
    scene: &Arc<PackedScene>,
    view: &PackedView,
    settings: &RenderSettings,
    policy: &ExecutionPolicy,
) -> Option<EarlyModule> {
    let task = Task {
        scene,
        view,
        settings,
        policy,
        film_rows: 0,
    };
    let wanted = TaskKernel::new(task, Fetch::Image, || Variant::Packet);
    if wanted.variant == Variant::Packet {
        return None;
    }
    let kernel = (wanted.kernel, policy.stack);
    let overrides = with_stack(wanted.overrides, kernel, true);
    EarlyModule::start(wanted.kernel, wanted.variant, overrides)
}

/// A pipeline of a kernel with a stack of this size, specialised by these overrides.
pub fn tracing(
    gpu: &Gpu,
    variant: Variant,
    layouts: &Layouts,
    (kernel, stack): (Kernel, Stack),
    overrides: Overrides,
) -> Result<Compiled, GpuError> {
    let mut overrides = with_stack(overrides, (kernel, stack), gpu.is_cpu());
    if let (Variant::Packet, Some(lanes)) = (variant, gpu.packet_lanes()) {
        overrides.extend(overrides::PACKET_LANES(lanes));
    }
    let groups = [&layouts.scene, &layouts.frame, &layouts.film].map(Some);
    gpu.pipeline(&kernel, variant, &groups, overrides)
}

/// The overrides with the place of the stack. In workgroup memory it is faster than in an array, where scenes are in buffers:
/// software adapters store elements of arrays lane by lane. On an H200 ray queries are up to 1.2 times as fast with an array,
/// but renders up to 2.5 times as fast with workgroup memory.
fn with_stack(
    mut overrides: Overrides,
    (kernel, stack): (Kernel, Stack),
    is_cpu: bool,
) -> Overrides {
    let is_faster = is_cpu || kernel.name != Kernel::TRACE_RAYS.name;
    let is_shared = stack == Stack::Usual && is_faster;
    overrides.extend(overrides::WORKGROUP_STACK(is_shared));
    overrides
}

/// A pipeline of a kernel that reads the film, with the layout of its target as bind group 3.
pub fn developing(
    gpu: &Gpu,
    layouts: &Layouts,
    kernel: Kernel,
    target: &BindGroupLayout,
    overrides: Overrides,
) -> Result<ComputePipeline, GpuError> {
    let groups = [
        None,
        Some(&layouts.frame),
        Some(&layouts.film),
        Some(target),
    ];
    let compiled = gpu.pipeline(&kernel, Variant::Buffer, &groups, overrides)?;
    Ok(compiled.pipeline)
}

/// A pipeline of a kernel of the denoiser, with this layout of bind group 3.
pub fn denoising(
    gpu: &Gpu,
    (kernel, variant): (Kernel, Variant),
    layout: &BindGroupLayout,
    overrides: Overrides,
) -> Result<ComputePipeline, GpuError> {
    let groups = [None, None, None, Some(layout)];
    let compiled = gpu.pipeline(&kernel, variant, &groups, overrides)?;
    Ok(compiled.pipeline)
}

/// The variant that does not depend on the adapter.
pub fn portable(fetch: Fetch) -> Variant {
    match fetch {
        Fetch::Image => Variant::Image,
        _ => Variant::Buffer,
    }
}

/// Packets if the adapter traces them, the data are in images, nothing moves while the shutter is open, and no section plane
/// cuts rays: then the rays of a packet can share nodes.
pub fn tracing_variant(gpu: &Gpu, fetch: Fetch, view: &PackedView) -> Variant {
    let is_still =
        !view.has_moving_instances() && !view.deforms() && view.frame.light_key_count == 1;
    let is_alike = is_still && !view.has_section();
    match fetch == Fetch::Image && is_alike && gpu.traces_packets() {
        true => Variant::Packet,
        false => portable(fetch),
    }
}

/// Whether lanes of packets would wait so long for the largest of their ray trees that rays are faster alone: among shapes, and
/// where rays deep in a tree sample lights less often. Other trees among triangles are up to 1.5 times as fast in packets.
fn waits_for_few_lanes(task: Task) -> bool {
    let is_uneven = effort::has_uneven_trees(task);
    let has_trees = effort::has_trees(task.scene, task.settings);
    match task.settings.integrator {
        Integrator::Whitted if has_trees => overrides::has_mostly_shapes(task.scene) || !is_uneven,
        _ => false,
    }
}

fn min_packet_rays(task: Task) -> u64 {
    match overrides::has_mostly_shapes(task.scene) {
        true => MIN_PACKET_RAYS_OF_SHAPES,
        false => MIN_PACKET_RAYS,
    }
}

fn least_rays(task: Task) -> u64 {
    effort::least_rays(task.view, task.settings, task.policy.picture_count)
}

#[cfg(test)]
mod tests {
    use super::{MIN_PACKET_RAYS, least_rays, waits_for_few_lanes};
    use crate::{ExecutionPolicy, RenderSettings, pack, task::Task};
    use glam::{DAffine3, DVec3, Vec3};
    use glimray_scene::{
        Camera, Geometry, Instance, Light, LightKind, Material, Mesh, Phong, Scene, Shape,
    };
    use std::sync::Arc;

    /// The result of `find` for a render of the scene's first frame.
    fn of_task<T>(
        scene: &Scene,
        settings: &RenderSettings,
        policy: &ExecutionPolicy,
        find: impl Fn(Task) -> T,
    ) -> T {
        let packed = Arc::new(pack::scene(scene).expect("a packed scene"));
        let view = packed.frame(&scene.frame(0.0)).expect("a packed frame");
        find(Task {
            scene: &packed,
            view: &view,
            settings,
            policy,
            film_rows: 1,
        })
    }

    #[test]
    fn small_pictures_are_worth_packets_if_there_are_many() {
        let scene = Scene {
            cameras: vec![Camera::default()],
            ..Scene::default()
        };
        let settings = RenderSettings {
            size: (100, 100),
            samples: 1,
            ..RenderSettings::default()
        };
        let are_worth_it = |picture_count| {
            let policy = ExecutionPolicy {
                picture_count,
                ..ExecutionPolicy::default()
            };
            of_task(&scene, &settings, &policy, least_rays) >= MIN_PACKET_RAYS
        };
        assert!(!are_worth_it(1) && !are_worth_it(199) && are_worth_it(200));
    }

    /// A mirror in the light of a lamp that takes so many shadow rays.
    fn mirror(reflect: f32, is_sphere: bool, lamp_rays: u32) -> Scene {
        let mut scene = Scene {
            cameras: vec![Camera::default()],
            materials: vec![Material::from(Phong {
                reflect: Vec3::splat(reflect),
                ..Phong::default()
            })],
            lights: vec![Light {
                kind: LightKind::Sphere {
                    center: DVec3::Y,
                    radius: 0.1,
                },
                color: Vec3::ONE,
                samples: lamp_rays,
                ..Light::default()
            }],
            ..Scene::default()
        };
        if is_sphere {
            scene.shapes.push(Shape {
                geometry: Geometry::Sphere {
                    center: DVec3::NEG_Z,
                    radius: 0.5,
                },
                material: 0,
                node: None,
                name: String::new(),
            });
        } else {
            let mesh = Mesh {
                positions: vec![Vec3::ZERO, Vec3::X, Vec3::Y],
                normals: vec![Vec3::Z; 3],
                triangles: vec![[0, 1, 2]],
                materials: vec![0; 3],
                ..Mesh::default()
            };
            scene.meshes.push(mesh.into());
            scene.instances.push(Instance {
                mesh: 0,
                placement: DAffine3::IDENTITY,
                node: None,
                name: String::new(),
            });
        }
        scene
    }

    #[test]
    fn packets_are_not_for_uneven_trees_among_spheres_or_with_several_rays_to_a_lamp() {
        let waits = |scene: &Scene, max_depth| {
            let settings = RenderSettings {
                max_depth,
                ..RenderSettings::default()
            };
            of_task(
                scene,
                &settings,
                &ExecutionPolicy::default(),
                waits_for_few_lanes,
            )
        };
        // The reflected share, whether it is a sphere or a triangle, rays to the lamp, bounces.
        for (reflect, is_sphere, lamp_rays, max_depth, expected) in [
            (0.5, true, 1, 5, true),
            (0.0, true, 1, 5, false),
            (0.5, true, 1, 0, false),
            (0.5, false, 1, 5, false),
            (0.5, false, 16, 5, true),
            (0.0, false, 16, 5, false),
        ] {
            let scene = mirror(reflect, is_sphere, lamp_rays);
            let row = (reflect, is_sphere, lamp_rays, max_depth);
            assert_eq!(waits(&scene, max_depth), expected, "{row:?}");
        }
    }
}
