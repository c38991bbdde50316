//! The rays of a pixel as plain data, in world space, with the names of what they met.

use crate::{
    layout::{
        MATERIAL_FRESNEL, NONE, PackedProbe, PackedRay, RAY_BOUNDARY, RAY_OUTSIDE, RAY_PRIMARY,
        RAY_REFLECTION, RAY_REFRACTION, RAY_TOTAL, RAY_TRANSPARENT, SHAPE,
    },
    pack::{PackedScene, PackedView},
    scene::ObjectRef,
};
use glam::{DVec3, Vec3};
use serde::Serialize;

/// Beyond this, in scene units, is infinitely far: no scene is as wide.
const FAR: f32 = 1e30;

/// What a pixel is made of.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct RayTree {
    /// Column and row in the picture.
    pub pixel: [u32; 2],
    /// Linear radiance, as the film has it for these samples: the sum of weight × colour over the sum
    /// of weights. What is negative counts as 0, and all is 0 where the weights cancel.
    pub value: [f32; 3],
    /// In the order of their indices.
    pub samples: Vec<SampleTree>,
}

/// The rays of one sample.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct SampleTree {
    /// Index of the sample in its pixel.
    pub sample: u32,
    /// What it counts in the pixel: 1, or −1 where the filter is negative.
    pub weight: f32,
    /// When it was taken: 0 as the shutter opens and 1 as it closes; 0 where nothing moves.
    pub time: f32,
    /// Linear radiance: the sum of the contributions of all its rays.
    pub color: [f32; 3],
    /// Whether it is left out of the pixel, because its colour is not finite.
    pub dropped: bool,
    /// Whether rays are missing in the picture: the tree outgrew what a tree may have.
    pub cut_off: bool,
    /// Rays that were traced; more than `rays` where there was no room for all of them.
    pub ray_count: usize,
    /// In the order in which they were sent, so that parents come before their children; the first is
    /// the primary ray.
    pub rays: Vec<TracedRay>,
}

/// A ray that was traced, in world space.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct TracedRay {
    /// What it was sent for.
    pub kind: RayKind,
    /// Place in [`SampleTree::rays`] of the ray that sent it; `None` for the primary ray.
    pub parent: Option<usize>,
    /// Places of the rays that it sent, in the order in which they were sent.
    pub children: Vec<usize>,
    /// Where it starts.
    pub origin: [f64; 3],
    /// Of unit length.
    pub direction: [f64; 3],
    /// Where it ends: at a surface, or at the light; `None` if nothing is in its way to infinity.
    pub end: Option<[f64; 3]>,
    /// The surface that it met. Of a shadow ray the nearest in its way, or the last one that it reached
    /// where light goes through things; without material and normals.
    pub hit: Option<RayHit>,
    /// Of a shadow ray.
    pub shadow: Option<ShadowRay>,
    /// Materials of the bodies that its origin is inside of, the outermost first: indices into
    /// [`crate::scene::Scene::materials`]. Empty where nothing is transparent.
    pub media: Vec<usize>,
    /// Its throughput where it starts. Of a shadow ray that of one sample of the light.
    pub throughput: [f32; 3],
    /// The same where it ends, after what the medium swallowed or the shadow took.
    pub arriving: [f32; 3],
    /// What it adds itself to the sample's colour: ambient and emitted light of the surface, the
    /// background, or of a shadow ray the light that comes through.
    pub contribution: [f32; 3],
}

/// What a ray was sent for.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum RayKind {
    /// From the camera.
    Primary,
    /// To a light.
    Shadow,
    /// Mirrored.
    Reflection,
    /// Refracted, or on through a surface that does not bend it.
    Refraction,
}

/// A surface that a ray met.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct RayHit {
    /// From the ray's origin, in scene units.
    pub distance: f64,
    /// What it belongs to.
    pub object: Option<ObjectRef>,
    /// The object's name, where it has one.
    pub name: Option<String>,
    /// Number of the triangle or of the shape on the GPU.
    pub primitive: u32,
    /// Index into [`crate::scene::Scene::materials`]; `None` for lamps, and for shadow rays.
    pub material: Option<usize>,
    /// The material's name, where it has one.
    pub material_name: Option<String>,
    /// Where it was met.
    pub position: [f64; 3],
    /// Of unit length, as it was used for shading.
    pub normal: [f64; 3],
    /// Of unit length, to the surface's own outside.
    pub geometric_normal: [f64; 3],
    /// Whether the ray came from the outside.
    pub outside: bool,
    /// Linear radiance that ambient light adds here, before the ray's throughput.
    pub ambient: [f32; 3],
    /// Linear radiance that the surface emits, before the ray's throughput.
    pub emission: [f32; 3],
    /// How it divides light; `None` where the scene has no mirrors and no glass, or depth is 0.
    pub split: Option<RaySplit>,
}

/// How a surface divides the light among itself, a mirrored and a refracted ray.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct RaySplit {
    /// Fraction that is mirrored.
    pub reflect: [f32; 3],
    /// Fraction that goes through.
    pub transmit: [f32; 3],
    /// Fresnel's reflectance; `None` for a material that does not ask for it.
    pub reflectance: Option<f32>,
    /// Whether all is mirrored, beyond the critical angle.
    pub total: bool,
    /// Whether the surface lets light through.
    pub transparent: bool,
    /// Whether the media on its two sides differ; else the ray goes on as if it were not there.
    pub boundary: bool,
    /// Index of refraction in front and behind.
    pub iors: [f32; 2],
    /// Material of the medium that the ray travelled in; `None` is the vacuum.
    pub medium: Option<usize>,
    /// Its name, where it has one.
    pub medium_name: Option<String>,
    /// Material of the medium behind a transparent surface; `None` is the vacuum.
    pub medium_behind: Option<usize>,
}

/// What a shadow ray found out.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct ShadowRay {
    /// Index into [`crate::scene::Scene::lights`].
    pub light: usize,
    /// The light's name, where it has one.
    pub light_name: Option<String>,
    /// To the light, in scene units; `None` for one that is infinitely far.
    pub distance: Option<f64>,
    /// Whether no light comes through.
    pub blocked: bool,
    /// The fraction of it that comes through.
    pub transmittance: [f32; 3],
    /// Linear radiance that the light adds at the surface without a shadow.
    pub unshadowed: [f32; 3],
    /// Surfaces that it met.
    pub crossings: u32,
}

impl RayTree {
    pub(super) fn new(pixel: [u32; 2], samples: Vec<SampleTree>) -> Self {
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
            value: value.as_vec3().into(),
            samples,
        }
    }
}

/// Turns records into trees.
pub struct Reader<'a> {
    scene: &'a PackedScene,
    view: &'a PackedView,
}

impl<'a> Reader<'a> {
    pub fn new(scene: &'a PackedScene, view: &'a PackedView) -> Self {
        Self { scene, view }
    }

    /// The tree of one sample.
    pub fn sample(&self, probe: &PackedProbe, records: &[PackedRay]) -> SampleTree {
        let mut rays: Vec<_> = records.iter().map(|record| self.ray(record)).collect();
        for index in 0..rays.len() {
            if let Some(parent) = rays[index].parent {
                rays[parent].children.push(index);
            }
        }
        SampleTree {
            sample: probe.sample,
            weight: probe.weight,
            time: probe.time,
            color: probe.color,
            dropped: !Vec3::from(probe.color).is_finite(),
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
        let end = match &hit {
            Some(hit) if !reaches_light => Some(hit.position),
            _ => (record.t_max < FAR).then(|| self.along(record, record.t_max)),
        };
        TracedRay {
            kind,
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
        }
    }

    fn hit(&self, record: &PackedRay, is_shadow: bool) -> RayHit {
        let object = (self.scene).object_at(self.view, record.primitive, record.instance);
        let material = self.scene.material_at(record.material);
        let name = object.and_then(|object| self.scene.object_name(object));
        let material_name = material.and_then(|material| self.scene.material_name(material));
        // Only where the kernel has code for mirrors and glass.
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
            emission: record.emission,
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
        let light = record.light as usize;
        let name = self.scene.object_name(ObjectRef::Light(light));
        ShadowRay {
            light,
            light_name: name.map(str::to_owned),
            distance: (record.t_max < FAR).then_some(record.t_max.into()),
            blocked: record.transmit == [0.0; 3],
            transmittance: record.transmit,
            unshadowed: record.ambient,
            crossings: record.crossings,
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
