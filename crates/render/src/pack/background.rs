//! Packs the background of a frame.

use super::PackedScene;
use crate::layout::{
    BACKGROUND_COLOR, BACKGROUND_GRADIENT, BACKGROUND_PICTURE, BACKGROUND_SKY, PackedFrame,
};
use glam::DQuat;
use glimray_scene::{
    Background,
    sky::{self, Sun},
};

impl PackedScene {
    /// The background members of a frame.
    pub(super) fn background(&self, background: &Background) -> PackedFrame {
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
                frame.background = [strength * self.packed_pictures[picture].scale; 3];
                frame.background_rotation = rotation as f32;
                [
                    frame.background_picture,
                    frame.background_width,
                    frame.background_height,
                ] = self.pictures[picture];
                if let Some(sun) = self.sun_of(picture) {
                    let direction = DQuat::from_rotation_y(rotation) * sun.direction;
                    frame.sun = direction.as_vec3().into();
                    frame.background_top = (f64::from(strength) * sun.radiance).as_vec3().into();
                }
            }
        }
        frame
    }

    /// The override `BACKGROUND`.
    pub(super) fn background_kind(&self, background: &Background) -> u32 {
        match *background {
            Background::Color(_) => BACKGROUND_COLOR,
            Background::Gradient { .. } => BACKGROUND_GRADIENT,
            Background::Picture { picture, .. } => match self.sun_of(picture) {
                Some(_) => BACKGROUND_SKY,
                None => BACKGROUND_PICTURE,
            },
        }
    }

    /// The sun of a picture in the background.
    fn sun_of(&self, picture: usize) -> Option<Sun> {
        sky::sun_of(&self.packed_pictures[picture].picture)
    }
}
