//! The panels: one file and one function each.

pub(super) mod add;
mod broken;
pub(super) mod icon;
pub(super) mod jobs;
mod menu;
pub(super) mod messages;
mod outline;
mod parts;
mod picture;
mod properties;
pub(super) mod rays;
pub(super) mod render;
pub(super) mod row;
mod setting_rows;
pub(crate) mod sign;
mod status;
mod time;

pub use menu::menu;
pub use messages::messages;
pub use status::status;

use crate::state::layout::Panel;
use crate::ui::context::PanelContext;
use eframe::egui;

/// Draws one of the panels that a layout has.
pub fn show(panel: Panel, ui: &mut egui::Ui, context: &mut PanelContext) {
    match panel {
        Panel::Picture => picture::picture(ui, context),
        Panel::Outline => outline::outline(ui, context),
        Panel::Properties => properties::properties(ui, context),
        Panel::Render => render::render(ui, context),
        Panel::Rays => rays::rays(ui, context),
        Panel::Outside => rays::space::outside(ui, context),
        Panel::Time => time::time(ui, context),
    }
}
