//! Features of a scene that a kernel needs code for; all others are compiled out.

/// Bounded primitives that are in no BVH: all of a kind, of which there are a few among many of the other kind.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum OutsideTree {
    /// None.
    #[default]
    Nothing,
    /// All triangles.
    Triangles,
    /// All bounded shapes.
    Shapes,
}

/// The features of a scene that a kernel needs code for.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct SceneFeatures {
    /// Bit k is set if there is a bounded shape of kind k.
    pub shape_kinds: u32,
    /// Primitive kind tested without a BVH.
    pub outside_tree: OutsideTree,
    /// The corners of some triangle differ in material.
    pub mixed_materials: bool,
    /// Some material reflects, possibly only by total internal reflection, or has partly weighted local
    /// shading.
    pub reflection: bool,
    /// Some material is transparent.
    pub refraction: bool,
    /// A dielectric volume may touch or overlap another object.
    pub contact: bool,
    /// Transparent materials differ in priority.
    pub priorities: bool,
    /// Transparent surfaces filter shadow rays.
    pub filtered_shadows: bool,
    /// Some transparent material is a thin wall.
    pub thin_walls: bool,
    /// Some material has highlights.
    pub gloss: bool,
    /// Some material is described by metal and roughness.
    pub metallic_roughness: bool,
    /// Some material has a clear coat, sheen, a thin film or diffuse transmission.
    pub coatings: bool,
    /// Some emissive material has a clear coat.
    pub coated_emission: bool,
    /// Some clear coat differs in its normal from what lies below it.
    pub coat_normals: bool,
    /// Some transparent material is rough.
    pub rough_glass: bool,
    /// Some volume disperses light.
    pub dispersion: bool,
    /// Some material catches shadows.
    pub shadow_catchers: bool,
    /// There are textures.
    pub textures: bool,
    /// Some mesh has a second set of texture coordinates.
    pub second_uvs: bool,
    /// Some texture is noise.
    pub noise: bool,
    /// Some texture is a picture.
    pub pictures: bool,
    /// Some picture is filtered over the footprint of a ray.
    pub footprints: bool,
    /// Some surface has holes.
    pub coverage: bool,
    /// Some material has a normal map.
    pub normal_maps: bool,
    /// Some metallic-roughness material reflects more along its tangents than across them.
    pub anisotropy: bool,
    /// Some material has an occlusion map.
    pub occlusion_maps: bool,
    /// Some picture has 8 bits per channel.
    pub byte_texels: bool,
    /// Some picture has floats.
    pub half_texels: bool,
    /// Some texture is of reflection, transmission or emission.
    pub optics_textures: bool,
    /// There is an emissive surface.
    pub emission: bool,
    /// There are instances.
    pub instances: bool,
}
