//! Wavefront OBJ with MTL: polygons, normals, and the Phong part of materials.
//!
//! All groups of a file become one [`Mesh`]. Polygons, including concave ones, are triangulated. Faces
//! without normals are flat unless they are in a smoothing group; see `smooth.rs`. Lines, points and
//! curves are skipped and reported. Vertices keep u and v only if a material uses them, because they
//! would split vertices that are otherwise equal.

mod colors;
mod face;
mod lines;
mod materials;
mod mtl;
mod smooth;
mod statements;
mod surface;
mod uv;
mod weld;

pub(super) use mtl::KEYS as LIBRARY_KEYS;
pub(super) use statements::KEYS;

use super::budget::{self, Budget};
use super::error::ImportError;
use super::faults::Faults;
use super::model::Model;
use super::notes::{self, Notes};
use super::paths::Files;
use super::picture::Pictures;
use super::polygon::{self, Cutter, Defect};
use super::rounding;
use super::source::{Source, Token, quote};
use super::{Axis, Options};
use colors::Colors;
use face::Corner;
use glam::{DVec3, Vec2, Vec3};
use glimray_scene::{Material, Mesh, Scene, Texture};
use lines::{Line, Lines};
use smooth::SmoothFace;
use statements::Statement;
use std::collections::{BTreeMap, HashMap};
use std::ops::Range;
use std::path::Path;

/// The model in `source` as a scene.
pub(super) fn read_scene(
    source: &Source,
    files: &Files,
    options: &Options,
) -> Result<Scene, ImportError> {
    let mut pictures = Pictures::new(options);
    let mut model = read(source, files, &mut pictures, None)?;
    let pictures = pictures.finish(&mut model.notes);
    Ok(model.into_scene(pictures, Axis::Y, options))
}

/// The model in the file at `path`, which must have been resolved. Its images are added to `pictures`. If
/// another material replaces its own, `replaced` tells whether that one uses u and v.
pub(super) fn read_model(
    path: &Path,
    files: &Files,
    pictures: &mut Pictures,
    replaced: Option<bool>,
) -> Result<Model, ImportError> {
    let bytes = files.read(path, super::MAX_GEOMETRY_BYTES)?;
    let source = Source::of_any_encoding("bad model", path, bytes)?;
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
        colors: Colors::default(),
        normals: Vec::new(),
        uvs: Vec::new(),
        made_normals: Vec::new(),
        smooth_faces: Vec::new(),
        face: Vec::new(),
        corners: Vec::new(),
        cutter: Cutter::new(),
        fan_count: 0,
        triangles: Vec::new(),
        material: None,
        material_names: Vec::new(),
        material_ids: HashMap::new(),
        smoothing: smooth::UNSTATED,
        libraries: Vec::new(),
        textures: Vec::new(),
        names: [None; 2],
        notes: Notes::default(),
        faults: Faults::default(),
        budget: Budget::of(source.bytes.len()),
        left_out: BTreeMap::new(),
        statements: BTreeMap::new(),
        unknown: None,
        known_count: 0,
    };
    for mut line in Lines::new(&source.bytes) {
        if let Some(keyword) = line.word() {
            reader.statement(keyword, &mut line)?;
            let refuse = |why, todo: &str| source.malformed(keyword.span(), why, todo);
            reader.budget.check(reader.memory(), refuse)?;
        }
    }
    if let (Some(span), 0) = (reader.unknown.clone(), reader.known_count) {
        let why = format!(
            "{} is not an OBJ statement",
            quote(&source.bytes[span.clone()])
        );
        return Err(source.malformed(span, why, "Check that this is a Wavefront OBJ file"));
    }
    reader.finish()
}

struct Reader<'s> {
    source: &'s Source,
    files: &'s Files<'s>,
    pictures: &'s mut Pictures,
    replaced: Option<bool>,
    positions: Vec<DVec3>,
    colors: Colors,
    normals: Vec<Vec3>,
    uvs: Vec<Vec2>,
    /// Normals that are computed, not from the file.
    made_normals: Vec<Vec3>,
    smooth_faces: Vec<SmoothFace>,
    /// The corners of the current face.
    face: Vec<Corner>,
    corners: Vec<Corner>,
    cutter: Cutter,
    /// Number of faces that could only be triangulated as fans.
    fan_count: usize,
    /// Indices into `corners`.
    triangles: Vec<[u32; 3]>,
    /// The name of the current material; `None` before the first `usemtl`.
    material: Option<&'s [u8]>,
    /// The materials that faces use.
    material_names: Vec<Option<&'s [u8]>>,
    material_ids: HashMap<Option<&'s [u8]>, u32>,
    /// The current smoothing group; 0 for none.
    smoothing: u32,
    /// Material libraries. Only the materials in use are parsed.
    libraries: Vec<mtl::Library>,
    textures: Vec<Texture>,
    /// The name of the only object and of the only group; empty if there are several.
    names: [Option<&'s [u8]>; 2],
    notes: Notes,
    faults: Faults,
    budget: Budget,
    /// Numbers of skipped statements by kind.
    left_out: BTreeMap<&'static str, usize>,
    /// Numbers of skipped statements by keyword.
    statements: BTreeMap<&'static str, usize>,
    /// The first unknown statement.
    unknown: Option<Range<usize>>,
    known_count: usize,
}

impl<'s> Reader<'s> {
    fn statement(&mut self, keyword: Token, line: &mut Line<'s>) -> Result<(), ImportError> {
        let Some((name, statement)) = statements::find(keyword.bytes) else {
            self.skip("unknown statements");
            self.unknown.get_or_insert(keyword.span());
            return Ok(());
        };
        self.known_count += 1;
        match statement {
            Statement::Vertex => self.vertex(keyword, line),
            Statement::Normal => {
                let normal = self.numbers("vn", keyword, line);
                // Normals of length 0 are computed.
                self.normals.push(normal.unwrap_or_default().as_vec3());
            }
            Statement::TextureCoordinates => self.texture_coordinates(keyword, line),
            Statement::Face => self.face(keyword, line)?,
            Statement::Material => {
                self.material = Some(line.rest().bytes);
                if line.rest().bytes.is_empty() {
                    self.skip("`usemtl` without a name");
                }
            }
            Statement::Library => self.material_libraries(keyword, line),
            Statement::Smoothing => self.smoothing = smooth::group(line.word()),
            Statement::Object => self.name(0, line),
            Statement::Group => self.name(1, line),
            Statement::Thin => self.skip("lines and points"),
            Statement::FreeForm => self.skip("free-form statements"),
            Statement::Skipped => {
                let rest = line.rest().bytes;
                if !rest.eq_ignore_ascii_case(b"off") && rest != b"0" {
                    *self.statements.entry(name).or_default() += 1;
                }
            }
        }
        Ok(())
    }

    fn skip(&mut self, what: &'static str) {
        *self.left_out.entry(what).or_default() += 1;
    }

    fn name(&mut self, kind: usize, line: &Line<'s>) {
        let name = line.rest().bytes;
        match self.names[kind] {
            Some(known) if known != name => self.names[kind] = Some(b""),
            _ => self.names[kind] = Some(name),
        }
    }

    fn vertex(&mut self, keyword: Token, line: &mut Line) {
        let position = self.numbers("v", keyword, line);
        // Faces with it are skipped.
        self.positions.push(position.unwrap_or(DVec3::NAN));
        // A weight (which only curves use), a colour, or both.
        let mut more = [0.0; 4];
        let mut count = 0;
        while let Some(word) = line.word() {
            let Some(place) = more.get_mut(count) else {
                let what = ("v", "numbers after the seventh skipped");
                self.faults.add(what, self.source, word.span(), || {
                    (
                        "a vertex has too many numbers".to_owned(),
                        "Write `v X Y Z`",
                    )
                });
                break;
            };
            let number = self.faults.number("v", self.source, word);
            *place = number.unwrap_or(1.0);
            count += 1;
        }
        match count {
            3 | 4 => self.colors.push(self.positions.len() - 1, &more[..count]),
            1 | 2 if more[0] != 1.0 => self.skip("weights of vertices"),
            _ => {}
        }
    }

    /// Three numbers, if all of them are there and finite.
    fn numbers(&mut self, key: &'static str, keyword: Token, line: &mut Line) -> Option<DVec3> {
        let mut values = Some(DVec3::ZERO);
        for i in 0..3 {
            let Some(word) = line.word() else {
                let what = (key, "statements with fewer than three numbers skipped");
                self.faults.add(what, self.source, keyword.span(), || {
                    let why = format!("{} needs three numbers", keyword.quote());
                    (why, "Add the missing ones")
                });
                return None;
            };
            match (self.faults.number(key, self.source, word), &mut values) {
                (Some(number), Some(values)) => values[i] = number,
                _ => values = None,
            }
        }
        values
    }

    fn face(&mut self, keyword: Token, line: &mut Line) -> Result<(), ImportError> {
        let counts = [self.positions.len(), self.uvs.len(), self.normals.len()];
        let mut face = std::mem::take(&mut self.face);
        if face::read(self.source, &mut self.faults, line, counts, &mut face) {
            self.polygon(keyword, &mut face)?;
        }
        self.face = face;
        Ok(())
    }

    fn polygon(&mut self, keyword: Token, face: &mut Vec<Corner>) -> Result<(), ImportError> {
        if face.len() < 3 {
            let what = ("f", "faces with fewer than three corners skipped");
            self.faults.add(what, self.source, keyword.span(), || {
                let why = "a face has fewer than three corners".to_owned();
                (why, "Check that the file is complete")
            });
            return Ok(());
        }
        let points: Vec<DVec3> = face
            .iter()
            .map(|c| self.positions[c.position as usize])
            .collect();
        if points.iter().any(|point| point.is_nan()) {
            self.skip("faces with vertices that are not finite");
            return Ok(());
        }
        let material = self.material_in_use();
        face.iter_mut()
            .for_each(|corner| corner.material = material);
        self.complete_normals(face, polygon::normal(&points));
        let first = self.corners.len();
        if first + face.len() > face::MAX_CORNERS {
            let why = format!("more than {} face corners", face::MAX_CORNERS);
            let error =
                self.source
                    .malformed(keyword.span(), why, "Split the model into several files");
            return Err(ImportError::TooBig(error.into_fault()));
        }
        let shift = |triangle: [u32; 3]| triangle.map(|i| first as u32 + i);
        if face.len() == 3 {
            self.triangles.push(shift([0, 1, 2]));
            self.corners.append(face);
            return Ok(());
        }
        let triangles = self.cutter.triangles(&points).unwrap_or_else(|defect| {
            // Triangles without area are counted when the mesh is repaired.
            self.fan_count += usize::from(defect != Defect::NoArea);
            polygon::fan(points.len())
        });
        self.triangles.extend(triangles.into_iter().map(shift));
        self.corners.append(face);
        Ok(())
    }

    /// The memory that the file takes so far, including later steps.
    fn memory(&self) -> u64 {
        /// Bytes per corner while vertices are welded: a corner is in an order and has a vertex index; a
        /// vertex has a corner, a position, a normal, a material, and u and v. `repair` takes less.
        const WELDED: usize = 3 * size_of::<u32>() + size_of::<(Vec3, Vec3, u32, Vec2)>();
        let libraries = self
            .libraries
            .iter()
            .map(|library| library.source.bytes.len() as u64);
        self.source.bytes.len() as u64
            + libraries.sum::<u64>()
            + budget::size::<DVec3>(self.positions.len())
            + self.color_memory()
            + budget::size::<Vec3>(self.normals.len() + self.made_normals.len())
            + budget::size::<Vec2>(self.uvs.len())
            + budget::size::<(Corner, [u8; WELDED])>(self.corners.len())
            + budget::size::<[u32; 3]>(self.triangles.len())
            + budget::size::<(SmoothFace, [Vec3; 3])>(self.smooth_faces.len())
            // A name and its index are stored three times, once in a hash table with spare capacity.
            + budget::size::<(Material, [&[u8]; 6])>(self.material_names.len())
    }

    fn finish(mut self) -> Result<Model, ImportError> {
        if self.triangles.is_empty()
            && let Some(refusal) = self.faults.refusal()
        {
            return Err(refusal);
        }
        let mut materials = self.materials();
        self.whiten(&mut materials);
        let colors = self.vertex_colors(&mut materials);
        self.smooth();
        let (vertices, vertex_of_corner) = weld::weld(&self.corners);
        for corner in self.triangles.as_flattened_mut() {
            *corner = vertex_of_corner[*corner as usize];
        }
        drop(vertex_of_corner);
        let uvs = self.uvs_of(&vertices, &materials);

        let corners = &self.corners;
        let corners = || vertices.iter().map(|&vertex| corners[vertex as usize]);
        let world = corners().map(|corner| &self.positions[corner.position as usize]);
        let (positions, offset) = Mesh::from_world_positions(world);
        let normal = |corner: Corner| match corner.normal & face::MADE {
            0 => self.normals[corner.normal as usize],
            mark => self.made_normals[(corner.normal ^ mark) as usize],
        };
        let mut mesh = Mesh {
            name: self.model_name(),
            positions,
            normals: corners().map(normal).collect(),
            uvs,
            second_uvs: Vec::new(),
            tangents: Vec::new(),
            colors: self.corner_colors(&vertices, &colors),
            materials: corners().map(|corner| corner.material).collect(),
            triangles: std::mem::take(&mut self.triangles),
        };
        self.note();
        rounding::note_lost_light(&mut self.notes, &mesh, &materials);
        notes::of_repairs(&mut self.notes, mesh.repair());
        Ok(Model {
            mesh,
            offset,
            materials,
            textures: self.textures,
            notes: self.notes,
            ..Model::default()
        })
    }

    /// The name of the only object, or else of the only group, or else of the file.
    fn model_name(&self) -> String {
        let is_given = |name: &&[u8]| !matches!(*name, b"" | b"default" | b"off");
        let given = self.names.iter().flatten().copied().find(is_given);
        let stem = self.source.path.file_stem().unwrap_or_default();
        match given {
            Some(name) => String::from_utf8_lossy(name).into_owned(),
            None => stem.to_string_lossy().into_owned(),
        }
    }

    /// Notes what was skipped or changed.
    fn note(&mut self) {
        for (what, count) in std::mem::take(&mut self.left_out) {
            self.notes.add("models with skipped parts", || {
                format!("{what} skipped: {count}")
            });
        }
        if !self.statements.is_empty() {
            let named = |(name, count): (&&str, &usize)| format!("`{name}` {count}");
            let named: Vec<_> = self.statements.iter().map(named).collect();
            self.notes.add("models with skipped parts", || {
                format!("statements skipped: {}", named.join(", "))
            });
        }
        if self.fan_count > 0 {
            self.notes.add("models with faces triangulated as fans", || {
                format!(
                    "faces that intersect themselves or are too large, triangulated as fans: {}",
                    self.fan_count
                )
            });
        }
        if let Some(span) = self.unknown.take() {
            let first = quote(&self.source.bytes[span]);
            self.notes.add("unknown statements", || {
                format!("the first unknown statement is {first}")
            });
        }
        std::mem::take(&mut self.faults).note(&mut self.notes, None);
    }
}
