//! A tree over many lamps and emitters: paths descend it by the light that each child may send to the point that is lit.
//!
//! Built by the surface area orientation heuristic (Conty Estevez and Kulla 2018, Importance Sampling of Many Lights with
//! Adaptive Tree Splitting), with the squared diagonal of a box in place of its surface, so that lights in a row count.

use super::light_cluster::Cluster;
use crate::layout::{
    ATTENUATION_NONE, LIGHT_BY_POWER, LIGHT_EMITTERS, LIGHT_LEAF, PackedCluster, PackedEmitter,
    PackedLight,
};
use glam::DVec3;

/// With fewer lights they are chosen by their power alone: see benches/log/2026-11.md.
pub const LEAST_LIGHTS: usize = 4;

const BUCKETS: usize = 12;

/// Children of a node, some of which may have no power, and no lights below.
const WIDTH: usize = 4;

/// The number of bits in a trail, two for each step.
const TRAIL_BITS: u32 = 32;

/// Lamps that do not fade with distance, and the other lights, each get at least this part of the samples.
const LEAST_SHARE: f64 = 0.1;

/// The tree over the lights of a view.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct LightTree {
    /// The leaves that the tree was built for.
    leaves: Vec<Leaf>,
    /// Children are side by side; empty if lights are chosen without a tree. The first is the root.
    pub nodes: Vec<PackedCluster>,
    /// The way to each leaf: bits 2k and 2k + 1 say which child it is under at depth k.
    trails: Vec<u32>,
}

/// A lamp or a group of emitters.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Leaf {
    /// See [`PackedCluster::child`].
    reference: u32,
    cluster: Cluster,
    /// The leaf's part of all light, up to a factor.
    power: f64,
    /// Whether its light fades with distance.
    fades: bool,
}

impl Leaf {
    /// The lamps that may shine, by their powers. Each key holds all lamps.
    pub fn of_lamps(keys: &[PackedLight], powers: &[f64]) -> Vec<Self> {
        let lamps = (0..powers.len()).filter(|&index| powers[index] > 0.0);
        let leaf = |index: usize| Self {
            reference: LIGHT_LEAF | index as u32,
            cluster: Cluster::of_lamp(keys[index..].iter().step_by(powers.len())),
            power: powers[index],
            fades: keys[index].attenuation != ATTENUATION_NONE,
        };
        lamps.map(leaf).collect()
    }

    /// A group of emitters.
    pub fn of_group(index: usize, cluster: Cluster) -> Self {
        Self {
            reference: LIGHT_LEAF | LIGHT_EMITTERS | index as u32,
            cluster,
            power: cluster.power,
            fades: true,
        }
    }
}

impl LightTree {
    /// The tree over these leaves, empty if there are fewer than two. Lamps that do not fade with distance, and the other
    /// lights, get shares by their powers.
    pub fn new(leaves: Vec<Leaf>) -> Self {
        let mut tree = Self {
            trails: vec![0; leaves.len()],
            nodes: Vec::new(),
            leaves: Vec::new(),
        };
        if leaves.len() < 2 {
            return tree;
        }
        let group = |fades: bool| -> Vec<usize> {
            let own = (0..leaves.len()).filter(|&index| leaves[index].fades == fades);
            own.collect()
        };
        let (mut fading, mut lasting) = (group(true), group(false));
        tree.leaves = leaves;
        tree.nodes.push(PackedCluster::default());
        match (fading.is_empty(), lasting.is_empty()) {
            (false, true) => tree.add(0, &mut fading, (0, 0), 0),
            (true, _) => tree.add(0, &mut lasting, (0, 0), LIGHT_BY_POWER),
            (false, false) => {
                tree.nodes.extend([PackedCluster::default(); WIDTH]);
                tree.nodes[0].child = 1 | LIGHT_BY_POWER;
                tree.add(1, &mut fading, (2, 0), 0);
                tree.add(2, &mut lasting, (2, 1), LIGHT_BY_POWER);
                tree.share_out(&fading, &lasting);
            }
        }
        tree
    }

    /// Gives both children of the root powers for what they hold. Only their ratio counts, so the power of a lone group of
    /// emitters stays what it is.
    fn share_out(&mut self, fading: &[usize], lasting: &[usize]) {
        let sum = |own: &[usize]| -> f64 { own.iter().map(|&at| self.leaves[at].power).sum() };
        let share = sum(lasting) / (sum(fading) + sum(lasting));
        let share = share.clamp(LEAST_SHARE, 1.0 - LEAST_SHARE);
        let scale = match *fading {
            [_] => f64::from(self.nodes[1].power) / (1.0 - share),
            _ => 1.0,
        };
        self.nodes[1].power = (scale * (1.0 - share)) as f32;
        self.nodes[2].power = (scale * share) as f32;
    }

    /// Whether it is that of these leaves.
    pub fn is_of(&self, leaves: &[Leaf]) -> bool {
        self.leaves == leaves
    }

    /// The reference to its root.
    pub fn root(&self) -> u32 {
        self.nodes.first().map_or(0, |root| root.child)
    }

    /// Writes the trail of each lamp and each emitter. Each key of `lights` holds `count` lamps, and each group as many
    /// emitters.
    pub fn set_trails(
        &self,
        (lights, count): (&mut [PackedLight], usize),
        (emitters, group): (&mut [PackedEmitter], usize),
    ) {
        for (leaf, &trail) in self.leaves.iter().zip(&self.trails) {
            let index = (leaf.reference & !(LIGHT_LEAF | LIGHT_EMITTERS)) as usize;
            match leaf.reference & LIGHT_EMITTERS {
                0 => (lights.iter_mut().skip(index).step_by(count))
                    .for_each(|light| (light.place, light.chance) = (trail, 1.0)),
                _ => (emitters.chunks_mut(group).nth(index).into_iter().flatten())
                    .for_each(|emitter| emitter.trail = trail),
            }
        }
    }

    /// Fills the node `at`, to which the first `bits` bits of `trail` lead.
    fn add(&mut self, at: usize, own: &mut [usize], (bits, trail): (u32, u32), flags: u32) {
        let clusters = own.iter().map(|&leaf| self.leaves[leaf].cluster);
        let Some(cluster) = clusters.reduce(Cluster::union) else {
            return;
        };
        let child = match *own {
            [leaf] => {
                self.trails[leaf] = trail;
                self.leaves[leaf].reference
            }
            _ => {
                let first = self.nodes.len();
                self.nodes.extend([PackedCluster::default(); WIDTH]);
                let mut parts = vec![own];
                while parts.len() < WIDTH
                    && let Some(largest) = (0..parts.len()).max_by_key(|&i| parts[i].len())
                    && parts[largest].len() > 1
                {
                    let part = parts.swap_remove(largest);
                    let middle = split(&self.leaves, part, bits);
                    let (left, right) = part.split_at_mut(middle);
                    parts.extend([left, right]);
                }
                for (slot, part) in parts.into_iter().enumerate() {
                    let trail = trail | (slot as u32) << bits;
                    self.add(first + slot, part, (bits + 2, trail), flags);
                }
                first as u32 | flags
            }
        };
        self.nodes[at] = cluster.packed(child);
    }
}

/// Sorts leaves into two parts, and returns the size of the first. `bits` of their trails are in use.
fn split(leaves: &[Leaf], own: &mut [usize], bits: u32) -> usize {
    let half = own.len() / 2;
    let cluster = |leaf: usize| &leaves[leaf].cluster;
    let places = own.iter().map(|&leaf| cluster(leaf).middle());
    let (min, max) = places.fold(
        (DVec3::INFINITY, DVec3::NEG_INFINITY),
        |(min, max), place| (min.min(place), max.max(place)),
    );
    // Otherwise a child that gets all of them, two bits further on, still has room for a tree of even parts.
    let is_deep = 1_u64 << (TRAIL_BITS - bits) < 4 * own.len() as u64;
    let size = max - min;
    if is_deep || size.max_element() <= 0.0 {
        return half;
    }
    let bucket = |leaf: usize, axis: usize| {
        let place = (cluster(leaf).middle()[axis] - min[axis]) / size[axis];
        ((place * BUCKETS as f64) as usize).min(BUCKETS - 1)
    };
    let mut best = (f64::INFINITY, 0, 0);
    for axis in (0..3).filter(|&axis| size[axis] > 0.0) {
        let mut buckets = [None; BUCKETS];
        for &leaf in own.iter() {
            let all = &mut buckets[bucket(leaf, axis)];
            *all = join(*all, Some(*cluster(leaf)));
        }
        // The cost of all buckets from each on.
        let mut costs_after = [0.0; BUCKETS];
        let mut after = None;
        for k in (0..BUCKETS).rev() {
            after = join(after, buckets[k]);
            costs_after[k] = after.map_or(0.0, |cluster: Cluster| cluster.cost());
        }
        let stretch = size.max_element() / size[axis];
        let mut before = None;
        for k in 1..BUCKETS {
            before = join(before, buckets[k - 1]);
            let cost = before.map_or(0.0, |cluster: Cluster| cluster.cost()) + costs_after[k];
            best = match stretch * cost < best.0 {
                true => (stretch * cost, axis, k),
                false => best,
            };
        }
    }
    let (_, axis, end) = best;
    own.sort_by_key(|&leaf| bucket(leaf, axis) >= end);
    let middle = own.partition_point(|&leaf| bucket(leaf, axis) < end);
    match middle {
        0 => half,
        _ if middle == own.len() => half,
        _ => middle,
    }
}

fn join(a: Option<Cluster>, b: Option<Cluster>) -> Option<Cluster> {
    match (a, b) {
        (Some(a), Some(b)) => Some(a.union(b)),
        _ => a.or(b),
    }
}
