//! What a camera ray brings back.
//!
//! Another integrator is a variant here with its entry in [`TABLE`], and its kernel; where it shares a kernel,
//! the branch there.

use super::levels::Quantity;
use crate::{
    gpu::Kernel,
    layout::{VIEW_DEPTH, VIEW_HEAT, VIEW_IDS, VIEW_NORMALS, VIEW_UV},
};

/// What a camera ray brings back.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Integrator {
    /// Phong's illumination with shadow rays, and recursive reflection and refraction.
    #[default]
    Whitted,
    /// Shading normals, components from -1..1 to 0..1; black where nothing is hit.
    Normals,
    /// Distance along the ray in scene units; 0 where nothing is hit.
    Depth,
    /// A colour for each primitive.
    Ids,
    /// Texture coordinates: u in red and v in green, from 0 to 1 and again, over a pattern of 8 by 8 fields;
    /// black where nothing is hit and on meshes that have none.
    Uv,
    /// Steps of the tree walk.
    Heat,
    /// The samples that adaptive sampling spent; raw, as a fraction of those allowed.
    Samples,
}

/// Everything that sets one integrator apart from the others.
#[derive(Clone, Copy, Debug)]
pub struct IntegratorEntry {
    /// Which it is.
    pub integrator: Integrator,
    /// Its word on the command line and in files.
    pub name: &'static str,
    /// Its title in menus.
    pub title: &'static str,
    /// What it shows, in a few words.
    pub help: &'static str,
    /// Its kernel.
    pub kernel: Kernel,
    /// The kernel's view, and how the film is developed: one of the `VIEW_` tags.
    pub view: u32,
    /// What the pictures are of.
    pub shows: Shows,
    /// Whether it goes on from what a camera ray meets: lights, mirrors and glass matter, and adaptive
    /// sampling can judge its pixels.
    pub is_lit: bool,
    /// Whether it looks up u and v where no texture asks for them.
    pub needs_uvs: bool,
    /// Whether rounds of the tree walk are counted.
    pub counts_steps: bool,
}

/// What the pictures of an integrator are of, which says how they are developed unless told otherwise.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Shows {
    /// Radiance: as the scene says.
    Radiance,
    /// Colours that stand for something: as they are.
    Colors,
    /// A quantity: over the range found.
    Quantity(Quantity),
}

/// All integrators, in the order in which they are offered.
pub const TABLE: [IntegratorEntry; 7] = [
    IntegratorEntry {
        kernel: Kernel::WHITTED,
        shows: Shows::Radiance,
        is_lit: true,
        ..debug_view(
            Integrator::Whitted,
            ("whitted", "Picture"),
            "Phong shading, shadows, mirrors and glass",
            VIEW_NORMALS,
        )
    },
    debug_view(
        Integrator::Normals,
        ("normals", "Normals"),
        "shading normals as colours",
        VIEW_NORMALS,
    ),
    IntegratorEntry {
        shows: Shows::Quantity(Quantity::Distance),
        ..debug_view(
            Integrator::Depth,
            ("depth", "Distances"),
            "distances, from white for the nearest to dark grey for the farthest",
            VIEW_DEPTH,
        )
    },
    debug_view(
        Integrator::Ids,
        ("ids", "Primitives"),
        "one colour for each primitive",
        VIEW_IDS,
    ),
    IntegratorEntry {
        needs_uvs: true,
        ..debug_view(
            Integrator::Uv,
            ("uv", "Texture coordinates"),
            "texture coordinates as red and green",
            VIEW_UV,
        )
    },
    IntegratorEntry {
        shows: Shows::Quantity(Quantity::Work),
        counts_steps: true,
        ..debug_view(
            Integrator::Heat,
            ("heat", "Work in the tree"),
            "steps of each ray through the tree, from black over blue to white",
            VIEW_HEAT,
        )
    },
    IntegratorEntry {
        kernel: Kernel::WHITTED,
        shows: Shows::Quantity(Quantity::Samples),
        is_lit: true,
        ..debug_view(
            Integrator::Samples,
            ("samples", "Samples"),
            "the samples that adaptive sampling spent, from black to white",
            VIEW_NORMALS,
        )
    },
];

/// Colours for what a camera ray meets.
const fn debug_view(
    integrator: Integrator,
    (name, title): (&'static str, &'static str),
    help: &'static str,
    view: u32,
) -> IntegratorEntry {
    IntegratorEntry {
        integrator,
        name,
        title,
        help,
        kernel: Kernel::DEBUG_VIEW,
        view,
        shows: Shows::Colors,
        is_lit: false,
        needs_uvs: false,
        counts_steps: false,
    }
}

impl Integrator {
    /// Everything about it.
    pub const fn entry(self) -> &'static IntegratorEntry {
        &TABLE_IN_PLACE[self as usize]
    }

    /// The one with this name.
    pub fn named(name: &str) -> Option<Self> {
        let entry = TABLE.iter().find(|entry| entry.name == name)?;
        Some(entry.integrator)
    }

    /// What it measures; `None` for those that show colours.
    pub fn quantity(self) -> Option<Quantity> {
        match self.entry().shows {
            Shows::Quantity(quantity) => Some(quantity),
            Shows::Radiance | Shows::Colors => None,
        }
    }
}

static TABLE_IN_PLACE: [IntegratorEntry; TABLE.len()] = TABLE;
