//! Where curves have keys, and how fast they turn.

use super::{MAX_KEYS, moment};
use crate::frame::rotation_from;
use crate::{Beyond, Curve, Easing, Interpolation, Value};
use glam::DVec3;

impl Curve {
    /// Whether the curve has constant velocity between two keys, possibly 0.
    fn is_even(&self) -> bool {
        match self.interpolation {
            Interpolation::Step => true,
            Interpolation::Linear => self.easing == Easing::None,
            Interpolation::CatmullRom | Interpolation::Hermite => false,
        }
    }

    /// Whether the curve may jump between `open` and `close`.
    pub(super) fn jumps_within(&self, open: f64, close: f64) -> bool {
        (self.interpolation == Interpolation::Step || self.beyond == Beyond::Repeat)
            && (self.keys_within(open, close)).is_some_and(|keys| !keys.is_empty())
    }

    /// The times in (`open`, `close`) at which the curve passes a key, in any order; `None` if there are
    /// too many to examine.
    pub(super) fn keys_within(&self, open: f64, close: f64) -> Option<Vec<f64>> {
        let (first, last) = self.span();
        let period = last - first;
        let run = |time: f64| ((time - first) / period).floor();
        let (low, high) = match self.beyond {
            _ if period <= 0.0 => return Some(Vec::new()),
            Beyond::Hold => (0.0, 0.0),
            Beyond::Repeat | Beyond::PingPong => (run(open), run(close)),
        };
        let mut found = Vec::new();
        let are_few = high - low <= MAX_KEYS as f64;
        if !are_few {
            return None;
        }
        for i in 0..=(high - low) as u32 {
            let start = first + (low + f64::from(i)) * period;
            let is_back = self.beyond == Beyond::PingPong && (low + f64::from(i)) % 2.0 != 0.0;
            // From the curve's own times to times of this run.
            let at = |key: f64| start + if is_back { last - key } else { key - first };
            let from_run = |time: f64| {
                if is_back {
                    last - (time - start)
                } else {
                    time - start + first
                }
            };
            let (a, b) = (from_run(open), from_run(close));
            let begin = self.times.partition_point(|key| *key < a.min(b));
            let end = self.times.partition_point(|key| *key <= a.max(b));
            if end - begin + found.len() > MAX_KEYS {
                return None;
            }
            let keys = self.times[begin..end.max(begin)].iter().map(|key| at(*key));
            found.extend(keys.filter(|time| *time > open && *time < close));
        }
        Some(found)
    }

    /// The highest speed, in radians per second, of a curve of rotations or angles between `open` and
    /// `close`, ignoring jumps at keys.
    pub(super) fn fastest_turn(&self, open: f64, close: f64) -> Option<f64> {
        /// Number of samples between two keys if the speed varies.
        const PIECES: u32 = 16;
        let mut stops = self.keys_within(open, close)?;
        stops.extend([open, close]);
        stops.sort_unstable_by(f64::total_cmp);
        let count = if self.is_even() { 1 } else { PIECES };
        let mut fastest = 0.0_f64;
        for pair in stops.windows(2) {
            for i in 0..count {
                let (a, b) = (
                    moment(pair[0], pair[1], i, count),
                    moment(pair[0], pair[1], i + 1, count),
                );
                // Slightly inside, because the curve may jump at the end.
                let inset = (b - a) / 4096.0;
                let (a, b) = (a + inset, b - inset);
                let turn = match (self.at(a), self.at(b)) {
                    (Value::Rotation(a), Value::Rotation(b)) => angle_between(a, b),
                    (Value::Vector(a), Value::Vector(b)) => turn_between(a, b),
                    _ => 0.0,
                };
                let speed = turn / (b - a);
                if speed.is_finite() {
                    fastest = fastest.max(speed);
                }
            }
        }
        Some(fastest)
    }
}

/// The smaller angle between two rotations, in radians.
fn angle_between(a: glam::DQuat, b: glam::DQuat) -> f64 {
    let b = if a.dot(b) < 0.0 { -b } else { b };
    4.0 * (a - b).length().atan2((a + b).length())
}

/// Upper bound of the angle in radians between two triples of angles, which may be several turns; exact
/// for a turn about one axis. It is never less than the smaller angle between the two rotations.
fn turn_between(a: DVec3, b: DVec3) -> f64 {
    let way = b - a;
    let sum = way.abs().element_sum();
    sum.max(angle_between(rotation_from(a), rotation_from(b)))
}
