//! Light samples of an emissive surface and paths that hit it agree on which side of it shines, and on which surface is
//! there: the light of both together is that of Lambert's formula.

use super::emitter_tree::{lambert, mean_irradiance};
use super::light_chances::{chances, mean_from};
use super::{clear, glowing_square, lit_floor, looking, matte, mean, near, paths};
use crate::import::gltf::model::Model;
use crate::motion_blur::track;
use crate::reference::scenes::{Build, quad};
use crate::support::verdict::Verdict;
use glam::{DAffine3, DMat3, DVec3, Vec3, dvec3};
use glimray::pack;
use glimray::render::{Integrator, RenderSettings};
use glimray::scene::{
    Attenuation, Background, Camera, CanonicalShape, Deformation, Geometry, Light, LightKind,
    Material, MorphTarget, Node, NodeProperty, Phong, Scene, Shape, Target, Values,
};
use serde_json::{Value, json};
use std::f64::consts::PI;
use std::sync::Arc;

const ALBEDO: f64 = 0.5;

fn dark_floor() -> Scene {
    let mut scene = lit_floor(matte(ALBEDO as f32), Light::default());
    scene.lights.clear();
    scene
}

/// The corners of [`glowing_square`], which shines towards -y.
fn square(placed: DAffine3) -> Vec<DVec3> {
    let corners = [(-1.0, -1.0), (1.0, -1.0), (1.0, 1.0), (-1.0, 1.0)];
    (corners.iter())
        .map(|&(x, z)| placed.transform_point3(dvec3(x, 0.0, z)))
        .collect()
}

/// The irradiance at p from the front of a square, which is on the side of `normal`.
fn from_front(corners: &[DVec3], normal: DVec3, p: DVec3) -> f64 {
    let own: Vec<_> = corners.iter().map(|corner| corner - p).collect();
    match normal.dot(own[0]) < 0.0 {
        true => lambert(&own).abs(),
        false => 0.0,
    }
}

/// Checks the light on the floor, with and without a tree.
fn check(verdict: &mut Verdict, name: &str, scene: &Scene, irradiance: f64) {
    let settings = RenderSettings {
        transparent_shadows: true,
        ..paths(512, (24, 16), 1)
    };
    for from in [2, usize::MAX] {
        let found = mean_from(scene, &settings, from) * PI / ALBEDO;
        let what = format!("{name}, tree from {from}");
        near(verdict, what, found, irradiance, 0.005 * irradiance);
    }
}

/// Normals at the corners of an emitter say which side is its front, even if they are far from those of the triangle and
/// point away from what it lights.
#[test]
fn smooth_normals_of_emitters_do_not_darken_their_front() {
    let mut verdict = Verdict::on("squares with tilted normals over a floor");
    let mut scene = dark_floor();
    let places = [dvec3(1.3, 0.8, -0.2), dvec3(0.3, 0.9, -1.2)];
    let placed =
        places.map(|at| DAffine3::from_translation(at) * DAffine3::from_scale(DVec3::splat(0.3)));
    for (placed, tilt) in placed.into_iter().zip([Vec3::X, Vec3::NEG_Z]) {
        glowing_square(&mut scene, placed, 3.0);
        let mesh = Arc::make_mut(scene.meshes.last_mut().expect("a square"));
        mesh.normals = vec![(Vec3::NEG_Y + 3.0 * tilt).normalize(); 4];
    }
    let expected = mean_irradiance(&scene, |p| {
        let squares = placed.map(|placed| from_front(&square(placed), DVec3::NEG_Y, p));
        3.0 * squares.iter().sum::<f64>()
    });
    check(&mut verdict, "tilted", &scene, expected);
    verdict.close();
}

/// A square turns its front away from the floor, or towards it, by a morph target of its corners and normals while the
/// shutter is open. Light samples may find it in either case.
#[test]
fn fronts_of_emitters_that_deform_follow_their_normals() {
    let mut verdict = Verdict::on("a square that turns over a floor");
    for (name, from, to) in [("away", 0.0, 2.0), ("towards", 2.2, 0.0)] {
        let mut scene = dark_floor();
        let at = DAffine3::from_translation(dvec3(0.9, 0.8, -0.9));
        let placed = [from, to].map(|angle| {
            at * DAffine3::from_scale(DVec3::splat(0.4)) * DAffine3::from_rotation_z(angle)
        });
        glowing_square(&mut scene, placed[0], 3.0);
        let turn = DAffine3::from_rotation_z(to - from);
        let mesh = scene.meshes.last().expect("a square");
        let turned = |v: &Vec3| turn.transform_vector3(v.as_dvec3()).as_vec3() - v;
        scene.deformations.push(Deformation {
            mesh: scene.meshes.len() - 1,
            weights: vec![0.0],
            targets: Arc::new([MorphTarget {
                vertices: (0..4).collect(),
                positions: mesh.positions.iter().map(turned).collect(),
                normals: mesh.normals.iter().map(turned).collect(),
                tangents: Vec::new(),
            }]),
            skin: None,
            flat: Arc::default(),
        });
        let grow = Values::Scalar(vec![0.0, 1.0]);
        scene.tracks.push(track(Target::Weight(0, 0), grow));
        let [first, last] = placed.map(square);
        let normals = placed.map(|placed| placed.transform_vector3(DVec3::NEG_Y));
        let expected = mean_irradiance(&scene, |p| {
            let moments = (0..32).map(|k| {
                let time = (f64::from(k) + 0.5) / 32.0;
                let corners: Vec<_> = (first.iter().zip(&last))
                    .map(|(a, b)| a.lerp(*b, time))
                    .collect();
                let across = (corners[1] - corners[0]).cross(corners[3] - corners[0]);
                let side = across.dot(normals[0].lerp(normals[1], time)).signum();
                from_front(&corners, side * across, p)
            });
            3.0 * moments.sum::<f64>() / 32.0
        });
        check(&mut verdict, name, &scene, expected);
        let mut packed = pack::scene(&scene).expect("a scene that can be packed");
        packed.tree_from = 2;
        let view = packed
            .view(&scene.motion_samples(0.0, 1.0))
            .expect("a view");
        let all = chances(&view, dvec3(0.3, 0.0, -0.2) - packed.origin, DVec3::Y);
        let are_found = all.emitters.iter().all(|(chance, _)| *chance > 0.0);
        verdict.that(format!("{name}, chances"), are_found, || {
            format!("{:?}", all.emitters)
        });
    }
    verdict.close();
}

/// Panes between an emitter and what it lights take no light, however many they are: light samples still end before the
/// emitter.
#[test]
fn emitters_shine_through_any_number_of_panes() {
    let mut verdict = Verdict::on("panes between an emitter and a floor");
    let lamp = DAffine3::from_translation(dvec3(0.4, 1.0, -0.9))
        * DAffine3::from_scale(dvec3(0.4, 1.0, 0.4));
    for panes in [1, 2, 9] {
        let mut scene = dark_floor();
        glowing_square(&mut scene, lamp, 3.0);
        let clear = scene.add_material(Material {
            thin: true,
            bsdf: Phong {
                diffuse: Vec3::ZERO,
                transmit: Vec3::ONE,
                opacity: 0.0,
                ..Phong::default()
            }
            .into(),
            ..Material::default()
        });
        for k in 0..panes {
            let height = dvec3(0.4, 0.1 + 0.08 * f64::from(k), -0.5);
            let pane = quad(4.0, clear as u32);
            scene.add_mesh(
                pane,
                DAffine3::from_translation(height) * DAffine3::from_rotation_x(0.3),
            );
        }
        scene.cameras = vec![looking(dvec3(0.3, 0.08, 0.6), dvec3(0.3, 0.0, 0.4), 0.1)];
        let expected =
            mean_irradiance(&scene, |p| 3.0 * from_front(&square(lamp), DVec3::NEG_Y, p));
        let found = mean(&scene, &paths(256, (24, 16), 1)) * PI / ALBEDO;
        near(
            &mut verdict,
            format!("{panes} panes"),
            found,
            expected,
            0.005 * expected,
        );
    }
    verdict.close();
}

/// A slab of clear glass ends just below an emitter: a path meets both at once, and the chance of light samples is that of
/// the emitter, a mesh or a shape.
#[test]
fn emitters_that_touch_glass_are_hit_with_their_own_chance() {
    let mut verdict = Verdict::on("glass under emitters over a floor");
    let scale = dvec3(0.4, 1.0, 0.4);
    let lamps = [dvec3(0.4, 1.0, -0.9), dvec3(-0.6, 0.9, -0.2)]
        .map(|at| DAffine3::from_translation(at) * DAffine3::from_scale(scale));
    let tilted = lamps[1] * DAffine3::from_rotation_z(0.4);
    let lamps = [lamps[0], tilted];
    for is_shape in [false, true] {
        let mut scene = dark_floor();
        glowing_square(&mut scene, lamps[0], 3.0);
        let material = scene.materials.len() - 1;
        if is_shape {
            scene.meshes.clear();
            scene.instances.clear();
            scene.shapes.push(Shape {
                geometry: Geometry::Placed {
                    canonical: CanonicalShape::Rectangle,
                    world_from_canonical: lamps[0] * DAffine3::from_scale(dvec3(1.0, -1.0, -1.0)),
                },
                material,
                node: None,
                name: String::new(),
            });
        }
        glowing_square(&mut scene, lamps[1], 3.0);
        let shell = scene.add_material(clear());
        scene.shapes.push(Shape {
            geometry: Geometry::Placed {
                canonical: CanonicalShape::Box,
                world_from_canonical: DAffine3::from_translation(dvec3(0.4, 0.9 - 4e-6, -0.9))
                    * DAffine3::from_scale(dvec3(0.5, 0.1, 0.5)),
            },
            material: shell,
            node: None,
            name: String::new(),
        });
        let front = tilted.transform_vector3(DVec3::NEG_Y);
        let expected = mean_irradiance(&scene, |p| {
            3.0 * (from_front(&square(lamps[0]), DVec3::NEG_Y, p)
                + from_front(&square(tilted), front, p))
        });
        let name = if is_shape { "shape" } else { "mesh" };
        check(&mut verdict, name, &scene, expected);
    }
    verdict.close();
}

/// Half the side of [`lamp_model`], and the place of its middle beside the axis y.
const HALF: f64 = 0.3;
const ASIDE: DVec3 = dvec3(0.4, 0.0, -0.3);

/// A glTF model: a square whose corners run counter-clockwise as seen from below, at this height and with this scale and
/// material. Its normals are those of its winding, in the file or not.
fn lamp_model(height: f64, scale: [f64; 3], has_normals: bool, material: Value) -> Scene {
    let corners = [(-1.0, -1.0), (1.0, -1.0), (1.0, 1.0), (-1.0, 1.0)];
    let corners = corners.map(|(x, z)| [x * HALF as f32, 0.0, z * HALF as f32]);
    let mut model = Model::new();
    let position = model.vectors(&[0, 1, 2, 0, 2, 3].map(|i: usize| corners[i]));
    let mut attributes = json!({});
    if has_normals {
        attributes["NORMAL"] = json!(model.vectors(&[[0.0, -1.0, 0.0]; 6]));
    }
    model.primitive(position, json!({ "attributes": attributes, "material": 0 }));
    model.push("materials", material);
    let translation = ASIDE + height * DVec3::Y;
    model.json["nodes"][0]["translation"] = json!(translation.to_array());
    model.json["nodes"][0]["scale"] = json!(scale);
    let mut scene = model.scene();
    scene.shapes.clear();
    scene.lights.clear();
    scene.background = Background::Color(Vec3::ZERO);
    scene.ambient = Vec3::ZERO;
    scene
}

/// A black surface that emits 1.
fn emissive(double_sided: bool) -> Value {
    json!({
        "emissiveFactor": [1, 1, 1], "doubleSided": double_sided,
        "pbrMetallicRoughness": { "baseColorFactor": [0, 0, 0, 1] },
    })
}

/// Glass around the lamp, behind which paths alone find it.
fn add_glass(scene: &mut Scene, height: f64) {
    let material = scene.add_material(clear());
    let around = DAffine3::from_translation(ASIDE + height * DVec3::Y);
    scene.shapes.push(Shape {
        geometry: Geometry::Placed {
            canonical: CanonicalShape::Box,
            world_from_canonical: around * DAffine3::from_scale(dvec3(0.35, 0.02, 0.35)),
        },
        material,
        node: None,
        name: String::new(),
    });
}

/// A camera below lamps that sees a part of the floor.
fn below_lamps() -> Camera {
    looking(dvec3(0.1, 0.5, 1.0), dvec3(0.3, 0.0, -0.2), 0.3)
}

/// The irradiance at a point of the plane y = 0 from a lamp at this height.
fn from_lamp(height: f64, p: DVec3) -> f64 {
    let placed = DAffine3::from_translation(ASIDE + height * DVec3::Y)
        * DAffine3::from_scale(dvec3(HALF, 1.0, HALF));
    let corners: Vec<_> = (square(placed).iter()).map(|corner| corner - p).collect();
    lambert(&corners).abs()
}

/// glTF renders no back faces of single-sided materials: a lamp below a ceiling lights the floor, and the ceiling above it
/// only if it is double-sided. Light samples, paths that hit the lamp, and both together find this.
#[test]
fn single_sided_lamps_of_gltf_do_not_light_the_ceiling_above_them() {
    let mut verdict = Verdict::on("a glTF lamp below a ceiling");
    let floor = below_lamps();
    let ceiling = looking(dvec3(-0.1, -0.15, -0.3), dvec3(0.4, 0.0, -0.3), 0.2);
    for (name, double_sided, camera, height, is_lit) in [
        ("floor, single-sided", false, floor.clone(), 0.7, true),
        ("floor, double-sided", true, floor, 0.7, true),
        ("ceiling, single-sided", false, ceiling.clone(), -0.3, false),
        ("ceiling, double-sided", true, ceiling, -0.3, true),
    ] {
        let mut scene = lamp_model(height, [1.0; 3], false, emissive(double_sided));
        let seen = scene.add_material(matte(ALBEDO as f32));
        let black = scene.add_material(matte(0.0));
        scene.add_plane(DVec3::ZERO, DVec3::Y, seen);
        let opposite = camera.look_from.y.signum() * DVec3::Y;
        scene.add_plane(opposite, DVec3::Y, black);
        scene.cameras = vec![camera];
        let lit = mean_irradiance(&scene, |p| from_lamp(height, p));
        let expected = if is_lit { lit } else { 0.0 };
        let mut measure = |how: &str, scene: &Scene, (samples, depth), from, tolerance: f64| {
            let settings = paths(samples, (24, 16), depth);
            let found = mean_from(scene, &settings, from) * PI / ALBEDO;
            let what = format!("{name}, {how}");
            // Behind glass 1.1e-12 was measured where nothing is expected.
            near(
                &mut verdict,
                what,
                found,
                expected,
                tolerance * expected + 2e-12,
            );
        };
        measure("table", &scene, (512, 0), usize::MAX, 0.005);
        let mut behind_glass = scene.clone();
        add_glass(&mut behind_glass, height);
        measure("behind glass", &behind_glass, (1024, 1), usize::MAX, 0.01);
        // A single patch has a table. The other light does not reach what is seen.
        scene.add_point_light(5.0 * opposite, 0.1);
        measure("tree", &scene, (512, 0), 1, 0.005);
    }
    verdict.close();
}

/// The front of a triangle is where its corners run counter-clockwise, or clockwise below a node with a negative
/// determinant: a reflection turns a lamp around only if it is along the normal.
#[test]
fn mirrored_lamps_of_gltf_shine_from_their_fronts() {
    let mut verdict = Verdict::on("mirrored glTF lamps over a floor");
    let height = 0.7;
    for has_normals in [false, true] {
        for (scale, is_lit) in [
            ([1.0, 1.0, 1.0], true),
            ([-1.0, 1.0, 1.0], true),
            ([1.0, 1.0, -1.0], true),
            ([1.0, -1.0, 1.0], false),
            ([-1.0, -1.0, -1.0], false),
        ] {
            let mut scene = lamp_model(height, scale, has_normals, emissive(false));
            let seen = scene.add_material(matte(ALBEDO as f32));
            scene.add_plane(DVec3::ZERO, DVec3::Y, seen);
            scene.cameras = vec![below_lamps()];
            let lit = mean_irradiance(&scene, |p| from_lamp(height, p));
            let found = mean(&scene, &paths(256, (24, 16), 0)) * PI / ALBEDO;
            let expected = if is_lit { lit } else { 0.0 };
            let name = format!("{scale:?}, normals {has_normals}");
            near(&mut verdict, name, found, expected, 0.01 * expected);
        }
    }
    verdict.close();
}

/// A lamp below a node becomes its image and shines to the side to which its normal is mapped, whether the node mirrors, moves
/// or scales unevenly. A lamp keeps its intensity, of which a patch of area A has the radiance π/A along its normal; a glowing
/// mesh keeps its radiance.
#[test]
fn lamps_below_any_transform_shine_to_the_side_of_their_normal() {
    let mut verdict = Verdict::on("lamps below nodes over a floor");
    let place = dvec3(0.9, 0.8, -0.9);
    for (scale, is_lit) in [
        (DVec3::ONE, true),
        (dvec3(-1.0, 1.0, 1.0), true),
        (dvec3(1.0, -1.0, 1.0), false),
        (dvec3(-1.0, -1.0, -1.0), false),
        (dvec3(-1.0, -1.0, 1.0), false),
        (dvec3(2.0, 0.01, -0.5), true),
        (dvec3(0.3, -7.0, 1.5), false),
    ] {
        for moves in [false, true] {
            let below_node = |scene: &mut Scene| {
                scene.nodes.push(Node {
                    translation: place,
                    scale,
                    ..Node::default()
                });
                if moves {
                    let stay = Values::Vector(vec![place; 2]);
                    let target = Target::Node(0, NodeProperty::Translation);
                    scene.tracks.push(track(target, stay));
                }
            };
            let world_from_node = DAffine3 {
                matrix3: DMat3::from_diagonal(scale),
                translation: place,
            };
            let corners = square(world_from_node * DAffine3::from_scale(DVec3::splat(0.4)));
            let area = (corners[1] - corners[0])
                .cross(corners[3] - corners[0])
                .length();
            let normal = scale.y.signum() * DVec3::NEG_Y;
            for (kind, radiance) in [("rectangle", 2.0 * PI / area), ("mesh", 3.0)] {
                let mut scene = dark_floor();
                below_node(&mut scene);
                match kind {
                    "mesh" => {
                        glowing_square(&mut scene, DAffine3::from_scale(DVec3::splat(0.4)), 3.0);
                        scene.instances.last_mut().expect("a square").node = Some(0);
                    }
                    _ => scene.lights.push(Light {
                        kind: LightKind::Rectangle {
                            center: DVec3::ZERO,
                            edge_u: 0.4 * DVec3::X,
                            edge_v: 0.4 * DVec3::Z,
                        },
                        color: Vec3::splat(2.0),
                        attenuation: Attenuation::InverseSquare,
                        node: Some(0),
                        ..Light::default()
                    }),
                }
                let lit = mean_irradiance(&scene, |p| radiance * from_front(&corners, normal, p));
                assert_eq!(lit > 0.0, is_lit, "{scale}");
                let name = format!("{kind}, {scale}, moves {moves}");
                check(&mut verdict, &name, &scene, lit);
            }
        }
    }
    verdict.close();
}

/// A surface stays visible from behind. Without light, it shows what it emits there: nothing if it is single-sided, but an
/// unlit one shows its colour.
#[test]
fn both_integrators_show_what_the_back_of_a_gltf_surface_emits() {
    let mut verdict = Verdict::on("glTF surfaces seen from both sides");
    let unlit = |double_sided: bool| {
        json!({
            "doubleSided": double_sided, "extensions": { "KHR_materials_unlit": {} },
            "pbrMetallicRoughness": { "baseColorFactor": [1, 1, 1, 1] },
        })
    };
    for (name, material, behind) in [
        ("single-sided", emissive(false), 0.0),
        ("double-sided", emissive(true), 1.0),
        ("unlit, single-sided", unlit(false), 1.0),
        ("unlit, double-sided", unlit(true), 1.0),
    ] {
        let mut scene = lamp_model(0.0, [1.0; 3], false, material);
        for (side, from, expected) in [("front", -1.0, 1.0), ("back", 1.0, behind)] {
            scene.cameras = vec![looking(ASIDE + dvec3(0.2, from, 0.1), ASIDE, 0.1)];
            for integrator in [Integrator::Whitted, Integrator::Path] {
                let settings = RenderSettings {
                    integrator,
                    ..paths(4, (8, 8), 1)
                };
                let found = mean(&scene, &settings);
                let what = format!("{name}, {side}, {integrator:?}");
                near(&mut verdict, what, found, expected, 1e-6);
            }
        }
    }
    verdict.close();
}
