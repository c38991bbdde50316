//! Value types of the layers of metallic-roughness materials.

use super::*;
use crate::import::range;

number! {
    /// The index of refraction of a body, 1 or more.
    BodyIndex(f32), 1.0, f64::from(range::IOR.1), "an index of refraction between 1 and 1000000"
}

number! {
    /// The index of refraction of a thin film, 1 or more.
    FilmIndex(f32), 1.0, f64::from(range::FILM_IOR), "an index of refraction between 1 and 100"
}

number! {
    /// 20 divided by Abbe's number, 0 or more.
    Dispersion(f32), 0.0, f64::from(range::DISPERSION), "a dispersion between 0 and 100"
}

number! {
    /// A thickness in nanometres, 0 or more.
    Nanometres(f32), 0.0, f64::from(range::FILM_THICKNESS), "a thickness between 0 and 1000000 nanometres"
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
