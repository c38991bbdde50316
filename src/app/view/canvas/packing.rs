//! What of an order the renderer gets.

use super::super::super::overrides;
use super::super::order::Order;
use crate::pack::{self, PackedScene, PackedView};
use crate::scene::{Frame, Scene};
use std::sync::Arc;

/// The scene as the order's camera sees it.
pub fn seen(order: &Order) -> Arc<Scene> {
    let Some(camera) = &order.camera else {
        return order.scene.clone();
    };
    let mut scene = Scene::clone(&order.scene);
    overrides::see_by(&mut scene, camera);
    Arc::new(scene)
}

/// The frames with the order's camera and background.
pub fn view(
    packed: &PackedScene,
    frames: &[Frame],
    order: &Order,
) -> Result<PackedView, pack::PackError> {
    if order.camera.is_none() && order.background.is_none() {
        return packed.shot(frames);
    }
    let mut frames = frames.to_vec();
    for frame in &mut frames {
        if let Some(camera) = &order.camera {
            frame.camera = camera.clone();
        }
        if let Some(background) = &order.background {
            frame.background = background.clone();
        }
    }
    packed.shot(&frames)
}
