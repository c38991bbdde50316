//! The inputs of a render on a device.

use super::{policy::ExecutionPolicy, settings::RenderSettings};
use crate::pack::{PackedScene, PackedView};
use std::sync::Arc;

/// The inputs of a render.
#[derive(Clone, Copy)]
pub struct Task<'a> {
    pub scene: &'a Arc<PackedScene>,
    pub view: &'a PackedView,
    pub settings: &'a RenderSettings,
    pub policy: &'a ExecutionPolicy,
    /// Film rows of the largest film tile.
    pub film_rows: usize,
}
