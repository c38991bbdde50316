//! The scene that shows one material on a ball before a plain background.

use glam::{DVec3, Vec3};
use glimray_scene::{
    Attenuation, Background, Camera, Geometry, Light, LightKind, Material, Origin, Pattern,
    Picture, Scene, Shape, Texels,
};
use std::sync::{Arc, Weak};

/// The longest side of pictures on the ball, in texels.
const MAX_SIDE: u32 = 256;
/// The lamp: its place and radius, with the ball of radius 1 at the origin.
const LAMP: (DVec3, f64) = (DVec3::new(-3.0, 4.0, 5.0), 1.0);
/// Light of the lamp on a white surface that faces it.
const LAMP_LIGHT: f32 = 0.6;
/// Radiance of the background straight down and straight up.
const GROUND: f32 = 0.1;
const SKY: f32 = 0.8;
/// Distance of the camera, and its field of view in radians.
const DISTANCE: f64 = 6.0;
const FOV_Y: f64 = 0.38;

/// Makes the scenes of balls. A scene stays the same object while it shows the same.
#[derive(Default)]
pub struct BallMaker {
    /// The scene and the index of the material that were asked for last.
    of: Option<(Weak<Scene>, usize)>,
    scene: Option<Arc<Scene>>,
    /// Small copies of pictures.
    small: Vec<(Weak<Picture>, Arc<Picture>)>,
}

impl BallMaker {
    /// A ball of the material with this index in `scene`.
    pub fn scene(&mut self, scene: &Arc<Scene>, index: usize) -> Arc<Scene> {
        let of = (Arc::downgrade(scene), index);
        let was_asked = |known: &(Weak<Scene>, usize)| known.0.ptr_eq(&of.0) && known.1 == index;
        if let (true, Some(known)) = (self.of.as_ref().is_some_and(was_asked), &self.scene) {
            return known.clone();
        }
        self.of = Some(of);
        let made = self.make(scene, &scene.materials[index]);
        let is_same = |before: &&Arc<Scene>| {
            let pictures = before.pictures.iter().zip(&made.pictures);
            before.materials == made.materials
                && before.textures == made.textures
                && before.pictures.len() == made.pictures.len()
                && pictures.into_iter().all(|(a, b)| Arc::ptr_eq(a, b))
        };
        match self.scene.as_ref().filter(is_same) {
            Some(before) => before.clone(),
            None => self.scene.insert(Arc::new(made)).clone(),
        }
    }

    fn make(&mut self, scene: &Scene, material: &Material) -> Scene {
        let used: Vec<usize> = material.texture_indices().collect();
        let mut pictures = Vec::new();
        let mut textures = scene.textures.clone();
        for (index, texture) in textures.iter_mut().enumerate() {
            let Pattern::Picture { picture, .. } = &mut texture.pattern else {
                continue;
            };
            // Other textures keep their places, without a picture of their own.
            if used.contains(&index) {
                pictures.push(self.small(&scene.pictures[*picture]));
                *picture = pictures.len() - 1;
            } else {
                texture.pattern = Pattern::Checker {
                    a: Vec3::ONE,
                    b: Vec3::ONE,
                };
            }
        }
        let (center, radius) = LAMP;
        let mut made = Scene {
            materials: vec![Material {
                name: String::new(),
                ..material.clone()
            }],
            textures,
            pictures,
            shapes: vec![Shape {
                geometry: Geometry::Sphere {
                    center: DVec3::ZERO,
                    radius: 1.0,
                },
                material: 0,
                node: None,
                name: String::new(),
            }],
            lights: vec![Light {
                kind: LightKind::Sphere { center, radius },
                color: Vec3::splat(LAMP_LIGHT * center.length_squared() as f32),
                attenuation: Attenuation::InverseSquare,
                samples: 1,
                visible: true,
                ..Light::default()
            }],
            cameras: vec![Camera {
                look_from: DVec3::Z * DISTANCE,
                look_at: DVec3::ZERO,
                fov_y: FOV_Y,
                ..Camera::default()
            }],
            background: Background::Gradient {
                bottom: Vec3::splat(GROUND),
                top: Vec3::splat(SKY),
            },
            ambient: Vec3::splat((GROUND + SKY) / 2.0),
            ..Scene::default()
        };
        made.complete_tangents();
        made
    }

    fn small(&mut self, picture: &Arc<Picture>) -> Arc<Picture> {
        if picture.width.max(picture.height) <= MAX_SIDE {
            return picture.clone();
        }
        let known = (self.small.iter()).find(|(of, _)| of.as_ptr() == Arc::as_ptr(picture));
        if let Some((_, small)) = known {
            return small.clone();
        }
        self.small.retain(|(of, _)| of.strong_count() > 0);
        let small = Arc::new(sampled(picture));
        self.small.push((Arc::downgrade(picture), small.clone()));
        small
    }
}

/// Every so many texels of a picture, which takes no time even if it is large.
fn sampled(picture: &Picture) -> Picture {
    let step = picture.width.max(picture.height).div_ceil(MAX_SIDE);
    let (width, height) = (picture.width.div_ceil(step), picture.height.div_ceil(step));
    let columns = (0..picture.width).step_by(step as usize);
    let places: Vec<usize> = (0..picture.height)
        .step_by(step as usize)
        .flat_map(|y| columns.clone().map(move |x| (x, y)))
        .map(|(x, y)| y as usize * picture.width as usize + x as usize)
        .collect();
    fn of<T: Copy>(texels: &[T], places: &[usize]) -> Vec<T> {
        places.iter().map(|place| texels[*place]).collect()
    }
    Picture {
        width,
        height,
        texels: match &picture.texels {
            Texels::Srgb8(texels) => Texels::Srgb8(of(texels, &places)),
            Texels::Linear8(texels) => Texels::Linear8(of(texels, &places)),
            Texels::Float(texels) => Texels::Float(of(texels, &places)),
        },
        origin: Origin::Texels,
    }
}
