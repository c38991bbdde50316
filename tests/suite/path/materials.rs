//! Metallic-roughness materials in path-traced pictures: what they reflect of even light.

use super::{ball_in, mean, near, paths};
use crate::support::verdict::Verdict;
use glam::Vec3;
use glimray::scene::{Material, MetallicRoughness};

/// A material as the importers make it.
fn material(model: MetallicRoughness) -> Material {
    Material {
        metallic_roughness: Some(model.clone().into()),
        ..model.classical(String::new())
    }
}

/// What a ball of the material shows of a background of 1.
fn in_even_light(model: MetallicRoughness) -> f64 {
    mean(&ball_in(1.0, material(model)), &paths(256, (12, 12), 16))
}

/// Nothing absorbs: white metals and dielectrics of every roughness, under a white coat or white cloth too, reflect all
/// light. The ball is convex, so that light meets it once.
#[test]
fn white_materials_are_invisible_in_even_light() {
    let mut verdict = Verdict::on("white balls under a background of 1");
    let dielectric = MetallicRoughness {
        metallic: 0.0,
        ..MetallicRoughness::default()
    };
    for roughness in [0.0, 0.1, 0.3, 0.5, 0.7, 0.9, 1.0] {
        let metal = MetallicRoughness {
            roughness,
            ..MetallicRoughness::default()
        };
        let plastic = MetallicRoughness {
            roughness,
            ..dielectric.clone()
        };
        let coated = MetallicRoughness {
            clearcoat: 1.0,
            clearcoat_roughness: roughness,
            ..plastic.clone()
        };
        let cloth = MetallicRoughness {
            sheen_color: Vec3::ONE,
            sheen_roughness: roughness.max(0.1),
            ..plastic.clone()
        };
        let through = MetallicRoughness {
            diffuse_transmission: 0.0,
            ior: 2.0,
            ..plastic.clone()
        };
        for (name, model) in [
            ("metal", metal),
            ("plastic", plastic),
            ("coated plastic", coated),
            ("cloth", cloth),
            ("plastic of index 2", through),
        ] {
            let found = in_even_light(model);
            near(
                &mut verdict,
                format!("{name}, roughness {roughness}"),
                found,
                1.0,
                0.005,
            );
        }
    }
    verdict.close();
}

/// With colours and films no material reflects more light than arrives.
#[test]
fn no_material_reflects_more_light_than_arrives() {
    let mut verdict = Verdict::on("coated balls under a background of 1");
    for roughness in [0.05, 0.4, 1.0] {
        for metallic in [0.0, 0.5, 1.0] {
            for thickness in [100.0, 300.0, 550.0] {
                let model = MetallicRoughness {
                    base_color: Vec3::new(0.9, 0.95, 1.0),
                    metallic,
                    roughness,
                    iridescence: 1.0,
                    iridescence_thickness: [thickness, thickness],
                    clearcoat: 0.5,
                    clearcoat_roughness: 0.1,
                    sheen_color: Vec3::new(0.3, 0.6, 0.2),
                    sheen_roughness: 0.5,
                    ..MetallicRoughness::default()
                };
                let found = in_even_light(model);
                let what = format!("roughness {roughness}, metallic {metallic}, film {thickness}");
                verdict.that(what, found <= 1.002 && found > 0.2, || format!("{found}"));
            }
        }
    }
    verdict.close();
}

/// Rough glass of any index loses what microfacets reflect or refract into each other, and nothing more.
#[test]
fn rough_glass_keeps_most_of_even_light() {
    let mut verdict = Verdict::on("rough glass under a background of 1");
    for (roughness, least) in [(0.0, 0.998), (0.2, 0.98), (0.5, 0.85), (1.0, 0.4)] {
        for thickness in [0.0, 1.0] {
            let glass = MetallicRoughness {
                metallic: 0.0,
                transmission: 1.0,
                roughness,
                thickness,
                ..MetallicRoughness::default()
            };
            let found = in_even_light(glass);
            let what = format!("roughness {roughness}, thickness {thickness}");
            verdict.that(what, found <= 1.002 && found >= least, || {
                format!("{found}")
            });
        }
    }
    verdict.close();
}
