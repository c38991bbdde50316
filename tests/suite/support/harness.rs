//! Evaluates shader functions: any function of `shaders/lib` over rows of inputs, or of `shaders/scene` that reads no scene.

use super::verdict::{Expected, Tolerance, Verdict};
use glimray::gpu::{bound_loops, inline_functions, runtime_checks};
use glimray_link::Modules;
use glimray_shader_test::{Gpu, Row, Shader};
use std::{borrow::Cow, path::Path, sync::OnceLock};

/// The device that all tests share.
pub struct Harness(Gpu);

/// A software renderer if available, so that results do not depend on the machine; if `GLIMRAY_TEST_ADAPTER` is
/// set, the first adapter with that in its name.
pub fn gpu() -> &'static Harness {
    static HARNESS: OnceLock<Harness> = OnceLock::new();
    HARNESS.get_or_init(|| {
        let name = std::env::var("GLIMRAY_TEST_ADAPTER").unwrap_or_default();
        let gpu = Gpu::open(&name).unwrap_or_else(|error| panic!("{error}"));
        let is_cpu = gpu.is_software();
        Harness(gpu.with_modules(move |device, module| make_module(device, module, is_cpu)))
    })
}

/// A module with functions inlined and loops bounded where they are in kernels.
#[expect(unsafe_code, reason = "kernels are made in this way")]
fn make_module(
    device: &wgpu::Device,
    mut module: naga::Module,
    is_cpu: bool,
) -> wgpu::ShaderModule {
    if is_cpu {
        inline_functions(&mut module);
        bound_loops(&mut module);
    }
    let descriptor = wgpu::ShaderModuleDescriptor {
        label: None,
        source: wgpu::ShaderSource::Naga(Cow::Owned(module)),
    };
    // SAFETY: all loops of functions under test end.
    unsafe { device.create_shader_module_trusted(descriptor, runtime_checks()) }
}

/// The modules of `shaders/` for a scene in buffers, without records.
fn shaders() -> Shader {
    Shader::resolved_by(|| Modules::new(Path::new("shaders"), &["buffer", "silent"]))
}

/// A piece of WESL that imports from `shaders/`.
pub fn probe(source: &str) -> Shader {
    shaders().text(source)
}

impl Harness {
    /// A bound on rounding errors: software adapters round after each operation, GPUs may fuse some.
    pub fn bound<T>(&self, on_cpu: T, on_gpu: T) -> T {
        match self.0.is_software() {
            true => on_cpu,
            false => on_gpu,
        }
    }

    /// Evaluates a function such as `lib::phong::phong` for each row of arguments.
    pub fn map<I: Row, O: Row>(&self, function: &str, inputs: &[I]) -> Vec<O> {
        self.run(&shaders(), function, inputs)
    }

    /// Evaluates the function `probe` of a piece of WESL for each row of arguments.
    pub fn map_source<I: Row, O: Row>(&self, source: &str, inputs: &[I]) -> Vec<O> {
        self.map_shader(&probe(source), inputs)
    }

    /// Evaluates the function `probe` of a shader for each row of arguments.
    pub fn map_shader<I: Row, O: Row>(&self, shader: &Shader, inputs: &[I]) -> Vec<O> {
        self.run(shader, "probe", inputs)
    }

    fn run<I: Row, O: Row>(&self, shader: &Shader, function: &str, inputs: &[I]) -> Vec<O> {
        let found = self.0.map(shader, function, inputs);
        found.unwrap_or_else(|error| panic!("{error}"))
    }

    /// Evaluates a function for a table of (name, arguments, result) and fails with all wrong rows.
    pub fn check<I: Row + Clone, E: Expected<Got: Row>>(
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
}
