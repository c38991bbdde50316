//! The menu bar, and below it the error of the scene's file.

use crate::actions::commands;
use crate::actions::comparing;
use crate::actions::files;
use crate::actions::files::{cameras, neighbours};
use crate::actions::tools;
use crate::model::bindings::Action as A;
use crate::model::document::Document;
use crate::model::overlays::Overlays;
use crate::model::tool::{Tool, ToolMenu};
use crate::model::view_settings::{ErrorMap, Measure, Sharing};
use crate::state::dialogs::Dialog;
use crate::state::layout::{Layout, Panel};
use crate::state::neighbours::Preview;
use crate::state::session::Session;
use crate::ui::context::PanelContext;
use crate::ui::panels::add;
use crate::ui::thumbnails::{self, color_image};
use eframe::egui::{self, Button, RichText, Ui};

/// Draws the menu bar.
pub fn menu(ui: &mut Ui, context: &mut PanelContext, layout: &mut Layout) {
    egui::Panel::top("menu").show(ui, |ui| {
        egui::MenuBar::new().ui(ui, |ui| {
            type Entries = fn(&mut Menu);
            let menus: [(&str, Entries); 7] = [
                ("File", file),
                ("Edit", edit),
                ("Add", |menu| add::entries(menu.ui, menu.context.session)),
                ("View", view),
                ("Render", render),
                ("Window", window),
                ("Help", help),
            ];
            for (title, entries) in menus {
                ui.menu_button(title, |ui| {
                    scrolled(ui, |ui| {
                        entries(&mut Menu {
                            ui,
                            context,
                            layout,
                        })
                    })
                });
            }
        });
    });
    crate::ui::panels::broken::broken(ui, context);
}

/// A menu that scrolls where the window is too low for it.
fn scrolled(ui: &mut Ui, entries: impl FnOnce(&mut Ui)) {
    let height = ui.ctx().content_rect().max.y - ui.cursor().min.y - 16.0;
    egui::ScrollArea::vertical()
        .min_scrolled_height(height)
        .max_height(height)
        .show(ui, entries);
}

/// The context of a menu.
struct Menu<'a, 'b> {
    ui: &'a mut Ui,
    context: &'a mut PanelContext<'b>,
    layout: &'a mut Layout,
}

impl Menu<'_, '_> {
    /// An entry for a command with its shortcut.
    fn entry(&mut self, text: &str, action: A) {
        self.entry_if(true, text, action);
    }

    /// An entry that can be disabled.
    fn entry_if(&mut self, enabled: bool, text: &str, action: A) {
        let button = Button::new(text);
        self.button(enabled, button, action);
    }

    /// An entry with a check mark.
    fn tick(&mut self, is_so: bool, text: &str, action: A) {
        let button = Button::selectable(is_so, text);
        self.button(true, button, action);
    }

    fn button(&mut self, enabled: bool, button: Button, action: A) {
        let keys = self.context.session.preferences.bindings.shortcut(action);
        let button = button.shortcut_text(keys);
        let response = self.ui.add_enabled(enabled, button);
        self.perform_if(
            response.on_hover_text(action.description()).clicked(),
            action,
        );
    }

    fn perform_if(&mut self, is_clicked: bool, action: A) {
        if is_clicked {
            self.ui.close();
            let ctx = self.ui.ctx().clone();
            commands::perform(action, self.context.session, self.layout, &ctx);
        }
    }

    /// The entry of a scene beside this one in its folder, with a small picture of the scene as its tooltip.
    fn neighbour(&mut self, enabled: bool, text: &str, action: A, step: isize) {
        let session = &mut *self.context.session;
        let keys = session.preferences.bindings.shortcut(action);
        let button = Button::new(text).shortcut_text(keys);
        let response = self.ui.add_enabled(enabled, button);
        let response = response.on_hover_ui(|ui| preview(ui, session, action, step));
        self.perform_if(response.clicked(), action);
    }

    /// The tools of this menu, the active one with a check mark.
    fn tools(&mut self, menu: ToolMenu) {
        for &tool in Tool::ALL {
            if tool.entry().menu == menu {
                let is_active = tools::is_active(self.context.session, tool);
                self.tick(is_active, tool.entry().title, A::Tool(tool));
            }
        }
    }

    /// The kept pictures, the one that is flipped to with a check mark.
    fn kept(&mut self) {
        let session = &self.context.session;
        let shown = comparing::flipped(session);
        let stills = session.comparing.gallery.all().iter();
        let entries: Vec<_> = stills
            .filter_map(|still| Some((still.id, still.name.clone(), A::kept(still.number)?)))
            .collect();
        for (id, name, action) in entries {
            self.tick(shown == Some(id), &format!("Flip to {name}"), action);
        }
    }

    fn line(&mut self) {
        self.ui.separator();
    }
}

/// Names a scene beside this one and shows its small picture.
fn preview(ui: &mut egui::Ui, session: &mut Session, action: A, step: isize) {
    let Some((path, preview)) = neighbours::neighbour(session, step) else {
        ui.label(action.description());
        return;
    };
    let name = files::short(&path);
    ui.label(&name);
    match preview {
        Preview::Awaited => {
            ui.weak("Rendering a small picture …");
            ui.ctx().request_repaint_after_secs(0.1);
        }
        Preview::Missing => {
            ui.weak("No small picture: the file is large or cannot be rendered");
        }
        Preview::Picture(image) => {
            let id = egui::Id::unique(("small picture", &path));
            let texture = thumbnails::kept(ui.ctx(), id, || Some(color_image(&image)));
            if let Some(texture) = texture {
                let picture = egui::Image::from_texture(&texture);
                ui.add(picture.alt_text(format!("Small picture of {name}")));
            }
        }
    }
}

fn file(menu: &mut Menu) {
    let session = &menu.context.session;
    let (has_file, has_scene) = (session.path.is_some(), session.scene().is_some());
    menu.entry("New", A::New);
    menu.entry("Open…", A::Open);
    let by_path = menu.ui.button("Open path…");
    if by_path
        .on_hover_text("Type or paste the path of a file")
        .clicked()
    {
        menu.ui.close();
        menu.context.session.files.typed = Some(String::new());
    }
    let recent = menu.context.session.preferences.recent.clone();
    menu.ui.add_enabled_ui(!recent.is_empty(), |ui| {
        ui.menu_button("Open recent", |ui| {
            for path in &recent {
                let name = files::short(path);
                let folder = path.parent().map(|f| f.display().to_string());
                let text = format!("{name}   {}", folder.unwrap_or_default());
                let button = Button::new(text).truncate();
                if ui
                    .add(button)
                    .on_hover_text(path.display().to_string())
                    .clicked()
                {
                    ui.close();
                    files::open(menu.context.session, vec![path.clone()]);
                }
            }
            ui.separator();
            if ui.button("Clear list").clicked() {
                menu.context.session.preferences.recent.clear();
            }
        });
    });
    menu.neighbour(has_file, "Next scene in folder", A::OpenNext, 1);
    menu.neighbour(has_file, "Previous scene in folder", A::OpenPrevious, -1);
    menu.entry_if(has_scene, "Reload", A::Reload);
    menu.line();
    menu.entry_if(has_scene, "Save scene", A::SaveScene);
    menu.entry_if(has_scene, "Save scene as…", A::SaveSceneAs);
    menu.entry_if(has_scene, "Revert", A::Revert);
    menu.line();
    menu.entry_if(has_scene, "Save picture…", A::SavePicture);
    menu.entry_if(has_scene, "Copy picture", A::CopyPicture);
    let overlays = A::SavePictureWithOverlays;
    menu.entry_if(has_scene, "Save picture with overlays…", overlays);
    if menu
        .ui
        .button("Jobs")
        .on_hover_text("Files that are being rendered or written")
        .clicked()
    {
        menu.ui.close();
        menu.context.session.dialogs.open(Dialog::Jobs);
    }
    menu.line();
    menu.entry("Quit", A::Quit);
}

fn edit(menu: &mut Menu) {
    let has_selection = menu.context.session.selection.is_some();
    let document = menu.context.session.document.as_ref();
    let undo = document.and_then(Document::undo_name).map(str::to_owned);
    let redo = document.and_then(Document::redo_name).map(str::to_owned);
    for (verb, name, action) in [("Undo", undo, A::Undo), ("Redo", redo, A::Redo)] {
        let text = match &name {
            Some(name) => format!("{verb} {name}"),
            None => verb.to_owned(),
        };
        menu.entry_if(name.is_some(), &text, action);
    }
    menu.line();
    menu.entry_if(has_selection, "Rename", A::Rename);
    menu.entry_if(has_selection, "Duplicate", A::Duplicate);
    menu.entry_if(has_selection, "Delete", A::Delete);
    menu.entry_if(has_selection, "Hide or show", A::ToggleVisible);
    menu.entry("Select all", A::SelectAll);
    menu.entry_if(has_selection, "Deselect", A::SelectNothing);
    menu.line();
    menu.tools(ToolMenu::Edit);
    let snaps = menu.context.session.preferences.snaps;
    menu.tick(snaps, "Snapping", A::ToggleSnapping);
    let is_measured = !menu.context.session.tool_state.measurements().is_empty();
    menu.entry_if(is_measured, "Copy measurements", A::CopyMeasurements);
    menu.line();
    menu.entry("Copy as command line", A::CopyCamera);
    menu.entry("Paste camera", A::PasteCamera);
    menu.line();
    menu.entry("Preferences…", A::Preferences);
}

fn view(menu: &mut Menu) {
    let has_selection = menu.context.session.selection.is_some();
    menu.entry_if(has_selection, "Frame selection", A::FrameSelection);
    menu.entry("Frame all", A::FrameAll);
    menu.entry("Scene camera", A::Home);
    menu.line();
    menu.entry("Front", A::ViewFront);
    menu.entry("Back", A::ViewBack);
    menu.entry("Right", A::ViewRight);
    menu.entry("Left", A::ViewLeft);
    menu.entry("Top", A::ViewTop);
    menu.entry("Bottom", A::ViewBottom);
    let controller = menu.context.session.controller.as_ref();
    let is_orthographic = controller.is_some_and(|controller| controller.is_orthographic());
    menu.tick(is_orthographic, "Orthographic", A::ToggleOrthographic);
    menu.entry("Magnify pixels", A::PixelZoomIn);
    menu.entry("Reduce pixels", A::PixelZoomOut);
    menu.entry("Reset pixel zoom", A::PixelZoomReset);
    menu.entry("Level horizon", A::Level);
    menu.entry("Walk", A::Walk);
    menu.line();
    let mut overlays = menu.context.session.preferences.overlays;
    for entry in Overlays::ALL {
        let is_shown = overlays.of(entry.action).is_some_and(|it| *it);
        menu.tick(is_shown, entry.title, entry.action);
    }
    menu.line();
    menu.entry("Undo camera movement", A::UndoView);
    menu.entry("Redo camera movement", A::RedoView);
    menu.line();
    menu.ui.menu_button("Cameras", |ui| {
        let views = cameras::all(menu.context.session);
        for view in &views {
            if ui.button(&view.name).clicked() {
                ui.close();
                cameras::go(menu.context.session, view);
            }
        }
        ui.separator();
        let mut menu = Menu {
            ui,
            context: menu.context,
            layout: menu.layout,
        };
        menu.entry("Bookmark view", A::SaveCamera);
        menu.entry("Next camera", A::NextCamera);
        menu.entry("Previous camera", A::PreviousCamera);
        menu.entry("Bookmarks…", A::Bookmarks);
    });
    menu.ui.menu_button("Animation", |ui| {
        let mut menu = Menu {
            ui,
            context: menu.context,
            layout: menu.layout,
        };
        let playback = &menu.context.session.playback;
        let (plays, repeats, blurs) = (playback.is_playing, playback.repeats, playback.blurs);
        menu.tick(plays, "Play", A::PlayPause);
        menu.entry("Next frame", A::StepForward);
        menu.entry("Previous frame", A::StepBack);
        menu.entry("First frame", A::FirstFrame);
        menu.entry("Last frame", A::LastFrame);
        menu.entry("Faster", A::PlayFaster);
        menu.entry("Slower", A::PlaySlower);
        menu.tick(repeats, "Loop", A::ToggleLoop);
        menu.tick(blurs, "Motion blur", A::ToggleMotionBlur);
    });
}

fn render(menu: &mut Menu) {
    let has_scene = menu.context.session.scene().is_some();
    let look = &menu.context.session.view;
    let integrator = look.settings.integrator;
    let comparison = look.comparison;
    let sharing = comparison.map(|comparison| comparison.sharing);
    let (is_paused, is_false_color) = (look.paused, look.false_color);
    for action in A::ALL {
        if let Some(shown) = action.integrator() {
            menu.tick(shown == integrator, shown.entry().title, *action);
        }
    }
    menu.entry("Next layer", A::NextLayer);
    menu.entry("Previous layer", A::PreviousLayer);
    menu.tick(is_false_color, "False colour", A::FalseColor);
    menu.line();
    let is_wipe = matches!(sharing, Some(Sharing::Wipe(_)));
    menu.tick(is_wipe, "Compare with a wipe", A::SplitWipe);
    let is_beside = sharing == Some(Sharing::SideBySide);
    menu.tick(is_beside, "Compare side by side", A::SideBySide);
    let difference = Sharing::Difference(ErrorMap::new(Measure::Absolute));
    let is_difference = sharing.is_some_and(|sharing| sharing.is_like(difference));
    menu.tick(is_difference, "Show difference", A::ShowDifference);
    let can_swap = comparison.is_some_and(|comparison| comparison.integrator().is_some());
    menu.entry_if(can_swap, "Swap sides", A::SwapSides);
    menu.entry_if(has_scene, "Keep snapshot", A::KeepSnapshot);
    menu.entry("Flip to kept picture", A::FlipKept);
    menu.entry("Next kept picture", A::NextKept);
    menu.kept();
    menu.entry_if(has_scene, "Open reference picture…", A::OpenReference);
    menu.line();
    menu.entry("Increase exposure", A::ExposureUp);
    menu.entry("Decrease exposure", A::ExposureDown);
    menu.entry("Reset exposure", A::ExposureReset);
    menu.entry("Next tone curve", A::NextToneCurve);
    menu.entry("Next background", A::NextBackground);
    menu.line();
    menu.tick(is_paused, "Pause", A::PauseRender);
    menu.entry("Restart", A::RestartRender);
    menu.tools(ToolMenu::Render);
    menu.entry("Double samples", A::MoreSamples);
    menu.entry("Halve samples", A::FewerSamples);
    menu.line();
    let has_scene = menu.context.session.scene().is_some();
    menu.entry_if(has_scene, "Film…", A::Film);
}

fn window(menu: &mut Menu) {
    for panel in Panel::ALL {
        let mut visible = menu.layout.is_visible(panel);
        if menu.ui.checkbox(&mut visible, panel.title()).changed() {
            menu.layout.set_visible(panel, visible);
        }
    }
    menu.entry("All panels", A::TogglePanels);
    if menu.ui.button("Reset layout").clicked() {
        menu.ui.close();
        *menu.layout = Layout::default();
    }
    menu.line();
    let session = &menu.context.session;
    let (overlays, statistics) = (session.shows_overlays, session.shows_statistics);
    menu.tick(overlays, "Overlays", A::ToggleOverlays);
    menu.tick(statistics, "Statistics", A::ToggleStatistics);
    menu.line();
    menu.entry("Toggle dark and light", A::ToggleTheme);
    menu.entry("Zoom in", A::LargerText);
    menu.entry("Zoom out", A::SmallerText);
    menu.entry("Reset zoom", A::ResetText);
    menu.entry("Full screen", A::FullScreen);
}

fn help(menu: &mut Menu) {
    menu.entry("Keyboard shortcuts", A::Help);
    for (text, dialog) in [
        ("First steps", Dialog::Hint),
        ("Messages", Dialog::Messages),
    ] {
        if menu.ui.button(text).clicked() {
            menu.ui.close();
            menu.context.session.dialogs.open(dialog);
        }
    }
    menu.line();
    let version = format!("glimray {}", env!("CARGO_PKG_VERSION"));
    menu.ui.label(RichText::new(version).weak());
}
