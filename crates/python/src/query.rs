//! Rays that Python asks about.

use crate::errors::Failure;
use crate::host::Session;
use crate::{Files, devices, words};
use glam::{DAffine3, DVec3, Vec3};
use glimray_cli::embedded;
use glimray_render::gpu::AdapterChoice;
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

/// A number that has not been looked up.
const UNKNOWN: u32 = u32::MAX;

/// Rays through a scene.
#[pyclass(frozen)]
pub struct RayQuery {
    query: glimray_render::RayQuery,
    packed: Arc<PackedScene>,
    scene: Scene,
    frame: Frame,
    /// For each mesh its triangles by their corners, in ascending order.
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

    /// Closest hits: a [`Row`] for each ray.
    fn closest<'py>(
        &self,
        py: Python<'py>,
        origins: &[u8],
        directions: &[u8],
        t_max: Option<&[u8]>,
        is_coherent: bool,
    ) -> PyResult<Bound<'py, PyBytes>> {
        let rays = rays(origins, directions, t_max)?;
        let found = py.detach(|| {
            let batch = self.batch(&rays, is_coherent)?;
            let hits = self.query.closest_hits_of(&batch)?;
            let places = self.places();
            Ok(threads::collect(hits.len(), |index| {
                let hit = hits[index];
                hit.map_or(Row::MISS, |hit| self.row(&places, &rays[index], &hit))
            }))
        });
        let found: Vec<Row> = found.map_err(|error| raised(py, error))?;
        Ok(PyBytes::new(py, bytemuck::cast_slice(&found)))
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
        let rays = rays(origins, directions, t_max)?;
        let occluded = py.detach(|| {
            let batch = self.batch(&rays, is_coherent)?;
            self.query.occluded_of(&batch)
        });
        let occluded = occluded.map_err(|error| raised(py, error))?;
        Ok(PyBytes::new(
            py,
            &occluded.into_iter().map(u8::from).collect::<Vec<_>>(),
        ))
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

fn raised(py: Python, error: RenderError) -> PyErr {
    Failure::App(error.into()).raised(py)
}

/// What a ray hits.
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
        let scene = match scene.deformations.is_empty() {
            true => scene,
            false => scene.at_rest(time),
        };
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
            numbers: (0..packed.triangles.len())
                .map(|_| AtomicU32::new(UNKNOWN))
                .collect(),
            packed,
            scene,
            frame,
            triangles: OnceLock::new(),
        })
    }

    fn batch(&self, rays: &[QueryRay], is_coherent: bool) -> Result<RayBatch, RenderError> {
        Ok((self.query.batch(rays)?).with_coherence(match is_coherent {
            true => Coherence::Coherent,
            false => Coherence::Incoherent,
        }))
    }

    /// From each instance to the world.
    fn places(&self) -> Vec<DAffine3> {
        let instances = self.scene.instances.iter();
        instances
            .map(|instance| self.world_from(self.scene.node_of(instance)) * instance.placement)
            .collect()
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

    /// The numbers of an instance and of its triangle that is hit, and the triangle's normal.
    fn on_triangle(
        &self,
        index: usize,
        world_from_mesh: DAffine3,
        hit: &QueryHit,
    ) -> Option<(usize, i32, DVec3)> {
        let corners = self.packed.corners_at(hit.primitive, hit.instance)?;
        let mesh = self.scene.instances[index].mesh;
        let kept = &self.numbers[hit.primitive as usize];
        let number = match kept.load(Ordering::Relaxed) {
            UNKNOWN => {
                let number = *self.triangles()[mesh].get(&sorted(corners))?;
                kept.store(number, Ordering::Relaxed);
                number
            }
            number => number,
        };
        let normal = self.triangle_normal(mesh, corners, world_from_mesh);
        Some((index, number as i32, normal))
    }

    fn world_from(&self, node: Option<usize>) -> DAffine3 {
        node.map_or(DAffine3::IDENTITY, |node| {
            self.frame.nodes[node].world_from_node
        })
    }

    /// The unit normal of the side from which the corners run counter-clockwise.
    fn triangle_normal(&self, mesh: usize, corners: [u32; 3], world_from_mesh: DAffine3) -> DVec3 {
        let positions = &self.scene.meshes[mesh].positions;
        let [a, b, c] = corners.map(|corner| positions[corner as usize].as_dvec3());
        let [u, v] = [b - a, c - a].map(|edge| world_from_mesh.transform_vector3(edge));
        let side = world_from_mesh.matrix3.determinant().signum();
        (side * u.cross(v)).normalize_or_zero()
    }

    fn triangles(&self) -> &[HashMap<[u32; 3], u32>] {
        self.triangles.get_or_init(|| {
            let meshes = self.scene.meshes.iter();
            let of_mesh = |mesh: &Arc<glimray_scene::Mesh>| {
                let triangles = mesh.triangles.iter().enumerate();
                triangles
                    .map(|(index, corners)| (sorted(*corners), index as u32))
                    .collect()
            };
            meshes.map(of_mesh).collect()
        })
    }
}

fn sorted(mut corners: [u32; 3]) -> [u32; 3] {
    corners.sort_unstable();
    corners
}

/// Rays of rows of three doubles, and of one float each for the distance at which they end.
fn rays(origins: &[u8], directions: &[u8], t_max: Option<&[u8]>) -> PyResult<Vec<QueryRay>> {
    let rows = |bytes: &[u8]| {
        let rows = bytes.as_chunks::<24>().0;
        threads::collect(rows.len(), |row| {
            DVec3::from(bytemuck::pod_read_unaligned::<[f64; 3]>(&rows[row]))
        })
    };
    let (origins, directions) = (rows(origins), rows(directions));
    let ends = t_max.map(|bytes| {
        let ends = bytes.as_chunks::<4>().0.iter();
        ends.map(|end| f32::from_ne_bytes(*end)).collect::<Vec<_>>()
    });
    let count = origins.len();
    if directions.len() != count || ends.as_ref().is_some_and(|ends| ends.len() != count) {
        return Err(PyValueError::new_err("rows of different numbers"));
    }
    let rays = threads::collect(count, |row| {
        let unit = directions[row].normalize_or_zero();
        let end = ends.as_ref().map_or(QueryRay::FAR, |ends| ends[row]);
        QueryRay {
            t_max: end.min(QueryRay::FAR),
            ..QueryRay::new(origins[row], unit.as_vec3())
        }
    });
    let is_bad = |ray: &QueryRay| ray.direction == Vec3::ZERO || !ray.origin.is_finite();
    let has_nan = |ends: &Vec<f32>| ends.iter().position(|end| end.is_nan());
    let bad = (rays.iter().position(is_bad)).or_else(|| ends.as_ref().and_then(has_nan));
    match bad {
        None => Ok(rays),
        Some(row) => Err(PyValueError::new_err(format!(
            "bad ray (row {row}): its origin or its length is not finite, or its direction is zero or not finite"
        ))),
    }
}
