//! Draws the panels of a layout in tabs.

use super::context::PanelContext;
use super::panels;
use crate::state::layout::{Layout, Panel};
use eframe::egui;
use egui_tiles::{Behavior, TileId, UiResponse};

/// Draws all panels.
pub fn show(ui: &mut egui::Ui, layout: &mut Layout, context: &mut PanelContext) {
    egui::CentralPanel::default()
        .frame(egui::Frame::NONE)
        .show(ui, |ui| {
            if context.session.scene().is_some() {
                layout.set_animated(context.session.playback.duration() > 0.0);
            }
            layout.resize(ui.available_size().into());
            // The picture panel sets it when it is drawn.
            context.session.viewport = None;
            layout.tree.ui(&mut Tabs { context }, ui);
        });
}

/// Draws panels in tabs.
struct Tabs<'a, 'b> {
    context: &'a mut PanelContext<'b>,
}

impl Behavior<Panel> for Tabs<'_, '_> {
    fn pane_ui(&mut self, ui: &mut egui::Ui, _: TileId, panel: &mut Panel) -> UiResponse {
        panels::show(*panel, ui, self.context);
        UiResponse::None
    }

    fn tab_title_for_pane(&mut self, panel: &Panel) -> egui::WidgetText {
        panel.title().into()
    }

    fn simplification_options(&self) -> egui_tiles::SimplificationOptions {
        egui_tiles::SimplificationOptions {
            all_panes_must_have_tabs: true,
            ..Default::default()
        }
    }
}
