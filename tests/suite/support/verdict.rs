//! Checks rows one by one and fails once, with all errors.

use std::fmt::{Debug, Display};

/// The tolerance of a result.
#[derive(Clone, Copy, Debug)]
pub enum Tolerance {
    Exact,
    Absolute(f64),
    Relative(f64),
    /// In f32 steps at the expected value.
    Ulps(f64),
}

impl Tolerance {
    /// Whether a result is within the tolerance.
    pub fn allows(self, got: f32, expected: f64) -> bool {
        let error = (f64::from(got) - expected).abs();
        match self {
            Self::Exact => error == 0.0,
            Self::Absolute(most) => error <= most,
            Self::Relative(most) => error <= most * expected.abs(),
            Self::Ulps(most) => error <= most * ulp(expected),
        }
    }
}

/// The distance between neighbouring f32 at `x`.
pub fn ulp(x: f64) -> f64 {
    let x = (x as f32).abs();
    f64::from(x.next_up()) - f64::from(x)
}

/// The expected result of a shader, in exact numbers.
pub trait Expected: Debug {
    type Got: Debug;
    fn is_met(&self, got: &Self::Got, tolerance: Tolerance) -> bool;
}

impl Expected for f64 {
    type Got = f32;
    fn is_met(&self, got: &f32, tolerance: Tolerance) -> bool {
        tolerance.allows(*got, *self)
    }
}

impl Expected for u32 {
    type Got = u32;
    fn is_met(&self, got: &u32, _: Tolerance) -> bool {
        self == got
    }
}

impl Expected for bool {
    type Got = bool;
    fn is_met(&self, got: &bool, _: Tolerance) -> bool {
        self == got
    }
}

impl<E: Expected, const N: usize> Expected for [E; N] {
    type Got = [E::Got; N];
    fn is_met(&self, got: &Self::Got, tolerance: Tolerance) -> bool {
        self.iter()
            .zip(got)
            .all(|(expected, got)| expected.is_met(got, tolerance))
    }
}

/// The results of a number of rows.
pub struct Verdict {
    subject: String,
    rows: usize,
    failures: Vec<String>,
    is_closed: bool,
}

/// Failures in a verdict that is never closed would be lost.
impl Drop for Verdict {
    fn drop(&mut self) {
        let is_lost = !self.is_closed && !std::thread::panicking();
        assert!(!is_lost, "the verdict on {} is not closed", self.subject);
    }
}

impl Verdict {
    /// Failures listed in full.
    const LISTED: usize = 20;

    pub fn on(subject: impl Display) -> Self {
        Self {
            subject: subject.to_string(),
            rows: 0,
            failures: Vec::new(),
            is_closed: false,
        }
    }

    /// Checks that a result is within `tolerance` of the expected one.
    pub fn near<E: Expected>(
        &mut self,
        name: impl Display,
        got: &E::Got,
        expected: &E,
        tolerance: Tolerance,
    ) {
        self.that(name, expected.is_met(got, tolerance), || {
            format!("got      {got:?}\n    expected {expected:?}, {tolerance:?}")
        });
    }

    /// Checks that a condition holds; `details` describes the actual result.
    pub fn that<D: Display>(
        &mut self,
        name: impl Display,
        holds: bool,
        details: impl FnOnce() -> D,
    ) {
        self.rows += 1;
        if !holds {
            self.failures.push(format!("  {name}\n    {}", details()));
        }
    }

    /// Fails with all failed rows, or if there were none at all.
    pub fn close(mut self) {
        self.is_closed = true;
        let Self {
            subject,
            rows,
            failures,
            ..
        } = &self;
        assert!(*rows > 0, "{subject}: there were no rows");
        let unlisted = failures.len().saturating_sub(Self::LISTED);
        let more = if unlisted > 0 {
            format!("\n  … and {unlisted} more")
        } else {
            String::new()
        };
        let listed = &failures[..failures.len() - unlisted];
        assert!(
            failures.is_empty(),
            "{subject}: {} of {rows} rows fail\n{}{more}",
            failures.len(),
            listed.join("\n"),
        );
    }
}

#[test]
#[should_panic(expected = "nothing: there were no rows")]
fn a_verdict_without_rows_fails() {
    Verdict::on("nothing").close();
}

#[test]
#[should_panic(expected = "one of two: 1 of 2 rows fail\n  second\n    it is odd")]
fn a_verdict_fails_with_the_rows_that_do_not_hold() {
    let mut verdict = Verdict::on("one of two");
    verdict.that("first", true, || "");
    verdict.that("second", false, || "it is odd");
    verdict.close();
}

#[test]
#[should_panic(expected = "the verdict on something is not closed")]
fn a_verdict_that_is_not_closed_fails() {
    Verdict::on("something").that("row", false, || "");
}
