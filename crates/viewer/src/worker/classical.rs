//! The scene that a picture shows.

use crate::worker::request::RenderRequest;
use glimray_scene::{ClassicalMaps, Scene};
use std::sync::Arc;

/// Scenes with the pictures that only the classical integrator needs: computed when it is chosen, as most scenes with
/// such materials are path-traced, and again after an edit where they differ.
#[derive(Debug, Default)]
pub struct ShownScenes {
    maps: ClassicalMaps,
    /// A scene without those pictures, and with them.
    last: Option<(Arc<Scene>, Arc<Scene>)>,
}

impl ShownScenes {
    /// The scene of `order` as its integrator shows it; the same one unless it lacks pictures.
    pub fn of(&mut self, request: &RenderRequest) -> Arc<Scene> {
        let scene = &request.scene;
        if !request.settings.integrator.is_classical() || !scene.lacks_classical_maps() {
            return scene.clone();
        }
        if let Some((from, shown)) = &self.last
            && Arc::ptr_eq(from, scene)
        {
            return shown.clone();
        }
        let mut shown = Scene::clone(scene);
        self.maps.bake(&mut shown);
        let shown = Arc::new(shown);
        self.last = Some((scene.clone(), shown.clone()));
        shown
    }
}
