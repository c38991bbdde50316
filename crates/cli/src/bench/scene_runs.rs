//! The ray sets of a scene, with the rates and sizes of its trees.

use super::figure::Figure;
use super::ray_sets::{self, RaySet, fnv};
use super::renders::{self, Purpose, Times};
use super::scenes::{Detail, Procedural};
use super::workloads::Workload;
use crate::args::BenchArgs;
use crate::job;
use glimray_app::error::AppError;
use glimray_app::storage;
use glimray_io::import::{self, Memory};
use glimray_render::gpu::Gpu;
use glimray_render::layout::PackedNode;
use glimray_render::pack::{self, PackedScene, PackedView};
use glimray_render::{Coherence, RayBatch, RayQuery, RaySteps, RayTest};
use glimray_scene::Scene;
use serde::Serialize;
use std::fmt::Write;
use std::time::Instant;

/// Side of the picture whose pixels the rays belong to, and with `--quick`.
const SIDE: u32 = 1024;
const QUICK_SIDE: u32 = 512;
/// Minimum time of a measurement in seconds: a set is traced repeatedly until it is reached, up to a maximum
/// number of passes.
const LEAST_SECONDS: f64 = 0.05;
const MOST_PASSES: f64 = 256.0;
/// Larger meshes are not loaded: their text would take gigabytes.
const MOST_LOADED: usize = 1_000_000;
/// The name of the file that is loaded.
const FILE: &str = "mesh.obj";

/// A scene, its ray sets and their measurements.
pub struct SceneRuns {
    workload: Workload,
    sets: Vec<Set>,
    /// Triangles and spheres in its trees; each mesh counts once.
    primitive_count: usize,
    /// The scene as a file, if it is a single mesh that is not too large.
    file: Option<Memory>,
    loads: Vec<f64>,
    /// Seconds of building the trees for the first picture in the window.
    drafts: Vec<f64>,
    times: Vec<Times>,
    tree_bytes: u64,
    all_bytes: u64,
}

struct Set {
    set: RaySet,
    counts: Option<Counts>,
    mrays: Vec<f64>,
}

/// Figures that are the same in every repeat.
#[derive(Clone, Copy)]
struct Counts {
    hits: usize,
    hit_checksum: u64,
    per_ray: Steps,
    /// `None` where rays are not traced in packets.
    per_packet: Option<Steps>,
    packet_rays: Option<u32>,
    passes: u32,
}

/// Means over the rays.
#[derive(Clone, Copy)]
struct Steps {
    nodes: f64,
    primitives: f64,
}

/// The figures of a scene.
#[derive(Debug, Serialize)]
pub struct Row {
    name: &'static str,
    /// In the world; each instance counts.
    triangles: usize,
    spheres: usize,
    instances: usize,
    /// Millions of triangles per second of reading an OBJ file; null for several meshes, spheres, and very large
    /// meshes.
    load_mtriangles_per_second: Option<Figure>,
    /// Millions of triangles and spheres per second of building the trees; each mesh counts once.
    build_mprimitives_per_second: Figure,
    /// Primitives for the first picture in the window; null without a mesh that is large enough.
    draft_mprimitives_per_second: Option<Figure>,
    /// GPU memory of nodes, instances, triangles and spheres.
    bytes_per_primitive: f64,
    /// GPU memory, with vertices, materials and lights.
    all_bytes_per_primitive: f64,
    width: u32,
    height: u32,
    /// The whole render, from opening the adapter to the developed picture.
    render_seconds: Figure,
    /// Seconds of tracing.
    trace_seconds: Figure,
    rays: Vec<SetRow>,
}

/// The figures of a ray set.
#[derive(Debug, Serialize)]
struct SetRow {
    set: &'static str,
    rays: usize,
    /// Checksum of the rays, equal on every machine.
    checksum: String,
    hits: usize,
    /// Checksum of the hits, which may differ in rounding between adapters.
    hit_checksum: String,
    /// Millions of rays per second.
    mrays_per_second: Figure,
    /// How those were traced: "packet", or "single" for rays one by one.
    walk: &'static str,
    /// Visits of rays one by one. Exact, like the following.
    nodes_per_ray: f64,
    primitives_per_ray: f64,
    /// Rays of a packet; null where none are traced, as the next.
    packet_rays: Option<u32>,
    /// Visits of a packet: the mean over the rays of what their packets visited and tested.
    nodes_per_packet: Option<f64>,
    primitives_per_packet: Option<f64>,
}

/// Pixels along a side of the picture of the ray sets.
pub fn side(is_quick: bool) -> u32 {
    if is_quick { QUICK_SIDE } else { SIDE }
}

impl SceneRuns {
    /// Generates the scene and its rays.
    pub fn new(procedural: &Procedural, is_quick: bool) -> Self {
        let scene = (procedural.scene)(Detail::Full);
        let side = side(is_quick);
        let sets = ray_sets::of(&scene, side).into_iter().map(|set| Set {
            set,
            counts: None,
            mrays: Vec::new(),
        });
        let in_meshes: usize = scene.meshes.iter().map(|mesh| mesh.triangles.len()).sum();
        Self {
            sets: sets.collect(),
            primitive_count: in_meshes + scene.shapes.len(),
            file: file_of(&scene),
            loads: Vec::new(),
            drafts: Vec::new(),
            times: Vec::new(),
            tree_bytes: 0,
            all_bytes: 0,
            workload: Workload::new(procedural.name, scene, (side, side)),
        }
    }

    /// Measures everything once more.
    ///
    /// # Errors
    /// The device failed.
    pub fn run(&mut self, gpu: &Gpu, arguments: &BenchArgs) -> Result<(), AppError> {
        if let Some(file) = &self.file {
            let started = Instant::now();
            import::load_from(file, FILE, &import::Options::default())?;
            self.loads.push(started.elapsed().as_secs_f64());
        }
        let scene = &self.workload.scene;
        if (scene.meshes.iter()).any(|mesh| mesh.triangles.len() >= pack::DRAFT_FROM) {
            self.drafts.push(pack::draft(scene)?.build_seconds);
        }
        if self.times.is_empty() {
            renders::render(&self.workload, arguments, Purpose::Warm)?;
        }
        let rendered = renders::render(&self.workload, arguments, Purpose::Time)?;
        self.times.push(rendered.times);
        let (packed, view) = (rendered.packed, rendered.view);
        let policy = storage::with_requested(job::policy(&arguments.device, false))?;
        let query = RayQuery::new(gpu.clone(), packed.clone(), &view, policy)?;
        (self.tree_bytes, self.all_bytes) = bytes(&packed, &view, query.node_bytes());
        self.sets.iter_mut().try_for_each(|set| set.run(&query))
    }

    /// The figures of all repeats.
    pub fn row(&self) -> Row {
        let Workload {
            name, scene, size, ..
        } = &self.workload;
        let count = self.primitive_count as f64;
        let millions = count / 1e6;
        let rates = |seconds: &[f64]| Figure::of(seconds.iter().map(|seconds| millions / seconds));
        let builds: Vec<_> = self.times.iter().map(|times| times.bvh).collect();
        Row {
            name,
            triangles: scene.triangle_count(),
            spheres: scene.shapes.len(),
            instances: scene.instances.len(),
            load_mtriangles_per_second: (!self.loads.is_empty()).then(|| rates(&self.loads)),
            build_mprimitives_per_second: rates(&builds),
            draft_mprimitives_per_second: (!self.drafts.is_empty()).then(|| rates(&self.drafts)),
            bytes_per_primitive: self.tree_bytes as f64 / count,
            all_bytes_per_primitive: self.all_bytes as f64 / count,
            width: size.0,
            height: size.1,
            render_seconds: Figure::of(self.times.iter().map(|times| times.total)),
            trace_seconds: Figure::of(self.times.iter().map(|times| times.trace)),
            rays: self.sets.iter().filter_map(Set::row).collect(),
        }
    }
}

impl Set {
    fn run(&mut self, query: &RayQuery) -> Result<(), AppError> {
        let batch = query.batch(&self.set.rays)?;
        let batch = batch.with_coherence(self.set.coherence);
        let counts = match self.counts {
            Some(counts) => counts,
            None => *self.counts.insert(counts(query, &batch, self.set.test)?),
        };
        let seconds = query.seconds(&batch, self.set.test, counts.passes)?;
        (self.mrays).push(self.set.rays.len() as f64 / seconds / 1e6);
        Ok(())
    }

    /// `None` before the first run.
    fn row(&self) -> Option<SetRow> {
        let counts = self.counts?;
        Some(SetRow {
            set: self.set.name,
            rays: self.set.rays.len(),
            checksum: format!("{:016x}", self.set.checksum()),
            hits: counts.hits,
            hit_checksum: format!("{:016x}", counts.hit_checksum),
            mrays_per_second: Figure::of(self.mrays.iter().copied()),
            walk: match (self.set.coherence, counts.per_packet) {
                (Coherence::Coherent, Some(_)) => "packet",
                _ => "single",
            },
            nodes_per_ray: counts.per_ray.nodes,
            primitives_per_ray: counts.per_ray.primitives,
            packet_rays: counts.packet_rays,
            nodes_per_packet: counts.per_packet.map(|steps| steps.nodes),
            primitives_per_packet: counts.per_packet.map(|steps| steps.primitives),
        })
    }
}

impl Steps {
    fn mean(all: &[RaySteps]) -> Self {
        let mean = |part: fn(&RaySteps) -> u32| {
            let sum: u64 = all.iter().map(|steps| u64::from(part(steps))).sum();
            sum as f64 / all.len().max(1) as f64
        };
        Self {
            nodes: mean(|steps| steps.nodes),
            primitives: mean(|steps| steps.primitives),
        }
    }
}

fn counts(query: &RayQuery, batch: &RayBatch, test: RayTest) -> Result<Counts, AppError> {
    let hits: Vec<Option<u32>> = match test {
        RayTest::Closest => {
            let hits = query.closest_hits_of(batch)?.into_iter();
            hits.map(|hit| hit.map(|hit| hit.t.to_bits())).collect()
        }
        RayTest::Any => {
            let hits = query.occluded_of(batch)?.into_iter();
            hits.map(|is_hit| is_hit.then_some(0)).collect()
        }
    };
    let per_ray = Steps::mean(&query.steps(batch, test)?);
    let per_packet = query.packet_steps(batch, test)?;
    let per_packet = per_packet.map(|steps| Steps::mean(&steps));
    let seconds = query.seconds(batch, test, 1)?;
    let words = hits.iter().map(|hit| hit.unwrap_or(u32::MAX));
    Ok(Counts {
        hits: hits.iter().flatten().count(),
        hit_checksum: fnv(words.flat_map(u32::to_le_bytes)),
        per_ray,
        per_packet,
        packet_rays: query.packet_rays(),
        passes: (LEAST_SECONDS / seconds).clamp(1.0, MOST_PASSES).ceil() as u32,
    })
}

/// Bytes on the GPU, where a node takes `node_bytes`: of trees and primitives, and of everything.
fn bytes(packed: &PackedScene, view: &PackedView, node_bytes: u64) -> (u64, u64) {
    let length = |parts: &[&[u8]]| parts.iter().map(|part| part.len() as u64).sum::<u64>();
    let trees = packed.nodes.byte_len() + packed.triangles.byte_len() + packed.shapes.byte_len();
    let trees = trees + length(&view.node_parts());
    let nodes = packed.nodes.byte_len() + view.node_parts()[0].len() as u64;
    let more =
        nodes / size_of::<PackedNode>() as u64 * (node_bytes - size_of::<PackedNode>() as u64);
    (
        trees + more,
        length(&packed.parts()) + length(&view.parts()) + more,
    )
}

/// An OBJ file of a scene that consists of one small enough mesh.
fn file_of(scene: &Scene) -> Option<Memory> {
    let [mesh] = &scene.meshes[..] else {
        return None;
    };
    if mesh.triangles.len() > MOST_LOADED {
        return None;
    }
    let mut text = String::new();
    // Writing to a string cannot fail.
    for position in &mesh.positions {
        let _ = writeln!(text, "v {} {} {}", position.x, position.y, position.z);
    }
    for triangle in &mesh.triangles {
        let [a, b, c] = triangle.map(|index| index + 1);
        let _ = writeln!(text, "f {a} {b} {c}");
    }
    Some(Memory::from_iter([(FILE, text.into_bytes())]))
}

impl Row {
    /// A table for people.
    pub fn text(&self) -> String {
        let objects = match (self.spheres, self.instances) {
            (0, 1) => format!("{} triangles", self.triangles),
            (0, instances) => format!("{instances} instances, {} triangles", self.triangles),
            (spheres, _) => format!("{spheres} spheres"),
        };
        let load = match self.load_mtriangles_per_second {
            Some(rate) => format!("load {rate:.2}, "),
            None => String::new(),
        };
        let draft = match self.draft_mprimitives_per_second {
            Some(rate) => format!(", draft {rate:.2}"),
            None => String::new(),
        };
        let mut text = format!(
            "\n{}: {objects}; {load}build {:.2}{draft} million primitives/s; {:.0} bytes per primitive, {:.0} with vertices and materials; \
             render {}×{} {:.3} s, of which tracing {:.3} s\n{:<17} {:>9} {:>9} {:>9}  {:<15} {:<6} {:>9} {:>10} {:>12} {:>10}\n",
            self.name,
            self.build_mprimitives_per_second,
            self.bytes_per_primitive,
            self.all_bytes_per_primitive,
            self.width,
            self.height,
            self.render_seconds,
            self.trace_seconds,
            "rays",
            "count",
            "hits",
            "Mrays/s",
            "min–max",
            "walk",
            "nodes/ray",
            "primitives",
            "nodes/packet",
            "primitives"
        );
        let per_packet = |steps: Option<f64>| match steps {
            Some(steps) => format!("{steps:.3}"),
            None => "-".into(),
        };
        for row in &self.rays {
            let Figure { median, min, max } = row.mrays_per_second;
            let _ = writeln!(
                text,
                "{:<17} {:>9} {:>9} {:>9.2}  {:<15} {:<6} {:>9.3} {:>10.3} {:>12} {:>10}",
                row.set,
                row.rays,
                row.hits,
                median,
                format!("{min:.2}–{max:.2}"),
                row.walk,
                row.nodes_per_ray,
                row.primitives_per_ray,
                per_packet(row.nodes_per_packet),
                per_packet(row.primitives_per_packet),
            );
        }
        text
    }
}
