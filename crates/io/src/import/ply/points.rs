//! A PLY file without faces is a cloud of points, which are shown as spheres.

use super::Content;
use crate::import::notes::Notes;
use glam::DVec3;
use glimray_scene::{Geometry, Shape};

/// Limit of the number of spheres: of more points, every second, third … is shown.
pub(super) const MOST: usize = 1 << 19;

/// The radius of each point if the file gives none: half of the diagonal of the bounds, divided by the square
/// root of the number of points. On a surface, neighbours then about touch each other.
fn radius(positions: &[DVec3]) -> f64 {
    let bounds = positions.iter().map(|&p| (p, p));
    let bounds = bounds.reduce(|a, b| (a.0.min(b.0), a.1.max(b.1)));
    let diagonal = bounds.map_or(0.0, |(min, max)| min.distance(max));
    match 0.5 * diagonal / (positions.len() as f64).sqrt() {
        radius if radius > 0.0 => radius,
        // All points are in one place.
        _ => 1.0,
    }
}

/// The spheres of a cloud, with the materials of its vertices.
pub(super) fn spheres(content: &Content, materials: &[u32], notes: &mut Notes) -> Vec<Shape> {
    let positions: Vec<DVec3> = (content.mesh.positions.iter())
        .map(|p| p.as_dvec3() + content.offset)
        .collect();
    let step = positions.len().div_ceil(MOST).max(1);
    if step > 1 {
        notes.add("points", || {
            format!(
                "one of {step} points is shown: there are {}, more than {MOST}",
                positions.len()
            )
        });
    }
    let shown: Vec<DVec3> = positions.iter().copied().step_by(step).collect();
    let usual = radius(&shown);
    let radius = |point: usize| {
        let own = content.radii.get(point).map(|&radius| f64::from(radius));
        own.filter(|own| *own > 0.0).unwrap_or(usual)
    };
    let sphere = |(i, center): (usize, DVec3)| Shape {
        geometry: Geometry::Sphere {
            center,
            radius: radius(i * step),
        },
        material: materials[i * step] as usize,
        node: None,
        name: String::new(),
    };
    shown.into_iter().enumerate().map(sphere).collect()
}
