//! Text is legible: its contrast by the Web Content Accessibility Guidelines, computed from the colours of both themes.

use crate::harness::Window;
use crate::support::verdict::Verdict;
use eframe::egui::{Color32, Theme, Visuals};

/// Least contrast of text, and of text that is disabled.
const LEAST: f64 = 4.5;
const LEAST_DISABLED: f64 = 3.0;

/// Relative luminance, from 0 to 1.
fn luminance(color: Color32) -> f64 {
    let linear = |level: u8| {
        let level = f64::from(level) / 255.0;
        match level <= 0.04045 {
            true => level / 12.92,
            false => ((level + 0.055) / 1.055).powf(2.4),
        }
    };
    0.2126 * linear(color.r()) + 0.7152 * linear(color.g()) + 0.0722 * linear(color.b())
}

/// The contrast of two opaque colours, from 1 to 21.
pub fn contrast(a: Color32, b: Color32) -> f64 {
    let (a, b) = (luminance(a) + 0.05, luminance(b) + 0.05);
    a.max(b) / a.min(b)
}

/// A colour over another one, with this opacity.
fn blended(color: Color32, ground: Color32, opacity: f32) -> Color32 {
    let mix =
        |a: u8, b: u8| (f32::from(a) * opacity + f32::from(b) * (1.0 - opacity)).round() as u8;
    Color32::from_rgb(
        mix(color.r(), ground.r()),
        mix(color.g(), ground.g()),
        mix(color.b(), ground.b()),
    )
}

/// All texts and the grounds on which they stand.
fn pairs(visuals: &Visuals) -> Vec<(&'static str, Color32, Vec<Color32>)> {
    let widgets = &visuals.widgets;
    let panels = vec![
        visuals.panel_fill,
        visuals.window_fill,
        visuals.extreme_bg_color,
    ];
    let of_entries = vec![
        visuals.panel_fill,
        visuals.window_fill,
        widgets.hovered.weak_bg_fill,
        widgets.active.weak_bg_fill,
        widgets.open.weak_bg_fill,
        visuals.selection.bg_fill,
    ];
    vec![
        ("labels", visuals.text_color(), panels.clone()),
        ("headings", visuals.strong_text_color(), panels.clone()),
        ("hints and shortcuts", visuals.weak_text_color(), of_entries),
        ("hints in fields", visuals.weak_text_color(), panels.clone()),
        ("links", visuals.hyperlink_color, panels.clone()),
        ("warnings", visuals.warn_fg_color, panels.clone()),
        ("errors", visuals.error_fg_color, panels.clone()),
        (
            "buttons",
            widgets.inactive.fg_stroke.color,
            vec![widgets.inactive.weak_bg_fill, widgets.inactive.bg_fill],
        ),
        (
            "buttons under the cursor",
            widgets.hovered.fg_stroke.color,
            vec![widgets.hovered.weak_bg_fill, visuals.panel_fill],
        ),
        (
            "pressed buttons",
            widgets.active.fg_stroke.color,
            vec![widgets.active.weak_bg_fill, visuals.panel_fill],
        ),
        (
            "open menus",
            widgets.open.fg_stroke.color,
            vec![widgets.open.weak_bg_fill],
        ),
        (
            "selected",
            visuals.selection.stroke.color,
            vec![visuals.selection.bg_fill],
        ),
    ]
}

#[test]
fn all_text_has_a_contrast_of_4_5_and_disabled_text_one_of_3() {
    let window = Window::open(&["--size", "64x48", "--samples", "1"]);
    let mut verdict = Verdict::on("contrast");
    for theme in [Theme::Dark, Theme::Light] {
        let style = window.harness.ctx.style_of(theme);
        let visuals = &style.visuals;
        for (text, color, grounds) in pairs(visuals) {
            for ground in grounds {
                let found = contrast(color, ground);
                verdict.that(format!("{theme:?}: {text}"), found >= LEAST, || {
                    format!("{found:.2} on {ground:?}")
                });
            }
        }
        for (text, color) in [
            ("labels", visuals.text_color()),
            ("hints and shortcuts", visuals.weak_text_color()),
            ("buttons", visuals.widgets.inactive.fg_stroke.color),
        ] {
            let ground = visuals.panel_fill;
            let found = contrast(blended(color, ground, visuals.disabled_alpha), ground);
            let is_legible = found >= LEAST_DISABLED;
            verdict.that(format!("{theme:?}: disabled {text}"), is_legible, || {
                format!("{found:.2}")
            });
        }
    }
    verdict.close();
}
