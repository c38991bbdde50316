//! Draws the line of a scene file that an error points at, for a terminal.

use glimray_io::import::Fault;
use unicode_width::UnicodeWidthStr;

/// Longest line that is shown, in bytes.
const MAX_LINE: usize = 300;

/// The line at fault with carets under the mistake, in `color` (escape sequences before and after);
/// `None` where there is no such line, or it is too long.
pub fn of(fault: &Fault, (color, plain): (&str, &str)) -> Option<String> {
    let excerpt = fault.excerpt.as_ref()?;
    if excerpt.text.len() > MAX_LINE {
        return None;
    }
    let number = fault.position?.line.to_string();
    let margin = " ".repeat(number.len());
    let indent = " ".repeat(excerpt.text[..excerpt.span.start].width());
    let carets = "^".repeat(excerpt.text[excerpt.span.clone()].width().max(1));
    let text = &excerpt.text;
    Some(format!(
        "{number} │ {text}\n{margin} │ {indent}{color}{carets}{plain}\n"
    ))
}
