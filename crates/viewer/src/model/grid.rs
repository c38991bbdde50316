//! The grid on the ground: which lines it has in a view.

use crate::model::handles::Eye;
use crate::model::snapping::{LEAST, grid_step};
use glam::DVec3;

/// Lines to each side of the middle.
const COUNT: i64 = 40;
/// Every so many lines one is stronger.
const STRONG: i64 = 10;

/// A line of the grid.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct GridLine {
    /// In world space.
    pub ends: [DVec3; 2],
    /// The axis of the world that it lies on, 0 to 2, if any.
    pub axis: Option<usize>,
    /// The strength of the line as a share of a full one, 0 to 1.
    pub strength: f64,
}

/// The grid of a view.
#[derive(Clone, Debug, PartialEq)]
pub struct Grid {
    /// The distance of neighbouring lines, in scene units: a power of ten.
    pub step: f64,
    /// The point around which it lies.
    pub middle: DVec3,
    /// How far it reaches, in scene units.
    pub reach: f64,
    /// The lines.
    pub lines: Vec<GridLine>,
}

impl Grid {
    /// The grid around `pivot`, in the plane through the origin across `up`. An orthographic camera that looks along that plane and
    /// along another axis gets the grid across its view. `length` is the size of a point of the screen at the pivot, in scene
    /// units. `None` for a view in which no grid can be seen.
    pub fn new(eye: Eye, up: DVec3, pivot: DVec3, length: f64) -> Option<Self> {
        let forward = eye.forward();
        let along = DVec3::AXES
            .into_iter()
            .find(|axis| axis.dot(forward).abs() > 0.999);
        let normal = match along {
            Some(axis) if eye.camera.orthographic_height.is_some() => axis,
            _ => up,
        };
        let across: Vec<usize> = (0..3).filter(|axis| normal[*axis].abs() < 0.5).collect();
        let &[first, second] = across.as_slice() else {
            return None;
        };
        let step = grid_step(length);
        if !step.is_normal() {
            return None;
        }
        let strong = step * STRONG as f64;
        let mut middle = (pivot / strong).round() * strong;
        middle -= normal * middle.dot(normal);
        let reach = step * COUNT as f64;
        // Near the next power of ten, the fine lines are far apart.
        let strength = (step / (LEAST * length)).log10().clamp(0.0, 1.0);
        let mut lines = Vec::new();
        for (own, other) in [(first, second), (second, first)] {
            let (way, side) = (DVec3::AXES[own], DVec3::AXES[other]);
            let index = (middle[other] / step).round() as i64;
            for offset in -COUNT..=COUNT {
                let at = middle + side * (step * offset as f64);
                let is_axis = index + offset == 0;
                lines.push(GridLine {
                    ends: [at - way * reach, at + way * reach],
                    axis: is_axis.then_some(own),
                    strength: match (index + offset) % STRONG == 0 {
                        true => 1.0,
                        false => 0.15 + 0.4 * strength,
                    },
                });
            }
        }
        Some(Self {
            step,
            middle,
            reach,
            lines,
        })
    }

    /// The strength of the grid at a point: it fades towards its end.
    pub fn fade(&self, point: DVec3) -> f64 {
        let share = (point.distance(self.middle) / self.reach).min(1.0);
        (1.0 - share * share).powi(2)
    }
}
