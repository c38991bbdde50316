//! Every struct and tag that a shader also sees, as the GPU sees it: the same names, members and
//! values as `shaders/types.wesl`. A test compares the two through naga.

use bytemuck::{Pod, Zeroable};

/// "None" for any index.
pub const NONE: u32 = u32::MAX;

/// Marks a child reference as a leaf; see [`leaf_reference`].
pub const LEAF: u32 = 0x8000_0000;
/// Marks a leaf's or a primitive's index as a [`PackedShape`]'s; without it, it is a triangle's.
pub const SHAPE: u32 = 0x4000_0000;
/// Lowest bit of a leaf reference's count less one, which has three bits.
pub const LEAF_COUNT_SHIFT: u32 = 27;
/// One more primitive in a leaf reference.
pub const LEAF_COUNT_ONE: u32 = 1 << LEAF_COUNT_SHIFT;
/// The bits of a leaf reference's count less one.
pub const LEAF_COUNT_MASK: u32 = 7 << LEAF_COUNT_SHIFT;
/// The bits of a leaf reference's first primitive.
pub const LEAF_FIRST_MASK: u32 = LEAF_COUNT_ONE - 1;
/// Entries of the traversal stack.
pub const STACK_SIZE: u32 = 96;
/// Texels in a row of the geometry images, as a power of two.
pub const IMAGE_WIDTH_LOG2: u32 = 12;

/// [`PackedShape::kind`]: a sphere.
pub const SHAPE_SPHERE: u32 = 0;
/// [`PackedShape::kind`]: an infinite plane.
pub const SHAPE_PLANE: u32 = 1;
/// [`PackedShape::kind`]: [`crate::scene::Form::Disc`].
pub const SHAPE_DISC: u32 = 2;
/// [`PackedShape::kind`]: [`crate::scene::Form::Rectangle`].
pub const SHAPE_RECTANGLE: u32 = 3;
/// [`PackedShape::kind`]: [`crate::scene::Form::Box`].
pub const SHAPE_BOX: u32 = 4;
/// [`PackedShape::kind`]: [`crate::scene::Form::Cone`].
pub const SHAPE_CONE: u32 = 5;
/// [`PackedShape::kind`]: [`crate::scene::Form::Torus`].
pub const SHAPE_TORUS: u32 = 6;
/// [`PackedShape::kind`]: [`crate::scene::Form::Ellipsoid`].
pub const SHAPE_ELLIPSOID: u32 = 7;
/// Bit of [`PackedShape::flags`]: a cone has both of its caps.
pub const SHAPE_CAPPED: u32 = 1;

/// [`PackedLight::kind`]: shines from a point, evenly all round.
pub const LIGHT_POINT: u32 = 0;
/// [`PackedLight::kind`]: shines along one direction, from infinitely far.
pub const LIGHT_DIRECTIONAL: u32 = 1;
/// [`PackedLight::kind`]: shines from a point into a cone.
pub const LIGHT_SPOT: u32 = 2;
/// [`PackedLight::kind`]: a parallelogram that shines to the side of its normal.
pub const LIGHT_RECTANGLE: u32 = 3;
/// [`PackedLight::kind`]: a disc that shines to the side of its normal.
pub const LIGHT_DISC: u32 = 4;
/// [`PackedLight::kind`]: a sphere.
pub const LIGHT_SPHERE: u32 = 5;

/// [`PackedLight::attenuation`]: the same at every distance.
pub const ATTENUATION_NONE: u32 = 0;
/// [`PackedLight::attenuation`]: 1/r² at distance r.
pub const ATTENUATION_INVERSE_SQUARE: u32 = 1;

/// Bit of [`PackedMaterial::flags`]: the shading normal is turned to the side the ray comes from.
pub const MATERIAL_TWO_SIDED: u32 = 1;
/// Bit of [`PackedMaterial::flags`]: Fresnel's equations split reflected and transmitted light.
pub const MATERIAL_FRESNEL: u32 = 2;
/// Bit of [`PackedMaterial::flags`]: with [`MATERIAL_FRESNEL`], by Schlick's approximation.
pub const MATERIAL_SCHLICK: u32 = 4;
/// Bit of [`PackedMaterial::flags`]: [`crate::scene::Mixing::Sum`].
pub const MATERIAL_SUM: u32 = 8;
/// Bit of [`PackedMaterial::flags`]: [`crate::scene::Mixing::Blend`].
pub const MATERIAL_BLEND: u32 = 16;
/// Rows of 16 bytes of a [`PackedMaterial`].
pub const MATERIAL_ROWS: u32 = 8;
/// Rows of 16 bytes of a [`PackedTexture`].
pub const TEXTURE_ROWS: u32 = 6;
/// No texture, in the 16 bits that a [`PackedMaterial`] has for each.
pub const NO_TEXTURE: u32 = 0xffff;

/// [`PackedTexture::kind`]: cubes of two colours.
pub const PATTERN_CHECKER: u32 = 0;
/// [`PackedTexture::kind`]: layers of two colours along x.
pub const PATTERN_STRIPES: u32 = 1;
/// [`PackedTexture::kind`]: from one colour to another along x.
pub const PATTERN_GRADIENT: u32 = 2;
/// [`PackedTexture::kind`]: clouds of two colours.
pub const PATTERN_NOISE: u32 = 3;
/// [`PackedTexture::kind`]: a picture over u and v.
pub const PATTERN_PICTURE: u32 = 4;
/// Bit of [`PackedTexture::flags`]: the pattern lies in u and v, not in space.
pub const TEXTURE_UV: u32 = 1;
/// Bit of [`PackedTexture::flags`]: texels have hard edges.
pub const TEXTURE_NEAREST: u32 = 2;

/// Override `BACKGROUND`: [`crate::scene::Background::Color`].
pub const BACKGROUND_COLOR: u32 = 0;
/// Override `BACKGROUND`: [`crate::scene::Background::Gradient`].
pub const BACKGROUND_GRADIENT: u32 = 1;
/// Override `BACKGROUND`: [`crate::scene::Background::Picture`].
pub const BACKGROUND_PICTURE: u32 = 2;

/// Override `FILTER`: [`crate::scene::Filter::Box`].
pub const FILTER_BOX: u32 = 0;
/// Override `FILTER`: [`crate::scene::Filter::Tent`].
pub const FILTER_TENT: u32 = 1;
/// Override `FILTER`: [`crate::scene::Filter::Gaussian`].
pub const FILTER_GAUSSIAN: u32 = 2;
/// Override `FILTER`: [`crate::scene::Filter::BlackmanHarris`].
pub const FILTER_BLACKMAN_HARRIS: u32 = 3;
/// Override `FILTER`: [`crate::scene::Filter::Mitchell`].
pub const FILTER_MITCHELL: u32 = 4;

/// Override `TRIANGLE_TEST`: [`crate::render::TriangleTest::Plane`].
pub const TRIANGLE_TEST_PLANE: u32 = 0;
/// Override `TRIANGLE_TEST`: [`crate::render::TriangleTest::MollerTrumbore`].
pub const TRIANGLE_TEST_MOLLER_TRUMBORE: u32 = 1;
/// Override `TRIANGLE_TEST`: [`crate::render::TriangleTest::Watertight`].
pub const TRIANGLE_TEST_WATERTIGHT: u32 = 2;

/// Override `VIEW`: [`crate::render::Integrator::Normals`].
pub const VIEW_NORMALS: u32 = 0;
/// Override `VIEW`: [`crate::render::Integrator::Depth`].
pub const VIEW_DEPTH: u32 = 1;
/// Override `VIEW`: [`crate::render::Integrator::Ids`].
pub const VIEW_IDS: u32 = 2;
/// Override `VIEW`: [`crate::render::Integrator::Heat`].
pub const VIEW_HEAT: u32 = 3;

/// [`PackedTone::curve`]: [`crate::scene::ToneCurve::None`].
pub const TONE_NONE: u32 = 0;
/// [`PackedTone::curve`]: [`crate::scene::ToneCurve::Aces`].
pub const TONE_ACES: u32 = 1;
/// [`PackedTone::curve`]: [`crate::scene::ToneCurve::Agx`].
pub const TONE_AGX: u32 = 2;
/// [`PackedTone::curve`]: [`crate::scene::ToneCurve::Reinhard`].
pub const TONE_REINHARD: u32 = 3;

/// [`PackedTone::transfer`]: [`crate::scene::Transfer::Srgb`].
pub const TRANSFER_SRGB: u32 = 0;
/// [`PackedTone::transfer`]: [`crate::scene::Transfer::Linear`].
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
        /// First corner.
        v0: [f32; 3],
        /// Index of its [`PackedVertex`].
        i0: u32,
        /// Second corner, of barycentric weight b1.
        v1: [f32; 3],
        /// Index of its [`PackedVertex`].
        i1: u32,
        /// Third corner, of barycentric weight b2.
        v2: [f32; 3],
        /// Index of its [`PackedVertex`].
        i2: u32,
    }
    /// What is known at a corner besides its position.
    PackedVertex {
        /// Unit shading normal.
        normal: [f32; 3],
        /// Index of a [`PackedMaterial`].
        material: u32,
    }
    /// An analytic shape; `kind` says what its sizes mean. All but spheres and planes are canonical
    /// surfaces in a space of their own, into which the rows lead.
    PackedShape {
        /// Sphere: its centre. Plane: a point on it. Others: their space's origin. In render space.
        position: [f32; 3],
        /// [`SHAPE_SPHERE`], [`SHAPE_PLANE`] and so on.
        kind: u32,
        /// What a point less `position` is multiplied by for its x in the shape's space. Plane: what a
        /// point is multiplied by for u, to which `size0` is added.
        row_x: [f32; 3],
        /// Sphere: radius. Disc: radius of its hole. Cone: radius at the bottom. Torus: small radius.
        /// The larger radius of a cone is 1.
        size0: f32,
        /// The same for y. Plane: its unit normal.
        row_y: [f32; 3],
        /// Cone: radius at the top.
        size1: f32,
        /// The same for z. Plane: for v, to which `size1` is added.
        row_z: [f32; 3],
        /// [`SHAPE_CAPPED`] or 0.
        flags: u32,
        /// Index of a [`PackedMaterial`].
        material: u32,
        /// Index in [`crate::scene::Scene::shapes`], or of the lights behind them.
        id: u32,
        #[doc(hidden)]
        _pad0: u32,
        #[doc(hidden)]
        _pad1: u32,
    }
    /// How a surface answers light; colours per channel, 0 or more.
    PackedMaterial {
        /// k_d.
        diffuse: [f32; 3],
        /// The exponent α.
        shininess: f32,
        /// k_s.
        specular: [f32; 3],
        /// Bits such as [`MATERIAL_TWO_SIDED`].
        flags: u32,
        /// Multiplies [`PackedFrame::ambient`].
        ambient: [f32; 3],
        /// Share of the light that is not transmitted, in 0..=1.
        opacity: f32,
        /// Share that is mirrored, before Fresnel's split.
        reflect: [f32; 3],
        /// Index of refraction of what is inside, above 0.
        ior: f32,
        /// Share that is transmitted, before Fresnel's split.
        transmit: [f32; 3],
        /// Where media overlap, the higher one counts.
        priority: i32,
        /// Of what is inside, per unit length.
        absorption: [f32; 3],
        #[doc(hidden)]
        _pad0: f32,
        /// Radiance of the surface itself.
        emission: [f32; 3],
        #[doc(hidden)]
        _pad1: f32,
        /// 16-bit indices of [`PackedTexture`]s or [`NO_TEXTURE`]: diffuse and specular, reflect and
        /// transmit, ambient and emission, the former in the lower half.
        textures: [u32; 3],
        #[doc(hidden)]
        _pad2: u32,
    }
    /// A colour that varies over a surface, and multiplies one of a material.
    PackedTexture {
        /// One colour.
        color_a: [f32; 3],
        /// [`PATTERN_CHECKER`] and so on.
        kind: u32,
        /// The other.
        color_b: [f32; 3],
        /// [`TEXTURE_UV`] and [`TEXTURE_NEAREST`], or 0.
        flags: u32,
        /// Affine row: (x, y, z, 1) in render space or (u, v, 0, 1) to x in the pattern's space.
        row_x: [f32; 4],
        /// The same for y.
        row_y: [f32; 4],
        /// The same for z.
        row_z: [f32; 4],
        /// Picture: index of its first texel.
        first_texel: u32,
        /// Picture: in texels.
        width: u32,
        /// Picture: in texels.
        height: u32,
        /// Noise: number of octaves, 1 to 16.
        octaves: u32,
    }
    /// A light; `kind` says which members count.
    PackedLight {
        /// Where it is, or its centre, in render space.
        position: [f32; 3],
        /// [`LIGHT_POINT`], [`LIGHT_DIRECTIONAL`] and so on.
        kind: u32,
        /// Directional and spot: the unit direction in which the light travels. Rectangle and disc:
        /// the unit normal.
        direction: [f32; 3],
        /// [`ATTENUATION_NONE`], which directional lights always have, or
        /// [`ATTENUATION_INVERSE_SQUARE`].
        attenuation: u32,
        /// Linear radiance, at distance 1 (of area lights along their normal) where it falls off.
        color: [f32; 3],
        /// Spot: cosine of the angle off the axis up to which it has its full strength.
        cos_inner: f32,
        /// Rectangle and disc: from the centre to the middle of an edge.
        edge_u: [f32; 3],
        /// Spot: cosine of the angle off the axis beyond which it gives nothing.
        cos_outer: f32,
        /// Rectangle and disc: from the centre to the middle of the other edge.
        edge_v: [f32; 3],
        /// Sphere: its radius.
        radius: f32,
        /// Shadow rays for each shaded point, at least 1.
        sample_count: u32,
        #[doc(hidden)]
        _pad0: u32,
        #[doc(hidden)]
        _pad1: u32,
        #[doc(hidden)]
        _pad2: u32,
    }
    /// `right` and `up` reach from the middle of the image plane to its edges.
    PackedCamera {
        /// The pinhole, or the middle of the lens, in render space.
        origin: [f32; 3],
        /// 0 for a pinhole.
        lens_radius: f32,
        /// Unit viewing direction.
        forward: [f32; 3],
        /// Along `forward`, to what is sharp.
        focus_distance: f32,
        /// From the middle of the image plane to its right edge.
        right: [f32; 3],
        /// Radians counter-clockwise of the first corner of the opening off `right`.
        blade_rotation: f32,
        /// From the middle of the image plane to its upper edge.
        up: [f32; 3],
        /// Corners of the opening; fewer than 3 make it round.
        blade_count: u32,
    }
    /// The head of the frame buffer; [`PackedLight`]s follow it.
    PackedFrame {
        /// The camera that the picture is seen by.
        camera: PackedCamera,
        /// Linear radiance of rays that hit nothing, or straight down, or the factor of a picture.
        background: [f32; 3],
        /// Number of lights, at least 1.
        light_count: u32,
        /// Linear radiance of the ambient term, multiplied by [`PackedMaterial::ambient`].
        ambient: [f32; 3],
        /// Number of triangles.
        triangle_count: u32,
        /// Number of shapes in the tree, which come first among the shapes.
        shape_count: u32,
        /// Number of planes, which follow them.
        plane_count: u32,
        /// Number of vertices, behind which their u and v follow.
        vertex_count: u32,
        /// Number of materials, behind which the textures follow.
        material_count: u32,
        /// Gradient: linear radiance straight up.
        background_top: [f32; 3],
        /// Picture: radians by which it is turned about +y.
        background_rotation: f32,
        /// Picture: index of its first texel.
        background_first_texel: u32,
        /// Picture: in texels.
        background_width: u32,
        /// Picture: in texels.
        background_height: u32,
        #[doc(hidden)]
        _pad: u32,
        /// Materials of the media round the camera, outermost first, then [`NONE`].
        camera_media: [u32; 4],
    }
    /// What one submission is to do, and from `tiles_done` on what came of it.
    PackedSlice {
        /// In pixels.
        picture_width: u32,
        /// In pixels.
        picture_height: u32,
        /// Left edge of the window in the picture, in pixels.
        window_x: u32,
        /// Upper edge of the window in the picture, in pixels.
        window_y: u32,
        /// In pixels.
        window_width: u32,
        /// In pixels.
        window_height: u32,
        /// Tiles in a row of the window.
        tile_columns: u32,
        /// Tiles in the window, at most 65,536.
        tile_count: u32,
        /// Step from one visited tile to the next, modulo `tile_count` and coprime to it.
        tile_stride: u32,
        /// Place of the first tile in the order of visits.
        first_tile: u32,
        /// One beyond the place of the last tile.
        end_tile: u32,
        /// Workgroups along x; a workgroup is a tile.
        grid_width: u32,
        /// Index of each pixel's first sample.
        first_sample: u32,
        /// One beyond the index of each pixel's last sample.
        end_sample: u32,
        /// Of the random numbers.
        seed: u32,
        /// Bounces after the first hit.
        max_depth: u32,
        /// Rays whose share in the pixel is smaller than this are not sent.
        min_throughput: f32,
        /// Factor on [`PackedLight::sample_count`].
        light_samples: f32,
        /// Workgroups that ran to their end.
        tiles_done: u32,
        /// Samples that were dropped: with them a sum would be infinite or not a number.
        nonfinite_samples: u32,
        /// Invocations in which a loop ended before its condition did.
        cut_off_paths: u32,
        /// Samples whose ray tree outgrew its stack or had too many rays.
        cut_off_trees: u32,
        /// Camera rays. This and the following are kept where override `COUNT_RAYS` is on.
        primary: u32,
        /// Camera rays that hit something.
        primary_hits: u32,
        /// Rays to lights.
        shadow: u32,
        /// Rays to lights that hit something before.
        shadow_blocked: u32,
        /// Mirrored rays.
        reflection: u32,
        /// Mirrored rays that hit something.
        reflection_hits: u32,
        /// Refracted rays.
        refraction: u32,
        /// Refracted rays that hit something.
        refraction_hits: u32,
    }
    /// How sums become a picture: [`crate::render::Tone`].
    PackedTone {
        /// Factor on linear radiance, above 0.
        exposure_scale: f32,
        /// [`TONE_NONE`], [`TONE_ACES`], [`TONE_AGX`] or [`TONE_REINHARD`].
        curve: u32,
        /// [`TRANSFER_SRGB`] or [`TRANSFER_LINEAR`].
        transfer: u32,
        #[doc(hidden)]
        _pad: u32,
    }
}
