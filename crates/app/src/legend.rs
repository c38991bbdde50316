//! Legends for views of a quantity: what their grey levels and colours mean.

use glimray_render::Quantity;

/// The legend as a sentence, such as "samples from 4 (black) to 64 (white)".
pub fn sentence(quantity: Quantity, [least, most]: [f32; 2]) -> String {
    let (what, first, last) = match quantity {
        Quantity::Distance => ("distances", "white", "dark grey"),
        Quantity::Samples => ("samples", "black", "white"),
        Quantity::Work => ("traversal cost", "black", "white"),
    };
    let [least, most] = [least, most].map(number);
    match quantity {
        Quantity::Samples => format!("{what} from {least} ({first}) to {most} ({last})"),
        _ => format!(
            "{what} from {least} ({first}) to {most} {} ({last}), excluding {:.1} % of the pixels at each end",
            quantity.unit(),
            100.0 * quantity.outliers()
        ),
    }
}

/// The colour gradient from the least to the greatest value: evenly spaced sRGB stops, interpolated between.
pub fn stops(quantity: Quantity) -> &'static [[u8; 3]] {
    match quantity {
        Quantity::Distance => &[[255; 3], [26; 3]],
        Quantity::Samples => &[[0; 3], [255; 3]],
        Quantity::Work => &[
            [0, 0, 0],
            [0, 0, 255],
            [0, 255, 0],
            [255, 255, 0],
            [255, 0, 0],
            [255, 255, 255],
        ],
    }
}

/// The colours of errors from none to the greatest: nine places of Matplotlib's magma, as FLIP's authors use it.
pub const ERRORS: &[[u8; 3]] = &[
    [0, 0, 4],
    [28, 16, 68],
    [79, 18, 123],
    [129, 37, 129],
    [181, 54, 122],
    [229, 80, 100],
    [251, 135, 97],
    [254, 194, 135],
    [252, 253, 191],
];

/// The colour at a place from 0 to 1 in a gradient of evenly spaced stops, in levels.
pub fn color_at(stops: &[[u8; 3]], place: f32) -> [f32; 3] {
    let last = stops.len().saturating_sub(1);
    let at = place.clamp(0.0, 1.0) * last as f32;
    let index = (at as usize).min(last.saturating_sub(1));
    let share = at - index as f32;
    [0, 1, 2].map(|channel| {
        let [from, to] = [index, (index + 1).min(last)].map(|it| f32::from(stops[it][channel]));
        from + share * (to - from)
    })
}

/// Formats a value with three significant digits, and with all digits before the decimal point.
pub fn number(value: f32) -> String {
    let digits = match value.abs() {
        0.0 => 0,
        size if !(1e-4..1e7).contains(&size) => return format!("{value:.2e}"),
        size => (2 - size.log10().floor() as i32).max(0) as usize,
    };
    let text = format!("{value:.digits$}");
    match text.contains('.') {
        true => text.trim_end_matches('0').trim_end_matches('.').to_owned(),
        false => text,
    }
}
