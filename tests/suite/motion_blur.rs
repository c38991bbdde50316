//! Motion blur against integrals over the shutter interval.

use crate::{
    instances::rendered,
    reference::{
        compare::{check_same_bits, sized},
        scenes::{self, Build},
    },
};
use glam::{DAffine3, DQuat, DVec3, Vec3, dvec3};
use glimray::{
    image::Image,
    pack,
    render::{Antialias, Integrator, RenderSettings},
    scene::{
        Background, Beyond, Camera, CameraProperty, CanonicalShape, Curve, Easing, Geometry,
        Interpolation, Light, LightKind, LightProperty, Material, Node, NodeProperty, Phong, Scene,
        Shape, Target, Track, Values,
    },
};
use std::{f64::consts::PI, sync::Arc};

/// Size of the pictures, and half of the visible extent at the distance of the object.
pub const SIDE: u32 = 64;
pub const HALF: f64 = 1.0;
/// The distance of the camera: so far that a sphere has the size of its silhouette, to a thousandth.
pub const DISTANCE: f64 = 60.0;

/// An empty black scene, seen from far away along −z; x and y of −1 and 1 are the edges of the picture.
pub fn stage() -> Scene {
    Scene {
        cameras: vec![Camera {
            look_from: dvec3(0.0, 0.0, DISTANCE),
            look_at: DVec3::ZERO,
            fov_y: 2.0 * (HALF / DISTANCE).atan(),
            ..Camera::default()
        }],
        materials: vec![Material {
            emission: Vec3::ONE,
            bsdf: Phong {
                diffuse: Vec3::ZERO,
                ambient: Vec3::ZERO,
                ..Phong::default()
            }
            .into(),
            ..Material::default()
        }],
        background: Background::Color(Vec3::ZERO),
        ..Scene::default()
    }
}

pub fn track(target: Target, values: Values) -> Track {
    let count = match &values {
        Values::Scalar(values) => values.len(),
        Values::Vector(values) => values.len(),
        Values::Rotation(values) => values.len(),
    };
    Track {
        targets: vec![target],
        curve: Curve {
            times: (0..count).map(|i| i as f64 / (count - 1) as f64).collect(),
            values,
            interpolation: Interpolation::Linear,
            easing: Easing::None,
            beyond: Beyond::Hold,
        },
    }
}

/// A glowing shape on a node of its own.
pub fn carried(geometry: Geometry) -> Scene {
    let mut scene = stage();
    scene.nodes.push(Node::default());
    scene.shapes.push(Shape {
        geometry,
        material: 0,
        node: Some(0),
        name: String::new(),
    });
    scene
}

pub fn blurred(samples: u32) -> RenderSettings {
    RenderSettings {
        samples,
        antialias: Antialias::Stratified,
        ..sized(SIDE, SIDE)
    }
}

/// The picture with the shutter open from time 0 to 1.
pub fn exposed(scene: &Scene, settings: &RenderSettings) -> Image {
    let packed = Arc::new(pack::scene(scene).expect("a scene that can be packed"));
    rendered(&packed, &scene.motion_samples(0.0, 1.0), settings).0
}

/// Mean of the red channel of some pixels.
pub fn mean(image: &Image, pixels: impl Iterator<Item = (u32, u32)>) -> f64 {
    let values = pixels.map(|(x, y)| f64::from(image.pixels[(y * image.width + x) as usize][0]));
    let (sum, count) = values.fold((0.0, 0), |(sum, count), value| (sum + value, count + 1));
    sum / f64::from(count)
}

/// The scene position of the centre of a column or row of pixels.
pub fn place(index: u32) -> f64 {
    (2.0 * (f64::from(index) + 0.5) / f64::from(SIDE) - 1.0) * HALF
}

#[test]
fn a_sphere_that_crosses_the_picture_covers_it_as_its_profile_says() {
    let radius = 0.3;
    let mut scene = carried(Geometry::Sphere {
        center: DVec3::ZERO,
        radius,
    });
    let (from, to) = (-0.5, 0.5);
    let way = vec![dvec3(from, 0.0, 0.0), dvec3(to, 0.0, 0.0)];
    let target = Target::Node(0, NodeProperty::Translation);
    scene.tracks.push(track(target, Values::Vector(way)));
    for integrator in [Integrator::Whitted, Integrator::Path] {
        let image = exposed(
            &scene,
            &RenderSettings {
                integrator,
                ..blurred(1024)
            },
        );
        check_profile(&image, radius, (from, to));
    }
}

/// A picture of a glowing sphere of this radius that crosses it along x.
fn check_profile(image: &Image, radius: f64, (from, to): (f64, f64)) {
    // A point at (x, y) is covered while the centre is within half of the chord.
    let covered = |x: f64, y: f64| {
        let half = (radius * radius - y * y).max(0.0).sqrt();
        ((x + half).min(to) - (x - half).max(from)).max(0.0) / (to - from)
    };
    let mut worst = 0.0_f64;
    for y in 0..SIDE {
        for x in 0..SIDE {
            // The mean over the pixel, by 16 × 16 points.
            let step = |i: u32| (f64::from(i) + 0.5) / 16.0 - 0.5;
            let pixel = 2.0 * HALF / f64::from(SIDE);
            let points = (0..256).map(|i| {
                let (dx, dy) = (step(i % 16) * pixel, step(i / 16) * pixel);
                covered(place(x) + dx, place(y) + dy)
            });
            let expected = points.sum::<f64>() / 256.0;
            let actual = mean(image, [(x, y)].into_iter());
            worst = worst.max((actual - expected).abs());
        }
    }
    assert!(worst < 0.01, "{worst} off");
    // All of its light is there: the fraction of the picture that its silhouette covers.
    let energy = mean(image, (0..SIDE * SIDE).map(|i| (i % SIDE, i / SIDE)));
    let expected = PI * radius * radius / (4.0 * HALF * HALF);
    assert!(
        (energy / expected - 1.0).abs() < 0.005,
        "{energy} for {expected}"
    );
}

#[test]
fn a_disc_that_turns_about_a_point_beside_it_is_an_annulus_and_does_not_shrink() {
    let (arm, radius) = (0.6, 0.15);
    let mut scene = carried(Geometry::Placed {
        canonical: CanonicalShape::Disc { hole: 0.0 },
        world_from_canonical: DAffine3::from_scale_rotation_translation(
            DVec3::splat(radius),
            DQuat::from_rotation_x(PI / 2.0),
            dvec3(arm, 0.0, 0.0),
        ),
    });
    let turn = vec![DVec3::ZERO, dvec3(0.0, 0.0, 2.0 * PI)];
    let target = Target::Node(0, NodeProperty::Angles);
    scene.tracks.push(track(target, Values::Vector(turn)));
    let image = exposed(&scene, &blurred(256));
    // At distance r from the pivot, the fraction of the circle inside the disc.
    let covered = |r: f64| {
        let cos = (r * r + arm * arm - radius * radius) / (2.0 * r * arm);
        cos.clamp(-1.0, 1.0).acos() / PI
    };
    for ring in 0..12 {
        let (inner, outer) = (0.3 + 0.05 * f64::from(ring), 0.35 + 0.05 * f64::from(ring));
        let pixels: Vec<_> = (0..SIDE * SIDE)
            .map(|i| (i % SIDE, i / SIDE))
            .filter(|&(x, y)| (inner..outer).contains(&place(x).hypot(place(y))))
            .collect();
        // The mean over the same pixels, each by 8 × 8 points.
        let pixel = 2.0 * HALF / f64::from(SIDE);
        let step = |i: u32| ((f64::from(i) + 0.5) / 8.0 - 0.5) * pixel;
        let points = pixels.iter().flat_map(|&(x, y)| {
            (0..64).map(move |i| (place(x) + step(i % 8)).hypot(place(y) + step(i / 8)))
        });
        let expected = points.map(covered).sum::<f64>() / (64 * pixels.len()) as f64;
        let actual = mean(&image, pixels.into_iter());
        assert!(
            (actual - expected).abs() < 0.01,
            "{inner}: {actual}, not {expected}"
        );
    }
}

#[test]
fn a_camera_that_moves_blurs_as_an_object_that_moves_the_other_way() {
    let shape = Geometry::Placed {
        canonical: CanonicalShape::Box,
        world_from_canonical: DAffine3::from_scale_rotation_translation(
            dvec3(0.3, 0.2, 0.1),
            DQuat::from_euler(glam::EulerRot::XYZ, 0.4, 0.5, 0.6),
            DVec3::ZERO,
        ),
    };
    let step = dvec3(0.7, 0.3, 0.0);
    let mut object = carried(shape);
    object.materials[0] = Material::default();
    object.ambient = Vec3::splat(0.2);
    object.lights.push(Light {
        kind: LightKind::Directional {
            direction: dvec3(-1.0, -2.0, -1.5).normalize(),
        },
        color: Vec3::ONE,
        ..Light::default()
    });
    let mut camera = object.clone();
    let target = Target::Node(0, NodeProperty::Translation);
    object
        .tracks
        .push(track(target, Values::Vector(vec![-step, step])));
    camera.nodes.clear();
    camera.shapes[0].node = None;
    for (property, rest) in [
        (CameraProperty::LookFrom, camera.cameras[0].look_from),
        (CameraProperty::LookAt, camera.cameras[0].look_at),
    ] {
        let values = Values::Vector(vec![rest + step, rest - step]);
        camera
            .tracks
            .push(track(Target::Camera(0, property), values));
    }
    let settings = blurred(64);
    let (object, camera) = (exposed(&object, &settings), exposed(&camera, &settings));
    let pairs = object.pixels.iter().zip(&camera.pixels);
    let worst = pairs.map(|(a, b)| (a[0] - b[0]).abs()).fold(0.0, f32::max);
    assert!(worst < 0.02, "{worst} off");
    let lit = object.pixels.iter().filter(|pixel| pixel[0] > 0.01).count();
    assert!(lit > 500, "{lit} pixels lit");
}

#[test]
fn a_light_that_moves_leaves_the_mean_of_its_places() {
    let mut scene = stage();
    scene.materials[0] = Material::default();
    scene.add_plane(DVec3::ZERO, DVec3::Z, 0);
    scene.lights.push(Light {
        kind: LightKind::Point {
            position: dvec3(0.0, 0.0, 1.0),
        },
        color: Vec3::ONE,
        ..Light::default()
    });
    let (from, to) = (-2.0, 2.0);
    let way = vec![dvec3(from, 0.0, 1.0), dvec3(to, 0.0, 1.0)];
    let target = Target::Light(0, LightProperty::Position);
    scene.tracks.push(track(target, Values::Vector(way)));
    let image = exposed(&scene, &blurred(64));
    let diffuse = f64::from(scene.materials[0].classical().diffuse.x);
    // ∫ 1/√(1 + y² + (x − s)²) ds over the path: the cosine at a lamp of height 1.
    let expected = |x: f64, y: f64| {
        let height = (1.0 + y * y).sqrt();
        let to_end = |s: f64| ((s - x) / height).asinh();
        diffuse * (to_end(to) - to_end(from)) / (to - from)
    };
    for (x, y) in [(8, 8), (32, 32), (60, 20), (10, 50)] {
        let actual = mean(&image, [(x, y)].into_iter());
        let expected = expected(place(x), place(y));
        assert!(
            (actual / expected - 1.0).abs() < 0.01,
            "{x} {y}: {actual}, not {expected}"
        );
    }
}

#[test]
fn a_scene_in_which_nothing_moves_is_the_same_bit_for_bit_with_an_open_shutter() {
    let mut scene = scenes::everything();
    let settings = RenderSettings {
        samples: 4,
        antialias: Antialias::Stratified,
        ..sized(48, 36)
    };
    // A track that moves nothing while the shutter is open.
    scene.nodes.push(Node::default());
    let values = Values::Vector(vec![DVec3::ONE; 2]);
    let target = Target::Node(0, NodeProperty::Scale);
    scene.tracks.push(track(target, values));
    let packed = Arc::new(pack::scene(&scene).expect("a scene that can be packed"));
    let (still, _) = rendered(&packed, &[scene.frame(0.0)], &settings);
    let (open, _) = rendered(&packed, &scene.motion_samples(0.0, 1.0), &settings);
    check_same_bits("open shutter", &still, &open).unwrap_or_else(|problem| panic!("{problem}"));
}

#[test]
fn boxes_that_follow_the_movement_lose_nothing() {
    // Shapes that tumble, swing and grow, against testing every primitive.
    let mut scene = scenes::empty();
    let material = scene.add_material(scenes::shiny(Vec3::splat(0.7)));
    let torus = scenes::torus(0.7, 0.3, glam::UVec2::new(16, 8), material as u32);
    scene.meshes.push(torus.into());
    for i in 0..12 {
        let phase = f64::from(i);
        scene.nodes.push(Node::default());
        let node = Some(i as usize);
        let at = dvec3(
            phase.sin() * 2.2,
            1.0 + (2.0 * phase).cos() * 0.7,
            (3.0 * phase).sin(),
        );
        let placement = DAffine3::from_scale_rotation_translation(
            dvec3(0.3, 0.5, if i % 4 == 0 { -0.4 } else { 0.4 }),
            DQuat::from_rotation_x(phase),
            at * 0.3,
        );
        if i % 2 == 0 {
            let mesh = 0;
            scene.instances.push(glimray::scene::Instance {
                mesh,
                placement,
                node,
                name: String::new(),
            });
        } else {
            scene.shapes.push(Shape {
                geometry: Geometry::Placed {
                    canonical: CanonicalShape::Cone {
                        bottom: 0.8,
                        top: 0.2,
                        capped: true,
                    },
                    world_from_canonical: placement,
                },
                material,
                node,
                name: String::new(),
            });
        }
        let index = i as usize;
        let way = vec![at * 0.7, at * 0.7 + dvec3(0.5, 0.4 * phase.cos(), 0.0)];
        let turn = vec![DVec3::ZERO, dvec3(phase, 2.0, 1.0 - phase)];
        let size = vec![DVec3::ONE, dvec3(1.3, 0.7, 1.1)];
        for (property, values) in [
            (NodeProperty::Translation, way),
            (NodeProperty::Angles, turn),
            (NodeProperty::Scale, size),
        ] {
            let target = Target::Node(index, property);
            scene.tracks.push(track(target, Values::Vector(values)));
        }
    }
    scene.add_plane(dvec3(0.0, -0.5, 0.0), DVec3::Y, 0);
    scene.add_point_light(dvec3(3.0, 5.0, 4.0), 0.7);
    let packed = Arc::new(pack::scene(&scene).expect("a scene that can be packed"));
    let frames = scene.motion_samples(0.0, 1.0);
    let settings = RenderSettings {
        samples: 8,
        antialias: Antialias::Stratified,
        ..sized(96, 72)
    };
    let brute_force = RenderSettings {
        brute_force: true,
        ..settings.clone()
    };
    let (tree, _) = rendered(&packed, &frames, &settings);
    let (every, _) = rendered(&packed, &frames, &brute_force);
    check_same_bits("moving tree", &every, &tree).unwrap_or_else(|problem| panic!("{problem}"));
}

#[test]
fn a_box_that_turns_by_180_degrees_is_hit_along_its_whole_path() {
    let cube = Geometry::Placed {
        canonical: CanonicalShape::Box,
        world_from_canonical: DAffine3::from_scale(DVec3::splat(0.6)),
    };
    let mut scene = carried(cube);
    let half = DQuat::from_rotation_z(PI);
    let target = Target::Node(0, NodeProperty::Rotation);
    (scene.tracks).push(track(target, Values::Rotation(vec![DQuat::IDENTITY, half])));
    let packed = Arc::new(pack::scene(&scene).expect("a scene that can be packed"));
    let frames = [scene.frame(0.0), scene.frame(1.0)];
    let settings = blurred(16);
    let brute_force = RenderSettings {
        brute_force: true,
        ..settings.clone()
    };
    let (tree, _) = rendered(&packed, &frames, &settings);
    let (every, _) = rendered(&packed, &frames, &brute_force);
    check_same_bits("half a turn", &every, &tree).unwrap_or_else(|problem| panic!("{problem}"));
    // The box's corners reach √2 as far as its sides, where there is nothing without the rotation.
    let (corner, ..) = (0..SIDE)
        .map(|x| (x, mean(&every, [(x, SIDE / 2)].into_iter())))
        .find(|(_, value)| *value > 0.0)
        .expect("a picture of it");
    assert!(place(corner) < -0.6 * 1.3, "{}", place(corner));
}
