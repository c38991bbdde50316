//! A ray tree as lines in space: a Wavefront OBJ file, which most programs for 3-D models open.

use crate::render::{RayKind, RayTree, TracedRay};
use glam::DVec3;
use std::fmt::Write;

/// One line for each ray, in groups by kind, an object for each sample. Rays that go on for ever are as
/// long as the longest that ends.
pub fn of(tree: &RayTree) -> String {
    let rays = || tree.samples.iter().flat_map(|sample| &sample.rays);
    let longest = rays().filter_map(length).fold(0.0, f64::max);
    let endless = if longest > 0.0 { longest } else { 1.0 };
    let [x, y] = tree.pixel;
    let mut out = format!("# rays of pixel {x},{y}\n");
    let mut vertex = 0;
    for sample in &tree.samples {
        let _ = writeln!(out, "o sample_{}", sample.sample);
        for (kind, name) in [
            (RayKind::Primary, "primary"),
            (RayKind::Reflection, "reflection"),
            (RayKind::Refraction, "refraction"),
            (RayKind::Shadow, "shadow"),
        ] {
            let mut of_kind = sample.rays.iter().filter(|ray| ray.kind == kind).peekable();
            if of_kind.peek().is_some() {
                let _ = writeln!(out, "g {name}");
            }
            for ray in of_kind {
                let far = DVec3::from(ray.origin) + endless * DVec3::from(ray.direction);
                for [x, y, z] in [ray.origin, ray.end.unwrap_or(far.into())] {
                    let _ = writeln!(out, "v {x} {y} {z}");
                }
                vertex += 2;
                let _ = writeln!(out, "l {} {vertex}", vertex - 1);
            }
        }
    }
    out
}

/// `None` for a ray that goes on for ever.
fn length(ray: &TracedRay) -> Option<f64> {
    ray.end
        .map(|end| DVec3::from(end).distance(ray.origin.into()))
}
