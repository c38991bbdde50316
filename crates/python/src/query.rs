//! Rays that Python asks about.

use crate::errors::Failure;
use crate::host::Session;
use crate::{Files, devices, words};
use glam::{DAffine3, DVec3, Vec3};
use glimray_cli::embedded;
use glimray_render::gpu::AdapterChoice;
use glimray_render::layout::NO_INSTANCE;
use glimray_render::pack::{self, PackedScene};
use glimray_render::{Coherence, ExecutionPolicy, QueryHit, QueryRay, RayBatch, RenderError};
use glimray_scene::{Frame, ObjectRef, Scene, threads};
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;
use pyo3::types::PyBytes;
use std::collections::HashMap;
use std::path::PathBuf;
use std::sync::atomic::{AtomicU32, Ordering};
use std::sync::{Arc, OnceLock};

/// Rays that are traced at once: few enough for the caches of a processor, many enough for a GPU.
const CHUNK: usize = 1 << 18;

/// A number that has not been looked up.
const UNKNOWN: u32 = u32::MAX;

/// Rays through a scene.
#[pyclass(frozen)]
pub struct RayQuery {
    query: glimray_render::RayQuery,
    /// The process that has the device.
    process: u32,
    packed: Arc<PackedScene>,
    scene: Scene,
    frame: Frame,
    /// For each mesh its triangles by their corners, from the least one on.
    triangles: OnceLock<Vec<HashMap<[u32; 3], u32>>>,
    /// The number of each packed triangle in its mesh; [`UNKNOWN`] until it is first hit.
    numbers: Vec<AtomicU32>,
}

#[pymethods]
impl RayQuery {
    /// Reads a scene as `inspect` does, and uploads it as it is at `time`.
    #[new]
    fn new(
        py: Python,
        arguments: Vec<PathBuf>,
        files: Files,
        time: f64,
        adapter: Option<String>,
    ) -> PyResult<Self> {
        let session = Session::new(files, None);
        let (scene, _) = session.run(py, move |host| embedded::scene(host, &words(arguments)))?;
        let made = py.detach(move || Self::of(scene, time, adapter));
        made.map_err(|failure| failure.raised(py))
    }

    /// The parts of the file that were left out, as sentences.
    fn skipped(&self) -> Vec<String> {
        self.scene.skipped.clone()
    }

    /// The corners of the triangles of the first mesh in its own space, nine floats each; nothing without a mesh.
    fn corners<'py>(&self, py: Python<'py>) -> Bound<'py, PyBytes> {
        let mesh = self.scene.meshes.first();
        let corners = mesh.into_iter().flat_map(|mesh| {
            let triangles = mesh.triangles.iter().flatten();
            triangles.map(|corner| mesh.positions[*corner as usize].to_array())
        });
        PyBytes::new(py, bytemuck::cast_slice(&corners.collect::<Vec<_>>()))
    }

    /// Closest hits: a [`Row`] for each ray.
    fn closest<'py>(
        &self,
        py: Python<'py>,
        origins: &[u8],
        directions: &[u8],
        t_max: Option<&[u8]>,
        is_coherent: bool,
    ) -> PyResult<Bound<'py, PyBytes>> {
        let given = Given::new(origins, directions, t_max)?;
        let mut rows = vec![Row::MISS; given.count()];
        let places = self.places();
        let mut chunks = rows.chunks_mut(CHUNK);
        self.trace(py, &given, is_coherent, |rays, batch| {
            let hits = self.query.closest_hits_of(batch)?;
            threads::fill(chunks.next().unwrap_or_default(), |index| {
                let hit = hits[index];
                hit.map_or(Row::MISS, |hit| self.row(&places, &rays[index], &hit))
            });
            Ok(())
        })?;
        Ok(PyBytes::new(py, bytemuck::cast_slice(&rows)))
    }

    /// Whether something is in the way of each ray: a byte each.
    fn occluded<'py>(
        &self,
        py: Python<'py>,
        origins: &[u8],
        directions: &[u8],
        t_max: Option<&[u8]>,
        is_coherent: bool,
    ) -> PyResult<Bound<'py, PyBytes>> {
        let given = Given::new(origins, directions, t_max)?;
        let mut found = Vec::with_capacity(given.count());
        self.trace(py, &given, is_coherent, |_, batch| {
            let occluded = self.query.occluded_of(batch)?;
            found.extend(occluded.into_iter().map(u8::from));
            Ok(())
        })?;
        Ok(PyBytes::new(py, &found))
    }

    /// The names of the objects, by their numbers.
    fn names(&self) -> Vec<String> {
        let (instances, shapes) = (self.scene.instances.len(), self.scene.shapes.len());
        let objects = (0..instances)
            .map(ObjectRef::Instance)
            .chain((0..shapes).map(ObjectRef::Shape));
        objects
            .map(|object| self.scene.object_name(object).to_owned())
            .collect()
    }
}

/// The hit of a ray.
#[repr(C)]
#[derive(Clone, Copy, bytemuck::Pod, bytemuck::Zeroable)]
struct Row {
    /// Infinite if it hits nothing.
    distance: f32,
    /// −1 if it hits nothing.
    object: i32,
    /// −1 if it hits no triangle.
    triangle: i32,
    /// Unit vector, or zero.
    normal: [f32; 3],
}

impl Row {
    const MISS: Self = Self {
        distance: f32::INFINITY,
        object: -1,
        triangle: -1,
        normal: [0.0; 3],
    };
}

impl RayQuery {
    fn of(scene: Scene, time: f64, adapter: Option<String>) -> Result<Self, Failure> {
        let mut scene = match scene.deformations.is_empty() {
            true => scene,
            false => scene.at_rest(time),
        };
        // Rays ask for surfaces of the scene, not for lamps that are seen.
        scene
            .lights
            .iter_mut()
            .for_each(|light| light.visible = false);
        let refused = |error: pack::PackError| Failure::App(error.into());
        let packed = Arc::new(pack::scene(&scene).map_err(refused)?);
        let frame = scene.frame(time);
        let view = packed.frame(&frame).map_err(refused)?;
        let choice = AdapterChoice {
            adapter,
            ..AdapterChoice::default()
        };
        let gpu = devices::on(&choice)?;
        let policy = ExecutionPolicy::default();
        let query = glimray_render::RayQuery::new(gpu, packed.clone(), &view, policy);
        Ok(Self {
            query: query.map_err(|error| Failure::App(error.into()))?,
            process: std::process::id(),
            numbers: (0..packed.triangles.len())
                .map(|_| AtomicU32::new(UNKNOWN))
                .collect(),
            packed,
            scene,
            frame,
            triangles: OnceLock::new(),
        })
    }

    /// Calls `answer` with one chunk of rays after the other, without holding the interpreter.
    fn trace(
        &self,
        py: Python,
        given: &Given,
        is_coherent: bool,
        mut answer: impl FnMut(&[QueryRay], &RayBatch) -> Result<(), RenderError> + Send,
    ) -> PyResult<()> {
        let coherence = match is_coherent {
            true => Coherence::Coherent,
            false => Coherence::Incoherent,
        };
        let traced = py.detach(|| {
            if self.process != std::process::id() {
                return Err(Failure::Forked);
            }
            given.for_chunks(|rays| {
                let batch = self.query.batch(rays)?.with_coherence(coherence);
                answer(rays, &batch)
            })
        });
        traced.map_err(|failure| failure.raised(py))
    }

    /// From each instance to the world.
    fn places(&self) -> Vec<DAffine3> {
        let instances = self.scene.instances.iter();
        instances
            .map(|instance| self.world_from(self.scene.node_of(instance)) * instance.placement)
            .collect()
    }

    fn world_from(&self, node: Option<usize>) -> DAffine3 {
        node.map_or(DAffine3::IDENTITY, |node| {
            self.frame.nodes[node].world_from_node
        })
    }

    fn row(&self, places: &[DAffine3], ray: &QueryRay, hit: &QueryHit) -> Row {
        let found = match self.query.object_of(hit) {
            Some(ObjectRef::Instance(index)) => self.on_triangle(index, places[index], hit),
            Some(ObjectRef::Shape(index)) => {
                let shape = &self.scene.shapes[index];
                let geometry = match shape.node {
                    None => shape.geometry,
                    node => shape.geometry.placed(self.world_from(node)),
                };
                let point = ray.origin + f64::from(hit.t) * ray.direction.as_dvec3();
                let index = self.scene.instances.len() + index;
                Some((index, -1, geometry.normal(point)))
            }
            Some(ObjectRef::Light(_)) | None => None,
        };
        let Some((object, triangle, normal)) = found else {
            return Row::MISS;
        };
        Row {
            distance: hit.t,
            object: object as i32,
            triangle,
            normal: normal.as_vec3().to_array(),
        }
    }

    /// The numbers of an instance and of its triangle that is hit, and the triangle's normal: that of the side from which
    /// its corners run counter-clockwise in the mesh.
    fn on_triangle(
        &self,
        index: usize,
        world_from_mesh: DAffine3,
        hit: &QueryHit,
    ) -> Option<(usize, i32, DVec3)> {
        let kept = &self.numbers[hit.primitive as usize];
        let number = match kept.load(Ordering::Relaxed) {
            UNKNOWN => {
                let corners = self.packed.corners_at(hit.primitive, hit.instance)?;
                let mesh = self.scene.instances[index].mesh;
                let number = *self.triangles()[mesh].get(&turned(corners))?;
                kept.store(number, Ordering::Relaxed);
                number
            }
            number => number,
        };
        let triangle = self.packed.triangles.get(hit.primitive as usize)?;
        let [a, b, c] = [triangle.v0, triangle.v1, triangle.v2].map(|v| Vec3::from(v).as_dvec3());
        let edges = match hit.instance {
            NO_INSTANCE => [b - a, c - a],
            _ => [b - a, c - a].map(|edge| world_from_mesh.transform_vector3(edge)),
        };
        let side = world_from_mesh.matrix3.determinant().signum();
        let normal = (side * edges[0].cross(edges[1])).normalize_or_zero();
        Some((index, number as i32, normal))
    }

    fn triangles(&self) -> &[HashMap<[u32; 3], u32>] {
        self.triangles.get_or_init(|| {
            let meshes = self.scene.meshes.iter();
            let of_mesh = |mesh: &Arc<glimray_scene::Mesh>| {
                let triangles = mesh.triangles.iter().enumerate();
                triangles
                    .map(|(index, corners)| (turned(*corners), index as u32))
                    .collect()
            };
            meshes.map(of_mesh).collect()
        })
    }
}

/// The corners in their order, from the least one on.
fn turned(mut corners: [u32; 3]) -> [u32; 3] {
    let least = (0..3).min_by_key(|&corner| corners[corner]);
    corners.rotate_left(least.unwrap_or(0));
    corners
}

/// Rays as Python gives them: rows of three doubles, and a float each for the distance at which they end.
struct Given<'a> {
    origins: &'a [[u8; 24]],
    directions: &'a [[u8; 24]],
    ends: Option<&'a [[u8; 4]]>,
}

impl<'a> Given<'a> {
    fn new(origins: &'a [u8], directions: &'a [u8], ends: Option<&'a [u8]>) -> PyResult<Self> {
        let given = Self {
            origins: origins.as_chunks().0,
            directions: directions.as_chunks().0,
            ends: ends.map(|ends| ends.as_chunks().0),
        };
        let count = given.count();
        match given.directions.len() == count && given.ends.is_none_or(|it| it.len() == count) {
            true => Ok(given),
            false => Err(PyValueError::new_err("rows of different numbers")),
        }
    }

    fn count(&self) -> usize {
        self.origins.len()
    }

    /// A ray; its direction is zero if it cannot be traced.
    fn ray(&self, row: usize) -> QueryRay {
        let vector =
            |bytes: &[u8; 24]| DVec3::from(bytemuck::pod_read_unaligned::<[f64; 3]>(bytes));
        let origin = vector(&self.origins[row]);
        let direction = vector(&self.directions[row]).normalize_or_zero().as_vec3();
        let end = self
            .ends
            .map_or(QueryRay::FAR, |ends| f32::from_ne_bytes(ends[row]));
        let is_sound = origin.is_finite() && !end.is_nan();
        QueryRay {
            t_max: end.min(QueryRay::FAR),
            ..QueryRay::new(origin, if is_sound { direction } else { Vec3::ZERO })
        }
    }

    /// Calls `trace` with one chunk of rays after the other.
    fn for_chunks(
        &self,
        mut trace: impl FnMut(&[QueryRay]) -> Result<(), RenderError>,
    ) -> Result<(), Failure> {
        let mut rays = vec![QueryRay::new(DVec3::ZERO, Vec3::ZERO); CHUNK.min(self.count())];
        for first in (0..self.count()).step_by(CHUNK) {
            let rays = &mut rays[..CHUNK.min(self.count() - first)];
            threads::fill(rays, |index| self.ray(first + index));
            if let Some(bad) = rays.iter().position(|ray| ray.direction == Vec3::ZERO) {
                return Err(Failure::Python(PyValueError::new_err(format!(
                    "bad ray (row {}): its origin is not finite, its t_max is NaN, or its direction is zero or not finite",
                    first + bad
                ))));
            }
            trace(rays).map_err(|error| Failure::App(error.into()))?;
            Python::attach(|py| py.check_signals()).map_err(Failure::Python)?;
        }
        Ok(())
    }
}
