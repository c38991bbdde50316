//! The command line as scripts see it: exit codes, messages, files.

mod adapters;
#[cfg(unix)]
mod checkpoint;
mod compare;
mod convert;
mod explain;
#[cfg(all(unix, feature = "archive"))]
mod farm;
mod help;
mod inspect;
mod merge;
mod refusals;
mod render;
mod report;
#[cfg(unix)]
mod signals;
mod streams;
