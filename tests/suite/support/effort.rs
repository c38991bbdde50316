//! Measures work independently of the machine and its load: the CPU time of this thread, in units of a
//! calculation that is timed on the same thread after it.

use super::random::Random;
use std::hint::black_box;
use std::time::Instant;

/// CPU seconds of this thread so far; wall-clock seconds if the system does not report them.
fn seconds() -> f64 {
    static START: std::sync::OnceLock<Instant> = std::sync::OnceLock::new();
    // Nanoseconds on a CPU, nanoseconds spent waiting for one, how often.
    let times = std::fs::read_to_string("/proc/thread-self/schedstat").unwrap_or_default();
    let spent = times.split_whitespace().next().and_then(|n| n.parse().ok());
    spent.map_or_else(
        || START.get_or_init(Instant::now).elapsed().as_secs_f64(),
        |nanoseconds: f64| nanoseconds * 1e-9,
    )
}

/// CPU seconds that a million random numbers take at least: two steps of a clock of 10 GHz each. Work that is within
/// its limit by this measure, as most is, needs no measurement of the machine.
const LEAST_UNIT: f64 = 2e-4;

/// CPU seconds for a million random numbers, which on a usual machine is about a millisecond.
fn unit() -> f64 {
    const MILLIONS: u64 = 20;
    let start = seconds();
    let mut random = Random::new(1);
    black_box((0..MILLIONS * 1_000_000).fold(0, |sum, _| sum ^ random.bits()));
    (seconds() - start) / MILLIONS as f64
}

/// Fails if `work`, which runs on this thread, takes longer than drawing this many million random numbers. A
/// limit is many times the expected value: it detects a wrong order of growth, not a slow machine.
#[track_caller]
pub fn within<T>(millions: f64, work: impl FnOnce() -> T) -> T {
    let start = seconds();
    let result = work();
    let spent = seconds() - start;
    if spent < millions * LEAST_UNIT {
        return result;
    }
    let took = spent / unit();
    println!("as much work as {took:.0} million random numbers, {millions} allowed");
    assert!(
        took <= millions,
        "as much work as {took:.0} million random numbers, {millions} allowed"
    );
    result
}

#[test]
fn work_within_its_limit_passes_and_its_result_comes_back() {
    assert_eq!(within(100.0, || 7), 7);
}

#[test]
#[should_panic(expected = "million random numbers, 10 allowed")]
fn work_beyond_its_limit_fails() {
    within(10.0, || {
        let mut random = Random::new(2);
        black_box((0..100_000_000).fold(0, |sum, _| sum ^ random.bits()))
    });
}

/// Sleep stands for other processes.
#[cfg(target_os = "linux")]
#[test]
fn waiting_is_no_work() {
    let start = seconds();
    std::thread::sleep(std::time::Duration::from_millis(50));
    assert!(seconds() - start < 0.025);
}
