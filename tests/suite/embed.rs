//! The renderer embedded in another program: it waits only on request, and the device stays with the program.

use crate::explain::{finish, project_scenes};
use crate::reference::compare::{assert_none, check_same_bits, open_gpu, sized};
use crate::reference::scenes;
use eframe::wgpu;
use glimray::gpu::{AdapterChoice, Gpu, GpuError};
use glimray::image::Image;
use glimray::pack::{self, PackedScene, PackedView};
use glimray::render::{
    Antialias, ExecutionPolicy, QueryRay, RayQuery, RenderError, RenderSettings, Renderer, Slicing,
    Status, Storage, Tone,
};
use std::sync::Arc;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::time::Duration;

fn everything() -> (Arc<PackedScene>, PackedView) {
    let scene = scenes::everything();
    let packed = Arc::new(pack::scene(&scene).expect("packed"));
    let view = packed.frame(&scene.frame(0.0)).expect("a view");
    (packed, view)
}

fn settings() -> RenderSettings {
    RenderSettings {
        samples: 6,
        antialias: Antialias::Stratified,
        ..sized(48, 36)
    }
}

/// With many small submissions.
fn policy(host_copy: bool) -> ExecutionPolicy {
    let slicing = Slicing {
        max_groups: 7,
        max_samples: 2,
        ..Slicing::default()
    };
    ExecutionPolicy {
        host_copy,
        slicing,
        ..ExecutionPolicy::default()
    }
}

fn renderer(gpu: Gpu, policy: ExecutionPolicy) -> Renderer {
    let (packed, view) = everything();
    Renderer::new(gpu, packed, &view, settings(), policy).expect("a renderer")
}

/// The picture of a renderer that waits at each step.
fn waited_for() -> Image {
    let gpu = Gpu::new(&AdapterChoice::default()).expect("a device");
    let mut renderer = renderer(gpu, policy(true));
    while !renderer.is_done() {
        renderer.step().expect("a step");
    }
    renderer.develop(&Tone::LINEAR).expect("a picture")
}

/// Renders to the end without waiting. Returns how often the GPU was busy.
fn poll_to_the_end(renderer: &mut Renderer) -> usize {
    let mut working = 0;
    loop {
        match renderer.poll().expect("a status") {
            Status::Done => return working,
            Status::Ready => renderer.submit().expect("submitted"),
            Status::Working => {
                working += 1;
                std::thread::sleep(Duration::from_micros(200));
            }
        }
    }
}

#[test]
fn polling_gives_the_picture_that_waiting_gives() {
    let expected = waited_for();
    for host_copy in [true, false] {
        let gpu = Gpu::new(&AdapterChoice::default()).expect("a device");
        let name = format!("host copy {host_copy}");
        // Each submission is so short that it may be done when it is first asked for.
        let was_working = (0..100).any(|_| {
            let mut renderer = renderer(gpu.clone(), policy(host_copy));
            let working = poll_to_the_end(&mut renderer);
            assert_eq!(renderer.poll().expect("a status"), Status::Done);
            let picture = renderer.develop(&Tone::LINEAR).expect("a picture");
            check_same_bits(&name, &expected, &picture).expect("the same picture");
            working > 0
        });
        assert!(was_working, "every submission was done at once");
    }
}

#[test]
fn a_picture_can_be_had_and_begun_again_while_the_gpu_works() {
    let expected = waited_for();
    let gpu = Gpu::new(&AdapterChoice::default()).expect("a device");
    for host_copy in [true, false] {
        let mut renderer = renderer(gpu.clone(), policy(host_copy));
        let screen = renderer.new_screen().expect("a screen");
        for _ in 0..3 {
            renderer.submit().expect("submitted");
            // A second call submits nothing more.
            renderer.submit().expect("submitted");
            renderer.show(&Tone::LINEAR, &screen).expect("shown");
            renderer.develop(&Tone::LINEAR).expect("a picture so far");
        }
        renderer.submit().expect("submitted");
        let (packed, view) = everything();
        let restarted = renderer.restart(packed, &view, settings(), policy(host_copy));
        restarted.expect("begun again");
        poll_to_the_end(&mut renderer);
        let picture = renderer.develop(&Tone::LINEAR).expect("a picture");
        let name = format!("host copy {host_copy}");
        check_same_bits(&name, &expected, &picture).expect("the same picture");
    }
}

/// A device as every browser with WebGPU gives it: the limits that the specification guarantees, and no optional feature.
fn guaranteed() -> Gpu {
    let (instance, adapter, device, queue) = device(wgpu::Limits::default());
    let has = device.limits();
    // https://www.w3.org/TR/webgpu/#limit-default
    for (name, has, guaranteed) in [
        ("bind groups", has.max_bind_groups, 4),
        (
            "storage buffers",
            has.max_storage_buffers_per_shader_stage,
            8,
        ),
        (
            "storage textures",
            has.max_storage_textures_per_shader_stage,
            4,
        ),
        (
            "sampled textures",
            has.max_sampled_textures_per_shader_stage,
            16,
        ),
        ("side of a texture", has.max_texture_dimension_2d, 8192),
        ("layers of a texture", has.max_texture_array_layers, 256),
        (
            "bytes of workgroup memory",
            has.max_compute_workgroup_storage_size,
            16 << 10,
        ),
        (
            "invocations",
            has.max_compute_invocations_per_workgroup,
            256,
        ),
        ("invocations along x", has.max_compute_workgroup_size_x, 256),
        (
            "workgroups along a side",
            has.max_compute_workgroups_per_dimension,
            65_535,
        ),
    ] {
        assert_eq!(has, guaranteed, "{name}");
    }
    assert_eq!(has.max_uniform_buffer_binding_size, 64 << 10);
    assert_eq!(has.max_storage_buffer_binding_size, 128 << 20);
    assert_eq!(has.max_buffer_size, 256 << 20);
    assert!(device.features().is_empty(), "{:?}", device.features());
    Gpu::from_wgpu(instance, adapter, device, queue)
}

#[test]
fn the_limits_that_webgpu_guarantees_suffice_for_every_scene() {
    let least = guaranteed();
    let scenes = project_scenes(&["toml", "scene", "nff", "obj", "glb"]);
    assert_none(scenes.into_iter().map(|(name, scene)| {
        let packed = Arc::new(pack::scene(&scene).expect("packed"));
        let view = packed.frame(&scene.frame(0.0)).expect("a view");
        let settings = RenderSettings {
            size: (32, 24),
            samples: scene.output.samples.min(2),
            ..RenderSettings::from(&scene.output)
        };
        let [expected, actual] = [open_gpu(), least.clone()].map(|gpu| {
            let policy = ExecutionPolicy::default();
            let renderer = Renderer::new(gpu, packed.clone(), &view, settings.clone(), policy);
            let mut renderer = renderer.unwrap_or_else(|error| panic!("{name}: {error}"));
            finish(&mut renderer);
            (renderer.develop(&Tone::from(&scene.output))).expect("a picture")
        });
        check_same_bits(&name, &expected, &actual)
    }));
}

#[test]
fn the_limits_that_webgpu_guarantees_suffice_for_layers_screens_ray_trees_and_queries() {
    let gpu = guaranteed();
    let (packed, view) = everything();
    let settings = RenderSettings {
        features: true,
        ..settings()
    };
    let of_all = ExecutionPolicy::default();
    let mut renderer =
        Renderer::new(gpu.clone(), packed.clone(), &view, settings, of_all).expect("a renderer");
    finish(&mut renderer);
    let screen = renderer.new_screen().expect("a screen");
    for denoise in [false, true] {
        let tone = Tone {
            denoise,
            ..Tone::LINEAR
        };
        renderer.show(&tone, &screen).expect("shown");
        let shown = screen.read(&gpu).expect("pixels");
        assert!(shown.pixels.iter().any(|pixel| pixel[0] > 0));
    }
    let tree = renderer.explain([24, 18], 0..1).expect("a ray tree");
    assert!(!tree.samples[0].rays.is_empty());
    let query = RayQuery::new(gpu, packed, &view, of_all).expect("a query");
    let ray = QueryRay::new(glam::DVec3::ZERO, glam::Vec3::NEG_Z);
    query.closest_hits(&[ray]).expect("hits");
}

/// A device opened outside of glimray, with at most these limits.
fn device(limits: wgpu::Limits) -> (wgpu::Instance, wgpu::Adapter, wgpu::Device, wgpu::Queue) {
    let own = Gpu::new(&AdapterChoice::default()).expect("an adapter");
    let (instance, adapter, ..) = own.handles();
    let descriptor = wgpu::DeviceDescriptor {
        required_limits: limits,
        ..Default::default()
    };
    let (device, queue) =
        pollster::block_on(adapter.request_device(&descriptor)).expect("a device");
    (instance, adapter, device, queue)
}

#[test]
fn a_device_of_another_program_keeps_its_callbacks_and_is_not_replaced() {
    let (instance, adapter, device, queue) = device(wgpu::Limits::default());
    let errors = Arc::new(AtomicUsize::new(0));
    let count = errors.clone();
    device.on_uncaptured_error(Arc::new(move |_| {
        count.fetch_add(1, Ordering::Relaxed);
    }));
    let gpu = Gpu::from_wgpu(instance, adapter, device.clone(), queue);
    let mut renderer = renderer(gpu, policy(true));
    // WebGPU guarantees four storage images, and the scene takes five.
    assert_eq!(renderer.storage(), Storage::Buffer);
    poll_to_the_end(&mut renderer);
    let picture = renderer.develop(&Tone::LINEAR).expect("a picture");
    check_same_bits("another's device", &waited_for(), &picture).expect("the same picture");
    assert_eq!(errors.load(Ordering::Relaxed), 0);
    let invalid = device.create_buffer(&wgpu::BufferDescriptor {
        label: None,
        size: 16,
        usage: wgpu::BufferUsages::MAP_READ | wgpu::BufferUsages::MAP_WRITE,
        mapped_at_creation: false,
    });
    drop(invalid);
    assert_eq!(
        errors.load(Ordering::Relaxed),
        1,
        "errors of the program's own"
    );

    device.destroy();
    let (packed, view) = everything();
    let lost =
        (renderer.restart(packed, &view, settings(), policy(true))).and_then(|()| renderer.step());
    assert!(
        matches!(lost, Err(RenderError::Gpu(GpuError::Lost))),
        "{lost:?}"
    );
    assert_eq!(renderer.stats().device_losses, 0);
}

#[test]
fn a_device_of_another_program_is_not_exchanged_for_one_with_higher_limits() {
    let (instance, adapter, device, queue) = device(wgpu::Limits {
        max_storage_buffer_binding_size: 64 << 10,
        ..wgpu::Limits::default()
    });
    let gpu = Gpu::from_wgpu(instance, adapter, device, queue);
    let (packed, view) = everything();
    // 16 bytes a pixel.
    let large = sized(128, 128);
    let refused = Renderer::new(gpu, packed, &view, large, ExecutionPolicy::default());
    match refused.map(drop) {
        Err(RenderError::Gpu(GpuError::Limit { need, limit, .. })) => {
            assert_eq!((need, limit), (16 * 128 * 128, 64 << 10));
        }
        other => panic!("{other:?}"),
    }
}
