//! Morph targets and skins of a mesh: read as they are in the file for a mesh that a clip deforms, otherwise
//! applied once.

use super::Reader;
use super::document::{Kind, Node, Primitive};
use super::skins::Bound;
use crate::import::budget;
use crate::import::error::ImportError;
use crate::import::notes;
use glam::Vec3;
use glimray_scene::{Deformation, Influences, Joint, Mesh, MorphTarget, Skin};
use std::ops::Range;
use std::sync::Arc;

/// A mesh as it was modelled, and what may deform it.
#[derive(Clone, Default)]
pub(super) struct Modelled {
    pub mesh: Mesh,
    pub targets: Vec<MorphTarget>,
    pub influences: Influences,
    pub flat: Vec<Range<usize>>,
}

/// Which deformations of a mesh are read.
#[derive(Clone, Copy)]
pub(super) struct Wanted<'a> {
    /// Only targets whose weight is not 0; `None` for all.
    pub weights: Option<&'a [f64]>,
    pub is_skinned: bool,
}

/// A mesh that several nodes may deform differently.
#[derive(Clone)]
pub(super) struct Deformable {
    mesh: Arc<Mesh>,
    targets: Arc<[MorphTarget]>,
    influences: Arc<Influences>,
    flat: Arc<[Range<usize>]>,
}

impl Reader<'_> {
    /// The weights of the morph targets of `node`'s mesh at rest.
    pub(super) fn weights_of(&self, node: &Node) -> Vec<f64> {
        let mesh = node.mesh.and_then(|mesh| self.document.meshes.get(mesh));
        let own = node.weights.as_ref();
        own.or(mesh.and_then(|mesh| mesh.weights.as_ref()))
            .cloned()
            .unwrap_or_default()
    }

    /// Adds a mesh for `nodes[index]`, which a clip deforms, and returns its index; `None` if it has no
    /// triangles.
    pub(super) fn deforming_mesh(
        &mut self,
        index: usize,
        mesh: usize,
        here: &str,
    ) -> Result<Option<usize>, ImportError> {
        let document = self.document;
        let source = &document.nodes[index];
        let key = (mesh, source.skin.is_some());
        if !self.deformables.contains_key(&key) {
            let wanted = Wanted {
                weights: None,
                is_skinned: source.skin.is_some(),
            };
            let mut modelled = self.modelled(mesh, wanted, here)?;
            let repairs = modelled.mesh.repair_normals();
            notes::of_repairs(&mut self.notes, repairs);
            let deformable = (!modelled.mesh.triangles.is_empty()).then(|| Deformable {
                mesh: modelled.mesh.into(),
                targets: modelled.targets.into(),
                influences: modelled.influences.into(),
                flat: modelled.flat.into(),
            });
            self.deformables.insert(key, deformable);
        }
        let Some(shared) = self.deformables[&key].clone() else {
            return Ok(None);
        };
        let joints = self.skin_of(source, here)?;
        let joints = self.enough_joints(&shared.influences, joints, here)?;
        let mut weights = self.weights_of(source);
        weights.resize(shared.targets.len(), 0.0);
        // Each node has vertices of its own in its pose.
        let size = budget::size::<f64>(weights.len())
            + budget::size::<[Vec3; 2]>(shared.mesh.positions.len())
            + budget::size::<Joint>(joints.as_ref().map_or(0, |joints| joints.len()));
        self.ledger.take(size, 0, here)?;
        self.scene.meshes.push(shared.mesh);
        let added = self.scene.meshes.len() - 1;
        self.deforming.push((index, joints.clone()));
        self.scene.deformations.push(Deformation {
            mesh: added,
            targets: shared.targets,
            weights,
            // The skin's joints are known when all nodes were added.
            skin: joints.map(|_| Skin {
                joints: Vec::new(),
                influences: shared.influences,
            }),
            flat: shared.flat,
        });
        Ok(Some(added))
    }

    /// Gives skins their joints, after all nodes were added.
    pub(super) fn bind_skins(&mut self) {
        for (place, (_, joints)) in self.deforming.iter().enumerate() {
            let Some(joints) = joints else { continue };
            let joints = self.scene_joints(joints);
            if let Some(skin) = &mut self.scene.deformations[place].skin {
                skin.joints = joints;
            }
        }
    }

    /// `modelled`, a mesh with morph targets or a skin, in its pose at rest.
    pub(super) fn posed(
        &mut self,
        modelled: Modelled,
        joints: Option<Arc<[Bound]>>,
        mut weights: Vec<f64>,
        here: &str,
    ) -> Result<Mesh, ImportError> {
        let joints = self.enough_joints(&modelled.influences, joints, here)?;
        let joints = joints.as_deref();
        weights.resize(modelled.targets.len(), 0.0);
        let pose = self.rest_pose(joints, weights);
        let deformation = Deformation {
            mesh: 0,
            targets: modelled.targets.into(),
            weights: Vec::new(),
            skin: joints.map(|_| Skin {
                joints: Vec::new(),
                influences: modelled.influences.into(),
            }),
            flat: modelled.flat.into(),
        };
        let mut mesh = modelled.mesh;
        let count = mesh.positions.len();
        self.ledger
            .take(0, budget::size::<[Vec3; 6]>(count), here)?;
        let posed = deformation.posed(&mesh, &pose);
        let (mut positions, mut normals) = (Vec::with_capacity(count), Vec::with_capacity(count));
        let mut tangents = Vec::with_capacity(mesh.tangents.len());
        for i in 0..count {
            let (position, normal) = posed.vertex(i);
            let position = position.as_vec3();
            if !position.is_finite() {
                let why = format!("the pose moves vertex {i} out of range");
                return Err(self.blame.bad(here, why));
            }
            positions.push(position);
            normals.push(normal.as_vec3());
            if !mesh.tangents.is_empty() {
                tangents.push(posed.tangent(i, normal));
            }
        }
        (mesh.positions, mesh.normals, mesh.tangents) = (positions, normals, tangents);
        Ok(mesh)
    }

    /// `joints`, with the first one in place of those that they lack.
    fn enough_joints(
        &mut self,
        influences: &Influences,
        joints: Option<Arc<[Bound]>>,
        here: &str,
    ) -> Result<Option<Arc<[Bound]>>, ImportError> {
        let Some((joints, last)) = joints.clone().zip(influences.last_joint()) else {
            return Ok(joints);
        };
        let lacking = (last as usize + 1).saturating_sub(joints.len());
        if lacking == 0 {
            return Ok(Some(joints));
        }
        let why = format!("the skin has no joint {last}");
        let Some(&first) = joints.first() else {
            return Err(self.blame.bad(here, why));
        };
        self.notes.add("joints that do not exist", || {
            format!("{here}: {why}: its vertices move with the first joint")
        });
        let all = joints.iter().copied();
        Ok(Some(
            all.chain(std::iter::repeat_n(first, lacking)).collect(),
        ))
    }

    /// Adds the morph targets of a primitive to those of its mesh, whose vertices from `first` on have been made
    /// from these `sources` in the primitive.
    pub(super) fn add_targets(
        &mut self,
        targets: &mut Vec<MorphTarget>,
        primitive: &Primitive,
        (wanted, wanted_tangents): (Option<&[f64]>, bool),
        (first, sources): (usize, &Sources),
        here: &str,
    ) -> Result<(), ImportError> {
        if targets.len() < primitive.targets.len() {
            let size = budget::size::<MorphTarget>(primitive.targets.len());
            self.ledger.take(size, 0, here)?;
            targets.resize_with(primitive.targets.len(), MorphTarget::default);
        }
        for (i, (source, target)) in primitive.targets.iter().zip(targets).enumerate() {
            let is_used = wanted.is_none_or(|weights| weights.get(i).is_some_and(|w| *w != 0.0));
            if !is_used {
                continue;
            }
            let displacements = |name: &str| {
                let Some(&index) = source.get(name) else {
                    return Ok(Vec::new());
                };
                let at = format!("{here}.targets[{i}].{name}");
                let moved = self
                    .accessors()
                    .vectors::<3>(index, &[Kind::Vec3], 0.0, &at)?;
                if moved.len() != sources.count {
                    let why = "a target for another number of vertices";
                    return Err(self.blame.bad(at, why));
                }
                if moved.as_flattened().iter().any(|x| !x.is_finite()) {
                    return Err(self.blame.bad(at, "a displacement is not finite"));
                }
                Ok(moved)
            };
            let found = [
                displacements("POSITION"),
                displacements("NORMAL"),
                match wanted_tangents {
                    true => displacements("TANGENT"),
                    false => Ok(Vec::new()),
                },
            ];
            let [mut positions, mut normals, mut tangents] = [const { Vec::new() }; 3];
            for (list, found) in [&mut positions, &mut normals, &mut tangents]
                .into_iter()
                .zip(found)
            {
                *list = self.spared(found)?.unwrap_or_default();
            }
            let at = |list: &[[f32; 3]], i: usize| {
                list.get(i).map_or(Vec3::ZERO, |&moved| Vec3::from(moved))
            };
            let moved = |vertex: usize| {
                let source = sources.of(vertex);
                [&positions, &normals, &tangents].map(|list| at(list, source))
            };
            let is_moved = |vertex: &usize| moved(*vertex) != [Vec3::ZERO; 3];
            let vertices: Vec<usize> = (0..sources.len()).filter(is_moved).collect();
            let size = budget::size::<(u32, [Vec3; 3])>(vertices.len());
            self.ledger.take(size, size, here)?;
            if !tangents.is_empty() {
                target.tangents.resize(target.vertices.len(), Vec3::ZERO);
            }
            for vertex in vertices {
                let [position, normal, tangent] = moved(vertex);
                target.vertices.push((first + vertex) as u32);
                target.positions.push(position);
                target.normals.push(normal);
                if !target.tangents.is_empty() || !tangents.is_empty() {
                    target.tangents.push(tangent);
                }
            }
        }
        Ok(())
    }

    /// Adds the joints and weights of the vertices of a primitive to those of its mesh.
    pub(super) fn add_influences(
        &mut self,
        influences: &mut Influences,
        primitive: &Primitive,
        sources: &Sources,
        here: &str,
    ) -> Result<(), ImportError> {
        let mut sets = Vec::new();
        for set in 0.. {
            let attribute = |name: &str| {
                let index = primitive.attributes.get(&format!("{name}_{set}"))?;
                Some((*index, format!("{here}.attributes.{name}_{set}")))
            };
            let (Some((numbers, place)), Some((weights, _))) =
                (attribute("JOINTS"), attribute("WEIGHTS"))
            else {
                break;
            };
            let vectors = |index: usize| {
                self.accessors()
                    .vectors::<4>(index, &[Kind::Vec4], 0.0, &place)
            };
            let found = vectors(numbers).and_then(|numbers| Ok((numbers, vectors(weights)?)));
            let found = found.and_then(|(numbers, weights)| {
                if numbers.len() == sources.count && weights.len() == sources.count {
                    return Ok((numbers, weights));
                }
                let why = "joints and weights for another number of vertices";
                Err(self.blame.bad(&place, why))
            });
            let Some((mut numbers, weights)) = self.spared(found)? else {
                break;
            };
            let (numbers, weights) = (numbers.as_flattened_mut(), weights.as_flattened());
            let mut lost = 0;
            for (number, weight) in numbers.iter_mut().zip(weights) {
                if !(0.0..=65535.0).contains(number) {
                    lost += usize::from(*weight != 0.0 && weight.is_finite());
                    *number = 0.0;
                }
            }
            if lost > 0 {
                self.notes.add("joints that do not exist", || {
                    format!("{place}: {lost} weights of joints that do not exist move with the first joint")
                });
            }
            let size = budget::size::<[(u32, f32); 4]>(sources.len());
            self.ledger.take(size, 2 * size, &place)?;
            sets.push((numbers.to_vec(), weights.to_vec()));
        }
        for vertex in 0..sources.len() {
            let source = sources.of(vertex);
            let of_vertex = sets.iter().flat_map(|(numbers, weights)| {
                let range = 4 * source..4 * source + 4;
                let pairs = numbers[range.clone()].iter().zip(&weights[range]);
                pairs.filter(|(_, weight)| weight.is_finite())
            });
            influences.push(of_vertex.map(|(&number, &weight)| (number as u32, weight)));
        }
        Ok(())
    }
}

/// The vertices of a primitive that those of a mesh were made from.
pub(super) struct Sources {
    /// Number of vertices of the primitive.
    pub count: usize,
    /// By vertex of the mesh; `None` if they are the same.
    pub corners: Option<Vec<u32>>,
}

impl Sources {
    /// Number of vertices of the mesh.
    fn len(&self) -> usize {
        self.corners.as_ref().map_or(self.count, Vec::len)
    }

    fn of(&self, vertex: usize) -> usize {
        let corners = self.corners.as_ref();
        corners.map_or(vertex, |corners| corners[vertex] as usize)
    }
}
