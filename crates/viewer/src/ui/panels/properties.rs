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
use fields::{Change, Compared, Drawing, Edit, Fields, Key, Moment, Options, Peers};
use glimray_scene::{ObjectRef, Scene};
use std::collections::HashMap;
use std::sync::{Arc, Weak};

/// Draws the properties of the selection.
pub fn properties(ui: &mut egui::Ui, context: &mut PanelContext) {
    let session = &mut *context.session;
    let Some(scene) = session.scene().cloned() else {
        session.show_ball(None);
        return;
    };
    let selected = session.selected();
    let moment = Moment::new(&scene, session.playback.time);
    let compared = Comparison::of(ui.ctx(), &scene, &moment, session, &selected);
    let mut drawing = Drawing {
        others: compared.rows.clone(),
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
            let fields = &mut Fields::drawn(ui, &mut drawing, (&scene, &moment), subject);
            match selection {
                None => environment::show(fields, session),
                Some(id) => rows(fields, session, id),
            }
        });
    });
    compared.follow(ui.ctx(), &drawing.options);
    context.textures.thumbnails = std::mem::take(&mut drawing.thumbnails);
    apply(ui, session, drawing, (&scene, &moment), &selected);
}

/// Does what was asked for in the rows.
fn apply(
    ui: &egui::Ui,
    session: &mut Session,
    drawing: Drawing,
    (scene, moment): (&Scene, &Moment),
    selected: &[Id],
) {
    let options = &drawing.options;
    let mut changes = drawing.changes;
    for Edit { name, key, apply } in drawing.edits {
        let mut peers = Peers::to_edit(options.clone(), key);
        read(&mut peers, (scene, moment), session, selected);
        let apply = Box::new(move |scene: &mut Scene| apply(scene, peers));
        changes.push(Change { name, apply });
    }
    let is_going_on = ui.input(|input| input.pointer.any_down());
    for Change { name, apply } in changes {
        match is_going_on {
            true => session.drag_change(&name, apply),
            false => session.change(&name, apply),
        };
    }
    if let Some((index, slot)) = drawing.opens {
        let mut peers = Peers::to_compare(drawing.options);
        read(&mut peers, (scene, moment), session, selected);
        let others = peers.materials.into_iter().filter(|it| *it != index);
        texturing::ask(
            session,
            ui.ctx(),
            slot,
            std::iter::once(index).chain(others),
        );
    }
    let side = (BALL * ui.ctx().pixels_per_point()).round() as u32;
    session.show_ball(drawing.ball_of.map(|index| (index, side.max(1))));
}

/// The rows of one thing.
fn rows(fields: &mut Fields, session: &mut Session, id: Id) {
    match id {
        Id::Camera(index) => camera::show(fields, session, index),
        Id::Material(index) if fields.is_new_material(index) => material::show(fields, index),
        Id::Material(_) => {}
        Id::Node(_) => place::show(fields, id),
        Id::Object(ObjectRef::Light(index)) => {
            place::show(fields, id);
            light::show(fields, index);
        }
        Id::Object(object) => {
            place::show(fields, id);
            place::shape(fields, object);
            material::of_object(fields, session, object);
        }
    }
}

/// The rows of what is selected besides the first, compared: kept until anything of this changes.
struct Comparison {
    of: (Weak<Scene>, Vec<Id>, f64, Options),
    rows: Arc<HashMap<Key, Compared>>,
}

impl Comparison {
    /// Compares the rows of the selection of a scene, or takes those of the last frame.
    fn of(
        ctx: &egui::Context,
        scene: &Arc<Scene>,
        moment: &Moment,
        session: &mut Session,
        selected: &[Id],
    ) -> Arc<Self> {
        let id = egui::Id::unique("compared rows");
        let before: Option<Arc<Self>> = ctx.data(|data| data.get_temp(id));
        let time = session.playback.time;
        if let Some(before) = &before
            && before.is_of(scene, selected, time)
        {
            return before.clone();
        }
        let options = before.map_or_else(Options::default, |it| it.of.3.clone());
        let mut peers = Peers::to_compare(options.clone());
        read(&mut peers, (scene, moment), session, selected);
        let new = Arc::new(Self {
            of: (Arc::downgrade(scene), selected.to_vec(), time, options),
            rows: peers.compared().into(),
        });
        ctx.data_mut(|data| data.insert_temp(id, new.clone()));
        new
    }

    fn is_of(&self, scene: &Arc<Scene>, selected: &[Id], time: f64) -> bool {
        let (of, ids, at, _) = &self.of;
        of.as_ptr() == Arc::as_ptr(scene) && ids == selected && *at == time
    }

    /// Lets the rows be compared anew with the options of what is shown, if these are others.
    fn follow(&self, ctx: &egui::Context, options: &Options) {
        if self.of.3 != *options {
            let id = egui::Id::unique("compared rows");
            let anew = Self {
                of: (Weak::new(), Vec::new(), 0.0, options.clone()),
                rows: Arc::default(),
            };
            ctx.data_mut(|data| data.insert_temp(id, Arc::new(anew)));
            ctx.request_repaint();
        }
    }
}

/// Reads the rows of what is selected besides the first.
fn read(
    peers: &mut Peers,
    (scene, moment): (&Scene, &Moment),
    session: &mut Session,
    selected: &[Id],
) {
    let Some((lead, others)) = selected.split_first() else {
        return;
    };
    match *lead {
        _ if !objects::is_there(scene, *lead) => return,
        Id::Material(index) => peers.materials.extend([index]),
        Id::Object(object) => peers.materials.extend(objects::materials_of(scene, object)),
        Id::Node(_) | Id::Camera(_) => {}
    }
    for id in others {
        if objects::is_there(scene, *id) {
            rows(&mut Fields::read(peers, (scene, moment)), session, *id);
        }
    }
}
