//! Packs the data of a frame: camera, lights, materials and instances.

use super::{
    PackError, PackedScene,
    deform::Deformed,
    geometry::{in_range, render_point},
    light,
    light_tree::{Leaf, LightTree},
    material, media,
    tlas::Tlas,
};
use crate::bvh::StackNeed;
use crate::layout::{
    CAMERA_ROWS, CLUSTER_ROWS, INSTANCE_ROWS, KEY_ROWS, LIGHT_RECTANGLE, LIGHT_ROWS, MATERIAL_THIN,
    MOVING, NODE_ROWS, NONE, PackedCamera, PackedEmitter, PackedFrame, PackedLight, PackedMaterial,
    PackedTexture, SHAPE,
};
use bytemuck::{bytes_of, cast_slice};
use glam::DVec3;
use glimray_scene::{Camera, Frame};
use std::{slice, sync::Arc};

/// Rows of 16 bytes of a [`crate::layout::PackedTriangle`].
const TRIANGLE_ROWS: u32 = 3;

/// A packed [`Frame`].
#[derive(Clone, Debug, PartialEq)]
pub struct PackedView {
    /// The frame, with a camera for a square picture; [`PackedView::with_aspect`] adapts it.
    pub frame: PackedFrame,
    /// At least one: a scene without lights gets a black one. If a light moves, each key holds all lights.
    pub lights: Vec<PackedLight>,
    /// Keys of a moving camera, for a square picture too; otherwise empty.
    pub cameras: Arc<[PackedCamera]>,
    /// The TLAS, shared between views as long as no instance moves.
    pub(super) tlas: Arc<Tlas>,
    /// The deforming meshes, shared as long as none changes.
    pub(super) deformed: Arc<Deformed>,
    /// Replaces the materials of the scene if any changes over time; otherwise empty. The values are those when
    /// the shutter opens, except that visible lights show their mean emission over the shutter interval.
    pub materials: Arc<[PackedMaterial]>,
    /// Replaces the textures of the scene if any moves; otherwise empty. They lie as when the shutter opens.
    pub textures: Arc<[PackedTexture]>,
    /// Emissive triangles and shapes, by instance and primitive.
    pub emitters: Vec<PackedEmitter>,
    /// The mean luminance of each, four in a row, if a texture is brighter on some than on others; otherwise empty.
    pub emitter_glows: Vec<[f32; 4]>,
    /// The tree over many lamps and emitters, shared as long as they are the same.
    pub(super) light_tree: Arc<LightTree>,
    /// With a section plane the vertices of each closed mesh, in ascending order: the first, and the one after the last.
    solids: Vec<[u32; 4]>,
    /// Whether the camera is orthographic.
    pub orthographic: bool,
    /// Whether there is a light that is not black.
    pub has_lights: bool,
    /// Whether there is an area light.
    pub has_area_lights: bool,
    /// One of the `BACKGROUND_` tags, such as [`crate::layout::BACKGROUND_COLOR`].
    pub background: u32,
}

impl PackedScene {
    /// The most entries on the stack of a walk through the trees of a view of this scene.
    pub fn stack_need(&self, view: &PackedView) -> StackNeed {
        self.tlas_source.stack_need.max(view.tlas.stack_need)
    }

    /// Packs a frame of the scene that this was packed from.
    ///
    /// # Errors
    /// The frame does not fit the scene, or has values out of their ranges.
    pub fn frame(&self, frame: &Frame) -> Result<PackedView, PackError> {
        self.view(slice::from_ref(frame))
    }

    /// Packs the result of [`glimray_scene::Scene::motion_samples`] for the scene that this was packed from: at
    /// least one frame, evenly spaced over the shutter interval.
    ///
    /// # Errors
    /// A frame does not fit the scene, or has values out of their ranges.
    pub fn view(&self, frames: &[Frame]) -> Result<PackedView, PackError> {
        self.view_from(None, frames)
    }

    /// Like [`Self::view`], but reuses the TLAS of another view of this scene, or of the one it was packed
    /// from, if only camera, lights, materials or background differ.
    ///
    /// # Errors
    /// As [`Self::view`].
    pub fn view_from(
        &self,
        previous: Option<&PackedView>,
        frames: &[Frame],
    ) -> Result<PackedView, PackError> {
        let first = &frames[0];
        let mut cameras = (frames.iter())
            .map(|frame| camera(&frame.camera, self.origin))
            .collect::<Result<Vec<_>, _>>()?;
        if cameras.iter().all(|camera| *camera == cameras[0]) {
            cameras.truncate(1);
        }
        let mut lights = Vec::new();
        for frame in frames {
            let packed = frame
                .lights
                .iter()
                .map(|light| light::packed(light, self.origin));
            let key = packed.collect::<Result<Vec<_>, _>>()?;
            lights.push(key);
        }
        if lights.iter().all(|key| *key == lights[0]) {
            lights.truncate(1);
        }
        let light_key_count = lights.len() as u32;
        let mut lights = lights.concat();
        if lights.is_empty() {
            lights.push(PackedLight::default());
        }
        let light_count = lights.len() as u32 / light_key_count;

        let deformed = self.deformed(frames, previous)?;
        let tlas = match self.features.instances {
            true => self.tlas(frames, &deformed, previous)?,
            false => Arc::new(Tlas::empty(self.first_view_node())),
        };
        let materials = self.materials_of(frames);
        let lit = match materials.is_empty() {
            true => &self.materials,
            false => &materials,
        };
        let powers = light::powers(frames, self.radius);
        let lamp_count = powers.iter().filter(|power| **power > 0.0).count();
        let mut emitters = self.emitters(&tlas, &deformed, lit, lamp_count);
        let has_lights = lights.iter().any(|light| light.color != [0.0; 3]);
        let has_others = has_lights || !emitters.rows.is_empty();
        let environment = self.environment_of(&first.background);
        // Paths find the rest of its light by themselves.
        let environment_share = match environment {
            None => 0.0,
            Some(table) if has_others => 0.5 * table.part,
            Some(_) => 1.0,
        };
        let share = emitters.share(powers.iter().sum());
        let lights_share = (1.0 - environment_share) * (1.0 - share);
        let emitters_share = (1.0 - environment_share) * share;
        let leaves = match emitters.in_tree {
            true => (Leaf::of_lamps(&lights, &powers).into_iter())
                .chain(emitters.leaves())
                .collect(),
            false => Vec::new(),
        };
        let light_tree = match previous {
            Some(previous) if previous.light_tree.is_of(&leaves) => previous.light_tree.clone(),
            _ => Arc::new(LightTree::new(leaves)),
        };
        match light_tree.nodes.is_empty() {
            true => light::set_chances(&mut lights, &powers, lights_share),
            false => light_tree.set_trails(
                (&mut lights, light_count as usize),
                (&mut emitters.rows, emitters.group),
            ),
        }
        let moving = if tlas.moves { MOVING } else { 0 };
        let instance_row = NODE_ROWS * (tlas.first_node + tlas.nodes.len() as u32);
        let key_row = instance_row + INSTANCE_ROWS * tlas.instances.len() as u32;
        let light_row = key_row + KEY_ROWS * tlas.keys.len() as u32;
        let camera_row = light_row + LIGHT_ROWS * lights.len() as u32;
        let camera_key_rows = if cameras.len() > 1 {
            cameras.len() as u32
        } else {
            0
        };
        let emitter_row = camera_row + CAMERA_ROWS * camera_key_rows;
        let cluster_row = emitter_row + (emitters.rows.len() + emitters.glows.len()) as u32;
        let solids = match first.section {
            Some(_) => {
                let flags = |material: u32| lit[material as usize].flags;
                (self.trees).solids(|material| flags(material) & MATERIAL_THIN != 0)
            }
            None => Vec::new(),
        };
        let start = start(&first.camera);
        let is_kept = first.section.is_none_or(|section| !section.cuts(start));
        Ok(PackedView {
            frame: PackedFrame {
                camera: cameras[0],
                clip: clip(&first.camera)?,
                light_count,
                ambient: first.ambient.into(),
                first_triangle: self.first_baked_triangle,
                triangle_count: self.baked_triangle_count,
                shape_count: self.baked_shape_count,
                plane_count: self.plane_count,
                vertex_count: self.vertices.len() as u32,
                material_count: self.materials.len() as u32,
                // A ray from beyond the section plane enters volumes through it.
                camera_media: match is_kept {
                    true => media::at_point(&self.volumes, first, start)?,
                    false => [NONE; media::MEDIA_SIZE],
                },
                root: if self.features.instances {
                    tlas.first_node | moving
                } else {
                    0
                },
                instance_row,
                instance_count: tlas.instances.len() as u32,
                key_row,
                light_row,
                shape_row: TRIANGLE_ROWS * self.triangles.len() as u32,
                camera_key_count: cameras.len() as u32,
                light_key_count,
                deformation_key_count: deformed.key_count,
                emitter_row,
                emitter_count: emitters.rows.len() as u32,
                emitter_power: (emitters.power / emitters_share.max(f64::MIN_POSITIVE)) as f32,
                emitter_group: emitters.group as u32,
                environment_first: environment.map_or(0, |_| self.environment_first()),
                environment_width: environment.map_or(0, |table| table.width),
                environment_share: environment_share as f32,
                sun_chance: environment.map_or(0.0, |table| table.sun_chance as f32),
                albedo_first: self.albedo_first(),
                cluster_row,
                solid_row: cluster_row + CLUSTER_ROWS * light_tree.nodes.len() as u32,
                solid_count: solids.len() as u32,
                section: first
                    .section
                    .map_or([0.0; 3], |it| it.normal.as_vec3().into()),
                section_offset: first.section.map_or(Ok(0.0), |section| {
                    let offset = section.offset - section.normal.dot(self.origin);
                    in_range(offset).map(|()| offset as f32)
                })?,
                light_root: light_tree.root(),
                lights_share: lights_share as f32,
                ..self.background(&first.background)
            },
            background: self.background_kind(&first.background),
            orthographic: first.camera.orthographic_height.is_some(),
            has_lights,
            emitters: emitters.rows,
            emitter_glows: emitters.glows,
            light_tree,
            solids,
            has_area_lights: lights.iter().any(|light| light.kind >= LIGHT_RECTANGLE),
            lights,
            cameras: match cameras.len() {
                1 => Arc::default(),
                _ => cameras.into(),
            },
            tlas,
            deformed,
            materials,
            textures: material::textures(&first.textures, self.origin, &self.pictures)?,
        })
    }

    /// The materials over the shutter interval; empty if they never change.
    fn materials_of(&self, frames: &[Frame]) -> Arc<[PackedMaterial]> {
        let Some(animated_materials) = &self.animated_materials else {
            return Arc::default();
        };
        let materials = match &frames[0].materials[..] {
            [] => &animated_materials.materials,
            changed => changed,
        };
        let lamps = animated_materials.lamps.iter();
        let lamps = lamps.map(|&index| {
            let mean = light::mean_material(frames, index);
            material::material(&mean, Some(index))
        });
        let own = materials.iter().zip(&*self.materials).map(|(one, rest)| {
            let mut packed = material::material(one, None);
            packed.layers.glow = rest.layers.glow;
            packed
        });
        own.chain(lamps).collect()
    }
}

impl PackedView {
    /// All bytes of the view that a picture depends on.
    pub fn parts(&self) -> Vec<&[u8]> {
        let mut parts = vec![
            bytes_of(&self.frame),
            cast_slice(&self.materials),
            cast_slice(&self.textures),
        ];
        parts.extend(self.node_parts());
        let trees = self.deformed.trees.iter();
        parts.extend(trees.flat_map(|tree| tree.parts()));
        parts.extend(self.deformed.key_triangles().map(cast_slice));
        parts.extend(self.deformed.key_rows().map(cast_slice));
        if self.orthographic {
            parts.push(b"orthographic");
        }
        parts
    }

    /// The frame on a device whose nodes have this many rows of 16 bytes instead of [`NODE_ROWS`]: what follows them starts
    /// later.
    pub fn frame_after(&self, node_rows: u32) -> PackedFrame {
        let nodes = self.tlas.first_node + self.tlas.nodes.len() as u32;
        let moved = |row: u32| row + (node_rows - NODE_ROWS) * nodes;
        let frame = self.frame;
        PackedFrame {
            instance_row: moved(frame.instance_row),
            key_row: moved(frame.key_row),
            light_row: moved(frame.light_row),
            emitter_row: moved(frame.emitter_row),
            cluster_row: moved(frame.cluster_row),
            solid_row: moved(frame.solid_row),
            ..frame
        }
    }

    /// The data after the scene's nodes on the GPU: first nodes, then other rows.
    pub fn node_parts(&self) -> [&[u8]; 9] {
        [
            cast_slice(&self.tlas.nodes),
            cast_slice(&self.tlas.instances),
            cast_slice(&self.tlas.keys),
            cast_slice(&self.lights),
            cast_slice(&self.cameras),
            cast_slice(&self.emitters),
            cast_slice(&self.emitter_glows),
            cast_slice(&self.light_tree.nodes),
            cast_slice(&self.solids),
        ]
    }

    /// The nodes of deforming meshes, the first of which is [`PackedScene::first_view_node`].
    pub fn deformed_nodes(&self) -> impl Iterator<Item = &[u8]> {
        self.deformed.nodes().map(cast_slice)
    }

    /// The triangles that replace those of the scene from an index on.
    pub fn triangles_from(&self, first: usize) -> Option<&[u8]> {
        self.deformed.triangles(first).map(cast_slice)
    }

    /// The vertices that replace those of the scene from an index on.
    pub fn vertices_from(&self, first: usize) -> Option<&[u8]> {
        self.deformed.vertices(first).map(cast_slice)
    }

    /// The tangents that replace those of the scene from an index on.
    pub fn tangents_from(&self, first: usize) -> Option<&[u8]> {
        self.deformed.tangents(first).map(cast_slice)
    }

    /// The triangles and the vertices of later keys of deforming meshes: after the shapes, at the next multiple
    /// of a triangle, and after the tangents and colours. Each vertex is followed by its tangent if the scene has any.
    pub fn later_keys(&self) -> [Vec<&[u8]>; 2] {
        [
            self.deformed.key_triangles().map(cast_slice).collect(),
            self.deformed.key_rows().map(cast_slice).collect(),
        ]
    }

    /// Whether a mesh deforms while the shutter is open.
    pub fn deforms(&self) -> bool {
        self.deformed.key_count > 1
    }

    /// Number of deforming meshes whose BLAS was rebuilt because refitting would have made it slow.
    pub fn rebuilt_count(&self) -> usize {
        let trees = self.deformed.trees.iter();
        trees.filter(|tree| tree.is_rebuilt).count()
    }

    /// Whether both views share a TLAS.
    pub fn shares_tlas(&self, other: &Self) -> bool {
        Arc::ptr_eq(&self.tlas, &other.tlas)
    }

    /// The scene index of an instance of the view; hidden instances are omitted from the view.
    pub(super) fn instanced_index(&self, instance: u32) -> Option<usize> {
        let instance = self.tlas.instances.get(instance as usize)?;
        Some(instance.id as usize - 1)
    }

    /// Whether a plane cuts away a part of the scene.
    pub fn has_section(&self) -> bool {
        self.frame.section != [0.0; 3]
    }

    /// Whether paths choose lamps and emitters from a tree.
    pub fn has_light_tree(&self) -> bool {
        !self.light_tree.nodes.is_empty()
    }

    /// Whether some emitter is a shape.
    pub fn has_emissive_shapes(&self) -> bool {
        let mut emitters = self.emitters.iter();
        emitters.any(|emitter| emitter.primitive & SHAPE != 0)
    }

    /// Whether instances move while the shutter is open.
    pub fn has_moving_instances(&self) -> bool {
        self.tlas.moves
    }

    /// The view for a picture of `width` × `height` pixels: aspect = width / height.
    pub fn with_aspect(&self, width: u32, height: u32) -> Self {
        let mut view = self.clone();
        let aspect = f64::from(width) / f64::from(height);
        view.frame.camera = widened(&self.frame.camera, aspect);
        view.cameras = (self.cameras.iter())
            .map(|camera| widened(camera, aspect))
            .collect();
        view
    }
}

/// Adapts the camera of a square picture to this aspect ratio.
fn widened(camera: &PackedCamera, aspect: f64) -> PackedCamera {
    PackedCamera {
        right: camera.right.map(|c| (f64::from(c) * aspect) as f32),
        ..*camera
    }
}

/// Where the ray through the centre of the picture starts: on the near plane.
fn start(camera: &Camera) -> DVec3 {
    let forward = (camera.look_at - camera.look_from).normalize_or(DVec3::NEG_Z);
    camera.look_from + camera.clip.0 * forward
}

/// The near and the far plane; a far plane that is farther away than any geometry is left out.
fn clip(camera: &Camera) -> Result<[f32; 2], PackError> {
    let (near, far) = camera.clip;
    in_range(near)?;
    let far = if in_range(far).is_ok() { far } else { 0.0 };
    Ok([near, far].map(|distance| distance as f32))
}

/// The image plane at distance 1: half its height is tan(fov_y / 2). For an orthographic camera it has the
/// height of the visible region.
fn camera(camera: &Camera, origin: DVec3) -> Result<PackedCamera, PackError> {
    let forward = (camera.look_at - camera.look_from).normalize_or(DVec3::NEG_Z);
    let right = forward
        .cross(camera.up)
        .normalize_or(forward.any_orthonormal_vector());
    let up = right.cross(forward);
    let half_height = match camera.orthographic_height {
        Some(height) => {
            in_range(height)?;
            height / 2.0
        }
        None => (camera.fov_y / 2.0).tan(),
    };
    Ok(PackedCamera {
        origin: render_point(camera.look_from, origin)?.into(),
        forward: forward.as_vec3().into(),
        right: (right * half_height).as_vec3().into(),
        up: (up * half_height).as_vec3().into(),
        lens_radius: camera.lens.map_or(0.0, |lens| lens.radius as f32),
        focus_distance: camera.lens.map_or(1.0, |lens| lens.focus_distance as f32),
        blade_count: camera.lens.map_or(0, |lens| lens.blade_count),
        blade_rotation: camera.lens.map_or(0.0, |lens| lens.blade_rotation as f32),
    })
}
