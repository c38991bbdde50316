//! The edges of analytic shapes, and the lines that a wireframe shows on round ones.

use super::Part;
use glam::{DAffine3, DVec3};
use glimray_scene::{CanonicalShape, Geometry};
use std::f64::consts::{PI, TAU};

/// Lines of a circle, and circles of a round surface in each direction.
const SEGMENTS: usize = 64;
const CIRCLES: usize = 8;

/// The edges of a shape in world space, or all lines of its wireframe. A plane has none.
pub(super) fn part(geometry: &Geometry, place: DAffine3, all: bool) -> Part {
    let (lines, own) = match *geometry {
        Geometry::Sphere { center, radius } => (
            canonical(&CanonicalShape::Ellipsoid, all),
            DAffine3::from_translation(center) * DAffine3::from_scale(DVec3::splat(radius)),
        ),
        Geometry::Plane { .. } => (Vec::new(), DAffine3::IDENTITY),
        Geometry::Placed {
            canonical: shape,
            world_from_canonical,
        } => (canonical(&shape, all), world_from_canonical),
    };
    let place = place * own;
    let mut part = Part {
        points: Vec::new(),
        edges: Vec::new(),
    };
    for line in lines {
        let first = part.points.len() as u32;
        let last = first + line.len() as u32 - 1;
        part.edges
            .extend((first..last).map(|index| [index, index + 1]));
        part.points
            .extend(line.into_iter().map(|point| place.transform_point3(point)));
    }
    part
}

fn canonical(shape: &CanonicalShape, all: bool) -> Vec<Vec<DVec3>> {
    let ring = |radius: f64, y: f64| {
        circle(|angle| DVec3::new(radius * angle.cos(), y, radius * angle.sin()))
    };
    match *shape {
        CanonicalShape::Disc { hole } => [1.0, hole]
            .into_iter()
            .filter(|radius| *radius > 0.0)
            .map(|radius| ring(radius, 0.0))
            .collect(),
        CanonicalShape::Rectangle => vec![square(0.0)],
        CanonicalShape::Box => {
            let posts = [(-1.0, -1.0), (1.0, -1.0), (1.0, 1.0), (-1.0, 1.0)];
            let posts = posts.map(|(x, z)| vec![DVec3::new(x, -1.0, z), DVec3::new(x, 1.0, z)]);
            let mut lines = vec![square(-1.0), square(1.0)];
            lines.extend(posts);
            lines
        }
        CanonicalShape::Cone { bottom, top, .. } => {
            let rims = [(bottom, 0.0), (top, 1.0)].into_iter();
            let rims = rims.filter(|(radius, _)| *radius > 0.0);
            let mut lines: Vec<_> = rims.map(|(radius, y)| ring(radius, y)).collect();
            if all {
                lines.extend(around().map(|angle| {
                    let way = DVec3::new(angle.cos(), 0.0, angle.sin());
                    vec![way * bottom, way * top + DVec3::Y]
                }));
            }
            lines
        }
        CanonicalShape::Torus { minor } if all => {
            let mut lines: Vec<_> = around()
                .map(|angle| {
                    let way = DVec3::new(angle.cos(), 0.0, angle.sin());
                    circle(|turn| way * (1.0 + minor * turn.cos()) + DVec3::Y * minor * turn.sin())
                })
                .collect();
            lines.extend(around().map(|turn| ring(1.0 + minor * turn.cos(), minor * turn.sin())));
            lines
        }
        CanonicalShape::Ellipsoid if all => {
            let mut lines: Vec<_> = (around().take(CIRCLES / 2))
                .map(|angle| {
                    let way = DVec3::new(angle.cos(), 0.0, angle.sin());
                    circle(|turn| way * turn.cos() + DVec3::Y * turn.sin())
                })
                .collect();
            lines.extend((1..CIRCLES).map(|index| {
                let latitude = PI * (index as f64 / CIRCLES as f64 - 0.5);
                ring(latitude.cos(), latitude.sin())
            }));
            lines
        }
        CanonicalShape::Torus { .. } | CanonicalShape::Ellipsoid => Vec::new(),
    }
}

fn around() -> impl Iterator<Item = f64> {
    (0..CIRCLES).map(|index| TAU * index as f64 / CIRCLES as f64)
}

fn circle(point: impl Fn(f64) -> DVec3) -> Vec<DVec3> {
    (0..=SEGMENTS)
        .map(|index| point(TAU * index as f64 / SEGMENTS as f64))
        .collect()
}

fn square(y: f64) -> Vec<DVec3> {
    [
        (-1.0, -1.0),
        (1.0, -1.0),
        (1.0, 1.0),
        (-1.0, 1.0),
        (-1.0, -1.0),
    ]
    .map(|(x, z)| DVec3::new(x, y, z))
    .to_vec()
}
