//! Devices, and runs of functions on them.

use crate::{Error, Row, Shader, linked::Linked, signature::Signature};
use std::{borrow::Cow, sync::OnceLock};
use wgpu::{
    BufferBindingType, BufferUsages,
    naga::{self, AddressSpace, StorageAccess},
};

/// Fills the output before a run.
const SENTINEL: u32 = u32::MAX;
/// Invocations of a workgroup.
const GROUP: usize = 64;
/// The limit of WebGPU on workgroups along X.
const MOST_GROUPS: usize = 65_535;
/// The bind group of rows. WebGPU has four.
const ROWS: usize = 3;

/// Makes a shader module of a device.
type MakeModule = dyn Fn(&wgpu::Device, naga::Module) -> wgpu::ShaderModule + Send + Sync;

/// A device that runs shader functions.
pub struct Gpu {
    device: wgpu::Device,
    queue: wgpu::Queue,
    is_software: bool,
    make_module: Box<MakeModule>,
}

impl Gpu {
    /// The device of this process, opened by the first call: of the first adapter with `WGPU_ADAPTER_NAME` in its name, as
    /// in [`Self::open`]. Devices are slow to open, and many at a time exhaust some drivers.
    ///
    /// # Errors
    /// [`Error::Device`], in every call.
    pub fn shared() -> Result<&'static Self, Error> {
        static SHARED: OnceLock<Result<Gpu, Error>> = OnceLock::new();
        let open = || Self::open(&std::env::var("WGPU_ADAPTER_NAME").unwrap_or_default());
        SHARED.get_or_init(open).as_ref().map_err(Error::clone)
    }

    /// A device of the first adapter with `name` in its name, in any case. Software renderers, such as Mesa's lavapipe, are
    /// the first, so that an empty name gives results that do not depend on the machine where there is one.
    ///
    /// # Errors
    /// [`Error::Device`] if there is no such adapter, or it gives no device.
    pub fn open(name: &str) -> Result<Self, Error> {
        let mut descriptor = wgpu::InstanceDescriptor::new_without_display_handle();
        descriptor.backends = wgpu::Backends::PRIMARY;
        let instance = wgpu::Instance::new(descriptor);
        let mut found = pollster::block_on(instance.enumerate_adapters(wgpu::Backends::PRIMARY));
        let name = name.to_lowercase();
        found.retain(|adapter| adapter.get_info().name.to_lowercase().contains(&name));
        let is_software =
            |adapter: &wgpu::Adapter| adapter.get_info().device_type == wgpu::DeviceType::Cpu;
        let adapter = found.iter().min_by_key(|adapter| !is_software(adapter));
        let adapter = adapter.ok_or_else(|| {
            Error::Device(format!(
                "there is no adapter with `{name}` in its name; Mesa's lavapipe needs no GPU"
            ))
        })?;
        let device = pollster::block_on(adapter.request_device(&Default::default()));
        let (device, queue) = device.map_err(|error| Error::Device(error.to_string()))?;
        let is_software = is_software(adapter);
        Ok(Self::from_device(device, queue, is_software))
    }

    /// Runs functions on a device of the caller. The device has at least WebGPU's default limits; `is_software` is the
    /// answer of [`Self::is_software`].
    pub fn from_device(device: wgpu::Device, queue: wgpu::Queue, is_software: bool) -> Self {
        Self {
            device,
            queue,
            is_software,
            make_module: Box::new(|device, module| {
                device.create_shader_module(wgpu::ShaderModuleDescriptor {
                    label: None,
                    source: wgpu::ShaderSource::Naga(Cow::Owned(module)),
                })
            }),
        }
    }

    /// Makes modules as a program does that changes them or their checks before a driver sees them.
    #[must_use]
    pub fn with_modules(
        mut self,
        make: impl Fn(&wgpu::Device, naga::Module) -> wgpu::ShaderModule + Send + Sync + 'static,
    ) -> Self {
        self.make_module = Box::new(make);
        self
    }

    /// Whether the adapter is a software renderer. These round after each operation, where GPUs may fuse some.
    pub fn is_software(&self) -> bool {
        self.is_software
    }

    /// Calls a function once for each row of arguments, and returns the results in order.
    ///
    /// `function` is a name in the shader's text, or a path of its package: `lib::phong::phong`.
    ///
    /// # Errors
    /// - [`Error::Shader`]: the function is missing or invalid, with the file and line; it reads a buffer that
    ///   [`Shader::buffer`] does not fill; or it has no override that [`Shader::set`] names.
    /// - [`Error::Rows`]: `rows` is empty, or `I` or `O` do not fit the function.
    /// - [`Error::Unwritten`]: the driver did not finish a row.
    /// - [`Error::Device`]: the device was lost or is out of memory.
    pub fn map<I: Row, O: Row>(
        &self,
        shader: &Shader,
        function: &str,
        rows: &[I],
    ) -> Result<Vec<O>, Error> {
        if rows.is_empty() {
            return Err(Error::Rows(format!("`{function}`: there are no rows")));
        }
        let linked = shader.link(function)?;
        let module = linked.parse("")?;
        let name = function.rsplit("::").next().unwrap_or(function);
        let is_named = |item: &naga::Function| item.name.as_deref() == Some(name);
        let found = (module.functions.iter()).find(|(_, item)| is_named(item));
        let missing = || Error::Shader(format!("`{function}`: there is no such function"));
        let (handle, item) = found.ok_or_else(missing)?;
        let signature = Signature::new::<I, O>(&module, item, function)?;
        let info = linked.validate(&module)?;
        let buffers = self.checked(|| self.buffers(shader, &linked, &module, &info[handle]));
        let of_device = |error: wgpu::Error| Error::Device(error.to_string());
        let of_function = |error| Error::Shader(format!("`{function}` {error}"));
        let buffers = buffers.map_err(of_device)?.map_err(of_function)?;

        let module = linked.parse(&entry_point(name, &signature))?;
        linked.validate(&module)?;
        let overrides = shader.overrides(&linked, &module).map_err(of_function)?;
        let run = self.checked(|| self.run(module, &overrides, &buffers));
        let run = run.map_err(|error| match error {
            wgpu::Error::Validation { .. } => Error::Shader(format!("`{function}`: {error}")),
            error => of_device(error),
        })?;

        let row_bytes = 4 * (signature.outputs + 1).max(signature.inputs);
        let most = self.device.limits().max_storage_buffer_binding_size / row_bytes as u64;
        let most = (most as usize).clamp(1, GROUP * MOST_GROUPS);
        let mut results = Vec::with_capacity(rows.len());
        for rows in rows.chunks(most) {
            let mut words = Vec::with_capacity(rows.len() * signature.inputs);
            rows.iter().for_each(|row| row.write(&mut words));
            let found =
                self.checked(|| self.dispatch(&run, &words, rows.len(), signature.outputs + 1));
            let found = found.map_err(of_device)?.map_err(Error::Device)?;
            for (index, words) in found.chunks_exact(signature.outputs + 1).enumerate() {
                let (mut words, end) = words.split_at(signature.outputs);
                if end != [index as u32] {
                    let (function, row) = (function.to_owned(), results.len());
                    return Err(Error::Unwritten { function, row });
                }
                results.push(O::read(&mut words));
            }
        }
        Ok(results)
    }

    /// The buffers that a function reads, with their groups.
    fn buffers(
        &self,
        shader: &Shader,
        linked: &Linked,
        module: &naga::Module,
        info: &naga::valid::FunctionInfo,
    ) -> Result<[Vec<Binding>; ROWS], String> {
        let mut groups: [Vec<Binding>; ROWS] = Default::default();
        for (handle, global) in module.global_variables.iter() {
            let Some(place) = global.binding.filter(|_| !info[handle].is_empty()) else {
                continue;
            };
            let name = linked.source_name(global.name.as_deref().unwrap_or_default());
            let problem = |text: &str| format!("reads `{name}`, {text}");
            let (ty, usage) = match global.space {
                AddressSpace::Uniform => (BufferBindingType::Uniform, BufferUsages::UNIFORM),
                AddressSpace::Storage { access } => {
                    let read_only = !access.contains(StorageAccess::STORE);
                    (
                        BufferBindingType::Storage { read_only },
                        BufferUsages::STORAGE,
                    )
                }
                _ => return Err(problem("which is no buffer")),
            };
            let contents = shader.contents(name);
            let contents =
                contents.ok_or_else(|| problem("which `Shader::buffer` does not fill"))?;
            let group = groups.get_mut(place.group as usize);
            let group = group.ok_or_else(|| problem("whose group is above 2"))?;
            group.push(Binding {
                binding: place.binding,
                ty,
                buffer: self.upload(contents, usage),
            });
        }
        Ok(groups)
    }

    /// Compiles a module whose functions read these buffers.
    fn run(
        &self,
        module: naga::Module,
        overrides: &[(String, f64)],
        buffers: &[Vec<Binding>; ROWS],
    ) -> Run {
        let module = (self.make_module)(&self.device, module);
        let layout = |types: &mut dyn Iterator<Item = (u32, BufferBindingType)>| {
            let entries: Vec<_> = types
                .map(|(binding, ty)| wgpu::BindGroupLayoutEntry {
                    binding,
                    visibility: wgpu::ShaderStages::COMPUTE,
                    ty: wgpu::BindingType::Buffer {
                        ty,
                        has_dynamic_offset: false,
                        min_binding_size: None,
                    },
                    count: None,
                })
                .collect();
            let descriptor = wgpu::BindGroupLayoutDescriptor {
                label: None,
                entries: &entries,
            };
            self.device.create_bind_group_layout(&descriptor)
        };
        let types = buffers
            .each_ref()
            .map(|group| group.iter().map(|item| (item.binding, item.ty)));
        let own = types.map(|mut types| (types.len() > 0).then(|| layout(&mut types)));
        let storage = |read_only| BufferBindingType::Storage { read_only };
        let rows = layout(&mut [(0, storage(true)), (1, storage(false))].into_iter());
        let layouts: Vec<_> = own
            .iter()
            .map(Option::as_ref)
            .chain([Some(&rows)])
            .collect();
        let layout = self
            .device
            .create_pipeline_layout(&wgpu::PipelineLayoutDescriptor {
                label: None,
                bind_group_layouts: &layouts,
                immediate_size: 0,
            });
        let constants: Vec<_> = overrides
            .iter()
            .map(|(name, value)| (&**name, *value))
            .collect();
        let pipeline = self
            .device
            .create_compute_pipeline(&wgpu::ComputePipelineDescriptor {
                label: None,
                layout: Some(&layout),
                module: &module,
                entry_point: Some("shader_test_main"),
                compilation_options: wgpu::PipelineCompilationOptions {
                    constants: &constants,
                    ..Default::default()
                },
                cache: None,
            });
        let groups = own.iter().zip(buffers).map(|(layout, group)| {
            let buffers = group.iter().map(|item| (item.binding, &item.buffer));
            Some(self.bind(layout.as_ref()?, buffers))
        });
        Run {
            pipeline,
            groups: groups.collect(),
            rows,
        }
    }

    /// Calls the function for rows, and returns `stride` words for each.
    fn dispatch(
        &self,
        run: &Run,
        words: &[u32],
        rows: usize,
        stride: usize,
    ) -> Result<Vec<u32>, String> {
        let inputs = self.upload(bytemuck::cast_slice(words), BufferUsages::STORAGE);
        let blank = vec![SENTINEL; rows * stride];
        let usage = BufferUsages::STORAGE | BufferUsages::COPY_SRC;
        let outputs = self.upload(bytemuck::cast_slice(&blank), usage);
        let staging = self.device.create_buffer(&wgpu::BufferDescriptor {
            label: None,
            size: outputs.size(),
            usage: BufferUsages::MAP_READ | BufferUsages::COPY_DST,
            mapped_at_creation: false,
        });
        let mut encoder = self.device.create_command_encoder(&Default::default());
        let mut pass = encoder.begin_compute_pass(&Default::default());
        pass.set_pipeline(&run.pipeline);
        let own = self.bind(&run.rows, [(0, &inputs), (1, &outputs)].into_iter());
        for (index, group) in (0..).zip(run.groups.iter().map(Option::as_ref).chain([Some(&own)])) {
            pass.set_bind_group(index, group, &[]);
        }
        pass.dispatch_workgroups(rows.div_ceil(GROUP) as u32, 1, 1);
        drop(pass);
        encoder.copy_buffer_to_buffer(&outputs, 0, &staging, 0, outputs.size());
        self.queue.submit([encoder.finish()]);
        staging.map_async(wgpu::MapMode::Read, .., |_| ());
        let polled = self.device.poll(wgpu::PollType::wait_indefinitely());
        polled.map_err(|error| error.to_string())?;
        let view = staging
            .get_mapped_range(..)
            .map_err(|error| error.to_string())?;
        Ok(bytemuck::pod_collect_to_vec(&view))
    }

    fn bind<'a>(
        &self,
        layout: &wgpu::BindGroupLayout,
        buffers: impl Iterator<Item = (u32, &'a wgpu::Buffer)>,
    ) -> wgpu::BindGroup {
        let entries: Vec<_> = buffers
            .map(|(binding, buffer)| wgpu::BindGroupEntry {
                binding,
                resource: buffer.as_entire_binding(),
            })
            .collect();
        let descriptor = wgpu::BindGroupDescriptor {
            label: None,
            layout,
            entries: &entries,
        };
        self.device.create_bind_group(&descriptor)
    }

    fn upload(&self, contents: &[u8], usage: BufferUsages) -> wgpu::Buffer {
        // A binding holds at least one word.
        let size = contents.len().next_multiple_of(4).max(4);
        let buffer = self.device.create_buffer(&wgpu::BufferDescriptor {
            label: None,
            size: size as u64,
            usage: usage | BufferUsages::COPY_DST,
            mapped_at_creation: false,
        });
        let mut padded = contents.to_vec();
        padded.resize(size, 0);
        self.queue.write_buffer(&buffer, 0, &padded);
        buffer
    }

    /// Does something on the device, and returns the first error that wgpu reports.
    fn checked<T>(&self, work: impl FnOnce() -> T) -> Result<T, wgpu::Error> {
        let memory = self.device.push_error_scope(wgpu::ErrorFilter::OutOfMemory);
        let validation = self.device.push_error_scope(wgpu::ErrorFilter::Validation);
        let done = work();
        let found = [
            pollster::block_on(validation.pop()),
            pollster::block_on(memory.pop()),
        ];
        match found.into_iter().flatten().next() {
            Some(error) => Err(error),
            None => Ok(done),
        }
    }
}

/// A buffer of the shader's.
struct Binding {
    binding: u32,
    ty: BufferBindingType,
    buffer: wgpu::Buffer,
}

/// A function that is ready to run.
struct Run {
    pipeline: wgpu::ComputePipeline,
    /// The groups of the shader's buffers.
    groups: Vec<Option<wgpu::BindGroup>>,
    /// The layout of the bind group of rows.
    rows: wgpu::BindGroupLayout,
}

/// WGSL that calls a function for the row of each invocation, and marks the row.
fn entry_point(name: &str, signature: &Signature) -> String {
    let Signature {
        arguments,
        stores,
        inputs,
        outputs,
    } = signature;
    let stride = outputs + 1;
    format!(
        "@group({ROWS}) @binding(0) var<storage, read> shader_test_in: array<u32>;
        @group({ROWS}) @binding(1) var<storage, read_write> shader_test_out: array<u32>;
        @compute @workgroup_size({GROUP})
        fn shader_test_main(@builtin(global_invocation_id) shader_test_id: vec3<u32>) {{
            let shader_test_row = shader_test_id.x;
            if (shader_test_row < arrayLength(&shader_test_out) / {stride}u) {{
                let shader_test_from = shader_test_row * {inputs}u;
                let shader_test_to = shader_test_row * {stride}u;
                let shader_test_result = {name}({arguments});
                {stores}
                shader_test_out[shader_test_to + {outputs}u] = shader_test_row;
            }}
        }}"
    )
}
