//! Section planes: distances, light and shadows by closed forms.

use crate::reference::compare::{
    assert_none, check_same_bits, open_gpu, render, sized, start_packed,
};
use crate::reference::scenes::Build;
use glam::{DAffine3, DQuat, DVec3, Vec3, dvec3, vec3};
use glimray::image::Image;
use glimray::pack;

use glimray::render::{ExecutionPolicy, Integrator, QueryRay, RayQuery, RenderSettings, Tone};
use glimray::scene::{
    Background, Camera, CanonicalShape, Fresnel, Geometry, Light, LightKind, Material, Mesh,
    Pattern, Phong, PhongTextures, Scene, Section, Shape, Space, Texture,
};

const SIDE: u32 = 48;
/// The height of the orthographic picture.
const HEIGHT: f64 = 2.5;
/// The distance of the camera from the origin.
const AWAY: f64 = 5.0;

/// A scene that is seen from +z by an orthographic camera, or from −z.
fn scene(material: impl Into<Material>, from_below: bool) -> Scene {
    Scene {
        cameras: vec![Camera {
            look_from: if from_below { -AWAY } else { AWAY } * DVec3::Z,
            look_at: DVec3::ZERO,
            orthographic_height: Some(HEIGHT),
            ..Camera::default()
        }],
        materials: vec![material.into()],
        ..Scene::default()
    }
}

/// Cuts away what is nearer to +z than this.
fn above(offset: f64) -> Option<Section> {
    Some(Section {
        normal: DVec3::Z,
        offset,
    })
}

fn with(integrator: Integrator, samples: u32) -> RenderSettings {
    RenderSettings {
        integrator,
        samples,
        max_depth: 16,
        ..sized(SIDE, SIDE)
    }
}

/// The middles of the pixels in the plane z = 0, from the left above to the right below, and their colours.
fn pixels(image: &Image) -> impl Iterator<Item = (f64, f64, [f32; 3])> {
    (0..).zip(&image.pixels).map(|(index, &[r, g, b, _])| {
        let at = |i: u32| ((f64::from(i) + 0.5) / f64::from(SIDE) - 0.5) * HEIGHT;
        (at(index % SIDE), -at(index / SIDE), [r, g, b])
    })
}

fn glowing(color: Vec3) -> Material {
    Material {
        emission: color,
        bsdf: Phong {
            diffuse: Vec3::ZERO,
            ..Phong::default()
        }
        .into(),
        ..Material::default()
    }
}

/// A cube with corners at ±1, whose faces share no vertex; without the one towards −z if it is open.
fn cube(is_open: bool) -> Mesh {
    let mut mesh = Mesh::default();
    for normal in [
        DVec3::X,
        DVec3::Y,
        DVec3::Z,
        -DVec3::X,
        -DVec3::Y,
        -DVec3::Z,
    ] {
        if is_open && normal.z < 0.0 {
            continue;
        }
        let (u, v) = normal.any_orthonormal_pair();
        let first = mesh.positions.len() as u32;
        for (x, y) in [(-1.0, -1.0), (1.0, -1.0), (1.0, 1.0), (-1.0, 1.0)] {
            mesh.positions.push((normal + x * u + y * v).as_vec3());
            mesh.normals.push(normal.as_vec3());
            mesh.materials.push(0);
        }
        mesh.triangles
            .extend([[0, 1, 2], [0, 2, 3]].map(|t| t.map(|i| first + i)));
    }
    mesh
}

/// Compares the distances of a picture with those that `expected` gives for a point; `None` where it is too near to an edge.
fn check_depths(
    name: &str,
    scene: &Scene,
    expected: impl Fn(f64, f64) -> Option<f64>,
) -> Result<(), String> {
    let image = render(scene, &with(Integrator::Depth, 1)).0;
    let mut compared = 0;
    for (x, y, color) in pixels(&image) {
        if let Some(expected) = expected(x, y) {
            compared += 1;
            if (f64::from(color[0]) - expected).abs() > 1e-4 {
                return Err(format!("{name}: at {x} {y} {}, not {expected}", color[0]));
            }
        }
    }
    match compared > 1500 {
        true => Ok(()),
        false => Err(format!("{name}: {compared} pixels")),
    }
}

/// The z of the front of a unit sphere that is cut at `offset`, seen from +z.
fn front_of_ball(offset: f64, x: f64, y: f64) -> Option<f64> {
    let r = x.hypot(y);
    let z = (1.0 - r * r).max(0.0).sqrt();
    let is_edge = (r - 1.0).abs() < 0.02 || (z.abs() - offset.abs()).abs() < 0.02;
    match r < 1.0 && -z < offset {
        _ if is_edge => None,
        true => Some(AWAY - z.min(offset)),
        false => Some(0.0),
    }
}

#[test]
fn a_cut_ball_has_a_flat_face() {
    let results = [0.3, -0.4].map(|offset| {
        let mut scene = scene(Material::default(), false);
        scene.add_sphere(DVec3::ZERO, 1.0, 0);
        scene.section = above(offset);
        check_depths(&format!("{offset}"), &scene, |x, y| {
            front_of_ball(offset, x, y)
        })
    });
    assert_none(results);
}

#[test]
fn a_closed_mesh_has_a_face_where_it_is_cut_and_an_open_one_is_hollow() {
    let half = 0.75;
    let placement = DAffine3::from_scale(DVec3::splat(half));
    let results = [(false, 0.2), (true, -half)].map(|(is_open, z)| {
        let mut scene = scene(Material::default(), false);
        // The open side of the open cube is below, so its inside is seen through it.
        let turned = DAffine3::from_rotation_x(std::f64::consts::PI);
        let turn = if is_open { turned } else { DAffine3::IDENTITY };
        scene.add_mesh(cube(is_open), placement * turn);
        scene.section = above(0.2);
        check_depths(&format!("open {is_open}"), &scene, |x, y| {
            let far = x.abs().max(y.abs());
            match (far - half).abs() < 0.02 {
                true => None,
                false if far < half => Some(AWAY - z),
                false => Some(0.0),
            }
        })
    });
    assert_none(results);
}

#[test]
fn a_sheet_with_two_faces_is_no_solid() {
    let mut sheet = Mesh::default();
    for side in [1.0, -1.0] {
        let first = sheet.positions.len() as u32;
        for (x, y) in [(-1.0, -1.0), (1.0, -1.0), (1.0, 1.0), (-1.0, 1.0)] {
            sheet.positions.push(vec3(x, y, 0.0));
            sheet.normals.push(Vec3::Z * side);
            sheet.materials.push(0);
        }
        let corners = if side > 0.0 { [1, 2] } else { [2, 1] };
        let triangle = |a: u32, b: u32| [first, first + a, first + b];
        let shift = |[a, b]: [u32; 2]| triangle(a, b);
        sheet
            .triangles
            .extend([shift(corners), shift(corners.map(|i| i + 1))]);
    }
    let mut scene = scene(Material::default(), false);
    scene.add_mesh(sheet, DAffine3::from_scale(DVec3::splat(0.75)));
    scene.section = above(0.5);
    let depths = check_depths("a sheet", &scene, |x, y| {
        let far = x.abs().max(y.abs());
        match (far - 0.75).abs() < 0.02 {
            true => None,
            false if far < 0.75 => Some(AWAY),
            false => Some(0.0),
        }
    });
    assert_none([depths]);
}

#[test]
fn a_surface_in_the_plane_is_kept_and_leaves_no_speckles() {
    let mut scene = scene(Material::default(), false);
    scene.cameras[0].look_from += dvec3(0.3, 0.2, 0.0);
    scene.cameras[0].look_at += dvec3(0.3, 0.2, 0.0);
    scene.add_mesh(cube(true), DAffine3::from_scale(DVec3::splat(0.75)));
    scene.section = above(0.75);
    let depths = check_depths("a lid", &scene, |x, y| {
        let far = (x + 0.3).abs().max((y + 0.2).abs());
        match (far - 0.75).abs() < 0.02 {
            true => None,
            false if far < 0.75 => Some(AWAY - 0.75),
            false => Some(0.0),
        }
    });
    assert_none([depths]);
}

#[test]
fn hundreds_of_open_surfaces_behind_the_plane_are_no_failure() {
    let mut scene = scene(Material::default(), false);
    for k in 0..400 {
        let z = -f64::from(k) / 100.0;
        scene.add_mesh(
            crate::reference::scenes::quad(1.0, 0),
            DAffine3::from_translation(z * DVec3::Z)
                * DAffine3::from_rotation_x(std::f64::consts::FRAC_PI_2),
        );
    }
    scene.section = above(0.5);
    let image = render(&scene, &with(Integrator::Depth, 1)).0;
    let (.., color) = pixels(&image)
        .nth((SIDE * SIDE / 2 + SIDE / 2) as usize)
        .expect("a pixel");
    assert!((f64::from(color[0]) - AWAY).abs() < 1e-4, "{color:?}");
}

#[test]
fn instances_and_the_search_without_trees_give_the_same_picture() {
    let mut scene = scene(Material::default(), false);
    scene.add_mesh(cube(false), DAffine3::from_scale(DVec3::splat(0.5)));
    scene.add_mesh(
        scene.meshes[0].clone(),
        DAffine3::from_scale_rotation_translation(
            dvec3(0.2, 0.3, -0.4),
            DQuat::from_rotation_y(0.7),
            dvec3(0.6, 0.5, 0.1),
        ),
    );
    scene.add_sphere(dvec3(-0.5, -0.5, 0.0), 0.4, 0);
    scene.section = Some(Section {
        normal: dvec3(0.6, 0.0, 0.8),
        offset: 0.1,
    });
    let settings = with(Integrator::Depth, 1);
    let baked = render(&scene, &settings).0;
    let brute = RenderSettings {
        brute_force: true,
        ..settings.clone()
    };
    assert_none([check_same_bits(
        "without trees",
        &baked,
        &render(&scene, &brute).0,
    )]);
    let packed = pack::scene_with(&scene, 0).expect("it fits");
    let view = packed.frame(&scene.frame(0.0)).expect("it fits");
    let mut renderer = start_packed(packed.into(), &view, &settings);
    while !renderer.is_done() {
        renderer.step().expect("a step");
    }
    let instanced = renderer.develop(&Tone::LINEAR).expect("a picture");
    for (a, b) in baked.pixels.iter().zip(&instanced.pixels) {
        assert!((a[0] - b[0]).abs() < 1e-4, "{a:?} {b:?}");
    }
}

#[test]
fn the_innermost_solid_has_the_face() {
    let colors = [
        vec3(0.5, 0.0, 0.0),
        vec3(0.0, 0.5, 0.0),
        vec3(0.0, 0.0, 0.5),
    ];
    for integrator in [Integrator::Whitted, Integrator::Path] {
        let mut scene = scene(glowing(colors[0]), false);
        scene
            .materials
            .extend([glowing(colors[1]), glowing(colors[2])]);
        scene.add_sphere(DVec3::ZERO, 1.0, 0);
        scene.add_sphere(DVec3::ZERO, 0.6, 1);
        scene.shapes.push(Shape {
            name: String::new(),
            geometry: Geometry::Placed {
                canonical: CanonicalShape::Box,
                world_from_canonical: DAffine3::from_scale(DVec3::splat(0.2)),
            },
            material: 2,
            node: None,
        });
        scene.section = above(0.0);
        let image = render(&scene, &with(integrator, 1)).0;
        let mut seen = [0; 3];
        for (x, y, color) in pixels(&image) {
            let (r, far) = (x.hypot(y), x.abs().max(y.abs()));
            if (r - 1.0).abs() < 0.05 || (r - 0.6).abs() < 0.05 || (far - 0.2).abs() < 0.05 {
                continue;
            }
            let expected = match r {
                _ if far < 0.2 => 2,
                r if r < 0.6 => 1,
                r if r < 1.0 => 0,
                _ => continue,
            };
            seen[expected] += 1;
            assert_eq!(
                Vec3::from(color),
                colors[expected],
                "{integrator:?} {x} {y}"
            );
        }
        assert!(seen.iter().all(|&count| count > 10), "{seen:?}");
    }
}

#[test]
fn a_cut_solid_reflects_its_albedo_under_an_even_sky() {
    // Each point of a convex body sees half of the sky: its radiance is albedo times that of the sky.
    let albedo = 0.6;
    let material = Phong {
        diffuse: Vec3::splat(albedo),
        ..Phong::default()
    };
    let mut scene = scene(material, false);
    scene.add_mesh(
        cube(false),
        DAffine3::from_rotation_z(0.4) * DAffine3::from_scale(DVec3::splat(0.7)),
    );
    scene.background = Background::Color(Vec3::ONE);
    scene.section = Some(Section {
        normal: dvec3(0.6, 0.0, 0.8),
        offset: 0.2,
    });
    let image = render(&scene, &with(Integrator::Path, 64)).0;
    let inner = pixels(&image).filter(|(x, y, _)| x.hypot(*y) < 0.6);
    let values: Vec<_> = inner.map(|(.., color)| f64::from(color[0])).collect();
    let mean = values.iter().sum::<f64>() / values.len() as f64;
    assert!((mean - f64::from(albedo)).abs() < 0.004, "{mean}");
}

#[test]
fn light_is_absorbed_along_the_part_of_a_ball_that_is_left() {
    // With the refractive index 1 light goes straight on, in by the face and out by the ball, or the other way round.
    let (absorption, offset) = (1.5, 0.3);
    let material = Phong {
        diffuse: Vec3::ZERO,
        specular: Vec3::ZERO,
        transmit: Vec3::ONE,
        opacity: 0.0,
        ior: 1.0,
        absorption: Vec3::splat(absorption),
        fresnel: Fresnel::None,
        ..Phong::default()
    };
    for integrator in [Integrator::Whitted, Integrator::Path] {
        for from_below in [false, true] {
            let mut scene = scene(material.clone(), from_below);
            scene.add_sphere(DVec3::ZERO, 1.0, 0);
            scene.background = Background::Color(Vec3::ONE);
            scene.section = above(offset);
            let image = render(&scene, &with(integrator, 1)).0;
            for (x, y, color) in pixels(&image) {
                let r = x.hypot(y);
                let z = (1.0 - r * r).max(0.0).sqrt();
                if (r - 1.0).abs() < 0.02 || (z - offset).abs() < 0.02 {
                    continue;
                }
                let way = match r < 1.0 {
                    true => z.min(offset) + z,
                    false => 0.0,
                };
                let expected = (-f64::from(absorption) * way).exp();
                let found = f64::from(color[0]);
                assert!(
                    (found - expected).abs() < 1e-3,
                    "{integrator:?} {from_below} at {x} {y}: {found}, not {expected}"
                );
            }
        }
    }
}

#[test]
fn what_is_cut_away_casts_no_shadow() {
    // Light falls along −z. The half x > 0 of a square that is above the floor is cut away.
    for integrator in [Integrator::Whitted, Integrator::Path] {
        let mut scene = scene(Material::default(), false);
        scene.add_plane(DVec3::ZERO, DVec3::Z, 0);
        scene.add_mesh(
            cube(false),
            DAffine3::from_translation(2.0 * DVec3::Z) * DAffine3::from_scale(dvec3(0.5, 0.5, 0.1)),
        );
        scene.lights.push(Light {
            kind: LightKind::Directional {
                direction: DVec3::NEG_Z,
            },
            color: Vec3::ONE,
            ..Light::default()
        });
        scene.section = Some(Section {
            normal: DVec3::X,
            offset: 0.0,
        });
        // Below the square, where the floor is seen.
        scene.cameras[0].look_from.z = 1.5;
        let settings = RenderSettings {
            max_depth: 0,
            ..with(integrator, 1)
        };
        let image = render(&scene, &settings).0;
        for (x, y, color) in pixels(&image) {
            let far = x.abs().max(y.abs());
            if x.abs() < 0.05 || (far - 0.5).abs() < 0.05 {
                continue;
            }
            // The floor beyond the plane is gone too.
            let is_lit = x < 0.0 && far > 0.5;
            assert_eq!(color[0] > 0.0, is_lit, "{integrator:?} {x} {y} {color:?}");
        }
    }
}

#[test]
fn the_part_of_a_light_that_is_cut_away_does_not_shine() {
    // A glowing square over a floor: the half that is left of a wide one, and a narrow one.
    let lamp = |from: f32| {
        let mut mesh = Mesh::default();
        for (x, y) in [(from, -1.0), (0.0, -1.0), (0.0, 1.0), (from, 1.0)] {
            mesh.positions.push(vec3(x, 1.5, y));
            mesh.normals.push(Vec3::NEG_Y);
            mesh.materials.push(1);
        }
        mesh.triangles = vec![[0, 1, 2], [0, 2, 3]];
        mesh
    };
    let build = |wide: bool| {
        let mut scene = scene(Material::default(), false);
        scene.materials.push(glowing(Vec3::splat(4.0)));
        scene.add_plane(DVec3::ZERO, DVec3::Y, 0);
        scene.add_mesh(lamp(-1.0), DAffine3::IDENTITY);
        if wide {
            let mut other = lamp(-1.0);
            other.positions.iter_mut().for_each(|p| p.x += 1.0);
            scene.add_mesh(other, DAffine3::IDENTITY);
            scene.section = Some(Section {
                normal: DVec3::X,
                offset: 0.0,
            });
        }
        // From above, where the floor is seen through no lamp.
        scene.cameras[0].look_from = dvec3(-0.6, 0.5, 0.0);
        scene.cameras[0].look_at = dvec3(-0.6, 0.0, 0.0);
        scene.cameras[0].up = DVec3::Z;
        scene.cameras[0].orthographic_height = Some(1.0);
        scene
    };
    let mean = |scene: &Scene| {
        let image = render(scene, &with(Integrator::Path, 256)).0;
        let sum: f64 = image.pixels.iter().map(|pixel| f64::from(pixel[0])).sum();
        sum / image.pixels.len() as f64
    };
    let (cut, narrow) = (mean(&build(true)), mean(&build(false)));
    assert!((cut / narrow - 1.0).abs() < 0.01, "{cut} {narrow}");
}

#[test]
fn the_face_of_a_glowing_solid_glows_once() {
    let mut scene = scene(glowing(Vec3::splat(0.75)), false);
    scene.add_sphere(DVec3::ZERO, 1.0, 0);
    scene.add_mesh(
        cube(false),
        DAffine3::from_translation(dvec3(0.0, 0.0, -9.0)),
    );
    scene.section = above(0.3);
    let image = render(&scene, &with(Integrator::Path, 16)).0;
    for (x, y, color) in pixels(&image) {
        if x.hypot(y) < 0.9 {
            assert!((color[0] - 0.75).abs() < 1e-5, "{x} {y} {color:?}");
        }
    }
}

#[test]
fn a_texture_by_coordinates_of_the_surface_is_not_on_the_face() {
    let mut scene = scene(
        Phong {
            ambient: vec3(0.25, 0.5, 0.75),
            textures: PhongTextures {
                ambient: Some(0),
                ..PhongTextures::default()
            },
            ..Phong::default()
        },
        false,
    );
    scene.textures.push(Texture {
        pattern: Pattern::Checker {
            a: Vec3::ZERO,
            b: vec3(0.0, 1.0, 0.0),
        },
        space: Space::Uv,
        pattern_from_space: DAffine3::from_scale(DVec3::splat(8.0)),
    });
    scene.add_sphere(DVec3::ZERO, 1.0, 0);
    scene.ambient = Vec3::ONE;
    scene.section = above(0.5);
    let image = render(&scene, &with(Integrator::Whitted, 1)).0;
    for (x, y, color) in pixels(&image) {
        match x.hypot(y) {
            r if r < 0.8 => assert_eq!(color, [0.25, 0.5, 0.75], "{x} {y}"),
            r if r > 0.9 => assert_eq!([color[0], color[2]], [0.0; 2], "{x} {y}"),
            _ => {}
        }
    }
}

#[test]
fn ray_queries_see_the_section_too() {
    let mut scene = scene(Material::default(), false);
    scene.add_sphere(DVec3::ZERO, 1.0, 0);
    scene.section = above(0.25);
    let packed = pack::scene(&scene).expect("it fits");
    let view = packed.frame(&scene.frame(0.0)).expect("it fits");
    let policy = ExecutionPolicy::default();
    let query = RayQuery::new(open_gpu(), packed.into(), &view, policy).expect("a query");
    let along = |from: f64, way: f32| QueryRay::new(dvec3(0.1, 0.0, from), way * Vec3::Z);
    let hits = query.closest_hits(&[along(3.0, -1.0), along(-3.0, 1.0)]);
    let distances: Vec<_> = (hits.expect("hits").iter())
        .map(|hit| f64::from(hit.expect("a hit").t))
        .collect();
    assert!((distances[0] - 2.75).abs() < 1e-5, "{distances:?}");
    let below = 3.0 - (1.0_f64 - 0.01).sqrt();
    assert!((distances[1] - below).abs() < 1e-5, "{distances:?}");
}
