//! Choices among the parts of a model's file, and among its cameras.

use crate::actions::files::{cameras, parts};
use crate::state::files::Part;
use crate::state::session::Session;
use crate::ui::panels::row::row;
use eframe::egui::{ComboBox, Ui};

/// Draws the choice among clips, variants or scenes, if there are several.
pub fn part(ui: &mut Ui, session: &mut Session, part: Part) {
    let Some(choices) = parts::choices(session, part) else {
        return;
    };
    let own = part.left_to_the_file();
    let now = choices.chosen.map_or(own, |index| &choices.names[index]);
    let names = choices.names.iter().map(String::as_str);
    let options = [(None, own)].into_iter().chain(numbered(names));
    let label = (part.title(), part.tip());
    let chosen = choice(ui, label, now, choices.chosen, options);
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
    let shown = now.map_or("Free view", |index| &own[index].name);
    let options = numbered(own.iter().map(|view| view.name.as_str()));
    let label = ("Camera", "Look through a camera of the scene");
    let chosen = choice(ui, label, shown, now, options);
    if let Some(index) = chosen.filter(|_| chosen != now) {
        cameras::go(session, own[index]);
    }
}

/// Options by their index.
fn numbered<'a>(
    names: impl Iterator<Item = &'a str>,
) -> impl Iterator<Item = (Option<usize>, &'a str)> {
    names.enumerate().map(|(index, name)| (Some(index), name))
}

/// Draws a choice with a label and a tooltip, which shows `now`. Returns the chosen option.
fn choice<'a>(
    ui: &mut Ui,
    (title, tip): (&str, &str),
    now: &str,
    mut chosen: Option<usize>,
    options: impl Iterator<Item = (Option<usize>, &'a str)>,
) -> Option<usize> {
    row(ui, (title, tip), |ui, label| {
        let list = ComboBox::from_id_salt(title)
            .selected_text(now)
            .truncate()
            .show_ui(ui, |ui| {
                for (option, name) in options {
                    ui.selectable_value(&mut chosen, option, name);
                }
            })
            .response
            .on_hover_text(tip);
        if let Some(label) = label {
            list.labelled_by(label);
        }
    });
    chosen
}
