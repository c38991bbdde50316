//! The edges of meshes and shapes in a picture, without those that are hidden.

mod mesh;
mod shape;

pub use mesh::MeshEdges;

use crate::model::camera::{distance_along, project_line};
use crate::model::sight::Sight;
use glam::{DAffine3, DVec2, DVec3};
use glimray_scene::{Camera, Frame, Mesh, ObjectRef, Scene, threads};
use std::collections::BTreeMap;
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

/// The edges of meshes that were looked at before.
#[derive(Clone, Default)]
pub struct EdgeCache(Arc<Mutex<Vec<Known>>>);

type Known = (Weak<Mesh>, Arc<MeshEdges>);

impl EdgeCache {
    fn of(&self, mesh: &Arc<Mesh>) -> Arc<MeshEdges> {
        let mut known = self.0.lock().unwrap_or_else(PoisonError::into_inner);
        known.retain(|(mesh, _)| mesh.strong_count() > 0);
        if let Some((_, edges)) = known.iter().find(|it| it.0.as_ptr() == Arc::as_ptr(mesh)) {
            return edges.clone();
        }
        let edges = Arc::new(MeshEdges::of(mesh));
        known.push((Arc::downgrade(mesh), edges.clone()));
        edges
    }
}

/// A view of what an object shows: where its points are and which of them are joined.
struct Part {
    points: Vec<DVec3>,
    edges: Vec<[u32; 2]>,
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
    let frame = scene.frame(time);
    let mut parts = Vec::new();
    let mut room = MOST_EDGES;
    let mut posed = BTreeMap::new();
    for object in sight.objects() {
        let part = match object {
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
                let own = (posed.entry(instance.mesh))
                    .or_insert_with(|| Arc::new(positions(scene, &frame, instance.mesh)));
                let world_from_node = (scene.node_of(instance))
                    .map_or(DAffine3::IDENTITY, |node| frame.nodes[node].world_from_node);
                let place = world_from_node * instance.placement;
                Part {
                    points: own.iter().map(|p| place.transform_point3(*p)).collect(),
                    edges: edges.to_vec(),
                }
            }
            ObjectRef::Shape(index) => {
                let place = (scene.shapes[index].node)
                    .map_or(DAffine3::IDENTITY, |node| frame.nodes[node].world_from_node);
                shape::part(&scene.shapes[index].geometry, place, wanted.0)
            }
            ObjectRef::Light(_) => continue,
        };
        room -= part.edges.len().min(room);
        parts.push(part);
    }
    let size = DVec2::new(size.0.into(), size.1.into());
    for part in &parts {
        seen.lines.extend(visible(part, camera, sight, size));
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

/// The vertices of a mesh in its own space, deformed as the frame asks.
fn positions(scene: &Scene, frame: &Frame, mesh: usize) -> Vec<DVec3> {
    let still = &scene.meshes[mesh];
    let moved = scene.deformations.iter().zip(&frame.weights);
    let moved = moved.into_iter().find(|(it, _)| it.mesh == mesh);
    match moved {
        Some((deformation, weights)) => {
            let pose = deformation.pose(&frame.nodes, weights);
            let posed = deformation.posed(still, &pose);
            (0..posed.len())
                .map(|vertex| posed.position(vertex))
                .collect()
        }
        None => still.positions.iter().map(|p| p.as_dvec3()).collect(),
    }
}

fn visible(part: &Part, camera: &Camera, sight: &Sight, size: DVec2) -> Vec<[DVec2; 2]> {
    let chunk = threads::chunk_len(part.edges.len());
    let chunks: Vec<_> = part.edges.chunks(chunk.max(1)).collect();
    let found = threads::map(chunks, |edges: &[[u32; 2]]| {
        let mut lines = Vec::new();
        for ends in edges {
            let [a, b] = ends.map(|end| part.points[end as usize]);
            visible_runs(camera, (a, b), sight, size, &mut lines);
        }
        lines
    });
    found.into_iter().flatten().collect()
}

/// The parts of a line in the world that are not hidden.
fn visible_runs(
    camera: &Camera,
    (from, to): (DVec3, DVec3),
    sight: &Sight,
    size: DVec2,
    lines: &mut Vec<[DVec2; 2]>,
) {
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
