//! Formats a ray tree as text.

pub mod path;

use crate::error::AppError;
use glam::{DVec3, Vec3};
use glimray_render::{
    Integrator, PhongTerms, RayHit, RayKind, RaySplit, RayTree, SampleTree, ShadowRay, TracedRay,
};
use glimray_scene::ObjectRef;
use glimray_scene::text;
use schemars::JsonSchema;
use serde::Serialize;
use std::fmt::{self, Write};

/// The tree of every sample, their weighted sum, and the pixel.
///
/// # Errors
/// None: a [`String`] takes any text.
pub fn of(tree: &RayTree, (width, height): (u32, u32)) -> Result<String, fmt::Error> {
    let mut out = String::new();
    let [x, y] = tree.pixel;
    writeln!(out, "pixel {x},{y} of {width}×{height}")?;
    for sample in &tree.samples {
        write_sample(&mut out, sample, tree.integrator)?;
    }
    let count = tree.samples.len();
    let sum = color(weighted_sum(tree).as_vec3().into());
    writeln!(out, "sum    {sum}, the weighted mean of {count} sample(s)")?;
    writeln!(out, "pixel  {} (linear)", color(tree.value))?;
    Ok(out)
}

/// The rays of a pixel, as `--json` prints them.
#[derive(Serialize, JsonSchema)]
pub struct Explanation<'a> {
    #[serde(flatten)]
    tree: &'a RayTree,
    /// Width and height of the picture in pixels.
    size: [u32; 2],
    /// Linear radiance: the weighted mean over the samples of the sum of their rays' contributions.
    sum: [f64; 3],
}

/// The output of `--json`.
///
/// # Errors
/// The tree cannot be serialized, which would be a bug.
pub fn json(tree: &RayTree, (width, height): (u32, u32)) -> Result<String, AppError> {
    let explanation = Explanation {
        tree,
        size: [width, height],
        sum: weighted_sum(tree).to_array(),
    };
    let value = serde_json::to_value(explanation)
        .map_err(|error| AppError::Internal(format!("explain: {error}")))?;
    Ok(text::escape_json(&format!("{value:#}\n")))
}

/// The weighted mean over the samples of the sum of their rays' contributions.
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

/// The sum of the contributions of a sample's rays.
pub fn ray_sum(sample: &SampleTree) -> DVec3 {
    let of = |ray: &TracedRay| Vec3::from(ray.contribution).as_dvec3();
    sample.rays.iter().map(of).sum()
}

fn write_sample(out: &mut String, sample: &SampleTree, integrator: Integrator) -> fmt::Result {
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
        write!(out, ", at {} of the shutter interval", short(*time))?;
    }
    writeln!(out)?;
    match integrator {
        Integrator::Path => path::write(out, rays)?,
        _ if rays.is_empty() => {}
        _ => write_ray(out, rays, 0, "", true)?,
    }
    if rays.len() < *ray_count {
        writeln!(out, "  only the first {} rays are listed", rays.len())?;
    }
    if sample.cut_off {
        writeln!(
            out,
            "  the tree was truncated: some rays are missing in the picture too"
        )?;
    }
    let sum = color(ray_sum(sample).as_vec3().into());
    writeln!(out, "  sum {sum}, colour {}", color(sample.color))?;
    if sample.dropped {
        writeln!(out, "  dropped from the pixel, because it is not finite")?;
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
        (Some(shadow), hit) => write_shadow(out, &detail, (shadow, hit.as_ref()), ray)?,
        (None, Some(hit)) => write_hit(out, &detail, hit, ray)?,
        (None, None) => {
            let [direction, throughput] = [vector(ray.direction), color(ray.throughput)];
            let added = color(ray.contribution);
            writeln!(out, " towards {direction} hits nothing")?;
            writeln!(
                out,
                "{detail}throughput {throughput}, contribution {added} (background)"
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
    detail: &str,
    (shadow, hit): (&ShadowRay, Option<&RayHit>),
    ray: &TracedRay,
) -> fmt::Result {
    write!(out, " to {}", target(shadow))?;
    if let Some(distance) = shadow.distance {
        write!(out, ", {} away", short(distance))?;
    }
    match hit {
        _ if !shadow.is_traced() => writeln!(out, ": not traced, nothing of it is reflected")?,
        Some(hit) if shadow.blocked => {
            let (what, distance) = (object(hit), short(hit.distance));
            writeln!(out, ": blocked by {what} at distance {distance}")?;
        }
        _ if shadow.blocked => writeln!(out, ": blocked")?,
        _ => {
            let throughput = color(ray.throughput);
            let added = color(ray.contribution);
            match shadow.crossings {
                0 => write!(out, ": unoccluded")?,
                count => {
                    let through = color(shadow.transmittance);
                    write!(out, ": transmittance {through} through {count} surface(s)")?;
                }
            }
            writeln!(out, ", throughput {throughput}, contribution {added}")?;
        }
    }
    match &shadow.phong {
        Some(terms) => write_phong(out, detail, terms),
        None => Ok(()),
    }
}

fn write_phong(out: &mut String, detail: &str, terms: &PhongTerms) -> fmt::Result {
    let [l_n, r_v, alpha] = [terms.l_dot_n, terms.r_dot_v, terms.alpha].map(short);
    let light = color(terms.light);
    writeln!(out, "{detail}L {light}, l·n {l_n}, r·v {r_v}, α {alpha}")?;
    let [diffuse, k_d] = [terms.diffuse, terms.k_d].map(color);
    write!(out, "{detail}diffuse {diffuse} (k_d {k_d})")?;
    let [highlight, k_s] = [terms.highlight, terms.k_s].map(color);
    writeln!(out, ", highlight {highlight} (k_s {k_s})")
}

fn write_hit(out: &mut String, detail: &str, hit: &RayHit, ray: &TracedRay) -> fmt::Result {
    let distance = short(hit.distance);
    write!(out, " hits {} at distance {distance}", object(hit))?;
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
        write!(out, ", arriving {}", color(ray.arriving))?;
    }
    let [added, ambient] = [ray.contribution, hit.ambient].map(color);
    write!(out, ", contribution {added} (ambient {ambient}")?;
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
        write!(out, ", total internal reflection")?;
    }
    if split.transparent && split.boundary {
        let [front, behind] = split.iors.map(short);
        write!(out, ", refractive index {front} to {behind}")?;
    }
    if !split.boundary {
        write!(out, ", no boundary: the medium continues")?;
    }
    if let Some(medium) = split.medium {
        let name = quoted(&split.medium_name);
        write!(out, ", in material {medium}{name}")?;
    }
    writeln!(out)
}

/// Name of a kind of ray.
pub fn kind(kind: RayKind) -> &'static str {
    match kind {
        RayKind::Primary => "primary",
        RayKind::Shadow => "shadow",
        RayKind::Reflection => "reflection",
        RayKind::Refraction => "refraction",
        RayKind::Passage => "passage",
    }
}

/// Name of the kind of a ray, with the lobe that it left in.
pub fn way(ray: &TracedRay) -> String {
    let kind = kind(ray.kind);
    match ray.lobe {
        Some(lobe) => format!("{} {kind}", path::lobe_name(lobe)),
        None => kind.to_owned(),
    }
}

/// The target of a shadow ray: the number of a light or an object, and its name if it has one.
pub fn target(shadow: &ShadowRay) -> String {
    let emitter = shadow.sample.as_ref().and_then(|sample| {
        let triangle = sample.primitive?;
        Some(named(sample.emitter, &sample.emitter_name, triangle))
    });
    match (shadow.light, emitter) {
        (Some(light), _) => format!("light {light}{}", quoted(&shadow.light_name)),
        (None, Some(emitter)) => emitter,
        (None, None) => "the background".to_owned(),
    }
}

/// The hit object's number, and its name if it has one.
pub fn object(hit: &RayHit) -> String {
    named(hit.object, &hit.name, hit.primitive)
}

fn named(object: Option<ObjectRef>, name: &Option<String>, primitive: u32) -> String {
    let name = quoted(name);
    match object {
        Some(ObjectRef::Instance(index)) => {
            format!("instance {index}{name} (triangle {primitive})")
        }
        Some(ObjectRef::Shape(index)) => format!("shape {index}{name}"),
        Some(ObjectRef::Light(index)) => format!("light {index}{name}"),
        None => format!("primitive {primitive}"),
    }
}

/// Quotes a name to follow a number. Line breaks are replaced, so that a name cannot imitate output lines.
pub fn quoted(name: &Option<String>) -> String {
    let quote = |name: &String| format!(" `{}`", text::one_line(name));
    name.as_ref().map(quote).unwrap_or_default()
}

/// Formats coordinates with four digits each.
pub fn vector(v: [f64; 3]) -> String {
    format!("({})", v.map(short).join(", "))
}

/// Formats red, green and blue of a radiance or throughput with four digits each.
pub fn color(c: [f32; 3]) -> String {
    c.map(short).join(" ")
}

/// Formats a number with at most four significant digits.
pub fn short(value: impl Into<f64>) -> String {
    let value: f64 = value.into();
    let rounded: f64 = format!("{value:.3e}").parse().unwrap_or(value);
    // Adding 0 turns -0 into 0.
    format!("{}", rounded + 0.0)
}
