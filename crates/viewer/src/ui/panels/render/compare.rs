//! The settings of a comparison, and the stills to compare with.

mod kept;

use crate::actions::comparing;
use crate::model::bindings::Action;
use crate::model::gallery::{Still, StillId};
use crate::model::view_settings::{Comparison, ErrorMap, MAX_GAIN, Sharing, Source};
use crate::state::session::Session;
use crate::ui::context::PanelContext;
use crate::ui::panels::row::row;
use crate::ui::panels::setting_rows::{line, title};
use eframe::egui::{self, Ui};
use glimray_app::value_names::INTEGRATORS;

/// Width of the button beside the second picture's name, in points.
const BESIDE: f32 = 68.0;

/// The picture without denoising.
const RAW: &str = "Without denoising";

/// The layout of the comparison, its second picture, and what belongs to both.
pub fn compare(ui: &mut Ui, context: &mut PanelContext) {
    layout(ui, context);
    if let Some(comparison) = context.session.view.comparison {
        if let Sharing::Difference(map) = comparison.sharing {
            set_gain(ui, context, map);
        }
        second(ui, context, comparison);
        size(ui, context);
    }
    stills(ui, context);
    kept::list(ui, context);
}

/// A tooltip with the shortcut of a command.
fn with_key(context: &PanelContext, tip: &str, action: Action) -> String {
    context.session.preferences.bindings.tip(tip, action)
}

fn layout(ui: &mut Ui, context: &mut PanelContext) {
    let tip = [
        with_key(
            context,
            "Show a second picture: with a wipe",
            Action::SplitWipe,
        ),
        with_key(context, "side by side", Action::SideBySide),
        with_key(context, "or as a difference", Action::ShowDifference),
    ]
    .join(", ");
    let look = &mut context.session.view;
    let mut way = look.comparison.map(|comparison| comparison.sharing);
    let before = way;
    line(ui, ("Compare", &tip), &mut way, &None, |ui, way| {
        let is_like = |other: Sharing| way.is_some_and(|way| way.is_like(other));
        let mut ways = Sharing::offered();
        let name = ways.find(|(_, other)| is_like(*other));
        let mut chosen = None;
        let list = egui::ComboBox::from_id_salt("compare")
            .truncate()
            .selected_text(name.map_or("Off", |(name, _)| name))
            .show_ui(ui, |ui| {
                if ui.selectable_label(way.is_none(), "Off").clicked() {
                    chosen = Some(None);
                }
                for (name, other) in Sharing::offered() {
                    let mut entry = ui.selectable_label(is_like(other), name);
                    if let Sharing::Difference(map) = other {
                        entry = entry.on_hover_text(map.measure.help());
                    }
                    if entry.clicked() && !is_like(other) {
                        chosen = Some(Some(other));
                    }
                }
            });
        *way = chosen.unwrap_or(*way);
        list.response
    });
    if way != before {
        match way {
            None => look.comparison = None,
            Some(sharing) => look.compare(sharing),
        }
    }
}

fn set_gain(ui: &mut Ui, context: &mut PanelContext, mut map: ErrorMap) {
    let tip = format!("Factor on the error, 1 to 100. {}", map.measure.help());
    let usual = ErrorMap::new(map.measure);
    line(ui, ("Gain", &tip), &mut map, &usual, |ui, map| {
        let value = egui::DragValue::new(&mut map.gain).range(1.0..=MAX_GAIN);
        let size = egui::vec2(ui.available_width(), ui.spacing().interact_size.y);
        ui.add_sized(size, value.speed(0.1).max_decimals(1).suffix(" ×"))
    });
    if let Some(comparison) = &mut context.session.view.comparison {
        comparison.sharing = Sharing::Difference(map);
    }
}

/// The second picture: a view mode or a still.
fn second(ui: &mut Ui, context: &mut PanelContext, comparison: Comparison) {
    let swap = with_key(context, "Swap comparison sides", Action::SwapSides);
    let tip = "A view mode of the scene, the picture without denoising, a snapshot or a reference picture";
    let session = &mut *context.session;
    let chosen = match comparison.source {
        Source::Integrator(integrator) => title(INTEGRATORS.name(&integrator)),
        Source::Still(_) => session
            .still()
            .map(|still| still.name.clone())
            .unwrap_or_default(),
        Source::Raw => RAW.to_owned(),
    };
    let mut source = comparison.source;
    row(ui, ("Compared with", tip), |ui, label| {
        let list = egui::ComboBox::from_id_salt("second")
            .selected_text(chosen)
            .width(ui.available_width() - BESIDE)
            .truncate()
            .show_ui(ui, |ui| {
                for (word, help, integrator) in INTEGRATORS.all() {
                    // Aliases of the same value are left out.
                    if INTEGRATORS.name(integrator) == *word {
                        let value = Source::Integrator(*integrator);
                        ui.selectable_value(&mut source, value, title(word))
                            .on_hover_text(*help);
                    }
                }
                if session.view.tone.denoise || source == Source::Raw {
                    ui.selectable_value(&mut source, Source::Raw, RAW)
                        .on_hover_text("The picture as it is before it is denoised");
                }
                for still in session.comparing.gallery.all() {
                    ui.selectable_value(&mut source, Source::Still(still.id), &still.name)
                        .on_hover_text(told(still));
                }
            });
        if let Some(label) = label {
            let tip = session.still().map_or(tip.to_owned(), told);
            list.response.labelled_by(label).on_hover_text(tip);
        }
        match comparison.source {
            Source::Integrator(_) => {
                if ui.button("Swap").on_hover_text(swap).clicked() {
                    session.view.swap_sides();
                    source = session.view.comparison.map_or(source, |it| it.source);
                }
            }
            Source::Still(id) => remove(ui, session, id),
            Source::Raw => {}
        }
    });
    if source != comparison.source {
        context.session.view.compare_with(source);
    }
}

fn remove(ui: &mut Ui, session: &mut Session, still: StillId) {
    let button = ui.button("Remove");
    if button.on_hover_text("Forget this picture").clicked() {
        comparing::remove(session, still);
    }
}

/// Describes a still and whether tone mapping applies to it.
fn told(still: &Still) -> String {
    let (width, height) = still.size();
    let tone = match still.is_radiance {
        true => "Linear radiance: exposure and tone curve apply",
        false => "Display values: shown as they are",
    };
    format!("{}\n{width}×{height} pixels\n{tone}", still.detail)
}

/// Offers the size of a still for the picture, so that pixels match.
fn size(ui: &mut Ui, context: &mut PanelContext) {
    let Some(size) = context.session.still().map(Still::size) else {
        return;
    };
    if size == context.session.picture_size() {
        return;
    }
    let (width, height) = size;
    let tip = "The other picture is scaled to the height of this one. Render this one at its size instead";
    let is_wished = row(ui, ("", tip), |ui, _| {
        let button = ui.button(format!("Render at {width}×{height}"));
        button.on_hover_text(tip).clicked()
    });
    if is_wished {
        context.session.view.fits = false;
        context.session.view.settings.size = size;
    }
}

/// The buttons that add stills.
fn stills(ui: &mut Ui, context: &mut PanelContext) {
    let (keep, open) = (Action::KeepSnapshot, Action::OpenReference);
    let tip = "Keep or open a picture to compare with";
    row(ui, ("Comparison picture", tip), |ui, _| {
        ui.horizontal_wrapped(|ui| {
            for (text, action) in [("Snapshot", keep), ("Open…", open)] {
                let tip = with_key(context, action.description(), action);
                if ui.button(text).on_hover_text(tip).clicked() {
                    context.session.clicked.push(action);
                }
            }
        });
    });
}
