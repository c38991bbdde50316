//! Whole moving pictures: against the independent tracer, against the mean of their moments, and against
//! themselves rendered in other ways.

use crate::{
    instances::{crowd, glass, mirror, packed, rendered},
    motion_blur::track,
    reference::{
        compare::{
            assert_none, check_alike, check_same_bits, counting, fetched, sized, sliced,
            start_packed,
        },
        scenes::{self, Build},
        trace_at,
    },
    render::slicings,
};
use glam::{DAffine3, DVec3, UVec2, Vec3, dvec3, vec3};
use glimray::{
    image::Image,
    pack::{self, PackedScene},
    render::{Antialias, Fetch, Integrator, RenderSettings, Tone},
    scene::{
        Attenuation, Background, Camera, CameraProperty, CanonicalShape, Fresnel, Geometry,
        Instance, Lens, Light, LightKind, LightProperty, Material, Node, NodeProperty, Pattern,
        Phong, Scene, Shape, Space, Target, Texture, Values,
    },
};
use std::{f64::consts::TAU, sync::Arc};

fn moves(scene: &mut Scene, node: usize, property: NodeProperty, values: &[DVec3]) {
    let target = Target::Node(node, property);
    scene
        .tracks
        .push(track(target, Values::Vector(values.to_vec())));
}

fn node(scene: &mut Scene, node: Node) -> usize {
    scene.nodes.push(node);
    scene.nodes.len() - 1
}

fn under(parent: usize) -> Node {
    Node {
        parent: Some(parent),
        ..Node::default()
    }
}

/// Objects that move in every way for one second over a patterned floor: meshes and shapes with patterns on
/// nodes, nested nodes, non-uniform and mirrored scales, and an object that appears and disappears.
fn fair() -> Scene {
    let mut scene = scenes::empty();
    let pattern = |pattern, size: f64| Texture {
        pattern,
        space: Space::World,
        pattern_from_space: DAffine3::from_scale(DVec3::splat(size)),
    };
    let (a, b) = (vec3(0.9, 0.8, 0.3), vec3(0.2, 0.2, 0.7));
    scene.textures = vec![
        pattern(Pattern::Checker { a, b }, 1.37),
        pattern(Pattern::Stripes { a: b, b: a }, 2.3),
        pattern(Pattern::Noise { a, b, octaves: 3 }, 2.1),
    ];
    let mut patterned = |texture: usize| {
        let mut material = scenes::shiny(Vec3::splat(0.9));
        material.classical_mut().textures.diffuse = Some(texture);
        material.classical_mut().textures.ambient = Some(texture);
        scene.add_material(material)
    };
    let [checkered, striped, cloudy] = [0, 1, 2].map(&mut patterned);
    scene.add_plane(dvec3(0.0, -0.31, 0.0), DVec3::Y, checkered);

    let carousel = node(&mut scene, Node::default());
    moves(
        &mut scene,
        carousel,
        NodeProperty::Angles,
        &[DVec3::ZERO, dvec3(0.0, 4.0, 0.0)],
    );
    // Non-uniform scale above a rotation: it shears.
    let horse = node(
        &mut scene,
        Node {
            placement: DAffine3::from_translation(dvec3(1.4, 0.6, 0.0)),
            scale: dvec3(0.7, 1.3, 0.5),
            ..under(carousel)
        },
    );
    moves(
        &mut scene,
        horse,
        NodeProperty::Translation,
        &[DVec3::ZERO, DVec3::Y * 0.5, DVec3::ZERO],
    );
    let rider = node(&mut scene, under(horse));
    moves(
        &mut scene,
        rider,
        NodeProperty::Angles,
        &[DVec3::ZERO, dvec3(1.0, 2.0, 0.5)],
    );
    scene
        .meshes
        .push(scenes::torus(0.5, 0.22, UVec2::new(20, 10), striped as u32).into());
    scene.instances.push(Instance {
        mesh: 0,
        placement: DAffine3::from_rotation_x(0.6),
        node: Some(rider),
        name: String::new(),
    });
    // Another instance of the mesh, mirrored and growing.
    let other = node(
        &mut scene,
        Node {
            placement: DAffine3::from_translation(dvec3(-1.3, 0.8, 0.2)),
            scale: dvec3(-1.0, 1.0, 1.0),
            ..under(carousel)
        },
    );
    moves(
        &mut scene,
        other,
        NodeProperty::Scale,
        &[dvec3(-1.0, 1.0, 1.0), dvec3(-0.6, 1.5, 0.9)],
    );
    scene.instances.push(Instance {
        mesh: 0,
        placement: DAffine3::from_rotation_x(1.1),
        node: Some(other),
        name: String::new(),
    });

    let shape = |scene: &mut Scene, geometry, material, node| {
        scene.shapes.push(Shape {
            geometry,
            material,
            node: Some(node),
            name: String::new(),
        });
    };
    let flier = node(&mut scene, Node::default());
    moves(
        &mut scene,
        flier,
        NodeProperty::Translation,
        &[dvec3(-2.0, 1.9, 0.0), dvec3(1.8, 1.6, 0.4)],
    );
    moves(
        &mut scene,
        flier,
        NodeProperty::Angles,
        &[DVec3::ZERO, dvec3(0.5, -1.0, 2.0)],
    );
    let sphere = Geometry::Sphere {
        center: DVec3::ZERO,
        radius: 0.45,
    };
    shape(&mut scene, sphere, cloudy, flier);
    let cone = Geometry::Placed {
        canonical: CanonicalShape::Cone {
            bottom: 0.4,
            top: 0.0,
            capped: true,
        },
        world_from_canonical: DAffine3::from_translation(dvec3(0.0, 0.4, 0.0)),
    };
    shape(&mut scene, cone, striped, flier);
    let crate_node = node(&mut scene, Node::default());
    moves(
        &mut scene,
        crate_node,
        NodeProperty::Translation,
        &[dvec3(0.0, 0.1, 1.2), dvec3(0.9, 0.1, 1.6)],
    );
    moves(
        &mut scene,
        crate_node,
        NodeProperty::Scale,
        &[DVec3::splat(0.3), dvec3(0.5, 0.2, 0.3)],
    );
    let cube = Geometry::Placed {
        canonical: CanonicalShape::Box,
        world_from_canonical: DAffine3::IDENTITY,
    };
    shape(&mut scene, cube, checkered, crate_node);
    scene.add_point_light(dvec3(3.0, 5.0, 4.0), 0.6);
    scene
}

/// Moving mirrors and glass, with the camera inside one of them.
fn glassware() -> Scene {
    let mut scene = scenes::mirrors_and_glass();
    for i in 1..scene.shapes.len() {
        let carrier = node(&mut scene, Node::default());
        let phase = i as f64;
        let way = dvec3(phase.sin(), 0.4 * (2.0 * phase).cos().abs(), phase.cos()) * 0.5;
        moves(
            &mut scene,
            carrier,
            NodeProperty::Translation,
            &[DVec3::ZERO, way],
        );
        if i % 2 == 0 {
            moves(
                &mut scene,
                carrier,
                NodeProperty::Scale,
                &[DVec3::ONE, dvec3(0.8, 1.1, 0.9)],
            );
        }
        scene.shapes[i].node = Some(carrier);
    }
    scene
}

/// Visible lamps that move with nodes, rotate, and move by themselves.
fn lamps() -> Scene {
    let mut scene = scenes::spheres();
    scene.lights.clear();
    let carrier = node(&mut scene, Node::default());
    moves(
        &mut scene,
        carrier,
        NodeProperty::Translation,
        &[dvec3(-1.5, 2.2, 1.0), dvec3(1.2, 2.6, 0.8)],
    );
    moves(
        &mut scene,
        carrier,
        NodeProperty::Angles,
        &[DVec3::ZERO, dvec3(0.7, 0.0, -0.9)],
    );
    let area = |kind, color: Vec3, node| Light {
        kind,
        color,
        attenuation: Attenuation::InverseSquare,
        samples: 64,
        visible: true,
        node,
        name: String::new(),
    };
    scene.lights.push(area(
        LightKind::Rectangle {
            center: DVec3::ZERO,
            edge_u: dvec3(0.3, 0.0, 0.0),
            edge_v: dvec3(0.0, 0.0, -0.4),
        },
        vec3(2.4, 1.8, 1.2),
        Some(carrier),
    ));
    scene.lights.push(area(
        LightKind::Sphere {
            center: DVec3::ZERO,
            radius: 0.3,
        },
        vec3(0.6, 0.9, 1.5),
        None,
    ));
    let target = Target::Light(1, LightProperty::Position);
    let way = vec![dvec3(2.2, 2.0, 0.5), dvec3(-2.0, 1.9, 1.2)];
    scene.tracks.push(track(target, Values::Vector(way)));
    // Static and fading: the trail of a lamp that moves as well has uniform brightness.
    scene.lights.push(area(
        LightKind::Disc {
            center: dvec3(0.4, 2.8, -0.5),
            normal: dvec3(0.0, -0.3, 1.0).normalize(),
            radius: 0.35,
        },
        vec3(0.6, 0.5, 0.1),
        None,
    ));
    let target = Target::Light(2, LightProperty::Intensity);
    scene
        .tracks
        .push(track(target, Values::Scalar(vec![1.0, 0.3])));
    scene
}

/// A camera on nested moving nodes, with a volume next to it.
fn ride() -> Scene {
    let mut scene = fair();
    let cart = node(&mut scene, Node::default());
    moves(
        &mut scene,
        cart,
        NodeProperty::Translation,
        &[dvec3(0.0, 0.3, 5.5), dvec3(1.5, 1.0, 4.8)],
    );
    moves(
        &mut scene,
        cart,
        NodeProperty::Angles,
        &[DVec3::ZERO, dvec3(-0.1, 0.35, 0.2)],
    );
    let seat = node(&mut scene, under(cart));
    scene.cameras = vec![Camera {
        look_from: dvec3(0.0, 1.2, 0.5),
        look_at: dvec3(0.0, 0.2, -5.5),
        fov_y: 0.8,
        node: Some(seat),
        ..Camera::default()
    }];
    let target = Target::Camera(0, CameraProperty::FovY);
    scene
        .tracks
        .push(track(target, Values::Scalar(vec![0.8, 0.65])));
    scene.shapes.push(Shape {
        geometry: Geometry::Sphere {
            center: dvec3(-0.9, 0.6, -2.5),
            radius: 0.35,
        },
        material: 0,
        node: Some(seat),
        name: String::new(),
    });
    scene
}

#[test]
fn moments_of_moving_scenes_match_an_independent_tracer() {
    let rows: [(&str, Scene, u32, u32); 4] = [
        ("carried meshes and shapes", fair(), 128, 1),
        ("carried mirrors and glass", glassware(), 128, 1),
        ("lamps that move", lamps(), 48, 16),
        ("a carried camera", ride(), 128, 1),
    ];
    assert_none(rows.into_iter().flat_map(|(name, scene, width, samples)| {
        let settings = RenderSettings {
            samples,
            max_depth: scene.output.max_depth,
            ..sized(width, width * 3 / 4)
        };
        let packed = Arc::new(pack::scene(&scene).expect("a scene that can be packed"));
        assert!(packed.instance_count() > 0, "{name}");
        [0.0, 0.37, 1.0].map(|time| {
            let expected = trace_at(&scene, time, settings.size).image;
            let (actual, _) = rendered(&packed, &[scene.frame(time)], &settings);
            // Small pictures have relatively many pixels on edges.
            check_alike(&format!("{name} at {time}"), &expected, &actual, 2.0, 0.002)
        })
    }));
}

fn stratified(samples: u32, (width, height): (u32, u32)) -> RenderSettings {
    RenderSettings {
        samples,
        antialias: Antialias::Stratified,
        ..sized(width, height)
    }
}

/// The mean of this many moments of a second, each a picture without blur.
fn mean_of_moments(
    scene: &Scene,
    packed: &Arc<PackedScene>,
    count: u32,
    settings: &RenderSettings,
) -> Image {
    let view = |i: u32| {
        let time = (f64::from(i) + 0.5) / f64::from(count);
        packed.frame(&scene.frame(time)).expect("a frame")
    };
    let mut renderer = start_packed(packed.clone(), &view(0), settings);
    let (width, height) = settings.size;
    let mut sum = Image::new(width, height);
    for i in 0..count {
        if i > 0 {
            renderer.set_frame(&view(i)).expect("a frame");
        }
        while !renderer.is_done() {
            renderer.step().expect("a step");
        }
        let moment = renderer.develop(&Tone::LINEAR).expect("a picture");
        for (sum, pixel) in sum.pixels.iter_mut().zip(&moment.pixels) {
            for (sum, c) in sum.iter_mut().zip(pixel) {
                *sum += c / count as f32;
            }
        }
    }
    sum
}

/// The mean colour difference relative to the mean of `a`, and the root mean squared difference.
fn difference(a: &Image, b: &Image) -> (f64, f64) {
    let channels = |image: &Image| -> Vec<f64> {
        let colors = image.pixels.iter().flat_map(|pixel| &pixel[..3]);
        colors.map(|c| f64::from(*c)).collect()
    };
    let (a, b) = (channels(a), channels(b));
    let count = a.len() as f64;
    let pairs = || a.iter().zip(&b).map(|(a, b)| a - b);
    (
        pairs().sum::<f64>() / a.iter().sum::<f64>(),
        (pairs().map(|d| d * d).sum::<f64>() / count).sqrt(),
    )
}

#[test]
fn an_open_shutter_gives_the_mean_of_its_moments() {
    let mut lens = ride();
    lens.cameras[0].lens = Some(Lens {
        radius: 0.12,
        focus_distance: 5.0,
        blade_count: 6,
        blade_rotation: 0.2,
    });
    let target = Target::Camera(0, CameraProperty::FocusDistance);
    lens.tracks
        .push(track(target, Values::Scalar(vec![5.0, 3.5])));
    let rows = [
        ("carried meshes and shapes", fair()),
        ("mirrors and glass", glassware()),
        ("lamps", lamps()),
        ("a carried camera with a lens", lens),
    ];
    let size = (48, 36);
    for (name, mut scene) in rows {
        for light in &mut scene.lights {
            light.samples = 4;
        }
        let packed = Arc::new(pack::scene(&scene).expect("a scene that can be packed"));
        let frames = scene.motion_samples(0.0, 1.0);
        let (blurred, stats) = rendered(&packed, &frames, &stratified(256, size));
        assert_eq!(stats.nonfinite_samples, 0, "{name}");
        let other = RenderSettings {
            seed: 5,
            ..stratified(8, size)
        };
        let expected = mean_of_moments(&scene, &packed, 32, &other);
        // Relative to the brightness of the picture: lamps are much brighter than the surfaces they light.
        let (_, strength) = difference(&expected, &Image::new(size.0, size.1));
        let (bias, rmse) = difference(&blurred, &expected);
        let rmse = rmse / strength;
        assert!(
            bias.abs() < 0.005 && rmse < 0.05,
            "{name}: bias {bias}, RMSE {rmse}"
        );
        // A single moment is a different picture.
        let (sharp, _) = rendered(&packed, &[scene.frame(0.0)], &stratified(16, size));
        let sharp = difference(&sharp, &expected).1 / strength;
        assert!(sharp > 3.0 * rmse, "{name}: RMSE {rmse} and {sharp}");
    }
}

/// Everything that samples can depend on at once, in a small scene.
fn busy() -> (Arc<PackedScene>, Vec<glimray::scene::Frame>) {
    let mut scene = ride();
    scene.cameras[0].lens = Some(Lens {
        radius: 0.05,
        focus_distance: 5.0,
        blade_count: 0,
        blade_rotation: 0.0,
    });
    scene.materials[1].classical_mut().reflect = Vec3::splat(0.3);
    scene
        .lights
        .extend(lamps().lights.into_iter().skip(1).map(|light| Light {
            samples: 2,
            ..light
        }));
    let target = Target::Light(1, LightProperty::Position);
    let way = vec![dvec3(2.2, 2.0, 0.5), dvec3(-2.0, 1.9, 1.2)];
    scene.tracks.push(track(target, Values::Vector(way)));
    let frames = scene.motion_samples(0.2, 0.6);
    (Arc::new(pack::scene(&scene).expect("packed")), frames)
}

#[test]
fn the_cut_of_the_work_does_not_show_in_blurred_pictures() {
    let (packed, frames) = busy();
    let base = stratified(6, (37, 27));
    let (expected, stats) = rendered(&packed, &frames, &counting(&base));
    let other = RenderSettings {
        seed: 1,
        ..base.clone()
    };
    assert!(
        rendered(&packed, &frames, &other).0 != expected,
        "nothing is drawn"
    );
    // Every second one: each needs a shader to be compiled.
    assert_none(slicings().into_iter().step_by(2).map(|(name, slicing)| {
        let (actual, cut) = rendered(&packed, &frames, &sliced(&base, slicing));
        assert_eq!(cut.rays, stats.rays, "{name}");
        check_same_bits(name, &expected, &actual)
    }));
}

#[test]
fn two_runs_images_buffers_and_crops_give_the_same_blur() {
    let (packed, frames) = busy();
    let base = stratified(4, (48, 36));
    let with = |fetch| fetched(&base, fetch);
    let (expected, _) = rendered(&packed, &frames, &with(Fetch::Image));
    let (again, _) = rendered(&packed, &frames, &with(Fetch::Image));
    let (buffers, _) = rendered(&packed, &frames, &with(Fetch::Buffer));
    let crop = RenderSettings {
        crop: Some([11, 5, 40, 30]),
        ..base.clone()
    };
    let (part, _) = rendered(&packed, &frames, &crop);
    let mut cut = Image::new(29, 25);
    for (i, pixel) in cut.pixels.iter_mut().enumerate() {
        *pixel = expected.pixels[(5 + i / 29) * 48 + 11 + i % 29];
    }
    assert_none([
        check_same_bits("again", &expected, &again),
        check_same_bits("buffers", &expected, &buffers),
        check_same_bits("crop", &cut, &part),
    ]);
}

#[test]
fn adaptive_sampling_spends_more_on_blur_and_comes_near_the_converged_picture() {
    // A bright ball that crosses the left half; the one on the right is static.
    let mut scene = scenes::empty();
    scene.background = Background::Color(Vec3::splat(0.1));
    let glow = scene.add_material(Material {
        emission: Vec3::ONE,
        ..Material::default()
    });
    let carrier = node(&mut scene, Node::default());
    moves(
        &mut scene,
        carrier,
        NodeProperty::Translation,
        &[dvec3(-2.4, -1.0, 0.0), dvec3(-0.6, 2.0, 0.0)],
    );
    scene.shapes.push(Shape {
        geometry: Geometry::Sphere {
            center: DVec3::ZERO,
            radius: 0.3,
        },
        material: glow,
        node: Some(carrier),
        name: String::new(),
    });
    scene.add_sphere(dvec3(1.6, 0.5, 0.0), 0.5, 0);
    scene.add_point_light(dvec3(3.0, 5.0, 4.0), 0.7);
    let packed = Arc::new(pack::scene(&scene).expect("packed"));
    let frames = scene.motion_samples(0.0, 1.0);
    let size = (64, 48);
    let (converged, _) = rendered(&packed, &frames, &stratified(512, size));
    let adaptive = RenderSettings {
        antialias: Antialias::Adaptive,
        noise: 0.01,
        ..stratified(256, size)
    };
    let (picture, stats) = rendered(&packed, &frames, &adaptive);
    let (bias, rmse) = difference(&picture, &converged);
    assert!(bias.abs() < 0.01 && rmse < 0.02, "bias {bias}, RMSE {rmse}");
    assert_eq!(stats.nonfinite_samples, 0);
    let spent = RenderSettings {
        integrator: Integrator::Samples,
        ..adaptive
    };
    let (spent, _) = rendered(&packed, &frames, &spent);
    // Along its path, and in the sky above the other.
    let fraction = |columns: std::ops::Range<usize>, rows: std::ops::Range<usize>| {
        let pixels = rows.flat_map(|y| columns.clone().map(move |x| y * 64 + x));
        let values: Vec<_> = pixels.map(|i| f64::from(spent.pixels[i][0])).collect();
        values.iter().sum::<f64>() / values.len() as f64
    };
    let (blur, sky) = (fraction(14..22, 16..26), fraction(40..60, 2..12));
    assert!(blur > 4.0 * sky, "{blur} in the blur, {sky} in the sky");
}

#[test]
fn trees_of_rays_are_counted_alike_through_instances() {
    let colors = [vec3(0.8, 0.3, 0.2), vec3(0.2, 0.4, 0.8)];
    for (name, scene) in [
        ("dull", crowd(colors.map(scenes::shiny))),
        ("mirrors", crowd(colors.map(mirror))),
        ("glass", crowd([glass(), mirror(colors[1])])),
    ] {
        let settings = counting(&RenderSettings {
            max_depth: 4,
            ..sized(200, 150)
        });
        let frame = [scene.frame(0.0)];
        let [laid_out, instanced] = [usize::MAX, 0].map(|most| {
            let (_, stats) = rendered(&packed(&scene, most), &frame, &settings);
            let rays = stats.rays.expect("counted");
            [
                rays.primary,
                rays.primary_hits,
                rays.shadow,
                rays.shadow_blocked,
                rays.reflection,
                rays.reflection_hits,
                rays.refraction,
                rays.refraction_hits,
            ]
        });
        assert!(laid_out[2] > 10_000, "{name}");
        assert_eq!(laid_out[4] > 0, name != "dull");
        assert_eq!(laid_out[6] > 0, name == "glass");
        let total = laid_out.iter().step_by(2).sum::<u64>() as f64;
        for (a, b) in laid_out.iter().zip(&instanced) {
            let off = a.abs_diff(*b) as f64;
            // Rare kinds of rays are few in total.
            let allowed = 0.002 * (*a as f64).max(0.1 * total);
            assert!(off <= allowed, "{name}: {laid_out:?} and {instanced:?}");
        }
    }
}

#[test]
fn normals_and_depths_are_the_same_through_instances() {
    let colors = [vec3(0.8, 0.3, 0.2), vec3(0.2, 0.4, 0.8)];
    let scene = crowd(colors.map(scenes::shiny));
    let frame = [scene.frame(0.0)];
    for integrator in [Integrator::Normals, Integrator::Depth] {
        let settings = RenderSettings {
            integrator,
            ..sized(96, 72)
        };
        let [laid_out, instanced] =
            [usize::MAX, 0].map(|most| rendered(&packed(&scene, most), &frame, &settings).0);
        let pairs = laid_out.pixels.iter().zip(&instanced.pixels);
        let off = pairs
            .filter(|(a, b)| a.iter().zip(*b).any(|(a, b)| (a - b).abs() > 1e-3))
            .count();
        // On an edge either result is correct.
        assert!(off <= 7, "{integrator:?}: {off} pixels");
        let seen = laid_out
            .pixels
            .iter()
            .filter(|pixel| pixel[0] > 0.0)
            .count();
        assert!(seen > 3000, "{seen} pixels");
    }
}

#[test]
fn a_wheel_of_glass_does_not_show_in_a_furnace() {
    let mut scene = scenes::empty();
    scene.background = Background::Color(Vec3::ONE);
    scene.materials[0] = Material::from(Phong {
        diffuse: Vec3::ZERO,
        ambient: Vec3::ZERO,
        reflect: Vec3::ONE,
        transmit: Vec3::ONE,
        opacity: 0.0,
        ior: 1.4,
        fresnel: Fresnel::Exact,
        ..Phong::default()
    });
    let wheel = node(&mut scene, Node::default());
    moves(
        &mut scene,
        wheel,
        NodeProperty::Angles,
        &[DVec3::ZERO, dvec3(0.0, 0.0, TAU)],
    );
    for i in 0..5 {
        let (sin, cos) = (TAU * f64::from(i) / 5.0).sin_cos();
        scene.shapes.push(Shape {
            geometry: Geometry::Sphere {
                center: dvec3(cos, sin, 0.0) * 1.4,
                radius: 0.5,
            },
            material: 0,
            node: Some(wheel),
            name: String::new(),
        });
    }
    let packed = Arc::new(pack::scene(&scene).expect("packed"));
    let settings = RenderSettings {
        max_depth: 8,
        ..stratified(16, (48, 36))
    };
    let (image, stats) = rendered(&packed, &scene.motion_samples(0.0, 1.0), &settings);
    assert_eq!(stats.cut_off_trees, 0);
    let off = |pixel: &[f32; 4]| (pixel[1] - 1.0).abs();
    let worst = image.pixels.iter().map(off).fold(0.0, f32::max);
    assert!(worst < 0.02, "{worst} off");
}
