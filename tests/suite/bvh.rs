//! The BVH: properties that hold for every input, and rays that find the same with and without it.

use crate::reference::compare::{assert_none, check_same_bits, open_gpu, render};
use crate::reference::scenes::{self, Build, Random};
use crate::support::verdict::Verdict;
use glam::{DAffine3, DMat3, DQuat, DVec3, UVec2, Vec3, dvec3};
use glimray::bvh::{self, Aabb, Bvh, Child, Limits, StackNeed};
use glimray::image::Image;
use glimray::layout::{
    LEAF, LEAF_COUNT_MASK, LEAF_COUNT_SHIFT, LEAF_FIRST_MASK, PackedShape, SHAPE, SHAPE_BOX,
    SHAPE_CONE, SHAPE_RECTANGLE, STACK_SIZE,
};
use glimray::pack::{self, OutsideTree, PackedScene};
use glimray::render::{Integrator, RenderSettings, TriangleTest};
use glimray::scene::{
    Background, CanonicalShape, Fresnel, Geometry, Material, Mesh, Phong, Scene, Shape,
};
use std::f64::consts::TAU;
use std::ops::Range;

const LIMITS: Limits = Limits {
    leaf_size: 4,
    alone: None,
    stack_size: STACK_SIZE as usize - 1,
};

fn box_round(center: DVec3, half: DVec3) -> Aabb {
    Aabb {
        min: (center - half).as_vec3(),
        max: (center + half).as_vec3(),
    }
}

/// Boxes that are easy and hard to build trees over, by name.
pub fn inputs() -> Vec<(&'static str, Vec<Aabb>)> {
    let mut random = Random(1);
    let mut many = |count: usize, mut make: Box<dyn FnMut(&mut Random) -> Aabb>| -> Vec<Aabb> {
        (0..count).map(|_| make(&mut random)).collect()
    };
    vec![
        ("none", vec![]),
        ("one", vec![box_round(DVec3::ONE, DVec3::ONE)]),
        (
            "two",
            many(2, Box::new(|r| box_round(r.within(1.0), DVec3::ONE))),
        ),
        (
            "random",
            many(
                5000,
                Box::new(|r| box_round(r.within(10.0), r.within(0.3).abs())),
            ),
        ),
        (
            "clustered",
            many(
                5000,
                Box::new(|r| {
                    let cluster = dvec3(r.below(8) as f64 * 100.0, r.below(3) as f64 * 1e-3, 0.0);
                    box_round(cluster + r.within(1e-4), DVec3::splat(1e-5))
                }),
            ),
        ),
        // The builder must not take quadratic time for these.
        (
            "coincident",
            vec![box_round(DVec3::ONE, DVec3::ONE); 100_000],
        ),
        (
            "in a row",
            (0..100_000)
                .map(|i| box_round(DVec3::X * f64::from(3 * i), DVec3::ONE))
                .collect(),
        ),
        (
            "nested",
            (1..=100_000)
                .map(|i| box_round(DVec3::ONE, DVec3::splat(f64::from(i))))
                .collect(),
        ),
        (
            "a few places",
            (0..100_000)
                .map(|i| box_round(DVec3::Y * f64::from(i % 40), DVec3::ONE))
                .collect(),
        ),
        (
            "collinear points",
            many(
                50_000,
                Box::new(|r| box_round(DVec3::X * r.between(-5.0, 5.0), DVec3::ZERO)),
            ),
        ),
        (
            "huge and tiny",
            many(
                3000,
                Box::new(|r| {
                    let size = 10f64.powf(r.between(-30.0, 14.0));
                    box_round(r.within(1.0) * size, r.within(1.0).abs() * size)
                }),
            ),
        ),
        (
            "at the limit",
            many(
                100,
                Box::new(|r| box_round(r.within(1e15), DVec3::splat(1e14))),
            ),
        ),
        ("spread exponentially", exponential()),
    ]
}

/// Each box is twice as far out as the one before: merging nearest neighbours produces a chain.
fn exponential() -> Vec<Aabb> {
    let place = |i: i32| DVec3::X * 2f64.powi(i);
    (-70..50)
        .map(|i| box_round(place(i), DVec3::splat(2f64.powi(i - 4))))
        .collect()
}

/// Describes what is wrong with a tree.
fn check_tree(bvh: &Bvh, boxes: &[Aabb], groups: &[u8]) -> Result<(), String> {
    let mut seen = vec![0; boxes.len()];
    let mut visited = vec![0; bvh.nodes.len()];
    let mut open = vec![0];
    while let Some(index) = open.pop() {
        visited[index] += 1;
        let children = &bvh.nodes[index].children;
        if children.len() > 4 {
            return Err(format!("node {index} has {} children", children.len()));
        }
        for (aabb, child) in children {
            match *child {
                Child::Node(below) => {
                    for (inner, _) in &bvh.nodes[below as usize].children {
                        if aabb.union(*inner) != *aabb {
                            return Err(format!(
                                "node {below} is not in its box {aabb:?}: {inner:?}"
                            ));
                        }
                    }
                    open.push(below as usize);
                }
                Child::Leaf {
                    group,
                    first,
                    count,
                } => {
                    if count == 0 || count > LIMITS.leaf_size {
                        return Err(format!("a leaf of {count}"));
                    }
                    for place in first..first + count {
                        let i = bvh.order[group as usize][place as usize] as usize;
                        seen[i] += 1;
                        if groups[i] != group {
                            return Err(format!("box {i} is in a leaf of group {group}"));
                        }
                        if aabb.union(boxes[i]) != *aabb {
                            return Err(format!("box {i} is not in its leaf's {aabb:?}"));
                        }
                    }
                }
            }
        }
    }
    if let Some(i) = seen.iter().position(|&count| count != 1) {
        return Err(format!("box {i} is in {} leaf slots", seen[i]));
    }
    if let Some(i) = visited.iter().position(|&count| count != 1) {
        return Err(format!("node {i} is reached {} times", visited[i]));
    }
    let need = deepest_stack(bvh);
    if bvh.stack_need != need {
        return Err(format!(
            "stack_need is {:?}, a walk takes {need:?}",
            bvh.stack_need
        ));
    }
    Ok(())
}

/// The largest stack size when a traversal visits every child of every node, over all orders of siblings: each child is tried
/// first, with its siblings on the stack, or their parent.
fn deepest_stack(bvh: &Bvh) -> StackNeed {
    let empty = StackNeed {
        references: 1,
        nodes: 0,
    };
    let mut deepest = empty;
    let mut open = vec![(0, empty)];
    while let Some((index, mut waiting)) = open.pop() {
        let children: &[(Aabb, Child)] = &bvh.nodes[index].children;
        waiting.references += children.len().saturating_sub(1);
        waiting.nodes += usize::from(children.len() > 1);
        deepest = deepest.max(waiting);
        for (_, child) in children {
            if let Child::Node(below) = child {
                open.push((*below as usize, waiting));
            }
        }
    }
    deepest
}

#[test]
fn every_input_gives_a_sound_tree() {
    assert_none(inputs().into_iter().map(|(name, boxes)| {
        let groups: Vec<u8> = (0..boxes.len()).map(|i| u8::from(i % 3 == 0)).collect();
        let bvh = bvh::build(&boxes, &groups, 2, LIMITS);
        let fits = bvh.stack_need.references <= LIMITS.stack_size;
        let checked = check_tree(&bvh, &boxes, &groups).and(
            fits.then_some(())
                .ok_or(format!("needs a stack of {:?}", bvh.stack_need)),
        );
        checked.map_err(|why| format!("{name}: {why}"))
    }));
}

#[test]
fn the_deep_parts_of_a_tree_are_balanced_for_a_small_stack() {
    let boxes = exponential();
    let groups = vec![0; boxes.len()];
    let with = |stack_size| {
        let limits = Limits {
            stack_size,
            ..LIMITS
        };
        bvh::build(&boxes, &groups, 1, limits)
    };
    let need = with(usize::MAX).stack_need.references;
    assert!(need > 40, "this input is meant to be deep, it needs {need}");
    assert_none((20..=need).map(|stack_size| {
        let tree = with(stack_size);
        check_tree(&tree, &boxes, &groups)?;
        match tree.stack_need.references <= stack_size {
            true => Ok(()),
            false => Err(format!("{:?} of {stack_size}", tree.stack_need)),
        }
    }));
}

#[test]
fn the_same_boxes_give_the_same_tree() {
    let mut random = Random(2);
    let boxes: Vec<_> = (0..50_000)
        .map(|_| box_round(random.within(10.0), random.within(0.2).abs()))
        .collect();
    let groups = vec![0; boxes.len()];
    let build = || bvh::build(&boxes, &groups, 1, LIMITS);
    let (a, b) = (build(), build());
    assert_eq!(a.order, b.order);
    assert!(a.nodes == b.nodes, "the nodes differ");
}

/// The exact box below a child reference of the packed tree, in f64.
fn exact_box(
    scene: &PackedScene,
    reference: u32,
    leaves: &[u32],
) -> Result<(DVec3, DVec3), String> {
    let mut all = (DVec3::INFINITY, DVec3::NEG_INFINITY);
    let mut add = |min: DVec3, max: DVec3| all = (all.0.min(min), all.1.max(max));
    if reference & LEAF == 0 {
        for (child, decoded) in decode(scene, reference) {
            let (min, max) = exact_box(scene, child, leaves)?;
            for (low, high) in decoded {
                if low.cmpgt(min).any() || high.cmplt(max).any() {
                    return Err(format!("{low}..{high} does not hold {min}..{max}"));
                }
            }
            add(min, max);
        }
        return Ok(all);
    }
    for i in primitives_of(reference) {
        if reference & SHAPE == 0 {
            // A leaf holds only a part of a triangle that is in several leaves.
            if leaves[i] > 1 {
                continue;
            }
            let triangle = &scene.triangles[i];
            for corner in [triangle.v0, triangle.v1, triangle.v2] {
                let corner = Vec3::from(corner).as_dvec3();
                add(corner, corner);
            }
        } else {
            let center = Vec3::from(scene.shapes[i].position).as_dvec3();
            let radius = f64::from(scene.shapes[i].size0);
            add(center - radius, center + radius);
        }
    }
    Ok(all)
}

/// The indices of the triangles or shapes of a leaf.
fn primitives_of(leaf: u32) -> Range<usize> {
    let first = (leaf & LEAF_FIRST_MASK) as usize;
    first..first + ((leaf & LEAF_COUNT_MASK) >> LEAF_COUNT_SHIFT) as usize + 1
}

/// The indices of the triangles of a child, if it is a leaf with triangles.
fn triangles_of(reference: u32) -> Range<usize> {
    match reference & (LEAF | SHAPE) {
        LEAF => primitives_of(reference),
        _ => 0..0,
    }
}

/// Like [`triangles_of`], for shapes.
fn shapes_of(reference: u32) -> Range<usize> {
    match reference & (LEAF | SHAPE) == LEAF | SHAPE {
        true => primitives_of(reference),
        false => 0..0,
    }
}

/// The number of leaves that each triangle is in.
fn leaves_of_triangles(scene: &PackedScene) -> Vec<u32> {
    leaves_of(scene, scene.triangles.len(), triangles_of)
}

/// The number of leaves that each primitive is in, whose indices `of` gives for a child.
fn leaves_of(scene: &PackedScene, count: usize, of: fn(u32) -> Range<usize>) -> Vec<u32> {
    let mut leaves = vec![0; count];
    let mut open = vec![0];
    while let Some(reference) = open.pop() {
        of(reference).for_each(|index| leaves[index] += 1);
        if reference & LEAF == 0 {
            open.extend(decode(scene, reference).iter().map(|(child, _)| child));
        }
    }
    leaves
}

type Box64 = (DVec3, DVec3);

/// The children of a packed node with their boxes, decoded in f32 with a fused and with a separate
/// multiplication, since a shader may do either.
fn decode(scene: &PackedScene, node: u32) -> Vec<(u32, [Box64; 2])> {
    let words = &scene.nodes[node as usize];
    let plane = |axis: usize, word: usize, child: usize, fused: bool| {
        let (lo, scale) = (f32::from_bits(words[axis]), f32::from_bits(words[3 + axis]));
        let steps = f32::from(words[word].to_le_bytes()[child]);
        f64::from(if fused {
            scale.mul_add(steps, lo)
        } else {
            scale * steps + lo
        })
    };
    let children = (0..4).filter(|&i| words[12 + i] != 0);
    let decoded = |i: usize, fused: bool| {
        let min = |axis: usize| plane(axis, 6 + 2 * axis, i, fused);
        let max = |axis: usize| plane(axis, 7 + 2 * axis, i, fused);
        (dvec3(min(0), min(1), min(2)), dvec3(max(0), max(1), max(2)))
    };
    children
        .map(|i| (words[12 + i], [decoded(i, false), decoded(i, true)]))
        .collect()
}

#[test]
fn quantised_nodes_decode_to_boxes_that_hold_the_exact_ones() {
    let mut far = scenes::meshes();
    far.cameras[0].look_from = dvec3(3e4, -2e5, 1e3);
    let mut tiny = Scene {
        meshes: vec![],
        instances: vec![],
        ..scenes::meshes()
    };
    tiny.add_mesh(
        scenes::ball(UVec2::splat(20), 0),
        DAffine3::from_scale(DVec3::splat(1e-12)),
    );
    let mut huge = soup(9, 2000);
    huge.add_sphere(dvec3(1e14, 1.0, 0.0), 1e10, 0);
    let rows = [
        ("mixed", scenes::everything()),
        ("soup", soup(3, 5000)),
        ("far from the camera", far),
        ("tiny", tiny),
        ("huge beside small", huge),
        ("flat", scenes::spheres()),
    ];
    assert_none(rows.map(|(name, scene)| {
        let packed = pack::scene(&scene).expect("packed");
        exact_box(&packed, 0, &leaves_of_triangles(&packed))
            .map(|_| ())
            .map_err(|why| format!("{name}: {why}"))
    }));
}

#[test]
fn nodes_with_float_planes_have_the_same_boxes() {
    let mut far = soup(3, 5000);
    far.cameras[0].look_from = dvec3(3e4, -2e5, 1e3);
    let mut verdict = Verdict::on("with_float_planes");
    for (name, scene) in [
        ("mixed", scenes::everything()),
        ("far from the camera", far),
    ] {
        let packed = pack::scene(&scene).expect("packed");
        for (index, node) in packed.nodes.iter().enumerate() {
            let real = |word: u32| f64::from(f32::from_bits(word));
            let words = pack::with_float_planes(node);
            verdict.that(
                format!("{name}, references of node {index}"),
                words[24..] == node[12..],
                || format!("{words:x?}"),
            );
            for (axis, child) in (0..3).flat_map(|axis| (0..4).map(move |child| (axis, child))) {
                let exact = |word: usize| {
                    let steps = node[word].to_le_bytes()[child];
                    real(node[axis]) + real(node[3 + axis]) * f64::from(steps)
                };
                let [low, high] = [words[8 * axis + child], words[8 * axis + 4 + child]].map(real);
                let is_right = match node[12 + child] {
                    // No ray is above the one and below the other.
                    0 => low > 1e15 && high < -1e15,
                    _ => {
                        let most = |plane: f64| 2.0 * f64::from(f32::EPSILON) * plane.abs() + 1e-40;
                        let (lower, upper) = (exact(6 + 2 * axis), exact(7 + 2 * axis));
                        (lower - most(lower)..=lower).contains(&low)
                            && (upper..=upper + most(upper)).contains(&high)
                    }
                };
                verdict.that(
                    format!("{name}, node {index}, axis {axis}"),
                    is_right,
                    || format!("{low} to {high}"),
                );
            }
        }
    }
    verdict.close();
}

/// Whether all boxes down to some leaf of the primitive hold the point.
fn is_found(
    scene: &PackedScene,
    reference: u32,
    point: DVec3,
    is_its_leaf: &impl Fn(u32) -> bool,
) -> bool {
    if reference & LEAF != 0 {
        return is_its_leaf(reference);
    }
    decode(scene, reference)
        .into_iter()
        .any(|(child, decoded)| {
            let holds = |(low, high): &Box64| low.cmple(point).all() && high.cmpge(point).all();
            decoded.iter().all(holds) && is_found(scene, child, point, is_its_leaf)
        })
}

/// Slivers, of which every tenth is long, in a mesh that is turned and stretched.
fn slivers(count: usize) -> Scene {
    let mut random = Random(12);
    let triangles = (0..count).map(|i| {
        let length = if i % 10 == 0 { 2.0 } else { 0.02 };
        let (start, along) = (random.within(1.0), random.within(length));
        [start, start + along, start + random.within(0.01)]
    });
    let mesh = lone_triangles(triangles.collect::<Vec<_>>());
    let mut scene = seen_from(dvec3(0.0, 0.0, 6.0));
    let turned = DAffine3::from_axis_angle(DVec3::ONE.normalize(), 0.7);
    scene.add_mesh(mesh, turned * DAffine3::from_scale(dvec3(3.0, 1.0, 0.5)));
    scene
}

#[test]
fn every_point_of_a_triangle_in_several_leaves_is_found() {
    // The first mesh shares a tree with shapes, the second has its own.
    assert_none([1500, 3000].into_iter().flat_map(|count| {
        let packed = pack::scene(&slivers(count)).expect("packed");
        let leaves = leaves_of_triangles(&packed);
        let divided: Vec<_> = (0..leaves.len()).filter(|&i| leaves[i] > 1).collect();
        assert!(divided.len() > 50, "{} are divided", divided.len());
        assert!(leaves.iter().all(|&count| count > 0), "one is left out");
        divided.into_iter().map(move |index| {
            let triangle = &packed.triangles[index];
            let [a, b, c] =
                [triangle.v0, triangle.v1, triangle.v2].map(|v| Vec3::from(v).as_dvec3());
            for (i, j) in (0..=40).flat_map(|i| (0..=4).map(move |j| (f64::from(i), f64::from(j))))
            {
                let (u, v) = (i / 40.0, j / 4.0 * (1.0 - i / 40.0));
                let point = a + (b - a) * u + (c - a) * v;
                let is_its_leaf = |reference| triangles_of(reference).contains(&index);
                if !is_found(&packed, 0, point, &is_its_leaf) {
                    return Err(format!(
                        "triangle {index} of {count} is not found at {u}, {v}"
                    ));
                }
            }
            Ok(())
        })
    }));
}

/// Long and short cylinders, cones, boxes and rectangles, oblique and along the axes.
fn beams(seed: u64) -> Scene {
    let mut random = Random(seed);
    let mut scene = seen_from(dvec3(0.0, 0.0, 6.0));
    for index in 0..400 {
        let cone = |bottom: f64| CanonicalShape::Cone {
            bottom,
            top: 1.0,
            capped: index % 8 < 4,
        };
        let width = random.between(0.01, 0.1);
        let length = if index % 16 < 12 { 2.0 } else { width };
        let (canonical, size) = match index % 4 {
            0 => (cone(1.0), dvec3(width, length, width)),
            1 => (cone(random.between(0.0, 1.0)), dvec3(width, length, width)),
            2 => (CanonicalShape::Box, dvec3(width, width, length)),
            _ => (CanonicalShape::Rectangle, dvec3(length, 1.0, width)),
        };
        let turn = match index % 32 < 16 {
            true => DQuat::from_axis_angle(random.within(1.0).normalize(), 1.0),
            false => DQuat::IDENTITY,
        };
        let place = DAffine3::from_scale_rotation_translation(size, turn, random.within(2.0));
        add_placed(&mut scene, canonical, place);
    }
    scene
}

fn add_placed(scene: &mut Scene, canonical: CanonicalShape, world_from_canonical: DAffine3) {
    scene.shapes.push(Shape {
        geometry: Geometry::Placed {
            canonical,
            world_from_canonical,
        },
        material: 0,
        node: None,
        name: String::new(),
    });
}

/// Points on a packed cone, box or rectangle, in its canonical space.
fn canonical_points(shape: &PackedShape) -> Vec<DVec3> {
    let steps = |count: u32| (0..=count).map(move |i| f64::from(i) / f64::from(count));
    let grid = steps(40).flat_map(|a| steps(8).map(move |b| (a, b)));
    let across = |a: f64, b: f64| (2.0 * a - 1.0, 2.0 * b - 1.0);
    match shape.kind {
        SHAPE_CONE => {
            let [bottom, top] = [shape.size0, shape.size1].map(f64::from);
            let round = |(y, turn): (f64, f64)| {
                let (sin, cos) = (TAU * turn).sin_cos();
                let radius = bottom + (top - bottom) * y;
                dvec3(radius * cos, y, radius * sin)
            };
            grid.map(round).collect()
        }
        SHAPE_RECTANGLE => {
            let flat = |(a, b)| dvec3(across(a, b).0, 0.0, across(a, b).1);
            grid.map(flat).collect()
        }
        SHAPE_BOX => {
            let sides = |(a, b)| {
                let (a, b) = across(a, b);
                let faces = [dvec3(b, a, 1.0), dvec3(1.0, a, b), dvec3(a, 1.0, b)];
                faces.into_iter().flat_map(|point| [point, -point])
            };
            grid.flat_map(sides).collect()
        }
        kind => panic!("a shape of kind {kind}"),
    }
}

#[test]
fn every_point_of_a_shape_in_several_leaves_is_found() {
    let packed = pack::scene(&beams(5)).expect("packed");
    let leaves = leaves_of(&packed, packed.shapes.len(), shapes_of);
    assert!(leaves.iter().all(|&count| count > 0), "one is left out");
    let divided = leaves.iter().filter(|&&count| count > 1).count();
    assert!(divided > 50, "{divided} are divided");
    assert_none((0..packed.shapes.len()).map(|index| {
        let shape = &packed.shapes[index];
        let rows = [shape.row_x, shape.row_y, shape.row_z].map(|row| Vec3::from(row).as_dvec3());
        let render_from_canonical = DMat3::from_cols_array_2d(&rows.map(Into::into))
            .transpose()
            .inverse();
        let origin = Vec3::from(shape.position).as_dvec3();
        let is_its_leaf = |reference| shapes_of(reference).contains(&index);
        for canonical in canonical_points(shape) {
            let point = origin + render_from_canonical * canonical;
            if !is_found(&packed, 0, point, &is_its_leaf) {
                return Err(format!("shape {index} is not found at {canonical}"));
            }
        }
        Ok(())
    }));
}

#[test]
fn only_long_oblique_shapes_are_in_several_leaves() {
    let radius = 1.0 / 15.0;
    let cylinder = CanonicalShape::Cone {
        bottom: 1.0,
        top: 1.0,
        capped: true,
    };
    assert_none(
        [
            ("long and oblique", DVec3::ONE, 1.0, 2..=8),
            ("long, at 45 degrees", dvec3(1.0, 0.0, 1.0), 1.0, 2..=8),
            ("along an axis", DVec3::Z, 1.0, 1..=1),
            ("short", DVec3::ONE, radius, 1..=1),
        ]
        .map(|(name, axis, length, expected)| {
            let turn = DQuat::from_rotation_arc(DVec3::Y, axis.normalize());
            let size = dvec3(radius, length, radius);
            let mut scene = seen_from(dvec3(0.0, 0.0, 6.0));
            for x in 0..50 {
                let at = dvec3(f64::from(x), 0.0, 0.0);
                let place = DAffine3::from_scale_rotation_translation(size, turn, at);
                add_placed(&mut scene, cylinder, place);
            }
            let packed = pack::scene(&scene).expect("packed");
            let leaves = leaves_of(&packed, packed.shapes.len(), shapes_of);
            match leaves.iter().all(|count| expected.contains(count)) {
                true => Ok(()),
                false => Err(format!("{name}: {leaves:?}")),
            }
        }),
    );
}

fn lone_triangles(corners: impl IntoIterator<Item = [DVec3; 3]>) -> Mesh {
    let mut mesh = Mesh::default();
    for triangle in corners {
        let first = mesh.positions.len() as u32;
        mesh.positions
            .extend(triangle.map(|corner| corner.as_vec3()));
        mesh.triangles.push([first, first + 1, first + 2]);
    }
    mesh.materials = vec![0; mesh.positions.len()];
    mesh.repair();
    mesh
}

fn seen_from(look_from: DVec3) -> Scene {
    let mut scene = scenes::empty();
    scene.cameras[0].look_from = look_from;
    scene.cameras[0].look_at = look_from - DVec3::Z;
    scene
}

/// Triangles of all sizes and directions.
fn soup(seed: u64, count: usize) -> Scene {
    let mut random = Random(seed);
    let triangles = (0..count).map(|_| {
        let (center, size) = (random.within(2.0), 10f64.powf(random.between(-2.0, 0.0)));
        [(); 3].map(|()| center + random.within(size))
    });
    let mesh = lone_triangles(triangles.collect::<Vec<_>>());
    let mut scene = seen_from(dvec3(0.0, 0.0, 6.0));
    scene.add_mesh(mesh, DAffine3::IDENTITY);
    scene
}

/// Overlapping spheres, some of them duplicates.
fn bubbles(seed: u64) -> Scene {
    let mut random = Random(seed);
    let mut scene = seen_from(dvec3(0.0, 0.0, 6.0));
    for i in 0..300 {
        let (center, radius) = (random.within(2.0), 10f64.powf(random.between(-2.0, 0.0)));
        for _ in 0..=(i % 7) / 6 {
            scene.add_sphere(center, radius, 0);
        }
    }
    scene
}

/// The walls of unit cells on a grid, seen along an axis from a corner of the grid, so that rays
/// have zero components and run in the walls' planes and through their edges.
fn walls(seed: u64) -> Scene {
    let mut random = Random(seed);
    let axes = [DVec3::X, DVec3::Y, DVec3::Z];
    let mut triangles = Vec::new();
    for _ in 0..400 {
        let corner = [(); 3].map(|()| random.below(7) as f64 - 3.0);
        let corner = DVec3::from_array(corner);
        let axis = random.below(3) as usize;
        let (u, v) = (axes[(axis + 1) % 3], axes[(axis + 2) % 3]);
        triangles.push([corner, corner + u, corner + v]);
        triangles.push([corner + u, corner + u + v, corner + v]);
    }
    let mut scene = seen_from(dvec3(0.0, 0.0, 8.0));
    scene.add_mesh(lone_triangles(triangles), DAffine3::IDENTITY);
    scene
}

/// Repeated triangles, and others that overlap in the same plane.
fn ties(seed: u64) -> Scene {
    let mut random = Random(seed);
    let mut triangles = Vec::new();
    for i in 0..200 {
        let mut flat =
            |z: f64| [(); 3].map(|()| (random.within(2.0) * dvec3(1.0, 1.0, 0.0)).with_z(z));
        let triangle = flat(f64::from(i % 4) * 0.5);
        let copies = if i % 3 == 0 { 6 } else { 1 };
        triangles.extend(std::iter::repeat_n(triangle, copies));
    }
    let mut scene = seen_from(dvec3(0.0, 0.0, 6.0));
    scene.add_mesh(lone_triangles(triangles), DAffine3::IDENTITY);
    scene
}

/// All kinds of primitive at once, planes among them.
fn medley(seed: u64) -> Scene {
    let mut scene = soup(seed, 300);
    scene.shapes = bubbles(seed + 100).shapes;
    scene.add_plane(dvec3(0.0, -1.0, 0.0), DVec3::Y, 0);
    scene.add_plane(dvec3(0.0, 0.0, -2.0), DVec3::Z, 0);
    scene
}

/// Distances and ids through the tree and without it.
fn check_tree_against_brute_force(
    name: &str,
    scene: &Scene,
    settings: &RenderSettings,
) -> Result<(), String> {
    let mut problems = Vec::new();
    for integrator in [Integrator::Depth, Integrator::Ids] {
        let of = |brute_force| {
            render(
                scene,
                &RenderSettings {
                    integrator,
                    brute_force,
                    ..settings.clone()
                },
            )
            .0
        };
        let name = format!("{name}, {integrator:?}");
        problems.extend(check_same_hits(&name, integrator, &of(true), &of(false)).err());
    }
    if problems.is_empty() {
        Ok(())
    } else {
        Err(problems.join("\n"))
    }
}

/// The kernels with and without a tree are compiled apart. GPUs may fuse operations in one of them only, so distances differ
/// by some units in the last place.
fn check_same_hits(
    name: &str,
    integrator: Integrator,
    expected: &Image,
    actual: &Image,
) -> Result<(), String> {
    if integrator != Integrator::Depth || open_gpu().is_cpu() {
        return check_same_bits(name, expected, actual);
    }
    let mut pairs = expected.pixels.iter().zip(&actual.pixels);
    let differs = |(a, b): &(&[f32; 4], &[f32; 4])| (a[0] - b[0]).abs() > 2e-6 * a[0].abs();
    match pairs.find(differs) {
        Some((a, b)) => Err(format!("{name}: {a:?} became {b:?}")),
        None => Ok(()),
    }
}

/// An odd number of pixels, so that the central ones look exactly along an axis.
fn odd_sized() -> RenderSettings {
    RenderSettings {
        size: (129, 129),
        ..RenderSettings::default()
    }
}

#[test]
fn the_tree_finds_what_brute_force_finds() {
    type Kind = (&'static str, fn(u64) -> Scene);
    let kinds: [Kind; 7] = [
        ("soup", |seed| soup(seed, 600)),
        ("slivers", |seed| slivers(1000 * seed as usize)),
        ("beams", beams),
        ("bubbles", bubbles),
        ("walls", walls),
        ("ties", ties),
        ("medley", medley),
    ];
    assert_none(kinds.into_iter().flat_map(|(name, scene)| {
        (1..=4).map(move |seed| {
            let name = format!("{name} {seed}");
            check_tree_against_brute_force(&name, &scene(seed), &odd_sized())
        })
    }));
}

/// A few cylinders, boxes, discs and glass spheres that touch among many triangles; and a few triangles among spheres; both
/// with planes.
fn few_of_a_kind() -> [Scene; 2] {
    let mut triangles = soup(11, 300);
    triangles.background = Background::Gradient {
        bottom: Vec3::X,
        top: Vec3::Y,
    };
    let glass = triangles.add_material(Material::from(Phong {
        reflect: Vec3::ONE,
        transmit: Vec3::ONE,
        opacity: 0.0,
        ior: 1.5,
        fresnel: Fresnel::Exact,
        ..Phong::default()
    }));
    triangles.add_plane(dvec3(0.0, -1.0, 0.0), DVec3::Y, 0);
    triangles.add_sphere(dvec3(-0.5, 0.21, 1.0), 0.5, glass);
    triangles.add_sphere(dvec3(0.5, 0.21, 1.0), 0.5, glass);
    let turn = DAffine3::from_rotation_z(0.5) * DAffine3::from_scale(dvec3(0.1, 2.0, 0.1));
    let cylinder = CanonicalShape::Cone {
        bottom: 1.0,
        top: 0.5,
        capped: true,
    };
    add_placed(&mut triangles, cylinder, turn);
    add_placed(
        &mut triangles,
        CanonicalShape::Box,
        turn * DAffine3::from_translation(DVec3::X),
    );
    let mut shapes = bubbles(12);
    shapes.add_plane(dvec3(0.0, -1.0, 0.0), DVec3::Y, 0);
    shapes.meshes = soup(13, 8).meshes;
    shapes.instances = soup(13, 8).instances;
    [triangles, shapes]
}

/// One primitive more, which no ray meets, and all are in the tree.
#[test]
fn what_is_in_no_tree_looks_as_what_is_in_one() {
    let far = dvec3(0.0, 0.0, 500.0);
    assert_none(few_of_a_kind().into_iter().flat_map(|few| {
        let mut more = few.clone();
        more.add_sphere(far, 0.01, 0);
        let corners = [DVec3::X, DVec3::Y, DVec3::Z].map(|axis| far + 0.01 * axis);
        more.add_mesh(lone_triangles([corners]), DAffine3::IDENTITY);
        let apart = |scene| pack::scene(scene).expect("packed").features.outside_tree;
        assert_ne!(apart(&few), OutsideTree::Nothing);
        assert_eq!(apart(&more), OutsideTree::Nothing);
        let integrators = [Integrator::Depth, Integrator::Normals, Integrator::Whitted];
        integrators.map(|integrator| {
            let of = |scene| {
                let settings = RenderSettings {
                    integrator,
                    ..odd_sized()
                };
                render(scene, &settings).0
            };
            let name = format!("{:?} apart, {integrator:?}", apart(&few));
            check_same_bits(&name, &of(&more), &of(&few))
        })
    }));
}

#[test]
fn every_triangle_test_finds_the_same_with_and_without_the_tree() {
    let rows = [
        ("soup", soup(7, 600)),
        ("walls", walls(7)),
        ("ties", ties(7)),
    ];
    assert_none(rows.into_iter().flat_map(|(name, scene)| {
        [TriangleTest::Plane, TriangleTest::MollerTrumbore].map(|triangle_test| {
            let settings = RenderSettings {
                triangle_test,
                ..odd_sized()
            };
            let name = format!("{name} by {triangle_test:?}");
            check_tree_against_brute_force(&name, &scene, &settings)
        })
    }));
}

#[test]
fn shadows_are_the_same_with_and_without_the_tree() {
    let scene = scenes::everything();
    let of = |brute_force| {
        render(
            &scene,
            &RenderSettings {
                brute_force,
                ..odd_sized()
            },
        )
        .0
    };
    assert_none([check_same_bits("shadows", &of(true), &of(false))]);
}

#[test]
fn a_chain_of_spheres_deeper_than_the_stack_renders_right() {
    let mut scene = seen_from(dvec3(0.0, 0.0, 6.0));
    for i in -40..46 {
        let (far, turn) = (2f64.powi(i), f64::from(i));
        let aside = 0.3 * dvec3(turn.cos(), turn.sin(), 0.0);
        scene.add_sphere(far * (aside - DVec3::Z), far / 20.0, 0);
    }
    let settings = RenderSettings {
        size: (64, 64),
        ..RenderSettings::default()
    };
    assert_none([check_tree_against_brute_force("chain", &scene, &settings)]);
    let hit = render(
        &scene,
        &RenderSettings {
            integrator: Integrator::Depth,
            ..settings
        },
    )
    .0;
    assert!(
        hit.pixels.iter().any(|pixel| pixel[0] > 1e6),
        "the far end is in the picture"
    );
}
