//! Mirrors, glass and shadows in native scenes.

use super::{messages, scene};
use glam::Vec3;
use glimray::scene::{Antialias, Fresnel, Material, Mixing, Shadows};
use insta::assert_snapshot;

fn material(text: &str) -> Material {
    scene("a.toml", format!("materials.a = {text}")).materials[0].clone()
}

#[test]
fn a_mirror_shades_with_the_rest() {
    let plain = material("{ reflect = { amount = 0.5, color = [1, 0.5, 0] } }");
    assert_eq!(plain.classical().reflect, Vec3::new(0.5, 0.25, 0.0));
    assert_eq!(
        (plain.classical().fresnel, plain.classical().mixing),
        (Fresnel::None, Mixing::Layer)
    );
    assert_eq!(
        (plain.classical().transmit, plain.classical().opacity),
        (Vec3::ZERO, 1.0)
    );
    let varnished = material("{ reflect = { fresnel = 'schlick' } }");
    assert_eq!(
        (varnished.classical().reflect, varnished.classical().ior),
        (Vec3::ONE, 1.5)
    );
    assert_eq!(varnished.classical().fresnel, Fresnel::Schlick);
}

#[test]
fn glass_reflects_and_transmits_by_fresnel_by_default() {
    let glass = material(
        "{ refract = { amount = 0.75, color = [1, 0, 0], absorption = [1, 2, 3], priority = 4 } }",
    );
    assert_eq!(
        (glass.classical().reflect, glass.classical().transmit),
        (Vec3::splat(0.75), 0.75 * Vec3::X)
    );
    assert_eq!(
        (
            glass.classical().opacity,
            glass.classical().ior,
            glass.priority
        ),
        (0.25, 1.5, 4)
    );
    assert_eq!(
        (glass.classical().fresnel, glass.classical().absorption),
        (Fresnel::Exact, Vec3::new(1.0, 2.0, 3.0))
    );
    let plain = material(
        "{ reflect = { amount = 0.25 }, refract = { amount = 0.75, ior = 1.33, fresnel = 'none' } }",
    );
    assert_eq!(
        (plain.classical().reflect, plain.classical().transmit),
        (Vec3::splat(0.25), Vec3::splat(0.75))
    );
    assert_eq!(
        (plain.classical().fresnel, plain.classical().ior),
        (Fresnel::None, 1.33)
    );
}

#[test]
fn shadows_and_depth_come_from_the_scene() {
    let plain = scene("a.toml", "ambient = [1, 1, 1]");
    assert_eq!(
        (plain.shadows, plain.output.max_depth),
        (Shadows::Opaque, 5)
    );
    let chosen = scene(
        "a.toml",
        "shadows = 'filtered'\noutput = { max_depth = 12, antialias = 'adaptive', noise = 0.5 }",
    );
    assert_eq!(
        (chosen.shadows, chosen.output.max_depth),
        (Shadows::Filtered, 12)
    );
    let output = chosen.output;
    assert_eq!(
        (output.antialias, output.noise),
        (Some(Antialias::Adaptive), 0.5)
    );
}

#[test]
fn every_error_has_a_message() {
    let texts = [
        "{ refract = { ior = 0 } }",
        "{ refract = { ior = -1.5 } }",
        "{ refract = { ior = nan } }",
        "{ refract = { ior = 1e6 } }",
        "{ refract = { absorption = [0, -1, 0] } }",
        "{ refract = { absorption = [0, 0] } }",
        "{ refract = { amount = 1.5 } }",
        "{ refract = { priority = 0.5 } }",
        "{ refract = { fresnel = 'schlik' } }",
        "{ reflect = { amount = -0.1 } }",
        "{ reflect = { colour = [1, 1, 1] } }",
        "{ reflect = {}, refract = {} }",
        "{ reflect = { amount = 0.5 }, refract = { amount = 0.6, fresnel = 'none' } }",
        "{ emission = [-1, 0, 0] }",
    ];
    let mut texts: Vec<_> = texts
        .iter()
        .map(|text| format!("materials.a = {text}"))
        .collect();
    texts.push("shadows = 'soft'".to_owned());
    texts.push("output = { max_depth = -1 }".to_owned());
    texts.push("output = { max_depth = 1.5 }".to_owned());
    assert_snapshot!(messages("a.toml", &texts), @r#"
bad scene (a.toml:1:35): 0 is not an index of refraction between 0.01 and 100. See `glimray schema` for what is allowed.
bad scene (a.toml:1:35): -1.5 is not an index of refraction between 0.01 and 100. See `glimray schema` for what is allowed.
bad scene (a.toml:1:35): NaN is not a finite number. See `glimray schema` for what is allowed.
bad scene (a.toml:1:35): 1000000 is not an index of refraction between 0.01 and 100. See `glimray schema` for what is allowed.
bad scene (a.toml:1:42): -1 in an absorption is not between 0 and 1e12. See `glimray schema` for what is allowed.
bad scene (a.toml:1:42): expected three numbers [x, y, z], found fewer. See `glimray schema` for what is allowed.
bad scene (a.toml:1:38): 1.5 is not between 0 and 1. See `glimray schema` for what is allowed.
bad scene (a.toml:1:40): 0.5 is not a whole number from -100 to 100. See `glimray schema` for what is allowed.
bad scene (a.toml:1:39): unknown value `schlik`, did you mean `schlick`? Allowed here: `none`, `exact`, `schlick`.
bad scene (a.toml:1:38): -0.1 is not between 0 and 1. See `glimray schema` for what is allowed.
bad scene (a.toml:1:29): unknown key `colour`, did you mean `color`? Allowed here: `amount`, `color`, `fresnel`, `ior`.
bad scene (a.toml:1:41): Fresnel's equations already determine how much a refracting surface reflects. Leave out `reflect`, or add `fresnel = "none"` to `refract`.
bad scene (a.toml:1:55): the sum of `amount` and that of `reflect` exceeds 1. Lower one of them.
bad scene (a.toml:1:28): -1 in a colour is negative. See `glimray schema` for what is allowed.
bad scene (a.toml:1:11): unknown value `soft`. Allowed here: `opaque`, `filtered`.
bad scene (a.toml:1:24): -1 is not a whole number from 0 to 1000. See `glimray schema` for what is allowed.
bad scene (a.toml:1:24): 1.5 is not a whole number from 0 to 1000. See `glimray schema` for what is allowed.
"#);
}

#[test]
fn layers_out_of_range_are_refused() {
    let pbr = |text: &str| format!("materials.a.pbr = {{ {text} }}");
    let texts = [
        pbr("dispersion = 1e10"),
        pbr("dispersion = -1"),
        pbr("iridescence_ior = 1e20"),
        pbr("iridescence_ior = 0.9"),
        pbr("iridescence_thickness = [0, 1e30]"),
        pbr("iridescence_thickness = [400, 100]"),
        pbr("ior = 1e20"),
    ];
    assert_snapshot!(messages("a.toml", &texts), @r"
bad scene (a.toml:1:34): 10000000000 is not a dispersion between 0 and 100. See `glimray schema` for what is allowed.
bad scene (a.toml:1:34): -1 is not a dispersion between 0 and 100. See `glimray schema` for what is allowed.
bad scene (a.toml:1:39): 1e20 is not an index of refraction between 1 and 100. See `glimray schema` for what is allowed.
bad scene (a.toml:1:39): 0.9 is not an index of refraction between 1 and 100. See `glimray schema` for what is allowed.
bad scene (a.toml:1:45): 1e30 is not a thickness between 0 and 1000000 nanometres. See `glimray schema` for what is allowed.
bad scene (a.toml:1:45): the thinnest part is thicker than the thickest, and there is no map. Give the smaller number first, or an `iridescence_thickness_map`.
bad scene (a.toml:1:27): 1e20 is not an index of refraction between 1 and 1000000. See `glimray schema` for what is allowed.
");
    // With a map white may be the thinner part.
    let map = "iridescence_thickness = [400, 100], iridescence_thickness_map = { checker = {} }";
    scene("a.toml", pbr(map));
}
