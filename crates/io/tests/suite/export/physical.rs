//! `pbr` in native scenes: every key reaches the model, bad values have a message, and models of other formats keep
//! theirs.

use super::{loss, round};
use glam::{DVec3, Vec3};
use glimray::import::{self, Options};
use glimray::scene::{
    Beyond, Curve, Easing, Fresnel, Interpolation, LayerProperty, Material, MetallicRoughness,
    Scene, Target, Track, Values,
};
use std::path::Path;

fn parsed(text: &str) -> Result<Scene, String> {
    let read = import::parse("a.toml", text, &Options::default());
    read.map_err(|error| error.to_string())
}

fn material(pbr: &str) -> Material {
    let text = format!("[materials.a]\n{pbr}");
    parsed(&text)
        .unwrap_or_else(|error| panic!("{error}\n{text}"))
        .materials[0]
        .clone()
}

#[test]
fn every_key_of_pbr_reaches_the_model() {
    let found = material(
        "pbr = { base_color = [0.1, 0.2, 0.3], metallic = 0.25, roughness = 0.75, ior = 1.4, specular = 0.5, \
         specular_color = [2, 1, 0], transmission = 0.125, thickness = 2, attenuation_color = [0.5, 1, 1], \
         attenuation_distance = 3, priority = 4, clearcoat = 0.5, clearcoat_roughness = 0.25, \
         sheen_color = [0, 0, 1], sheen_roughness = 1, iridescence = 1, iridescence_ior = 1.8, \
         iridescence_thickness = [50, 300], anisotropy = 0.5, anisotropy_rotation_deg = 90, dispersion = 0.5, \
         diffuse_transmission = 0.75, diffuse_transmission_color = [1, 0, 0] }",
    );
    let expected = MetallicRoughness {
        base_color: Vec3::new(0.1, 0.2, 0.3),
        metallic: 0.25,
        roughness: 0.75,
        ior: 1.4,
        specular: 0.5,
        specular_color: Vec3::new(2.0, 1.0, 0.0),
        transmission: 0.125,
        thickness: 2.0,
        attenuation_color: Vec3::new(0.5, 1.0, 1.0),
        attenuation_distance: 3.0,
        clearcoat: 0.5,
        clearcoat_roughness: 0.25,
        sheen_color: Vec3::Z,
        sheen_roughness: 1.0,
        iridescence: 1.0,
        iridescence_ior: 1.8,
        iridescence_thickness: [50.0, 300.0],
        anisotropy: 0.5,
        anisotropy_rotation: std::f32::consts::FRAC_PI_2,
        dispersion: 0.5,
        diffuse_transmission: 0.75,
        diffuse_transmission_color: Vec3::X,
        ..MetallicRoughness::default()
    };
    assert_eq!(found.metallic_roughness(), Some(&expected));
    assert_eq!(found.priority, 4);
    // The classical integrators see glTF's mapping: absorption is -ln(colour)/distance.
    assert_eq!(
        (
            found.classical().ior,
            found.classical().fresnel,
            found.is_thin()
        ),
        (1.4, Fresnel::Exact, false)
    );
    assert!(
        (found.classical().absorption.x - 2_f32.ln() / 3.0).abs() < 1e-6,
        "{}",
        found.classical().absorption
    );
    let plain = material("pbr = {}");
    let model = plain.metallic_roughness().expect("a model");
    assert_eq!((model.metallic, model.roughness), (0.0, 0.5));
    assert_eq!(
        (model.base_color, plain.classical().diffuse),
        (Vec3::splat(0.8), Vec3::splat(0.8))
    );
}

#[test]
fn textures_of_pbr_are_those_of_its_parameters() {
    let text = "[textures.wood]\nnoise = { a = [1, 1, 1], b = [0.5, 0.5, 0.5] }\n[materials.a]\n\
        pbr = { base_color = { texture = 'wood', color = [0.5, 1, 1] }, metallic = { texture = 'wood' }, \
        roughness = { checker = {}, value = 0.5 }, clearcoat = { gradient = {} }, metallic = { texture = 'wood' } }";
    // A key must not occur twice.
    assert!(parsed(text).is_err());
    let scene = parsed(&text.replace(
        "gradient = {} }, metallic = { texture = 'wood' }",
        "gradient = {} }",
    ));
    let scene = scene.expect("a scene");
    let material = &scene.materials[0];
    let model = material.metallic_roughness().expect("a model");
    let layers = &model.textures;
    assert_eq!((layers.base_color, layers.metallic), (Some(0), Some(0)));
    assert_eq!((layers.roughness, layers.clearcoat), (Some(1), Some(2)));
    assert_eq!(
        (model.metallic, model.roughness, model.clearcoat),
        (1.0, 0.5, 1.0)
    );
    assert_eq!(model.base_color, Vec3::new(0.5, 1.0, 1.0));
    // Metals are shown by mirrors, and by diffuse colours in part.
    assert_eq!(
        (
            material.classical().textures.diffuse,
            material.classical().textures.reflect
        ),
        (Some(0), Some(0))
    );
}

#[test]
fn phong_and_optics_are_what_the_classical_integrators_show_instead() {
    let found = material("pbr = { base_color = [1, 0, 0] }\nphong = { diffuse = [0, 1, 0] }");
    assert_eq!(found.classical().diffuse, Vec3::Y);
    let model = found.metallic_roughness().expect("a model");
    assert_eq!(model.base_color, Vec3::X);
    let found = material("pbr = {}\noptics = { reflect = [0.5, 0.5, 0.5] }");
    assert_eq!(
        (found.classical().reflect, found.classical().fresnel),
        (Vec3::splat(0.5), Fresnel::None)
    );
}

#[test]
fn values_that_are_out_of_range_are_refused() {
    let messages = [
        (
            "pbr = { base_color = [0.5, 1.5, 0] }",
            "a channel of this colour is above 1, so the surface would create light. Lower it, or use `emission`.",
        ),
        (
            "pbr = { sheen_color = { checker = { a = [2, 0, 0] } } }",
            "a channel of this colour is above 1, so the surface would create light. Lower it, or use `emission`.",
        ),
        (
            "pbr = { roughness = 1.5 }",
            "1.5 is not between 0 and 1. See `glimray schema` for what is allowed.",
        ),
        (
            "pbr = { roughness = { checker = { a = [2, 2, 2] } } }",
            "this texture has numbers above 1. Lower its colours.",
        ),
        (
            "pbr = { specular = { checker = {} } }",
            "this number is read from the alpha of a texture, which only pictures have. Give it a picture, or a number.",
        ),
        (
            "pbr = { ior = 0.5 }",
            "0.5 is not an index of refraction between 1 and 1000000. See `glimray schema` for what is allowed.",
        ),
        (
            "pbr = { attenuation_distance = 0 }",
            "0 is not greater than 0. See `glimray schema` for what is allowed.",
        ),
        (
            "pbr = { metallic = true }",
            "invalid type: boolean `true`, expected a number between 0 and 1, or a texture. See `glimray schema` for what is allowed.",
        ),
        (
            "pbr = { iridescence_thickness = [1] }",
            "expected two numbers [thinnest, thickest], found fewer. See `glimray schema` for what is allowed.",
        ),
        (
            "pbr = { iridescence_thickness_map = { checker = {}, value = 0.5 } }",
            "a map between two thicknesses has no `value`. Change the thicknesses instead.",
        ),
        (
            "pbr = {}\nrefract = {}",
            "`pbr` determines reflection and transmission. Leave out `reflect` and `refract`, or write `optics` for the classical integrators.",
        ),
    ];
    for (text, expected) in messages {
        let error = parsed(&format!("[materials.a]\n{text}")).expect_err(text);
        assert!(error.starts_with("bad scene (a.toml:"), "{error}");
        assert!(error.ends_with(expected), "{error}");
    }
}

/// The model of the project has metal, glass, a normal map, holes and vertex colours.
#[test]
fn a_gltf_model_keeps_its_materials() {
    let model = Path::new("assets/scenes/flower.glb");
    // The model moves; native scenes keep its pose.
    let mut scene = import::load(model).expect("a model").at_rest(0.0);
    scene.clips.clear();
    loss(&scene).unwrap_or_else(|lost| panic!("{lost}"));
    let text = round(&scene).expect("a scene").1.text;
    let physical = scene
        .materials
        .iter()
        .filter(|it| it.metallic_roughness().is_some());
    assert_eq!(text.matches("pbr = {").count(), physical.count(), "{text}");
}

/// Native animations have no base colour: the classical integrators keep the diffuse colours that follow from it.
#[test]
fn an_animated_base_colour_is_written_as_the_diffuse_colour_that_follows_from_it() {
    let mut scene = parsed("[materials.a]\npbr = { transmission = 0.5, tint = [1, 0.5, 0.5] }")
        .expect("a scene");
    scene.tracks.push(Track {
        targets: vec![Target::Layer(0, LayerProperty::BaseColor)],
        curve: Curve {
            times: vec![0.0, 1.0],
            values: Values::Vector(vec![DVec3::X, DVec3::ONE]),
            interpolation: Interpolation::Linear,
            easing: Easing::None,
            beyond: Beyond::Hold,
        },
    });
    let (read, _) = round(&scene).expect("a scene");
    for time in [0.0, 0.5, 1.0] {
        let [wanted, found] = [&scene, &read].map(|it| it.frame(time).materials[0].clone());
        let (wanted, found) = (wanted.classical(), found.classical());
        for (wanted, found) in [
            (wanted.diffuse, found.diffuse),
            (wanted.ambient, found.ambient),
        ] {
            assert!(found.abs_diff_eq(wanted, 1e-6), "{found}, not {wanted}");
        }
    }
}

/// The look that a file gives is not kept where it is the derived one, so that it follows later edits.
#[test]
fn a_look_that_is_given_as_it_would_be_derived_stays_derived() {
    let same = material("pbr = { roughness = 1 }\noptics = { ior = 1.5, fresnel = 'schlick' }");
    let model = same.metallic_roughness().expect("a model");
    assert_eq!(model.phong, None);
    let other = material("pbr = { roughness = 1 }\noptics = { ior = 1.5 }");
    let model = other.metallic_roughness().expect("a model");
    assert_eq!(model.phong.as_deref(), Some(&*other.classical()));
}
