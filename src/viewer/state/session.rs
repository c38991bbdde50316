//! What the person works on: everything that outlives a lost device.

pub mod opening;
mod orders;
mod room;

use crate::app::clock::Clock;
use crate::app::error::AppError;
use crate::app::showcase;
use crate::app::window::ViewRequest;
use crate::render::{Integrator, RenderSettings};
use crate::scene::{Camera, Scene};
use crate::viewer::model::bindings::Action;
use crate::viewer::model::camera::CameraController;
use crate::viewer::model::document::Document;
use crate::viewer::model::loader::Loader;
use crate::viewer::model::messages::Messages;
use crate::viewer::model::objects;
use crate::viewer::model::objects::Id;
use crate::viewer::model::playback::Playback;
use crate::viewer::model::preferences::{Preferences, Store};
use crate::viewer::model::recording::InputRecording;
use crate::viewer::model::tool::{Drag, Tool};
use crate::viewer::model::view_settings::ViewSettings;
use crate::viewer::model::viewport::{PixelZoom, Viewport};
use crate::viewer::state::answer::Answer;
use crate::viewer::state::cursor::Cursor;
use crate::viewer::state::dialogs::Dialogs;
use crate::viewer::state::editing::Editing;
use crate::viewer::state::files::Files;
use crate::viewer::state::inspector::Inspector;
use crate::viewer::worker::progressive_image::FrameRenderer;
use crate::viewer::worker::render_thread::Question;
use glam::DVec3;
use room::Room;
use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::time::Duration;

/// Seconds after the last movement until the picture is made in full.
const SETTLE: f64 = 0.12;

/// The shortest time between two frames that something moves in, and between two looks at what others do.
const FRAME: Duration = Duration::from_millis(8);
const LOOK: Duration = Duration::from_millis(50);

/// Everything about the window but what is on the GPU.
pub struct Session {
    /// What there is to tell.
    pub messages: Messages,
    /// What is kept between runs.
    pub preferences: Preferences,
    /// Where it is kept.
    pub store: Store,
    /// The scene as it is edited; `None` before there is one.
    pub document: Option<Document>,
    /// As it was read, no flags applied.
    pub original: Option<Arc<Scene>>,
    /// The scene's file; `None` for the demo.
    pub path: Option<PathBuf>,
    /// How the picture is made.
    pub view: ViewSettings,
    /// When it is.
    pub playback: Playback,
    /// The camera under the person's hands.
    pub controller: Option<CameraController>,
    /// What a click in the picture does.
    pub tool: Tool,
    /// What the mouse drags in the picture.
    pub drag: Option<Drag>,
    /// What is selected.
    pub selection: Option<Id>,
    /// Commands that clicks gave, for the next frame.
    pub clicked: Vec<Action>,
    /// Where the picture is in the window; `None` where it is not to be seen.
    pub viewport: Option<Viewport>,
    /// The pixel under the cursor.
    pub cursor: Cursor,
    /// The magnification of the picture.
    pub pixel_zoom: PixelZoom,
    /// Whether the figures of the render are to be seen.
    pub shows_statistics: bool,
    /// Whether anything is drawn over the picture.
    pub shows_overlays: bool,
    /// What the window has to do with files.
    pub files: Files,
    /// What is being changed.
    pub editing: Editing,
    /// The rays of a pixel.
    pub inspector: Inspector,
    /// What lies over the window.
    pub dialogs: Dialogs,
    /// What the person does, recorded or played.
    pub recording: InputRecording,
    /// What the window was opened with; what it says of one scene is dropped with that scene.
    pub request: ViewRequest,
    /// Questions that wait for the render thread.
    pub questions: Vec<Question<Answer>>,
    pub(in crate::viewer) loader: Option<Loader>,
    /// The scene that may be lost to the one that is being opened.
    pub(in crate::viewer) left: Option<Arc<Scene>>,
    /// How often the picture was started over.
    pub(in crate::viewer) restarts: u32,
    room: Room,
    /// When something moved last, in egui's time; and what egui's time is.
    pub(in crate::viewer) last_motion: f64,
    pub(in crate::viewer) now: f64,
    pub(in crate::viewer) is_device_lost: bool,
    pub(in crate::viewer) refusal: Option<String>,
}

impl Session {
    /// A session that is about to read its scene. `store` is where preferences are.
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
            controller: None,
            tool: Tool::default(),
            drag: None,
            selection: None,
            clicked: Vec::new(),
            viewport: None,
            cursor: Cursor::default(),
            pixel_zoom: PixelZoom::default(),
            shows_statistics: true,
            shows_overlays: true,
            files: Files::default(),
            editing: Editing::default(),
            inspector: Inspector::default(),
            dialogs: Dialogs::default(),
            recording: InputRecording::new(&request.recording)?,
            request,
            questions: Vec::new(),
            loader: None,
            left: None,
            restarts: 0,
            room: Room::default(),
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

    /// Tells that the picture is changing, and so is coarse for a while.
    pub fn moved(&mut self) {
        self.last_motion = self.now;
    }

    /// Whether the picture is changing.
    pub fn is_moving(&self) -> bool {
        self.now - self.last_motion < SETTLE || self.drag.is_some()
    }

    /// The camera that the picture is seen by, in the world.
    pub fn camera(&self) -> Option<Camera> {
        self.controller.as_ref().map(CameraController::camera)
    }

    /// Starts the picture over.
    pub fn restart(&mut self) {
        self.restarts += 1;
    }

    /// Bounds of all there is, in the world.
    pub fn bounds(&self) -> Option<(DVec3, DVec3)> {
        self.scene().and_then(|scene| scene.bounds())
    }

    /// Bounds of what there is to look at, in the world.
    pub fn subject(&self) -> Option<(DVec3, DVec3)> {
        self.scene().and_then(|scene| objects::subject(scene))
    }

    /// Bounds of what is selected, in the world.
    pub fn selection_bounds(&self) -> Option<(DVec3, DVec3)> {
        objects::bounds(self.scene()?, self.selection?, self.playback.time)
    }

    /// The scene as it is edited; `None` before there is one.
    pub fn scene(&self) -> Option<&Arc<Scene>> {
        self.document.as_ref().map(Document::scene)
    }

    /// Whether there are changes that are in no file.
    pub fn has_changes(&self) -> bool {
        self.document.as_ref().is_some_and(Document::is_changed)
    }

    /// Changes the scene, as one step that can be undone.
    pub fn edit(&mut self, name: &str, change: impl FnOnce(&mut Scene)) {
        if let Some(document) = &mut self.document {
            document.edit(name, change);
        }
    }

    /// Asks the render thread for something as soon as there is a picture.
    pub fn ask(&mut self, question: impl FnOnce(&mut FrameRenderer) -> Answer + Send + 'static) {
        self.questions.push(Box::new(question));
    }

    /// The size of the picture, in pixels.
    pub fn picture_size(&self) -> (u32, u32) {
        self.view
            .settings_in(self.room.taken, Integrator::Whitted)
            .size
    }

    /// What a window without a picture waits for.
    pub fn waiting_for(&self) -> String {
        match &self.loader {
            Some(loader) => format!("reading {}", loader.path.display()),
            None if self.document.is_none() => "no scene is open".into(),
            None => "preparing".into(),
        }
    }

    /// Whether there is no scene, and none is being read.
    pub fn is_empty(&self) -> bool {
        self.document.is_none() && self.loader.is_none()
    }

    /// The name of what is on screen.
    pub fn title(&self) -> String {
        let name = self.path.as_deref().and_then(Path::file_name);
        name.map_or("demo".into(), |name| name.to_string_lossy().into_owned())
    }

    /// Whether nothing moves and nothing is being read.
    pub fn is_at_rest(&self) -> bool {
        self.loader.is_none()
            && self.questions.is_empty()
            && !self.files.is_busy()
            && !self.is_moving()
            && !self.playback.is_playing
            && !self.recording.is_playing()
    }

    /// How long the window may sleep before something happens by itself; `None` until a person or another
    /// thread wakes it. On software each frame that shows nothing new delays the one that does.
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
        if self.loader.is_some() || self.files.is_busy() {
            return Some(LOOK);
        }
        // Nothing settles while a button is held.
        let settles = self.last_motion + SETTLE - self.now;
        let is_due = settles > 0.0 && self.drag.is_none();
        is_due.then(|| Duration::from_secs_f64(settles.min(SETTLE)).max(FRAME))
    }

    /// Notes that the window must be opened again on another device.
    pub fn lost_device(&mut self) {
        self.is_device_lost = true;
    }

    /// Whether it must.
    pub fn is_device_lost(&self) -> bool {
        self.is_device_lost
    }

    /// Whether it must; asked once.
    pub fn is_to_reopen(&mut self) -> bool {
        std::mem::take(&mut self.is_device_lost)
    }

    /// Notes why what is wanted cannot be rendered; `None` while it can.
    pub fn refused(&mut self, why: Option<String>) {
        if self.refusal != why {
            if let Some(why) = &why {
                self.messages.warn(why.clone());
            }
            self.refusal = why;
        }
    }
}
