//! How work is done, which never shows in a picture.

use crate::gpu::MEMORY_LIMIT_BYTES;

/// How a picture is made: with any policy it is the same.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ExecutionPolicy {
    /// How work is cut into submissions.
    pub slicing: Slicing,
    /// Whether the film comes to the host after each submission, so that a lost device costs no more
    /// than one. Without, it comes when it is asked for, and a loss is an error.
    pub host_copy: bool,
    /// Through what the shader reads the scene.
    pub fetch: Fetch,
    /// Most memory that scene and picture may take, in bytes.
    pub memory_limit_bytes: u64,
    /// Whether [`super::Stats::rays`] is kept.
    pub count_rays: bool,
}

impl Default for ExecutionPolicy {
    fn default() -> Self {
        Self {
            slicing: Slicing::default(),
            host_copy: true,
            fetch: Fetch::Auto,
            memory_limit_bytes: MEMORY_LIMIT_BYTES,
            count_rays: false,
        }
    }
}

/// Through what the shader reads nodes and triangles.
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

/// How work is cut into submissions.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Slicing {
    /// Time that one submission should take, in seconds.
    pub target_seconds: f64,
    /// Most groups of 8x8 pixels in a submission, at least 1.
    pub max_groups: u32,
    /// Most samples per pixel in a submission, at least 1.
    pub max_samples: u32,
    /// Longest side of a tile, the part of the picture that is on the GPU at a time, in pixels;
    /// 8 to 2048.
    pub tile_side: u32,
}

impl Default for Slicing {
    fn default() -> Self {
        Self {
            target_seconds: 0.1,
            max_groups: u32::MAX,
            max_samples: 16,
            tile_side: 2048,
        }
    }
}
