//! The meshes of a scene, its nodes, and the instances of meshes.

use super::runs::{LEAST, runs};
use super::text::{Table, key, list, scale, string, vector};
use super::{Writer, exact, ply};
use glam::{DAffine3, DVec3};
use glimray_scene::Node;

impl Writer<'_> {
    pub fn meshes(&mut self) {
        if !self.scene.meshes.is_empty() {
            self.text.section("Meshes");
        }
        for (index, mesh) in self.scene.meshes.iter().enumerate() {
            let mut used = mesh.materials.clone();
            used.sort_unstable();
            used.dedup();
            let number_of = |material: u32| used.binary_search(&material).unwrap_or(0) as u32;
            let bytes = ply::mesh(mesh, number_of, used.len() > 1);
            let name = &self.names.meshes[index];
            let file = self.beside.add(name, "ply", bytes);
            let materials = used
                .iter()
                .map(|&i| string(&self.names.materials[i as usize]));
            let mut table = Table::default();
            table.put("file", string(&file));
            table.put("materials", list(materials));
            self.text.gap();
            self.text.head(&format!("[meshes.{}]", key(name)));
            self.text.lines(&table);
        }
    }

    pub fn nodes(&mut self) {
        if !self.scene.nodes.is_empty() {
            self.text.section("Nodes");
        }
        for (index, node) in self.scene.nodes.iter().enumerate() {
            let mut table = Table::default();
            table.put("name", string(&self.names.nodes[index]));
            if let Some(parent) = node.parent {
                table.put("carried_by", string(&self.names.nodes[parent]));
            }
            if let Some(placement) = exact::transform(node.placement) {
                table.put("placement", placement);
            }
            let transform = at_rest(node);
            table.put_if(!transform.is_empty(), "transform", transform.inline());
            table.put_if(!node.visible, "visible", "false");
            self.text.gap();
            self.text.head("[[nodes]]");
            self.text.lines(&table);
        }
    }

    pub fn instances(&mut self) {
        let instances = &self.scene.instances;
        if !instances.is_empty() {
            self.text.section("Mesh instances");
        }
        let is_alike = |a: &usize, b: &usize| {
            let (a, b) = (&instances[*a], &instances[*b]);
            a.mesh == b.mesh && a.node == b.node
        };
        let all: Vec<usize> = (0..instances.len()).collect();
        for run in runs(&all, is_alike) {
            let first = &instances[run.start];
            let mut table = Table::default();
            table.put("mesh", string(&self.names.meshes[first.mesh]));
            if let Some(node) = first.node {
                table.put("carried_by", string(&self.names.nodes[node]));
            }
            if run.len() >= LEAST {
                let places: Vec<_> = instances[run].iter().map(|i| i.placement).collect();
                let name = self.names.meshes[first.mesh].clone();
                self.copies(table, &name, &places);
                continue;
            }
            for instance in &instances[run] {
                let mut table = Table::default();
                table.put("mesh", string(&self.names.meshes[instance.mesh]));
                self.object(table, instance.node, exact::transform(instance.placement));
            }
        }
    }

    /// One object with its parent node and transform.
    pub fn object(&mut self, mut table: Table, node: Option<usize>, transform: Option<String>) {
        if let Some(node) = node {
            table.put("carried_by", string(&self.names.nodes[node]));
        }
        if let Some(transform) = transform {
            table.put("transform", transform);
        }
        self.text.gap();
        self.text.head("[[objects]]");
        self.text.lines(&table);
    }

    /// One object with many copies.
    pub fn copies(&mut self, mut table: Table, name: &str, places: &[DAffine3]) {
        let bytes = ply::places(places);
        let file = self.beside.add(&format!("{name}-places"), "ply", bytes);
        let points = format!("{{ points = {{ file = {} }} }}", string(&file));
        table.put("repeat", points);
        self.text.gap();
        self.text.head("[[objects]]");
        self.text.lines(&table);
    }
}

/// The transform that animations of a node override.
fn at_rest(node: &Node) -> Table {
    let mut table = Table::default();
    let bits = |v: DVec3| v.to_array().map(f64::to_bits);
    let moved = bits(node.translation) != bits(DVec3::ZERO);
    table.put_if(moved, "translate", vector(node.translation));
    exact::put_rotation(&mut table, node.rotation);
    table.put_if(node.scale != DVec3::ONE, "scale", scale(node.scale));
    table
}
