//! Tasks of people who sit down at the window, each from its start to a file on the disk, by keys and the mouse alone.

mod blender;
mod looker;
mod student;
mod tuner;

use crate::harness::Window;
use eframe::egui::{Key, Modifiers};

/// Types a path into the line that has the focus, in place of its text, and agrees.
fn answer(window: &mut Window, path: &std::path::Path) {
    crate::making::press(window, Modifiers::COMMAND, Key::A);
    crate::focus::type_text(window, path.to_str().expect("a path in UTF-8"));
    crate::making::press(window, Modifiers::NONE, Key::Enter);
    window.settle();
}
