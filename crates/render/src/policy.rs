//! How the work is executed. The policy never affects the picture.

use crate::gpu::{Gpu, MEMORY_LIMIT_BYTES};

/// How a picture is rendered. The policy does not affect the result.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ExecutionPolicy {
    /// How work is split into submissions.
    pub slicing: Slicing,
    /// Whether the film is read back after each submission, so that a lost device costs at most one submission.
    /// Otherwise it is read back on request, and a loss is an error.
    pub host_copy: bool,
    /// How shaders read the scene.
    pub fetch: Fetch,
    /// The storage to read the scene from, for [`Fetch::Auto`] and [`Fetch::Packet`]. By default the kind of the adapter
    /// decides.
    pub storage: Option<Storage>,
    /// How many entries the stack of a walk has in fast memory.
    pub stack: Stack,
    /// How many pictures like this one will be rendered, such as the frames of an animation, at least 1: a kernel that
    /// traces faster but takes longer to compile may be worth it for all of them together.
    pub picture_count: u32,
    /// Memory limit for scene and picture, in bytes.
    pub memory_limit_bytes: u64,
    /// Whether to count [`super::Stats::rays`].
    pub count_rays: bool,
}

impl Default for ExecutionPolicy {
    fn default() -> Self {
        Self {
            slicing: Slicing::default(),
            host_copy: true,
            fetch: Fetch::Auto,
            stack: Stack::Usual,
            storage: None,
            picture_count: 1,
            memory_limit_bytes: MEMORY_LIMIT_BYTES,
            count_rays: false,
        }
    }
}

/// How shaders read nodes and triangles, and whether neighbouring rays are traced together.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Fetch {
    /// From [`ExecutionPolicy::storage`], otherwise images on software adapters and buffers elsewhere; from the other
    /// one if the adapter's are too small for the scene. Larger pictures, and smaller ones of which there are many, are
    /// traced in packets where the adapter can do so and the scene is in images.
    #[default]
    Auto,
    /// Storage images: faster on software adapters.
    Image,
    /// Storage buffers: faster on most GPUs, if one binding can hold the scene.
    Buffer,
    /// As `Auto`, but also small pictures are traced in packets, whose kernels take longer to compile.
    Packet,
}

impl Fetch {
    /// Whether rays may be traced in packets.
    pub(super) fn allows_packets(self) -> bool {
        matches!(self, Self::Auto | Self::Packet)
    }
}

/// The size of the stack of a ray's walk through the trees, where an array is slow: on software adapters it is in registers,
/// and each step moves all of its entries; where scenes are in buffers it is in workgroup memory.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord)]
pub enum Stack {
    /// The number of entries that rays usually need. If one needs more, that part of the picture is rendered again, and the rest too,
    /// with `Deepest`.
    #[default]
    Usual,
    /// Enough entries for the deepest path through the BVHs.
    Deepest,
}

/// Where shaders read nodes and triangles from.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Storage {
    /// Storage images.
    Image,
    /// Storage buffers.
    Buffer,
}

impl Storage {
    /// The usually faster storage on an adapter of this kind. Software adapters read images faster, if kernels may read them.
    pub fn usual(gpu: &Gpu) -> Self {
        match gpu.is_cpu() && gpu.reads_images() {
            true => Self::Image,
            false => Self::Buffer,
        }
    }
}

/// How work is split into submissions.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Slicing {
    /// Target time of a submission, in seconds.
    pub target_seconds: f64,
    /// Maximum number of workgroups of 8x8 pixels in a submission, at least 1.
    pub max_groups: u32,
    /// Maximum number of samples per pixel in a submission, at least 1.
    pub max_samples: u32,
    /// Maximum side of a film tile, the part of the picture that is on the GPU at a time, in pixels; 8 to 2048.
    pub tile_side: u32,
    /// Whether a pass over a path-traced picture that can be watched, because it takes a while, at most doubles the samples, so
    /// that no part is much noisier than another. On some adapters this costs a few percent of the time.
    pub even_passes: bool,
}

impl Default for Slicing {
    fn default() -> Self {
        Self {
            target_seconds: 0.1,
            max_groups: u32::MAX,
            max_samples: 32,
            tile_side: 2048,
            even_passes: false,
        }
    }
}
