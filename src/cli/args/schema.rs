//! The flags of `glimray schema`.

use clap::{Args, ValueEnum};

#[derive(Debug, Args)]
pub struct SchemaArgs {
    /// Whose schema
    #[arg(value_enum, default_value_t)]
    pub subject: Subject,
    /// Print the schema of the manifest of `farm plan` instead
    #[cfg(feature = "archive")]
    #[arg(long, conflicts_with = "subject")]
    pub manifest: bool,
}

/// What there is a schema of.
#[derive(Clone, Copy, Debug, Default, ValueEnum)]
pub enum Subject {
    /// Native scenes (.toml)
    #[default]
    Scene,
    /// What --report writes
    Report,
    /// What `compare --json` prints
    Compare,
    /// What `inspect --json` prints
    Inspect,
    /// What `explain --json` prints
    Explain,
}
