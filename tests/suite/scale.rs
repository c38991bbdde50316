//! The scale and position of a scene do not affect its picture.

use crate::reference::compare::{assert_none, check_alike, render, sized};
use crate::reference::scenes::{self, Build};
use crate::reference::trace;
use glam::{DAffine3, DVec3, UVec2, Vec3, dvec3};
use glimray::scene::{Attenuation, Geometry, Light, LightKind, Scene};
use std::sync::Arc;

/// `scene` scaled around the origin and translated; lights with attenuation are scaled accordingly.
fn placed(scene: &Scene, scale: f64, offset: DVec3) -> Scene {
    let place = |p: DVec3| scale * p + offset;
    let mut placed = scene.clone();
    for shape in &mut placed.shapes {
        shape.geometry = match shape.geometry {
            Geometry::Sphere { center, radius } => Geometry::Sphere {
                center: place(center),
                radius: scale * radius,
            },
            Geometry::Plane { point, normal } => Geometry::Plane {
                point: place(point),
                normal,
            },
            Geometry::Placed {
                canonical,
                world_from_canonical,
            } => Geometry::Placed {
                canonical,
                world_from_canonical: DAffine3::from_translation(offset)
                    * DAffine3::from_scale(DVec3::splat(scale))
                    * world_from_canonical,
            },
        };
    }
    let placement = DAffine3::from_translation(offset) * DAffine3::from_scale(DVec3::splat(scale));
    for instance in &mut placed.instances {
        instance.placement = placement * instance.placement;
    }
    for light in &mut placed.lights {
        if light.attenuation == Attenuation::InverseSquare {
            light.color *= (scale * scale) as f32;
        }
        light.kind = match light.kind {
            LightKind::Point { position } => LightKind::Point {
                position: place(position),
            },
            LightKind::Spot {
                position,
                direction,
                inner,
                outer,
            } => LightKind::Spot {
                position: place(position),
                direction,
                inner,
                outer,
            },
            LightKind::Rectangle {
                center,
                edge_u,
                edge_v,
            } => LightKind::Rectangle {
                center: place(center),
                edge_u: scale * edge_u,
                edge_v: scale * edge_v,
            },
            LightKind::Disc {
                center,
                normal,
                radius,
            } => LightKind::Disc {
                center: place(center),
                normal,
                radius: scale * radius,
            },
            LightKind::Sphere { center, radius } => LightKind::Sphere {
                center: place(center),
                radius: scale * radius,
            },
            directional @ LightKind::Directional { .. } => directional,
        };
    }
    for camera in &mut placed.cameras {
        camera.look_from = place(camera.look_from);
        camera.look_at = place(camera.look_at);
    }
    placed
}

fn all_scenes() -> [(&'static str, Scene); 4] {
    [
        ("spheres", scenes::spheres()),
        ("meshes", scenes::meshes()),
        ("everything", scenes::everything()),
        ("solids", scenes::solids()),
    ]
}

/// Each scene next to itself at other positions.
fn check_places(places: &[(&str, f64, DVec3)]) {
    let settings = sized(160, 120);
    assert_none(all_scenes().into_iter().flat_map(|(name, scene)| {
        let (expected, _) = render(&scene, &settings);
        let check = |(what, scale, offset): &(&str, f64, DVec3)| {
            let (actual, _) = render(&placed(&scene, *scale, *offset), &settings);
            check_alike(&format!("{name} {what}"), &expected, &actual, 2.0, 0.001)
        };
        places.iter().map(check).collect::<Vec<_>>()
    }));
}

#[test]
fn a_scene_of_another_size_gives_the_same_picture() {
    check_places(&[
        ("a thousandth as large", 1e-3, DVec3::ZERO),
        ("10,000 times as large", 1e4, DVec3::ZERO),
        ("a millionth as large", 1e-6, DVec3::ZERO),
        ("10⁹ times as large", 1e9, DVec3::ZERO),
    ]);
}

#[test]
fn a_scene_far_from_the_origin_gives_the_same_picture() {
    check_places(&[
        ("10,000 away", 1.0, dvec3(1e4, -1e4, 1e4)),
        ("a million away", 1.0, dvec3(-1e6, 2e5, 1e6)),
        ("tiny and 10 away", 1e-3, dvec3(10.0, 10.0, -10.0)),
    ]);
}

#[test]
fn a_mesh_with_large_or_small_vertices_gives_the_same_picture() {
    let settings = sized(160, 120);
    let (expected, _) = render(&scenes::meshes(), &settings);
    assert_none([1e-3, 1e4].map(|scale: f64| {
        // The scale is moved from the placement to the vertices.
        let mut scene = placed(&scenes::meshes(), scale, DVec3::ZERO);
        for instance in &mut scene.instances {
            instance.placement *= DAffine3::from_scale(DVec3::splat(1.0 / scale));
        }
        for position in scene
            .meshes
            .iter_mut()
            .flat_map(|mesh| &mut Arc::make_mut(mesh).positions)
        {
            *position *= scale as f32;
        }
        let (actual, _) = render(&scene, &settings);
        check_alike(
            &format!("vertices times {scale}"),
            &expected,
            &actual,
            2.0,
            0.001,
        )
    }));
}

/// A distant view through a narrow field of view: f32 is coarse at the far end.
#[test]
fn a_scene_seen_from_10_000_away_matches_the_reference() {
    let settings = sized(160, 120);
    assert_none(all_scenes().map(|(name, mut scene)| {
        let camera = &mut scene.cameras[0];
        camera.look_from = camera.look_at + (camera.look_from - camera.look_at).normalize() * 1e4;
        camera.fov_y = 6.0 / 1e4;
        // The tolerance of the course, except at edges, where one f32 step is a tenth of a pixel.
        let (actual, _) = render(&scene, &settings);
        let expected = trace(&scene, settings.size).image;
        check_alike(&format!("{name} from afar"), &expected, &actual, 2.0, 0.02)
    }));
}

/// Light at this grazing angle to the ground, which still lights it.
fn grazing(angle: f64) -> Light {
    Light {
        kind: LightKind::Directional {
            direction: dvec3(-angle.cos(), -angle.sin(), 0.0),
        },
        color: Vec3::splat((0.8 / angle.sin()) as f32),
        attenuation: Attenuation::None,
        ..Light::default()
    }
}

#[test]
fn grazing_light_draws_no_speckles() {
    let identity = DAffine3::IDENTITY;
    let ground = || {
        let mut scene = scenes::empty();
        scene.ambient = Vec3::ZERO;
        scene
    };
    let mut plane = ground();
    plane.add_plane(DVec3::ZERO, dvec3(0.0, 1.0, 0.0), 0);
    let mut tilted = ground();
    tilted.add_plane(DVec3::ZERO, dvec3(0.1, 1.0, 0.3).normalize(), 0);
    let mut square = ground();
    square.add_mesh(scenes::quad(40.0, 0), identity);
    let mut flat_field = ground();
    flat_field.add_mesh(scenes::height_field(20.0, 50, 0, |_, _| 0.0), identity);
    let mut slope = ground();
    slope.add_mesh(
        scenes::height_field(20.0, 50, 0, |x, z| 0.1 * x - 0.3 * z),
        identity,
    );
    let mut hills = ground();
    let height = |x: f64, z: f64| 0.3 * (1.1 * x).sin() * (1.3 * z).cos();
    hills.add_mesh(scenes::height_field(12.0, 40, 0, height), identity);
    let mut balls = ground();
    balls.add_sphere(DVec3::ZERO, 1.0, 0);
    balls.add_mesh(
        scenes::ball(UVec2::new(48, 24), 0),
        DAffine3::from_translation(DVec3::X * 2.2),
    );
    let mut solids = scenes::solids();
    solids.ambient = Vec3::ZERO;
    let grounds = [
        ("solids", solids),
        ("plane", plane),
        ("tilted plane", tilted),
        ("square", square),
        ("flat field", flat_field),
        ("slope", slope),
        ("hills", hills),
        ("balls", balls),
    ];
    let settings = sized(96, 72);
    assert_none(grounds.into_iter().flat_map(|(name, scene)| {
        [2.0f64, 0.2, 0.02].map(|degrees| {
            let mut scene = scene.clone();
            scene.lights = vec![grazing(degrees.to_radians())];
            let expected = trace(&scene, settings.size).image;
            let (actual, _) = render(&scene, &settings);
            check_alike(
                &format!("{name} at {degrees} degrees"),
                &expected,
                &actual,
                2.0,
                0.001,
            )
        })
    }));
}

#[test]
fn a_lamp_just_above_the_ground_draws_no_speckles() {
    let mut rows = Vec::new();
    for height in [0.1, 0.001] {
        let mut plane = scenes::empty();
        plane.add_plane(DVec3::ZERO, DVec3::Y, 0);
        let mut field = scenes::empty();
        let flat = scenes::height_field(20.0, 64, 0, |_, _| 0.0);
        field.add_mesh(flat, DAffine3::from_rotation_y(0.3));
        rows.extend([("plane", plane, height), ("field", field, height)]);
    }
    let settings = sized(96, 72);
    assert_none(rows.into_iter().map(|(name, mut scene, height)| {
        scene.add_point_light(dvec3(0.3, height, 0.2), (1.0 / height) as f32);
        let expected = trace(&scene, settings.size).image;
        let (actual, _) = render(&scene, &settings);
        check_alike(
            &format!("lamp {height} above the {name}"),
            &expected,
            &actual,
            2.0,
            0.001,
        )
    }));
}
