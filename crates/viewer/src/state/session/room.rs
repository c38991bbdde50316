//! The size of the picture panel. A picture in progress keeps its size while the panel changes, and is rendered anew once
//! the size is quiet. The camera of a model whose file has none follows the size.

use crate::state::session::Session;
use crate::worker::request::RenderRequest;
use glimray_io::import;
use glimray_scene::{Camera, Scene};
use std::sync::Arc;

/// Seconds of tracing beyond which a resize does not restart the picture.
const WORTH_KEEPING: f64 = 2.0;

/// Seconds without a change of size after which a scaled picture is rendered anew.
const QUIET: f64 = 0.5;

/// The size of the panel, and the size that the picture uses.
#[derive(Default)]
pub(super) struct Room {
    /// The size of the current picture, in pixels.
    pub taken: (u32, u32),
    /// The size of the panel, in pixels.
    available: (u32, u32),
    /// When that changed last, in egui's time.
    changed: f64,
    /// The picture's last request.
    requested: Option<RenderRequest>,
    /// The picture's seconds of tracing so far.
    spent: f64,
}

/// A camera that frames a model, and its counterpart for the picture in the window.
pub(super) struct Fitted {
    /// The scene as imported.
    scene: Arc<Scene>,
    /// The scene's own camera, for a picture of the scene's size.
    own: Camera,
    /// The camera for a picture of that size in the window.
    fitted: Option<((u32, u32), Camera)>,
}

impl Fitted {
    /// `None` if the file gave the camera, or the command line changed it.
    pub fn new(original: &Arc<Scene>, scene: &Scene, size: (u32, u32)) -> Option<Self> {
        let own = scene.cameras.get(scene.camera_index)?;
        let is_same = original.cameras.get(original.camera_index) == Some(own);
        (is_same && import::is_framed(original, size)).then(|| Self {
            scene: original.clone(),
            own: own.clone(),
            fitted: None,
        })
    }

    fn fit(&mut self, size: Option<(u32, u32)>) {
        self.fitted = size.map(|size| {
            let name = self.own.name.clone();
            let camera = import::framed_camera(&self.scene, size);
            (size, Camera { name, ..camera })
        });
    }
}

impl Session {
    /// The camera that Home returns to, in world space: the scene's own, or where that frames a model, one that frames it in the
    /// window.
    pub fn home_camera(&self) -> Option<Camera> {
        let scene = self.scene()?;
        let fitted = self.fitted_camera().cloned();
        Some(fitted.unwrap_or_else(|| scene.frame(self.playback.time).camera))
    }

    /// The camera that takes the place of the scene's own in the window.
    fn fitted_camera(&self) -> Option<&Camera> {
        let (scene, fitted) = (self.scene()?, self.fitted.as_ref()?);
        let is_own = scene.cameras.get(scene.camera_index) == Some(&fitted.own);
        fitted
            .fitted
            .as_ref()
            .filter(|_| is_own)
            .map(|(_, camera)| camera)
    }

    /// Whether Home in the window is another camera than that of the scene.
    pub fn is_fitted(&self) -> bool {
        self.fitted_camera().is_some()
    }

    /// Fits the camera of a model to the picture in the window.
    pub(super) fn fit_camera(&mut self) {
        let size = Some(self.room.taken).filter(|(width, height)| *width > 0 && *height > 0);
        let size = size.filter(|_| self.view.fits);
        let Some(fitted) = &mut self.fitted else {
            return;
        };
        if fitted.fitted.as_ref().map(|(size, _)| *size) == size {
            return;
        }
        fitted.fit(size);
        if let (Some(home), Some(controller)) = (self.home_camera(), &mut self.controller) {
            controller.set_home(&home);
        }
    }

    /// Sets the seconds of tracing so far; 0 for a preview.
    pub fn set_spent(&mut self, seconds: f64) {
        self.room.spent = seconds;
    }

    /// Sets the size of the panel, in pixels. A picture that fits the panel adopts it when it starts, if restarting loses
    /// little, or once the size is quiet; until then it is scaled.
    pub fn set_space(&mut self, pixels: (u32, u32)) {
        if self.room.available != pixels {
            self.room.available = pixels;
            self.room.changed = self.now;
        }
        let is_due = self.is_to_fit() && self.quiet_in() <= 0.0;
        if self.room.taken != pixels && (is_due || !self.is_worth_keeping()) {
            self.room.taken = pixels;
        }
        self.fit_camera();
        self.room.requested = self.render_request(self.view.settings.integrator);
    }

    /// Whether the picture keeps its samples and is scaled to the room that there is now.
    pub fn is_scaled_to_room(&self) -> bool {
        self.view.fits && self.room.taken != self.room.available
    }

    /// Seconds until a scaled picture is rendered anew; `None` if it is hidden, or is not to be: one that is paused, or that will
    /// be saved when it is finished, keeps its samples.
    pub fn until_fitted(&self) -> Option<f64> {
        (self.viewport.is_some() && self.is_to_fit()).then(|| self.quiet_in())
    }

    fn is_to_fit(&self) -> bool {
        let goes_on = !self.view.paused && self.files.jobs.waiting().is_none();
        self.is_scaled_to_room() && goes_on
    }

    /// Seconds until the size has been quiet for long enough.
    fn quiet_in(&self) -> f64 {
        self.room.changed + QUIET - self.now
    }

    /// Begins the picture again, as large as there is room for now.
    pub fn take_room(&mut self) {
        self.room.taken = self.room.available;
    }

    fn is_worth_keeping(&self) -> bool {
        let request = self.render_request(self.view.settings.integrator);
        let goes_on = (self.room.requested.as_ref().zip(request.as_ref()))
            .is_some_and(|(last, now)| last.shows_same(now) && last.settings == now.settings);
        goes_on && self.view.fits && self.room.spent >= WORTH_KEEPING
    }
}
