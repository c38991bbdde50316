//! Which properties of vertices are read, and where they are.

use super::reader::Reader;
use super::types::Element;
use super::{AGAIN, Purpose, points};
use crate::import::budget;
use crate::import::error::ImportError;
use crate::import::tint::{self, Rgb};
use glam::{DVec3, Vec2, Vec3, Vec4};
use glimray_scene::Shape;

/// The names of a vertex's colour.
pub(super) const COLORS: [[&str; 3]; 3] = [
    ["red", "green", "blue"],
    ["diffuse_red", "diffuse_green", "diffuse_blue"],
    ["r", "g", "b"],
];

/// The names of a vertex's linear colour and alpha, which glimray writes.
pub(super) const LINEAR_COLORS: [&str; 4] =
    ["linear_red", "linear_green", "linear_blue", "linear_alpha"];

/// Where the parts of a vertex are among the columns that are read.
#[derive(Default)]
pub(super) struct Layout {
    pub columns: Vec<usize>,
    pub normal: Option<usize>,
    pub uv: Option<usize>,
    pub second_uv: Option<usize>,
    pub tangent: Option<usize>,
    pub linear_color: Option<usize>,
    pub color: Option<usize>,
    pub material: Option<usize>,
    pub radius: Option<usize>,
}

impl Layout {
    pub fn of(reader: &Reader, element: &Element, purpose: Purpose) -> Result<Self, ImportError> {
        let mut layout = Self::default();
        let place = reader.columns(element, &["x", "y", "z"])?;
        layout.columns =
            place.ok_or_else(|| reader.refuse("its vertices lack x, y or z", AGAIN))?;
        let mut add = |columns: Option<Vec<usize>>| {
            let at = layout.columns.len();
            layout.columns.extend(columns.as_ref()?);
            Some(at)
        };
        layout.normal = add(reader.columns(element, &["nx", "ny", "nz"])?);
        for names in [["s", "t"], ["u", "v"], ["texture_u", "texture_v"]] {
            if layout.uv.is_none() {
                layout.uv = add(reader.columns(element, &names)?);
            }
        }
        if layout.uv.is_some() {
            layout.second_uv = add(reader.columns(element, &["s2", "t2"])?);
        }
        layout.linear_color = add(reader.columns(element, &LINEAR_COLORS)?);
        match purpose {
            Purpose::Mesh(_) => {
                layout.tangent = add(reader.columns(element, &["tx", "ty", "tz", "tw"])?);
                layout.material = add(reader.columns(element, &["material"])?);
            }
            Purpose::Model => {
                for names in COLORS {
                    if layout.color.or(layout.linear_color).is_none() {
                        layout.color = add(reader.columns(element, &names)?);
                    }
                }
                layout.radius = add(reader.columns(element, &["radius"])?);
            }
        }
        Ok(layout)
    }

    /// Memory in bytes of `count` vertices, including that of later steps.
    pub fn memory(&self, count: usize, is_double: bool, is_cloud: bool) -> u64 {
        // A position, a normal, its accumulator, and a material; see `Mesh::repair`.
        let mut needed = budget::size::<(Vec3, Vec3, u32)>(count);
        if self.normal.is_none() {
            needed += budget::size::<Option<DVec3>>(count);
        }
        for uv in [self.uv, self.second_uv] {
            needed += budget::size::<Vec2>(if uv.is_some() { count } else { 0 });
        }
        for four in [self.tangent, self.linear_color] {
            needed += budget::size::<Vec4>(if four.is_some() { count } else { 0 });
        }
        needed += budget::size::<DVec3>(if is_double { count } else { 0 });
        if self.color.is_some() {
            needed += match is_cloud {
                true => budget::size::<(Vec3, Option<Rgb>)>(count) + tint::bytes(),
                false => budget::size::<(Vec3, Vec4)>(count),
            };
        }
        needed += budget::size::<f32>(if self.radius.is_some() { count } else { 0 });
        if is_cloud {
            needed += budget::size::<DVec3>(count);
            needed += budget::size::<(Shape, DVec3)>(count.min(points::MOST));
        }
        needed
    }
}
