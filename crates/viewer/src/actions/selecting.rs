//! Selecting several things, and the commands that act on all of them.

use crate::actions::editing;
use crate::model::objects::{self, Id};
use crate::state::editing::Group;
use crate::state::session::Session;

/// The effect of a click in the outline on the selection.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Pick {
    /// Selects nothing else.
    Only,
    /// Adds it, or takes it out again.
    Toggle,
    /// Selects the lines from the one clicked before to this one.
    Range,
}

impl Session {
    /// All that is selected; [`Session::selection`] comes first.
    pub fn selected(&self) -> Vec<Id> {
        let Some(lead) = self.selection else {
            return Vec::new();
        };
        let group = self.editing.group.as_ref();
        let members = group
            .filter(|group| group.lead == lead)
            .map_or(&[][..], |group| &group.members);
        let others = members.iter().copied().filter(|id| *id != lead);
        std::iter::once(lead).chain(others).collect()
    }

    /// Whether something is selected, alone or among others.
    pub fn is_selected(&self, id: Id) -> bool {
        self.selected().contains(&id)
    }

    /// Changes the selection as a click on the line of `id` does.
    pub fn pick(&mut self, id: Id, pick: Pick) {
        let mut members = self.selected();
        let group = self.editing.group.take();
        let anchor = group
            .filter(|group| Some(group.lead) == self.selection)
            .map(|group| group.anchor)
            .or(self.selection);
        let (lead, anchor) = match (pick, anchor) {
            (Pick::Only, _) | (_, None) => {
                members = vec![id];
                (id, id)
            }
            (Pick::Toggle, _) if members.contains(&id) => {
                members.retain(|other| *other != id);
                match members.first() {
                    Some(&lead) => (lead, lead),
                    None => {
                        self.selection = None;
                        return;
                    }
                }
            }
            (Pick::Toggle, _) => {
                members.push(id);
                (id, id)
            }
            (Pick::Range, Some(anchor)) => {
                members = self.editing.listing.between(anchor, id);
                (id, anchor)
            }
        };
        self.selection = Some(lead);
        self.group(lead, anchor, members);
    }

    fn group(&mut self, lead: Id, anchor: Id, members: Vec<Id>) {
        self.editing.group = (members.len() > 1).then_some(Group {
            lead,
            anchor,
            members,
        });
    }

    /// Shows or hides several things in one step.
    pub fn set_all_visible(&mut self, ids: &[Id], visible: bool) {
        if let [id] = ids {
            return self.set_visible(*id, visible);
        }
        let verb = if visible { "show" } else { "hide" };
        self.change(&format!("{verb} {} items", ids.len()), |scene| {
            ids.iter()
                .try_for_each(|id| objects::set_visible(scene, *id, visible))
        });
    }

    /// Moves things to another parent node, or to the top level for `None`, in one step. They keep their
    /// places in the world.
    pub fn set_parent(&mut self, ids: &[Id], parent: Option<usize>) {
        let what = match ids {
            [id] => self.label(*id),
            ids => format!("{} items", ids.len()),
        };
        let to = match parent {
            Some(index) => self.label(Id::Node(index)),
            None => "the top level".to_owned(),
        };
        let time = self.playback.time;
        self.change(&format!("move {what} to {to}"), |scene| {
            ids.iter()
                .try_for_each(|id| objects::set_parent(scene, *id, parent, time))
        });
    }
}

/// Hides all that is selected, or shows it if nothing of it is visible.
pub fn toggle_visible(session: &mut Session) {
    editing::with_selection(session, |session, _| {
        let ids = session.selected();
        let scene = session.scene().cloned();
        let is_any_visible =
            scene.is_some_and(|scene| ids.iter().any(|id| objects::is_visible(&scene, *id)));
        session.set_all_visible(&ids, !is_any_visible);
    });
}

/// Deletes all that is selected in one step.
pub fn remove(session: &mut Session) {
    editing::with_selection(session, |session, id| {
        let mut ids = session.selected();
        if ids.len() == 1 {
            return session.remove(id);
        }
        // From the end of each list, so that the indices of the rest stay valid.
        ids.sort_unstable_by(|a, b| b.cmp(a));
        let removed = session.change(&format!("delete {} items", ids.len()), |scene| {
            ids.iter().try_for_each(|id| objects::remove(scene, *id))
        });
        if removed.is_some() {
            session.selection = None;
            session.editing.group = None;
        }
    });
}

/// Duplicates all that is selected in one step, and selects the copies.
pub fn duplicate(session: &mut Session) {
    editing::with_selection(session, |session, id| {
        let ids = session.selected();
        if ids.len() == 1 {
            return session.duplicate(id);
        }
        let copies = session.change(&format!("duplicate {} items", ids.len()), |scene| {
            let copies = ids.iter().map(|id| objects::duplicate(scene, *id));
            copies.collect::<Result<Vec<_>, _>>()
        });
        if let Some(copies) = copies
            && let Some(&lead) = copies.first()
        {
            session.selection = Some(lead);
            session.group(lead, lead, copies);
            session
                .messages
                .notify(format!("Duplicated {} items in place", ids.len()));
        }
    });
}
