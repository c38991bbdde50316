//! The desktop's file manager, opened without blocking. Tests replace it.

use eframe::egui;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};
use std::sync::Arc;
use std::sync::mpsc::{Receiver, channel};

/// Opens the folder of a file, with the file selected where that is possible.
type Show = dyn Fn(&Path) -> Result<(), String> + Send + Sync;

/// The file manager.
#[derive(Clone)]
pub struct FileManager(Arc<Show>);

impl Default for FileManager {
    /// That of the desktop.
    fn default() -> Self {
        Self(Arc::new(|path| first_of(commands(path), path)))
    }
}

impl FileManager {
    /// One that does this instead, for tests.
    pub fn new(show: impl Fn(&Path) -> Result<(), String> + Send + Sync + 'static) -> Self {
        Self(Arc::new(show))
    }

    /// Shows a file, on a thread of its own. The outcome comes later and requests a repaint of `ctx`.
    pub fn show(&self, path: PathBuf, ctx: &egui::Context) -> Receiver<Result<(), String>> {
        let (sender, receiver) = channel();
        let (show, ctx) = (self.0.clone(), ctx.clone());
        let work = move || {
            // The window may have been closed meanwhile.
            let _ = sender.send(show(&path));
            ctx.request_repaint();
        };
        // Without a thread the sender is dropped, which counts as a failure.
        let _ = std::thread::Builder::new()
            .name("file manager".into())
            .spawn(work);
        receiver
    }
}

/// A program with its arguments.
pub type Line = (&'static str, Vec<String>);

/// The commands that show a file in its folder, of which the first that succeeds is enough. The path is absolute.
pub fn commands(path: &Path) -> Vec<Line> {
    let text = path.display().to_string();
    let folder = path.parent().unwrap_or(path).display().to_string();
    if cfg!(target_os = "macos") {
        vec![("open", vec!["-R".to_owned(), text])]
    } else if cfg!(windows) {
        vec![("explorer", vec![format!("/select,\"{text}\"")])]
    } else {
        let method = [
            "--session",
            "--print-reply",
            "--dest=org.freedesktop.FileManager1",
            "/org/freedesktop/FileManager1",
            "org.freedesktop.FileManager1.ShowItems",
        ];
        let items = [
            format!("array:string:{}", address(path)),
            "string:".to_owned(),
        ];
        let method = method.map(str::to_owned).into_iter().chain(items);
        // Without the interface, the folder is opened.
        vec![("dbus-send", method.collect()), ("xdg-open", vec![folder])]
    }
}

/// The address of a file: RFC 8089. Commas would separate the items of a list.
fn address(path: &Path) -> String {
    let mut address = "file://".to_owned();
    for byte in path.as_os_str().as_encoded_bytes() {
        match byte {
            b'a'..=b'z' | b'A'..=b'Z' | b'0'..=b'9' | b'/' | b'-' | b'.' | b'_' | b'~' => {
                address.push(char::from(*byte));
            }
            _ => address += &format!("%{byte:02X}"),
        }
    }
    address
}

/// Runs commands until one of them succeeds.
///
/// # Errors
/// None of them does: one line.
fn first_of(commands: Vec<Line>, path: &Path) -> Result<(), String> {
    let succeeds = |(program, arguments): &Line| {
        let mut command = Command::new(program);
        // Explorer reads the line by itself, with quotes round the path alone.
        #[cfg(windows)]
        for argument in arguments {
            std::os::windows::process::CommandExt::raw_arg(&mut command, argument);
        }
        #[cfg(not(windows))]
        command.args(arguments);
        let quiet = command
            .stdin(Stdio::null())
            .stdout(Stdio::null())
            .stderr(Stdio::null())
            .status();
        // The Explorer's status tells nothing.
        quiet.is_ok_and(|status| status.success() || cfg!(windows))
    };
    let programs: Vec<_> = commands.iter().map(|(program, _)| *program).collect();
    match commands.iter().any(succeeds) {
        true => Ok(()),
        false => Err(format!(
            "Cannot show {} in its folder: {} did not succeed. Open the folder by hand.",
            path.display(),
            programs.join(" and ")
        )),
    }
}
