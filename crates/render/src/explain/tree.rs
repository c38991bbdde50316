//! The rays of a pixel as plain data, in world space, with the names of the objects they hit.

use super::path::{LightSample, LightSource, Lobe, PathStep, Sharing, StepOutcome};
use super::phong::PhongTerms;
use crate::{
    Integrator,
    layout::{
        LARGEST_RADIANCE_BITS, MATERIAL_FRESNEL, NONE, PackedProbe, PackedRay, RAY_BOUNDARY,
        RAY_OUTSIDE, RAY_PRIMARY, RAY_REFLECTION, RAY_REFRACTION, RAY_TOTAL, RAY_TRANSPARENT,
        SHAPE,
    },
    pack::{PackedScene, PackedView},
};
use glam::{DVec3, Vec3};
use glimray_scene::ObjectRef;
use schemars::JsonSchema;
use serde::Serialize;

/// Distances beyond this, in scene units, are infinite: no scene is that large.
const FAR: f32 = 1e30;

/// The samples and rays of a pixel.
#[derive(Clone, Debug, PartialEq, Serialize, JsonSchema)]
pub struct RayTree {
    /// Column and row in the picture.
    pub pixel: [u32; 2],
    /// [`Integrator::Whitted`], whose samples are trees of rays, or [`Integrator::Path`], whose samples are paths
    /// with light samples.
    pub integrator: Integrator,
    /// Linear radiance, as in the film for these samples: the weighted mean of the sample colours. Negative
    /// values are clamped to 0, and the value is 0 if the weights cancel.
    pub value: [f32; 3],
    /// In index order.
    pub samples: Vec<SampleTree>,
}

/// The rays of one sample.
#[derive(Clone, Debug, PartialEq, Serialize, JsonSchema)]
pub struct SampleTree {
    /// Index of the sample in its pixel.
    pub sample: u32,
    /// The weight in the pixel: 1, or −1 where the filter is negative.
    pub weight: f32,
    /// The shutter time: 0 when the shutter opens, 1 when it closes; 0 if nothing moves.
    pub time: f32,
    /// Linear radiance: the sum of the contributions of all its rays.
    pub color: [f32; 3],
    /// Whether the sample was dropped because its colour is not finite, or beyond 2^40.
    pub dropped: bool,
    /// Whether rays are missing in the picture because the tree exceeded a limit.
    pub cut_off: bool,
    /// Number of rays, light samples that were not traced included; more than in `rays` if there was no room to
    /// record all of them.
    pub ray_count: usize,
    /// In spawn order, so that parents come before their children; the first is the primary ray.
    pub rays: Vec<TracedRay>,
}

/// A traced ray, in world space.
#[derive(Clone, Debug, PartialEq, Serialize, JsonSchema)]
pub struct TracedRay {
    /// Its kind.
    pub kind: RayKind,
    /// In a path: the lobe in which it left the surface at its origin; `None` if it did not scatter there.
    pub lobe: Option<Lobe>,
    /// Index in [`SampleTree::rays`] of the parent; `None` for the primary ray.
    pub parent: Option<usize>,
    /// Indices of its child rays, in spawn order.
    pub children: Vec<usize>,
    /// Origin.
    pub origin: [f64; 3],
    /// Of unit length.
    pub direction: [f64; 3],
    /// End point: at a surface or a light; `None` if it goes to infinity.
    pub end: Option<[f64; 3]>,
    /// The surface it hit. For a shadow ray the nearest one, or the last one that it reached if transparent
    /// surfaces filter shadows; without material and normals.
    pub hit: Option<RayHit>,
    /// Set for shadow rays.
    pub shadow: Option<ShadowRay>,
    /// Materials of the dielectric volumes around its origin, outermost first: indices into
    /// [`glimray_scene::Scene::materials`]. Empty if nothing is transparent.
    pub media: Vec<usize>,
    /// Its throughput at the origin. For a shadow ray that of one sample of the light.
    pub throughput: [f32; 3],
    /// The throughput at its end, after absorption or shadowing.
    pub arriving: [f32; 3],
    /// The radiance it adds to the sample: ambient light and emission of the surface, the background, or for a
    /// shadow ray the light that passes. In a path it is weighted by [`Self::sharing`].
    pub contribution: [f32; 3],
    /// Linear radiance of the background, before the throughput; `None` if the ray hit something, and in trees of
    /// the classical integrator.
    pub background: Option<[f32; 3]>,
    /// In a path: how the light that the ray found, or its light sample, is shared with the other way to find it.
    /// `None` if there is no light.
    pub sharing: Option<Sharing>,
    /// In a path: how it goes on at the surface.
    pub step: Option<PathStep>,
}

/// The kind of a ray.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Serialize, JsonSchema)]
#[serde(rename_all = "lowercase")]
pub enum RayKind {
    /// From the camera.
    Primary,
    /// To a light.
    Shadow,
    /// Reflected.
    Reflection,
    /// Transmitted. In a tree of the classical integrator also continued through a surface that does not refract.
    Refraction,
    /// The ray of a path that goes straight through a hole, a smooth thin wall, or between equal media.
    Passage,
}

/// A surface that a ray hit.
#[derive(Clone, Debug, PartialEq, Serialize, JsonSchema)]
pub struct RayHit {
    /// Distance from the origin of the ray, in scene units.
    pub distance: f64,
    /// The object.
    pub object: Option<ObjectRef>,
    /// The name of the object, if it has one.
    pub name: Option<String>,
    /// Index of the triangle or the shape on the GPU.
    pub primitive: u32,
    /// Index into [`glimray_scene::Scene::materials`]; `None` for lamps, and for shadow rays.
    pub material: Option<usize>,
    /// The name of the material, if it has one.
    pub material_name: Option<String>,
    /// Hit point.
    pub position: [f64; 3],
    /// Shading normal, of unit length.
    pub normal: [f64; 3],
    /// Geometric normal, of unit length, pointing outwards.
    pub geometric_normal: [f64; 3],
    /// Whether the ray came from outside.
    pub outside: bool,
    /// Linear radiance of ambient light here, before the throughput of the ray.
    pub ambient: [f32; 3],
    /// Linear radiance of emission, before the throughput of the ray.
    pub emission: [f32; 3],
    /// How its boundary divides light. `None` where a path passes a hole, and in trees of the classical integrator if
    /// the scene has no holes, and no reflection and no refraction or the depth is 0.
    pub split: Option<RaySplit>,
}

/// How a surface divides light among local shading, a reflected and a refracted ray.
#[derive(Clone, Debug, PartialEq, Serialize, JsonSchema)]
pub struct RaySplit {
    /// Reflected fraction.
    pub reflect: [f32; 3],
    /// Transmitted fraction.
    pub transmit: [f32; 3],
    /// Fresnel reflectance; `None` for a material without Fresnel.
    pub reflectance: Option<f32>,
    /// Whether there is total internal reflection.
    pub total: bool,
    /// Whether the surface is transparent.
    pub transparent: bool,
    /// Whether the media on its two sides differ; otherwise the ray passes unchanged.
    pub boundary: bool,
    /// Index of refraction in front and behind.
    pub iors: [f32; 2],
    /// Material of the medium that the ray travelled in; `None` is the vacuum.
    pub medium: Option<usize>,
    /// The name of that medium, if it has one.
    pub medium_name: Option<String>,
    /// Material of the medium behind a transparent surface; `None` is the vacuum.
    pub medium_behind: Option<usize>,
}

/// The result of a shadow ray.
#[derive(Clone, Debug, PartialEq, Serialize, JsonSchema)]
pub struct ShadowRay {
    /// Index into [`glimray_scene::Scene::lights`]; `None` for emissive triangles and the background.
    pub light: Option<usize>,
    /// The name of the light, if it has one.
    pub light_name: Option<String>,
    /// Distance to the light, in scene units; `None` if it is infinitely far away.
    pub distance: Option<f64>,
    /// Whether nothing of the light arrives: it is blocked, or the ray is not traced.
    pub blocked: bool,
    /// The fraction of the light that passes.
    pub transmittance: [f32; 3],
    /// Linear radiance that the unshadowed light adds at the surface.
    pub unshadowed: [f32; 3],
    /// Number of surfaces that it crossed.
    pub crossings: u32,
    /// In a path: what was chosen.
    pub sample: Option<LightSample>,
    /// In a tree of the classical integrator: the terms of Phong's model.
    pub phong: Option<PhongTerms>,
}

impl ShadowRay {
    /// Whether the ray exists: there is none to light of which the surface scatters nothing.
    pub fn is_traced(&self) -> bool {
        let sample = self.sample.as_ref().is_none_or(|sample| sample.traced);
        sample && self.phong.as_ref().is_none_or(|phong| phong.traced)
    }
}

impl TracedRay {
    /// Whether the ray exists: a shadow ray may not, see [`ShadowRay::is_traced`].
    pub fn is_traced(&self) -> bool {
        self.shadow.as_ref().is_none_or(ShadowRay::is_traced)
    }
}

impl RayTree {
    pub(super) fn new(pixel: [u32; 2], integrator: Integrator, samples: Vec<SampleTree>) -> Self {
        let (mut sum, mut weights) = (DVec3::ZERO, 0.0);
        for sample in samples.iter().filter(|sample| !sample.dropped) {
            let weight = f64::from(sample.weight);
            sum += weight * Vec3::from(sample.color).as_dvec3();
            weights += weight;
        }
        // As `weighted_mean` of lib/filter.wesl.
        let value = match weights.abs() > 0.5 {
            true => (sum / weights).max(DVec3::ZERO),
            false => DVec3::ZERO,
        };
        Self {
            pixel,
            integrator,
            value: value.as_vec3().into(),
            samples,
        }
    }
}

/// Converts records to trees.
pub struct Reader<'a> {
    scene: &'a PackedScene,
    view: &'a PackedView,
    is_path: bool,
}

impl<'a> Reader<'a> {
    pub fn new(scene: &'a PackedScene, view: &'a PackedView, integrator: Integrator) -> Self {
        let is_path = integrator == Integrator::Path;
        Self {
            scene,
            view,
            is_path,
        }
    }

    /// The tree of one sample.
    pub fn sample(&self, probe: &PackedProbe, records: &[PackedRay]) -> SampleTree {
        let mut rays: Vec<_> = records.iter().map(|record| self.ray(record)).collect();
        for index in 0..rays.len() {
            let Some(parent) = rays[index].parent else {
                continue;
            };
            rays[parent].children.push(index);
            let step = rays[parent].step.as_ref();
            let step = step.filter(|_| rays[index].kind != RayKind::Shadow);
            match step.map(|step| (step.outcome, step.lobe)) {
                Some((StepOutcome::Passed, _)) => rays[index].kind = RayKind::Passage,
                Some((_, lobe)) => rays[index].lobe = lobe,
                None => {}
            }
        }
        SampleTree {
            sample: probe.sample,
            weight: probe.weight,
            time: probe.time,
            color: probe.color,
            dropped: !Vec3::from(probe.color)
                .abs()
                .cmple(Vec3::splat(f32::from_bits(LARGEST_RADIANCE_BITS)))
                .all(),
            cut_off: probe.cut_off > 0,
            ray_count: probe.ray_count as usize,
            rays,
        }
    }

    fn ray(&self, record: &PackedRay) -> TracedRay {
        let kind = match record.kind {
            RAY_PRIMARY => RayKind::Primary,
            RAY_REFLECTION => RayKind::Reflection,
            RAY_REFRACTION => RayKind::Refraction,
            _ => RayKind::Shadow,
        };
        let shadow = (kind == RayKind::Shadow).then(|| self.shadow(record));
        let hit = (record.primitive != NONE).then(|| self.hit(record, shadow.is_some()));
        let reaches_light = shadow.as_ref().is_some_and(|shadow| !shadow.blocked);
        let is_segment = self.is_path && kind != RayKind::Shadow;
        let sharing = match (self.is_path, kind) {
            (false, _) => None,
            (true, RayKind::Shadow) => Some(Sharing::sampled(record)),
            (true, _) => {
                (hit.is_none() || record.emission != [0.0; 3]).then(|| Sharing::found(record))
            }
        };
        let end = match &hit {
            Some(hit) if !reaches_light => Some(hit.position),
            _ => (record.t_max < FAR).then(|| self.along(record, record.t_max)),
        };
        TracedRay {
            kind,
            lobe: None,
            parent: (record.parent != NONE).then_some(record.parent as usize),
            children: Vec::new(),
            origin: self.point(record.origin),
            direction: vector(record.direction),
            end,
            hit,
            shadow,
            media: (record.media.iter())
                .filter_map(|&material| self.scene.material_at(material))
                .collect(),
            throughput: record.throughput,
            arriving: record.arriving,
            contribution: record.contribution,
            background: (is_segment && record.primitive == NONE).then_some(record.emission),
            sharing,
            step: (is_segment && record.primitive != NONE).then(|| PathStep::of(record)),
        }
    }

    fn hit(&self, record: &PackedRay, is_shadow: bool) -> RayHit {
        let object = (self.scene).object_at(self.view, record.primitive, record.instance);
        let material = self.scene.material_at(record.material);
        let name = object.and_then(|object| self.scene.object_name(object));
        let material_name = material.and_then(|material| self.scene.material_name(material));
        // Set only if the kernel has code for reflection, refraction or holes.
        let is_split = !is_shadow && record.ior > 0.0;
        RayHit {
            distance: record.t.into(),
            object,
            name: name.map(str::to_owned),
            primitive: record.primitive & !SHAPE,
            material,
            material_name: material_name.map(str::to_owned),
            position: match is_shadow {
                true => self.along(record, record.t),
                false => self.point(record.p),
            },
            normal: vector(record.n),
            geometric_normal: vector(record.ng),
            outside: record.flags & RAY_OUTSIDE != 0,
            ambient: if is_shadow { [0.0; 3] } else { record.ambient },
            emission: if is_shadow { [0.0; 3] } else { record.emission },
            split: is_split.then(|| self.split(record)),
        }
    }

    fn split(&self, record: &PackedRay) -> RaySplit {
        let is = |bit: u32| record.flags & bit != 0;
        let materials = match &self.view.materials[..] {
            [] => &self.scene.materials,
            changed => changed,
        };
        let packed = materials.get(record.material as usize);
        let medium = self.scene.material_at(record.medium);
        let medium_name = medium.and_then(|medium| self.scene.material_name(medium));
        let asks = packed.is_some_and(|material| material.flags & MATERIAL_FRESNEL != 0);
        RaySplit {
            reflect: record.reflect,
            transmit: record.transmit,
            reflectance: (asks && is(RAY_BOUNDARY)).then_some(record.reflectance),
            total: is(RAY_TOTAL) && is(RAY_TRANSPARENT),
            transparent: is(RAY_TRANSPARENT),
            boundary: is(RAY_BOUNDARY),
            iors: [record.ior, record.ior_behind],
            medium,
            medium_name: medium_name.map(str::to_owned),
            medium_behind: self.scene.material_at(record.medium_behind),
        }
    }

    fn shadow(&self, record: &PackedRay) -> ShadowRay {
        let sample = self.is_path.then(|| self.light_sample(record));
        let is_light = |sample: &LightSample| sample.source == LightSource::Light;
        let light = (sample.as_ref().is_none_or(is_light)).then_some(record.light as usize);
        let name = light.and_then(|light| self.scene.object_name(ObjectRef::Light(light)));
        ShadowRay {
            light,
            light_name: name.map(str::to_owned),
            distance: (record.t_max < FAR).then_some(record.t_max.into()),
            blocked: record.transmit == [0.0; 3],
            transmittance: record.transmit,
            unshadowed: record.ambient,
            crossings: record.crossings,
            sample,
            phong: (!self.is_path).then(|| PhongTerms::of(record)),
        }
    }

    fn light_sample(&self, record: &PackedRay) -> LightSample {
        let sample = LightSample::of(record);
        let emitter = (sample.source == LightSource::Emitter)
            .then(|| self.view.emitters.get(record.light as usize))
            .flatten();
        let Some(emitter) = emitter else {
            return sample;
        };
        let object = (self.scene).object_at(self.view, emitter.primitive, emitter.instance);
        let name = object.and_then(|object| self.scene.object_name(object));
        LightSample {
            emitter: object,
            emitter_name: name.map(str::to_owned),
            primitive: Some(emitter.primitive),
            ..sample
        }
    }

    fn along(&self, record: &PackedRay, distance: f32) -> [f64; 3] {
        let way = f64::from(distance) * Vec3::from(record.direction).as_dvec3();
        (DVec3::from(self.point(record.origin)) + way).into()
    }

    /// From render to world space.
    fn point(&self, p: [f32; 3]) -> [f64; 3] {
        (self.scene.origin + Vec3::from(p).as_dvec3()).into()
    }
}

fn vector(v: [f32; 3]) -> [f64; 3] {
    v.map(f64::from)
}
