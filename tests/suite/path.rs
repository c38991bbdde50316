//! The path tracer against closed forms and against the classical integrator.

mod backdrop;
mod densities;
mod emission_maps;
mod emissive_solids;
mod emitter_sides;
pub mod emitter_tree;
mod emitters;
mod explained;
mod full_maps;
mod layers;
mod light_chances;
pub mod lobes;
mod many_lights;
mod materials;
mod references;

use crate::reference::compare::{render, sized};
use crate::reference::scenes::Build;
use crate::support::verdict::Verdict;
use glam::{DAffine3, DQuat, DVec3, Vec3, dvec3, vec3};
use glimray::render::{Integrator, RenderSettings};
use glimray::scene::{
    Antialias, Attenuation, Background, Camera, Fresnel, Instance, Light, LightKind, Material,
    Mesh, Phong, Scene,
};
use std::f64::consts::PI;
use std::sync::Arc;

fn paths(samples: u32, size: (u32, u32), max_depth: u32) -> RenderSettings {
    RenderSettings {
        integrator: Integrator::Path,
        samples,
        antialias: Antialias::Stratified,
        max_depth,
        ..sized(size.0, size.1)
    }
}

/// A matte material of this albedo.
fn matte(albedo: f32) -> Material {
    Material::from(Phong {
        diffuse: Vec3::splat(albedo),
        ..Phong::default()
    })
}

/// Glass that bends and reflects nothing: light samples are stopped by it, so that paths find by themselves what is behind it.
fn clear() -> Material {
    Material {
        bsdf: Phong {
            reflect: Vec3::ONE,
            transmit: Vec3::ONE,
            fresnel: Fresnel::Exact,
            opacity: 0.0,
            ior: 1.0,
            ..matte(0.0).classical().into_owned()
        }
        .into(),
        ..matte(0.0)
    }
}

fn looking(from: DVec3, at: DVec3, fov_y: f64) -> Camera {
    Camera {
        look_from: from,
        look_at: at,
        fov_y,
        ..Camera::default()
    }
}

/// A ball of radius 1 around the origin that fills the picture.
fn ball_in(background: f32, material: Material) -> Scene {
    let mut scene = Scene {
        cameras: vec![looking(5.0 * DVec3::Z, DVec3::ZERO, 0.2)],
        materials: vec![material],
        background: Background::Color(Vec3::splat(background)),
        ..Scene::default()
    };
    scene.add_sphere(DVec3::ZERO, 1.0, 0);
    scene
}

/// Checks that a mean is within `tolerance` of what it should be.
fn near(
    verdict: &mut Verdict,
    name: impl std::fmt::Display,
    found: f64,
    expected: f64,
    tolerance: f64,
) {
    verdict.that(name, (found - expected).abs() <= tolerance, || {
        format!("{found}, expected {expected}")
    });
}

/// The mean of the green channel.
fn mean(scene: &Scene, settings: &RenderSettings) -> f64 {
    let (image, stats) = render(scene, settings);
    assert_eq!(stats.nonfinite_samples, 0);
    let sum: f64 = image.pixels.iter().map(|pixel| f64::from(pixel[1])).sum();
    sum / image.pixels.len() as f64
}

#[test]
fn a_convex_ball_in_even_light_shows_its_albedo() {
    let mut verdict = Verdict::on("balls under a background of 1");
    for albedo in [0.0, 0.18, 0.5, 1.0] {
        let found = mean(&ball_in(1.0, matte(albedo)), &paths(16, (16, 16), 16));
        near(
            &mut verdict,
            format!("albedo {albedo}"),
            found,
            f64::from(albedo),
            1e-4,
        );
    }
    verdict.close();
}

/// Inside of a closed room whose walls emit e and reflect a of the light, the radiance is e/(1 − a) everywhere.
#[test]
fn a_closed_room_of_even_light_sums_all_bounces() {
    let mut verdict = Verdict::on("the inside of a glowing ball");
    for albedo in [0.2, 0.5, 0.8] {
        let mut scene = ball_in(0.0, matte(albedo));
        scene.materials[0].emission = Vec3::splat(0.5);
        scene.cameras = vec![looking(DVec3::ZERO, DVec3::Z, 1.0)];
        let expected = 0.5 / (1.0 - f64::from(albedo));
        let found = mean(&scene, &paths(256, (16, 16), 200));
        near(
            &mut verdict,
            format!("albedo {albedo}"),
            found,
            expected,
            0.003 * expected,
        );
        // Each bounce adds a term of the series.
        for bounces in [0, 1, 4] {
            let terms = (0..=bounces + 1).map(|k| f64::from(albedo).powi(k));
            let expected = 0.5 * terms.sum::<f64>();
            let found = mean(&scene, &paths(256, (16, 16), bounces as u32));
            near(
                &mut verdict,
                format!("albedo {albedo}, {bounces} bounces"),
                found,
                expected,
                0.004 * expected,
            );
            // The rest of the series is the reported share.
            let (_, stats) = render(&scene, &paths(256, (16, 16), bounces as u32));
            let cut = f64::from(albedo).powi(bounces + 2);
            let what = format!("albedo {albedo}, share cut after {bounces} bounces");
            near(
                &mut verdict,
                what,
                stats.energy_cut(),
                cut,
                0.01 * cut + 1e-5,
            );
        }
    }
    verdict.close();
}

#[test]
fn clamping_cuts_each_bounce_of_indirect_light_to_the_limit() {
    let mut verdict = Verdict::on("the inside of a glowing room");
    let (albedo, limit) = (0.8, 0.1);
    let mut scene = ball_in(0.0, matte(albedo));
    scene.materials[0].emission = Vec3::splat(0.5);
    scene.cameras = vec![looking(DVec3::ZERO, DVec3::Z, 1.0)];
    // Planes are no lights for light samples, so a path finds all light by itself.
    scene.shapes.clear();
    for normal in DVec3::AXES.into_iter().flat_map(|axis| [axis, -axis]) {
        scene.add_plane(-normal, normal, 0);
    }
    let settings = RenderSettings {
        clamp_indirect: Some(limit),
        ..paths(256, (16, 16), 2)
    };
    // Light that a sample finds at its four surfaces: the last two are indirect.
    let found = (0..4).map(|k| 0.5 * f64::from(albedo).powi(k));
    let limits = [f64::INFINITY, f64::INFINITY, limit.into(), limit.into()];
    let kept: f64 = found.clone().zip(limits).map(|(x, most)| x.min(most)).sum();
    let (_, stats) = render(&scene, &settings);
    let mean = mean(&scene, &settings);
    near(&mut verdict, "radiance", mean, kept, 1e-3);
    let cut = 1.0 - (1.0 - f64::from(albedo).powi(4)) * kept / found.sum::<f64>();
    let what = "share cut";
    near(&mut verdict, what, stats.energy_cut(), cut, 1e-3);
    verdict.close();
}

/// A floor under one light, which is outside of the picture.
fn lit_floor(material: Material, light: Light) -> Scene {
    let mut scene = Scene {
        cameras: vec![looking(dvec3(0.1, 2.5, 1.0), dvec3(0.3, 0.0, -0.2), 0.3)],
        materials: vec![material],
        background: Background::Color(Vec3::ZERO),
        lights: vec![light],
        ..Scene::default()
    };
    scene.add_plane(DVec3::ZERO, DVec3::Y, 0);
    scene
}

fn lights() -> Vec<(&'static str, LightKind)> {
    let position = dvec3(0.4, 1.2, -0.5);
    vec![
        ("point", LightKind::Point { position }),
        (
            "directional",
            LightKind::Directional {
                direction: dvec3(0.3, -1.0, 0.2).normalize(),
            },
        ),
        (
            "spot",
            LightKind::Spot {
                position,
                direction: -DVec3::Y,
                inner: 0.3,
                outer: 0.9,
            },
        ),
        (
            "rectangle",
            LightKind::Rectangle {
                center: position,
                edge_u: 0.4 * DVec3::X,
                edge_v: 0.3 * DVec3::Z,
            },
        ),
        (
            "disc",
            LightKind::Disc {
                center: position,
                normal: -DVec3::Y,
                radius: 0.4,
            },
        ),
        (
            "sphere",
            LightKind::Sphere {
                center: position,
                radius: 0.4,
            },
        ),
    ]
}

/// The strength of a light means the same to both integrators: matte surfaces without a second bounce look alike.
#[test]
fn matte_surfaces_look_alike_in_direct_light() {
    let mut verdict = Verdict::on("direct light");
    for (name, kind) in lights() {
        for attenuation in [Attenuation::None, Attenuation::InverseSquare] {
            for visible in [false, true] {
                let light = Light {
                    kind,
                    color: Vec3::splat(0.7),
                    attenuation,
                    samples: 16,
                    visible,
                    node: None,
                    name: String::new(),
                };
                let scene = lit_floor(matte(0.6), light);
                let classical = RenderSettings {
                    integrator: Integrator::Whitted,
                    ..paths(64, (24, 16), 0)
                };
                let expected = mean(&scene, &classical);
                let found = mean(&scene, &paths(256, (24, 16), 0));
                let what = format!("{name}, {attenuation:?}, visible {visible}");
                near(&mut verdict, what, found, expected, 0.004 * expected);
            }
        }
    }
    verdict.close();
}

/// Whether paths may hit a lamp or not, its light is the same: both techniques together count it once.
#[test]
fn lamps_that_paths_can_hit_give_no_more_light_than_hidden_ones() {
    let mut verdict = Verdict::on("glossy floors under lamps");
    let glossy = |shininess: f32| {
        Material::from(Phong {
            diffuse: Vec3::splat(0.1),
            specular: Vec3::splat(0.2 * shininess),
            shininess,
            ..Phong::default()
        })
    };
    for (name, kind) in lights()
        .into_iter()
        .filter(|(_, kind)| kind.radiance().is_some())
    {
        for shininess in [4.0, 60.0] {
            let of = |visible: bool| {
                let light = Light {
                    kind,
                    color: Vec3::ONE,
                    attenuation: Attenuation::InverseSquare,
                    samples: 1,
                    visible,
                    node: None,
                    name: String::new(),
                };
                let scene = lit_floor(glossy(shininess), light);
                mean(&scene, &paths(1024, (24, 16), 0))
            };
            let expected = of(false);
            near(
                &mut verdict,
                format!("{name}, exponent {shininess}"),
                of(true),
                expected,
                0.01 * expected,
            );
        }
    }
    verdict.close();
}

/// Light bounces inside a matte ball as if it were spread evenly: a lamp of power Φ at the centre gives each point of
/// the wall the irradiance Φ/(4π R² (1 − a)).
#[test]
fn a_lamp_in_a_ball_lights_it_evenly() {
    let albedo = 0.6;
    let mut scene = ball_in(0.0, matte(albedo as f32));
    scene.cameras = vec![looking(dvec3(0.3, 0.0, 0.2), DVec3::Z, 0.8)];
    scene.lights = vec![Light {
        kind: LightKind::Point {
            position: DVec3::ZERO,
        },
        color: Vec3::ONE,
        attenuation: Attenuation::InverseSquare,
        ..Light::default()
    }];
    // The irradiance of a light of strength L is π L at distance 1.
    let expected = albedo / PI * PI / (1.0 - albedo);
    let found = mean(&scene, &paths(512, (16, 16), 200));
    assert!(
        (found / expected - 1.0).abs() < 0.003,
        "{found}, expected {expected}"
    );
}

/// Glass that absorbs nothing is invisible in even light, however often light bounces inside.
#[test]
fn clear_glass_is_invisible_in_even_light() {
    let mut verdict = Verdict::on("glass balls under a background of 1");
    for ior in [1.0, 1.33, 1.5, 2.4] {
        let glass = Material::from(Phong {
            diffuse: Vec3::ZERO,
            reflect: Vec3::ONE,
            transmit: Vec3::ONE,
            fresnel: Fresnel::Exact,
            opacity: 0.0,
            ior,
            ..Phong::default()
        });
        let found = mean(&ball_in(1.0, glass), &paths(64, (16, 16), 64));
        near(&mut verdict, format!("index {ior}"), found, 1.0, 0.002);
    }
    verdict.close();
}

/// Slices of any size give the same bits: a sample depends on nothing but its pixel and its index.
#[test]
fn a_picture_does_not_depend_on_how_it_is_cut_into_slices() {
    let (_, kind) = lights().remove(3);
    let light = Light {
        kind,
        color: Vec3::ONE,
        attenuation: Attenuation::InverseSquare,
        samples: 1,
        visible: true,
        node: None,
        name: String::new(),
    };
    let scene = lit_floor(matte(0.7), light);
    let whole = render(&scene, &paths(32, (40, 24), 8)).0;
    let again = render(&scene, &paths(32, (40, 24), 8)).0;
    assert_eq!(whole.pixels, again.pixels);
    let crop = RenderSettings {
        crop: Some([8, 4, 21, 19]),
        ..paths(32, (40, 24), 8)
    };
    let part = render(&scene, &crop).0;
    let expected: Vec<_> = (4..19)
        .flat_map(|y| (8..21).map(move |x| (x, y)))
        .map(|(x, y)| whole.pixels[y * 40 + x])
        .collect();
    assert_eq!(part.pixels, expected);
}

/// A glowing square of two triangles, as an emissive mesh.
fn glowing_square(scene: &mut Scene, world_from_mesh: DAffine3, radiance: f32) {
    let material = scene.add_material(Material {
        emission: Vec3::splat(radiance),
        two_sided: false,
        ..matte(0.0)
    });
    let corners = [(-1.0, -1.0), (1.0, -1.0), (1.0, 1.0), (-1.0, 1.0)];
    scene.meshes.push(Arc::new(Mesh {
        positions: corners.map(|(x, z)| vec3(x, 0.0, z)).to_vec(),
        name: String::new(),
        normals: vec![Vec3::NEG_Y; 4],
        uvs: Vec::new(),
        second_uvs: Vec::new(),
        colors: Vec::new(),
        tangents: Vec::new(),
        materials: vec![material as u32; 4],
        triangles: vec![[0, 1, 2], [0, 2, 3]],
    }));
    scene.instances.push(Instance {
        mesh: scene.meshes.len() - 1,
        placement: world_from_mesh,
        node: None,
        name: String::new(),
    });
}

/// An emissive mesh and a lamp of the same shape and radiance light a floor alike, wherever the mesh is and however it
/// is stretched; and paths that find the mesh without light samples agree.
#[test]
fn emissive_meshes_shine_like_lamps_of_the_same_radiance() {
    let mut verdict = Verdict::on("floors under emissive squares");
    let center = dvec3(0.4, 1.2, -0.5);
    let (along, across) = (0.4, 0.3);
    let kind = LightKind::Rectangle {
        center,
        edge_u: along * DVec3::X,
        edge_v: across * DVec3::Z,
    };
    let radiance = 3.0;
    let lamp = Light {
        kind,
        color: Vec3::splat((radiance / kind.radiance().expect("an area light")) as f32),
        attenuation: Attenuation::InverseSquare,
        samples: 1,
        visible: true,
        node: None,
        name: String::new(),
    };
    let glossy = Material {
        bsdf: Phong {
            specular: Vec3::splat(2.0),
            shininess: 20.0,
            ..matte(0.5).classical().into_owned()
        }
        .into(),
        ..matte(0.5)
    };
    let expected = mean(
        &lit_floor(glossy.clone(), lamp.clone()),
        &paths(512, (24, 16), 0),
    );
    let placed = DAffine3::from_scale_rotation_translation(
        dvec3(along, 1.0, across),
        DQuat::IDENTITY,
        center,
    );
    let mut scene = lit_floor(glossy.clone(), lamp.clone());
    scene.lights.clear();
    glowing_square(&mut scene, placed, radiance as f32);
    let found = mean(&scene, &paths(512, (24, 16), 0));
    near(&mut verdict, "mesh", found, expected, 0.004 * expected);
    // Half of the radiance in the mesh, half in the lamp: both are in one table of chances.
    let mut scene = lit_floor(glossy, lamp);
    scene.lights[0].color *= 0.5;
    scene.lights[0].visible = false;
    glowing_square(&mut scene, placed, radiance as f32 / 2.0);
    let found = mean(&scene, &paths(512, (24, 16), 0));
    near(
        &mut verdict,
        "mesh and lamp",
        found,
        expected,
        0.004 * expected,
    );
    verdict.close();
}
