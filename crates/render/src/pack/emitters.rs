//! Emissive triangles and shapes, which paths sample as lights: each with a chance in proportion to its power, or from
//! the light tree.

use super::{
    PackedScene,
    deform::Deformed,
    emissive_solid::EmissiveSolid,
    emitter_places::Places,
    glow::{self, Glow},
    light_cluster::{Cluster, LUMINANCE},
    light_tree::Leaf,
    tlas::Tlas,
};
use crate::layout::{
    MATERIAL_COLORED_EMISSION, MATERIAL_TWO_SIDED_EMISSION, NO_INSTANCE, PackedEmitter,
    PackedMaterial, PackedShape, PackedTriangle, PackedVertex, SHAPE, SHAPE_DISC, SHAPE_RECTANGLE,
};
use glam::{DVec3, Mat3, Vec3, Vec4};
use std::{array::from_fn, collections::HashMap, f32::consts::PI};

/// Groups of emitters that the light tree has room for: for more emitters the groups become larger.
const MAX_GROUPS: usize = 1 << 16;

/// A triangle or a shape whose material emits at some time.
#[derive(Clone, Copy, Debug)]
pub struct Emissive {
    /// Index in the triangles array, or in the shapes array with [`SHAPE`].
    primitive: u32,
    material: u32,
    form: Form,
    glow: Glimmer,
}

/// The differences in emission between triangles of one material.
#[derive(Clone, Copy, Debug)]
struct Glimmer {
    /// The mean luminance of the texture.
    texture: f32,
    /// The mean colour of the vertices, if it counts.
    color: Vec3,
}

impl Glimmer {
    fn even(texture: f32) -> Self {
        Self {
            texture,
            color: Vec3::ONE,
        }
    }
}

/// In render space or in the space of its BLAS.
#[derive(Clone, Copy, Debug)]
enum Form {
    /// A part of a parallelogram.
    Flat {
        corner: Vec3,
        edges: [Vec3; 2],
        /// The part's area as a fraction of the parallelogram's.
        share: f32,
        /// Three normals on its front.
        normals: [Vec3; 3],
    },
    /// A curved shape or one of several sides.
    Solid(EmissiveSolid),
}

/// All emissive triangles and shapes of a scene.
#[derive(Clone, Debug, Default)]
pub struct EmissiveParts {
    /// By primitive.
    list: Vec<Emissive>,
    /// Whether a texture or colours of vertices are brighter on some triangles than on others.
    is_uneven: bool,
    /// How bright triangles are by their vertices, which meshes keep when they deform.
    glow_of: HashMap<[u32; 3], Glimmer>,
}

/// The emitters of a view, and their share of its light.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Emitters {
    /// Emitters, whose cumulative chances follow those of the lights and reach 1.
    pub rows: Vec<PackedEmitter>,
    /// The sum of radiance times area, in luminance. 0 if there are none.
    pub power: f64,
    /// The number of emitters in a group.
    pub group: usize,
    /// Whether lights of this view are to be chosen from the light tree.
    pub in_tree: bool,
    /// The luminance of each, if that of its material is not it; four in a row.
    pub glows: Vec<[f32; 4]>,
    /// The cluster of each, for the light tree.
    clusters: Vec<Cluster>,
}

/// Emitters that point one way and cover this part of a disc around them are as good as one light without a tree.
const DENSE: f64 = 0.4;

/// The cosine of the angle up to which they point one way.
const SAME_WAY: f64 = 0.99;

/// A shape that paths sample; `None` for other kinds.
fn emissive_shape(primitive: u32, shape: &PackedShape, glow: f32) -> Option<Emissive> {
    let flat = |share| {
        let solid = EmissiveSolid::of(shape)?;
        let halves = [solid.columns.x_axis, solid.columns.z_axis];
        Some(Form::Flat {
            corner: solid.center - halves[0] - halves[1],
            edges: halves.map(|half| 2.0 * half),
            share,
            normals: [shape.row_y.into(); 3],
        })
    };
    Some(Emissive {
        primitive,
        material: shape.material,
        form: match shape.kind {
            SHAPE_RECTANGLE => flat(1.0)?,
            SHAPE_DISC => flat(PI / 4.0 * (1.0 - shape.size0 * shape.size0))?,
            _ => Form::Solid(EmissiveSolid::of(shape)?),
        },
        glow: Glimmer::even(glow),
    })
}

fn emissive_triangle(
    primitive: u32,
    triangle: &PackedTriangle,
    vertices: [&PackedVertex; 3],
    glow: Glimmer,
) -> Emissive {
    let [v0, v1, v2] = [triangle.v0, triangle.v1, triangle.v2].map(Vec3::from);
    Emissive {
        primitive,
        material: vertices[0].material,
        form: Form::Flat {
            corner: v0,
            edges: [v1 - v0, v2 - v0],
            share: 0.5,
            normals: vertices.map(|vertex| vertex.normal.into()),
        },
        glow,
    }
}

impl Emissive {
    /// The corners of what it lies in, in its own space.
    fn corners(&self) -> Vec<DVec3> {
        match self.form {
            Form::Flat { corner, edges, .. } => {
                let [corner, u, v] = [corner, edges[0], edges[1]].map(|v| v.as_dvec3());
                let mut corners = vec![corner, corner + u, corner + v];
                if self.primitive & SHAPE != 0 {
                    corners.push(corner + u + v);
                }
                corners
            }
            Form::Solid(solid) => solid.corners(),
        }
    }

    /// The area after a transform, or an estimate: the same as that of the shaders.
    fn area(&self, linear: Mat3) -> f32 {
        match self.form {
            Form::Flat { edges, share, .. } => {
                let [a, b] = edges.map(|edge| linear * edge);
                a.cross(b).length() * share
            }
            Form::Solid(solid) => solid.area(linear),
        }
    }

    /// The cluster of an emitter of intensity `power` while the shutter is open. `later` are its corners at later keys.
    fn cluster(&self, power: f64, places: &Places, later: &[DVec3]) -> Cluster {
        let corners = [&self.corners(), later].concat();
        let normal = match self.form {
            Form::Flat { edges, normals, .. } if later.is_empty() => places.front(edges, normals),
            _ => None,
        };
        Cluster::of_surface(places.bounds(&corners), power, normal)
    }
}

impl Emitters {
    /// The part of all light that is theirs, beside lamps of the given power.
    pub fn share(&self, lamps: f64) -> f64 {
        // A surface of radiance 1 and area 1 sends as much as a light of strength 1/π per steradian.
        let own = self.power / std::f64::consts::PI;
        if own > 0.0 { own / (own + lamps) } else { 0.0 }
    }

    /// Puts them into groups for the light tree, or all into one.
    fn grouped(mut self, weights: &[f64], count: usize) -> Self {
        self.group = self.rows.len().div_ceil(count.max(1)).max(1);
        for (rows, weights) in (self.rows.chunks_mut(self.group)).zip(weights.chunks(self.group)) {
            let total: f64 = weights.iter().sum();
            let mut end = 0.0;
            for (row, weight) in rows.iter_mut().zip(weights) {
                end += weight;
                row.end = (end / total) as f32;
            }
        }
        self
    }

    /// Whether all of them together are a flat patch of this area.
    fn is_patch(&self, area: f64) -> bool {
        let all = self.clusters.iter().copied().reduce(Cluster::union);
        all.is_some_and(|all| {
            let disc = (all.max - all.min).length_squared() * std::f64::consts::PI / 4.0;
            all.spread.cos() > SAME_WAY && area > DENSE * disc
        })
    }

    /// The leaves of the light tree.
    pub fn leaves(&self) -> impl Iterator<Item = Leaf> {
        let groups = self.clusters.chunks(self.group.max(1));
        groups.enumerate().filter_map(|(index, group)| {
            let all = group.iter().copied().reduce(Cluster::union)?;
            Some(Leaf::of_group(index, all))
        })
    }
}

impl PackedScene {
    /// The triangles and shapes whose material `emits`, by material index; planes and globes are none of them.
    pub(super) fn emissive(&self, emits: &[bool], glows: &[Glow]) -> EmissiveParts {
        let mut found = EmissiveParts::default();
        if !emits.contains(&true) {
            return found;
        }
        let vertices: Vec<&PackedVertex> = self.vertices.iter().collect();
        let is_uneven = |triangle: &&PackedTriangle| {
            let material = vertices[triangle.i0 as usize].material as usize;
            glows.get(material).is_some_and(Glow::is_uneven)
        };
        let most_texels = glow::most_texels(self.triangles.iter().filter(is_uneven).count());
        for (index, triangle) in self.triangles.iter().enumerate() {
            let corners = [triangle.i0, triangle.i1, triangle.i2];
            let own = corners.map(|i| vertices[i as usize]);
            let material = own[0].material as usize;
            if emits.get(material) != Some(&true) {
                continue;
            }
            let of_texture = &glows[material];
            let uvs = corners.map(|i| self.uvs.get(i as usize).copied().unwrap_or_default());
            let is_colored = !self.colors.is_empty()
                && self.materials[material].flags & MATERIAL_COLORED_EMISSION != 0;
            let color = |i: u32| self.colors.get(i as usize).copied().unwrap_or([1.0; 4]);
            let color = |i: u32| Vec4::from(color(i)).truncate();
            let glow = Glimmer {
                texture: of_texture.over(uvs, most_texels),
                color: match is_colored {
                    true => corners.map(color).iter().sum::<Vec3>() / 3.0,
                    false => Vec3::ONE,
                },
            };
            if of_texture.is_uneven() || is_colored {
                found.is_uneven = true;
                if !self.deforming.is_empty() {
                    found.glow_of.insert(corners, glow);
                }
            }
            (found.list).push(emissive_triangle(index as u32, triangle, own, glow));
        }
        for (index, shape) in self.shapes.iter().enumerate() {
            let material = shape.material as usize;
            if emits.get(material) == Some(&true) {
                let glow = glows[material].mean;
                (found.list).extend(emissive_shape(index as u32 | SHAPE, shape, glow));
            }
        }
        found
    }

    /// The emitters of a view with these instances and materials, beside so many lamps.
    pub(super) fn emitters(
        &self,
        tlas: &Tlas,
        deformed: &Deformed,
        materials: &[PackedMaterial],
        lamp_count: usize,
    ) -> Emitters {
        let EmissiveParts {
            list,
            is_uneven,
            glow_of,
        } = &self.emissive;
        let within = |from: u32, to: u32| {
            let start = list.partition_point(|one| one.primitive < from);
            let end = list.partition_point(|one| one.primitive < to);
            &list[start..end]
        };
        let mut all = Emitters::default();
        let (mut weights, mut area, mut glows) = (Vec::new(), 0.0, Vec::new());
        let no_keys: &dyn Fn() -> Vec<DVec3> = &Vec::new;
        let mut add =
            |instance: u32, places: &Places, one: &Emissive, later: &dyn Fn() -> Vec<DVec3>| {
                let material = &materials[one.material as usize];
                let emission = one.glow.color * Vec3::from(material.emission);
                let radiance = LUMINANCE.dot(emission) * one.glow.texture;
                let own_area = f64::from(one.area(places.linear()));
                let weight = f64::from(radiance) * own_area;
                // Areas beyond the range of f32 have no chance.
                if weight > 0.0 && weight.is_finite() {
                    let power = weight / std::f64::consts::PI;
                    let mut cluster = one.cluster(power, places, &later());
                    cluster.two_sided = material.flags & MATERIAL_TWO_SIDED_EMISSION != 0;
                    all.clusters.push(cluster);
                    all.rows.push(PackedEmitter {
                        primitive: one.primitive,
                        instance,
                        ..PackedEmitter::default()
                    });
                    weights.push(weight);
                    glows.push(radiance);
                    area += own_area;
                }
            };
        for (index, instance) in tlas.instances.iter().enumerate() {
            let list = within(instance.first, instance.first + instance.count);
            if list.is_empty() {
                continue;
            }
            let places = Places::of(instance, &tlas.keys);
            match deformed.starting_at(instance.first) {
                // The order of deformed triangles may differ from that at rest.
                Some(tree) => tree.triangles().for_each(|(own, triangle, vertices)| {
                    let corners = [triangle.i0, triangle.i1, triangle.i2];
                    let of_material = || materials[vertices[0].material as usize].layers.glow;
                    let glow = (glow_of.get(&corners).copied())
                        .unwrap_or_else(|| Glimmer::even(of_material()));
                    let one = emissive_triangle(own, triangle, vertices, glow);
                    add(index as u32, &places, &one, &|| tree.later_corners(own));
                }),
                _ => (list.iter()).for_each(|one| add(index as u32, &places, one, no_keys)),
            }
        }
        // Baked triangles, then baked shapes; planes and instanced shapes follow those.
        let baked = within(self.first_baked_triangle, SHAPE | self.baked_shape_count);
        let here = Places::default();
        (baked.iter()).for_each(|one| add(NO_INSTANCE, &here, one, no_keys));
        if *is_uneven {
            let row = |four: &[f32]| from_fn(|k| four.get(k).copied().unwrap_or(0.0));
            all.glows = glows.chunks(4).map(row).collect();
        }
        all.power = weights.iter().sum();
        all.in_tree = all.rows.len() + lamp_count >= self.tree_from
            && (lamp_count > 0 || !all.is_patch(area));
        let groups = if all.in_tree { MAX_GROUPS } else { 1 };
        all.grouped(&weights, groups)
    }
}
