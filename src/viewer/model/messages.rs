//! What happened: each notice for as long as it takes to read, and all of them in a list.

use std::time::{Duration, Instant};

/// How long the shortest notice stays, and how long it takes to read a character more.
const STAY: Duration = Duration::from_secs(5);
const READING: Duration = Duration::from_millis(60);

/// Most notices that are kept.
pub const MOST: usize = 200;

/// Something that happened.
#[derive(Clone, Debug)]
pub struct Message {
    /// In a line or two.
    pub text: String,
    /// Whether something went wrong.
    pub is_trouble: bool,
    /// When.
    pub since: Instant,
    is_read: bool,
}

/// Notices, the newest last.
#[derive(Default)]
pub struct Messages {
    messages: Vec<Message>,
}

impl Messages {
    /// Tells of trouble, once while it is to be seen.
    pub fn warn(&mut self, text: String) {
        self.add(text, true);
    }

    /// The same for what is no trouble.
    pub fn tell(&mut self, text: impl Into<String>) {
        self.add(text.into(), false);
    }

    fn add(&mut self, text: String, is_trouble: bool) {
        (self.messages).retain(|known| known.text != text || known.rest().is_none());
        if self.messages.len() == MOST {
            self.messages.remove(0);
        }
        self.messages.push(Message {
            text,
            is_trouble,
            since: Instant::now(),
            is_read: false,
        });
    }

    /// Those that are to be seen now.
    pub fn current(&self) -> Vec<Message> {
        let messages = self.messages.iter();
        messages.filter(|n| n.rest().is_some()).cloned().collect()
    }

    /// How long it takes until one of them goes away.
    pub fn next_change(&self) -> Option<Duration> {
        self.messages.iter().filter_map(Message::rest).min()
    }

    /// Takes a notice away that was read.
    pub fn dismiss(&mut self, text: &str) {
        for notice in &mut self.messages {
            notice.is_read |= notice.text == text;
        }
    }

    /// All that are kept, the oldest first.
    pub fn all(&self) -> &[Message] {
        &self.messages
    }
}

impl Message {
    /// How long it will be seen yet.
    fn rest(&self) -> Option<Duration> {
        let stay = STAY + READING * u32::try_from(self.text.chars().count()).unwrap_or(u32::MAX);
        (!self.is_read)
            .then(|| stay.checked_sub(self.since.elapsed()))
            .flatten()
    }
}
