//! Everything that can move, one by one: closed forms, and static scenes with the same state.

use crate::{
    instances::{packed, rendered},
    motion_blur::{DISTANCE, HALF, SIDE, blurred, carried, exposed, mean, place, stage, track},
    reference::{
        compare::{differing, render, sized, start_packed},
        scenes::{self, Build},
    },
};
use glam::{DAffine3, DQuat, DVec3, UVec2, Vec3, dvec3, vec3};
use glimray::{
    image::Image,
    pack,
    render::{Integrator, RenderSettings, Tone},
    scene::{
        Attenuation, Background, Beyond, CanonicalShape, Curve, Easing, Fresnel, Geometry,
        Instance, Interpolation, Light, LightKind, LightProperty, Material, MaterialProperty, Node,
        NodeProperty, Pattern, Phong, Scene, Shape, Space, Target, Texture, Textures, Track,
        Values,
    },
};
use std::{f64::consts::PI, sync::Arc};

/// The pictures at several times, from one packed scene.
fn moments<const N: usize>(
    scene: &Scene,
    settings: &RenderSettings,
    times: [f64; N],
) -> [Image; N] {
    let packed = Arc::new(pack::scene(scene).expect("a scene that can be packed"));
    let view = |time| packed.frame(&scene.frame(time)).expect("a frame");
    let mut renderer = start_packed(packed.clone(), &view(times[0]), settings);
    times.map(|time| {
        renderer.set_frame(&view(time)).expect("a frame");
        while !renderer.is_done() {
            renderer.step().expect("a step");
        }
        renderer.develop(&Tone::LINEAR).expect("a picture")
    })
}

fn moves(property: NodeProperty, values: Vec<DVec3>) -> Track {
    track(Target::Node(0, property), Values::Vector(values))
}

/// On or off, from 0 and from 0.5 seconds on.
fn switch(target: Target, values: [f64; 2]) -> Track {
    Track {
        targets: vec![target],
        curve: Curve {
            times: vec![0.0, 0.5],
            values: Values::Scalar(values.to_vec()),
            interpolation: Interpolation::Step,
            easing: Easing::None,
            beyond: Beyond::Hold,
        },
    }
}

/// The red radiance of a pixel.
fn red(image: &Image, x: u32, y: u32) -> f64 {
    mean(image, [(x, y)].into_iter())
}

fn whole(image: &Image) -> f64 {
    mean(image, (0..SIDE * SIDE).map(|i| (i % SIDE, i / SIDE)))
}

/// The largest difference of any channel of two pictures.
fn furthest(a: &Image, b: &Image) -> f32 {
    let channels = |image: &Image| {
        image
            .pixels
            .clone()
            .into_iter()
            .flatten()
            .collect::<Vec<_>>()
    };
    let pairs = channels(a).into_iter().zip(channels(b));
    pairs.map(|(a, b)| (a - b).abs()).fold(0.0, f32::max)
}

/// A square facing the camera that covers a quarter of the picture.
fn facing() -> DAffine3 {
    DAffine3::from_scale_rotation_translation(
        DVec3::splat(HALF / 4.0),
        DQuat::from_rotation_x(PI / 2.0),
        DVec3::ZERO,
    )
}

#[test]
fn a_pattern_moves_with_its_node() {
    let pixel = 2.0 * HALF / f64::from(SIDE);
    let steps = (11_u32, 5_u32);
    let way = dvec3(f64::from(steps.0), -f64::from(steps.1), 0.0) * pixel;
    let shape = Geometry::Placed {
        canonical: CanonicalShape::Rectangle,
        world_from_canonical: facing(),
    };
    let mut as_shape = carried(shape);
    as_shape.textures.push(Texture {
        pattern: Pattern::Checker {
            a: vec3(1.0, 0.2, 0.1),
            b: vec3(0.1, 0.5, 1.0),
        },
        space: Space::World,
        // Cells of three pixels, with no pixel centre on an edge.
        pattern_from_space: DAffine3::from_scale(DVec3::splat(1.0 / (3.0 * pixel))),
    });
    as_shape.materials[0].textures = Textures {
        emission: Some(0),
        ..Textures::default()
    };
    as_shape
        .tracks
        .push(moves(NodeProperty::Translation, vec![DVec3::ZERO, way]));
    let mut as_mesh = as_shape.clone();
    as_mesh.shapes.clear();
    as_mesh.meshes.push(scenes::quad(2.0, 0).into());
    as_mesh.instances.push(Instance {
        mesh: 0,
        placement: facing(),
        node: Some(0),
        name: String::new(),
    });
    for (name, scene) in [("shape", as_shape), ("mesh", as_mesh)] {
        let settings = sized(SIDE, SIDE);
        let [before, after] = moments(&scene, &settings, [0.0, 1.0]);
        let mut seen = 0;
        for y in 0..SIDE - steps.1 {
            for x in 0..SIDE - steps.0 {
                let here = before.pixels[(y * SIDE + x) as usize];
                let there = after.pixels[((y + steps.1) * SIDE + x + steps.0) as usize];
                assert_eq!(here, there, "{name} at {x}, {y}");
                seen += u32::from(here[0] > 0.0);
            }
        }
        // The square is complete, and not of one colour.
        assert_eq!(seen, SIDE * SIDE / 16, "{name}");
        let dim = before.pixels.iter().filter(|pixel| pixel[0] == 0.1).count();
        assert!(
            (60..200).contains(&dim),
            "{name}: {dim} pixels of one colour"
        );
    }
}

#[test]
fn a_pattern_on_a_static_object_is_static_whatever_else_moves() {
    // Copies on a static node, next to one that moves, baked or instanced.
    let mut scene = scenes::empty();
    scene.textures.push(Texture {
        pattern: Pattern::Checker {
            a: Vec3::splat(0.1),
            b: Vec3::ONE,
        },
        space: Space::World,
        pattern_from_space: DAffine3::from_scale(DVec3::splat(3.1)),
    });
    scene.materials[0].classical_mut().textures.diffuse = Some(0);
    scene.materials[0].classical_mut().textures.ambient = Some(0);
    scene
        .meshes
        .push(scenes::ball(UVec2::new(24, 12), 0).into());
    scene.nodes = vec![
        Node {
            translation: dvec3(0.3, 0.45, 0.2),
            rotation: DQuat::from_rotation_z(0.7),
            ..Node::default()
        },
        Node::default(),
    ];
    for (x, node) in [(-1.2, 0), (0.6, 0), (1.7, 1)] {
        scene.instances.push(Instance {
            mesh: 0,
            placement: DAffine3::from_scale_rotation_translation(
                DVec3::splat(0.8),
                DQuat::IDENTITY,
                dvec3(x, 0.0, 0.0),
            ),
            node: Some(node),
            name: String::new(),
        });
    }
    let target = Target::Node(1, NodeProperty::Translation);
    let way = vec![DVec3::ZERO, DVec3::Y * 0.2];
    scene.tracks.push(track(target, Values::Vector(way)));
    scene.add_point_light(dvec3(3.0, 5.0, 4.0), 0.7);
    let settings = sized(96, 72);
    let frame = [scene.frame(0.5)];
    let (laid_out, _) = rendered(&packed(&scene, usize::MAX), &frame, &settings);
    let (placed, _) = rendered(&packed(&scene, 0), &frame, &settings);
    assert!(differing(&laid_out, &placed, 2.0) <= 10);
}

/// A visible lamp that lights a floor behind it, and nothing else.
fn lamp(visible: bool) -> Scene {
    let mut scene = stage();
    scene.materials[0] = Material::default();
    scene.add_plane(dvec3(0.0, 0.0, -1.0), DVec3::Z, 0);
    scene.lights.push(Light {
        kind: LightKind::Sphere {
            center: DVec3::ZERO,
            radius: 0.25,
        },
        color: Vec3::splat(0.5),
        attenuation: Attenuation::InverseSquare,
        samples: 1,
        visible,
        node: None,
        name: String::new(),
    });
    scene
}

#[test]
fn a_lamp_that_moves_is_seen_where_it_shines_from() {
    let (from, to) = (-0.4, 0.4);
    let mut scene = lamp(true);
    let way = vec![dvec3(0.0, from, 0.0), dvec3(0.0, to, 0.0)];
    let target = Target::Light(0, LightProperty::Position);
    scene.tracks.push(track(target, Values::Vector(way)));
    let image = exposed(&scene, &blurred(512));
    // The lamp's radiance is 0.5 / 0.25²; elsewhere the floor shows its light, which is that of a point light at
    // its centre: k_d · 0.5 · cos / d², with cos = h / d.
    let diffuse = f64::from(scene.materials[0].classical().diffuse.x);
    for (x, y) in [(32, 32), (32, 20), (28, 44), (2, 32), (60, 10), (12, 60)] {
        let (px, py) = (place(x), place(y));
        let steps = 4000;
        let sum: f64 = (0..steps)
            .map(|i| {
                let at = from + (to - from) * (f64::from(i) + 0.5) / f64::from(steps);
                // Rows count downwards.
                let off = px.hypot(-py - at);
                match off < 0.25 {
                    true => 0.5 / (0.25 * 0.25),
                    false => diffuse * 0.5 * (1.0 + off * off).powf(-1.5),
                }
            })
            .sum();
        let expected = sum / f64::from(steps);
        let actual = red(&image, x, y);
        // Within a pixel the edge of the lamp blocks some of it.
        let allowed = 0.02 * expected.max(1.0);
        assert!(
            (actual - expected).abs() < allowed,
            "{x} {y}: {actual}, not {expected}"
        );
    }
}

#[test]
fn a_lamp_is_switched_together_with_its_surface() {
    for kind in [
        LightKind::Sphere {
            center: DVec3::ZERO,
            radius: 0.25,
        },
        LightKind::Rectangle {
            center: DVec3::ZERO,
            edge_u: DVec3::X * 0.3,
            edge_v: dvec3(0.0, 0.2, 0.1),
        },
        LightKind::Disc {
            center: DVec3::ZERO,
            normal: DVec3::Z,
            radius: 0.3,
        },
    ] {
        let mut scene = lamp(true);
        // Another light, so that there is always something to see.
        scene.add_point_light(dvec3(0.5, 0.5, 3.0), 0.3);
        scene.lights[0].kind = kind;
        let settings = sized(SIDE, SIDE);
        let mut without = scene.clone();
        without.lights.remove(0);
        let (on, _) = render(&scene, &settings);
        let (off, _) = render(&without, &settings);
        assert!(furthest(&on, &off) > 1.0, "the lamp is not seen");
        let target = Target::Light(0, LightProperty::On);
        scene.tracks.push(switch(target, [0.0, 1.0]));
        let [before, after] = moments(&scene, &settings, [0.25, 0.75]);
        assert!(
            furthest(&before, &off) < 1e-6,
            "{kind:?} is there before it is on"
        );
        assert!(
            furthest(&after, &on) < 1e-4,
            "{kind:?} is not there when it is on"
        );
    }
}

#[test]
fn hidden_nodes_hide_their_shadows_and_lights() {
    let mut scene = scenes::spheres();
    let without = {
        let mut scene = scene.clone();
        scene.shapes.remove(2);
        scene
    };
    scene.nodes = vec![Node::default()];
    scene.shapes[2].node = Some(0);
    scene.lights.push(Light {
        color: Vec3::splat(0.5),
        kind: LightKind::Point {
            position: dvec3(-2.0, 3.0, 3.0),
        },
        node: Some(0),
        ..Light::default()
    });
    let with = {
        let mut scene = scene.clone();
        scene.nodes.clear();
        scene.shapes[2].node = None;
        scene.lights[2].node = None;
        scene
    };
    let target = Target::Node(0, NodeProperty::Visible);
    scene.tracks.push(switch(target, [0.0, 1.0]));
    let settings = sized(96, 72);
    let [before, after] = moments(&scene, &settings, [0.25, 0.75]);
    assert!(differing(&render(&without, &settings).0, &before, 1.0) <= 5);
    assert!(differing(&render(&with, &settings).0, &after, 1.0) <= 5);
    assert!(differing(&before, &after, 1.0) > 500);
}

/// Three balls over a floor, the middle one of this material.
fn shown(material: Material) -> Scene {
    let mut scene = scenes::spheres();
    scene.materials[2] = material;
    scene
}

fn becomes(property: MaterialProperty, values: Values) -> Track {
    track(Target::Material(2, property), values)
}

#[test]
fn materials_become_what_their_tracks_say() {
    use MaterialProperty as P;
    let plain = scenes::shiny(vec3(0.2, 0.7, 0.2));
    let glass = Material {
        bsdf: Phong {
            reflect: Vec3::ONE,
            transmit: Vec3::ONE,
            opacity: 0.0,
            ior: 1.5,
            fresnel: Fresnel::Exact,
            absorption: vec3(0.4, 0.1, 0.2),
            ..plain.classical().into_owned()
        }
        .into(),
        ..plain.clone()
    };
    let vectors = |from: Vec3, to: Vec3| Values::Vector(vec![from.as_dvec3(), to.as_dvec3()]);
    let scalars = |from: f64, to: f64| Values::Scalar(vec![from, to]);
    let (dark, bright) = (vec3(0.1, 0.3, 0.6), vec3(0.9, 0.5, 0.2));
    // At rest, the change, and the state at the end.
    type Change = fn(&mut Material);
    let rows: [(&str, &Material, P, Values, Change); 11] = [
        ("diffuse", &plain, P::Diffuse, vectors(dark, bright), |m| {
            m.classical_mut().diffuse = vec3(0.9, 0.5, 0.2)
        }),
        (
            "specular",
            &plain,
            P::Specular,
            vectors(dark, bright),
            |m| m.classical_mut().specular = vec3(0.9, 0.5, 0.2),
        ),
        ("shininess", &plain, P::Shininess, scalars(2.0, 90.0), |m| {
            m.classical_mut().shininess = 90.0
        }),
        ("ambient", &plain, P::Ambient, vectors(dark, bright), |m| {
            m.classical_mut().ambient = vec3(0.9, 0.5, 0.2)
        }),
        (
            "emission from none",
            &plain,
            P::Emission,
            vectors(Vec3::ZERO, bright),
            |m| m.emission = vec3(0.9, 0.5, 0.2),
        ),
        (
            "a mirror from none",
            &plain,
            P::Reflect,
            vectors(Vec3::ZERO, bright),
            |m| m.classical_mut().reflect = vec3(0.9, 0.5, 0.2),
        ),
        (
            "transparency from none",
            &plain,
            P::Transmit,
            vectors(Vec3::ZERO, bright),
            |m| m.classical_mut().transmit = vec3(0.9, 0.5, 0.2),
        ),
        ("opacity", &glass, P::Opacity, scalars(0.0, 0.7), |m| {
            m.classical_mut().opacity = 0.7
        }),
        (
            "index of refraction",
            &glass,
            P::Ior,
            scalars(1.5, 1.1),
            |m| m.classical_mut().ior = 1.1,
        ),
        (
            "absorption",
            &glass,
            P::Absorption,
            vectors(dark, bright),
            |m| m.classical_mut().absorption = vec3(0.9, 0.5, 0.2),
        ),
        (
            "transparency to none",
            &glass,
            P::Transmit,
            vectors(Vec3::ONE, Vec3::ZERO),
            |m| m.classical_mut().transmit = Vec3::ZERO,
        ),
    ];
    let settings = sized(96, 72);
    for (name, rest, property, values, change) in rows {
        let mut scene = shown(rest.clone());
        let mut end = scene.clone();
        change(&mut end.materials[2]);
        scene.tracks.push(becomes(property, values));
        let [start, later] = moments(&scene, &settings, [0.0, 1.0]);
        let (expected, _) = render(&end, &settings);
        let off = differing(&expected, &later, 0.5);
        assert!(
            off <= 2,
            "{name}: {off} pixels are other than if it had always been so"
        );
        let changed = differing(&start, &later, 2.0);
        assert!(changed > 20, "{name}: {changed} pixels change");
    }
}

#[test]
fn twice_the_emission_is_twice_the_radiance() {
    let mut scene = carried(Geometry::Sphere {
        center: DVec3::ZERO,
        radius: 0.5,
    });
    let values = vec![dvec3(0.3, 0.4, 0.5), dvec3(0.6, 0.8, 1.0)];
    let target = Target::Material(0, MaterialProperty::Emission);
    scene.tracks.push(track(target, Values::Vector(values)));
    let [once, twice] = moments(&scene, &sized(SIDE, SIDE), [0.0, 1.0]);
    assert!(whole(&once) > 0.05);
    for (a, b) in once.pixels.iter().zip(&twice.pixels) {
        assert_eq!([a[0], a[1], a[2]].map(|c| 2.0 * c), [b[0], b[1], b[2]]);
    }
}

#[test]
fn a_moving_camera_is_in_the_medium_around_it() {
    // Absorbing balls with an index of 1, in front of a white sky: the result is exp(-absorption · distance).
    let medium = Material::from(Phong {
        diffuse: Vec3::ZERO,
        ambient: Vec3::ZERO,
        transmit: Vec3::ONE,
        opacity: 0.0,
        ior: 1.0,
        absorption: vec3(0.5, 0.25, 0.1),
        ..Phong::default()
    });
    let mut scene = stage();
    scene.background = Background::Color(Vec3::ONE);
    scene.materials[0] = medium.clone();
    let eye = scene.cameras[0].look_from;
    scene.nodes = vec![Node::default()];
    scene.shapes.push(Shape {
        geometry: Geometry::Sphere {
            center: eye,
            radius: 2.0,
        },
        material: 0,
        node: Some(0),
        name: String::new(),
    });
    let way = vec![DVec3::ZERO, dvec3(0.0, 50.0, 0.0)];
    scene.tracks.push(moves(NodeProperty::Translation, way));
    let settings = sized(8, 8);
    let left = |way: f64| {
        medium
            .classical()
            .absorption
            .as_dvec3()
            .to_array()
            .map(|a| (-a * way).exp())
    };
    // Ray paths through the corners of the picture differ in length by one percent.
    let check = |name: &str, image: &Image, expected: [f64; 3]| {
        for pixel in &image.pixels {
            for (actual, expected) in pixel.iter().zip(expected) {
                let off = f64::from(*actual) - expected;
                assert!(
                    off.abs() <= 0.01 * expected,
                    "{name}: {pixel:?}, not {expected}"
                );
            }
        }
    };
    // From its centre; from half-way to its rim, sideways; and from outside.
    let [middle, aside, outside] = moments(&scene, &settings, [0.0, 0.02, 1.0]);
    check("in the middle", &middle, left(2.0));
    check("half-way", &aside, left(3.0_f64.sqrt()));
    check("outside", &outside, left(0.0));

    // Moved along with it: always in the centre.
    scene.cameras[0].node = Some(0);
    let [start, later] = moments(&scene, &settings, [0.0, 0.7]);
    check("carried, before", &start, left(2.0));
    check("carried, later", &later, left(2.0));

    // A ball around it that becomes transparent, with a bright object in it, straight ahead.
    scene.tracks.clear();
    scene.materials[0].classical_mut().transmit = Vec3::ZERO;
    let target = Target::Material(0, MaterialProperty::Transmit);
    let values = vec![DVec3::ZERO, DVec3::ONE];
    scene.tracks.push(track(target, Values::Vector(values)));
    let glow = scene.add_material(Material {
        emission: Vec3::ONE,
        ..Material::default()
    });
    scene.add_sphere(eye - DVec3::Z, 0.1, glow);
    let [opaque, clear] = moments(&scene, &settings, [0.0, 1.0]);
    check("in what is no medium yet", &opaque, left(0.0));
    check("in what is one by then", &clear, left(0.9));
}

#[test]
fn a_ball_that_flies_under_a_still_light_keeps_its_light() {
    let radius = 0.3;
    let ball = Geometry::Sphere {
        center: DVec3::ZERO,
        radius,
    };
    let mut scene = carried(ball);
    scene.materials[0] = Material::from(Phong {
        ambient: Vec3::ZERO,
        ..Phong::default()
    });
    scene.lights.push(Light {
        kind: LightKind::Directional {
            direction: DVec3::NEG_Z,
        },
        color: Vec3::ONE,
        ..Light::default()
    });
    // Moves back and forth and around, always in the picture, and spins.
    let way = vec![
        dvec3(-0.6, -0.5, 0.0),
        dvec3(0.6, -0.1, 0.0),
        dvec3(-0.2, 0.6, 0.0),
    ];
    scene.tracks.push(moves(NodeProperty::Translation, way));
    let turn = vec![DVec3::ZERO, dvec3(1.0, 4.0, -3.0)];
    scene.tracks.push(moves(NodeProperty::Angles, turn));
    let energy = whole(&exposed(&scene, &blurred(64)));
    // The mean cosine over the disc of a ball is 2/3.
    let diffuse = f64::from(scene.materials[0].classical().diffuse.x);
    let expected = diffuse * 2.0 / 3.0 * PI * radius * radius / (4.0 * HALF * HALF);
    assert!(
        (energy / expected - 1.0).abs() < 0.005,
        "{energy} for {expected}"
    );
}

#[test]
fn nonuniform_and_mirrored_scales_give_the_picture_of_baked_geometry() {
    // A cone transformed by keys, against cones with that transform from the start.
    let cone = |world_from_canonical| Geometry::Placed {
        canonical: CanonicalShape::Cone {
            bottom: 0.5,
            top: 0.1,
            capped: true,
        },
        world_from_canonical,
    };
    let own = DAffine3::from_rotation_z(0.5);
    let build = |geometry| {
        let mut scene = carried(geometry);
        scene.materials[0] = scenes::shiny(vec3(0.8, 0.4, 0.2));
        scene.ambient = Vec3::splat(0.1);
        scene.add_point_light(dvec3(1.0, 3.0, 8.0), 0.8);
        scene
    };
    let mut scene = build(cone(own));
    let sizes = [dvec3(0.8, 0.8, 0.8), dvec3(-1.2, 0.5, 0.9)];
    let turn = dvec3(0.4, 0.7, -1.0);
    scene
        .tracks
        .push(moves(NodeProperty::Scale, sizes.to_vec()));
    scene
        .tracks
        .push(moves(NodeProperty::Angles, vec![DVec3::ZERO, turn]));
    let settings = sized(SIDE, SIDE);
    let times = [0.0, 0.2, 0.7, 1.0];
    for (time, picture) in times.into_iter().zip(moments(&scene, &settings, times)) {
        let angles = turn * time;
        let rotation = DQuat::from_rotation_z(angles.z)
            * DQuat::from_rotation_y(angles.y)
            * DQuat::from_rotation_x(angles.x);
        let scale = sizes[0].lerp(sizes[1], time);
        let placed = DAffine3::from_scale_rotation_translation(scale, rotation, DVec3::ZERO) * own;
        let (expected, _) = render(&build(cone(placed)), &settings);
        let off = differing(&expected, &picture, 2.0);
        assert!(off <= 6, "{off} pixels are off at {time}");
        assert!(whole(&picture) > 0.01);
    }
}

#[test]
fn reflections_are_blurred_like_direct_views() {
    // Behind the camera, seen in a mirror across the picture; and as far behind the mirror without it.
    let glow = |z: f64| {
        let mut scene = carried(Geometry::Sphere {
            center: dvec3(0.0, 0.0, z),
            radius: 0.6,
        });
        let way = vec![dvec3(-1.0, 0.3, 0.0), dvec3(0.9, -0.4, 0.0)];
        scene.tracks.push(moves(NodeProperty::Translation, way));
        scene
    };
    let seen = exposed(&glow(-DISTANCE - 10.0), &blurred(128));
    let mut scene = glow(DISTANCE + 10.0);
    let mirror = scene.add_material(Material::from(Phong {
        diffuse: Vec3::ZERO,
        ambient: Vec3::ZERO,
        reflect: Vec3::ONE,
        ..Phong::default()
    }));
    scene.add_plane(DVec3::ZERO, DVec3::Z, mirror);
    let mirrored = exposed(&scene, &blurred(128));
    assert!(
        furthest(&seen, &mirrored) < 0.02,
        "{} off",
        furthest(&seen, &mirrored)
    );
    let partly = seen
        .pixels
        .iter()
        .filter(|pixel| (0.2..0.8).contains(&pixel[0]))
        .count();
    assert!(partly > 100, "{partly} pixels are blurred");
}

#[test]
fn the_shadow_of_a_moving_object_is_blurred_as_its_profile_says() {
    let radius = 0.2;
    let (from, to) = (-0.5, 0.5);
    let mut scene = carried(Geometry::Sphere {
        center: dvec3(0.6, 0.0, 1.0),
        radius,
    });
    scene.materials[0].emission = Vec3::ZERO;
    let floor = scene.add_material(Material::default());
    scene.add_plane(DVec3::ZERO, DVec3::Z, floor);
    scene.lights.push(Light {
        kind: LightKind::Directional {
            direction: dvec3(-1.0, 0.0, -1.0).normalize(),
        },
        color: Vec3::ONE,
        ..Light::default()
    });
    let way = vec![dvec3(0.0, from, 0.0), dvec3(0.0, to, 0.0)];
    scene.tracks.push(moves(NodeProperty::Translation, way));
    let image = exposed(&scene, &blurred(512));
    let lit = f64::from(scene.materials[1].classical().diffuse.x) / 2.0_f64.sqrt();
    // The centre of the shadow is at x = -0.4, and it is √2 as long along x.
    let covered = |x: f64, y: f64| {
        let across = (x + 0.4) / (radius * 2.0_f64.sqrt());
        let half = radius * (1.0 - across * across).max(0.0).sqrt();
        ((y + half).min(to) - (y - half).max(from)).max(0.0) / (to - from)
    };
    let pixel = 2.0 * HALF / f64::from(SIDE);
    let mut shaded = 0;
    for y in 0..SIDE {
        for x in (0..SIDE).filter(|&x| place(x) < 0.2) {
            let points = (0..256).map(|i| {
                let step = |i: u32| (f64::from(i) + 0.5) / 16.0 - 0.5;
                covered(
                    place(x) + step(i % 16) * pixel,
                    -place(y) + step(i / 16) * pixel,
                )
            });
            let fraction = points.sum::<f64>() / 256.0;
            let actual = red(&image, x, y) / lit;
            assert!(
                (actual - (1.0 - fraction)).abs() < 0.02,
                "{x} {y}: {actual}, not {}",
                1.0 - fraction
            );
            shaded += u32::from(fraction > 0.1);
        }
    }
    assert!(shaded > 300, "{shaded} pixels in the shade");
}

/// Depths and normals of moving objects, in closed form at several times.
#[test]
fn depths_and_normals_are_those_of_the_moment() {
    let mut scene = carried(Geometry::Placed {
        canonical: CanonicalShape::Rectangle,
        world_from_canonical: facing(),
    });
    // Towards the camera, while it rotates about the vertical axis.
    let way = vec![DVec3::ZERO, dvec3(0.0, 0.0, 20.0)];
    scene.tracks.push(moves(NodeProperty::Translation, way));
    let turn = vec![DVec3::ZERO, dvec3(0.0, 0.8, 0.0)];
    scene.tracks.push(moves(NodeProperty::Angles, turn));
    let middle = |image: &Image| image.pixels[(17 / 2 * 17 + 17 / 2) as usize];
    let settings = |integrator| RenderSettings {
        integrator,
        ..sized(17, 17)
    };
    let times = [0.0, 0.3, 1.0];
    let depths = moments(&scene, &settings(Integrator::Depth), times);
    let normals = moments(&scene, &settings(Integrator::Normals), times);
    for (i, time) in times.into_iter().enumerate() {
        let depth = f64::from(middle(&depths[i])[0]);
        assert!(
            (depth - (DISTANCE - 20.0 * time)).abs() < 1e-4,
            "{depth} at {time}"
        );
        let (sin, cos) = (0.8 * time).sin_cos();
        let expected = [sin, 0.0, cos].map(|c| 0.5 * c + 0.5);
        for (actual, expected) in middle(&normals[i]).iter().zip(expected) {
            assert!(
                (f64::from(*actual) - expected).abs() < 1e-5,
                "{actual}, not {expected}"
            );
        }
    }
}
