//! Materials that are added, and dropped on objects.

use crate::actions::surface::surface_at;
use crate::model::material_presets::MaterialPreset;
use crate::model::objects::{self, Id, unused_name};
use crate::model::tool::Purpose;
use crate::state::session::Session;
use glimray_scene::ObjectRef;

/// Adds a material in one step. The selected objects get it; without any, the material is selected.
pub fn add(session: &mut Session, preset: MaterialPreset) {
    let Some(scene) = session.scene() else {
        return;
    };
    let name = unused_name(scene, preset.title());
    let takers = selected_surfaces(session);
    let added = session.change(&format!("add {name}"), |scene| {
        let index = preset.add_to(scene);
        objects::assign_all(scene, &takers, index)?;
        Ok(index)
    });
    let Some(index) = added else {
        return;
    };
    session.messages.notify(match takers.as_slice() {
        [] => format!("Added {name}"),
        [one] => format!("Added {name} to {}", session.label(Id::Object(*one))),
        several => format!("Added {name} to {} items", several.len()),
    });
    if takers.is_empty() {
        session.select(vec![Id::Material(index)]);
    }
}

/// The selected objects that have a material.
pub fn selected_surfaces(session: &Session) -> Vec<ObjectRef> {
    let Some(scene) = session.scene() else {
        return Vec::new();
    };
    let surface = |id| match id {
        Id::Object(ObjectRef::Light(_)) => None,
        Id::Object(object) => objects::is_there(scene, id).then_some(object),
        _ => None,
    };
    session.selected().into_iter().filter_map(surface).collect()
}

/// Gives a material to an object in one step; if that is selected, to all selected objects.
pub fn assign(session: &mut Session, material: usize, object: ObjectRef) {
    let takers = match session.is_selected(Id::Object(object)) {
        true => selected_surfaces(session),
        false => Vec::new(),
    };
    // A light is refused by name.
    let takers = if takers.contains(&object) {
        takers
    } else {
        vec![object]
    };
    let ids: Vec<Id> = takers.iter().copied().map(Id::Object).collect();
    let (what, to) = (session.label(Id::Material(material)), session.labels(&ids));
    session.change(&format!("give {what} to {to}"), |scene| {
        objects::assign_all(scene, &takers, material)
    });
}

/// Asks what a pixel shows over which a material is dragged, one question at a time. Notes the last answer.
pub fn hover(session: &mut Session, pixel: [u32; 2]) {
    let Some(dropping) = &mut session.editing.dropping else {
        return;
    };
    let (is_known, waits) = match dropping.asked {
        Some((of, Some(object))) => {
            dropping.next = object;
            (of == pixel, false)
        }
        Some((_, None)) => {
            dropping.next = dropping.over;
            (false, true)
        }
        None => (false, false),
    };
    if !is_known && !waits {
        dropping.asked = Some((pixel, None));
        session.ask(move |frame| surface_at(frame, pixel, Purpose::Hover));
    }
}

/// Takes the answer to [`hover`].
pub fn hovered(session: &mut Session, object: Option<ObjectRef>) {
    if let Some(dropping) = &mut session.editing.dropping
        && let Some((_, answer)) = &mut dropping.asked
    {
        *answer = Some(object);
    }
}

/// Gives a material to the object that a pixel of the picture shows.
pub fn drop_on(session: &mut Session, material: usize, pixel: [u32; 2]) {
    session.ask(move |frame| surface_at(frame, pixel, Purpose::Assign(material)));
}
