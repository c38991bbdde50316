//! Trees that instances place: the same picture as if every copy were laid out in the world.

use crate::{
    reference::{
        compare::{assert_none, check_alike, check_same_bits, differing, open_gpu, sized},
        scenes::{self, Build},
    },
    support::random::Random,
};
use glam::{DAffine3, DQuat, DVec3, UVec2, Vec3, dvec3, vec3};
use glimray::{
    image::Image,
    pack::{self, PackedScene},
    render::{Renderer, Settings, Stats, Tone},
    scene::{Frame, Instance, Material, Mesh, Pattern, Scene, Space, Texture, Textures},
};
use std::sync::Arc;

/// A picture of packed frames of a scene, linear, and what it cost.
pub fn shot(packed: &Arc<PackedScene>, frames: &[Frame], settings: &Settings) -> (Image, Stats) {
    let view = packed.shot(frames).expect("frames that can be packed");
    let mut renderer =
        Renderer::new(open_gpu(), packed.clone(), &view, settings.clone()).expect("a renderer");
    while !renderer.is_done() {
        renderer.step().expect("a step");
    }
    let image = renderer.develop(&Tone::LINEAR).expect("a picture");
    (image, renderer.stats().clone())
}

pub fn packed(scene: &Scene, most_laid_out: usize) -> Arc<PackedScene> {
    Arc::new(pack::scene_with(scene, most_laid_out).expect("a scene that can be packed"))
}

/// Copies of a ball and a torus, moved, turned, stretched, and mirrored by turns, over a floor.
pub fn crowd(materials: [Material; 2]) -> Scene {
    let mut scene = scenes::empty();
    let [first, second] = materials.map(|material| scene.add_material(material) as u32);
    scene.meshes = vec![
        scenes::ball(UVec2::new(12, 8), first),
        scenes::torus(0.7, 0.3, UVec2::new(16, 8), second),
    ];
    let mut random = Random::new(7);
    for copy in 0..40 {
        let mirror = if copy % 3 == 0 { -1.0 } else { 1.0 };
        let scale = dvec3(
            mirror * random.between(0.2, 0.5),
            random.between(0.2, 0.5),
            random.between(0.2, 0.5),
        );
        let turn = DQuat::from_axis_angle(random.direction(), random.between(0.0, 6.0));
        let place = random.in_cube() * dvec3(2.6, 1.0, 2.0) + dvec3(0.0, 1.1, 0.0);
        scene.instances.push(Instance {
            mesh: copy % 2,
            placement: DAffine3::from_scale_rotation_translation(scale, turn, place),
            node: None,
        });
    }
    scene.add_mesh(scenes::quad(9.0, 0), DAffine3::IDENTITY);
    scene.add_sphere(dvec3(-2.4, 0.5, 1.4), 0.5, second as usize);
    scene.add_point_light(dvec3(3.0, 5.0, 4.0), 0.7);
    scene
}

pub fn mirror(color: Vec3) -> Material {
    Material {
        reflect: Vec3::splat(0.5),
        ..scenes::shiny(color)
    }
}

pub fn glass() -> Material {
    Material {
        diffuse: Vec3::splat(0.05),
        reflect: Vec3::ONE,
        transmit: Vec3::ONE,
        ior: 1.3,
        absorption: vec3(0.3, 0.1, 0.2),
        ..Material::default()
    }
}

#[test]
fn instances_give_the_picture_of_copies_laid_out() {
    let checkered = |mut scene: Scene| {
        scene.textures.push(Texture {
            pattern: Pattern::Checker {
                a: Vec3::splat(0.2),
                b: Vec3::ONE,
            },
            space: Space::World,
            pattern_from_space: DAffine3::from_scale(DVec3::splat(5.0)),
        });
        for material in &mut scene.materials {
            material.textures = Textures {
                diffuse: Some(0),
                ..Textures::default()
            };
        }
        scene
    };
    let colors = [vec3(0.8, 0.3, 0.2), vec3(0.2, 0.4, 0.8)];
    let scenes = [
        ("dull", crowd(colors.map(scenes::shiny))),
        ("mirrors", crowd(colors.map(mirror))),
        ("glass", crowd([glass(), mirror(colors[1])])),
        ("patterns", checkered(crowd(colors.map(scenes::shiny)))),
    ];
    let settings = Settings {
        count_rays: true,
        ..sized(160, 120)
    };
    assert_none(scenes.map(|(name, scene)| {
        let frame = [scene.frame(0.0)];
        let laid_out = packed(&scene, usize::MAX);
        let instanced = packed(&scene, 0);
        assert_eq!(laid_out.instance_count(), 0, "{name}");
        assert_eq!(instanced.instance_count(), 40, "{name}");
        let (expected, _) = shot(&laid_out, &frame, &settings);
        let (actual, _) = shot(&instanced, &frame, &settings);
        check_alike(name, &expected, &actual, 2.0, 0.004)?;

        if name == "mirrors" || name == "glass" {
            // Beyond the driver's limit on the rounds of loops.
            return Ok(());
        }
        let brute_force = Settings {
            brute_force: true,
            ..settings.clone()
        };
        let (exhaustive, _) = shot(&instanced, &frame, &brute_force);
        check_same_bits(&format!("{name}, every primitive"), &exhaustive, &actual)
    }));
}

#[test]
fn instances_need_the_memory_of_one_mesh() {
    let mesh = scenes::torus(0.7, 0.3, UVec2::new(200, 100), 0);
    let triangles = mesh.triangles.len();
    let scene_of = |copies: u32| {
        let mut scene = scenes::empty();
        scene.meshes.push(mesh.clone());
        scene.instances.extend((0..copies).map(|i| Instance {
            mesh: 0,
            placement: DAffine3::from_translation(dvec3(f64::from(i), 0.0, 0.0)),
            node: None,
        }));
        scene
    };
    let bytes = |scene: &Scene| {
        let packed = pack::scene(scene).expect("a scene that can be packed");
        assert_eq!(packed.triangles.len(), triangles);
        let view = packed.frame(&scene.frame(0.0)).expect("a frame");
        let all = packed.parts().into_iter().chain(view.parts());
        all.map(<[u8]>::len).sum::<usize>()
    };
    let (one, thousand) = (bytes(&scene_of(1)), bytes(&scene_of(1000)));
    // An instance's rows, and its share of the nodes above it.
    assert!(thousand - one < 1000 * 256, "{} bytes more", thousand - one);
}

#[test]
fn rays_that_leave_a_triangle_hit_the_same_one_of_another_instance() {
    // A floor and the same mesh as a roof above it, which is its only shade.
    let mut scene = scenes::empty();
    scene.meshes.push(scenes::quad(4.0, 0));
    scene.instances = [0.0, 2.0]
        .map(|height| Instance {
            mesh: 0,
            placement: DAffine3::from_translation(dvec3(0.0, height, 0.0)),
            node: None,
        })
        .into();
    scene.ambient = Vec3::ZERO;
    scene.cameras[0].look_from = dvec3(0.0, 0.5, 6.0);
    scene.cameras[0].look_at = DVec3::ZERO;
    scene.add_point_light(dvec3(0.1, 8.0, 0.2), 1.0);
    let frame = [scene.frame(0.0)];
    let settings = sized(64, 48);
    let (laid_out, _) = shot(&packed(&scene, usize::MAX), &frame, &settings);
    let (instanced, _) = shot(&packed(&scene, 0), &frame, &settings);
    assert_eq!(differing(&laid_out, &instanced, 1.0), 0);
    let dark = |image: &Image| image.pixels.iter().filter(|p| p[..3] == [0.0; 3]).count();
    assert!(
        dark(&instanced) > 100,
        "{} pixels in the shade",
        dark(&instanced)
    );
}

#[test]
fn an_empty_crowd_and_a_hidden_one_are_background() {
    let mut scene = scenes::empty();
    scene.meshes.push(Mesh::default());
    scene.instances = vec![
        Instance {
            mesh: 0,
            placement: DAffine3::IDENTITY,
            node: None,
        };
        3
    ];
    let (image, _) = shot(&packed(&scene, 0), &[scene.frame(0.0)], &sized(8, 8));
    let background = [0.2_f32, 0.4, 0.6];
    assert!(image.pixels.iter().all(|pixel| pixel[..3] == background));
}
