//! Instances of BLASes: the same picture as if every copy were baked into the world.

use crate::{
    reference::{
        compare::{
            Wanted, assert_none, check_alike, check_same_bits, counting, differing, fetched,
            open_gpu, sized,
        },
        scenes::{self, Build},
    },
    support::random::Random,
};
use glam::{DAffine3, DQuat, DVec3, UVec2, Vec3, dvec3, vec3};
use glimray::{
    image::Image,
    pack::{self, PackedScene, PackedView},
    render::{ExecutionPolicy, Fetch, RenderError, RenderSettings, Renderer, Stats, Tone},
    scene::{
        Beyond, Curve, Easing, Frame, Instance, Interpolation, Light, LightKind, Material, Mesh,
        Node, NodeProperty, Pattern, Phong, PhongTextures, Scene, Space, Target, Texture, Track,
        Values,
    },
};
use glimray_app::error::AppError;
use std::{fmt::Write, fs, process::Command, sync::Arc};

/// A linear picture of packed frames of a scene, and its statistics.
pub fn rendered(
    packed: &Arc<PackedScene>,
    frames: &[Frame],
    wanted: &impl Wanted,
) -> (Image, Stats) {
    let view = packed.view(frames).expect("frames that can be packed");
    let (settings, policy) = wanted.parts();
    let mut renderer =
        Renderer::new(open_gpu(), packed.clone(), &view, settings, policy).expect("a renderer");
    while !renderer.is_done() {
        renderer.step().expect("a step");
    }
    let image = renderer.develop(&Tone::LINEAR).expect("a picture");
    (image, renderer.stats().clone())
}

pub fn packed(scene: &Scene, most_baked: usize) -> Arc<PackedScene> {
    Arc::new(pack::scene_with(scene, most_baked).expect("a scene that can be packed"))
}

/// Copies of a ball and a torus, translated, rotated, stretched, and alternately mirrored, over a floor.
pub fn crowd(materials: [Material; 2]) -> Scene {
    let mut scene = scenes::empty();
    let [first, second] = materials.map(|material| scene.add_material(material) as u32);
    scene.meshes = vec![
        scenes::ball(UVec2::new(12, 8), first).into(),
        scenes::torus(0.7, 0.3, UVec2::new(16, 8), second).into(),
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
            name: String::new(),
        });
    }
    scene.add_mesh(scenes::quad(9.0, 0), DAffine3::IDENTITY);
    scene.add_sphere(dvec3(-2.4, 0.5, 1.4), 0.5, second as usize);
    scene.add_point_light(dvec3(3.0, 5.0, 4.0), 0.7);
    scene
}

pub fn mirror(color: Vec3) -> Material {
    Material {
        bsdf: Phong {
            reflect: Vec3::splat(0.5),
            ..scenes::shiny(color).classical().into_owned()
        }
        .into(),
        ..scenes::shiny(color)
    }
}

pub fn glass() -> Material {
    Material::from(Phong {
        diffuse: Vec3::splat(0.05),
        reflect: Vec3::ONE,
        transmit: Vec3::ONE,
        ior: 1.3,
        absorption: vec3(0.3, 0.1, 0.2),
        ..Phong::default()
    })
}

#[test]
fn instances_give_the_picture_of_baked_copies() {
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
            material.classical_mut().textures = PhongTextures {
                diffuse: Some(0),
                ..PhongTextures::default()
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
    let settings = counting(&sized(160, 120));
    assert_none(scenes.map(|(name, scene)| {
        let frame = [scene.frame(0.0)];
        let laid_out = packed(&scene, usize::MAX);
        let instanced = packed(&scene, 0);
        assert_eq!(laid_out.instance_count(), 0, "{name}");
        assert_eq!(instanced.instance_count(), 40, "{name}");
        let (expected, _) = rendered(&laid_out, &frame, &settings);
        let (actual, _) = rendered(&instanced, &frame, &settings);
        check_alike(name, &expected, &actual, 2.0, 0.004)?;

        if name == "mirrors" || name == "glass" {
            // Beyond the loop limit of the driver.
            return Ok(());
        }
        let brute_force = RenderSettings {
            brute_force: true,
            ..settings.0.clone()
        };
        let (exhaustive, _) = rendered(&instanced, &frame, &brute_force);
        check_same_bits(&format!("{name}, every primitive"), &exhaustive, &actual)
    }));
}

#[test]
fn instances_need_the_memory_of_one_mesh() {
    let mesh = scenes::torus(0.7, 0.3, UVec2::new(200, 100), 0);
    let triangles = mesh.triangles.len();
    let scene_of = |copies: u32| {
        let mut scene = scenes::empty();
        scene.meshes.push(mesh.clone().into());
        scene.instances.extend((0..copies).map(|i| Instance {
            mesh: 0,
            placement: DAffine3::from_translation(dvec3(f64::from(i), 0.0, 0.0)),
            node: None,
            name: String::new(),
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
    // The rows of an instance, and its part of the nodes above it.
    assert!(thousand - one < 1000 * 256, "{} bytes more", thousand - one);
}

#[test]
fn rays_that_leave_a_triangle_hit_the_same_one_of_another_instance() {
    // A floor and the same mesh as a roof above it, which is the only object that casts shadows.
    let mut scene = scenes::empty();
    scene.meshes.push(scenes::quad(4.0, 0).into());
    scene.instances = [0.0, 2.0]
        .map(|height| Instance {
            mesh: 0,
            placement: DAffine3::from_translation(dvec3(0.0, height, 0.0)),
            node: None,
            name: String::new(),
        })
        .into();
    scene.ambient = Vec3::ZERO;
    scene.cameras[0].look_from = dvec3(0.0, 0.5, 6.0);
    scene.cameras[0].look_at = DVec3::ZERO;
    scene.add_point_light(dvec3(0.1, 8.0, 0.2), 1.0);
    let frame = [scene.frame(0.0)];
    let settings = sized(64, 48);
    let (laid_out, _) = rendered(&packed(&scene, usize::MAX), &frame, &settings);
    let (instanced, _) = rendered(&packed(&scene, 0), &frame, &settings);
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
    scene.meshes.push(Mesh::default().into());
    scene.instances = vec![
        Instance {
            mesh: 0,
            placement: DAffine3::IDENTITY,
            node: None,
            name: String::new(),
        };
        3
    ];
    let (image, _) = rendered(&packed(&scene, 0), &[scene.frame(0.0)], &sized(8, 8));
    let background = [0.2_f32, 0.4, 0.6];
    assert!(image.pixels.iter().all(|pixel| pixel[..3] == background));
}

#[test]
fn a_lamp_throws_no_shadow_of_itself_on_instances() {
    let center = dvec3(0.0, 2.5, 0.0);
    let lamps = [
        LightKind::Sphere {
            center,
            radius: 0.4,
        },
        LightKind::Rectangle {
            center,
            edge_u: DVec3::X * 0.4,
            edge_v: DVec3::Z * 0.4,
        },
        LightKind::Disc {
            center,
            normal: DVec3::NEG_Y,
            radius: 0.4,
        },
    ];
    for kind in lamps {
        // Adjacent floors, far from the origin of their own space.
        let mut scene = scenes::empty();
        let mut floor = scenes::quad(0.5, 0);
        for position in &mut floor.positions {
            position.x += 40.0;
        }
        scene.meshes.push(floor.into());
        scene.instances = [-1.2, 0.0, 1.2]
            .map(|x| Instance {
                mesh: 0,
                placement: DAffine3::from_translation(dvec3(x - 40.0, 0.0, 0.0)),
                node: None,
                name: String::new(),
            })
            .into();
        scene.lights.push(Light {
            kind,
            color: Vec3::ONE,
            samples: 4,
            visible: true,
            ..Light::default()
        });
        let settings = counting(&sized(160, 120));
        let (_, stats) = rendered(&packed(&scene, 0), &[scene.frame(0.0)], &settings);
        let rays = stats.rays.expect("rays are counted");
        assert!(rays.shadow > 400, "{kind:?}: {rays:?}");
        assert_eq!(rays.shadow_blocked, 0, "{kind:?}: {rays:?}");
    }
}

/// A crowd on a static node, while another node moves.
fn crowd_beside_a_mover() -> Scene {
    let mut scene = crowd([vec3(0.8, 0.3, 0.2), vec3(0.2, 0.4, 0.8)].map(scenes::shiny));
    scene.nodes = vec![
        Node {
            translation: dvec3(0.37, 0.1, -0.2),
            rotation: DQuat::from_rotation_y(0.7),
            ..Node::default()
        },
        Node::default(),
    ];
    for instance in &mut scene.instances[..40] {
        instance.node = Some(0);
    }
    scene.shapes[0].node = Some(1);
    scene.tracks = vec![translation(1, [DVec3::ZERO, DVec3::X])];
    scene
}

/// A node that moves from the first to the second position within a second, in a jump at half of it.
fn jump(node: usize, places: [DVec3; 2]) -> Track {
    let mut track = translation(node, places);
    track.curve.times = vec![0.0, 0.5];
    track.curve.interpolation = Interpolation::Step;
    track
}

/// A node that moves from the first to the second position within a second.
fn translation(node: usize, places: [DVec3; 2]) -> Track {
    Track {
        targets: vec![Target::Node(node, NodeProperty::Translation)],
        curve: Curve {
            times: vec![0.0, 1.0],
            values: Values::Vector(places.into()),
            interpolation: Interpolation::Linear,
            easing: Easing::None,
            beyond: Beyond::Hold,
        },
    }
}

#[test]
fn patterns_on_static_objects_stay_in_world_space_while_others_move() {
    let mut scene = crowd_beside_a_mover();
    scene.textures.push(Texture {
        pattern: Pattern::Checker {
            a: Vec3::splat(0.2),
            b: Vec3::ONE,
        },
        space: Space::World,
        pattern_from_space: DAffine3::from_scale(DVec3::splat(5.0)),
    });
    for material in &mut scene.materials {
        material.classical_mut().textures.diffuse = Some(0);
    }
    let frame = [scene.frame(0.0)];
    let settings = sized(160, 120);
    let (expected, _) = rendered(&packed(&scene, usize::MAX), &frame, &settings);
    let (actual, _) = rendered(&packed(&scene, 0), &frame, &settings);
    assert_none([check_alike("patterns", &expected, &actual, 2.0, 0.004)]);
}

/// Many spheres on a node that jumps while the shutter is open, which needs the maximum number of keys.
fn jumping_spheres(count: usize) -> Scene {
    let mut scene = scenes::empty();
    scene.nodes.push(Node::default());
    for i in 0..count {
        let place = dvec3((i % 100) as f64, (i / 100) as f64, -60.0);
        scene.add_sphere(place - dvec3(50.0, 30.0, 0.0), 0.4, 0);
        scene.shapes[i].node = Some(0);
    }
    scene.tracks = vec![jump(0, [DVec3::ZERO, DVec3::X])];
    scene.ambient = Vec3::ONE;
    scene
}

#[test]
fn the_memory_limit_applies_to_later_frames_too() {
    let scene = jumping_spheres(100);
    let packed = packed(&scene, 0);
    let still = packed
        .view(&scene.motion_samples(0.0, 0.1))
        .expect("a frame");
    let moving = packed
        .view(&scene.motion_samples(0.0, 1.0))
        .expect("a frame");
    let (settings, policy) = sized(16, 16).parts();
    let mut renderer = Renderer::new(open_gpu(), packed.clone(), &still, settings.clone(), policy)
        .expect("a renderer");
    let first = renderer.stats().gpu_bytes;
    renderer.set_frame(&moving).expect("within the usual limit");
    let most = renderer.stats().gpu_bytes;
    // 257 keys of 64 bytes for each.
    assert!(most > first + 100 * 257 * 64, "{most} after {first}");
    renderer.set_frame(&still).expect("it was there before");
    assert_eq!(renderer.stats().gpu_bytes, most);

    let policy = ExecutionPolicy {
        memory_limit_bytes: most - 1,
        ..policy
    };
    let mut renderer =
        Renderer::new(open_gpu(), packed, &still, settings, policy).expect("a renderer");
    let refused = renderer.set_frame(&moving).expect_err("one byte too many");
    assert!(refused.to_string().contains("nodes"), "{refused}");
    assert_eq!(AppError::from(refused).exit_code(), 7);
}

#[test]
fn a_frame_that_outgrows_the_limits_of_the_device_gets_another_device_or_is_too_big() {
    let scene = jumping_spheres(6600);
    let packed = packed(&scene, 0);
    let still = packed
        .view(&scene.motion_samples(0.0, 0.1))
        .expect("a frame");
    let moving = packed
        .view(&scene.motion_samples(0.0, 1.0))
        .expect("a frame");
    let picture = |fetch, views: &[&PackedView]| {
        let (settings, policy) = fetched(&sized(16, 12), fetch);
        let mut renderer = Renderer::new(open_gpu(), packed.clone(), views[0], settings, policy)?;
        for view in &views[1..] {
            renderer.set_frame(view)?;
        }
        while !renderer.is_done() {
            renderer.step()?;
        }
        Ok::<_, RenderError>(renderer.develop(&Tone::LINEAR).expect("a picture"))
    };
    let same = |a: &Image, b: &Image| assert_none([check_same_bits("frames", a, b)]);
    let expected = picture(Fetch::Auto, &[&moving]).expect("a picture");
    let after = picture(Fetch::Auto, &[&still, &moving]).expect("a picture");
    same(&expected, &after);
    // Beyond the minimum binding size of WebGPU, which some adapters do not exceed.
    match picture(Fetch::Buffer, &[&still, &moving, &still, &moving]) {
        Ok(image) => same(&expected, &image),
        Err(error) => assert_eq!(AppError::from(error).exit_code(), 7),
    }
}

#[test]
fn copies_of_glass_need_the_memory_of_one_mesh() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let write = |name: &str, text: &str| fs::write(folder.path().join(name), text).expect("a file");
    const SIDE: usize = 41;
    let mut grid = String::new();
    for i in 0..SIDE * SIDE {
        let _ = writeln!(grid, "v {} {} {}", i % SIDE, i / SIDE, i * 7 % 13);
    }
    for i in (0..SIDE * (SIDE - 1)).filter(|i| i % SIDE != SIDE - 1) {
        let [a, b, c, d] = [i + 1, i + 2, i + SIDE + 1, i + SIDE + 2];
        let _ = writeln!(grid, "f {a} {b} {c}\nf {b} {d} {c}");
    }
    write("grid.obj", &grid);
    let peak_bytes = |material: &str| {
        let scene = format!(
            "
camera = {{ look_from = [0, 0, 9], look_at = [0, 0, 0] }}
[materials]
copied = {{ {material} }}
[[objects]]
mesh = {{ file = \"grid.obj\" }}
material = \"copied\"
repeat = {{ grid = {{ count = [50, 60, 1], step = [50, 50, 1] }} }}
"
        );
        write("a.toml", &scene);
        let output = Command::new(env!("CARGO_BIN_EXE_glimray"))
            .args(["render", "a.toml", "-o", "a.png", "--report", "-"])
            .args(["--size", "8x8", "--quiet"])
            .current_dir(folder.path())
            .output()
            .expect("glimray runs");
        let report: serde_json::Value = serde_json::from_slice(&output.stdout).expect("a report");
        report["memory"]["host_peak_bytes"].as_u64()
    };
    let dull = peak_bytes("phong = { diffuse = [1, 1, 1] }");
    let glass = peak_bytes("refract = { ior = 1.5 }");
    // Where the system reports it. 3000 copies of 3200 triangles would need hundreds of megabytes.
    if let (Some(dull), Some(glass)) = (dull, glass) {
        assert!(glass < dull + (100 << 20), "{glass} bytes, dull {dull}");
    }
}
