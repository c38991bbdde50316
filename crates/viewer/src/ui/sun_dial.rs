//! A map of the sky from above, with the sun: its middle is the zenith, its rim the horizon, −Z is up and +X at the right.

use crate::ui::world_painter::SHADE;
use eframe::egui::{Align2, Color32, FontId, Painter, Pos2, Stroke, Vec2, vec2};
use glam::DVec3;

/// The colours of the map: legible in both themes and on any picture.
const GROUND: Color32 = Color32::from_rgb(38, 58, 92);
const LINES: Color32 = Color32::from_rgb(120, 146, 188);
const LETTERS: Color32 = Color32::from_rgb(226, 234, 246);
const SUN: Color32 = Color32::from_rgb(255, 214, 64);

/// A map on the screen.
#[derive(Clone, Copy, Debug)]
pub struct SunDial {
    /// The middle of the map.
    pub center: Pos2,
    /// The radius of the map, in points.
    pub radius: f32,
}

impl SunDial {
    /// Where the sun is with this elevation and azimuth in degrees.
    pub fn point(&self, [elevation, azimuth]: [f64; 2]) -> Pos2 {
        let (sine, cosine) = azimuth.to_radians().sin_cos();
        let distance = self.radius * (1.0 - elevation / 90.0) as f32;
        self.center + distance * vec2(sine as f32, -cosine as f32)
    }

    /// Elevation and azimuth in degrees of the sun at a point of the screen; beyond the rim it is on the horizon.
    pub fn sun_deg(&self, at: Pos2) -> [f64; 2] {
        let off = at - self.center;
        let share = f64::from(off.length() / self.radius).min(1.0);
        let azimuth = f64::from(off.x).atan2(f64::from(-off.y)).to_degrees();
        [90.0 * (1.0 - share), azimuth]
    }

    /// Draws the map with a sun at this elevation and azimuth in degrees, and a line in the direction that the camera looks.
    pub fn paint(&self, painter: &Painter, sun_deg: [f64; 2], forward: Option<DVec3>) {
        let &Self { center, radius } = self;
        painter.circle(center, radius, GROUND, Stroke::new(1.0, LINES));
        // The heights of 30° and 60°.
        for share in [1.0 / 3.0, 2.0 / 3.0] {
            painter.circle_stroke(center, radius * share, Stroke::new(0.5, LINES));
        }
        let level = forward.map(|way| Vec2::new(way.x as f32, way.z as f32));
        if let Some(way) = level.filter(|way| way.length() > 1e-3) {
            let tip = center + way.normalized() * radius;
            painter.line_segment([center, tip], Stroke::new(1.5, LETTERS));
        }
        for (text, at, anchor) in [
            ("−Z", vec2(0.0, -1.0), Align2::CENTER_TOP),
            ("+X", vec2(1.0, 0.0), Align2::RIGHT_CENTER),
        ] {
            let at = center + at * (radius - 3.0);
            painter.text(at, anchor, text, FontId::proportional(10.0), LETTERS);
        }
        painter.circle(self.point(sun_deg), 5.5, SUN, Stroke::new(1.5, SHADE));
    }
}
