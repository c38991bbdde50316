//! The entities `p` and `pp`: polygons and patches, as triangles of one mesh.

use super::Reader;
use crate::import::budget;
use crate::import::error::ImportError;
use crate::import::notes::{self, Notes};
use crate::import::polygon::{self, Cutter, Defect};
use crate::import::source::Token;
use glam::{DAffine3, DVec3, Vec3};
use glimray_scene::{Instance, Mesh, Scene};

/// Limit of corners of one polygon.
const MAX_CORNERS: f64 = 65_536.0;

/// All polygons so far, and the current one.
pub(super) struct Surface {
    /// Without positions.
    mesh: Mesh,
    positions: Vec<DVec3>,
    cutter: Cutter,
    /// Corners of the current polygon, and their normals if it is a patch.
    corners: Vec<DVec3>,
    normals: Vec<Vec3>,
    repeated_corners: usize,
    too_few_corners: usize,
    without_area: usize,
    fans: usize,
}

impl Surface {
    pub fn new() -> Self {
        Self {
            mesh: Mesh::default(),
            positions: Vec::new(),
            cutter: Cutter::new(),
            corners: Vec::new(),
            normals: Vec::new(),
            repeated_corners: 0,
            too_few_corners: 0,
            without_area: 0,
            fans: 0,
        }
    }

    /// Adds a corner to the polygon, unless it equals the previous one.
    fn corner(&mut self, position: DVec3, normal: Option<Vec3>) {
        if self.corners.last() == Some(&position) {
            self.repeated_corners += 1;
            return;
        }
        self.corners.push(position);
        self.normals.extend(normal);
    }

    /// Triangulates the polygon.
    fn close(&mut self, announced: usize, material: u32) {
        if self.corners.iter().any(|corner| corner.is_nan()) {
            return;
        }
        if self.corners.len() > 1 && self.corners.first() == self.corners.last() {
            self.repeated_corners += 1;
            self.corners.pop();
            self.normals.truncate(self.corners.len());
        }
        if announced < 3 {
            self.too_few_corners += 1;
            return;
        }
        let triangles = match self.cutter.triangles(&self.corners) {
            Ok(triangles) => triangles,
            Err(Defect::NoArea) => {
                self.without_area += 1;
                return;
            }
            Err(Defect::Crossing | Defect::TooMuchWork) => {
                self.fans += 1;
                polygon::fan(self.corners.len())
            }
        };
        let (first, count) = (self.positions.len() as u32, self.corners.len());
        let shift = |triangle: [u32; 3]| triangle.map(|i| first + i);
        self.mesh.triangles.extend(triangles.into_iter().map(shift));
        if self.normals.is_empty() {
            let normal = polygon::normal(&self.corners).normalize_or_zero().as_vec3();
            self.normals.resize(count, normal);
        }
        self.mesh.normals.append(&mut self.normals);
        self.positions.append(&mut self.corners);
        self.mesh.materials.resize(self.positions.len(), material);
    }

    pub fn is_empty(&self) -> bool {
        self.mesh.triangles.is_empty()
    }

    /// The memory that all polygons take, including later steps.
    pub fn memory(&self) -> u64 {
        budget::size::<(DVec3, [Vec3; 2], u32)>(self.positions.len())
            + budget::size::<[u32; 3]>(self.mesh.triangles.len())
    }

    /// Adds the mesh and the notes about it to `scene`.
    pub fn add_to(mut self, scene: &mut Scene) {
        let counts = [
            (
                "repeated corners of polygons dropped",
                self.repeated_corners,
            ),
            (
                "polygons with fewer than three corners skipped",
                self.too_few_corners,
            ),
            ("polygons without area skipped", self.without_area),
            (
                "polygons that intersect themselves or are too large, triangulated as fans",
                self.fans,
            ),
        ];
        let counts = counts.iter().filter(|(_, count)| *count > 0);
        let notes = counts.map(|(what, count)| format!("{what}: {count}"));
        scene.skipped.extend(notes);

        let (local, offset) = Mesh::from_world_positions(&self.positions);
        drop(self.positions);
        self.mesh.positions = local;
        let mut notes = Notes::default();
        notes::of_repairs(&mut notes, self.mesh.repair());
        scene.skipped.extend(notes.into_lines());
        if !self.mesh.triangles.is_empty() {
            scene.meshes.push(self.mesh.into());
            scene.instances.push(Instance {
                mesh: 0,
                placement: DAffine3::from_translation(offset),
                node: None,
                name: String::new(),
            });
        }
    }
}

impl<'s> Reader<'s> {
    pub(super) fn polygon(
        &mut self,
        keyword: Token<'s>,
        is_patch: bool,
    ) -> Result<(), ImportError> {
        let material = self.material_in_use(keyword)?;
        let (token, count) = self.number()?;
        if count.fract() != 0.0 || !(1.0..=MAX_CORNERS).contains(&count) {
            let why = format!("{} is not a count of corners", token.quote());
            return Err(self.refuse(token, why, "Write a whole number from 3 to 65536"));
        }
        let count = count as usize;
        self.surface.corners.clear();
        self.surface.normals.clear();
        for i in 0..count {
            let position = self.corner_vector(i, count)?;
            let normal = match is_patch {
                true => Some(self.corner_vector(i, count)?.as_vec3()),
                false => None,
            };
            self.surface.corner(position, normal);
        }
        self.surface.close(count, material as u32);
        Ok(())
    }

    /// Three numbers of corner `i` of `count`.
    fn corner_vector(&mut self, i: usize, count: usize) -> Result<DVec3, ImportError> {
        let mut vector = DVec3::ZERO;
        for value in vector.as_mut() {
            *value = self.corner_number(i, count)?;
        }
        Ok(vector)
    }

    fn corner_number(&mut self, i: usize, count: usize) -> Result<f64, ImportError> {
        // Format the text for errors only: this is the inner loop for large files.
        match self.words.peek() {
            Some(token) if super::looks_like_number(token) => Ok(self.number()?.1),
            _ => Ok(self
                .number_of(&format!(", after {i} of {count} corners"))?
                .1),
        }
    }
}
