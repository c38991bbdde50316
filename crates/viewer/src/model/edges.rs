//! The edges of meshes and shapes in a picture, without those that are hidden.

mod mesh;
mod shape;

pub use mesh::MeshEdges;

use crate::model::camera::{distance_along, project_line};
use crate::model::sight::{Limits, Sight};
use glam::{DAffine3, DVec2, DVec3};
use glimray_scene::{Camera, Frame, Instance, Mesh, ObjectRef, Scene, threads};
use std::collections::{BTreeMap, HashMap};
use std::sync::{Arc, Mutex, PoisonError, Weak};

/// The most edges that are looked at in a picture.
pub const MOST_EDGES: usize = 400_000;
/// The most triangles of a mesh whose edges are looked for.
const MOST_TRIANGLES: usize = 1_000_000;
/// The most lines that are drawn: the longest.
pub const MOST_LINES: usize = 100_000;
/// The distance between two points of an edge that are tested, in pixels.
const STEP: f64 = 3.0;

/// The visible parts of edges.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct SeenEdges {
    /// The ends of each line, in pixels from the upper left corner of the picture.
    pub lines: Vec<[DVec2; 2]>,
    /// Whether there were more than are shown.
    pub is_cut: bool,
}

/// The edges of meshes that were looked at before, by the address of the mesh.
#[derive(Clone, Default)]
pub struct EdgeCache(Arc<Mutex<HashMap<usize, Known>>>);

type Known = (Weak<Mesh>, Arc<MeshEdges>);

impl EdgeCache {
    /// Drops the edges of meshes that are gone.
    fn tidy(&self) {
        let mut known = self.0.lock().unwrap_or_else(PoisonError::into_inner);
        known.retain(|_, (mesh, _)| mesh.strong_count() > 0);
    }

    fn of(&self, mesh: &Arc<Mesh>) -> Arc<MeshEdges> {
        let mut known = self.0.lock().unwrap_or_else(PoisonError::into_inner);
        // A weak reference keeps the address, so that no other mesh gets it.
        let (_, edges) = (known.entry(Arc::as_ptr(mesh) as usize))
            .or_insert_with(|| (Arc::downgrade(mesh), Arc::new(MeshEdges::of(mesh))));
        edges.clone()
    }
}

/// A view of what a shape shows: where its points are and which of them are joined.
struct Part {
    points: Vec<DVec3>,
    edges: Vec<[u32; 2]>,
}

/// The picture in which edges are looked for.
struct Picture<'a> {
    camera: &'a Camera,
    limits: Limits,
    sight: &'a Sight,
    /// In pixels.
    size: DVec2,
}

/// The edges that a picture of `size` pixels shows: all of them, or with the second of `wanted` the features only.
pub fn seen(
    scene: &Scene,
    camera: &Camera,
    time: f64,
    (sight, size): (&Sight, (u32, u32)),
    wanted: (bool, bool),
    cache: &EdgeCache,
) -> SeenEdges {
    let mut seen = SeenEdges::default();
    if wanted == (false, false) {
        return seen;
    }
    let picture = Picture {
        camera,
        limits: Limits::of(scene, camera),
        sight,
        size: DVec2::new(size.0.into(), size.1.into()),
    };
    let frame = scene.frame(time);
    let mut room = MOST_EDGES;
    let mut known = BTreeMap::new();
    cache.tidy();
    for object in sight.objects() {
        match object {
            ObjectRef::Instance(index) => {
                let instance = &scene.instances[index];
                let mesh = &scene.meshes[instance.mesh];
                if mesh.triangles.len() > MOST_TRIANGLES {
                    seen.is_cut = true;
                    continue;
                }
                let edges = cache.of(mesh);
                let edges = edges.chosen(wanted.0);
                if edges.len() > room {
                    seen.is_cut = true;
                    continue;
                }
                if edges.is_empty() {
                    continue;
                }
                room -= edges.len();
                let moved: &Option<_> = (known.entry(instance.mesh))
                    .or_insert_with(|| moved(scene, &frame, instance.mesh));
                let place = world_from_mesh(scene, &frame, instance);
                let lines = visible(edges, &picture, |index| {
                    let still = || mesh.positions[index].as_dvec3();
                    let own = moved.as_ref().map_or_else(still, |moved| moved[index]);
                    place.transform_point3(own)
                });
                seen.lines.extend(lines);
            }
            ObjectRef::Shape(index) => {
                let shape = &scene.shapes[index];
                let part = shape::part(&shape.geometry, world_from(&frame, shape.node), wanted.0);
                room -= part.edges.len().min(room);
                let lines = visible(&part.edges, &picture, |index| part.points[index]);
                seen.lines.extend(lines);
            }
            ObjectRef::Light(_) => {}
        }
    }
    if seen.lines.len() > MOST_LINES {
        seen.is_cut = true;
        let length = |[a, b]: &[DVec2; 2]| a.distance_squared(*b);
        let longest = |a: &[DVec2; 2], b: &[DVec2; 2]| length(b).total_cmp(&length(a));
        seen.lines.select_nth_unstable_by(MOST_LINES, longest);
        seen.lines.truncate(MOST_LINES);
    }
    seen
}

/// The vertices of a mesh in its own space, deformed as the frame asks; `None` where nothing deforms it.
pub fn moved(scene: &Scene, frame: &Frame, mesh: usize) -> Option<Vec<DVec3>> {
    let known = (scene.deformations).binary_search_by_key(&mesh, |it| it.mesh);
    let index = known.ok()?;
    let deformation = &scene.deformations[index];
    let pose = deformation.pose(&frame.nodes, &frame.weights[index]);
    let posed = deformation.posed(&scene.meshes[mesh], &pose);
    Some((0..posed.len()).map(|it| posed.position(it)).collect())
}

/// Where the frame places a mesh. Its vertices are those of [`moved`], if there are any.
pub fn world_from_mesh(scene: &Scene, frame: &Frame, instance: &Instance) -> DAffine3 {
    world_from(frame, scene.node_of(instance)) * instance.placement
}

fn world_from(frame: &Frame, node: Option<usize>) -> DAffine3 {
    node.map_or(DAffine3::IDENTITY, |node| frame.nodes[node].world_from_node)
}

fn visible(
    edges: &[[u32; 2]],
    picture: &Picture,
    point: impl Fn(usize) -> DVec3 + Sync,
) -> Vec<[DVec2; 2]> {
    let chunks: Vec<_> = edges.chunks(threads::chunk_len(edges.len())).collect();
    let found = threads::map(chunks, |edges: &[[u32; 2]]| {
        let mut lines = Vec::new();
        for ends in edges {
            let [a, b] = ends.map(|end| point(end as usize));
            visible_runs(picture, (a, b), &mut lines);
        }
        lines
    });
    found.into_iter().flatten().collect()
}

/// The parts of a line in the world that are not hidden.
fn visible_runs(picture: &Picture, ends: (DVec3, DVec3), lines: &mut Vec<[DVec2; 2]>) {
    let Picture {
        camera,
        sight,
        size,
        ..
    } = *picture;
    let Some((from, to)) = picture.limits.clip(ends) else {
        return;
    };
    let near = 1e-4 * camera.look_from.distance(camera.look_at);
    let Some((a, b)) = project_line(camera, (from, to), near, (size, 0.0)) else {
        return;
    };
    let count = (a.distance(b) / STEP).ceil().max(1.0);
    let mut run: Option<(f64, f64)> = None;
    let mut end = |run: &mut Option<(f64, f64)>| {
        if let Some((first, last)) = run.take() {
            lines.push([a.lerp(b, first), a.lerp(b, last)]);
        }
    };
    for piece in 0..count as usize {
        let [start, stop] = [piece, piece + 1].map(|index| index as f64 / count);
        let middle = a.lerp(b, (start + stop) / 2.0);
        let distance = distance_along(camera, (from, to), middle, size);
        match distance.is_some_and(|distance| sight.shows(middle, distance)) {
            true => run = Some((run.map_or(start, |run| run.0), stop)),
            false => end(&mut run),
        }
    }
    end(&mut run);
}
