//! Wavefront OBJ with MTL: polygons, normals, and the Phong part of materials.
//!
//! All groups of a file become one [`Mesh`]. Polygons are triangulated, concave ones too. Corners
//! without normals get the area-weighted mean of the faces round their vertex, or the face's own
//! normal after `s off`. Lines, points and curves are left out and reported. Vertices have u and v only
//! where some material wants them: they part vertices that are one without.

mod face;
mod lines;
mod materials;
mod mtl;
mod uv;
mod weld;

use super::error::ImportError;
use super::paths::{self, Files, Refusal};
use super::picture::Pictures;
use super::polygon::{self, Cutter, Defect};
use super::source::{Source, Token, quote};
use super::{number, repair_notes, stage};
use crate::scene::{Instance, Material, Mesh, OutputDefaults, Scene, Texture};
use face::Corner;
use glam::{DAffine3, DVec3, Vec2, Vec3};
use lines::{Line, Lines};
use std::collections::{BTreeMap, HashMap};
use std::ops::Range;
use std::path::Path;

/// The largest material file, in bytes.
const MAX_MTL_BYTES: u64 = 64 << 20;

/// Statements of the format that say nothing about triangles.
const IGNORED: [&[u8]; 17] = [
    b"o",
    b"g",
    b"mg",
    b"vp",
    b"bevel",
    b"c_interp",
    b"d_interp",
    b"lod",
    b"shadow_obj",
    b"trace_obj",
    b"ctech",
    b"stech",
    b"maplib",
    b"usemap",
    b"call",
    b"csh",
    b"end",
];

/// The triangles of a file.
pub(super) struct Model {
    /// Its materials are indices into `materials`.
    pub mesh: Mesh,
    /// World from mesh: the translation that brings the mesh back to where the file has it.
    pub offset: DVec3,
    /// Their textures are indices into `textures`.
    pub materials: Vec<Material>,
    pub textures: Vec<Texture>,
    /// Notes for [`Scene::skipped`].
    pub skipped: Vec<String>,
}

/// The model in `source` as a scene, with a camera and lights that show it.
pub(super) fn read_scene(source: &Source, files: &Files) -> Result<Scene, ImportError> {
    let mut pictures = Pictures::default();
    let model = read(source, files, &mut pictures, None)?;
    let mut scene = Scene {
        materials: model.materials,
        textures: model.textures,
        pictures: pictures.pictures,
        output: OutputDefaults {
            size: (800, 600),
            samples: 4,
            ..OutputDefaults::default()
        },
        skipped: model.skipped,
        ..Scene::default()
    };
    if model.mesh.triangles.is_empty() {
        scene.skipped.push("the model has no triangles".to_owned());
    } else {
        let world_from_object = DAffine3::from_translation(model.offset);
        scene.meshes.push(model.mesh.into());
        scene.instances.push(Instance {
            mesh: 0,
            placement: world_from_object,
            node: None,
        });
    }
    stage::light(&mut scene);
    scene.cameras = vec![stage::camera(&scene)];
    Ok(scene)
}

/// The model in the file at `path`, which must already be known to be permitted. Its pictures go to
/// `pictures`. Where another material takes the place of its own, `replaced` says whether that one
/// wants u and v.
pub(super) fn read_model(
    path: &Path,
    files: &Files,
    pictures: &mut Pictures,
    replaced: Option<bool>,
) -> Result<Model, ImportError> {
    let bytes = paths::read(path, super::MAX_GEOMETRY_BYTES)?;
    let source = Source::new("bad model", path, bytes)?;
    read(&source, &files.named_in(path), pictures, replaced)
}

fn read(
    source: &Source,
    files: &Files,
    pictures: &mut Pictures,
    replaced: Option<bool>,
) -> Result<Model, ImportError> {
    let mut reader = Reader {
        source,
        files,
        pictures,
        replaced,
        positions: Vec::new(),
        normals: Vec::new(),
        uvs: Vec::new(),
        face_normals: Vec::new(),
        smooth_normals: Vec::new(),
        corners: Vec::new(),
        cutter: Cutter::new(),
        fan_count: 0,
        triangles: Vec::new(),
        material: 0,
        material_names: vec![String::new()],
        material_ids: HashMap::new(),
        flat: false,
        library: HashMap::new(),
        textures: Vec::new(),
        skipped: Vec::new(),
        left_out: BTreeMap::new(),
        unknown: None,
        known_count: 0,
    };
    for mut line in Lines::new(&source.bytes) {
        if let Some(keyword) = line.word() {
            reader.statement(keyword, &mut line)?;
        }
    }
    if let (Some(span), 0) = (reader.unknown.clone(), reader.known_count) {
        let why = format!(
            "{} is no statement of an OBJ file",
            quote(&source.bytes[span.clone()])
        );
        return Err(source.malformed(span, why, "Check that this is a Wavefront OBJ file"));
    }
    Ok(reader.finish())
}

struct Reader<'s> {
    source: &'s Source,
    files: &'s Files,
    pictures: &'s mut Pictures,
    replaced: Option<bool>,
    positions: Vec<DVec3>,
    normals: Vec<Vec3>,
    uvs: Vec<Vec2>,
    /// Normals of flat faces, which the file does not have.
    face_normals: Vec<Vec3>,
    /// For each position, the sum of the normals of the faces that have none there; shorter than
    /// `positions` where there are none at all.
    smooth_normals: Vec<DVec3>,
    corners: Vec<Corner>,
    cutter: Cutter,
    /// Faces that could only be cut into fans.
    fan_count: usize,
    /// Indices into `corners`.
    triangles: Vec<[u32; 3]>,
    /// Index into `material_names` of the material in use; 0 before the first `usemtl`.
    material: u32,
    material_names: Vec<String>,
    material_ids: HashMap<Vec<u8>, u32>,
    /// Whether faces without normals are flat.
    flat: bool,
    library: HashMap<String, mtl::Entry>,
    textures: Vec<Texture>,
    skipped: Vec<String>,
    /// How much of what was left out.
    left_out: BTreeMap<&'static str, usize>,
    /// The first statement that we do not know.
    unknown: Option<Range<usize>>,
    known_count: usize,
}

impl Reader<'_> {
    fn statement(&mut self, keyword: Token, line: &mut Line) -> Result<(), ImportError> {
        self.known_count += 1;
        match keyword.bytes {
            b"v" => self.vertex(keyword, line)?,
            b"vn" => {
                let normal = self.numbers(keyword, line)?;
                self.normals.push(normal.as_vec3());
            }
            b"vt" => self.texture_coordinates(keyword, line)?,
            b"f" | b"fo" => self.face(keyword, line)?,
            b"usemtl" => self.use_material(line),
            b"mtllib" => self.material_library(line)?,
            b"s" => self.flat = matches!(line.word().map(|w| w.bytes), Some(b"off" | b"0")),
            b"l" | b"p" => self.leave_out("lines and points"),
            b"curv" | b"curv2" | b"surf" | b"cstype" | b"deg" | b"bmat" | b"step" | b"parm"
            | b"trim" | b"hole" | b"scrv" | b"sp" | b"con" => {
                self.leave_out("free-form statements")
            }
            word if IGNORED.contains(&word) => {}
            word if word.iter().all(|b| b.is_ascii_alphanumeric() || *b == b'_') => {
                self.known_count -= 1;
                self.leave_out("unknown statements");
                self.unknown.get_or_insert(keyword.span());
            }
            _ => {
                let why = format!("{} is no statement of an OBJ file", keyword.quote());
                let todo = "Check that this is a Wavefront OBJ file";
                return Err(self.source.malformed(keyword.span(), why, todo));
            }
        }
        Ok(())
    }

    fn leave_out(&mut self, what: &'static str) {
        *self.left_out.entry(what).or_default() += 1;
    }

    fn vertex(&mut self, keyword: Token, line: &mut Line) -> Result<(), ImportError> {
        let position = self.numbers(keyword, line)?;
        self.positions.push(position);
        // A weight (which only curves use), a colour, or both.
        let mut more = 0;
        while let Some(word) = line.word() {
            number::parse(self.source, word)?;
            more += 1;
            if more > 4 {
                let why = "a vertex has too many numbers".to_owned();
                return Err(self.source.malformed(word.span(), why, "Write `v X Y Z`"));
            }
        }
        if more >= 3 {
            self.leave_out("vertex colours");
        }
        Ok(())
    }

    fn numbers(&self, keyword: Token, line: &mut Line) -> Result<DVec3, ImportError> {
        let mut values = DVec3::ZERO;
        for value in values.as_mut() {
            let Some(word) = line.word() else {
                let why = format!("{} needs three numbers", keyword.quote());
                return Err(self
                    .source
                    .malformed(keyword.span(), why, "Add the missing ones"));
            };
            *value = number::parse(self.source, word)?;
        }
        Ok(values)
    }

    fn face(&mut self, keyword: Token, line: &mut Line) -> Result<(), ImportError> {
        let counts = [self.positions.len(), self.uvs.len(), self.normals.len()];
        let mut face = face::read(self.source, keyword, line, counts, self.material)?;
        if face.len() < 3 {
            self.leave_out("faces of fewer than three corners");
            return Ok(());
        }
        let points: Vec<DVec3> = face
            .iter()
            .map(|c| self.positions[c.position as usize])
            .collect();
        self.complete_normals(&mut face, polygon::normal(&points));
        let first = self.corners.len();
        if first + face.len() > face::MAX_CORNERS {
            let why = format!("more than {} corners of faces", face::MAX_CORNERS);
            let error =
                self.source
                    .malformed(keyword.span(), why, "Split the model into several files");
            return Err(ImportError::TooBig(error.into_fault()));
        }
        let shift = |triangle: [u32; 3]| triangle.map(|i| first as u32 + i);
        let triangles = self.cutter.triangles(&points).unwrap_or_else(|defect| {
            // Triangles without area are counted when the mesh is repaired.
            self.fan_count += usize::from(defect != Defect::NoArea);
            polygon::fan(points.len())
        });
        self.triangles.extend(triangles.into_iter().map(shift));
        self.corners.append(&mut face);
        Ok(())
    }

    /// Sees to the corners of `face` that have no normals, where `normal` is the face's own, as
    /// long as its area: the whole face counts, so that it matters not how it is cut.
    fn complete_normals(&mut self, face: &mut [Corner], normal: DVec3) {
        let mut bare = face
            .iter_mut()
            .filter(|corner| corner.normal == face::NONE)
            .peekable();
        if bare.peek().is_none() {
            return;
        }
        if self.flat {
            let index = face::FACE_NORMAL | self.face_normals.len() as u32;
            self.face_normals.push(normal.normalize_or_zero().as_vec3());
            bare.for_each(|corner| corner.normal = index);
        } else {
            self.smooth_normals
                .resize(self.positions.len(), DVec3::ZERO);
            bare.for_each(|corner| self.smooth_normals[corner.position as usize] += normal);
        }
    }

    fn use_material(&mut self, line: &Line) {
        let name = line.rest().bytes;
        self.material = match self.material_ids.get(name) {
            Some(&id) => id,
            None => {
                let id = self.material_names.len() as u32;
                self.material_names
                    .push(String::from_utf8_lossy(name).into_owned());
                self.material_ids.insert(name.to_vec(), id);
                id
            }
        };
    }

    /// Reads the libraries that `line` names: one whose name may have spaces, else several.
    fn material_library(&mut self, line: &mut Line) -> Result<(), ImportError> {
        let whole = line.rest();
        if self.library_file(whole)? {
            return Ok(());
        }
        let mut words = Vec::new();
        while let Some(word) = line.word() {
            words.push(word);
        }
        for word in words {
            if word.bytes.len() == whole.bytes.len() || !self.library_file(word)? {
                let note = format!("the material file {} does not exist", word.quote());
                if !self.skipped.contains(&note) {
                    self.skipped.push(note);
                }
            }
        }
        Ok(())
    }

    /// Whether the library `name` exists and was read.
    fn library_file(&mut self, name: Token) -> Result<bool, ImportError> {
        let text = String::from_utf8_lossy(name.bytes);
        let path = match self.files.resolve(&text) {
            Ok(path) => path,
            Err(Refusal::Missing(_)) => return Ok(false),
            Err(refusal) => {
                let malformed = |why, todo: &str| self.source.malformed(name.span(), why, todo);
                return Err(refusal.into_error("material file", malformed));
            }
        };
        let bytes = paths::read(&path, MAX_MTL_BYTES)?;
        // Exporters do write empty libraries.
        if !bytes.is_empty() {
            let source = Source::new("bad material file", &path, bytes)?;
            let library = mtl::read(&source)?;
            self.library.extend(library.materials);
            self.skipped.extend(library.skipped);
        }
        Ok(true)
    }

    fn finish(mut self) -> Model {
        let (materials, material_of_id) = self.materials();
        self.drop_unwanted_uvs(&materials, &material_of_id);
        let (vertices, vertex_of_corner) = weld::weld(&self.corners);
        drop(std::mem::take(&mut self.corners));
        let uvs = self.uvs_of(&vertices, &materials);

        let world: Vec<DVec3> = vertices
            .iter()
            .map(|v| self.positions[v.position as usize])
            .collect();
        let (positions, offset) = Mesh::from_world_positions(&world);
        let normal = |v: &Corner| match v.normal {
            face::NONE => self.smooth_normals[v.position as usize]
                .normalize_or_zero()
                .as_vec3(),
            index if index & face::FACE_NORMAL != 0 => {
                self.face_normals[(index & !face::FACE_NORMAL) as usize]
            }
            index => self.normals[index as usize],
        };
        let name = self.source.path.file_stem().unwrap_or_default();
        let mut mesh = Mesh {
            name: name.to_string_lossy().into_owned(),
            positions,
            normals: vertices.iter().map(normal).collect(),
            uvs,
            materials: vertices
                .iter()
                .map(|v| material_of_id[v.material as usize])
                .collect(),
            triangles: self.triangles,
        };
        for triangle in &mut mesh.triangles {
            *triangle = triangle.map(|corner| vertex_of_corner[corner as usize]);
        }
        let left_out = self.left_out.iter();
        self.skipped
            .extend(left_out.map(|(what, count)| format!("{what} left out: {count}")));
        if self.fan_count > 0 {
            let note = format!(
                "faces that cross themselves or are too large, cut into fans: {}",
                self.fan_count
            );
            self.skipped.push(note);
        }
        if let Some(span) = &self.unknown {
            let first = quote(&self.source.bytes[span.clone()]);
            self.skipped
                .push(format!("the first unknown statement is {first}"));
        }
        self.skipped.extend(repair_notes(mesh.repair()));
        Model {
            mesh,
            offset,
            materials,
            textures: self.textures,
            skipped: self.skipped,
        }
    }
}
