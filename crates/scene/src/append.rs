//! Appending a scene to another one.

use super::{Geometry, Node, Pattern, Scene, Target};
use std::sync::Arc;

impl Scene {
    /// Adds the surfaces, lights and animations of `other` under a new node without a transform, and returns the index of
    /// that node. Cameras, background, ambient light and output settings stay those of this scene. Planes, which are static,
    /// stay in the world. The largest pictures are halved until all of the scene take at most
    /// [`super::MAX_PICTURE_BYTES`]; the second result is how many times that was.
    pub fn append(&mut self, other: Scene, name: &str) -> (usize, usize) {
        let root = self.nodes.len();
        let nodes = root + 1;
        let (meshes, materials) = (self.meshes.len(), self.materials.len());
        let (textures, pictures) = (self.textures.len(), self.pictures.len());
        let (lights, deformations) = (self.lights.len(), self.deformations.len());
        let under = |node: Option<usize>| Some(node.map_or(root, |index| nodes + index));
        self.nodes.push(Node {
            name: name.to_owned(),
            ..Node::default()
        });
        self.nodes.extend(other.nodes.into_iter().map(|node| Node {
            parent: under(node.parent),
            ..node
        }));
        self.meshes.extend(other.meshes.into_iter().map(|mut mesh| {
            let own = &mut Arc::make_mut(&mut mesh).materials;
            own.iter_mut().for_each(|index| *index += materials as u32);
            mesh
        }));
        self.instances
            .extend(other.instances.into_iter().map(|mut it| {
                it.mesh += meshes;
                it.node = under(it.node);
                it
            }));
        self.deformations
            .extend(other.deformations.into_iter().map(|mut it| {
                it.mesh += meshes;
                let joints = it.skin.iter_mut().flat_map(|skin| &mut skin.joints);
                joints.for_each(|joint| joint.node = under(joint.node));
                it
            }));
        self.shapes.extend(other.shapes.into_iter().map(|mut it| {
            it.material += materials;
            it.node = match it.geometry {
                Geometry::Plane { .. } => None,
                _ => under(it.node),
            };
            it
        }));
        self.materials
            .extend(other.materials.into_iter().map(|mut it| {
                it.shift_textures(textures);
                it
            }));
        self.textures
            .extend(other.textures.into_iter().map(|mut it| {
                if let Pattern::Picture { picture, .. } = &mut it.pattern {
                    *picture += pictures;
                }
                it
            }));
        // The picture of a background is not used: it comes along, but is never saved or packed.
        self.pictures.extend(other.pictures);
        self.lights.extend(other.lights.into_iter().map(|mut it| {
            it.node = under(it.node);
            it
        }));
        let moved = |target: Target| match target {
            Target::Node(index, property) => Some(Target::Node(nodes + index, property)),
            Target::Camera(..) => None,
            Target::Light(index, property) => Some(Target::Light(lights + index, property)),
            Target::Material(index, property) => {
                Some(Target::Material(materials + index, property))
            }
            Target::Layer(index, property) => Some(Target::Layer(materials + index, property)),
            Target::Texture(index, property) => Some(Target::Texture(textures + index, property)),
            Target::Weight(index, weight) => Some(Target::Weight(deformations + index, weight)),
        };
        self.tracks
            .extend(other.tracks.into_iter().filter_map(|mut track| {
                track.targets = track.targets.into_iter().filter_map(moved).collect();
                (!track.targets.is_empty()).then_some(track)
            }));
        self.skipped.extend(other.skipped);
        self.remarks.extend(other.remarks);
        (root, super::fit(&mut self.pictures))
    }
}
