//! The visible rows of the outline, updated when the scene or the search changes.

use crate::scene::Scene;
use crate::viewer::model::objects::Id;
use crate::viewer::model::outline::{Entry, Outline};
use std::collections::HashMap;
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
}

impl Listing {
    /// Updates the rows for a scene and a search text.
    pub fn follow(&mut self, scene: &Arc<Scene>) {
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
            self.shown = self.outline.search(&self.query);
        }
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
