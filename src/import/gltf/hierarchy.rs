//! The nodes of one scene of the file (section 3.5 of the specification), and what hangs on them: meshes,
//! cameras and lights. Nodes that carry nothing and are not animated are folded into those below.

use super::Reader;
use super::document::{Kind, Node as Source};
use crate::import::budget;
use crate::import::error::ImportError;
use crate::scene::{Camera, Instance, Node};
use glam::{DAffine3, DMat3, DQuat, DVec3};

/// What replaces a scale of 0, relative to the largest of the three, so that transforms are invertible.
const FLAT: f64 = 1e-6;

/// A node of the file that is to be visited.
struct Visit {
    index: usize,
    /// The nearest node of the scene above it.
    parent: Option<usize>,
    /// From the space above the node to that parent's, or to the world.
    parent_from_above: DAffine3,
    /// The nearest node of the file above it that has a name, or itself.
    named: usize,
}

impl Reader<'_> {
    /// Adds the nodes under `roots`, and everything that they carry. Nodes that
    /// clips move stay apart.
    ///
    /// # Errors
    /// A node has two parents or is its own ancestor, or something that it refers to is wrong.
    pub(super) fn nodes(&mut self, roots: &[usize], place: &str) -> Result<(), ImportError> {
        let nodes = &self.document.nodes;
        self.check_tree(roots, place)?;
        self.find_worlds(roots);
        self.find_moving(roots);
        let visit = |&index: &usize| Visit {
            index,
            parent: None,
            parent_from_above: self.turn,
            named: index,
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
            if is_animated || is_carrier || is_joint {
                let size = budget::size::<(Node, Instance)>(1);
                self.ledger.take(size, 0, &here)?;
                let name = nodes[named].name.clone().unwrap_or_default();
                let node = self.node(source, &visit, is_animated, name, &here);
                self.scene.nodes.push(node);
                let added = self.scene.nodes.len() - 1;
                self.node_of[visit.index] = Some(added);
                (parent, above) = (Some(added), DAffine3::IDENTITY);
                self.carry(visit.index, added, &here)?;
            } else {
                above *= self.placed(source, &here);
            }
            stack.extend(source.children.iter().rev().map(|&index| Visit {
                index,
                parent,
                parent_from_above: above,
                named,
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
            stack.extend(nodes[index].children.iter().map(|&child| (child, world)));
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
            let children = document.nodes[index].children.iter();
            stack.extend(children.map(|&child| (child, is_moving)));
        }
        for &joint in document.skins.iter().flat_map(|skin| &skin.joints) {
            if self.moving.get(joint).is_some_and(|moves| *moves) {
                self.is_joint[joint] = true;
            }
        }
    }

    /// Checks that the nodes under `roots` are trees.
    fn check_tree(&self, roots: &[usize], place: &str) -> Result<(), ImportError> {
        let nodes = &self.document.nodes;
        let mut is_child = vec![false; nodes.len()];
        for (index, node) in nodes.iter().enumerate() {
            for &child in &node.children {
                let here = || format!("nodes[{index}].children");
                self.blame.get(nodes, child, "nodes", here())?;
                if std::mem::replace(&mut is_child[child], true) {
                    let why = format!("nodes[{child}] has two parents");
                    return Err(self.blame.bad(here(), why));
                }
            }
        }
        let mut is_root = vec![false; nodes.len()];
        for &root in roots {
            self.blame.get(nodes, root, "nodes", place)?;
            if is_child[root] || std::mem::replace(&mut is_root[root], true) {
                let why = format!("nodes[{root}] is not a root: it has a parent or appears twice");
                return Err(self.blame.bad(place, why));
            }
        }
        Ok(())
    }

    /// The node of the scene for `source`.
    fn node(
        &mut self,
        source: &Source,
        visit: &Visit,
        is_animated: bool,
        name: String,
        here: &str,
    ) -> Node {
        let mut node = Node {
            name,
            parent: visit.parent,
            placement: visit.parent_from_above,
            visible: !is_hidden(source),
            ..Node::default()
        };
        if is_animated && source.matrix.is_none() {
            let (scale, rotation, translation) = self.parts(source, here);
            node.scale = scale;
            node.rotation = rotation;
            node.translation = translation;
        } else {
            node.placement *= self.placed(source, here);
        }
        let is_flat = !is_invertible(&node.parent_from_node());
        if is_flat && self.is_joint[visit.index] && source.matrix.is_none() {
            // What follows a joint without extent has none either.
            let (_, rotation, translation) = self.parts(source, here);
            (node.rotation, node.translation) = (rotation, translation);
            (node.placement, node.scale) = (visit.parent_from_above, DVec3::splat(FLAT));
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
        let column = |i: usize| DVec3::new(matrix[4 * i], matrix[4 * i + 1], matrix[4 * i + 2]);
        if [matrix[3], matrix[7], matrix[11], matrix[15]] != [0.0, 0.0, 0.0, 1.0] {
            self.notes.add("transforms that are not affine", || {
                format!("{here}.matrix is not affine: its last row was ignored")
            });
        }
        DAffine3 {
            matrix3: DMat3::from_cols(column(0), column(1), column(2)),
            translation: column(3),
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
    fn carry(&mut self, index: usize, added: usize, here: &str) -> Result<(), ImportError> {
        let document = self.document;
        let source = &document.nodes[index];
        if let Some(mesh) = source.mesh {
            let skin = source.skin.and_then(|skin| document.skins.get(skin));
            let mut joints = skin.iter().flat_map(|skin| &skin.joints);
            let bends = joints.any(|&joint| self.moving.get(joint).is_some_and(|moves| *moves));
            let may_hide = self.moving[index] || !self.scene.nodes[added].visible;
            let deforms = bends || self.morphed[index] || source.skin.is_some() && may_hide;
            let mesh = match deforms {
                true => self.deforming_mesh(index, mesh, here)?,
                false => self.mesh(mesh, source, here)?,
            };
            if let (Some(mesh), Some(_)) = (mesh, source.skin) {
                // Its node only hides it.
                self.scene.instances.push(Instance {
                    mesh,
                    placement: DAffine3::IDENTITY,
                    node: deforms.then_some(added),
                });
            } else if let Some(mesh) = mesh {
                for placement in self.placements(source, here)? {
                    if !is_invertible(&placement) {
                        continue;
                    }
                    self.scene.instances.push(Instance {
                        mesh,
                        placement,
                        node: Some(added),
                    });
                }
            }
        }
        if let Some(index) = source.camera {
            let cameras = &self.document.cameras;
            let camera = self.blame.get(cameras, index, "cameras", here)?;
            let place = format!("cameras[{index}]");
            let mut named = [&camera.name, &source.name].into_iter().flatten();
            let mut seen = Camera {
                name: named
                    .find(|name| !name.is_empty())
                    .cloned()
                    .unwrap_or_default(),
                node: Some(added),
                ..Camera::default()
            };
            match (&camera.perspective, &camera.orthographic) {
                (Some(lens), _) if lens.yfov > 0.0 && lens.yfov < std::f64::consts::PI => {
                    seen.fov_y = lens.yfov;
                }
                (None, Some(lens)) if lens.ymag != 0.0 && lens.ymag.abs() < 1e18 => {
                    seen.orthographic_height = Some(2.0 * lens.ymag.abs());
                }
                _ => {
                    let why = "it needs a yfov between 0 and π, or a ymag other than 0";
                    return Err(self.blame.bad(place, why));
                }
            }
            self.scene.cameras.push(seen);
            self.cameras.push(index);
        }
        let light = source.extensions.as_ref().and_then(|e| e.light.as_ref());
        match light {
            Some(light) => self.light(light.light, added, here),
            None => Ok(()),
        }
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

/// `q` with unit length, if it has a length.
pub(super) fn unit(q: DQuat) -> Option<DQuat> {
    let length = q.length();
    (length.is_finite() && length > 1e-12).then(|| q * length.recip())
}

/// `scale` with small numbers in place of 0, if it is not all 0.
pub(super) fn extended(scale: DVec3) -> DVec3 {
    let least = FLAT * scale.abs().max_element();
    DVec3::from(scale.to_array().map(|s| match s.abs() < least {
        true => least.copysign(s),
        false => s,
    }))
}

/// Whether a transform is finite and can be inverted.
fn is_invertible(transform: &DAffine3) -> bool {
    let most = transform
        .matrix3
        .to_cols_array()
        .into_iter()
        .fold(0.0, |a: f64, b| a.max(b.abs()));
    let inverse = transform.inverse();
    transform.is_finite() && inverse.is_finite() && most < 1e18 && {
        transform.translation.abs().max_element() < 1e18 && transform.matrix3.determinant() != 0.0
    }
}
