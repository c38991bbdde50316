//! The lights of a native scene.

use super::Texts;
use super::file::{
    DiscLightTable, LIGHT_SAMPLES, LightTable, RectangleLightTable, SceneFile, Spanned, SpotTable,
};
use super::nodes::Nodes;
use super::values::{AttenuationName, Color, Count, NonNegative, Vector, or};
use crate::import::error::ImportError;
use crate::import::source::quote;
use glam::{DVec3, Vec3};
use glimray_scene::{Attenuation, Light, LightKind};
use std::collections::HashSet;
use std::ops::Range;

/// A light that animations can refer to.
pub(super) struct NamedLight {
    pub name: Option<String>,
    pub light: Light,
    /// Colour in the file, and the factor that turns it into the light's colour.
    pub color: Vec3,
    pub factor: f64,
    /// The largest channel that its colour ever has.
    pub peak: f64,
}

/// The lights of `file`.
pub(super) fn lights(
    file: &SceneFile,
    nodes: &Nodes,
    texts: &Texts,
) -> Result<Vec<NamedLight>, ImportError> {
    let mut names = HashSet::new();
    let mut lights = Vec::with_capacity(file.lights.len());
    for spanned in &file.lights {
        let table = spanned.get_ref();
        let mut light = light(spanned, texts)?;
        if let Some(name) = &table.name {
            if !names.insert(name.get_ref()) {
                let quoted = quote(name.as_bytes());
                let why = format!("duplicate light name {quoted}");
                return Err(texts.malformed(name.span(), why, "Rename one of them"));
            }
            light.name = Some(name.get_ref().clone());
            light.light.name.clone_from(name.get_ref());
        }
        if let Some(name) = &table.carried_by {
            light.light.node = Some(nodes.one(name.get_ref(), name.span(), texts)?);
        }
        lights.push(light);
    }
    Ok(lights)
}

/// The light that `table` describes, without its name.
fn light(table: &Spanned<LightTable>, texts: &Texts) -> Result<NamedLight, ImportError> {
    let reader = Reader {
        texts,
        span: table.span(),
    };
    let table = table.get_ref();
    let mut found = Vec::new();
    if let Some(point) = &table.point {
        let position = point.position.0;
        let kind = LightKind::Point { position };
        found.push(reader.small(kind, point.color, point.intensity, point.attenuation)?);
    }
    if let Some(sun) = &table.directional {
        let direction = sun.direction.0;
        let kind = LightKind::Directional { direction };
        found.push(reader.small(kind, sun.color, sun.intensity, Some(AttenuationName::None))?);
    }
    if let Some(spanned) = &table.spot {
        let (kind, spot) = (cone(spanned, texts)?, spanned.get_ref());
        found.push(reader.small(kind, spot.color, spot.intensity, spot.attenuation)?);
    }
    // Tables of all area lights have these members.
    macro_rules! large {
        ($kind:expr, $table:expr) => {{
            let brightness = reader.brightness($table.intensity, $table.radiance)?;
            let (kind, attenuation) = ($kind, $table.attenuation);
            let seen = ($table.samples, $table.visible);
            found.push(reader.large(kind, $table.color, brightness, attenuation, seen)?);
        }};
    }
    if let Some(rectangle) = &table.rectangle {
        large!(reader.rectangle(rectangle)?, rectangle);
    }
    if let Some(disc) = &table.disc {
        large!(reader.disc(disc)?, disc);
    }
    if let Some(sphere) = &table.sphere {
        let (center, radius) = (sphere.center.0, sphere.radius.0);
        large!(LightKind::Sphere { center, radius }, sphere);
    }
    match <[NamedLight; 1]>::try_from(found) {
        Ok([light]) => Ok(light),
        Err(_) => Err(reader.refuse(
            "a light needs exactly one kind",
            "Give it one of `point`, `directional`, `spot`, `rectangle`, `disc` and `sphere`",
        )),
    }
}

/// The brightness of an area light.
enum Brightness {
    Intensity(f32),
    Radiance(f32),
}

/// Reads one light.
struct Reader<'a> {
    texts: &'a Texts<'a>,
    /// The whole light.
    span: Range<usize>,
}

impl Reader<'_> {
    fn refuse(&self, why: &str, todo: &str) -> ImportError {
        self.texts
            .malformed(self.span.clone(), why.to_owned(), todo)
    }

    /// A light without extent.
    fn small(
        &self,
        kind: LightKind,
        color: Option<Color>,
        intensity: Option<NonNegative>,
        attenuation: Option<AttenuationName>,
    ) -> Result<NamedLight, ImportError> {
        let (color, intensity) = (or(color, Vec3::ONE), or(intensity, 1.0));
        let light = Light {
            kind,
            color: self.product(color, intensity)?,
            attenuation: or(attenuation, Attenuation::InverseSquare),
            ..Light::default()
        };
        Ok(NamedLight {
            name: None,
            light,
            color,
            factor: intensity.into(),
            peak: color.max_element().into(),
        })
    }

    /// An area light.
    fn large(
        &self,
        kind: LightKind,
        color: Option<Color>,
        brightness: Brightness,
        attenuation: Option<AttenuationName>,
        (samples, visible): (Option<Count>, Option<bool>),
    ) -> Result<NamedLight, ImportError> {
        let radiance_of_one = kind.radiance().unwrap_or(1.0);
        let plain = or(color, Vec3::ONE);
        let (color, factor) = match brightness {
            Brightness::Intensity(intensity) => {
                let color = self.product(plain, intensity)?.as_dvec3();
                (color, f64::from(intensity))
            }
            Brightness::Radiance(radiance) => {
                let color = self.product(plain, radiance)?.as_dvec3() / radiance_of_one;
                (color, f64::from(radiance) / radiance_of_one)
            }
        };
        let surface = color * radiance_of_one;
        if !color.as_vec3().is_finite() || !surface.as_vec3().is_finite() {
            let why = "its size or radiance is out of range: at most 3.4e38 is allowed";
            return Err(self.refuse(why, "Make it darker, or change its size"));
        }
        let light = Light {
            kind,
            color: color.as_vec3(),
            attenuation: or(attenuation, Attenuation::InverseSquare),
            samples: or(samples, LIGHT_SAMPLES),
            visible: visible.unwrap_or(true),
            node: None,
            name: String::new(),
        };
        Ok(NamedLight {
            name: None,
            light,
            color: plain,
            factor,
            peak: plain.max_element().into(),
        })
    }

    fn product(&self, color: Vec3, factor: f32) -> Result<Vec3, ImportError> {
        let product = color * factor;
        if product.is_finite() {
            return Ok(product);
        }
        let why = "`color` times `intensity` is out of range: at most 3.4e38 is allowed";
        Err(self.refuse(why, "Lower one of them"))
    }

    fn brightness(
        &self,
        intensity: Option<NonNegative>,
        radiance: Option<NonNegative>,
    ) -> Result<Brightness, ImportError> {
        match (intensity, radiance) {
            (None, None) => Ok(Brightness::Intensity(1.0)),
            (Some(intensity), None) => Ok(Brightness::Intensity(intensity.0)),
            (None, Some(radiance)) => Ok(Brightness::Radiance(radiance.0)),
            (Some(_), Some(_)) => Err(self.refuse(
                "there are both `intensity` and `radiance`",
                "Leave out one of them",
            )),
        }
    }

    fn rectangle(&self, table: &RectangleLightTable) -> Result<LightKind, ImportError> {
        let center = table.center.0;
        let (edge_u, edge_v) = match (&table.edge_u, table.edge_v, &table.look_at, table.size) {
            (Some(edge_u), Some(Vector(edge_v)), None, None) => {
                let span = edge_u.span();
                let edge_u = edge_u.0;
                if is_flat(edge_u, edge_v) {
                    let why = "`edge_u` and `edge_v` span no area".to_owned();
                    let todo = "Give two edges that are not parallel";
                    return Err(self.texts.malformed(span, why, todo));
                }
                (edge_u, edge_v)
            }
            (None, None, Some(look_at), Some(size)) => {
                let normal = self.towards(center, look_at)?;
                // A level edge, and the edge that completes it to u × v = normal.
                let level = DVec3::Y.cross(normal);
                let u = if level.length() > 1e-6 {
                    level.normalize()
                } else {
                    DVec3::X
                };
                let [width, height] = size.0;
                (u * width / 2.0, normal.cross(u) * height / 2.0)
            }
            _ => {
                return Err(self.refuse(
                    "a rectangle needs its edges",
                    "Give it either `edge_u` and `edge_v`, or `look_at` and `size`",
                ));
            }
        };
        Ok(LightKind::Rectangle {
            center,
            edge_u,
            edge_v,
        })
    }

    fn disc(&self, table: &DiscLightTable) -> Result<LightKind, ImportError> {
        let center = table.center.0;
        let normal = match (&table.look_at, table.normal) {
            (Some(look_at), None) => self.towards(center, look_at)?,
            (None, Some(normal)) => normal.0,
            _ => {
                let todo = "Give it either `look_at` or `normal`";
                return Err(self.refuse("a disc needs exactly one direction", todo));
            }
        };
        Ok(LightKind::Disc {
            center,
            normal,
            radius: table.radius.0,
        })
    }

    fn towards(&self, center: DVec3, look_at: &Spanned<Vector>) -> Result<DVec3, ImportError> {
        (look_at.0 - center).try_normalize().ok_or_else(|| {
            let why = "`look_at` is the centre of the light itself".to_owned();
            let todo = "Move one of them";
            self.texts.malformed(look_at.span(), why, todo)
        })
    }
}

/// Whether two edges are too nearly parallel to span an area.
fn is_flat(u: DVec3, v: DVec3) -> bool {
    match (u.try_normalize(), v.try_normalize()) {
        (Some(u), Some(v)) => u.cross(v).length() < 1e-6,
        _ => true,
    }
}

fn cone(spot: &Spanned<SpotTable>, texts: &Texts) -> Result<LightKind, ImportError> {
    let table = spot.get_ref();
    let position = table.position.0;
    let direction = match (&table.look_at, table.direction) {
        (Some(look_at), None) => {
            let direction = (look_at.0 - position).try_normalize();
            direction.ok_or_else(|| {
                let why = "`look_at` is the position of the spot light itself".to_owned();
                texts.malformed(look_at.span(), why, "Move one of them")
            })?
        }
        (None, Some(direction)) => direction.0,
        _ => {
            let why = "a spot light needs exactly one direction".to_owned();
            let todo = "Give it either `look_at` or `direction`";
            return Err(texts.malformed(spot.span(), why, todo));
        }
    };
    for (degrees, radians, name) in [
        (
            table.inner_deg.is_some(),
            table.inner.as_ref().map(Spanned::span),
            "inner",
        ),
        (
            table.outer_deg.is_some(),
            table.outer.as_ref().map(Spanned::span),
            "outer",
        ),
    ] {
        if let (true, Some(span)) = (degrees, radians) {
            let why = format!("there are both `{name}_deg` and `{name}`");
            return Err(texts.malformed(span, why, "Leave out one of them"));
        }
    }
    let outer_deg = match &table.outer {
        Some(radians) => radians.0.to_degrees(),
        None => or(table.outer_deg, 30.0),
    };
    let outer = (table.outer.as_ref()).map_or(outer_deg.to_radians(), |angle| angle.0);
    let inner = match (&table.inner_deg, &table.inner) {
        (Some(degrees), _) => degrees.0.to_radians(),
        (None, Some(radians)) => radians.0,
        (None, None) => (0.8 * outer_deg).to_radians(),
    };
    if inner > outer {
        let in_degrees = table.inner_deg.as_ref().map(Spanned::span);
        let span = in_degrees.or(table.inner.as_ref().map(Spanned::span));
        let why = format!("`inner_deg` is greater than `outer_deg`, which is {outer_deg}");
        let todo = "Give the inner cone the smaller angle";
        return Err(texts.malformed(span.unwrap_or(spot.span()), why, todo));
    }
    Ok(LightKind::Spot {
        position,
        direction,
        inner,
        outer,
    })
}
