//! The manual holds: README.md, the book in `docs/` and the READMEs of folders. Their links lead somewhere, their
//! commands parse, their scenes load, and what is generated is current.

mod commands;
mod formats;
mod generated;
mod items;
mod links;
mod native_reference;
mod pages;
#[cfg(unix)]
mod recipes;
mod scenes;
mod tables;
