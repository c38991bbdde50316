//! What changes from frame to frame: camera and lights.

use super::{PackError, PackedScene, geometry::render_point};
use crate::{
    layout::{
        ATTENUATION_INVERSE_SQUARE, ATTENUATION_NONE, LIGHT_DIRECTIONAL, LIGHT_POINT, LIGHT_SPOT,
        PackedCamera, PackedFrame, PackedLight,
    },
    scene::{Attenuation, Camera, Frame, Light, LightKind},
};
use glam::DVec3;

/// A [`Frame`] as the GPU wants it.
#[derive(Clone, Debug, PartialEq)]
pub struct PackedView {
    /// Its camera's `right` is still that of a square picture; [`PackedView::with_aspect`] widens it.
    pub frame: PackedFrame,
    /// At least one: a dark light stands in where there is none.
    pub lights: Vec<PackedLight>,
    /// Whether there is a light that is not dark.
    pub has_lights: bool,
}

impl PackedScene {
    /// Packs a frame of the scene that this was made from.
    pub fn frame(&self, frame: &Frame) -> Result<PackedView, PackError> {
        let mut lights = (frame.lights.iter())
            .map(|l| light(l, self.origin))
            .collect::<Result<Vec<_>, _>>()?;
        let has_lights = lights.iter().any(|light| light.color != [0.0; 3]);
        if lights.is_empty() {
            lights.push(PackedLight::default());
        }
        Ok(PackedView {
            frame: PackedFrame {
                camera: camera(&frame.camera, self.origin)?,
                background: frame.background.into(),
                light_count: lights.len() as u32,
                ambient: frame.ambient.into(),
                triangle_count: self.triangles.len() as u32,
                shape_count: self.bounded_shape_count(),
                plane_count: self.plane_count,
                ..Default::default()
            },
            lights,
            has_lights,
        })
    }
}

impl PackedView {
    /// The view for a picture of `width` × `height` pixels: aspect = width / height.
    pub fn with_aspect(&self, width: u32, height: u32) -> Self {
        let mut view = self.clone();
        let aspect = f64::from(width) / f64::from(height);
        view.frame.camera.right = self
            .frame
            .camera
            .right
            .map(|c| (f64::from(c) * aspect) as f32);
        view
    }
}

/// The image plane at distance 1: half its height is tan(fov_y / 2).
fn camera(camera: &Camera, origin: DVec3) -> Result<PackedCamera, PackError> {
    let forward = (camera.look_at - camera.look_from).normalize_or(DVec3::NEG_Z);
    let right = forward
        .cross(camera.up)
        .normalize_or(forward.any_orthonormal_vector());
    let up = right.cross(forward);
    let half_height = (camera.fov_y / 2.0).tan();
    Ok(PackedCamera {
        origin: render_point(camera.look_from, origin)?.into(),
        forward: forward.as_vec3().into(),
        right: (right * half_height).as_vec3().into(),
        up: (up * half_height).as_vec3().into(),
        ..Default::default()
    })
}

fn light(light: &Light, origin: DVec3) -> Result<PackedLight, PackError> {
    let (kind, position, direction, cones) = match light.kind {
        LightKind::Point { position } => (LIGHT_POINT, position, DVec3::NEG_Y, (0.0, 0.0)),
        LightKind::Directional { direction } => (LIGHT_DIRECTIONAL, origin, direction, (0.0, 0.0)),
        LightKind::Spot {
            position,
            direction,
            inner,
            outer,
        } => (LIGHT_SPOT, position, direction, (inner, outer)),
    };
    Ok(PackedLight {
        position: render_point(position, origin)?.into(),
        kind,
        direction: direction.as_vec3().into(),
        attenuation: match light.attenuation {
            Attenuation::InverseSquare if kind != LIGHT_DIRECTIONAL => ATTENUATION_INVERSE_SQUARE,
            _ => ATTENUATION_NONE,
        },
        color: light.color.into(),
        cos_inner: cones.0.cos() as f32,
        cos_outer: cones.1.cos() as f32,
        ..Default::default()
    })
}
