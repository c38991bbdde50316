//! Questions that must be answered first: file names and unsaved changes.

use crate::actions::adding;
use crate::actions::comparing;
use crate::actions::files;
use crate::actions::files::pictures;
use crate::actions::texturing;
use crate::state::files::{Intent, SaveSize};
use crate::state::jobs::Job;
use crate::state::session::Session;
use crate::ui::context::PanelContext;
use crate::worker::progressive_image::PictureSlot;
use eframe::egui::{self, Align2, Button, Key, Modal, RichText, Slider, TextEdit, Ui, vec2};
use glimray_io::output::Format;
use std::path::PathBuf;

/// The user's decision about unsaved changes.
pub enum Choice {
    /// Save, then continue.
    Save(Intent),
    /// Continue without saving.
    GoOn(Intent),
}

/// The dialogs for a typed path to open.
pub fn typed(ctx: &egui::Context, session: &mut Session) {
    let hint = "A scene, a folder of scenes, or an environment image";
    if let Some(path) = path(ctx, "Open a path", hint, &mut session.files.typed) {
        files::open(session, vec![path]);
    }
    let hint = "A model or a scene";
    if let Some(path) = path(ctx, "Add a model", hint, &mut session.files.typed_model) {
        adding::add_model(session, path);
    }
    if let Some(typed) = session.files.texturing.typed() {
        let hint = "A PNG, JPEG, WebP, KTX2, EXR or HDR file";
        if let Some(path) = path(ctx, "Open a picture for the material", hint, typed) {
            texturing::open_typed(session, path);
        }
    }
    let (title, hint) = (
        "Open a reference picture",
        "A PNG, JPEG, WebP, KTX2, EXR or HDR file",
    );
    if let Some(path) = path(ctx, title, hint, &mut session.comparing.typed) {
        comparing::open_reference(session, path);
    }
}

/// Draws the dialog for a path while it is being typed. Returns the path once it is complete.
fn path(
    ctx: &egui::Context,
    title: &str,
    hint: &str,
    typed: &mut Option<String>,
) -> Option<PathBuf> {
    let mut text = typed.take()?;
    let mut path = None;
    let stays = crate::ui::dialogs::window(ctx, title, vec2(440.0, 90.0), |ui| {
        let field = TextEdit::singleline(&mut text)
            .hint_text(hint)
            .desired_width(f32::INFINITY);
        let field = ui.add(field).accessible_name("Path");
        if text.is_empty() && !field.has_focus() {
            field.request_focus();
        }
        let entered = field.lost_focus() && ui.input(|input| input.key_pressed(Key::Enter));
        ui.add_space(4.0);
        let is_ready = !text.trim().is_empty();
        let opened = ui.add_enabled(is_ready, Button::new("Open")).clicked();
        if is_ready && (opened || entered) {
            path = Some(PathBuf::from(text.trim()));
        }
    });
    if path.is_none() && stays {
        *typed = Some(text);
    }
    path
}

/// The user's choice in the save dialog.
#[derive(Clone, Copy, PartialEq)]
enum Wish {
    Browse,
    Save { waits: bool },
}

/// The dialog for saving the picture.
pub fn saving(ctx: &egui::Context, context: &mut PanelContext) {
    let progress = context.shown(PictureSlot::Main).map(|shown| shown.progress);
    let (width, height) = pictures::size(context.session);
    let session = &mut *context.session;
    let others = SaveSize::ALL.map(|size| pictures::size_of(session, size));
    let Some(dialog) = &mut session.files.saving else {
        return;
    };
    let mut wish = None;
    let mut is_entered = false;
    let mut is_cancelled = false;
    let title = match dialog.overlays {
        true => "Save the picture with overlays",
        false => "Save the picture",
    };
    let stays = crate::ui::dialogs::window(ctx, title, vec2(460.0, 170.0), |ui| {
        ui.horizontal(|ui| {
            let width = ui.available_width() - 90.0;
            let field = TextEdit::singleline(&mut dialog.path).desired_width(width);
            let field = ui.add(field).accessible_name("File");
            if std::mem::take(&mut dialog.is_new) {
                field.request_focus();
            }
            is_entered = field.lost_focus() && ui.input(|input| input.key_pressed(Key::Enter));
            let button = ui.button("Browse…").on_hover_text("Choose a file");
            if button.clicked() {
                wish = Some(Wish::Browse);
            }
        });
        super::folder(ui, &dialog.path);
        if !dialog.overlays {
            ui.horizontal(|ui| {
                for size in SaveSize::ALL {
                    ui.radio_value(&mut dialog.size, size, size.title());
                }
            });
        }
        let other = others[dialog.size as usize].filter(|_| !dialog.overlays);
        let (width, height) = other.unwrap_or((width, height));
        let target = dialog.target();
        match &target {
            Err(why) => {
                ui.colored_label(ui.visuals().error_fg_color, why);
            }
            Ok(target) => {
                ui.horizontal(|ui| {
                    if !dialog.overlays {
                        ui.label(format!("{}, {width} × {height} pixels", target.format));
                    }
                    if target.format.is_linear() {
                        ui.weak("linear radiance, without exposure or tone mapping");
                    }
                    if target.format == Format::Jpeg {
                        let slider = Slider::new(&mut dialog.quality, 1..=100).text("Quality");
                        ui.add(slider)
                            .on_hover_text("From 1 (smallest) to 100 (best)");
                    }
                });
                if dialog.must_ask(target) {
                    let text = "A file with this name exists and will be replaced.";
                    ui.colored_label(ui.visuals().warn_fg_color, text);
                }
            }
        }
        // At another size it is rendered for the file, with all samples.
        let is_done = other.is_some() || progress.is_some_and(|progress| progress.is_done);
        if let Some(progress) = progress.filter(|_| !is_done && !dialog.overlays) {
            ui.label(format!(
                "{} of {} samples so far.",
                progress.samples_so_far(),
                progress.target
            ));
        }
        ui.add_space(6.0);
        ui.horizontal(|ui| {
            let replaces = target.as_ref().is_ok_and(|target| dialog.must_ask(target));
            let (now, later) = match replaces {
                true => ("Replace", "Replace when finished"),
                false => ("Save", "Save when finished"),
            };
            let is_now = ui.add_enabled(target.is_ok(), Button::new(now)).clicked();
            // Replacing a file requires a click, not just Enter.
            if is_now || is_entered && target.is_ok() && !replaces {
                wish = Some(Wish::Save { waits: false });
            }
            if !is_done
                && !dialog.overlays
                && ui.add_enabled(target.is_ok(), Button::new(later)).clicked()
            {
                wish = Some(Wish::Save { waits: true });
            }
            is_cancelled = ui.button("Cancel").clicked();
        });
    });
    match wish {
        Some(Wish::Browse) => pictures::browse(session, ctx),
        Some(Wish::Save { waits }) => pictures::save(session, waits),
        None if !stays || is_cancelled => session.files.saving = None,
        None => {}
    }
}

/// The files that closing the window would leave unwritten.
fn unfinished(session: &Session) -> String {
    let names: Vec<_> = session.files.jobs.lasting().map(Job::name).collect();
    match names.as_slice() {
        [name] => format!("{name} is not written yet."),
        names => format!(
            "{} files are not written yet: {}.",
            names.len(),
            names.join(", ")
        ),
    }
}

/// The question about unsaved changes.
pub fn undecided(ctx: &egui::Context, session: &mut Session) -> Option<Choice> {
    let intent = session.files.undecided.clone()?;
    let name = session.title();
    let (what, lose, keep) = match &intent {
        Intent::Close => (
            format!("{name} has unsaved changes."),
            "Close without saving",
            "Cancel",
        ),
        Intent::CloseUnfinished => (
            unfinished(session),
            "Close without saving it",
            "Continue rendering",
        ),
        Intent::Open(path) => (
            format!(
                "{name} has unsaved changes. Save them before opening {}?",
                files::short(path)
            ),
            "Open without saving",
            "Cancel",
        ),
        Intent::New => (
            format!("{name} has unsaved changes. Save them before making a new scene?"),
            "New without saving",
            "Cancel",
        ),
        Intent::Reload | Intent::Choose(..) => (
            format!("{name} has unsaved changes. Reloading discards them."),
            "Reload",
            "Cancel",
        ),
        Intent::ReloadChanged => (
            format!("{name} has changed on disk and has unsaved changes here."),
            "Reload",
            "Cancel",
        ),
    };
    let mut choice = None;
    let mut is_over = false;
    Modal::new(egui::Id::unique("unsaved")).show(ctx, |ui: &mut Ui| {
        ui.set_max_width(380.0);
        ui.label(RichText::new(what).strong());
        ui.add_space(8.0);
        ui.horizontal(|ui| {
            let has_changes = intent != Intent::CloseUnfinished;
            if has_changes && ui.button("Save").clicked() {
                choice = Some(Choice::Save(intent.clone()));
                is_over = true;
            }
            if ui.button(lose).clicked() {
                choice = Some(Choice::GoOn(intent));
            }
            is_over |= ui.button(keep).clicked();
        });
    });
    if is_over {
        session.files.undecided = None;
    }
    choice
}

/// Explains what can be dropped while a file is held over the window.
pub fn hovering(ctx: &egui::Context) {
    if ctx.input(|input| input.raw.hovered_files.is_empty()) {
        return;
    }
    let room = ctx.content_rect();
    egui::Area::new(egui::Id::unique("hovering"))
        .order(egui::Order::Tooltip)
        .anchor(Align2::CENTER_CENTER, [0.0, 0.0])
        .interactable(false)
        .show(ctx, |ui| {
            let painter = ui.ctx().layer_painter(egui::LayerId::background());
            let stroke = egui::Stroke::new(3.0, ui.visuals().selection.stroke.color);
            painter.rect_stroke(room.shrink(2.0), 4.0, stroke, egui::StrokeKind::Inside);
            egui::Frame::popup(ui.style()).show(ui, |ui| {
                ui.heading("Drop to open");
                ui.label("Scenes, models and folders are opened.");
                ui.label("An image becomes the environment.");
            });
        });
}
