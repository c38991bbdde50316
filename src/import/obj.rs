//! Wavefront OBJ with MTL: polygons, normals, and the Phong part of materials.
//!
//! All groups of a file become one [`Mesh`]. Polygons, including concave ones, are triangulated. Faces
//! without normals are flat unless they are in a smoothing group; see `smooth.rs`. Lines, points and
//! curves are skipped and reported. Vertices keep u and v only if a material uses them, because they
//! would split vertices that are otherwise equal.

mod face;
mod lines;
mod materials;
mod mtl;
mod smooth;
mod surface;
mod uv;
mod weld;

use super::budget::{self, Budget};
use super::error::ImportError;
use super::model::Model;
use super::notes::{self, Notes};
use super::paths::Files;
use super::picture::Pictures;
use super::polygon::{self, Cutter, Defect};
use super::source::{Source, Token, quote};
use super::{Axis, Options, number};
use crate::scene::{Material, Mesh, Scene, Texture};
use face::Corner;
use glam::{DVec3, Vec2, Vec3};
use lines::{Line, Lines};
use smooth::SmoothFace;
use std::collections::{BTreeMap, HashMap};
use std::ops::Range;
use std::path::Path;

/// Statements of the format that do not affect triangles.
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
        colors: Vec::new(),
        normals: Vec::new(),
        uvs: Vec::new(),
        made_normals: Vec::new(),
        smooth_faces: Vec::new(),
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
        notes: Notes::default(),
        budget: Budget::of(source.bytes.len()),
        left_out: BTreeMap::new(),
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
    /// Colours of vertices; empty if there are none, and may be shorter than `positions`.
    /// Of vertices in sRGB, from 0 to 1, white where the file gives none; empty if it gives none at all.
    colors: Vec<Vec3>,
    normals: Vec<Vec3>,
    uvs: Vec<Vec2>,
    /// Normals that are computed, not from the file.
    made_normals: Vec<Vec3>,
    smooth_faces: Vec<SmoothFace>,
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
    libraries: Vec<Source>,
    textures: Vec<Texture>,
    notes: Notes,
    budget: Budget,
    /// Numbers of skipped statements by kind.
    left_out: BTreeMap<&'static str, usize>,
    /// The first unknown statement.
    unknown: Option<Range<usize>>,
    known_count: usize,
}

impl<'s> Reader<'s> {
    fn statement(&mut self, keyword: Token, line: &mut Line<'s>) -> Result<(), ImportError> {
        self.known_count += 1;
        match keyword.bytes {
            b"v" => self.vertex(keyword, line)?,
            b"vn" => {
                let normal = self.numbers(keyword, line)?;
                self.normals.push(normal.as_vec3());
            }
            b"vt" => self.texture_coordinates(keyword, line)?,
            b"f" | b"fo" => self.face(keyword, line)?,
            b"usemtl" => self.material = Some(line.rest().bytes),
            b"mtllib" => self.material_library(line)?,
            b"s" => self.smoothing = smooth::group(line.word()),
            b"l" | b"p" => self.skip("lines and points"),
            b"curv" | b"curv2" | b"surf" | b"cstype" | b"deg" | b"bmat" | b"step" | b"parm"
            | b"trim" | b"hole" | b"scrv" | b"sp" | b"con" => self.skip("free-form statements"),
            word if IGNORED.contains(&word) => {}
            word if word.iter().all(|b| b.is_ascii_alphanumeric() || *b == b'_') => {
                self.known_count -= 1;
                self.skip("unknown statements");
                self.unknown.get_or_insert(keyword.span());
            }
            _ => {
                let why = format!("{} is not an OBJ statement", keyword.quote());
                let todo = "Check that this is a Wavefront OBJ file";
                return Err(self.source.malformed(keyword.span(), why, todo));
            }
        }
        Ok(())
    }

    fn skip(&mut self, what: &'static str) {
        *self.left_out.entry(what).or_default() += 1;
    }

    fn vertex(&mut self, keyword: Token, line: &mut Line) -> Result<(), ImportError> {
        let position = self.numbers(keyword, line)?;
        self.positions.push(position);
        // A weight (which only curves use), a colour, or both.
        let mut more = [0.0; 4];
        let mut count = 0;
        while let Some(word) = line.word() {
            let number = number::parse(self.source, word)?;
            let Some(place) = more.get_mut(count) else {
                let why = "a vertex has too many numbers".to_owned();
                return Err(self.source.malformed(word.span(), why, "Write `v X Y Z`"));
            };
            *place = number;
            count += 1;
        }
        if count >= 3 {
            let color = DVec3::new(more[count - 3], more[count - 2], more[count - 1]);
            self.colors.resize(self.positions.len() - 1, Vec3::ONE);
            self.colors.push(color.as_vec3());
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
        let mut face = face::read(self.source, keyword, line, counts)?;
        if face.len() < 3 {
            self.skip("faces with fewer than three corners");
            return Ok(());
        }
        let material = self.material_in_use();
        face.iter_mut()
            .for_each(|corner| corner.material = material);
        let points: Vec<DVec3> = face
            .iter()
            .map(|c| self.positions[c.position as usize])
            .collect();
        self.complete_normals(&mut face, polygon::normal(&points));
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
            self.corners.append(&mut face);
            return Ok(());
        }
        let triangles = self.cutter.triangles(&points).unwrap_or_else(|defect| {
            // Triangles without area are counted when the mesh is repaired.
            self.fan_count += usize::from(defect != Defect::NoArea);
            polygon::fan(points.len())
        });
        self.triangles.extend(triangles.into_iter().map(shift));
        self.corners.append(&mut face);
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
            .map(|library| library.bytes.len() as u64);
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
        let mut materials = self.materials()?;
        self.whiten(&mut materials);
        self.drop_unwanted_uvs(&materials);
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
        let name = self.source.path.file_stem().unwrap_or_default();
        let mut mesh = Mesh {
            name: name.to_string_lossy().into_owned(),
            positions,
            normals: corners().map(normal).collect(),
            uvs,
            second_uvs: Vec::new(),
            tangents: Vec::new(),
            colors: self.vertex_colors(&vertices),
            materials: corners().map(|corner| corner.material).collect(),
            triangles: self.triangles,
        };
        for (what, count) in self.left_out {
            self.notes.add("models with skipped parts", || {
                format!("{what} skipped: {count}")
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
        if let Some(span) = self.unknown {
            let first = quote(&self.source.bytes[span]);
            self.notes.add("unknown statements", || {
                format!("the first unknown statement is {first}")
            });
        }
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
}
