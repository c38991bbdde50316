//! Value types of the layers of metallic-roughness materials.

use super::Written;
use super::{elements, number};
use crate::import::range;
use schemars::{JsonSchema, Schema, SchemaGenerator, json_schema};
use serde::de::{Deserialize, Deserializer};
use serde::ser::{Serialize, Serializer};
use std::borrow::Cow;
use toml::Value;

value! {
    /// The index of refraction of a body, 1 or more.
    BodyIndex(f32),
    { "type": "number", "minimum": 1, "maximum": range::IOR.1 },
    |d| {
        let holds = |x: f64| (1.0..=f64::from(range::IOR.1)).contains(&x);
        number(d, holds, "an index of refraction between 1 and 1000000").map(|x| x as f32)
    }
}

value! {
    /// The index of refraction of a thin film, 1 or more.
    FilmIndex(f32),
    { "type": "number", "minimum": 1, "maximum": range::FILM_IOR },
    |d| {
        let holds = |x: f64| (1.0..=f64::from(range::FILM_IOR)).contains(&x);
        number(d, holds, "an index of refraction between 1 and 100").map(|x| x as f32)
    }
}

value! {
    /// 20 divided by Abbe's number, 0 or more.
    Dispersion(f32),
    { "type": "number", "minimum": 0, "maximum": range::DISPERSION },
    |d| {
        let holds = |x: f64| (0.0..=f64::from(range::DISPERSION)).contains(&x);
        number(d, holds, "a dispersion between 0 and 100").map(|x| x as f32)
    }
}

value! {
    /// A thickness in nanometres, 0 or more.
    Nanometres(f32),
    { "type": "number", "minimum": 0, "maximum": range::FILM_THICKNESS },
    |d| {
        let holds = |x: f64| (0.0..=f64::from(range::FILM_THICKNESS)).contains(&x);
        number(d, holds, "a thickness between 0 and 1000000 nanometres").map(|x| x as f32)
    }
}

value! {
    /// The thinnest and the thickest part in nanometres, each 0 or more.
    Thicknesses([f32; 2]),
    {
        "type": "array", "minItems": 2, "maxItems": 2,
        "items": { "type": "number", "minimum": 0, "maximum": range::FILM_THICKNESS }
    },
    |d| {
        let both = elements::<Nanometres, 2, D>(d, "two numbers [thinnest, thickest]")?;
        Ok(both.map(|x| x.0))
    }
}
