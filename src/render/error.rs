//! Why a picture cannot be rendered.

use super::{FilmError, effort::LongPath};
use crate::gpu::GpuError;

/// Why a picture cannot be rendered.
#[derive(Debug, thiserror::Error)]
pub enum RenderError {
    /// The device or its driver failed.
    #[error(transparent)]
    Gpu(#[from] GpuError),
    /// There is no such film.
    #[error(transparent)]
    Film(#[from] FilmError),
    /// The driver ended a shader's loops early, even with one sample in an invocation.
    #[error(
        "too much work in one sample ({0}): this driver ends a shader's loops after 65,535 rounds, and the picture would be wrong."
    )]
    PathTooLong(LongPath),
    /// One sample would keep a GPU busy for longer than drivers allow.
    #[error(
        "too many shadow rays ({lights} lights): every point takes {rays}, at most {limit} are possible before a driver may reset the GPU."
    )]
    TooManyShadowRays {
        /// Of the scene.
        lights: u64,
        /// From each point that a camera ray meets.
        rays: u64,
        /// The most possible.
        limit: u64,
    },
}
