//! Value types for repetition and animation.

use super::*;
use glam::DQuat;
use glimray_scene::Easing;

/// Limit of the shutter's times, in frames from the frame's own time.
const MAX_FRAMES: f64 = 1000.0;

whole! {
    /// A number of copies, a whole number of 1 or more.
    Copies(u64), 1, 1_000_000_000
}

value! {
    /// Numbers of copies along x, y and z.
    GridCount([u64; 3]),
    { "type": "array", "items": { "type": "integer", "minimum": 1, "maximum": 1_000_000_000 }, "minItems": 3, "maxItems": 3 },
    |d| elements::<Copies, 3, D>(d, "three counts [x, y, z]").map(|count| count.map(|copies| copies.0))
}

whole! {
    /// A whole number from 0 to 4294967295.
    Seed(u64), 0, 4_294_967_295_i64
}

value! {
    /// The smallest and the largest factor of a range, each greater than 0.
    ScaleRange([f64; 2]),
    { "type": "array", "items": { "type": "number", "exclusiveMinimum": 0 }, "minItems": 2, "maxItems": 2 },
    |d| {
        let [least, most] = elements::<Positive, 2, D>(d, "two factors [smallest, largest]")?.map(|x| x.0);
        if least > most {
            return Err(de::Error::custom(format!("the smallest factor, {least}, exceeds the largest, {most}")));
        }
        Ok([least, most])
    }
}

number! {
    /// A time in seconds.
    Time(f64), -1e9, 1e9, "a time between -1e9 and 1e9 seconds"
}

number! {
    /// A length of time in seconds, above 0.
    Duration(f64), 1e-6, 1e9, "between 1e-6 and 1e9 seconds"
}

number! {
    /// Frames per second.
    FrameRate(f64), 0.001, 1000.0, "between 0.001 and 1000"
}

value! {
    /// A rotation as a quaternion x, y, z, w of length 1.
    Quaternion(DQuat),
    { "type": "array", "items": { "type": "number", "minimum": -1.001, "maximum": 1.001 }, "minItems": 4, "maxItems": 4 },
    |d| {
        let quaternion = DQuat::from_array(elements::<Number, 4, D>(d, "a quaternion [x, y, z, w]")?.map(|x| x.0));
        // A quaternion that is already normalised keeps all its digits.
        if is_unit(quaternion.length_squared()) {
            return Ok(quaternion);
        }
        let length = quaternion.length();
        // A quaternion with three digits is meant to have length 1; a larger deviation is an error.
        if (length - 1.0).abs() <= 1e-3 {
            return Ok(quaternion.normalize());
        }
        Err(de::Error::custom(format!("a rotation is a quaternion [x, y, z, w] of length 1, not {length:.3}")))
    }
}

value! {
    /// A fraction of the light, 0 to 1, or one for each channel, as a colour.
    Share(Vec3),
    { "oneOf": [
        { "type": "number", "minimum": 0, "maximum": 1 },
        { "type": "array", "items": { "type": "number", "minimum": 0 }, "minItems": 3, "maxItems": 3 },
        { "type": "string", "pattern": "^#[0-9A-Fa-f]{6}$" }
    ] },
    |d| Ok(match FractionOrColor::deserialize(d)? {
        FractionOrColor::Fraction(fraction) => Vec3::splat(fraction.0),
        FractionOrColor::Color(color) => color.0,
    }),
    color
}

value! {
    /// How long the shutter is open, from the frame's own time on: a fraction of the frame interval, or
    /// an angle such as "180deg", of which 360 are a whole frame; or the times at which it opens and
    /// closes, in frames.
    ShutterTimes([f64; 2]),
    { "oneOf": [
        { "type": "number", "minimum": 0, "maximum": 1000 },
        { "type": "string", "pattern": "^[0-9.]+deg$" },
        { "type": "array", "items": { "type": "number", "minimum": -1000, "maximum": 1000 }, "minItems": 2, "maxItems": 2 }
    ] },
    |d| d.deserialize_any(ShutterVisitor),
    |[open, close]| match open.to_bits() == 0 {
        true => close.written(),
        false => [*open, *close].written(),
    }
}

value! {
    /// Timing of a change: none (constant speed), in (slow start), out (slow end), in-out, or the x1, y1,
    /// x2, y2 of CSS's cubic-bezier.
    Pace(Easing),
    { "oneOf": [
        { "enum": ["none", "in", "out", "in-out"] },
        { "type": "array", "items": { "type": "number", "minimum": -10, "maximum": 10 }, "minItems": 4, "maxItems": 4 }
    ] },
    |d| d.deserialize_any(PaceVisitor),
    |easing| match *easing {
        Easing::None => "none".into(),
        Easing::IN => "in".into(),
        Easing::OUT => "out".into(),
        Easing::IN_OUT => "in-out".into(),
        Easing::Bezier(points) => points.written(),
    }
}

either! {
    /// A fraction for all channels, or a colour.
    FractionOrColor { Fraction(Fraction), Color(Color) },
    "a fraction between 0 and 1, or a colour",
    number: Fraction, str: Color, seq: Color
}

struct ShutterVisitor;

impl<'de> Visitor<'de> for ShutterVisitor {
    type Value = [f64; 2];

    fn expecting(&self, f: &mut fmt::Formatter) -> fmt::Result {
        f.write_str(
            "a fraction of a frame, an angle such as \"180deg\", or [open, close] in frames",
        )
    }

    fn visit_i64<E: de::Error>(self, value: i64) -> Result<[f64; 2], E> {
        self.visit_f64(value as f64)
    }

    fn visit_f64<E: de::Error>(self, value: f64) -> Result<[f64; 2], E> {
        if (0.0..=MAX_FRAMES).contains(&value) {
            return Ok([0.0, value]);
        }
        let wanted = format!("a fraction of a frame between 0 and {MAX_FRAMES}");
        Err(E::custom(format!("{value} is not {wanted}")))
    }

    fn visit_str<E: de::Error>(self, text: &str) -> Result<[f64; 2], E> {
        let degrees = text.strip_suffix("deg").and_then(|text| text.parse().ok());
        match degrees {
            Some(degrees) if (0.0..=360.0 * MAX_FRAMES).contains(&degrees) => {
                Ok([0.0, degrees / 360.0])
            }
            _ => {
                let quoted = quote(text.as_bytes());
                let wanted = "the angle of a shutter, such as \"180deg\"";
                Err(E::custom(format!("{quoted} is not {wanted}")))
            }
        }
    }

    fn visit_seq<A: SeqAccess<'de>>(self, seq: A) -> Result<[f64; 2], A::Error> {
        let from = de::value::SeqAccessDeserializer::new(seq);
        let [open, close] = elements::<Number, 2, _>(from, "two times [open, close]")?.map(|x| x.0);
        if let Some(time) = [open, close].iter().find(|time| time.abs() > MAX_FRAMES) {
            let wanted = format!("within {MAX_FRAMES} frames of the frame's own time");
            return Err(de::Error::custom(format!("{time} is not {wanted}")));
        }
        if open > close {
            let why = format!("the shutter opens at {open}, after it closes at {close}");
            return Err(de::Error::custom(why));
        }
        Ok([open, close])
    }
}

struct PaceVisitor;

impl<'de> Visitor<'de> for PaceVisitor {
    type Value = Easing;

    fn expecting(&self, f: &mut fmt::Formatter) -> fmt::Result {
        f.write_str("the name of an easing, or [x1, y1, x2, y2]")
    }

    fn visit_str<E: de::Error>(self, text: &str) -> Result<Easing, E> {
        match text {
            "none" => Ok(Easing::None),
            "in" => Ok(Easing::IN),
            "out" => Ok(Easing::OUT),
            "in-out" => Ok(Easing::IN_OUT),
            _ => Err(E::unknown_variant(text, &["none", "in", "out", "in-out"])),
        }
    }

    fn visit_seq<A: SeqAccess<'de>>(self, seq: A) -> Result<Easing, A::Error> {
        let from = de::value::SeqAccessDeserializer::new(seq);
        let curve = elements::<Number, 4, _>(from, "four numbers [x1, y1, x2, y2]")?.map(|x| x.0);
        let [x1, y1, x2, y2] = curve;
        if ![x1, x2].iter().all(|x| (0.0..=1.0).contains(x)) {
            let why = "x1 and x2 of an easing are between 0 and 1: time runs forward";
            return Err(de::Error::custom(why));
        }
        if ![y1, y2].iter().all(|y| y.abs() <= 10.0) {
            return Err(de::Error::custom(
                "y1 and y2 of an easing are between -10 and 10",
            ));
        }
        Ok(Easing::Bezier(curve))
    }
}
