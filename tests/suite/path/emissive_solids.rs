//! Emissive shapes that no lamp has the form of, as lights of paths.

use super::emission_maps::add_picture_texture;
use super::{clear, lit_floor, looking, matte, mean, near, paths};
use crate::motion_blur::{exposed, track};
use crate::reference::scenes::{Build, ball, lattice, torus};
use crate::support::verdict::Verdict;
use glam::{DAffine3, DMat3, DQuat, DVec3, UVec2, Vec3, dvec3, uvec2};
use glimray::pack;
use glimray::scene::{
    Antialias, CanonicalShape, Geometry, Light, Material, Mesh, Node, NodeProperty, Picture, Scene,
    Shape, Target, Values,
};
use std::f64::consts::TAU;

const AROUND: u32 = 96;

/// A disc at this height, or what a hole leaves of it.
fn disc(hole: f64, radius: f64, y: f64, up: f64) -> Mesh {
    lattice(uvec2(AROUND, 1), 1, |u, v| {
        let (sin, cos) = (up * TAU * u).sin_cos();
        let radius = hole + (radius - hole) * v;
        (dvec3(radius * sin, y, radius * cos), up * DVec3::Y)
    })
}

fn side(bottom: f64, top: f64) -> Mesh {
    lattice(uvec2(AROUND, 1), 1, |u, v| {
        let (sin, cos) = (TAU * u).sin_cos();
        let y = 1.0 - v;
        let radius = bottom + (top - bottom) * y;
        let normal = dvec3(sin, bottom - top, cos);
        (dvec3(radius * sin, y, radius * cos), normal.normalize())
    })
}

/// One side of a box: the images of the upper side.
fn sides() -> Vec<Mesh> {
    let up = |turn: DQuat| {
        lattice(UVec2::ONE, 1, |u, v| {
            let p = dvec3(2.0 * u - 1.0, 1.0, 2.0 * v - 1.0);
            (turn * p, turn * DVec3::Y)
        })
    };
    let turns = (0..4).map(|k| DQuat::from_rotation_x(f64::from(k) * TAU / 4.0));
    let ends = [1.0, -1.0].map(|side| DQuat::from_rotation_z(side * TAU / 4.0));
    turns.chain(ends).map(up).collect()
}

/// Shapes, and meshes of them.
pub fn solids() -> Vec<(&'static str, CanonicalShape, Vec<Mesh>)> {
    let cone = |bottom, top, capped| CanonicalShape::Cone {
        bottom,
        top,
        capped,
    };
    vec![
        (
            "ellipsoid",
            CanonicalShape::Ellipsoid,
            vec![ball(uvec2(AROUND, 48), 1)],
        ),
        ("box", CanonicalShape::Box, sides()),
        ("tube", cone(1.0, 1.0, false), vec![side(1.0, 1.0)]),
        (
            "cylinder",
            cone(1.0, 1.0, true),
            vec![
                side(1.0, 1.0),
                disc(0.0, 1.0, 0.0, -1.0),
                disc(0.0, 1.0, 1.0, 1.0),
            ],
        ),
        (
            "frustum",
            cone(0.5, 1.5, true),
            vec![
                side(0.5, 1.5),
                disc(0.0, 0.5, 0.0, -1.0),
                disc(0.0, 1.5, 1.0, 1.0),
            ],
        ),
        (
            "cone",
            cone(1.0, 0.0, true),
            vec![side(1.0, 0.0), disc(0.0, 1.0, 0.0, -1.0)],
        ),
        ("funnel", cone(0.0, 1.2, false), vec![side(0.0, 1.2)]),
        (
            "torus",
            CanonicalShape::Torus { minor: 0.3 },
            vec![torus(1.0, 0.3, uvec2(AROUND, 48), 1)],
        ),
        (
            "ring",
            CanonicalShape::Disc { hole: 0.6 },
            vec![disc(0.6, 1.0, 0.0, 1.0)],
        ),
    ]
}

/// A floor below something that glows on its outside.
fn floor(radiance: f32) -> Scene {
    let mut scene = lit_floor(matte(0.5), Light::default());
    scene.lights.clear();
    scene.add_material(Material {
        emission: Vec3::splat(radiance),
        two_sided: false,
        ..matte(0.0)
    });
    scene
}

fn under(canonical: CanonicalShape, placed: DAffine3, radiance: f32) -> Scene {
    let mut scene = floor(radiance);
    scene.shapes.push(Shape {
        geometry: Geometry::Placed {
            canonical,
            world_from_canonical: placed,
        },
        material: 1,
        node: None,
        name: String::new(),
    });
    scene
}

/// Turned so that its front and back, and its top and bottom, are seen from below; stretched, and mirrored.
fn placed(size: f64) -> DAffine3 {
    let turn = DMat3::from_quat(DQuat::from_axis_angle(
        dvec3(1.0, 0.2, 0.5).normalize(),
        2.4,
    ));
    DAffine3 {
        matrix3: turn * DMat3::from_diagonal(size * dvec3(0.9, 0.7, -1.4)),
        translation: dvec3(0.4, 1.1, -0.5),
    }
}

/// The mean of a picture while a node carries what glows past the floor.
fn carried(mut scene: Scene) -> f64 {
    scene.nodes.push(Node::default());
    let nodes = (scene.shapes.iter_mut().map(|shape| &mut shape.node))
        .chain(scene.instances.iter_mut().map(|mesh| &mut mesh.node));
    nodes.skip(1).for_each(|node| *node = Some(0));
    scene.tracks.push(track(
        Target::Node(0, NodeProperty::Translation),
        Values::Vector(vec![dvec3(-0.3, 0.1, 0.0), dvec3(0.3, 0.0, 0.2)]),
    ));
    let image = exposed(&scene, &paths(4096, (24, 16), 0));
    let sum: f64 = image.pixels.iter().map(|pixel| f64::from(pixel[1])).sum();
    sum / image.pixels.len() as f64
}

#[test]
fn emissive_shapes_of_every_kind_shine_like_meshes_of_them() {
    let mut verdict = Verdict::on("floors under glowing shapes");
    for (name, canonical, meshes) in solids() {
        let mut expected = floor(2.0);
        for mesh in meshes {
            expected.add_mesh(mesh, placed(0.3));
        }
        let scene = under(canonical, placed(0.3), 2.0);
        let still = [&expected, &scene].map(|scene| mean(scene, &paths(512, (24, 16), 0)));
        for (how, [expected, found]) in [
            ("still", still),
            ("carried", [expected, scene].map(carried)),
        ] {
            let what = format!("{name}, {how}");
            near(&mut verdict, what, found, expected, 0.01 * expected);
        }
    }
    verdict.close();
}

/// A node may stretch a sphere.
#[test]
fn a_sphere_that_a_node_stretches_shines_like_an_ellipsoid() {
    let expected = mean(
        &under(CanonicalShape::Ellipsoid, placed(0.3), 2.0),
        &paths(512, (24, 16), 0),
    );
    let mut scene = floor(2.0);
    scene.shapes.push(Shape {
        geometry: Geometry::Sphere {
            center: DVec3::ZERO,
            radius: 1.0,
        },
        material: 1,
        node: Some(0),
        name: String::new(),
    });
    scene.nodes.push(Node {
        placement: placed(0.3),
        ..Node::default()
    });
    let found = mean(&scene, &paths(512, (24, 16), 0));
    assert!(
        (found / expected - 1.0).abs() < 0.01,
        "{found}, expected {expected}"
    );
}

/// A small shape is found by light samples: paths hit one of these once in 100,000 samples.
#[test]
fn small_shapes_of_every_kind_are_found_by_few_samples() {
    let mut verdict = Verdict::on("the light of small shapes");
    for (name, canonical, _) in solids() {
        let mut scene = under(canonical, placed(0.01), 1000.0);
        // The outside of the funnel is turned away.
        scene.materials[1].two_sided = true;
        scene.output.antialias = Some(Antialias::Stratified);
        let few = mean(&scene, &paths(16, (16, 16), 0));
        let many = mean(&scene, &paths(1024, (16, 16), 0));
        near(&mut verdict, name, few, many, 0.03 * many);
    }
    verdict.close();
}

/// Everything that a surface in a room of radiance 1 sees is as bright, whatever the form of the room.
#[test]
fn rooms_whose_walls_glow_on_both_sides_light_all_in_them_alike() {
    let mut verdict = Verdict::on("floors in glowing rooms");
    for (name, canonical, _) in solids() {
        let is_room = match canonical {
            CanonicalShape::Ellipsoid | CanonicalShape::Box => true,
            CanonicalShape::Cone { capped, .. } => capped,
            _ => false,
        };
        if !is_room {
            continue;
        }
        let mut scene = under(canonical, DAffine3::IDENTITY, 1.0);
        scene.materials[1].two_sided = true;
        // A small floor in the middle instead of the plane.
        scene.shapes[0].geometry = Geometry::Placed {
            canonical: CanonicalShape::Rectangle,
            world_from_canonical: DAffine3::from_translation(0.25 * DVec3::Y)
                * DAffine3::from_scale(DVec3::splat(0.01)),
        };
        scene.cameras = vec![looking(dvec3(0.0, 0.35, 0.0), 0.25 * DVec3::Y, 0.05)];
        scene.cameras[0].up = DVec3::Z;
        let found = mean(&scene, &paths(256, (16, 16), 0));
        near(&mut verdict, name, found, 0.5, 0.003);
    }
    verdict.close();
}

/// A texture is looked up where a sample is: shapes whose pictures are half black light the floor as those do that paths
/// find by themselves, in a shell of glass that bends nothing.
#[test]
fn textures_of_glowing_shapes_are_looked_up_where_their_samples_are() {
    let mut verdict = Verdict::on("floors under textured shapes");
    for (name, canonical, _) in solids() {
        let mut scene = under(canonical, placed(0.3), 4.0);
        scene.materials[1].two_sided = true;
        let texels = [Vec3::ONE, Vec3::ZERO, Vec3::splat(0.2), Vec3::ONE];
        add_picture_texture(&mut scene, Picture::opaque(2, 2, texels));
        scene.materials[1].textures.emission = Some(0);
        let mut found_by_paths = scene.clone();
        let shell = found_by_paths.add_material(clear());
        found_by_paths.add_sphere(placed(0.3).translation, 0.9, shell);
        let found = mean(&scene, &paths(512, (24, 16), 0));
        // Two bounces lead through the shell.
        let expected = mean(&found_by_paths, &paths(4096, (24, 16), 2));
        near(&mut verdict, name, found, expected, 0.015 * expected);
    }
    verdict.close();
}

/// Planes are no lights, and light samples for shapes beside them take nothing of their light.
#[test]
fn glowing_planes_keep_their_light_beside_glowing_shapes() {
    let mut ceiling = floor(0.8);
    ceiling.add_plane(3.0 * DVec3::Y, -DVec3::Y, 1);
    let settings = paths(256, (16, 16), 0);
    let alone = mean(&ceiling, &settings);
    assert!((alone - 0.4).abs() < 0.004, "{alone} of half of 0.8");
    for (_, canonical, _) in solids().into_iter().take(2) {
        let mut scene = ceiling.clone();
        let dim = scene.add_material(Material {
            emission: Vec3::splat(1e-6),
            ..matte(0.0)
        });
        scene.shapes.push(Shape {
            geometry: Geometry::Placed {
                canonical,
                world_from_canonical: placed(1e-3),
            },
            material: dim,
            node: None,
            name: String::new(),
        });
        let found = mean(&scene, &settings);
        assert!((found / alone - 1.0).abs() < 0.01, "{found}, not {alone}");
    }
}

/// Emitters are chosen in proportion to their areas, which the host computes.
#[test]
fn areas_of_shapes_decide_how_often_they_are_chosen() {
    let mut verdict = Verdict::on("chances of shapes beside a square");
    let area_of_mesh = |mesh: &Mesh| -> f64 {
        let corner = |i: u32| placed(0.3).transform_point3(mesh.positions[i as usize].as_dvec3());
        let triangles = mesh.triangles.iter().map(|triangle| {
            let [a, b, c] = triangle.map(corner);
            (b - a).cross(c - a).length() / 2.0
        });
        triangles.sum()
    };
    for (name, canonical, meshes) in solids() {
        let mut scene = under(canonical, placed(0.3), 2.0);
        scene.shapes.push(Shape {
            geometry: Geometry::Placed {
                canonical: CanonicalShape::Rectangle,
                world_from_canonical: DAffine3::from_translation(5.0 * DVec3::Y),
            },
            material: 1,
            node: None,
            name: String::new(),
        });
        let packed = pack::scene(&scene).expect("a scene that can be packed");
        let view = packed.frame(&scene.frame(0.0)).expect("a frame");
        let ends: Vec<_> = view.emitters.iter().map(|emitter| emitter.end).collect();
        assert_eq!(ends.len(), 2, "{name}");
        let area: f64 = meshes.iter().map(area_of_mesh).sum();
        let chances = [f64::from(ends[0]), 1.0 - f64::from(ends[0])];
        // In either order: the square has an area of 4.
        let expected = area / (area + 4.0);
        let off = chances.map(|chance| (chance / expected - 1.0).abs());
        let least = off[0].min(off[1]);
        verdict.that(name, least < 0.05, || {
            format!("{chances:?}, not {expected}")
        });
    }
    verdict.close();
}
