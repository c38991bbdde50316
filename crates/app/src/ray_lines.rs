//! Writes a ray tree as 3-D lines in a Wavefront OBJ file, which most 3-D programs can open.

use glam::DVec3;
use glimray_render::{RayKind, RayTree, TracedRay};
use std::fmt::Write;

/// One line per ray, one group per kind and one object per sample. Rays without a hit are drawn as long as the
/// longest ray with a hit.
pub fn of(tree: &RayTree) -> String {
    let rays = || tree.samples.iter().flat_map(|sample| &sample.rays);
    let longest = rays().filter_map(length).fold(0.0, f64::max);
    let unbounded = if longest > 0.0 { longest } else { 1.0 };
    let [x, y] = tree.pixel;
    let mut out = format!("# rays of pixel {x},{y}\n");
    let mut vertex = 0;
    for sample in &tree.samples {
        let _ = writeln!(out, "o sample_{}", sample.sample);
        for (kind, name) in [
            (RayKind::Primary, "primary"),
            (RayKind::Reflection, "reflection"),
            (RayKind::Refraction, "refraction"),
            (RayKind::Passage, "passage"),
            (RayKind::Shadow, "shadow"),
        ] {
            let is_line = |ray: &&TracedRay| ray.kind == kind && ray.is_traced();
            let mut of_kind = sample.rays.iter().filter(is_line).peekable();
            if of_kind.peek().is_some() {
                let _ = writeln!(out, "g {name}");
            }
            for ray in of_kind {
                let far = DVec3::from(ray.origin) + unbounded * DVec3::from(ray.direction);
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

/// Length of a ray; `None` if it hits nothing.
fn length(ray: &TracedRay) -> Option<f64> {
    ray.end
        .map(|end| DVec3::from(end).distance(ray.origin.into()))
}
