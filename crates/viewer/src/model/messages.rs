//! Messages of the window: shown for as long as it takes to read them, and kept in a list.

use std::path::PathBuf;
use std::time::{Duration, Instant};

/// Minimum time on screen, and the extra time per character.
const STAY: Duration = Duration::from_secs(5);
const READING: Duration = Duration::from_millis(60);

/// Maximum number of messages kept.
pub const MOST: usize = 200;

/// A way out of what a message reports, as a button.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Remedy {
    /// Add a light to the scene.
    AddLight,
    /// Make the background a sky, which path tracing sees.
    Sky,
    /// Switch to path tracing.
    PathTracing,
}

impl Remedy {
    /// Label of the button.
    pub fn title(self) -> &'static str {
        match self {
            Self::AddLight => "Add a light",
            Self::Sky => "Sky",
            Self::PathTracing => "Path tracing",
        }
    }
}

/// A message.
#[derive(Clone, Debug)]
pub struct Message {
    /// One or two lines of text.
    pub text: String,
    /// Whether it reports a problem.
    pub is_trouble: bool,
    /// Ways out. With one, the message stays until it is dismissed.
    pub remedies: &'static [Remedy],
    /// The file that it says was written.
    pub file: Option<PathBuf>,
    /// When it was added.
    pub since: Instant,
    is_read: bool,
}

/// `text` with a capital first letter. Errors of the library start with a lower-case word, because the
/// command line prints them after `error:`. File names at the start stay as they are.
pub fn sentence(text: &str) -> String {
    let word = text.split_whitespace().next().unwrap_or_default();
    match word.chars().next() {
        Some(first) if word.chars().all(char::is_alphabetic) => {
            first.to_uppercase().chain(text.chars().skip(1)).collect()
        }
        _ => text.to_owned(),
    }
}

/// Messages, the newest last.
#[derive(Default)]
pub struct Messages {
    messages: Vec<Message>,
}

impl Messages {
    /// Adds a warning. A visible message with the same text is replaced.
    pub fn warn(&mut self, text: String) {
        self.add(sentence(&text), true, &[], None);
    }

    /// Adds a warning that stays until it is dismissed, with ways out.
    pub fn offer(&mut self, text: &str, remedies: &'static [Remedy]) {
        self.add(sentence(text), true, remedies, None);
    }

    /// Adds a message that is not a warning.
    pub fn notify(&mut self, text: impl Into<String>) {
        self.add(text.into(), false, &[], None);
    }

    /// Says that a file was written.
    pub fn saved(&mut self, text: String, file: PathBuf) {
        self.add(text, false, &[], Some(file));
    }

    fn add(
        &mut self,
        text: String,
        is_trouble: bool,
        remedies: &'static [Remedy],
        file: Option<PathBuf>,
    ) {
        (self.messages).retain(|known| known.text != text || known.rest().is_none());
        if self.messages.len() == MOST {
            self.messages.remove(0);
        }
        self.messages.push(Message {
            text,
            is_trouble,
            remedies,
            file,
            since: Instant::now(),
            is_read: false,
        });
    }

    /// The messages that are visible now.
    pub fn current(&self) -> Vec<Message> {
        let messages = self.messages.iter();
        messages.filter(|n| n.rest().is_some()).cloned().collect()
    }

    /// Time until the next visible message expires.
    pub fn next_change(&self) -> Option<Duration> {
        let expiring = self.messages.iter().filter(|it| it.remedies.is_empty());
        expiring.filter_map(Message::rest).min()
    }

    /// Hides a message.
    pub fn dismiss(&mut self, text: &str) {
        for notice in &mut self.messages {
            notice.is_read |= notice.text == text;
        }
    }

    /// All messages, the oldest first.
    pub fn all(&self) -> &[Message] {
        &self.messages
    }
}

impl Message {
    /// Remaining time on screen.
    fn rest(&self) -> Option<Duration> {
        if !self.remedies.is_empty() {
            return (!self.is_read).then_some(Duration::MAX);
        }
        let stay = STAY + READING * u32::try_from(self.text.chars().count()).unwrap_or(u32::MAX);
        (!self.is_read)
            .then(|| stay.checked_sub(self.since.elapsed()))
            .flatten()
    }
}
