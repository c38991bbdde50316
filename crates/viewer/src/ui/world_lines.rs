//! Many thin lines of the world, drawn at once: hidden ones faintly.

use crate::model::sight::Sight;
use crate::ui::world_painter::WorldPainter;
use eframe::egui::{Color32, Mesh, Pos2, Shape, Vec2};
use glam::DVec3;
use std::sync::Arc;

/// The longest piece of a line, in points: of one colour, and of one visibility.
const LONGEST: f32 = 40.0;
const TESTED: f32 = 4.0;

/// Lines as triangles with soft edges. Drawing them costs no more than copying them.
#[derive(Default)]
pub struct WorldLines {
    mesh: Mesh,
}

impl WorldLines {
    /// Adds a line in world space. `ink` gives the colour at a point, from whether it is visible; so long as that is not known
    /// everything is.
    pub fn add(
        &mut self,
        view: &WorldPainter,
        sight: Option<&Sight>,
        ends: [DVec3; 2],
        ink: impl Fn(DVec3, bool) -> Color32,
    ) {
        let Some([a, b]) = view.segment(ends) else {
            return;
        };
        let Some((first, last)) = inside(view, a, b) else {
            return;
        };
        let longest = if sight.is_some() { TESTED } else { LONGEST };
        let count = (((last - first) * a.distance(b)) / longest).ceil().max(1.0) as usize;
        let eye = view.eye;
        let mut before: Option<(Pos2, Color32)> = None;
        for index in 0..=count {
            let share = first + (last - first) * index as f32 / count as f32;
            let at = a.lerp(b, share);
            let position = view.viewport.position(at);
            let line = (ends[0], ends[1]);
            let along = eye.distance_along(line, position);
            let color = along.map(|(point, distance)| {
                let is_seen = sight.is_none_or(|sight| sight.shows(position, distance));
                ink(point, is_seen)
            });
            let here = (at, color.unwrap_or(Color32::TRANSPARENT));
            if let Some(before) = before.filter(|it| it.1.a() > 0 || here.1.a() > 0) {
                self.piece(before, here, 1.0);
            }
            before = Some(here);
        }
    }

    /// Adds a line on the screen, of one colour.
    pub fn add_on_screen(&mut self, [a, b]: [Pos2; 2], color: Color32) {
        self.piece((a, color), (b, color), 1.0);
    }

    /// A strip whose colour is full in its middle and ends `half` points beside it.
    fn piece(&mut self, (a, from): (Pos2, Color32), (b, to): (Pos2, Color32), half: f32) {
        let side = (b - a).normalized().rot90() * half;
        if side == Vec2::ZERO {
            return;
        }
        let base = self.mesh.vertices.len() as u32;
        for (at, color) in [(a, from), (b, to)] {
            self.mesh.colored_vertex(at - side, Color32::TRANSPARENT);
            self.mesh.colored_vertex(at, color);
            self.mesh.colored_vertex(at + side, Color32::TRANSPARENT);
        }
        for [i, j, k] in [[0, 1, 3], [1, 4, 3], [1, 2, 4], [2, 5, 4]] {
            self.mesh.add_triangle(base + i, base + j, base + k);
        }
    }

    /// The lines, to be drawn.
    pub fn shape(self) -> Shape {
        Shape::Mesh(Arc::new(self.mesh))
    }
}

/// The part of a line between two points of the screen that can be seen, as shares of the way.
fn inside(view: &WorldPainter, a: Pos2, b: Pos2) -> Option<(f32, f32)> {
    let space = view.painter.clip_rect().intersect(view.viewport.rect);
    let (mut first, mut last) = (0.0_f32, 1.0_f32);
    for axis in 0..2 {
        let way = b[axis] - a[axis];
        let [near, far] = [space.min[axis] - a[axis], space.max[axis] - a[axis]];
        if way == 0.0 {
            if near > 0.0 || far < 0.0 {
                return None;
            }
            continue;
        }
        let (t, u) = (near / way, far / way);
        first = first.max(t.min(u));
        last = last.min(t.max(u));
    }
    (first < last).then_some((first, last))
}
