//! Emissive shapes as lights of paths.

use super::{clear, lights, lit_floor, looking, matte, mean, near, paths};
use crate::motion_blur::{exposed, track};
use crate::reference::compare::render;
use crate::reference::scenes::Build;
use crate::support::random::Random;
use crate::support::verdict::Verdict;
use glam::{DAffine3, DMat3, DVec3, Vec3, dvec3, vec3};
use glimray::pack;
use glimray::scene::{
    Antialias, Attenuation, Background, CanonicalShape, Deformation, Geometry, Light, LightKind,
    LightProperty, Material, Mesh, MorphTarget, Node, Phong, Scene, Shape, Target, Values,
};
use std::f32::consts::PI;
use std::sync::Arc;

/// The surface of an area light.
fn surface(kind: &LightKind) -> Geometry {
    match *kind {
        LightKind::Rectangle {
            center,
            edge_u,
            edge_v,
        } => Geometry::Placed {
            canonical: CanonicalShape::Rectangle,
            world_from_canonical: DAffine3 {
                matrix3: DMat3::from_cols(edge_u, -DVec3::Y, -edge_v),
                translation: center,
            },
        },
        LightKind::Disc { center, radius, .. } => Geometry::Placed {
            canonical: CanonicalShape::Disc { hole: 0.0 },
            world_from_canonical: DAffine3 {
                matrix3: DMat3::from_cols(radius * DVec3::X, -DVec3::Y, -radius * DVec3::Z),
                translation: center,
            },
        },
        LightKind::Sphere { center, radius } => Geometry::Sphere { center, radius },
        _ => unreachable!("not an area light"),
    }
}

/// A floor below an emissive shape instead of the lamp.
fn under(kind: &LightKind, floor: &Material, radiance: f64, node: Option<Node>) -> Scene {
    let mut scene = lit_floor(floor.clone(), Light::default());
    scene.lights.clear();
    let material = scene.add_material(Material {
        emission: Vec3::splat(radiance as f32),
        two_sided: false,
        ..matte(0.0)
    });
    let node = node.map(|node| {
        scene.nodes.push(node);
        scene.nodes.len() - 1
    });
    scene.shapes.push(Shape {
        geometry: surface(kind),
        material,
        node,
        name: String::new(),
    });
    scene
}

/// Emissive spheres, rectangles and discs light a floor as lamps of the same shape and radiance do, near and far, and
/// wherever a node puts them.
#[test]
fn emissive_shapes_shine_like_lamps_of_the_same_radiance() {
    let mut verdict = Verdict::on("floors under emissive shapes");
    let glossy = Material {
        bsdf: Phong {
            specular: Vec3::splat(2.0),
            shininess: 20.0,
            ..matte(0.5).classical().into_owned()
        }
        .into(),
        ..matte(0.5)
    };
    for (name, kind) in lights()
        .into_iter()
        .filter(|(_, kind)| kind.radiance().is_some())
    {
        let strength = kind.radiance().expect("an area light");
        let lamp = Light {
            kind,
            color: Vec3::ONE,
            attenuation: Attenuation::InverseSquare,
            samples: 1,
            visible: false,
            node: None,
            name: String::new(),
        };
        let expected = mean(&lit_floor(glossy.clone(), lamp), &paths(1024, (24, 16), 0));
        let moved = Node {
            translation: dvec3(0.25, 0.0, 0.0),
            placement: DAffine3::from_translation(dvec3(-0.25, 0.0, 0.0)),
            ..Node::default()
        };
        for (place, node) in [("still", None), ("carried", Some(moved))] {
            let scene = under(&kind, &glossy, strength, node);
            let found = mean(&scene, &paths(512, (24, 16), 0));
            near(
                &mut verdict,
                format!("{name}, {place}"),
                found,
                expected,
                0.006 * expected,
            );
        }
    }
    verdict.close();
}

/// A small lamp is found by light samples: without them a picture of few samples would hardly show it.
#[test]
fn small_emissive_shapes_are_found_by_few_samples() {
    let mut verdict = Verdict::on("the spread of pixels under small lamps");
    let position = dvec3(0.3, 1.0, -0.2);
    for (name, kind) in [
        (
            "sphere",
            LightKind::Sphere {
                center: position,
                radius: 0.02,
            },
        ),
        (
            "disc",
            LightKind::Disc {
                center: position,
                normal: -DVec3::Y,
                radius: 0.02,
            },
        ),
        (
            "rectangle",
            LightKind::Rectangle {
                center: position,
                edge_u: 0.02 * DVec3::X,
                edge_v: 0.02 * DVec3::Z,
            },
        ),
    ] {
        let mut scene = under(&kind, &matte(0.5), 1000.0, None);
        scene.output.antialias = Some(Antialias::Stratified);
        let few = mean(&scene, &paths(4, (16, 16), 0));
        let many = mean(&scene, &paths(1024, (16, 16), 0));
        near(&mut verdict, name, few, many, 0.02 * many);
    }
    verdict.close();
}

/// A triangle for each center, of which every fourth glows, and the corners of all of them.
pub fn dust(scene: &mut Scene, centers: &[Vec3]) -> Mesh {
    let glowing = scene.add_material(Material {
        emission: Vec3::splat(20.0),
        ..matte(0.0)
    });
    let plain = scene.add_material(matte(0.3));
    let mut mesh = Mesh::default();
    let mut random = Random::new(3);
    for (index, center) in centers.iter().enumerate() {
        let first = mesh.positions.len() as u32;
        let corners = [(); 3].map(|()| *center + 0.06 * random.in_cube().as_vec3());
        mesh.positions.extend(corners);
        let material = if index % 4 == 0 { glowing } else { plain };
        mesh.materials.extend([material as u32; 3]);
        mesh.triangles.push([first, first + 1, first + 2]);
    }
    mesh.normals = vec![Vec3::Y; mesh.positions.len()];
    mesh
}

/// Triangles that a morph target scatters, so that their tree is built anew, shine as if they had always been there.
#[test]
fn glowing_triangles_keep_their_light_when_their_tree_is_rebuilt() {
    let mut random = Random::new(5);
    let moved: Vec<Vec3> = (0..400)
        .map(|_| (0.5 * random.in_cube()).as_vec3() + vec3(0.3, 0.9, -0.2))
        .collect();
    let rest: Vec<Vec3> = (0..400_u16)
        .map(|k| 0.05 * vec3((k % 20).into(), 40.0, (k / 20).into()))
        .collect();
    let mut still = lit_floor(matte(0.5), Light::default());
    still.lights.clear();
    let mut deforming = still.clone();
    let mesh = dust(&mut still, &moved);
    still.add_mesh(mesh, DAffine3::IDENTITY);
    let mesh = dust(&mut deforming, &rest);
    let count = mesh.positions.len() as u32;
    let ways = (0..count as usize).map(|k| moved[k / 3] - rest[k / 3]);
    deforming.deformations.push(Deformation {
        mesh: deforming.meshes.len(),
        weights: vec![1.0],
        targets: Arc::new([MorphTarget {
            vertices: (0..count).collect(),
            positions: ways.collect(),
            normals: Vec::new(),
            tangents: Vec::new(),
        }]),
        skin: None,
        flat: Arc::default(),
    });
    deforming.add_mesh(mesh, DAffine3::IDENTITY);
    let packed = pack::scene(&deforming).expect("a scene that can be packed");
    let view = packed.frame(&deforming.frame(0.0)).expect("a frame");
    assert_eq!(view.rebuilt_count(), 1);
    let expected = mean(&still, &paths(256, (24, 16), 0));
    let found = mean(&deforming, &paths(256, (24, 16), 0));
    assert!(
        (found / expected - 1.0).abs() < 0.01,
        "{found}, expected {expected}"
    );
}

/// A lamp that is black when the shutter opens and then becomes brighter gives half of its last light.
#[test]
fn lamps_that_are_lit_while_the_shutter_is_open_are_sampled() {
    let mut verdict = Verdict::on("a floor under lamps that are switched on");
    for (name, kind) in lights() {
        for beside in [false, true] {
            let lamp = Light {
                kind,
                color: Vec3::ONE,
                attenuation: Attenuation::InverseSquare,
                ..Light::default()
            };
            let mut scene = lit_floor(matte(0.5), lamp.clone());
            if beside {
                let kind = LightKind::Point {
                    position: dvec3(-0.5, 1.5, 0.0),
                };
                scene.lights.push(Light { kind, ..lamp });
            }
            let settings = paths(256, (24, 16), 0);
            let lit = mean(&scene, &settings);
            let others = match beside {
                true => {
                    let mut alone = scene.clone();
                    alone.lights.remove(0);
                    mean(&alone, &settings)
                }
                false => 0.0,
            };
            let ramp = Values::Vector(vec![DVec3::ZERO, DVec3::ONE]);
            let target = Target::Light(0, LightProperty::Color);
            scene.tracks.push(track(target, ramp));
            let image = exposed(&scene, &settings);
            let sum: f64 = image.pixels.iter().map(|pixel| f64::from(pixel[1])).sum();
            let expected = others + (lit - others) / 2.0;
            let what = format!("{name}, another lamp {beside}");
            let found = sum / image.pixels.len() as f64;
            near(&mut verdict, what, found, expected, 0.01 * expected);
        }
    }
    verdict.close();
}

/// A ball of triangles around the origin: `rows` bands of twice as many quads.
pub fn globe(radius: f32, rows: u32, material: u32) -> Mesh {
    let columns = 2 * rows;
    let mut mesh = Mesh::default();
    for y in 0..=rows {
        for x in 0..=columns {
            let [down, around] = [(y, rows), (x, rows)].map(|(k, all)| PI * k as f32 / all as f32);
            let out = vec3(
                down.sin() * around.cos(),
                down.cos(),
                down.sin() * around.sin(),
            );
            mesh.positions.push(radius * out);
            mesh.normals.push(out);
            mesh.materials.push(material);
        }
    }
    for y in 0..rows {
        for x in 0..columns {
            let first = y * (columns + 1) + x;
            let below = first + columns + 1;
            mesh.triangles.push([first, first + 1, below]);
            mesh.triangles.push([first + 1, below + 1, below]);
        }
    }
    mesh
}

/// A closed room with matte walls, seen from inside.
pub fn room() -> Scene {
    let mut scene = Scene {
        cameras: vec![looking(dvec3(0.0, 1.0, 1.9), dvec3(0.0, 0.9, 0.0), 0.9)],
        materials: vec![matte(0.6)],
        background: Background::Color(Vec3::ZERO),
        ..Scene::default()
    };
    for (point, normal) in [
        (DVec3::ZERO, DVec3::Y),
        (2.0 * DVec3::Y, -DVec3::Y),
        (-DVec3::X, DVec3::X),
        (DVec3::X, -DVec3::X),
        (-DVec3::Z, DVec3::Z),
        (2.0 * DVec3::Z, -DVec3::Z),
    ] {
        scene.add_plane(point, normal, 0);
    }
    scene
}

/// A room that a glowing mesh lights has at most a quarter of the noise of one in which a shell of glass that bends nothing
/// is around the mesh: paths then find it by themselves only.
#[test]
fn light_samples_of_a_glowing_mesh_take_most_of_the_noise_away() {
    let radius = 0.15;
    let center = dvec3(0.3, 1.5, -0.2);
    let mut sampled = room();
    let glowing = sampled.add_material(Material {
        emission: Vec3::splat(30.0),
        two_sided: false,
        ..matte(0.0)
    });
    sampled.add_mesh(
        globe(radius, 24, glowing as u32),
        DAffine3::from_translation(center),
    );
    let mut found = sampled.clone();
    let shell = found.add_material(clear());
    found.add_sphere(center, 1.1 * f64::from(radius), shell);
    let pictures = [&sampled, &found].map(|scene| {
        let image = |samples| render(scene, &paths(samples, (40, 30), 6)).0;
        let (few, many) = (image(64), image(4096));
        let luminance = |pixel: &[f32; 4]| f64::from(pixel[0] + pixel[1] + pixel[2]) / 3.0;
        let pairs = few.pixels.iter().zip(&many.pixels);
        let errors = pairs.map(|(few, many)| {
            let [few, many] = [few, many].map(luminance);
            ((few - many) / many.max(1e-3)).powi(2)
        });
        let sum: f64 = many.pixels.iter().map(luminance).sum();
        [errors.sum::<f64>() / few.pixels.len() as f64, sum]
    });
    let [[sampled, light], [found, same_light]] = pictures;
    assert!(
        (light / same_light - 1.0).abs() < 0.01,
        "{light}, {same_light}"
    );
    assert!(
        sampled <= found / 4.0,
        "relative MSE {sampled}, and {found} without light samples"
    );
    println!("relative MSE {sampled:.5}, and {found:.5} without light samples");
}
