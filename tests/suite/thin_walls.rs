//! Thin walls, occlusion maps and second sets of texture coordinates in whole pictures.

use crate::reference::compare::{assert_none, check_same_bits, render, sized};
use crate::reference::scenes::{self, Build};
use glam::{DAffine3, DVec3, Vec2, Vec3, dvec3, vec3};
use glimray::render::RenderSettings;
use glimray::scene::{
    Background, Fresnel, Light, LightKind, Material, Mesh, Minify, Pattern, Phong, PhongTextures,
    Picture, Scene, Shadows, Space, Texels, Texture, Textures, Wrap,
};
use std::sync::Arc;

/// Looks from the origin along -z.
fn ahead() -> Scene {
    let mut scene = scenes::empty();
    scene.cameras[0].look_from = DVec3::ZERO;
    scene.cameras[0].look_at = DVec3::NEG_Z;
    scene
}

/// A square of this side that faces +z.
fn wall(side: f32, material: usize) -> Mesh {
    let mut mesh = scenes::quad(side, material as u32);
    for p in &mut mesh.positions {
        *p = vec3(p.x, -p.z, 0.0);
    }
    mesh.normals = vec![Vec3::Z; 4];
    mesh
}

fn pane(tint: Vec3) -> Material {
    Material {
        thin: true,
        bsdf: Phong {
            diffuse: Vec3::ZERO,
            ambient: Vec3::ZERO,
            transmit: tint,
            ior: 1.7,
            ..Phong::default()
        }
        .into(),
        ..Material::default()
    }
}

#[test]
fn light_goes_straight_through_any_number_of_thin_walls() {
    let tint = vec3(0.9, 0.8, 0.95);
    let mut scene = ahead();
    scene.background = Background::Color(Vec3::ONE);
    let material = scene.add_material(pane(tint));
    let tilted = DAffine3::from_rotation_y(0.9);
    for k in 0..9 {
        let place = DAffine3::from_translation(dvec3(0.0, 0.0, -1.0 - f64::from(k)));
        scene.add_mesh(wall(200.0, material), place * tilted);
    }
    for max_depth in [0, 1, 5] {
        let settings = RenderSettings {
            max_depth,
            min_throughput: 0.0,
            ..sized(16, 16)
        };
        let (image, stats) = render(&scene, &settings);
        // At depth 0 there is local shading only, and these walls have none.
        let expected = match max_depth {
            0 => Vec3::ZERO,
            _ => tint.powf(9.0),
        };
        for pixel in &image.pixels {
            let off = (Vec3::from_slice(pixel) - expected).abs().max_element();
            assert!(off < 1e-4, "{max_depth}: {pixel:?}, not {expected}");
        }
        assert_eq!(stats.cut_off_trees, 0);
    }
}

#[test]
fn a_thin_wall_in_a_medium_leaves_the_medium_as_it_is() {
    // A ball of coloured glass around the camera's view, with a pane across it or without.
    let build = |has_pane: bool| {
        let mut scene = ahead();
        scene.background = Background::Gradient {
            bottom: Vec3::X,
            top: Vec3::ONE,
        };
        let glass = scene.add_material(Material::from(Phong {
            diffuse: Vec3::ZERO,
            ambient: Vec3::ZERO,
            transmit: Vec3::ONE,
            ior: 1.5,
            absorption: vec3(0.1, 0.3, 0.0),
            fresnel: Fresnel::Exact,
            reflect: Vec3::ONE,
            ..Phong::default()
        }));
        scene.add_sphere(dvec3(0.0, 0.0, -4.0), 1.5, glass);
        if has_pane {
            let material = scene.add_material(pane(Vec3::ONE));
            scene.add_mesh(
                wall(9.0, material),
                DAffine3::from_translation(dvec3(0.0, 0.0, -4.1)),
            );
        }
        render(&scene, &sized(64, 64)).0
    };
    let [with, without] = [true, false].map(build);
    let far = (with.pixels.iter().zip(&without.pixels))
        .filter(|(a, b)| (0..3).any(|i| (a[i] - b[i]).abs() > 1e-3))
        .count();
    assert!(far < 8, "{far} of 4096 pixels differ");
}

#[test]
fn shadow_rays_pass_thin_walls_with_their_tint() {
    let tint = vec3(0.5, 0.25, 1.0);
    let build = |pane_count: i32| {
        let mut scene = ahead();
        scene.shadows = Shadows::Filtered;
        scene.lights.push(Light {
            color: Vec3::ONE,
            kind: LightKind::Directional {
                direction: dvec3(0.0, -1.0, -0.2).normalize(),
            },
            ..Light::default()
        });
        let white = scene.add_material(Material::from(Phong {
            ambient: Vec3::ZERO,
            ..Phong::default()
        }));
        scene.add_mesh(
            wall(400.0, white),
            DAffine3::from_translation(dvec3(0.0, 0.0, -5.0)),
        );
        let material = scene.add_material(pane(tint));
        for k in 0..pane_count {
            // Above the view.
            let place = DAffine3::from_translation(dvec3(0.0, 10.0 + f64::from(k), 0.0));
            scene.add_mesh(scenes::quad(800.0, material as u32), place);
        }
        render(&scene, &sized(8, 8)).0
    };
    let open = build(0);
    for count in [1, 6] {
        for (pixel, open) in build(count).pixels.iter().zip(&open.pixels) {
            let expected = Vec3::from_slice(open) * tint.powf(count as f32);
            assert!(open[0] > 0.05);
            let off = (Vec3::from_slice(pixel) - expected).abs().max_element();
            assert!(off < 1e-4, "{count} panes: {pixel:?}, not {expected}");
        }
    }
}

fn picture(code: [u8; 4]) -> Arc<Picture> {
    Arc::new(Picture {
        width: 1,
        height: 1,
        texels: Texels::Linear8(vec![code]),
        origin: glimray::scene::Origin::Texels,
    })
}

fn texture(picture: usize, space: Space) -> Texture {
    Texture {
        pattern: Pattern::Picture {
            picture,
            nearest: true,
            minify: Minify::Nearest,
            wrap: [Wrap::Repeat; 2],
        },
        space,
        pattern_from_space: DAffine3::IDENTITY,
    }
}

#[test]
fn occlusion_maps_dim_ambient_light_and_nothing_else() {
    let build = |occlusion: Option<f32>| {
        let mut scene = ahead();
        scene.ambient = Vec3::splat(0.5);
        scene.lights.push(Light {
            color: Vec3::ONE,
            kind: LightKind::Directional {
                direction: dvec3(0.1, -0.2, -1.0).normalize(),
            },
            ..Light::default()
        });
        // Only red counts.
        scene.pictures.push(picture([51, 255, 0, 255]));
        scene.textures.push(texture(0, Space::Uv));
        let material = scene.add_material(Material {
            emission: vec3(0.01, 0.02, 0.03),
            occlusion_strength: occlusion.unwrap_or(1.0),
            textures: Textures {
                occlusion: occlusion.map(|_| 0),
                ..Textures::default()
            },
            bsdf: Phong {
                ambient: vec3(0.6, 0.4, 0.8),
                ..Phong::default()
            }
            .into(),
            ..Material::default()
        });
        scene.add_mesh(
            wall(90.0, material),
            DAffine3::from_translation(DVec3::NEG_Z),
        );
        render(&scene, &sized(4, 4)).0
    };
    let open = build(None);
    for strength in [1.0, 0.25, 0.0] {
        let lost = 0.5 * vec3(0.6, 0.4, 0.8) * strength * (1.0 - 0.2);
        for (pixel, open) in build(Some(strength)).pixels.iter().zip(&open.pixels) {
            let expected = Vec3::from_slice(open) - lost;
            let off = (Vec3::from_slice(pixel) - expected).abs().max_element();
            assert!(off < 1e-5, "{strength}: {pixel:?}, not {expected}");
        }
    }
}

#[test]
fn a_texture_uses_the_set_of_texture_coordinates_that_it_names() {
    let checker = Picture::opaque(
        8,
        8,
        (0..64).map(|i| vec3(f32::from((i + i / 8) % 2 == 0), i as f32 / 64.0, 0.3)),
    );
    // The first or the second set has the coordinates; the other is not used.
    let build = |is_second: bool| {
        let mut scene = ahead();
        scene.lights.push(Light {
            color: Vec3::ONE,
            kind: LightKind::Directional {
                direction: dvec3(-0.4, -0.2, -1.0).normalize(),
            },
            ..Light::default()
        });
        scene.ambient = Vec3::splat(0.3);
        scene.pictures.push(checker.clone().into());
        scene.pictures.push(picture([190, 90, 220, 255]));
        let space = match is_second {
            true => Space::SecondUv,
            false => Space::Uv,
        };
        for index in 0..2 {
            scene.textures.push(Texture {
                pattern: Pattern::Picture {
                    picture: index,
                    nearest: false,
                    minify: Minify::LinearMipmapLinear,
                    wrap: [Wrap::Repeat; 2],
                },
                ..texture(0, space)
            });
        }
        let material = scene.add_material(Material {
            textures: Textures {
                normal: Some(1),
                occlusion: Some(0),
                alpha: Some(0),
                ..Textures::default()
            },
            bsdf: Phong {
                textures: PhongTextures {
                    diffuse: Some(0),
                    ambient: Some(0),
                    ..PhongTextures::default()
                },
                ..Phong::default()
            }
            .into(),
            ..Material::default()
        });
        let mut mesh = wall(3.0, material);
        let used = (mesh.positions.iter()).map(|p| Vec2::new(p.x + 2.0 * p.y, 1.7 * p.y));
        let (used, other) = (used.collect(), vec![Vec2::ZERO; 4]);
        (mesh.uvs, mesh.second_uvs) = match is_second {
            true => (other, used),
            false => (used, other),
        };
        let away = DAffine3::from_translation(dvec3(0.0, 0.0, -3.0));
        scene.add_mesh(mesh, away * DAffine3::from_rotation_x(-0.8));
        render(&scene, &sized(64, 64)).0
    };
    let [first, second] = [false, true].map(build);
    assert_none([check_same_bits("second set", &first, &second)]);
    let shown = first.pixels.iter().filter(|pixel| pixel[0] > 0.2).count();
    assert!(shown > 100, "{shown}");
}
