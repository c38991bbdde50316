//! Many alike in a row, which one object with many places stands for.

use std::ops::Range;

/// From how many on places go to a file of their own.
pub(super) const LEAST: usize = 64;

/// The stretches of `items` of which each is alike to the first.
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
