//! Adds the command line's remedies to the library's errors: which flag or command helps. The library
//! itself knows no flags.

use glimray_io::import::ImportError;
use glimray_render::gpu::GpuError;
use glimray_render::{LongPath, RenderError};
use std::path::PathBuf;

/// The warning for a scene without light.
pub const UNLIT: &str = "the scene has no light, so its surfaces are black. Add a light, an ambient \
                         light, or a material with emission.";

/// The error for a scene that a camera is to be placed for, if it has nothing of limited size.
pub const UNBOUNDED: &str =
    "cannot frame the scene: it has no bounded geometry. Add an object other than a plane.";

/// The message of a device error, with its remedy.
pub fn gpu(error: &GpuError) -> String {
    match error {
        GpuError::NoBackend { backend, why } => format!(
            "no usable GPU (--backend {backend}): {why}. Omit --backend or choose another one."
        ),
        GpuError::NoSuchAdapter { wanted, present } => format!(
            "no such adapter (--adapter {wanted}): available are {present}. Give a number or part of a \
             name."
        ),
        GpuError::NoDevice { .. } => format!("{error} Try another with --adapter."),
        GpuError::KeptFailing { .. } => {
            format!("{error} Try another adapter with --adapter, or update the driver.")
        }
        GpuError::Limit { .. } => format!(
            "{error} Use a smaller scene or picture, or an adapter with higher limits (see `glimray \
             doctor`)."
        ),
        GpuError::Budget { .. } => format!(
            "{error} Use a smaller scene or picture, or raise --memory-limit if memory allows."
        ),
        GpuError::Internal { .. } => {
            format!("{error} Please report it with the output of `glimray doctor`.")
        }
        GpuError::NoAdapter { .. }
        | GpuError::Lost
        | GpuError::OutOfMemory { .. }
        | GpuError::WrongLanes { .. } => error.to_string(),
    }
}

/// The message of a rendering error, with its remedy.
pub fn render(error: &RenderError) -> String {
    let cause = match error {
        RenderError::Gpu(error) => return gpu(error),
        RenderError::Film(error) => return error.to_string(),
        RenderError::BeyondLecture { .. } => return format!("{error} Use --integrator whitted."),
        RenderError::PathTooLong(cause) => *cause,
        RenderError::TooManyShadowRays { lights, rays, .. } => LongPath::ShadowRays {
            lights: *lights,
            rays: *rays,
        },
    };
    let remedy = match cause {
        LongPath::BruteForce { .. } => "Use --integrator whitted, without --no-bvh.",
        LongPath::ShadowRays { .. } => {
            "Use fewer lights, or fewer samples of area lights (--light-samples 0.1) and more --samples."
        }
        LongPath::Depth { .. } => "Lower --max-depth, or raise --min-throughput.",
        LongPath::Crowded => "Remove duplicate objects and triangles.",
    };
    format!("{error} {remedy}")
}

/// The message of an import error, with its remedy.
pub fn import(error: &ImportError) -> String {
    let mut fault = error.fault().clone();
    if fault.is_in_override() {
        fault.path = PathBuf::from("--set");
    }
    if matches!(error, ImportError::OutsideFolder(_)) {
        fault.todo = "Use --allow-dir DIR to permit".into();
    }
    fault.to_string()
}
