//! Formats the rays of a path: one after the other, each with its light sample and the direction chosen at its end.

use super::{color, object, quoted, short, target, vector, way, write_split};
use glimray_render::{
    LightSample, Lobe, PathStep, RayHit, ShadowRay, Sharing, StepOutcome, TracedRay,
};
use std::fmt::{self, Write};

/// The rays of a sample.
///
/// # Errors
/// None for a [`String`].
pub fn write(out: &mut String, rays: &[TracedRay]) -> fmt::Result {
    let segments: Vec<_> = (rays.iter().enumerate())
        .filter(|(_, ray)| ray.shadow.is_none())
        .collect();
    for (place, &(index, ray)) in segments.iter().enumerate() {
        let is_last = place + 1 == segments.len();
        let (branch, below) = if is_last {
            ("└ ", "  ")
        } else {
            ("├ ", "│ ")
        };
        write!(out, "{branch}{}", way(ray))?;
        write_segment(out, below, ray)?;
        let samples = (rays.iter()).filter(|other| other.parent == Some(index));
        for (sample, shadow) in samples.filter_map(|other| Some((other, other.shadow.as_ref()?))) {
            write_light_sample(out, below, sample, shadow)?;
        }
        if let Some(step) = &ray.step {
            writeln!(out, "{below}{}", describe(step))?;
        }
    }
    Ok(())
}

fn write_segment(out: &mut String, below: &str, ray: &TracedRay) -> fmt::Result {
    let mut found = String::new();
    match (&ray.hit, ray.background) {
        (Some(hit), _) => {
            write_hit(out, below, hit)?;
            if hit.emission != [0.0; 3] {
                found = format!(" (emission {}", color(hit.emission));
            }
        }
        (None, background) => {
            writeln!(out, " towards {} hits nothing", vector(ray.direction))?;
            found = format!(" (background {}", color(background.unwrap_or_default()));
        }
    }
    write!(out, "{below}throughput {}", color(ray.throughput))?;
    if ray.arriving != ray.throughput {
        write!(out, ", arriving {}", color(ray.arriving))?;
    }
    write!(out, ", contribution {}{found}", color(ray.contribution))?;
    match &ray.sharing {
        Some(sharing) if !found.is_empty() => {
            write!(out, ", weight {}", short(sharing.bsdf_weight))?;
            writeln!(out, "{})", densities(sharing))
        }
        _ => writeln!(out),
    }
}

fn write_hit(out: &mut String, below: &str, hit: &RayHit) -> fmt::Result {
    let distance = short(hit.distance);
    write!(out, " hits {} at distance {distance}", object(hit))?;
    if let Some(material) = hit.material {
        let name = quoted(&hit.material_name);
        write!(out, ", material {material}{name}")?;
    }
    writeln!(out)?;
    let side = if hit.outside { "outside" } else { "inside" };
    let [position, normal] = [hit.position, hit.normal].map(vector);
    writeln!(out, "{below}at {position}, normal {normal}, from {side}")?;
    match &hit.split {
        Some(split) => write_split(out, below, split),
        None => Ok(()),
    }
}

fn write_light_sample(
    out: &mut String,
    below: &str,
    ray: &TracedRay,
    shadow: &ShadowRay,
) -> fmt::Result {
    let Some(sample) = &shadow.sample else {
        return Ok(());
    };
    let chance = short(sample.chance);
    write!(out, "{below}samples {}, chance {chance}", target(shadow))?;
    if let Some(distance) = shadow.distance {
        write!(out, ", {} away", short(distance))?;
    }
    writeln!(out, ": {}", fate(sample, shadow, ray))?;
    if !sample.traced {
        return Ok(());
    }
    let [radiance, bsdf] = [sample.radiance, sample.bsdf].map(color);
    write!(out, "{below}  radiance per density {radiance}, BSDF {bsdf}")?;
    if let Some(sharing) = &ray.sharing {
        let weight = short(sharing.light_weight);
        write!(out, ", weight {weight}{}", densities(sharing))?;
    }
    writeln!(out, ", contribution {}", color(ray.contribution))
}

/// The outcome of a light sample.
fn fate(sample: &LightSample, shadow: &ShadowRay, ray: &TracedRay) -> String {
    match &ray.hit {
        _ if !sample.traced => "the surface scatters nothing of it".to_owned(),
        Some(hit) if shadow.blocked => {
            format!(
                "blocked by {} at distance {}",
                object(hit),
                short(hit.distance)
            )
        }
        _ if shadow.blocked => "blocked".to_owned(),
        _ if shadow.crossings == 0 => "unoccluded".to_owned(),
        _ => {
            let through = color(shadow.transmittance);
            format!(
                "transmittance {through} through {} surface(s)",
                shadow.crossings
            )
        }
    }
}

/// The densities of both ways to find a light.
fn densities(sharing: &Sharing) -> String {
    match (sharing.light_pdf, sharing.bsdf_pdf) {
        (Some(light), Some(path)) => {
            format!(
                " from densities: light {}, path {}",
                short(light),
                short(path)
            )
        }
        (Some(light), None) => format!(", light density {}", short(light)),
        (None, Some(path)) => format!(", path density {}", short(path)),
        (None, None) => String::new(),
    }
}

/// How a path goes on.
fn describe(step: &PathStep) -> String {
    let mut text = format!("{}: {}", outcome(step.outcome), lobe_of(step));
    if let (Some(bsdf), Some(pdf)) = (step.bsdf, step.pdf) {
        text += &format!(", BSDF {}, density {}", color(bsdf), short(pdf));
    }
    if step.outcome != StepOutcome::Absorbed {
        text += &format!(", factor {}", color(step.weight));
    }
    if step.survival < 1.0 {
        text += &format!(", roulette {}", short(step.survival));
    }
    text
}

/// The outcome of a step, in words.
pub fn outcome(outcome: StepOutcome) -> &'static str {
    match outcome {
        StepOutcome::Scattered => "goes on",
        StepOutcome::Passed => "goes straight on",
        StepOutcome::Roulette => "ends by roulette",
        StepOutcome::Limit => "ends at the limit of bounces",
        StepOutcome::Absorbed => "ends absorbed",
    }
}

/// Name of the lobe of a step.
pub fn lobe_of(step: &PathStep) -> &'static str {
    step.lobe.map_or("hole", lobe_name)
}

/// Name of a lobe.
pub(super) fn lobe_name(lobe: Lobe) -> &'static str {
    match lobe {
        Lobe::Diffuse => "diffuse",
        Lobe::Glossy => "glossy",
        Lobe::Coat => "coat",
        Lobe::Sheen => "sheen",
        Lobe::Boundary => "boundary",
    }
}
