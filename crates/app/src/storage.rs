//! Where kernels read the scene from: images or buffers, by the environment or by the kind of the adapter.

use super::error::AppError;
use glimray_render::{ExecutionPolicy, Renderer, Storage};
use schemars::JsonSchema;
use serde::Serialize;
use std::env;

/// The environment variable that chooses: `image`, `buffer`, or `auto`, the default, for what is usual on the adapter.
pub const VARIABLE: &str = "GLIMRAY_FETCH";

/// Why a renderer reads from its storage.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum Reason {
    /// Adapters of this kind usually have it.
    DeviceType,
    /// The environment variable says so.
    Environment,
    /// The scene is too large for the preferred storage on this adapter.
    Limits,
}

impl Reason {
    /// Why a renderer reads from `used`, if the environment requested a storage or none.
    pub fn of(used: Storage, requested: Option<Storage>, usual: Storage) -> Self {
        match requested {
            Some(requested) if requested == used => Self::Environment,
            None if usual == used => Self::DeviceType,
            _ => Self::Limits,
        }
    }

    /// For people, after the storage.
    pub fn phrase(self) -> &'static str {
        match self {
            Self::DeviceType => "as usual on such adapters",
            Self::Environment => "as GLIMRAY_FETCH says",
            Self::Limits => "as it is too large for the others",
        }
    }
}

/// The name of a storage in reports.
pub fn name(storage: Storage) -> &'static str {
    match storage {
        Storage::Image => "image",
        Storage::Buffer => "buffer",
    }
}

/// The storage that the environment requests.
///
/// # Errors
/// The environment variable has an unknown value.
pub fn requested() -> Result<Option<Storage>, AppError> {
    let value = env::var_os(VARIABLE).unwrap_or_default();
    match value.to_str() {
        Some("" | "auto") => Ok(None),
        Some("image") => Ok(Some(Storage::Image)),
        Some("buffer") => Ok(Some(Storage::Buffer)),
        _ => Err(AppError::Usage(format!(
            "cannot choose how kernels read the scene ({VARIABLE}={}): there is no such choice. Set it to image, buffer \
             or auto.",
            value.to_string_lossy()
        ))),
    }
}

/// The policy with the storage that the environment requests.
///
/// # Errors
/// As [`requested`].
pub fn with_requested(policy: ExecutionPolicy) -> Result<ExecutionPolicy, AppError> {
    Ok(ExecutionPolicy {
        storage: requested()?,
        ..policy
    })
}

/// A sentence for people if the environment requests another storage than the renderer reads from.
pub fn refusal(renderer: &Renderer, requested: Option<Storage>) -> Option<String> {
    let used = renderer.storage();
    let requested = requested.filter(|requested| *requested != used)?;
    let (used, requested) = (name(used), name(requested));
    Some(format!(
        "the scene is read from {used}s, not from {requested}s as {VARIABLE} says: it is too large for the \
         {requested}s of this adapter. `glimray doctor` prints its limits."
    ))
}
