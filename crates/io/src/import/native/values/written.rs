//! Values as they are written: in the fewest digits that preserve all bits.

use glam::{DAffine3, DQuat, DVec3, Vec3};
use glimray_scene::linear_from_srgb;
use toml::Value;

/// A value that is written as a single TOML value.
pub(crate) trait Written {
    /// The TOML value.
    fn written(&self) -> Value;
}

/// `value`, or `default` where a file gives none.
pub(crate) fn or<T, V: Into<T>>(value: Option<V>, default: T) -> T {
    value.map_or(default, Into::into)
}

/// `value` as a key of a file; none if that would be written as `default` is.
pub(crate) fn differing<T, V: From<T> + PartialEq>(value: T, default: T) -> Option<V> {
    let value = V::from(value);
    (value != V::from(default)).then_some(value)
}

/// The number with the fewest digits that is read as `value`.
pub(crate) fn short(value: f32) -> f64 {
    let short = value.to_string().parse().unwrap_or(f64::NAN);
    // The importer parses f64 and rounds to f32: the shortest f32 digits may round to a neighbour.
    match (short as f32).to_bits() == value.to_bits() {
        true => short,
        false => f64::from(value),
    }
}

impl Written for f64 {
    fn written(&self) -> Value {
        // Zero has a sign, integers do not.
        let is_zero = *self == 0.0 && self.is_sign_negative();
        match self.fract() == 0.0 && self.abs() < 1e16 && !is_zero {
            true => Value::Integer(*self as i64),
            false => Value::Float(*self),
        }
    }
}

impl Written for f32 {
    fn written(&self) -> Value {
        short(*self).written()
    }
}

macro_rules! integers {
    ($($kind:ty)*) => {
        $(impl Written for $kind {
            fn written(&self) -> Value {
                Value::Integer(*self as i64)
            }
        })*
    };
}

integers!(i32 u32 u64);

impl<T: Written> Written for [T] {
    fn written(&self) -> Value {
        Value::Array(self.iter().map(T::written).collect())
    }
}

impl<T: Written, const N: usize> Written for [T; N] {
    fn written(&self) -> Value {
        self.as_slice().written()
    }
}

impl Written for DVec3 {
    fn written(&self) -> Value {
        self.to_array().written()
    }
}

impl Written for Vec3 {
    fn written(&self) -> Value {
        self.to_array().written()
    }
}

impl Written for DQuat {
    fn written(&self) -> Value {
        self.to_array().written()
    }
}

impl Written for DAffine3 {
    fn written(&self) -> Value {
        let axes = self.matrix3;
        [axes.x_axis, axes.y_axis, axes.z_axis, self.translation].written()
    }
}

/// A colour: as "#rrggbb" if that is exact and shorter.
pub(crate) fn color(color: &Vec3) -> Value {
    let numbers = color.written();
    if numbers.to_string().len() <= 18 {
        return numbers;
    }
    let code = |channel: f32| {
        let linear = |code: &u8| linear_from_srgb(f64::from(*code) / 255.0) as f32;
        (0..=u8::MAX).find(|code| linear(code).to_bits() == channel.to_bits())
    };
    match color.to_array().map(code) {
        [Some(r), Some(g), Some(b)] => format!("#{r:02x}{g:02x}{b:02x}").into(),
        _ => numbers,
    }
}
