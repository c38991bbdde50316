//! The rays of a pixel for other programs: as `glimray explain` writes them, and the command that does.

use super::super::super::explain;
use super::super::command_line::{self, CommandLine, Shown};
use super::super::session::Session;
use super::Inspected;
use crate::output;
use crate::render::{Integrator, Settings};
use eframe::egui;
use std::path::PathBuf;
use std::sync::mpsc::{Receiver, Sender, channel};

/// What a tree is saved as.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Format {
    /// What `glimray explain --json` prints.
    Json,
    /// The lines that `glimray explain --obj` writes.
    Obj,
}

/// Files that are being saved.
pub struct Saving {
    sender: Sender<String>,
    receiver: Receiver<String>,
}

impl Default for Saving {
    fn default() -> Self {
        let (sender, receiver) = channel();
        Self { sender, receiver }
    }
}

/// The tree as a text.
///
/// # Errors
/// As `explain::json`, as one line.
pub fn text(inspected: &Inspected, format: Format) -> Result<String, String> {
    match format {
        Format::Json => explain::json(&inspected.tree, inspected.order.settings.size)
            .map_err(|error| error.to_string()),
        Format::Obj => Ok(explain::lines::of(&inspected.tree)),
    }
}

/// Asks for a file's name and writes the tree there; a notice says what came of it.
pub fn save(session: &mut Session, format: Format, ctx: &egui::Context) {
    let Some(inspected) = &session.inspector.inspected else {
        return;
    };
    let text = match text(inspected, format) {
        Ok(text) => text,
        Err(why) => return session.notices.warn(why),
    };
    let [x, y] = inspected.tree.pixel;
    let (name, ending) = match format {
        Format::Json => ("Rays as JSON", "json"),
        Format::Obj => ("Rays as Wavefront OBJ lines", "obj"),
    };
    let file = format!("rays_{x}_{y}.{ending}");
    let (sender, ctx) = (session.inspector.saving.sender.clone(), ctx.clone());
    // A dialog of the desktop waits for a person: not here.
    let thread = std::thread::Builder::new().name("save rays".into());
    let spawned = thread.spawn(move || {
        let dialog = rfd::FileDialog::new().set_file_name(file);
        if let Some(path) = dialog.add_filter(name, &[ending]).save_file() {
            // Whoever asked has closed the window by now if nobody listens.
            let _ = sender.send(write(path, &text));
            ctx.request_repaint();
        }
    });
    if let Err(error) = spawned {
        let why = format!("cannot ask for a file's name: {error}.");
        session.notices.warn(why);
    }
}

/// Writes a text and says so, or why not.
pub fn write(path: PathBuf, text: &str) -> String {
    match output::write(&path, text.as_bytes(), true) {
        Ok(()) => format!("saved {}", path.display()),
        Err(error) => error.to_string(),
    }
}

/// Tells what was saved since the last frame.
pub fn update(session: &mut Session) {
    while let Ok(notice) = session.inspector.saving.receiver.try_recv() {
        session.notices.tell(notice);
    }
}

/// The command that prints the tree of the pixel in the picture on the screen; `sample` is its index
/// where it is to be one only.
///
/// # Errors
/// There is nothing to name: one line on why.
pub fn command(session: &Session, sample: Option<u32>) -> Result<CommandLine, String> {
    let (Some(inspected), Some(scene), Some(camera)) = (
        &session.inspector.inspected,
        &session.original,
        session.camera(),
    ) else {
        return Err("cannot copy a command: no pixel is inspected. Click one first.".into());
    };
    let Some(path) = &session.path else {
        return Err(
            "cannot copy a command: the demo has no file. Open a scene, or save this one.".into(),
        );
    };
    let settings = Settings {
        integrator: Integrator::Whitted,
        ..inspected.order.settings.clone()
    };
    let background = session.look.background.as_ref();
    let playback = &session.playback;
    let mut command = command_line::copy(&Shown {
        path,
        options: &session.flags.options,
        scene,
        camera: &camera,
        background: background.unwrap_or(&scene.background),
        settings: &settings,
        tone: session.look.tone,
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
