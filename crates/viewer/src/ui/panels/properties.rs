//! The properties of the selection, or of the scene if nothing is selected.

mod camera;
mod environment;
mod fields;
mod light;
mod material;
mod material_rows;
mod metallic_roughness;
mod place;
mod section;

use crate::model::objects;
use crate::model::objects::Id;
use crate::ui::context::PanelContext;
use crate::ui::panels::{icon, row};
use eframe::egui::{self, vec2};
use fields::{Change, Fields};
use glimray_scene::ObjectRef;

/// Draws the properties of the selection.
pub fn properties(ui: &mut egui::Ui, context: &mut PanelContext) {
    let session = &mut *context.session;
    let Some(scene) = session.scene().cloned() else {
        return;
    };
    let mut changes: Vec<Change> = Vec::new();
    egui::Frame::new().inner_margin(6).show(ui, |ui| {
        row::scrolled(ui, |ui| {
            let selection = session
                .selection
                .filter(|id| objects::is_there(&scene, *id));
            let subject = match selection {
                Some(id) => session.label(id),
                None => "the scene".to_owned(),
            };
            ui.horizontal(|ui| {
                if let Some(id) = selection {
                    let (rect, _) = ui.allocate_exact_size(vec2(16.0, 18.0), egui::Sense::hover());
                    icon::draw(ui, rect, &scene, id, true);
                }
                let title = if selection.is_some() {
                    &subject
                } else {
                    "Scene"
                };
                ui.add(
                    egui::Label::new(egui::RichText::new(title).heading().size(15.0)).truncate(),
                );
            });
            let time = session.playback.time;
            let fields = &mut Fields::new(ui, &scene, subject, &mut changes);
            match selection {
                None => environment::show(fields, session),
                Some(Id::Camera(index)) => camera::show(fields, session, index),
                Some(Id::Material(index)) => material::show(fields, index),
                Some(id @ Id::Node(_)) => place::show(fields, id, time),
                Some(id @ Id::Object(ObjectRef::Light(index))) => {
                    place::show(fields, id, time);
                    light::show(fields, index);
                }
                Some(id @ Id::Object(object)) => {
                    place::show(fields, id, time);
                    place::shape(fields, object);
                    material::of_object(fields, session, object);
                }
            }
        });
    });
    let is_going_on = ui.input(|input| input.pointer.any_down());
    for Change { name, apply } in changes {
        match is_going_on {
            true => session.drag_change(&name, apply),
            false => session.change(&name, apply),
        };
    }
}
