//! Text of scene files, file names and systems in messages.

/// Replacement for a character that is not shown.
const REPLACEMENT: &str = "\u{fffd}";

/// Whether `c` shows nothing itself and acts on a terminal or on the text around it: control characters, line and
/// paragraph separators, zero-width characters, the marks, embeddings, overrides and isolates of right-to-left text
/// (Unicode Standard Annex #9), and tags.
pub fn is_control(c: char) -> bool {
    c.is_control()
        || matches!(c, '\u{61c}' | '\u{180e}' | '\u{200b}'..='\u{200f}' | '\u{2028}'..='\u{202e}')
        || matches!(c, '\u{2060}'..='\u{206f}' | '\u{feff}' | '\u{fff9}'..='\u{fffb}')
        || matches!(c, '\u{e0000}'..='\u{e007f}')
}

/// `text` on one line, with a replacement character (�) for each that [`is_control`].
pub fn one_line(text: &str) -> String {
    text.replace(is_control, REPLACEMENT)
}

/// `text` with an escape (`\u{202e}`) for each character that [`is_control`], except those to `keep`.
pub fn escape(text: &str, keep: impl Fn(char) -> bool) -> String {
    let mut escaped = String::with_capacity(text.len());
    for c in text.chars() {
        match is_control(c) && !keep(c) {
            true => escaped.extend(c.escape_default()),
            false => escaped.push(c),
        }
    }
    escaped
}

/// `json` with JSON's own escapes (`\u202e`) for the characters that [`is_control`]. They stand in strings only, but for the
/// line feeds between values.
pub fn escape_json(json: &str) -> String {
    let mut escaped = String::with_capacity(json.len());
    for c in json.chars() {
        match is_control(c) && c != '\n' {
            true => {
                let mut units = [0; 2];
                for unit in c.encode_utf16(&mut units) {
                    escaped.push_str(&format!("\\u{unit:04x}"));
                }
            }
            false => escaped.push(c),
        }
    }
    escaped
}
