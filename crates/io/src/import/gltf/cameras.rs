//! Cameras (section 3.10 of the specification). A lens with a value that none can have gets a usual one.

use super::Reader;
use super::document::{Node, Orthographic, Perspective};
use super::values::Checked;
use crate::import::error::ImportError;
use glimray_scene::Camera;
use std::f64::consts::PI;

/// The widest pictures that cameras are made for, in heights.
const MOST_RATIO: f64 = 32.0;

/// The field of view of a camera whose own cannot be used, in radians.
const USUAL_FOV: f64 = PI / 4.0;

/// The largest half of an orthographic view.
const MOST_MAG: f64 = 1e18;

impl Reader<'_> {
    /// Adds `cameras[index]` at the node `source`, which is node `added` of the scene.
    pub(super) fn camera(
        &mut self,
        index: usize,
        source: &Node,
        added: usize,
        here: &str,
    ) -> Result<(), ImportError> {
        let cameras = &self.document.cameras;
        let camera = self.blame.get(cameras, index, "cameras", here)?;
        let place = format!("cameras[{index}]");
        let mut named = [&camera.name, &source.name].into_iter().flatten();
        let mut seen = Camera {
            name: named
                .find(|name| !name.is_empty())
                .cloned()
                .unwrap_or_default(),
            node: Some(added),
            ..Camera::default()
        };
        match (&camera.perspective, &camera.orthographic) {
            (Some(lens), _) => {
                seen.fov_y = self.fov_y(lens, &place);
                seen.clip = self.clip(lens.znear, lens.zfar, &place);
            }
            (None, Some(lens)) => {
                seen.orthographic_height = Some(self.height(lens, &place));
                seen.clip = self.clip(lens.znear, lens.zfar, &place);
            }
            (None, None) => {
                seen.fov_y = USUAL_FOV;
                self.notes.add("cameras without a lens", || {
                    format!("{place} has no lens: its field of view is π/4")
                });
            }
        }
        self.scene.cameras.push(seen);
        self.cameras.push(index);
        Ok(())
    }

    /// The field of view along y, in radians, in which pictures show all that the file's would.
    fn fov_y(&mut self, lens: &Perspective, place: &str) -> f64 {
        let aspect = self.aspect;
        let mut values = Checked::new(&mut self.notes, place, None);
        let mut fov_y = lens.yfov;
        if !(fov_y > 0.0 && fov_y < PI) {
            let rule = "it must be between 0 and π";
            values.repaired("perspective.yfov", &[fov_y], rule, "π/4");
            fov_y = USUAL_FOV;
        }
        let high = (fov_y / 2.0).tan();
        let wide = match lens.aspect_ratio {
            Some(ratio) if ratio > 0.0 => high * ratio.min(MOST_RATIO),
            Some(ratio) => {
                let used = "the aspect of the picture";
                values.repaired(
                    "perspective.aspectRatio",
                    &[ratio],
                    "it must be above 0",
                    used,
                );
                0.0
            }
            None => 0.0,
        };
        match wide > high * aspect {
            true => 2.0 * (wide / aspect).atan(),
            false => fov_y,
        }
    }

    /// The height of an orthographic view, in which pictures show all that the file's would.
    fn height(&mut self, lens: &Orthographic, place: &str) -> f64 {
        let aspect = self.aspect;
        let mut values = Checked::new(&mut self.notes, place, None);
        let mut half = |key: &str, value: f64, usual: f64| {
            // Some programs mirror views.
            let size = value.abs();
            let used = match size > 0.0 && size < MOST_MAG {
                true => size,
                false => usual,
            };
            if used != value {
                let rule = "it must be above 0";
                values.repaired(key, &[value], rule, &used.to_string());
            }
            used
        };
        let high = half("orthographic.ymag", lens.ymag, 1.0);
        let wide = half("orthographic.xmag", lens.xmag, high * aspect);
        2.0 * high.max(wide.min(MOST_RATIO * high) / aspect)
    }

    /// The planes between which the camera at `place` sees. One that the specification excludes does not clip.
    fn clip(&mut self, znear: f64, zfar: Option<f64>, place: &str) -> (f64, f64) {
        let (mut near, mut far) = Camera::UNCLIPPED;
        let mut refuse = |value: f64, name: &str, why: &str| {
            self.notes.add("clipping planes that do not clip", || {
                format!("{place}: {name} {value} does not clip: it must be {why}")
            });
        };
        match (0.0..1e18).contains(&znear) {
            true => near = znear,
            false => refuse(znear, "znear", "0 or more"),
        }
        match zfar {
            Some(zfar) if zfar > near => far = zfar,
            Some(zfar) => refuse(zfar, "zfar", "greater than znear"),
            None => {}
        }
        (near, far)
    }
}
