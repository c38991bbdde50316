//! The cameras of a scene.

use super::text::{Table, number, string, vector};
use super::{Writer, exact};
use glam::DVec3;
use glimray_scene::Camera;

impl Writer<'_> {
    pub fn cameras(&mut self) {
        let count = self.scene.cameras.len();
        for (index, camera) in self.scene.cameras.iter().enumerate() {
            let table = self.camera(index, camera);
            self.text.gap();
            self.text.head(if count == 1 {
                "[camera]"
            } else {
                "[[cameras]]"
            });
            self.text.lines(&table);
        }
    }

    fn camera(&self, index: usize, camera: &Camera) -> Table {
        let mut table = Table::default();
        let name = &self.names.cameras[index];
        table.put_if(!name.is_empty(), "name", string(name));
        let is_default = index > 0 && index == self.scene.camera_index;
        table.put_if(is_default, "default", "true");
        if let Some(node) = camera.node {
            table.put("carried_by", string(&self.names.nodes[node]));
        }
        table.put("look_from", vector(camera.look_from));
        table.put(
            "look_at",
            match camera.target {
                Some(node) => string(&self.names.nodes[node]),
                None => vector(camera.look_at),
            },
        );
        let bits = |v: DVec3| v.to_array().map(f64::to_bits);
        table.put_if(bits(camera.up) != bits(DVec3::Y), "up", vector(camera.up));
        match exact::degrees(camera.fov_y) {
            Some(60.0) => {}
            Some(degrees) if (1e-3..=179.999).contains(&degrees) => {
                table.put("fov_y_deg", number(degrees));
            }
            _ => table.put("fov_y", number(camera.fov_y)),
        }
        if let Some(height) = camera.orthographic_height {
            table.put("orthographic", number(height));
        }
        let (near, far) = camera.clip;
        table.put_if(near > 0.0, "near", number(near));
        table.put_if(far < f64::INFINITY, "far", number(far));
        if let Some(lens) = &camera.lens {
            let mut inner = Table::default();
            inner.put("radius", number(lens.radius));
            inner.put("focus_distance", number(lens.focus_distance));
            if lens.blade_count > 0 {
                inner.put("blades", lens.blade_count.to_string());
            }
            if lens.blade_rotation.to_bits() != 0 {
                match exact::degrees(lens.blade_rotation) {
                    Some(degrees) => inner.put("blade_rotation_deg", number(degrees)),
                    None => inner.put("blade_rotation", number(lens.blade_rotation)),
                }
            }
            table.put("lens", inner.inline());
        }
        table
    }
}
