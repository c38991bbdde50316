//! The meshes of a scene, its nodes, and the instances of meshes.

use super::runs::{LEAST, runs};
use super::{Writer, exact, ply};
use crate::import::native::file::{
    MeshOrName, MeshTable, NodeTable, ObjectTable, PointsTable, RepeatTable, Spanned,
    TransformTable,
};
use crate::import::native::values::differing;
use glam::{DAffine3, DVec3};
use glimray_scene::{Mesh, Node};

impl Writer<'_> {
    pub fn mesh(&mut self, index: usize, mesh: &Mesh) -> MeshTable {
        let mut used = mesh.materials.clone();
        used.sort_unstable();
        used.dedup();
        let number_of = |material: u32| used.binary_search(&material).unwrap_or(0) as u32;
        let bytes = ply::mesh(mesh, number_of, used.len() > 1);
        let file = self.beside.add(&self.names.meshes[index], "ply", bytes);
        let names = used.iter().map(|&i| self.names.material(i as usize));
        MeshTable {
            file: file.into(),
            materials: Some(names.collect()),
        }
    }

    pub fn node(&self, index: usize, node: &Node) -> NodeTable {
        NodeTable {
            name: self.names.nodes[index].clone().into(),
            carried_by: self.names.node(node.parent),
            transform: at_rest(node).map(Into::into),
            placement: exact::transform(node.placement).map(Into::into),
            visible: (!node.visible).then_some(false),
        }
    }

    pub fn instances(&mut self) -> Vec<Spanned<ObjectTable>> {
        let scene = self.scene;
        let is_alike = |a: &usize, b: &usize| {
            let (a, b) = (&scene.instances[*a], &scene.instances[*b]);
            a.mesh == b.mesh && a.node == b.node && a.name == b.name
        };
        let all: Vec<usize> = (0..scene.instances.len()).collect();
        let mut tables = Vec::new();
        for run in runs(&all, is_alike) {
            let run = &scene.instances[run];
            let name = self.names.meshes[run[0].mesh].clone();
            let table = |placement| ObjectTable {
                mesh: Some(MeshOrName::Name(name.clone()).into()),
                transform: exact::transform(placement).map(Into::into),
                ..ObjectTable::default()
            };
            let places = run.iter().map(|instance| instance.placement);
            let run_tables = match run.len() >= LEAST {
                true => {
                    let repeat = self.copies(&name, &places.collect::<Vec<_>>());
                    let table = table(DAffine3::IDENTITY);
                    vec![ObjectTable { repeat, ..table }]
                }
                false => places.map(table).collect(),
            };
            tables.extend(run_tables.into_iter().map(|table| {
                ObjectTable {
                    name: self.names.objects.next(&run[0].name),
                    carried_by: self.names.node(run[0].node),
                    ..table
                }
                .into()
            }));
        }
        tables
    }

    /// The repetition at many places, which are in a file.
    pub fn copies(&mut self, name: &str, places: &[DAffine3]) -> Option<Spanned<RepeatTable>> {
        let bytes = ply::places(places);
        let file = self.beside.add(&format!("{name}-places"), "ply", bytes);
        let repeat = RepeatTable {
            points: Some(PointsTable { file: file.into() }),
            ..RepeatTable::default()
        };
        Some(repeat.into())
    }
}

/// The transform that animations of a node override, if it is not the identity.
fn at_rest(node: &Node) -> Option<TransformTable> {
    let (rotate_deg, rotation) = exact::turn(node.rotation);
    let (translate, scale) = (
        differing(node.translation, DVec3::ZERO),
        differing(node.scale, DVec3::ONE),
    );
    let is_moved = translate.is_some() || scale.is_some();
    let is_other = is_moved || rotate_deg.is_some() || rotation.is_some();
    is_other.then_some(TransformTable {
        translate,
        rotate_deg,
        rotation,
        scale,
        matrix: None,
    })
}
