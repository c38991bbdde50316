//! Creates renderers, and describes adapters for people.

use crate::args::DeviceFlags;
use crate::memory;
use crate::report::FetchReport;
use glimray_app::console;
use glimray_app::error::AppError;
use glimray_app::host;
use glimray_app::storage;
use glimray_render::gpu::{AdapterChoice, AdapterReport, Backend, Gpu};
use glimray_render::pack::{self, PackedScene, PackedView};
use glimray_render::{ExecutionPolicy, RenderSettings, Renderer, Tone};
use glimray_scene::Scene;
use std::panic::resume_unwind;
use std::sync::Arc;
use std::thread::{self, JoinHandle};

/// An adapter that a thread opens while the scene is read. Whoever drops it waits: a driver must not be at work when the
/// process ends.
pub struct Opening {
    choice: AdapterChoice,
    thread: Option<JoinHandle<Result<Gpu, AppError>>>,
}

impl Opening {
    /// Starts to open the adapter that the flags choose, unless a host may have it open, or the process has a memory limit:
    /// what the driver reserves would then count against the scene.
    pub fn start(flags: &DeviceFlags) -> Self {
        let choice = flags.choice();
        let own = choice.clone();
        Self {
            choice,
            thread: (!memory::is_limited() && host::current().is_none())
                .then(|| thread::spawn(move || chosen(&own))),
        }
    }

    /// The adapter.
    ///
    /// # Errors
    /// As [`open`].
    pub fn wait(mut self) -> Result<Gpu, AppError> {
        match self.thread.take().map(JoinHandle::join) {
            Some(Ok(opened)) => opened,
            Some(Err(panic)) => resume_unwind(panic),
            None => chosen(&self.choice),
        }
    }
}

impl Drop for Opening {
    fn drop(&mut self) {
        if let Some(thread) = self.thread.take() {
            // Nobody needs the adapter, or what went wrong with it.
            let _ = thread.join();
        }
    }
}

/// Opens the adapter that the flags choose, after a look at the environment: nothing is then announced that a wrong
/// value would stop.
pub fn open(flags: &DeviceFlags) -> Result<Gpu, AppError> {
    chosen(&flags.choice())
}

fn chosen(choice: &AdapterChoice) -> Result<Gpu, AppError> {
    storage::requested()?;
    match host::current() {
        Some(host) => host.gpu(choice),
        None => Ok(Gpu::new(choice)?),
    }
}

/// A renderer of a packed scene; `tone` is compiled beside it.
pub fn prepared(
    gpu: Gpu,
    (packed, view): (Arc<PackedScene>, PackedView),
    settings: RenderSettings,
    policy: ExecutionPolicy,
    tone: Option<Tone>,
) -> Result<Renderer, AppError> {
    let policy = storage::with_requested(policy)?;
    thread::scope(|scope| {
        if let Some(tone) = tone {
            let (gpu, integrator) = (gpu.clone(), settings.integrator);
            // Developing meets the same error, if there is one.
            scope.spawn(move || tone.prepare(&gpu, integrator));
        }
        Ok(Renderer::new(gpu, packed, &view, settings, policy)?)
    })
}

/// A renderer of `scene` while the shutter is open, from `shutter.0` to `shutter.1` in seconds.
pub fn renderer(
    gpu: Gpu,
    scene: &Scene,
    shutter: (f64, f64),
    settings: RenderSettings,
    policy: ExecutionPolicy,
) -> Result<Renderer, AppError> {
    let (packed, view) = packed(scene, None, shutter)?;
    let policy = storage::with_requested(policy)?;
    Ok(Renderer::new(gpu, packed, &view, settings, policy)?)
}

/// `scene` while the shutter is open, from `shutter.0` to `shutter.1` in seconds. Meshes and pictures that are those of
/// `previous` are packed already.
pub fn packed(
    scene: &Scene,
    previous: Option<&PackedScene>,
    shutter: (f64, f64),
) -> Result<(Arc<PackedScene>, PackedView), AppError> {
    let packed = Arc::new(match previous {
        Some(previous) => pack::scene_from(previous, scene)?,
        None => pack::scene(scene)?,
    });
    let view = packed.view(&scene.motion_samples(shutter.0, shutter.1))?;
    Ok((packed, view))
}

/// Where the renderer reads the scene from. Warns if the environment requests another storage.
///
/// # Errors
/// As [`storage::requested`].
pub fn fetch_report(renderer: &Renderer) -> Result<FetchReport, AppError> {
    let requested = storage::requested()?;
    if let Some(refusal) = storage::refusal(renderer, requested) {
        console::warning(refusal);
    }
    Ok(FetchReport::new(renderer, requested))
}

/// Describes the adapter in a status line: `NAME [BACKEND, KIND]`.
pub fn describe(adapter: &AdapterReport) -> String {
    format!("{} [{}, {}]", adapter.name, adapter.backend, kind(adapter))
}

/// The kind of device, with a warning if it is slow.
pub fn kind(adapter: &AdapterReport) -> &str {
    match adapter.device_type.as_str() {
        "cpu" => "CPU (slow)",
        "discrete_gpu" => "discrete GPU",
        "integrated_gpu" => "integrated GPU",
        "virtual_gpu" => "virtual GPU",
        other => other,
    }
}

/// How to get a faster adapter than this, if the system has none but OpenGL on the CPU.
pub fn faster_driver(adapter: &AdapterReport) -> Option<&'static str> {
    let is_slow = adapter.backend == "gl" && adapter.is_cpu();
    (is_slow && cfg!(target_os = "linux")).then_some(
        "There is no Vulkan driver. Mesa's is several times faster than OpenGL on the CPU: install \
         mesa-vulkan-drivers (Debian, Ubuntu, Fedora), vulkan-swrast (Arch) or mesa-vulkan-swrast (Alpine).",
    )
}

/// How to get an adapter on this system, or one of `backend` if that was requested.
pub fn advice(backend: Option<Backend>) -> &'static str {
    if backend.is_some_and(|backend| backend.absence().is_some()) {
        return "Omit --backend or choose another one.";
    }
    if backend == Some(Backend::Gl) && cfg!(target_os = "linux") {
        return "Install Mesa's OpenGL driver, or omit --backend:\n  \
            Debian, Ubuntu  sudo apt-get install libegl1 libgl1-mesa-dri";
    }
    if cfg!(target_os = "linux") {
        "Install the driver of your GPU, or Mesa's software driver:\n  \
         Debian, Ubuntu  sudo apt-get install mesa-vulkan-drivers libvulkan1\n  \
         Fedora          sudo dnf install mesa-vulkan-drivers vulkan-loader\n  \
         Arch            sudo pacman -S vulkan-swrast vulkan-icd-loader\n  \
         Alpine          sudo apk add mesa-vulkan-swrast vulkan-loader"
    } else if cfg!(target_os = "windows") {
        "Install the GPU vendor's driver. Windows' software adapter (WARP) comes with DirectX 12."
    } else if cfg!(target_os = "macos") {
        "Metal is part of macOS: update the system, or use a machine with Metal support."
    } else {
        "Install a Vulkan driver, or Mesa's lavapipe for software rendering."
    }
}
