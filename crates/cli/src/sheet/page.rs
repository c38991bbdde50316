//! The page of a sheet: a title, the views in rows, each below its name, and a scale bar.

use super::canvas::{self, Color, LETTER_HEIGHT};
use super::shot::{Shot, Shots};
use crate::args::VIEWS;
use crate::report::{SceneReport, SheetReport, SheetView};
use glam::{DMat3, DVec2, DVec3};
use glimray_app::legend;
use glimray_scene::image::Image;
use std::iter;

/// The space around the page and between views, and the height of a line, in pixels.
const GAP: u32 = 12;
const LINE: u32 = LETTER_HEIGHT + 4;

/// The most views in a row.
const COLUMNS: usize = 4;

const PAPER: Color = [1.0; 3];
const INK: Color = [0.0; 3];

/// The axes: their length, the distance from the corner and between an end and the middle of its letter, in pixels;
/// and those of x, y and z.
const AXIS: f64 = 26.0;
const CORNER: f64 = 18.0;
const LETTER: f64 = 9.0;
const AXES: [(&str, DVec3, Color); 3] = [
    ("x", DVec3::X, [0.80, 0.05, 0.05]),
    ("y", DVec3::Y, [0.0, 0.45, 0.0]),
    ("z", DVec3::Z, [0.05, 0.15, 0.90]),
];

/// A sheet that is being drawn.
pub struct Page {
    image: Image,
    side: u32,
    columns: usize,
}

/// Columns, and width and height in pixels, of a page for `count` views of `side` pixels square.
fn layout(side: u32, count: usize) -> (usize, (u32, u32)) {
    let columns = count.div_ceil(count.div_ceil(COLUMNS));
    let rows = count.div_ceil(columns) as u32;
    let width = columns as u32 * (side + GAP) + GAP;
    let height = 2 * (GAP + LINE) + rows * (LINE + side + GAP) + GAP;
    (columns, (width, height))
}

/// Width and height in pixels of a page for `count` views of `side` pixels square.
pub fn size(side: u32, count: usize) -> (u32, u32) {
    layout(side, count).1
}

impl Page {
    /// An empty page for these views, of `side` pixels square.
    pub fn new(side: u32, shots: &Shots) -> Self {
        let (columns, (width, height)) = layout(side, shots.list.len());
        let mut image = Image::new(width, height);
        canvas::fill(&mut image, [0, 0], [width, height], PAPER);
        Self {
            image,
            side,
            columns,
        }
    }

    /// The upper left pixel of a view.
    fn corner(&self, index: usize) -> [u32; 2] {
        let (column, row) = ((index % self.columns) as u32, (index / self.columns) as u32);
        let y = GAP + LINE + row * (LINE + self.side + GAP);
        [GAP + column * (self.side + GAP), y + LINE]
    }

    /// Puts the picture of a view in its place, with its name and the axes.
    pub fn place(&mut self, index: usize, shot: &Shot, picture: &Image) {
        let [x, y] = self.corner(index);
        let name = VIEWS.name(&shot.view);
        self.image.put(&picture.pixels, picture.width, [x, y]);
        self.write([x, y - LINE], self.side, name);
        self.draw_axes(
            DVec2::new(x.into(), (y + self.side).into()),
            shot.view.axes(),
        );
    }

    fn write(&mut self, [x, y]: [u32; 2], width: u32, text: &str) {
        canvas::write(&mut self.image, [x.into(), y.into()], width, text, INK);
    }

    /// Draws the axes of the world from `corner`, the lower left one of a view; those along the view are points, and left
    /// out.
    fn draw_axes(&mut self, corner: DVec2, axes: DMat3) {
        let end = |axis: DVec3| AXIS * DVec2::new(axis.dot(axes.x_axis), -axis.dot(axes.y_axis));
        let seen = AXES.map(|(name, axis, color)| (name, end(axis), color));
        let seen: Vec<_> = (seen.into_iter())
            .filter(|(_, end, _)| end.length() > 0.1 * AXIS)
            .collect();
        let ends = seen.iter().map(|(_, end, _)| *end);
        let (low, high) = ends.fold((DVec2::ZERO, DVec2::ZERO), |(low, high), end| {
            (low.min(end), high.max(end))
        });
        let origin = corner + DVec2::new(CORNER - low.x, -CORNER - high.y);
        for (width, is_edge) in [(4.0, true), (2.0, false)] {
            for (_, end, color) in &seen {
                let color = if is_edge { PAPER } else { *color };
                canvas::line(&mut self.image, [origin, origin + *end], width, color);
            }
        }
        for (name, end, color) in seen {
            let middle = origin + end + LETTER * end.normalize();
            canvas::write_edged(&mut self.image, middle, name, [color, PAPER]);
        }
    }

    /// Writes the name of the file, the size of the model's bounding box and the counts of what is in it.
    pub fn write_title(&mut self, name: &str, counts: &SceneReport, extent: DVec3) {
        let [x, y, z] = extent
            .to_array()
            .map(|length| legend::number(length as f32));
        let counts = [
            (counts.triangles, "triangles"),
            (counts.spheres, "spheres"),
            (counts.shapes, "other shapes"),
        ];
        let counts = counts.iter().filter(|(count, _)| *count > 0);
        let counts = counts.map(|(count, what)| format!("{count} {what}"));
        let width = self.image.width - 2 * GAP;
        let mut text = name.to_owned();
        for part in iter::once(format!("{x} × {y} × {z}")).chain(counts) {
            let longer = format!("{text}  {part}");
            // A narrow page has no room for all.
            if longer.chars().count() > canvas::fitting(width) {
                break;
            }
            text = longer;
        }
        self.write([GAP, GAP], width, &text);
    }

    /// Draws the scale bar of the views along an axis, if there are any.
    pub fn draw_scale(&mut self, shots: &Shots) {
        let (length, pixels) = shots.bar;
        if !shots.list.iter().any(|shot| shot.view.is_to_scale()) {
            return;
        }
        let top = self.image.height - GAP - LINE;
        let height = LETTER_HEIGHT / 2;
        let middle = top + height;
        canvas::fill(&mut self.image, [GAP, middle - 1], [pixels, 2], INK);
        for x in [GAP, GAP + pixels - 1] {
            canvas::fill(&mut self.image, [x, middle - height / 2], [1, height], INK);
        }
        let left = GAP + pixels + GAP;
        let text = format!(
            "{} in the views along an axis",
            legend::number(length as f32)
        );
        self.write(
            [left, top],
            self.image.width.saturating_sub(left + GAP),
            &text,
        );
    }

    /// Where the views are, and their scale.
    pub fn report(&self, shots: &Shots) -> SheetReport {
        let views = shots.list.iter().enumerate().map(|(index, shot)| {
            let [x, y] = self.corner(index);
            SheetView {
                name: VIEWS.name(&shot.view),
                x,
                y,
                units_per_pixel: shot.view.is_to_scale().then(|| shots.units_per_pixel()),
            }
        });
        SheetReport {
            views: views.collect(),
            side: self.side,
            scale_bar: shots.bar.0,
        }
    }

    pub fn into_image(self) -> Image {
        self.image
    }
}
