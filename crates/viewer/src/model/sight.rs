//! The object and the distance that each pixel of a picture shows: what lies in a rectangle, what hides what, and where the
//! silhouettes of objects run.

mod contour;
mod limits;

pub use contour::contours;
pub use limits::Limits;

use glam::{DVec2, UVec2};
use glimray_scene::ObjectRef;
use std::collections::{BTreeSet, HashMap};

/// The first surface in each pixel of a picture, seen through its centre.
#[derive(Clone, Debug, PartialEq)]
pub struct Sight {
    /// The side of the square of pixels that share an entry; 1 unless the picture is large.
    step: u32,
    /// Number of entries in a row and in a column.
    size: UVec2,
    /// The objects that can be seen.
    objects: Vec<ObjectRef>,
    /// The index of the object plus 1, 0 for none, and the distance along the ray from where the ray begins, in scene units.
    /// Row by row from the top left.
    seen: Vec<(u32, f32)>,
}

impl Sight {
    /// The distance where nothing is hit.
    pub const NOTHING: f32 = f32::INFINITY;
    /// How much farther than a surface a point may be that lies on it, as a share of the distance.
    const SLACK: f64 = 2e-3;

    /// The entries of a picture of `size` pixels, where every `step`th row and column has one: what each of [`Sight::places`] shows,
    /// and how far away it is.
    ///
    /// # Panics
    /// The number of entries is another one.
    pub fn new(
        size: (u32, u32),
        step: u32,
        seen: impl Iterator<Item = (Option<ObjectRef>, f32)>,
    ) -> Self {
        let entries = Self::entries(size, step);
        let mut objects = Vec::new();
        let mut numbers = HashMap::new();
        let seen = seen.map(|(object, distance)| {
            let number = object.map_or(0, |object| {
                *numbers.entry(object).or_insert_with(|| {
                    objects.push(object);
                    objects.len() as u32
                })
            });
            (number, distance)
        });
        let seen: Vec<_> = seen.collect();
        assert_eq!(seen.len(), entries.element_product() as usize);
        Self {
            step,
            size: entries,
            objects,
            seen,
        }
    }

    fn entries((width, height): (u32, u32), step: u32) -> UVec2 {
        UVec2::new(width.div_ceil(step), height.div_ceil(step))
    }

    /// The places in a picture of `size` pixels that have an entry, in their order, in pixels from its upper left corner.
    pub fn places(size: (u32, u32), step: u32) -> impl Iterator<Item = DVec2> {
        let entries = Self::entries(size, step);
        let middle = f64::from(step) / 2.0;
        (0..entries.y).flat_map(move |y| {
            (0..entries.x).map(move |x| {
                let corner = DVec2::new(f64::from(x), f64::from(y)) * f64::from(step);
                corner + middle
            })
        })
    }

    fn entry(&self, column: i64, row: i64) -> Option<(u32, f32)> {
        let (width, height) = (i64::from(self.size.x), i64::from(self.size.y));
        let is_inside = (0..width).contains(&column) && (0..height).contains(&row);
        is_inside.then(|| self.seen[(row * width + column) as usize])
    }

    fn cell(&self, position: DVec2) -> (i64, i64) {
        let cell = (position / f64::from(self.step)).floor();
        (cell.x as i64, cell.y as i64)
    }

    /// The object with a number.
    fn object(&self, number: u32) -> Option<ObjectRef> {
        let index = (number as usize).checked_sub(1)?;
        self.objects.get(index).copied()
    }

    /// Whether a point that is projected to `position` is not hidden: `distance` is that from where the ray through it begins.
    /// A point on an edge belongs to the surface behind as well as to the one before, so neighbours count too. Outside of the
    /// picture nothing is hidden. Points beyond the [`Limits`] of the picture must be left out before.
    pub fn shows(&self, position: DVec2, distance: f64) -> bool {
        let (column, row) = self.cell(position);
        let mut farthest: Option<f32> = None;
        for (dx, dy) in [(0, 0), (-1, 0), (1, 0), (0, -1), (0, 1)] {
            if let Some((_, seen)) = self.entry(column + dx, row + dy) {
                farthest = Some(farthest.map_or(seen, |before| before.max(seen)));
            }
        }
        farthest.is_none_or(|farthest| distance * (1.0 - Self::SLACK) <= f64::from(farthest))
    }

    /// The objects that can be seen in the rectangle between two corners, in pixels.
    pub fn objects_in(&self, a: DVec2, b: DVec2) -> BTreeSet<ObjectRef> {
        let (min, max) = (self.cell(a.min(b)), self.cell(a.max(b)));
        let within = |from: i64, to: i64, count: u32| from.max(0)..(to + 1).min(count.into());
        let mut found = BTreeSet::new();
        for row in within(min.1, max.1, self.size.y) {
            for column in within(min.0, max.0, self.size.x) {
                found.extend(self.entry(column, row).map(|entry| entry.0));
            }
        }
        found
            .into_iter()
            .filter_map(|number| self.object(number))
            .collect()
    }

    /// All objects that can be seen, those first that cover most of the picture.
    pub fn objects(&self) -> Vec<ObjectRef> {
        let mut areas: Vec<(usize, ObjectRef)> = self.objects.iter().map(|it| (0, *it)).collect();
        for (number, _) in &self.seen {
            if let Some(index) = number.checked_sub(1) {
                areas[index as usize].0 += 1;
            }
        }
        areas.sort_by_key(|(area, object)| (std::cmp::Reverse(*area), *object));
        areas.into_iter().map(|(_, object)| object).collect()
    }

    /// The silhouette of each object that `is_part` accepts, in pixels from the upper left corner. Where the picture ends, they are
    /// open.
    pub fn silhouettes(&self, is_part: impl Fn(ObjectRef) -> bool) -> Vec<Vec<DVec2>> {
        let parts: Vec<bool> = self.objects.iter().map(|object| is_part(*object)).collect();
        let region = |(number, _): &(u32, f32)| match number.checked_sub(1) {
            Some(index) if parts[index as usize] => *number,
            _ => 0,
        };
        let regions: Vec<u32> = self.seen.iter().map(region).collect();
        let mut lines = contours(&regions, self.size);
        let step = f64::from(self.step);
        lines.iter_mut().flatten().for_each(|point| *point *= step);
        lines
    }
}
