//! Parts of a model that no picture shows, by name: properties of the same name in the entries of a list share one line.

use std::collections::BTreeMap;

/// Most different names that are told apart.
const MOST: usize = 100;

/// Properties that are alike: where the first one is, how many there are, and why they are not used.
struct Alike {
    first: String,
    count: usize,
    why: &'static str,
}

/// Properties by the pattern of their name, which has `[]` for each index.
#[derive(Default)]
pub(super) struct Tally {
    found: BTreeMap<String, Alike>,
    /// Properties beyond [`MOST`] different ones.
    more: usize,
}

impl Tally {
    /// Adds a property by its pattern and its own name.
    pub fn add(&mut self, pattern: String, first: impl FnOnce() -> String, why: &'static str) {
        if let Some(alike) = self.found.get_mut(&pattern) {
            alike.count += 1;
        } else if self.found.len() < MOST {
            let (first, count, why) = (first(), 1, why);
            self.found.insert(pattern, Alike { first, count, why });
        } else {
            self.more += 1;
        }
    }

    /// A sentence for each name, made of it and the reason, and one for the rest, which are not `known` or `used`.
    pub fn into_lines(self, sentence: impl Fn(&str, &str) -> String, what: &str) -> Vec<String> {
        let found = self.found.into_values();
        let mut lines: Vec<String> = found
            .map(|it| sentence(&it.first, it.why) + &times(it.count))
            .collect();
        if self.more > 0 {
            lines.push(format!("{} more properties are not {what}", self.more));
        }
        lines
    }
}

fn times(count: usize) -> String {
    match count {
        1 => String::new(),
        _ => format!(" ({count} times)"),
    }
}

/// Properties and entries of a model that are not used.
#[derive(Default)]
pub(super) struct Unused {
    tally: Tally,
    /// By the pattern, how often a property is there that says nothing about the picture.
    idle: BTreeMap<String, usize>,
}

impl Unused {
    /// Adds a property that is not used, by its pattern and its own name.
    pub fn add(&mut self, pattern: String, first: impl FnOnce() -> String, why: &'static str) {
        self.tally.add(pattern, first, why);
    }

    /// Adds `property` of the entry `index` of `list`; all of the entry if it is empty.
    pub fn of(&mut self, list: &str, index: usize, property: &str, why: &'static str) {
        let dot = if property.is_empty() { "" } else { "." };
        let pattern = format!("{list}[]{dot}{property}");
        self.add(pattern, || format!("{list}[{index}]{dot}{property}"), why);
    }

    /// Adds a property that says nothing about the picture, by its pattern.
    pub fn idle(&mut self, pattern: String) {
        if self.idle.len() < MOST || self.idle.contains_key(&pattern) {
            *self.idle.entry(pattern).or_default() += 1;
        } else {
            self.tally.more += 1;
        }
    }

    /// A sentence for each name.
    pub fn into_lines(self) -> Vec<String> {
        let sentence = |first: &str, why: &str| format!("{first} is not used: {why}");
        let mut lines = self.tally.into_lines(sentence, "used");
        if !self.idle.is_empty() {
            let names = self.idle.into_iter();
            let names: Vec<String> = names
                .map(|(name, count)| format!("{name}{}", times(count)))
                .collect();
            lines.push(format!(
                "without effect on the picture: {}",
                names.join(", ")
            ));
        }
        lines
    }
}
