//! A ray tree for people to read.

use crate::app::error::AppError;
use crate::render::{RayHit, RayKind, RaySplit, RayTree, SampleTree, ShadowRay, TracedRay};
use crate::scene::ObjectRef;
use glam::{DVec3, Vec3};
use serde_json::json;
use std::fmt::{self, Write};

/// The tree of every sample, what they add up to, and the pixel.
pub fn of(tree: &RayTree, (width, height): (u32, u32)) -> Result<String, fmt::Error> {
    let mut out = String::new();
    let [x, y] = tree.pixel;
    writeln!(out, "pixel {x},{y} of {width}×{height}")?;
    for sample in &tree.samples {
        write_sample(&mut out, sample)?;
    }
    let count = tree.samples.len();
    let sum = color(weighted_sum(tree).as_vec3().into());
    writeln!(out, "sum    {sum}, the weighted mean of {count} sample(s)")?;
    writeln!(out, "pixel  {} (linear)", color(tree.value))?;
    Ok(out)
}

/// The tree as it is, with the size of the picture: what `--json` prints.
///
/// # Errors
/// None that is known: the tree is made of numbers and texts.
pub fn json(tree: &RayTree, (width, height): (u32, u32)) -> Result<String, AppError> {
    let mut value = serde_json::to_value(tree)
        .map_err(|error| AppError::Internal(format!("explain: {error}")))?;
    value["size"] = json!([width, height]);
    value["sum"] = json!(weighted_sum(tree).to_array());
    Ok(format!("{value:#}\n"))
}

/// What all rays add to the pixel: contributions by the weights of their samples, over the sum of
/// weights.
pub fn weighted_sum(tree: &RayTree) -> DVec3 {
    let kept = tree.samples.iter().filter(|sample| !sample.dropped);
    let (mut sum, mut weights) = (DVec3::ZERO, 0.0);
    for sample in kept {
        let weight = f64::from(sample.weight);
        sum += weight * ray_sum(sample);
        weights += weight;
    }
    if weights == 0.0 { sum } else { sum / weights }
}

/// What the rays of a sample add up to.
pub fn ray_sum(sample: &SampleTree) -> DVec3 {
    let of = |ray: &TracedRay| Vec3::from(ray.contribution).as_dvec3();
    sample.rays.iter().map(of).sum()
}

fn write_sample(out: &mut String, sample: &SampleTree) -> fmt::Result {
    let SampleTree {
        sample: index,
        weight,
        time,
        rays,
        ray_count,
        ..
    } = sample;
    write!(out, "sample {index}: {ray_count} ray(s), weight {weight}")?;
    if *time > 0.0 {
        write!(out, ", at {} of the time the shutter is open", short(*time))?;
    }
    writeln!(out)?;
    if !rays.is_empty() {
        write_ray(out, rays, 0, "", true)?;
    }
    if rays.len() < *ray_count {
        writeln!(out, "  cut off after {} rays", rays.len())?;
    }
    if sample.cut_off {
        writeln!(
            out,
            "  the tree had too many rays: some are missing in the picture too"
        )?;
    }
    let sum = color(ray_sum(sample).as_vec3().into());
    writeln!(out, "  sum {sum}, colour {}", color(sample.color))?;
    if sample.dropped {
        writeln!(out, "  left out of the pixel, as it is not finite")?;
    }
    Ok(())
}

fn write_ray(
    out: &mut String,
    rays: &[TracedRay],
    index: usize,
    before: &str,
    is_last: bool,
) -> fmt::Result {
    let ray = &rays[index];
    let branch = if is_last { "└ " } else { "├ " };
    let below = format!("{before}{}", if is_last { "  " } else { "│ " });
    write!(out, "{before}{branch}{}", kind(ray.kind))?;
    let bar = if ray.children.is_empty() {
        "  "
    } else {
        "│ "
    };
    let detail = format!("{below}{bar}");
    match (&ray.shadow, &ray.hit) {
        (Some(shadow), hit) => write_shadow(out, shadow, hit.as_ref(), ray)?,
        (None, Some(hit)) => write_hit(out, &detail, hit, ray)?,
        (None, None) => {
            let [direction, throughput] = [vector(ray.direction), color(ray.throughput)];
            let added = color(ray.contribution);
            writeln!(out, " towards {direction} meets nothing")?;
            writeln!(
                out,
                "{detail}throughput {throughput}, adds {added} (background)"
            )?;
        }
    }
    for (place, &child) in ray.children.iter().enumerate() {
        let is_last = place + 1 == ray.children.len();
        write_ray(out, rays, child, &below, is_last)?;
    }
    Ok(())
}

fn write_shadow(
    out: &mut String,
    shadow: &ShadowRay,
    hit: Option<&RayHit>,
    ray: &TracedRay,
) -> fmt::Result {
    write!(
        out,
        " to light {}{}",
        shadow.light,
        quoted(&shadow.light_name)
    )?;
    if let Some(distance) = shadow.distance {
        write!(out, ", {} away", short(distance))?;
    }
    match hit {
        Some(hit) if shadow.blocked => {
            let (what, distance) = (object(hit), short(hit.distance));
            writeln!(out, ": blocked by {what} after {distance}")
        }
        _ if shadow.blocked => writeln!(out, ": blocked"),
        _ => {
            let throughput = color(ray.throughput);
            let added = color(ray.contribution);
            match shadow.crossings {
                0 => write!(out, ": free")?,
                count => {
                    let through = color(shadow.transmittance);
                    write!(out, ": {through} comes through {count} surface(s)")?;
                }
            }
            writeln!(out, ", throughput {throughput}, adds {added}")
        }
    }
}

fn write_hit(out: &mut String, detail: &str, hit: &RayHit, ray: &TracedRay) -> fmt::Result {
    let distance = short(hit.distance);
    write!(out, " hits {} after {distance}", object(hit))?;
    if let Some(material) = hit.material {
        let name = quoted(&hit.material_name);
        write!(out, ", material {material}{name}")?;
    }
    writeln!(out)?;
    let side = if hit.outside { "outside" } else { "inside" };
    let [position, normal] = [hit.position, hit.normal].map(vector);
    writeln!(out, "{detail}at {position}, normal {normal}, from {side}")?;
    if let Some(split) = &hit.split {
        write_split(out, detail, split)?;
    }
    write!(out, "{detail}throughput {}", color(ray.throughput))?;
    if ray.arriving != ray.throughput {
        write!(out, ", {} arrives", color(ray.arriving))?;
    }
    let [added, ambient] = [ray.contribution, hit.ambient].map(color);
    write!(out, ", adds {added} (ambient {ambient}")?;
    if hit.emission != [0.0; 3] {
        write!(out, ", emission {}", color(hit.emission))?;
    }
    writeln!(out, ")")
}

fn write_split(out: &mut String, detail: &str, split: &RaySplit) -> fmt::Result {
    let is_mirror = split.reflect != [0.0; 3];
    if !is_mirror && !split.transparent {
        return Ok(());
    }
    write!(out, "{detail}reflects {}", color(split.reflect))?;
    if split.transparent {
        write!(out, ", transmits {}", color(split.transmit))?;
    }
    if let Some(reflectance) = split.reflectance {
        write!(out, ", Fresnel {}", short(reflectance))?;
    }
    if split.total {
        write!(out, ", total reflection")?;
    }
    if split.transparent && split.boundary {
        let [front, behind] = split.iors.map(short);
        write!(out, ", index {front} to {behind}")?;
    }
    if !split.boundary {
        write!(out, ", no boundary: the medium goes on")?;
    }
    if let Some(medium) = split.medium {
        let name = quoted(&split.medium_name);
        write!(out, ", in material {medium}{name}")?;
    }
    writeln!(out)
}

/// As a word.
pub fn kind(kind: RayKind) -> &'static str {
    match kind {
        RayKind::Primary => "primary",
        RayKind::Shadow => "shadow",
        RayKind::Reflection => "reflection",
        RayKind::Refraction => "refraction",
    }
}

/// What was hit: its number, and its name where it has one.
pub fn object(hit: &RayHit) -> String {
    let name = quoted(&hit.name);
    match hit.object {
        Some(ObjectRef::Instance(index)) => {
            format!("instance {index}{name} (triangle {})", hit.primitive)
        }
        Some(ObjectRef::Shape(index)) => format!("shape {index}{name}"),
        Some(ObjectRef::Light(index)) => format!("light {index}{name}"),
        None => format!("primitive {}", hit.primitive),
    }
}

/// A name to follow a number. One of many lines must not pass for several.
pub fn quoted(name: &Option<String>) -> String {
    let quote = |name: &String| format!(" `{}`", name.replace(char::is_control, " "));
    name.as_ref().map(quote).unwrap_or_default()
}

/// Coordinates, four digits of each.
pub fn vector(v: [f64; 3]) -> String {
    format!("({})", v.map(short).join(", "))
}

/// Linear radiance or a throughput: red, green, blue, four digits of each.
pub fn color(c: [f32; 3]) -> String {
    c.map(short).join(" ")
}

/// Four digits at most, wherever they begin.
pub fn short(value: impl Into<f64>) -> String {
    let value: f64 = value.into();
    let rounded: f64 = format!("{value:.3e}").parse().unwrap_or(value);
    // Adding 0 turns -0 into 0.
    format!("{}", rounded + 0.0)
}
