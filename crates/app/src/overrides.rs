//! Overrides of a scene's values. The command line and the window fill them in.

use super::error::AppError;
pub use super::settings::PictureOverrides;
use glam::{DVec3, Vec3};
use glimray_render::{Integrator, Levels, Quantity, RenderSettings, Shows, Tone};
use glimray_scene::{
    Backdrop, Background, Camera, CameraProperty, OutputDefaults, Scene, Section, Shutter, Target,
    ToneCurve, Transfer,
};

/// Everything that a user may ask for. Values that are `None` are the scene's.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct RenderOverrides {
    /// How the picture is traced.
    pub picture: PictureOverrides,
    /// How it is developed.
    pub tone: ToneOverrides,
    /// From where.
    pub camera: CameraOverrides,
    /// When.
    pub moment: Moment,
    /// Frame rate and shutter.
    pub timing: TimingOverrides,
}

/// How a picture is developed.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct ToneOverrides {
    /// Exposure.
    pub exposure: Option<Exposure>,
    /// Tone curve.
    pub curve: Option<ToneCurve>,
    /// Transfer function.
    pub transfer: Option<Transfer>,
    /// Denoise the picture.
    pub denoise: Option<bool>,
}

/// An exposure as users give it.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Exposure {
    /// Whether it adds to one that makes the picture's average a medium grey.
    pub is_auto: bool,
    /// In stops.
    pub stops: f32,
}

/// The choice of a camera, and changes to it.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct CameraOverrides {
    /// A camera of the scene, by name or index.
    pub name: Option<String>,
    /// Vertical field of view in degrees; makes the camera a perspective one.
    pub fov_y_deg: Option<f64>,
    /// Height of the picture in scene units; makes the camera an orthographic one.
    pub orthographic_height: Option<f64>,
    /// Position in world space.
    pub look_from: Option<DVec3>,
    /// The point in the centre of the picture, in world space.
    pub look_at: Option<DVec3>,
    /// The direction that is up in the picture.
    pub up: Option<DVec3>,
    /// Background of rays that hit nothing.
    pub background: Option<BackgroundChoice>,
    /// The section plane.
    pub section: Option<SectionChoice>,
    /// Whether a background colour is seen by paths from the camera only, and an environment lights the scene.
    pub has_environment: bool,
}

/// Background of rays that hit nothing.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum BackgroundChoice {
    /// A linear radiance.
    Color(Vec3),
    /// See [`Backdrop::Transparent`].
    Transparent,
}

/// A section plane in place of the scene's, or none.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SectionChoice(pub Option<Section>);

/// A moment of an animation: a frame wins over a time.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Moment {
    /// Frame number.
    pub frame: Option<u32>,
    /// In seconds.
    pub time: Option<f64>,
}

/// Frame rate and shutter.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct TimingOverrides {
    /// Frames per second, greater than 0.
    pub fps: Option<f64>,
    /// When the shutter is open, in frames.
    pub shutter: Option<Shutter>,
}

impl PictureOverrides {
    /// The settings of a picture: the overrides, else the values of `scene`.
    pub fn settings(&self, scene: &OutputDefaults) -> RenderSettings {
        let integrator = self.integrator.unwrap_or(scene.integrator.into());
        let said = (scene.samples, scene.max_depth);
        let (samples, max_depth) =
            scene
                .integrator
                .converted(integrator.into(), said, scene.denoise);
        let usual = Tone::of_scene(scene, integrator);
        let filter = self.filter.unwrap_or(scene.filter);
        let mut settings = RenderSettings {
            integrator,
            features: self.denoise.unwrap_or(usual.denoise),
            ..RenderSettings::from(&OutputDefaults {
                samples: self.samples.unwrap_or(samples),
                max_depth,
                filter,
                // The scene's radius applies only to the scene's filter.
                filter_radius: scene.filter_radius.filter(|_| filter == scene.filter),
                ..scene.clone()
            })
        };
        self.apply(&mut settings);
        settings
    }
}

/// Width and height of the output: those of the crop, if there is one.
///
/// # Errors
/// The crop is not inside the picture.
pub fn picture_size(settings: &RenderSettings) -> Result<(u32, u32), AppError> {
    let (width, height) = settings.size;
    match settings.crop {
        None => Ok((width, height)),
        Some([x0, y0, x1, y1]) if x1 <= width && y1 <= height => Ok((x1 - x0, y1 - y0)),
        Some([.., x1, y1]) => Err(AppError::Usage(format!(
            "cannot crop (--crop): it ends at {x1},{y1}, outside of {width}×{height} pixels. \
             Choose a region inside the picture."
        ))),
    }
}

/// Number of BVH traversal steps that the heat view shows as white with `--exposure 0`.
const FULL_HEAT: f32 = 128.0;

impl ToneOverrides {
    /// The tone mapping of a picture of `integrator`. Without overrides, linear formats store the traced
    /// radiance, other formats use the scene's tone mapping, quantities are shown over the range found in
    /// the picture, and other debug views are not tone-mapped.
    pub fn tone(
        &self,
        scene: &OutputDefaults,
        integrator: Integrator,
        linear_format: bool,
    ) -> Tone {
        let shows = integrator.entry().shows;
        let usual = Tone::of_scene(scene, integrator);
        let default = if linear_format || shows != Shows::Radiance {
            Tone::LINEAR
        } else {
            usual
        };
        let exposure = self.exposure.unwrap_or(Exposure {
            is_auto: default.auto_exposure,
            stops: default.exposure_ev,
        });
        // A curve in place of the usual one leaves the transfer function to the scene.
        let is_other = self.curve.is_some_and(|curve| curve != default.curve);
        let transfer = match is_other && !linear_format && shows == Shows::Radiance {
            true => scene.transfer,
            false => default.transfer,
        };
        let tone = Tone {
            exposure_ev: exposure.stops,
            auto_exposure: exposure.is_auto && shows == Shows::Radiance,
            curve: self.curve.unwrap_or(default.curve),
            transfer: self.transfer.unwrap_or(transfer),
            levels: Levels::Raw,
            denoise: self.denoise.unwrap_or(usual.denoise),
        };
        match (shows, self.exposure) {
            _ if linear_format => tone,
            (Shows::Quantity(_), None) => Tone {
                levels: Levels::Found,
                ..tone
            },
            // Exposure scales the number of steps, not the colours.
            (Shows::Quantity(Quantity::Work), Some(exposure)) => Tone {
                exposure_ev: 0.0,
                levels: Levels::Fixed([0.0, FULL_HEAT * (-exposure.stops).exp2()]),
                ..tone
            },
            _ => tone,
        }
    }
}

impl CameraOverrides {
    /// Chooses and changes the scene's camera and background.
    ///
    /// # Errors
    /// There is no camera of that name, or the changed camera has no direction.
    pub fn apply(&self, scene: &mut Scene) -> Result<(), AppError> {
        if let Some(name) = &self.name {
            scene.camera_index = camera_index(&scene.cameras, name)?;
            scene.blind_cameras = 0;
        }
        match self.background {
            Some(BackgroundChoice::Transparent) => scene.output.backdrop = Backdrop::Transparent,
            Some(BackgroundChoice::Color(color)) if self.has_environment => {
                scene.output.backdrop = Backdrop::Color(color);
            }
            Some(BackgroundChoice::Color(color)) => scene.background = Background::Color(color),
            None => {}
        }
        if let Some(SectionChoice(section)) = self.section {
            scene.section = section;
        }
        let moved = self.look_from.or(self.look_at).or(self.up).is_some();
        if moved {
            let has_node = scene.cameras[scene.camera_index].node.is_some();
            for (property, flag) in [
                (CameraProperty::LookFrom, self.look_from),
                (CameraProperty::LookAt, self.look_at),
                (CameraProperty::Up, self.up),
            ] {
                // The tracks of a camera below a node are in the node's space, so none of them can remain.
                if has_node || flag.is_some() {
                    remove_track(scene, property);
                }
            }
            self.place(scene)?;
        }
        if let Some(degrees) = self.fov_y_deg {
            remove_track(scene, CameraProperty::FovY);
            let camera = &mut scene.cameras[scene.camera_index];
            camera.fov_y = degrees.to_radians();
            camera.orthographic_height = None;
        }
        if let Some(height) = self.orthographic_height {
            remove_track(scene, CameraProperty::OrthographicHeight);
            scene.cameras[scene.camera_index].orthographic_height = Some(height);
        }
        Ok(())
    }

    /// Places the camera in world space, detached from any node.
    fn place(&self, scene: &mut Scene) -> Result<(), AppError> {
        let start = scene.frame(0.0).camera;
        let camera = &mut scene.cameras[scene.camera_index];
        camera.look_from = self.look_from.unwrap_or(start.look_from);
        camera.look_at = self.look_at.unwrap_or(start.look_at);
        camera.up = self.up.unwrap_or(start.up);
        camera.node = None;
        camera.clip = Camera::UNCLIPPED;
        if self.look_at.is_some() {
            camera.target = None;
        }
        check(camera)
    }
}

/// Makes `camera`, in world space, the scene's camera, as overrides of all its properties would. A lens
/// that is animated stays.
pub fn set_camera(scene: &mut Scene, camera: &Camera) {
    for property in [
        CameraProperty::LookFrom,
        CameraProperty::LookAt,
        CameraProperty::Up,
        CameraProperty::FovY,
        CameraProperty::OrthographicHeight,
    ] {
        remove_track(scene, property);
    }
    let index = scene.camera_index;
    let is_lens = |target: &Target| {
        matches!(target, Target::Camera(of, CameraProperty::FocusDistance | CameraProperty::LensRadius)
            if *of == index)
    };
    let has_moving_lens = (scene.tracks.iter()).any(|track| track.targets.iter().any(is_lens));
    let current = &mut scene.cameras[index];
    *current = Camera {
        name: std::mem::take(&mut current.name),
        lens: if has_moving_lens {
            current.lens
        } else {
            camera.lens
        },
        node: None,
        target: None,
        ..camera.clone()
    };
}

/// Removes the track that drives this property of the current camera.
fn remove_track(scene: &mut Scene, property: CameraProperty) {
    let driven = Target::Camera(scene.camera_index, property);
    for track in &mut scene.tracks {
        track.targets.retain(|target| *target != driven);
    }
    scene.tracks.retain(|track| !track.targets.is_empty());
}

/// Finds a camera by name, else by number.
fn camera_index(cameras: &[Camera], name: &str) -> Result<usize, AppError> {
    let named = cameras.iter().position(|camera| camera.name == name);
    let numbered = || name.parse().ok().filter(|&index| index < cameras.len());
    named.or_else(numbered).ok_or_else(|| {
        let known: Vec<_> = (0..).zip(cameras).map(label).collect();
        AppError::Usage(format!(
            "no such camera (--camera {name}): the scene has {}. Choose one of them.",
            known.join(", ")
        ))
    })
}

/// How a camera is named in messages: by its number, and its name if it has one.
pub fn label((index, camera): (usize, &Camera)) -> String {
    if camera.name.is_empty() {
        index.to_string()
    } else {
        format!("{index} `{}`", camera.name)
    }
}

/// Checks that the camera has a viewing direction and an up direction that is not parallel to it.
fn check(camera: &Camera) -> Result<(), AppError> {
    // `why` begins with the flags and closes their bracket.
    let refused = |why| Err(AppError::Usage(format!("cannot place the camera ({why}.")));
    let forward = camera.look_at - camera.look_from;
    let scale = camera.look_at.length().max(camera.look_from.length());
    if forward.length() <= scale * f64::EPSILON {
        return refused("--look-from, --look-at): both are the same point. Move one of them");
    }
    let Some(up) = camera.up.try_normalize() else {
        return refused("--up): it has zero length. Choose a direction, such as 0,1,0");
    };
    if up.cross(forward.normalize()).length() < 1e-9 {
        return refused(
            "--up): it is parallel to the viewing direction. Choose another one, such as 0,0,1",
        );
    }
    Ok(())
}
