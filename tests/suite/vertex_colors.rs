//! Colours of vertices: interpolated over triangles, and the same as a material of that colour.

use crate::motion_blur;
use crate::reference::compare::{check_alike, fetched, render, sized};
use crate::reference::scenes::{self, Build};
use crate::support::verdict::Verdict;
use glam::{DAffine3, DVec3, UVec2, Vec2, Vec3, Vec4, dvec3, vec3, vec4};
use glimray::image::Image;
use glimray::pack;
use glimray::render::{Fetch, Integrator, RenderSettings};
use glimray::scene::{
    Antialias, Background, Bsdf, Coverage, Deformation, Fresnel, Light, LightKind, Material, Mesh,
    MetallicRoughness, MorphTarget, Phong, Scene, Target, Values,
};
use std::sync::Arc;

const SIDE: u32 = 32;

/// The surface behind those with holes.
const BEHIND: Vec3 = vec3(0.1, 0.2, 0.3);

/// A square that fills the picture, whose material is `material`, with the colour `at` its u and v.
fn square(material: Material, at: impl Fn(f32, f32) -> Vec4) -> Scene {
    let mut scene = scenes::empty();
    scene.ambient = Vec3::ONE;
    scene.background = Background::Color(BEHIND);
    scene.cameras[0].look_from = DVec3::ZERO;
    scene.cameras[0].look_at = DVec3::NEG_Z;
    scene.cameras[0].fov_y = 2.0 * 0.5_f64.atan();
    let material = scene.add_material(material);
    let mut mesh = scenes::quad(1.0, material as u32);
    for p in &mut mesh.positions {
        *p = vec3(p.x, -p.z, -1.0);
        mesh.colors.push(at(p.x + 0.5, p.y + 0.5));
    }
    mesh.normals = vec![Vec3::Z; 4];
    scene.add_mesh(mesh, DAffine3::IDENTITY);
    scene
}

/// Settings without random places in pixels.
fn still(integrator: Integrator, samples: u32) -> RenderSettings {
    RenderSettings {
        integrator,
        samples,
        antialias: Antialias::None,
        max_depth: 8,
        min_throughput: 0.0,
        ..sized(SIDE, SIDE)
    }
}

fn both() -> [Integrator; 2] {
    [Integrator::Whitted, Integrator::Path]
}

/// u and v at the centre of a pixel.
fn place(index: usize) -> (f32, f32) {
    let (x, y) = (index as u32 % SIDE, index as u32 / SIDE);
    let center = |i: u32| (i as f32 + 0.5) / SIDE as f32;
    (center(x), 1.0 - center(y))
}

/// The largest difference from `expected` at u and v.
fn worst(image: &Image, expected: impl Fn(f32, f32) -> Vec3) -> f32 {
    let of = |(index, pixel): (usize, &[f32; 4])| {
        let (u, v) = place(index);
        (Vec3::from_slice(pixel) - expected(u, v))
            .abs()
            .max_element()
    };
    image.pixels.iter().enumerate().map(of).fold(0.0, f32::max)
}

fn physical(model: MetallicRoughness) -> Material {
    model.into()
}

fn unlit() -> MetallicRoughness {
    MetallicRoughness {
        unlit: true,
        ..MetallicRoughness::default()
    }
}

#[test]
fn unlit_colours_are_linear_over_a_triangle_and_may_exceed_1() {
    let mut verdict = Verdict::on("unlit squares");
    let color = |u: f32, v: f32| vec4(u, 7.0 * v, 0.2, 1.0);
    // A Phong material that shows nothing but its emission is unlit too.
    let glowing = Material {
        emission: Vec3::ONE,
        bsdf: Phong {
            diffuse: Vec3::ZERO,
            ambient: Vec3::ZERO,
            ..Phong::default()
        }
        .into(),
        ..Material::default()
    };
    for (name, material) in [("unlit", physical(unlit())), ("glowing", glowing)] {
        let scene = square(material, color);
        for integrator in both() {
            for fetch in [Fetch::Image, Fetch::Buffer] {
                let (image, _) = render(&scene, &fetched(&still(integrator, 1), fetch));
                let off = worst(&image, |u, v| color(u, v).truncate());
                let what = format!("{name}, {integrator:?}, {fetch:?}");
                verdict.that(what, off < 1e-4, || off);
            }
        }
    }
    verdict.close();
}

/// glTF 2.0, 3.9.4: the alpha of the colour multiplies that of the base colour.
#[test]
fn alpha_of_vertices_counts_as_the_mode_says() {
    let mut verdict = Verdict::on("squares with alpha");
    for (name, coverage, part) in [
        ("opaque", Coverage::Opaque, [1.0, 1.0]),
        ("mask", Coverage::Mask(0.3), [0.0, 1.0]),
        ("blend", Coverage::Blend, [0.25 * 0.5, 0.75 * 0.5]),
    ] {
        let material = Material {
            coverage,
            alpha: 0.5,
            ..physical(unlit())
        };
        // Even in each half, which meet within a pixel.
        let mut scene = square(material, |_, _| Vec4::ONE);
        let mesh = Arc::make_mut(&mut scene.meshes[0]);
        let [left, right] = [0.25, 0.75].map(|alpha| vec4(1.0, 1.0, 1.0, alpha));
        mesh.positions = [-0.5, 0.0, 0.0, 0.5]
            .iter()
            .flat_map(|&x| [-0.5, 0.5].map(|y| vec3(x, y, -1.0)))
            .collect();
        mesh.colors = [[left; 4], [right; 4]].concat();
        mesh.normals = vec![Vec3::Z; 8];
        mesh.materials = vec![1; 8];
        mesh.triangles = vec![[0, 2, 3], [0, 3, 1], [4, 6, 7], [4, 7, 5]];
        for (integrator, samples, tolerance) in [
            (Integrator::Whitted, 1, 1e-5),
            (Integrator::Path, 256, 0.02),
        ] {
            let (image, _) = render(&scene, &still(integrator, samples));
            for (half, part) in part.iter().enumerate() {
                let pixels = image.pixels.iter().enumerate();
                let own = pixels.filter(|(index, _)| (place(*index).0 > 0.5) == (half == 1));
                let sum: Vec3 = own.map(|(_, pixel)| Vec3::from_slice(pixel)).sum();
                let found = sum / (SIDE * SIDE / 2) as f32;
                let off = (found - BEHIND.lerp(Vec3::ONE, *part)).abs().max_element();
                let what = format!("{name}, {integrator:?}, half {half}");
                verdict.that(what, off < tolerance, || found);
            }
        }
    }
    verdict.close();
}

/// Light passes the sheet on its way to the wall, and what the camera sees passes it again.
#[test]
fn shadows_have_the_alpha_of_vertices() {
    let sheet = Material {
        coverage: Coverage::Blend,
        bsdf: Phong {
            ambient: Vec3::ZERO,
            diffuse: Vec3::ZERO,
            ..Phong::default()
        }
        .into(),
        ..Material::default()
    };
    let mut scene = square(sheet, |u, _| vec4(1.0, 1.0, 1.0, u));
    scene.ambient = Vec3::ZERO;
    scene.lights.push(Light {
        color: Vec3::ONE,
        kind: LightKind::Directional {
            direction: DVec3::NEG_Z,
        },
        ..Light::default()
    });
    let wall = scene.add_material(Material::from(Phong {
        diffuse: Vec3::ONE,
        ..Phong::default()
    }));
    scene.add_plane(dvec3(0.0, 0.0, -1.0 - 1e-4), DVec3::Z, wall);
    let (image, _) = render(&scene, &still(Integrator::Whitted, 1));
    let off = worst(&image, |u, _| Vec3::splat((1.0 - u) * (1.0 - u)));
    assert!(off < 1e-3, "{off}");
}

/// Gives a material the colour of vertices.
fn paint(material: &mut Material, color: Vec3) {
    let parts = material.colored_parts();
    match &mut material.bsdf {
        Bsdf::MetallicRoughness(_) => material.tint = color,
        Bsdf::Phong(phong) => {
            phong.diffuse *= color;
            phong.ambient *= color;
            if parts.emission {
                material.emission *= color;
            }
        }
    }
}

/// A ball and a floor of these materials under a lamp, before a wall.
fn corner(materials: [&Material; 2], color: Option<Vec3>) -> Scene {
    let mut scene = scenes::empty();
    scene.ambient = Vec3::splat(0.2);
    scene.background = Background::Color(vec3(0.5, 0.6, 0.9));
    let balls = scenes::ball(UVec2::new(12, 8), 0);
    for (mut mesh, material, at) in [
        (balls, materials[0], dvec3(0.0, 1.0, 0.0)),
        (scenes::quad(6.0, 0), materials[1], DVec3::ZERO),
    ] {
        let mut material = material.clone();
        match color {
            Some(color) => paint(&mut material, color),
            None => mesh.colors = vec![COLOR.extend(1.0); mesh.positions.len()],
        }
        let index = scene.add_material(material);
        mesh.materials.fill(index as u32);
        scene.add_mesh(mesh, DAffine3::from_translation(at));
    }
    let wall = scene.add_material(scenes::shiny(vec3(0.9, 0.4, 0.4)));
    scene.add_plane(dvec3(0.0, 0.0, -4.0), DVec3::Z, wall);
    scene.add_point_light(dvec3(2.0, 4.0, 4.0), 1.5);
    scene
}

const COLOR: Vec3 = vec3(0.9, 0.25, 0.5);

#[test]
fn an_even_colour_of_vertices_is_that_of_the_material() {
    let model = |metallic, roughness, transmission, thickness| {
        physical(MetallicRoughness {
            metallic,
            roughness,
            transmission,
            thickness,
            ..MetallicRoughness::default()
        })
    };
    let mirror = Material {
        bsdf: Phong {
            reflect: Vec3::splat(0.5),
            fresnel: Fresnel::Schlick,
            ..scenes::shiny(vec3(0.6, 0.7, 0.8)).classical().into_owned()
        }
        .into(),
        ..scenes::shiny(vec3(0.6, 0.7, 0.8))
    };
    let matte = scenes::shiny(vec3(0.8, 0.8, 0.6));
    let mut results = Vec::new();
    for (name, ball, floor) in [
        ("Phong", mirror, matte.clone()),
        (
            "metal",
            model(1.0, 0.3, 0.0, 0.0),
            model(1.0, 0.0, 0.0, 0.0),
        ),
        (
            "plastic",
            model(0.0, 0.2, 0.0, 0.0),
            model(0.0, 0.6, 0.0, 0.0),
        ),
        ("glass", model(0.0, 0.0, 1.0, 1.0), matte.clone()),
        ("window", model(0.0, 0.0, 1.0, 0.0), matte),
        ("unlit", physical(unlit()), model(0.0, 0.5, 0.0, 0.0)),
    ] {
        for integrator in both() {
            let settings = RenderSettings {
                transparent_shadows: true,
                ..still(integrator, 16)
            };
            let [painted, colored] = [Some(COLOR), None].map(|color| {
                let scene = corner([&ball, &floor], color);
                render(&scene, &settings).0
            });
            let name = format!("{name}, {integrator:?}");
            results.push(check_alike(&name, &painted, &colored, 1.0, 0.01));
        }
    }
    crate::reference::compare::assert_none(results);
}

/// Rows of other attributes of vertices, and of later keys, lie around those of colours.
#[test]
fn colours_keep_to_their_vertices_beside_other_attributes_and_while_the_mesh_deforms() {
    let mut verdict = Verdict::on("squares with other attributes");
    let color = |u: f32, v: f32| vec4(u, v, 0.5, 1.0);
    let plain = square(physical(unlit()), color);
    for (uvs, tangents, deforms) in [
        (true, false, false),
        (true, true, false),
        (false, false, true),
        (true, true, true),
    ] {
        let mut scene = plain.clone();
        // Another mesh, without colours, comes first.
        let other = scenes::quad(0.1, 0);
        scene.meshes.insert(0, Arc::new(other));
        scene.instances[0].mesh = 1;
        scene.instances.push(scene.instances[0].clone());
        scene.instances[1].mesh = 0;
        scene.instances[1].placement = DAffine3::from_translation(dvec3(0.0, 0.0, 5.0));
        let mesh = Arc::make_mut(&mut scene.meshes[1]);
        if uvs {
            mesh.uvs = vec![Vec2::splat(0.3); 4];
        }
        if tangents {
            mesh.tangents = vec![vec4(1.0, 0.0, 0.0, 1.0); 4];
        }
        if deforms {
            scene.deformations.push(Deformation {
                mesh: 1,
                weights: vec![0.0],
                targets: Arc::new([MorphTarget {
                    vertices: vec![0, 1, 2, 3],
                    positions: vec![vec3(0.0, 0.0, -1e-3); 4],
                    normals: Vec::new(),
                    tangents: Vec::new(),
                }]),
                skin: None,
                flat: Arc::default(),
            });
            let values = Values::Scalar(vec![0.0, 1.0]);
            scene
                .tracks
                .push(motion_blur::track(Target::Weight(0, 0), values));
        }
        let image = motion_blur::exposed(&scene, &still(Integrator::Whitted, 4));
        let off = worst(&image, |u, v| color(u, v).truncate());
        let what = format!("u and v {uvs}, tangents {tangents}, deforms {deforms}");
        verdict.that(what, off < 2e-3, || off);
    }
    verdict.close();
}

/// Scenes without colours have neither rows nor code for them.
#[test]
fn meshes_without_colours_take_no_memory_for_them() {
    let mut scene = square(physical(unlit()), |_, _| Vec4::ONE);
    assert_eq!(pack::scene(&scene).expect("a scene").colors.len(), 4);
    let mesh: &mut Mesh = Arc::make_mut(&mut scene.meshes[0]);
    mesh.colors = Vec::new();
    assert_eq!(pack::scene(&scene).expect("a scene").colors.len(), 0);
}
