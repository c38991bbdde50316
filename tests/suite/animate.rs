//! Animations on the command line: frame files, resumable runs, videos.

mod deforming;
mod moving;
mod refusals;
mod resume;
mod videos;
