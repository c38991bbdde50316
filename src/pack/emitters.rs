//! Emissive triangles and shapes, which paths sample as lights: each with a chance in proportion to its power.

use super::{PackedScene, deform::Deformed};
use crate::layout::{
    NO_INSTANCE, PackedEmitter, PackedInstance, PackedMaterial, PackedShape, PackedTriangle, SHAPE,
    SHAPE_DISC, SHAPE_RECTANGLE, SHAPE_SPHERE,
};
use crate::scene::{Pattern, Scene, Texture};
use glam::{Mat3, Vec3};
use std::f32::consts::PI;

/// The luminance of linear Rec. 709 colours is the dot product with this.
pub(super) const LUMINANCE: Vec3 = Vec3::new(0.2126, 0.7152, 0.0722);

/// A triangle or a shape whose material emits at some time.
#[derive(Clone, Copy, Debug)]
pub struct Emissive {
    /// Its index in the triangles array, or in the shapes array with [`SHAPE`].
    primitive: u32,
    material: u32,
    /// Two edges, in render space or in the space of its BLAS: its area is that of their parallelogram times `share`.
    edges: [Vec3; 2],
    share: f32,
    /// Whether an instance may stretch it: a stretched sphere is none.
    stretches: bool,
}

/// The emitters of a view, and their share of its light.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Emitters {
    /// Their chances follow those of the lights and reach 1.
    pub rows: Vec<PackedEmitter>,
    /// The sum of radiance times area, in luminance, divided by the chance of all emitters together: radiance divided
    /// by it is a chance per area. 0 if there are none.
    pub power: f64,
    /// The chance of all of them together.
    pub share: f64,
}

/// The mean luminance of the texture of each material's emission; 1 without one.
pub fn mean_glow(scene: &Scene) -> Vec<f32> {
    let mut known = vec![None; scene.textures.len()];
    let mut mean = |index: usize| {
        *known[index].get_or_insert_with(|| mean_luminance(scene, &scene.textures[index]))
    };
    let materials = scene.materials.iter();
    (materials.map(|material| material.textures.emission.map_or(1.0, &mut mean))).collect()
}

fn mean_luminance(scene: &Scene, texture: &Texture) -> f32 {
    match texture.pattern {
        Pattern::Checker { a, b }
        | Pattern::Stripes { a, b }
        | Pattern::Gradient { a, b }
        | Pattern::Noise { a, b, .. } => LUMINANCE.dot(a + b) / 2.0,
        Pattern::Picture { picture, .. } => {
            let picture = &scene.pictures[picture];
            let texels = picture
                .linear()
                .map(|texel| f64::from(LUMINANCE.dot(texel.truncate())));
            (texels.sum::<f64>() / picture.texels.len().max(1) as f64) as f32
        }
    }
}

/// A shape that paths sample; `None` for other kinds.
fn emissive_shape(primitive: u32, shape: &PackedShape) -> Option<Emissive> {
    let rows = [shape.row_x, shape.row_y, shape.row_z];
    let inverse = || Mat3::from_cols_array_2d(&rows).transpose().inverse();
    let flat = |share| {
        let inverse = inverse();
        ([inverse.x_axis, inverse.z_axis], share, true)
    };
    let (edges, share, stretches) = match shape.kind {
        SHAPE_RECTANGLE => flat(4.0),
        SHAPE_DISC if shape.size0 == 0.0 => flat(PI),
        SHAPE_SPHERE => {
            let edges = [shape.size0 * Vec3::X, shape.size0 * Vec3::Y];
            (edges, 4.0 * PI, false)
        }
        _ => return None,
    };
    Some(Emissive {
        primitive,
        material: shape.material,
        edges,
        share,
        stretches,
    })
}

fn emissive_triangle(primitive: u32, triangle: &PackedTriangle, material: u32) -> Emissive {
    let [v0, v1, v2] = [triangle.v0, triangle.v1, triangle.v2].map(Vec3::from);
    Emissive {
        primitive,
        material,
        edges: [v1 - v0, v2 - v0],
        share: 0.5,
        stretches: true,
    }
}

impl Emitters {
    /// Leaves the last `share` of all chances, 0 to 1, to other lights.
    pub fn leave(&mut self, share: f64) {
        let rest = 1.0 - share;
        self.power /= rest.max(f64::MIN_POSITIVE);
        for row in &mut self.rows {
            row.chance *= rest as f32;
            row.end *= rest as f32;
        }
    }
}

impl PackedScene {
    /// The triangles, spheres, rectangles and discs whose material `emits`, by material index.
    pub(super) fn emissive(&self, emits: &[bool]) -> Vec<Emissive> {
        if !emits.contains(&true) {
            return Vec::new();
        }
        let materials: Vec<u32> = (self.vertices.iter())
            .map(|vertex| vertex.material)
            .collect();
        let mut found = Vec::new();
        for (index, triangle) in self.triangles.iter().enumerate() {
            let material = materials[triangle.i0 as usize];
            if emits.get(material as usize) == Some(&true) {
                found.push(emissive_triangle(index as u32, triangle, material));
            }
        }
        for (index, shape) in self.shapes.iter().enumerate() {
            if emits.get(shape.material as usize) == Some(&true) {
                found.extend(emissive_shape(index as u32 | SHAPE, shape));
            }
        }
        found
    }

    /// The emitters of a view with these instances and materials, beside lights of the given power.
    pub(super) fn emitters(
        &self,
        instances: &[PackedInstance],
        deformed: &Deformed,
        materials: &[PackedMaterial],
        lights: f64,
    ) -> Emitters {
        let within = |from: u32, to: u32| {
            let start = self.emissive.partition_point(|one| one.primitive < from);
            let end = self.emissive.partition_point(|one| one.primitive < to);
            &self.emissive[start..end]
        };
        let strength = |one: &Emissive| {
            let material = &materials[one.material as usize];
            f64::from(LUMINANCE.dot(material.emission.into()) * material.layers.glow)
        };
        let mut weighted = Vec::new();
        let mut add = |instance: u32, linear: Mat3, list: &[Emissive]| {
            for one in list {
                let [a, b] = one.edges.map(|edge| linear * edge);
                let weight = strength(one) * f64::from(a.cross(b).length() * one.share);
                if weight > 0.0 && (one.stretches || instance == NO_INSTANCE) {
                    weighted.push((one.primitive, instance, weight));
                }
            }
        };
        // Baked triangles, then baked shapes; planes and instanced shapes follow those.
        let baked = within(self.first_baked_triangle, SHAPE | self.baked_shape_count);
        add(NO_INSTANCE, Mat3::IDENTITY, baked);
        for (index, instance) in instances.iter().enumerate() {
            let rows = [instance.linear_x, instance.linear_y, instance.linear_z];
            let linear = Mat3::from_cols_array_2d(&rows).transpose();
            let list = within(instance.first, instance.first + instance.count);
            match deformed.starting_at(instance.first) {
                // Their order may differ from that at rest.
                Some(tree) if !list.is_empty() => {
                    let posed = tree.triangles().map(|(index, triangle, material)| {
                        emissive_triangle(index, triangle, material)
                    });
                    add(index as u32, linear, &posed.collect::<Vec<_>>());
                }
                _ => add(index as u32, linear, list),
            }
        }
        let total: f64 = weighted.iter().map(|(.., weight)| weight).sum();
        if total <= 0.0 {
            return Emitters::default();
        }
        // A surface of radiance 1 and area 1 sends as much as a light of strength 1/π per steradian.
        let own = total / std::f64::consts::PI;
        let share = own / (own + lights);
        let power = total / share;
        let mut end = 1.0 - share;
        let rows = weighted.into_iter().map(|(primitive, instance, weight)| {
            end += weight / power;
            PackedEmitter {
                primitive,
                instance,
                chance: (weight / power) as f32,
                end: end as f32,
            }
        });
        Emitters {
            rows: rows.collect(),
            power,
            share,
        }
    }
}
