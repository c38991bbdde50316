//! What the person works on: everything that outlives a lost device.

mod opening;
mod room;

use super::super::cli::{CameraFlags, MomentFlags, MotionFlags, PictureFlags, ViewArgs};
use super::super::clock::Clock;
use super::super::error::AppError;
use super::super::{demo, job};
use super::bindings::Action;
use super::canvas::Place;
use super::document::Document;
use super::editing::{self, Editing};
use super::files::{self, Files};
use super::inspector::{self, Inspector};
use super::loader::Loader;
use super::look::Look;
use super::navigation::Rig;
use super::notices::Notices;
use super::objects::{self, Id};
use super::order::Order;
use super::playback::Playback;
use super::preferences::{Preferences, Store};
use super::question::Answer;
use super::render_thread::Orders;
use super::replay::Tape;
use super::sheets::Sheets;
use super::tools::{Drag, Tool};
use super::viewport::Viewport;
use crate::import;
use crate::render::{ExecutionPolicy, Integrator, RenderSettings};
use crate::scene::{Camera, Scene};
use eframe::egui;
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
    pub notices: Notices,
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
    pub look: Look,
    /// When it is.
    pub playback: Playback,
    /// The camera under the person's hands.
    pub rig: Option<Rig>,
    /// What a click in the picture does.
    pub tool: Tool,
    /// What the mouse drags in the picture.
    pub drag: Option<Drag>,
    /// What is selected.
    pub selection: Option<Id>,
    /// Commands that clicks in the picture gave, for the next frame.
    pub clicked: Vec<Action>,
    /// Where the picture is in the window; `None` where it is not to be seen.
    pub viewport: Option<Viewport>,
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
    pub sheets: Sheets,
    /// What the person does, recorded or played.
    pub tape: Tape,
    /// What the command line said.
    pub flags: Flags,
    /// Questions that wait for the render thread.
    pub questions: Vec<super::render_thread::Question<Answer>>,
    loader: Option<Loader>,
    /// The scene that may be lost to the one that is being opened.
    left: Option<Arc<Scene>>,
    /// How often the picture was started over.
    restarts: u32,
    room: Room,
    /// When something moved last, in egui's time; and what egui's time is.
    last_motion: f64,
    now: f64,
    is_device_lost: bool,
    refusal: Option<String>,
}

/// What the command line said.
pub struct Flags {
    /// About the picture.
    pub picture: PictureFlags,
    /// About the camera of the scene on screen, if the command line named that scene.
    pub camera: CameraFlags,
    /// About its moment.
    pub moment: MomentFlags,
    /// About time.
    pub motion: MotionFlags,
    /// About reading the scene.
    pub options: import::Options,
    /// Most memory that a picture may take, in bytes.
    pub policy: ExecutionPolicy,
}

impl Flags {
    /// What they say of one scene means nothing in another.
    fn forget_scene(&mut self) {
        self.camera = CameraFlags::default();
        self.moment = MomentFlags::default();
        self.options.overrides.clear();
    }
}

impl Session {
    /// A session that is about to read its scene. `store` is where preferences are.
    pub fn new(arguments: ViewArgs, mut store: Store) -> Result<Self, AppError> {
        let ViewArgs {
            scene: path,
            picture,
            camera,
            moment,
            motion,
            reading,
            tape,
            device,
        } = arguments;
        let (preferences, notes) = store.load();
        let mut notices = Notices::default();
        notes.into_iter().for_each(|note| notices.warn(note));
        let demo = demo::scene()?;
        let mut session = Self {
            notices,
            preferences,
            store,
            look: Look::new(
                RenderSettings::default(),
                job::tone(&demo.output, &picture.develop, Integrator::Whitted, false),
                picture.size.size.is_none(),
            ),
            playback: Playback::new(Clock::new(&demo.output, &motion), 0.0),
            document: None,
            original: None,
            path: None,
            rig: None,
            tool: Tool::default(),
            drag: None,
            selection: None,
            clicked: Vec::new(),
            viewport: None,
            shows_statistics: true,
            shows_overlays: true,
            files: Files::default(),
            editing: Editing::default(),
            inspector: Inspector::default(),
            sheets: Sheets::default(),
            tape: Tape::new(&tape)?,
            flags: Flags {
                picture,
                camera,
                moment,
                motion,
                options: reading.import_options(),
                policy: job::policy(&device, false),
            },
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

    /// Tells that the window is another one: what was asked of the last one's renderer, and what the hand
    /// held there, is gone.
    pub fn begin(&mut self) {
        self.sheets.begin();
        self.files.begin();
        self.questions.clear();
        inspector::begin(self);
        self.drag = None;
        self.look.grip = None;
        self.editing.grip = None;
        self.editing.modal = None;
    }

    /// What happened since the last frame.
    pub fn update(&mut self, ctx: &egui::Context) {
        let (now, seconds) = ctx.input(|input| (input.time, f64::from(input.stable_dt).min(0.1)));
        // A frame that is drawn again takes no time.
        let seconds = if now > self.now { seconds } else { 0.0 };
        self.now = now;
        self.take_scene();
        files::update(self, ctx);
        inspector::update(self, ctx, seconds);
        editing::update(self, ctx);
        let time = self.playback.time;
        self.playback.advance(seconds);
        if self.playback.time != time {
            self.last_motion = now;
        }
        if let (Some(rig), Some(document)) = (&mut self.rig, &self.document) {
            let scene = document.scene();
            if rig.is_home() && scene.is_animated() {
                rig.set_home(&scene.frame(self.playback.time).camera);
            }
            if rig.advance(seconds) || rig.is_moving() {
                self.last_motion = now;
            }
        }
    }

    /// The same while the window is minimised: nothing moves, and the picture goes on.
    pub fn update_hidden(&mut self) {
        self.last_motion = f64::NEG_INFINITY;
        self.drag = None;
        self.take_scene();
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
        self.rig.as_ref().map(Rig::camera)
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

    /// The pictures that are wanted now.
    pub fn orders(&self) -> Orders {
        let mut orders = Orders {
            coarse: self.is_moving(),
            paused: self.look.paused,
            ..Orders::default()
        };
        if self.room.taken.0 > 0 && self.room.taken.1 > 0 {
            orders.pictures[Place::Main as usize] = self.order(self.look.settings.integrator);
            orders.pictures[Place::Beside as usize] =
                (self.look.comparison).and_then(|comparison| self.order(comparison.integrator));
        }
        orders.pictures[Place::Outside as usize] = inspector::outside::order(self);
        orders
    }

    fn order(&self, integrator: Integrator) -> Option<Order> {
        let (scene, rig) = (self.scene()?, self.rig.as_ref()?);
        Some(Order {
            scene: scene.clone(),
            restarts: self.restarts,
            camera: (!rig.is_home()).then(|| rig.camera()),
            background: self.look.background.clone(),
            shot: self.playback.shot(),
            settings: self.look.settings_in(self.room.taken, integrator),
            policy: self.flags.policy,
            tone: self.look.tone_of(integrator),
        })
    }

    /// The size of the picture, in pixels.
    pub fn picture_size(&self) -> (u32, u32) {
        self.look
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
            && !self.tape.is_playing()
    }

    /// How long the window may sleep before something happens by itself; `None` until a person or another
    /// thread wakes it. On software each frame that shows nothing new delays the one that does.
    pub fn until_next_frame(&self) -> Option<Duration> {
        let glides = self.rig.as_ref().is_some_and(Rig::is_moving);
        if glides
            || self.playback.is_playing
            || self.tape.is_playing()
            || !self.questions.is_empty()
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
                self.notices.warn(why.clone());
            }
            self.refusal = why;
        }
    }
}
