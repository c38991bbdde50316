//! Packs materials and textures.

use super::{PackError, SceneFeatures, layers, light};
use crate::layout::{
    MATERIAL_BLEND, MATERIAL_COLORED_EMISSION, MATERIAL_COLORED_GLASS, MATERIAL_COLORED_MIRROR,
    MATERIAL_COVERAGE, MATERIAL_FRESNEL, MATERIAL_MASK, MATERIAL_METALLIC_ROUGHNESS,
    MATERIAL_SCHLICK, MATERIAL_SHADOW_CATCHER, MATERIAL_SUM, MATERIAL_THIN, MATERIAL_TWO_SIDED,
    MATERIAL_TWO_SIDED_EMISSION, NO_TEXTURE, PATTERN_CHECKER, PATTERN_GRADIENT, PATTERN_NOISE,
    PATTERN_PICTURE, PATTERN_STRIPES, PackedMaterial, PackedTexture, TEXTURE_BETWEEN_LEVELS,
    TEXTURE_LEVELS, TEXTURE_MINIFY_NEAREST, TEXTURE_NEAREST, TEXTURE_SECOND_UV, TEXTURE_UV,
    TEXTURE_WRAP_U_SHIFT, TEXTURE_WRAP_V_SHIFT, WRAP_CLAMP, WRAP_MIRROR, WRAP_REPEAT,
};
use glam::{DAffine3, DVec3, Vec3};
use glimray_scene::{
    Bsdf, Coverage, Fresnel, LayerProperty, Material, MaterialProperty, MetallicRoughness, Mixing,
    Pattern, Scene, Space, Target, Texels, Texture, Values, Wrap,
};
use std::sync::Arc;

/// Equals `NOISE_PERIOD` of `lib/noise.wesl`.
const NOISE_PERIOD: f64 = 256.0;

/// Packs a material. `lamp` is the index of the light whose surface it is.
pub fn material(material: &Material, lamp: Option<usize>) -> PackedMaterial {
    let phong = material.classical();
    let (emission, emission_texture) = material.radiance();
    let fresnel = match phong.fresnel {
        Fresnel::None => 0,
        Fresnel::Exact => MATERIAL_FRESNEL,
        Fresnel::Schlick => MATERIAL_FRESNEL | MATERIAL_SCHLICK,
    };
    let mixing = match phong.mixing {
        Mixing::Layer => 0,
        Mixing::Sum => MATERIAL_SUM,
        Mixing::Blend => MATERIAL_BLEND,
    };
    let (covers, alpha) = match material.coverage {
        Coverage::Mask(least) if least > 0.0 => {
            (MATERIAL_COVERAGE | MATERIAL_MASK, material.alpha / least)
        }
        Coverage::Opaque | Coverage::Mask(_) => (0, 1.0),
        Coverage::Blend => (MATERIAL_COVERAGE, material.alpha),
    };
    let sides = match (material.two_sided, material.two_sided_emission) {
        (true, true) => MATERIAL_TWO_SIDED | MATERIAL_TWO_SIDED_EMISSION,
        (true, false) => MATERIAL_TWO_SIDED,
        (false, _) => 0,
    };
    let colored = material.colored_parts();
    let colored = [
        (colored.mirror, MATERIAL_COLORED_MIRROR),
        (colored.glass, MATERIAL_COLORED_GLASS),
        (colored.emission, MATERIAL_COLORED_EMISSION),
    ];
    let colored = (colored.iter()).fold(0, |bits, (is, bit)| bits | if *is { *bit } else { 0 });
    let pair = |low: Option<usize>, high: Option<usize>| {
        let index = |texture: Option<usize>| texture.map_or(NO_TEXTURE, |index| index as u32);
        index(low) | index(high) << 16
    };
    let (textures, shaded) = (&material.textures, &phong.textures);
    PackedMaterial {
        diffuse: phong.diffuse.into(),
        shininess: phong.shininess,
        specular: phong.specular.into(),
        flags: sides
            | fresnel
            | mixing
            | covers
            | colored
            | if material.is_thin() { MATERIAL_THIN } else { 0 }
            | if material.shadow_catcher {
                MATERIAL_SHADOW_CATCHER
            } else {
                0
            }
            | match material.bsdf {
                Bsdf::MetallicRoughness(_) => MATERIAL_METALLIC_ROUGHNESS,
                Bsdf::Phong(_) => 0,
            },
        ambient: phong.ambient.into(),
        opacity: phong.opacity,
        reflect: phong.reflect.into(),
        ior: phong.ior,
        transmit: phong.transmit.into(),
        priority: material.priority,
        absorption: phong.absorption.into(),
        alpha,
        emission: emission.into(),
        textures: [
            pair(shaded.diffuse, shaded.specular),
            pair(shaded.reflect, shaded.transmit),
            pair(shaded.ambient, emission_texture),
            pair(textures.normal, textures.alpha),
        ],
        normal_scale: material.normal_scale,
        occlusion: pair(textures.occlusion, None),
        occlusion_strength: material.occlusion_strength,
        layers: layers::packed(material, lamp),
        ..Default::default()
    }
}

/// For each material, whether its `color` may be non-black at some time: its own, or a value that a track gives
/// to `property`.
fn may_be_nonblack(
    scene: &Scene,
    color: fn(&Material) -> Vec3,
    property: MaterialProperty,
) -> Vec<bool> {
    let own = scene.materials.iter().map(|m| color(m) != Vec3::ZERO);
    let mut nonblack: Vec<bool> = own.collect();
    for track in &scene.tracks {
        let is_black =
            matches!(&track.curve.values, Values::Vector(v) if v.iter().all(|v| *v == DVec3::ZERO));
        for target in &track.targets {
            match *target {
                Target::Material(index, p) if p == property => nonblack[index] |= !is_black,
                Target::Layer(index, p) if layer_changes(&scene.materials[index], p, property) => {
                    nonblack[index] = true;
                }
                _ => {}
            }
        }
    }
    nonblack
}

/// Whether a track of a layer may give this classical colour a value.
fn layer_changes(material: &Material, layer: LayerProperty, property: MaterialProperty) -> bool {
    match property {
        MaterialProperty::Emission => {
            let is_unlit = material.metallic_roughness().is_some_and(|it| it.unlit);
            is_unlit && layer == LayerProperty::BaseColor
        }
        MaterialProperty::Transmit => layer == LayerProperty::Transmission,
        MaterialProperty::Reflect => !matches!(
            layer,
            LayerProperty::Alpha | LayerProperty::EmissionStrength
        ),
        _ => false,
    }
}

/// For each material, whether it emits light at some time.
pub fn may_emit(scene: &Scene) -> Vec<bool> {
    may_be_nonblack(scene, |m| m.radiance().0, MaterialProperty::Emission)
}

/// For each material, whether it is transparent at some time.
pub fn may_transmit(scene: &Scene) -> Vec<bool> {
    may_be_nonblack(
        scene,
        |m| m.classical().transmit,
        MaterialProperty::Transmit,
    )
}

/// For each material, whether it encloses a transparent medium at some time.
pub fn may_enclose(scene: &Scene) -> Vec<bool> {
    let transmits = may_transmit(scene).into_iter().zip(&scene.materials);
    transmits
        .map(|(is, material)| is && !material.is_thin())
        .collect()
}

/// Whether total internal reflection converts transmitted light to reflected light for some material. With
/// Fresnel, `reflect` covers that case; `sum` mixing does not convert.
fn has_total_reflection(scene: &Scene) -> bool {
    let mut materials = scene.materials.iter().zip(may_enclose(scene));
    materials.any(|(material, encloses)| {
        let phong = material.classical();
        encloses && phong.fresnel == Fresnel::None && phong.mixing != Mixing::Sum
    })
}

/// Whether some material has partly weighted local shading at some time.
fn has_thin_material(scene: &Scene) -> bool {
    let is_layer = |material: &Material| material.classical().mixing == Mixing::Layer;
    let is_thin = |material: &Material| is_layer(material) && material.classical().opacity != 1.0;
    let thins = |target: &Target| {
        matches!(*target, Target::Material(index, MaterialProperty::Opacity)
            if is_layer(&scene.materials[index]))
    };
    let mut targets = scene.tracks.iter().flat_map(|track| &track.targets);
    scene.materials.iter().any(is_thin) || targets.any(thins)
}

/// The features used by materials, textures and pictures.
pub fn features(scene: &Scene) -> SceneFeatures {
    let mirrors = may_be_nonblack(scene, |m| m.classical().reflect, MaterialProperty::Reflect)
        .contains(&true);
    let refraction = may_transmit(scene).contains(&true);
    let emission = may_emit(scene).contains(&true);
    let transparent = may_enclose(scene).into_iter().zip(&scene.materials);
    let mut priorities = transparent.filter_map(|(is, material)| is.then_some(material.priority));
    let first = priorities.next();
    let has_pattern = |is: fn(&Pattern) -> bool| scene.textures.iter().any(|it| is(&it.pattern));
    let has_texels = |is: fn(&Texels) -> bool| scene.pictures.iter().any(|it| is(&it.texels));
    SceneFeatures {
        priorities: priorities.any(|other| Some(other) != first),
        // Refraction includes the code for thin materials.
        reflection: mirrors
            || has_total_reflection(scene)
            || !refraction && has_thin_material(scene),
        refraction,
        gloss: (may_be_nonblack(
            scene,
            |m| m.classical().specular,
            MaterialProperty::Specular,
        ))
        .contains(&true)
            || has_layers(scene, |_, _, model| !model.unlit),
        metallic_roughness: has_layers(scene, |_, _, _| true),
        coatings: has_layers(scene, |_, _, model| model.is_coated()),
        coated_emission: emission && has_layers(scene, |_, _, model| model.clearcoat > 0.0),
        coat_normals: has_layers(scene, |_, material, model| {
            let own = model.textures.clearcoat_normal;
            model.clearcoat > 0.0 && own.or(material.textures.normal).is_some()
        }),
        rough_glass: has_rough_glass(scene),
        dispersion: has_layers(scene, |_, material, it| {
            it.dispersion > 0.0 && !material.is_thin()
        }),
        thin_walls: (may_transmit(scene).into_iter().zip(&scene.materials))
            .any(|(transmits, material)| transmits && material.is_thin()),
        shadow_catchers: scene.materials.iter().any(|it| it.shadow_catcher),
        textures: !scene.textures.is_empty(),
        noise: has_pattern(|it| matches!(it, Pattern::Noise { .. })),
        pictures: has_pattern(|it| matches!(it, Pattern::Picture { .. })),
        footprints: has_pattern(|it| match it {
            Pattern::Picture {
                nearest, minify, ..
            } => minify.has_levels() || minify.is_nearest() != *nearest,
            _ => false,
        }),
        byte_texels: has_texels(|it| !matches!(it, Texels::Float(_))),
        half_texels: has_texels(|it| matches!(it, Texels::Float(_))),
        optics_textures: scene.materials.iter().any(|material| {
            let shaded = material.classical().textures;
            (shaded.reflect.or(shaded.transmit))
                .or(material.radiance().1)
                .is_some()
        }),
        coverage: (scene.materials.iter()).any(|it| it.coverage != Coverage::Opaque),
        occlusion_maps: (scene.materials.iter()).any(|it| it.textures.occlusion.is_some()),
        anisotropy: (scene.materials.iter())
            .filter_map(Material::metallic_roughness)
            .any(|model| model.anisotropy > 0.0 && !model.unlit),
        normal_maps: (scene.materials.iter()).any(|material| material.textures.normal.is_some()),
        emission: emission || light::visible(scene).next().is_some(),
        ..SceneFeatures::default()
    }
}

/// Whether some material is rough and transparent at some time.
fn has_rough_glass(scene: &Scene) -> bool {
    let is_animated = |index, property| {
        let mut targets = scene.tracks.iter().flat_map(|track| &track.targets);
        targets.any(|target| *target == Target::Layer(index, property))
    };
    has_layers(scene, |index, _, model| {
        (model.transmission > 0.0 || is_animated(index, LayerProperty::Transmission))
            && (model.roughness > 0.0 || is_animated(index, LayerProperty::Roughness))
    })
}

/// Whether a metallic-roughness material, its index and its model satisfy `holds`.
fn has_layers(scene: &Scene, holds: impl Fn(usize, &Material, &MetallicRoughness) -> bool) -> bool {
    (scene.materials.iter().enumerate()).any(|(index, material)| {
        let model = material.metallic_roughness();
        model.is_some_and(|model| holds(index, material, model))
    })
}

/// Packs all textures. Their indices must differ from `NO_TEXTURE`.
pub fn textures(
    textures: &[Texture],
    origin: DVec3,
    pictures: &[[u32; 3]],
) -> Result<Arc<[PackedTexture]>, PackError> {
    let (count, limit) = (textures.len(), NO_TEXTURE as usize);
    if count > limit {
        let what = "textures";
        return Err(PackError::TooMany { what, count, limit });
    }
    let pack = |one| texture(one, origin, pictures);
    Ok(textures.iter().map(pack).collect())
}

fn texture(texture: &Texture, origin: DVec3, pictures: &[[u32; 3]]) -> PackedTexture {
    let mut space = match texture.space {
        Space::World => texture.pattern_from_space * DAffine3::from_translation(origin),
        Space::Uv | Space::SecondUv => texture.pattern_from_space,
    };
    // Whole periods are subtracted, so that f32 is as precise far from the origin of the pattern as near it.
    let periods = periods(&texture.pattern);
    let repetitions = (space.translation / periods).round();
    space.translation -=
        DVec3::select(periods.is_finite_mask(), periods * repetitions, DVec3::ZERO);
    // Clamped so that no point of a scene overflows.
    let row = |i| {
        let row = space.matrix3.row(i);
        [row.x, row.y, row.z, space.translation[i]].map(|c| c.clamp(-1e18, 1e18) as f32)
    };
    let mut packed = PackedTexture {
        flags: match texture.space {
            Space::World => 0,
            Space::Uv => TEXTURE_UV,
            Space::SecondUv => TEXTURE_UV | TEXTURE_SECOND_UV,
        },
        row_x: row(0),
        row_y: row(1),
        row_z: row(2),
        ..Default::default()
    };
    let mut colors = |kind, a: Vec3, b: Vec3| {
        (packed.kind, packed.color_a, packed.color_b) = (kind, a.into(), b.into());
    };
    match texture.pattern {
        Pattern::Checker { a, b } => colors(PATTERN_CHECKER, a, b),
        Pattern::Stripes { a, b } => colors(PATTERN_STRIPES, a, b),
        Pattern::Gradient { a, b } => colors(PATTERN_GRADIENT, a, b),
        Pattern::Noise { a, b, octaves } => {
            colors(PATTERN_NOISE, a, b);
            packed.octaves = octaves;
        }
        Pattern::Picture {
            picture,
            nearest,
            minify,
            wrap: [u, v],
        } => {
            packed.kind = PATTERN_PICTURE;
            let bit = |bit: u32, is_on: bool| if is_on { bit } else { 0 };
            packed.flags |= bit(TEXTURE_NEAREST, nearest)
                | bit(TEXTURE_MINIFY_NEAREST, minify.is_nearest())
                | bit(TEXTURE_LEVELS, minify.has_levels())
                | bit(TEXTURE_BETWEEN_LEVELS, minify.blends_levels());
            packed.flags |= wrap(u) << TEXTURE_WRAP_U_SHIFT | wrap(v) << TEXTURE_WRAP_V_SHIFT;
            [packed.picture, packed.width, packed.height] = pictures[picture];
        }
    }
    packed
}

/// The period of a pattern along each axis, in pattern units; infinite if there is none.
fn periods(pattern: &Pattern) -> DVec3 {
    match pattern {
        Pattern::Checker { .. } => DVec3::splat(2.0),
        Pattern::Stripes { .. } => DVec3::ONE,
        Pattern::Picture { wrap: [u, v], .. } => {
            let period = |wrap: &Wrap| match wrap {
                Wrap::Repeat => 1.0,
                Wrap::Clamp => f64::INFINITY,
                Wrap::Mirror => 2.0,
            };
            DVec3::new(period(u), period(v), f64::INFINITY)
        }
        Pattern::Noise { .. } => DVec3::splat(NOISE_PERIOD),
        Pattern::Gradient { .. } => DVec3::INFINITY,
    }
}

fn wrap(wrap: Wrap) -> u32 {
    match wrap {
        Wrap::Repeat => WRAP_REPEAT,
        Wrap::Clamp => WRAP_CLAMP,
        Wrap::Mirror => WRAP_MIRROR,
    }
}
