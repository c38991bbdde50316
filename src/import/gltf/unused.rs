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

/// Properties and entries of a model that are not used.
#[derive(Default)]
pub(super) struct Unused {
    /// By the pattern of their name, which has `[]` for each index.
    found: BTreeMap<String, Alike>,
    /// By the pattern, how often a property is there that says nothing about the picture.
    idle: BTreeMap<String, usize>,
    /// Properties beyond [`MOST`] different ones.
    more: usize,
}

impl Unused {
    /// Adds a property that is not used, by its pattern and its own name.
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
            self.more += 1;
        }
    }

    /// A sentence for each name.
    pub fn into_lines(self) -> Vec<String> {
        let times = |count: usize| match count {
            1 => String::new(),
            _ => format!(" ({count} times)"),
        };
        let found = self.found.into_values();
        let mut lines: Vec<String> = found
            .map(|it| format!("{} is not used: {}{}", it.first, it.why, times(it.count)))
            .collect();
        if self.more > 0 {
            lines.push(format!("{} more properties are not used", self.more));
        }
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
