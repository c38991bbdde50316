//! The lights of a native scene.

use super::Texts;
use super::file::{LightTable, SpotTable};
use super::values::{Color, NonNegative};
use crate::import::error::ImportError;
use crate::scene::{Light, LightKind};
use glam::Vec3;
use toml::Spanned;

/// The light that `table` describes.
pub(super) fn light(table: &Spanned<LightTable>, texts: &Texts) -> Result<Light, ImportError> {
    let radiance = |color: Color, intensity: NonNegative| -> Result<Vec3, ImportError> {
        let radiance = color.0 * intensity.0;
        if radiance.is_finite() {
            return Ok(radiance);
        }
        let why = "color times intensity is out of range: at most 3.4e38 is allowed".to_owned();
        Err(texts.malformed(table.span(), why, "Lower one of them"))
    };
    match table.get_ref() {
        LightTable {
            point: Some(point),
            directional: None,
            spot: None,
        } => Ok(Light {
            kind: LightKind::Point {
                position: point.position.0,
            },
            color: radiance(point.color, point.intensity)?,
            attenuation: point.attenuation.into(),
            ..Light::default()
        }),
        LightTable {
            point: None,
            directional: Some(sun),
            spot: None,
        } => Ok(Light {
            kind: LightKind::Directional {
                direction: sun.direction.0,
            },
            color: radiance(sun.color, sun.intensity)?,
            ..Light::default()
        }),
        LightTable {
            point: None,
            directional: None,
            spot: Some(spot),
        } => Ok(Light {
            kind: cone(spot, texts)?,
            color: radiance(spot.color, spot.intensity)?,
            attenuation: spot.attenuation.into(),
            ..Light::default()
        }),
        _ => {
            let todo = "Give it exactly one of `point`, `directional` and `spot`";
            Err(texts.malformed(table.span(), "a light is of one kind".to_owned(), todo))
        }
    }
}

fn cone(spot: &SpotTable, texts: &Texts) -> Result<LightKind, ImportError> {
    let position = spot.position.0;
    let Some(direction) = (spot.look_at.get_ref().0 - position).try_normalize() else {
        let why = "`look_at` is where the spot light itself is".to_owned();
        return Err(texts.malformed(spot.look_at.span(), why, "Move one of them"));
    };
    let outer = spot.outer_deg.0;
    let inner = match &spot.inner_deg {
        Some(inner) if inner.get_ref().0 > outer => {
            let why = format!("`inner_deg` is greater than `outer_deg`, which is {outer}");
            let todo = "Give the inner cone the smaller angle";
            return Err(texts.malformed(inner.span(), why, todo));
        }
        Some(inner) => inner.get_ref().0,
        None => 0.8 * outer,
    };
    let [inner, outer] = [inner, outer].map(f64::to_radians);
    Ok(LightKind::Spot {
        position,
        direction,
        inner,
        outer,
    })
}
