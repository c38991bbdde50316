//! The integrators: what a camera ray computes.
//!
//! To add an integrator, add a variant with its entry in [`TABLE`] and a kernel, or a branch in an existing kernel.

use super::levels::Quantity;
use crate::{
    gpu::Kernel,
    layout::{VIEW_DEPTH, VIEW_HEAT, VIEW_IDS, VIEW_NORMALS, VIEW_UV},
};
use glimray_scene::LightTransport;

/// The algorithm that follows camera rays.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, serde::Serialize, schemars::JsonSchema)]
#[serde(rename_all = "lowercase")]
pub enum Integrator {
    /// Phong's illumination with shadow rays, and recursive reflection and refraction.
    #[default]
    Whitted,
    /// Path tracing: light that comes from everywhere, by the rendering equation (Kajiya 1986).
    Path,
    /// The exercise alone: spheres and triangles, each tested by each ray, and Phong's illumination with shadow rays.
    Lecture,
    /// Shading normals, with components mapped from -1..1 to 0..1; black without a hit.
    Normals,
    /// Distance along the ray in scene units; 0 without a hit.
    Depth,
    /// A colour for each primitive.
    Ids,
    /// Texture coordinates: u in red and v in green, repeating over 0 to 1, with a pattern of 8 by 8 fields;
    /// black without a hit and on meshes without texture coordinates.
    Uv,
    /// Traversal steps.
    Heat,
    /// The samples of each pixel with adaptive sampling; as a fraction of the maximum if developed raw.
    Samples,
}

/// The description of an integrator.
#[derive(Clone, Copy, Debug)]
pub struct IntegratorEntry {
    /// The integrator.
    pub integrator: Integrator,
    /// Name on the command line and in files.
    pub name: &'static str,
    /// Title in menus.
    pub title: &'static str,
    /// A short description.
    pub help: &'static str,
    /// The integrator's kernel.
    pub kernel: Kernel,
    /// The view of the kernel and of developing: one of the `VIEW_` tags.
    pub view: u32,
    /// The content of the integrator's pictures.
    pub shows: Shows,
    /// Whether it computes shading: lights, reflection and refraction matter, and adaptive sampling can judge
    /// its pixels.
    pub is_lit: bool,
    /// Whether its films may hold layers besides radiance, such as those that the denoiser needs.
    pub has_layers: bool,
    /// Whether it needs texture coordinates even without textures.
    pub needs_uvs: bool,
    /// Whether it counts traversal steps.
    pub counts_steps: bool,
}

/// The content of an integrator's pictures, which determines how they are developed by default.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Shows {
    /// Radiance: developed with the tone of the scene.
    Radiance,
    /// False colours: not tone-mapped.
    Colors,
    /// A quantity: shown over the range found in the picture.
    Quantity(Quantity),
}

/// All integrators, in menu order.
pub const TABLE: [IntegratorEntry; 9] = [
    IntegratorEntry {
        kernel: Kernel::WHITTED,
        shows: Shows::Radiance,
        is_lit: true,
        has_layers: true,
        ..debug_view(
            Integrator::Whitted,
            ("whitted", "Classical (Whitted)"),
            "Phong shading with shadows, reflection and refraction",
            VIEW_NORMALS,
        )
    },
    IntegratorEntry {
        kernel: Kernel::PATH_TRACE,
        shows: Shows::Radiance,
        is_lit: true,
        has_layers: true,
        ..debug_view(
            Integrator::Path,
            ("path", "Path tracing"),
            "unbiased global illumination with physically based materials",
            VIEW_NORMALS,
        )
    },
    IntegratorEntry {
        kernel: Kernel::LECTURE,
        shows: Shows::Radiance,
        is_lit: true,
        ..debug_view(
            Integrator::Lecture,
            ("lecture", "Lecture"),
            "the exercise alone: spheres and triangles, Phong shading with shadows",
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
            ("heat", "BVH heatmap"),
            "BVH traversal steps of each ray, from black through blue to white",
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
            "sample counts of adaptive sampling, from black to white",
            VIEW_NORMALS,
        )
    },
];

/// The entry of a debug view.
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
        has_layers: false,
        needs_uvs: false,
        counts_steps: false,
    }
}

impl Integrator {
    /// The description.
    pub const fn entry(self) -> &'static IntegratorEntry {
        &TABLE_IN_PLACE[self as usize]
    }

    /// The integrator with this name.
    pub fn named(name: &str) -> Option<Self> {
        let entry = TABLE.iter().find(|entry| entry.name == name)?;
        Some(entry.integrator)
    }

    /// Whether it shades as [`Self::Whitted`] does, so that it shows [`glimray_scene::Scene::bake_classical_maps`].
    pub fn is_classical(self) -> bool {
        matches!(self, Self::Whitted | Self::Samples)
    }

    /// The quantity it measures; `None` if it shows colours.
    pub fn quantity(self) -> Option<Quantity> {
        match self.entry().shows {
            Shows::Quantity(quantity) => Some(quantity),
            Shows::Radiance | Shows::Colors => None,
        }
    }
}

impl From<LightTransport> for Integrator {
    fn from(transport: LightTransport) -> Self {
        match transport {
            LightTransport::Whitted => Self::Whitted,
            LightTransport::Path => Self::Path,
        }
    }
}

impl From<Integrator> for LightTransport {
    /// Debug views count as classical.
    fn from(integrator: Integrator) -> Self {
        match integrator {
            Integrator::Path => Self::Path,
            _ => Self::Whitted,
        }
    }
}

static TABLE_IN_PLACE: [IntegratorEntry; TABLE.len()] = TABLE;
