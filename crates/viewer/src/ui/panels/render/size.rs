//! The size of the picture and its region.

use crate::model::view_settings::ViewSettings;
use crate::ui::context::PanelContext;
use crate::ui::panels::setting_rows::{number, reset_button};
use eframe::egui::{self, Ui};

/// Maximum side length that can be entered, in pixels.
const MAX_SIDE: u32 = 16384;

/// Common sizes, in pixels.
const USUAL: [(u32, u32); 6] = [
    (640, 480),
    (1280, 720),
    (1920, 1080),
    (2560, 1440),
    (3840, 2160),
    (1024, 1024),
];

pub fn size(ui: &mut Ui, context: &mut PanelContext) {
    let now = context.session.picture_size();
    let look = &mut context.session.view;
    let tip = "Render at the size of the picture panel, in screen pixels";
    let label = ui.label("Fit to window").on_hover_text(tip);
    let mut fits = look.fits;
    (ui.checkbox(&mut fits, "").labelled_by(label.id)).on_hover_text(tip);
    if fits != look.fits {
        look.fits = fits;
        if !fits {
            look.settings.size = now;
        }
    }
    ui.end_row();
    let usual = look.scene_settings.size;
    let mut size = if look.fits { now } else { look.settings.size };
    ui.label("Width × height");
    ui.horizontal(|ui| {
        for (side, name) in [(&mut size.0, "Width"), (&mut size.1, "Height")] {
            let response = number(ui, side, 1..=MAX_SIDE, 1.0, "");
            response.widget_info(|| {
                let mut info = egui::WidgetInfo::drag_value(true, f64::from(*side));
                info.label = Some(name.into());
                info
            });
            response.on_hover_text(format!("{name} of the picture, 1 to {MAX_SIDE} pixels"));
        }
        ui.menu_button("Presets", |ui| {
            let scene = format!("Scene size ({} × {})", usual.0, usual.1);
            if ui.button(scene).clicked() {
                size = usual;
            }
            for (width, height) in USUAL {
                if ui.button(format!("{width} × {height}")).clicked() {
                    size = (width, height);
                }
            }
        })
        .response
        .on_hover_text("Common picture sizes in pixels");
    });
    ui.end_row();
    let before = if look.fits { now } else { look.settings.size };
    if size != before {
        resize(look, size);
    }
    region(ui, look, before);
}

fn resize(look: &mut ViewSettings, size: (u32, u32)) {
    look.fits = false;
    look.settings.size = size;
    // A crop does not apply to a different size.
    look.settings.crop = None;
}

/// The region as numbers.
fn region(ui: &mut Ui, look: &mut ViewSettings, (width, height): (u32, u32)) {
    let tip = "Render only this region: left, upper, right and lower edge in pixels";
    let Some(region) = &mut look.region else {
        return;
    };
    ui.label("Region").on_hover_text(tip);
    let mut is_ended = false;
    ui.horizontal_wrapped(|ui| {
        let names = ["Left edge", "Upper edge", "Right edge", "Lower edge"];
        for (edge, name) in names.into_iter().enumerate() {
            let length = if edge % 2 == 0 { width } else { height };
            let (lowest, highest) = match edge {
                0 | 1 => (0, pixel(region[edge + 2], length).saturating_sub(1)),
                _ => (pixel(region[edge - 2], length) + 1, length),
            };
            let before = pixel(region[edge], length);
            let mut value = before;
            let response = number(ui, &mut value, lowest..=highest.max(lowest), 1.0, "");
            response.widget_info(|| {
                let mut info = egui::WidgetInfo::drag_value(true, f64::from(value));
                info.label = Some(name.into());
                info
            });
            response.on_hover_text(format!("{name} of the region, in pixels"));
            if value != before {
                region[edge] = f64::from(value) / f64::from(length);
            }
        }
        is_ended = reset_button(ui, "region")
            .on_hover_text("Render the whole picture")
            .clicked();
    });
    ui.end_row();
    if is_ended {
        look.region = None;
    }
}

fn pixel(share: f64, length: u32) -> u32 {
    (share * f64::from(length)).round() as u32
}
