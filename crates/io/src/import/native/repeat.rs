//! The transforms of repeated objects' copies.

use super::Texts;
use super::file::Spanned;
use super::file::{GridTable, PointsTable, RepeatTable, RingTable, ScatterTable};
use super::values::or;
use crate::import::error::ImportError;
use crate::import::paths::Files;
use crate::import::{MAX_GEOMETRY_BYTES, ply};
use glam::{DAffine3, DQuat, DVec3};
use glimray_scene::Transform;
use glimray_scene::random::{GAMMA, mixed, unit};
use std::f64::consts::TAU;

/// Copies of an object, by index.
pub(super) enum Repeat<'a> {
    /// The object itself, without repetition.
    Once,
    Grid(&'a GridTable),
    Ring(&'a RingTable),
    Scatter(&'a ScatterTable),
    Points(Vec<DAffine3>),
}

impl<'a> Repeat<'a> {
    /// The repetition that `table` describes.
    pub fn new(
        table: Option<&'a Spanned<RepeatTable>>,
        texts: &Texts,
        files: &Files,
    ) -> Result<Self, ImportError> {
        let Some(table) = table else {
            return Ok(Self::Once);
        };
        let RepeatTable {
            grid,
            ring,
            scatter,
            points,
        } = table.get_ref();
        match (grid, ring, scatter, points) {
            (Some(grid), None, None, None) => Ok(Self::Grid(grid)),
            (None, Some(ring), None, None) => Ok(Self::Ring(ring)),
            (None, None, None, Some(points)) => self::points(points, texts, files),
            (None, None, Some(scatter), None) => {
                let (min, max) = (scatter.min.0, scatter.max.0);
                let names = ["x", "y", "z"].into_iter().enumerate();
                if let Some((_, name)) = names.into_iter().find(|&(i, _)| max[i] < min[i]) {
                    let why = format!("{name} of `max` is less than {name} of `min`");
                    let todo = "Swap them";
                    return Err(texts.malformed(scatter.max.span(), why, todo));
                }
                Ok(Self::Scatter(scatter))
            }
            _ => {
                let why = "a repetition needs exactly one arrangement".to_owned();
                let todo = "Give one of `grid`, `ring`, `scatter` and `points`; to combine them, repeat a group";
                Err(texts.malformed(table.span(), why, todo))
            }
        }
    }

    /// Number of copies.
    pub fn count(&self) -> u128 {
        match self {
            Self::Once => 1,
            Self::Grid(grid) => grid.count.0.map(u128::from).iter().product(),
            Self::Ring(ring) => ring.count.0.into(),
            Self::Scatter(scatter) => scatter.count.0.into(),
            Self::Points(places) => places.len() as u128,
        }
    }

    /// The transform of the copy with this index.
    pub fn placement(&self, index: u64) -> DAffine3 {
        match self {
            Self::Once => DAffine3::IDENTITY,
            Self::Grid(table) => grid(table, index),
            Self::Ring(table) => ring(table, index),
            Self::Scatter(table) => scatter(table, index),
            Self::Points(places) => places[index as usize],
        }
    }
}

fn points<'a>(
    points: &PointsTable,
    texts: &Texts,
    files: &Files,
) -> Result<Repeat<'a>, ImportError> {
    let path = files.resolve(points.file.get_ref()).map_err(|refusal| {
        refusal.into_error("point file", |why, todo| {
            texts.malformed(points.file.span(), why, todo)
        })
    })?;
    let bytes = files.read(&path, MAX_GEOMETRY_BYTES)?;
    ply::places(&path, &bytes).map(Repeat::Points)
}

/// x varies fastest, then y.
fn grid(table: &GridTable, index: u64) -> DAffine3 {
    let [x, y, z] = table.count.0;
    let steps = [index % x, index / x % y, index / x / y].map(|step| step as f64);
    let middle = if table.centered == Some(true) {
        DVec3::from([x, y, z].map(|count| (count - 1) as f64)) / 2.0
    } else {
        DVec3::ZERO
    };
    DAffine3::from_translation((DVec3::from(steps) - middle) * table.step.0)
}

fn ring(table: &RingTable, index: u64) -> DAffine3 {
    let axis = or(table.axis, DVec3::Y);
    let (index, count) = (index as f64, table.count.0 as f64);
    let turn = match table.arc_deg {
        // A single copy is at the start of its arc.
        Some(arc) => index * arc.0.to_radians() / (count - 1.0).max(1.0),
        None => index * TAU / count,
    };
    let turn = DQuat::from_axis_angle(axis, or(table.start_deg, 0.0).to_radians() + turn);
    let outwards = DQuat::from_rotation_arc(DVec3::Y, axis) * DVec3::X;
    let moved = turn * (f64::from(or(table.radius, 0.0)) * outwards);
    let turn = if table.turned.unwrap_or(true) {
        turn
    } else {
        DQuat::IDENTITY
    };
    DAffine3::from_rotation_translation(turn, moved)
}

/// Scale, then rotation, then translation. Every copy has its own random numbers.
fn scatter(table: &ScatterTable, index: u64) -> DAffine3 {
    const DRAWS: u64 = 7;
    let draw = |i: u64| random(or(table.seed, 0), index * DRAWS + i);
    let three = |first: u64| DVec3::new(draw(first), draw(first + 1), draw(first + 2));
    let (min, max) = (table.min.0, table.max.0);
    let turn = (2.0 * three(3) - 1.0) * or(table.turn_deg, DVec3::ZERO);
    let [least, most] = or(table.scale, [1.0; 2]);
    let scale = least + (most - least) * draw(6);
    let transform = Transform {
        scale: DVec3::splat(scale),
        rotate_deg: turn,
        translate: min + (max - min) * three(0),
    };
    transform.affine()
}

/// A random number in [0, 1) for each seed and index: SplitMix64 of both, so that
/// each can be computed without those before it.
fn random(seed: u64, index: u64) -> f64 {
    let stream = mixed(seed.wrapping_add(1).wrapping_mul(GAMMA));
    let bits = mixed(stream.wrapping_add(index.wrapping_add(1).wrapping_mul(GAMMA)));
    unit(bits)
}
