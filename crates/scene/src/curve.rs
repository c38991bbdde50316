//! Evaluation of curves.

use super::{Beyond, Curve, Easing, Interpolation, Values};
use glam::{DQuat, DVec3};
use std::ops::{Add, Mul, Sub};

/// How far behind the end of a repeating curve the end still counts, relative to the time since the start.
const END_TOLERANCE: f64 = 2e-7;

/// The value of a [`Curve`] at one time.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Value {
    /// A value of [`Values::Scalar`].
    Scalar(f64),
    /// A value of [`Values::Vector`].
    Vector(DVec3),
    /// A value of [`Values::Rotation`], of unit length.
    Rotation(DQuat),
}

impl Curve {
    /// The value at `time` seconds, any finite number. At a key's time it is exactly that key's value, also at
    /// the end of a curve that repeats, where the last key and the first one meet.
    ///
    /// A cubic of rotations interpolates the quaternions' components and normalises the result, as in
    /// glTF 2.0 (section 3.11, appendix C.5). [`Interpolation::CatmullRom`] first flips signs so that
    /// each quaternion is near its neighbour, which makes it follow the shorter path.
    pub fn at(&self, time: f64) -> Value {
        match &self.values {
            Values::Scalar(values) => Value::Scalar(self.value(values, time)),
            Values::Vector(values) => Value::Vector(self.value(values, time)),
            Values::Rotation(values) => Value::Rotation(self.value(values, time)),
        }
    }

    /// The times of the first and the last key.
    pub fn span(&self) -> (f64, f64) {
        (self.times[0], self.times[self.times.len() - 1])
    }

    /// Whether its value is the same at all times.
    pub fn is_constant(&self) -> bool {
        match &self.values {
            Values::Scalar(values) => self.is_flat(values),
            Values::Vector(values) => self.is_flat(values),
            Values::Rotation(values) => self.is_flat(values),
        }
    }

    fn is_flat<V: Blend>(&self, values: &[V]) -> bool {
        let still = |tangent: V| tangent + tangent == tangent;
        match self.interpolation {
            Interpolation::Hermite => (values.chunks_exact(3))
                .all(|key| key[1] == values[1] && still(key[0]) && still(key[2])),
            _ => values.iter().all(|key| *key == values[0]),
        }
    }

    /// The time between the first and the last key that corresponds to `time`.
    pub(super) fn clock(&self, time: f64) -> f64 {
        let (first, last) = self.span();
        let is_within = (first..last).contains(&time);
        if is_within || first >= last {
            return time.clamp(first, last);
        }
        let period = last - first;
        let after = time - first;
        let clock = match self.beyond {
            Beyond::Hold => time,
            Beyond::Repeat => {
                let rest = after.rem_euclid(period);
                // Keys in files have the precision of f32, so that the frame at the end may miss the last key.
                match after > 0.0 && rest < END_TOLERANCE * after {
                    true => last,
                    false => first + rest,
                }
            }
            Beyond::PingPong => {
                let there = after.rem_euclid(2.0 * period);
                first + there.min(2.0 * period - there)
            }
        };
        // Very far from 0, times have lost all precision and the remainder may be NaN.
        if clock.is_nan() {
            first
        } else {
            clock.clamp(first, last)
        }
    }

    fn value<V: Blend>(&self, values: &[V], time: f64) -> V {
        let key = |i: usize| match self.interpolation {
            Interpolation::Hermite => values[3 * i + 1],
            _ => values[i],
        };
        let count = self.times.len();
        if count == 1 {
            return key(0);
        }
        let time = self.clock(time);
        let after = self.times.partition_point(|key| *key <= time);
        let index = after.clamp(1, count - 1) - 1;
        let (start, end) = (self.times[index], self.times[index + 1]);
        let fraction = fraction(start, end, time);
        if fraction <= 0.0 {
            return key(index);
        }
        if fraction >= 1.0 {
            return key(index + 1);
        }

        let (from, to) = (key(index), key(index + 1));
        let length = end - start;
        match self.interpolation {
            Interpolation::Step => from,
            Interpolation::Linear => from.mix(to, self.easing.way(fraction)),
            Interpolation::CatmullRom => {
                let to = to.near(from);
                let [leave, reach] = self.parabolic_tangents(values, index, [from, to]);
                cubic(from, leave * length, reach * length, to, fraction)
            }
            Interpolation::Hermite => {
                let (leave, reach) = (values[3 * index + 2], values[3 * index + 3]);
                cubic(from, leave * length, reach * length, to, fraction)
            }
        }
    }

    /// The tangents at both ends of the piece from key `index` to the next, whose values are `ends`.
    fn parabolic_tangents<V: Blend>(&self, keys: &[V], index: usize, ends: [V; 2]) -> [V; 2] {
        let times = &self.times;
        let last = keys.len() - 1;
        let goes_on = self.beyond == Beyond::Repeat && keys[0].is_same(keys[last]);
        let length = times[index + 1] - times[index];
        let slope = (ends[1] - ends[0]) * (1.0 / length);
        // The tangent at `end` of the parabola through `end`, its neighbour in this piece, and the key
        // beyond, which is `gap` away and reached with slope `other`.
        let tangent = |gap: f64, other: V| {
            let blend = length / (length + gap);
            other * blend + slope * (1.0 - blend)
        };
        let before = match index {
            0 if goes_on => Some(last - 1),
            _ => index.checked_sub(1),
        };
        let before = before.map(|i| {
            let gap = times[i + 1] - times[i];
            tangent(gap, (ends[0] - keys[i].near(ends[0])) * (1.0 / gap))
        });
        let after = match index + 2 {
            i if i > last => goes_on.then_some(1),
            i => Some(i),
        };
        let after = after.map(|i| {
            let gap = times[i] - times[i - 1];
            tangent(gap, (keys[i].near(ends[1]) - ends[1]) * (1.0 / gap))
        });
        // Without a key beyond, continue the parabola of the other end.
        match (before, after) {
            (Some(before), Some(after)) => [before, after],
            (Some(before), None) => [before, slope * 2.0 - before],
            (None, Some(after)) => [slope * 2.0 - after, after],
            (None, None) => [slope; 2],
        }
    }
}

/// The fraction of the time from `start` to `end` that has passed at `time`.
fn fraction(start: f64, end: f64, time: f64) -> f64 {
    let length = end - start;
    if length.is_finite() {
        (time - start) / length
    } else {
        (time / 2.0 - start / 2.0) / (end / 2.0 - start / 2.0)
    }
}

/// Cubic Hermite interpolation from the end points and the tangents there, in units of the piece's
/// length.
fn cubic<V: Blend>(from: V, leave: V, reach: V, to: V, fraction: f64) -> V {
    let s = fraction;
    let rest = 1.0 - s;
    let bend = leave * (s * rest * rest) - reach * (s * s * rest);
    let value = from + (to - from) * (s * s * (3.0 - 2.0 * s)) + bend;
    // Large tangents may overflow.
    value.validated().unwrap_or_else(|| from.mix(to, fraction))
}

impl Easing {
    /// Progress after `fraction` of the time, which is in [0, 1].
    pub fn way(self, fraction: f64) -> f64 {
        let Self::Bezier([x1, y1, x2, y2]) = self else {
            return fraction;
        };
        let (x1, x2) = (x1.clamp(0.0, 1.0), x2.clamp(0.0, 1.0));
        let at = |a: f64, b: f64, s: f64| {
            let rest = 1.0 - s;
            3.0 * rest * rest * s * a + 3.0 * rest * s * s * b + s * s * s
        };
        // x is monotonic. Newton's method, with bisection where a step leaves the bracket.
        let (mut low, mut high, mut s) = (0.0, 1.0, fraction);
        for _ in 0..100 {
            let error = at(x1, x2, s) - fraction;
            if error == 0.0 {
                break;
            }
            *(if error > 0.0 { &mut high } else { &mut low }) = s;
            let rest = 1.0 - s;
            let slope = 3.0 * (rest * rest * x1 + 2.0 * rest * s * (x2 - x1) + s * s * (1.0 - x2));
            let newton = s - error / slope;
            let next = if newton > low && newton < high {
                newton
            } else {
                low.midpoint(high)
            };
            if next == s {
                break;
            }
            s = next;
        }
        at(y1, y2, s)
    }
}

/// Values that can be interpolated.
trait Blend:
    Copy + PartialEq + Add<Output = Self> + Sub<Output = Self> + Mul<f64, Output = Self>
{
    /// Linear, or at constant speed along an arc; `fraction` may lie outside [0, 1].
    fn mix(self, to: Self, fraction: f64) -> Self;

    /// The value in the representation nearer to `other`, if there are two equivalent ones.
    fn near(self, _other: Self) -> Self {
        self
    }

    /// Whether two values are equivalent.
    fn is_same(self, other: Self) -> bool {
        self == other
    }

    /// The value, if it is valid.
    fn validated(self) -> Option<Self>;
}

impl Blend for f64 {
    fn mix(self, to: Self, fraction: f64) -> Self {
        let value = self + (to - self) * fraction;
        value.validated().unwrap_or_else(|| {
            // The difference between the ends may overflow.
            (self * (1.0 - fraction) + to * fraction).clamp(f64::MIN, f64::MAX)
        })
    }

    fn validated(self) -> Option<Self> {
        self.is_finite().then_some(self)
    }
}

impl Blend for DVec3 {
    fn mix(self, to: Self, fraction: f64) -> Self {
        let mix = |i: usize| self[i].mix(to[i], fraction);
        Self::new(mix(0), mix(1), mix(2))
    }

    fn validated(self) -> Option<Self> {
        self.is_finite().then_some(self)
    }
}

impl Blend for DQuat {
    /// Shoemake's slerp (1985) along the shorter arc. Kahan's formula gives the angle accurately, also
    /// when it is small.
    fn mix(self, to: Self, fraction: f64) -> Self {
        let to = to.near(self);
        let angle = 2.0 * (to - self).length().atan2((to + self).length());
        let mixed = if angle < 1e-9 {
            self + (to - self) * fraction
        } else {
            (self * ((1.0 - fraction) * angle).sin() + to * (fraction * angle).sin())
                * angle.sin().recip()
        };
        mixed.validated().unwrap_or(self)
    }

    fn near(self, other: Self) -> Self {
        if self.dot(other) < 0.0 { -self } else { self }
    }

    fn is_same(self, other: Self) -> bool {
        (self.near(other) - other).length_squared() < 1e-20
    }

    fn validated(self) -> Option<Self> {
        let length = self.length();
        (length.is_finite() && length > 1e-9).then(|| self * length.recip())
    }
}
