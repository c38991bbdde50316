//! What changes from frame to frame: camera and lights.

use super::{
    PackError, PackedScene,
    geometry::{in_range, render_point},
    media,
};
use crate::{
    layout::{
        ATTENUATION_INVERSE_SQUARE, ATTENUATION_NONE, BACKGROUND_COLOR, BACKGROUND_GRADIENT,
        BACKGROUND_PICTURE, LIGHT_DIRECTIONAL, LIGHT_DISC, LIGHT_POINT, LIGHT_RECTANGLE,
        LIGHT_SPHERE, LIGHT_SPOT, PackedCamera, PackedFrame, PackedLight,
    },
    scene::{Attenuation, Background, Camera, Frame, Light, LightKind},
};
use bytemuck::{bytes_of, cast_slice};
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
    /// Whether there is a light that has extent.
    pub has_area_lights: bool,
    /// [`BACKGROUND_COLOR`] and so on.
    pub background: u32,
}

impl PackedScene {
    /// Packs what [`crate::scene::Scene::shot`] of the scene that this was made from gives.
    pub fn shot(&self, frames: &[Frame]) -> Result<PackedView, PackError> {
        self.frame(&frames[0])
    }

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
                light_count: lights.len() as u32,
                ambient: frame.ambient.into(),
                triangle_count: self.triangles.len() as u32,
                shape_count: self.bounded_shape_count(),
                plane_count: self.plane_count,
                vertex_count: self.vertices.len() as u32,
                material_count: self.materials.len() as u32,
                camera_media: media::around(&self.bodies, frame.camera.look_from)?,
                ..self.background(&frame.background)
            },
            background: match frame.background {
                Background::Color(_) => BACKGROUND_COLOR,
                Background::Gradient { .. } => BACKGROUND_GRADIENT,
                Background::Picture { .. } => BACKGROUND_PICTURE,
            },
            has_area_lights: lights.iter().any(|light| light.kind >= LIGHT_RECTANGLE),
            lights,
            has_lights,
        })
    }

    /// The members of a frame that belong to the background.
    fn background(&self, background: &Background) -> PackedFrame {
        let mut frame = PackedFrame::default();
        match *background {
            Background::Color(color) => frame.background = color.into(),
            Background::Gradient { bottom, top } => {
                frame.background = bottom.into();
                frame.background_top = top.into();
            }
            Background::Picture {
                picture,
                strength,
                rotation,
            } => {
                frame.background = [strength; 3];
                frame.background_rotation = rotation as f32;
                [
                    frame.background_first_texel,
                    frame.background_width,
                    frame.background_height,
                ] = self.pictures[picture];
            }
        }
        frame
    }
}

impl PackedView {
    /// Every byte that a picture of this scene depends on.
    pub fn parts(&self) -> Vec<&[u8]> {
        vec![bytes_of(&self.frame), cast_slice(&self.lights)]
    }

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
        lens_radius: camera.lens.map_or(0.0, |lens| lens.radius as f32),
        focus_distance: camera.lens.map_or(1.0, |lens| lens.focus_distance as f32),
        blade_count: camera.lens.map_or(0, |lens| lens.blade_count),
        blade_rotation: camera.lens.map_or(0.0, |lens| lens.blade_rotation as f32),
    })
}

fn light(light: &Light, origin: DVec3) -> Result<PackedLight, PackError> {
    let mut packed = PackedLight {
        direction: DVec3::NEG_Y.as_vec3().into(),
        color: light.color.into(),
        attenuation: match light.attenuation {
            Attenuation::InverseSquare => ATTENUATION_INVERSE_SQUARE,
            Attenuation::None => ATTENUATION_NONE,
        },
        sample_count: 1,
        ..Default::default()
    };
    let direct = |direction: DVec3| direction.as_vec3().into();
    let position = match light.kind {
        LightKind::Point { position } => {
            packed.kind = LIGHT_POINT;
            position
        }
        LightKind::Directional { direction } => {
            packed.kind = LIGHT_DIRECTIONAL;
            packed.attenuation = ATTENUATION_NONE;
            packed.direction = direct(direction);
            origin
        }
        LightKind::Spot {
            position,
            direction,
            inner,
            outer,
        } => {
            packed.kind = LIGHT_SPOT;
            packed.direction = direct(direction);
            packed.cos_inner = inner.cos() as f32;
            packed.cos_outer = outer.cos() as f32;
            position
        }
        LightKind::Rectangle {
            center,
            edge_u,
            edge_v,
        } => {
            in_range(edge_u.length().max(edge_v.length()))?;
            packed.kind = LIGHT_RECTANGLE;
            packed.direction = direct(edge_u.cross(edge_v).normalize_or(DVec3::NEG_Y));
            (packed.edge_u, packed.edge_v) = (direct(edge_u), direct(edge_v));
            center
        }
        LightKind::Disc {
            center,
            normal,
            radius,
        } => {
            in_range(radius)?;
            packed.kind = LIGHT_DISC;
            packed.direction = direct(normal);
            let (u, v) = normal.any_orthonormal_pair();
            (packed.edge_u, packed.edge_v) = (direct(u * radius), direct(v * radius));
            center
        }
        LightKind::Sphere { center, radius } => {
            in_range(radius)?;
            packed.kind = LIGHT_SPHERE;
            packed.radius = radius as f32;
            center
        }
    };
    packed.position = render_point(position, origin)?.into();
    if light.kind.radiance().is_some() {
        packed.sample_count = light.samples;
    }
    Ok(packed)
}
