//! Exports the rays of a pixel as `glimray explain` does, and copies its command line.

use crate::model::command_line;
use crate::model::command_line::{CommandLine, Shown};
use crate::model::file_dialog::{self, Kind, Reply, Request};
use crate::state::inspector::{Export, Inspected};
use crate::state::session::Session;
use eframe::egui;
use glimray_app::{ray_lines, ray_text};
use glimray_io::output;
use glimray_render::RenderSettings;
use std::path::Path;

/// A file format for a tree.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Format {
    /// The output of `glimray explain --json`.
    Json,
    /// The lines of `glimray explain --obj`.
    Obj,
}

/// Formats the tree.
///
/// # Errors
/// As for `explain::json`, in one line.
pub fn text(inspected: &Inspected, format: Format) -> Result<String, String> {
    match format {
        Format::Json => ray_text::json(&inspected.tree, inspected.request.settings.size)
            .map_err(|error| error.to_string()),
        Format::Obj => Ok(ray_lines::of(&inspected.tree)),
    }
}

/// Asks for a file name and writes the tree; a message reports the result.
pub fn save(session: &mut Session, format: Format, ctx: &egui::Context) {
    let Some(inspected) = &session.inspector.inspected else {
        return;
    };
    if session.inspector.export.asked.is_some() {
        return;
    }
    let text = match text(inspected, format) {
        Ok(text) => text,
        Err(why) => return session.messages.warn(why),
    };
    let [x, y] = inspected.tree.pixel;
    let (kind, ending): (Kind, _) = match format {
        Format::Json => (("Rays as JSON", &["json"]), "json"),
        Format::Obj => (("Rays as Wavefront OBJ lines", &["obj"]), "obj"),
    };
    let name = format!("rays_{x}_{y}.{ending}");
    let request = Request::save("Save the rays", kind, Path::new(&name));
    let asked = Some(session.files.dialogs.ask(request, ctx));
    session.inspector.export = Export { asked, text };
}

/// Writes a text and returns a message.
///
/// # Errors
/// The file cannot be written: why, in one line.
pub fn write(path: &Path, text: &str) -> Result<String, String> {
    match output::write(path, text.as_bytes(), true) {
        Ok(()) => Ok(format!("Saved {}", path.display())),
        Err(error) => Err(error.to_string()),
    }
}

/// Handles the reply of the file dialog.
pub fn update(session: &mut Session) {
    let export = &mut session.inspector.export;
    match file_dialog::take_reply(&mut export.asked) {
        Some(Reply::Chosen(path)) if session.files.inputs().contain(&path) => {
            let path = path.display();
            session.messages.warn(format!(
                "Cannot save the rays ({path}): the scene uses that file. Choose another name."
            ));
        }
        Some(Reply::Chosen(path)) => match write(&path, &export.text) {
            Ok(notice) => session.messages.saved(notice, path),
            Err(why) => session.messages.warn(why),
        },
        Some(Reply::Unavailable) => session.messages.warn(NO_DIALOG.to_owned()),
        Some(Reply::Cancelled) | None => {}
    }
}

/// Message for desktops without file dialogs.
const NO_DIALOG: &str = "Cannot save the rays: no file dialog is available on this desktop (no portal answers). Copy the command and run it with --json or --obj.";

/// The command that prints the tree of the inspected pixel; `sample` limits it to one sample.
///
/// # Errors
/// No pixel is inspected or the scene has no file: why, in one line.
pub fn command(session: &Session, sample: Option<u32>) -> Result<CommandLine, String> {
    let (Some(inspected), Some(scene), Some(camera)) = (
        &session.inspector.inspected,
        &session.original,
        session.camera(),
    ) else {
        return Err("Cannot copy the command: no pixel is inspected. Click one first.".into());
    };
    let Some(path) = &session.path else {
        let why = match session.is_untitled {
            true => "Cannot copy the command: the new scene has no file yet. Save it first.",
            false => {
                "Cannot copy the command: the demo scene has no file. Open a scene, or save this one."
            }
        };
        return Err(why.into());
    };
    let settings = RenderSettings {
        integrator: inspected.tree.integrator,
        ..inspected.request.settings.clone()
    };
    let background = session.view.background.as_ref();
    let playback = &session.playback;
    let mut command = command_line::copy(&Shown {
        path,
        options: &session.request.import,
        scene,
        camera: &camera,
        background: background.unwrap_or(&scene.background),
        section: inspected.request.scene.section,
        settings: &settings,
        tone: session.view.tone,
        time: playback.time,
        fps: playback.clock.fps,
        shutter: playback.shutter(),
        edited: session
            .document
            .as_ref()
            .is_some_and(|document| document.is_changed()),
    });
    let line = (command.line).replacen("glimray render", "glimray explain", 1);
    let [x, y] = inspected.tree.pixel;
    command.line = format!("{line} --pixel {x},{y}");
    if let Some(sample) = sample {
        command.line += &format!(" --sample {sample}");
    }
    Ok(command)
}
