//! Reading a scene and putting it on screen, for the first time or anew.

use super::super::super::clock::Clock;
use super::super::super::error::AppError;
use super::super::super::{job, overrides};
use super::super::document::Document;
use super::super::files::{self, Intent};
use super::super::loader::{Loader, Trouble};
use super::super::look::Look;
use super::super::navigation::Rig;
use super::super::playback::Playback;
use super::Session;
use crate::render::{Integrator, RenderSettings};
use crate::scene::{OutputDefaults, Scene};
use std::path::PathBuf;
use std::sync::Arc;

impl Session {
    /// Begins to read a scene; the one on screen stays until it is there.
    pub fn open(&mut self, path: PathBuf) {
        self.left = self.scene().cloned();
        self.open_instead(path);
    }

    /// The same in place of a scene that could not be read.
    pub fn open_instead(&mut self, path: PathBuf) {
        let is_own = self.path.as_ref() == Some(&path);
        self.load(path, false, is_own);
    }

    /// Whether another scene is being read.
    pub fn is_opening(&self) -> bool {
        self.loader.as_ref().is_some_and(|loader| !loader.again)
    }

    /// Begins to read the scene on screen again; camera, look and time stay.
    pub fn reload(&mut self) {
        if let Some(path) = self.path.clone() {
            self.load(path, true, true);
        }
    }

    /// `is_own`: what the command line says of a scene is meant for this one.
    pub(super) fn load(&mut self, path: PathBuf, again: bool, is_own: bool) {
        let mut options = self.flags.options.clone();
        if !is_own {
            options.overrides.clear();
        }
        match Loader::new(path, options, again, || {}) {
            Ok(mut loader) => {
                loader.is_own = is_own;
                self.loader = Some(loader);
            }
            Err(error) => self.notices.warn(format!("cannot read a scene: {error}.")),
        }
    }

    /// Shows a scene that was read, from its own camera and with its own settings.
    pub(super) fn show(&mut self, original: Scene) -> Result<(), AppError> {
        let mut scene = original.clone();
        overrides::apply(&mut scene, &self.flags.camera)?;
        let settings = self.settings_of(&scene.output);
        let picture = &self.flags.picture;
        let mut tone = job::tone(&scene.output, &picture.develop, Integrator::Whitted, false);
        if let (None, Some(curve)) = (picture.develop.tone, self.preferences.tone) {
            tone.curve = curve;
        }
        self.look = Look::new(settings, tone, picture.size.size.is_none());
        self.crop();
        let clock = Clock::new(&scene.output, &self.flags.motion);
        let moment = &self.flags.moment;
        let time = (moment.frame).map_or(moment.time, |frame| Some(f64::from(frame) / clock.fps));
        self.playback = Playback::new(clock, time.unwrap_or(0.0));
        self.playback.follow(&scene);
        let camera = scene.frame(self.playback.time).camera;
        self.rig = Some(Rig::new(&camera, scene.bounds()));
        self.selection = None;
        let inspector = std::mem::take(&mut self.inspector);
        // A name that is being asked for is that of rays of before.
        self.inspector.saving = inspector.saving;
        self.original = Some(Arc::new(original));
        self.document = Some(Document::new(scene));
        Ok(())
    }

    /// Makes what the command line crops a region, which can be changed and ended.
    fn crop(&mut self) {
        let size = self.look.settings.size;
        let crop = self.flags.picture.crop;
        let settings = RenderSettings {
            crop,
            size,
            ..RenderSettings::default()
        };
        if let Err(error) = job::picture_size(&settings) {
            self.notices.warn(error.to_string());
            return;
        }
        let lengths = [size.0, size.1, size.0, size.1].map(f64::from);
        self.look.region =
            crop.map(|edges| std::array::from_fn(|edge| f64::from(edges[edge]) / lengths[edge]));
    }

    /// How a picture of a scene is made before anything is changed: flags win over preferences, and
    /// these over the scene.
    fn settings_of(&self, output: &OutputDefaults) -> RenderSettings {
        let picture = &self.flags.picture;
        let mut output = output.clone();
        output.samples = self.preferences.samples.unwrap_or(output.samples);
        RenderSettings {
            // That is a region here.
            crop: None,
            ..job::picture_settings(&output, picture)
        }
    }

    pub(super) fn take_scene(&mut self) {
        let Some(loaded) = self.loader.as_ref().and_then(Loader::outcome) else {
            return;
        };
        let Some(loader) = self.loader.take() else {
            return;
        };
        let Loader {
            path,
            again,
            is_own,
            ..
        } = loader;
        if loaded.outcome.is_ok() && !again && self.has_more_changes() {
            self.files.undecided = Some(Intent::Open(path));
            return;
        }
        if loaded.outcome.is_ok() && !is_own {
            self.flags.forget_scene();
        }
        let shown = loaded.outcome.and_then(|scene| {
            let shown = match again {
                true => self.show_again(scene),
                false => self.show(scene),
            };
            shown.map_err(|error| Trouble::from(error.to_string()))
        });
        let read = (&loaded.files[..], loaded.began);
        files::loaded(self, path, again, read, shown);
    }

    /// Whether there are unsaved changes made since another scene began to be read: nobody was asked
    /// about these.
    fn has_more_changes(&mut self) -> bool {
        let left = self.left.take();
        let is_left = |scene: &Arc<Scene>| left.as_ref().is_some_and(|l| Arc::ptr_eq(l, scene));
        self.has_changes() && !self.scene().is_some_and(is_left)
    }

    /// Shows the scene that is on screen as it was read anew. What the person has chosen stays, and
    /// what was the scene's own follows it.
    fn show_again(&mut self, scene: Scene) -> Result<(), AppError> {
        let (Some(before), Some(mut rig)) = (self.original.clone(), self.rig.clone()) else {
            return self.show(scene);
        };
        let (look, playback) = (self.look.clone(), self.playback.clone());
        let document = self.document.clone();
        self.show(scene)?;
        let clock = self.playback.clock;
        self.playback = playback;
        self.playback.clock = clock;
        if let (Some(scene), Some(mut document)) = (self.scene().cloned(), document) {
            self.playback.follow(&scene);
            rig.set_bounds(scene.bounds());
            rig.set_home(&scene.frame(self.playback.time).camera);
            // What was done before can still be taken back.
            document.reload(Scene::clone(&scene));
            self.document = Some(document);
        }
        self.rig = Some(rig);
        let own = std::mem::replace(&mut self.look, look);
        let integrator = self.look.settings.integrator;
        let seen = |settings| RenderSettings {
            integrator,
            ..settings
        };
        if self.look.settings == seen(self.settings_of(&before.output)) {
            self.look.settings = seen(own.settings);
        }
        if self.look.tone == self.look.scene_tone {
            self.look.tone = own.tone;
        }
        self.look.scene_tone = own.scene_tone;
        Ok(())
    }
}
