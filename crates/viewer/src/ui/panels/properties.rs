//! The properties of the selection, or of the scene if nothing is selected.

mod ball;
mod camera;
mod environment;
mod fields;
mod light;
mod material;
mod material_rows;
mod metallic_roughness;
mod place;
mod section;
mod texture_rows;

use crate::actions::texturing;
use crate::model::objects;
use crate::model::objects::Id;
use crate::state::session::Session;
use crate::ui::context::PanelContext;
use crate::ui::panels::{icon, row};
use ball::BALL;
use eframe::egui::{self, vec2};
use fields::{Change, Drawing, Fields, Peers};
use glimray_scene::{ObjectRef, Scene};

/// Draws the properties of the selection.
pub fn properties(ui: &mut egui::Ui, context: &mut PanelContext) {
    let session = &mut *context.session;
    let Some(scene) = session.scene().cloned() else {
        session.show_ball(None);
        return;
    };
    let selected = session.selected();
    let mut drawing = Drawing {
        peers: peers(&scene, session, &selected),
        thumbnails: std::mem::take(&mut context.textures.thumbnails),
        ball: (context.render.ball()).map(|screen| context.textures.id(&screen, true)),
        names: session.files.texturing.names().to_vec(),
        ..Drawing::default()
    };
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
            if let Some(others) = selected.len().checked_sub(1).filter(|others| *others > 0) {
                ui.weak(format!(
                    "{others} more selected. Edits change all that have the row."
                ));
            }
            let fields = &mut Fields::drawn(ui, &mut drawing, &scene, subject);
            match selection {
                None => environment::show(fields, session),
                Some(id) => rows(fields, session, id),
            }
        });
    });
    let is_going_on = ui.input(|input| input.pointer.any_down());
    for Change { name, apply } in drawing.changes {
        match is_going_on {
            true => session.drag_change(&name, apply),
            false => session.change(&name, apply),
        };
    }
    if let Some(place) = drawing.opens {
        texturing::ask(session, ui.ctx(), place);
    }
    let side = (BALL * ui.ctx().pixels_per_point()).round() as u32;
    session.show_ball(drawing.ball_of.map(|index| (index, side.max(1))));
    context.textures.thumbnails = drawing.thumbnails;
}

/// The rows of one thing.
fn rows(fields: &mut Fields, session: &mut Session, id: Id) {
    let time = session.playback.time;
    match id {
        Id::Camera(index) => camera::show(fields, session, index),
        Id::Material(index) if fields.is_new_material(index) => material::show(fields, index),
        Id::Material(_) => {}
        Id::Node(_) => place::show(fields, id, time),
        Id::Object(ObjectRef::Light(index)) => {
            place::show(fields, id, time);
            light::show(fields, index);
        }
        Id::Object(object) => {
            place::show(fields, id, time);
            place::shape(fields, object);
            material::of_object(fields, session, object);
        }
    }
}

/// The rows of what is selected besides the first.
fn peers(scene: &Scene, session: &mut Session, selected: &[Id]) -> Peers {
    let mut peers = Peers::default();
    let Some((lead, others)) = selected.split_first() else {
        return peers;
    };
    match *lead {
        _ if !objects::is_there(scene, *lead) => return peers,
        Id::Material(index) => peers.materials.extend([index]),
        Id::Object(object) => peers.materials.extend(objects::materials_of(scene, object)),
        Id::Node(_) | Id::Camera(_) => {}
    }
    for id in others {
        if objects::is_there(scene, *id) {
            rows(&mut Fields::read(&mut peers, scene), session, *id);
        }
    }
    peers
}
