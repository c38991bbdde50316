//! Deforming meshes: rays meet them where a search in f64 finds them, and they blur.

use crate::instances::{packed, rendered};
use crate::motion_blur::{self, SIDE, blurred, mean, place, stage, track};
use crate::ray_query::{toward, triangle};
use crate::reference::compare::{check_same_bits, open_gpu, sized};
use crate::reference::scenes::{self, Build};
use crate::support::random::Random;
use crate::support::verdict::Verdict;
use glam::{DAffine3, DMat4, DQuat, DVec3, Vec3, dvec3};
use glimray::image::Image;
use glimray::pack::{PackedScene, PackedView};
use glimray::render::{
    ExecutionPolicy, Fetch, Fingerprint, QueryRay, RayQuery, RayTest, RenderSettings, Renderer,
    Tone,
};
use glimray::scene::{
    Attenuation, Deformation, Influences, Instance, Joint, Light, LightKind, Material, Mesh,
    MorphTarget, Node, NodeProperty, ObjectRef, Phong, Scene, Skin, Target, Values,
};
use std::f64::consts::PI;
use std::sync::Arc;

/// A grid of quads over [0, 1]², at the places that `at` gives; normals along z.
fn sheet(columns: u32, rows: u32, material: u32, at: impl Fn(f64, f64) -> DVec3) -> Mesh {
    let mut mesh = Mesh::default();
    for y in 0..=rows {
        for x in 0..=columns {
            let (u, v) = (
                f64::from(x) / f64::from(columns),
                f64::from(y) / f64::from(rows),
            );
            mesh.positions.push(at(u, v).as_vec3());
        }
    }
    let count = mesh.positions.len();
    mesh.normals = vec![Vec3::Z; count];
    mesh.materials = vec![material; count];
    for y in 0..rows {
        for x in 0..columns {
            let first = y * (columns + 1) + x;
            let above = first + columns + 1;
            mesh.triangles.push([first, first + 1, above]);
            mesh.triangles.push([first + 1, above + 1, above]);
        }
    }
    mesh
}

fn node(scene: &mut Scene, translation: DVec3, parent: Option<usize>) -> usize {
    scene.nodes.push(Node {
        translation,
        parent,
        ..Node::default()
    });
    scene.nodes.len() - 1
}

/// Adds a mesh with one instance and returns its index.
fn added(scene: &mut Scene, mesh: Mesh) -> usize {
    scene.add_mesh(mesh, DAffine3::IDENTITY);
    scene.meshes.len() - 1
}

/// Joins vertices to two joints, by the share of the second.
fn skin(joints: [Joint; 2], shares: impl Iterator<Item = f64>) -> Skin {
    let mut influences = Influences::default();
    for share in shares {
        influences.push([(0, (1.0 - share) as f32), (1, share as f32)]);
    }
    Skin {
        joints: joints.into(),
        influences: influences.into(),
    }
}

fn deform(scene: &mut Scene, mesh: usize, skin: Option<Skin>, targets: Vec<MorphTarget>) {
    scene.deformations.push(Deformation {
        mesh,
        weights: vec![0.0; targets.len()],
        targets: targets.into(),
        skin,
        flat: Arc::default(),
    });
}

/// Far from the world's origin.
const FAR: DVec3 = dvec3(1000.0, 200.0, -500.0);

/// A tube whose upper half bends and twists, a sheet on a moving node that waves, a still mesh with texture
/// coordinates and a sphere.
pub fn party() -> Scene {
    let mut scene = scenes::empty();
    scene.render_origin = Some(FAR);
    let foot = node(&mut scene, FAR, None);
    let knee = node(&mut scene, dvec3(0.0, 1.0, 0.0), Some(foot));
    let tube = sheet(24, 20, 0, |u, v| {
        let angle = 2.0 * PI * u;
        dvec3(0.4 * angle.cos(), 2.0 * v, 0.4 * angle.sin())
    });
    let bound = |node, y: f64| Joint {
        node: Some(node),
        node_from_mesh: DAffine3::from_translation(dvec3(0.0, -y, 0.0)),
    };
    let shares: Vec<f64> = tube.positions.iter().map(|p| share(p.as_dvec3())).collect();
    let tube = added(&mut scene, tube);
    let skin = skin([bound(foot, 0.0), bound(knee, 1.0)], shares.into_iter());
    deform(&mut scene, tube, Some(skin), Vec::new());
    let turn = |angle| DQuat::from_euler(glam::EulerRot::XYZ, angle, 0.7 * angle, 0.0);
    let turns = vec![DQuat::IDENTITY, turn(1.2)];
    scene.tracks.push(track(
        Target::Node(knee, NodeProperty::Rotation),
        Values::Rotation(turns),
    ));

    let carrier = node(&mut scene, FAR, None);
    let flag = sheet(12, 12, 0, |u, v| dvec3(2.0 * u - 3.0, 2.0 * v, 0.0));
    let wave = flag.positions.iter().map(|p| Vec3::Z * (3.0 * p.x).sin());
    let target = MorphTarget {
        vertices: (0..flag.positions.len() as u32).collect(),
        positions: wave.collect(),
        normals: Vec::new(),
        tangents: Vec::new(),
    };
    scene.meshes.push(flag.into());
    let mesh = scene.meshes.len() - 1;
    scene.instances.push(Instance {
        mesh,
        placement: DAffine3::from_scale(dvec3(1.0, -0.8, 1.5)),
        node: Some(carrier),
        name: String::new(),
    });
    deform(&mut scene, mesh, None, vec![target]);
    scene
        .tracks
        .push(track(Target::Weight(1, 0), Values::Scalar(vec![0.0, 1.0])));
    let way = vec![FAR, FAR + DVec3::X * 0.5];
    scene.tracks.push(track(
        Target::Node(carrier, NodeProperty::Translation),
        Values::Vector(way),
    ));

    let mut still = scenes::ball(glam::UVec2::new(16, 8), 0);
    still.uvs = vec![glam::Vec2::splat(0.5); still.positions.len()];
    scene.add_mesh(still, DAffine3::from_translation(FAR + DVec3::X * 2.0));
    scene.add_sphere(FAR + dvec3(0.0, -1.0, 0.0), 0.5, 0);
    scene
}

fn share(p: DVec3) -> f64 {
    (p.y - 0.5).clamp(0.0, 1.0)
}

/// The triangles of `party` at a time, by the instance that they belong to.
fn triangles(scene: &Scene, time: f64) -> Vec<(usize, [DVec3; 3])> {
    let turn = {
        let last = DQuat::from_euler(glam::EulerRot::XYZ, 1.2, 0.84, 0.0);
        let (axis, angle) = last.to_axis_angle();
        DMat4::from_quat(DQuat::from_axis_angle(axis, angle * time))
    };
    let knee = DMat4::from_translation(DVec3::Y);
    let bent = knee * turn * knee.inverse();
    let place = |instance: usize, p: Vec3| {
        let p = p.as_dvec3();
        match instance {
            0 => FAR + p * (1.0 - share(p)) + bent.transform_point3(p) * share(p),
            1 => {
                let p = p + DVec3::Z * f64::from((3.0 * p.x as f32).sin()) * time;
                FAR + DVec3::X * 0.5 * time + p * dvec3(1.0, -0.8, 1.5)
            }
            _ => p + FAR + DVec3::X * 2.0,
        }
    };
    let instances = scene.instances.iter().enumerate();
    instances
        .flat_map(|(index, instance)| {
            let mesh = &scene.meshes[instance.mesh];
            let corners = mesh.triangles.iter();
            corners.map(move |t| (index, t.map(|i| place(index, mesh.positions[i as usize]))))
        })
        .collect()
}

fn rays(count: usize, around: DVec3) -> Vec<QueryRay> {
    let mut random = Random::new(3);
    let rays = 0..count;
    rays.map(|_| {
        let (from, to) = (random.in_cube(), random.in_cube());
        toward(around + 4.0 * from, around + 2.0 * to)
    })
    .collect()
}

/// Checks the view against a search through `triangles` and the sphere.
fn check(name: &str, packed: &Arc<PackedScene>, view: &PackedView, scene: &Scene, time: f64) {
    let mut rays = rays(2000, FAR);
    if view.deforms() {
        rays.iter_mut().for_each(|ray| ray.time = time as f32);
    }
    let all = triangles(scene, time);
    let sphere = FAR + dvec3(0.0, -1.0, 0.0);
    let mut verdict = Verdict::on("hits");
    for fetch in [Fetch::Image, Fetch::Buffer] {
        let policy = ExecutionPolicy {
            fetch,
            ..ExecutionPolicy::default()
        };
        let query = RayQuery::new(open_gpu(), packed.clone(), view, policy).expect("a query");
        let hits = query.closest_hits(&rays).expect("hits");
        let (mut differing, mut hit_count) = (0, 0);
        for (ray, hit) in rays.iter().zip(hits) {
            let (origin, direction) = (ray.origin, ray.direction.as_dvec3());
            let hits = all.iter().filter_map(|(index, corners)| {
                let t = triangle(origin, direction, *corners)?;
                Some((t, ObjectRef::Instance(*index)))
            });
            let ball = crate::ray_query::sphere(origin, direction, sphere, 0.5);
            let hits = hits.chain(ball.map(|t| (t, ObjectRef::Shape(0))));
            let expected = hits.min_by(|a, b| a.0.total_cmp(&b.0));
            let found = hit.map(|hit| {
                let object = packed.object_at(view, hit.primitive, hit.instance);
                (f64::from(hit.t), object)
            });
            hit_count += usize::from(expected.is_some());
            differing += usize::from(match (found, expected) {
                (None, None) => false,
                (Some((t, object)), Some((exact, wanted))) => {
                    (t - exact).abs() > 1e-4 * exact || object != Some(wanted)
                }
                _ => true,
            });
        }
        // Rays past an edge within rounding may hit on one side and miss on the other.
        verdict.that(format!("{name}, {fetch:?}"), differing <= 2, || {
            format!("{differing} rays differ")
        });
        assert!(hit_count > 500, "{hit_count} hits");
    }
    verdict.close();
}

#[test]
fn rays_meet_deformed_meshes_where_a_search_finds_them() {
    let scene = party();
    let packed = packed(&scene, 1 << 14);
    let mut before = None;
    for time in [0.0, 0.35, 1.0] {
        let frames = [scene.frame(time)];
        let view = packed
            .view_from(before.as_ref(), &frames)
            .expect("a frame that can be packed");
        assert_eq!(view.rebuilt_count(), 0);
        assert!(!view.deforms());
        check(&format!("at {time}"), &packed, &view, &scene, time);
        let alone = packed.view(&frames).expect("a frame that can be packed");
        assert!(alone == view, "the view at {time} depends on another");
        let again = packed.view_from(Some(&view), &frames);
        assert!(again.expect("the same frame").shares_tlas(&view));
        before = Some(view);
    }
    // In the middle of the shutter interval there is a key.
    let view = packed
        .view(&scene.motion_samples(0.0, 1.0))
        .expect("frames");
    assert!(view.deforms() && view.has_moving_instances());
    check("while the shutter is open", &packed, &view, &scene, 0.5);
}

#[test]
fn a_tree_that_became_poor_is_rebuilt() {
    let mut scene = scenes::empty();
    let dust = sheet(40, 40, 0, |u, v| dvec3(u, v, 0.0));
    // Every vertex goes to a place of its own anywhere.
    let mut random = Random::new(9);
    let count = dust.positions.len();
    let target = MorphTarget {
        vertices: (0..count as u32).collect(),
        positions: (0..count)
            .map(|_| (4.0 * random.in_cube()).as_vec3())
            .collect(),
        normals: Vec::new(),
        tangents: Vec::new(),
    };
    let moved = target.positions.clone();
    let mesh = added(&mut scene, dust);
    deform(&mut scene, mesh, None, vec![target]);
    scene
        .tracks
        .push(track(Target::Weight(0, 0), Values::Scalar(vec![0.0, 1.0])));
    let packed = packed(&scene, 1 << 14);
    let rebuilt = |time: f64| {
        let view = packed.frame(&scene.frame(time)).expect("a frame");
        view.rebuilt_count()
    };
    assert_eq!([0.0, 0.001, 1.0].map(rebuilt), [0, 0, 1]);
    let view = packed.frame(&scene.frame(1.0)).expect("a frame");
    let rays = rays(2000, DVec3::ZERO);
    let policy = ExecutionPolicy::default();
    let query = RayQuery::new(open_gpu(), packed, &view, policy).expect("a query");
    let hits = query.closest_hits(&rays).expect("hits");
    let mesh = &scene.meshes[0];
    let corner = |i: u32| (mesh.positions[i as usize] + moved[i as usize]).as_dvec3();
    let mut differing = 0;
    for (ray, hit) in rays.iter().zip(hits) {
        let ts = mesh.triangles.iter();
        let ts = ts.filter_map(|t| triangle(ray.origin, ray.direction.as_dvec3(), t.map(corner)));
        let expected = ts.min_by(f64::total_cmp);
        differing += usize::from(match (hit, expected) {
            (None, None) => false,
            (Some(hit), Some(t)) => (f64::from(hit.t) - t).abs() > 1e-4 * t.max(1.0),
            _ => true,
        });
    }
    assert!(differing <= 4, "{differing} rays differ");
}

#[test]
fn a_renderer_shows_the_frame_that_it_was_given_last() {
    let mut scene = party();
    scene.cameras[0].look_from = FAR + dvec3(0.0, 1.5, 6.0);
    scene.cameras[0].look_at = FAR + dvec3(0.0, 0.5, 0.0);
    scene.add_point_light(FAR + dvec3(3.0, 5.0, 4.0), 0.7);
    let packed = packed(&scene, 1 << 14);
    let settings = sized(64, 48);
    let finished = |renderer: &mut Renderer| {
        while !renderer.is_done() {
            renderer.step().expect("a step");
        }
        renderer.develop(&Tone::LINEAR).expect("a picture")
    };
    let view = packed.frame(&scene.frame(0.0)).expect("a frame");
    let policy = ExecutionPolicy::default();
    let mut renderer = Renderer::new(open_gpu(), packed.clone(), &view, settings.clone(), policy)
        .expect("a renderer");
    let first = finished(&mut renderer);
    let mut prints = vec![Fingerprint::of_view(&view)];
    for time in [0.5, 1.0, 0.0] {
        let view = packed.frame(&scene.frame(time)).expect("a frame");
        prints.push(Fingerprint::of_view(&view));
        renderer.set_frame(&view).expect("another frame");
        let shown = finished(&mut renderer);
        let (alone, _) = rendered(&packed, &[scene.frame(time)], &settings);
        check_same_bits(&format!("{time}"), &alone, &shown).expect("the same picture");
        assert_eq!(shown == first, time == 0.0);
    }
    // Only the last picture is the first one.
    assert!(prints[0] == prints[3] && prints[0] != prints[1] && prints[1] != prints[2]);
}

/// A glowing square from `from` to `from` + `side`, moved by a morph target along x.
fn slider(from: f64, side: f64, way: f64) -> Scene {
    let mut scene = stage();
    let square = sheet(3, 3, 0, |u, v| {
        dvec3(from + side * u, side * (v - 0.5), 0.0)
    });
    let count = square.positions.len();
    let target = MorphTarget {
        vertices: (0..count as u32).collect(),
        positions: vec![Vec3::X * way as f32; count],
        normals: Vec::new(),
        tangents: Vec::new(),
    };
    let mesh = added(&mut scene, square);
    deform(&mut scene, mesh, None, vec![target]);
    scene
        .tracks
        .push(track(Target::Weight(0, 0), Values::Scalar(vec![0.0, 1.0])));
    scene
}

#[test]
fn a_deforming_mesh_covers_each_pixel_as_long_as_it_is_there() {
    let (from, side, way) = (-0.8, 0.6, 1.0);
    let scene = slider(from, side, way);
    let image = motion_blur::exposed(&scene, &blurred(512));
    let mut worst = 0.0_f64;
    for x in 0..SIDE {
        // The left edge is at `from` + t `way`; the pixel is covered while it is within `side` left of it.
        let at = place(x) - from;
        let covered = (at / way).clamp(0.0, 1.0) - ((at - side) / way).clamp(0.0, 1.0);
        let rows = SIDE / 2 - 8..SIDE / 2 + 8;
        let actual = mean(&image, rows.map(|y| (x, y)));
        worst = worst.max((actual - covered).abs());
    }
    assert!(worst < 0.02, "{worst} off");
}

/// The mean of the pictures at many instants.
fn mean_of_instants(scene: &Scene, settings: &RenderSettings) -> Image {
    const COUNT: u32 = 64;
    let packed = packed(scene, 1 << 14);
    let mut sum: Option<Image> = None;
    for i in 0..COUNT {
        let time = (f64::from(i) + 0.5) / f64::from(COUNT);
        let (image, _) = rendered(&packed, &[scene.frame(time)], settings);
        match &mut sum {
            None => sum = Some(image),
            Some(sum) => {
                for (sum, pixel) in sum.pixels.iter_mut().zip(&image.pixels) {
                    for (sum, value) in sum.iter_mut().zip(pixel) {
                        *sum += value;
                    }
                }
            }
        }
    }
    let mut sum = sum.expect("a picture");
    for pixel in sum.pixels.as_flattened_mut() {
        *pixel /= COUNT as f32;
    }
    sum
}

#[test]
fn a_bending_figure_blurs_like_the_mean_of_many_instants() {
    let mut scene = stage();
    scene.materials[0] = Material::from(Phong {
        diffuse: Vec3::splat(0.8),
        specular: Vec3::splat(0.2),
        ..Phong::default()
    });
    scene.lights = vec![Light {
        kind: LightKind::Directional {
            direction: dvec3(-0.3, -0.5, -1.0).normalize(),
        },
        color: Vec3::ONE,
        attenuation: Attenuation::None,
        ..Light::default()
    }];
    let hip = node(&mut scene, dvec3(0.0, -0.9, 0.0), None);
    let knee = node(&mut scene, DVec3::Y * 0.8, Some(hip));
    let strip = sheet(8, 24, 0, |u, v| dvec3(0.5 * (u - 0.5), 1.7 * v, 0.0));
    let bound = |node, y: f64| Joint {
        node: Some(node),
        node_from_mesh: DAffine3::from_translation(dvec3(0.0, -y, 0.0)),
    };
    let shares: Vec<f64> = (strip.positions.iter())
        .map(|p| (2.0 * f64::from(p.y) - 1.1).clamp(0.0, 1.0))
        .collect();
    let mesh = added(&mut scene, strip);
    let skin = skin([bound(hip, 0.0), bound(knee, 0.8)], shares.into_iter());
    deform(&mut scene, mesh, Some(skin), Vec::new());
    let turns = [(-0.5, 0.0), (0.5, 0.9)];
    let turns = turns.map(|(z, y)| DQuat::from_rotation_z(z) * DQuat::from_rotation_y(y));
    scene.tracks.push(track(
        Target::Node(knee, NodeProperty::Rotation),
        Values::Rotation(turns.into()),
    ));
    let frames = scene.motion_samples(0.0, 1.0);
    assert!(frames.len() >= 9, "{} frames", frames.len());
    let packed = packed(&scene, 1 << 14);
    assert!(packed.view(&frames).expect("a view").deforms());
    let expected = mean_of_instants(&scene, &blurred(16));
    for brute_force in [false, true] {
        let settings = RenderSettings {
            brute_force,
            ..blurred(256)
        };
        let (image, _) = rendered(&packed, &frames, &settings);
        let difference = |(a, b): (&[f32; 4], &[f32; 4])| f64::from((a[0] - b[0]).abs());
        let pairs = || image.pixels.iter().zip(&expected.pixels);
        let worst = pairs().map(difference).fold(0.0, f64::max);
        let off = pairs().map(difference).sum::<f64>() / image.pixels.len() as f64;
        let all = |image: &Image| mean(image, (0..SIDE * SIDE).map(|i| (i % SIDE, i / SIDE)));
        let energy = all(&image) / all(&expected);
        assert!(
            worst < 0.12 && off < 0.004 && (energy - 1.0).abs() < 0.005,
            "{worst} at most, {off} in the mean, {energy} of the light"
        );
    }
}

#[test]
fn boxes_follow_a_mesh_while_the_shutter_is_open() {
    let mut scene = slider(-8.0, 1.0, 16.0);
    scene.meshes[0] = sheet(40, 40, 0, |u, v| dvec3(u - 8.0, v - 0.5, 0.0)).into();
    let count = scene.meshes[0].positions.len();
    let target = MorphTarget {
        vertices: (0..count as u32).collect(),
        positions: vec![Vec3::X * 16.0; count],
        normals: Vec::new(),
        tangents: Vec::new(),
    };
    scene.deformations[0].targets = [target].into();
    let packed = packed(&scene, 1 << 14);
    let mut random = Random::new(5);
    let rays = (0..1000).map(|_| {
        let time = random.between(0.0, 1.0);
        let (x, y) = (random.between(0.0, 1.0), random.between(-0.5, 0.5));
        let at = dvec3(16.0 * time - 8.0 + x, y, 0.0);
        let ray = toward(at + 3.0 * DVec3::Z, at);
        QueryRay {
            time: time as f32,
            ..ray
        }
    });
    let rays: Vec<_> = rays.collect();
    let view = packed
        .view(&scene.motion_samples(0.0, 1.0))
        .expect("a view");
    assert!(view.deforms());
    let policy = ExecutionPolicy::default();
    let query = RayQuery::new(open_gpu(), packed, &view, policy).expect("a query");
    let hits = query.closest_hits(&rays).expect("hits");
    let hit_count = hits.iter().flatten().count();
    // Where a ray meets an edge of the sheet, rounding decides.
    assert!(hit_count >= 998, "{hit_count} hits");
    let batch = query.batch(&rays).expect("a batch");
    let steps = query.steps(&batch, RayTest::Closest).expect("steps");
    let nodes = steps
        .iter()
        .map(|steps| f64::from(steps.nodes))
        .sum::<f64>()
        / 1000.0;
    // 3200 triangles are at least five levels of four children each. Boxes round the whole way would overlap:
    // a ray would visit those of a row of 80 triangles.
    assert!(nodes < 16.0, "{nodes} nodes");
}

#[test]
fn a_still_pose_is_packed_as_one_key() {
    let mut scene = slider(-0.5, 1.0, 0.5);
    let packed = packed(&scene, 1 << 14);
    let view = packed
        .view(&scene.motion_samples(2.0, 3.0))
        .expect("a view");
    assert!(!view.deforms());
    // Something else moves: the mesh keeps its shape.
    scene.tracks.clear();
    let carrier = node(&mut scene, DVec3::ZERO, None);
    scene.instances[0].node = Some(carrier);
    let way = vec![DVec3::ZERO, DVec3::X];
    scene.tracks.push(track(
        Target::Node(carrier, NodeProperty::Translation),
        Values::Vector(way),
    ));
    let packed = crate::instances::packed(&scene, 1 << 14);
    let view = packed
        .view(&scene.motion_samples(0.0, 1.0))
        .expect("a view");
    assert!(!view.deforms() && view.has_moving_instances());
}

#[test]
fn a_pose_out_of_range_is_refused() {
    let scene = slider(0.0, 1.0, 1e30);
    let packed = packed(&scene, 1 << 14);
    let refused = packed.frame(&scene.frame(1.0)).expect_err("a refusal");
    let message = refused.to_string();
    assert!(message.starts_with("scene too spread out"), "{message}");
    packed
        .frame(&scene.frame(0.0))
        .expect("a frame within range");
}
