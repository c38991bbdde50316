//! Moving pictures on the command line: frames as files, runs that go on, videos made of frames.

mod moving;
pub mod place;
mod refusals;
mod resume;
mod videos;
