//! Normals of corners that have none: of flat faces and of smoothing groups.
//!
//! A face is flat after `s off`. In a smoothing group, the normal of a corner is the area-weighted mean over
//! the faces of the group around its vertex, restricted to faces within the crease angle of 60° of the corner's
//! own face: a cube keeps its edges, and a tube of seven sides is smooth. Faces before the first `s` are a group too.

use super::Reader;
use super::face::{self, Corner};
use crate::import::source::Token;
use glam::{DVec3, Vec3};

/// The group before the first `s` statement.
pub(super) const UNSTATED: u32 = u32::MAX;

/// The cosine of the crease angle.
const CREASE: f64 = 0.5;

/// If more faces of a group meet in a vertex, all of them are averaged: comparing all pairs would take
/// quadratic time.
const MANY: usize = 64;

/// A face of a smoothing group.
pub(super) struct SmoothFace {
    /// Area-weighted: the area of the whole polygon, independent of its triangulation.
    normal: DVec3,
    group: u32,
}

/// The smoothing group of an `s` statement; 0 for none.
pub(super) fn group(word: Option<Token>) -> u32 {
    match word.map(|word| word.bytes) {
        None | Some(b"off" | b"0") => 0,
        Some(word) => {
            let number = std::str::from_utf8(word).ok();
            // Some exporters write `s on`.
            number.and_then(|number| number.parse().ok()).unwrap_or(1)
        }
    }
}

impl Reader<'_> {
    /// Gives normals to the corners of `face` that have none; `normal` is the face's own, weighted by its
    /// area.
    pub(super) fn complete_normals(&mut self, face: &mut [Corner], normal: DVec3) {
        let is_bare = |corner: &Corner| corner.normal == face::NONE;
        if !face.iter().any(is_bare) {
            return;
        }
        let index = if self.smoothing == 0 {
            face::MADE | self.made(normal.normalize_or_zero().as_vec3())
        } else {
            let group = self.smoothing;
            self.smooth_faces.push(SmoothFace { normal, group });
            face::SMOOTH | (self.smooth_faces.len() - 1) as u32
        };
        for corner in face.iter_mut().filter(|corner| is_bare(corner)) {
            corner.normal = index;
        }
    }

    /// Adds a computed normal. Equal consecutive normals share an index, which lets the faces of a plane
    /// share their vertices.
    fn made(&mut self, normal: Vec3) -> u32 {
        if self.made_normals.last() != Some(&normal) {
            self.made_normals.push(normal);
        }
        (self.made_normals.len() - 1) as u32
    }

    /// Computes the normals of corners in smoothing groups.
    pub(super) fn smooth(&mut self) {
        let face_of = |corner: &Corner| face::smooth_index(corner.normal);
        let corners = &self.corners;
        let mut order: Vec<u32> = (0..corners.len() as u32)
            .filter(|&i| face_of(&corners[i as usize]).is_some())
            .collect();
        let face = |i: u32| &self.smooth_faces[face_of(&corners[i as usize]).unwrap_or_default()];
        let key = |i: u32| (corners[i as usize].position, face(i).group);
        order.sort_unstable_by_key(|&i| (key(i), i));

        let mut means: Vec<Vec3> = Vec::new();
        let mut made = vec![0; order.len()];
        let mut start = 0;
        for round in order.chunk_by(|&a, &b| key(a) == key(b)) {
            let first = means.len();
            for (i, &corner) in round.iter().enumerate() {
                let own = face(corner).normal;
                let near = |other: &DVec3| {
                    round.len() > MANY || own.dot(*other) >= CREASE * own.length() * other.length()
                };
                let around = round.iter().map(|&other| face(other).normal).filter(near);
                let mean = around.sum::<DVec3>().normalize_or_zero().as_vec3();
                // All corners at a vertex with many faces get the same normal.
                let known = means[first..].iter().position(|known| *known == mean);
                made[start + i] = (first + known.unwrap_or(means.len() - first)) as u32;
                if known.is_none() {
                    means.push(mean);
                }
                if round.len() > MANY {
                    made[start..start + round.len()].fill(first as u32);
                    break;
                }
            }
            start += round.len();
        }
        let before = self.made_normals.len() as u32;
        self.made_normals.append(&mut means);
        for (&corner, index) in order.iter().zip(made) {
            self.corners[corner as usize].normal = face::MADE | (before + index);
        }
        self.smooth_faces = Vec::new();
    }
}
