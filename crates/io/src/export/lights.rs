//! The lights of a scene.

use super::text::{Table, color, number, number32, string, vector};
use super::{Writer, exact};
use glam::Vec3;
use glimray_scene::{Attenuation, Light, LightKind};

/// The importer's default number of shadow rays of area lights.
const SAMPLES: u32 = 16;

impl Writer<'_> {
    pub fn lights(&mut self) {
        if !self.scene.lights.is_empty() {
            self.text.section("Lights");
        }
        for (index, light) in self.scene.lights.iter().enumerate() {
            let mut table = Table::default();
            let name = &self.names.lights[index];
            table.put_if(!name.is_empty(), "name", string(name));
            if let Some(node) = light.node {
                table.put("carried_by", string(&self.names.nodes[node]));
            }
            // An animated intensity multiplies the plain colour.
            put(&mut table, light, name.is_empty());
            self.text.gap();
            self.text.head("[[lights]]");
            self.text.lines(&table);
        }
    }
}

fn put(table: &mut Table, light: &Light, may_split: bool) {
    let mut inner = Table::default();
    let key = match light.kind {
        LightKind::Point { position } => {
            inner.put("position", vector(position));
            "point"
        }
        LightKind::Directional { direction } => {
            inner.put("direction", vector(direction));
            "directional"
        }
        LightKind::Spot {
            position,
            direction,
            inner: full,
            outer,
        } => {
            inner.put("position", vector(position));
            inner.put("direction", vector(direction));
            let is_read = |degrees: &f64| (0.0..=90.0).contains(degrees);
            match exact::degrees(full).filter(is_read) {
                Some(degrees) => inner.put("inner_deg", number(degrees)),
                None => inner.put("inner", number(full)),
            }
            match exact::degrees(outer).filter(is_read) {
                Some(degrees) => inner.put("outer_deg", number(degrees)),
                None => inner.put("outer", number(outer)),
            }
            "spot"
        }
        LightKind::Rectangle {
            center,
            edge_u,
            edge_v,
        } => {
            inner.put("center", vector(center));
            inner.put("edge_u", vector(edge_u));
            inner.put("edge_v", vector(edge_v));
            "rectangle"
        }
        LightKind::Disc {
            center,
            normal,
            radius,
        } => {
            inner.put("center", vector(center));
            inner.put("normal", vector(normal));
            inner.put("radius", number(radius));
            "disc"
        }
        LightKind::Sphere { center, radius } => {
            inner.put("center", vector(center));
            inner.put("radius", number(radius));
            "sphere"
        }
    };
    let gray = light.color.x;
    let is_gray = light
        .color
        .to_array()
        .iter()
        .all(|c| c.to_bits() == gray.to_bits());
    if is_gray && may_split {
        inner.put_if(gray != 1.0, "intensity", number32(gray));
    } else {
        inner.put_if(light.color != Vec3::ONE, "color", color(light.color));
    }
    if light.kind.radiance().is_some() {
        inner.put_if(
            light.samples != SAMPLES,
            "samples",
            light.samples.to_string(),
        );
        inner.put_if(!light.visible, "visible", "false");
    }
    let fades = light.attenuation == Attenuation::InverseSquare;
    let never_fades = matches!(light.kind, LightKind::Directional { .. });
    inner.put_if(!fades && !never_fades, "attenuation", string("none"));
    table.put(key, inner.inline());
}
