//! Choices among the parts of a model's file, and among its cameras.

use crate::actions::files::{cameras, parts};
use crate::state::files::Part;
use crate::state::session::Session;
use eframe::egui::{ComboBox, Ui};

/// Draws the choice among clips, variants or scenes, if there are several.
pub fn part(ui: &mut Ui, session: &mut Session, part: Part) {
    let Some(choices) = parts::choices(session, part) else {
        return;
    };
    let own = part.left_to_the_file();
    let now = choices.chosen.map_or(own, |index| &choices.names[index]);
    let mut chosen = choices.chosen;
    ui.horizontal(|ui| {
        ui.label(part.title());
        ComboBox::from_id_salt(part.title())
            .selected_text(now)
            .truncate()
            .show_ui(ui, |ui| {
                ui.selectable_value(&mut chosen, None, own);
                for (index, name) in choices.names.iter().enumerate() {
                    ui.selectable_value(&mut chosen, Some(index), name);
                }
            })
            .response
            .on_hover_text(part.tip())
            .accessible_name(part.title());
    });
    if chosen != choices.chosen {
        parts::choose(session, part, chosen);
    }
}

/// Draws the choice among the cameras of the scene, if there are several.
pub fn camera(ui: &mut Ui, session: &mut Session) {
    let Some(count) = session.scene().map(|scene| scene.cameras.len()) else {
        return;
    };
    if count < 2 {
        return;
    }
    let views = cameras::all(session);
    let own: Vec<_> = views.iter().filter(|view| !view.is_bookmark).collect();
    let destination = session.controller.as_ref().map(|it| it.destination());
    let now = own
        .iter()
        .position(|view| Some(&view.camera) == destination.as_ref());
    let mut chosen = now;
    ui.horizontal(|ui| {
        ui.label("Camera");
        ComboBox::from_id_salt("Camera")
            .selected_text(now.map_or("Free view", |index| &own[index].name))
            .truncate()
            .show_ui(ui, |ui| {
                for (index, view) in own.iter().enumerate() {
                    ui.selectable_value(&mut chosen, Some(index), &view.name);
                }
            })
            .response
            .on_hover_text("Look through a camera of the scene")
            .accessible_name("Camera");
    });
    if let Some(index) = chosen.filter(|_| chosen != now) {
        cameras::go(session, own[index]);
    }
}
