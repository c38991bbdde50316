//! Animations on the command line: frame files, resumable runs, videos.

mod moving;
mod refusals;
mod resume;
mod videos;
