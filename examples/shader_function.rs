//! Uses a function of the shader library in a custom kernel: the fraction of light that glass reflects at
//! each angle, by `lib::fresnel`. `cargo run --release --example shader_function`
//!
//! The kernel imports the function, `wesl` links both to plain WGSL, and wgpu runs it. The tests of the
//! library do the same for tables of inputs, by the package `glimray-shader-test`.

use std::error::Error;
use wesl::{FileResolver, Router, VirtualResolver, Wesl};
use wgpu::util::DeviceExt;

const KERNEL: &str = "
    import package::lib::fresnel::fresnel;

    @group(0) @binding(0) var<storage, read_write> values: array<f32>;

    // Replaces the cosine of the angle of incidence by the reflectance of glass in air.
    @compute @workgroup_size(64)
    fn main(@builtin(global_invocation_id) id: vec3u) {
        if (id.x < arrayLength(&values)) {
            values[id.x] = fresnel(values[id.x], 1.0 / 1.5).reflectance;
        }
    }";

/// Degrees from the normal.
const ANGLES: [f32; 7] = [0.0, 15.0, 30.0, 45.0, 60.0, 75.0, 90.0];

fn main() -> Result<(), Box<dyn Error>> {
    let cosines = ANGLES.map(|angle| angle.to_radians().cos().max(0.0));
    for (angle, reflectance) in ANGLES.iter().zip(run(&linked()?, &cosines)?) {
        println!("{angle} {reflectance}");
    }
    Ok(())
}

/// The kernel and its imports, linked to plain WGSL.
fn linked() -> Result<String, Box<dyn Error>> {
    let shaders = concat!(env!("CARGO_MANIFEST_DIR"), "/shaders");
    let path: wesl::ModulePath = "package::kernel".parse()?;
    let mut own = VirtualResolver::new();
    own.add_module("package".parse()?, KERNEL.into());
    let mut router = Router::new();
    router.mount_resolver(path.clone(), own);
    router.mount_fallback_resolver(FileResolver::new(shaders));
    let linked = Wesl::new(shaders)
        .set_custom_resolver(router)
        .compile(&path);
    Ok(linked.map_err(|error| error.to_string())?.to_string())
}

/// Runs the kernel on `values`.
fn run(wgsl: &str, values: &[f32]) -> Result<Vec<f32>, Box<dyn Error>> {
    let instance = wgpu::Instance::new(wgpu::InstanceDescriptor::new_without_display_handle());
    let adapter = pollster::block_on(instance.request_adapter(&Default::default()))?;
    let (device, queue) = pollster::block_on(adapter.request_device(&Default::default()))?;
    let module = device.create_shader_module(wgpu::ShaderModuleDescriptor {
        label: None,
        source: wgpu::ShaderSource::Wgsl(wgsl.into()),
    });
    let pipeline = device.create_compute_pipeline(&wgpu::ComputePipelineDescriptor {
        label: None,
        layout: None,
        module: &module,
        entry_point: None,
        compilation_options: Default::default(),
        cache: None,
    });
    let buffer = device.create_buffer_init(&wgpu::util::BufferInitDescriptor {
        label: None,
        contents: bytemuck::cast_slice(values),
        usage: wgpu::BufferUsages::STORAGE | wgpu::BufferUsages::COPY_SRC,
    });
    let staging = device.create_buffer(&wgpu::BufferDescriptor {
        label: None,
        size: buffer.size(),
        usage: wgpu::BufferUsages::MAP_READ | wgpu::BufferUsages::COPY_DST,
        mapped_at_creation: false,
    });
    let group = device.create_bind_group(&wgpu::BindGroupDescriptor {
        label: None,
        layout: &pipeline.get_bind_group_layout(0),
        entries: &[wgpu::BindGroupEntry {
            binding: 0,
            resource: buffer.as_entire_binding(),
        }],
    });
    let mut encoder = device.create_command_encoder(&Default::default());
    let mut pass = encoder.begin_compute_pass(&Default::default());
    pass.set_pipeline(&pipeline);
    pass.set_bind_group(0, &group, &[]);
    pass.dispatch_workgroups(values.len().div_ceil(64) as u32, 1, 1);
    drop(pass);
    encoder.copy_buffer_to_buffer(&buffer, 0, &staging, 0, staging.size());
    queue.submit([encoder.finish()]);
    staging.map_async(wgpu::MapMode::Read, .., |mapped| mapped.expect("mapped"));
    device.poll(wgpu::PollType::wait_indefinitely())?;
    let view = staging.get_mapped_range(..)?;
    Ok(bytemuck::pod_collect_to_vec(&view))
}
