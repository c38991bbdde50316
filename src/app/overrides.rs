//! Applies camera and background flags to a scene.

use super::cli::CameraFlags;
use super::error::AppError;
use crate::scene::{Background, Camera, CameraProperty, Scene, Target};

/// Selects and changes the scene's camera and background as the flags say.
///
/// # Errors
/// There is no camera of that name, or the new camera has no valid orientation.
pub fn apply(scene: &mut Scene, flags: &CameraFlags) -> Result<(), AppError> {
    if let Some(name) = &flags.camera {
        scene.camera_index = camera_index(&scene.cameras, name)?;
    }
    if let Some(background) = flags.background {
        scene.background = Background::Color(background);
    }
    let moved = flags.look_from.or(flags.look_at).or(flags.up).is_some();
    if moved {
        let has_node = scene.cameras[scene.camera_index].node.is_some();
        for (property, flag) in [
            (CameraProperty::LookFrom, flags.look_from),
            (CameraProperty::LookAt, flags.look_at),
            (CameraProperty::Up, flags.up),
        ] {
            // The tracks of a camera below a node are in the node's space, so none of them can remain.
            if has_node || flag.is_some() {
                remove_track(scene, property);
            }
        }
        place(scene, flags)?;
    }
    if let Some(fov_y) = flags.fov_y {
        remove_track(scene, CameraProperty::FovY);
        let camera = &mut scene.cameras[scene.camera_index];
        camera.fov_y = fov_y.to_radians();
        camera.orthographic_height = None;
    }
    if let Some(height) = flags.orthographic {
        remove_track(scene, CameraProperty::OrthographicHeight);
        scene.cameras[scene.camera_index].orthographic_height = Some(height);
    }
    Ok(())
}

/// Replaces the scene's current camera by `camera`, given in world space, as all the camera flags together
/// would. An animated lens is kept.
#[cfg(feature = "viewer")]
pub fn see_by(scene: &mut Scene, camera: &Camera) {
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

/// Moves the camera as the flags say, in world space, and detaches it from its node.
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

fn label((index, camera): (usize, &Camera)) -> String {
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
