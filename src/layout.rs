//! Every struct and tag that a shader also sees, as the GPU sees it: the same names, members and
//! values as `shaders/types.wesl`. A test compares the two through naga.

use bytemuck::{Pod, Zeroable};

/// "None" for any index.
pub const NONE: u32 = u32::MAX;

/// Marks a child reference as a leaf; see [`leaf_reference`].
pub const LEAF: u32 = 0x8000_0000;
/// Marks a leaf's or a primitive's index as a [`PackedShape`]'s; without it, it is a triangle's.
pub const SHAPE: u32 = 0x4000_0000;
pub const LEAF_COUNT_SHIFT: u32 = 27;
pub const LEAF_COUNT_ONE: u32 = 1 << LEAF_COUNT_SHIFT;
pub const LEAF_COUNT_MASK: u32 = 7 << LEAF_COUNT_SHIFT;
pub const LEAF_FIRST_MASK: u32 = LEAF_COUNT_ONE - 1;
/// Entries of the traversal stack.
pub const STACK_SIZE: u32 = 64;
/// Texels in a row of the geometry images, as a power of two.
pub const IMAGE_WIDTH_LOG2: u32 = 12;

pub const SHAPE_SPHERE: u32 = 0;
pub const SHAPE_PLANE: u32 = 1;

pub const LIGHT_POINT: u32 = 0;
pub const LIGHT_DIRECTIONAL: u32 = 1;
pub const LIGHT_SPOT: u32 = 2;

pub const ATTENUATION_NONE: u32 = 0;
pub const ATTENUATION_INVERSE_SQUARE: u32 = 1;

/// Bit of [`PackedMaterial::flags`].
pub const MATERIAL_TWO_SIDED: u32 = 1;

pub const TRIANGLE_TEST_PLANE: u32 = 0;
pub const TRIANGLE_TEST_MOLLER_TRUMBORE: u32 = 1;
pub const TRIANGLE_TEST_WATERTIGHT: u32 = 2;

pub const VIEW_NORMALS: u32 = 0;
pub const VIEW_DEPTH: u32 = 1;
pub const VIEW_IDS: u32 = 2;
pub const VIEW_HEAT: u32 = 3;

pub const TONE_NONE: u32 = 0;
pub const TONE_ACES: u32 = 1;
pub const TONE_AGX: u32 = 2;
pub const TONE_REINHARD: u32 = 3;

pub const TRANSFER_SRGB: u32 = 0;
pub const TRANSFER_LINEAR: u32 = 1;

/// A node as the shader's `decode_node` reads it: four rows of four words.
pub type PackedNode = [u32; 16];

/// The reference to a leaf of `count` (1 to 8) primitives from `first` (below 2²⁷), shapes or
/// triangles.
pub const fn leaf_reference(first: u32, count: u32, is_shape: bool) -> u32 {
    let kind = if is_shape { SHAPE } else { 0 };
    LEAF | kind | ((count - 1) << LEAF_COUNT_SHIFT) | first
}

/// Declares a struct as plain old data together with a table of its members for the layout test.
macro_rules! packed {
    ($($(#[$doc:meta])* $name:ident { $($(#[$field_doc:meta])* $field:ident: $type:ty,)* })*) => {
        $(
            $(#[$doc])*
            #[repr(C)]
            #[derive(Clone, Copy, Debug, Default, PartialEq, Pod, Zeroable)]
            pub struct $name { $($(#[$field_doc])* pub $field: $type,)* }
        )*

        /// Name, size and members (name, offset) of every packed struct.
        pub const PACKED_STRUCTS: &[(&str, usize, &[(&str, usize)])] = &[
            $((
                stringify!($name),
                size_of::<$name>(),
                &[$((stringify!($field), std::mem::offset_of!($name, $field)),)*],
            ),)*
        ];
    };
}

packed! {
    /// Three corners in render space and the index of each one's [`PackedVertex`].
    PackedTriangle {
        v0: [f32; 3],
        i0: u32,
        v1: [f32; 3],
        i1: u32,
        v2: [f32; 3],
        i2: u32,
    }
    /// What is known at a corner besides its position.
    PackedVertex {
        normal: [f32; 3],
        material: u32,
    }
    /// An analytic shape; the meaning of `position`, `radius` and `normal` depends on `kind`.
    PackedShape {
        position: [f32; 3],
        radius: f32,
        normal: [f32; 3],
        kind: u32,
        material: u32,
        id: u32,
        _pad0: u32,
        _pad1: u32,
    }
    PackedMaterial {
        diffuse: [f32; 3],
        shininess: f32,
        specular: [f32; 3],
        flags: u32,
        ambient: [f32; 3],
        _pad: f32,
    }
    PackedLight {
        position: [f32; 3],
        kind: u32,
        direction: [f32; 3],
        attenuation: u32,
        color: [f32; 3],
        cos_inner: f32,
        cos_outer: f32,
        _pad0: f32,
        _pad1: f32,
        _pad2: f32,
    }
    /// `right` and `up` reach from the middle of the image plane to its edges.
    PackedCamera {
        origin: [f32; 3],
        _pad0: f32,
        forward: [f32; 3],
        _pad1: f32,
        right: [f32; 3],
        _pad2: f32,
        up: [f32; 3],
        _pad3: f32,
    }
    /// The head of the frame buffer; [`PackedLight`]s follow it.
    PackedFrame {
        camera: PackedCamera,
        background: [f32; 3],
        light_count: u32,
        ambient: [f32; 3],
        triangle_count: u32,
        shape_count: u32,
        plane_count: u32,
        _pad0: u32,
        _pad1: u32,
    }
    /// What one submission is to do, and from `tiles_done` on what came of it.
    PackedSlice {
        picture_width: u32,
        picture_height: u32,
        window_x: u32,
        window_y: u32,
        window_width: u32,
        window_height: u32,
        tile_columns: u32,
        tile_count: u32,
        tile_stride: u32,
        first_tile: u32,
        end_tile: u32,
        grid_width: u32,
        first_sample: u32,
        end_sample: u32,
        sample_count: u32,
        seed: u32,
        tiles_done: u32,
        nonfinite_samples: u32,
        longest_path: u32,
        primary: u32,
        primary_hits: u32,
        shadow: u32,
        shadow_blocked: u32,
        _pad: u32,
    }
    PackedTone {
        exposure_scale: f32,
        curve: u32,
        transfer: u32,
        _pad: u32,
    }
}
