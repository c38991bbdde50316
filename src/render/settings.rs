//! What is to be rendered and how, apart from the scene.

use crate::{
    gpu::MEMORY_LIMIT_BYTES,
    scene::{Antialias, Filter, OutputDefaults},
};

/// The share in a sample below which rays are not sent, unless told otherwise: half of what shows
/// in 8 bits.
pub const MIN_THROUGHPUT: f32 = 1.0 / 512.0;

/// Settings of one picture. Together with scene, frame and seed they determine every pixel.
#[derive(Clone, Debug, PartialEq)]
pub struct Settings {
    /// Width and height of the whole picture in pixels, at least 1.
    pub size: (u32, u32),
    /// Part of the picture to render: x0, y0, x1, y1 in pixels, the last two exclusive.
    pub crop: Option<[u32; 4]>,
    /// Samples per pixel, at least 1.
    pub samples: u32,
    /// Where in a pixel its samples lie.
    pub antialias: Antialias,
    /// The noise at which adaptive sampling stops; see [`Antialias::Adaptive`]. Above 0.
    pub noise: f32,
    /// What samples are weighted by; without effect where they all lie at the centre.
    pub filter: Filter,
    /// Half the filter's width in pixels, above 0.
    pub filter_radius: f32,
    /// Factor on the samples of every area light, above 0; each has at least one all the same.
    pub light_samples: f32,
    /// What a camera ray brings back.
    pub integrator: Integrator,
    /// How rays meet triangles.
    pub triangle_test: TriangleTest,
    /// Tests every primitive for every ray instead of walking the tree. For checking it.
    pub brute_force: bool,
    /// Chooses the random numbers.
    pub seed: u32,
    /// Bounces after the first hit; 0 is local shading only.
    pub max_depth: u32,
    /// Mirrored and refracted rays are sent whose share in a sample, the mean of the channels, is at
    /// least this, 0 to 1.
    pub min_throughput: f32,
    /// Whether [`super::Stats::rays`] is kept.
    pub count_rays: bool,
    /// Most memory that scene and picture may take, in bytes.
    pub memory_limit_bytes: u64,
    /// Through what the shader reads the scene.
    pub fetch: Fetch,
    /// How work is cut into submissions.
    pub slicing: Slicing,
}

impl Default for Settings {
    fn default() -> Self {
        Self {
            size: (640, 480),
            crop: None,
            samples: 1,
            antialias: Antialias::None,
            noise: 0.01,
            filter: Filter::Box,
            filter_radius: Filter::Box.default_radius(),
            light_samples: 1.0,
            integrator: Integrator::Whitted,
            triangle_test: TriangleTest::Watertight,
            brute_force: false,
            seed: 0,
            max_depth: 5,
            min_throughput: MIN_THROUGHPUT,
            count_rays: false,
            memory_limit_bytes: MEMORY_LIMIT_BYTES,
            fetch: Fetch::Auto,
            slicing: Slicing::default(),
        }
    }
}

impl From<&OutputDefaults> for Settings {
    /// What the scene says, and everything else by default.
    fn from(output: &OutputDefaults) -> Self {
        let antialias = if output.samples > 1 {
            Antialias::Stratified
        } else {
            Antialias::None
        };
        Self {
            size: output.size,
            samples: output.samples,
            antialias: output.antialias.unwrap_or(antialias),
            noise: output.noise,
            filter: output.filter,
            filter_radius: (output.filter_radius).unwrap_or(output.filter.default_radius()),
            light_samples: output.light_samples,
            max_depth: output.max_depth,
            ..Self::default()
        }
    }
}

impl Settings {
    /// Whether pixels stop when they are good enough.
    pub fn is_adaptive(&self) -> bool {
        self.antialias == Antialias::Adaptive && self.is_lit()
    }

    /// Whether lights count: the integrator traces more than what is first hit.
    pub(super) fn is_lit(&self) -> bool {
        matches!(self.integrator, Integrator::Whitted | Integrator::Samples)
    }

    /// The rectangle to render: x, y, width, height.
    pub fn region(&self) -> [u32; 4] {
        let [x0, y0, x1, y1] = self.crop.unwrap_or([0, 0, self.size.0, self.size.1]);
        [x0, y0, x1 - x0, y1 - y0]
    }
}

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
    /// The samples that adaptive sampling spent; raw, as a share of those allowed.
    Samples,
}

/// How a ray is tested against a triangle.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum TriangleTest {
    /// The plane, then whether the point is inside.
    Plane,
    /// Möller and Trumbore 1997.
    MollerTrumbore,
    /// Woop, Benthin and Wald 2013: no ray slips between neighbours.
    #[default]
    Watertight,
}

/// Through what the shader reads nodes and triangles; the picture is the same.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Fetch {
    /// Images on software adapters, buffers elsewhere where they are large enough.
    #[default]
    Auto,
    /// Storage images: the faster way on software adapters.
    Image,
    /// Storage buffers: the faster way on most GPUs, where one binding can hold the scene.
    Buffer,
}

/// How work is cut into submissions; the picture is the same.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Slicing {
    /// Time that one submission should take, in seconds.
    pub target_seconds: f64,
    /// Most tiles of 8x8 pixels in a submission, at least 1.
    pub max_tiles: u32,
    /// Most samples per pixel in a submission, at least 1.
    pub max_samples: u32,
    /// Longest side of a window, the part of the picture that is on the GPU at a time, in pixels;
    /// 8 to 2048.
    pub window_side: u32,
    /// Whether the film comes to the host after each submission, so that a lost device costs no more
    /// than one. Without, it comes when it is asked for, and a loss is an error.
    pub host_copy: bool,
}

impl Default for Slicing {
    fn default() -> Self {
        Self {
            target_seconds: 0.1,
            max_tiles: u32::MAX,
            max_samples: 16,
            window_side: 2048,
            host_copy: true,
        }
    }
}
