//! The stack of the portable walk: registers of software adapters hold as many entries as the deepest way through a tree
//! needs, and walks that need all of them do the same steps as with an array. So do walks that need more than the usual
//! number, in registers or, where scenes are in buffers, in workgroup memory.

use crate::instances::packed;
use crate::pack_view::children;
use crate::reference::compare::{assert_none, check_same_bits, open_gpu, sized, start_packed};
use crate::reference::scenes;

use glam::{DAffine3, DQuat, DVec3, Vec3, vec3};
use glimray::bvh::StackNeed;
use glimray::image::Image;
use glimray::layout::{INSTANCE, LEAF, LEAF_FIRST_MASK, PackedInstance, PackedNode};
use glimray::pack::{PackedScene, PackedView};
use glimray::render::{
    ExecutionPolicy, Fetch, Integrator, QueryRay, RayQuery, RenderSettings, Stack, Tone,
};
use glimray::scene::{Instance, Mesh, Scene};
use std::sync::Arc;

/// The camera looks along the x axis, on which triangles lie: each is twice as far away and twice as large as the one
/// before, so that joining nearest neighbours gives a chain. `copies` of all of them follow each other likewise.
fn chain(count: i32, copies: i32) -> Scene {
    let place = |i: i32| 2f64.powi(i);
    let mut mesh = Mesh::default();
    for i in 0..count {
        let (at, half) = (place(i - count) as f32, place(i - count - 2) as f32);
        let first = mesh.positions.len() as u32;
        let corners = [(-1.0, -1.0), (3.0, -1.0), (-1.0, 3.0)];
        let corners = corners.map(|(y, z)| vec3(at, half * y, half * z));
        mesh.positions.extend(corners);
        mesh.normals.extend([Vec3::NEG_X; 3]);
        mesh.materials.extend([0; 3]);
        mesh.triangles.push([first, first + 1, first + 2]);
    }
    let mut scene = scenes::empty();
    scene.cameras[0].look_from = DVec3::ZERO;
    scene.cameras[0].look_at = DVec3::X;
    scene.cameras[0].fov_y = 1e-30;
    scene.meshes.push(mesh.into());
    scene.instances.extend((0..copies).map(|i| Instance {
        mesh: 0,
        placement: DAffine3::from_scale_rotation_translation(
            DVec3::splat(place(i - copies - 3)),
            DQuat::IDENTITY,
            DVec3::X * place(i - copies),
        ),
        node: None,
        name: String::new(),
    }));
    scene
}

/// The entries that a ray along x has on its stack when it reaches its first triangle: at each node those of all children
/// but the nearest, or the node, and one that returns from an instance.
fn entries_on_the_way(packed: &PackedScene, view: &PackedView) -> StackNeed {
    let [nodes, instances, ..] = view.node_parts();
    let nodes: Vec<PackedNode> = bytemuck::pod_collect_to_vec(nodes);
    let instances: Vec<PackedInstance> = bytemuck::pod_collect_to_vec(instances);
    let mut entries = StackNeed::default();
    let mut reference = match packed.instance_count() {
        0 => 0,
        _ => view.frame.root,
    };
    loop {
        let node = match reference.checked_sub(packed.first_view_node()) {
            Some(index) => &nodes[index as usize],
            None => &packed.nodes[reference as usize],
        };
        let all = children(node);
        entries.references += all.len() - 1;
        entries.nodes += usize::from(all.len() > 1);
        let nearest = all.iter().min_by(|a, b| a.0[0].x.total_cmp(&b.0[0].x));
        reference = nearest.expect("a child").1;
        if reference >= INSTANCE {
            entries.references += 1;
            entries.nodes += 1;
            reference = instances[(reference & LEAF_FIRST_MASK) as usize].root;
        }
        if reference & LEAF != 0 {
            return entries;
        }
    }
}

fn policy(fetch: Fetch, stack: Stack) -> ExecutionPolicy {
    ExecutionPolicy {
        fetch,
        stack,
        ..ExecutionPolicy::default()
    }
}

/// The steps of all rays as a picture, and the submissions that it took.
fn steps(packed: &Arc<PackedScene>, view: &PackedView, policy: ExecutionPolicy) -> (Image, u64) {
    let settings = RenderSettings {
        integrator: Integrator::Heat,
        ..sized(8, 8)
    };
    let mut renderer = start_packed(packed.clone(), view, &(settings, policy));
    while !renderer.is_done() {
        renderer.step().expect("a step that loses no entry");
    }
    let picture = renderer.develop(&Tone::LINEAR).expect("a picture");
    (picture, renderer.stats().submissions)
}

/// Chains of 1 to 89 triangles as they are packed.
fn chains(copies: i32, most_baked: usize) -> impl Iterator<Item = (Arc<PackedScene>, PackedView)> {
    (1..90).map(move |count| {
        let scene = chain(count, copies);
        let packed = packed(&scene, most_baked);
        let view = packed.frame(&scene.frame(0.0)).expect("a view");
        (packed, view)
    })
}

#[test]
fn registers_hold_the_deepest_way_through_a_tree() {
    let mut results = Vec::new();
    for (copies, most_baked, registers) in [
        (1, usize::MAX, 1..=4),
        // Trees over instances have all registers.
        (40, 0, 6..=6),
    ] {
        for registers in registers {
            // The chain that fills most of the registers, of those for which they are just enough.
            let fits = |(packed, view): &(Arc<PackedScene>, PackedView)| {
                packed.stack_need(view).nodes.div_ceil(4) == registers
            };
            let entries = |(packed, view): &(Arc<PackedScene>, PackedView)| {
                entries_on_the_way(packed, view).nodes
            };
            let deepest = chains(copies, most_baked).filter(fits).max_by_key(entries);
            let (packed, view) = deepest.expect("a chain");
            let entries = entries_on_the_way(&packed, &view);
            let name = format!("{registers} registers, {copies} copies, {entries:?}");
            assert!(entries.nodes > 4 * (registers - 1), "{name}");
            let [expected, found] = [Fetch::Buffer, Fetch::Image]
                .map(|fetch| steps(&packed, &view, policy(fetch, Stack::Deepest)).0);
            // Every reference is visited in the end.
            assert!(expected.pixels[0][0] > entries.references as f32, "{name}");
            results.push(check_same_bits(&name, &expected, &found));
        }
    }
    assert_none(results);
}

/// Rays through instances usually need at most 24 references, or 20 nodes.
#[test]
fn rays_that_need_more_entries_than_usual_are_traced_again() {
    let mut results = Vec::new();
    // With an array in the end, or with all registers.
    for bound in [25..=96, 21..=24] {
        let is_deep = |(packed, view): &(Arc<PackedScene>, PackedView)| {
            let entries = entries_on_the_way(packed, view);
            bound.contains(&packed.stack_need(view).nodes)
                && entries.nodes > 20
                && entries.references > 24
        };
        let (packed, view) = chains(40, 0).find(is_deep).expect("a chain");
        let name = format!("{:?}", entries_on_the_way(&packed, &view));
        let of = |policy| steps(&packed, &view, policy);
        let (expected, once) = of(policy(Fetch::Buffer, Stack::Deepest));
        for (fetch, host_copy) in [
            (Fetch::Image, true),
            (Fetch::Image, false),
            (Fetch::Buffer, true),
            (Fetch::Buffer, false),
        ] {
            let name = format!("{name}, {fetch:?}");
            let (found, again) = of(ExecutionPolicy {
                host_copy,
                ..policy(fetch, Stack::Usual)
            });
            assert!(again > once, "{name}: {again} and {once} submissions");
            results.push(check_same_bits(&name, &expected, &found));
        }

        let hits = |fetch| {
            let policy = policy(fetch, Stack::Usual);
            let query = RayQuery::new(open_gpu(), packed.clone(), &view, policy);
            let along_x = QueryRay::new(DVec3::ZERO, Vec3::X);
            let hits = query.expect("a query").closest_hits(&[along_x; 64]);
            hits.expect("hits")
        };
        let expected = hits(Fetch::Buffer);
        assert!(expected[0].is_some(), "{name}");
        assert_eq!(hits(Fetch::Image), expected, "{name}");
    }
    assert_none(results);
}
