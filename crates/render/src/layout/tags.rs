//! Tags, bits and counts shared with shaders: the constants of `shaders/types.wesl`.

/// "None" for any index.
pub const NONE: u32 = u32::MAX;

/// Marks a child reference as a leaf; see [`super::leaf_reference`].
pub const LEAF: u32 = 0x8000_0000;
/// Marks the index of a leaf or primitive as that of a [`super::PackedShape`]; without it, it refers to a
/// triangle.
pub const SHAPE: u32 = 0x4000_0000;
/// Lowest of the three bits of a leaf reference that hold its count less one.
pub const LEAF_COUNT_SHIFT: u32 = 27;
/// One more primitive in a leaf reference.
pub const LEAF_COUNT_ONE: u32 = 1 << LEAF_COUNT_SHIFT;
/// The bits of a leaf reference's count less one.
pub const LEAF_COUNT_MASK: u32 = 7 << LEAF_COUNT_SHIFT;
/// The bits of a leaf reference's first primitive.
pub const LEAF_FIRST_MASK: u32 = LEAF_COUNT_ONE - 1;
/// Marks a child reference as an instance, whose index is in the bits of [`LEAF_FIRST_MASK`].
pub const INSTANCE: u32 = LEAF | SHAPE | LEAF_COUNT_MASK;
/// Marks the reference to a node that is followed by the same node at the end of the shutter interval.
pub const MOVING: u32 = 0x4000_0000;
/// The instance index of geometry that is not instanced; also the largest number of instances.
pub const NO_INSTANCE: u32 = (1 << 20) - 1;
/// [`super::PackedCounters::cut_off`]: a loop ended before its condition did.
pub const CUT_OFF_LOOP: u32 = 1;
/// [`super::PackedCounters::cut_off`]: a stack in registers was full.
pub const CUT_OFF_STACK: u32 = 2;
/// Rows of 16 bytes of a [`super::PackedNode`].
pub const NODE_ROWS: u32 = 4;
/// Rows of 16 bytes of a [`super::FloatNode`].
pub const FLOAT_NODE_ROWS: u32 = 7;
/// Rows of 16 bytes of a [`super::PackedInstance`].
pub const INSTANCE_ROWS: u32 = 10;
/// Rows of 16 bytes of a [`super::PackedKey`].
pub const KEY_ROWS: u32 = 4;
/// Rows of 16 bytes of a [`super::PackedCamera`].
pub const CAMERA_ROWS: u32 = 4;
/// Rows of 16 bytes of a [`super::PackedLight`].
pub const LIGHT_ROWS: u32 = 6;
/// Rows of 16 bytes of a [`super::PackedCluster`].
pub const CLUSTER_ROWS: u32 = 2;
/// [`super::PackedCluster::child`]: the rest is the index of a light, or of a group of emitters.
pub const LIGHT_LEAF: u32 = 0x8000_0000;
/// [`super::PackedCluster::child`] without [`LIGHT_LEAF`]: the children are chosen by their power, wherever the point is.
pub const LIGHT_BY_POWER: u32 = 0x4000_0000;
/// [`super::PackedCluster::child`] with [`LIGHT_LEAF`]: a group of emitters.
pub const LIGHT_EMITTERS: u32 = 0x4000_0000;
/// [`super::PackedCluster::child`]: some light in the cluster also shines against its direction.
pub const LIGHT_TWO_SIDED: u32 = 0x2000_0000;
/// The index in [`super::PackedCluster::child`].
pub const LIGHT_INDEX_MASK: u32 = 0x1fff_ffff;
/// Rows of 16 bytes of a [`super::PackedShape`].
pub const SHAPE_ROWS: u32 = 5;
/// Size of the traversal stack in entries.
pub const STACK_SIZE: u32 = 96;
/// Size of a smaller one, for scenes that need no more entries.
pub const SHORT_STACK_SIZE: u32 = 32;
/// Texels in a row of the geometry images, as a power of two.
pub const IMAGE_WIDTH_LOG2: u32 = 12;
/// Rows in a layer of the words of texels, as a power of two.
pub const LAYER_ROWS_LOG2: u32 = 10;

/// [`super::PackedShape::kind`]: a sphere.
pub const SHAPE_SPHERE: u32 = 0;
/// [`super::PackedShape::kind`]: an infinite plane.
pub const SHAPE_PLANE: u32 = 1;
/// [`super::PackedShape::kind`]: [`glimray_scene::CanonicalShape::Disc`].
pub const SHAPE_DISC: u32 = 2;
/// [`super::PackedShape::kind`]: [`glimray_scene::CanonicalShape::Rectangle`].
pub const SHAPE_RECTANGLE: u32 = 3;
/// [`super::PackedShape::kind`]: [`glimray_scene::CanonicalShape::Box`].
pub const SHAPE_BOX: u32 = 4;
/// [`super::PackedShape::kind`]: [`glimray_scene::CanonicalShape::Cone`].
pub const SHAPE_CONE: u32 = 5;
/// [`super::PackedShape::kind`]: [`glimray_scene::CanonicalShape::Torus`].
pub const SHAPE_TORUS: u32 = 6;
/// [`super::PackedShape::kind`]: [`glimray_scene::CanonicalShape::Ellipsoid`].
pub const SHAPE_ELLIPSOID: u32 = 7;
/// [`super::PackedShape::kind`]: a sphere that is huge compared to its distance from the origin of render
/// space.
pub const SHAPE_GLOBE: u32 = 8;
/// Bit of [`super::PackedShape::flags`]: the cone has both of its caps.
pub const SHAPE_CAPPED: u32 = 1;

/// [`super::PackedLight::kind`]: shines evenly in all directions from a point.
pub const LIGHT_POINT: u32 = 0;
/// [`super::PackedLight::kind`]: shines in one direction from infinitely far away.
pub const LIGHT_DIRECTIONAL: u32 = 1;
/// [`super::PackedLight::kind`]: shines from a point into a cone.
pub const LIGHT_SPOT: u32 = 2;
/// [`super::PackedLight::kind`]: a parallelogram that emits to the side of its normal.
pub const LIGHT_RECTANGLE: u32 = 3;
/// [`super::PackedLight::kind`]: a disc that emits to the side of its normal.
pub const LIGHT_DISC: u32 = 4;
/// [`super::PackedLight::kind`]: a sphere.
pub const LIGHT_SPHERE: u32 = 5;
/// Stands for the kind or the attenuation of lights that differ in it.
pub const MIXED_LIGHTS: u32 = u32::MAX;

/// [`super::PackedLight::attenuation`]: none.
pub const ATTENUATION_NONE: u32 = 0;
/// [`super::PackedLight::attenuation`]: 1/r² at distance r.
pub const ATTENUATION_INVERSE_SQUARE: u32 = 1;

/// The bits of 2^40 as an f32. Samples with larger components are dropped: no light that makes sense is so bright.
pub const LARGEST_RADIANCE_BITS: u32 = 0x5380_0000;

/// Bit of [`super::PackedMaterial::flags`]: the shading normal is flipped to face the ray.
pub const MATERIAL_TWO_SIDED: u32 = 1;
/// Bit of [`super::PackedMaterial::flags`]: Fresnel's equations split reflected and transmitted light.
pub const MATERIAL_FRESNEL: u32 = 2;
/// Bit of [`super::PackedMaterial::flags`]: with [`MATERIAL_FRESNEL`], Schlick's approximation is used.
pub const MATERIAL_SCHLICK: u32 = 4;
/// Bit of [`super::PackedMaterial::flags`]: [`glimray_scene::Mixing::Sum`].
pub const MATERIAL_SUM: u32 = 8;
/// Bit of [`super::PackedMaterial::flags`]: [`glimray_scene::Mixing::Blend`].
pub const MATERIAL_BLEND: u32 = 16;
/// Bit of [`super::PackedMaterial::flags`]: alpha says how much of the surface is there.
pub const MATERIAL_COVERAGE: u32 = 32;
/// Bit of [`super::PackedMaterial::flags`]: the surface is there where alpha is at least 1.
pub const MATERIAL_MASK: u32 = 64;
/// Bit of [`super::PackedMaterial::flags`]: transmitted light goes straight on, in the same medium.
pub const MATERIAL_THIN: u32 = 128;
/// Bit of [`super::PackedMaterial::flags`]: its layers are those of a metallic-roughness material.
pub const MATERIAL_METALLIC_ROUGHNESS: u32 = 256;
/// Bit of [`super::PackedMaterial::flags`]: [`glimray_scene::Material::shadow_catcher`].
pub const MATERIAL_SHADOW_CATCHER: u32 = 512;
/// Bit of [`super::PackedMaterial::flags`]: the back emits as the front does.
pub const MATERIAL_TWO_SIDED_EMISSION: u32 = 1024;
/// Bit of [`super::PackedMaterial::flags`]: colours of vertices multiply highlights and reflection.
pub const MATERIAL_COLORED_MIRROR: u32 = 2048;
/// Bit of [`super::PackedMaterial::flags`]: colours of vertices multiply transmission.
pub const MATERIAL_COLORED_GLASS: u32 = 4096;
/// Bit of [`super::PackedMaterial::flags`]: colours of vertices multiply emission.
pub const MATERIAL_COLORED_EMISSION: u32 = 8192;
/// Rows of 16 bytes of a [`super::PackedMaterial`].
pub const MATERIAL_ROWS: u32 = 20;
/// The first of these rows that belongs to [`super::PackedMaterial::layers`].
pub const LAYERS_ROW: u32 = 9;
/// Texture slot of [`super::PackedLayers`]: base colour.
pub const SLOT_BASE: u32 = 0;
/// Texture slot of [`super::PackedLayers`]: roughness in green, metalness in blue.
pub const SLOT_METALLIC_ROUGHNESS: u32 = 1;
/// Texture slot of [`super::PackedLayers`]: reflectance of a dielectric along the normal; of Phong materials the highlight.
pub const SLOT_F0: u32 = 2;
/// Texture slot of [`super::PackedLayers`]: transmission, in red; of Phong materials the transmitted colour.
pub const SLOT_TRANSMISSION: u32 = 3;
/// Texture slot of [`super::PackedLayers`]: factor on the reflectance of a dielectric, in alpha.
pub const SLOT_F90: u32 = 4;
/// Texture slot of [`super::PackedLayers`]: strength of the clear coat, in red.
pub const SLOT_COAT: u32 = 5;
/// Texture slot of [`super::PackedLayers`]: its roughness, in green.
pub const SLOT_COAT_ROUGHNESS: u32 = 6;
/// Texture slot of [`super::PackedLayers`]: colour of the sheen.
pub const SLOT_SHEEN: u32 = 7;
/// Texture slot of [`super::PackedLayers`]: its roughness, in alpha.
pub const SLOT_SHEEN_ROUGHNESS: u32 = 8;
/// Texture slot of [`super::PackedLayers`]: direction in red and green, strength in blue.
pub const SLOT_ANISOTROPY: u32 = 9;
/// Texture slot of [`super::PackedLayers`]: strength of the thin film, in red.
pub const SLOT_IRIDESCENCE: u32 = 10;
/// Texture slot of [`super::PackedLayers`]: position in its range of thickness, in green.
pub const SLOT_FILM_THICKNESS: u32 = 11;
/// Texture slot of [`super::PackedLayers`]: fraction of diffuse light that passes, in alpha.
pub const SLOT_DIFFUSE_TRANSMISSION: u32 = 12;
/// Texture slot of [`super::PackedLayers`]: its colour.
pub const SLOT_DIFFUSE_TRANSMISSION_COLOR: u32 = 13;
/// Texture slot of [`super::PackedLayers`]: mirror of a Phong material.
pub const SLOT_REFLECT: u32 = 14;
/// Texture slot of [`super::PackedLayers`]: emission.
pub const SLOT_EMISSION: u32 = 15;
/// Metalness alone, in blue.
pub const SLOT_METALLIC: u32 = 16;
/// Roughness alone, in green.
pub const SLOT_ROUGHNESS: u32 = 17;
/// The normal map of the clear coat, without a bit in [`crate::layout::PackedLayers::slots`].
pub const SLOT_COAT_NORMAL: u32 = 18;
/// Rows of 16 bytes of a [`super::PackedTexture`].
pub const TEXTURE_ROWS: u32 = 6;
/// No texture, in the 16 bits of a texture index in a [`super::PackedMaterial`].
pub const NO_TEXTURE: u32 = 0xffff;

/// [`super::PackedTexture::kind`]: checkerboard of cubes.
pub const PATTERN_CHECKER: u32 = 0;
/// [`super::PackedTexture::kind`]: stripes along x.
pub const PATTERN_STRIPES: u32 = 1;
/// [`super::PackedTexture::kind`]: gradient along x.
pub const PATTERN_GRADIENT: u32 = 2;
/// [`super::PackedTexture::kind`]: gradient noise.
pub const PATTERN_NOISE: u32 = 3;
/// [`super::PackedTexture::kind`]: an image over u and v.
pub const PATTERN_PICTURE: u32 = 4;
/// Bit of [`super::PackedTexture::flags`]: the pattern is a function of u and v, not of position.
pub const TEXTURE_UV: u32 = 1;
/// Bit of [`super::PackedTexture::flags`]: texels are looked up without interpolation.
pub const TEXTURE_NEAREST: u32 = 2;
/// Bit of [`super::PackedTexture::flags`]: the same for texels that are smaller than the footprint of a ray.
pub const TEXTURE_MINIFY_NEAREST: u32 = 64;
/// Bit of [`super::PackedTexture::flags`]: the picture is looked up in the levels of its mipmap.
pub const TEXTURE_LEVELS: u32 = 128;
/// Bit of [`super::PackedTexture::flags`]: levels are interpolated.
pub const TEXTURE_BETWEEN_LEVELS: u32 = 256;
/// Bit of [`super::PackedTexture::flags`]: with [`TEXTURE_UV`], u and v are those of the second set.
pub const TEXTURE_SECOND_UV: u32 = 512;
/// Shift of the mode in [`super::PackedTexture::flags`] by which a picture continues along u.
pub const TEXTURE_WRAP_U_SHIFT: u32 = 2;
/// Shift of the mode in [`super::PackedTexture::flags`] by which a picture continues along v.
pub const TEXTURE_WRAP_V_SHIFT: u32 = 4;
/// A picture is repeated.
pub const WRAP_REPEAT: u32 = 0;
/// The edge of a picture goes on.
pub const WRAP_CLAMP: u32 = 1;
/// A picture is repeated, and every second copy is mirrored.
pub const WRAP_MIRROR: u32 = 2;

/// Bit of [`super::PackedTexture::picture`]: texels are half floats in two words.
pub const PICTURE_HALF: u32 = 0x8000_0000;
/// Bit of [`super::PackedTexture::picture`]: the colours of texels have the transfer function of sRGB.
pub const PICTURE_SRGB: u32 = 0x4000_0000;
/// The other bits of [`super::PackedTexture::picture`].
pub const PICTURE_FIRST_MASK: u32 = 0x3fff_ffff;

/// Override `BACKGROUND`: [`glimray_scene::Background::Color`].
pub const BACKGROUND_COLOR: u32 = 0;
/// Override `BACKGROUND`: [`glimray_scene::Background::Gradient`].
pub const BACKGROUND_GRADIENT: u32 = 1;
/// Override `BACKGROUND`: [`glimray_scene::Background::Picture`].
pub const BACKGROUND_PICTURE: u32 = 2;
/// Override `BACKGROUND`: a picture of [`glimray_scene::sky`], to which a sun is added.
pub const BACKGROUND_SKY: u32 = 3;

/// Override `BACKDROP`: [`glimray_scene::Backdrop::Background`].
pub const BACKDROP_BACKGROUND: u32 = 0;
/// Override `BACKDROP`: [`glimray_scene::Backdrop::Color`].
pub const BACKDROP_COLOR: u32 = 1;
/// Override `BACKDROP`: [`glimray_scene::Backdrop::Transparent`].
pub const BACKDROP_TRANSPARENT: u32 = 2;

/// Override `FILTER`: [`glimray_scene::Filter::Box`].
pub const FILTER_BOX: u32 = 0;
/// Override `FILTER`: [`glimray_scene::Filter::Tent`].
pub const FILTER_TENT: u32 = 1;
/// Override `FILTER`: [`glimray_scene::Filter::Gaussian`].
pub const FILTER_GAUSSIAN: u32 = 2;
/// Override `FILTER`: [`glimray_scene::Filter::BlackmanHarris`].
pub const FILTER_BLACKMAN_HARRIS: u32 = 3;
/// Override `FILTER`: [`glimray_scene::Filter::Mitchell`].
pub const FILTER_MITCHELL: u32 = 4;

/// Override `TRIANGLE_TEST`: [`crate::TriangleTest::Plane`].
pub const TRIANGLE_TEST_PLANE: u32 = 0;
/// Override `TRIANGLE_TEST`: [`crate::TriangleTest::MollerTrumbore`].
pub const TRIANGLE_TEST_MOLLER_TRUMBORE: u32 = 1;
/// Override `TRIANGLE_TEST`: [`crate::TriangleTest::Watertight`].
pub const TRIANGLE_TEST_WATERTIGHT: u32 = 2;

/// Override `VIEW`: [`crate::Integrator::Normals`].
pub const VIEW_NORMALS: u32 = 0;
/// Override `VIEW`: [`crate::Integrator::Depth`].
pub const VIEW_DEPTH: u32 = 1;
/// Override `VIEW`: [`crate::Integrator::Ids`].
pub const VIEW_IDS: u32 = 2;
/// Override `VIEW`: [`crate::Integrator::Heat`].
pub const VIEW_HEAT: u32 = 3;
/// Override `VIEW`: [`crate::Integrator::Uv`].
pub const VIEW_UV: u32 = 4;

/// [`super::PackedTone::curve`]: [`glimray_scene::ToneCurve::None`].
pub const TONE_NONE: u32 = 0;
/// [`super::PackedTone::curve`]: [`glimray_scene::ToneCurve::Aces`].
pub const TONE_ACES: u32 = 1;
/// [`super::PackedTone::curve`]: [`glimray_scene::ToneCurve::Agx`].
pub const TONE_AGX: u32 = 2;
/// [`super::PackedTone::curve`]: [`glimray_scene::ToneCurve::Reinhard`].
pub const TONE_REINHARD: u32 = 3;
/// [`super::PackedTone::curve`]: [`glimray_scene::ToneCurve::Neutral`].
pub const TONE_NEUTRAL: u32 = 4;

/// [`super::PackedTone::transfer`]: [`glimray_scene::Transfer::Srgb`].
pub const TRANSFER_SRGB: u32 = 0;
/// [`super::PackedTone::transfer`]: [`glimray_scene::Transfer::Linear`].
pub const TRANSFER_LINEAR: u32 = 1;

/// [`super::PackedRay::kind`]: a camera ray.
pub const RAY_PRIMARY: u32 = 0;
/// [`super::PackedRay::kind`]: a reflected ray.
pub const RAY_REFLECTION: u32 = 1;
/// [`super::PackedRay::kind`]: a refracted ray.
pub const RAY_REFRACTION: u32 = 2;
/// [`super::PackedRay::kind`]: a shadow ray.
pub const RAY_SHADOW: u32 = 3;
/// Bit of [`super::PackedRay::flags`]: it hit the side that the unflipped normal points to.
pub const RAY_OUTSIDE: u32 = 1;
/// Bit of [`super::PackedRay::flags`]: the surface is transparent.
pub const RAY_TRANSPARENT: u32 = 2;
/// Bit of [`super::PackedRay::flags`]: the media on the two sides of the surface differ.
pub const RAY_BOUNDARY: u32 = 4;
/// Bit of [`super::PackedRay::flags`]: total internal reflection.
pub const RAY_TOTAL: u32 = 8;
/// Bit of [`super::PackedRay::flags`]: a light sample of which the surface scatters nothing.
pub const RAY_UNTRACED: u32 = 16;
/// [`super::PackedRay::lobe`]: diffuse.
pub const LOBE_DIFFUSE: u32 = 0;
/// [`super::PackedRay::lobe`]: microfacets of a metal or a dielectric.
pub const LOBE_GLOSSY: u32 = 1;
/// [`super::PackedRay::lobe`]: clear coat.
pub const LOBE_COAT: u32 = 2;
/// [`super::PackedRay::lobe`]: sheen.
pub const LOBE_SHEEN: u32 = 3;
/// [`super::PackedRay::lobe`]: mirror or glass, smooth or rough.
pub const LOBE_BOUNDARY: u32 = 4;
/// [`super::PackedRay::step`]: the path goes on in the direction that it chose.
pub const STEP_SCATTERED: u32 = 0;
/// [`super::PackedRay::step`]: it goes straight on, through a hole, a thin wall or between equal media.
pub const STEP_PASSED: u32 = 1;
/// [`super::PackedRay::step`]: Russian roulette ends it.
pub const STEP_ROULETTE: u32 = 2;
/// [`super::PackedRay::step`]: the limit of bounces ends it.
pub const STEP_LIMIT: u32 = 3;
/// [`super::PackedRay::step`]: the surface reflects nothing in that direction.
pub const STEP_ABSORBED: u32 = 4;
/// [`super::PackedRay::lobe`] of a light sample: a light.
pub const SOURCE_LIGHT: u32 = 0;
/// [`super::PackedRay::lobe`] of a light sample: an emissive triangle.
pub const SOURCE_EMITTER: u32 = 1;
/// [`super::PackedRay::lobe`] of a light sample: the background.
pub const SOURCE_ENVIRONMENT: u32 = 2;
/// Rows of 16 bytes of a [`super::PackedProbe`].
pub const PROBE_ROWS: u32 = 3;
/// Rows of 16 bytes of a [`super::PackedRay`].
pub const RAY_ROWS: u32 = 17;
