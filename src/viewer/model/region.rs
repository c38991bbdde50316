//! The edge or corner of the render region that the mouse drags.

use glam::DVec2;

/// Which edges of the region follow the mouse. Positions are shares of the picture's width and height.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Grip {
    /// x0, y0, x1, y1 when it was taken.
    pub start: [f64; 4],
    pub follows: [bool; 4],
    pub from: DVec2,
}

impl Grip {
    /// The region once the mouse is at `to`; its edges may have changed places.
    pub fn region(&self, to: DVec2) -> [f64; 4] {
        let moved = to - self.from;
        std::array::from_fn(|edge| {
            let shift = if edge % 2 == 0 { moved.x } else { moved.y };
            let at = self.start[edge] + if self.follows[edge] { shift } else { 0.0 };
            at.clamp(0.0, 1.0)
        })
    }
}
