//! Messages on standard error and results on standard output. Failures to write messages are ignored;
//! failures to write results are errors.
//!
//! With `--progress json` every line on standard error is a JSON object. A host takes warnings and results instead, and
//! status lines are left out.

use super::error::AppError;
use super::host;
use glimray_scene::text;
use serde_json::{Value, json};
use std::fmt::Display;
use std::io::{ErrorKind, IsTerminal, Write, stderr};
use std::sync::atomic::{AtomicBool, Ordering};

/// Whether messages are JSON lines.
static IS_JSON: AtomicBool = AtomicBool::new(false);

/// Terminal styles of the labels `error:` (bold red) and `warning:` (bold yellow).
const RED: &str = "\u{1b}[1;31m";
const YELLOW: &str = "\u{1b}[1;33m";
const PLAIN: &str = "\u{1b}[0m";

/// Prints status messages to standard error, as verbosely as the flags ask.
#[derive(Clone, Copy, Debug)]
pub struct Console {
    quiet: bool,
    verbose: bool,
}

impl Console {
    /// `quiet` leaves out status lines, `verbose` adds details.
    pub fn new(quiet: bool, verbose: bool) -> Self {
        Self { quiet, verbose }
    }

    /// Prints a line unless `--quiet` is set.
    pub fn status(self, text: impl Display) {
        if !self.quiet {
            note(text);
        }
    }

    /// Prints a line if `--verbose` is set.
    pub fn detail(self, text: impl Display) {
        if self.verbose {
            note(text);
        }
    }
}

/// Makes every following message a JSON line.
pub fn use_json() {
    IS_JSON.store(true, Ordering::Relaxed);
}

/// Whether messages are JSON lines.
pub fn is_json() -> bool {
    IS_JSON.load(Ordering::Relaxed)
}

fn note(text: impl Display) {
    if host::current().is_some() {
        return;
    }
    let text = text.to_string();
    match is_json() {
        true => json_line(&json!({ "note": text })),
        false => line("", "", &text),
    }
}

/// A name from a scene within a line.
pub fn quoted(name: &str) -> String {
    if name.is_empty() {
        "(unnamed)".into()
    } else {
        // Line breaks are replaced, so that a name cannot imitate lines of its own.
        format!("`{}`", text::one_line(name))
    }
}

/// Prints a warning.
pub fn warning(text: impl Display) {
    let text = text.to_string();
    match host::current() {
        Some(host) => host.warn(&text),
        None if is_json() => json_line(&json!({ "warning": text })),
        None => line("warning:", YELLOW, &format!(" {text}")),
    }
}

/// Prints the error that ended the command with `exit_code`.
pub fn error(text: impl Display, exit_code: u8) {
    let text = text.to_string();
    match is_json() {
        true => json_line(&json!({ "error": text, "code": exit_code })),
        false => line("error:", RED, &format!(" {text}")),
    }
}

/// Writes a JSON object to standard error as one line.
pub fn json_line(value: &Value) {
    let line = text::escape_json(&value.to_string());
    let _ = writeln!(stderr().lock(), "{line}");
}

/// Writes `label` and `text` to standard error and ends the line. On a terminal the label is coloured and
/// the text is wrapped between words. Line breaks become spaces, and what acts on a terminal is escaped, because parts of
/// the text come from scene files.
fn line(label: &str, color: &str, text: &str) {
    let text = text::escape(&text.replace(['\n', '\r'], " "), |c| c == '\t');
    let text = match !label.is_empty() && shows_color() {
        true => format!("{color}{label}{PLAIN}{text}"),
        false => format!("{label}{text}"),
    };
    let _ = writeln!(stderr().lock(), "{}", fit(&text));
}

/// Prints lines to standard error, wrapped between words on a terminal. They may contain styles.
pub fn wrapped(text: &str) {
    let text = text::escape(text.trim_end(), |c| c == '\t' || c == '\n' || c == '\u{1b}');
    let _ = writeln!(stderr().lock(), "{}", fit(&text));
}

/// The escape sequences that begin and end red text on standard error; empty without colour.
pub fn red() -> (&'static str, &'static str) {
    match shows_color() {
        true => (RED, PLAIN),
        false => ("", ""),
    }
}

/// Whether standard error is a terminal with colour, and `NO_COLOR` does not forbid it.
pub fn shows_color() -> bool {
    let is_set = |name| std::env::var_os(name).is_some_and(|value| !value.is_empty());
    let is_dumb = std::env::var_os("TERM").is_none_or(|term| term == "dumb");
    stderr().is_terminal() && !is_set("NO_COLOR") && !is_dumb
}

/// Wraps every line to the width of the terminal on standard error, if it is one.
fn fit(text: &str) -> String {
    match terminal_size::terminal_size_of(stderr()) {
        Some((width, _)) => {
            let lines = text.lines().map(|line| wrap(line, width.0.into()));
            lines.collect::<Vec<_>>().join("\n")
        }
        None => text.to_owned(),
    }
}

/// Breaks a line between words, so that no part has more than `width` columns. A longer word gets a line of
/// its own.
fn wrap(line: &str, width: usize) -> String {
    let mut wrapped = String::with_capacity(line.len() + 8);
    let mut column = 0;
    for (index, word) in line.split(' ').enumerate() {
        let length = columns(word);
        if index > 0 && column + 1 + length > width {
            wrapped.push('\n');
            column = 0;
        } else if index > 0 {
            wrapped.push(' ');
            column += 1;
        }
        wrapped.push_str(word);
        column += length;
    }
    wrapped
}

/// Columns that a word takes on a terminal; styles (`ESC … m`) take none.
fn columns(word: &str) -> usize {
    let mut parts = word.split('\u{1b}');
    let plain = parts.next().unwrap_or_default();
    let styled = parts.map(|part| part.split_once('m').map_or("", |(_, text)| text));
    std::iter::once(plain)
        .chain(styled)
        .map(|text| text.chars().count())
        .sum()
}

/// Writes several lines to standard error. What acts on a terminal is escaped, except the characters to `keep`.
pub fn block(text: &str, keep: impl Fn(char) -> bool) {
    let text = text::escape(text, |c| c == '\t' || c == '\n' || keep(c));
    let _ = writeln!(stderr().lock(), "{}", text.trim_end());
}

/// Writes a result to standard output. A reader that closes the pipe early (`glimray inspect … | head`) is
/// not an error.
///
/// # Errors
/// Standard output fails for any other reason.
pub fn print(text: &str) -> Result<(), AppError> {
    let text = text::escape(text, |c| c == '\t' || c == '\n');
    print_bytes(text.as_bytes())
}

/// Like [`print()`], with nothing escaped.
///
/// # Errors
/// As [`print()`].
pub fn print_bytes(bytes: &[u8]) -> Result<(), AppError> {
    if let Some(host) = host::current() {
        host.print(bytes);
        return Ok(());
    }
    let mut stdout = std::io::stdout().lock();
    match stdout.write_all(bytes).and_then(|()| stdout.flush()) {
        Err(error) if error.kind() != ErrorKind::BrokenPipe => Err(AppError::Stdout(error)),
        _ => Ok(()),
    }
}

/// Prints `value` as indented JSON.
///
/// # Errors
/// As [`print()`].
pub fn print_json(value: &serde_json::Value) -> Result<(), AppError> {
    print_bytes(text::escape_json(&format!("{value:#}\n")).as_bytes())
}
