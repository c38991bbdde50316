//! Saves the window's settings to the scene.

use crate::state::session::Session;
use crate::state::session::opening::samples_of;
use glimray_scene::OutputDefaults;

impl Session {
    /// The output defaults that the scene would need; `None` if it has them.
    fn unsaved_output(&self) -> Option<OutputDefaults> {
        let scene = self.scene()?;
        let before = &scene.output;
        let mut output = self.view.output(before, &self.playback);
        // A scene that does not set its samples need not do so to look the same here.
        if output.samples == samples_of(scene) {
            output.samples = before.samples;
        }
        (output != *before || self.view.background.is_some()).then_some(output)
    }

    /// Whether view settings differ from the scene.
    pub fn has_unsaved_view_settings(&self) -> bool {
        self.unsaved_output().is_some()
    }

    /// Stores render settings, tone mapping, background and timing in the scene.
    pub fn save_view_settings(&mut self) {
        let Some(output) = self.unsaved_output() else {
            return;
        };
        let background = self.view.background.take();
        self.change("save settings to scene", |scene| {
            scene.output = output;
            scene.background = background.unwrap_or(scene.background.clone());
            Ok(())
        });
        self.view.scene_settings = self.view.settings.clone();
        self.view.scene_tone = self.view.tone;
    }
}
