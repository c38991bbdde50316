//! Measures whether kernels read the scene faster from images or from buffers on an adapter.

use super::{
    ExecutionPolicy, Fetch, QueryRay, RayBatch, RayQuery, RayTest, RenderError, policy::Storage,
};
use crate::{
    clock::Instant,
    gpu::Gpu,
    pack,
    random::SplitMix64,
    scene::{Camera, Instance, Material, Mesh, Scene},
};
use glam::{DAffine3, DVec3, Vec3, dvec3};
use std::{f64::consts::TAU, sync::Arc};

/// Quads along a side of the height field: 32,768 triangles, more than the caches of a core or of a multiprocessor hold.
const QUADS: u32 = 128;
/// The camera rays of a pass are the square of this, as are the others: enough to fill the adapter.
const SIDE_ON_CPU: u32 = 128;
const SIDE: u32 = 512;
/// Passes with each kind of storage, after a first one that may compile; fewer if the time is used up.
const ROUNDS: u32 = 3;
/// Seconds after which no further passes are started, on software adapters and on others.
const BUDGET_ON_CPU: f64 = 1.6;
const BUDGET: f64 = 0.15;
/// A difference that noise may cause: within it the kind of the adapter decides.
const MARGIN: f64 = 0.9;

/// The seconds in which an adapter traces the same rays.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct StorageTimes {
    /// With the scene in images.
    pub image: f64,
    /// With the scene in buffers.
    pub buffer: f64,
}

impl StorageTimes {
    /// Traces camera rays, which are coherent, and rays in random directions from random points of a surface, both in a
    /// height field, and takes the least of a few times. It takes up to 2 seconds on a software adapter that has to
    /// compile the kernels, and up to 0.2 on a GPU. `None` if compiling one of them used up the time, or if the device cannot
    /// bind the images.
    ///
    /// # Errors
    /// The device failed.
    pub fn measure(gpu: &Gpu) -> Result<Option<Self>, RenderError> {
        let started = Instant::now();
        let (side, budget) = match gpu.is_cpu() {
            true => (SIDE_ON_CPU, BUDGET_ON_CPU),
            false => (SIDE, BUDGET),
        };
        if !gpu.reads_images() {
            return Ok(None);
        }
        let scene = height_field();
        let rays = rays(side);
        let packed = match pack::scene(&scene) {
            Ok(packed) => Arc::new(packed),
            // The scene is a constant, which can be packed.
            Err(_) => return Ok(None),
        };
        let Ok(view) = packed.frame(&scene.frame(0.0)) else {
            return Ok(None);
        };
        let prepare = |fetch| -> Result<(RayQuery, RayBatch), RenderError> {
            let policy = ExecutionPolicy {
                fetch,
                ..ExecutionPolicy::default()
            };
            let query = RayQuery::new(gpu.clone(), packed.clone(), &view, policy)?;
            let batch = query.batch(&rays)?;
            query.seconds(&batch, RayTest::Closest, 1)?;
            Ok((query, batch))
        };
        let images = prepare(Fetch::Image)?;
        if started.elapsed().as_secs_f64() > budget {
            return Ok(None);
        }
        let buffers = prepare(Fetch::Buffer)?;
        let mut least = Self {
            image: f64::INFINITY,
            buffer: f64::INFINITY,
        };
        let trace =
            |(query, batch): &(RayQuery, RayBatch)| query.seconds(batch, RayTest::Closest, 1);
        for _ in 0..ROUNDS {
            least.image = least.image.min(trace(&images)?);
            least.buffer = least.buffer.min(trace(&buffers)?);
            if started.elapsed().as_secs_f64() > budget {
                break;
            }
        }
        Ok(Some(least))
    }

    /// The faster storage; that of the adapter's kind if there is no clear difference.
    pub fn faster(self, of_kind: Storage) -> Storage {
        let (usual, other, instead) = match of_kind {
            Storage::Image => (self.image, self.buffer, Storage::Buffer),
            Storage::Buffer => (self.buffer, self.image, Storage::Image),
        };
        match other < MARGIN * usual {
            true => instead,
            false => of_kind,
        }
    }
}

/// A height at a point of the unit square around the origin.
fn height(x: f64, z: f64) -> f64 {
    0.06 * (TAU * 2.0 * x).sin() * (TAU * 3.0 * z).sin() + 0.01 * (TAU * 17.0 * (x + z)).sin()
}

fn height_field() -> Scene {
    let side = QUADS + 1;
    let at = |i: u32| f64::from(i) / f64::from(QUADS) - 0.5;
    let positions: Vec<_> = (0..side * side)
        .map(|index| (at(index % side), at(index / side)))
        .map(|(x, z)| dvec3(x, height(x, z), z).as_vec3())
        .collect();
    let quads = (0..QUADS * QUADS).map(|index| index / QUADS * side + index % QUADS);
    let triangles = quads.flat_map(|corner| {
        let [right, below, across] = [corner + 1, corner + side, corner + side + 1];
        [[corner, below, right], [right, below, across]]
    });
    let mesh = Mesh {
        normals: vec![Vec3::Y; positions.len()],
        materials: vec![0; positions.len()],
        triangles: triangles.collect(),
        positions,
        ..Mesh::default()
    };
    Scene {
        meshes: vec![mesh.into()],
        instances: vec![Instance {
            mesh: 0,
            placement: DAffine3::IDENTITY,
            node: None,
        }],
        materials: vec![Material::default()],
        cameras: vec![Camera::default()],
        ..Scene::default()
    }
}

/// `side` rows of `side` camera rays, then as many from random points above the surface in random directions upwards.
fn rays(side: u32) -> Vec<QueryRay> {
    let eye = dvec3(0.55, 0.45, 0.75);
    let at = |i: u32| f64::from(i) / f64::from(side) - 0.5;
    let count = side * side;
    let seen = (0..count).map(|index| {
        let target = dvec3(at(index % side), 0.0, at(index / side));
        QueryRay::new(eye, (target - eye).normalize().as_vec3())
    });
    let mut random = SplitMix64::new(1);
    let bounced = (0..count).map(|_| {
        let (x, z) = (random.unit() - 0.5, random.unit() - 0.5);
        let (up, turn) = (random.unit(), TAU * random.unit());
        let flat = (1.0 - up * up).sqrt();
        let direction = dvec3(flat * turn.cos(), up, flat * turn.sin());
        let origin = dvec3(x, height(x, z), z) + 0.005 * DVec3::Y;
        QueryRay::new(origin, direction.as_vec3())
    });
    seen.chain(bounced).collect()
}
