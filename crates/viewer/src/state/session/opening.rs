//! Loads a scene and shows it.

use crate::model::camera::{CameraController, CameraHistory};
use crate::model::document::Document;
use crate::model::loader::{Imported, Loader, Trouble};
use crate::model::messages::sentence;
use crate::model::playback::Playback;
use crate::model::refinement::{Refined, Refinement};
use crate::model::tool::ToolState;
use crate::model::view_settings::ViewSettings;
use crate::state::files::Intent;
use crate::state::session::Session;
use crate::state::session::room::Fitted;
use crate::worker::request::PreparedScene;
use glimray_app::clock::Clock;
use glimray_app::error::AppError;
use glimray_app::new_scene;
use glimray_app::overrides::{CameraOverrides, Moment, picture_size};
use glimray_app::showcase;
use glimray_io::import::Options;
use glimray_render::RenderSettings;
use glimray_render::pack::PackedScene;
use glimray_scene::{Camera, Scene};
use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::time::SystemTime;

/// Least samples per pixel that the window aims at where the scene does not set them: the picture refines
/// while it is watched, so more cost nothing.
const SAMPLES: u32 = 64;

/// The key of bookmarks of a new scene, until it is saved. No file has this name.
pub(crate) const UNTITLED: &str = "/glimray untitled/";

/// Samples per pixel that the window aims at for a scene. A count equal to the scene's default counts as
/// not set, as it does when the scene is saved.
pub fn samples_of(scene: &Scene) -> u32 {
    let samples = scene.output.samples;
    match samples == scene.default_samples() {
        true => samples.max(SAMPLES),
        false => samples,
    }
}

/// The result of loading a scene.
pub struct Opened {
    /// The scene's file.
    pub path: PathBuf,
    /// Whether it is a reload.
    pub again: bool,
    /// The scene's file and the files that it refers to, as far as known.
    pub files: Vec<PathBuf>,
    /// When loading started.
    pub began: SystemTime,
    /// Whether it is shown, or why not.
    pub shown: Result<(), Trouble>,
}

/// Forgets what was chosen in a file, and changed of it.
pub fn forget_parts(options: &mut Options) {
    options.overrides.clear();
    options.scene = None;
    options.clip = None;
    options.variant = None;
}

impl Session {
    /// Starts to load a scene; the current one stays until it is ready.
    pub fn open(&mut self, path: PathBuf) {
        self.left = self.scene().cloned();
        self.open_instead(path);
    }

    /// Starts to load another scene in place of one that cannot be read.
    pub fn open_instead(&mut self, path: PathBuf) {
        let is_own = self.path.as_ref() == Some(&path);
        self.load(path, false, is_own);
    }

    /// Whether another scene is loading.
    pub fn is_opening(&self) -> bool {
        self.loader.as_ref().is_some_and(|loader| !loader.again)
    }

    /// Reloads the current scene; camera, view settings and time are kept.
    pub fn reload(&mut self) {
        if let Some(path) = self.path.clone() {
            self.load(path, true, true);
        }
    }

    /// `is_own`: whether the flags of the command line apply to this scene.
    pub(super) fn load(&mut self, path: PathBuf, again: bool, is_own: bool) {
        let mut options = self.request.import.clone();
        if !is_own {
            forget_parts(&mut options);
        }
        // An empty file that was shown before is still being written.
        if again {
            options.instead_of_empty = None;
        }
        match Loader::new(path, options, again) {
            Ok(mut loader) => {
                loader.is_own = is_own;
                self.loader = Some(loader);
            }
            Err(error) => self
                .messages
                .warn(format!("Cannot read the scene: {error}.")),
        }
    }

    /// Shows the built-in scene, without what the command line says of another one.
    ///
    /// # Errors
    /// The built-in scene is broken.
    pub fn show_built_in(&mut self) -> Result<(), AppError> {
        self.forget_scene_overrides();
        self.show(showcase::scene()?)
    }

    /// Shows a new scene without a file.
    ///
    /// # Errors
    /// The new scene is broken.
    pub fn show_new(&mut self) -> Result<(), AppError> {
        self.forget_scene_overrides();
        self.show(new_scene::scene()?)?;
        self.is_untitled = true;
        // Bookmarks of the last new scene are not for this one.
        let key = Path::new(UNTITLED);
        for camera in self.preferences.cameras_of(key).to_vec() {
            self.preferences.remove_camera(key, &camera.name);
        }
        Ok(())
    }

    /// Shows a loaded scene with its own camera and settings.
    pub(super) fn show(&mut self, original: Scene) -> Result<(), AppError> {
        self.refinement = None;
        self.is_untitled = false;
        let mut scene = original.clone();
        self.request.overrides.camera.apply(&mut scene)?;
        let settings = self.settings_of(&scene);
        let overrides = &self.request.overrides;
        let mut tone = (overrides.tone).tone(&scene.output, settings.integrator, false);
        if let (None, Some(curve)) = (overrides.tone.curve, self.preferences.tone) {
            tone.curve = curve;
        }
        self.view = ViewSettings::new(settings, tone, overrides.picture.size.is_none());
        self.crop();
        let clock = Clock::new(&scene.output, &self.request.overrides.timing);
        let time = clock.time(&self.request.overrides.moment);
        self.playback = Playback::new(clock, time);
        self.playback.set_scene(&scene);
        let (bounds, has_aim) = (
            scene.bounds(),
            (scene.cameras.get(scene.camera_index)).is_none_or(Camera::has_aim),
        );
        self.select(Vec::new());
        let editing = &mut self.editing;
        (editing.renaming, editing.grip, editing.modal) = (None, None, None);
        (editing.lamp, editing.section, editing.aimed) = (None, None, None);
        editing.dropping = None;
        editing.lit = None;
        if let Some(warning) = editing.darkness.take() {
            self.messages.dismiss(&sentence(warning));
        }
        self.histogram.forget();
        self.tool_state = ToolState::default();
        self.sight.boxed = None;
        let inspector = std::mem::take(&mut self.inspector);
        // A pending export belongs to rays of the previous scene.
        self.inspector.export = inspector.export;
        let original = Arc::new(original);
        let size = (self.request.import.size).unwrap_or(original.output.size);
        self.fitted = Fitted::new(&original, &scene, size);
        self.original = Some(original);
        self.document = Some(Document::new(scene));
        self.fit_camera();
        self.owes_aim = !has_aim;
        self.camera_history = CameraHistory::default();
        self.walk = None;
        self.controller = self.home_camera().map(|camera| match has_aim {
            true => CameraController::new(&camera, bounds),
            false => CameraController::without_aim(&camera, bounds),
        });
        Ok(())
    }

    /// Turns a crop of the command line into a region, which can be edited and cleared.
    fn crop(&mut self) {
        let size = self.view.settings.size;
        let crop = self.request.overrides.picture.crop.flatten();
        let settings = RenderSettings {
            crop,
            size,
            ..RenderSettings::default()
        };
        if let Err(error) = picture_size(&settings) {
            self.messages.warn(error.to_string());
            return;
        }
        let lengths = [size.0, size.1, size.0, size.1].map(f64::from);
        self.view.region =
            crop.map(|edges| std::array::from_fn(|edge| f64::from(edges[edge]) / lengths[edge]));
    }

    /// The initial view settings of a scene: flags override preferences, which override the scene.
    fn settings_of(&self, scene: &Scene) -> RenderSettings {
        let picture = &self.request.overrides.picture;
        let mut output = scene.output.clone();
        output.samples = self.preferences.samples.unwrap_or(samples_of(scene));
        RenderSettings {
            // The crop becomes a region.
            crop: None,
            ..picture.settings(&output)
        }
    }

    /// Flags of one scene do not apply to another.
    fn forget_scene_overrides(&mut self) {
        let request = &mut self.request;
        request.overrides.camera = CameraOverrides::default();
        request.overrides.moment = Moment::default();
        forget_parts(&mut request.import);
    }

    /// Shows a scene that has finished loading. `actions::files` handles the result.
    pub fn take_scene(&mut self) -> Option<Opened> {
        let loaded = self.loader.as_mut().and_then(Loader::poll)?;
        let loader = self.loader.take()?;
        let Loader {
            path,
            again,
            is_own,
            ..
        } = loader;
        if loaded.outcome.is_ok() && !again && self.has_more_changes() {
            self.files.undecided = Some(Intent::Open(path));
            return None;
        }
        if loaded.outcome.is_ok() && !is_own {
            self.forget_scene_overrides();
        }
        let shown = loaded.outcome.and_then(|Imported { scene, packed }| {
            let shown = match again {
                true => self.show_again(scene),
                false => self.show(scene),
            };
            shown.map_err(|error| Trouble::from(error.to_string()))?;
            if packed.is_draft() {
                self.refine(packed.clone());
            }
            // The camera of the command line changes nothing that is packed.
            self.prepared = (self.scene().cloned()).map(|scene| PreparedScene { scene, packed });
            Ok(())
        });
        Some(Opened {
            path,
            again,
            files: loaded.files,
            began: loaded.began,
            shown,
        })
    }

    /// Stops loading and keeps the current scene. Returns the file that was loading.
    pub fn cancel_loading(&mut self) -> Option<PathBuf> {
        self.left = None;
        self.loader.take().map(|loader| loader.path)
    }

    /// Starts to replace the drafts of the current scene.
    fn refine(&mut self, draft: Arc<PackedScene>) {
        let scene = self.scene().cloned();
        // Without a thread the scene stays with its drafts.
        self.refinement = scene.and_then(|scene| Refinement::new(scene, draft).ok());
    }

    /// Takes the packed scene once its BVHs are no longer drafts, and nothing moves that would have to wait for the upload.
    pub fn take_refined(&mut self) {
        if self.is_moving() {
            return;
        }
        let refined = match self.refinement.as_mut().map(Refinement::poll) {
            None | Some(Refined::NotYet) => return,
            Some(Refined::Never) => None,
            Some(Refined::Scene(refined)) => Some(refined),
        };
        self.refinement = None;
        if let (Some(refined), Some(scene)) = (refined, self.scene()) {
            match refined.packed(scene) {
                Some(_) => self.prepared = Some(refined),
                // The scene was edited meanwhile. Little is left to do for its current state.
                None => self.refine(refined.packed),
            }
        }
    }

    /// The packed scene as it was loaded or refined, until it is edited.
    pub fn prepared_scene(&self) -> Option<&Arc<PackedScene>> {
        self.prepared.as_ref().map(|prepared| &prepared.packed)
    }

    /// Frees the packed scene once an edit has replaced its scene.
    pub fn drop_outdated(&mut self) {
        let scene = self.document.as_ref().map(Document::scene);
        (self.prepared).take_if(|it| scene.is_none_or(|scene| it.packed(scene).is_none()));
    }

    /// Whether the current scene has been edited since another one started to load: the user was not asked
    /// about those changes.
    fn has_more_changes(&mut self) -> bool {
        let left = self.left.take();
        let is_left = |scene: &Arc<Scene>| left.as_ref().is_some_and(|l| Arc::ptr_eq(l, scene));
        self.has_changes() && !self.scene().is_some_and(is_left)
    }

    /// Shows a reloaded scene. The user's choices stay, and the scene's own values are updated.
    fn show_again(&mut self, scene: Scene) -> Result<(), AppError> {
        let (Some(before), Some(mut controller)) = (self.original.clone(), self.controller.clone())
        else {
            return self.show(scene);
        };
        let (look, playback) = (self.view.clone(), self.playback.clone());
        let document = self.document.clone();
        let history = std::mem::take(&mut self.camera_history);
        // A warning that was read does not come back while it applies.
        let darkness = self.editing.darkness.take();
        let shown = self.show(scene);
        self.editing.darkness = darkness;
        shown?;
        self.camera_history = history;
        let clock = self.playback.clock;
        self.playback = playback;
        self.playback.clock = clock;
        if let (Some(scene), Some(mut document)) = (self.scene().cloned(), document) {
            self.playback.set_scene(&scene);
            controller.set_bounds(scene.bounds());
            // Earlier steps can still be undone.
            document.reload(Scene::clone(&scene));
            self.document = Some(document);
        }
        if let Some(home) = self.home_camera() {
            controller.set_home(&home);
        }
        self.controller = Some(controller);
        let own = std::mem::replace(&mut self.view, look);
        let integrator = self.view.settings.integrator;
        let in_view_mode = |settings| RenderSettings {
            integrator,
            ..settings
        };
        if self.view.settings == in_view_mode(self.settings_of(&before)) {
            self.view.settings = in_view_mode(own.settings);
        }
        if self.view.tone == self.view.scene_tone {
            self.view.tone = own.tone;
        }
        self.view.scene_tone = own.scene_tone;
        Ok(())
    }
}
