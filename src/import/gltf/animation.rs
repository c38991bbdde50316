//! Clips (section 3.11 of the specification): tracks of the nodes that they move.

use super::Reader;
use super::document::{AnimationSampler, Interpolation as Kinds, Kind};
use super::hierarchy::{extended, unit};
use crate::import::budget;
use crate::import::error::ImportError;
use crate::scene::{Beyond, Curve, Easing, Interpolation, NodeProperty, Target, Track, Values};
use glam::{DQuat, DVec3};
use std::collections::HashSet;

/// The values of a sampler: one per key, or with tangents three.
struct Keys {
    times: Vec<f64>,
    values: Vec<[f64; 4]>,
    interpolation: Interpolation,
}

/// The property that a channel's path names.
fn property(path: &str) -> Option<NodeProperty> {
    match path {
        "translation" => Some(NodeProperty::Translation),
        "rotation" => Some(NodeProperty::Rotation),
        "scale" => Some(NodeProperty::Scale),
        _ => None,
    }
}

impl Reader<'_> {
    /// The clips to play: the one that `wanted` names, by its name or number, or else all, except those
    /// that move what an earlier one moves.
    ///
    /// # Errors
    /// There is no clip of that name, or a channel refers to a node that does not exist.
    pub(super) fn clips(&mut self, wanted: Option<&str>) -> Result<Vec<usize>, ImportError> {
        let document = self.document;
        let clips = &document.animations;
        for (index, clip) in clips.iter().enumerate() {
            for (i, channel) in clip.channels.iter().enumerate() {
                let here = || format!("animations[{index}].channels[{i}]");
                if let Some(node) = channel.target.node {
                    self.blame.get(&document.nodes, node, "nodes", here())?;
                }
                self.blame
                    .get(&clip.samplers, channel.sampler, "samplers", here())?;
            }
        }
        if let Some(wanted) = wanted {
            let names = clips.iter().map(|clip| clip.name.as_deref());
            return Ok(vec![super::named("clip", wanted, names, self.blame)?]);
        }
        let mut moved: HashSet<(usize, &str)> = HashSet::new();
        let mut played = Vec::new();
        for (index, clip) in clips.iter().enumerate() {
            let targets = || {
                let targets = clip.channels.iter().map(|channel| &channel.target);
                targets.filter_map(|target| Some((target.node?, target.path.as_str())))
            };
            if targets().any(|target| moved.contains(&target)) {
                let name = clip.name.clone().unwrap_or_default();
                self.notes.add("clips that are not played", || {
                    format!(
                        "the clip {index} `{name}` is not played: it moves what an earlier one moves"
                    )
                });
                continue;
            }
            moved.extend(targets());
            played.push(index);
        }
        Ok(played)
    }

    /// For each node of the file, whether one of `clips` moves it.
    pub(super) fn moved_by(&self, clips: &[usize]) -> Vec<bool> {
        let mut animated = vec![false; self.document.nodes.len()];
        let clips = clips.iter().map(|&clip| &self.document.animations[clip]);
        for target in clips.flat_map(|clip| &clip.channels).map(|it| &it.target) {
            if let (Some(node), Some(_)) = (target.node, property(&target.path)) {
                animated[node] = true;
            }
        }
        animated
    }

    /// Whether a clip moves `nodes[node]`, which exists.
    pub(super) fn is_animated(&self, node: usize) -> bool {
        self.animated[node]
    }

    /// Adds the tracks of the clip `index`. It repeats as a whole.
    pub(super) fn tracks(&mut self, index: usize) -> Result<(), ImportError> {
        let document = self.document;
        let clip = &document.animations[index];
        let here = |i: usize| format!("animations[{index}].channels[{i}]");
        let mut found = Vec::new();
        let mut seen = HashSet::new();
        for (i, channel) in clip.channels.iter().enumerate() {
            let target = &channel.target;
            let Some(node) = target.node.and_then(|node| self.node_of[node]) else {
                if target.path == "pointer" {
                    self.skip(index, "a property by its pointer");
                }
                continue;
            };
            let Some(property) = property(&target.path) else {
                self.skip(
                    index,
                    match target.path.as_str() {
                        "weights" => "the weights of morph targets",
                        _ => "an unknown property",
                    },
                );
                continue;
            };
            if !seen.insert((node, target.path.as_str())) {
                continue;
            }
            let has_matrix = target
                .node
                .is_some_and(|node| document.nodes[node].matrix.is_some());
            if has_matrix {
                self.notes.add("animated matrices", || {
                    format!("{}: the node has a matrix, which stays", here(i))
                });
            }
            let keys = self.keys(&clip.samplers[channel.sampler], property, &here(i))?;
            found.push((node, property, keys));
        }
        let span = found
            .iter()
            .map(|(.., keys)| (keys.times[0], keys.times[keys.times.len() - 1]));
        let span = span.reduce(|a, b| (a.0.min(b.0), a.1.max(b.1)));
        let (_, end) = span.unwrap_or_default();
        for (node, property, keys) in found {
            let curve = curve(keys, property, end);
            self.scene.tracks.push(Track {
                targets: vec![Target::Node(node, property)],
                curve,
            });
        }
        Ok(())
    }

    fn skip(&mut self, clip: usize, what: &str) {
        self.notes.add("animations that are not shown", || {
            format!("animations[{clip}] moves {what}, which is not shown")
        });
    }

    /// The keys of a sampler for `property`.
    fn keys(
        &mut self,
        sampler: &AnimationSampler,
        property: NodeProperty,
        here: &str,
    ) -> Result<Keys, ImportError> {
        let accessors = self.accessors();
        let place = format!("{here}.sampler.input");
        let times = accessors.vectors::<1>(sampler.input, &[Kind::Scalar], 0.0, &place)?;
        let mut times: Vec<f64> = times.iter().map(|[time]| f64::from(*time)).collect();
        let is_finite = times.iter().all(|time| time.is_finite());
        if times.is_empty() || !is_finite || times.windows(2).any(|pair| pair[0] > pair[1]) {
            return Err(self.blame.bad(place, "the times do not increase"));
        }
        let place = format!("{here}.sampler.output");
        let kind = match property {
            NodeProperty::Rotation => Kind::Vec4,
            _ => Kind::Vec3,
        };
        let values = accessors.vectors::<4>(sampler.output, &[kind], 0.0, &place)?;
        let per_key = match sampler.interpolation {
            Kinds::CubicSpline => 3,
            _ => 1,
        };
        if values.len() != per_key * times.len() {
            let why = format!("{} values for {} keys", values.len(), times.len());
            return Err(self.blame.bad(place, why));
        }
        if values.as_flattened().iter().any(|value| !value.is_finite()) {
            return Err(self.blame.bad(place, "a value is not finite"));
        }
        let size = budget::size::<f64>(times.len()) + budget::size::<[f64; 4]>(values.len());
        self.ledger.take(size, size, here)?;
        let mut values: Vec<[f64; 4]> = values.iter().map(|v| v.map(f64::from)).collect();
        // Of keys at the same time the last one counts.
        let is_last =
            |i: usize, times: &[f64]| times.get(i + 1).is_none_or(|next| times[i] < *next);
        let kept: Vec<usize> = (0..times.len()).filter(|&i| is_last(i, &times)).collect();
        if kept.len() < times.len() {
            let keys = kept.iter();
            values = keys
                .flat_map(|&i| values[per_key * i..per_key * (i + 1)].to_vec())
                .collect();
            times = kept.iter().map(|&i| times[i]).collect();
        }
        let interpolation = match sampler.interpolation {
            Kinds::Linear => Interpolation::Linear,
            Kinds::Step => Interpolation::Step,
            Kinds::CubicSpline => Interpolation::Hermite,
        };
        Ok(Keys {
            times,
            values,
            interpolation,
        })
    }
}

/// The curve through `keys`, with keys at 0 and at `end`, so that all curves of a clip repeat together.
/// Before its first key and after its last one, a curve is constant.
fn curve(mut keys: Keys, property: NodeProperty, end: f64) -> Curve {
    let is_cubic = keys.interpolation == Interpolation::Hermite;
    let last = keys.times.len() - 1;
    if keys.times.len() > 1 || keys.times[0] != end {
        let hold = |keys: &Keys, i: usize| match is_cubic {
            true => vec![[0.0; 4], keys.values[3 * i + 1], [0.0; 4]],
            false => vec![keys.values[i]],
        };
        if keys.times[last] < end {
            if is_cubic {
                keys.values[3 * last + 2] = [0.0; 4];
            }
            keys.values.extend(hold(&keys, last));
            keys.times.push(end);
        }
        if keys.times[0] > 0.0 {
            if is_cubic {
                keys.values[0] = [0.0; 4];
            }
            let first = hold(&keys, 0);
            keys.values.splice(0..0, first);
            keys.times.insert(0, 0.0);
        }
    }
    let vector = |v: &[f64; 4]| DVec3::new(v[0], v[1], v[2]);
    let is_key = |i: usize| !is_cubic || i % 3 == 1;
    let all = keys.values.iter();
    let values = match property {
        NodeProperty::Rotation => Values::Rotation(
            all.enumerate()
                .map(|(i, v)| match is_key(i) {
                    true => unit(DQuat::from_array(*v)).unwrap_or_default(),
                    false => DQuat::from_array(*v),
                })
                .collect(),
        ),
        NodeProperty::Scale => Values::Vector(
            all.enumerate()
                .map(|(i, v)| match (is_key(i), vector(v)) {
                    (true, DVec3::ZERO) => DVec3::splat(1e-6),
                    (true, scale) => extended(scale),
                    (false, tangent) => tangent,
                })
                .collect(),
        ),
        _ => Values::Vector(all.map(vector).collect()),
    };
    Curve {
        times: keys.times,
        values,
        interpolation: keys.interpolation,
        easing: Easing::None,
        beyond: Beyond::Repeat,
    }
}
