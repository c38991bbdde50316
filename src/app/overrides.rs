//! Flags win over the scene file: what they change in a scene.

use super::cli::CameraFlags;
use super::error::AppError;
use crate::scene::{Background, Camera, CameraProperty, Scene, Target};

/// Chooses and changes the scene's camera and background as the flags say.
///
/// # Errors
/// There is no camera of that name, or the changed one looks nowhere.
pub fn apply(scene: &mut Scene, flags: &CameraFlags) -> Result<(), AppError> {
    if let Some(name) = &flags.camera {
        scene.camera_index = camera_index(&scene.cameras, name)?;
    }
    if let Some(background) = flags.background {
        scene.background = Background::Color(background);
    }
    let moved = flags.look_from.or(flags.look_at).or(flags.up).is_some();
    if moved {
        let carried = scene.cameras[scene.camera_index].node.is_some();
        for (property, flag) in [
            (CameraProperty::LookFrom, flags.look_from),
            (CameraProperty::LookAt, flags.look_at),
            (CameraProperty::Up, flags.up),
        ] {
            // What a carried camera's tracks say is in the space of what carries it.
            if carried || flag.is_some() {
                stop(scene, property);
            }
        }
        place(scene, flags)?;
    }
    if let Some(fov_y) = flags.fov_y {
        stop(scene, CameraProperty::FovY);
        let camera = &mut scene.cameras[scene.camera_index];
        camera.fov_y = fov_y.to_radians();
        camera.orthographic_height = None;
    }
    if let Some(height) = flags.orthographic {
        stop(scene, CameraProperty::OrthographicHeight);
        scene.cameras[scene.camera_index].orthographic_height = Some(height);
    }
    Ok(())
}

/// Makes `camera`, in the world, the one that the scene is seen by, as the flags for all of it would.
/// Its lens stays the scene's where that changes over time.
#[cfg(feature = "viewer")]
pub fn see_by(scene: &mut Scene, camera: &Camera) {
    for property in [
        CameraProperty::LookFrom,
        CameraProperty::LookAt,
        CameraProperty::Up,
        CameraProperty::FovY,
        CameraProperty::OrthographicHeight,
    ] {
        stop(scene, property);
    }
    let index = scene.camera_index;
    let is_lens = |target: &Target| {
        matches!(target, Target::Camera(of, CameraProperty::FocusDistance | CameraProperty::LensRadius)
            if *of == index)
    };
    let has_moving_lens = (scene.tracks.iter()).any(|track| track.targets.iter().any(is_lens));
    let seen_by = &mut scene.cameras[index];
    *seen_by = Camera {
        name: std::mem::take(&mut seen_by.name),
        lens: if has_moving_lens {
            seen_by.lens
        } else {
            camera.lens
        },
        node: None,
        target: None,
        ..camera.clone()
    };
}

/// Puts the camera where the flags say, in the world: whatever carried it goes on without it.
fn place(scene: &mut Scene, flags: &CameraFlags) -> Result<(), AppError> {
    let start = scene.frame(0.0).camera;
    let camera = &mut scene.cameras[scene.camera_index];
    camera.look_from = flags.look_from.unwrap_or(start.look_from);
    camera.look_at = flags.look_at.unwrap_or(start.look_at);
    camera.up = flags.up.unwrap_or(start.up);
    camera.node = None;
    if flags.look_at.is_some() {
        camera.target = None;
    }
    check(camera)
}

/// Takes away the track that drives this property of the camera in use.
fn stop(scene: &mut Scene, property: CameraProperty) {
    let driven = Target::Camera(scene.camera_index, property);
    for track in &mut scene.tracks {
        track.targets.retain(|target| *target != driven);
    }
    scene.tracks.retain(|track| !track.targets.is_empty());
}

/// By name, else by number.
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

fn label((index, camera): (usize, &Camera)) -> String {
    if camera.name.is_empty() {
        index.to_string()
    } else {
        format!("{index} `{}`", camera.name)
    }
}

/// A camera needs a direction to look in and an up direction beside it.
fn check(camera: &Camera) -> Result<(), AppError> {
    // `why` closes the bracket of the place it names.
    let refused = |why| Err(AppError::Usage(format!("cannot place the camera ({why}.")));
    let forward = camera.look_at - camera.look_from;
    let scale = camera.look_at.length().max(camera.look_from.length());
    if forward.length() <= scale * f64::EPSILON {
        return refused("--look-from, --look-at): both are the same point. Move one of them");
    }
    let Some(up) = camera.up.try_normalize() else {
        return refused("--up): it has no length. Give a direction, such as 0,1,0");
    };
    if up.cross(forward.normalize()).length() < 1e-9 {
        return refused("--up): it is the viewing direction. Give another one, such as 0,0,1");
    }
    Ok(())
}
