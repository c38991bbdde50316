//! Runs of equal objects, which one object with copies represents.

use std::ops::Range;

/// Runs of at least this length write the transforms to a file of their own.
pub(super) const LEAST: usize = 64;

/// Splits `items` into runs in which every item is equivalent to the first.
pub(super) fn runs<T>(items: &[T], is_alike: impl Fn(&T, &T) -> bool) -> Vec<Range<usize>> {
    let mut runs = Vec::new();
    let mut start = 0;
    for end in 1..=items.len() {
        if end == items.len() || !is_alike(&items[start], &items[end]) {
            runs.push(start..end);
            start = end;
        }
    }
    runs
}
