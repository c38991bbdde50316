//! The chances of all lamps and emitters in a light tree, by brute force in f64 from its packed clusters.

use crate::instances::rendered;
use bytemuck::cast_slice;
use glam::{DVec3, Vec3, dvec3};
use glimray::layout::{
    LIGHT_BY_POWER, LIGHT_EMITTERS, LIGHT_INDEX_MASK, LIGHT_LEAF, LIGHT_TWO_SIDED, PackedCluster,
};
use glimray::pack::{self, PackedView};
use glimray::render::RenderSettings;
use glimray::scene::Scene;
use std::f64::consts::PI;
use std::sync::Arc;

pub fn wide(v: [f32; 3]) -> DVec3 {
    Vec3::from(v).as_dvec3()
}

fn fraction(word: u32) -> f64 {
    (f64::from(word as u16 as i16) / 32767.0).max(-1.0)
}

/// A point of the octahedron |x| + |y| + |z| = 1 that is laid flat.
fn axis(word: u32) -> DVec3 {
    let (x, y) = (fraction(word), fraction(word >> 16));
    let z = 1.0 - x.abs() - y.abs();
    let at = match z < 0.0 {
        true => dvec3((1.0 - y.abs()).copysign(x), (1.0 - x.abs()).copysign(y), z),
        false => dvec3(x, y, z),
    };
    at.normalize()
}

/// The most light that a cluster may send to a point of a surface, by angles.
pub fn importance(cluster: &PackedCluster, p: DVec3, n: DVec3) -> f64 {
    let offset = p - wide(cluster.center);
    let radius = f64::from(cluster.radius2).sqrt();
    let distance = offset.length();
    let seen = match distance <= radius {
        true => PI,
        false => (radius / distance).asin(),
    };
    let (spread, falloff) = (
        fraction(cluster.cones).acos(),
        fraction(cluster.cones >> 16).acos(),
    );
    let w = offset / distance;
    let mut turn = axis(cluster.axis).angle_between(w);
    if cluster.child & LIGHT_TWO_SIDED != 0 {
        turn = turn.min(PI - turn);
    }
    let off = (turn - spread - seen).max(0.0);
    let below = (n.angle_between(-w) - seen).max(0.0);
    // Cosines this little below the end of the light may be rounding errors.
    let slack = 1e-3;
    if off.cos() + slack <= falloff.cos() || below.cos() + slack <= 0.0 {
        return 0.0;
    }
    let cosines = off.cos().max(slack) * below.cos().max(slack);
    f64::from(cluster.power) * cosines / distance.max(radius).powi(2)
}

/// The chances at a point, each with the trail that leads there.
pub struct Chances {
    pub lamps: Vec<(f64, u32)>,
    pub emitters: Vec<(f64, u32)>,
    /// The chance of clusters in which no light may reach the point.
    pub missed: f64,
}

pub fn chances(view: &PackedView, p: DVec3, n: DVec3) -> Chances {
    let clusters: &[PackedCluster] = cast_slice(view.node_parts()[7]);
    let mut found = Chances {
        lamps: vec![(0.0, 0); view.frame.light_count as usize],
        emitters: vec![(0.0, 0); view.emitters.len()],
        missed: 0.0,
    };
    let share = 1.0 - f64::from(view.frame.environment_share);
    let mut open = vec![(view.frame.light_root, share, 0, 0)];
    while let Some((reference, chance, bits, trail)) = open.pop() {
        let index = (reference & LIGHT_INDEX_MASK) as usize;
        if reference & LIGHT_LEAF != 0 {
            if reference & LIGHT_EMITTERS == 0 {
                found.lamps[index] = (chance, trail);
                continue;
            }
            let group = view.frame.emitter_group as usize;
            let mut before = 0.0;
            for at in index * group..((index + 1) * group).min(view.emitters.len()) {
                let end = f64::from(view.emitters[at].end);
                found.emitters[at] = (chance * (end - before), trail);
                before = end;
            }
            continue;
        }
        let children = &clusters[index..index + 4];
        let weights = [0, 1, 2, 3].map(|k| match reference & LIGHT_BY_POWER {
            _ if children[k].child == 0 => 0.0,
            0 => importance(&children[k], p, n),
            _ => children[k].power.into(),
        });
        let total: f64 = weights.iter().sum();
        found.missed += if total > 0.0 { 0.0 } else { chance };
        for k in (0..4).filter(|&k| children[k].child != 0) {
            let own = match total > 0.0 {
                true => chance * weights[k] / total,
                false => 0.0,
            };
            let trail = trail | (k as u32) << bits;
            open.push((children[k].child, own, bits + 2, trail));
        }
    }
    found
}

/// The mean of the green channel, of a scene whose lights are in a tree from this many on; the shutter is open from 0 to 1.
pub fn mean_from(scene: &Scene, settings: &RenderSettings, tree_from: usize) -> f64 {
    let mut packed = pack::scene(scene).expect("a scene that can be packed");
    packed.tree_from = tree_from;
    let frames = scene.motion_samples(0.0, 1.0);
    let (image, stats) = rendered(&Arc::new(packed), &frames, settings);
    assert_eq!(stats.nonfinite_samples, 0);
    let sum: f64 = image.pixels.iter().map(|pixel| f64::from(pixel[1])).sum();
    sum / image.pixels.len() as f64
}
