//! The TLAS: boxes that bound moving objects, keys that give their transforms, and nothing else.

use crate::{
    reference::scenes::{self, Build},
    support::{random::Random, verdict::Verdict},
};
use glam::{DAffine3, DMat3, DQuat, DVec3, UVec2, Vec3, dvec3};
use glimray::{
    bvh::{self, Aabb, StackNeed},
    layout::{INSTANCE, LEAF, MOVING, PackedInstance, PackedKey, PackedNode, STACK_SIZE},
    pack::{self, PackedScene, PackedView},
    scene::{
        Beyond, CanonicalShape, Curve, Easing, Geometry, Instance, Interpolation, Light, LightKind,
        LightProperty, Mesh, Node, NodeProperty, Scene, Shape, Target, Track, Values,
    },
};
use std::sync::Arc;

fn track(index: usize, property: NodeProperty, values: Vec<DVec3>) -> Track {
    let last = (values.len() - 1) as f64;
    Track {
        targets: vec![Target::Node(index, property)],
        curve: Curve {
            times: (0..values.len()).map(|i| i as f64 / last).collect(),
            values: Values::Vector(values),
            interpolation: Interpolation::Linear,
            easing: Easing::None,
            beyond: Beyond::Hold,
        },
    }
}

/// The data after the scene's nodes on the GPU.
struct Behind {
    nodes: Vec<PackedNode>,
    instances: Vec<PackedInstance>,
    keys: Vec<PackedKey>,
    first_node: u32,
    root: u32,
}

fn behind(packed: &PackedScene, view: &PackedView) -> Behind {
    let [nodes, instances, keys, ..] = view.node_parts();
    Behind {
        nodes: bytemuck::pod_collect_to_vec(nodes),
        instances: bytemuck::pod_collect_to_vec(instances),
        keys: bytemuck::pod_collect_to_vec(keys),
        first_node: packed.first_view_node(),
        root: view.frame.root,
    }
}

/// A box in f64.
pub type Box = [DVec3; 2];

/// The boxes of a node's children, and their references.
pub fn children(node: &PackedNode) -> Vec<(Box, u32)> {
    let real = |i: usize| f64::from(f32::from_bits(node[i]));
    let plane = |axis: usize, side: usize, child: usize| {
        let steps = node[6 + 2 * axis + side].to_le_bytes()[child];
        real(axis) + real(3 + axis) * f64::from(steps)
    };
    let corner = |side, child| DVec3::from_array([0, 1, 2].map(|axis| plane(axis, side, child)));
    let count = node[12..].iter().take_while(|child| **child != 0).count();
    assert_eq!(node[3] & 7, count as u32, "the number of children");
    (0..4)
        .filter(|&child| node[12 + child] != 0)
        .map(|child| ([corner(0, child), corner(1, child)], node[12 + child]))
        .collect()
}

impl Behind {
    /// The children of a node at this fraction of the shutter interval.
    fn children_at(&self, reference: u32, time: f64) -> Vec<(Box, u32)> {
        let index = ((reference & !MOVING) - self.first_node) as usize;
        let open = children(&self.nodes[index]);
        if reference & MOVING == 0 {
            return open;
        }
        let close = children(&self.nodes[index + 1]);
        assert_eq!(open.len(), close.len());
        open.into_iter()
            .zip(close)
            .map(|((a, reference), (b, same))| {
                assert_eq!(reference, same);
                ([a[0].lerp(b[0], time), a[1].lerp(b[1], time)], reference)
            })
            .collect()
    }

    /// For each instance the intersection of all boxes on the path to it, and all other references with theirs.
    fn boxes_at(&self, time: f64) -> (Vec<Option<Box>>, Vec<(Box, u32)>) {
        let mut found = vec![None; self.instances.len()];
        let mut others = Vec::new();
        let everything = [DVec3::splat(f64::NEG_INFINITY), DVec3::splat(f64::INFINITY)];
        let mut open = vec![(everything, self.root)];
        while let Some((outer, reference)) = open.pop() {
            for (own, child) in self.children_at(reference, time) {
                let inner = [outer[0].max(own[0]), outer[1].min(own[1])];
                let is_inner_node = child & LEAF == 0 && child & !MOVING >= self.first_node;
                if child >= INSTANCE {
                    let place = &mut found[(child & !INSTANCE) as usize];
                    assert!(place.is_none(), "an instance is there twice");
                    *place = Some(inner);
                } else if is_inner_node {
                    open.push((inner, child));
                } else {
                    others.push((inner, child));
                }
            }
        }
        (found, others)
    }

    /// The transform of an instance at this fraction of the shutter interval, from its keys.
    fn space_at(&self, instance: &PackedInstance, time: f64) -> DAffine3 {
        let vector = |v: [f32; 3]| DVec3::from(v.map(f64::from));
        if instance.key_count == 1 {
            let rows = [instance.linear_x, instance.linear_y, instance.linear_z].map(vector);
            let columns = DMat3::from_cols(rows[0], rows[1], rows[2]);
            return DAffine3::from_mat3_translation(
                columns.transpose(),
                vector(instance.translation),
            );
        }
        let at = time * f64::from(instance.key_count - 1);
        let before = (at as u32).min(instance.key_count - 2);
        let fraction = at - f64::from(before);
        let key = |step: u32| parts(&self.keys[(instance.first_key + before + step) as usize]);
        let ((p, q, s), (p1, q1, s1)) = (key(0), key(1));
        let rotation = (q * (1.0 - fraction) + q1 * fraction).normalize();
        let matrix = DMat3::from_quat(rotation) * (s * (1.0 - fraction) + s1 * fraction);
        DAffine3::from_mat3_translation(matrix, p.lerp(p1, fraction))
    }
}

/// Translation, rotation and stretch of a key.
fn parts(key: &PackedKey) -> (DVec3, DQuat, DMat3) {
    let vector = |v: [f32; 3]| DVec3::from(v.map(f64::from));
    let (d, s) = (vector(key.stretch), vector(key.shear));
    let stretch = DMat3::from_cols(
        dvec3(d.x, s.z, s.y),
        dvec3(s.z, d.y, s.x),
        dvec3(s.y, s.x, d.z),
    );
    let rotation = DQuat::from_array(key.rotation.map(f64::from));
    (vector(key.translation), rotation, stretch)
}

/// Objects that translate, tumble, stretch, shear and grow, mirrored or not, over a static floor; meshes first,
/// each with points on its surface.
fn flock(random: &mut Random) -> (Scene, Vec<Vec<DVec3>>) {
    let mut scene = scenes::empty();
    scene
        .meshes
        .push(scenes::torus(0.7, 0.3, UVec2::new(10, 6), 0).into());
    let mut points = Vec::new();
    for i in 0..24 {
        // A parent with non-uniform scale above a rotating child makes it shear.
        let mirror = if i % 5 == 0 { -1.0 } else { 1.0 };
        let uneven = dvec3(
            mirror * random.between(0.3, 2.0),
            random.between(0.3, 2.0),
            1.0,
        );
        scene.nodes.push(Node {
            scale: uneven,
            rotation: DQuat::from_scaled_axis(random.in_cube() * 3.0),
            ..Node::default()
        });
        let parent = scene.nodes.len() - 1;
        scene.nodes.push(Node {
            parent: Some(parent),
            ..Node::default()
        });
        let child = parent + 1;
        let mut way = || {
            (0..2 + i % 3)
                .map(|_| random.in_cube() * 4.0)
                .collect::<Vec<_>>()
        };
        scene
            .tracks
            .push(track(parent, NodeProperty::Translation, way()));
        scene.tracks.push(track(child, NodeProperty::Angles, way()));
        if i % 4 == 1 {
            let sizes = (0..3).map(|_| random.in_cube() * 0.4 + 1.0).collect();
            scene.tracks.push(track(child, NodeProperty::Scale, sizes));
        }
        let placement = DAffine3::from_scale_rotation_translation(
            dvec3(0.5, 1.0, 0.2),
            DQuat::from_scaled_axis(random.in_cube()),
            random.in_cube(),
        );
        if i < 12 {
            scene.instances.push(Instance {
                mesh: 0,
                placement,
                node: Some(child),
                name: String::new(),
            });
            let positions = &scene.meshes[0].positions;
            points.push(positions.iter().map(|p| p.as_dvec3()).collect());
            continue;
        }
        let (geometry, own): (_, Vec<DVec3>) = if i % 2 == 0 {
            let center = random.in_cube();
            let on_it = (0..200)
                .map(|_| center + 0.6 * random.direction())
                .collect();
            (
                Geometry::Sphere {
                    center,
                    radius: 0.6,
                },
                on_it,
            )
        } else {
            let corners = (0..8).map(|k| {
                let side = |bit: i32| if k >> bit & 1 == 0 { -1.0 } else { 1.0 };
                placement.transform_point3(dvec3(side(0), side(1), side(2)))
            });
            let geometry = Geometry::Placed {
                canonical: CanonicalShape::Box,
                world_from_canonical: placement,
            };
            (geometry, corners.collect())
        };
        scene.shapes.push(Shape {
            geometry,
            material: 0,
            node: Some(child),
            name: String::new(),
        });
        points.push(own);
    }
    scene.add_mesh(scenes::quad(6.0, 0), DAffine3::IDENTITY);
    (scene, points)
}

#[test]
fn boxes_bound_moving_objects_at_every_moment() {
    let mut random = Random::new(51);
    let mut verdict = Verdict::on("boxes of a view");
    for round in 0..6 {
        let (scene, points) = flock(&mut random);
        let packed = pack::scene(&scene).expect("packed");
        // From a tiny part of the animation to all of it.
        let (open, close) = [(0.3, 0.31), (0.2, 0.4), (0.0, 1.0)][round % 3];
        let frames = scene.motion_samples(open, close);
        let view = packed.view(&frames).expect("a view");
        let behind = behind(&packed, &view);
        assert_eq!(behind.instances.len(), points.len());
        assert!(view.has_moving_instances());
        for _ in 0..200 {
            let time = random.between(0.0, 1.0);
            let (boxes, others) = behind.boxes_at(time);
            for (instance, found) in behind.instances.iter().zip(&boxes) {
                let object = instance.id as usize - 1;
                let Some([min, max]) = found else {
                    verdict.that(format!("object {object}"), false, || "is in no box");
                    continue;
                };
                let space = behind.space_at(instance, time);
                let outside = points[object].iter().find(|p| {
                    let p = space.transform_point3(**p);
                    p.cmplt(*min).any() || p.cmpgt(*max).any()
                });
                let name = format!("object {object} of round {round} at {time}");
                verdict.that(name, outside.is_none(), || {
                    let p = space.transform_point3(*outside.expect("a point"));
                    format!("{p} is not in {min} to {max}")
                });
            }
            // The floor is there too, and does not move.
            let half = 3.0;
            let corners =
                [dvec3(-half, 0.0, -half), dvec3(half, 0.0, half)].map(|p| p - packed.origin);
            let held = others
                .iter()
                .fold([DVec3::INFINITY, DVec3::NEG_INFINITY], |whole, (own, _)| {
                    [whole[0].min(own[0]), whole[1].max(own[1])]
                });
            let is_held = held[0].cmple(corners[0]).all() && held[1].cmpge(corners[1]).all();
            verdict.that(format!("floor at {time}"), is_held, || format!("{held:?}"));
        }
    }
    verdict.close();
}

#[test]
fn keys_give_the_transforms_of_the_scene_at_every_moment() {
    let mut random = Random::new(52);
    let (scene, points) = flock(&mut random);
    let packed = pack::scene(&scene).expect("packed");
    // Between keys of the scene: at a key with a sharp bend, the maximum number of frames may be too few.
    let (open, close) = (0.35, 0.48);
    let view = packed
        .view(&scene.motion_samples(open, close))
        .expect("a view");
    let behind = behind(&packed, &view);
    let mut verdict = Verdict::on("keys of a view");
    for _ in 0..200 {
        let fraction = random.between(0.0, 1.0);
        let frame = scene.frame(open + (close - open) * fraction);
        for instance in &behind.instances {
            let object = instance.id as usize - 1;
            let (node, placement) = match scene.instances.get(object).filter(|_| object < 12) {
                Some(instance) => (instance.node, instance.placement),
                None => (scene.shapes[object - 12].node, DAffine3::IDENTITY),
            };
            let world = frame.nodes[node.expect("a node")].world_from_node * placement;
            let space = behind.space_at(instance, fraction);
            // The required precision of motion samples: a thousandth of the distance for positions, and a
            // rotation of 0.1 for the size of the object.
            let worst = (points[object].iter())
                .map(|p| {
                    let expected = world.transform_point3(*p) - packed.origin;
                    let size = world.transform_vector3(*p).length();
                    let allowed = 2e-3 * expected.length() + 4e-3 * size;
                    space.transform_point3(*p).distance(expected) / allowed
                })
                .fold(0.0, f64::max);
            verdict.that(
                format!("object {object} at {fraction}"),
                worst <= 1.0,
                || worst,
            );
        }
    }
    verdict.close();
}

#[test]
fn every_transform_survives_decomposition_into_a_key() {
    let mut random = Random::new(53);
    let mut scene = scenes::empty();
    scene.meshes.push(scenes::quad(1e-3, 0).into());
    let mut transforms = Vec::new();
    for i in 0..400 {
        // From spherical to a millionth as thin as wide, and alternately mirrored.
        let thin = || -6.0 * (i % 5) as f64 / 4.0;
        let scale = dvec3(
            random.between(0.5, 1.0),
            10f64.powf(thin()) * random.between(0.5, 1.0),
            10f64.powf(random.between(thin(), 0.0)),
        ) * 10f64.powf(random.between(-3.0, 3.0));
        let turn = |random: &mut Random| {
            DMat3::from_quat(DQuat::from_axis_angle(
                random.direction(),
                random.between(0.0, 6.3),
            ))
        };
        let mirror = if i % 3 == 0 { -1.0 } else { 1.0 };
        let matrix = turn(&mut random) * DMat3::from_diagonal(scale * mirror) * turn(&mut random);
        transforms.push(matrix);
        scene.nodes.push(Node {
            placement: DAffine3::from_mat3(matrix),
            ..Node::default()
        });
        // Moved far enough to need keys.
        let way = vec![DVec3::ZERO, DVec3::splat(1.0)];
        scene.tracks.push(track(i, NodeProperty::Translation, way));
        scene.instances.push(Instance {
            mesh: 0,
            placement: DAffine3::IDENTITY,
            node: Some(i),
            name: String::new(),
        });
    }
    let packed = pack::scene(&scene).expect("packed");
    let view = packed
        .view(&scene.motion_samples(0.0, 1.0))
        .expect("a view");
    let behind = behind(&packed, &view);
    let mut verdict = Verdict::on("keys");
    for (instance, matrix) in behind.instances.iter().zip(&transforms) {
        let name = format!(
            "transform {} of determinant {:e}",
            instance.id,
            matrix.determinant()
        );
        verdict.that(&name, instance.key_count >= 2, || instance.key_count);
        let size = matrix
            .to_cols_array()
            .into_iter()
            .fold(0.0, |a: f64, b| a.max(b.abs()));
        for step in 0..instance.key_count {
            let (_, rotation, stretch) = parts(&behind.keys[(instance.first_key + step) as usize]);
            verdict.that(&name, (rotation.length() - 1.0).abs() < 1e-6, || rotation);
            let off = (DMat3::from_quat(rotation.normalize()) * stretch - *matrix)
                .to_cols_array()
                .into_iter()
                .fold(0.0, |a: f64, b| a.max(b.abs()));
            verdict.that(&name, off <= 1e-6 * size, || format!("{off} off"));
        }
    }
    verdict.close();
}

#[test]
fn keys_go_the_short_way_round() {
    // Three full turns: quaternions change their sign on the way.
    let mut scene = scenes::empty();
    scene.meshes.push(scenes::quad(1.0, 0).into());
    scene.nodes.push(Node::default());
    scene.instances.push(Instance {
        mesh: 0,
        placement: DAffine3::IDENTITY,
        node: Some(0),
        name: String::new(),
    });
    let turn = vec![DVec3::ZERO, dvec3(0.0, 3.0 * std::f64::consts::TAU, 0.0)];
    scene.tracks.push(track(0, NodeProperty::Angles, turn));
    let packed = pack::scene(&scene).expect("packed");
    let view = packed
        .view(&scene.motion_samples(0.0, 1.0))
        .expect("a view");
    let keys = behind(&packed, &view).keys;
    assert!(keys.len() > 180, "{} keys", keys.len());
    for pair in keys.windows(2) {
        let [a, b] = [0, 1].map(|i| DQuat::from_array(pair[i].rotation.map(f64::from)));
        assert!(a.dot(b) > 0.99, "{a} to {b}");
    }
}

#[test]
fn hidden_objects_are_omitted_and_take_no_memory() {
    let mut random = Random::new(54);
    let (mut scene, points) = flock(&mut random);
    let hide = |node: usize, times: [f64; 2], values: [f64; 2]| Track {
        targets: vec![Target::Node(node, NodeProperty::Visible)],
        curve: Curve {
            times: times.to_vec(),
            values: Values::Scalar(values.to_vec()),
            interpolation: Interpolation::Step,
            easing: Easing::None,
            beyond: Beyond::Hold,
        },
    };
    // A parent, and so its child, until half-time; then another child.
    scene.tracks.push(hide(0, [0.0, 0.5], [0.0, 1.0]));
    scene.tracks.push(hide(3, [0.0, 0.5], [1.0, 0.0]));
    let lamp = |radius, position: DVec3| Light {
        kind: LightKind::Sphere {
            center: position,
            radius,
        },
        color: Vec3::ONE,
        visible: true,
        ..Light::default()
    };
    scene.lights = vec![lamp(0.2, DVec3::X), lamp(0.3, DVec3::Y)];
    let mut switch = hide(0, [0.0, 0.5], [0.0, 1.0]);
    switch.targets = vec![Target::Light(1, LightProperty::On)];
    scene.tracks.push(switch);
    let packed = pack::scene(&scene).expect("packed");
    // The first lamp is static, the second is the last instance.
    let all = points.len() + 1;
    assert_eq!(packed.instance_count(), all);
    let ids = |time: f64| {
        let view = packed.frame(&scene.frame(time)).expect("a frame");
        let behind = behind(&packed, &view);
        assert!(behind.boxes_at(0.0).0.iter().all(Option::is_some));
        assert!(behind.keys.is_empty());
        let ids = behind
            .instances
            .iter()
            .map(|instance| instance.id as usize - 1);
        ids.collect::<Vec<_>>()
    };
    let but = |gone: &[usize]| (0..all).filter(|id| !gone.contains(id)).collect::<Vec<_>>();
    assert_eq!(ids(0.25), but(&[0, all - 1]));
    assert_eq!(ids(0.75), but(&[1]));
}

#[test]
fn the_same_frames_are_packed_to_the_same_bytes() {
    let pack = || {
        let (scene, _) = flock(&mut Random::new(55));
        let packed = pack::scene(&scene).expect("packed");
        (scene, packed)
    };
    let ((scene, packed), (_, again)) = (pack(), pack());
    assert!(packed.parts() == again.parts());
    let view_of = |packed: &PackedScene, open, close| {
        packed
            .view(&scene.motion_samples(open, close))
            .expect("a view")
    };
    let first = view_of(&packed, 0.2, 0.4);
    // Other views in between have no effect.
    let other = view_of(&packed, 0.5, 0.6);
    assert!(first.parts() != other.parts());
    assert!(first.parts() == view_of(&packed, 0.2, 0.4).parts());
    assert!(first.parts() == view_of(&again, 0.2, 0.4).parts());
    let still = |packed: &PackedScene| packed.frame(&scene.frame(0.7)).expect("a frame");
    assert!(still(&packed).parts() == still(&again).parts());
}

/// The most entries on the stack of a traversal from this reference: at each node all children but one, or the node if it has
/// several.
fn need(reference: u32, children: &impl Fn(u32) -> Vec<u32>) -> StackNeed {
    if reference & LEAF != 0 {
        return StackNeed::default();
    }
    let children_here = children(reference);
    let mut deepest = (children_here.iter().map(|&child| need(child, children)))
        .fold(StackNeed::default(), StackNeed::max);
    deepest.references += children_here.len().saturating_sub(1);
    deepest.nodes += usize::from(children_here.len() > 1);
    deepest
}

#[test]
fn traversal_of_both_levels_fits_on_the_stack() {
    // Each is twice as far out as the previous one, triangles and copies: joining nearest neighbours gives deep
    // trees.
    let place = |i: i32| 2f64.powi(i);
    let boxes: Vec<_> = (-70..49)
        .map(|i| {
            let (at, half) = (DVec3::X * place(i), DVec3::splat(place(i - 4)));
            Aabb {
                min: (at - half).as_vec3(),
                max: (at + half).as_vec3(),
            }
        })
        .collect();
    let limits = bvh::Limits {
        leaf_size: 1,
        alone: None,
        stack_size: usize::MAX,
    };
    let chain = bvh::build(&boxes, &vec![0; boxes.len()], 1, limits)
        .stack_need
        .references;
    assert!(chain > 40, "{chain} is no chain");
    let mut mesh = Mesh::default();
    for i in -110..0 {
        let (at, size) = (place(i) as f32, place(i - 4) as f32);
        let corner = mesh.positions.len() as u32;
        let corners = [Vec3::ZERO, Vec3::Y, Vec3::Z].map(|to| Vec3::X * at + to * size);
        mesh.positions.extend(corners);
        mesh.normals.extend([Vec3::X; 3]);
        mesh.materials.extend([0; 3]);
        mesh.triangles.push([corner, corner + 1, corner + 2]);
    }
    let mut scene = scenes::empty();
    scene.cameras[0].look_from = DVec3::ZERO;
    scene.cameras[0].look_at = DVec3::X;
    scene.meshes.push(mesh.into());
    scene.instances.extend((-70..49).map(|i| Instance {
        mesh: 0,
        placement: DAffine3::from_scale_rotation_translation(
            DVec3::splat(place(i - 4)),
            DQuat::IDENTITY,
            DVec3::X * place(i),
        ),
        node: None,
        name: String::new(),
    }));
    scene.add_mesh(
        scene.meshes[0].clone(),
        DAffine3::from_translation(DVec3::NEG_Z),
    );
    let packed = pack::scene_with(&scene, 0).expect("packed");
    let view = packed.frame(&scene.frame(0.0)).expect("a frame");
    let behind = behind(&packed, &view);
    assert_eq!(behind.instances.len(), boxes.len());
    let references = |reference: u32| -> Vec<u32> {
        let node = match reference.checked_sub(behind.first_node) {
            Some(index) => &behind.nodes[index as usize],
            None => &packed.nodes[reference as usize],
        };
        children(node).into_iter().map(|(_, child)| child).collect()
    };
    let inner = (behind.instances.iter())
        .map(|instance| need(instance.root, &references))
        .fold(StackNeed::default(), StackNeed::max);
    let outer = need(behind.root, &references);
    // Baked meshes are below the TLAS, and nothing returns from them.
    let in_tlas = |reference: u32| match reference < behind.first_node {
        true => Vec::new(),
        false => references(reference),
    };
    let above = need(behind.root, &in_tlas);
    // At the bottom is the end marker, between the levels the return marker, and the last store of a step
    // writes one entry beyond the top.
    let all = 1 + outer.references + 1 + inner.references + 1;
    assert!(all <= STACK_SIZE as usize, "{all} entries");
    let kept = packed.stack_need(&view);
    let references = outer.references + 1 + inner.references;
    assert!(kept.references >= references, "{kept:?}");
    let nodes = outer.nodes.max(above.nodes + 1 + inner.nodes);
    assert!(kept.nodes >= nodes, "{kept:?}, {nodes} nodes");
}

/// Meshes that are too large for the tree of small ones have trees of their own, under one tree above all.
#[test]
fn the_stack_holds_the_way_through_the_tree_above_large_meshes() {
    let ball = Arc::new(scenes::ball(UVec2::new(64, 32), 0));
    let needs = |count: i32| {
        let mut scene = scenes::empty();
        for i in 0..count {
            let place = DVec3::X * 4.0 * f64::from(i);
            scene.add_mesh(ball.clone(), DAffine3::from_translation(place));
        }
        let packed = pack::scene_with(&scene, usize::MAX).expect("packed");
        assert_eq!(packed.instance_count(), 0);
        let view = packed.frame(&scene.frame(0.0)).expect("a frame");
        let references = |reference: u32| -> Vec<u32> {
            let node = &packed.nodes[reference as usize];
            children(node).into_iter().map(|(_, child)| child).collect()
        };
        (need(0, &references), packed.stack_need(&view))
    };
    let (one, _) = needs(1);
    let (needed, kept) = needs(12);
    assert!(needed.nodes > one.nodes, "{needed:?}, of one ball {one:?}");
    assert!(kept.references >= needed.references, "{kept:?}, {needed:?}");
    assert!(kept.nodes >= needed.nodes, "{kept:?}, {needed:?}");
}
