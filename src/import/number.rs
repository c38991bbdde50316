//! Numbers in text formats: the decimal subset of C's `scanf("%lf")`.

use super::error::ImportError;
use super::source::{Source, Token};

/// Parses all of `token` as a number in the range of f32, the precision of the GPU.
///
/// # Errors
/// `token` is not a decimal number, or is out of range.
pub(super) fn parse(source: &Source, token: Token) -> Result<f64, ImportError> {
    let is_decimal = |b: &u8| b.is_ascii_digit() || b"+-.eE".contains(b);
    let text = std::str::from_utf8(token.bytes).ok();
    let text = text.filter(|text| text.bytes().all(|b| is_decimal(&b)));
    match text.and_then(|text| text.parse().ok()) {
        Some(value) if in_range(value) => Ok(value),
        value => {
            let why = format!(
                "{} {}",
                token.quote(),
                diagnosis(token.bytes, value.is_some())
            );
            let todo = "Write a decimal number such as -0.5 or 2e3";
            Err(source.malformed(token.span(), why, todo))
        }
    }
}

/// The error for a word that is not a number or is out of range.
fn diagnosis(word: &[u8], is_number: bool) -> &'static str {
    let digits = word
        .strip_prefix(b"-")
        .or(word.strip_prefix(b"+"))
        .unwrap_or(word);
    let begins = |prefix: &[u8]| {
        let start = digits.get(..prefix.len());
        start.is_some_and(|start| start.eq_ignore_ascii_case(prefix))
    };
    if is_number {
        "is out of range: at most 3.4e38 is allowed"
    } else if begins(b"nan") || begins(b"inf") {
        "is not a finite number"
    } else if begins(b"0x") {
        "is hexadecimal, which is not accepted"
    } else {
        "is not a number"
    }
}

/// Whether `value` is finite and fits an f32.
pub(super) fn in_range(value: f64) -> bool {
    value.abs() <= f64::from(f32::MAX)
}
