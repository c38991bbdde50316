//! Materials and their pictures.

use super::model::{Model, UNSIGNED_BYTE, picture};
use super::{folder, message_in};
use crate::support::verdict::Verdict;
use glam::{DVec3, Vec3};
use glam::{Vec4, vec4};
use glimray::import::{self, Options};
use glimray::scene::{
    Coverage, Fresnel, Material, MetallicRoughness, Minify, Pattern, Scene, Space, Texture, Wrap,
};
use serde_json::{Value, json};

/// A triangle with texture coordinates and this material.
fn model(material: Value) -> Model {
    let mut model = Model::triangle(json!({ "material": 0 }));
    let uv = model.pairs(&[[0.0, 0.0], [1.0, 0.0], [0.0, 1.0]]);
    model.json["meshes"][0]["primitives"][0]["attributes"]["TEXCOORD_0"] = json!(uv);
    model.push("materials", material);
    model
}

fn material(material: Value) -> Material {
    let scene = model(material).scene();
    // The other is the ground's.
    assert_eq!(scene.materials.len(), 2);
    scene.materials[0].clone()
}

fn metallic_roughness(material: &Material) -> &MetallicRoughness {
    material.metallic_roughness().expect("the model")
}

/// The texels of a texture.
fn texels(scene: &Scene, texture: Option<usize>) -> Vec<Vec3> {
    let texture = &scene.textures[texture.expect("a texture")];
    match texture.pattern {
        Pattern::Picture { picture, .. } => {
            let texels = scene.pictures[picture].linear();
            texels.map(|texel| texel.truncate()).collect()
        }
        _ => panic!("not a picture"),
    }
}

#[track_caller]
fn assert_near(found: Vec3, expected: [f64; 3]) {
    let expected = DVec3::from(expected);
    assert!(
        found.as_dvec3().abs_diff_eq(expected, 2e-5),
        "{found} is not {expected}"
    );
}

/// Texels have 8 bits: a step of sRGB is at most 0.009.
#[track_caller]
fn assert_texel(found: Vec3, expected: [f64; 3]) {
    let expected = DVec3::from(expected);
    assert!(
        found.as_dvec3().abs_diff_eq(expected, 4.5e-3),
        "{found} is not {expected}"
    );
}

#[test]
fn a_rough_dielectric_is_diffuse_with_a_wide_weak_highlight() {
    let found = material(json!({ "pbrMetallicRoughness": {
        "baseColorFactor": [0.5, 0.25, 1, 1], "metallicFactor": 0, "roughnessFactor": 0.5 } }));
    assert_near(found.classical().diffuse, [0.5, 0.25, 1.0]);
    // α = 1/4: the exponent of Blinn and Phong is 2/α² − 2 = 30, Phong's a quarter of it. F₀ is 0.04.
    assert_eq!(found.classical().shininess, 7.5);
    assert_near(found.classical().specular, [0.04 * 38.0 / 8.0; 3]);
    assert_eq!(
        (found.classical().transmit, found.classical().opacity),
        (Vec3::ZERO, 1.0)
    );
    assert_eq!(
        (found.classical().fresnel, found.classical().ior),
        (Fresnel::Schlick, 1.5)
    );
    // (1 − 1/2)⁴ of a mirror.
    assert_near(found.classical().reflect, [0.0625; 3]);
}

#[test]
fn a_smooth_metal_reflects_its_base_color() {
    let found = material(json!({ "pbrMetallicRoughness": {
        "baseColorFactor": [1, 0.75, 0.25, 1], "metallicFactor": 1, "roughnessFactor": 0 } }));
    assert_eq!(found.classical().diffuse, Vec3::ZERO);
    assert_near(found.classical().reflect, [1.0, 0.75, 0.25]);
    assert_eq!(found.classical().fresnel, Fresnel::None);
}

#[test]
fn the_default_material_is_gltfs() {
    let scene = Model::triangle(json!({})).scene();
    let model = metallic_roughness(&scene.materials[0]);
    assert_eq!((model.metallic, model.roughness), (1.0, 1.0));
    assert_eq!(model.base_color, Vec3::ONE);
}

#[test]
fn a_volume_refracts_and_absorbs() {
    let found = material(json!({
        "pbrMetallicRoughness": { "metallicFactor": 0, "roughnessFactor": 0 },
        "extensions": {
            "KHR_materials_transmission": { "transmissionFactor": 1 },
            "KHR_materials_ior": { "ior": 1.3 },
            "KHR_materials_volume": { "thicknessFactor": 1, "attenuationDistance": 2,
                                      "attenuationColor": [1, 0.5, 0.25] },
        },
    }));
    assert_eq!(
        (found.classical().transmit, found.classical().ior),
        (Vec3::ONE, 1.3)
    );
    assert_eq!(
        (found.classical().fresnel, found.classical().diffuse),
        (Fresnel::Exact, Vec3::ZERO)
    );
    // Half remains after two units: exp(−2 a) = 1/2.
    let half = std::f64::consts::LN_2 / 2.0;
    assert_near(found.classical().absorption, [0.0, half, 2.0 * half]);
}

#[test]
fn a_thin_wall_does_not_refract() {
    let found = material(json!({
        "pbrMetallicRoughness": { "metallicFactor": 0, "roughnessFactor": 1,
                                  "baseColorFactor": [0, 1, 0, 1] },
        "extensions": { "KHR_materials_transmission": { "transmissionFactor": 0.75 } },
    }));
    assert_eq!(found.classical().ior, 1.0);
    assert_near(found.classical().transmit, [0.0, 0.75, 0.0]);
    assert_near(found.classical().diffuse, [0.0, 0.25, 0.0]);
}

#[test]
fn emission_has_its_strength_and_what_is_unlit_shines() {
    let found = material(json!({
        "emissiveFactor": [1, 0.5, 0],
        "extensions": { "KHR_materials_emissive_strength": { "emissiveStrength": 8 } },
    }));
    assert_near(found.emission, [8.0, 4.0, 0.0]);
    let found = material(json!({
        "pbrMetallicRoughness": { "baseColorFactor": [0.5, 0, 1, 1] },
        "extensions": { "KHR_materials_unlit": {} },
    }));
    assert_near(found.radiance().0, [0.5, 0.0, 1.0]);
    assert_eq!(
        (found.classical().diffuse, found.classical().specular),
        (Vec3::ZERO, Vec3::ZERO)
    );
}

/// glTF's default is single-sided. Surfaces are seen from both sides, unlit ones with their colour.
#[test]
fn the_back_emits_if_the_material_is_double_sided_or_unlit() {
    let sides = |more: Value| {
        let mut source = json!({ "emissiveFactor": [1, 1, 1] });
        source
            .as_object_mut()
            .expect("a table")
            .extend(more.as_object().expect("one").clone());
        let found = material(source);
        (found.two_sided, found.two_sided_emission)
    };
    assert_eq!(sides(json!({})), (true, false));
    assert_eq!(sides(json!({ "doubleSided": false })), (true, false));
    assert_eq!(sides(json!({ "doubleSided": true })), (true, true));
    let unlit = json!({ "extensions": { "KHR_materials_unlit": {} } });
    assert_eq!(sides(unlit), (true, true));
}

#[test]
fn every_parameter_is_kept() {
    let found = material(json!({
        "doubleSided": true, "alphaMode": "MASK", "alphaCutoff": 0.3,
        "extensions": {
            "KHR_materials_clearcoat": { "clearcoatFactor": 0.5, "clearcoatRoughnessFactor": 0.25 },
            "KHR_materials_sheen": { "sheenColorFactor": [0, 0, 1], "sheenRoughnessFactor": 0.75 },
            "KHR_materials_anisotropy": { "anisotropyStrength": 0.5, "anisotropyRotation": 1 },
            "KHR_materials_iridescence": { "iridescenceFactor": 1, "iridescenceIor": 1.5,
                                           "iridescenceThicknessMaximum": 300 },
            "KHR_materials_dispersion": { "dispersion": 0.125 },
            "KHR_materials_diffuse_transmission": { "diffuseTransmissionFactor": 0.5,
                "diffuseTransmissionColorFactor": [1, 0, 0] },
            "KHR_materials_specular": { "specularFactor": 0.5, "specularColorFactor": [2, 1, 0] },
        },
    }));
    let expected = MetallicRoughness {
        clearcoat: 0.5,
        clearcoat_roughness: 0.25,
        sheen_color: Vec3::Z,
        sheen_roughness: 0.75,
        anisotropy: 0.5,
        anisotropy_rotation: 1.0,
        iridescence: 1.0,
        iridescence_ior: 1.5,
        iridescence_thickness: [100.0, 300.0],
        dispersion: 0.125,
        diffuse_transmission: 0.5,
        diffuse_transmission_color: Vec3::X,
        specular: 0.5,
        specular_color: Vec3::new(2.0, 1.0, 0.0),
        ..MetallicRoughness::default()
    };
    assert_eq!(*metallic_roughness(&found), expected);
    assert_eq!(found.coverage, Coverage::Mask(0.3));
}

/// The notes on a material.
fn noted(material: Value) -> Vec<String> {
    super::scene("a.glb", model(material).glb()).skipped.clone()
}

#[test]
fn values_out_of_range_are_noted_with_what_is_used_instead() {
    let mut verdict = Verdict::on("values of materials");
    let of = |extension: &str, values: Value| json!({ "extensions": { format!("KHR_materials_{extension}"): values } });
    let pbr = |values: Value| json!({ "pbrMetallicRoughness": values });
    let huge = 1e39;
    let cases = [
        (
            pbr(json!({ "baseColorFactor": [2, -1, 0.5, 1] })),
            "baseColorFactor is [2, -1, 0.5, 1], but only 0 to 1 is allowed: [1, 0, 0.5, 1] is used",
        ),
        (
            pbr(json!({ "roughnessFactor": 5 })),
            "roughnessFactor is 5, but at most 1 is allowed: 1 is used",
        ),
        (
            pbr(json!({ "metallicFactor": -3 })),
            "metallicFactor is -3, but at least 0 is allowed: 0 is used",
        ),
        (
            json!({ "emissiveFactor": [20, 1, -1] }),
            "emissiveFactor is [20, 1, -1], but only 0 to 1 is allowed: [1, 1, 0] is used",
        ),
        (
            json!({ "alphaMode": "MASK", "alphaCutoff": -1 }),
            "alphaCutoff is -1, but",
        ),
        (
            of("emissive_strength", json!({ "emissiveStrength": -4 })),
            "emissiveStrength is -4, but at least 0",
        ),
        (
            of("emissive_strength", json!({ "emissiveStrength": huge })),
            "emissiveStrength is 1e39, but at most 1e12",
        ),
        (
            of("ior", json!({ "ior": 0.5 })),
            "ior is 0.5, but at least 1 is allowed: 1 is used",
        ),
        (of("ior", json!({ "ior": -2 })), "ior is -2, but"),
        (
            of("transmission", json!({ "transmissionFactor": 3 })),
            "transmissionFactor is 3, but",
        ),
        (
            of("volume", json!({ "thicknessFactor": -1 })),
            "thicknessFactor is -1, but",
        ),
        (
            of("volume", json!({ "attenuationDistance": 0 })),
            "attenuationDistance is 0, but it must be above 0: no attenuation is used",
        ),
        (
            of("volume", json!({ "attenuationDistance": -1 })),
            "attenuationDistance is -1, but",
        ),
        (
            of("volume", json!({ "attenuationColor": [2, 0, 0] })),
            "attenuationColor is [2, 0, 0], but",
        ),
        (
            of("clearcoat", json!({ "clearcoatFactor": 4 })),
            "clearcoatFactor is 4, but",
        ),
        (
            of("sheen", json!({ "sheenColorFactor": [9, 9, 9] })),
            "sheenColorFactor is [9, 9, 9], but",
        ),
        (
            of("iridescence", json!({ "iridescenceFactor": 5 })),
            "iridescenceFactor is 5, but",
        ),
        (
            of("iridescence", json!({ "iridescenceIor": 0 })),
            "iridescenceIor is 0, but",
        ),
        (
            of(
                "iridescence",
                json!({ "iridescenceThicknessMaximum": 1e30 }),
            ),
            "iridescenceThicknessMaximum is 1e30, but at most 1000000",
        ),
        (
            of("anisotropy", json!({ "anisotropyStrength": -2 })),
            "anisotropyStrength is -2, but",
        ),
        (
            of("dispersion", json!({ "dispersion": -3 })),
            "dispersion is -3, but",
        ),
        (
            of("dispersion", json!({ "dispersion": 1e20 })),
            "dispersion is 1e20, but at most 100",
        ),
        (
            of("specular", json!({ "specularColorFactor": [-1, 4, 1] })),
            "specularColorFactor is [-1, 4, 1], but at least 0",
        ),
    ];
    for (mut material, expected) in cases {
        material["name"] = json!("clay");
        let found = noted(material.clone());
        let start = format!("materials[0] `clay`: {expected}");
        let is_noted = found.len() == 1 && found[0].starts_with(&start);
        verdict.that(&material, is_noted, || format!("{found:?}"));
    }
    for material in [
        pbr(json!({ "baseColorFactor": [1, 0, 0.5, 1], "roughnessFactor": 1.000_000_1 })),
        of("ior", json!({ "ior": 0 })),
        of("specular", json!({ "specularColorFactor": [4, 4, 1] })),
        of(
            "iridescence",
            json!({ "iridescenceFactor": 1, "iridescenceThicknessMaximum": 50 }),
        ),
        of("dispersion", json!({ "dispersion": 3 })),
    ] {
        let found = noted(material.clone());
        verdict.that(&material, found.is_empty(), || format!("{found:?}"));
    }
    verdict.close();
}

#[test]
fn a_base_color_picture_is_srgb_times_a_linear_factor() {
    let mut model = model(json!({ "pbrMetallicRoughness": {
        "baseColorTexture": { "index": 0 }, "baseColorFactor": [0.5, 1, 1, 1], "metallicFactor": 0 } }));
    picture(&mut model, 2, &[[255, 0, 0, 255], [188, 188, 188, 255]]);
    let scene = model.scene();
    let textures = scene.materials[0].classical().textures;
    let found = texels(&scene, textures.diffuse);
    assert_eq!(found[0], Vec3::X);
    // ((188/255 + 0.055) / 1.055)^2.4
    assert_near(found[1], [0.502_886_5; 3]);
    assert_near(scene.materials[0].classical().diffuse, [0.5, 1.0, 1.0]);
    assert_eq!(textures.ambient, textures.diffuse);
    assert_eq!(scene.pictures.len(), 1);
}

#[test]
fn a_metallic_roughness_picture_divides_a_surface_into_metal_and_dielectric() {
    let mut model = model(json!({ "pbrMetallicRoughness": {
        "baseColorFactor": [1, 0.5, 0.25, 1], "metallicRoughnessTexture": { "index": 0 } } }));
    // Roughness 1 in green; blue is 0, then 1. Red means nothing.
    picture(&mut model, 2, &[[77, 255, 0, 255], [77, 255, 255, 255]]);
    let scene = model.scene();
    let textures = scene.materials[0].classical().textures;
    let diffuse = texels(&scene, textures.diffuse);
    assert_texel(diffuse[0], [1.0, 0.5, 0.25]);
    assert_texel(diffuse[1], [0.6, 0.3, 0.15]);
    let specular = texels(&scene, textures.specular);
    // α = 1: the height is F₀ · 8/8.
    assert_texel(specular[0], [0.04; 3]);
    assert_texel(specular[1], [1.0, 0.5, 0.25]);
    assert_eq!((textures.reflect, textures.transmit), (None, None));
}

#[test]
fn alpha_is_kept_and_means_what_its_mode_says() {
    for (mode, coverage) in [
        ("OPAQUE", Coverage::Opaque),
        ("MASK", Coverage::Mask(0.25)),
        ("BLEND", Coverage::Blend),
    ] {
        let mut model = model(json!({ "alphaMode": mode, "alphaCutoff": 0.25,
            "pbrMetallicRoughness": { "baseColorTexture": { "index": 0 },
                "baseColorFactor": [1, 1, 1, 0.5], "metallicFactor": 0 } }));
        picture(&mut model, 2, &[[255, 255, 255, 51], [255, 255, 255, 204]]);
        let scene = model.scene();
        let material = &scene.materials[0];
        // Alpha means nothing where all of the surface is there.
        let alpha = if mode == "OPAQUE" { 1.0 } else { 0.5 };
        assert_eq!((material.coverage, material.alpha), (coverage, alpha));
        assert_eq!(
            material.classical().transmit,
            Vec3::ZERO,
            "alpha is not transmission"
        );
        let Some(texture) = material.textures.alpha else {
            assert_eq!(mode, "OPAQUE");
            continue;
        };
        let Pattern::Picture { picture, .. } = scene.textures[texture].pattern else {
            panic!("not a picture");
        };
        let alphas: Vec<f32> = scene.pictures[picture]
            .linear()
            .map(|texel| texel.w)
            .collect();
        assert_eq!(alphas, [0.2, 0.8]);
    }
}

/// The texture of a picture with a transform.
fn placed(extension: Value, sampler: Value) -> (Texture, Scene) {
    let mut model = model(json!({ "pbrMetallicRoughness": { "metallicFactor": 0,
        "baseColorTexture": { "index": 0,
            "extensions": { "KHR_texture_transform": extension } } } }));
    picture(&mut model, 2, &[[255, 0, 0, 255], [0, 255, 0, 255]]);
    model.push("samplers", sampler);
    model.json["textures"][0]["sampler"] = json!(0);
    let scene = model.scene();
    let index = scene.materials[0]
        .classical()
        .textures
        .diffuse
        .expect("a texture");
    (scene.textures[index].clone(), scene)
}

#[test]
fn normal_maps_are_numbers_and_not_colors() {
    let mut model = model(json!({ "normalTexture": { "index": 0, "scale": 0.5 } }));
    picture(&mut model, 1, &[[51, 102, 255, 255]]);
    let scene = model.scene();
    let material = &scene.materials[0];
    assert_near(texels(&scene, material.textures.normal)[0], [0.2, 0.4, 1.0]);
    assert_eq!(material.normal_scale, 0.5);
    assert!(!scene.meshes[0].uvs.is_empty() && scene.skipped.is_empty());
}

#[test]
fn texture_transforms_scale_then_turn_then_move() {
    let transform = json!({ "offset": [0.25, 0.5], "rotation": 0.3, "scale": [2, 3] });
    let (texture, _) = placed(transform, json!({}));
    assert_eq!(texture.space, Space::Uv);
    for (u, v) in [(0.0, 0.0), (1.0, 0.0), (0.3, 0.9)] {
        // The matrix in the text of KHR_texture_transform, with v downwards.
        let (x, y) = (2.0 * u, 3.0 * v);
        let (sin, cos) = 0.3_f64.sin_cos();
        let (s, t) = (cos * x + sin * y + 0.25, -sin * x + cos * y + 0.5);
        let up = DVec3::new(u, 1.0 - v, 0.0);
        let found = texture.pattern_from_space.transform_point3(up);
        assert!(
            found.abs_diff_eq(DVec3::new(s, 1.0 - t, 0.0), 1e-12),
            "{found}"
        );
    }
}

#[test]
fn samplers_say_how_pictures_continue() {
    use Wrap::{Clamp, Mirror, Repeat};
    for (sampler, expected) in [
        (json!({}), (false, Minify::LinearMipmapLinear, [Repeat; 2])),
        (
            json!({ "wrapS": 33648, "magFilter": 9728, "minFilter": 9728 }),
            (true, Minify::Nearest, [Mirror, Repeat]),
        ),
        (
            json!({ "wrapS": 10497, "wrapT": 33071, "magFilter": 9729, "minFilter": 9729 }),
            (false, Minify::Linear, [Repeat, Clamp]),
        ),
        (
            json!({ "minFilter": 9984 }),
            (false, Minify::NearestMipmapNearest, [Repeat; 2]),
        ),
        (
            json!({ "minFilter": 9985 }),
            (false, Minify::LinearMipmapNearest, [Repeat; 2]),
        ),
        (
            json!({ "minFilter": 9986 }),
            (false, Minify::NearestMipmapLinear, [Repeat; 2]),
        ),
        (
            json!({ "minFilter": 9987 }),
            (false, Minify::LinearMipmapLinear, [Repeat; 2]),
        ),
    ] {
        let (texture, _) = placed(json!({}), sampler);
        let Pattern::Picture {
            nearest,
            minify,
            wrap,
            ..
        } = texture.pattern
        else {
            panic!("not a picture");
        };
        assert_eq!((nearest, minify, wrap), expected);
    }
}

#[test]
fn vertex_colors_multiply_the_base_color() {
    let mut model = Model::triangle(json!({ "material": 0 }));
    let colors = [[255, 0, 0, 255], [0, 255, 0, 255], [0, 0, 255, 255_u8]].concat();
    let color = model.accessor(&colors, UNSIGNED_BYTE, "VEC4", 3);
    model.json["accessors"][color]["normalized"] = json!(true);
    model.json["meshes"][0]["primitives"][0]["attributes"]["COLOR_0"] = json!(color);
    let factor = json!({ "baseColorFactor": [0.5, 0.5, 0.5, 1], "metallicFactor": 0 });
    model.push("materials", json!({ "pbrMetallicRoughness": factor }));
    let scene = model.scene();
    assert_near(scene.materials[0].classical().diffuse, [0.5; 3]);
    let colors = [
        vec4(1.0, 0.0, 0.0, 1.0),
        vec4(0.0, 1.0, 0.0, 1.0),
        vec4(0.0, 0.0, 1.0, 1.0),
    ];
    assert_eq!(scene.meshes[0].colors, colors);
}

/// glTF 2.0, 3.7.2.1: integers of colours are normalised.
#[test]
fn colors_keep_their_bits_and_those_that_are_none_are_repaired() {
    let of = |color: usize, model: &mut Model, mode: &str| {
        let mut model = std::mem::replace(model, Model::triangle(json!({})));
        model.json["meshes"][0]["primitives"][0]["attributes"]["COLOR_0"] = json!(color);
        model.push("materials", json!({ "alphaMode": mode }));
        model.json["meshes"][0]["primitives"][0]["material"] = json!(0);
        let scene = model.scene();
        (scene.meshes[0].colors.clone(), scene.skipped)
    };
    let mut model = Model::triangle(json!({}));
    let floats = [
        [0.123_456_79, 7.5, 0.0, 0.3],
        [1e-5, 1.0, 1.0, 1.0],
        [1.0; 4],
    ];
    let color = model.quads(&floats);
    assert_eq!(
        of(color, &mut model, "BLEND"),
        (floats.map(Vec4::from).to_vec(), vec![])
    );
    // Without an effect alpha is dropped, and so is white.
    let mut model = Model::triangle(json!({}));
    let color = model.quads(&[[1.0, 1.0, 1.0, 0.3]; 3]);
    assert_eq!(of(color, &mut model, "OPAQUE"), (vec![], vec![]));
    let mut model = Model::triangle(json!({}));
    let color = model.quads(&[[f32::NAN, -1.0, 1e9, 0.3]; 3]);
    let (colors, notes) = of(color, &mut model, "MASK");
    assert_eq!(colors, [vec4(0.0, 0.0, 1e3, 0.3); 3]);
    assert_eq!(notes, ["colours of vertices clamped to 0 to 1000: 3"]);
    let mut model = Model::triangle(json!({}));
    let color = model.accessor(
        &[[255, 51, 0, 102_u8]; 3].concat(),
        UNSIGNED_BYTE,
        "VEC4",
        3,
    );
    let (colors, notes) = of(color, &mut model, "BLEND");
    assert_eq!(colors, [vec4(1.0, 0.2, 0.0, 0.4); 3]);
    assert_eq!(notes.len(), 1, "{notes:?}");
    assert!(
        notes[0].ends_with("is not marked as normalised, and read as if it were"),
        "{notes:?}"
    );
}

#[test]
fn variants_replace_materials() {
    let mut model = Model::triangle(json!({ "material": 0, "extensions": {
        "KHR_materials_variants": { "mappings": [{ "material": 1, "variants": [1] }] } } }));
    model.push("materials", json!({ "name": "day" }));
    model.push("materials", json!({ "name": "night" }));
    let model = model.with(json!({ "extensions": { "KHR_materials_variants": {
        "variants": [{ "name": "sun" }, { "name": "moon" }] } } }));
    let files = folder(&[("a.glb", &model.glb())]);
    let options = |name: Option<&str>| Options {
        variant: name.map(str::to_owned),
        ..Options::default()
    };
    for (variant, name) in [(None, "day"), (Some("sun"), "day"), (Some("moon"), "night")] {
        let scene = import::load_with(&files.path().join("a.glb"), &options(variant));
        assert_eq!(scene.expect("a scene").materials[0].name, name);
    }
    assert_eq!(
        message_in(&files, "a.glb", &options(Some("mon"))),
        "bad model (a.glb): unknown variant `mon`, did you mean `moon`? It has `sun`, `moon`."
    );
}

#[test]
fn pictures_that_cannot_be_read_are_skipped_by_name_and_those_outside_refused() {
    let with = |uri: &str| {
        let mut model = model(json!({ "pbrMetallicRoughness": {
            "baseColorTexture": { "index": 0 }, "baseColorFactor": [0, 1, 0, 1], "metallicFactor": 0 } }));
        model.push("images", json!({ "uri": uri }));
        model.push("textures", json!({ "source": 0 }));
        model
    };
    let scene = with("gone.png").scene();
    assert_near(scene.materials[0].classical().diffuse, [0.0, 1.0, 0.0]);
    assert_eq!(
        scene.skipped,
        ["texture skipped: images[0] `gone.png` does not exist"]
    );
    assert_eq!(with("data:image/png;base64,AAAA").scene().skipped.len(), 1);
    assert_eq!(
        with("%2e%2e/secret.png").message(),
        "picture refused (a.glb): images[0]: `../secret.png` points outside the scene folder. \
         Name a file in it, or permit the other folder."
    );
}

#[test]
fn a_clear_coat_has_its_own_normal_map() {
    let mut model = model(
        json!({ "extensions": { "KHR_materials_clearcoat": { "clearcoatFactor": 1,
        "clearcoatNormalTexture": { "index": 0, "scale": 0.5 } } } }),
    );
    picture(&mut model, 1, &[[51, 102, 255, 255]]);
    let scene = super::scene("a.glb", model.glb());
    assert_eq!(scene.skipped, [] as [&str; 0]);
    let material = &scene.materials[0];
    let layers = &metallic_roughness(material).textures;
    // The map's bytes are numbers and not colours.
    assert_near(texels(&scene, layers.clearcoat_normal)[0], [0.2, 0.4, 1.0]);
    assert_eq!(material.textures.normal, None);
    assert_eq!(metallic_roughness(material).clearcoat_normal_scale, 0.5);
}

#[test]
fn what_is_not_shown_is_named() {
    let mut model = model(json!({ "extensions": { "KHR_materials_clearcoat":
        { "clearcoatTexture": { "index": 0 } } } }));
    picture(&mut model, 1, &[[128, 128, 255, 255]]);
    let model = model.with(json!({
        "extensionsUsed": ["KHR_materials_sheen", "EXT_unheard_of", "KHR_xmp_json_ld"],
    }));
    let scene = model.scene();
    assert_eq!(
        scene.skipped,
        [
            "the extension `KHR_materials_sheen` is shown by path tracing only",
            "the extension `EXT_unheard_of` is not supported and was ignored",
            "materials[0].clearcoatTexture is shown by path tracing only",
        ]
    );
    // By default models are path-traced.
    let path_traced = super::scene("a.glb", model.glb());
    assert_eq!(
        path_traced.skipped,
        ["the extension `EXT_unheard_of` is not supported and was ignored"]
    );
    let layers = &metallic_roughness(&scene.materials[0]).textures;
    assert!(layers.clearcoat.is_some());
}

#[test]
fn maps_use_two_sets_of_texture_coordinates() {
    let mut model = model(json!({
        "pbrMetallicRoughness": { "metallicFactor": 0, "baseColorTexture": { "index": 0, "texCoord": 4 } },
        "emissiveFactor": [1, 1, 1],
        "emissiveTexture": { "index": 0, "texCoord": 1,
            "extensions": { "KHR_texture_transform": { "texCoord": 0 } } },
        "normalTexture": { "index": 0, "texCoord": 4 },
        "occlusionTexture": { "index": 0, "texCoord": 0, "strength": 0.5 },
    }));
    picture(&mut model, 1, &[[128, 128, 255, 255]]);
    let other = model.pairs(&[[0.25, 0.75], [0.5, 0.5], [1.0, 0.0]]);
    model.json["meshes"][0]["primitives"][0]["attributes"]["TEXCOORD_4"] = json!(other);
    let scene = model.scene();
    assert_eq!(scene.skipped, [""; 0]);
    let material = &scene.materials[0];
    let space = |index: Option<usize>| scene.textures[index.expect("a texture")].space;
    let textures = &material.textures;
    assert_eq!(
        [
            material.classical().textures.diffuse,
            textures.normal,
            textures.emission,
            textures.occlusion
        ]
        .map(space),
        [Space::Uv, Space::Uv, Space::SecondUv, Space::SecondUv]
    );
    assert_eq!(material.occlusion_strength, 0.5);
    let mesh = &scene.meshes[0];
    let first: Vec<_> = mesh.uvs.iter().map(|uv| uv.to_array()).collect();
    assert_eq!(first, [[0.25, 0.25], [0.5, 0.5], [1.0, 1.0]]);
    assert_eq!(mesh.second_uvs.len(), 3);
    assert_ne!(mesh.second_uvs, mesh.uvs);
}

/// Adds `set` with values of its own to the only primitive.
fn add_set(model: &mut Model, set: u32) {
    let x = set as f32 / 8.0;
    let values = model.pairs(&[[x, 0.0], [0.5, x], [0.0, 1.0 - x]]);
    let attributes = &mut model.json["meshes"][0]["primitives"][0]["attributes"];
    attributes[format!("TEXCOORD_{set}")] = json!(values);
}

#[test]
fn maps_with_a_third_set_are_noted_and_those_that_cannot_be_combined_count_with_their_mean() {
    let mut model = model(json!({
        "name": "Car paint",
        "pbrMetallicRoughness": {
            "baseColorTexture": { "index": 0 },
            "metallicRoughnessTexture": { "index": 1, "texCoord": 1 },
        },
        "normalTexture": { "index": 1, "texCoord": 2 },
        "occlusionTexture": { "index": 1, "texCoord": 3 },
    }));
    picture(&mut model, 1, &[[255, 255, 255, 255]]);
    // Half as rough as the factor, and half of it a metal.
    picture(&mut model, 2, &[[0, 255, 0, 255], [0, 0, 255, 255]]);
    for set in 1..4 {
        add_set(&mut model, set);
    }
    let scene = model.scene();
    assert_eq!(
        scene.skipped,
        [
            "materials[0] `Car paint`: normalTexture is not shown, as TEXCOORD_2 is a third set of texture coordinates",
            "materials[0] `Car paint`: occlusionTexture is not shown, as TEXCOORD_3 is a third set of texture coordinates",
            "materials[0]: a map with other texture coordinates than the first is shown by its mean",
        ]
    );
    let material = &scene.materials[0];
    let expected = MetallicRoughness {
        metallic: 0.5,
        roughness: 0.5,
        ..MetallicRoughness::default()
    };
    let lobes = expected.lobes(&expected.point(), 0.5);
    let near = |a: Vec3, b: Vec3| (a - b).abs().max_element() < 5e-3;
    assert!(
        near(material.classical().diffuse, lobes.diffuse),
        "{}",
        material.classical().diffuse
    );
    assert!(
        near(material.classical().reflect, lobes.reflect),
        "{}",
        material.classical().reflect
    );
}

/// The file as it is read for path tracing.
fn path_traced(model: &Model) -> Scene {
    let folder = folder(&[("a.glb", &model.glb())]);
    let options = Options {
        staging: import::Staging::NONE,
        ..Options::default()
    };
    import::load_with(&folder.path().join("a.glb"), &options).expect("a model")
}

#[test]
fn paths_have_the_pictures_of_the_file_only() {
    let mut model = model(json!({
        "pbrMetallicRoughness": { "baseColorTexture": { "index": 0 },
                                  "metallicRoughnessTexture": { "index": 1 } },
    }));
    picture(&mut model, 1, &[[255, 128, 0, 255]]);
    picture(&mut model, 2, &[[0, 255, 0, 255], [0, 0, 255, 255]]);
    let traced = path_traced(&model);
    assert_eq!((traced.pictures.len(), traced.textures.len()), (2, 2));
    let layers = &metallic_roughness(&traced.materials[0]).textures;
    assert_eq!(layers.base_color, Some(0));
    assert!(traced.lacks_classical_maps());
    // Three colours differ from texel to texel; what passes is zero.
    let classical = model.scene();
    assert_eq!(classical.pictures.len(), 5);
    assert!(!classical.lacks_classical_maps());
    let mut baked = traced.clone();
    baked.bake_classical_maps();
    assert_eq!(baked.pictures, classical.pictures);
    assert_eq!(baked.materials[0], classical.materials[0]);
}

/// The default factor is a metal, which lets no light pass; the map says that it is none.
#[test]
fn glass_by_a_map_is_glass_for_paths() {
    let mut model = model(json!({
        "pbrMetallicRoughness": { "metallicRoughnessTexture": { "index": 0 } },
        "extensions": { "KHR_materials_transmission": { "transmissionFactor": 1 } },
    }));
    picture(&mut model, 1, &[[0, 255, 0, 255]]);
    let material = &path_traced(&model).materials[0];
    assert_eq!(material.classical().transmit, Vec3::ONE);
    assert!(material.is_thin());
}

#[test]
fn transmission_without_a_volume_is_a_thin_wall() {
    for (thickness, is_thin) in [(0.0, true), (1.0, false)] {
        let model = model(
            json!({ "pbrMetallicRoughness": { "metallicFactor": 0 }, "extensions": {
            "KHR_materials_transmission": { "transmissionFactor": 1 },
            "KHR_materials_volume": { "thicknessFactor": thickness },
        } }),
        );
        let material = &model.scene().materials[0];
        assert_eq!(material.is_thin(), is_thin, "{thickness}");
        assert!(material.classical().transmit.min_element() > 0.0);
    }
}

/// Maps are baked for the classical integrators and kept for paths; both survive an export as a native scene.
#[test]
fn materials_with_maps_survive_an_export() {
    let mut model = model(json!({
        "pbrMetallicRoughness": { "baseColorTexture": { "index": 0 }, "roughnessFactor": 0.75,
            "metallicRoughnessTexture": { "index": 1 } },
        "normalTexture": { "index": 1, "scale": 0.5 },
        "occlusionTexture": { "index": 1, "strength": 0.25 },
        "emissiveFactor": [1, 0.5, 0], "emissiveTexture": { "index": 0 },
        "extensions": {
            "KHR_materials_clearcoat": { "clearcoatFactor": 0.5, "clearcoatTexture": { "index": 1 } },
            "KHR_materials_sheen": { "sheenColorFactor": [0, 0, 1], "sheenColorTexture": { "index": 0 } },
            "KHR_materials_transmission": { "transmissionFactor": 0.5, "transmissionTexture": { "index": 1 } },
            "KHR_materials_specular": { "specularTexture": { "index": 1 } },
        },
    }));
    picture(&mut model, 2, &[[255, 0, 0, 255], [188, 188, 188, 128]]);
    picture(&mut model, 2, &[[128, 128, 255, 255], [77, 200, 30, 51]]);
    model.push(
        "materials",
        json!({ "pbrMetallicRoughness": { "baseColorTexture": { "index": 0 } },
                "extensions": { "KHR_materials_unlit": {} } }),
    );
    let mut primitive = model.json["meshes"][0]["primitives"][0].clone();
    primitive["material"] = json!(1);
    let primitives = model.json["meshes"][0]["primitives"].as_array_mut();
    primitives.expect("a list").push(primitive);
    crate::export::loss(&model.scene()).unwrap_or_else(|lost| panic!("{lost}"));
}
