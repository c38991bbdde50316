//! Errors of the renderer.

use super::{FilmError, effort::LongPath};
use crate::gpu::GpuError;

/// An error of the renderer.
#[derive(Debug, thiserror::Error)]
pub enum RenderError {
    /// The device or its driver failed.
    #[error(transparent)]
    Gpu(#[from] GpuError),
    /// The film does not exist as requested.
    #[error(transparent)]
    Film(#[from] FilmError),
    /// The driver ended the loops of a shader early, even with one sample per invocation.
    #[error(
        "too much work in one sample ({0}): this driver ends the loops of a shader after 65,535 iterations, so the picture would be wrong."
    )]
    PathTooLong(LongPath),
    /// One sample would keep the GPU busy for longer than drivers allow.
    #[error(
        "too many shadow rays ({lights} lights): every point needs {rays}, at most {limit} are possible before a driver may reset the GPU."
    )]
    TooManyShadowRays {
        /// Number of lights of the scene.
        lights: u64,
        /// Shadow rays from each hit point of a camera ray.
        rays: u64,
        /// The maximum.
        limit: u64,
    },
    /// The scene has more than [`crate::Integrator::Lecture`] can show.
    #[error("cannot render the scene as the exercise alone: it has {parts}.")]
    BeyondLecture {
        /// The names of the other parts, separated by commas.
        parts: String,
    },
}
