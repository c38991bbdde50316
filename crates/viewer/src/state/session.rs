//! The session: all state that outlives a lost device.

mod ball;
pub mod opening;
mod requests;
mod room;

use crate::model::bindings::{Action, Drag};
use crate::model::camera::{CameraController, CameraHistory};
use crate::model::document::Document;
use crate::model::loader::Loader;
use crate::model::messages::Messages;
use crate::model::objects;
use crate::model::objects::Id;
use crate::model::playback::Playback;
use crate::model::preferences::{Preferences, Store};
use crate::model::recording::InputRecording;
use crate::model::refinement::Refinement;
use crate::model::tool::{Tool, ToolState};
use crate::model::view_settings::{Comparison, ViewSettings};
use crate::model::viewport::{PixelZoom, Viewport};
use crate::state::answer::Answer;
use crate::state::comparing::Comparing;
use crate::state::cursor::Cursor;
use crate::state::dialogs::Dialogs;
use crate::state::editing::Editing;
use crate::state::files::Files;
use crate::state::histogram::HistogramView;
use crate::state::inspector::Inspector;
use crate::state::picture_menu::PictureMenu;
use crate::state::pixel_values::PixelValues;
use crate::state::sight::SightState;
use crate::state::time_left::TimeLeft;
use crate::state::walk::Walk;
use crate::worker::progressive_image::FrameRenderer;
use crate::worker::render_thread::Question;
use crate::worker::request::PreparedScene;
use ball::Ball;
use glam::DVec3;
use glimray_app::clock::Clock;
use glimray_app::error::AppError;
use glimray_app::showcase;
use glimray_app::window::ViewRequest;
use glimray_render::{Integrator, RenderSettings};
use glimray_scene::{Camera, Scene};
use room::{Fitted, Room};
use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::time::Duration;

/// Delay after the last motion before the full-resolution picture starts, in seconds.
const SETTLE: f64 = 0.12;

/// Minimum interval between frames during motion, and between polls of other threads.
const FRAME: Duration = Duration::from_millis(8);
const LOOK: Duration = Duration::from_millis(50);
/// The interval between polls for better BVHs and for jobs, which may take a while and need all cores.
const SLOW: Duration = Duration::from_millis(250);

/// The state of the window, except for GPU resources.
pub struct Session {
    /// The messages.
    pub messages: Messages,
    /// The preferences.
    pub preferences: Preferences,
    /// The settings file.
    pub store: Store,
    /// The edited scene; `None` before there is one.
    pub document: Option<Document>,
    /// The scene as read, without flags.
    pub original: Option<Arc<Scene>>,
    /// The scene's file; `None` for the demo and for a new scene.
    pub path: Option<PathBuf>,
    /// Whether the scene without a file is a new one and not the demo.
    pub is_untitled: bool,
    /// View settings.
    pub view: ViewSettings,
    /// The animation.
    pub playback: Playback,
    /// The interactive camera.
    pub controller: Option<CameraController>,
    /// The views that undo and redo of the camera lead to.
    pub camera_history: CameraHistory,
    /// The walk through the scene that goes on.
    pub walk: Option<Walk>,
    /// The active tool.
    pub tool: Tool,
    /// The state of tools.
    pub tool_state: ToolState,
    /// The open menu of a point of the picture.
    pub picture_menu: Option<PictureMenu>,
    /// The current drag in the picture.
    pub drag: Option<Drag>,
    /// The selection.
    pub selection: Option<Id>,
    /// Commands of clicked buttons, for the next frame.
    pub clicked: Vec<Action>,
    /// The viewport of the picture; `None` if it is hidden.
    pub viewport: Option<Viewport>,
    /// The pixel under the cursor.
    pub cursor: Cursor,
    /// The magnification of the picture.
    pub pixel_zoom: PixelZoom,
    /// Whether statistics are visible.
    pub shows_statistics: bool,
    /// Whether overlays are visible.
    pub shows_overlays: bool,
    /// The objects and distances that the pixels of the picture show.
    pub sight: SightState,
    /// The stills to compare with.
    pub comparing: Comparing,
    /// The comparison that a flip to a kept picture has replaced.
    pub(crate) unflipped: Option<Comparison>,
    /// The histogram of the picture.
    pub histogram: HistogramView,
    /// The time until the picture is done.
    pub time_left: TimeLeft,
    /// The values in magnified pixels.
    pub pixel_values: PixelValues,
    /// The state of files.
    pub files: Files,
    /// The state of editing.
    pub editing: Editing,
    /// The ray inspector.
    pub inspector: Inspector,
    /// The dialogs.
    pub dialogs: Dialogs,
    /// Recording or replay of input.
    pub recording: InputRecording,
    /// The arguments of the window; those for one scene are dropped with it.
    pub request: ViewRequest,
    /// Questions that wait for the render thread.
    pub questions: Vec<Question<Answer>>,
    pub(crate) loader: Option<Loader>,
    /// The packed scene as it was loaded or refined, until it is edited.
    pub(crate) prepared: Option<PreparedScene>,
    /// While better BVHs are built for a scene with drafts.
    pub(crate) refinement: Option<Refinement>,
    /// The scene that may be replaced by the one being opened.
    pub(crate) left: Option<Arc<Scene>>,
    /// Whether the pivot of the scene's camera waits for what the middle of the picture shows.
    pub(crate) owes_aim: bool,
    /// Number of restarts of the picture.
    pub(crate) restarts: u32,
    ball: Ball,
    room: Room,
    fitted: Option<Fitted>,
    /// Time of the last motion, and the current time of egui.
    pub(crate) last_motion: f64,
    pub(crate) now: f64,
    pub(crate) is_device_lost: bool,
    pub(crate) refusal: Option<String>,
}

impl Session {
    /// A session that is about to load its scene. `store` is the settings file.
    ///
    /// # Errors
    /// The built-in scene cannot be made.
    pub fn new(request: ViewRequest, mut store: Store) -> Result<Self, AppError> {
        let (preferences, notes) = store.load();
        let mut messages = Messages::default();
        notes.into_iter().for_each(|note| messages.warn(note));
        let demo = showcase::scene()?;
        let overrides = &request.overrides;
        let path = request.scene.clone();
        let mut session = Self {
            messages,
            preferences,
            store,
            view: ViewSettings::new(
                RenderSettings::default(),
                (overrides.tone).tone(&demo.output, Integrator::Whitted, false),
                overrides.picture.size.is_none(),
            ),
            playback: Playback::new(Clock::new(&demo.output, &overrides.timing), 0.0),
            document: None,
            original: None,
            path: None,
            is_untitled: false,
            controller: None,
            camera_history: CameraHistory::default(),
            walk: None,
            tool: Tool::default(),
            tool_state: ToolState::default(),
            picture_menu: None,
            drag: None,
            selection: None,
            clicked: Vec::new(),
            viewport: None,
            cursor: Cursor::default(),
            pixel_zoom: PixelZoom::default(),
            shows_statistics: true,
            shows_overlays: true,
            sight: SightState::default(),
            comparing: Comparing::default(),
            unflipped: None,
            histogram: HistogramView::default(),
            time_left: TimeLeft::default(),
            pixel_values: PixelValues::default(),
            files: Files::default(),
            editing: Editing::default(),
            inspector: Inspector::default(),
            dialogs: Dialogs::default(),
            recording: InputRecording::new(&request.recording)?,
            request,
            questions: Vec::new(),
            loader: None,
            prepared: None,
            refinement: None,
            left: None,
            owes_aim: false,
            restarts: 0,
            ball: Ball::default(),
            room: Room::default(),
            fitted: None,
            last_motion: f64::NEG_INFINITY,
            now: 0.0,
            is_device_lost: false,
            refusal: None,
        };
        match path {
            None => session.show(demo)?,
            Some(path) => session.load(path, false, true),
        }
        Ok(session)
    }

    /// Marks the picture as moving, so that previews are rendered for a while.
    pub fn moved(&mut self) {
        self.last_motion = self.now;
    }

    /// Whether the picture is moving.
    pub fn is_moving(&self) -> bool {
        self.now - self.last_motion < SETTLE || self.drag.is_some()
    }

    /// The current camera, in world space.
    pub fn camera(&self) -> Option<Camera> {
        self.controller.as_ref().map(CameraController::camera)
    }

    /// Restarts the picture.
    pub fn restart(&mut self) {
        self.restarts += 1;
    }

    /// Bounds of the scene, in world space.
    pub fn bounds(&self) -> Option<(DVec3, DVec3)> {
        self.scene().and_then(|scene| scene.bounds())
    }

    /// Bounds of the visible geometry, in world space.
    pub fn subject(&self) -> Option<(DVec3, DVec3)> {
        self.scene().and_then(|scene| objects::subject(scene))
    }

    /// All that is selected; [`Session::selection`] comes first.
    pub fn selected(&self) -> Vec<Id> {
        let Some(lead) = self.selection else {
            return Vec::new();
        };
        let group = self.editing.group.as_ref();
        let members = group
            .filter(|group| group.lead == lead)
            .map_or(&[][..], |group| &group.members);
        let others = members.iter().copied().filter(|id| *id != lead);
        std::iter::once(lead).chain(others).collect()
    }

    /// Whether something is selected, alone or among others.
    pub fn is_selected(&self, id: Id) -> bool {
        let group = self.editing.group.as_ref();
        let group = group.filter(|group| Some(group.lead) == self.selection);
        self.selection == Some(id) || group.is_some_and(|group| group.members.contains(&id))
    }

    /// Bounds of the selection, in world space.
    pub fn selection_bounds(&self) -> Option<(DVec3, DVec3)> {
        let (scene, time) = (self.scene()?, self.playback.time);
        (self.selected().into_iter())
            .filter_map(|id| objects::bounds(scene, id, time))
            .reduce(|a, b| (a.0.min(b.0), a.1.max(b.1)))
    }

    /// The edited scene; `None` before there is one.
    pub fn scene(&self) -> Option<&Arc<Scene>> {
        self.document.as_ref().map(Document::scene)
    }

    /// Whether there are unsaved changes.
    pub fn has_changes(&self) -> bool {
        self.document.as_ref().is_some_and(Document::is_changed)
    }

    /// Changes the scene in one step that can be undone.
    pub fn edit(&mut self, name: &str, change: impl FnOnce(&mut Scene)) {
        if let Some(document) = &mut self.document {
            document.edit(name, change);
        }
    }

    /// Sends a question to the render thread as soon as there is a picture.
    pub fn ask(&mut self, question: impl FnOnce(&mut FrameRenderer) -> Answer + Send + 'static) {
        self.questions.push(Box::new(question));
    }

    /// The size of the picture, in pixels.
    pub fn picture_size(&self) -> (u32, u32) {
        self.view
            .settings_in(self.room.taken, Integrator::Whitted)
            .size
    }

    /// Width of the picture over its height.
    pub fn aspect(&self) -> f64 {
        let (width, height) = self.picture_size();
        f64::from(width) / f64::from(height.max(1))
    }

    /// Status text of a window without a picture.
    pub fn waiting_for(&self) -> String {
        match &self.loader {
            Some(loader) => format!("Loading {}", loader.path.display()),
            None if self.document.is_none() => "No scene is open".into(),
            None => "Preparing".into(),
        }
    }

    /// Whether no scene is open or loading.
    pub fn is_empty(&self) -> bool {
        self.document.is_none() && self.loader.is_none()
    }

    /// The name of the scene.
    pub fn title(&self) -> String {
        let name = self.path.as_deref().and_then(Path::file_name);
        match name {
            Some(name) => name.to_string_lossy().into_owned(),
            None if self.is_untitled => "untitled".to_owned(),
            None => "demo".to_owned(),
        }
    }

    /// Whether nothing is moving or loading.
    pub fn is_at_rest(&self) -> bool {
        self.loader.is_none()
            && self.refinement.is_none()
            && self.questions.is_empty()
            && !self.files.is_busy()
            && self.files.shown_in_folder.is_none()
            && !self.files.jobs.is_busy()
            && !self.comparing.is_busy()
            && !self.is_moving()
            && self.until_fitted().is_none()
            && !self.playback.is_playing
            && !self.recording.is_playing()
    }

    /// How long the window may sleep before something happens; `None` until there is input or another thread
    /// wakes it. On software, each unnecessary frame delays the next useful one.
    pub fn until_next_frame(&self) -> Option<Duration> {
        let glides = self
            .controller
            .as_ref()
            .is_some_and(CameraController::is_moving);
        if glides
            || self.playback.is_playing
            || self.recording.is_playing()
            || !self.questions.is_empty()
            || !self.clicked.is_empty()
        {
            return Some(FRAME);
        }
        if self.loader.is_some() || self.files.is_busy() || self.comparing.is_busy() {
            return Some(LOOK);
        }
        if let Some(seconds) = self.until_fitted() {
            return Some(Duration::from_secs_f64(seconds.max(0.0)).max(FRAME));
        }
        // Not while a button is held.
        let settles = self.last_motion + SETTLE - self.now;
        if settles > 0.0 && self.drag.is_none() {
            return Some(Duration::from_secs_f64(settles.min(SETTLE)).max(FRAME));
        }
        (self.refinement.is_some() || self.files.jobs.is_busy()).then_some(SLOW)
    }

    /// Requests that the window is opened again on a new device.
    pub fn lost_device(&mut self) {
        self.is_device_lost = true;
    }

    /// Whether the window must be opened again.
    pub fn is_device_lost(&self) -> bool {
        self.is_device_lost
    }

    /// Whether the window must be opened again; clears the request.
    pub fn is_to_reopen(&mut self) -> bool {
        std::mem::take(&mut self.is_device_lost)
    }

    /// Sets the render error; `None` if rendering works.
    pub fn refused(&mut self, why: Option<String>) {
        if self.refusal != why {
            if let Some(why) = &why {
                self.messages.warn(why.clone());
            }
            self.refusal = why;
        }
    }
}
