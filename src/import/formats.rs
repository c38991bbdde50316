//! What is read of each format, for the tables of the manual.

use super::error::{ImportError, fault};
use super::source::quote;
use super::{SCENE_ENDINGS, course, nff, obj, ply, stl};
use std::path::Path;

/// A format of scenes or models.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct SceneFormat {
    /// Extensions of its files, in lower case; see [`super::SCENE_ENDINGS`].
    pub endings: &'static [&'static str],
    /// Its name.
    pub name: &'static str,
    /// The parts that are shown.
    pub shown: &'static str,
    /// The parts that are skipped and reported; empty if there are none.
    pub skipped: &'static str,
}

/// The formats of scenes and models, in the order of [`super::SCENE_ENDINGS`].
pub const SCENE_FORMATS: &[SceneFormat] = &[
    SceneFormat {
        endings: &["toml"],
        name: "glimray's own",
        shown: "everything that glimray can show, but deforming meshes",
        skipped: "",
    },
    SceneFormat {
        endings: &["scene"],
        name: "of the course CV 804",
        shown: "everything",
        skipped: "",
    },
    SceneFormat {
        endings: &["nff"],
        name: "Haines' NFF",
        shown: "everything but the inside of shapes of negative radius",
        skipped: "negative radii",
    },
    SceneFormat {
        endings: &["obj"],
        name: "Wavefront OBJ with MTL",
        shown: "polygons, normals, smoothing groups, texture coordinates, vertex colours; colours, pictures, \
                normal and height maps, masks, mirrors, glass, roughness, metalness, clear coats, sheen and anisotropy",
        skipped: "points, lines, curves and surfaces; `disp`, `refl`, `map_Ns` and others, by name",
    },
    SceneFormat {
        endings: &["gltf", "glb"],
        name: "glTF 2.0",
        shown: "meshes, instances, skins, morph targets, clips, cameras, lights, all maps of materials; \
                many extensions",
        skipped: "points and lines",
    },
    SceneFormat {
        endings: &["ply"],
        name: "Stanford PLY, text and binary",
        shown: "faces of any number of corners, strips, normals, texture coordinates, vertex colours; points \
                as spheres",
        skipped: "edges and other elements and properties",
    },
    SceneFormat {
        endings: &["stl"],
        name: "STL, text and binary",
        shown: "facets, and their colours in both dialects",
        skipped: "the normals in the file, which are reported where they contradict the facets",
    },
    #[cfg(feature = "archive")]
    SceneFormat {
        endings: &["zip"],
        name: "ZIP archive of one of these",
        shown: "one scene or model with its files",
        skipped: "further scenes",
    },
];

/// The keys of formats that are read by key, each with the extension of its files. A key that is read and has no effect
/// on the scene is listed in [`crate::scene::Scene::skipped`].
pub const FORMAT_KEYS: &[(&str, &[&str])] = &[
    ("obj", &obj::KEYS),
    ("mtl", &obj::LIBRARY_KEYS),
    ("ply", &ply::KEYS),
    ("stl", &stl::KEYS),
    ("nff", &nff::KEYS),
    ("scene", &course::KEYS),
];

/// The error for a file whose extension is not that of a format.
pub(super) fn unknown(path: &Path) -> ImportError {
    let ending = path.extension().map_or_else(
        || "the name has no extension".to_owned(),
        |ending| {
            let ending = format!(".{}", ending.to_string_lossy());
            format!(
                "the extension {} is not supported",
                quote(ending.as_bytes())
            )
        },
    );
    let (last, others) = SCENE_ENDINGS.split_last().unwrap_or((&"", &[]));
    let others = others.join(", .");
    let todo = format!("Use a .{others} or .{last} file; convert other models to one of these");
    ImportError::UnknownFormat(fault("unknown scene format", path, &ending, &todo))
}
