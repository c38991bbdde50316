//! Notes on what was not read of a PLY file, or repaired.

use super::reader::Reader;
use super::types::Element;
use super::{Content, faces};
use crate::import::notes::Notes;
use crate::import::source::quote;
use crate::import::uvs;

/// The properties that are read of vertices and faces of a model, and what else its header may name.
pub(in crate::import) const KEYS: [&str; 32] = [
    "x",
    "y",
    "z",
    "nx",
    "ny",
    "nz",
    "s",
    "t",
    "u",
    "v",
    "texture_u",
    "texture_v",
    "s2",
    "t2",
    "radius",
    "red",
    "green",
    "blue",
    "diffuse_red",
    "diffuse_green",
    "diffuse_blue",
    "r",
    "g",
    "b",
    "linear_red",
    "linear_green",
    "linear_blue",
    "linear_alpha",
    "vertex_indices",
    "vertex_index",
    "tristrips",
    "TextureFile",
];

impl Content {
    /// Notes the faces and points that were skipped or changed.
    pub(super) fn note(&self, notes: &mut Notes) {
        const WHAT: &str = "skipped parts";
        let mut add = |what: &str, count: usize| {
            if count > 0 {
                notes.add(WHAT, || format!("{what}: {count}"));
            }
        };
        add(
            "faces with fewer than three corners skipped",
            self.short_faces,
        );
        add(
            "faces that intersect themselves or are too large, triangulated as fans",
            self.fans,
        );
        add(
            "points with coordinates that are not finite skipped",
            self.lost_points,
        );
        add(
            "vertices with coordinates that are not finite skipped with their faces",
            self.lost.iter().filter(|lost| **lost).count(),
        );
        add(
            "corners of faces at vertices that do not exist, skipped with their faces",
            self.absent_corners,
        );
        add(
            "radii of points that are not finite skipped",
            self.lost_radii,
        );
        uvs::note(self.lost_uvs, notes);
    }
}

/// Notes what is not read.
pub(super) fn note(reader: &Reader, elements: &[Element], notes: &mut Notes) {
    for element in elements.iter().filter(|element| element.count > 0) {
        let is_read = |name: &str| match element.name.as_str() {
            "vertex" => KEYS.contains(&name) && !faces::CORNERS.contains(&name),
            _ => faces::CORNERS.contains(&name),
        };
        if !matches!(element.name.as_str(), "vertex" | "face" | "tristrips") {
            let (name, count) = (&element.name, element.count);
            notes.add("elements", || format!("elements `{name}` skipped: {count}"));
            continue;
        }
        let names = element
            .properties
            .iter()
            .map(|property| property.name.as_str());
        let skipped: Vec<&str> = names.filter(|name| !is_read(name)).take(16).collect();
        if !skipped.is_empty() {
            let what = &element.name;
            let skipped = skipped.join(", ");
            notes.add("properties", || {
                format!("{what} properties skipped: {skipped}")
            });
        }
    }
    for name in &reader.texture_files {
        let name = quote(name.as_bytes());
        notes.add("skipped textures", || format!("texture skipped: {name}"));
    }
}
