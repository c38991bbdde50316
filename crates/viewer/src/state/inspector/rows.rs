//! The rows of a ray tree, and the contribution of each bounce.

use crate::state::inspector::Inspected;
use crate::state::inspector::ray_labels;
use glam::{DVec3, Vec3};
use glimray_render::{Integrator, RayKind, SampleTree, TracedRay};
use std::collections::BTreeSet;

/// A ray: the index of its sample in the pixel, and its index in the sample.
pub type RayId = (usize, usize);

/// The filter of visible rays.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Filter {
    /// The index of the only visible sample; `None` for all.
    pub sample: Option<usize>,
    /// Maximum number of bounces before a ray.
    pub bounces: u32,
    /// Whether shadow rays are visible.
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
    /// Whether a ray is visible.
    pub fn has(&self, inspected: &Inspected, (sample, ray): RayId) -> bool {
        let bounces = inspected.bounces[sample][ray];
        let kind = inspected.tree.samples[sample].rays[ray].kind;
        self.sample.is_none_or(|shown| shown == sample)
            && bounces <= self.bounces
            && (self.shadows || kind != RayKind::Shadow)
    }

    /// The visible samples.
    pub fn samples(&self, inspected: &Inspected) -> std::ops::Range<usize> {
        match self.sample {
            Some(sample) => sample..sample + 1,
            None => 0..inspected.tree.samples.len(),
        }
    }
}

/// A row of the list.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Row {
    /// A sample's heading.
    Sample(usize),
    /// A ray.
    Ray {
        /// Which.
        id: RayId,
        /// Indentation level.
        level: usize,
        /// Whether it has visible children.
        has_children: bool,
    },
    /// A property of a ray.
    Detail {
        /// The ray.
        id: RayId,
        /// Indentation level.
        level: usize,
        /// The index of the property.
        place: usize,
    },
}

/// The rows of the list, from the top. The rays of a path follow each other at the same level, because a path does
/// not branch; only their light samples are below them.
pub fn rows(
    inspected: &Inspected,
    filter: &Filter,
    folded: &BTreeSet<RayId>,
    selected: Option<RayId>,
) -> Vec<Row> {
    let mut rows = Vec::new();
    let has_headings = filter.sample.is_none();
    let is_path = inspected.tree.integrator == Integrator::Path;
    for sample in filter.samples(inspected) {
        if has_headings {
            rows.push(Row::Sample(sample));
        }
        let rays = &inspected.tree.samples[sample].rays;
        // An explicit stack, because a tree may be deep.
        let mut ahead = vec![(0, usize::from(has_headings))];
        while let Some((ray, level)) = ahead.pop() {
            let id = (sample, ray);
            if rays.is_empty() || !filter.has(inspected, id) {
                continue;
            }
            let shown = |&&child: &&usize| filter.has(inspected, (sample, child));
            let follows = |child: &usize| is_path && rays[*child].kind != RayKind::Shadow;
            let (next, children): (Vec<usize>, Vec<usize>) =
                (rays[ray].children.iter().filter(shown)).partition(|child| follows(child));
            ahead.extend(next.iter().map(|&next| (next, level)));
            rows.push(Row::Ray {
                id,
                level,
                has_children: !children.is_empty(),
            });
            if selected == Some(id) {
                let count = ray_labels::details(inspected, &rays[ray]).len();
                let details = (0..count).map(|place| Row::Detail { id, level, place });
                rows.extend(details);
            }
            if !folded.contains(&id) {
                ahead.extend(children.iter().rev().map(|&child| (child, level + 1)));
            }
        }
    }
    rows
}

/// The number of bounces before each ray of a sample. Shadow rays and passages have the number of their parent.
pub fn bounces(sample: &SampleTree) -> Vec<u32> {
    let mut bounces: Vec<u32> = Vec::with_capacity(sample.rays.len());
    for ray in &sample.rays {
        let before = (ray.parent).and_then(|parent| bounces.get(parent).copied());
        let own = u32::from(!matches!(ray.kind, RayKind::Shadow | RayKind::Passage));
        bounces.push(before.map_or(0, |before| before + own));
    }
    bounces
}

/// The contribution of each bounce as linear radiance: of one sample, or of the pixel with the weights of
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
