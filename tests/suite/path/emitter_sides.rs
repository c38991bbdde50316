//! Light samples of an emissive surface and paths that hit it agree on which side of it shines, and on which surface is
//! there: the light of both together is that of Lambert's formula.

use super::emitter_tree::{lambert, mean_irradiance};
use super::light_chances::{chances, mean_from};
use super::{clear, glowing_square, lit_floor, looking, matte, mean, near, paths};
use crate::motion_blur::track;
use crate::reference::scenes::{Build, quad};
use crate::support::verdict::Verdict;
use glam::{DAffine3, DVec3, Vec3, dvec3};
use glimray::pack;
use glimray::render::RenderSettings;
use glimray::scene::{
    CanonicalShape, Deformation, Geometry, Light, Material, MorphTarget, Scene, Shape, Target,
    Values,
};
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
            diffuse: Vec3::ZERO,
            transmit: Vec3::ONE,
            thin: true,
            opacity: 0.0,
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
