//! The `v` entity: camera and image size.

use super::Reader;
use crate::import::error::ImportError;
use crate::import::source::Token;
use crate::import::suggest;
use glam::DVec3;
use glimray_scene::Camera;

/// The keys of a view, in the order of the specification.
pub(super) const KEYS: [&str; 6] = ["from", "at", "up", "angle", "hither", "resolution"];

/// Optional keys: only hidden-surface programs need the near plane.
const OPTIONAL: usize = 4;

/// Limit of the image's width and height in pixels.
const MAX_SIDE: f64 = 65_536.0;

pub(super) fn is_key(token: Token) -> bool {
    KEYS.iter().any(|key| key.as_bytes() == token.bytes)
}

impl<'s> Reader<'s> {
    /// Reads the keys, in any order.
    pub(super) fn view(&mut self, keyword: Token<'s>) -> Result<(), ImportError> {
        if !self.scene.cameras.is_empty() {
            let why = "duplicate view".to_owned();
            return Err(self.refuse(keyword, why, "Keep one `v` in the file"));
        }
        let mut values: [Option<[f64; 3]>; 6] = Default::default();
        while let Some(token) = self.words.peek() {
            let Some(key) = KEYS.iter().position(|key| key.as_bytes() == token.bytes) else {
                break;
            };
            self.words.next();
            if values[key].is_some() {
                let why = format!("a second `{}` in a view", KEYS[key]);
                return Err(self.refuse(token, why, "Keep one of them"));
            }
            values[key] = Some(self.view_values(key)?);
        }
        for (key, name) in KEYS.iter().enumerate() {
            if values[key].is_none() && key != OPTIONAL {
                return Err(self.missing(name));
            }
        }
        let [from, at, mut up, angle, hither, resolution] =
            values.map(|value| DVec3::from(value.unwrap_or_default()));
        let axis = at - from;
        let Some(forward) = axis.try_normalize() else {
            let why = "`from` and `at` are the same point or not finite".to_owned();
            return Err(self.refuse(keyword, why, "Choose distinct points"));
        };
        let slope = forward.cross(up.normalize_or_zero()).length();
        if slope.is_nan() || slope < 1e-6 {
            self.view_fault(keyword, "`up` replaced", || {
                "`up` is zero or parallel to the viewing direction".to_owned()
            });
            up = forward.any_orthonormal_vector();
        }
        if hither.x >= axis.length() {
            let note = "`hither` lies beyond the point that is looked at: nothing is cut off";
            self.scene.skipped.push(note.to_owned());
        }
        self.scene.cameras.push(Camera {
            look_from: from,
            look_at: at,
            up,
            fov_y: angle.x.to_radians(),
            ..Camera::default()
        });
        self.scene.output.size = (resolution.x as u32, resolution.y as u32);
        Ok(())
    }

    /// Counts a value of the view that is replaced.
    fn view_fault(&mut self, token: Token, what: &'static str, why: impl FnOnce() -> String) {
        let todo = super::ENTITIES[self.entity].2;
        let refusal = || (why(), todo);
        (self.faults).add(("v", what), self.source, token.span(), refusal);
    }

    fn view_values(&mut self, key: usize) -> Result<[f64; 3], ImportError> {
        match KEYS[key] {
            "angle" => {
                let (token, angle) = self.number()?;
                if angle > 0.0 && angle < 180.0 {
                    return Ok([angle, 0.0, 0.0]);
                }
                self.view_fault(token, "angles other than 0 to 180 replaced by 45", || {
                    format!("the angle {} is out of range", token.quote())
                });
                Ok([45.0, 0.0, 0.0])
            }
            "hither" => Ok([self.at_least_zero()?, 0.0, 0.0]),
            "resolution" => Ok([self.side()?, self.side()?, 0.0]),
            _ => Ok(self.vector()?.to_array()),
        }
    }

    fn side(&mut self) -> Result<f64, ImportError> {
        let (token, side) = self.number()?;
        if side.fract() == 0.0 && (1.0..=MAX_SIDE).contains(&side) {
            return Ok(side);
        }
        self.view_fault(token, "counts of pixels replaced by 512", || {
            format!("{} is not a count of pixels", token.quote())
        });
        Ok(512.0)
    }

    fn missing(&mut self, name: &str) -> ImportError {
        let todo = super::ENTITIES[self.entity].2;
        let Some(token) = self.words.peek() else {
            let why = format!("the file ends inside a view, before `{name}`");
            return self.refuse(self.words.end(), why, todo);
        };
        let word = String::from_utf8_lossy(token.bytes);
        let why = if word.len() > 2 && !super::looks_like_number(token) {
            suggest::unknown("key", &word, KEYS)
        } else {
            format!("the view before {} has no `{name}`", token.quote())
        };
        self.refuse(token, why, todo)
    }
}
