//! Stanford PLY: triangles and points, ASCII or binary.
//!
//! Vertex properties read: `x y z`, `nx ny nz`, `s t` (also `u v` or `texture_u texture_v`), and
//! glimray's own material number `material`. Face property read: the list `vertex_indices` (also
//! `vertex_index`). Others are skipped. Doubles become floats near the mesh's own origin.

use super::budget::{self, Budget};
use super::error::{ImportError, fault};
use super::number::in_range;
use super::source::quote;
use crate::scene::Mesh;
use glam::{DAffine3, DMat3, DVec3, Vec2, Vec3};
use std::path::Path;

/// Size limit of the header in bytes.
const MAX_HEADER: usize = 64 << 10;

/// The vertex properties that hold the axes of a copy's transform.
const AXES: [&str; 9] = ["xx", "xy", "xz", "yx", "yy", "yz", "zx", "zy", "zz"];

/// The triangles in `bytes`, the contents of the file at `path`, not yet repaired, and the translation of
/// their origin. Material numbers are below `material_count`.
pub(super) fn mesh(
    path: &Path,
    bytes: &[u8],
    material_count: usize,
) -> Result<(Mesh, DVec3), ImportError> {
    let mut reader = Reader::new(path, bytes)?;
    let mut mesh = Mesh::default();
    let mut offset = None;
    for element in reader.elements()? {
        match element.name.as_str() {
            "vertex" => {
                offset = Some(vertices(&mut reader, &element, &mut mesh, material_count)?);
            }
            "face" => faces(&mut reader, &element, &mut mesh)?,
            _ => reader.pass_over(&element)?,
        }
    }
    match offset {
        Some(offset) => Ok((mesh, offset)),
        None => Err(reader.refuse("it has no vertices", "Save the mesh again")),
    }
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
        let place = place.ok_or_else(|| reader.refuse("its vertices lack x, y or z", AGAIN))?;
        let axes = reader.columns(&element, &AXES)?;
        reader.reserve(budget::size::<DAffine3>(element.count))?;
        let mut places = Vec::with_capacity(element.count);
        let mut row = Vec::new();
        for _ in 0..element.count {
            reader.row(&element, &mut row)?;
            let translation = DVec3::new(row[place[0]], row[place[1]], row[place[2]]);
            let matrix = match &axes {
                Some(axes) => {
                    let column =
                        |i: usize| DVec3::new(row[axes[i]], row[axes[i + 1]], row[axes[i + 2]]);
                    DMat3::from_cols(column(0), column(3), column(6))
                }
                None => DMat3::IDENTITY,
            };
            places.push(DAffine3::from_mat3_translation(matrix, translation));
        }
        return Ok(places);
    }
    Err(reader.refuse("it has no vertices", AGAIN))
}

const AGAIN: &str = "Save the file again";

fn vertices(
    reader: &mut Reader,
    element: &Element,
    mesh: &mut Mesh,
    material_count: usize,
) -> Result<DVec3, ImportError> {
    let place = reader.columns(element, &["x", "y", "z"])?;
    let place = place.ok_or_else(|| reader.refuse("its vertices lack x, y or z", AGAIN))?;
    let normal = reader.columns(element, &["nx", "ny", "nz"])?;
    let mut uv = None;
    for names in [["s", "t"], ["u", "v"], ["texture_u", "texture_v"]] {
        uv = uv.or(reader.columns(element, &names)?);
    }
    let material = reader.columns(element, &["material"])?;
    let is_double = place
        .iter()
        .any(|&i| element.properties[i].kind == Kind::Double);
    // A position, a normal, its accumulator, and a material; see `Mesh::repair`.
    let mut needed = budget::size::<(Vec3, Vec3, u32)>(element.count);
    if normal.is_none() {
        needed += budget::size::<Option<DVec3>>(element.count);
    }
    needed += budget::size::<Vec2>(if uv.is_some() { element.count } else { 0 });
    needed += budget::size::<DVec3>(if is_double { element.count } else { 0 });
    reader.reserve(needed)?;
    let mut places = Vec::with_capacity(if is_double { element.count } else { 0 });
    let mut row = Vec::new();
    for _ in 0..element.count {
        reader.row(element, &mut row)?;
        let three = |at: &[usize]| DVec3::new(row[at[0]], row[at[1]], row[at[2]]);
        match is_double {
            true => places.push(three(&place)),
            false => mesh.positions.push(three(&place).as_vec3()),
        }
        if let Some(normal) = &normal {
            mesh.normals.push(three(normal).as_vec3());
        }
        if let Some(uv) = &uv {
            let place = |x: f64| x.clamp(-1e9, 1e9) as f32;
            mesh.uvs
                .push(Vec2::new(place(row[uv[0]]), place(row[uv[1]])));
        }
        let number = material.as_ref().map_or(0.0, |at| row[at[0]]);
        if !(0.0..material_count as f64).contains(&number) || number.fract() != 0.0 {
            let why = format!("a vertex has material {number}, but only {material_count} exist");
            let todo = "List more `materials` in the mesh's table, or repair the file";
            return Err(reader.refuse(&why, todo));
        }
        mesh.materials.push(number as u32);
    }
    if !is_double {
        return Ok(DVec3::ZERO);
    }
    let offset;
    (mesh.positions, offset) = Mesh::from_world_positions(&places);
    Ok(offset)
}

fn faces(reader: &mut Reader, element: &Element, mesh: &mut Mesh) -> Result<(), ImportError> {
    let names = ["vertex_indices", "vertex_index"];
    let is_wanted = |property: &Property| names.contains(&property.name.as_str());
    let at = element.properties.iter().position(is_wanted);
    let at = at.filter(|&at| element.properties[at].count.is_some());
    let at = at.ok_or_else(|| reader.refuse("its faces have no list `vertex_indices`", AGAIN))?;
    reader.reserve(budget::size::<[u32; 3]>(element.count))?;
    for _ in 0..element.count {
        for (i, property) in element.properties.iter().enumerate() {
            let count = reader.length(property)?;
            if i != at {
                for _ in 0..count {
                    reader.number(property.kind)?;
                }
                continue;
            }
            if count != 3 {
                let why = format!("a face has {count} corners, but only triangles are supported");
                return Err(reader.refuse(&why, "Triangulate the mesh, or save it as OBJ"));
            }
            let mut corners = [0; 3];
            for corner in &mut corners {
                let index = reader.number(property.kind)?;
                if !(0.0..mesh.positions.len() as f64).contains(&index) {
                    let count = mesh.positions.len();
                    let why = format!("a face has vertex {index}, but only {count} exist");
                    return Err(reader.refuse(&why, AGAIN));
                }
                *corner = index as u32;
            }
            mesh.triangles.push(corners);
        }
    }
    Ok(())
}

/// The type of a number.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Kind {
    I8,
    U8,
    I16,
    U16,
    I32,
    U32,
    Float,
    Double,
}

impl Kind {
    fn named(name: &str) -> Option<Self> {
        Some(match name {
            "char" | "int8" => Self::I8,
            "uchar" | "uint8" => Self::U8,
            "short" | "int16" => Self::I16,
            "ushort" | "uint16" => Self::U16,
            "int" | "int32" => Self::I32,
            "uint" | "uint32" => Self::U32,
            "float" | "float32" => Self::Float,
            "double" | "float64" => Self::Double,
            _ => return None,
        })
    }

    fn size(self) -> usize {
        match self {
            Self::I8 | Self::U8 => 1,
            Self::I16 | Self::U16 => 2,
            Self::I32 | Self::U32 | Self::Float => 4,
            Self::Double => 8,
        }
    }
}

struct Property {
    name: String,
    /// The type of the length for a list.
    count: Option<Kind>,
    kind: Kind,
}

struct Element {
    name: String,
    count: usize,
    properties: Vec<Property>,
}

#[derive(Clone, Copy, PartialEq, Eq)]
enum Encoding {
    Text,
    Little,
    Big,
}

/// Reads numbers one after the other.
struct Reader<'a> {
    path: &'a Path,
    bytes: &'a [u8],
    at: usize,
    encoding: Encoding,
    /// Memory in bytes that the file takes.
    taken: u64,
}

impl<'a> Reader<'a> {
    fn new(path: &'a Path, bytes: &'a [u8]) -> Result<Self, ImportError> {
        let reader = Self {
            path,
            bytes,
            at: 0,
            encoding: Encoding::Text,
            taken: bytes.len() as u64,
        };
        match bytes.starts_with(b"ply") {
            true => Ok(reader),
            false => Err(reader.refuse("it does not begin with `ply`", "Name a PLY file")),
        }
    }

    fn refuse(&self, why: &str, todo: &str) -> ImportError {
        ImportError::Malformed(fault("bad mesh", self.path, why, todo))
    }

    /// Reserves memory from the budget, before it is allocated.
    fn reserve(&mut self, bytes: u64) -> Result<(), ImportError> {
        self.taken = self.taken.saturating_add(bytes);
        Budget::of(self.bytes.len()).check(self.taken, |why, todo| self.refuse(&why, todo))
    }

    fn cut(&self) -> ImportError {
        let todo = "Check that it was written completely";
        self.refuse("it is shorter than its header announces", todo)
    }

    /// Parses the header.
    fn elements(&mut self) -> Result<Vec<Element>, ImportError> {
        let mut elements: Vec<Element> = Vec::new();
        let mut number = 0;
        loop {
            let rest = &self.bytes[self.at..self.bytes.len().min(MAX_HEADER)];
            let Some(end) = rest.iter().position(|&b| b == b'\n') else {
                return Err(self.refuse("its header does not end with `end_header`", AGAIN));
            };
            self.at += end + 1;
            number += 1;
            let line = String::from_utf8_lossy(&rest[..end]);
            let words: Vec<&str> = line.split_ascii_whitespace().collect();
            let bad = |reader: &Self| {
                let quoted = quote(line.trim_end().as_bytes());
                reader.refuse(&format!("line {number} of its header is {quoted}"), AGAIN)
            };
            match words[..] {
                ["ply"] if number == 1 => {}
                ["format", encoding, _] => {
                    self.encoding = match encoding {
                        "ascii" => Encoding::Text,
                        "binary_little_endian" => Encoding::Little,
                        "binary_big_endian" => Encoding::Big,
                        _ => return Err(bad(self)),
                    }
                }
                [] | ["comment" | "obj_info", ..] => {}
                ["element", name, count] => elements.push(Element {
                    name: name.to_owned(),
                    count: count.parse().map_err(|_| bad(self))?,
                    properties: Vec::new(),
                }),
                ["property", "list", count, kind, name] => {
                    let element = elements.last_mut().ok_or_else(|| bad(self))?;
                    element.properties.push(Property {
                        name: name.to_owned(),
                        count: Some(Kind::named(count).ok_or_else(|| bad(self))?),
                        kind: Kind::named(kind).ok_or_else(|| bad(self))?,
                    });
                }
                ["property", kind, name] => {
                    let element = elements.last_mut().ok_or_else(|| bad(self))?;
                    element.properties.push(Property {
                        name: name.to_owned(),
                        count: None,
                        kind: Kind::named(kind).ok_or_else(|| bad(self))?,
                    });
                }
                ["end_header"] => break,
                _ => return Err(bad(self)),
            }
        }
        self.check(&elements)?;
        Ok(elements)
    }

    /// Refuses headers that announce more data than the file has, before memory is allocated.
    fn check(&self, elements: &[Element]) -> Result<(), ImportError> {
        let left = (self.bytes.len() - self.at) as u128;
        let least = |property: &Property| match self.encoding {
            Encoding::Text => 2,
            _ => property.count.unwrap_or(property.kind).size() as u128,
        };
        let size = |element: &Element| {
            let row: u128 = element.properties.iter().map(least).sum();
            row.max(1) * element.count as u128
        };
        // The last line of a text file may lack its line break.
        match elements.iter().map(size).sum::<u128>() > left + 1 {
            true => Err(self.cut()),
            false => Ok(()),
        }
    }

    /// The columns of properties, if the element has all of them; lists are refused.
    fn columns(
        &self,
        element: &Element,
        names: &[&str],
    ) -> Result<Option<Vec<usize>>, ImportError> {
        let column = |name: &&str| element.properties.iter().position(|p| p.name == *name);
        let columns: Option<Vec<_>> = names.iter().map(column).collect();
        let lists = columns.iter().flatten();
        let mut lists = lists.filter(|&&i| element.properties[i].count.is_some());
        match lists.next() {
            Some(_) => Err(self.refuse(&format!("`{}` is a list", names[0]), AGAIN)),
            None => Ok(columns),
        }
    }

    /// The numbers of one row; a list gives 0.
    fn row(&mut self, element: &Element, row: &mut Vec<f64>) -> Result<(), ImportError> {
        row.clear();
        for property in &element.properties {
            if property.count.is_none() {
                row.push(self.number(property.kind)?);
                continue;
            }
            for _ in 0..self.length(property)? {
                self.number(property.kind)?;
            }
            row.push(0.0);
        }
        Ok(())
    }

    fn pass_over(&mut self, element: &Element) -> Result<(), ImportError> {
        let mut row = Vec::new();
        (0..element.count).try_for_each(|_| self.row(element, &mut row))
    }

    /// The number of values of a property.
    fn length(&mut self, property: &Property) -> Result<usize, ImportError> {
        let Some(kind) = property.count else {
            return Ok(1);
        };
        match self.number(kind)? {
            length if length >= 0.0 => Ok(length as usize),
            _ => Err(self.refuse("a list has a negative length", AGAIN)),
        }
    }

    fn number(&mut self, kind: Kind) -> Result<f64, ImportError> {
        let number = match self.encoding {
            Encoding::Text => self.word()?,
            _ => self.binary(kind)?,
        };
        match in_range(number) {
            true => Ok(number),
            false => {
                let why = format!("{number} is not a finite number of at most 3.4e38");
                Err(self.refuse(&why, "Repair the mesh"))
            }
        }
    }

    fn word(&mut self) -> Result<f64, ImportError> {
        let is_space = |b: &u8| b.is_ascii_whitespace();
        let rest = &self.bytes[self.at..];
        let start = rest.iter().position(|b| !is_space(b));
        let start = start.ok_or_else(|| self.cut())?;
        let length = rest[start..].iter().position(is_space);
        let word = &rest[start..length.map_or(rest.len(), |length| start + length)];
        self.at += start + word.len();
        let number = std::str::from_utf8(word)
            .ok()
            .and_then(|word| word.parse().ok());
        number.ok_or_else(|| self.refuse(&format!("{} is not a number", quote(word)), AGAIN))
    }

    fn binary(&mut self, kind: Kind) -> Result<f64, ImportError> {
        let size = kind.size();
        let bytes = self.bytes.get(self.at..self.at + size);
        let bytes = bytes.ok_or_else(|| self.cut())?;
        self.at += size;
        let mut bits = [0; 8];
        for (i, &byte) in bytes.iter().enumerate() {
            let at = if self.encoding == Encoding::Little {
                i
            } else {
                size - 1 - i
            };
            bits[at] = byte;
        }
        let bits = u64::from_le_bytes(bits);
        Ok(match kind {
            Kind::I8 => f64::from(bits as i8),
            Kind::U8 => f64::from(bits as u8),
            Kind::I16 => f64::from(bits as i16),
            Kind::U16 => f64::from(bits as u16),
            Kind::I32 => f64::from(bits as i32),
            Kind::U32 => f64::from(bits as u32),
            Kind::Float => f64::from(f32::from_bits(bits as u32)),
            Kind::Double => f64::from_bits(bits),
        })
    }
}
