//! `glimray schema`: prints the JSON Schemas of the native scene format, of what commands print and write as JSON, and of a
//! farm's manifest.

use super::args::{SchemaArgs, Subject};
use super::compare::ComparisonOutput;
use super::inspect::Inspection;
use super::report::AnyReport;
use glimray_app::console;
use glimray_app::error::AppError;
use glimray_app::ray_text::Explanation;
use glimray_io::import;
use schemars::JsonSchema;
use schemars::generate::SchemaSettings;
use serde_json::Value;

pub fn run(arguments: &SchemaArgs) -> Result<(), AppError> {
    #[cfg(feature = "archive")]
    if arguments.manifest {
        return console::print_json(&crate::farm::schema());
    }
    console::print_json(&match arguments.subject {
        Subject::Scene => import::native_schema(),
        Subject::Report => of::<AnyReport>("glimray report"),
        Subject::Compare => of::<ComparisonOutput>("glimray compare --json"),
        Subject::Inspect => of::<Inspection>("glimray inspect --json"),
        Subject::Explain => of::<Explanation>("glimray explain --json"),
    })
}

/// The schema of what is written of a type.
fn of<T: JsonSchema>(title: &str) -> Value {
    let settings = SchemaSettings::default().for_serialize();
    let mut schema = settings.into_generator().into_root_schema_for::<T>();
    schema.insert("title".to_owned(), title.into());
    schema.to_value()
}
