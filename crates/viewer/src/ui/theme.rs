//! The colours of both themes, in one table.
//!
//! A test holds each text against each ground that it stands on: 4.5 : 1 at least, and 3 : 1 where it is disabled.

use eframe::egui::{self, Color32, Theme, Visuals};

/// Opacity of disabled widgets.
const DISABLED: f32 = 0.65;

/// The colours of a theme that differ from egui's.
struct Palette {
    /// Labels.
    text: Color32,
    /// Hints, notes and shortcuts.
    weak: Color32,
    /// Ground of what is under the cursor, of what is pressed and of what is selected.
    hovered: Color32,
    pressed: Color32,
    selected: Color32,
    /// Text on what is selected.
    on_selected: Color32,
    link: Color32,
    warning: Color32,
    error: Color32,
    /// Letters of x, y and z.
    axes: [Color32; 3],
}

const DARK: Palette = Palette {
    text: Color32::from_gray(205),
    weak: Color32::from_gray(170),
    hovered: Color32::from_gray(56),
    pressed: Color32::from_gray(42),
    selected: Color32::from_rgb(0, 64, 96),
    on_selected: Color32::from_rgb(192, 222, 255),
    link: Color32::from_rgb(90, 170, 255),
    warning: Color32::from_rgb(255, 160, 60),
    error: Color32::from_rgb(255, 107, 107),
    axes: [
        Color32::from_rgb(255, 110, 115),
        Color32::from_rgb(120, 200, 60),
        Color32::from_rgb(110, 165, 255),
    ],
};

const LIGHT: Palette = Palette {
    text: Color32::from_gray(50),
    weak: Color32::from_gray(80),
    hovered: Color32::from_gray(220),
    pressed: Color32::from_gray(205),
    selected: Color32::from_rgb(160, 214, 255),
    on_selected: Color32::from_rgb(0, 60, 100),
    link: Color32::from_rgb(0, 90, 165),
    warning: Color32::from_rgb(150, 72, 0),
    error: Color32::from_rgb(190, 20, 30),
    axes: [
        Color32::from_rgb(190, 20, 30),
        Color32::from_rgb(40, 110, 0),
        Color32::from_rgb(20, 80, 200),
    ],
};

fn palette(is_dark: bool) -> &'static Palette {
    match is_dark {
        true => &DARK,
        false => &LIGHT,
    }
}

/// Gives a window the colours of both themes.
pub fn install(ctx: &egui::Context) {
    for (theme, own) in [(Theme::Dark, &DARK), (Theme::Light, &LIGHT)] {
        ctx.style_mut_of(theme, |style| apply(&mut style.visuals, own));
    }
}

fn apply(visuals: &mut Visuals, own: &Palette) {
    visuals.widgets.noninteractive.fg_stroke.color = own.text;
    visuals.weak_text_color = Some(own.weak);
    visuals.widgets.hovered.weak_bg_fill = own.hovered;
    visuals.widgets.active.weak_bg_fill = own.pressed;
    visuals.selection.bg_fill = own.selected;
    visuals.selection.stroke.color = own.on_selected;
    visuals.hyperlink_color = own.link;
    visuals.warn_fg_color = own.warning;
    visuals.error_fg_color = own.error;
    visuals.disabled_alpha = DISABLED;
}

/// Colours of the letters x, y and z on a panel.
pub fn axes(visuals: &Visuals) -> [Color32; 3] {
    palette(visuals.dark_mode).axes
}
