//! What the tracer remembers of its rays: how many there were and, where asked for, each of them.

use super::{Primitive, Tracer, moment, pixel_ray};
use glam::DVec3;
use glimray::render::{RayKind, Rays};
use glimray::scene::{ObjectRef, Scene};
use std::ops::{Deref, DerefMut};

/// A ray that was sent.
pub struct Sent {
    pub kind: RayKind,
    /// Place among those kept of the ray that sent it.
    pub sender: Option<usize>,
    /// Its share in the sample; of a shadow ray 0.
    pub share: DVec3,
    /// Distance, and what it met.
    pub hit: Option<(f64, Primitive)>,
    /// Of a shadow ray.
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
            share: DVec3::ZERO,
            hit,
            light: Some(light),
        });
    }
}

/// A ray of a pixel, with what it sent on.
pub struct Node {
    pub kind: RayKind,
    pub share: DVec3,
    /// Distance, and the instance or shape that it met.
    pub hit: Option<(f64, ObjectRef)>,
    pub light: Option<usize>,
    pub children: Vec<usize>,
}

/// For each pixel its colour and the rays through its centre, the primary one first. Nothing in the
/// scene may be hidden, nor any lamp be visible.
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
                share: sent.share,
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
