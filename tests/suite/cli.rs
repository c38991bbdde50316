//! The command line as scripts see it: exit codes, messages, files.

mod adapters;
#[cfg(unix)]
mod checkpoint;
mod compare;
mod convert;
mod explain;
mod help;
mod inspect;
mod merge;
mod refusals;
mod render;
mod report;
#[cfg(unix)]
mod signals;
mod streams;
