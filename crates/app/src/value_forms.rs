//! The forms of values in flags: numbers, lists, names. A text that is written is read as the same value.

use super::value_names::ValueNames;
use glimray_render::{MAX_SIDE, RayOffset, RenderSettings};
use std::fmt::Display;
use std::ops::RangeInclusive;
use std::str::FromStr;

/// Finds a value in the settings.
pub type Place<T> = fn(&mut RenderSettings) -> &mut T;

/// How a setting is edited.
pub enum Control {
    /// A flag without a value.
    Switch(Place<bool>),
    /// A whole number.
    Count(Place<u32>, RangeInclusive<u32>),
    /// A number.
    Real(Place<f32>, RangeInclusive<f32>),
    /// A number; `None` is no limit, which controls show as 0.
    Limit(Place<Option<f32>>, RangeInclusive<f32>),
    /// One of these names, each with a description.
    Names(Vec<(&'static str, &'static str)>),
    /// Text.
    Text,
}

/// The form of a setting's values.
pub trait Form<T> {
    /// The value of a text.
    ///
    /// # Errors
    /// Why there is none.
    fn read(&self, text: &str) -> Result<T, String>;

    /// The text of a value; `None` if only the absence of the flag says it.
    fn write(&self, value: &T) -> Option<String>;

    /// How it is edited.
    fn control(&self, place: Place<T>) -> Control;
}

/// A flag without a value switches it on.
pub struct Switch;

impl Form<bool> for Switch {
    fn read(&self, _: &str) -> Result<bool, String> {
        Ok(true)
    }

    fn write(&self, value: &bool) -> Option<String> {
        value.then(String::new)
    }

    fn control(&self, place: Place<bool>) -> Control {
        Control::Switch(place)
    }
}

/// A whole number in a range.
pub struct Count(pub RangeInclusive<u32>);

impl Form<u32> for Count {
    fn read(&self, text: &str) -> Result<u32, String> {
        let number: i64 = (text.parse()).map_err(|error| format!("{error}"))?;
        let found = u32::try_from(number).ok().filter(|it| self.0.contains(it));
        found.ok_or_else(|| format!("{number} is not in {:?}", self.0))
    }

    fn write(&self, value: &u32) -> Option<String> {
        Some(value.to_string())
    }

    fn control(&self, place: Place<u32>) -> Control {
        Control::Count(place, self.0.clone())
    }
}

/// A number in a range.
pub struct Real(pub RangeInclusive<f32>);

impl Form<f32> for Real {
    fn read(&self, text: &str) -> Result<f32, String> {
        within(text, *self.0.start(), *self.0.end(), "it")
    }

    fn write(&self, value: &f32) -> Option<String> {
        Some(value.to_string())
    }

    fn control(&self, place: Place<f32>) -> Control {
        Control::Real(place, self.0.clone())
    }
}

/// A number in a range, or no limit.
pub struct Limit(pub RangeInclusive<f32>);

impl Form<Option<f32>> for Limit {
    fn read(&self, text: &str) -> Result<Option<f32>, String> {
        within(text, *self.0.start(), *self.0.end(), "it").map(Some)
    }

    fn write(&self, value: &Option<f32>) -> Option<String> {
        value.map(|limit| limit.to_string())
    }

    fn control(&self, place: Place<Option<f32>>) -> Control {
        Control::Limit(place, self.0.clone())
    }
}

impl<T: PartialEq + Clone> Form<T> for ValueNames<T> {
    fn read(&self, text: &str) -> Result<T, String> {
        self.value(text).ok_or_else(|| format!("unknown: `{text}`"))
    }

    fn write(&self, value: &T) -> Option<String> {
        Some(self.name(value).to_owned())
    }

    fn control(&self, _: Place<T>) -> Control {
        Control::Names(
            self.0
                .iter()
                .map(|(name, help, _)| (*name, *help))
                .collect(),
        )
    }
}

/// Another form, by its functions.
pub struct Written<T: 'static>(
    pub fn(&str) -> Result<T, String>,
    pub fn(&T) -> Option<String>,
);

impl<T> Form<T> for Written<T> {
    fn read(&self, text: &str) -> Result<T, String> {
        self.0(text)
    }

    fn write(&self, value: &T) -> Option<String> {
        self.1(value)
    }

    fn control(&self, _: Place<T>) -> Control {
        Control::Text
    }
}

/// `WIDTHxHEIGHT`.
pub const SIZE: Written<(u32, u32)> = Written(
    |text| {
        let (width, height) = text
            .split_once(['x', 'X', '×'])
            .ok_or("it must be WIDTHxHEIGHT in pixels, such as 640x480")?;
        let side = |text: &str| within(text, 1, MAX_SIDE, "width and height");
        Ok((side(width)?, side(height)?))
    },
    |(width, height)| Some(format!("{width}x{height}")),
);

/// `X0,Y0,X1,Y1`.
pub const CROP: Written<Option<[u32; 4]>> =
    Written(|text| crop(text).map(Some), |edges| edges.map(joined));

/// `bound` or `fixed:DISTANCE`.
pub const OFFSET: Written<RayOffset> = Written(str::parse, |offset| Some(offset.to_string()));

/// `X0,Y0,X1,Y1`, not empty.
///
/// # Errors
/// One line for the user: other than four whole numbers, one out of range, or an empty rectangle.
pub fn crop(text: &str) -> Result<[u32; 4], String> {
    let edges @ [x0, y0, x1, y1] = list(text, "X0,Y0,X1,Y1", |part| {
        within(part, 0, MAX_SIDE, "every edge")
    })?;
    if x0 < x1 && y0 < y1 {
        Ok(edges)
    } else {
        Err("it is empty: X1 must be more than X0, and Y1 more than Y0".into())
    }
}

/// `N` comma-separated values.
///
/// # Errors
/// The error of the first part that is refused, or a line with both counts.
pub fn list<T, const N: usize>(
    text: &str,
    shape: &str,
    part: impl Fn(&str) -> Result<T, String>,
) -> Result<[T; N], String> {
    let parts = text.split(',').map(part).collect::<Result<Vec<_>, _>>()?;
    let count = parts.len();
    parts
        .try_into()
        .map_err(|_| format!("it must be {shape}: {N} numbers, not {count}"))
}

/// The text of values for [`list`].
pub fn joined<T: ToString, const N: usize>(parts: [T; N]) -> String {
    parts.map(|part| part.to_string()).join(",")
}

/// A number from `min` to `max`. NaN is out of every range.
///
/// # Errors
/// One line for the user that begins with `what` and names the range.
pub fn within<T>(text: &str, min: T, max: T, what: &str) -> Result<T, String>
where
    T: FromStr + PartialOrd + Display,
{
    match text.trim().parse::<T>() {
        Ok(number) if number >= min && number <= max => Ok(number),
        _ => Err(format!(
            "{what} must be a number from {min} to {max}, not `{}`",
            text.trim()
        )),
    }
}
