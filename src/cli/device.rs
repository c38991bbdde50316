//! Adapters: handing one a scene, and adapters in words.

use crate::app::error::AppError;
use crate::gpu::{AdapterReport, Backend, Gpu};
use crate::pack;
use crate::render::{ExecutionPolicy, RenderSettings, Renderer};
use crate::scene::Scene;
use std::sync::Arc;

/// A renderer of `scene` while the shutter is open, from `shot.0` to `shot.1` in seconds, and the
/// seconds that building the tree took.
pub fn renderer(
    gpu: Gpu,
    scene: &Scene,
    shot: (f64, f64),
    settings: RenderSettings,
    policy: ExecutionPolicy,
) -> Result<(Renderer, f64), AppError> {
    let packed = Arc::new(pack::scene(scene)?);
    let build_seconds = packed.build_seconds;
    let view = packed.view(&scene.motion_samples(shot.0, shot.1))?;
    let renderer = Renderer::new(gpu, packed, &view, settings, policy)?;
    Ok((renderer, build_seconds))
}

/// The adapter for a status line: `NAME [BACKEND, KIND]`.
pub fn describe(adapter: &AdapterReport) -> String {
    format!("{} [{}, {}]", adapter.name, adapter.backend, kind(adapter))
}

/// What kind of device it is, with a warning where speed is not to be had.
pub fn kind(adapter: &AdapterReport) -> &str {
    match adapter.device_type.as_str() {
        "cpu" => "CPU: expect it to be slow",
        "discrete_gpu" => "discrete GPU",
        "integrated_gpu" => "integrated GPU",
        "virtual_gpu" => "virtual GPU",
        other => other,
    }
}

/// How to get a first adapter on this system: with this backend, if it is to be that one.
pub fn advice(backend: Option<Backend>) -> &'static str {
    if backend.is_some_and(|backend| backend.absence().is_some()) {
        return "Leave out --backend, or choose another one.";
    }
    if backend == Some(Backend::Gl) && cfg!(target_os = "linux") {
        return "Install Mesa's OpenGL driver, or leave out --backend:\n  \
            Debian, Ubuntu  sudo apt-get install libegl1 libgl1-mesa-dri";
    }
    if cfg!(target_os = "linux") {
        "Install the driver of your GPU, or Mesa's software driver:\n  \
         Debian, Ubuntu  sudo apt-get install mesa-vulkan-drivers libvulkan1\n  \
         Fedora          sudo dnf install mesa-vulkan-drivers vulkan-loader\n  \
         Arch            sudo pacman -S vulkan-swrast vulkan-icd-loader\n  \
         Alpine          sudo apk add mesa-vulkan-swrast vulkan-loader"
    } else if cfg!(target_os = "windows") {
        "Install the driver of your GPU from its maker; Windows' own software adapter (WARP) comes \
         with DirectX 12."
    } else if cfg!(target_os = "macos") {
        "Metal comes with macOS: update the system, or leave a virtual machine without it."
    } else {
        "Install a Vulkan driver, or Mesa's lavapipe for software rendering."
    }
}
