//! The structs and tags shared with shaders, as the GPU sees them: the same names, members and values as
//! in `shaders/types.wesl`. A test writes the structs there, and compares all through naga.

use bytemuck::{Pod, Zeroable};

mod tags;

pub use tags::*;

/// A BVH node in the encoding that the shader's `decode_node` reads, three rows of four words, and its references to children in a
/// fourth.
pub type PackedNode = [u32; 16];
/// A BVH node for `float_node`: for each axis the lower, then the upper planes of four children, as `f32`; then references.
pub type FloatNode = [u32; 28];

/// The reference to a leaf of `count` (1 to 8) primitives, shapes or triangles, from `first` (below 2²⁷).
pub const fn leaf_reference(first: u32, count: u32, is_shape: bool) -> u32 {
    let kind = if is_shape { SHAPE } else { 0 };
    LEAF | kind | ((count - 1) << LEAF_COUNT_SHIFT) | first
}

/// Declares plain old data structs together with a table of their members for the layout test.
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
    /// Three corners in render space, each with the index of its [`PackedVertex`].
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
    /// Attributes of a corner other than its position.
    PackedVertex {
        /// Unit shading normal.
        normal: [f32; 3],
        /// Index of a [`PackedMaterial`].
        material: u32,
    }
    /// Where u of a vertex points, for normal maps and anisotropy.
    PackedTangent {
        /// Unit vector, or zero where a triangle's own u and v decide.
        direction: [f32; 3],
        /// 1 if cross(normal, direction) points along v, −1 if against it.
        handedness: f32,
    }
    /// An analytic shape; `kind` says which members apply and how. All shapes but spheres and planes are
    /// canonical in a space of their own, to which the rows transform. A globe is a huge sphere nearby.
    PackedShape {
        /// Sphere: its centre. Globe: its point nearest to the origin. Plane: a point on it. Others: the
        /// origin of their canonical space. In render space.
        position: [f32; 3],
        /// [`SHAPE_SPHERE`], [`SHAPE_PLANE`] and so on.
        kind: u32,
        /// Dot product with a point less `position`: its x in the canonical space. Plane: dot product
        /// with a point plus `size0`: u.
        row_x: [f32; 3],
        /// Sphere: radius. Globe: reciprocal of the radius. Disc: radius of its hole. Cone: radius at the
        /// bottom, where the larger one is 1. Torus: small radius.
        size0: f32,
        /// Dot product with a point less `position`: its y. Plane: its unit normal. Globe: its normal at `position`.
        row_y: [f32; 3],
        /// Cone: radius at the top.
        size1: f32,
        /// Dot product with a point less `position`: its z. Plane: dot product with a point plus `size1`: v.
        row_z: [f32; 3],
        /// [`SHAPE_CAPPED`] or 0.
        flags: u32,
        /// Index of a [`PackedMaterial`].
        material: u32,
        /// Index in [`glimray_scene::Scene::shapes`], followed by those of visible lights.
        id: u32,
        #[doc(hidden)]
        _pad0: u32,
        #[doc(hidden)]
        _pad1: u32,
    }
    /// An instance of a BLAS, placed in render space: p = linear q + translation, q = inverse (p − translation).
    PackedInstance {
        /// Position of its origin.
        translation: [f32; 3],
        /// Child reference to the root of its BLAS.
        root: u32,
        /// Row of the inverse of `linear`.
        inverse_x: [f32; 3],
        /// Index of its first primitive, with [`SHAPE`] for shapes.
        first: u32,
        /// Row of the inverse of `linear`.
        inverse_y: [f32; 3],
        /// Number of its primitives.
        count: u32,
        /// Row of the inverse of `linear`.
        inverse_z: [f32; 3],
        /// Number of its [`PackedKey`]s: more than 1 if it moves while the shutter is open.
        key_count: u32,
        /// Row of the matrix from object to render space.
        linear_x: [f32; 3],
        /// Index of its first [`PackedKey`].
        first_key: u32,
        /// Row of the matrix from object to render space.
        linear_y: [f32; 3],
        /// Identifies the instance in the `ids` view.
        id: u32,
        /// Row of the matrix from object to render space.
        linear_z: [f32; 3],
        /// Deforming meshes: what must be added to the index of a triangle, modulo 2³², for that of the same
        /// triangle at the second key; those of later keys follow. 0 if it keeps its shape while the shutter
        /// is open.
        next_key: u32,
        /// Affine row from object space to the space of solid textures.
        pattern_x: [f32; 4],
        /// Affine row for y, from object space to the space of solid textures.
        pattern_y: [f32; 4],
        /// Affine row for z, from object space to the space of solid textures.
        pattern_z: [f32; 4],
    }
    /// The transform of a moving instance at one time: stretch, then rotation, then translation (Shoemake and Duff, Matrix
    /// Animation and Polar Decomposition, 1992).
    PackedKey {
        /// Translation into render space.
        translation: [f32; 3],
        #[doc(hidden)]
        _pad0: u32,
        /// Unit quaternion x, y, z, w.
        rotation: [f32; 4],
        /// xx, yy and zz of a symmetric matrix.
        stretch: [f32; 3],
        #[doc(hidden)]
        _pad1: u32,
        /// yz, xz and xy of the same matrix.
        shear: [f32; 3],
        #[doc(hidden)]
        _pad2: u32,
    }
    /// How a surface scatters light; colours per channel, 0 or more.
    PackedMaterial {
        /// k_d.
        diffuse: [f32; 3],
        /// The exponent α.
        shininess: f32,
        /// k_s.
        specular: [f32; 3],
        /// Bits such as [`MATERIAL_TWO_SIDED`].
        flags: u32,
        /// Factor on [`PackedFrame::ambient`].
        ambient: [f32; 3],
        /// Fraction of the light that is not transmitted, in 0..=1.
        opacity: f32,
        /// Fraction that is reflected, before Fresnel's equations.
        reflect: [f32; 3],
        /// Index of refraction of the inside, above 0.
        ior: f32,
        /// Fraction that is transmitted, before Fresnel's equations.
        transmit: [f32; 3],
        /// Among overlapping media, the one with the highest priority counts.
        priority: i32,
        /// Absorption coefficient of the inside, per unit length.
        absorption: [f32; 3],
        /// With [`MATERIAL_COVERAGE`]: alpha. With [`MATERIAL_MASK`] divided by the alpha from which on the
        /// surface is there.
        alpha: f32,
        /// Emitted radiance.
        emission: [f32; 3],
        /// Factor on the tilt of the normals in the normal map.
        normal_scale: f32,
        /// 16-bit indices of [`PackedTexture`]s or [`NO_TEXTURE`]: diffuse and specular, reflect and
        /// transmit, ambient and emission, normal map and alpha, the first of each pair in the lower half.
        textures: [u32; 4],
        /// 16-bit index of the occlusion map's [`PackedTexture`] or [`NO_TEXTURE`], in the lower half.
        occlusion: u32,
        /// Weight of the occlusion map, 0 to 1.
        occlusion_strength: f32,
        #[doc(hidden)]
        _pad0: u32,
        #[doc(hidden)]
        _pad1: u32,
        /// The layers that the path tracer sees.
        layers: PackedLayers,
    }
    /// The layers of a surface in the path tracer: glTF's metallic-roughness material with its extensions.
    PackedLayers {
        /// Base colour: of the diffuse body of a dielectric, and of the reflection of a metal.
        base: [f32; 3],
        /// 0 for a dielectric, 1 for a metal.
        metallic: f32,
        /// Reflectance of a dielectric along the normal.
        f0: [f32; 3],
        /// Reflectance of a dielectric at grazing angles; of Phong materials unused, `f0` holds for all angles.
        f90: f32,
        /// Square root of the width α of the microfacet distribution.
        roughness: f32,
        /// Fraction of the light in a dielectric that passes through it.
        transmission: f32,
        /// Strength of the clear coat.
        coat: f32,
        /// Roughness of the clear coat.
        coat_roughness: f32,
        /// Colour of the sheen.
        sheen: [f32; 3],
        /// Roughness of the sheen.
        sheen_roughness: f32,
        /// How much longer highlights are along one direction, 0 to 1.
        anisotropy: f32,
        /// Direction of the longest highlights, in radians counter-clockwise from the tangent.
        anisotropy_rotation: f32,
        /// Strength of the thin film.
        iridescence: f32,
        /// Index of refraction of the film.
        iridescence_ior: f32,
        /// Thickness of the film in nanometres where its texture is 0.
        film_thinnest: f32,
        /// Thickness of the film in nanometres where its texture is 1, or without a texture.
        film_thickest: f32,
        /// 20 divided by the Abbe number; 0 for none.
        dispersion: f32,
        /// Fraction of the diffuse light that leaves on the other side.
        diffuse_transmission: f32,
        /// Colour of the diffuse transmission.
        diffuse_transmission_color: [f32; 3],
        /// Index of refraction, of thin walls too.
        ior: f32,
        /// Index of the light whose surface this is, or [`NONE`].
        light: u32,
        /// Mean luminance of the texture of the emission, 1 without one.
        glow: f32,
        /// A bit for each slot with a texture, see [`SLOT_BASE`].
        slots: u32,
        /// Factor on the tilt of the clear coat's normal map.
        coat_normal_scale: f32,
        /// 16-bit indices of the [`PackedTexture`]s of the first eight slots, the first of each pair in the lower half.
        textures: [u32; 4],
        /// As `textures`, for the second eight slots.
        more_textures: [u32; 4],
        /// As `textures`, for the third eight slots.
        last_textures: [u32; 4],
    }
    /// A spatially varying colour that multiplies a colour of a material.
    PackedTexture {
        /// First colour.
        color_a: [f32; 3],
        /// [`PATTERN_CHECKER`] and so on.
        kind: u32,
        /// Second colour.
        color_b: [f32; 3],
        /// [`TEXTURE_UV`], [`TEXTURE_NEAREST`] and the `WRAP_` modes.
        flags: u32,
        /// Affine row: from (x, y, z, 1) in render space or (u, v, 0, 1) to x in the pattern's space.
        row_x: [f32; 4],
        /// Affine row to y in the pattern's space.
        row_y: [f32; 4],
        /// Affine row to z in the pattern's space.
        row_z: [f32; 4],
        /// Picture: index of the first word of its texels, with [`PICTURE_HALF`] or [`PICTURE_SRGB`].
        picture: u32,
        /// Picture: width in texels.
        width: u32,
        /// Picture: height in texels.
        height: u32,
        /// Noise: number of octaves, 1 to 16.
        octaves: u32,
    }
    /// A light; `kind` says which members apply.
    PackedLight {
        /// Position or centre of the light, in render space.
        position: [f32; 3],
        /// [`LIGHT_POINT`], [`LIGHT_DIRECTIONAL`] and so on.
        kind: u32,
        /// Directional and spot: the unit direction in which the light travels. Rectangle and disc: the unit normal.
        direction: [f32; 3],
        /// [`ATTENUATION_NONE`], always for directional lights, or [`ATTENUATION_INVERSE_SQUARE`].
        attenuation: u32,
        /// Linear radiance, with attenuation at distance 1 (for area lights along the normal).
        color: [f32; 3],
        /// Spot: cosine of the angle from the axis up to which the light has its full intensity.
        cos_inner: f32,
        /// Rectangle and disc: from the centre to the middle of an edge.
        edge_u: [f32; 3],
        /// Spot: cosine of the angle from the axis beyond which the light is zero.
        cos_outer: f32,
        /// Rectangle and disc: from the centre to the middle of the other edge.
        edge_v: [f32; 3],
        /// Sphere: its radius.
        radius: f32,
        /// Shadow rays per shaded point, at least 1.
        sample_count: u32,
        /// Chance with which a path samples this light, without a light tree.
        chance: f32,
        /// The bits of the sum of the chances of the lights before it, as a float; with a light tree its trail.
        place: u32,
        /// Whether rays can hit it, 0 or 1.
        visible: u32,
    }
    /// Lights of a light tree: a box around them, and a cone around the directions in which they point.
    PackedCluster {
        /// The centre of the box in render space.
        center: [f32; 3],
        /// The sum of the intensities, in luminance; of a surface its area times its radiance, divided by π.
        power: f32,
        /// Half of the diagonal of the box, squared.
        radius2: f32,
        /// The first of four clusters, with [`LIGHT_BY_POWER`] if power alone chooses; or [`LIGHT_LEAF`] with a light, or also
        /// with [`LIGHT_EMITTERS`] a group of emitters; or 0 without lights. With [`LIGHT_TWO_SIDED`] as the cluster is.
        child: u32,
        /// The axis of the cone: octahedral x and y as signed 16-bit fractions (Meyer and others 2010).
        axis: u32,
        /// Signed 16-bit cosines: of the cone's half angle; above it, of the angle from which on a light sends nothing.
        cones: u32,
    }
    /// An emissive triangle or shape that paths sample as a light. Emitters are sorted by instance, then by primitive.
    PackedEmitter {
        /// Index in the triangles array, or in the shapes array with [`SHAPE`].
        primitive: u32,
        /// Index of the instance, or [`NO_INSTANCE`].
        instance: u32,
        /// The sum of the chances in its group up to it: the last one has 1.
        end: f32,
        /// The way to its group in the light tree: bits 2k and 2k + 1 say which child it is under at depth k.
        trail: u32,
    }
    /// A camera. The image plane is at distance 1; the centre of the plane is `origin` + `forward`.
    PackedCamera {
        /// The pinhole or the centre of the lens, in render space.
        origin: [f32; 3],
        /// 0 for a pinhole.
        lens_radius: f32,
        /// Unit viewing direction.
        forward: [f32; 3],
        /// Distance to the plane of focus along `forward`.
        focus_distance: f32,
        /// From the centre of the image plane to its right edge.
        right: [f32; 3],
        /// Angle in radians of the aperture's first corner from `right`, counter-clockwise.
        blade_rotation: f32,
        /// From the centre of the image plane to its upper edge.
        up: [f32; 3],
        /// Corners of the aperture; fewer than 3 for a circle.
        blade_count: u32,
    }
    /// The head of the frame buffer; the [`PackedLight`]s follow it.
    PackedFrame {
        /// The camera in use.
        camera: PackedCamera,
        /// Distances of its near and far planes along its viewing direction; 0 for none.
        clip: [f32; 2],
        /// With a section plane, row of the first range of vertices of a closed mesh.
        solid_row: u32,
        /// Number of those ranges: first vertex, and the one after the last.
        solid_count: u32,
        /// The unit normal of the section plane, which points to what is cut away; 0 without one.
        section: [f32; 3],
        /// Distance of the section plane from the origin of render space along its normal.
        section_offset: f32,
        /// Linear radiance of rays that hit nothing; gradient: straight down; picture: its factor.
        background: [f32; 3],
        /// Number of lights, at least 1.
        light_count: u32,
        /// Linear radiance of the ambient term, multiplied by [`PackedMaterial::ambient`].
        ambient: [f32; 3],
        /// Number of triangles that are not instanced.
        triangle_count: u32,
        /// Number of bounded shapes that are not instanced, which come first among the shapes.
        shape_count: u32,
        /// Number of planes, which follow those shapes.
        plane_count: u32,
        /// Number of vertices; their u and v follow them.
        vertex_count: u32,
        /// Number of materials; the textures follow them.
        material_count: u32,
        /// Gradient: linear radiance straight up; sky: that of its sun.
        background_top: [f32; 3],
        /// Picture: rotation about +y in radians.
        background_rotation: f32,
        /// Picture: index of the first word of its texels, with [`PICTURE_HALF`] or [`PICTURE_SRGB`].
        background_picture: u32,
        /// Picture: width in texels.
        background_width: u32,
        /// Picture: height in texels.
        background_height: u32,
        /// Reference to the root node of the TLAS.
        root: u32,
        /// Materials of the media around the camera, outermost first, padded with [`NONE`].
        camera_media: [u32; 4],
        /// Row of the first [`PackedInstance`] in the node buffer.
        instance_row: u32,
        /// Number of instances.
        instance_count: u32,
        /// Row of the first [`PackedKey`].
        key_row: u32,
        /// Row of the first [`PackedLight`]. If the camera moves, its keys follow the lights.
        light_row: u32,
        /// Keys of the camera, evenly spaced over the shutter interval; more than 1 if it moves.
        camera_key_count: u32,
        /// Keys of the lights; more than 1 if a light moves. Each key holds all lights.
        light_key_count: u32,
        /// Index of the first triangle that is not instanced.
        first_triangle: u32,
        /// The first row of the shapes in the triangles array.
        shape_row: u32,
        /// Keys of deforming meshes, evenly spaced over the shutter interval; more than 1 if one deforms.
        deformation_key_count: u32,
        /// Row of the first [`PackedEmitter`].
        emitter_row: u32,
        /// Number of emitters.
        emitter_count: u32,
        /// Without a light tree, radiance divided by this is the chance per area with which a path samples a point.
        emitter_power: f32,
        /// The first word of the table from which paths sample a picture in the background, among the texels.
        environment_first: u32,
        /// Columns of that table, a power of two from 4 on; it has half as many rows. 0 without a table.
        environment_width: u32,
        /// The chance with which a light sample is one of the background; 0 without a table.
        environment_share: f32,
        /// Index of the first word of the tables of albedos among those of the texels.
        albedo_first: u32,
        /// Row of the first [`PackedCluster`].
        cluster_row: u32,
        /// The [`PackedCluster::child`] of the root of the light tree.
        light_root: u32,
        /// Without a light tree, the chance with which a light sample is one of the lights.
        lights_share: f32,
        /// Number of emitters in each group: all of them without a light tree.
        emitter_group: u32,
        /// Sky: the unit direction to the sun.
        sun: [f32; 3],
        /// Sky: the part of the light samples of the background that are of the sun.
        sun_chance: f32,
    }
    /// The parameters of one dispatch: which workgroups of which film tile, which samples. `counters` is its result.
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
        /// Workgroups of 8x8 pixels in the film tile, at most 65,536.
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
        /// Samples of each pixel in the sequences that all pixels share, a power of two; 0 if each has its own.
        shared_samples: u32,
        /// Bounces after the first hit.
        max_depth: u32,
        /// Linear radiance that paths from the camera see where there is nothing; see [`BACKDROP_COLOR`].
        backdrop: [f32; 3],
        /// Rays of a throughput below this are not sent.
        min_throughput: f32,
        /// Factor on [`PackedLight::sample_count`].
        light_samples: f32,
        /// Width of the part of a pixel that a sample stands for, in pixels.
        footprint: f32,
        /// Film blocks of 8x8 pixels that a workgroup renders one after the other, at least 1.
        blocks: u32,
        /// Padding.
        _pad0: u32,
        /// Counts of what the dispatch did; zero before it.
        counters: PackedCounters,
    }
    /// The counters of a dispatch.
    PackedCounters {
        /// Samples that were dropped: not numbers, or beyond [`LARGEST_RADIANCE_BITS`].
        nonfinite_samples: u32,
        /// Why paths were cut off: [`CUT_OFF_LOOP`] and [`CUT_OFF_STACK`], or 0 if none was.
        cut_off: u32,
        /// Samples whose ray tree overflowed its stack, had too many rays, or a ray inside too many dielectric volumes.
        cut_off_trees: u32,
        /// 256 times the sum of the throughputs of paths that the limit of bounces cut off.
        cut_throughput: u32,
        /// The luminance that clamping removed, in sixteenths of the clamp: the low word, then the high one. This and
        /// the following are kept where override `CLAMP_INDIRECT` is above 0.
        clamped_light: u32,
        /// High word of `clamped_light`.
        clamped_light_high: u32,
        /// The luminance that paths found, without what clamping removed.
        kept_light: u32,
        /// High word of `kept_light`.
        kept_light_high: u32,
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
        /// Workgroups that ran to their end, in the first of each 16 words: see `count_group` in `scene/groups.wesl`.
        groups_done: [[u32; 16]; 8],
    }
    /// How film sums become an image: [`crate::Tone`].
    PackedTone {
        /// Factor on linear radiance, above 0.
        exposure_scale: f32,
        /// [`TONE_NONE`], [`TONE_ACES`], [`TONE_AGX`], [`TONE_REINHARD`] or [`TONE_NEUTRAL`].
        curve: u32,
        /// [`TRANSFER_SRGB`] or [`TRANSFER_LINEAR`].
        transfer: u32,
        /// Contents of the film: quantities for [`VIEW_DEPTH`] and [`VIEW_HEAT`], colours for everything else.
        view: u32,
        /// Smallest and largest value of the range in which a quantity is shown.
        range: [f32; 2],
        /// Whether `range` is used, 0 or 1.
        has_range: u32,
        /// Rows of the film per pixel.
        film_rows: u32,
    }
    /// A sample whose rays are recorded, and its results.
    PackedProbe {
        /// Column in the image, or [`NONE`] if there is no sample to trace.
        pixel_x: u32,
        /// Row in the image.
        pixel_y: u32,
        /// Index of the sample.
        sample: u32,
        /// Row of 16 bytes of its first [`PackedRay`].
        first_row: u32,
        /// Capacity for rays.
        ray_limit: u32,
        /// Result: number of rays traced.
        ray_count: u32,
        /// Result: 1, or -1 where the filter is negative.
        weight: f32,
        /// Result: time of the sample in the shutter interval, 0 to 1.
        time: f32,
        /// Result: the sample's contribution to the film.
        color: [f32; 3],
        /// Result: whether the ray tree exceeded its limits.
        cut_off: u32,
    }
    /// A ray that was traced, in render space. Shadow ray in Phong's model: `emission` is L, `reflect` k_d, `value` k_s,
    /// `pdf` the shininess α, `own_pdf` l·n, `other_pdf` r·v, and `chance` max(r·v, 0)^α.
    PackedRay {
        /// Origin of the ray.
        origin: [f32; 3],
        /// [`RAY_PRIMARY`] and so on.
        kind: u32,
        /// Unit vector.
        direction: [f32; 3],
        /// Distance to the hit.
        t: f32,
        /// Position of the hit.
        p: [f32; 3],
        /// The primitive that was hit, or [`NONE`].
        primitive: u32,
        /// Shading normal.
        n: [f32; 3],
        /// Index of an instance of the view, or [`NO_INSTANCE`].
        instance: u32,
        /// Geometric normal.
        ng: [f32; 3],
        /// Index of a [`PackedMaterial`], or [`NONE`].
        material: u32,
        /// Throughput at its origin.
        throughput: [f32; 3],
        /// Number of its parent ray, or [`NONE`].
        parent: u32,
        /// Throughput at its end.
        arriving: [f32; 3],
        /// [`RAY_OUTSIDE`] and so on.
        flags: u32,
        /// The ray's own contribution to the sample.
        contribution: [f32; 3],
        /// Shadow ray: index of its light, or of its [`PackedEmitter`]; otherwise [`NONE`].
        light: u32,
        /// Ambient part; shadow ray: the light's unshadowed contribution.
        ambient: [f32; 3],
        /// Material of the medium that it travels in, or [`NONE`].
        medium: u32,
        /// Emitted part; path: the radiance that it found at its end, or the light sample's, divided by its density.
        emission: [f32; 3],
        /// Material of the medium behind the surface, or [`NONE`].
        medium_behind: u32,
        /// Fraction that is reflected.
        reflect: [f32; 3],
        /// Fresnel reflectance.
        reflectance: f32,
        /// Fraction that is refracted; shadow ray: fraction that passed through.
        transmit: [f32; 3],
        /// Index of refraction in front of the surface.
        ior: f32,
        /// Materials of the media around its origin, outermost first, padded with [`NONE`].
        media: [u32; 4],
        /// Index of refraction behind the surface.
        ior_behind: f32,
        /// Shadow ray: distance to the light.
        t_max: f32,
        /// Shadow ray: number of surfaces that it crossed.
        crossings: u32,
        /// The rest is of paths. [`LOBE_DIFFUSE`] and so on; light sample: [`SOURCE_LIGHT`] and so on.
        lobe: u32,
        /// BSDF times cosine, per steradian, of the direction that the path chose, or of the light sample.
        value: [f32; 3],
        /// Density of the direction that the path chose, per steradian; 0 if there was no choice.
        pdf: f32,
        /// Factor on its throughput.
        weight: [f32; 3],
        /// Chance of Russian roulette; light sample: chance of its light.
        chance: f32,
        /// Density with which the ray was chosen; light sample: that of the light sample.
        own_pdf: f32,
        /// Density with which a light sample would have been this ray; light sample: that of the BSDF.
        other_pdf: f32,
        /// Weight of what it found.
        mis_weight: f32,
        /// [`STEP_SCATTERED`] and so on.
        step: u32,
    }
}
