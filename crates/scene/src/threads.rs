//! Work on slices by all cores. Results never depend on the number of threads.

use std::{
    cell::Cell,
    num::NonZero,
    sync::{Arc, Mutex, OnceLock, PoisonError},
    thread,
};

/// Slices shorter than this are not divided: starting a thread costs more than it saves.
const LEAST: usize = 1 << 14;

thread_local! {
    static CHOSEN: Cell<Option<usize>> = const { Cell::new(None) };
}

/// Runs `work`, in which functions of this module use `count` threads, the calling one included.
///
/// # Panics
/// If `count` is 0.
pub fn with<R>(count: usize, work: impl FnOnce() -> R) -> R {
    assert!(count > 0, "no thread is left to work");
    let before = CHOSEN.replace(Some(count));
    let result = work();
    CHOSEN.set(before);
    result
}

/// The number of threads: unless chosen by [`with`], as many as cores, or 1 without the feature `parallel`.
pub fn count() -> usize {
    // Asking the system takes longer than a small task.
    static CORES: OnceLock<usize> = OnceLock::new();
    let cores = || match cfg!(feature = "parallel") {
        true => thread::available_parallelism().map_or(1, NonZero::get),
        false => 1,
    };
    (CHOSEN.get()).unwrap_or_else(|| *CORES.get_or_init(cores))
}

/// The length of the chunks into which a slice of this length is divided, at least 1.
pub fn chunk_len(len: usize) -> usize {
    match len < LEAST {
        true => len.max(1),
        false => len.div_ceil(count()),
    }
}

/// Calls `work` with each job, each on a thread of its own; the last one on the calling thread.
pub fn for_each<J: Send>(jobs: impl IntoIterator<Item = J>, work: impl Fn(J) + Sync) {
    let mut jobs = jobs.into_iter();
    let Some(mut last) = jobs.next() else { return };
    thread::scope(|scope| {
        let work = &work;
        for next in jobs {
            let job = std::mem::replace(&mut last, next);
            scope.spawn(move || work(job));
        }
        work(last);
    });
}

/// Does both, `aside` on a thread of its own if there are several.
pub fn join<R>(work: impl FnOnce() -> R, aside: impl FnOnce() + Send) -> R {
    if count() == 1 {
        aside();
        return work();
    }
    thread::scope(|scope| {
        scope.spawn(aside);
        work()
    })
}

/// The results of `work` for all jobs, in their order. Threads take the next job as soon as they are done with one, so
/// that jobs may differ in length.
pub fn map<J: Send, R: Send>(jobs: Vec<J>, work: impl Fn(J) -> R + Sync) -> Vec<R> {
    let count = count().min(jobs.len());
    let mut results: Vec<Option<R>> = jobs.iter().map(|_| None).collect();
    let queue = Mutex::new(jobs.into_iter().zip(&mut results));
    let next = || queue.lock().unwrap_or_else(PoisonError::into_inner).next();
    for_each(0..count, |_| {
        while let Some((job, result)) = next() {
            *result = Some(work(job));
        }
    });
    drop(queue);
    results.into_iter().flatten().collect()
}

/// Divides a slice into chunks, and calls `work` with the index of the first element of each and the chunk.
pub fn for_chunks<T: Send>(slice: &mut [T], work: impl Fn(usize, &mut [T]) + Sync) {
    let len = chunk_len(slice.len());
    for_each(slice.chunks_mut(len).enumerate(), |(index, chunk)| {
        work(index * len, chunk);
    });
}

/// A list of `len` elements, made from their indices.
pub fn collect<T: Copy + Send>(len: usize, make: impl Fn(usize) -> T + Sync) -> Vec<T> {
    let mut list = if len > 0 {
        vec![make(0); len]
    } else {
        Vec::new()
    };
    fill(&mut list, make);
    list
}

/// As [`collect`], without a copy when the list is shared.
pub fn collect_shared<T: Copy + Send>(len: usize, make: impl Fn(usize) -> T + Sync) -> Arc<[T]> {
    let mut list: Arc<[T]> = match len {
        0 => Arc::from([]),
        _ => std::iter::repeat_n(make(0), len).collect(),
    };
    if let Some(list) = Arc::get_mut(&mut list) {
        fill(list, make);
    }
    list
}

/// Sets all elements, made from their indices. Memory that is still zero from the system is first touched here, by all
/// threads.
pub fn fill<T: Send>(list: &mut [T], make: impl Fn(usize) -> T + Sync) {
    for_chunks(list, |first, chunk| {
        for (index, slot) in (first..).zip(chunk) {
            *slot = make(index);
        }
    });
}

/// Sorts a list without equal elements.
pub fn sort<T: Copy + Ord + Send + Sync>(list: &mut Vec<T>) {
    let mut run = chunk_len(list.len());
    for_chunks(list, |_, chunk| chunk.sort_unstable());
    if run >= list.len() {
        return;
    }
    let mut merged = list.clone();
    while run < list.len() {
        let pairs = list.chunks(2 * run).zip(merged.chunks_mut(2 * run));
        let parts = (2 * run * count()).div_ceil(list.len());
        let jobs =
            pairs.flat_map(|(pair, out)| divided(pair.split_at(run.min(pair.len())), out, parts));
        for_each(jobs, |(pair, out)| merge(pair, out));
        std::mem::swap(list, &mut merged);
        run *= 2;
    }
}

/// Two sorted slices and the place of their elements in order.
type Merge<'a, T> = ((&'a [T], &'a [T]), &'a mut [T]);

/// Divides a merge into at most `count` parts of about the same length.
fn divided<'a, T: Ord>(
    (mut left, mut right): (&'a [T], &'a [T]),
    mut out: &'a mut [T],
    count: usize,
) -> Vec<Merge<'a, T>> {
    let len = out.len().div_ceil(count.max(1)).max(1);
    let mut parts = Vec::with_capacity(count);
    while !out.is_empty() {
        let len = len.min(out.len());
        let on_left = least_on_left((left, right), len);
        let (own_left, rest_left) = left.split_at(on_left);
        let (own_right, rest_right) = right.split_at(len - on_left);
        let (own, rest) = std::mem::take(&mut out).split_at_mut(len);
        parts.push(((own_left, own_right), own));
        (left, right, out) = (rest_left, rest_right, rest);
    }
    parts
}

/// The number of the `count` least elements of two sorted slices that are in the left one.
fn least_on_left<T: Ord>((left, right): (&[T], &[T]), count: usize) -> usize {
    let (mut low, mut high) = (count.saturating_sub(right.len()), count.min(left.len()));
    while low < high {
        let middle = low.midpoint(high);
        match left[middle] < right[count - middle - 1] {
            true => low = middle + 1,
            false => high = middle,
        }
    }
    low
}

/// Merges two sorted slices.
fn merge<T: Copy + Ord>((mut left, mut right): (&[T], &[T]), out: &mut [T]) {
    for slot in out {
        let from = match (left.first(), right.first()) {
            (Some(a), Some(b)) if b < a => &mut right,
            (Some(_), _) => &mut left,
            _ => &mut right,
        };
        *slot = from[0];
        *from = &from[1..];
    }
}
