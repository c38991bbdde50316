//! What of an order the renderer gets.

use super::super::super::overrides;
use super::super::order::Order;
use crate::pack::{self, PackedScene, PackedView};
use crate::scene::{Frame, Scene};
use std::sync::Arc;

/// The scene as the order's camera sees it.
pub fn seen(order: &Order) -> Arc<Scene> {
    let background = order.baked_background();
    if order.camera.is_none() && background.is_none() {
        return order.scene.clone();
    }
    let mut scene = Scene::clone(&order.scene);
    if let Some(camera) = &order.camera {
        overrides::see_by(&mut scene, camera);
    }
    if let Some(background) = background {
        scene.background = background.clone();
    }
    Arc::new(scene)
}

/// The frames with the order's camera and background.
pub fn view(
    packed: &PackedScene,
    frames: &[Frame],
    order: &Order,
) -> Result<PackedView, pack::PackError> {
    let background = order.baked_background();
    if order.camera.is_none() && background.is_none() {
        return packed.shot(frames);
    }
    let mut frames = frames.to_vec();
    for frame in &mut frames {
        if let Some(camera) = &order.camera {
            frame.camera = camera.clone();
        }
        if let Some(background) = background {
            frame.background = background.clone();
        }
    }
    packed.shot(&frames)
}
