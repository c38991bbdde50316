//! The visible rows of the outline, updated when the scene or the search changes.

use crate::model::objects::Id;
use crate::model::outline::{Entry, Outline};
use glimray_scene::Scene;
use std::collections::{HashMap, HashSet};
use std::ops::Range;
use std::sync::Arc;

/// An [`Outline`] and its visible rows.
#[derive(Default)]
pub struct Listing {
    /// The search text.
    pub query: String,
    scene: Option<Arc<Scene>>,
    outline: Outline,
    lines: HashMap<Id, usize>,
    searched: String,
    /// Indices of the visible rows.
    shown: Vec<usize>,
    /// Groups whose contents are hidden.
    folded: HashSet<Group>,
}

/// A line that other lines can be below: a node, or a heading by its label.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
enum Group {
    Node(Id),
    Heading(String),
}

impl Group {
    fn of(entry: &Entry) -> Self {
        match entry.id {
            Some(id) => Self::Node(id),
            None => Self::Heading(entry.label.clone()),
        }
    }
}

impl Listing {
    /// Updates the rows for a scene and a search text.
    pub fn update(&mut self, scene: &Arc<Scene>) {
        let is_known = self.lists(scene);
        if !is_known {
            self.outline = Outline::of(scene);
            self.lines = (self.outline.entries.iter().enumerate())
                .filter_map(|(index, entry)| Some((entry.id?, index)))
                .collect();
            self.scene = Some(scene.clone());
        }
        if !is_known || self.searched != self.query {
            self.searched.clone_from(&self.query);
            self.list();
        }
    }

    /// Finds the lines that are shown.
    fn list(&mut self) {
        self.shown = self.outline.search(&self.query);
        // A search finds lines in folded groups too.
        if self.query.trim().is_empty() {
            self.leave_out_folded();
        }
    }

    fn leave_out_folded(&mut self) {
        let (entries, folded) = (&self.outline.entries, &self.folded);
        // The depth of the folded group that the current line may be in.
        let mut limit = usize::MAX;
        self.shown.retain(|index| {
            let entry = &entries[*index];
            if entry.depth > limit {
                return false;
            }
            let is_folded = folded.contains(&Group::of(entry));
            limit = if is_folded { entry.depth } else { usize::MAX };
            true
        });
    }

    /// Whether the children of a shown line are folded; `None` for a line without children.
    pub fn fold(&self, row: usize) -> Option<bool> {
        let index = *self.shown.get(row)?;
        let entry = &self.outline.entries[index];
        let next = self.outline.entries.get(index + 1)?;
        (next.depth > entry.depth).then(|| self.folded.contains(&Group::of(entry)))
    }

    /// Folds or unfolds the children of a shown line.
    pub fn toggle_fold(&mut self, row: usize) {
        let Some(index) = self.shown.get(row) else {
            return;
        };
        let group = Group::of(&self.outline.entries[*index]);
        if !self.folded.remove(&group) {
            self.folded.insert(group);
        }
        self.list();
    }

    /// Unfolds the groups that something is in, so that its line is shown.
    pub fn reveal(&mut self, id: Id) {
        let Some(&line) = self.lines.get(&id) else {
            return;
        };
        let mut depth = self.outline.entries[line].depth;
        let mut is_folded = false;
        for entry in self.outline.entries[..line].iter().rev() {
            if entry.depth < depth {
                depth = entry.depth;
                is_folded |= self.folded.remove(&Group::of(entry));
            }
        }
        if is_folded {
            self.list();
        }
    }

    /// The items from one shown line to another, both included, in the order of the outline.
    pub fn between(&self, a: Id, b: Id) -> Vec<Id> {
        let (Some(a), Some(b)) = (self.row_of(a), self.row_of(b)) else {
            return Vec::new();
        };
        let rows = self.rows(a.min(b)..a.max(b) + 1);
        rows.filter_map(|entry| entry.id).collect()
    }

    fn lists(&self, scene: &Arc<Scene>) -> bool {
        (self.scene.as_ref()).is_some_and(|known| Arc::ptr_eq(known, scene))
    }

    /// Number of visible rows.
    pub fn count(&self) -> usize {
        self.shown.len()
    }

    /// A range of the visible rows.
    pub fn rows(&self, range: Range<usize>) -> impl Iterator<Item = &Entry> + '_ {
        let shown = self.shown.get(range).unwrap_or_default();
        shown.iter().map(|index| &self.outline.entries[*index])
    }

    /// Index of something among the visible rows.
    pub fn row_of(&self, id: Id) -> Option<usize> {
        let line = self.lines.get(&id)?;
        self.shown.binary_search(line).ok()
    }

    /// The label of something in `scene` if that is the scene listed. A hidden outline is not updated.
    pub fn label(&self, scene: &Arc<Scene>, id: Id) -> Option<&str> {
        if !self.lists(scene) {
            return None;
        }
        let line = self.lines.get(&id)?;
        Some(&self.outline.entries[*line].label)
    }

    /// The item some rows after the selection.
    pub fn step(&self, from: Option<Id>, steps: isize) -> Option<Id> {
        let things: Vec<Id> = (self.shown.iter())
            .filter_map(|index| self.outline.entries[*index].id)
            .collect();
        let at = from.and_then(|id| things.iter().position(|other| *other == id));
        let last = things.len().checked_sub(1)? as isize;
        let next = at.map_or(0, |at| at as isize + steps);
        things.get(next.clamp(0, last) as usize).copied()
    }
}
