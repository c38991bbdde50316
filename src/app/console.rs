//! What a person reads. A closed or full standard error is nobody's fault and loses nothing but
//! words; the standard output carries results, so its errors count.
//!
//! With `--progress json` a program reads the standard error: then each line is a JSON object.

use super::error::AppError;
use serde_json::{Value, json};
use std::fmt::Display;
use std::io::{ErrorKind, IsTerminal, Write, stderr};
use std::sync::atomic::{AtomicBool, Ordering};

/// Whether lines are JSON.
static IS_JSON: AtomicBool = AtomicBool::new(false);

/// What an error and a warning begin with on a terminal: bold red and bold yellow.
const RED: &str = "\u{1b}[1;31m";
const YELLOW: &str = "\u{1b}[1;33m";
const PLAIN: &str = "\u{1b}[0m";

/// Says as much about the work as the flags ask for, on the standard error.
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

    /// A line for everybody who did not ask for quiet.
    pub fn status(self, text: impl Display) {
        if !self.quiet {
            note(text);
        }
    }

    /// A line for those who asked for more.
    pub fn detail(self, text: impl Display) {
        if self.verbose {
            note(text);
        }
    }
}

/// From now on every line is a JSON object.
pub fn speak_json() {
    IS_JSON.store(true, Ordering::Relaxed);
}

/// Whether every line is a JSON object.
pub fn speaks_json() -> bool {
    IS_JSON.load(Ordering::Relaxed)
}

fn note(text: impl Display) {
    let text = text.to_string();
    match speaks_json() {
        true => json_line(&json!({ "note": text })),
        false => line("", "", &text),
    }
}

pub fn warning(text: impl Display) {
    let text = text.to_string();
    match speaks_json() {
        true => json_line(&json!({ "warning": text })),
        false => line("warning:", YELLOW, &format!(" {text}")),
    }
}

/// Says what ended the command, which returns `exit_code`.
pub fn error(text: impl Display, exit_code: u8) {
    let text = text.to_string();
    match speaks_json() {
        true => json_line(&json!({ "error": text, "code": exit_code })),
        false => line("error:", RED, &format!(" {text}")),
    }
}

/// Writes a JSON object to the standard error, in one line.
pub fn json_line(value: &Value) {
    let _ = writeln!(stderr().lock(), "{value}");
}

/// Writes `label` and `text` to the standard error and ends the line; a terminal gets the label in
/// colour, and lines that end between two words. Whatever could break the line or steer the terminal is
/// escaped: scene files choose some of the words.
fn line(label: &str, color: &str, text: &str) {
    let mut text = format!("{label}{}", escape(text, |c| c == '\t'));
    let is_terminal = stderr().is_terminal();
    if is_terminal && let Some((width, _)) = terminal_size::terminal_size_of(stderr()) {
        text = wrap(&text, width.0.into());
    }
    if is_terminal && !label.is_empty() && shows_color() {
        text.replace_range(..label.len(), &format!("{color}{label}{PLAIN}"));
    }
    let _ = writeln!(stderr().lock(), "{text}");
}

/// The escape sequences that begin and end red text on the standard error, which is a terminal; empty
/// where colour is unwanted.
pub fn red() -> (&'static str, &'static str) {
    match shows_color() {
        true => (RED, PLAIN),
        false => ("", ""),
    }
}

/// Whether the person wants colour, and the terminal is known to have it.
fn shows_color() -> bool {
    let is_set = |name| std::env::var_os(name).is_some_and(|value| !value.is_empty());
    let is_dumb = std::env::var_os("TERM").is_none_or(|term| term == "dumb");
    !is_set("NO_COLOR") && !is_dumb
}

/// `text` in lines of at most `width` characters; a longer word has a line for itself.
fn wrap(text: &str, width: usize) -> String {
    let mut wrapped = String::with_capacity(text.len() + 8);
    let mut column = 0;
    for (index, word) in text.split(' ').enumerate() {
        let length = word.chars().count();
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

/// Writes several lines to the standard error as they are, but for what could steer the terminal.
pub fn block(text: &str, keep: impl Fn(char) -> bool) {
    let text = escape(text, |c| c == '\t' || c == '\n' || keep(c));
    let _ = writeln!(stderr().lock(), "{}", text.trim_end());
}

/// Writes a result to the standard output. A reader that has seen enough and closed its end
/// (`glimray inspect … | head`) is content.
///
/// # Errors
/// A standard output that takes no more for any other reason.
pub fn print(text: &str) -> Result<(), AppError> {
    let text = escape(text, |c| c == '\t' || c == '\n');
    print_bytes(text.as_bytes())
}

/// Like [`print`], with nothing escaped.
///
/// # Errors
/// As [`print`].
pub fn print_bytes(bytes: &[u8]) -> Result<(), AppError> {
    let mut stdout = std::io::stdout().lock();
    match stdout.write_all(bytes).and_then(|()| stdout.flush()) {
        Err(error) if error.kind() != ErrorKind::BrokenPipe => Err(AppError::Stdout(error)),
        _ => Ok(()),
    }
}

/// Prints `value` as indented JSON.
///
/// # Errors
/// As [`print`].
pub fn print_json(value: &serde_json::Value) -> Result<(), AppError> {
    print_bytes(format!("{value:#}\n").as_bytes())
}

fn escape(text: &str, keep: impl Fn(char) -> bool) -> String {
    let mut escaped = String::with_capacity(text.len());
    for c in text.chars() {
        match c {
            '\n' | '\r' if !keep(c) => escaped.push(' '),
            c if c.is_control() && !keep(c) => escaped.extend(c.escape_default()),
            c => escaped.push(c),
        }
    }
    escaped
}
