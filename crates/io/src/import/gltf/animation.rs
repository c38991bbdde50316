//! Clips (section 3.11 of the specification): tracks of what they move.

use super::Reader;
use super::aim::{Aim, Values as ValueKind, map_of};
use super::document::{AnimationSampler, ChannelTarget, Interpolation as Kinds, Kind};
use super::map_kinds::all_maps;
use super::maps;
use super::node_transform::{extended, unit};
use crate::import::budget;
use crate::import::error::ImportError;
use crate::import::source::quote_up_to;
use glam::{DQuat, DVec3};
use glimray_scene::text::one_line;
use glimray_scene::{
    Beyond, Curve, Easing, Interpolation, LightProperty, NodeProperty, Target, TextureProperty,
    Track, Values,
};
use std::collections::HashSet;

/// The values of a sampler: one per key, or with tangents three.
struct Keys {
    times: Vec<f64>,
    values: Vec<[f64; 4]>,
    interpolation: Interpolation,
}

impl Reader<'_> {
    /// The clips to play: the one that `wanted` names, by its name or number, or else all, except those
    /// that move what an earlier one moves.
    ///
    /// # Errors
    /// There is no clip of that name.
    pub(super) fn clips(&mut self, wanted: Option<&str>) -> Result<Vec<usize>, ImportError> {
        let document = self.document;
        let clips = &document.animations;
        if let Some(wanted) = wanted {
            let names = clips.iter().map(|clip| clip.name.as_deref());
            return Ok(vec![super::named("clip", wanted, names, self.blame)?]);
        }
        let mut moved: HashSet<Aim> = HashSet::new();
        let mut played = Vec::new();
        for (index, clip) in clips.iter().enumerate() {
            let targets = || {
                let channels = clip.channels.iter();
                channels.filter_map(|channel| Aim::of(&channel.target))
            };
            if targets().any(|target| moved.contains(&target)) {
                let name = clip.name.clone().unwrap_or_default();
                self.scene.remarks.push(one_line(&format!(
                    "the clip {index} `{name}` is not played: it moves what an earlier one moves"
                )));
                continue;
            }
            moved.extend(targets());
            played.push(index);
        }
        Ok(played)
    }

    /// Finds the nodes of the file that `clips` move or hide, and those whose morph targets they blend.
    pub(super) fn find_moved(&mut self, clips: &[usize]) {
        let document = self.document;
        let nodes = &document.nodes;
        for list in [&mut self.animated, &mut self.scaled, &mut self.morphed] {
            *list = vec![false; nodes.len()];
        }
        let clips = clips.iter().map(|&clip| &document.animations[clip]);
        for channel in clips.flat_map(|clip| &clip.channels) {
            let aim = Aim::of(&channel.target);
            match aim.filter(|aim| self.check_aim(*aim, "").is_ok()) {
                Some(Aim::Node(node, property)) => {
                    self.animated[node] = true;
                    self.scaled[node] |= property == NodeProperty::Scale;
                }
                Some(Aim::Map(material, map, _)) => {
                    let found = map_of(&document.materials[material], map);
                    self.moved_maps
                        .extend(found.map(|info| (std::ptr::from_ref(info), None)));
                }
                Some(Aim::WeightsOfNode(node)) => self.morphed[node] = true,
                Some(Aim::WeightsOfMesh(mesh)) => {
                    for (morphed, node) in self.morphed.iter_mut().zip(nodes) {
                        *morphed |= node.mesh == Some(mesh) && node.weights.is_none();
                    }
                }
                _ => {}
            }
        }
    }

    /// Adds the tracks of the clip `index`. It repeats as a whole.
    pub(super) fn tracks(&mut self, index: usize) -> Result<(), ImportError> {
        let document = self.document;
        let clip = &document.animations[index];
        let here = |i: usize| format!("animations[{index}].channels[{i}]");
        let aims: HashSet<Aim> = (clip.channels.iter())
            .filter_map(|channel| Aim::of(&channel.target))
            .collect();
        let is_lit = |light| aims.contains(&Aim::Light(light, LightProperty::Intensity));
        let mut found = Vec::new();
        let mut seen = HashSet::new();
        for (i, channel) in clip.channels.iter().enumerate() {
            let target = &channel.target;
            let Some(aim) = Aim::of(target) else {
                match target.node {
                    None if target.path != "pointer" => {
                        let place = here(i);
                        self.notes.add("animations that are not shown", || {
                            format!("{place} moves nothing: its target has no node")
                        });
                    }
                    _ => self.skip(index, &described(target)),
                }
                continue;
            };
            let place = here(i);
            if !seen.insert(aim) {
                self.notes.add("animations that are not shown", || {
                    format!("{place} moves what an earlier channel of its clip moves")
                });
                continue;
            }
            let exists = self.check_aim(aim, &place);
            let sampler = self
                .blame
                .get(&clip.samplers, channel.sampler, "samplers", &place);
            let found_sampler = exists.and(sampler);
            let Some(sampler) = self.spared(found_sampler)? else {
                continue;
            };
            if let Aim::Node(node, _) = aim
                && document.nodes[node].matrix.is_some()
            {
                self.notes.add("animated matrices", || {
                    format!("{}: the node has a matrix, which stays", here(i))
                });
            }
            let mut deformations = self.deformations_of(aim);
            if let Aim::WeightsOfMesh(_) = aim {
                let node = |it: usize| Aim::WeightsOfNode(self.deforming[it].0);
                deformations.retain(|&it| !aims.contains(&node(it)));
            }
            let width = (deformations.iter())
                .map(|&it| self.scene.deformations[it].targets.len())
                .max();
            match self.targets(aim, is_lit) {
                Err(what) => self.skip(index, what),
                Ok(targets) if !targets.is_empty() => {
                    let keys = self.keys(sampler, aim.kind(), 1, &place);
                    let Some(mut keys) = self.spared(keys)? else {
                        continue;
                    };
                    let alphas = self.alphas(aim);
                    if let (false, Some(keys)) = (alphas.is_empty(), keys.last()) {
                        found.push((alphas, ValueKind::Scalar, keys.of_last()));
                    }
                    found.extend(keys.pop().map(|keys| (targets, aim.values(), keys)));
                }
                Ok(_) => {
                    let Some(width) = width.filter(|width| *width > 0) else {
                        if self.lacks_targets(aim) {
                            let what = "the weights of a mesh without morph targets";
                            self.skip(index, what);
                        }
                        continue;
                    };
                    let all = self.keys(sampler, Kind::Scalar, width, &place);
                    let Some(all) = self.spared(all)? else {
                        continue;
                    };
                    for (k, keys) in all.into_iter().enumerate() {
                        let has = |it: &&usize| k < self.scene.deformations[**it].targets.len();
                        let targets = deformations.iter().filter(has);
                        let targets = targets.map(|&it| (Target::Weight(it, k), DVec3::ONE));
                        found.push((targets.collect(), ValueKind::Scalar, keys));
                    }
                }
            }
        }
        let ends = (found.iter()).map(|(.., keys)| keys.times[keys.times.len() - 1]);
        let end = ends.reduce(f64::max).unwrap_or_default();
        self.scene.clips[index].seconds = Some(end);
        for (targets, kind, keys) in found {
            let keys = keys.held_until(end);
            for alike in targets.chunk_by(|(_, a), (_, b)| a == b) {
                self.scene.tracks.push(Track {
                    targets: alike.iter().map(|(target, _)| *target).collect(),
                    curve: keys.curve(kind, alike[0].1),
                });
            }
        }
        Ok(())
    }

    /// Gives the transforms of maps that move in part the values of the file for the rest.
    pub(super) fn hold_maps(&mut self) {
        let moved = self.moved_maps.iter();
        let mut moved: Vec<_> = moved
            .filter_map(|(info, texture)| Some(((*texture)?, *info)))
            .collect();
        moved.sort_unstable();
        for (texture, info) in moved {
            let maps = self.document.materials.iter().flat_map(all_maps);
            let mut maps = maps.map(|(_, own)| own);
            let Some(info) = maps.find(|own| std::ptr::eq(*own, info)) else {
                continue;
            };
            let rest = maps::transform(info);
            for (property, values) in [
                (
                    TextureProperty::Offset,
                    Values::Vector(vec![rest.offset.extend(0.0)]),
                ),
                (
                    TextureProperty::Rotation,
                    Values::Scalar(vec![rest.rotation]),
                ),
                (
                    TextureProperty::Scale,
                    Values::Vector(vec![rest.scale.extend(1.0)]),
                ),
            ] {
                let target = Target::Texture(texture, property);
                if self
                    .scene
                    .tracks
                    .iter()
                    .any(|track| track.targets.contains(&target))
                {
                    continue;
                }
                self.scene.tracks.push(Track {
                    targets: vec![target],
                    curve: Curve {
                        times: vec![0.0],
                        values,
                        interpolation: Interpolation::Step,
                        easing: Easing::None,
                        beyond: Beyond::Hold,
                    },
                });
            }
        }
    }

    fn skip(&mut self, clip: usize, what: &str) {
        self.notes.add("animations that are not shown", || {
            format!("animations[{clip}] moves {what}, which is not shown")
        });
    }

    /// The keys of a sampler whose elements have this type; a list of each of `width` numbers that follow each
    /// other for each key.
    fn keys(
        &mut self,
        sampler: &AnimationSampler,
        kind: Kind,
        width: usize,
        here: &str,
    ) -> Result<Vec<Keys>, ImportError> {
        let accessors = self.accessors();
        let place = format!("{here}.sampler.input");
        let times = accessors.vectors::<1>(sampler.input, &[Kind::Scalar], 0.0, &place)?;
        let times: Vec<f64> = times.iter().map(|[time]| f64::from(*time)).collect();
        let is_finite = times.iter().all(|time| time.is_finite());
        if times.is_empty() || !is_finite || times.windows(2).any(|pair| pair[0] > pair[1]) {
            return Err(self.blame.bad(place, "the times do not increase"));
        }
        let place = format!("{here}.sampler.output");
        let values = accessors.vectors::<4>(sampler.output, &[kind], 0.0, &place)?;
        let per_key = match sampler.interpolation {
            Kinds::CubicSpline => 3,
            _ => 1,
        };
        if values.len() != per_key * times.len() * width {
            let why = match width {
                1 => format!("{} values for {} keys", values.len(), times.len()),
                _ => format!(
                    "{} values for {} keys of {width} morph targets",
                    values.len(),
                    times.len()
                ),
            };
            return Err(self.blame.bad(place, why));
        }
        if values.as_flattened().iter().any(|value| !value.is_finite()) {
            return Err(self.blame.bad(place, "a value is not finite"));
        }
        let size =
            budget::size::<[f64; 2]>(times.len() * width) + budget::size::<[f64; 4]>(values.len());
        self.ledger.take(size, 2 * size, here)?;
        // The last of several keys at one time counts.
        let is_last = |i: &usize| times.get(i + 1).is_none_or(|next| times[*i] < *next);
        let kept: Vec<usize> = (0..times.len()).filter(is_last).collect();
        let interpolation = match sampler.interpolation {
            Kinds::Linear => Interpolation::Linear,
            Kinds::Step => Interpolation::Step,
            Kinds::CubicSpline => Interpolation::Hermite,
        };
        let of = |k: usize| {
            let parts = kept
                .iter()
                .flat_map(|&i| (0..per_key).map(move |part| (i * per_key + part) * width + k));
            Keys {
                times: kept.iter().map(|&i| times[i]).collect(),
                values: parts.map(|at| values[at].map(f64::from)).collect(),
                interpolation,
            }
        };
        Ok((0..width).map(of).collect())
    }
}

/// The unknown property that a channel animates, for messages.
fn described(target: &ChannelTarget) -> String {
    let pointer = target
        .extensions
        .as_ref()
        .and_then(|it| it.pointer.as_ref());
    match pointer {
        Some(it) => quote_up_to(160, it.pointer.as_bytes()),
        None => "an unknown property".to_owned(),
    }
}

impl Keys {
    /// Adds keys at 0 and at `end` where there are none, so that all curves of a clip repeat together. Before its first
    /// key and after its last one, a curve is constant.
    fn held_until(mut self, end: f64) -> Self {
        let is_cubic = self.interpolation == Interpolation::Hermite;
        let last = self.times.len() - 1;
        if self.times.len() == 1 && self.times[0] == end {
            return self;
        }
        let hold = |keys: &Self, i: usize| match is_cubic {
            true => vec![[0.0; 4], keys.values[3 * i + 1], [0.0; 4]],
            false => vec![keys.values[i]],
        };
        if self.times[last] < end {
            if is_cubic {
                self.values[3 * last + 2] = [0.0; 4];
            }
            self.values.extend(hold(&self, last));
            self.times.push(end);
        }
        if self.times[0] > 0.0 {
            if is_cubic {
                self.values[0] = [0.0; 4];
            }
            let first = hold(&self, 0);
            self.values.splice(0..0, first);
            self.times.insert(0, 0.0);
        }
        self
    }

    /// Keys with the fourth component as their only one.
    fn of_last(&self) -> Self {
        Self {
            times: self.times.clone(),
            values: self.values.iter().map(|value| [value[3]; 4]).collect(),
            interpolation: self.interpolation,
        }
    }

    /// The curve through these keys, their values multiplied with `factor`. It repeats.
    fn curve(&self, kind: ValueKind, factor: DVec3) -> Curve {
        let is_cubic = self.interpolation == Interpolation::Hermite;
        let vector = |v: &[f64; 4]| DVec3::new(v[0], v[1], v[2]) * factor;
        let all = self.values.iter().enumerate();
        let all = all.map(|(i, v)| (!is_cubic || i % 3 == 1, v));
        let values = match kind {
            ValueKind::Rotation => Values::Rotation(
                all.map(|(is_key, v)| match is_key {
                    true => unit(DQuat::from_array(*v)).unwrap_or_default(),
                    false => DQuat::from_array(*v),
                })
                .collect(),
            ),
            ValueKind::Scale => Values::Vector(
                all.map(|(is_key, v)| match (is_key, vector(v)) {
                    (true, DVec3::ZERO) => DVec3::splat(1e-6),
                    (true, scale) => extended(scale),
                    (false, tangent) => tangent,
                })
                .collect(),
            ),
            ValueKind::Vector => Values::Vector(all.map(|(_, v)| vector(v)).collect()),
            ValueKind::Scalar => Values::Scalar(all.map(|(_, v)| v[0] * factor.x).collect()),
        };
        Curve {
            times: self.times.clone(),
            values,
            interpolation: self.interpolation,
            easing: Easing::None,
            beyond: Beyond::Repeat,
        }
    }
}
