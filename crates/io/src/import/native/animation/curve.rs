//! The curve of an animation, from its keys.

use crate::import::error::ImportError;
use crate::import::native::Texts;
use crate::import::native::file::Spanned;
use crate::import::native::file::{
    AnimationTable, InterpolationName, Key, KeyValue, PropertyName as P,
};
use crate::import::native::values::{
    Absorption, Color, Direction, Fraction, NonNegative, Number, NumberOrVector, Positive,
    Quaternion, RefractiveIndex, Scale, Share, Vector, ViewAngle, ViewRadians, elements, or,
};
use glam::{DQuat, DVec3, DVec4};
use glimray_scene::{Beyond, Curve, Easing, Values};
use serde::Deserialize;
use serde::de::value;

const SEE: &str = "See `glimray schema` for what is allowed";

/// The curve that `table` describes.
pub(super) fn curve(table: &AnimationTable, texts: &Texts) -> Result<Curve, ImportError> {
    let property = *table.property.get_ref();
    let interpolation = interpolation(table, texts)?;
    let easing = easing(table, interpolation, texts)?;
    let keys = table.keys.get_ref();
    if keys.is_empty() {
        let why = "an animation needs at least one key".to_owned();
        let todo = "Add one, such as [0, VALUE]";
        return Err(texts.malformed(table.keys.span(), why, todo));
    }
    let mut times = Vec::with_capacity(keys.len());
    let mut samples = Vec::with_capacity(keys.len());
    for Key(key) in keys {
        let time = key.time.0;
        if let Some(&last) = times.last()
            && time <= last
        {
            let why = match time == last {
                true => format!("two keys have the same time, {time}"),
                false => {
                    format!("the time {time} is before that of the previous key, {last}")
                }
            };
            let todo = "Give every key a later time than the one before it";
            return Err(texts.malformed(key.time.span(), why, todo));
        }
        times.push(time);
        let refuse =
            |error: value::Error| texts.malformed(key.value.span(), error.to_string(), SEE);
        let sample = sample(property, key.value.get_ref()).map_err(refuse)?;
        if let Some((why, todo)) = (samples.last())
            .filter(|_| interpolation != InterpolationName::Step)
            .and_then(|last| obstacle(property, *last, sample))
        {
            return Err(texts.malformed(key.value.span(), why.to_owned(), todo));
        }
        samples.push(sample);
    }
    if interpolation == InterpolationName::Hermite {
        samples = with_tangents(property, keys, &samples, texts)?;
    } else if let Some(tangent) =
        (keys.iter()).find_map(|Key(key)| key.in_tangent.as_ref().or(key.out_tangent.as_ref()))
    {
        let why = "only hermite interpolation has tangents".to_owned();
        let todo = "Leave it out, or add `interpolation = \"hermite\"`";
        return Err(texts.malformed(tangent.span(), why, todo));
    }
    Ok(Curve {
        times,
        values: values(&samples),
        interpolation: interpolation.into(),
        easing,
        beyond: or(table.beyond, Beyond::Hold),
    })
}

/// A value of a curve, of the type of its property.
#[derive(Clone, Copy)]
enum Sample {
    Scalar(f64),
    Vector(DVec3),
    Rotation(DQuat),
}

fn interpolation(table: &AnimationTable, texts: &Texts) -> Result<InterpolationName, ImportError> {
    let is_switch = matches!(table.property.get_ref(), P::Visible | P::On);
    match &table.interpolation {
        None if is_switch => Ok(InterpolationName::Step),
        None => Ok(InterpolationName::Linear),
        Some(name) if is_switch && *name.get_ref() != InterpolationName::Step => {
            let why = "true and false cannot be interpolated".to_owned();
            let todo = "Leave `interpolation` out, or make it \"step\"";
            Err(texts.malformed(name.span(), why, todo))
        }
        Some(name) => Ok(*name.get_ref()),
    }
}

fn easing(
    table: &AnimationTable,
    interpolation: InterpolationName,
    texts: &Texts,
) -> Result<Easing, ImportError> {
    match &table.easing {
        None => Ok(Easing::None),
        Some(pace) if interpolation != InterpolationName::Linear => {
            let why = "only linear interpolation has easing".to_owned();
            let todo = "Leave `easing` out, or make the interpolation linear";
            Err(texts.malformed(pace.span(), why, todo))
        }
        Some(pace) => Ok(pace.0),
    }
}

/// The value of a key for `property`, read as in the table that it overrides.
fn sample(property: P, from: &KeyValue) -> Result<Sample, value::Error> {
    use Sample::{Rotation, Scalar, Vector as Three};
    Ok(match property {
        P::Visible | P::On => Scalar(f64::from(u8::from(bool::deserialize(from)?))),
        P::Translate | P::Angles | P::LookFrom | P::LookAt | P::Position => {
            Three(Vector::deserialize(from)?.0)
        }
        P::RotateDeg => Three(radians(Vector::deserialize(from)?.0)),
        P::Rotation => Rotation(Quaternion::deserialize(from)?.0),
        P::Scale => Three(Scale::deserialize(from)?.0),
        P::Up | P::Direction => Three(Direction::deserialize(from)?.0),
        P::FovYDeg => Scalar(ViewAngle::deserialize(from)?.0.to_radians()),
        P::FocusDistance | P::LensRadius | P::Orthographic => {
            Scalar(Positive::deserialize(from)?.0)
        }
        P::FovY => Scalar(ViewRadians::deserialize(from)?.0),
        P::Color | P::Diffuse | P::Specular | P::Ambient | P::Emission => {
            Three(Color::deserialize(from)?.0.as_dvec3())
        }
        P::Reflect | P::Transmit => Three(Share::deserialize(from)?.0.as_dvec3()),
        P::Intensity | P::Shininess => Scalar(NonNegative::deserialize(from)?.0.into()),
        P::Opacity => Scalar(Fraction::deserialize(from)?.0.into()),
        P::Ior => Scalar(RefractiveIndex::deserialize(from)?.0.into()),
        P::Absorption => Three(Absorption::deserialize(from)?.0.as_dvec3()),
    })
}

/// The change per second of a value like `sample`.
fn tangent(property: P, sample: Sample, from: &KeyValue) -> Result<Sample, value::Error> {
    Ok(match (property, sample) {
        (P::FovYDeg, _) => Sample::Scalar(Number::deserialize(from)?.0.to_radians()),
        (P::RotateDeg, _) => Sample::Vector(radians(Vector::deserialize(from)?.0)),
        (P::Scale | P::Reflect | P::Transmit, _) => {
            Sample::Vector(NumberOrVector::deserialize(from)?.into())
        }
        (_, Sample::Scalar(_)) => Sample::Scalar(Number::deserialize(from)?.0),
        (_, Sample::Vector(_)) => Sample::Vector(Vector::deserialize(from)?.0),
        (_, Sample::Rotation(_)) => {
            let four = elements::<Number, 4, _>(from, "four numbers [x, y, z, w]")?;
            Sample::Rotation(DQuat::from_array(four.map(|x| x.0)))
        }
    })
}

/// For each key, the incoming tangent, the value, and the outgoing tangent.
fn with_tangents(
    property: P,
    keys: &[Key],
    samples: &[Sample],
    texts: &Texts,
) -> Result<Vec<Sample>, ImportError> {
    let mut all = Vec::with_capacity(3 * keys.len());
    for (Key(key), &sample) in keys.iter().zip(samples) {
        let read = |given: &Option<Spanned<KeyValue>>| match given {
            None => Ok(match sample {
                Sample::Scalar(_) => Sample::Scalar(0.0),
                Sample::Vector(_) => Sample::Vector(DVec3::ZERO),
                Sample::Rotation(_) => Sample::Rotation(DQuat::from_vec4(DVec4::ZERO)),
            }),
            Some(given) => tangent(property, sample, given.get_ref())
                .map_err(|error| texts.malformed(given.span(), error.to_string(), SEE)),
        };
        all.extend([read(&key.in_tangent)?, sample, read(&key.out_tangent)?]);
    }
    Ok(all)
}

/// Why there is no valid interpolation between two values, and what to do.
fn obstacle(property: P, from: Sample, to: Sample) -> Option<(&'static str, &'static str)> {
    let (Sample::Vector(from), Sample::Vector(to)) = (from, to) else {
        return None;
    };
    match property {
        P::Scale if (from * to).min_element() < 0.0 => Some((
            "between the previous key and this one, the scale would pass through 0",
            "Keep the signs, or use `interpolation = \"step\"`",
        )),
        P::Up | P::Direction if from.dot(to) < 1e-9 - 1.0 => Some((
            "the direction is opposite to that of the previous key, so the path is ambiguous",
            "Add a key in between, or use `interpolation = \"step\"`",
        )),
        _ => None,
    }
}

/// Samples of one type as a list of that type.
fn values(samples: &[Sample]) -> Values {
    macro_rules! all {
        ($kind:ident) => {
            samples.iter().filter_map(|sample| match sample {
                Sample::$kind(value) => Some(*value),
                _ => None,
            })
        };
    }
    match samples.first() {
        Some(Sample::Scalar(_)) | None => Values::Scalar(all!(Scalar).collect()),
        Some(Sample::Vector(_)) => Values::Vector(all!(Vector).collect()),
        Some(Sample::Rotation(_)) => Values::Rotation(all!(Rotation).collect()),
    }
}

fn radians(degrees: DVec3) -> DVec3 {
    DVec3::from(degrees.to_array().map(f64::to_radians))
}
