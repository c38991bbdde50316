//! The dialog for a film.

use crate::actions::files::film;
use crate::state::film::{FilmDialog, FilmFormat, FilmMotion, MAX_FRAME};
use crate::state::jobs::Jobs;
use crate::state::session::Session;
use crate::ui::panels::render::seconds;
use eframe::egui::{self, Button, DragValue, Grid, Key, TextEdit, Ui, vec2};

/// Largest width and height, in pixels.
const MAX_SIDE: u32 = 16_384;

/// The user's choice.
enum Wish {
    Browse,
    Start,
    Cancel,
}

/// Draws the dialog for a film, if it is open.
pub fn show(ctx: &egui::Context, session: &mut Session) {
    let duration = session.playback.duration();
    let is_animated = duration > 0.0;
    // A dialog does not lock the panels, where the background may change.
    let has_opacity = film::has_opacity(session);
    let files = &mut session.files;
    let (Some(dialog), jobs) = (&mut files.film, &files.jobs) else {
        return;
    };
    dialog.has_opacity = has_opacity;
    let mut wish = None;
    let stays = crate::ui::dialogs::window(ctx, "Film", vec2(460.0, 330.0), |ui| {
        wish = name(ui, dialog);
        super::folder(ui, &dialog.path);
        Grid::new("film")
            .num_columns(2)
            .spacing([12.0, 6.0])
            .show(ui, |ui| {
                ui.label("Format");
                ui.horizontal(|ui| formats(ui, dialog, jobs));
                ui.end_row();
                ui.label("Motion");
                ui.horizontal(|ui| {
                    let animation = "The scene moves by its own animation";
                    ui.add_enabled_ui(is_animated, |ui| {
                        ui.radio_value(&mut dialog.motion, FilmMotion::Animation, "Animation")
                            .on_hover_text(animation)
                            .on_disabled_hover_text("Nothing moves in this scene");
                    });
                    ui.radio_value(&mut dialog.motion, FilmMotion::Turntable, "Turntable")
                        .on_hover_text("The camera goes once round the pivot of this view");
                });
                ui.end_row();
                let last = dialog.last_frame(duration);
                extent(ui, dialog, last);
                ui.end_row();
                ui.label("Frame rate");
                ui.horizontal(|ui| {
                    let mut fps = dialog.fps;
                    let rate = DragValue::new(&mut fps).range(0.01..=1000.0).speed(0.1);
                    ui.add(rate.suffix(" frames/s"))
                        .accessible_name("Frame rate");
                    if fps != dialog.fps {
                        dialog.set_fps(fps, duration);
                    }
                    let length = f64::from(dialog.count()) / dialog.fps;
                    ui.weak(format!("{} frames, {}", dialog.count(), seconds(length)));
                });
                ui.end_row();
                ui.label("Size");
                ui.horizontal(|ui| {
                    let [width, height] = &mut dialog.size;
                    side(ui, width, "Width");
                    ui.label("×");
                    side(ui, height, "Height");
                });
                ui.end_row();
                ui.label("Samples");
                ui.horizontal(|ui| {
                    let most = crate::model::view_settings::MAX_SAMPLES;
                    let samples = DragValue::new(&mut dialog.samples).range(1..=most);
                    ui.add(samples).accessible_name("Samples of a frame");
                    ui.checkbox(&mut dialog.denoise, "Denoise");
                });
                ui.end_row();
            });
        let target = dialog.target();
        match &target {
            Err(why) => {
                ui.colored_label(ui.visuals().error_fg_color, why);
            }
            Ok(target) if dialog.must_ask(target) => {
                let text = match target.video {
                    Some(_) => "A file with this name exists and will be replaced.",
                    None => "Frames with this name exist. Those of another film will be replaced.",
                };
                ui.colored_label(ui.visuals().warn_fg_color, text);
            }
            Ok(_) => {}
        }
        ui.add_space(6.0);
        ui.horizontal(|ui| {
            let replaces = target.as_ref().is_ok_and(|target| dialog.must_ask(target));
            let text = if replaces { "Replace" } else { "Start" };
            if ui.add_enabled(target.is_ok(), Button::new(text)).clicked() {
                wish = Some(Wish::Start);
            }
            if ui.button("Cancel").clicked() {
                wish = Some(Wish::Cancel);
            }
        });
    });
    match wish {
        Some(Wish::Browse) => film::browse(session, ctx),
        Some(Wish::Start) => film::start(session),
        None if stays => {}
        Some(Wish::Cancel) | None => session.files.film = None,
    }
}

/// The file, and the choice among files.
fn name(ui: &mut Ui, dialog: &mut FilmDialog) -> Option<Wish> {
    let mut wish = None;
    ui.horizontal(|ui| {
        let width = ui.available_width() - 90.0;
        let field = TextEdit::singleline(&mut dialog.path).desired_width(width);
        let field = ui.add(field).accessible_name("File");
        if std::mem::take(&mut dialog.is_new) {
            field.request_focus();
        }
        let is_entered = field.lost_focus() && ui.input(|input| input.key_pressed(Key::Enter));
        // Replacing a file requires a click, not just Enter.
        let is_free = || (dialog.target()).is_ok_and(|target| !dialog.must_ask(&target));
        if is_entered && is_free() {
            wish = Some(Wish::Start);
        }
        let button = ui.button("Browse…").on_hover_text("Choose a file");
        if button.clicked() {
            wish = Some(Wish::Browse);
        }
    });
    wish
}

/// The formats that are offered; each changes the ending of the name.
fn formats(ui: &mut Ui, dialog: &mut FilmDialog, jobs: &Jobs) {
    let now = FilmFormat::of(&dialog.typed());
    for (format, title, ending) in FilmFormat::OFFERED {
        if ui.radio(now == Some(format), title).clicked() {
            dialog.set_ending(ending, |path| jobs.is_reserved(path));
        }
    }
}

/// The frames of an animation, or the duration and direction of a turn.
fn extent(ui: &mut Ui, dialog: &mut FilmDialog, last: u32) {
    match dialog.motion {
        FilmMotion::Animation => {
            ui.label("Frames");
            ui.horizontal(|ui| {
                let [first, end] = &mut dialog.range;
                ui.add(DragValue::new(first).range(0..=MAX_FRAME))
                    .accessible_name("First frame of the film");
                ui.label("to");
                ui.add(DragValue::new(end).range(0..=MAX_FRAME))
                    .accessible_name("Last frame of the film");
                if *end > last {
                    ui.weak(format!("the animation ends at {last}"));
                }
            });
        }
        FilmMotion::Turntable => {
            ui.label("Turn");
            ui.horizontal(|ui| {
                let seconds = DragValue::new(&mut dialog.seconds).range(0.01..=10_000.0);
                let seconds = seconds.speed(0.05).suffix(" s");
                ui.add(seconds).accessible_name("Duration of a turn");
                ui.checkbox(&mut dialog.clockwise, "Clockwise")
                    .on_hover_text("The scene appears to turn clockwise, seen from above");
            });
        }
    }
}

/// A width or a height.
fn side(ui: &mut Ui, value: &mut u32, name: &str) {
    ui.add(DragValue::new(value).range(1..=MAX_SIDE))
        .accessible_name(format!("{name} of a frame"));
}
