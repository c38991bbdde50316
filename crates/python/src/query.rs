//! Rays that Python asks about.

use crate::errors::Failure;
use crate::host::Session;
use crate::{Files, devices, words};
use glam::{DAffine3, DVec3};
use glimray_cli::embedded;
use glimray_render::gpu::AdapterChoice;
use glimray_render::pack::{self, PackedScene};
use glimray_render::{Coherence, ExecutionPolicy, QueryHit, QueryRay, RayBatch, RenderError};
use glimray_scene::{Frame, ObjectRef, Scene};
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;
use pyo3::types::PyBytes;
use std::collections::HashMap;
use std::path::PathBuf;
use std::sync::{Arc, OnceLock};

/// Rays through a scene.
#[pyclass(frozen)]
pub struct RayQuery {
    query: glimray_render::RayQuery,
    packed: Arc<PackedScene>,
    scene: Scene,
    frame: Frame,
    /// For each mesh its triangles by their corners, in ascending order.
    triangles: OnceLock<Vec<HashMap<[u32; 3], u32>>>,
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

    /// Closest hits: distances, numbers of objects, numbers of triangles, normals, each as bytes; −1 where there is none.
    fn closest<'py>(
        &self,
        py: Python<'py>,
        origins: &[u8],
        directions: &[u8],
        t_max: Option<&[u8]>,
        is_coherent: bool,
    ) -> PyResult<[Bound<'py, PyBytes>; 4]> {
        let rays = rays(origins, directions, t_max)?;
        let found = py.detach(|| {
            let batch = self.batch(&rays, is_coherent)?;
            Ok(self.found(&rays, &self.query.closest_hits_of(&batch)?))
        });
        let found = found.map_err(|error| raised(py, error))?;
        Ok([
            PyBytes::new(py, bytemuck::cast_slice(&found.distances)),
            PyBytes::new(py, bytemuck::cast_slice(&found.objects)),
            PyBytes::new(py, bytemuck::cast_slice(&found.triangles)),
            PyBytes::new(py, bytemuck::cast_slice(&found.normals)),
        ])
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

/// What rays hit, ray by ray.
struct Found {
    distances: Vec<f32>,
    objects: Vec<i32>,
    triangles: Vec<i32>,
    normals: Vec<[f32; 3]>,
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

    fn found(&self, rays: &[QueryRay], hits: &[Option<QueryHit>]) -> Found {
        let mut found = Found {
            distances: vec![f32::INFINITY; hits.len()],
            objects: vec![-1; hits.len()],
            triangles: vec![-1; hits.len()],
            normals: vec![[0.0; 3]; hits.len()],
        };
        let places = self.scene.instances.iter().map(|instance| {
            let node = self.scene.node_of(instance);
            self.world_from(node) * instance.placement
        });
        let places: Vec<_> = places.collect();
        for (row, (ray, hit)) in rays.iter().zip(hits).enumerate() {
            let Some(hit) = hit else { continue };
            found.distances[row] = hit.t;
            let (object, normal) = match self.query.object_of(hit) {
                Some(ObjectRef::Instance(index)) => {
                    let corners = self.packed.corners_at(hit.primitive, hit.instance);
                    let Some(corners) = corners else { continue };
                    let mesh = self.scene.instances[index].mesh;
                    let triangle = self.triangles()[mesh].get(&sorted(corners)).copied();
                    found.triangles[row] = triangle.map_or(-1, |triangle| triangle as i32);
                    (index, self.triangle_normal(mesh, corners, places[index]))
                }
                Some(ObjectRef::Shape(index)) => {
                    let shape = &self.scene.shapes[index];
                    let geometry = match shape.node {
                        None => shape.geometry,
                        node => shape.geometry.placed(self.world_from(node)),
                    };
                    let point = ray.origin + f64::from(hit.t) * ray.direction.as_dvec3();
                    let index = self.scene.instances.len() + index;
                    (index, geometry.normal(point))
                }
                Some(ObjectRef::Light(_)) | None => continue,
            };
            found.objects[row] = object as i32;
            found.normals[row] = normal.as_vec3().to_array();
        }
        found
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
    let rows = |bytes: &[u8]| -> Vec<DVec3> {
        let rows = bytes.as_chunks::<24>().0.iter();
        rows.map(|row| DVec3::from(bytemuck::pod_read_unaligned::<[f64; 3]>(row)))
            .collect()
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
    let ray = |(row, (origin, direction)): (usize, (DVec3, DVec3))| {
        let unit = direction.try_normalize();
        let end = ends.as_ref().map_or(QueryRay::FAR, |ends| ends[row]);
        match unit {
            Some(unit) if origin.is_finite() && !end.is_nan() => Ok(QueryRay {
                t_max: end.min(QueryRay::FAR),
                ..QueryRay::new(origin, unit.as_vec3())
            }),
            _ => Err(PyValueError::new_err(format!(
                "bad ray (row {row}): its origin is not finite, or its direction is zero or not finite"
            ))),
        }
    };
    let rows = origins.into_iter().zip(directions).enumerate();
    rows.map(ray).collect()
}
