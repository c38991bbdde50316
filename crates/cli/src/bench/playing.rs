//! A skinned figure that plays: how long each frame takes to deform, to upload and to render.

use super::figure::Figure;
use super::scenes::parts::Builder;
use crate::args::BenchArgs;
use crate::job;
use glam::{DAffine3, DQuat, DVec3, Vec3};
use glimray_app::error::AppError;
use glimray_app::storage;
use glimray_render::gpu::Gpu;
use glimray_render::pack::{self, PackedScene};
use glimray_render::{RenderSettings, Renderer};
use glimray_scene::{
    Attenuation, Beyond, Camera, Curve, Deformation, Easing, Influences, Instance, Interpolation,
    Joint, Light, LightKind, Node, NodeProperty, Scene, Skin, Target, Track, Values,
};
use serde::Serialize;
use std::f64::consts::TAU;
use std::sync::Arc;
use std::time::Instant;

pub const NAME: &str = "figure";
const SIZE: (u32, u32) = (640, 480);
const FPS: f64 = 24.0;
/// Frames of a repeat, and with `--quick`.
const FRAMES: u32 = 48;
const QUICK_FRAMES: u32 = 6;
/// A tube of so many quads round and along, and the joints along it.
const ROUND: u32 = 60;
const ALONG: u32 = 250;
const JOINTS: usize = 24;
const RADIUS: f64 = 0.25;
const HEIGHT: f64 = 4.0;

/// The scene and its measurements.
pub struct Playing {
    scene: Scene,
    packed: Arc<PackedScene>,
    frames: u32,
    still: Vec<Seconds>,
    blurred: Vec<Seconds>,
}

/// Means over the frames of a repeat.
#[derive(Clone, Copy, Default)]
struct Seconds {
    deform: f64,
    upload: f64,
    render: f64,
}

/// The figures of a frame, with the shutter closed and open for half of the frame.
#[derive(Debug, Serialize)]
pub struct Row {
    name: &'static str,
    triangles: usize,
    joints: usize,
    width: u32,
    height: u32,
    still: Times,
    blurred: Times,
}

#[derive(Debug, Serialize)]
struct Times {
    /// Posing the mesh, refitting its tree, and building the tree above.
    deform_seconds: Figure,
    upload_seconds: Figure,
    /// One sample per pixel.
    render_seconds: Figure,
    frames_per_second: Figure,
}

/// A tube that bends like a tentacle, of 30,000 triangles with four weights each vertex.
pub fn figure() -> Scene {
    let mut builder = Builder::default();
    builder.grid(ROUND, ALONG, |i, j| {
        let angle = TAU * f64::from(i) / f64::from(ROUND);
        let y = HEIGHT * f64::from(j) / f64::from(ALONG);
        DVec3::new(RADIUS * angle.cos(), y, -RADIUS * angle.sin())
    });
    let mesh = builder.mesh();
    let mut scene = Scene {
        cameras: vec![Camera {
            look_from: DVec3::new(0.0, 2.5, 8.0),
            look_at: DVec3::new(0.0, 1.8, 0.0),
            ..Camera::default()
        }],
        materials: vec![glimray_scene::Material::default()],
        lights: vec![Light {
            kind: LightKind::Directional {
                direction: DVec3::new(-0.4, -0.6, -0.7).normalize(),
            },
            color: Vec3::ONE,
            attenuation: Attenuation::None,
            ..Light::default()
        }],
        ..Scene::default()
    };
    let step = HEIGHT / JOINTS as f64;
    let mut joints = Vec::new();
    for index in 0..JOINTS {
        scene.nodes.push(Node {
            parent: index.checked_sub(1),
            translation: DVec3::Y * if index == 0 { 0.0 } else { step },
            ..Node::default()
        });
        joints.push(Joint {
            node: Some(index),
            node_from_mesh: DAffine3::from_translation(-DVec3::Y * step * index as f64),
        });
        let turn = |angle: f64| DQuat::from_euler(glam::EulerRot::XYZ, 0.4 * angle, 0.0, angle);
        scene.tracks.push(Track {
            targets: vec![Target::Node(index, NodeProperty::Rotation)],
            curve: Curve {
                times: vec![0.0, 0.5, 1.5, 2.0],
                values: Values::Rotation([0.0, 0.12, -0.12, 0.0].map(turn).into()),
                interpolation: Interpolation::Linear,
                easing: Easing::None,
                beyond: Beyond::Repeat,
            },
        });
    }
    let mut influences = Influences::default();
    for position in &mesh.positions {
        let at = f64::from(position.y) / step;
        let first = (at.floor() as usize).saturating_sub(1).min(JOINTS - 4);
        let near = (first..first + 4).map(|joint| {
            let distance = (at - joint as f64 - 0.5).abs();
            (joint as u32, (2.0 - distance).max(1e-3) as f32)
        });
        influences.push(near);
    }
    scene.deformations.push(Deformation {
        mesh: 0,
        targets: Arc::default(),
        weights: Vec::new(),
        skin: Some(Skin {
            joints,
            influences: influences.into(),
        }),
        flat: Arc::default(),
    });
    scene.meshes.push(mesh.into());
    scene.instances.push(Instance {
        mesh: 0,
        placement: DAffine3::IDENTITY,
        node: None,
        name: String::new(),
    });
    scene
}

impl Playing {
    /// Generates the scene.
    ///
    /// # Errors
    /// The scene cannot be packed.
    pub fn new(is_quick: bool) -> Result<Self, AppError> {
        let scene = figure();
        Ok(Self {
            packed: Arc::new(pack::scene(&scene)?),
            scene,
            frames: if is_quick { QUICK_FRAMES } else { FRAMES },
            still: Vec::new(),
            blurred: Vec::new(),
        })
    }

    /// Measures everything once more.
    ///
    /// # Errors
    /// The device failed.
    pub fn run(&mut self, gpu: &Gpu, arguments: &BenchArgs) -> Result<(), AppError> {
        let policy = storage::with_requested(job::policy(&arguments.device, false))?;
        let settings = RenderSettings {
            size: SIZE,
            ..RenderSettings::default()
        };
        for shutter in [0.0, 0.5] {
            let frames = |frame: u32| {
                let open = f64::from(frame) / FPS;
                self.scene.motion_samples(open, open + shutter / FPS)
            };
            let mut view = self.packed.view(&frames(0))?;
            let packed = self.packed.clone();
            let mut renderer = Renderer::new(gpu.clone(), packed, &view, settings.clone(), policy)?;
            while !renderer.is_done() {
                renderer.step()?;
            }
            let mut sum = Seconds::default();
            for frame in 1..=self.frames {
                let started = Instant::now();
                view = self.packed.view_from(Some(&view), &frames(frame))?;
                let deformed = started.elapsed().as_secs_f64();
                renderer.set_frame(&view)?;
                let uploaded = started.elapsed().as_secs_f64();
                while !renderer.is_done() {
                    renderer.step()?;
                }
                sum.deform += deformed;
                sum.upload += uploaded - deformed;
                sum.render += started.elapsed().as_secs_f64() - uploaded;
            }
            let count = f64::from(self.frames);
            let times = match shutter {
                0.0 => &mut self.still,
                _ => &mut self.blurred,
            };
            times.push(Seconds {
                deform: sum.deform / count,
                upload: sum.upload / count,
                render: sum.render / count,
            });
        }
        Ok(())
    }

    /// The figures of all repeats.
    pub fn row(&self) -> Row {
        Row {
            name: NAME,
            triangles: self.scene.triangle_count(),
            joints: JOINTS,
            width: SIZE.0,
            height: SIZE.1,
            still: Times::of(&self.still),
            blurred: Times::of(&self.blurred),
        }
    }
}

impl Times {
    fn of(all: &[Seconds]) -> Self {
        let figure = |value: fn(&Seconds) -> f64| Figure::of(all.iter().map(value));
        Self {
            deform_seconds: figure(|it| it.deform),
            upload_seconds: figure(|it| it.upload),
            render_seconds: figure(|it| it.render),
            frames_per_second: figure(|it| 1.0 / (it.deform + it.upload + it.render)),
        }
    }
}

impl Row {
    /// Lines for people.
    pub fn text(&self) -> String {
        let line = |what: &str, times: &Times| {
            format!(
                "{:<20} {what}: deform {:.4} s, upload {:.4} s, render {:.4} s, {:.1} frames/s\n",
                self.name,
                times.deform_seconds,
                times.upload_seconds,
                times.render_seconds,
                times.frames_per_second
            )
        };
        line("still", &self.still) + &line("blurred", &self.blurred)
    }
}
