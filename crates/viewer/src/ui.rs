//! Panels, dialogs and overlays: what is drawn.

pub(crate) mod context;
pub(crate) mod dialogs;
pub(crate) mod dragged;
pub(crate) mod focus_ring;
pub(crate) mod ground;
pub(crate) mod overlay;
pub(crate) mod panels;
pub(crate) mod region;
pub(crate) mod section_handle;
pub(crate) mod shield;
pub(crate) mod silhouette;
pub(crate) mod sun_dial;
pub(crate) mod tabs;
pub(crate) mod textures;
pub(crate) mod theme;
mod thumbnails;
pub(crate) mod tools;
pub(crate) mod world_lines;
pub(crate) mod world_painter;
