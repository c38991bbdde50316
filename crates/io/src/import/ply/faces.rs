//! The faces of a PLY file: polygons, and the triangle strips of older scanners.

use super::reader::Reader;
use super::types::{Element, Property};
use super::{AGAIN, Content};
use crate::import::budget;
use crate::import::error::ImportError;
use crate::import::polygon::{Cutter, Defect, fan};
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
    let row_count = reader.row_count(element);
    reader.reserve(budget::size::<[u32; 3]>(row_count))?;
    content.mesh.triangles.reserve_exact(row_count);
    let mut cutter = Cutter::new();
    let mut corners: Vec<u32> = Vec::new();
    // Without vertices that are lost, triangles need one comparison for each corner.
    let count = match content.lost.is_empty() {
        true => content.vertex_count().min(i32::MAX as usize),
        false => 0,
    };
    for _ in 0..element.count {
        if let [property] = &element.properties[..]
            && let Some(triangle) = reader.triple(property, count)
        {
            content.mesh.triangles.push(triangle);
            continue;
        }
        match polygon(reader, element, at, content, &mut corners) {
            Ok(true) => {}
            Ok(false) => continue,
            Err(_) if reader.is_cut.get() => return Ok(()),
            Err(error) => return Err(error),
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

/// Reads one polygon; returns whether all of its corners can be used.
fn polygon(
    reader: &mut Reader,
    element: &Element,
    at: usize,
    content: &mut Content,
    corners: &mut Vec<u32>,
) -> Result<bool, ImportError> {
    corners.clear();
    let mut lacks = false;
    for (i, property) in element.properties.iter().enumerate() {
        let count = reader.length(property)?;
        for _ in 0..count {
            let number = reader.number(property.kind)?;
            if i == at && !lacks {
                match vertex(reader, number, content) {
                    Some(corner) => corners.push(corner),
                    None => lacks = true,
                }
            }
        }
    }
    Ok(!lacks)
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
            let count = match reader.length(property) {
                Err(_) if reader.is_cut.get() => return Ok(()),
                count => count?,
            };
            if i == at {
                reader.reserve(budget::size::<[u32; 3]>(count))?;
            }
            let mut strip: Vec<u32> = Vec::new();
            for _ in 0..count {
                let number = match reader.number(property.kind) {
                    Err(_) if reader.is_cut.get() => return Ok(()),
                    number => number?,
                };
                if i != at {
                    continue;
                }
                // A vertex that cannot be used interrupts a strip.
                let corner = match number == RESTART {
                    true => None,
                    false => vertex(reader, number, content),
                };
                let Some(corner) = corner else {
                    strip.clear();
                    continue;
                };
                strip.push(corner);
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

/// The vertex with this index, if it can be used; otherwise counts it.
fn vertex(reader: &mut Reader, index: f64, content: &mut Content) -> Option<u32> {
    let count = content.vertex_count();
    if (0.0..count as f64).contains(&index) {
        let is_lost = content.lost.get(index as usize).is_some_and(|lost| *lost);
        return (!is_lost).then_some(index as u32);
    }
    content.absent_corners += 1;
    if reader.fault.is_none() {
        let why = format!("a face has vertex {index}, but only {count} exist");
        reader.fault = Some(reader.refuse(&why, AGAIN));
    }
    None
}

/// Adds the triangles of a polygon of more than three corners.
fn cut(cutter: &mut Cutter, corners: &[u32], content: &mut Content) {
    let place = |&corner: &u32| content.mesh.positions[corner as usize].as_dvec3();
    let points: Vec<DVec3> = corners.iter().map(place).collect();
    let triangles = cutter.triangles(&points).unwrap_or_else(|defect| {
        // Triangles without area are counted when the mesh is repaired.
        content.fans += usize::from(defect != Defect::NoArea);
        fan(points.len())
    });
    let corner = |i: u32| corners[i as usize];
    content
        .mesh
        .triangles
        .extend(triangles.iter().map(|triangle| triangle.map(corner)));
}
