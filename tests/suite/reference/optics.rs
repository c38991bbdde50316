//! Recursive reflection and refraction as in a textbook: a recursive function.

use super::rays::{Log, Sent};
use super::{Hit, Ray, Tracer, textures};
use glam::DVec3;
use glimray::render::{MIN_THROUGHPUT, RayKind, Rays};
use glimray::scene::{Fresnel, Mixing};

/// The position of a ray in the tree.
#[derive(Clone)]
pub struct Place {
    pub kind: RayKind,
    /// The parent ray, if rays are recorded.
    pub sender: Option<usize>,
    pub depth: u32,
    /// The ray's throughput.
    pub throughput: DVec3,
    /// The materials of the volumes that it is inside of, the last entered last.
    pub media: Vec<usize>,
}

impl Tracer<'_> {
    /// The radiance of a ray, without its throughput.
    pub fn trace(&self, ray: Ray, place: &Place, rays: &mut Log) -> (DVec3, bool) {
        let nearest = self.nearest(ray);
        let own = rays.keep(Sent {
            kind: place.kind,
            sender: place.sender,
            throughput: place.throughput,
            hit: nearest,
            light: None,
        });
        let Some((t, primitive)) = nearest else {
            let left = self.absorbed(self.dominant(&place.media), 1e30);
            let left = if self.scene.output.max_depth > 0 {
                left
            } else {
                DVec3::ONE
            };
            return (
                left * textures::background(self.scene, ray.direction),
                false,
            );
        };
        let hit = self.hit(ray, t, primitive);
        let is_deep = self.scene.output.max_depth > 0;
        let is_clear = is_deep && hit.material.classical().transmit != glam::Vec3::ZERO;
        let mut behind = place.media.clone();
        let mut here = self.dominant(&place.media);
        if is_clear {
            if hit.enters {
                behind.push(hit.material_index);
            } else if let Some(i) = behind.iter().rposition(|&m| m == hit.material_index) {
                behind.remove(i);
            } else {
                here = Some(hit.material_index);
            }
        }
        let left = if is_deep {
            self.absorbed(here, t)
        } else {
            DVec3::ONE
        };
        let throughput = place.throughput * left;
        let (reflect, transmit, refracted) =
            self.split(&hit, ray.direction, here, &behind, is_clear);

        if is_clear && here == self.dominant(&behind) {
            // A boundary within a volume of higher priority is ignored, but absorption in that volume may leave
            // too little throughput to continue.
            if throughput.element_sum() / 3.0 < f64::from(MIN_THROUGHPUT) {
                return (DVec3::ZERO, true);
            }
            let onwards = Ray {
                origin: hit.p,
                t_min: 1e-9 * t.max(1.0),
                leaving: Some(primitive),
                ..ray
            };
            let next = Place {
                kind: RayKind::Refraction,
                sender: own,
                throughput,
                media: behind,
                depth: place.depth,
            };
            rays.refraction += 1;
            let (arriving, is_hit) = self.trace(onwards, &next, rays);
            rays.refraction_hits += u64::from(is_hit);
            return (left * arriving, true);
        }
        let mut color = DVec3::ZERO;
        let mut send = |kind: RayKind, weight: DVec3, direction: DVec3, media: &[usize]| {
            let next = Place {
                kind,
                sender: own,
                depth: place.depth + 1,
                throughput: throughput * weight,
                media: media.to_vec(),
            };
            let matters = next.throughput.element_sum() / 3.0 >= f64::from(MIN_THROUGHPUT);
            if place.depth >= self.scene.output.max_depth || !matters {
                return false;
            }
            let onwards = Ray {
                origin: hit.p,
                direction,
                t_min: 1e-9 * t.max(1.0),
                t_max: f64::INFINITY,
                leaving: Some(primitive),
            };
            let (arriving, is_hit) = self.trace(onwards, &next, rays);
            let counts: &mut Rays = rays;
            let (sent, met) = match kind {
                RayKind::Reflection => (&mut counts.reflection, &mut counts.reflection_hits),
                _ => (&mut counts.refraction, &mut counts.refraction_hits),
            };
            *sent += 1;
            *met += u64::from(is_hit);
            color += weight * arriving;
            true
        };
        let mirrored = ray.direction - 2.0 * ray.direction.dot(hit.n) * hit.n;
        let sends = send(RayKind::Reflection, reflect, mirrored, &place.media);
        if is_clear {
            send(RayKind::Refraction, transmit, refracted, &behind);
        }

        let kept = (DVec3::ONE - reflect).max(DVec3::ZERO);
        let (diffuse, highlight) = match hit.material.classical().mixing {
            _ if !is_deep => (DVec3::ONE, DVec3::ONE),
            Mixing::Sum => (DVec3::ONE, DVec3::ONE),
            Mixing::Blend if sends => (kept, kept),
            Mixing::Blend => (DVec3::ONE, DVec3::ONE),
            Mixing::Layer => (
                f64::from(hit.material.classical().opacity) * kept,
                DVec3::ONE,
            ),
        };
        let mut material = hit.material.clone();
        material.classical_mut().diffuse *= diffuse.as_vec3();
        material.classical_mut().ambient *= diffuse.as_vec3();
        material.classical_mut().specular *= highlight.as_vec3();
        let shadow = Ray {
            origin: hit.p,
            t_min: 1e-9 * t,
            leaving: Some(primitive),
            ..ray
        };
        rays.sender = own;
        color += self.shade(shadow, hit.n, -ray.direction, &material, rays);
        if hit.enters || material.two_sided {
            color += material.emission.as_dvec3();
        }
        (left * color, true)
    }

    /// Weights of reflected and refracted light, and the refracted direction.
    fn split(
        &self,
        hit: &Hit,
        direction: DVec3,
        here: Option<usize>,
        behind: &[usize],
        is_clear: bool,
    ) -> (DVec3, DVec3, DVec3) {
        let index = |medium: Option<usize>| medium.map_or(1.0, |m| self.ior(m));
        let n1 = index(here);
        let n2 = if is_clear {
            index(self.dominant(behind))
        } else {
            f64::from(hit.material.classical().ior)
        };
        let n = hit.n * -hit.n.dot(direction).signum();
        let incidence = (-direction.dot(n)).clamp(0.0, 1.0).acos();
        let sine = n1 / n2 * incidence.sin();
        let mut reflect = hit.material.classical().reflect.as_dvec3();
        let mut transmit = hit.material.classical().transmit.as_dvec3();
        if sine >= 1.0 {
            if hit.material.classical().fresnel == Fresnel::None
                && is_clear
                && hit.material.classical().mixing != Mixing::Sum
            {
                reflect += transmit;
            }
            return (reflect, DVec3::ZERO, direction);
        }
        let refraction = sine.asin();
        let normal_reflectance = ((n1 - n2) / (n1 + n2)).powi(2);
        let reflectance = match hit.material.classical().fresnel {
            Fresnel::None => None,
            Fresnel::Exact if incidence < 1e-7 => Some(normal_reflectance),
            Fresnel::Exact => {
                let (sum, difference) = (incidence + refraction, incidence - refraction);
                Some(
                    0.5 * ((difference.sin() / sum.sin()).powi(2)
                        + (difference.tan() / sum.tan()).powi(2)),
                )
            }
            Fresnel::Schlick => {
                let cos = incidence.max(refraction).cos();
                Some(normal_reflectance + (1.0 - normal_reflectance) * (1.0 - cos).powi(5))
            }
        };
        if let Some(reflectance) = reflectance {
            reflect *= reflectance;
            transmit *= 1.0 - reflectance;
        }
        let along = (direction + incidence.cos() * n).normalize_or_zero();
        (
            reflect,
            transmit,
            along * refraction.sin() - n * refraction.cos(),
        )
    }

    fn dominant(&self, media: &[usize]) -> Option<usize> {
        let priority = |&m: &usize| self.scene.materials[m].priority;
        // The last one of the highest priority.
        media.iter().copied().max_by_key(priority)
    }

    fn ior(&self, material: usize) -> f64 {
        f64::from(self.scene.materials[material].classical().ior)
    }

    fn absorbed(&self, medium: Option<usize>, length: f64) -> DVec3 {
        let absorption = medium.map_or(DVec3::ZERO, |m| {
            self.scene.materials[m].classical().absorption.as_dvec3()
        });
        (-absorption * length).exp()
    }
}
