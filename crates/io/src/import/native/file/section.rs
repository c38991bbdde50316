//! The section plane of a native scene.

use crate::import::native::values::{Direction, Number};
use glimray_scene::Section;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// A plane that cuts away what lies beyond it. Closed meshes and shapes are solid: the plane shows their inside as a flat face of
/// their material. Lights without a surface stay.
#[derive(Clone, Copy, Debug, Deserialize, Serialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct SectionTable {
    /// The direction towards what is cut away.
    pub normal: Direction,
    /// The distance of the plane from the origin in that direction; default 0.
    pub offset: Option<Number>,
}

impl From<SectionTable> for Section {
    fn from(table: SectionTable) -> Self {
        Self {
            normal: table.normal.0,
            offset: table.offset.map_or(0.0, |offset| offset.0),
        }
    }
}

impl From<Section> for SectionTable {
    fn from(section: Section) -> Self {
        Self {
            normal: section.normal.into(),
            offset: Some(section.offset.into()),
        }
    }
}
