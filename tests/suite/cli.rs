//! The command line as scripts see it: exit codes, messages, files.

mod adapters;
mod baking;
#[cfg(unix)]
mod checkpoint;
mod compare;
mod convert;
mod explain;
#[cfg(all(unix, feature = "archive"))]
mod farm;
#[cfg(all(unix, feature = "archive"))]
mod farm_faults;
#[cfg(all(unix, feature = "archive"))]
mod farm_runs;
mod help;
mod inspect;
mod library;
mod merge;
mod models;
#[cfg(unix)]
mod parts;
mod refusals;
mod render;
mod report;
mod schema;
mod sheet;
#[cfg(unix)]
mod signals;
mod streams;
mod terminal;
mod thumbnail;
