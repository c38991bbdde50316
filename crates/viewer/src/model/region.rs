//! Dragging an edge or corner of the render region.

use glam::DVec2;

/// A drag of the region. Positions are fractions of the picture's width and height.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Grip {
    /// x0, y0, x1, y1 when the drag started.
    pub start: [f64; 4],
    /// Which of the edges follow the mouse, in the order of `start`.
    pub follows: [bool; 4],
    /// Where the drag started, as fractions of the width and height.
    pub from: DVec2,
}

impl Grip {
    /// The region for the mouse at `to`; edges may have been swapped.
    pub fn region(&self, to: DVec2) -> [f64; 4] {
        let moved = to - self.from;
        std::array::from_fn(|edge| {
            let shift = if edge % 2 == 0 { moved.x } else { moved.y };
            let at = self.start[edge] + if self.follows[edge] { shift } else { 0.0 };
            at.clamp(0.0, 1.0)
        })
    }
}
