//! Surfaces over u and v.

use glam::{Quat, Vec3, vec3};
use std::f32::consts::TAU;

/// Triangles with smooth normals and texture coordinates, v downwards as in glTF.
#[derive(Clone, Default)]
pub struct Surface {
    pub positions: Vec<Vec3>,
    pub normals: Vec<Vec3>,
    pub uvs: Vec<[f32; 2]>,
    pub triangles: Vec<[u16; 3]>,
}

impl Surface {
    /// The surface `point`(u, v) for u and v from 0 to 1, of columns × rows quads. Its front is where ∂u × ∂v
    /// points.
    pub fn grid([columns, rows]: [usize; 2], point: impl Fn(f32, f32) -> Vec3) -> Self {
        const STEP: f32 = 1e-3;
        let mut surface = Self::default();
        for row in 0..=rows {
            for column in 0..=columns {
                let (u, v) = (column as f32 / columns as f32, row as f32 / rows as f32);
                // At poles one derivative vanishes: take it a little inside.
                let inside = v.clamp(STEP, 1.0 - STEP);
                let along_u = point(u + STEP, inside) - point(u - STEP, inside);
                let along_v = point(u, inside + STEP) - point(u, inside - STEP);
                surface.positions.push(point(u, v));
                surface
                    .normals
                    .push(along_u.cross(along_v).normalize_or(Vec3::Y));
                surface.uvs.push([u, 1.0 - v]);
            }
        }
        surface.connect(0, columns, rows);
        surface
    }

    /// A profile of (radius, height) turned around the y axis: from the outside the profile runs upwards. Its
    /// corners are sharp where it turns by more than 30°.
    pub fn lathe(profile: &[[f32; 2]], segments: usize) -> Self {
        let mut surface = Self::default();
        let length: f32 = profile
            .windows(2)
            .map(|pair| distance(pair[0], pair[1]))
            .sum();
        let outward = |pair: &[[f32; 2]]| {
            let [a, b] = [pair[0], pair[1]];
            vec3(b[1] - a[1], a[0] - b[0], 0.0).normalize_or(Vec3::Y)
        };
        let mut so_far = 0.0;
        for (i, pair) in profile.windows(2).enumerate() {
            let here = outward(pair);
            let smooth = |other: Option<Vec3>| match other {
                Some(other) if here.dot(other) > 0.87 => (here + other).normalize(),
                _ => here,
            };
            let before = i.checked_sub(1).map(|before| outward(&profile[before..=i]));
            let after = profile.get(i + 1..i + 3).map(outward);
            let first = surface.positions.len();
            let next = so_far + distance(pair[0], pair[1]);
            for (end, normal, at) in [
                (pair[0], smooth(before), so_far),
                (pair[1], smooth(after), next),
            ] {
                for segment in 0..=segments {
                    let u = segment as f32 / segments as f32;
                    let (sin, cos) = (u * TAU).sin_cos();
                    surface
                        .positions
                        .push(vec3(end[0] * cos, end[1], -end[0] * sin));
                    surface
                        .normals
                        .push(vec3(normal.x * cos, normal.y, -normal.x * sin));
                    surface.uvs.push([u, 1.0 - at / length]);
                }
            }
            so_far = next;
            surface.connect(first, segments, 1);
        }
        surface
    }

    /// A ring around the y axis.
    pub fn torus(radius: f32, thickness: f32, around: usize, across: usize) -> Self {
        Self::grid([around, across], |u, v| {
            let (sin, cos) = (u * TAU).sin_cos();
            let (up, out) = (v * TAU).sin_cos();
            let reach = radius + thickness * out;
            vec3(reach * cos, thickness * up, -reach * sin)
        })
    }

    pub fn moved(mut self, by: Vec3) -> Self {
        self.positions.iter_mut().for_each(|point| *point += by);
        self
    }

    pub fn turned(mut self, by: Quat) -> Self {
        let vectors = self.positions.iter_mut().chain(&mut self.normals);
        vectors.for_each(|vector| *vector = by * *vector);
        self
    }

    pub fn add(&mut self, other: &Self) {
        let first = self.positions.len() as u16;
        self.positions.extend(&other.positions);
        self.normals.extend(&other.normals);
        self.uvs.extend(&other.uvs);
        let triangles = other.triangles.iter();
        self.triangles
            .extend(triangles.map(|corners| corners.map(|corner| corner + first)));
    }

    /// Triangles between rows of vertices from `first` on.
    fn connect(&mut self, first: usize, columns: usize, rows: usize) {
        for row in 0..rows {
            for column in 0..columns {
                let at = |down: usize, right: usize| {
                    (first + (row + down) * (columns + 1) + column + right) as u16
                };
                for corners in [
                    [at(0, 0), at(0, 1), at(1, 1)],
                    [at(0, 0), at(1, 1), at(1, 0)],
                ] {
                    let [a, b, c] = corners.map(|corner| self.positions[usize::from(corner)]);
                    if (b - a).cross(c - a).length() > 2e-8 {
                        self.triangles.push(corners);
                    }
                }
            }
        }
    }
}

fn distance(a: [f32; 2], b: [f32; 2]) -> f32 {
    (a[0] - b[0]).hypot(a[1] - b[1])
}
