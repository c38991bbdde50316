//! Bounds of the lights in a node of the light tree: where they are, in which directions they shine, and how much.

use crate::layout::{
    LIGHT_DISC, LIGHT_POINT, LIGHT_RECTANGLE, LIGHT_SPHERE, LIGHT_SPOT, LIGHT_TWO_SIDED,
    PackedCluster, PackedLight,
};
use glam::{DQuat, DVec2, DVec3, Vec3};
use glimray_scene as scene;
use std::f64::consts::{FRAC_PI_2, PI};

/// [`scene::LUMINANCE`] in f32.
pub const LUMINANCE: Vec3 = Vec3::new(
    scene::LUMINANCE.x as f32,
    scene::LUMINANCE.y as f32,
    scene::LUMINANCE.z as f32,
);

/// Cosines of cones are lowered by this, for rounding.
const SLACK: f64 = 1e-3;

/// Lights in a box, with a cone around the directions in which they point.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Cluster {
    pub min: DVec3,
    pub max: DVec3,
    /// The sum of the intensities, in luminance; of a surface its area times its radiance, divided by π.
    pub power: f64,
    pub axis: DVec3,
    /// The angle from the axis of the farthest direction in which a light points, and the angle from this beyond which no
    /// light is sent, in radians.
    pub spread: f64,
    pub falloff: f64,
    /// Whether some light also shines against its direction.
    pub two_sided: bool,
}

fn wide(v: [f32; 3]) -> DVec3 {
    Vec3::from(v).as_dvec3()
}

impl Cluster {
    /// A lamp at all its keys, of which there is at least one.
    pub fn of_lamp<'a>(keys: impl Iterator<Item = &'a PackedLight>) -> Self {
        let mut count = 0.0;
        let keys = keys.inspect(|_| count += 1.0).map(Self::of_light);
        let mut all = keys.reduce(Self::union).expect("a key");
        all.power /= count;
        all
    }

    fn of_light(light: &PackedLight) -> Self {
        let (u, v) = (wide(light.edge_u).abs(), wide(light.edge_v).abs());
        let extent = match light.kind {
            LIGHT_RECTANGLE => u + v,
            LIGHT_DISC => (u * u + v * v).map(f64::sqrt),
            LIGHT_SPHERE => DVec3::splat(light.radius.into()),
            _ => DVec3::ZERO,
        };
        let center = wide(light.position);
        let (spread, falloff) = match light.kind {
            LIGHT_POINT | LIGHT_SPHERE => (PI, FRAC_PI_2),
            LIGHT_SPOT => {
                let [inner, outer] = [light.cos_inner, light.cos_outer]
                    .map(|cos| f64::from(cos).clamp(-1.0, 1.0).acos());
                match outer - inner < FRAC_PI_2 {
                    true => (inner, outer - inner),
                    false => (PI, FRAC_PI_2),
                }
            }
            _ => (0.0, FRAC_PI_2),
        };
        Self {
            min: center - extent,
            max: center + extent,
            power: LUMINANCE.dot(light.color.into()).into(),
            axis: wide(light.direction),
            spread,
            falloff,
            two_sided: false,
        }
    }

    /// A surface within a box, which shines along `normal`, or in all directions without one.
    pub fn of_surface((min, max): (DVec3, DVec3), power: f64, normal: Option<DVec3>) -> Self {
        Self {
            min,
            max,
            power,
            axis: normal.unwrap_or(DVec3::Y),
            spread: if normal.is_some() { 0.0 } else { PI },
            falloff: FRAC_PI_2,
            two_sided: false,
        }
    }

    pub fn middle(&self) -> DVec3 {
        (self.min + self.max) / 2.0
    }

    /// Both together. The smallest cone about both cones is algorithm 1 of the paper.
    pub fn union(self, other: Self) -> Self {
        let (wide, mut narrow) = match self.spread >= other.spread {
            true => (self, other),
            false => (other, self),
        };
        let mut all = Self {
            min: self.min.min(other.min),
            max: self.max.max(other.max),
            power: self.power + other.power,
            axis: wide.axis,
            spread: wide.spread,
            falloff: self.falloff.max(other.falloff),
            two_sided: self.two_sided || other.two_sided,
        };
        if wide.spread >= PI {
            return all;
        }
        // Either end of an axis will do.
        if all.two_sided && wide.axis.dot(narrow.axis) < 0.0 {
            narrow.axis = -narrow.axis;
        }
        let between = wide.axis.angle_between(narrow.axis);
        if (between + narrow.spread).min(PI) > wide.spread {
            let spread = (wide.spread + between + narrow.spread) / 2.0;
            let turn = wide.axis.cross(narrow.axis).try_normalize();
            match turn {
                Some(turn) if spread < PI => {
                    let by = DQuat::from_axis_angle(turn, spread - wide.spread);
                    all.axis = (by * wide.axis).normalize_or(wide.axis);
                    all.spread = spread;
                }
                _ => all.spread = PI,
            }
        }
        all
    }

    /// Power times the measure of the directions times the size.
    pub fn cost(&self) -> f64 {
        let widest = (self.spread + self.falloff).min(PI);
        let (sin, cos) = self.spread.sin_cos();
        let directions = 2.0 * PI * (1.0 - cos)
            + FRAC_PI_2
                * (2.0 * widest * sin
                    - (self.spread - 2.0 * widest).cos()
                    - 2.0 * self.spread * sin
                    + cos);
        let sides = if self.two_sided { 2.0 } else { 1.0 };
        let directions = (sides * directions).min(4.0 * PI);
        self.power * directions * (self.max - self.min).length_squared()
    }

    pub fn packed(&self, child: u32) -> PackedCluster {
        let middle = self.middle();
        let center = middle.as_vec3();
        // Rounding must not make it smaller.
        let extent = (self.max - self.min) / 2.0;
        let slack = 1e-6 * (extent.max_element() + middle.abs().max_element());
        let radius = match extent == DVec3::ZERO {
            true => 0.0,
            false => extent.length() + 2.0 * slack,
        };
        let lowered = |angle: f64| fraction((angle.cos() - SLACK).max(-1.0) - 0.5 / 32767.0);
        let cone = match self.spread < PI {
            true => lowered(self.spread),
            false => fraction(-1.0),
        };
        PackedCluster {
            center: center.into(),
            power: self.power as f32,
            radius2: (radius * radius) as f32,
            child: child | if self.two_sided { LIGHT_TWO_SIDED } else { 0 },
            axis: octahedral(self.axis),
            cones: cone | lowered(self.falloff) << 16,
        }
    }
}

/// The nearest signed 16-bit fraction.
fn fraction(x: f64) -> u32 {
    u32::from((x.clamp(-1.0, 1.0) * 32767.0).round() as i16 as u16)
}

/// See [`PackedCluster::axis`].
fn octahedral(axis: DVec3) -> u32 {
    let flat = axis / (axis.x.abs() + axis.y.abs() + axis.z.abs()).max(f64::MIN_POSITIVE);
    let mut at = flat.truncate();
    if flat.z < 0.0 {
        let signs = DVec2::new(1.0_f64.copysign(at.x), 1.0_f64.copysign(at.y));
        at = (1.0 - DVec2::new(at.y.abs(), at.x.abs())) * signs;
    }
    fraction(at.x) | fraction(at.y) << 16
}
