//! What a person reads. A closed or full standard error is nobody's fault and loses nothing but
//! words; the standard output carries results, so its errors count.

use super::cli::LogFlags;
use super::exit::AppError;
use std::fmt::Display;
use std::io::{ErrorKind, Write};

/// Says as much about the work as the flags ask for, on the standard error.
#[derive(Clone, Copy, Debug)]
pub struct Console {
    quiet: bool,
    verbose: bool,
}

impl Console {
    pub fn new(flags: &LogFlags) -> Self {
        Self {
            quiet: flags.quiet,
            verbose: flags.verbose,
        }
    }

    /// A line for everybody who did not ask for quiet.
    pub fn status(self, text: impl Display) {
        if !self.quiet {
            line(text);
        }
    }

    /// A line for those who asked for more.
    pub fn detail(self, text: impl Display) {
        if self.verbose {
            line(text);
        }
    }
}

pub fn warning(text: impl Display) {
    line(format_args!("warning: {text}"));
}

pub fn error(text: impl Display) {
    line(format_args!("error: {text}"));
}

/// Writes `text` to the standard error and ends the line. Whatever could break the line or steer
/// the terminal is escaped: scene files choose some of the words.
pub fn line(text: impl Display) {
    let text = escape(&text.to_string(), |c| c == '\t');
    let _ = writeln!(std::io::stderr().lock(), "{text}");
}

/// Writes several lines to the standard error as they are, but for what could steer the terminal.
pub fn block(text: &str, keep: impl Fn(char) -> bool) {
    let text = escape(text, |c| c == '\t' || c == '\n' || keep(c));
    let _ = writeln!(std::io::stderr().lock(), "{}", text.trim_end());
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
