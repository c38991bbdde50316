//! The scene while the shutter is open: how many frames represent its motion.
//!
//! The renderer interpolates linearly between two frames, so frames must be close enough for the chord
//! between two states to approximate the true path. Comparing states misses a curve that returns to its
//! starting point in between. Rotation is therefore measured along the curves, from key to key, and
//! states are also compared at the keys.

mod speed;

use super::frame::Hierarchy;
use super::{
    Beyond, Camera, Curve, Frame, Light, LightKind, LightProperty, NodeProperty, NodeState, Scene,
    Target,
};
use glam::DVec3;

/// The shutter interval is divided into at most 2 to the power of this many intervals.
const MAX_DOUBLINGS: u32 = 8;

/// Largest rotation of a node between two frames, in radians.
const MAX_TURN: f64 = 0.1;

/// Largest rotation of the camera between two frames, in radians.
const MAX_CAMERA_TURN: f64 = 0.02;

/// Largest deviation of a chord, as a fraction of the distance from the camera.
const TOLERANCE: f64 = 1e-3;

/// Number of keys in the shutter interval that are examined one by one. With more, the largest number of
/// frames is used.
const MAX_KEYS: usize = 1024;

impl Scene {
    /// The scene while the shutter is open, from `open` to `close` in seconds: frames evenly spaced in
    /// time, the first at `open` and the last at `close`, close enough for linear interpolation. A single
    /// frame if nothing moves. Visibility, the lights' switches and materials keep the state they have
    /// when the shutter opens.
    ///
    /// There are 2ᵏ + 1 frames, with the smallest k ≤ 8 such that between two frames no node turns by
    /// more than 0.1 radians and the camera by no more than 0.02, assuming their highest speed in the
    /// interval throughout, and no chord deviates by more than
    /// * 10⁻³ of the distance from the camera for positions of nodes and lights, where nodes nearer than
    ///   a tenth of the camera's distance to its target count as that far away;
    /// * the sagitta of a turn by 0.1 radians for the axes of nodes and lights;
    /// * 10⁻³ of the camera's distance to its target for the camera's position;
    /// * 10⁻³ of that distance for what the weight of a morph target moves, taken as in world space;
    /// * 10⁻³ of their value for the field of view, the lens, and the colours of lights.
    ///
    /// Linear interpolation cannot represent a jump: a jump takes the largest number of frames and is
    /// spread over one interval. A jump at the very moment at which the shutter closes has not happened
    /// yet.
    pub fn motion_samples(&self, open: f64, close: f64) -> Vec<Frame> {
        let first = self.frame(open);
        let mut frames = vec![first];
        if close <= open {
            return frames;
        }
        let motion = Motion::new(self, open, close, &frames[0]);
        let close = motion.close;
        let Some(doublings) = motion.doublings() else {
            return frames;
        };
        let count = 1_u32 << doublings;
        frames.reserve(count as usize);
        for i in 1..=count {
            frames.push(self.frame_while(moment(open, close, i, count), open));
        }
        frames
    }
}

/// The time of frame `index` out of 0..=`count`.
fn moment(open: f64, close: f64, index: u32, count: u32) -> f64 {
    if index == count {
        close
    } else {
        open + (close - open) * (f64::from(index) / f64::from(count))
    }
}

/// A number or vector of a state, and the permitted interpolation error.
struct Probe {
    value: DVec3,
    tolerance: f64,
}

/// Everything that moves while the shutter is open.
struct Motion<'a> {
    scene: &'a Scene,
    hierarchy: Hierarchy<'a>,
    open: f64,
    close: f64,
    /// The nodes that move, parents first.
    nodes: Vec<usize>,
    camera: bool,
    /// The lights that tracks animate.
    lights: Vec<usize>,
    /// The weights of morph targets that tracks animate: the deformation, the target, and how far it moves
    /// a vertex.
    weights: Vec<(usize, usize, f64)>,
    /// The states of all nodes, initially those at the time when the shutter opens.
    states: Vec<NodeState>,
    /// The curves that cause the motion.
    curves: Vec<&'a Curve>,
}

impl<'a> Motion<'a> {
    fn new(scene: &'a Scene, open: f64, close: f64, first: &Frame) -> Self {
        let moves = |curve: &Curve| {
            let (start, end) = curve.span();
            let is_held = curve.beyond == Beyond::Hold && (close <= start || open >= end);
            !is_held && !curve.is_constant()
        };
        let hierarchy = Hierarchy::new(scene);
        let mut moving = vec![false; scene.nodes.len()];
        let mut lights = Vec::new();
        let mut weights = Vec::new();
        let mut camera = false;
        let mut curves = Vec::new();
        for track in scene.tracks.iter().filter(|track| moves(&track.curve)) {
            let mut counts = false;
            for target in &track.targets {
                counts |= match *target {
                    Target::Node(_, NodeProperty::Visible)
                    | Target::Light(_, LightProperty::On)
                    | Target::Material(..)
                    | Target::Layer(..)
                    | Target::Texture(..) => false,
                    Target::Node(index, _) => {
                        moving[index] = true;
                        true
                    }
                    Target::Light(index, _) => {
                        lights.push(index);
                        true
                    }
                    Target::Camera(index, _) => {
                        camera |= index == scene.camera_index;
                        index == scene.camera_index
                    }
                    Target::Weight(deformation, index) => {
                        let reach = scene.deformations[deformation].targets[index].reach();
                        weights.push((deformation, index, reach));
                        true
                    }
                };
            }
            if counts {
                curves.push(&track.curve);
            }
        }
        for (index, node) in scene.nodes.iter().enumerate() {
            moving[index] |= node.parent.is_some_and(|parent| moving[parent]);
        }
        let seen_by = &scene.cameras[scene.camera_index];
        let is_moving = |node: Option<usize>| node.is_some_and(|node| moving[node]);
        camera |= is_moving(seen_by.node) || is_moving(seen_by.target);
        lights.sort_unstable();
        lights.dedup();
        let just = 1e-9 * (close - open);
        let jumps = (curves.iter()).any(|curve| curve.jumps_within(close - just, close + just));
        Self {
            scene,
            hierarchy,
            open,
            close: if jumps { close - just } else { close },
            nodes: (0..moving.len()).filter(|&node| moving[node]).collect(),
            camera,
            lights,
            weights,
            states: first.nodes.clone(),
            curves,
        }
    }

    /// How often the interval must be halved; `None` if nothing moves.
    fn doublings(mut self) -> Option<u32> {
        if self.curves.is_empty() {
            return None;
        }
        let (Some(stops), Some(intervals)) = (self.stops(), self.intervals_by_turning()) else {
            return Some(MAX_DOUBLINGS);
        };
        let mut doublings = 0;
        while doublings < MAX_DOUBLINGS && f64::from(1_u32 << doublings) < intervals {
            doublings += 1;
        }
        while doublings < MAX_DOUBLINGS && !self.is_approximated_by(1 << doublings, &stops) {
            doublings += 1;
        }
        (doublings > 0 || self.differs(&stops)).then_some(doublings)
    }

    /// The times of all curves' keys, in ascending order; `None` if there are too many.
    fn stops(&self) -> Option<Vec<f64>> {
        let mut stops = Vec::new();
        for curve in &self.curves {
            stops.extend(curve.keys_within(self.open, self.close)?);
            stops.sort_unstable_by(f64::total_cmp);
            stops.dedup();
            if stops.len() > MAX_KEYS {
                return None;
            }
        }
        Some(stops)
    }

    /// Number of intervals that rotation requires: the largest turn of a node, including its ancestors'
    /// turns, over the shutter interval, assuming each one's highest speed throughout.
    fn intervals_by_turning(&self) -> Option<f64> {
        let mut turns = vec![0.0; self.scene.nodes.len()];
        for &index in &self.nodes {
            let above = self.scene.nodes[index]
                .parent
                .map_or(0.0, |parent| turns[parent]);
            let mut own = 0.0_f64;
            for (_, property, curve) in self.hierarchy.curves_of(index) {
                if matches!(property, NodeProperty::Rotation | NodeProperty::Angles) {
                    own = own.max(curve.fastest_turn(self.open, self.close)?);
                }
            }
            turns[index] = above + own * (self.close - self.open);
        }
        let camera = &self.scene.cameras[self.scene.camera_index];
        let camera_turn = camera.node.map_or(0.0, |node| turns[node]);
        let node_turn = turns.into_iter().fold(0.0, f64::max);
        // Subtract what rounding may have added to a turn that fits exactly.
        Some((node_turn / MAX_TURN).max(camera_turn / MAX_CAMERA_TURN) * (1.0 - 1e-9))
    }

    /// Whether the chords over `count` equal intervals stay within their tolerances. States are compared
    /// at each quarter of an interval and at the keys in it.
    fn is_approximated_by(&mut self, count: u32, stops: &[f64]) -> bool {
        let mut from = self.probes(self.open);
        let mut start = self.open;
        for i in 1..=count {
            let end = moment(self.open, self.close, i, count);
            let to = self.probes(end);
            let keys = {
                let first = stops.partition_point(|key| *key <= start);
                let last = stops.partition_point(|key| *key < end);
                &stops[first.min(last)..last]
            };
            let quarters = [0.25, 0.5, 0.75].map(|fraction| start + (end - start) * fraction);
            for &time in quarters.iter().chain(keys) {
                let fraction = (time - start) / (end - start);
                for (probe, (from, to)) in self.probes(time).iter().zip(from.iter().zip(&to)) {
                    let chord = from.value + (to.value - from.value) * fraction;
                    let rounding = 1e-12 * probe.value.length();
                    // Also false for NaN, which no chord can approximate.
                    let is_near = chord.distance(probe.value) <= probe.tolerance + rounding;
                    if !is_near {
                        return false;
                    }
                }
            }
            (from, start) = (to, end);
        }
        true
    }

    /// Whether any state while the shutter is open differs from the first one.
    fn differs(&mut self, stops: &[f64]) -> bool {
        let (open, close) = (self.open, self.close);
        let first = self.probes(open);
        let moments = [1, 2, 3, 4].map(|i| moment(open, close, i, 4));
        (moments.iter().chain(stops)).any(|&time| {
            let probes = self.probes(time);
            probes.iter().zip(&first).any(|(a, b)| a.value != b.value)
        })
    }

    /// Probes of everything that moves, at one time.
    fn probes(&mut self, time: f64) -> Vec<Probe> {
        for &index in &self.nodes {
            self.states[index] = self.hierarchy.state(index, &self.states, time, self.open);
        }
        let camera = self.scene.camera_at(time, &self.states);
        let reach = camera.look_from.distance(camera.look_at);
        let from_camera = |p: DVec3| TOLERANCE * camera.look_from.distance(p).max(0.1 * reach);
        let mut probes = Vec::new();
        for &index in &self.nodes {
            let place = self.states[index].world_from_node;
            let origin = place.translation;
            probes.push(Probe::new(origin, from_camera(origin)));
            for axis in [
                place.matrix3.x_axis,
                place.matrix3.y_axis,
                place.matrix3.z_axis,
            ] {
                probes.push(Probe::axis(axis, MAX_TURN));
            }
        }
        if self.camera {
            probes.extend(camera_probes(&camera));
        }
        if !self.weights.is_empty() {
            let weights = self.scene.weights_at(time);
            for &(deformation, index, distance) in &self.weights {
                let moved = distance * weights[deformation][index];
                probes.push(Probe::new(DVec3::splat(moved), TOLERANCE * reach));
            }
        }
        if !self.lights.is_empty() {
            let lights = self.scene.lights_at(time, self.open, &self.states);
            for &index in &self.lights {
                light_probes(&lights[index], from_camera, &mut probes);
            }
        }
        probes
    }
}

impl Probe {
    fn new(value: DVec3, tolerance: f64) -> Self {
        Self { value, tolerance }
    }

    /// A probe that may deviate by the sagitta of an arc of `turn` radians.
    fn axis(value: DVec3, turn: f64) -> Self {
        let sagitta = 1.0 - (turn / 2.0).cos();
        Self::new(value, sagitta * value.length())
    }

    /// A probe that may deviate by a fraction of its own length.
    fn size(value: DVec3) -> Self {
        Self::new(value, TOLERANCE * value.length())
    }
}

fn camera_probes(camera: &Camera) -> Vec<Probe> {
    let forward = camera.look_at - camera.look_from;
    let right = forward.cross(camera.up).normalize_or_zero();
    let mut probes = vec![
        Probe::new(camera.look_from, TOLERANCE * forward.length()),
        Probe::axis(forward.normalize_or_zero(), MAX_CAMERA_TURN),
        Probe::axis(right, MAX_CAMERA_TURN),
        Probe::size(DVec3::splat(
            (camera.orthographic_height).unwrap_or_else(|| (camera.fov_y / 2.0).tan()),
        )),
    ];
    if let Some(lens) = camera.lens {
        probes.push(Probe::size(DVec3::splat(lens.focus_distance)));
        probes.push(Probe::size(DVec3::splat(lens.radius)));
    }
    probes
}

fn light_probes(light: &Light, from_camera: impl Fn(DVec3) -> f64, probes: &mut Vec<Probe>) {
    let mut place = |p: DVec3| probes.push(Probe::new(p, from_camera(p)));
    match light.kind {
        LightKind::Point { position } | LightKind::Spot { position, .. } => place(position),
        LightKind::Directional { .. } => {}
        LightKind::Rectangle { center, .. }
        | LightKind::Disc { center, .. }
        | LightKind::Sphere { center, .. } => place(center),
    }
    let axis = match light.kind {
        LightKind::Directional { direction } | LightKind::Spot { direction, .. } => direction,
        LightKind::Disc { normal, .. } => normal,
        _ => DVec3::ZERO,
    };
    probes.push(Probe::axis(axis, MAX_TURN));
    probes.push(Probe::size(light.color.as_dvec3()));
}
