//! A ray in words: one line, and the things to tell about it.

use super::super::super::explain::text::{color, kind, object, quoted, short, vector};
use super::Inspected;
use crate::render::{RayHit, RaySplit, ShadowRay, TracedRay};

/// What a ray is and what it met, in a few words.
pub fn headline(ray: &TracedRay) -> String {
    let word = kind(ray.kind);
    match (&ray.shadow, &ray.hit) {
        (Some(shadow), hit) => {
            let light = format!("light {}{}", shadow.light, quoted(&shadow.light_name));
            match hit {
                Some(hit) if shadow.blocked => format!("{light} hidden by {}", object(hit)),
                _ if shadow.blocked => format!("{light} gives nothing"),
                _ if shadow.crossings == 1 => format!("{light} through a surface"),
                _ if shadow.crossings > 1 => {
                    format!("{light} through {} surfaces", shadow.crossings)
                }
                _ => light,
            }
        }
        (None, Some(hit)) => format!("{word} hits {}", object(hit)),
        (None, None) => format!("{word} hits nothing"),
    }
}

/// How long a ray is, in scene units; of one that goes on for ever an infinity sign.
pub fn length(ray: &TracedRay) -> String {
    let to_light = (ray.shadow.as_ref()).filter(|shadow| !shadow.blocked);
    let distance = match (to_light, &ray.hit) {
        (Some(shadow), _) => shadow.distance,
        (None, Some(hit)) => Some(hit.distance),
        (None, None) => None,
    };
    distance.map_or("∞".to_owned(), short)
}

/// Everything to tell about a ray: what, and its value.
pub fn details(inspected: &Inspected, ray: &TracedRay) -> Vec<(&'static str, String)> {
    let mut told = vec![
        ("from", vector(ray.origin)),
        ("direction", vector(ray.direction)),
    ];
    if let Some(hit) = ray.hit.as_ref().filter(|_| ray.shadow.is_none()) {
        surface(&mut told, hit);
    }
    if let Some(shadow) = &ray.shadow {
        light(&mut told, shadow, ray.hit.as_ref());
    }
    let materials = &inspected.order.scene.materials;
    if !ray.media.is_empty() {
        let name = |&index: &usize| {
            let name = materials.get(index).map(|material| material.name.clone());
            format!(
                "material {index}{}",
                quoted(&name.filter(|n| !n.is_empty()))
            )
        };
        let names: Vec<_> = ray.media.iter().map(name).collect();
        told.push(("inside of", names.join(", ")));
    }
    told.push(("share", color(ray.throughput)));
    if ray.arriving != ray.throughput {
        told.push(("share at end", color(ray.arriving)));
    }
    told.push(("adds", color(ray.contribution)));
    told
}

fn surface(told: &mut Vec<(&'static str, String)>, hit: &RayHit) {
    told.push(("hits", object(hit)));
    told.push(("at", vector(hit.position)));
    told.push(("distance", short(hit.distance)));
    told.push(("normal", vector(hit.normal)));
    if hit.geometric_normal != hit.normal {
        told.push(("geometric normal", vector(hit.geometric_normal)));
    }
    let side = if hit.outside { "outside" } else { "inside" };
    told.push(("met from", side.to_owned()));
    if let Some(material) = hit.material {
        let name = quoted(&hit.material_name);
        told.push(("material", format!("{material}{name}")));
    }
    if let Some(split) = &hit.split {
        divides(told, split);
    }
    told.push(("ambient light", color(hit.ambient)));
    if hit.emission != [0.0; 3] {
        told.push(("emission", color(hit.emission)));
    }
}

fn divides(told: &mut Vec<(&'static str, String)>, split: &RaySplit) {
    if split.reflect == [0.0; 3] && !split.transparent {
        return;
    }
    told.push(("reflects", color(split.reflect)));
    if split.transparent {
        told.push(("transmits", color(split.transmit)));
    }
    if let Some(reflectance) = split.reflectance {
        told.push(("Fresnel", short(reflectance)));
    }
    if split.total {
        told.push(("total reflection", "beyond the critical angle".to_owned()));
    }
    if !split.boundary {
        told.push(("no boundary", "the medium goes on".to_owned()));
    } else if split.transparent {
        let [front, behind] = split.iors.map(short);
        told.push(("index of refraction", format!("{front} to {behind}")));
    }
}

fn light(told: &mut Vec<(&'static str, String)>, shadow: &ShadowRay, hit: Option<&RayHit>) {
    let name = quoted(&shadow.light_name);
    told.push(("to light", format!("{}{name}", shadow.light)));
    let distance = shadow.distance.map_or("infinite".to_owned(), short);
    told.push(("light's distance", distance));
    if let Some(hit) = hit.filter(|_| shadow.blocked) {
        let blocked = format!("{} after {}", object(hit), short(hit.distance));
        told.push(("hidden by", blocked));
    }
    if shadow.crossings > 0 {
        told.push(("surfaces met", shadow.crossings.to_string()));
    }
    told.push(("comes through", color(shadow.transmittance)));
    told.push(("without shadow", color(shadow.unshadowed)));
}
