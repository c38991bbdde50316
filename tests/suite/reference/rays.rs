//! The records of the tracer: the number of rays and, on request, each of them.

use super::{Primitive, Tracer, moment, pixel_ray};
use glam::DVec3;
use glimray::render::{RayKind, Rays};
use glimray::scene::{ObjectRef, Scene};
use std::ops::{Deref, DerefMut};

/// A traced ray.
pub struct Sent {
    pub kind: RayKind,
    /// Index of its parent in the records.
    pub sender: Option<usize>,
    /// The ray's throughput; 0 for a shadow ray.
    pub throughput: DVec3,
    /// Distance, and the object it hit.
    pub hit: Option<(f64, Primitive)>,
    /// Set for a shadow ray.
    pub light: Option<usize>,
}

#[derive(Default)]
pub struct Log {
    pub counts: Rays,
    kept: Option<Vec<Sent>>,
    /// The ray whose surface is being shaded.
    pub sender: Option<usize>,
}

impl Deref for Log {
    type Target = Rays;
    fn deref(&self) -> &Rays {
        &self.counts
    }
}

impl DerefMut for Log {
    fn deref_mut(&mut self) -> &mut Rays {
        &mut self.counts
    }
}

impl Log {
    pub fn keep(&mut self, sent: Sent) -> Option<usize> {
        let kept = self.kept.as_mut()?;
        kept.push(sent);
        Some(kept.len() - 1)
    }

    pub fn keep_shadow(&mut self, light: usize, hit: Option<(f64, Primitive)>) {
        self.keep(Sent {
            kind: RayKind::Shadow,
            sender: self.sender,
            throughput: DVec3::ZERO,
            hit,
            light: Some(light),
        });
    }
}

/// A ray of a pixel, with its children.
pub struct Node {
    pub kind: RayKind,
    pub throughput: DVec3,
    /// Distance, and the instance or shape it hit.
    pub hit: Option<(f64, ObjectRef)>,
    pub light: Option<usize>,
    pub children: Vec<usize>,
}

/// For each pixel its colour and the rays through its centre, the primary one first. The scene must have no
/// hidden objects and no visible lamps.
pub fn trees(
    scene: &Scene,
    time: f64,
    size: (u32, u32),
    pixels: &[[u32; 2]],
) -> Vec<(DVec3, Vec<Node>)> {
    let (still, carriers) = moment::resolve(scene, time);
    let tracer = Tracer::new(&still, &carriers);
    let object = |primitive| match primitive {
        Primitive::Shape(index) => ObjectRef::Shape(index),
        Primitive::Triangle(index) => ObjectRef::Instance(tracer.triangles[index].instance),
    };
    let tree = |&pixel: &[u32; 2]| {
        let mut log = Log {
            kept: Some(Vec::new()),
            ..Log::default()
        };
        let (origin, direction) = pixel_ray(tracer.camera, size, pixel);
        let color = tracer.radiance(origin, direction, &mut log);
        let mut nodes: Vec<Node> = Vec::new();
        for (index, sent) in log.kept.into_iter().flatten().enumerate() {
            if let Some(sender) = sent.sender {
                nodes[sender].children.push(index);
            }
            nodes.push(Node {
                kind: sent.kind,
                throughput: sent.throughput,
                hit: sent.hit.map(|(t, primitive)| (t, object(primitive))),
                light: sent.light,
                children: Vec::new(),
            });
        }
        (color, nodes)
    };
    let (first, second) = pixels.split_at(pixels.len() / 2);
    // Two threads, because brute force takes its time.
    std::thread::scope(|scope| {
        let second = scope.spawn(|| second.iter().map(tree).collect::<Vec<_>>());
        let mut all: Vec<_> = first.iter().map(tree).collect();
        all.extend(second.join().expect("traced"));
        all
    })
}
