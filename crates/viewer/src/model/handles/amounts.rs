//! The result of a move, rotation or scale by an amount, dragged or typed.

use crate::model::handles::{Dragged, Eye, Grip, Part};
use crate::model::tool::Tool;
use glam::{DAffine3, DMat3, DQuat, DVec3};

/// Smallest scale factor of a drag.
const LEAST: f64 = 0.01;

impl Grip {
    /// The transform for an exact amount, independent of the pointer: scene units along the handle's axis (x
    /// for the free handle, the first axis of a plane), degrees, or a factor.
    pub fn by(&self, eye: Eye, amount: f64) -> Dragged {
        let axes = self.handles.axes;
        match (self.handles.tool, self.part) {
            (Tool::Rotate, Part::Ring(axis)) => self.turned_by(axes[axis], amount.to_radians()),
            (Tool::Rotate, _) => {
                self.turned_by(-eye.toward(self.handles.origin), amount.to_radians())
            }
            (Tool::Scale, _) => self.scaled_by(amount),
            (_, Part::Axis(axis)) => self.moved_by(axes[axis] * amount),
            (_, Part::Plane(axis)) => self.moved_by(axes[(axis + 1) % 3] * amount),
            _ => self.moved_by(axes[0] * amount),
        }
    }

    pub(super) fn moved_by(&self, way: DVec3) -> Dragged {
        let parts = ["x", "y", "z"].into_iter().zip(way.to_array());
        let parts = parts.filter(|(_, by)| by.abs() > 1e-9 * self.handles.reach);
        let parts: Vec<String> = parts.map(|(name, by)| format!("{name} {by:+.3}")).collect();
        let mut place = self.start;
        place.translation += way;
        Dragged {
            place,
            label: parts.join("  "),
        }
    }

    pub(super) fn turned_by(&self, axis: DVec3, angle: f64) -> Dragged {
        let turn = DMat3::from_quat(DQuat::from_axis_angle(axis, angle));
        Dragged {
            place: DAffine3 {
                matrix3: turn * self.start.matrix3,
                translation: self.start.translation,
            },
            label: format!("{:+.1}°", angle.to_degrees()),
        }
    }

    pub(super) fn scaled_by(&self, factor: f64) -> Dragged {
        let factor = if factor.is_finite() {
            factor.max(LEAST)
        } else {
            1.0
        };
        let scale = match self.part {
            Part::Axis(axis) => DVec3::ONE + DMat3::IDENTITY.col(axis) * (factor - 1.0),
            _ => DVec3::splat(factor),
        };
        Dragged {
            place: DAffine3 {
                matrix3: self.start.matrix3 * DMat3::from_diagonal(scale),
                translation: self.start.translation,
            },
            label: format!("× {factor:.3}"),
        }
    }
}
