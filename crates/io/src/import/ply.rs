//! Stanford PLY: polygons and points, ASCII or binary.
//!
//! Vertex properties read: `x y z`, `nx ny nz`, `s t` (also `u v` or `texture_u texture_v`), `red green blue`
//! (also `diffuse_red …` or `r g b`), `radius` of points, and glimray's own `material` (a number), `s2 t2` (a second set of
//! u and v), `tx ty tz tw` (tangents) and `linear_red linear_green linear_blue linear_alpha` (colours). Face property
//! read: the list `vertex_indices` (also `vertex_index`). Others are skipped. Doubles become floats near the mesh's own
//! origin. Source: Greg Turk, The PLY Polygon File Format, 1994.

pub(super) use skipped::KEYS;

mod faces;
mod header;
mod layout;
mod points;
mod reader;
mod skipped;
mod types;

use super::budget;
use super::crease;
use super::encoding;
use super::error::ImportError;
use super::model::Model;
use super::notes::{self, Notes};
use super::number::in_range;
use super::tangent::tangent;
use super::tint::{self, Rgb};
use super::{Axis, Options, levels, uvs};
use glam::{DAffine3, DMat3, DVec3, Vec2, Vec3};
use glimray_scene::{Material, Mesh, Scene, Shape};
use layout::Layout;
use reader::Reader;
use std::path::Path;
use types::{Element, Kind};

/// The vertex properties that hold the axes of a copy's transform.
const AXES: [&str; 9] = ["xx", "xy", "xz", "yx", "yy", "yz", "zx", "zy", "zz"];

const AGAIN: &str = "Save the file again";

/// Faces of a model without normals are smooth where they meet at less than this angle, in radians.
const CREASE: f64 = std::f64::consts::FRAC_PI_3;

/// Purpose of reading a file.
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
    /// Colour of each vertex in sRGB, from 0 to 1, or empty.
    colors: Vec<Vec3>,
    radii: Vec<f32>,
    /// Number of faces of fewer than three corners.
    short_faces: usize,
    /// Number of faces that could only be triangulated as fans.
    fans: usize,
    /// Whether the position of a vertex cannot be used, for each up to the last such vertex of a mesh.
    lost: Vec<bool>,
    /// Number of points without a position.
    lost_points: usize,
    /// Number of corners of faces at vertices that do not exist.
    absent_corners: usize,
    /// Number of radii that are not finite.
    lost_radii: usize,
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
    let mut content = read(path, bytes, Purpose::Mesh(material_count))?;
    if !content.lost.is_empty() {
        drop_unused(&mut content.mesh);
    }
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
        let mut colors = std::mem::take(&mut content.colors);
        levels::normalize(&mut colors, &mut notes);
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
    let bytes = encoding::without_mark(bytes);
    let mut reader = Reader::new(path, &bytes)?;
    let elements = reader.elements()?;
    let mut content = Content::default();
    let is_face = |element: &Element| matches!(element.name.as_str(), "face" | "tristrips");
    let is_cloud = !elements
        .iter()
        .any(|element| is_face(element) && element.count > 0);
    let mut has_vertices = false;
    for element in &elements {
        if reader.is_cut.get() {
            break;
        }
        match element.name.as_str() {
            "vertex" => {
                has_vertices = true;
                vertices(&mut reader, element, &mut content, purpose, is_cloud)?;
            }
            "face" => faces::polygons(&mut reader, element, &mut content)?,
            "tristrips" => faces::strips(&mut reader, element, &mut content)?,
            _ => match reader.pass_over(element) {
                Err(_) if reader.is_cut.get() && has_vertices => break,
                result => result?,
            },
        }
    }
    if !has_vertices {
        return Err(reader.refuse("it has no vertices", "Save the mesh again"));
    }
    let is_empty = match is_cloud {
        true => content.mesh.positions.is_empty(),
        false => content.mesh.triangles.is_empty(),
    };
    if is_empty && let Some(fault) = reader.fault.take() {
        return Err(fault);
    }
    if reader.is_cut.get() {
        if is_empty {
            return Err(reader.cut());
        }
        content.notes.add("ends", || {
            "the file is shorter than its header announces: the rest is missing".to_owned()
        });
    }
    if let Purpose::Model = purpose {
        skipped::note(&reader, &elements, &mut content.notes);
    }
    Ok(content)
}

/// The transforms of copies at the vertices in `bytes`, the contents of the file at `path`.
pub(super) fn places(path: &Path, bytes: &[u8]) -> Result<Vec<DAffine3>, ImportError> {
    let bytes = encoding::without_mark(bytes);
    let mut reader = Reader::new(path, &bytes)?;
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
    // A colour has 8 or 16 bits, or is a fraction of 1.
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
        lost,
        lost_points,
        lost_uvs,
        lost_radii,
        ..
    } = content;
    let mut fault = None;
    mesh.positions
        .reserve_exact(if is_double { 0 } else { element.count });
    mesh.materials.reserve_exact(element.count);
    reader.rows(element, &layout.columns, |reader, row| {
        let three = |at: usize| DVec3::new(row[at], row[at + 1], row[at + 2]);
        let mut place = three(0);
        if let Some(&number) = row[..3].iter().find(|&&number| !in_range(number)) {
            fault.get_or_insert_with(|| reader.not_finite(number));
            if is_cloud && is_model {
                *lost_points += 1;
                return Ok(());
            }
            // Faces with it are skipped, and then it is dropped.
            place = DVec3::ZERO;
            lost.resize(mesh.materials.len(), false);
            lost.push(true);
        }
        match is_double {
            true => places.push(place),
            false => mesh.positions.push(place.as_vec3()),
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
            let is_usable = in_range(row[at]);
            *lost_radii += usize::from(!is_usable);
            radii.push(if is_usable { row[at] as f32 } else { 0.0 });
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
    if reader.fault.is_none() {
        reader.fault = fault;
    }
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
    fn vertex_count(&self) -> usize {
        self.mesh.positions.len()
    }
}
