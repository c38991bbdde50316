//! The value types of a native scene. Each checks itself when it is read, so that errors have a position,
//! and describes itself for the JSON Schema.

mod either;
mod names;
mod spanned;
mod written;

pub(crate) use backdrop::BackdropValue;
pub(crate) use either::either;
pub(crate) use layers::{BodyIndex, Dispersion, FilmIndex, Thicknesses};
pub(crate) use moving::{
    Copies, Duration, FrameRate, GridCount, Pace, Quaternion, ScaleRange, Seed, Share,
    ShutterTimes, Time,
};
pub(crate) use names::words;
pub(crate) use names::{
    AntialiasName, AttenuationName, FilterName, FresnelName, IntegratorName, MixingName,
    ShadowsName, ToneName, TransferName,
};
pub(crate) use places::{AxisRadians, ConeAngle, ConeRadians, Matrix, Upwards, ViewRadians};
pub(crate) use spanned::Spanned;
pub(crate) use written::{Written, differing, or, short};

use crate::import::number::in_range;
use crate::import::picture::linear_from_srgb;
use crate::import::source::quote;
use glam::{DVec3, Vec3};
use schemars::{JsonSchema, Schema, SchemaGenerator, json_schema};
use serde::de::{self, Deserialize, Deserializer, SeqAccess, Visitor};
use serde::ser::{Serialize, Serializer};
use std::borrow::Cow;
use std::fmt;
use std::marker::PhantomData;
use std::ops::RangeInclusive;
use toml::Value;
use written::color;

struct NumberVisitor;

impl Visitor<'_> for NumberVisitor {
    type Value = f64;

    fn expecting(&self, f: &mut fmt::Formatter) -> fmt::Result {
        f.write_str("a number")
    }

    fn visit_i64<E: de::Error>(self, value: i64) -> Result<f64, E> {
        Ok(value as f64)
    }

    fn visit_u64<E: de::Error>(self, value: u64) -> Result<f64, E> {
        Ok(value as f64)
    }

    fn visit_f64<E: de::Error>(self, value: f64) -> Result<f64, E> {
        match value {
            value if in_range(value) => Ok(value),
            value if value.is_finite() => Err(E::custom(format!(
                "{value:e} is out of range: at most 3.4e38 is allowed"
            ))),
            _ => Err(E::custom(format!("{value} is not a finite number"))),
        }
    }
}

/// Reads `[a, b, …]` of exactly `N` elements.
struct Elements<T, const N: usize>(&'static str, PhantomData<T>);

impl<'de, T: Deserialize<'de>, const N: usize> Visitor<'de> for Elements<T, N> {
    type Value = [T; N];

    fn expecting(&self, f: &mut fmt::Formatter) -> fmt::Result {
        f.write_str(self.0)
    }

    fn visit_seq<A: SeqAccess<'de>>(self, mut seq: A) -> Result<[T; N], A::Error> {
        let mut elements = Vec::with_capacity(N);
        while let Some(element) = seq.next_element()? {
            elements.push(element);
            if elements.len() > N {
                break;
            }
        }
        elements.try_into().map_err(|wrong: Vec<T>| {
            let more = if wrong.len() > N { "more" } else { "fewer" };
            de::Error::custom(format!("expected {}, found {more}", self.0))
        })
    }
}

/// Exactly `N` elements, which `expected` describes.
pub(crate) fn elements<'de, T: Deserialize<'de>, const N: usize, D: Deserializer<'de>>(
    deserializer: D,
    expected: &'static str,
) -> Result<[T; N], D::Error> {
    deserializer.deserialize_seq(Elements(expected, PhantomData))
}

/// Defines a value type from its docs, the type that it wraps, its schema, the check, and how it is written if not as
/// the type that it wraps.
macro_rules! value {
    ($(#[doc = $doc:literal])* $name:ident($inner:ty), $schema:tt, $read:expr) => {
        value!($(#[doc = $doc])* $name($inner), $schema, $read, Written::written);
    };
    ($(#[doc = $doc:literal])* $name:ident($inner:ty), $schema:tt, $read:expr, $write:expr) => {
        $(#[doc = $doc])*
        #[derive(Clone, Copy, Debug)]
        pub(crate) struct $name(pub $inner);

        impl<'de> Deserialize<'de> for $name {
            fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
                let read: fn(D) -> Result<$inner, D::Error> = $read;
                read(deserializer).map(Self)
            }
        }

        impl Written for $name {
            fn written(&self) -> Value {
                let write: fn(&$inner) -> Value = $write;
                write(&self.0)
            }
        }

        impl Serialize for $name {
            fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
                self.written().serialize(serializer)
            }
        }

        impl PartialEq for $name {
            /// Zeros differ in their signs.
            fn eq(&self, other: &Self) -> bool {
                self.written() == other.written()
            }
        }

        impl JsonSchema for $name {
            fn schema_name() -> Cow<'static, str> {
                stringify!($name).into()
            }
            fn json_schema(_: &mut SchemaGenerator) -> Schema {
                json_schema!($schema)
            }
        }

        impl From<$inner> for $name {
            fn from(value: $inner) -> Self {
                Self(value)
            }
        }

        impl From<$name> for $inner {
            fn from(value: $name) -> Self {
                value.0
            }
        }
    };
}

/// Defines a number from its docs, its type, its least and its greatest value, and what it is in errors.
macro_rules! number {
    ($(#[doc = $doc:literal])* $name:ident($inner:ty), $least:expr, $most:expr, $wanted:literal) => {
        value! {
            $(#[doc = $doc])*
            $name($inner),
            { "type": "number", "minimum": $least, "maximum": $most },
            |d| number(d, |x| $name::range().contains(&x), $wanted).map(|x| x as $inner)
        }

        impl $name {
            /// The values that are read.
            pub fn range() -> std::ops::RangeInclusive<f64> {
                $least..=$most
            }
        }
    };
}

/// Defines a whole number from its docs, its type, and its least and its greatest value.
macro_rules! whole {
    ($(#[doc = $doc:literal])* $name:ident($inner:ty), $least:literal, $most:literal) => {
        value! {
            $(#[doc = $doc])*
            $name($inner),
            { "type": "integer", "minimum": $least, "maximum": $most },
            |d| read_whole(d, $least..=$most).map(|x| x as $inner)
        }
    };
}

// Below the macros, because they use them.
mod backdrop;
mod layers;
mod moving;
mod places;

/// One element for each corner of a triangle.
#[derive(Clone, Debug, serde::Serialize, JsonSchema)]
#[serde(transparent)]
#[schemars(inline)]
pub(crate) struct Triple<T>(pub [T; 3]);

impl<'de, T: Deserialize<'de>> Deserialize<'de> for Triple<T> {
    // By hand: serde's own arrays ignore surplus elements.
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        elements(deserializer, "three elements, one for each corner").map(Self)
    }
}

/// Reads a number for which `holds` is true; otherwise an error "is not WANTED".
fn number<'de, D: Deserializer<'de>>(
    deserializer: D,
    holds: fn(f64) -> bool,
    wanted: &str,
) -> Result<f64, D::Error> {
    match Number::deserialize(deserializer)?.0 {
        value if holds(value) => Ok(value),
        value => Err(de::Error::custom(format!(
            "{} is not {wanted}",
            shown(value)
        ))),
    }
}

/// Reads a whole number in `range`.
fn read_whole<'de, D: Deserializer<'de>>(
    deserializer: D,
    range: RangeInclusive<i64>,
) -> Result<i64, D::Error> {
    let value = Number::deserialize(deserializer)?.0;
    if value.fract() == 0.0 && range.contains(&(value as i64)) {
        return Ok(value as i64);
    }
    let (least, most) = range.into_inner();
    let wanted = format!("a whole number from {least} to {most}");
    Err(de::Error::custom(format!(
        "{} is not {wanted}",
        shown(value)
    )))
}

/// Whether a squared length is 1 within f64's rounding of a normalised vector.
fn is_unit(length_squared: f64) -> bool {
    (length_squared - 1.0).abs() <= 8.0 * f64::EPSILON
}

/// A number in the fewest digits that identify it.
fn shown(value: f64) -> String {
    if value == 0.0 || (1e-6..1e15).contains(&value.abs()) {
        value.to_string()
    } else {
        format!("{value:e}")
    }
}

value! {
    /// Any number in the range of f32, integer or not.
    Number(f64),
    { "type": "number" },
    |d| d.deserialize_f64(NumberVisitor)
}

value! {
    /// A length or exponent above 0.
    Positive(f64),
    { "type": "number", "exclusiveMinimum": 0 },
    |d| match number(d, |x| x > 0.0, "greater than 0")? {
        x if x >= f64::from(f32::MIN_POSITIVE) => Ok(x),
        x => Err(de::Error::custom(format!("{x:e} is out of range: at least 1.2e-38 is allowed"))),
    }
}

value! {
    /// A distance, 0 or more.
    Distance(f64),
    { "type": "number", "minimum": 0 },
    |d| number(d, |x| x >= 0.0, "0 or more")
}

number! {
    /// A number of pixels.
    Radius(f32), 0.01, 16.0, "between 0.01 and 16"
}

number! {
    /// A factor on a number of samples.
    Factor(f32), 0.001, 1000.0, "between 0.001 and 1000"
}

whole! {
    /// A number of corners.
    Corners(u32), 3, 64
}

value! {
    /// Width and height, above 0.
    Extent([f64; 2]),
    { "type": "array", "items": { "type": "number", "exclusiveMinimum": 0 }, "minItems": 2, "maxItems": 2 },
    |d| elements::<Positive, 2, D>(d, "two numbers [width, height]").map(|size| size.map(|side| side.0))
}

value! {
    /// Three radii, each greater than 0.
    Radii(DVec3),
    { "type": "array", "items": { "type": "number", "exclusiveMinimum": 0 }, "minItems": 3, "maxItems": 3 },
    |d| elements::<Positive, 3, D>(d, "three radii [x, y, z]").map(|radii| DVec3::from(radii.map(|x| x.0)))
}

value! {
    /// A number, 0 or more.
    NonNegative(f32),
    { "type": "number", "minimum": 0 },
    |d| number(d, |x| x >= 0.0, "0 or more").map(|x| x as f32)
}

number! {
    /// A fraction, 0 to 1.
    Fraction(f32), 0.0, 1.0, "between 0 and 1"
}

number! {
    /// An error threshold, above 0.
    Noise(f32), 1e-6, 1.0, "between 1e-6 and 1"
}

number! {
    /// An index of refraction.
    RefractiveIndex(f32), 0.01, 100.0, "an index of refraction between 0.01 and 100"
}

value! {
    /// Absorption per unit length: three numbers [r, g, b], 0 or more.
    Absorption(Vec3),
    { "type": "array", "items": { "type": "number", "minimum": 0, "maximum": 1e12 }, "minItems": 3, "maxItems": 3 },
    |d| {
        let absorption = Vector::deserialize(d)?.0;
        match absorption.to_array().iter().find(|&&x| !(0.0..=1e12).contains(&x)) {
            Some(x) => Err(de::Error::custom(format!("{x} in an absorption is not between 0 and 1e12"))),
            None => Ok(absorption.as_vec3()),
        }
    }
}

whole! {
    /// A priority, a whole number from -100 to 100.
    Priority(i32), -100, 100
}

number! {
    /// A number of photographic stops.
    Stops(f32), -32.0, 32.0, "between -32 and 32"
}

value! {
    /// A field of view in degrees.
    ViewAngle(f64),
    { "type": "number", "exclusiveMinimum": 0, "exclusiveMaximum": 180 },
    |d| number(d, |x| ViewAngle::range().contains(&x), "an angle between 0.001 and 179.999 degrees")
}

impl ViewAngle {
    /// The values that are read.
    pub fn range() -> RangeInclusive<f64> {
        1e-3..=179.999
    }
}

number! {
    /// An angle from an axis in degrees.
    AxisAngle(f64), 0.0, 90.0, "an angle between 0 and 90 degrees"
}

value! {
    /// Any number of degrees.
    Angle(f64),
    { "type": "number" },
    |d| number(d, |_| true, "an angle")
}

whole! {
    /// A whole number from 1 to 16.
    Octaves(u32), 1, 16
}

value! {
    /// Three numbers: x, y, z.
    Vector(DVec3),
    { "type": "array", "items": { "type": "number" }, "minItems": 3, "maxItems": 3 },
    |d| elements::<Number, 3, D>(d, "three numbers [x, y, z]").map(|v| DVec3::from(v.map(|x| x.0)))
}

value! {
    /// Three numbers that are not all 0: a direction of any length.
    Direction(DVec3),
    { "type": "array", "items": { "type": "number" }, "minItems": 3, "maxItems": 3 },
    |d| {
        let vector = Vector::deserialize(d)?.0;
        // A direction that is already normalised keeps all its digits.
        if is_unit(vector.length_squared()) {
            return Ok(vector);
        }
        vector.try_normalize().ok_or_else(|| de::Error::custom("a direction cannot be [0, 0, 0]"))
    }
}

value! {
    /// A scale factor for all axes, or one for each. Negative factors mirror.
    Scale(DVec3),
    { "oneOf": [
        { "type": "number", "not": { "const": 0 } },
        { "type": "array", "items": { "type": "number", "not": { "const": 0 } }, "minItems": 3, "maxItems": 3 }
    ] },
    |d| {
        let scale = DVec3::from(NumberOrVector::deserialize(d)?);
        let is_flat = scale.abs().min_element() < f64::from(f32::MIN_POSITIVE);
        if is_flat { Err(de::Error::custom("a scale cannot be 0")) } else { Ok(scale) }
    },
    |scale| match scale.to_array().map(f64::to_bits) {
        [x, y, z] if x == y && y == z => scale.x.written(),
        _ => scale.written(),
    }
}

value! {
    /// A linear Rec. 709 colour as three numbers [r, g, b], 0 or more, or an sRGB colour as "#rrggbb".
    Color(Vec3),
    { "oneOf": [
        { "type": "array", "items": { "type": "number", "minimum": 0 }, "minItems": 3, "maxItems": 3 },
        { "type": "string", "pattern": "^#[0-9A-Fa-f]{6}$" }
    ] },
    |d| d.deserialize_any(ColorVisitor),
    color
}

value! {
    /// Width and height in pixels.
    Size([u32; 2]),
    { "type": "array", "items": { "type": "integer", "minimum": 1, "maximum": 65536 }, "minItems": 2, "maxItems": 2 },
    |d| elements::<Count, 2, D>(d, "two numbers [width, height]").map(|size| size.map(|count| count.0))
}

whole! {
    /// A whole number from 0 to 1000.
    Bounces(u32), 0, 1000
}

whole! {
    /// A whole number from 1 to 65536.
    Count(u32), 1, 65536
}

either! {
    /// Three numbers, or one for all three.
    NumberOrVector { Number(Number), Vector(Vector) },
    "a number or [x, y, z]",
    number: Number, seq: Vector
}

impl From<NumberOrVector> for DVec3 {
    fn from(value: NumberOrVector) -> Self {
        match value {
            NumberOrVector::Number(number) => Self::splat(number.0),
            NumberOrVector::Vector(vector) => vector.0,
        }
    }
}

struct ColorVisitor;

impl<'de> Visitor<'de> for ColorVisitor {
    type Value = Vec3;

    fn expecting(&self, f: &mut fmt::Formatter) -> fmt::Result {
        f.write_str("a colour: [r, g, b] or \"#rrggbb\"")
    }

    fn visit_str<E: de::Error>(self, text: &str) -> Result<Vec3, E> {
        let digits = text.strip_prefix('#').filter(|digits| digits.len() == 6);
        let code = digits.filter(|digits| digits.bytes().all(|b| b.is_ascii_hexdigit()));
        let code = code
            .and_then(|digits| u32::from_str_radix(digits, 16).ok())
            .ok_or_else(|| {
                let quoted = quote(text.as_bytes());
                E::custom(format!(
                    "{quoted} is not a colour: write \"#rrggbb\" or [r, g, b]"
                ))
            })?;
        let channel = |shift: u32| linear_from_srgb(((code >> shift) & 0xff) as f64 / 255.0) as f32;
        Ok(Vec3::new(channel(16), channel(8), channel(0)))
    }

    fn visit_seq<A: SeqAccess<'de>>(self, seq: A) -> Result<Vec3, A::Error> {
        let expected = "three numbers [r, g, b]";
        let color = Elements::<Number, 3>(expected, PhantomData)
            .visit_seq(seq)?
            .map(|x| x.0);
        match color.iter().find(|&&x| x < 0.0) {
            Some(x) => Err(de::Error::custom(format!("{x} in a colour is negative"))),
            None => Ok(DVec3::from(color).as_vec3()),
        }
    }
}
