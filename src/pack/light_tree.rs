//! A tree over many lamps: paths descend it by the light that each half may send to the point that is lit.
//!
//! Built by the surface area orientation heuristic (Conty Estevez and Kulla 2018, Importance Sampling of Many Lights with
//! Adaptive Tree Splitting), with the squared diagonal of a box in place of its surface, so that lamps in a row count.

use crate::layout::{
    ATTENUATION_NONE, LIGHT_BY_POWER, LIGHT_DISC, LIGHT_LEAF, LIGHT_POINT, LIGHT_RECTANGLE,
    LIGHT_SPHERE, LIGHT_SPOT, PackedCluster, PackedLight,
};
use glam::{DQuat, DVec3, Vec3};
use std::f64::consts::{FRAC_PI_2, PI};

/// With fewer lamps they are chosen by their power alone.
const LEAST_LAMPS: usize = 16;

const BUCKETS: usize = 12;

/// Steps from the root to a lamp, at most: as many as a trail has bits.
const MAX_DEPTH: u32 = 32;

/// Lamps that do not fade with distance, and those that do, each get at least this part of the samples.
const LEAST_SHARE: f64 = 0.1;

/// Cosines of cones are lowered by this, for rounding.
const SLACK: f64 = 1e-3;

/// The tree over the lamps of a view.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct LightTree {
    /// The lamps that it was built for.
    source: Vec<PackedLight>,
    /// Children are side by side; empty if lamps are chosen without a tree. The first is the root.
    pub nodes: Vec<PackedCluster>,
    /// By the index of the lamp: bit k says whether it is under the second child at depth k.
    trails: Vec<u32>,
}

/// Lamps and what is known of their light: where they are, and in which directions they shine.
#[derive(Clone, Copy, Debug)]
struct Cluster {
    min: DVec3,
    max: DVec3,
    /// The sum of the intensities, in luminance.
    power: f64,
    axis: DVec3,
    /// The angle from the axis of the farthest direction in which a lamp points, and the angle from this beyond which no
    /// light is sent, in radians.
    spread: f64,
    falloff: f64,
}

#[derive(Clone, Copy, Debug)]
struct Lamp {
    index: usize,
    cluster: Cluster,
}

impl LightTree {
    /// The tree for lamps of these powers, empty if they are few or move. Lamps that fade with distance and those that do
    /// not get shares by their powers.
    pub fn new(lights: &[PackedLight], powers: &[f64]) -> Self {
        let lamps = || (0..powers.len()).filter(|&index| powers[index] > 0.0);
        let mut tree = Self {
            source: lights.to_vec(),
            trails: vec![0; lights.len()],
            nodes: Vec::new(),
        };
        // Lamps that move have a key for each moment.
        if lights.len() != powers.len() || lamps().count() < LEAST_LAMPS {
            return tree;
        }
        let group = |fades: bool| -> Vec<Lamp> {
            let own =
                lamps().filter(|&index| (lights[index].attenuation != ATTENUATION_NONE) == fades);
            own.map(|index| Lamp {
                index,
                cluster: Cluster::of(&lights[index]),
            })
            .collect()
        };
        let (mut fading, mut lasting) = (group(true), group(false));
        tree.nodes.push(PackedCluster::default());
        match (fading.is_empty(), lasting.is_empty()) {
            (false, true) => tree.add(0, &mut fading, (0, 0), 0),
            (true, _) => tree.add(0, &mut lasting, (0, 0), LIGHT_BY_POWER),
            (false, false) => {
                tree.nodes.extend([PackedCluster::default(); 2]);
                tree.nodes[0].child = 1 | LIGHT_BY_POWER;
                tree.add(1, &mut fading, (1, 0), 0);
                tree.add(2, &mut lasting, (1, 1), LIGHT_BY_POWER);
                let sum = |lamps: &[Lamp]| lamps.iter().map(|lamp| powers[lamp.index]).sum::<f64>();
                let share = sum(&lasting) / (sum(&fading) + sum(&lasting));
                let share = share.clamp(LEAST_SHARE, 1.0 - LEAST_SHARE);
                tree.nodes[1].power = (1.0 - share) as f32;
                tree.nodes[2].power = share as f32;
            }
        }
        tree
    }

    /// Whether it is that of these lamps.
    pub fn is_of(&self, lights: &[PackedLight]) -> bool {
        self.source == lights
    }

    /// The reference to its root.
    pub fn root(&self) -> u32 {
        self.nodes.first().map_or(0, |root| root.child)
    }

    /// Writes the trail of each lamp, and that all of them together are chosen with the chance `share`.
    pub fn set_trails(&self, lights: &mut [PackedLight], powers: &[f64], share: f64) {
        for ((light, &trail), &power) in lights.iter_mut().zip(&self.trails).zip(powers) {
            light.place = trail;
            light.chance = if power > 0.0 { share as f32 } else { 0.0 };
        }
    }

    /// Fills the node `at`, which is `depth` steps below the root along the bits of `trail`.
    fn add(&mut self, at: usize, lamps: &mut [Lamp], (depth, trail): (u32, u32), flags: u32) {
        let clusters = lamps.iter().map(|lamp| lamp.cluster);
        let Some(cluster) = clusters.reduce(Cluster::union) else {
            return;
        };
        let child = match *lamps {
            [Lamp { index, .. }] => {
                self.trails[index] = trail;
                LIGHT_LEAF | index as u32
            }
            _ => {
                let middle = split(lamps, depth);
                let first = self.nodes.len();
                self.nodes.extend([PackedCluster::default(); 2]);
                let (left, right) = lamps.split_at_mut(middle);
                self.add(first, left, (depth + 1, trail), flags);
                self.add(first + 1, right, (depth + 1, trail | 1 << depth), flags);
                first as u32 | flags
            }
        };
        self.nodes[at] = cluster.packed(child);
    }
}

/// Sorts lamps into two parts, and returns the size of the first.
fn split(lamps: &mut [Lamp], depth: u32) -> usize {
    let half = lamps.len() / 2;
    let places = lamps.iter().map(|lamp| lamp.cluster.middle());
    let (min, max) = places.fold(
        (DVec3::INFINITY, DVec3::NEG_INFINITY),
        |(min, max), place| (min.min(place), max.max(place)),
    );
    // A tree of even halves has room for all that are left.
    let is_deep = 1_u64 << (MAX_DEPTH - depth).min(40) < 4 * lamps.len() as u64;
    let size = max - min;
    if is_deep || size.max_element() <= 0.0 {
        return half;
    }
    let bucket = |lamp: &Lamp, axis: usize| {
        let place = (lamp.cluster.middle()[axis] - min[axis]) / size[axis];
        ((place * BUCKETS as f64) as usize).min(BUCKETS - 1)
    };
    let mut best = (f64::INFINITY, 0, 0);
    for axis in (0..3).filter(|&axis| size[axis] > 0.0) {
        let mut buckets = [None; BUCKETS];
        for lamp in lamps.iter() {
            let own = &mut buckets[bucket(lamp, axis)];
            *own = join(*own, Some(lamp.cluster));
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
    lamps.sort_by_key(|lamp| bucket(lamp, axis) >= end);
    let middle = lamps.partition_point(|lamp| bucket(lamp, axis) < end);
    match middle {
        0 => half,
        _ if middle == lamps.len() => half,
        _ => middle,
    }
}

fn join(a: Option<Cluster>, b: Option<Cluster>) -> Option<Cluster> {
    match (a, b) {
        (Some(a), Some(b)) => Some(a.union(b)),
        _ => a.or(b),
    }
}

impl Cluster {
    fn of(light: &PackedLight) -> Self {
        let wide = |v: [f32; 3]| Vec3::from(v).as_dvec3();
        let (u, v) = (wide(light.edge_u).abs(), wide(light.edge_v).abs());
        let extent = match light.kind {
            LIGHT_RECTANGLE => u + v,
            LIGHT_DISC => (u * u + v * v).map(f64::sqrt),
            LIGHT_SPHERE => DVec3::splat(light.radius.into()),
            _ => DVec3::ZERO,
        };
        let center = wide(light.position);
        let (spread, falloff) = match light.kind {
            LIGHT_POINT | LIGHT_SPHERE => (PI, FRAC_PI_2),
            LIGHT_SPOT => {
                let [inner, outer] = [light.cos_inner, light.cos_outer]
                    .map(|cos| f64::from(cos).clamp(-1.0, 1.0).acos());
                match outer - inner < FRAC_PI_2 {
                    true => (inner, outer - inner),
                    false => (PI, FRAC_PI_2),
                }
            }
            _ => (0.0, FRAC_PI_2),
        };
        Self {
            min: center - extent,
            max: center + extent,
            power: super::emitters::LUMINANCE.dot(light.color.into()).into(),
            axis: wide(light.direction),
            spread,
            falloff,
        }
    }

    fn middle(&self) -> DVec3 {
        (self.min + self.max) / 2.0
    }

    /// The smallest cone about both cones is algorithm 1 of the paper.
    fn union(self, other: Self) -> Self {
        let (wide, narrow) = match self.spread >= other.spread {
            true => (self, other),
            false => (other, self),
        };
        let between = wide.axis.angle_between(narrow.axis);
        let mut all = Self {
            min: self.min.min(other.min),
            max: self.max.max(other.max),
            power: self.power + other.power,
            axis: wide.axis,
            spread: wide.spread,
            falloff: self.falloff.max(other.falloff),
        };
        if (between + narrow.spread).min(PI) > wide.spread {
            let spread = (wide.spread + between + narrow.spread) / 2.0;
            let turn = wide.axis.cross(narrow.axis).try_normalize();
            match turn {
                Some(turn) if spread < PI => {
                    let by = DQuat::from_axis_angle(turn, spread - wide.spread);
                    all.axis = (by * wide.axis).normalize_or(wide.axis);
                    all.spread = spread;
                }
                _ => all.spread = PI,
            }
        }
        all
    }

    /// Power times the measure of the directions times the size.
    fn cost(&self) -> f64 {
        let widest = (self.spread + self.falloff).min(PI);
        let (sin, cos) = self.spread.sin_cos();
        let directions = 2.0 * PI * (1.0 - cos)
            + FRAC_PI_2
                * (2.0 * widest * sin
                    - (self.spread - 2.0 * widest).cos()
                    - 2.0 * self.spread * sin
                    + cos);
        self.power * directions * (self.max - self.min).length_squared()
    }

    fn packed(&self, child: u32) -> PackedCluster {
        let middle = self.middle();
        let center = middle.as_vec3();
        // Rounding must not make it smaller.
        let extent = (self.max - self.min) / 2.0;
        let slack = 1e-6 * (extent.max_element() + middle.abs().max_element());
        let lowered = |angle: f64| {
            let steps = ((angle.cos() - SLACK).max(-1.0) * 32767.0).floor();
            u32::from(steps as i16 as u16)
        };
        let cone = match self.spread < PI {
            true => lowered(self.spread),
            false => u32::from(-32767_i16 as u16),
        };
        PackedCluster {
            center: center.into(),
            power: self.power as f32,
            extent: match extent == DVec3::ZERO {
                true => [0.0; 3],
                false => (extent + slack).as_vec3().into(),
            },
            child,
            axis: self.axis.as_vec3().into(),
            cones: cone | lowered(self.falloff) << 16,
        }
    }
}
