//! Colours of vertices: the numbers after the position in `v` statements. No specification has them. ZBrush, MeshLab and
//! others write red, green and blue; some write a weight before them or an opacity after them.

use crate::import::notes::Notes;
use crate::import::{budget, levels, tint};
use glam::{Vec3, Vec4};

/// The numbers after the positions of vertices.
#[derive(Default)]
pub(super) struct Colors {
    /// One for each vertex up to the last with a colour: three or four numbers; the rest is NaN.
    rows: Vec<[f32; 4]>,
}

impl Colors {
    pub fn is_empty(&self) -> bool {
        self.rows.is_empty()
    }

    /// Memory in bytes.
    pub fn memory(&self) -> u64 {
        budget::size::<([f32; 4], Vec3, Vec4)>(self.rows.len())
    }

    /// Gives the vertex with this index its three or four `numbers`.
    pub fn push(&mut self, vertex: usize, numbers: &[f64]) {
        let mut row = [f32::NAN; 4];
        for (place, number) in row.iter_mut().zip(numbers) {
            *place = *number as f32;
        }
        self.rows.resize(vertex, [f32::NAN; 4]);
        self.rows.push(row);
    }

    /// Linear colours with opacity; white where there is none. Notes what was changed.
    pub fn finish(mut self, notes: &mut Notes) -> Vec<Vec4> {
        // The first of four numbers is a weight if it is always 1 and the last one is not, which then is no opacity.
        let four = || self.rows.iter().filter(|row| !row[3].is_nan());
        let has_weights = four().all(|row| row[0] == 1.0) && four().any(|row| row[3] != 1.0);
        if has_weights {
            let four = self.rows.iter_mut().filter(|row| !row[3].is_nan());
            for row in four {
                *row = [row[1], row[2], row[3], f32::NAN];
            }
        }
        let has_color = |row: &&[f32; 4]| !row[0].is_nan();
        let given = self.rows.iter().filter(has_color);
        let mut colors: Vec<Vec3> = given.map(|&[r, g, b, _]| Vec3::new(r, g, b)).collect();
        let most = levels::normalize(&mut colors, notes);
        let mut colors = colors.into_iter();
        let rows = self.rows.iter().map(|row| match has_color(&row) {
            true => {
                let color = tint::linear(colors.next().unwrap_or(Vec3::ONE));
                let opacity = if row[3].is_nan() { 1.0 } else { row[3] / most };
                color.truncate().extend(opacity.clamp(0.0, 1.0))
            }
            false => Vec4::ONE,
        });
        rows.collect()
    }
}
