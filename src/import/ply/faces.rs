//! The faces of a PLY file: polygons, and the triangle strips of older scanners.

use super::reader::Reader;
use super::types::{Element, Property};
use super::{AGAIN, Content};
use crate::import::budget;
use crate::import::error::ImportError;
use crate::import::polygon::{self, Cutter, Defect};
use glam::DVec3;

/// The face property with the corners.
pub(super) const CORNERS: [&str; 2] = ["vertex_indices", "vertex_index"];

/// Ends a strip in the list of an element `tristrips`.
const RESTART: f64 = -1.0;

/// Reads the polygons of the element into triangles.
pub(super) fn polygons(
    reader: &mut Reader,
    element: &Element,
    content: &mut Content,
) -> Result<(), ImportError> {
    let at = corners_of(reader, element)?;
    reader.reserve(budget::size::<[u32; 3]>(element.count))?;
    content.mesh.triangles.reserve_exact(element.count);
    let mut cutter = Cutter::new();
    let mut corners: Vec<u32> = Vec::new();
    let count = content.mesh.positions.len().min(i32::MAX as usize);
    for _ in 0..element.count {
        if let [property] = &element.properties[..]
            && let Some(triangle) = reader.triple(property, count)
        {
            content.mesh.triangles.push(triangle);
            continue;
        }
        corners.clear();
        for (i, property) in element.properties.iter().enumerate() {
            let count = reader.length(property)?;
            for _ in 0..count {
                let number = reader.number(property.kind)?;
                if i == at {
                    corners.push(vertex(reader, number, content)?);
                }
            }
        }
        match corners[..] {
            [a, b, c] => content.mesh.triangles.push([a, b, c]),
            [_, _, _, ..] => {
                reader.reserve(budget::size::<[u32; 3]>(corners.len() - 3))?;
                cut(&mut cutter, &corners, content);
            }
            _ => content.short_faces += 1,
        }
    }
    Ok(())
}

/// Reads the strips of the element: each corner after the first two adds a triangle with the two before it.
pub(super) fn strips(
    reader: &mut Reader,
    element: &Element,
    content: &mut Content,
) -> Result<(), ImportError> {
    let at = corners_of(reader, element)?;
    for _ in 0..element.count {
        for (i, property) in element.properties.iter().enumerate() {
            let count = reader.length(property)?;
            if i == at {
                reader.reserve(budget::size::<[u32; 3]>(count))?;
            }
            let mut strip: Vec<u32> = Vec::new();
            for _ in 0..count {
                let number = reader.number(property.kind)?;
                if i != at {
                    continue;
                }
                if number == RESTART {
                    strip.clear();
                    continue;
                }
                strip.push(vertex(reader, number, content)?);
                if let [.., a, b, c] = strip[..] {
                    // Every other triangle is turned, so that all have the same winding.
                    let is_odd = strip.len() % 2 == 1;
                    content
                        .mesh
                        .triangles
                        .push(if is_odd { [a, b, c] } else { [b, a, c] });
                }
            }
        }
    }
    Ok(())
}

fn corners_of(reader: &Reader, element: &Element) -> Result<usize, ImportError> {
    let is_wanted = |property: &Property| CORNERS.contains(&property.name.as_str());
    let at = element.properties.iter().position(is_wanted);
    let at = at.filter(|&at| element.properties[at].count.is_some());
    at.ok_or_else(|| reader.refuse("its faces have no list `vertex_indices`", AGAIN))
}

fn vertex(reader: &Reader, index: f64, content: &Content) -> Result<u32, ImportError> {
    let count = content.mesh.positions.len();
    match (0.0..count as f64).contains(&index) {
        true => Ok(index as u32),
        false => {
            let why = format!("a face has vertex {index}, but only {count} exist");
            Err(reader.refuse(&why, AGAIN))
        }
    }
}

/// Adds the triangles of a polygon of more than three corners.
fn cut(cutter: &mut Cutter, corners: &[u32], content: &mut Content) {
    let place = |&corner: &u32| content.mesh.positions[corner as usize].as_dvec3();
    let points: Vec<DVec3> = corners.iter().map(place).collect();
    let triangles = cutter.triangles(&points).unwrap_or_else(|defect| {
        // Triangles without area are counted when the mesh is repaired.
        content.fans += usize::from(defect != Defect::NoArea);
        polygon::fan(points.len())
    });
    let corner = |i: u32| corners[i as usize];
    content
        .mesh
        .triangles
        .extend(triangles.iter().map(|triangle| triangle.map(corner)));
}
