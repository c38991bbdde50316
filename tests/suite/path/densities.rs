//! Light samples and paths that find a light by themselves share its light by their densities. Both report the density of light
//! samples for a direction: a light sample by its radiance per density, and the weights by the density that a path which
//! hits the light takes for it. Their product is the radiance of the light.

use super::emissive_solids::solids;
use super::emitters::{dust, globe};
use super::explained::explained;
use super::{lights, lit_floor, matte, paths};
use crate::reference::scenes::Build;
use crate::support::{random::Random, verdict::Verdict};
use glam::{DAffine3, DQuat, Vec3, dvec3, vec3, vec4};
use glimray::scene::{
    Attenuation, Background, CanonicalShape, Geometry, Light, LightKind, Material, Phong, Picture,
    Scene, Shape,
};
use std::sync::Arc;

const RADIANCE: f32 = 3.0;

/// Rough balls over a glossy floor, without lights.
fn dark(random: &mut Random) -> Scene {
    let glossy = |shininess| Material {
        bsdf: Phong {
            specular: Vec3::splat(2.0),
            shininess,
            ..matte(0.4).classical().into_owned()
        }
        .into(),
        ..matte(0.4)
    };
    let mut scene = lit_floor(glossy(30.0), Light::default());
    scene.lights.clear();
    for _ in 0..4 {
        let material = scene.add_material(glossy(random.between(1.0, 300.0) as f32));
        let center = 0.8 * random.in_cube() + dvec3(0.0, 0.5, 0.0);
        scene.add_sphere(center, random.between(0.05, 0.3), material);
    }
    scene
}

/// Somewhere above the floor.
fn placed(random: &mut Random) -> DAffine3 {
    let turn = DQuat::from_axis_angle(random.direction(), random.between(0.0, 6.0));
    let scale = dvec3(1.0, random.between(0.5, 2.0), random.between(0.5, 2.0));
    DAffine3::from_scale_rotation_translation(
        random.between(0.02, 0.3) * scale,
        turn,
        random.in_cube() + dvec3(0.0, 1.3, 0.0),
    )
}

fn glowing(scene: &mut Scene, two_sided: bool) -> usize {
    scene.add_material(Material {
        emission: Vec3::splat(RADIANCE),
        two_sided,
        ..matte(0.2)
    })
}

/// `count` emissive shapes of a kind.
fn under_shapes(canonical: CanonicalShape, count: usize, random: &mut Random) -> Scene {
    let mut scene = dark(random);
    let materials = [false, true].map(|two_sided| glowing(&mut scene, two_sided));
    for index in 0..count {
        scene.shapes.push(Shape {
            geometry: Geometry::Placed {
                canonical,
                world_from_canonical: placed(random),
            },
            material: materials[index % 2],
            node: None,
            name: String::new(),
        });
    }
    scene
}

/// `count` meshes of triangles that glow, some of which are copies.
fn under_meshes(count: usize, random: &mut Random) -> Scene {
    let mut scene = dark(random);
    let material = glowing(&mut scene, false) as u32;
    for index in 0..count {
        match index % 3 {
            0 => scene.add_mesh(globe(1.0, 4, material), placed(random)),
            1 => {
                let centers: Vec<Vec3> = (0..5)
                    .map(|_| (0.7 * random.in_cube()).as_vec3() + vec3(0.0, 1.0, 0.0))
                    .collect();
                let glowing = scene.materials.len();
                let mesh = dust(&mut scene, &centers);
                scene.materials[glowing].emission = Vec3::splat(RADIANCE);
                scene.add_mesh(mesh, DAffine3::IDENTITY)
            }
            _ => {
                let mut copy = scene.instances.last().expect("a mesh").clone();
                copy.placement = placed(random);
                scene.instances.push(copy);
            }
        };
    }
    scene
}

/// Meshes whose colours vary over their triangles, but not in green.
fn under_painted_meshes(random: &mut Random) -> Scene {
    let mut scene = dark(random);
    let material = scene.add_material(Material {
        emission: Vec3::splat(RADIANCE),
        ..matte(0.0)
    });
    for _ in 0..6 {
        let mut mesh = globe(1.0, 4, material as u32);
        let mut part = || random.between(0.0, 8.0) as f32;
        let mut color = || vec4(part(), 1.0, part(), 1.0);
        mesh.colors = mesh.positions.iter().map(|_| color()).collect();
        scene.add_mesh(mesh, placed(random));
    }
    scene
}

/// `count` lamps of this kind that paths can hit.
fn under_lamps(kind: &LightKind, count: usize, random: &mut Random) -> Scene {
    let mut scene = dark(random);
    let strength = kind.radiance().expect("an area light");
    for _ in 0..count {
        let at = random.in_cube() + dvec3(0.0, 1.3, 0.0);
        let kind = match *kind {
            LightKind::Rectangle { edge_u, edge_v, .. } => LightKind::Rectangle {
                center: at,
                edge_u,
                edge_v,
            },
            LightKind::Disc { radius, .. } => LightKind::Disc {
                center: at,
                normal: random.direction(),
                radius,
            },
            LightKind::Sphere { radius, .. } => LightKind::Sphere { center: at, radius },
            _ => unreachable!("not an area light"),
        };
        scene.lights.push(Light {
            kind,
            color: Vec3::splat(RADIANCE / strength as f32),
            attenuation: Attenuation::InverseSquare,
            samples: 1,
            visible: true,
            node: None,
            name: String::new(),
        });
    }
    scene
}

/// A background whose upper half is brighter than its lower half.
fn under_the_sky(random: &mut Random) -> Scene {
    let mut scene = dark(random);
    let texel = |index| Vec3::splat(if index < 64 * 16 { RADIANCE } else { 0.2 });
    let picture = Picture::opaque(64, 32, (0..64 * 32).map(texel));
    scene.pictures.push(Arc::new(picture));
    scene.background = Background::Picture {
        picture: 0,
        strength: 1.0,
        rotation: 0.0,
    };
    scene
}

/// Compares the radiance of all light samples with that of the lights in their direction.
fn check(
    verdict: &mut Verdict,
    name: &str,
    scene: &Scene,
    radiance: impl Fn([f32; 3]) -> Option<f32>,
) {
    let (trees, _) = explained(scene, &paths(16, (24, 16), 3), 40);
    let rays = trees
        .iter()
        .flat_map(|tree| &tree.samples)
        .flat_map(|sample| &sample.rays);
    let mut count = 0;
    for ray in rays {
        let sample = ray
            .shadow
            .as_ref()
            .and_then(|shadow| shadow.sample.as_ref());
        let density = ray.sharing.and_then(|sharing| sharing.light_pdf);
        let (Some(sample), Some(density)) = (sample, density) else {
            continue;
        };
        let Some(expected) = radiance(ray.direction.map(|x| x as f32)) else {
            continue;
        };
        // The back of a light sends nothing.
        if sample.radiance == [0.0; 3] {
            continue;
        }
        let found = density * sample.radiance[1];
        // Distances of lamps seen edge-on are shortened by up to 1 %.
        let tolerance = if density > 100.0 { 0.021 } else { 0.002 };
        verdict.that(name, (found / expected - 1.0).abs() < tolerance, || {
            format!("{found}, not {expected}: {sample:?}, density {density}")
        });
        count += 1;
    }
    verdict.that(format!("{name}: samples"), count > 100, || count);
}

#[test]
fn densities_of_light_samples_are_those_that_hits_take_for_them() {
    let mut verdict = Verdict::on("light samples");
    let mut random = Random::new(17);
    let even = |_| Some(RADIANCE);
    // Few lights are in a table, many in a tree.
    for count in [3, 200] {
        for (name, kind) in lights() {
            if kind.radiance().is_some() {
                let scene = under_lamps(&kind, count, &mut random);
                check(
                    &mut verdict,
                    &format!("{count} lamps: {name}"),
                    &scene,
                    even,
                );
            }
        }
        for (name, canonical, _) in solids() {
            let scene = under_shapes(canonical, count, &mut random);
            check(&mut verdict, &format!("{count} times {name}"), &scene, even);
        }
        let scene = under_meshes(count, &mut random);
        check(&mut verdict, &format!("{count} meshes"), &scene, even);
    }
    for tree in [false, true] {
        let mut scene = under_painted_meshes(&mut random);
        if !tree {
            scene.meshes.truncate(1);
            scene.instances.truncate(1);
            Arc::make_mut(&mut scene.meshes[0]).triangles.truncate(3);
        }
        check(&mut verdict, "painted meshes", &scene, even);
    }
    let scene = under_the_sky(&mut random);
    check(&mut verdict, "sky", &scene, |[_, y, _]| match y {
        0.15..=1.0 => Some(RADIANCE),
        -1.0..=-0.15 => Some(0.2),
        _ => None,
    });
    verdict.close();
}
