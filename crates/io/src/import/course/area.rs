//! The extension that turns a light into a rectangle.

use crate::import::error::ImportError;
use crate::import::faults::Faults;
use crate::import::source::{Source, Token};
use glam::DVec3;
use glimray_scene::{Light, LightKind};

/// Shadow rays per point if `samples:` is missing.
const SAMPLES: u32 = 16;

/// The extent that one object specifies.
#[derive(Default)]
pub(super) struct Area<'s> {
    /// Whether the object is a light.
    pub is_of_light: bool,
    /// `area_light:`.
    wanted: Option<bool>,
    /// `area_u:` and its position.
    side_u: Option<(DVec3, Token<'s>)>,
    side_v: Option<DVec3>,
    samples: Option<u32>,
    /// Indices of all keys that occurred, in the importer's list.
    found: Vec<usize>,
}

impl<'s> Area<'s> {
    /// Reads the key with this index, `area_light:` being 1, and its words.
    pub fn read(
        &mut self,
        index: usize,
        key: Token<'s>,
        words: &[Token],
        source: &Source,
        faults: &mut Faults,
    ) -> Result<(), ImportError> {
        let refuse = |word: Token, why, todo| Err(source.malformed(word.span(), why, todo));
        self.found.push(index);
        match (index, words) {
            (1, [word]) => match word.bytes.to_ascii_lowercase().as_slice() {
                b"true" => self.wanted = Some(true),
                b"false" => self.wanted = Some(false),
                _ => {
                    let why = format!("expected `true` or `false`, found {}", word.quote());
                    return refuse(*word, why, "Write `area_light: true`");
                }
            },
            (2 | 3, &[x, y, z]) => {
                let mut parse = |word| faults.number_or_nan("area_light:", source, word);
                let side = DVec3::new(parse(x)?, parse(y)?, parse(z)?);
                if index == 2 {
                    self.side_u = Some((side, key));
                } else {
                    self.side_v = Some(side);
                }
            }
            (_, [word]) => {
                let count = faults.number_or_nan("samples:", source, *word)?;
                if count.fract() != 0.0 || !(1.0..=65536.0).contains(&count) {
                    let what = ("samples:", "other than 1 to 65536 skipped");
                    faults.add(what, source, word.span(), || {
                        let why = format!("{} is not a number of samples", word.quote());
                        (why, "Write a whole number from 1 to 65536")
                    });
                    return Ok(());
                }
                self.samples = Some(count as u32);
            }
            _ => {}
        }
        Ok(())
    }

    /// Turns a light into a rectangle if it has one.
    pub fn apply(
        self,
        light: &mut Light,
        source: &Source,
        faults: &mut Faults,
        unused: &mut [usize],
    ) {
        match (self.wanted, self.side_u, self.side_v, light.kind) {
            // A disabled light needs no edges.
            (Some(false), ..) => {}
            (
                Some(true),
                Some((side_u, key)),
                Some(side_v),
                LightKind::Point { position: center },
            ) => {
                let sine = match (side_u.try_normalize(), side_v.try_normalize()) {
                    (Some(u), Some(v)) => u.cross(v).length(),
                    _ => 0.0,
                };
                if sine.is_nan() || sine < 1e-6 {
                    let what = ("area_light:", "lights without area left as points");
                    faults.add(what, source, key.span(), || {
                        let why = "`area_u:` and `area_v:` span no area".to_owned();
                        (why, "Give two sides that are not parallel")
                    });
                    return;
                }
                light.kind = LightKind::Rectangle {
                    center,
                    edge_u: side_u / 2.0,
                    edge_v: side_v / 2.0,
                };
                light.samples = self.samples.unwrap_or(SAMPLES);
            }
            _ => self.count(unused),
        }
    }

    /// Counts all keys of the object as ineffective.
    pub fn count(&self, unused: &mut [usize]) {
        for &index in &self.found {
            unused[index] += 1;
        }
    }
}
