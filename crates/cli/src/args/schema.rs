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

/// Documents with a schema.
#[derive(Clone, Copy, Debug, Default, ValueEnum)]
pub enum Subject {
    /// Native scenes (.toml)
    #[default]
    Scene,
    /// The file of --report
    Report,
    /// The output of `compare --json`
    Compare,
    /// The output of `inspect --json`
    Inspect,
    /// The output of `explain --json`
    Explain,
}
