//! A ray tree as the lines of a list, of which some are shown; and what its bounces add up to.

use crate::render::{RayKind, SampleTree, TracedRay};
use crate::viewer::state::inspector::Inspected;
use crate::viewer::state::inspector::words;
use glam::{DVec3, Vec3};
use std::collections::BTreeSet;

/// A ray: place of its sample among those of the pixel, and its own in the sample.
pub type RayId = (usize, usize);

/// Which rays are shown.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Filter {
    /// Those of one sample, by its place; else of all.
    pub sample: Option<usize>,
    /// Those whose light was mirrored or refracted at most so often before.
    pub bounces: u32,
    /// Those to lights too.
    pub shadows: bool,
}

impl Default for Filter {
    fn default() -> Self {
        Self {
            sample: Some(0),
            bounces: u32::MAX,
            shadows: true,
        }
    }
}

impl Filter {
    /// Whether a ray is shown.
    pub fn has(&self, inspected: &Inspected, (sample, ray): RayId) -> bool {
        let bounces = inspected.bounces[sample][ray];
        let kind = inspected.tree.samples[sample].rays[ray].kind;
        self.sample.is_none_or(|shown| shown == sample)
            && bounces <= self.bounces
            && (self.shadows || kind != RayKind::Shadow)
    }

    /// The samples that are shown.
    pub fn samples(&self, inspected: &Inspected) -> std::ops::Range<usize> {
        match self.sample {
            Some(sample) => sample..sample + 1,
            None => 0..inspected.tree.samples.len(),
        }
    }
}

/// A line of the list.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Row {
    /// A sample's heading.
    Sample(usize),
    /// A ray.
    Ray {
        /// Which.
        id: RayId,
        /// How far it is set in.
        level: usize,
        /// Whether rays that it sent can be shown below it.
        has_children: bool,
    },
    /// One of the things to tell about a ray.
    Detail {
        /// Which ray.
        id: RayId,
        /// How far it is set in.
        level: usize,
        /// Which thing.
        place: usize,
    },
}

/// The lines of the list, from the top.
pub fn rows(
    inspected: &Inspected,
    filter: &Filter,
    folded: &BTreeSet<RayId>,
    selected: Option<RayId>,
) -> Vec<Row> {
    let mut rows = Vec::new();
    let has_headings = filter.sample.is_none();
    for sample in filter.samples(inspected) {
        if has_headings {
            rows.push(Row::Sample(sample));
        }
        let rays = &inspected.tree.samples[sample].rays;
        // Of its own, as a tree may be deep.
        let mut ahead = vec![(0, usize::from(has_headings))];
        while let Some((ray, level)) = ahead.pop() {
            let id = (sample, ray);
            if rays.is_empty() || !filter.has(inspected, id) {
                continue;
            }
            let shown = |&&child: &&usize| filter.has(inspected, (sample, child));
            let children: Vec<_> = rays[ray].children.iter().filter(shown).collect();
            rows.push(Row::Ray {
                id,
                level,
                has_children: !children.is_empty(),
            });
            if selected == Some(id) {
                let count = words::details(inspected, &rays[ray]).len();
                let details = (0..count).map(|place| Row::Detail { id, level, place });
                rows.extend(details);
            }
            if !folded.contains(&id) {
                ahead.extend(children.iter().rev().map(|&&child| (child, level + 1)));
            }
        }
    }
    rows
}

/// How often the light of each ray of a sample was mirrored or refracted before. A ray to a light counts
/// as the one that sent it.
pub fn bounces(sample: &SampleTree) -> Vec<u32> {
    let mut bounces: Vec<u32> = Vec::with_capacity(sample.rays.len());
    for ray in &sample.rays {
        let before = (ray.parent).and_then(|parent| bounces.get(parent).copied());
        let own = u32::from(ray.kind != RayKind::Shadow);
        bounces.push(before.map_or(0, |before| before + own));
    }
    bounces
}

/// What the rays of each bounce add, as linear radiance: of one sample, or of the pixel by the weights of
/// its samples.
pub fn by_bounce(inspected: &Inspected, sample: Option<usize>) -> Vec<DVec3> {
    let mut sums = vec![DVec3::ZERO; inspected.max_bounces() as usize + 1];
    let mut weights = 0.0;
    let samples = inspected.tree.samples.iter().zip(&inspected.bounces);
    for (place, (tree, bounces)) in samples.enumerate() {
        let weight = match sample {
            None if tree.dropped => continue,
            None => f64::from(tree.weight),
            Some(shown) if shown == place => 1.0,
            Some(_) => continue,
        };
        weights += weight;
        for (ray, bounce) in tree.rays.iter().zip(bounces) {
            sums[*bounce as usize] += weight * contribution(ray);
        }
    }
    if weights != 0.0 {
        sums.iter_mut().for_each(|sum| *sum /= weights);
    }
    sums
}

fn contribution(ray: &TracedRay) -> DVec3 {
    Vec3::from(ray.contribution).as_dvec3()
}
