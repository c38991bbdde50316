//! Surfaces with holes, against closed forms: what a ray gets that passes them.

use crate::reference::compare::{fetched, render, sized};
use crate::reference::scenes::{self, Build};
use crate::support::verdict::Verdict;
use glam::{DAffine3, DVec3, Vec2, Vec3, dvec3, vec3};
use glimray::render::{Fetch, RenderSettings};
use glimray::scene::{
    Background, Coverage, Light, LightKind, Material, Minify, Pattern, Phong, Picture, Scene,
    Space, Texels, Texture, Textures, Wrap,
};
use std::sync::Arc;

const BEHIND: Vec3 = vec3(0.2, 0.4, 0.6);

/// A camera at the origin that looks along -z at so many walls, one behind the other.
fn ahead(count: usize, material: Material) -> Scene {
    let mut scene = scenes::empty();
    scene.ambient = Vec3::ONE;
    scene.background = Background::Color(BEHIND);
    scene.cameras[0].look_from = DVec3::ZERO;
    scene.cameras[0].look_at = DVec3::NEG_Z;
    let material = scene.add_material(material);
    for k in 1..=count {
        scene.add_mesh(
            wall(material),
            DAffine3::from_translation(dvec3(0.0, 0.0, -(k as f64))),
        );
    }
    scene
}

/// A large quad in the plane z = 0 with u and v from 0 to 1.
fn wall(material: usize) -> glimray::scene::Mesh {
    let mut mesh = scenes::quad(400.0, material as u32);
    for p in &mut mesh.positions {
        *p = vec3(p.x, -p.z, 0.0);
    }
    mesh.normals = vec![Vec3::Z; 4];
    mesh.uvs = [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]]
        .map(Vec2::from)
        .into();
    mesh
}

fn sheer(alpha: f32, coverage: Coverage) -> Material {
    Material {
        alpha,
        coverage,
        bsdf: Phong {
            ambient: vec3(0.9, 0.5, 0.1),
            ..Phong::default()
        }
        .into(),
        ..Material::default()
    }
}

fn middle(scene: &Scene, settings: &RenderSettings) -> Vec3 {
    let (image, _) = render(scene, settings);
    Vec3::from_slice(&image.pixels[0])
}

#[test]
fn layers_are_composed_in_order_however_many_and_without_bounces() {
    let mut verdict = Verdict::on("layers");
    for count in [1, 2, 7, 20] {
        for (name, coverage, alpha, part) in [
            ("blend", Coverage::Blend, 0.3, 0.3),
            ("blend nothing", Coverage::Blend, 0.0, 0.0),
            ("mask below", Coverage::Mask(0.5), 0.49, 0.0),
            ("mask at", Coverage::Mask(0.7), 0.7, 1.0),
            ("mask of 0", Coverage::Mask(0.0), 0.0, 1.0),
            ("opaque", Coverage::Opaque, 0.2, 1.0),
        ] {
            let scene = ahead(count, sheer(alpha, coverage));
            for max_depth in [0, 5] {
                let settings = RenderSettings {
                    max_depth,
                    min_throughput: 0.0,
                    ..sized(1, 1)
                };
                let color = sheer(1.0, Coverage::Opaque).classical().ambient;
                let expected = (0..count).fold(BEHIND, |behind: Vec3, _| behind.lerp(color, part));
                let got = middle(&scene, &settings);
                let holds = (got - expected).abs().max_element() < 1e-5;
                verdict.that(
                    format!("{name}, {count} layers, depth {max_depth}"),
                    holds,
                    || format!("{got}, not {expected}"),
                );
            }
        }
    }
    verdict.close();
}

/// A picture of one opaque and one clear texel, side by side.
fn half(texels: [u8; 2]) -> (Arc<Picture>, Texture) {
    let picture = Picture {
        width: 2,
        height: 1,
        texels: Texels::Srgb8(texels.map(|alpha| [255, 255, 255, alpha]).into()),
        origin: glimray::scene::Origin::Texels,
    };
    let texture = Texture {
        pattern: Pattern::Picture {
            picture: 0,
            nearest: true,
            minify: Minify::default(),
            wrap: [Wrap::Clamp; 2],
        },
        space: Space::Uv,
        pattern_from_space: DAffine3::IDENTITY,
    };
    (Arc::new(picture), texture)
}

#[test]
fn the_alpha_of_a_picture_cuts_the_surface_and_its_shadow() {
    let (picture, texture) = half([255, 51]);
    for (coverage, right) in [(Coverage::Mask(0.5), 0.0), (Coverage::Blend, 0.2)] {
        // A floor at z = -2 below a sheet at z = -1, lit along -z.
        let mut scene = ahead(
            1,
            Material {
                coverage,
                textures: Textures {
                    alpha: Some(0),
                    ..Textures::default()
                },
                bsdf: Phong {
                    ambient: Vec3::ZERO,
                    diffuse: Vec3::ZERO,
                    ..Phong::default()
                }
                .into(),
                ..Material::default()
            },
        );
        scene.pictures.push(picture.clone());
        scene.textures.push(texture.clone());
        scene.ambient = Vec3::ZERO;
        scene.lights.push(Light {
            color: Vec3::ONE,
            kind: LightKind::Directional {
                direction: DVec3::NEG_Z,
            },
            ..Light::default()
        });
        let floor = scene.add_material(Material::from(Phong {
            diffuse: Vec3::ONE,
            ..Phong::default()
        }));
        scene.add_mesh(
            wall(floor),
            DAffine3::from_translation(dvec3(0.0, 0.0, -2.0)),
        );
        for fetch in [Fetch::Image, Fetch::Buffer, Fetch::Packet] {
            let (image, _) = render(&scene, &fetched(&sized(2, 1), fetch));
            let [left_pixel, right_pixel] = [0, 1].map(|i| Vec3::from_slice(&image.pixels[i]).x);
            // Light passes the sheet on its way down, and what the camera sees passes it again.
            let expected = (1.0 - right) * (1.0 - right);
            assert!(left_pixel.abs() < 1e-6, "{fetch:?}: {left_pixel}");
            let off = (right_pixel - expected).abs();
            assert!(
                off < 1e-5,
                "{coverage:?} {fetch:?}: {right_pixel}, not {expected}"
            );
        }
    }
}
