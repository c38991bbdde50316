//! Ray queries: they find what a search through all primitives in f64 finds.

use crate::reference::compare::open_gpu;
use crate::reference::scenes::{self, Build};
use crate::support::random::Random;
use crate::support::verdict::Verdict;
use glam::{DAffine3, DVec3, dvec3};
use glimray::pack::{self, OutsideTree};
use glimray::render::{Coherence, ExecutionPolicy, Fetch, QueryHit, QueryRay, RayQuery, RayTest};
use glimray::scene::{Geometry, Mesh, ObjectRef, Scene};
use std::sync::Arc;

/// Overlapping meshes and spheres, more than the joint tree holds, in a corner of the world.
fn mixed() -> Scene {
    let mut scene = scenes::empty();
    let mut random = Random::new(1);
    for _ in 0..40 {
        scene.add_sphere(2.0 * random.in_cube(), random.between(0.05, 0.4), 0);
    }
    let ball = Arc::new(scenes::ball(glam::UVec2::new(24, 12), 0));
    for _ in 0..20 {
        let place = DAffine3::from_translation(2.0 * random.in_cube());
        scene.add_mesh(
            ball.clone(),
            place * DAffine3::from_scale(DVec3::splat(0.4)),
        );
    }
    scene
}

/// Instances of one mesh that are not baked, uneven and mirrored, with spheres between them.
fn instanced() -> Scene {
    let mut scene = mixed();
    let mesh = scene.meshes.pop().expect("a mesh");
    scene.meshes = vec![mesh];
    let mut random = Random::new(2);
    for instance in &mut scene.instances {
        instance.mesh = 0;
        let mut scale = || random.between(0.2, 0.5);
        let scale = dvec3(scale(), -scale(), scale());
        let turn =
            DAffine3::from_rotation_z(scale.x * 9.0) * DAffine3::from_rotation_x(scale.y * 9.0);
        let place = DAffine3::from_translation(instance.placement.translation);
        instance.placement = place * turn * DAffine3::from_scale(scale);
    }
    scene
}

/// The given numbers of spheres and triangles.
fn few(spheres: usize, triangles: usize) -> Scene {
    let mut scene = scenes::empty();
    let mut random = Random::new(4);
    for _ in 0..spheres {
        scene.add_sphere(2.0 * random.in_cube(), random.between(0.05, 0.4), 0);
    }
    let mut mesh = Mesh::default();
    for first in (0..3 * triangles as u32).step_by(3) {
        let corners = [(); 3].map(|()| (2.0 * random.in_cube()).as_vec3());
        mesh.positions.extend(corners);
        mesh.triangles.push([first, first + 1, first + 2]);
    }
    mesh.materials = vec![0; mesh.positions.len()];
    mesh.repair();
    scene.add_mesh(mesh, DAffine3::IDENTITY);
    scene
}

/// Four spheres among instances of a mesh: nothing that is baked is in a tree.
fn few_and_instanced() -> Scene {
    let mut scene = instanced();
    scene.shapes.truncate(4);
    scene
}

/// Rays between random points, every third of limited length.
fn rays(count: usize) -> Vec<QueryRay> {
    let mut random = Random::new(3);
    (0..count)
        .map(|index| QueryRay {
            t_max: if index % 3 == 0 { 0.7 } else { QueryRay::FAR },
            ..toward(3.0 * random.in_cube(), 2.0 * random.in_cube())
        })
        .collect()
}

pub fn toward(origin: DVec3, target: DVec3) -> QueryRay {
    QueryRay::new(origin, (target - origin).normalize().as_vec3())
}

/// The closest hit in f64: its distance and object.
fn reference(scene: &Scene, ray: &QueryRay) -> Option<(f64, ObjectRef)> {
    let (origin, direction) = (ray.origin, ray.direction.as_dvec3());
    let triangles = scene
        .instances
        .iter()
        .enumerate()
        .flat_map(|(index, instance)| {
            let mesh = &scene.meshes[instance.mesh];
            mesh.triangles.iter().filter_map(move |corners| {
                let [a, b, c] = corners.map(|corner| {
                    let corner = mesh.positions[corner as usize].as_dvec3();
                    instance.placement.transform_point3(corner)
                });
                Some((
                    triangle(origin, direction, [a, b, c])?,
                    ObjectRef::Instance(index),
                ))
            })
        });
    let spheres = scene
        .shapes
        .iter()
        .enumerate()
        .filter_map(|(index, shape)| {
            let Geometry::Sphere { center, radius } = shape.geometry else {
                panic!("a sphere")
            };
            Some((
                sphere(origin, direction, center, radius)?,
                ObjectRef::Shape(index),
            ))
        });
    let hits = triangles.chain(spheres);
    hits.filter(|(t, _)| *t < f64::from(ray.t_max))
        .min_by(|a, b| a.0.total_cmp(&b.0))
}

/// Solves origin + t direction = a + u (b - a) + v (c - a) by Cramer's rule.
pub fn triangle(origin: DVec3, direction: DVec3, [a, b, c]: [DVec3; 3]) -> Option<f64> {
    let (u_axis, v_axis, to) = (b - a, c - a, origin - a);
    let volume = |x: DVec3, y: DVec3, z: DVec3| x.dot(y.cross(z));
    let whole = volume(-direction, u_axis, v_axis);
    let t = volume(to, u_axis, v_axis) / whole;
    let u = volume(-direction, to, v_axis) / whole;
    let v = volume(-direction, u_axis, to) / whole;
    (t > 0.0 && u >= 0.0 && v >= 0.0 && u + v <= 1.0).then_some(t)
}

pub fn sphere(origin: DVec3, direction: DVec3, center: DVec3, radius: f64) -> Option<f64> {
    let to = center - origin;
    let (a, b, c) = (
        direction.length_squared(),
        direction.dot(to),
        to.length_squared() - radius * radius,
    );
    let root = (b * b - a * c).sqrt();
    [(b - root) / a, (b + root) / a]
        .into_iter()
        .find(|t| *t > 0.0)
}

fn query(
    scene: &Scene,
    most_baked: usize,
    fetch: Fetch,
) -> (RayQuery, Arc<pack::PackedScene>, pack::PackedView) {
    let packed = Arc::new(pack::scene_with(scene, most_baked).expect("packed"));
    let view = packed.frame(&scene.frame(0.0)).expect("a view");
    let policy = ExecutionPolicy {
        fetch,
        ..ExecutionPolicy::default()
    };
    let query = RayQuery::new(open_gpu(), packed.clone(), &view, policy).expect("a query");
    (query, packed, view)
}

#[test]
fn queries_find_what_a_search_through_all_primitives_finds() {
    let rays = rays(5000);
    let mut verdict = Verdict::on("ray queries");
    for (name, scene, most_baked) in [
        ("baked", mixed(), usize::MAX),
        ("instanced", instanced(), 0),
        ("few triangles", few(40, 8), usize::MAX),
        ("one triangle", few(40, 1), usize::MAX),
        ("few spheres", few(4, 60), usize::MAX),
        ("few spheres and instances", few_and_instanced(), 0),
    ] {
        let expected: Vec<_> = rays.iter().map(|ray| reference(&scene, ray)).collect();
        let hit_count = expected.iter().flatten().count();
        assert!(
            (1000..4500).contains(&hit_count),
            "{name}: {hit_count} hits"
        );
        for fetch in [Fetch::Image, Fetch::Buffer, Fetch::Packet] {
            let (query, packed, view) = query(&scene, most_baked, fetch);
            assert_eq!(packed.instance_count() > 0, most_baked == 0);
            let closest = query.closest_hits(&rays).expect("hits");
            let any = query.occluded(&rays).expect("hits");
            assert_eq!((closest.len(), any.len()), (rays.len(), rays.len()));
            let object = |hit: &QueryHit| packed.object_at(&view, hit.primitive, hit.instance);
            let mut differing = 0;
            for (index, expected) in expected.iter().enumerate() {
                let found = closest[index].map(|hit| (f64::from(hit.t), object(&hit)));
                let is_same = match (found, expected) {
                    (None, None) => true,
                    (Some((t, object)), Some((exact, reference))) => {
                        (t - exact).abs() <= 1e-4 * exact && object == Some(*reference)
                    }
                    _ => false,
                };
                differing += usize::from(!is_same);
                verdict.that(
                    format!("any hit of ray {index}, {name}, {fetch:?}"),
                    any[index] == closest[index].is_some(),
                    || format!("{} and {found:?}", any[index]),
                );
            }
            // Rays past an edge within rounding may hit on one side and miss on the other.
            verdict.that(format!("{name}, {fetch:?}"), differing <= 2, || {
                format!("{differing} rays differ")
            });
        }
    }
    verdict.close();
}

#[test]
fn a_few_primitives_among_many_of_another_kind_are_in_no_tree() {
    let apart = |scene: &Scene, most_baked| {
        let packed = pack::scene_with(scene, most_baked).expect("packed");
        packed.features.outside_tree
    };
    let mut verdict = Verdict::on("what is apart");
    for (spheres, triangles, expected) in [
        (40, 1, OutsideTree::Triangles),
        (40, 8, OutsideTree::Triangles),
        (2, 2, OutsideTree::Triangles),
        (40, 9, OutsideTree::Nothing),
        (0, 8, OutsideTree::Nothing),
        (0, 60, OutsideTree::Nothing),
        (40, 0, OutsideTree::Nothing),
        (1, 60, OutsideTree::Shapes),
        (4, 60, OutsideTree::Shapes),
        (5, 60, OutsideTree::Nothing),
    ] {
        let found = apart(&few(spheres, triangles), usize::MAX);
        let name = format!("{spheres} spheres and {triangles} triangles");
        verdict.that(name, found == expected, || format!("{found:?}"));
    }
    verdict.close();
    // With a mesh that has a tree of its own, baked or not.
    let mut beside_mesh = few(40, 8);
    let ball = scenes::ball(glam::UVec2::new(100, 50), 0);
    beside_mesh.add_mesh(ball, DAffine3::IDENTITY);
    assert_eq!(apart(&beside_mesh, usize::MAX), OutsideTree::Nothing);
    assert_eq!(apart(&few_and_instanced(), 0), OutsideTree::Shapes);
}

#[test]
fn barycentric_weights_lead_to_the_hit_point() {
    let scene = mixed();
    let rays = rays(2000);
    let (query, packed, _) = query(&scene, usize::MAX, Fetch::Auto);
    let hits = query.closest_hits(&rays).expect("hits");
    let mut verdict = Verdict::on("weights");
    let mut count = 0;
    for (ray, hit) in rays.iter().zip(hits) {
        let Some((hit, triangle)) =
            hit.and_then(|hit| Some((hit, packed.triangles.get(hit.primitive as usize)?)))
        else {
            continue;
        };
        count += 1;
        let [v0, v1, v2] = [triangle.v0, triangle.v1, triangle.v2]
            .map(|corner| glam::Vec3::from(corner).as_dvec3() + packed.origin);
        let [b1, b2] = hit.weights.map(f64::from);
        let by_weights = v0 + b1 * (v1 - v0) + b2 * (v2 - v0);
        let along = ray.origin + f64::from(hit.t) * ray.direction.as_dvec3();
        let error = by_weights.distance(along);
        verdict.that(format!("{ray:?}"), error < 1e-4, || format!("{error}"));
    }
    assert!(count > 300, "{count} triangles");
    verdict.close();
}

#[test]
fn a_query_takes_any_number_of_rays() {
    let scene = mixed();
    let (query, ..) = query(&scene, usize::MAX, Fetch::Auto);
    assert_eq!(query.closest_hits(&[]).expect("none"), vec![]);
    let all = rays(130);
    let together = query.closest_hits(&all).expect("hits");
    for count in [1, 63, 64, 65] {
        let alone = query.closest_hits(&all[..count]).expect("hits");
        assert_eq!(alone, together[..count], "{count} rays");
    }
}

/// A dispatch takes 1,048,576 rays, whose hits are read back together with its counters and timestamps.
#[test]
fn a_query_fills_whole_dispatches() {
    const IN_DISPATCH: usize = 1 << 20;
    let mut scene = scenes::empty();
    scene.add_sphere(DVec3::ZERO, 1.0, 0);
    let (query, ..) = query(&scene, usize::MAX, Fetch::Auto);
    let rays: Vec<_> = (0..=IN_DISPATCH)
        .map(|index| {
            let y = 2.0 * index as f64 / IN_DISPATCH as f64;
            QueryRay::new(dvec3(0.0, y, 3.0), glam::Vec3::NEG_Z)
        })
        .collect();
    let hits = query.closest_hits(&rays).expect("hits");
    // Rays up to the height of the radius hit; that which touches may do either.
    let count = hits.iter().flatten().count();
    assert!((count as i64 - (1 << 19)).abs() <= 1, "{count} hits");
    for (ray, hit) in rays.iter().zip(&hits).step_by(4099) {
        let expected = (1.0 - ray.origin.y.powi(2)).max(0.0).sqrt();
        let z = hit.map_or(0.0, |hit| 3.0 - f64::from(hit.t));
        assert!((z - expected).abs() < 2e-3, "{ray:?}: {z}, not {expected}");
    }
}

#[test]
fn steps_are_exact_and_any_hit_takes_no_more_of_them() {
    let scene = mixed();
    let (query, ..) = query(&scene, usize::MAX, Fetch::Auto);
    let batch = query.batch(&rays(1000)).expect("a batch");
    let steps = |test| query.steps(&batch, test).expect("steps");
    let (closest, any) = (steps(RayTest::Closest), steps(RayTest::Any));
    assert_eq!(closest, steps(RayTest::Closest));
    for (closest, any) in closest.iter().zip(&any) {
        assert!(closest.nodes >= 1 && any.nodes >= 1, "the root is visited");
        assert!(any.nodes <= closest.nodes && any.primitives <= closest.primitives);
    }
    let seconds = query.seconds(&batch, RayTest::Closest, 3).expect("a time");
    assert!(seconds > 0.0 && seconds < 60.0, "{seconds}");
}

/// The lanes of a packet share a stack, which a deep tree can fill: the query is then repeated ray by ray.
#[test]
fn packets_and_single_rays_find_the_same_in_a_deep_tree() {
    let center = |i: i32| {
        let turn = f64::from(i);
        2f64.powi(i) * dvec3(0.3 * turn.cos(), 0.3 * turn.sin(), -1.0)
    };
    let mut scene = scenes::empty();
    for i in -40..46 {
        scene.add_sphere(center(i), 2f64.powi(i) / 20.0, 0);
    }
    let rays: Vec<_> = (0..512)
        .map(|index| toward(6.0 * DVec3::Z, center(index % 86 - 40)))
        .collect();
    let hits = |fetch| {
        let (query, ..) = query(&scene, pack::MAX_BAKED, fetch);
        query.closest_hits(&rays).expect("hits")
    };
    let expected = hits(Fetch::Image);
    assert!(
        expected.iter().flatten().count() > 50,
        "the rays hit spheres"
    );
    assert!(hits(Fetch::Packet) == expected);
}

#[test]
fn the_coherence_of_rays_does_not_affect_what_they_hit() {
    let scene = mixed();
    let rays = rays(5000);
    for (fetch, may_trace_packets) in [(Fetch::Auto, true), (Fetch::Image, false)] {
        let (query, ..) = query(&scene, usize::MAX, fetch);
        let packets = match open_gpu().traces_packets() && may_trace_packets {
            true => &[32, 64][..],
            false => &[],
        };
        let is_known = |rays| packets.contains(&rays);
        assert_eq!(query.packet_rays().is_some(), !packets.is_empty());
        assert!(query.packet_rays().is_none_or(is_known));
        let of = |coherence| {
            let batch = query.batch(&rays).expect("a batch");
            let batch = batch.with_coherence(coherence);
            let hits = query.closest_hits_of(&batch).expect("hits");
            let any = query.occluded_of(&batch).expect("hits");
            let steps = query.steps(&batch, RayTest::Closest).expect("steps");
            let packets = query.packet_steps(&batch, RayTest::Closest);
            (hits, any, steps, packets.expect("steps"))
        };
        let coherent = of(Coherence::Coherent);
        assert_eq!(coherent.3.is_some(), !packets.is_empty());
        assert!(coherent == of(Coherence::Incoherent), "{fetch:?}");
    }
}

/// Whichever thread polls a device reports finished work for all of them, and may be interrupted first. The others wait for
/// it: the device is not lost.
#[test]
fn threads_that_share_a_device_read_their_results() {
    let scene = mixed();
    let rays = rays(64);
    let (query, packed, view) = query(&scene, usize::MAX, Fetch::Auto);
    let expected = query.closest_hits(&rays).expect("hits");
    let gpu = open_gpu();
    std::thread::scope(|scope| {
        for _ in 0..8 {
            scope.spawn(|| {
                let policy = ExecutionPolicy::default();
                let query = RayQuery::new(gpu.clone(), packed.clone(), &view, policy);
                let query = query.expect("a query");
                for round in 0..500 {
                    let hits = query.closest_hits(&rays);
                    let hits = hits.unwrap_or_else(|error| panic!("round {round}: {error}"));
                    assert!(hits == expected);
                }
            });
        }
    });
}
