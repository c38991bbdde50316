//! Building trees: the work is bounded for every input, and the result is compact, cheap to traverse and
//! independent of the number of threads.

use crate::reference::compare::assert_none;
use crate::reference::scenes::{self, Build, Random};
use glam::{DAffine3, DVec3, dvec3};
use glimray::bvh::{self, Aabb, Bvh, Child, Limits, threads};
use glimray::layout::{PackedNode, PackedTriangle, STACK_SIZE};
use glimray::pack;
use glimray::scene::Scene;

const LIMITS: Limits = Limits {
    leaf_size: 4,
    alone: None,
    stack_size: STACK_SIZE as usize - 1,
};

pub fn build(boxes: &[Aabb]) -> Bvh {
    bvh::build(boxes, &vec![0; boxes.len()], 1, LIMITS)
}

fn box_round(center: DVec3, half: f64) -> Aabb {
    Aabb {
        min: (center - half).as_vec3(),
        max: (center + half).as_vec3(),
    }
}

/// The boxes in another order.
pub fn shuffled(mut boxes: Vec<Aabb>) -> Vec<Aabb> {
    let mut random = Random(7);
    for last in (1..boxes.len()).rev() {
        boxes.swap(last, random.below(last as u64 + 1) as usize);
    }
    boxes
}

/// Inputs in which few boxes are each other's nearest neighbours.
fn ties(count: u32) -> Vec<(&'static str, Vec<Aabb>)> {
    let mut random = Random(4);
    let mut jitter = |size: f64| {
        let mut boxes = Vec::new();
        for _ in 0..count {
            let (min, max) = (random.within(size), random.within(size));
            boxes.push(Aabb {
                min: (DVec3::splat(0.5) + min).as_vec3(),
                max: (DVec3::splat(1.5) + max).as_vec3(),
            });
        }
        boxes
    };
    let near = [jitter(0.0), jitter(1e-7), jitter(1e-5), jitter(1e-3)];
    let indexed = |make: &dyn Fn(f64) -> Aabb| (0..count).map(|i| make(f64::from(i))).collect();
    let corner = |turn: f64| DVec3::new(turn.cos(), turn.sin(), 0.0).as_vec3();
    let step = std::f64::consts::TAU / f64::from(count);
    let [equal, tiny, small, visible] = near;
    vec![
        ("equal", equal),
        ("nearly equal, 1e-7", tiny),
        ("nearly equal, 1e-5", small),
        ("nearly equal, 1e-3", visible),
        ("in a row", indexed(&|i| box_round(DVec3::X * 3.0 * i, 1.0))),
        (
            "ever further apart",
            indexed(&|i| box_round(DVec3::X * (3.0 + 1e-5 * i) * i, 1.0)),
        ),
        ("nested", indexed(&|i| box_round(DVec3::ONE, 1.0 + i))),
        (
            "nearly nested",
            indexed(&|i| box_round(DVec3::X * (i % 7.0) * 1e-6, 1.0 + 1e-6 * i)),
        ),
        (
            "two clusters",
            indexed(&|i| box_round(DVec3::X * (100.0 * (i % 2.0) + 1e-6 * (i % 5.0)), 1.0)),
        ),
        (
            "a fan",
            indexed(&|i| {
                Aabb::of([
                    DVec3::ZERO.as_vec3(),
                    corner(i * step),
                    corner((i + 1.0) * step),
                ])
            }),
        ),
    ]
}

#[test]
fn ties_do_not_make_the_work_quadratic() {
    let count = 30_000;
    let rows = ties(count).into_iter().flat_map(|(name, boxes)| {
        let shuffled = shuffled(boxes.clone());
        [(name, "in order", boxes), (name, "shuffled", shuffled)]
    });
    assert_none(rows.map(|(name, order, boxes)| {
        let per_box = build(&boxes).work as f64 / f64::from(count);
        // Passes over all boxes with 14 comparisons each; a quadratic pass alone would take thousands.
        match per_box < 400.0 {
            true => Ok(()),
            false => Err(format!(
                "{name}, {order}: {per_box} comparisons for each box"
            )),
        }
    }));
}

/// The probability-weighted number of nodes and boxes that a random ray through the root visits.
pub fn cost(bvh: &Bvh) -> f64 {
    let area = |aabb: &Aabb| f64::from(aabb.half_area());
    let children = bvh.nodes.iter().flat_map(|node| &node.children);
    let below: f64 = children
        .map(|(aabb, child)| match child {
            Child::Node(_) => area(aabb),
            Child::Leaf { count, .. } => area(aabb) * f64::from(*count),
        })
        .sum();
    let all = bvh.nodes[0].children.iter();
    1.0 + below / area(&all.fold(Aabb::EMPTY, |all, (aabb, _)| all.union(*aabb)))
}

/// [`cost`] of a tree that halves the boxes at the median of the longest axis, four ways in each node.
fn cost_of_medians(boxes: &mut [Aabb], root_area: f64) -> f64 {
    let union = |part: &[Aabb]| part.iter().fold(Aabb::EMPTY, |all, aabb| all.union(*aabb));
    let all = union(boxes);
    let share = f64::from(all.half_area()) / root_area;
    if boxes.len() <= 4 {
        return share * boxes.len() as f64;
    }
    let halve = |part: &mut [Aabb]| {
        let all = union(part);
        let axis = (all.max - all.min).max_position();
        let center = |aabb: &Aabb| aabb.min[axis] + aabb.max[axis];
        part.sort_by(|a, b| center(a).total_cmp(&center(b)));
        part.len() / 2
    };
    let middle = halve(boxes);
    let (left, right) = boxes.split_at_mut(middle);
    let quarters = [left, right].map(|half| {
        let middle = halve(half);
        let (left, right) = half.split_at_mut(middle);
        cost_of_medians(left, root_area) + cost_of_medians(right, root_area)
    });
    share + quarters[0] + quarters[1]
}

/// A height field of so many by so many cells of two triangles.
pub fn height_field(parts: u32) -> Scene {
    let mut scene = scenes::empty();
    let height = |x: f64, z: f64| {
        0.1 * (x * 7.0).sin() * (z * 5.0).cos() + 0.02 * (x * 41.0 + z * 29.0).sin()
    };
    scene.add_mesh(
        scenes::height_field(2.0, parts, 0, height),
        DAffine3::IDENTITY,
    );
    scene
}

/// The boxes of the triangles of the first mesh.
pub fn boxes_of(scene: &Scene) -> Vec<Aabb> {
    let mesh = &scene.meshes[0];
    let corners = |triangle: &[u32; 3]| triangle.map(|i| mesh.positions[i as usize]);
    (mesh.triangles.iter().map(corners)).map(Aabb::of).collect()
}

/// Strips of all lengths and directions.
fn strips() -> Vec<Aabb> {
    let mut random = Random(11);
    let strip = |random: &mut Random| {
        let (start, along) = (random.within(1.0), random.within(0.4));
        let aside = dvec3(along.y, -along.x, 0.0) * 0.01;
        Aabb::of([start, start + along, start + aside].map(|corner| corner.as_vec3()))
    };
    (0..20_000).map(|_| strip(&mut random)).collect()
}

#[test]
fn a_tree_is_cheaper_than_one_of_medians() {
    let rows = [
        ("height field", boxes_of(&height_field(150)), 0.8),
        ("strips", strips(), 0.88),
    ];
    assert_none(rows.map(|(name, mut boxes, most)| {
        let ours = cost(&build(&boxes));
        let root = boxes.iter().fold(Aabb::EMPTY, |all, aabb| all.union(*aabb));
        let medians = cost_of_medians(&mut boxes, root.half_area().into());
        match ours <= most * medians {
            true => Ok(()),
            false => Err(format!("{name}: {ours} against {medians}")),
        }
    }));
}

#[test]
fn a_few_ties_do_not_spoil_a_tree() {
    let boxes = boxes_of(&height_field(100));
    let knot = shuffled(vec![boxes[7000]; 2000]);
    let with_knot = [boxes.clone(), knot].concat();
    let least = cost(&build(&boxes));
    // The knot itself takes at most one visit for each of its boxes and their nodes, times its share of the rays.
    let root = boxes.iter().fold(Aabb::EMPTY, |all, aabb| all.union(*aabb));
    let share = f64::from(boxes[7000].half_area() / root.half_area());
    let most = 1.05 * least + share * 2.0 * 2000.0;
    let got = cost(&build(&with_knot));
    assert!(got <= most, "{got} against {most}");
}

#[test]
fn a_mesh_takes_at_most_80_bytes_a_triangle() {
    let scene = height_field(150);
    let packed = pack::scene(&scene).expect("packed");
    let bytes = packed.nodes.len() * size_of::<PackedNode>()
        + packed.triangles.len() * size_of::<PackedTriangle>();
    let each = bytes as f64 / scene.triangle_count() as f64;
    assert!(each <= 80.0, "{each} bytes for each triangle");
}

#[test]
fn the_number_of_threads_does_not_change_a_byte() {
    let scene = height_field(150);
    assert!(scene.triangle_count() > 40_000, "the work is divided");
    let packed = |count| threads::with(count, || pack::scene(&scene)).expect("packed");
    let (one, two, five) = (packed(1), packed(2), packed(5));
    assert!(one.parts() == two.parts(), "two threads differ from one");
    assert!(one.parts() == five.parts(), "five threads differ from one");
}

#[test]
fn threads_divide_and_sort_every_length() {
    let mut random = Random(3);
    assert_none(
        [0, 1, 2, 16_383, 16_384, 16_385, 50_001, 100_000].map(|len: usize| {
            let list: Vec<_> = (0..len as u64).map(|i| (random.below(1000), i)).collect();
            let mut expected = list.clone();
            expected.sort();
            for count in [1, 2, 3, 7] {
                let (mut sorted, copied, shared) = threads::with(count, || {
                    let copied = threads::collect(len, |index| list[index]);
                    (
                        list.clone(),
                        copied,
                        threads::collect_shared(len, |index| list[index]),
                    )
                });
                threads::with(count, || threads::sort(&mut sorted));
                if sorted != expected || copied != list || *shared != *list {
                    return Err(format!("{len} by {count} threads"));
                }
            }
            Ok(())
        }),
    );
}
