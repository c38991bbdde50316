//! Describes a ray: a headline and its properties.

use crate::model::objects::Id;
use crate::state::inspector::Inspected;
use glimray_app::ray_text::path::{lobe_of, outcome};
use glimray_app::ray_text::{color, short, vector, way};
use glimray_render::{
    LightSample, PathStep, RayHit, RaySplit, RayTree, ShadowRay, Sharing, TracedRay,
};
use glimray_scene::ObjectRef;
use std::collections::BTreeSet;

/// All objects and materials that rays of a tree hit, target or pass through.
pub fn hit_by(tree: &RayTree) -> BTreeSet<Id> {
    let mut ids = BTreeSet::new();
    for ray in tree.samples.iter().flat_map(|sample| &sample.rays) {
        if let Some(hit) = &ray.hit {
            ids.extend(hit.object.map(Id::Object));
            ids.extend(hit.material.map(Id::Material));
        }
        ids.extend(ray.shadow.as_ref().and_then(light_of));
        ids.extend(ray.media.iter().copied().map(Id::Material));
    }
    ids
}

/// The light or the emissive object that a shadow ray aims at; `None` for the background.
fn light_of(shadow: &ShadowRay) -> Option<Id> {
    let emitter = |sample: &LightSample| sample.emitter;
    let light = shadow.light.map(ObjectRef::Light);
    let object = light.or_else(|| shadow.sample.as_ref().and_then(emitter));
    object.map(Id::Object)
}

fn light_name<'a>(inspected: &'a Inspected, shadow: &ShadowRay) -> &'a str {
    light_of(shadow).map_or("background", |id| inspected.label(id))
}

fn object(inspected: &Inspected, hit: &RayHit) -> String {
    match hit.object {
        Some(object) => inspected.label(Id::Object(object)).to_owned(),
        None => format!("primitive {}", hit.primitive),
    }
}

/// The headline of a ray.
pub fn headline(inspected: &Inspected, ray: &TracedRay) -> String {
    let kind = way(ray);
    match (&ray.shadow, &ray.hit) {
        (Some(shadow), hit) => {
            let light = light_name(inspected, shadow);
            match hit {
                Some(hit) if shadow.blocked => {
                    format!("{light} blocked by {}", object(inspected, hit))
                }
                _ if shadow.blocked => format!("{light} contributes nothing"),
                _ if shadow.crossings == 1 => format!("{light} through 1 surface"),
                _ if shadow.crossings > 1 => {
                    format!("{light} through {} surfaces", shadow.crossings)
                }
                _ => light.to_owned(),
            }
        }
        (None, Some(hit)) => format!("{kind} hits {}", object(inspected, hit)),
        (None, None) => format!("{kind} hits background"),
    }
}

/// Length of a ray in scene units; an infinity sign for infinite rays.
pub fn length(ray: &TracedRay) -> String {
    let to_light = (ray.shadow.as_ref()).filter(|shadow| !shadow.blocked);
    let distance = match (to_light, &ray.hit) {
        (Some(shadow), _) => shadow.distance,
        (None, Some(hit)) => Some(hit.distance),
        (None, None) => None,
    };
    distance.map_or("∞".to_owned(), short)
}

/// The properties of a ray: name and value.
pub fn details(inspected: &Inspected, ray: &TracedRay) -> Vec<(&'static str, String)> {
    let mut details = vec![
        ("origin", vector(ray.origin)),
        ("direction", vector(ray.direction)),
    ];
    if let Some(hit) = ray.hit.as_ref().filter(|_| ray.shadow.is_none()) {
        surface(inspected, &mut details, hit);
    }
    if let Some(shadow) = &ray.shadow {
        light(inspected, &mut details, shadow, ray.hit.as_ref());
    }
    if !ray.media.is_empty() {
        let names = ray.media.iter().map(|&m| inspected.label(Id::Material(m)));
        details.push(("inside", names.collect::<Vec<_>>().join(", ")));
    }
    details.push(("throughput", color(ray.throughput)));
    if ray.arriving != ray.throughput {
        details.push(("throughput at end", color(ray.arriving)));
    }
    if let Some(sharing) = &ray.sharing {
        shares(&mut details, sharing);
    }
    details.push(("contribution", color(ray.contribution)));
    if let Some(step) = &ray.step {
        goes_on(&mut details, step);
    }
    details
}

type Details = Vec<(&'static str, String)>;

fn surface(inspected: &Inspected, details: &mut Details, hit: &RayHit) {
    details.push(("hits", object(inspected, hit)));
    if let Some(ObjectRef::Instance(_)) = hit.object {
        details.push(("triangle", hit.primitive.to_string()));
    }
    details.push(("position", vector(hit.position)));
    details.push(("distance", short(hit.distance)));
    details.push(("normal", vector(hit.normal)));
    if hit.geometric_normal != hit.normal {
        details.push(("geometric normal", vector(hit.geometric_normal)));
    }
    let side = if hit.outside { "outside" } else { "inside" };
    details.push(("side", side.to_owned()));
    if let Some(material) = hit.material {
        let name = inspected.label(Id::Material(material));
        details.push(("material", name.to_owned()));
    }
    if let Some(split) = &hit.split {
        divides(details, split);
    }
    details.push(("ambient light", color(hit.ambient)));
    if hit.emission != [0.0; 3] {
        details.push(("emission", color(hit.emission)));
    }
}

fn divides(details: &mut Details, split: &RaySplit) {
    if split.reflect == [0.0; 3] && !split.transparent {
        return;
    }
    details.push(("reflects", color(split.reflect)));
    if split.transparent {
        details.push(("transmits", color(split.transmit)));
    }
    if let Some(reflectance) = split.reflectance {
        details.push(("Fresnel", short(reflectance)));
    }
    if split.total {
        details.push(("total reflection", "beyond the critical angle".to_owned()));
    }
    if !split.boundary {
        details.push(("no boundary", "same medium on both sides".to_owned()));
    } else if split.transparent {
        let [front, behind] = split.iors.map(short);
        details.push(("index of refraction", format!("{front} to {behind}")));
    }
}

/// The direction that a path chose, and what becomes of it.
fn goes_on(details: &mut Details, step: &PathStep) {
    details.push(("path", outcome(step.outcome).to_owned()));
    details.push(("lobe", lobe_of(step).to_owned()));
    if let (Some(bsdf), Some(pdf)) = (step.bsdf, step.pdf) {
        details.push(("BSDF times cosine", color(bsdf)));
        details.push(("density", short(pdf)));
    }
    details.push(("factor", color(step.weight)));
    if step.survival < 1.0 {
        details.push(("chance of roulette", short(step.survival)));
    }
}

/// The densities of both ways to find a light, and their weights.
fn shares(details: &mut Details, sharing: &Sharing) {
    let density = |pdf: Option<f32>| pdf.map_or("none".to_owned(), short);
    let both = |light: String, path: String| format!("light sample {light}, path {path}");
    let [light, path] = [sharing.light_pdf, sharing.bsdf_pdf].map(density);
    details.push(("densities", both(light, path)));
    let [light, path] = [sharing.light_weight, sharing.bsdf_weight].map(short);
    details.push(("weights", both(light, path)));
}

fn light(inspected: &Inspected, details: &mut Details, shadow: &ShadowRay, hit: Option<&RayHit>) {
    details.push(("to", light_name(inspected, shadow).to_owned()));
    let distance = shadow.distance.map_or("infinite".to_owned(), short);
    details.push(("light distance", distance));
    if let Some(hit) = hit.filter(|_| shadow.blocked) {
        let blocked = format!("{} after {}", object(inspected, hit), short(hit.distance));
        details.push(("blocked by", blocked));
    }
    if shadow.crossings > 0 {
        details.push(("surfaces crossed", shadow.crossings.to_string()));
    }
    if let Some(sample) = &shadow.sample {
        details.push(("chance of the light", short(sample.chance)));
        details.push(("radiance per density", color(sample.radiance)));
        details.push(("BSDF times cosine", color(sample.bsdf)));
    }
    if let Some(terms) = &shadow.phong {
        details.push(("L", color(terms.light)));
        details.push(("l·n", short(terms.l_dot_n)));
        details.push(("r·v", short(terms.r_dot_v)));
        details.push(("α", short(terms.alpha)));
        details.push(("diffuse", color(terms.diffuse)));
        details.push(("highlight", color(terms.highlight)));
    }
    details.push(("transmittance", color(shadow.transmittance)));
    details.push(("unshadowed", color(shadow.unshadowed)));
}
