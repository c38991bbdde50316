//! Numbers in text formats: the decimal subset of C's `scanf("%lf")`.

use super::error::ImportError;
use super::source::{Source, Token};

/// Parses all of `token` as a number in the range of f32, the precision of the GPU.
///
/// # Errors
/// `token` is not a decimal number, or is out of range.
pub(super) fn parse(source: &Source, token: Token) -> Result<f64, ImportError> {
    read(token.bytes).ok_or_else(|| {
        let (why, todo) = refusal(token);
        source.malformed(token.span(), why, todo)
    })
}

/// All of `word` as a number in the range of f32.
pub(super) fn read(word: &[u8]) -> Option<f64> {
    number(word).filter(|&value| in_range(value))
}

fn number(word: &[u8]) -> Option<f64> {
    let is_decimal = |b: &u8| b.is_ascii_digit() || b"+-.eE".contains(b);
    let text = std::str::from_utf8(word).ok();
    let text = text.filter(|text| text.bytes().all(|b| is_decimal(&b)));
    text?.parse().ok()
}

/// Whether C programs write `word` for a number that is not finite: `nan`, `-nan(ind)`, `1.#QNAN`, `-inf` and so on. Any
/// number out of the range of f32 is one too.
pub(super) fn is_nonfinite(word: &[u8]) -> bool {
    let digits = unsigned(word);
    let begins = |prefix: &[u8]| begins(digits, prefix);
    begins(b"nan") || begins(b"inf") || begins(b"1.#") || number(word).is_some_and(|v| !in_range(v))
}

fn unsigned(word: &[u8]) -> &[u8] {
    let positive = word.strip_prefix(b"-").or(word.strip_prefix(b"+"));
    positive.unwrap_or(word)
}

fn begins(word: &[u8], prefix: &[u8]) -> bool {
    let start = word.get(..prefix.len());
    start.is_some_and(|start| start.eq_ignore_ascii_case(prefix))
}

/// Why `token` is not a number that can be used, and what to do.
pub(super) fn refusal(token: Token) -> (String, &'static str) {
    let digits = unsigned(token.bytes);
    let why = if number(token.bytes).is_some() {
        "is out of range: at most 3.4e38 is allowed"
    } else if is_nonfinite(token.bytes) {
        "is not a finite number"
    } else if begins(digits, b"0x") {
        "is hexadecimal, which is not accepted"
    } else {
        "is not a number"
    };
    let why = format!("{} {why}", token.quote());
    (why, "Write a decimal number such as -0.5 or 2e3")
}

/// Whether `value` is finite and fits an f32.
pub(super) fn in_range(value: f64) -> bool {
    value.abs() <= f64::from(f32::MAX)
}
