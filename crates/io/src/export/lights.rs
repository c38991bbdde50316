//! The lights of a scene.

use super::Writer;
use super::exact::{angle, same_bits};
use crate::import::native::file::{
    DirectionalTable, DiscLightTable, LIGHT_SAMPLES, LightTable, PointTable, RectangleLightTable,
    SphereLightTable, SpotTable,
};
use crate::import::native::values::{
    AxisAngle, AxisRadians, ConeAngle, ConeRadians, Vector, differing,
};
use glam::{DVec3, Vec3};
use glimray_scene::{Attenuation, Light, LightKind};

impl Writer<'_> {
    pub fn light(&self, index: usize, light: &Light) -> LightTable {
        let name = &self.names.lights[index];
        LightTable {
            name: (!name.is_empty()).then(|| name.clone().into()),
            carried_by: self.names.node(light.node),
            // An animated intensity multiplies the plain colour.
            ..table(light, !self.names.animated_lights[index])
        }
    }
}

/// A light without its name and its node. A gray may be written as an intensity if it `may_split`.
fn table(light: &Light, may_split: bool) -> LightTable {
    let gray = light.color.x;
    let is_gray = same_bits(light.color, Vec3::splat(gray));
    let (color, intensity) = match may_split && is_gray {
        true => (None, differing(gray, 1.0)),
        false => (differing(light.color, Vec3::ONE), None),
    };
    let attenuation = differing(light.attenuation, Attenuation::InverseSquare);
    let samples = differing(light.samples, LIGHT_SAMPLES);
    let visible = (!light.visible).then_some(false);
    let mut table = LightTable::default();
    // Tables of all area lights have these members.
    macro_rules! area {
        ($table:ident { $($key:ident: $value:expr),* }) => {
            Some($table { $($key: $value,)* color, intensity, radiance: None, samples, visible, attenuation })
        };
    }
    match light.kind {
        LightKind::Point { position } => {
            table.point = Some(PointTable {
                position: position.into(),
                color,
                intensity,
                attenuation,
            });
        }
        LightKind::Directional { direction } => {
            table.directional = Some(DirectionalTable {
                direction: direction.into(),
                color,
                intensity,
            });
        }
        LightKind::Spot {
            position,
            direction,
            inner,
            outer,
        } => {
            let spot = SpotTable {
                color,
                intensity,
                attenuation,
                ..spot(position, direction, [inner, outer])
            };
            table.spot = Some(spot.into());
        }
        LightKind::Rectangle {
            center,
            edge_u,
            edge_v,
        } => {
            table.rectangle = area!(RectangleLightTable {
                center: center.into(),
                edge_u: Some(Vector(edge_u).into()),
                edge_v: Some(edge_v.into()),
                look_at: None,
                size: None
            });
        }
        LightKind::Disc {
            center,
            normal,
            radius,
        } => {
            table.disc = area!(DiscLightTable {
                center: center.into(),
                look_at: None,
                normal: Some(normal.into()),
                radius: radius.into()
            });
        }
        LightKind::Sphere { center, radius } => {
            table.sphere = area!(SphereLightTable {
                center: center.into(),
                radius: radius.into()
            });
        }
    }
    table
}

/// A spot light's place and cone.
fn spot(position: DVec3, direction: DVec3, [inner, outer]: [f64; 2]) -> SpotTable {
    let (inner_deg, inner) = angle(inner, |degrees| AxisAngle::range().contains(degrees));
    let (outer_deg, outer) = angle(outer, |degrees| ConeAngle::range().contains(degrees));
    SpotTable {
        position: position.into(),
        look_at: None,
        direction: Some(direction.into()),
        inner_deg: inner_deg.map(|it| AxisAngle(it).into()),
        outer_deg: outer_deg.map(ConeAngle),
        inner: inner.map(|it| AxisRadians(it).into()),
        outer: outer.map(|it| ConeRadians(it).into()),
        color: None,
        intensity: None,
        attenuation: None,
    }
}
