//! The size of the picture and its region.

use crate::model::view_settings::ViewSettings;
use crate::ui::context::PanelContext;
use crate::ui::panels::icon;
use crate::ui::panels::row::row;
use crate::ui::panels::setting_rows::wide_number;
use eframe::egui::Ui;
use std::ops::RangeInclusive;

/// Maximum side length that can be entered, in pixels.
const MAX_SIDE: u32 = 16384;

/// Width of the button with common sizes, in points.
const PRESETS: f32 = 30.0;

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
    let mut fits = look.fits;
    row(ui, ("Fit to window", tip), |ui, label| {
        let response = ui.checkbox(&mut fits, "");
        if let Some(label) = label {
            response.labelled_by(label).on_hover_text(tip);
        }
    });
    if fits != look.fits {
        look.fits = fits;
        if !fits {
            look.settings.size = now;
        }
    }
    let usual = look.scene_settings.size;
    let mut size = if look.fits { now } else { look.settings.size };
    row(ui, ("Width × height", ""), |ui, _| {
        let width = (ui.available_width() - PRESETS - 6.0) / 2.0;
        for (side, name) in [(&mut size.0, "Width"), (&mut size.1, "Height")] {
            let tip = format!("{name} of the picture, 1 to {MAX_SIDE} pixels");
            pixels(ui, side, (1..=MAX_SIDE, name, &tip), width);
        }
        ui.menu_button("⏷", |ui| {
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
        .accessible_name("Presets")
        .on_hover_text("Common picture sizes in pixels");
    });
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
fn region(ui: &mut Ui, look: &mut ViewSettings, (width_of, height_of): (u32, u32)) {
    let tip = "Render only this region: left, upper, right and lower edge in pixels";
    let Some(region) = &mut look.region else {
        return;
    };
    let mut edges = |ui: &mut Ui, label, names: [(usize, &str); 2]| {
        row(ui, (label, tip), |ui, _| {
            let width = (ui.available_width() - 3.0) / 2.0;
            for (edge, name) in names {
                let length = if edge % 2 == 0 { width_of } else { height_of };
                let (lowest, highest) = match edge {
                    0 | 1 => (0, pixel(region[edge + 2], length).saturating_sub(1)),
                    _ => (pixel(region[edge - 2], length) + 1, length),
                };
                let before = pixel(region[edge], length);
                let mut value = before;
                let tip = format!("{name} of the region, in pixels");
                let range = lowest..=highest.max(lowest);
                pixels(ui, &mut value, (range, name, &tip), width);
                if value != before {
                    region[edge] = f64::from(value) / f64::from(length);
                }
            }
        });
    };
    edges(
        ui,
        "Region x from, to",
        [(0, "Left edge"), (2, "Right edge")],
    );
    edges(
        ui,
        "Region y from, to",
        [(1, "Upper edge"), (3, "Lower edge")],
    );
    let mut is_ended = false;
    row(ui, ("", tip), |ui, _| {
        let button = ui.button("Clear region");
        is_ended = button.on_hover_text("Render the whole picture").clicked();
    });
    if is_ended {
        look.region = None;
    }
}

/// A field for a number of pixels, with a name of its own.
fn pixels(
    ui: &mut Ui,
    value: &mut u32,
    (range, name, tip): (RangeInclusive<u32>, &str, &str),
    width: f32,
) {
    let response = wide_number(ui, value, (range, 1.0, ""), width);
    icon::named(&response, name);
    response.on_hover_text(tip);
}

fn pixel(share: f64, length: u32) -> u32 {
    (share * f64::from(length)).round() as u32
}
