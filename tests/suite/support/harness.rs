//! Evaluates shader functions: any function of `shaders/lib` over rows of inputs, or of `shaders/scene` that reads no scene.
//!
//! A small entry point is generated around the function, linked like the kernels, and run with one invocation
//! for each row. The output is filled with a sentinel and each row ends with its index, so a row that was never
//! written cannot be mistaken for a result.

use super::{
    verdict::{Expected, Tolerance, Verdict},
    words::{Input, Output},
};
use glimray::gpu::{bound_loops, inline_functions, runtime_checks};
use glimray_link::FEATURES;
use std::{borrow::Cow, sync::OnceLock};
use wesl::{FileResolver, Router, VirtualResolver, Wesl};
use wgpu::{BufferUsages, util::DeviceExt};

/// Fills the output before a run.
const SENTINEL: u32 = u32::MAX;
/// The limit of WebGPU on workgroups along X.
const MOST_ROWS: usize = 64 * 65_535;

/// The device that all tests share.
pub struct Harness {
    device: wgpu::Device,
    queue: wgpu::Queue,
    is_cpu: bool,
}

/// A software renderer if available, so that results do not depend on the machine; if `GLIMRAY_TEST_ADAPTER` is
/// set, the first adapter with that in its name.
pub fn gpu() -> &'static Harness {
    static HARNESS: OnceLock<Harness> = OnceLock::new();
    HARNESS.get_or_init(Harness::open)
}

impl Harness {
    fn open() -> Self {
        let backends = wgpu::Backends::PRIMARY;
        let mut descriptor = wgpu::InstanceDescriptor::new_without_display_handle();
        descriptor.backends = backends;
        let instance = wgpu::Instance::new(descriptor);
        let mut found = pollster::block_on(instance.enumerate_adapters(backends));
        if let Ok(name) = std::env::var("GLIMRAY_TEST_ADAPTER") {
            let name = name.to_lowercase();
            found.retain(|adapter| adapter.get_info().name.to_lowercase().contains(&name));
        }
        let adapter = found
            .into_iter()
            .min_by_key(|adapter| adapter.get_info().device_type != wgpu::DeviceType::Cpu)
            .expect("an adapter; Mesa's lavapipe will do");
        let is_cpu = adapter.get_info().device_type == wgpu::DeviceType::Cpu;
        let (device, queue) =
            pollster::block_on(adapter.request_device(&Default::default())).expect("a device");
        Self {
            device,
            queue,
            is_cpu,
        }
    }

    /// A bound on rounding errors: software adapters round after each operation, GPUs may fuse some.
    pub fn bound<T>(&self, on_cpu: T, on_gpu: T) -> T {
        if self.is_cpu { on_cpu } else { on_gpu }
    }

    /// Evaluates a function such as `lib::phong::phong` for each row of arguments.
    pub fn map<I: Input, O: Output>(&self, function: &str, inputs: &[I]) -> Vec<O> {
        self.run("", &format!("package::{function}"), &[], &[0.0], inputs)
    }

    /// Evaluates the function `probe` of a piece of WESL for each row of arguments.
    pub fn map_source<I: Input, O: Output>(&self, source: &str, inputs: &[I]) -> Vec<O> {
        self.run(source, "probe", &[], &[0.0], inputs)
    }

    /// As `map_source`, with these overrides of `bindings.wesl` switched on.
    pub fn map_flagged<I: Input, O: Output>(
        &self,
        flags: &[&str],
        source: &str,
        inputs: &[I],
    ) -> Vec<O> {
        self.run(source, "probe", flags, &[0.0], inputs)
    }

    /// As `map_source`, with numbers shared by all rows: `table` in the source.
    pub fn map_table<I: Input, O: Output>(
        &self,
        source: &str,
        table: &[f32],
        inputs: &[I],
    ) -> Vec<O> {
        self.run(source, "probe", &[], table, inputs)
    }

    /// Evaluates a function for a table of (name, arguments, result) and fails with all wrong rows.
    pub fn check<I: Input + Clone, E: Expected<Got: Output>>(
        &self,
        function: &str,
        tolerance: Tolerance,
        rows: &[(&str, I, E)],
    ) {
        let inputs: Vec<I> = rows.iter().map(|(_, input, _)| input.clone()).collect();
        let outputs: Vec<E::Got> = self.map(function, &inputs);
        let mut verdict = Verdict::on(function);
        for ((name, _, expected), got) in rows.iter().zip(&outputs) {
            verdict.near(name, got, expected, tolerance);
        }
        verdict.close();
    }

    /// Generates the entry point around `function`, runs it and unpacks the rows.
    fn run<I: Input, O: Output>(
        &self,
        source: &str,
        function: &str,
        flags: &[&str],
        table: &[f32],
        inputs: &[I],
    ) -> Vec<O> {
        assert!(
            !inputs.is_empty() && inputs.len() <= MOST_ROWS,
            "1 to {MOST_ROWS} rows"
        );
        let (mut input_words, mut output_words) = (0, 0);
        let arguments = I::load(&mut input_words);
        let stores = O::store("result", &mut output_words);
        let stride = output_words + 1;
        let probe = format!(
            "{source}
            @group(0) @binding(0) var<storage, read> inputs: array<u32>;
            @group(0) @binding(1) var<storage, read_write> outputs: array<u32>;
            @group(0) @binding(2) var<storage, read> table: array<f32>;
            var<private> row: u32;
            fn word(i: u32) -> u32 {{ return inputs[row * {input_words}u + i]; }}
            fn real(i: u32) -> f32 {{ return bitcast<f32>(word(i)); }}
            fn write(i: u32, value: u32) {{ outputs[row * {stride}u + i] = value; }}
            @compute @workgroup_size(64, 1, 1)
            fn main(@builtin(global_invocation_id) id: vec3u) {{
                if (id.x < {rows}u) {{
                    row = id.x;
                    let result = {function}({arguments});
                    {stores}
                    write({output_words}u, row);
                }}
            }}",
            rows = inputs.len(),
        );
        let mut words = Vec::new();
        inputs.iter().for_each(|input| input.write(&mut words));
        let linked = with_flags(link(&probe), flags);
        let results = self.dispatch(function, &linked, table, &words, inputs.len(), stride);
        results
            .chunks_exact(stride)
            .enumerate()
            .map(|(row, words)| {
                assert_eq!(
                    words[output_words], row as u32,
                    "{function}: row {row} was not written"
                );
                O::read(&mut words.iter().copied())
            })
            .collect()
    }

    /// Runs linked WGSL over `rows` rows and returns the output's words.
    fn dispatch(
        &self,
        name: &str,
        wgsl: &str,
        table: &[f32],
        inputs: &[u32],
        rows: usize,
        stride: usize,
    ) -> Vec<u32> {
        let upload = |contents: &[u8], usage| {
            self.device
                .create_buffer_init(&wgpu::util::BufferInitDescriptor {
                    label: None,
                    contents,
                    usage,
                })
        };
        let inputs = upload(bytemuck::cast_slice(inputs), BufferUsages::STORAGE);
        let table = upload(bytemuck::cast_slice(table), BufferUsages::STORAGE);
        let blank = vec![SENTINEL; rows * stride];
        let outputs = upload(
            bytemuck::cast_slice(&blank),
            BufferUsages::STORAGE | BufferUsages::COPY_SRC,
        );
        let staging = self.device.create_buffer(&wgpu::BufferDescriptor {
            label: None,
            size: outputs.size(),
            usage: BufferUsages::MAP_READ | BufferUsages::COPY_DST,
            mapped_at_creation: false,
        });
        let storage = |binding, read_only| wgpu::BindGroupLayoutEntry {
            binding,
            visibility: wgpu::ShaderStages::COMPUTE,
            ty: wgpu::BindingType::Buffer {
                ty: wgpu::BufferBindingType::Storage { read_only },
                has_dynamic_offset: false,
                min_binding_size: None,
            },
            count: None,
        };
        // Explicit, because the shader may not use the table, and a derived layout would lack it.
        let group_layout = self
            .device
            .create_bind_group_layout(&wgpu::BindGroupLayoutDescriptor {
                label: Some(name),
                entries: &[storage(0, true), storage(1, false), storage(2, true)],
            });
        let group = self.device.create_bind_group(&wgpu::BindGroupDescriptor {
            label: Some(name),
            layout: &group_layout,
            entries: &[
                wgpu::BindGroupEntry {
                    binding: 0,
                    resource: inputs.as_entire_binding(),
                },
                wgpu::BindGroupEntry {
                    binding: 1,
                    resource: outputs.as_entire_binding(),
                },
                wgpu::BindGroupEntry {
                    binding: 2,
                    resource: table.as_entire_binding(),
                },
            ],
        });
        let mut encoder = self.device.create_command_encoder(&Default::default());
        {
            let mut pass = encoder.begin_compute_pass(&Default::default());
            pass.set_pipeline(&self.pipeline(name, wgsl, &group_layout));
            pass.set_bind_group(0, &group, &[]);
            pass.dispatch_workgroups(rows.div_ceil(64) as u32, 1, 1);
        }
        encoder.copy_buffer_to_buffer(&outputs, 0, &staging, 0, outputs.size());
        self.queue.submit([encoder.finish()]);
        self.read(&staging)
    }

    #[expect(unsafe_code, reason = "kernels are made in this way")]
    fn pipeline(
        &self,
        name: &str,
        wgsl: &str,
        group_layout: &wgpu::BindGroupLayout,
    ) -> wgpu::ComputePipeline {
        let validation = self.device.push_error_scope(wgpu::ErrorFilter::Validation);
        let descriptor = wgpu::ShaderModuleDescriptor {
            label: Some(name),
            source: self.source(wgsl),
        };
        // SAFETY: all loops of functions under test end.
        let module =
            unsafe { (self.device).create_shader_module_trusted(descriptor, runtime_checks()) };
        let layout = self
            .device
            .create_pipeline_layout(&wgpu::PipelineLayoutDescriptor {
                label: Some(name),
                bind_group_layouts: &[Some(group_layout)],
                immediate_size: 0,
            });
        let pipeline = self
            .device
            .create_compute_pipeline(&wgpu::ComputePipelineDescriptor {
                label: Some(name),
                layout: Some(&layout),
                module: &module,
                entry_point: None,
                compilation_options: Default::default(),
                cache: None,
            });
        if let Some(error) = pollster::block_on(validation.pop()) {
            panic!("{name}: {error}\n{wgsl}");
        }
        pipeline
    }

    /// The source, with functions inlined and loops bounded where they are in kernels.
    fn source(&self, wgsl: &str) -> wgpu::ShaderSource<'static> {
        let module = self.is_cpu.then(|| naga::front::wgsl::parse_str(wgsl));
        if let Some(Ok(mut module)) = module {
            inline_functions(&mut module);
            bound_loops(&mut module);
            return wgpu::ShaderSource::Naga(Cow::Owned(module));
        }
        wgpu::ShaderSource::Wgsl(wgsl.to_owned().into())
    }

    fn read(&self, staging: &wgpu::Buffer) -> Vec<u32> {
        staging.map_async(wgpu::MapMode::Read, .., |mapped| mapped.expect("mapped"));
        self.device
            .poll(wgpu::PollType::wait_indefinitely())
            .expect("the device answers");
        let view = staging.get_mapped_range(..).expect("mapped");
        bytemuck::pod_collect_to_vec(&view)
    }
}

/// Linked WGSL with these overrides switched on.
fn with_flags(mut wgsl: String, flags: &[&str]) -> String {
    for flag in flags {
        let off = format!("{flag}: bool = false");
        assert!(wgsl.contains(&off), "{flag} is no override that is off");
        wgsl = wgsl.replace(&off, &off.replace("false", "true"));
    }
    wgsl
}

/// Links a module of a test and its imports from `shaders/` to plain WGSL.
fn link(probe: &str) -> String {
    let path: wesl::ModulePath = "package::probe".parse().expect("a path");
    let mut own = VirtualResolver::new();
    own.add_module("package".parse().expect("a path"), probe.to_string().into());
    let mut router = Router::new();
    router.mount_resolver(path.clone(), own);
    router.mount_fallback_resolver(FileResolver::new("shaders"));
    let mut compiler = Wesl::new("shaders").set_custom_resolver(router);
    for feature in FEATURES {
        compiler.set_feature(feature, false);
    }
    match compiler.compile(&path) {
        Ok(linked) => linked.to_string(),
        Err(error) => panic!("{error}\n{probe}"),
    }
}
