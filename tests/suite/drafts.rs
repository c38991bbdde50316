//! Drafts of BVHs for first pictures: sound trees, the same hits, and the usual trees after them, with all samples kept.

use crate::bvh::inputs;
use crate::ray_query::{toward, triangle};
use crate::reference::compare::{assert_none, check_alike, open_gpu, render, sized, start_packed};
use crate::reference::scenes::{self, Build, Random};
use crate::support::PATIENCE;
use crate::trees::{boxes_of, build, cost, height_field, shuffled};
use glam::{DAffine3, DQuat, DVec3, Vec3, dvec3};
use glimray::bvh::linear::{self, LinearBvh};
use glimray::bvh::{Aabb, Child, StackNeed, threads};
use glimray::pack::{self, DRAFT_FROM, PackedScene};
use glimray::render::{ExecutionPolicy, Integrator, RayQuery, RenderSettings, Slicing, Tone};
use glimray::scene::{Deformation, Scene};
use glimray_viewer::model::refinement::{Refined, Refinement};
use std::sync::Arc;
use std::time::{Duration, Instant};

/// Cells along a side of a mesh that has just enough triangles for a draft.
const PARTS: u32 = 363;

/// A scene with a mesh that is large enough, a small one and a light.
fn large() -> Scene {
    let mut scene = height_field(PARTS);
    assert!(scene.triangle_count() >= DRAFT_FROM);
    let ball = scenes::ball(glam::UVec2::new(24, 12), 0);
    let place = DAffine3::from_translation(dvec3(0.2, 0.4, 0.1));
    scene.add_mesh(ball, place * DAffine3::from_scale(DVec3::splat(0.2)));
    scene.add_point_light(dvec3(1.0, 3.0, 2.0), 8.0);
    scene
}

fn draft(scene: &Scene) -> Arc<PackedScene> {
    let packed = pack::draft(scene).expect("a scene that can be packed");
    assert!(packed.is_draft());
    Arc::new(packed)
}

/// Describes what is wrong with a tree over so many boxes.
fn check(tree: &LinearBvh, count: usize) -> Result<(), String> {
    let mut seen = vec![0; count];
    let mut reached = vec![0; tree.nodes.len()];
    // A ray that hits every child and follows any one of them leaves its siblings on the stack, above the entry that marks the
    // empty stack, or their parent.
    let empty = StackNeed {
        references: 1,
        nodes: 0,
    };
    let (mut open, mut most) = (vec![(0, empty)], empty);
    while let Some((index, mut waiting)) = open.pop() {
        reached[index] += 1;
        let children: Vec<_> = tree.nodes[index].iter().flatten().collect();
        waiting.references += children.len() - 1;
        waiting.nodes += usize::from(children.len() > 1);
        most = most.max(waiting);
        for child in children {
            match *child {
                Child::Node(below) if below as usize <= index => {
                    return Err(format!("node {below} comes before its parent {index}"));
                }
                Child::Node(below) => open.push((below as usize, waiting)),
                Child::Leaf {
                    group: 0,
                    first,
                    count: count @ 1..=4,
                } => {
                    for place in first..first + count {
                        seen[tree.order[place as usize] as usize] += 1;
                    }
                }
                leaf => return Err(format!("{leaf:?}")),
            }
        }
    }
    match (
        seen.iter().position(|it| *it != 1),
        reached.iter().position(|it| *it != 1),
    ) {
        (Some(index), _) => Err(format!("box {index} is in {} leaves", seen[index])),
        (_, Some(index)) => Err(format!("node {index} is reached {} times", reached[index])),
        _ if most != tree.stack_need => Err(format!("{:?}, {most:?} needed", tree.stack_need)),
        _ => Ok(()),
    }
}

#[test]
fn linear_trees_have_every_box_in_one_leaf() {
    assert_none(inputs().into_iter().map(|(name, boxes)| {
        let tree = linear::build(&boxes, usize::MAX);
        let checked = match &tree {
            None if boxes.len() < 2 => Ok(()),
            None => Err("no tree".into()),
            Some(tree) => check(tree, boxes.len()),
        };
        let need = tree.map_or(0, |tree| tree.stack_need.references);
        let is_refused = need == 0 || linear::build(&boxes, need - 1).is_none();
        let refused = match is_refused {
            true => Ok(()),
            false => Err(format!("fits fewer than {need} entries")),
        };
        checked.and(refused).map_err(|why| format!("{name}: {why}"))
    }));
}

#[test]
fn the_number_of_threads_does_not_change_a_linear_tree() {
    let boxes = boxes_of(&height_field(150));
    let with = |count| {
        let tree = threads::with(count, || linear::build(&boxes, 60)).expect("a tree");
        (tree.nodes, tree.order)
    };
    assert!(with(1) == with(2), "two threads differ from one");
    assert!(with(1) == with(5), "five threads differ from one");
}

/// The half areas of the boxes of nodes and, once for each of its boxes, of leaves; without boxes that are larger than `most`.
/// By the surface area heuristic a ray visits and tests that much, divided by what it hits.
fn steps(tree: &LinearBvh, boxes: &[Aabb], most: f32) -> f64 {
    let mut bounds = vec![Aabb::EMPTY; tree.nodes.len()];
    let mut sum = 0.0;
    let mut add = |aabb: Aabb, count: u32| {
        if aabb.half_area() <= most {
            sum += f64::from(count) * f64::from(aabb.half_area());
        }
    };
    for index in (0..tree.nodes.len()).rev() {
        for child in tree.nodes[index].iter().flatten() {
            let aabb = match *child {
                Child::Node(below) => bounds[below as usize],
                Child::Leaf { first, count, .. } => {
                    let places = first as usize..(first + count) as usize;
                    let own = tree.order[places]
                        .iter()
                        .map(|&index| boxes[index as usize]);
                    let aabb = own.reduce(|a, b| a.union(b)).expect("a box");
                    add(aabb, count);
                    aabb
                }
            };
            bounds[index] = bounds[index].union(aabb);
        }
        add(bounds[index], 1);
    }
    sum
}

#[test]
fn a_linear_tree_over_even_triangles_is_nearly_as_good() {
    let boxes = boxes_of(&height_field(150));
    let root = boxes.iter().fold(Aabb::EMPTY, |all, aabb| all.union(*aabb));
    let tree = linear::build(&boxes, 60).expect("a tree");
    let usual = cost(&build(&boxes)) * f64::from(root.half_area());
    let own = steps(&tree, &boxes, f32::MAX);
    assert!(own < 1.2 * usual, "{} times the usual", own / usual);

    // Also where the mesh is small in its bounds, and its triangles are in no order: many have the same upper bits.
    let mut far = shuffled(boxes);
    far.push(Aabb {
        min: Vec3::splat(20_000.0),
        max: Vec3::splat(20_000.1),
    });
    let tree = linear::build(&far, 60).expect("a tree");
    let own = steps(&tree, &far, root.half_area());
    assert!(own < 1.5 * usual, "{} times the usual", own / usual);
}

#[test]
fn a_refined_scene_has_the_bytes_of_a_full_pack() {
    let scene = large();
    let draft = draft(&scene);
    let usual = pack::scene(&scene).expect("packed");
    assert!(!usual.is_draft());
    assert!(
        usual.parts() != draft.parts(),
        "the draft is the usual tree"
    );
    assert_eq!(
        draft.work.topologies, 1,
        "the small mesh is in the joint tree"
    );

    // Edits do not wait for the usual trees.
    let edited = Scene {
        ambient: scene.ambient * 2.0,
        ..scene.clone()
    };
    let again = pack::scene_from(&draft, &edited).expect("packed");
    assert_eq!((again.work.total(), again.work.topologies), (0, 0));
    assert!(again.is_draft());

    let refined = pack::refined(&draft, &scene).expect("packed");
    assert!(!refined.is_draft());
    assert!(refined.parts() == usual.parts(), "the bytes differ");
    // Whatever is packed from the draft has the better tree from now on.
    let again = pack::scene_from(&draft, &edited).expect("packed");
    assert!(!again.is_draft());
    assert_eq!(again.work.topologies, 0);
    let expected = pack::scene(&edited).expect("packed");
    assert!(again.parts() == expected.parts(), "the bytes differ");
}

#[test]
fn small_and_deforming_meshes_have_no_drafts() {
    let small = height_field(PARTS - 1);
    assert!(small.triangle_count() < DRAFT_FROM);
    let mut deforming = height_field(PARTS);
    deforming.deformations.push(Deformation {
        mesh: 0,
        targets: Arc::default(),
        weights: Vec::new(),
        skin: None,
        flat: Arc::default(),
    });
    assert_none(
        [("small", small), ("deforming", deforming)].map(|(name, scene)| {
            let packed = pack::draft(&scene).expect("packed");
            let usual = pack::scene(&scene).expect("packed");
            match packed.is_draft() || packed.parts() != usual.parts() {
                true => Err(format!("{name}: a draft")),
                false => Ok(()),
            }
        }),
    );
}

#[test]
fn rays_find_in_a_draft_what_a_search_finds() {
    let mut scene = height_field(PARTS);
    let placement =
        DAffine3::from_rotation_translation(DQuat::from_rotation_x(0.4), dvec3(3.0, -1.0, 2.0));
    scene.instances[0].placement = placement;
    let mesh = scene.meshes[0].clone();
    let corners: Vec<_> = (mesh.positions.iter())
        .map(|corner| placement.transform_point3(corner.as_dvec3()))
        .collect();
    let mut random = Random(5);
    let rays: Vec<_> = (0..60)
        .map(|_| {
            let at = dvec3(random.between(-1.2, 1.2), 0.0, random.between(-1.2, 1.2));
            let from = at + dvec3(random.between(-1.0, 1.0), 0.7, random.between(-1.0, 1.0));
            toward(
                placement.transform_point3(from),
                placement.transform_point3(at),
            )
        })
        .collect();
    let packed = draft(&scene);
    let view = packed.frame(&scene.frame(0.0)).expect("a view");
    let query = RayQuery::new(open_gpu(), packed, &view, ExecutionPolicy::default());
    let query = query.expect("a query");
    let hits = query.closest_hits(&rays).expect("hits");
    let mut hit_count = 0;
    assert_none(rays.iter().zip(hits).map(|(ray, hit)| {
        let direction = ray.direction.as_dvec3();
        let distances = mesh.triangles.iter().filter_map(|t| {
            triangle(
                ray.origin,
                direction,
                t.map(|corner| corners[corner as usize]),
            )
        });
        let nearest = distances.min_by(f64::total_cmp);
        hit_count += usize::from(nearest.is_some());
        match (nearest, hit) {
            (None, None) => Ok(()),
            (Some(t), Some(hit)) if (t - f64::from(hit.t)).abs() < 1e-5 => Ok(()),
            (expected, hit) => Err(format!("{ray:?}: {hit:?} instead of {expected:?}")),
        }
    }));
    assert!(hit_count > 30, "only {hit_count} rays hit");
}

#[test]
fn a_renderer_goes_on_with_the_better_tree() {
    let scene = large();
    let draft = draft(&scene);
    let refined = Arc::new(pack::refined(&draft, &scene).expect("packed"));
    let settings = RenderSettings {
        samples: 6,
        ..sized(48, 32)
    };
    let policy = ExecutionPolicy {
        slicing: Slicing {
            max_samples: 1,
            ..Slicing::default()
        },
        host_copy: false,
        ..ExecutionPolicy::default()
    };
    let in_tiles = Slicing {
        tile_side: 16,
        ..policy.slicing
    };
    let rows = [
        ("sums on the device", settings.clone(), policy),
        (
            "sums on the host",
            settings.clone(),
            ExecutionPolicy {
                host_copy: true,
                ..policy
            },
        ),
        (
            "film tiles",
            settings.clone(),
            ExecutionPolicy {
                slicing: in_tiles,
                ..policy
            },
        ),
        (
            "two blocks of samples",
            RenderSettings {
                samples: 80,
                ..settings.clone()
            },
            policy,
        ),
        (
            "paths",
            RenderSettings {
                integrator: Integrator::Path,
                ..settings
            },
            policy,
        ),
    ];
    assert_none(rows.into_iter().map(|(name, settings, policy)| {
        let view = |packed: &PackedScene| packed.frame(&scene.frame(0.0)).expect("a view");
        let (expected, stats) = render(&scene, &settings);
        let mut renderer = start_packed(draft.clone(), &view(&draft), &(settings, policy));
        while renderer.progress() < 0.4 {
            renderer.step().expect("a step");
        }
        let before = renderer.progress();
        let replaced = renderer.replace_scene(refined.clone(), &view(&refined), policy);
        replaced.expect("a renderer");
        if before == 1.0 || renderer.progress() != before {
            return Err(format!("{name}: {before}, then {}", renderer.progress()));
        }
        while !renderer.is_done() {
            renderer.step().expect("a step");
        }
        if renderer.stats().samples != stats.samples {
            return Err(format!("{name}: {} samples", renderer.stats().samples));
        }
        let image = renderer.develop(&Tone::LINEAR).expect("a picture");
        check_alike(name, &expected, &image, 1.0, 0.001)
    }));
}

#[test]
fn a_scene_that_was_edited_meanwhile_is_refined_as_it_is_now() {
    let scene = large();
    let draft = draft(&scene);
    let mut edited = scene.clone();
    edited.instances[1].placement = DAffine3::from_translation(dvec3(0.0, 0.6, 0.0));
    let edited = Arc::new(edited);
    let mut refinement = Refinement::new(edited.clone(), draft).expect("a thread");
    let start = Instant::now();
    let refined = loop {
        match refinement.poll() {
            Refined::Scene(refined) => break refined,
            Refined::Never => panic!("it has failed"),
            Refined::NotYet => std::thread::sleep(Duration::from_millis(5)),
        }
        assert!(start.elapsed() < PATIENCE, "never done");
    };
    let packed = refined.packed(&edited).expect("the edited scene");
    let expected = pack::scene(&edited).expect("packed");
    assert!(packed.parts() == expected.parts(), "the bytes differ");
}
