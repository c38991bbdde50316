//! Features that a scene does not use are compiled out of its kernel; that must never affect its picture.

use crate::{
    instances::{packed, rendered},
    motion_blur::track,
    reference::{
        compare::{assert_none, check_alike, counting, render, sized, start_packed},
        scenes::{self, Build},
    },
    support::random::Random,
};
use glam::{DAffine3, DQuat, DVec3, UVec2, Vec3, dvec3, vec3};
use glimray::{
    image::Image,
    pack,
    render::{Antialias, Filter, Integrator, RenderSettings, Tone},
    scene::{
        Attenuation, Background, Camera, CanonicalShape, Fresnel, Geometry, Instance, Lens, Light,
        LightKind, Material, Mesh, Mixing, Node, NodeProperty, Pattern, Phong, Picture, Scene,
        Shadows, Shape, Space, Target, Texture, Values,
    },
};
use std::sync::Arc;

/// A material in front of a background of this radiance, with only ambient light.
fn before(background: f32, material: Material) -> Scene {
    Scene {
        cameras: vec![Camera {
            look_from: dvec3(0.5, 1.2, 6.0),
            fov_y: 1.0,
            ..Camera::default()
        }],
        materials: vec![material],
        background: Background::Color(Vec3::splat(background)),
        ambient: Vec3::ONE,
        ..Scene::default()
    }
}

fn black() -> Material {
    Material::from(Phong {
        diffuse: Vec3::ZERO,
        ambient: Vec3::ZERO,
        ..Phong::default()
    })
}

/// Without Fresnel: all light passes.
fn clear(ior: f32) -> Material {
    Material {
        bsdf: Phong {
            transmit: Vec3::ONE,
            opacity: 0.0,
            ior,
            ..black().classical().into_owned()
        }
        .into(),
        ..black()
    }
}

fn add_box(scene: &mut Scene, min: DVec3, max: DVec3) {
    let world_from_canonical = DAffine3::from_scale_rotation_translation(
        (max - min) / 2.0,
        DQuat::IDENTITY,
        (min + max) / 2.0,
    );
    scene.shapes.push(Shape {
        geometry: Geometry::Placed {
            canonical: CanonicalShape::Box,
            world_from_canonical,
        },
        material: 0,
        node: None,
        name: String::new(),
    });
}

#[track_caller]
fn assert_all(image: &Image, expected: f32) {
    for (i, pixel) in image.pixels.iter().enumerate() {
        assert!(
            (pixel[0] - expected).abs() < 1e-4,
            "pixel {i}: {} for {expected}",
            pixel[0]
        );
    }
}

#[test]
fn total_reflection_needs_no_mirror_elsewhere_in_the_scene() {
    // A ray that enters a block of index 1.5 hits its sides beyond the critical angle and leaves by the
    // opposite face: no light is lost, so the block is invisible in front of a uniform background.
    let mut scene = before(0.5, clear(1.5));
    add_box(&mut scene, DVec3::NEG_ONE, DVec3::ONE);
    let (image, stats) = render(
        &scene,
        &counting(&RenderSettings {
            max_depth: 9,
            ..sized(48, 48)
        }),
    );
    assert!(stats.rays.expect("counts").reflection > 100);
    assert_all(&image, 0.5);
}

#[test]
fn opacity_counts_without_mirrors_or_glass_in_the_scene() {
    // Layer: (1 - R) · opacity · ambient light.
    let mut scene = before(
        0.25,
        Material {
            bsdf: Phong {
                opacity: 0.25,
                ambient: Vec3::ONE,
                ..black().classical().into_owned()
            }
            .into(),
            ..black()
        },
    );
    scene.add_sphere(DVec3::ZERO, 1.5, 0);
    assert_all(&render(&scene, &sized(32, 32)).0, 0.25);
}

#[test]
fn a_lamp_on_the_back_of_the_only_body_is_seen_through_it() {
    let mut scene = before(0.0, clear(1.0));
    scene.cameras[0] = Camera {
        look_from: dvec3(0.0, 0.0, 5.0),
        fov_y: 0.1,
        ..Camera::default()
    };
    add_box(&mut scene, dvec3(-4.0, -4.0, -1.0), dvec3(4.0, 4.0, 0.0));
    let kind = LightKind::Rectangle {
        center: dvec3(0.0, 0.0, -1.0),
        edge_u: DVec3::X,
        edge_v: DVec3::Y,
    };
    scene.lights.push(Light {
        kind,
        color: Vec3::ONE,
        visible: true,
        ..Light::default()
    });
    // A square of area 4 with the radiance of a light of colour 1: π c / A.
    assert_all(
        &render(&scene, &sized(16, 16)).0,
        std::f32::consts::PI / 4.0,
    );
}

/// Closed boxes from corner to corner, in one mesh with flat normals.
pub fn boxes(corners: &[[DVec3; 2]]) -> Mesh {
    let mut mesh = Mesh::default();
    for [min, max] in corners {
        for (axis, sign) in [
            (0, -1.0),
            (0, 1.0),
            (1, -1.0),
            (1, 1.0),
            (2, -1.0),
            (2, 1.0),
        ] {
            let mut normal = DVec3::ZERO;
            normal[axis] = sign;
            let (u, v) = ((axis + 1) % 3, (axis + 2) % 3);
            let first = mesh.positions.len() as u32;
            for (a, b) in [(false, false), (true, false), (true, true), (false, true)] {
                let mut p = if sign > 0.0 { *max } else { *min };
                p[u] = if a { max[u] } else { min[u] };
                p[v] = if b { max[v] } else { min[v] };
                mesh.positions.push(p.as_vec3());
                mesh.normals.push(normal.as_vec3());
                mesh.materials.push(0);
            }
            mesh.triangles
                .extend([[first, first + 1, first + 2], [first, first + 2, first + 3]]);
        }
    }
    mesh.repair();
    mesh
}

#[test]
fn overlapping_parts_of_a_mesh_are_one_volume() {
    // Half of the light passes each boundary; the overlap has no boundaries.
    let mut scene = before(
        1.0,
        Material {
            bsdf: Phong {
                transmit: Vec3::splat(0.5),
                ..clear(1.0).classical().into_owned()
            }
            .into(),
            ..clear(1.0)
        },
    );
    scene.cameras[0] = Camera {
        look_from: dvec3(0.1, 0.05, 9.0),
        look_at: dvec3(0.1, 0.05, 0.0),
        fov_y: 0.01,
        ..Camera::default()
    };
    let parts = [
        [dvec3(-1.0, -1.0, -1.0), dvec3(1.0, 1.0, 0.5)],
        [dvec3(-0.8, -1.1, -0.5), dvec3(1.2, 0.9, 1.0)],
    ];
    scene.add_mesh(boxes(&parts), DAffine3::IDENTITY);
    let settings = RenderSettings {
        max_depth: 9,
        ..sized(8, 8)
    };
    assert_all(&render(&scene, &settings).0, 0.25);
}

/// Kinds of materials.
const MATERIALS: usize = 10;

/// Every property of a material that adds code to a kernel.
fn material(kind: usize) -> Material {
    let shiny = scenes::shiny(vec3(0.8, 0.5, 0.3));
    let glass = Material {
        bsdf: Phong {
            reflect: Vec3::ONE,
            transmit: Vec3::ONE,
            opacity: 0.0,
            ior: 1.5,
            absorption: vec3(0.3, 0.1, 0.2),
            ..shiny.classical().into_owned()
        }
        .into(),
        ..shiny.clone()
    };
    match kind {
        0 => Material::default(),
        1 => shiny,
        2 => Material {
            bsdf: Phong {
                reflect: vec3(0.7, 0.6, 0.5),
                ..shiny.classical().into_owned()
            }
            .into(),
            ..shiny
        },
        3 => Material {
            bsdf: Phong {
                fresnel: Fresnel::Exact,
                ..glass.classical().into_owned()
            }
            .into(),
            ..glass
        },
        4 => Material {
            bsdf: Phong {
                fresnel: Fresnel::Schlick,
                ..glass.classical().into_owned()
            }
            .into(),
            ..glass
        },
        5 => Material {
            bsdf: Phong {
                reflect: Vec3::ZERO,
                transmit: Vec3::splat(0.9),
                ..glass.classical().into_owned()
            }
            .into(),
            ..glass
        },
        6 => Material {
            bsdf: Phong {
                opacity: 0.4,
                ..shiny.classical().into_owned()
            }
            .into(),
            ..shiny
        },
        7 => Material {
            emission: vec3(0.3, 0.5, 0.7),
            two_sided: false,
            ..shiny
        },
        8 => Material {
            bsdf: Phong {
                mixing: Mixing::Sum,
                reflect: Vec3::splat(0.2),
                transmit: Vec3::splat(0.6),
                ..glass.classical().into_owned()
            }
            .into(),
            ..glass
        },
        _ => Material {
            bsdf: Phong {
                mixing: Mixing::Blend,
                reflect: Vec3::splat(0.3),
                ..shiny.classical().into_owned()
            }
            .into(),
            ..shiny
        },
    }
}

fn light(kind: usize, random: &mut Random) -> Light {
    let position = random.in_cube() * 2.0 + dvec3(0.0, 4.0, 2.0);
    let direction = (dvec3(0.0, 0.5, 0.0) - position).normalize();
    let kind = match kind {
        0 => LightKind::Point { position },
        1 => LightKind::Directional { direction },
        2 => LightKind::Spot {
            position,
            direction,
            inner: 0.2,
            outer: 0.6,
        },
        3 => LightKind::Rectangle {
            center: position,
            edge_u: DVec3::X * 0.5,
            edge_v: DVec3::Z * 0.5,
        },
        _ => LightKind::Sphere {
            center: position,
            radius: 0.3,
        },
    };
    Light {
        kind,
        color: Vec3::splat(0.7),
        attenuation: Attenuation::None,
        samples: 2,
        visible: random.below(2) == 0,
        node: None,
        name: String::new(),
    }
}

/// A small scene with a random subset of the features. Few of each kind are chosen, so that most scenes lack
/// most features; some have this kind of material and no other.
fn random_scene(random: &mut Random, only: Option<usize>) -> Scene {
    let mut scene = scenes::empty();
    let kinds: Vec<usize> = match only {
        Some(kind) => vec![kind],
        None => vec![random.below(MATERIALS), random.below(MATERIALS)],
    };
    scene.materials = kinds.into_iter().map(material).collect();
    let count = scene.materials.len();
    if random.below(2) == 0 {
        scene.add_plane(DVec3::ZERO, DVec3::Y, random.below(count));
    }
    for _ in 0..random.below(3) {
        let scale = DVec3::from_array([0.0; 3].map(|_| random.between(0.4, 0.8)));
        let turn = DQuat::from_axis_angle(random.direction(), random.between(0.0, 6.0));
        let place = random.in_cube() * dvec3(1.5, 0.5, 1.0) + DVec3::Y;
        let canonical = [
            CanonicalShape::Box,
            CanonicalShape::Ellipsoid,
            CanonicalShape::Torus { minor: 0.4 },
            CanonicalShape::Cone {
                bottom: 1.0,
                top: 0.3,
                capped: true,
            },
        ][random.below(4)];
        scene.shapes.push(Shape {
            geometry: Geometry::Placed {
                canonical,
                world_from_canonical: DAffine3::from_scale_rotation_translation(scale, turn, place),
            },
            material: random.below(count),
            node: None,
            name: String::new(),
        });
    }
    if scene.shapes.is_empty() || random.below(2) == 0 {
        let material = random.below(count) as u32;
        let mut mesh = match random.below(2) {
            0 => scenes::ball(UVec2::new(16, 10), material),
            _ => scenes::torus(0.9, 0.4, UVec2::new(18, 10), material),
        };
        if random.below(3) == 0 {
            for (i, material) in mesh.materials.iter_mut().enumerate() {
                *material = (i % count) as u32;
            }
        }
        let place = DAffine3::from_translation(random.in_cube() * 0.8 + DVec3::Y);
        scene.add_mesh(mesh, place * DAffine3::from_rotation_x(0.7));
    }
    for kind in 0..5 {
        if random.below(4) == 0 {
            scene.lights.push(light(kind, random));
        }
    }
    let (a, b) = (vec3(0.9, 0.8, 0.3), vec3(0.2, 0.2, 0.7));
    scene.background = match random.below(3) {
        0 => Background::Color(a),
        1 => Background::Gradient { bottom: b, top: a },
        _ => {
            let picture = Picture::opaque(2, 2, [a, b, b, a]);
            scene.pictures.push(Arc::new(picture));
            Background::Picture {
                picture: 0,
                strength: 0.8,
                rotation: 0.4,
            }
        }
    };
    if random.below(3) == 0 {
        let octaves = 2;
        scene.textures.push(Texture {
            pattern: match random.below(2) {
                0 => Pattern::Checker { a, b },
                _ => Pattern::Noise { a, b, octaves },
            },
            space: Space::World,
            pattern_from_space: DAffine3::from_scale(DVec3::splat(1.37)),
        });
        let textures = &mut scene.materials[0].classical_mut().textures;
        match random.below(2) {
            0 => textures.diffuse = Some(0),
            _ => (textures.reflect, textures.transmit) = (Some(0), Some(0)),
        }
    }
    if random.below(4) == 0 {
        scene.shadows = Shadows::Filtered;
    }
    if random.below(3) == 0 {
        scene.cameras[0].lens = Some(Lens {
            radius: 0.1,
            focus_distance: 6.0,
            blade_count: 0,
            blade_rotation: 0.0,
        });
    }
    if random.below(3) == 0 {
        let moved = random.in_cube();
        add_moving(&mut scene, moved, true);
    }
    scene
}

/// A moving ball and a moving mesh; hidden, they only make a kernel include instances, shapes and triangles.
fn add_moving(scene: &mut Scene, way: DVec3, visible: bool) {
    scene.nodes.push(Node {
        visible,
        ..Node::default()
    });
    let node = Some(scene.nodes.len() - 1);
    let target = Target::Node(scene.nodes.len() - 1, NodeProperty::Translation);
    scene
        .tracks
        .push(track(target, Values::Vector(vec![DVec3::ZERO, way])));
    scene.shapes.push(Shape {
        geometry: Geometry::Sphere {
            center: dvec3(-1.0, 2.0, -0.5),
            radius: 0.4,
        },
        material: 0,
        node,
        name: String::new(),
    });
    scene.meshes.push(scenes::quad(0.7, 0).into());
    scene.instances.push(Instance {
        mesh: scene.meshes.len() - 1,
        placement: DAffine3::from_translation(dvec3(1.2, 1.9, -0.5)),
        node,
        name: String::new(),
    });
}

/// The picture of a kernel with all features that do not affect the scene.
fn with_everything_compiled_in(scene: &Scene, settings: &RenderSettings) -> Image {
    let mut full = scene.clone();
    if full.tracks.is_empty() && full.cameras[0].lens.is_none() {
        // Too small to see. With motion, a lens changes how shutter times are sampled.
        full.cameras[0].lens = Some(Lens {
            radius: 1e-9,
            focus_distance: 6.0,
            blade_count: 0,
            blade_rotation: 0.0,
        });
    }
    add_moving(&mut full, DVec3::X, false);
    let mut packed = pack::scene(&full).expect("a packed scene");
    let features = &mut packed.features;
    features.shape_kinds = u32::MAX;
    for feature in [
        &mut features.mixed_materials,
        &mut features.reflection,
        &mut features.refraction,
        &mut features.contact,
        &mut features.priorities,
        &mut features.textures,
        &mut features.noise,
        &mut features.pictures,
        &mut features.optics_textures,
        &mut features.emission,
    ] {
        *feature = true;
    }
    assert!(features.instances);
    let mut view = packed
        .view(&full.motion_samples(0.0, 1.0))
        .expect("frames that can be packed");
    (view.has_lights, view.has_area_lights) = (true, true);
    let mut renderer = start_packed(Arc::new(packed), &view, settings);
    while !renderer.is_done() {
        renderer.step().expect("a step");
    }
    renderer.develop(&Tone::LINEAR).expect("a picture")
}

/// The picture of a kernel that lacks a feature.
fn without(scene: &Scene, feature: fn(&mut pack::SceneFeatures) -> &mut bool) -> Image {
    let mut packed = pack::scene(scene).expect("a packed scene");
    let is_on = feature(&mut packed.features);
    assert!(*is_on);
    *is_on = false;
    rendered(&Arc::new(packed), &[scene.frame(0.0)], &sized(32, 24)).0
}

#[test]
fn compiling_out_a_needed_feature_changes_the_picture() {
    type Feature = fn(&mut pack::SceneFeatures) -> &mut bool;
    let features: [(usize, Feature); 5] = [
        (2, |features| &mut features.reflection),
        (3, |features| &mut features.refraction),
        (5, |features| &mut features.reflection),
        (6, |features| &mut features.reflection),
        (7, |features| &mut features.emission),
    ];
    for (kind, feature) in features {
        let mut scene = before(0.5, material(kind));
        add_box(&mut scene, DVec3::NEG_ONE, DVec3::ONE);
        let expected = with_everything_compiled_in(&scene, &sized(32, 24));
        let lacking = without(&scene, feature);
        assert!(
            check_alike(&format!("lacking {kind}"), &expected, &lacking, 2.0, 0.005).is_err(),
            "material {kind}"
        );
    }
}

#[test]
fn compiled_out_features_do_not_affect_the_picture() {
    let rows = (0..MATERIALS + 4).map(|seed| {
        let mut random = Random::new(seed as u64);
        let scene = random_scene(&mut random, (seed < MATERIALS).then_some(seed));
        let settings = RenderSettings {
            samples: 2,
            antialias: Antialias::Stratified,
            // One for all: each filter has its own kernels.
            filter: Filter::Tent,
            max_depth: 1 + random.below(6) as u32,
            ..sized(32, 24)
        };
        let everything = with_everything_compiled_in(&scene, &settings);
        let most_baked = [0, pack::MAX_BAKED][random.below(2)];
        let packed = packed(&scene, most_baked);
        let (specialised, _) = rendered(&packed, &scene.motion_samples(0.0, 1.0), &settings);
        // If rounding moves a ray across an edge, it sees something else.
        check_alike(
            &format!("seed {seed}"),
            &everything,
            &specialised,
            2.0,
            0.005,
        )
    });
    assert_none(rows);
}

/// A floor of this material under a lamp, as paths see it.
fn lit_floor(material: Material) -> Scene {
    let mut scene = before(0.0, material);
    add_box(&mut scene, dvec3(-2.0, -1.0, -2.0), dvec3(2.0, 0.0, 2.0));
    scene.lights.push(Light {
        kind: LightKind::Rectangle {
            center: dvec3(0.0, 2.5, 0.0),
            edge_u: DVec3::X,
            edge_v: DVec3::Z,
        },
        color: Vec3::ONE,
        attenuation: Attenuation::InverseSquare,
        ..Light::default()
    });
    scene
}

#[test]
fn paths_do_not_depend_on_code_that_the_scene_does_not_need() {
    let settings = RenderSettings {
        integrator: Integrator::Path,
        samples: 4,
        max_depth: 4,
        ..sized(32, 24)
    };
    let picture = |scene: &Scene, change: fn(&mut pack::SceneFeatures)| {
        let mut packed = pack::scene(scene).expect("a packed scene");
        change(&mut packed.features);
        rendered(&Arc::new(packed), &[scene.frame(0.0)], &settings).0
    };
    let matte = lit_floor(Material::from(Phong {
        specular: Vec3::ZERO,
        ..Phong::default()
    }));
    let own = picture(&matte, |features| {
        assert!(!features.gloss && !features.metallic_roughness);
    });
    let more = picture(&matte, |features| {
        (features.gloss, features.metallic_roughness) = (true, true);
    });
    // A dark light of another kind: the kernel then chooses between kinds.
    let mut mixed = matte.clone();
    mixed.lights.push(Light {
        kind: LightKind::Point {
            position: dvec3(1.0, 2.0, 0.0),
        },
        color: Vec3::ZERO,
        ..Light::default()
    });
    let mixed = picture(&mixed, |_| {});
    let glossy = lit_floor(Material::from(Phong {
        specular: Vec3::ONE,
        ..Phong::default()
    }));
    let whole = picture(&glossy, |features| assert!(features.gloss));
    let lacking = picture(&glossy, |features| features.gloss = false);
    assert_none([
        check_alike("code for gloss", &own, &more, 0.01, 0.0),
        check_alike("code for other lights", &own, &mixed, 0.01, 0.0),
    ]);
    assert!(check_alike("without gloss", &whole, &lacking, 2.0, 0.005).is_err());
}
