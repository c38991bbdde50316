//! What a device is to render.

use super::{policy::ExecutionPolicy, settings::RenderSettings};
use crate::pack::{PackedScene, PackedView};
use std::sync::Arc;

/// What is to be rendered.
#[derive(Clone, Copy)]
pub struct Task<'a> {
    pub scene: &'a Arc<PackedScene>,
    pub view: &'a PackedView,
    pub settings: &'a RenderSettings,
    pub policy: &'a ExecutionPolicy,
    /// Rows of the film of the largest tile.
    pub film_rows: usize,
}
