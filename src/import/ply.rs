//! Stanford PLY: polygons and points, ASCII or binary.
//!
//! Vertex properties read: `x y z`, `nx ny nz`, `s t` (also `u v` or `texture_u texture_v`), `red green blue`
//! (also `diffuse_red …` or `r g b`), `radius` of points, and glimray's own `material` (a number), `s2 t2` (a second set of
//! u and v), `tx ty tz tw` (tangents) and `linear_red linear_green linear_blue linear_alpha` (colours). Face property read: the list `vertex_indices` (also `vertex_index`). Others are skipped. Doubles become floats
//! near the mesh's own origin. Source: Greg Turk, The PLY Polygon File Format, 1994.

mod faces;
mod header;
mod layout;
mod points;
mod reader;
mod types;

use super::budget;
use super::crease;
use super::error::ImportError;
use super::model::Model;
use super::notes::{self, Notes};
use super::number::in_range;
use super::tangent::tangent;
use super::tint::{self, Rgb};
use super::{Axis, Options, uvs};
use crate::scene::{Material, Mesh, Scene, Shape};
use glam::{DAffine3, DMat3, DVec3, Vec2, Vec3};
use layout::{COLORS, LINEAR_COLORS, Layout};
use reader::Reader;
use std::path::Path;
use types::{Element, Kind};

/// The vertex properties that hold the axes of a copy's transform.
const AXES: [&str; 9] = ["xx", "xy", "xz", "yx", "yy", "yz", "zx", "zy", "zz"];

const AGAIN: &str = "Save the file again";

/// Faces of a model without normals are smooth where they meet at less than this angle, in radians.
const CREASE: f64 = std::f64::consts::FRAC_PI_3;

/// What a file is read for.
#[derive(Clone, Copy)]
enum Purpose {
    /// A mesh of a native scene, whose material numbers are below this one.
    Mesh(usize),
    /// A scene of its own.
    Model,
}

/// The contents of a file.
#[derive(Default)]
struct Content {
    mesh: Mesh,
    /// World from mesh: the translation to the position in the file.
    offset: DVec3,
    /// Of each vertex in sRGB, from 0 to 1, or empty.
    colors: Vec<Vec3>,
    radii: Vec<f32>,
    /// Number of faces of fewer than three corners.
    short_faces: usize,
    /// Number of faces that could only be triangulated as fans.
    fans: usize,
    /// Number of points without a position.
    lost_points: usize,
    /// Number of texture coordinates that are not numbers.
    lost_uvs: usize,
    notes: Notes,
}

/// The triangles in `bytes`, the contents of the file at `path`, not yet repaired, and the translation of
/// their origin. Material numbers are below `material_count`. Adds notes about faces to `notes`.
pub(super) fn mesh(
    path: &Path,
    bytes: &[u8],
    material_count: usize,
    notes: &mut Notes,
) -> Result<(Mesh, DVec3), ImportError> {
    let content = read(path, bytes, Purpose::Mesh(material_count))?;
    content.note(notes);
    Ok((content.mesh, content.offset))
}

/// The scene in `bytes`, the contents of the file at `path`: a mesh, or a cloud of points.
pub(super) fn read_scene(
    path: &Path,
    bytes: &[u8],
    options: &Options,
) -> Result<Scene, ImportError> {
    let mut content = read(path, bytes, Purpose::Model)?;
    let mut notes = std::mem::take(&mut content.notes);
    content.note(&mut notes);
    let mut materials = vec![Material::default()];
    if !content.colors.is_empty() {
        materials = vec![tint::white()];
        let colors = std::mem::take(&mut content.colors);
        if content.mesh.triangles.is_empty() {
            let bits;
            let colors: Vec<Option<Rgb>> = colors.into_iter().map(tint::rgb).map(Some).collect();
            let ids = &mut content.mesh.materials;
            (materials, bits) = tint::tint(&materials, ids, &colors);
            if bits < 8 {
                notes.add("colours", || {
                    format!(
                        "colours of points reduced to {bits} bits a channel: there are too many"
                    )
                });
            }
        } else {
            content.mesh.colors = colors.into_iter().map(tint::linear).collect();
        }
    } else if !content.mesh.colors.is_empty() {
        materials = vec![tint::white()];
    }
    let points: Vec<Shape>;
    if content.mesh.triangles.is_empty() {
        points = points::spheres(&content, &content.mesh.materials, &mut notes);
        content.mesh = Mesh::default();
    } else {
        points = Vec::new();
        let mesh = &mut content.mesh;
        drop_unused(mesh);
        if mesh.normals.is_empty() {
            crease::sharpen(mesh, CREASE);
        }
        mesh.name = (path.file_stem().unwrap_or_default())
            .to_string_lossy()
            .into_owned();
        notes::of_repairs(&mut notes, mesh.repair());
    }
    let model = Model {
        mesh: content.mesh,
        offset: content.offset,
        points,
        materials,
        notes,
        ..Model::default()
    };
    Ok(model.into_scene(Vec::new(), Axis::Y, options))
}

fn read(path: &Path, bytes: &[u8], purpose: Purpose) -> Result<Content, ImportError> {
    let mut reader = Reader::new(path, bytes)?;
    let elements = reader.elements()?;
    let mut content = Content::default();
    let is_face = |element: &Element| matches!(element.name.as_str(), "face" | "tristrips");
    let is_cloud = !elements
        .iter()
        .any(|element| is_face(element) && element.count > 0);
    let mut has_vertices = false;
    for element in &elements {
        match element.name.as_str() {
            "vertex" => {
                has_vertices = true;
                vertices(&mut reader, element, &mut content, purpose, is_cloud)?;
            }
            "face" => faces::polygons(&mut reader, element, &mut content)?,
            "tristrips" => faces::strips(&mut reader, element, &mut content)?,
            _ => reader.pass_over(element)?,
        }
    }
    if !has_vertices {
        return Err(reader.refuse("it has no vertices", "Save the mesh again"));
    }
    if let Purpose::Model = purpose {
        note_skipped(&reader, &elements, &mut content.notes);
    }
    Ok(content)
}

/// The transforms of copies at the vertices in `bytes`, the contents of the file at `path`.
pub(super) fn places(path: &Path, bytes: &[u8]) -> Result<Vec<DAffine3>, ImportError> {
    let mut reader = Reader::new(path, bytes)?;
    for element in reader.elements()? {
        if element.name != "vertex" {
            reader.pass_over(&element)?;
            continue;
        }
        let place = reader.columns(&element, &["x", "y", "z"])?;
        let mut columns =
            place.ok_or_else(|| reader.refuse("its vertices lack x, y or z", AGAIN))?;
        columns.extend(reader.columns(&element, &AXES)?.unwrap_or_default());
        reader.reserve(budget::size::<DAffine3>(element.count))?;
        let mut places = Vec::with_capacity(element.count);
        reader.rows(&element, &columns, |reader, row| {
            if let Some(&number) = row.iter().find(|&&number| !in_range(number)) {
                return Err(reader.not_finite(number));
            }
            let column = |i: usize| DVec3::new(row[i], row[i + 1], row[i + 2]);
            let matrix = match row.len() {
                3 => DMat3::IDENTITY,
                _ => DMat3::from_cols(column(3), column(6), column(9)),
            };
            places.push(DAffine3::from_mat3_translation(matrix, column(0)));
            Ok(())
        })?;
        return Ok(places);
    }
    Err(reader.refuse("it has no vertices", AGAIN))
}

fn vertices(
    reader: &mut Reader,
    element: &Element,
    content: &mut Content,
    purpose: Purpose,
    is_cloud: bool,
) -> Result<(), ImportError> {
    let layout = Layout::of(reader, element, purpose)?;
    let kind = |column: usize| element.properties[layout.columns[column]].kind;
    let is_double = (0..3).any(|i| kind(i) == Kind::Double);
    let is_model = matches!(purpose, Purpose::Model);
    reader.reserve(layout.memory(element.count, is_double, is_cloud && is_model))?;
    // Of 8 bits, or of 16 or a fraction of 1.
    let most_color = match layout.color.map(kind) {
        Some(Kind::Float | Kind::Double) => 1.0,
        Some(Kind::U16) => 65535.0,
        _ => 255.0,
    };
    let mut places = Vec::with_capacity(if is_double { element.count } else { 0 });
    let Content {
        mesh,
        colors,
        radii,
        lost_points,
        lost_uvs,
        ..
    } = content;
    mesh.positions
        .reserve_exact(if is_double { 0 } else { element.count });
    mesh.materials.reserve_exact(element.count);
    reader.rows(element, &layout.columns, |reader, row| {
        let three = |at: usize| DVec3::new(row[at], row[at + 1], row[at + 2]);
        if let Some(&number) = row[..3].iter().find(|&&number| !in_range(number)) {
            if is_cloud && is_model {
                *lost_points += 1;
                return Ok(());
            }
            return Err(reader.not_finite(number));
        }
        match is_double {
            true => places.push(three(0)),
            false => mesh.positions.push(three(0).as_vec3()),
        }
        if let Some(at) = layout.normal {
            mesh.normals.push(three(at).as_vec3());
        }
        let uvs = [
            (layout.uv, &mut mesh.uvs),
            (layout.second_uv, &mut mesh.second_uvs),
        ];
        for (at, uvs) in uvs {
            if let Some(at) = at {
                let mut place = |x: f64| uvs::in_range(x, lost_uvs) as f32;
                uvs.push(Vec2::new(place(row[at]), place(row[at + 1])));
            }
        }
        if let Some(at) = layout.tangent {
            let numbers = [row[at], row[at + 1], row[at + 2], row[at + 3]];
            mesh.tangents.push(tangent(numbers));
        }
        if let Some(at) = layout.linear_color {
            let color = three(at).extend(row[at + 3]);
            mesh.colors.push(color.as_vec4());
        }
        if let Some(at) = layout.color {
            colors.push((three(at) / most_color).as_vec3());
        }
        if let Some(at) = layout.radius {
            radii.push(if in_range(row[at]) {
                row[at] as f32
            } else {
                0.0
            });
        }
        let number = layout.material.map_or(0.0, |at| row[at]);
        if let Purpose::Mesh(count) = purpose
            && (!(0.0..count as f64).contains(&number) || number.fract() != 0.0)
        {
            let why = format!("a vertex has material {number}, but only {count} exist");
            let todo = "List more `materials` in the mesh's table, or repair the file";
            return Err(reader.refuse(&why, todo));
        }
        mesh.materials.push(number as u32);
        Ok(())
    })?;
    if is_double {
        (mesh.positions, content.offset) = Mesh::from_world_positions(&places);
    }
    Ok(())
}

/// Drops vertices that no triangle uses: a model is framed by its vertices.
fn drop_unused(mesh: &mut Mesh) {
    const UNUSED: u32 = u32::MAX;
    let mut moved = vec![UNUSED; mesh.positions.len()];
    for &vertex in mesh.triangles.as_flattened() {
        moved[vertex as usize] = 0;
    }
    if !moved.contains(&UNUSED) {
        return;
    }
    fn keep<T>(values: &mut Vec<T>, moved: &[u32]) {
        let mut next = moved.iter();
        values.retain(|_| next.next() != Some(&UNUSED));
    }
    keep(&mut mesh.positions, &moved);
    keep(&mut mesh.normals, &moved);
    keep(&mut mesh.uvs, &moved);
    keep(&mut mesh.second_uvs, &moved);
    keep(&mut mesh.tangents, &moved);
    keep(&mut mesh.colors, &moved);
    keep(&mut mesh.materials, &moved);
    let used = moved.iter_mut().filter(|index| **index != UNUSED);
    used.zip(0..).for_each(|(index, new)| *index = new);
    for vertex in mesh.triangles.as_flattened_mut() {
        *vertex = moved[*vertex as usize];
    }
}

impl Content {
    /// Notes the faces and points that were skipped or changed.
    fn note(&self, notes: &mut Notes) {
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
        uvs::note(self.lost_uvs, notes);
    }
}

/// Notes what is not read.
fn note_skipped(reader: &Reader, elements: &[Element], notes: &mut Notes) {
    const READ: &str = "x y z nx ny nz s t u v texture_u texture_v s2 t2 radius";
    for element in elements.iter().filter(|element| element.count > 0) {
        let is_read = |name: &str| match element.name.as_str() {
            "vertex" => {
                let mut known =
                    (READ.split(' ').chain(LINEAR_COLORS)).chain(COLORS.into_iter().flatten());
                known.any(|known| known == name)
            }
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
        let name = super::source::quote(name.as_bytes());
        notes.add("skipped textures", || format!("texture skipped: {name}"));
    }
}
