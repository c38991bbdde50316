//! Metallic-roughness materials in path-traced pictures: what they reflect of even light.

use super::layers::square;
use super::{ball_in, looking, mean, paths};
use crate::reference::scenes::Build;
use crate::support::verdict::Verdict;
use glam::{DAffine3, DVec3, Vec3, dvec3};
use glimray::scene::{Background, Instance, Material, MetallicRoughness, Picture, Scene};
use std::sync::Arc;

/// A material as the importers make it.
pub fn material(model: MetallicRoughness) -> Material {
    model.into()
}

/// The mean of a ball of the material in a background of 1.
fn in_even_light(model: MetallicRoughness) -> f64 {
    mean(&ball_in(1.0, material(model)), &paths(256, (12, 12), 16))
}

/// Checks that a material does not show: it neither loses nor adds light.
fn invisible(verdict: &mut Verdict, name: impl std::fmt::Display, found: f64, room: f64) {
    verdict.that(name, found > 1.0 - room && found < 1.002, || found);
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
        let mixed = |metallic| MetallicRoughness {
            metallic,
            ..metal.clone()
        };
        let (quarter, half) = (mixed(0.25), mixed(0.5));
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
            ("a quarter of metal", quarter),
            ("half of metal", half),
            ("plastic", plastic),
            ("coated plastic", coated),
            ("cloth", cloth),
            ("plastic of index 2", through),
        ] {
            let found = in_even_light(model);
            let room = if name == "metal" { 0.002 } else { 0.005 };
            let what = format!("{name}, roughness {roughness}");
            invisible(&mut verdict, what, found, room);
        }
    }
    verdict.close();
}

/// Brushed white metal reflects all light too, seen along its direction and across it.
#[test]
fn brushed_white_metal_is_invisible_in_even_light() {
    let mut verdict = Verdict::on("brushed white metal under a background of 1");
    for (roughness, strength) in [(0.1, 1.0), (0.1, 0.6), (0.3, 1.0), (0.6, 0.8)] {
        let model = MetallicRoughness {
            roughness,
            anisotropy: strength,
            ..MetallicRoughness::default()
        };
        for from in [
            dvec3(0.0, 3.0, 0.01),
            dvec3(3.0, 2.0, 0.0),
            dvec3(0.0, 1.0, 3.0),
            dvec3(2.0, 1.0, 2.0),
        ] {
            let mut scene = Scene {
                materials: vec![material(model.clone())],
                background: Background::Color(Vec3::ONE),
                meshes: vec![Arc::new(square())],
                instances: vec![Instance {
                    mesh: 0,
                    placement: DAffine3::IDENTITY,
                    node: None,
                    name: String::new(),
                }],
                cameras: vec![looking(from, DVec3::ZERO, 1e-3)],
                ..Scene::default()
            };
            scene.complete_tangents();
            let found = mean(&scene, &paths(1024, (8, 8), 16));
            let what = format!("roughness {roughness}, anisotropy {strength}, from {from}");
            verdict.that(what, found > 0.995 && found < 1.002, || found);
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

fn glass(roughness: f32, thickness: f32, ior: f32) -> Material {
    material(MetallicRoughness {
        metallic: 0.0,
        transmission: 1.0,
        roughness,
        thickness,
        ior,
        ..MetallicRoughness::default()
    })
}

/// A plane under a background of 1, seen from above (`side` 1) or below (-1) at this cosine to its normal.
fn boundary(material: Material, side: f64, cos: f64) -> Scene {
    let mut scene = ball_in(1.0, material);
    scene.shapes.clear();
    scene.add_plane(DVec3::ZERO, DVec3::Y, 0);
    let from = dvec3((1.0 - cos * cos).sqrt(), side * cos, 0.0);
    scene.cameras = vec![looking(3.0 * from, DVec3::ZERO, 0.01)];
    scene
}

/// A boundary of rough glass keeps all light, also what its microfacets reflect or refract into each other, seen from
/// both sides and from all angles. Light meets it once.
#[test]
fn rough_glass_is_invisible_in_even_light() {
    let mut verdict = Verdict::on("boundaries of rough glass under a background of 1");
    for ior in [1.1, 1.5, 2.5] {
        for roughness in [0.0, 0.2, 0.5, 1.0] {
            for thickness in [0.0, 1.0] {
                for (side, cos) in [
                    (1.0, 0.95_f64),
                    (1.0, 0.4),
                    (-1.0, 0.9),
                    (-1.0, 0.6),
                    (-1.0, 0.25),
                ] {
                    let scene = boundary(glass(roughness, thickness, ior), side, cos);
                    let found = mean(&scene, &paths(32_768, (4, 4), 8));
                    let what = format!(
                        "roughness {roughness}, thickness {thickness}, index {ior}, side {side}, cos {cos}"
                    );
                    invisible(&mut verdict, what, found, 0.003);
                }
            }
        }
    }
    verdict.close();
}

/// Where a material transmits a part of the light and scatters the rest, or has metal beside it, little is lost or added
/// either. What reflects everything transmits nothing. In smooth balls the light that is scattered inside would be reflected
/// totally for ever.
#[test]
fn partly_transmissive_white_is_invisible_in_even_light() {
    let mut verdict = Verdict::on("partly transmissive balls under a background of 1");
    let rows = [
        // Transmission, metallic, index of refraction, thickness, roughness.
        (0.5, 0.0, 1.5, 0.0, &[0.2, 0.5, 0.8, 1.0][..]),
        (0.2, 0.0, 1.5, 0.0, &[0.2, 0.5, 0.8, 1.0]),
        (0.5, 0.0, 2.5, 0.0, &[0.5, 1.0]),
        (0.5, 0.5, 1.5, 0.0, &[0.2, 0.5, 1.0]),
        (0.5, 0.0, 1.5, 1.0, &[0.3, 0.6]),
        (0.8, 0.2, 1.5, 1.0, &[0.3, 0.6]),
        (0.5, 0.0, 0.0, 1.0, &[0.0, 0.5, 1.0]),
        // As glTF's index of 0 is read.
        (0.5, 0.0, 1e6, 1.0, &[0.0, 0.5, 1.0]),
        (0.5, 0.5, 0.0, 0.0, &[0.0, 0.5, 1.0]),
    ];
    for (transmission, metallic, ior, thickness, all) in rows {
        for &roughness in all {
            let white = material(MetallicRoughness {
                metallic,
                transmission,
                roughness,
                thickness,
                ior,
                ..MetallicRoughness::default()
            });
            let found = mean(&ball_in(1.0, white), &paths(512, (12, 12), 500));
            let what = format!(
                "transmission {transmission}, metallic {metallic}, index {ior}, roughness {roughness}, \
                 thickness {thickness}"
            );
            verdict.that(what, found > 0.996 && found < 1.002, || found);
        }
    }
    verdict.close();
}

/// The boundary of such a volume, which light meets once. In a ball it would meet it dozens of times, and few paths would
/// have most of the light.
#[test]
fn partly_transmissive_boundaries_are_invisible_in_even_light() {
    let mut verdict = Verdict::on("partly transmissive boundaries under a background of 1");
    for transmission in [0.2, 0.5] {
        for (side, cos) in [(1.0, 0.95_f64), (1.0, 0.4), (-1.0, 0.9), (-1.0, 0.4)] {
            let white = material(MetallicRoughness {
                metallic: 0.0,
                transmission,
                roughness: 1.0,
                thickness: 1.0,
                ior: 1.5,
                ..MetallicRoughness::default()
            });
            let scene = boundary(white, side, cos);
            let found = mean(&scene, &paths(32_768, (4, 4), 8));
            let what = format!("transmission {transmission}, side {side}, cos {cos}");
            verdict.that(what, found > 0.995 && found < 1.002, || found);
        }
    }
    verdict.close();
}

/// Rough glass with light that bounces inside, where errors would add up. Light samples know the white picture's
/// directions, and boundaries must scatter towards them as much as paths that go there by themselves. These sums have more
/// samples and room: near total reflection lobes are narrow, and light samples rarely meet them.
#[test]
fn balls_of_rough_glass_are_invisible_in_even_light() {
    let mut verdict = Verdict::on("balls of rough glass under a background of 1");
    for (ior, roughness) in [1.5, 2.5]
        .iter()
        .flat_map(|ior| [0.05, 0.3, 1.0].map(|r| (*ior, r)))
    {
        for thickness in [0.0, 1.0] {
            let mut scene = ball_in(1.0, glass(roughness, thickness, ior));
            let what = format!("roughness {roughness}, thickness {thickness}, index {ior}");
            let found = mean(&scene, &paths(768, (12, 12), 500));
            invisible(&mut verdict, &what, found, 0.002);
            let white = Picture::opaque(8, 4, [Vec3::ONE; 32]);
            scene.pictures = vec![white.into()];
            scene.background = Background::Picture {
                picture: 0,
                strength: 1.0,
                rotation: 0.0,
            };
            let found = mean(&scene, &paths(3072, (12, 12), 500));
            invisible(
                &mut verdict,
                format!("{what}, with light samples"),
                found,
                0.003,
            );
        }
    }
    verdict.close();
}
