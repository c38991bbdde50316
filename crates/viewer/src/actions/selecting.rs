//! Selecting several things, and the commands that act on all of them.

use crate::actions::{editing, modal};
use crate::model::objects::{self, Id};
use crate::state::editing::Group;
use crate::state::session::Session;
use glimray_scene::ObjectRef;

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
    /// Selects exactly these; the first one leads.
    pub fn select(&mut self, ids: Vec<Id>) {
        self.selection = ids.first().copied();
        self.editing.group = None;
        if let Some(lead) = self.selection {
            self.group(lead, lead, ids);
        }
    }

    /// The label of one thing, or how many there are.
    pub fn labels(&self, ids: &[Id]) -> String {
        match ids {
            [id] => self.label(*id),
            ids => format!("{} items", ids.len()),
        }
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
            objects::set_all_visible(scene, ids, visible)
        });
    }

    /// Moves things to another parent node, or to the top level for `None`, in one step. They keep their
    /// places in the world.
    pub fn set_parent(&mut self, ids: &[Id], parent: Option<usize>) {
        let what = self.labels(ids);
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

/// Selects all visible objects and lights.
pub fn select_all(session: &mut Session) {
    let Some(scene) = session.scene().cloned() else {
        return;
    };
    let instances = (0..scene.instances.len()).map(ObjectRef::Instance);
    let shapes = (0..scene.shapes.len()).map(ObjectRef::Shape);
    let lights = (0..scene.lights.len()).map(ObjectRef::Light);
    let all = instances.chain(shapes).chain(lights).map(Id::Object);
    session.select(all.filter(|id| objects::is_visible(&scene, *id)).collect());
}

/// Deletes all that is selected in one step.
pub fn remove(session: &mut Session) {
    editing::with_selection(session, |session, _| {
        let ids = session.selected();
        let name = format!("delete {}", session.labels(&ids));
        if (session.change(&name, |scene| objects::remove(scene, &ids))).is_some() {
            session.select(Vec::new());
        }
    });
}

/// Duplicates all that is selected in one step, and selects the copies, which then follow the pointer.
pub fn duplicate(session: &mut Session) {
    editing::with_selection(session, |session, _| {
        let ids = session.selected();
        let what = session.labels(&ids);
        let copies = session.change(&format!("duplicate {what}"), |scene| {
            let copies = ids.iter().map(|id| objects::duplicate(scene, *id));
            copies.collect::<Result<Vec<_>, _>>()
        });
        if let Some(copies) = copies {
            let is_placed = copies.iter().any(|copy| matches!(copy, Id::Object(_)));
            session.select(copies);
            session.messages.notify(format!("Duplicated {what}"));
            if is_placed {
                modal::place_new(session);
            }
        }
    });
}
