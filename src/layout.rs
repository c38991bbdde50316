//! Every struct and tag that a shader also sees, as the GPU sees it: the same names, members and
//! values as `shaders/types.wesl`. A test compares the two through naga.

use bytemuck::{Pod, Zeroable};

mod tags;

pub use tags::*;

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
    /// surfaces in a space of their own, into which the rows lead. A globe is a huge sphere nearby.
    PackedShape {
        /// Sphere: its centre. Globe: its point nearest to the origin. Plane: a point on it. Others:
        /// their space's origin. In render space.
        position: [f32; 3],
        /// [`SHAPE_SPHERE`], [`SHAPE_PLANE`] and so on.
        kind: u32,
        /// What a point less `position` is multiplied by for its x in the shape's space. Plane: what a
        /// point is multiplied by for u, to which `size0` is added.
        row_x: [f32; 3],
        /// Sphere: radius. Globe: reciprocal of the radius. Disc: radius of its hole. Cone: radius at
        /// the bottom, the larger one is 1. Torus: small radius.
        size0: f32,
        /// The same for y. Plane: its unit normal. Globe: that at `position`.
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
    /// A tree of its own, placed in render space by `linear` and `translation`.
    PackedInstance {
        /// Where its origin is.
        translation: [f32; 3],
        /// Child reference to its root.
        root: u32,
        /// Row of the inverse of `linear`.
        inverse_x: [f32; 3],
        /// Its first primitive, with [`SHAPE`] for shapes.
        first: u32,
        /// Row of the inverse of `linear`.
        inverse_y: [f32; 3],
        /// Number of its primitives.
        count: u32,
        /// Row of the inverse of `linear`.
        inverse_z: [f32; 3],
        /// More than 1 where it moves while the shutter is open.
        key_count: u32,
        /// Row of the matrix from object to render space.
        linear_x: [f32; 3],
        /// Index of its first [`PackedKey`].
        first_key: u32,
        /// Row of the matrix from object to render space.
        linear_y: [f32; 3],
        /// Tells instances apart in pictures of ids.
        id: u32,
        /// Row of the matrix from object to render space.
        linear_z: [f32; 3],
        #[doc(hidden)]
        _pad: u32,
        /// Affine row from object space to where patterns in space are looked up.
        pattern_x: [f32; 4],
        /// The same for y.
        pattern_y: [f32; 4],
        /// The same for z.
        pattern_z: [f32; 4],
    }
    /// Where a moving instance is at one time: stretched, rotated, translated.
    PackedKey {
        /// Into render space.
        translation: [f32; 3],
        #[doc(hidden)]
        _pad0: u32,
        /// Unit quaternion x, y, z, w.
        rotation: [f32; 4],
        /// xx, yy and zz of a symmetric matrix.
        stretch: [f32; 3],
        #[doc(hidden)]
        _pad1: u32,
        /// yz, xz and xy of it.
        shear: [f32; 3],
        #[doc(hidden)]
        _pad2: u32,
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
        /// Fraction of the light that is not transmitted, in 0..=1.
        opacity: f32,
        /// Fraction that is mirrored, before Fresnel's equations.
        reflect: [f32; 3],
        /// Index of refraction of what is inside, above 0.
        ior: f32,
        /// Fraction that is transmitted, before Fresnel's equations.
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
        /// Number of triangles that are not instanced.
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
        /// Reference to the first node of the tree.
        root: u32,
        /// Materials of the media round the camera, outermost first, then [`NONE`].
        camera_media: [u32; 4],
        /// Row of the first [`PackedInstance`] among those of the nodes.
        instance_row: u32,
        /// Number of instances.
        instance_count: u32,
        /// Row of the first [`PackedKey`].
        key_row: u32,
        /// Row of the first [`PackedCamera`] of a moving one.
        camera_row: u32,
        /// Of the camera, evenly spaced over the shot; more than 1 where it moves.
        camera_key_count: u32,
        /// Of the lights; more than 1 where one moves. Each key has all lights.
        light_key_count: u32,
        /// The first triangle that is not instanced.
        first_triangle: u32,
        #[doc(hidden)]
        _pad: u32,
    }
    /// The parameters of one dispatch: which workgroups of which film tile, which samples. `counters` is its
    /// result.
    PackedDispatch {
        /// Width of the picture in pixels.
        picture_width: u32,
        /// Height of the picture in pixels.
        picture_height: u32,
        /// Left edge of the film tile in the picture, in pixels.
        tile_x: u32,
        /// Upper edge of the film tile in the picture, in pixels.
        tile_y: u32,
        /// Width of the film tile in pixels.
        tile_width: u32,
        /// Height of the film tile in pixels.
        tile_height: u32,
        /// Workgroups in a row of the film tile; each has 8x8 pixels.
        group_columns: u32,
        /// Workgroups in the film tile, at most 65,536.
        group_count: u32,
        /// Step from one workgroup's pixels to the next one's, modulo `group_count` and coprime to it.
        group_stride: u32,
        /// Index of the first workgroup of this dispatch, in dispatch order.
        first_group: u32,
        /// One beyond the index of its last workgroup.
        end_group: u32,
        /// Workgroups along x.
        grid_width: u32,
        /// Index of each pixel's first sample.
        first_sample: u32,
        /// One beyond the index of each pixel's last sample.
        end_sample: u32,
        /// Seed of the random numbers.
        seed: u32,
        /// Bounces after the first hit.
        max_depth: u32,
        /// Rays of a throughput below this are not sent.
        min_throughput: f32,
        /// Factor on [`PackedLight::sample_count`].
        light_samples: f32,
        /// Counts of what the dispatch did; zero before it.
        counters: PackedCounters,
    }
    /// What a dispatch counted.
    PackedCounters {
        /// Workgroups that ran to their end.
        groups_done: u32,
        /// Samples that were dropped: with them a sum would be infinite or not a number.
        nonfinite_samples: u32,
        /// Invocations in which a loop ended before its condition did.
        cut_off_paths: u32,
        /// Samples whose ray tree outgrew its stack, had too many rays, or had a ray inside too many media.
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
        /// What the film holds: [`VIEW_DEPTH`] and [`VIEW_HEAT`] are quantities, all else is colours.
        view: u32,
        /// The least and the greatest value of a quantity.
        range: [f32; 2],
        /// Whether it is to be shown over that range, 0 or 1.
        has_range: u32,
        /// Rows of the film for each pixel.
        film_rows: u32,
    }
    /// A sample of which every ray is to be recorded, and what came of it.
    PackedProbe {
        /// Column in the picture, or [`NONE`] where there is no sample to take.
        pixel_x: u32,
        /// Row in the picture.
        pixel_y: u32,
        /// Index of the sample.
        sample: u32,
        /// Row of 16 bytes of its first [`PackedRay`].
        first_row: u32,
        /// Rays for which there is room.
        ray_limit: u32,
        /// Comes back: rays that were traced.
        ray_count: u32,
        /// Comes back: 1, or -1 where the filter is negative.
        weight: f32,
        /// Comes back: moment in the shot, 0 to 1.
        time: f32,
        /// Comes back: what the sample adds to the film.
        color: [f32; 3],
        /// Comes back: whether the tree outgrew what a tree may have.
        cut_off: u32,
    }
    /// A ray that was traced, in render space; `shaders/types.wesl` says more.
    PackedRay {
        /// Where it starts.
        origin: [f32; 3],
        /// [`RAY_PRIMARY`] and so on.
        kind: u32,
        /// Of unit length.
        direction: [f32; 3],
        /// Distance to what it met.
        t: f32,
        /// Where that is.
        p: [f32; 3],
        /// What it met, or [`NONE`].
        primitive: u32,
        /// Shading normal.
        n: [f32; 3],
        /// Index of an instance of the view, or [`NO_INSTANCE`].
        instance: u32,
        /// Geometric normal.
        ng: [f32; 3],
        /// Index of a [`PackedMaterial`], or [`NONE`].
        material: u32,
        /// Throughput where it starts.
        throughput: [f32; 3],
        /// Number of the ray that sent it, or [`NONE`].
        parent: u32,
        /// Throughput where it ends.
        arriving: [f32; 3],
        /// [`RAY_OUTSIDE`] and so on.
        flags: u32,
        /// What it adds itself to the sample.
        contribution: [f32; 3],
        /// Of a shadow ray: index of a light, else [`NONE`].
        light: u32,
        /// Ambient part; of a shadow ray: what the light adds without a shadow.
        ambient: [f32; 3],
        /// Material of the medium that it travelled in, or [`NONE`].
        medium: u32,
        /// Emitted part.
        emission: [f32; 3],
        /// Material of the medium behind the surface, or [`NONE`].
        medium_behind: u32,
        /// Fraction that is mirrored.
        reflect: [f32; 3],
        /// Fresnel's.
        reflectance: f32,
        /// Fraction that is refracted; of a shadow ray: that came through.
        transmit: [f32; 3],
        /// Index of refraction in front of the surface.
        ior: f32,
        /// Materials of the media round its origin, outermost first, then [`NONE`].
        media: [u32; 4],
        /// Index of refraction behind the surface.
        ior_behind: f32,
        /// Of a shadow ray: distance to the light.
        t_max: f32,
        /// Of a shadow ray: surfaces that it met.
        crossings: u32,
        #[doc(hidden)]
        _pad: u32,
    }
}
