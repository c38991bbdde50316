//! Helpers that the tests of all packages share.

#![allow(dead_code, reason = "the tests of the root use more of them")]

#[path = "../../../../tests/suite/support/effort.rs"]
pub mod effort;
#[path = "../../../../tests/suite/support/random.rs"]
pub mod random;
#[path = "../../../../tests/suite/support/skip.rs"]
pub mod skip;
#[path = "../../../../tests/suite/support/verdict.rs"]
pub mod verdict;
