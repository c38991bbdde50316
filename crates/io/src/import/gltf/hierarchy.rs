//! The nodes of one scene of the file (section 3.5 of the specification), and what hangs on them: meshes,
//! cameras and lights. Nodes that carry nothing and are not animated are folded into those below.

use super::Reader;
use super::document::{Kind, Node as Source};
use super::node_transform::{extended, is_invertible, linear, thickened, unit};
use crate::import::budget;
use crate::import::error::ImportError;
use glam::{DAffine3, DMat3, DQuat, DVec3};
use glimray_scene::{Instance, Node};

/// A node of the file that is to be visited.
struct Visit {
    index: usize,
    /// The nearest node of the scene above it.
    parent: Option<usize>,
    /// From the space above the node to that parent's, or to the world.
    parent_from_above: DAffine3,
    /// The nearest node of the file above it that has a name, or itself.
    named: usize,
    /// Whether a node above it has a scale of 0, at which nothing has an extent.
    is_flat: bool,
}

impl Reader<'_> {
    /// Adds the nodes under `roots`, and everything that they carry. Nodes that
    /// clips move stay apart.
    ///
    /// # Errors
    /// The model is too large, or refers to files that may not be read.
    pub(super) fn nodes(&mut self, roots: &[usize], place: &str) -> Result<(), ImportError> {
        let nodes = &self.document.nodes;
        let (children, roots) = self.trees(roots, place)?;
        self.children = children;
        self.find_worlds(&roots);
        self.find_moving(&roots);
        let visit = |&index: &usize| Visit {
            index,
            parent: None,
            parent_from_above: self.turn,
            named: index,
            is_flat: false,
        };
        let mut stack: Vec<Visit> = roots.iter().rev().map(visit).collect();
        while let Some(visit) = stack.pop() {
            let source = &nodes[visit.index];
            let here = format!("nodes[{}]", visit.index);
            let is_animated = self.animated[visit.index];
            let is_joint = self.is_joint[visit.index];
            let light = source.extensions.as_ref().and_then(|e| e.light.as_ref());
            let is_carrier = source.mesh.is_some()
                || source.camera.is_some()
                || light.is_some()
                || is_hidden(source);
            let named = match source.name.as_deref() {
                None | Some("") => visit.named,
                Some(_) => visit.index,
            };
            let (mut parent, mut above) = (visit.parent, visit.parent_from_above);
            let is_flat = visit.is_flat || self.is_flat(visit.index);
            if is_animated || is_carrier || is_joint {
                let size = budget::size::<(Node, Instance)>(1);
                self.ledger.take(size, 0, &here)?;
                let name = nodes[named].name.clone().unwrap_or_default();
                let node = self.node(source, &visit, name, &here);
                self.scene.nodes.push(node);
                let added = self.scene.nodes.len() - 1;
                self.node_of[visit.index] = Some(added);
                (parent, above) = (Some(added), DAffine3::IDENTITY);
                self.carry(visit.index, added, is_flat, &here)?;
            } else {
                above *= self.placed(source, &here);
            }
            stack.extend(self.children[visit.index].iter().rev().map(|&index| Visit {
                index,
                parent,
                parent_from_above: above,
                named,
                is_flat,
            }));
        }
        Ok(())
    }

    /// Computes the transforms of all nodes under `roots` at rest.
    fn find_worlds(&mut self, roots: &[usize]) {
        let nodes = &self.document.nodes;
        let mut stack: Vec<(usize, DAffine3)> =
            roots.iter().map(|&root| (root, self.turn)).collect();
        while let Some((index, above)) = stack.pop() {
            let world = above * self.placed(&nodes[index], &format!("nodes[{index}]"));
            self.worlds[index] = world;
            stack.extend(self.children[index].iter().map(|&child| (child, world)));
        }
    }

    /// Finds the nodes under `roots` that move, and the joints among them.
    fn find_moving(&mut self, roots: &[usize]) {
        let document = self.document;
        let count = document.nodes.len();
        (self.moving, self.is_joint) = (vec![false; count], vec![false; count]);
        let mut stack: Vec<(usize, bool)> = roots.iter().map(|&root| (root, false)).collect();
        while let Some((index, is_carried)) = stack.pop() {
            let is_moving = is_carried || self.animated[index];
            self.moving[index] = is_moving;
            let children = self.children[index].iter();
            stack.extend(children.map(|&child| (child, is_moving)));
        }
        for &joint in document.skins.iter().flat_map(|skin| &skin.joints) {
            if self.moving.get(joint).is_some_and(|moves| *moves) {
                self.is_joint[joint] = true;
            }
        }
    }

    /// The nodes under `roots` as trees: the children of each node, and the roots. What is there twice, or does not
    /// exist, is left out.
    fn trees(
        &mut self,
        roots: &[usize],
        place: &str,
    ) -> Result<(Vec<Vec<usize>>, Vec<usize>), ImportError> {
        let nodes = &self.document.nodes;
        let mut is_placed = vec![false; nodes.len()];
        let mut place_once = |it: &mut Self, index: usize, here: &str| {
            let found = it.blame.get(nodes, index, "nodes", here);
            if it.spared(found)?.is_none() {
                return Ok(false);
            }
            let is_second = std::mem::replace(&mut is_placed[index], true);
            if is_second {
                it.notes.add("nodes that appear twice", || {
                    format!("{here}: nodes[{index}] has another place already, where it stays")
                });
            }
            Ok::<_, ImportError>(!is_second)
        };
        let mut children = vec![Vec::new(); nodes.len()];
        let mut tops = Vec::new();
        for &root in roots {
            if place_once(self, root, place)? {
                tops.push(root);
            }
        }
        let mut stack: Vec<usize> = tops.iter().rev().copied().collect();
        while let Some(index) = stack.pop() {
            for &child in &nodes[index].children {
                if place_once(self, child, &format!("nodes[{index}].children"))? {
                    children[index].push(child);
                }
            }
            stack.extend(children[index].iter().rev());
        }
        Ok((children, tops))
    }

    /// Whether the scale of `nodes[index]` is 0 at all times: then it shows no mesh, but cameras and lights, whose
    /// scale does not count.
    fn is_flat(&self, index: usize) -> bool {
        let source = &self.document.nodes[index];
        match &source.matrix {
            Some(matrix) => linear(matrix) == DMat3::ZERO,
            None => source.scale == Some([0.0; 3]) && !self.scaled[index],
        }
    }

    /// The node of the scene for `source`.
    fn node(&mut self, source: &Source, visit: &Visit, name: String, here: &str) -> Node {
        let mut node = Node {
            name,
            parent: visit.parent,
            placement: visit.parent_from_above,
            visible: !is_hidden(source),
            ..Node::default()
        };
        if self.animated[visit.index] && source.matrix.is_none() {
            let (scale, rotation, translation) = self.parts(source, here);
            node.scale = scale;
            node.rotation = rotation;
            node.translation = translation;
        } else {
            node.placement *= self.placed(source, here);
        }
        if !is_invertible(&node.parent_from_node()) {
            self.notes.add("hidden nodes", || {
                format!("{here} is hidden: its transform has no extent, or is out of range")
            });
            node = Node {
                name: node.name,
                parent: node.parent,
                visible: false,
                ..Node::default()
            };
        }
        node
    }

    /// The transform of a node to the space above it.
    fn placed(&mut self, source: &Source, here: &str) -> DAffine3 {
        let Some(matrix) = &source.matrix else {
            let (scale, rotation, translation) = self.parts(source, here);
            return DAffine3::from_scale_rotation_translation(scale, rotation, translation);
        };
        if [matrix[3], matrix[7], matrix[11], matrix[15]] != [0.0, 0.0, 0.0, 1.0] {
            self.notes.add("transforms that are not affine", || {
                format!("{here}.matrix is not affine: its last row was ignored")
            });
        }
        DAffine3 {
            matrix3: thickened(linear(matrix)),
            translation: DVec3::new(matrix[12], matrix[13], matrix[14]),
        }
    }

    /// Scale, rotation and translation of a node without a matrix.
    fn parts(&mut self, source: &Source, here: &str) -> (DVec3, DQuat, DVec3) {
        let rotation = DQuat::from_array(source.rotation.unwrap_or([0.0, 0.0, 0.0, 1.0]));
        let rotation = unit(rotation).unwrap_or_else(|| {
            self.notes.add("rotations without a direction", || {
                format!("{here}.rotation is zero: there is no rotation")
            });
            DQuat::IDENTITY
        });
        let scale = extended(DVec3::from(source.scale.unwrap_or([1.0; 3])));
        let translation = DVec3::from(source.translation.unwrap_or_default());
        (scale, rotation, translation)
    }

    /// Adds what `nodes[index]`, which is node `added` of the scene, carries.
    fn carry(
        &mut self,
        index: usize,
        added: usize,
        is_flat: bool,
        here: &str,
    ) -> Result<(), ImportError> {
        let document = self.document;
        let source = &document.nodes[index];
        if let Some(mesh) = source.mesh {
            let mesh = self.carry_mesh(index, added, mesh, is_flat, here);
            self.spared(mesh)?;
        }
        if let Some(index) = source.camera {
            let camera = self.camera(index, source, added, here);
            self.spared(camera)?;
        }
        let light = source.extensions.as_ref().and_then(|e| e.light.as_ref());
        if let Some(light) = light {
            let light = self.light(light.light, added, here);
            self.spared(light)?;
        }
        Ok(())
    }

    /// Adds the mesh of `nodes[index]`, which is node `added` of the scene.
    fn carry_mesh(
        &mut self,
        index: usize,
        added: usize,
        mesh: usize,
        is_flat: bool,
        here: &str,
    ) -> Result<(), ImportError> {
        let document = self.document;
        let source = &document.nodes[index];
        let skin_of = self.skin_of(source, here)?;
        // The transform of the node of a skinned mesh does not count.
        if is_flat && skin_of.is_none() {
            return Ok(());
        }
        {
            let skin = source.skin.and_then(|skin| document.skins.get(skin));
            let mut joints = skin.iter().flat_map(|skin| &skin.joints);
            let bends = joints.any(|&joint| self.moving.get(joint).is_some_and(|moves| *moves));
            let may_hide = self.moving[index] || !self.scene.nodes[added].visible;
            let deforms = bends || self.morphed[index] || source.skin.is_some() && may_hide;
            let mesh = match deforms {
                true => self.deforming_mesh(index, mesh, here)?,
                false => self.mesh(mesh, source, here)?,
            };
            if let (Some(mesh), Some(_)) = (mesh, skin_of) {
                // The node of a skinned mesh only hides it.
                self.scene.instances.push(Instance {
                    mesh,
                    placement: DAffine3::IDENTITY,
                    node: deforms.then_some(added),
                    name: String::new(),
                });
            } else if let Some(mesh) = mesh {
                for placement in self.placements(source, here)? {
                    if !is_invertible(&placement) {
                        self.notes.add("hidden copies", || {
                            format!("{here}: copies are hidden whose transform is out of range")
                        });
                        continue;
                    }
                    self.scene.instances.push(Instance {
                        mesh,
                        placement,
                        node: Some(added),
                        name: String::new(),
                    });
                }
            }
        }
        Ok(())
    }

    /// The places of a mesh in the space of its node: one, or those of `EXT_mesh_gpu_instancing`.
    fn placements(&mut self, source: &Source, here: &str) -> Result<Vec<DAffine3>, ImportError> {
        let copies = source
            .extensions
            .as_ref()
            .and_then(|e| e.instancing.as_ref());
        let Some(copies) = copies.filter(|copies| !copies.attributes.is_empty()) else {
            return Ok(vec![DAffine3::IDENTITY]);
        };
        let place = format!("{here}.EXT_mesh_gpu_instancing");
        let accessors = self.accessors();
        let attribute = |name: &str| copies.attributes.get(name).copied();
        let vectors = |name: &str| match attribute(name) {
            Some(index) => accessors
                .vectors::<3>(index, &[Kind::Vec3], 0.0, &place)
                .map(Some),
            None => Ok(None),
        };
        let (translations, scales) = (vectors("TRANSLATION")?, vectors("SCALE")?);
        let rotations = match attribute("ROTATION") {
            Some(index) => Some(accessors.vectors::<4>(index, &[Kind::Vec4], 0.0, &place)?),
            None => None,
        };
        let counts = [
            translations.as_ref().map(Vec::len),
            scales.as_ref().map(Vec::len),
            rotations.as_ref().map(Vec::len),
        ];
        let count = counts.iter().flatten().copied().max().unwrap_or(0);
        if counts.iter().flatten().any(|other| *other != count) {
            return Err(self.blame.bad(place, "attributes of different lengths"));
        }
        let size = budget::size::<Instance>(count);
        self.ledger.take(size, 2 * size, &place)?;
        let vector = |v: [f32; 3]| DVec3::from(v.map(f64::from));
        let placement = |i: usize| {
            let rotation = rotations.as_ref().map(|all| all[i].map(f64::from));
            DAffine3::from_scale_rotation_translation(
                extended(scales.as_ref().map_or(DVec3::ONE, |all| vector(all[i]))),
                rotation
                    .and_then(|q| unit(DQuat::from_array(q)))
                    .unwrap_or_default(),
                translations
                    .as_ref()
                    .map_or(DVec3::ZERO, |all| vector(all[i])),
            )
        };
        Ok((0..count).map(placement).collect())
    }
}

/// Whether `KHR_node_visibility` hides a node and what is below it.
fn is_hidden(source: &Source) -> bool {
    let extensions = source.extensions.as_ref();
    extensions
        .and_then(|it| it.visibility.as_ref())
        .is_some_and(|it| !it.visible)
}
