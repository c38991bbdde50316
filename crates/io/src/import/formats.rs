//! The formats of scenes and models: one row for each, with its file names, its limits and its importer. A format is added
//! here, and its importer beside this file.

use super::error::{ImportError, fault};
use super::options::Options;
use super::paths::{self, Files};
use super::resolver::FileError;
use super::source::{Source, quote};
#[cfg(feature = "archive")]
use super::zipped;
use super::{course, gltf, native, nff, obj, ply, stl};
use glimray_scene::Scene;
use std::path::Path;

/// A format of scenes or models.
#[derive(Clone, Copy, Debug)]
pub struct SceneFormat {
    /// Extensions of its files, in lower case.
    pub endings: &'static [&'static str],
    /// Name of the format.
    pub name: &'static str,
    /// The parts that are shown.
    pub shown: &'static str,
    /// The parts that are skipped and reported; empty if there are none.
    pub skipped: &'static str,
    /// Whether files have a model rather than a whole scene; those of archives may.
    pub is_model: bool,
    takes: Takes,
    /// Size limit of a file in bytes.
    pub(super) max_bytes: u64,
    read: fn(File) -> Result<Scene, ImportError>,
}

/// The options that a format takes besides those that all take.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Takes {
    Nothing,
    /// Overrides of keys.
    Overrides,
    /// A scene, a clip and a variant.
    Choices,
    /// All, for a scene of another format in the file.
    Everything,
}

/// A file, and all that it takes to read it.
struct File<'a> {
    path: &'a Path,
    bytes: Vec<u8>,
    options: &'a Options,
    files: &'a Files<'a>,
}

impl File<'_> {
    /// The text in any encoding, for errors with the heading `what`.
    fn text(self, what: &'static str) -> Result<Source, ImportError> {
        Source::of_any_encoding(what, self.path, self.bytes)
    }
}

/// The heading of errors in scenes.
const SCENE: &str = "bad scene";

/// Size limit of a file of geometry in bytes.
pub(super) const MAX_GEOMETRY_BYTES: u64 = 2 << 30;

/// The formats of scenes and models. Archives are searched in this order.
pub const SCENE_FORMATS: &[SceneFormat] = &[
    SceneFormat {
        endings: &["toml"],
        name: "glimray's own",
        shown: "everything that glimray can show, but deforming meshes",
        skipped: "",
        is_model: false,
        takes: Takes::Overrides,
        max_bytes: native::MAX_BYTES,
        read: |file| {
            let instead = file.options.instead_of_empty;
            let bytes = match instead.filter(|_| file.bytes.trim_ascii().is_empty()) {
                Some(text) => text.as_bytes().to_vec(),
                None => file.bytes,
            };
            let source = Source::new(SCENE, file.path, bytes)?;
            native::read(&source, file.options, file.files)
        },
    },
    SceneFormat {
        endings: &["scene"],
        name: "of the course CV 804",
        shown: "everything",
        skipped: "",
        is_model: false,
        takes: Takes::Nothing,
        max_bytes: MAX_GEOMETRY_BYTES,
        read: |file| course::read(&file.text(SCENE)?),
    },
    SceneFormat {
        endings: &["nff"],
        name: "Haines' NFF",
        shown: "everything but the inside of shapes of negative radius",
        skipped: "negative radii",
        is_model: false,
        takes: Takes::Nothing,
        max_bytes: MAX_GEOMETRY_BYTES,
        read: |file| nff::read(&file.text(SCENE)?),
    },
    SceneFormat {
        endings: &["obj"],
        name: "Wavefront OBJ with MTL",
        shown: "polygons, normals, smoothing groups, texture coordinates, vertex colours; colours, pictures, \
                normal and height maps, masks, mirrors, glass, roughness, metalness, clear coats, sheen and anisotropy",
        skipped: "points, lines, curves and surfaces; `disp`, `refl`, `map_Ns` and others, by name",
        is_model: true,
        takes: Takes::Nothing,
        max_bytes: MAX_GEOMETRY_BYTES,
        read: |file| {
            let (files, options) = (file.files, file.options);
            obj::read_scene(&file.text("bad model")?, files, options)
        },
    },
    SceneFormat {
        endings: &["gltf", "glb"],
        name: "glTF 2.0",
        shown: "meshes, instances, skins, morph targets, clips, cameras, lights, all maps of materials; \
                many extensions",
        skipped: "points and lines",
        is_model: true,
        takes: Takes::Choices,
        max_bytes: MAX_GEOMETRY_BYTES,
        read: |file| gltf::read(file.path, file.bytes, file.options, file.files),
    },
    SceneFormat {
        endings: &["ply"],
        name: "Stanford PLY, text and binary",
        shown: "faces of any number of corners, strips, normals, texture coordinates, vertex colours; points \
                as spheres",
        skipped: "edges and other elements and properties",
        is_model: true,
        takes: Takes::Nothing,
        max_bytes: MAX_GEOMETRY_BYTES,
        read: |file| ply::read_scene(file.path, &file.bytes, file.options),
    },
    SceneFormat {
        endings: &["stl"],
        name: "STL, text and binary",
        shown: "facets, and their colours in both dialects",
        skipped: "the normals in the file, which are reported where they contradict the facets",
        is_model: true,
        takes: Takes::Nothing,
        max_bytes: MAX_GEOMETRY_BYTES,
        read: |file| stl::read_scene(file.path, file.bytes, file.options),
    },
    #[cfg(feature = "archive")]
    SceneFormat {
        endings: &["zip"],
        name: "ZIP archive of one of these",
        shown: "one scene or model with its files",
        skipped: "further scenes",
        is_model: true,
        takes: Takes::Everything,
        max_bytes: MAX_GEOMETRY_BYTES,
        read: |file| zipped::read_scene(file.path, file.bytes, file.options),
    },
];

/// The extensions of the files that [`super::load`] reads, in lower case, in the order of [`SCENE_FORMATS`].
pub const SCENE_ENDINGS: &[&str] = &{
    let mut endings = [""; ENDING_COUNT];
    let (mut format, mut count) = (0, 0);
    while format < SCENE_FORMATS.len() {
        let mut own = 0;
        while own < SCENE_FORMATS[format].endings.len() {
            endings[count] = SCENE_FORMATS[format].endings[own];
            (own, count) = (own + 1, count + 1);
        }
        format += 1;
    }
    endings
};

const ENDING_COUNT: usize = {
    let (mut format, mut count) = (0, 0);
    while format < SCENE_FORMATS.len() {
        count += SCENE_FORMATS[format].endings.len();
        format += 1;
    }
    count
};

impl SceneFormat {
    /// The format of a file by its extension; `None` if it is not one of [`SCENE_ENDINGS`].
    pub fn of(path: &Path) -> Option<&'static Self> {
        let ending = path.extension()?;
        let is = |other: &&str| ending.eq_ignore_ascii_case(other);
        (SCENE_FORMATS.iter()).find(|format| format.endings.iter().any(is))
    }

    /// As [`Self::of`].
    ///
    /// # Errors
    /// There is no such format.
    pub(super) fn required(path: &Path) -> Result<&'static Self, ImportError> {
        Self::of(path).ok_or_else(|| unknown(path))
    }

    /// The format of a model by the first of its bytes.
    ///
    /// # Errors
    /// They are those of no model.
    #[cfg(not(target_arch = "wasm32"))]
    pub(super) fn of_content(path: &Path, bytes: &[u8]) -> Result<&'static Self, ImportError> {
        /// Lines of an OBJ file among which there is a vertex: others are names, comments and libraries.
        const MOST_LINES: usize = 1000;
        let start = bytes.trim_ascii_start();
        let mut lines = start.split(|byte| *byte == b'\n').take(MOST_LINES);
        let ending = match start {
            _ if start.starts_with(b"glTF") => "glb",
            _ if start.starts_with(b"PK\x03\x04") => "zip",
            _ if start.starts_with(b"ply") => "ply",
            _ if start.starts_with(b"{") => "gltf",
            _ if stl::is_stl(bytes) => "stl",
            _ if lines.any(|line| line.starts_with(b"v ")) => "obj",
            _ => return Err(unknown(path)),
        };
        (SCENE_FORMATS.iter())
            .find(|format| format.endings.contains(&ending))
            .ok_or_else(|| unknown(path))
    }

    /// Whether its files have scenes of other formats in them.
    pub(super) fn is_archive(&self) -> bool {
        self.takes == Takes::Everything
    }

    /// Whether a scene, a clip or a variant of its files can be chosen.
    pub fn has_choices(&self) -> bool {
        self.takes(Takes::Choices)
    }

    fn takes(&self, option: Takes) -> bool {
        self.takes == option || self.is_archive()
    }

    /// The error for a scene file that could not be read.
    pub(super) fn unreadable(&self, path: &Path, error: &FileError) -> ImportError {
        match paths::unreadable(path, error, self.max_bytes) {
            // The size limit belongs to the format; it is not for lack of memory.
            ImportError::TooBig(fault) if self.max_bytes < MAX_GEOMETRY_BYTES => {
                ImportError::Malformed(fault)
            }
            error => error,
        }
    }

    /// The scene in `bytes`, the contents of the file at `path`.
    pub(super) fn scene(
        &self,
        path: &Path,
        bytes: Vec<u8>,
        options: &Options,
        files: &Files,
    ) -> Result<Scene, ImportError> {
        self.check(path, options)?;
        let mut scene = (self.read)(File {
            path,
            bytes,
            options,
            files,
        })?;
        // The scene in an archive is complete.
        if !self.is_archive() {
            super::finish(&mut scene, options);
        }
        Ok(scene)
    }

    /// Refuses options that the format does not take.
    fn check(&self, path: &Path, options: &Options) -> Result<(), ImportError> {
        let refuse =
            |what, why: &str, todo| Err(ImportError::Malformed(fault(what, path, why, todo)));
        if !options.overrides.is_empty() && !self.takes(Takes::Overrides) {
            let why = "only native scenes (.toml) have keys to set";
            return refuse("override refused", why, "Leave out the overrides");
        }
        for (what, is_given) in [
            ("scene", options.scene.is_some()),
            ("clip", options.clip.is_some()),
            ("variant", options.variant.is_some()),
        ] {
            if is_given && !self.has_choices() {
                let why = format!("only glTF models have a {what} to choose");
                return refuse("choice refused", &why, "Leave out the choice");
            }
        }
        if options.up.is_some() && !self.is_model {
            let todo = "Leave it out, or give the camera an up direction";
            return refuse(
                "up axis refused",
                "only models have an axis that points up",
                todo,
            );
        }
        Ok(())
    }
}

/// The keys of formats that are read by key, each with the extension of its files. A key that is read and has no effect
/// on the scene is listed in [`glimray_scene::Scene::skipped`].
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
