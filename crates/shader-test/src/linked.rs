//! Linked functions, and the lines of their sources that messages are about.

use crate::Error;
use std::ops::Range;
use wesl::{
    BasicSourceMap, Diagnostic, ModulePath, SourceMap,
    syntax::{CompoundStatement, GlobalDeclaration, Statement, StatementNode, TranslationUnit},
};
use wgpu::naga::{self, Span};

/// The module of the text that a shader was made from. No folder has a file of this name.
pub const TEXT: &str = "shader_test_text";

/// A function in plain WGSL with all that it needs.
pub struct Linked {
    /// The text.
    pub wgsl: String,
    /// The syntax of the text, with places in the sources.
    pub syntax: TranslationUnit,
    /// Sources, and where declarations of the text are in them.
    pub map: BasicSourceMap,
    /// The function's module, whose names are as in the source.
    pub root: ModulePath,
}

impl Linked {
    /// The name that a declaration has in its module.
    pub fn source_name<'a>(&'a self, name: &'a str) -> &'a str {
        self.map.get_decl(name).map_or(name, |(_, name)| name)
    }

    /// Parses the text, with code around the function after it.
    pub fn parse(&self, around: &str) -> Result<naga::Module, Error> {
        let text = format!("{}\n{around}", self.wgsl);
        naga::front::wgsl::parse_str(&text).map_err(|error| {
            let mut message = error.message().to_owned();
            message.extend(error.notes().map(|note| format!("; {note}")));
            of_wgsl(self, &message, error.labels())
        })
    }

    /// Checks a module of [`Self::parse`].
    pub fn validate(&self, module: &naga::Module) -> Result<naga::valid::ModuleInfo, Error> {
        use naga::valid::{Capabilities, ValidationFlags, Validator};
        let found = Validator::new(ValidationFlags::all(), Capabilities::all()).validate(module);
        found.map_err(|error| {
            let mut message = error.as_inner().to_string();
            let mut inner = std::error::Error::source(error.as_inner());
            while let Some(error) = inner {
                message += &format!(": {error}");
                inner = error.source();
            }
            // Labels name what is in memory.
            of_wgsl(self, &message, error.spans().map(|(span, _)| (*span, "")))
        })
    }
}

/// A message of the linker on a function.
pub fn of_wesl(error: wesl::Error, function: &str) -> Error {
    let Diagnostic { error, detail } = Diagnostic::from(error);
    let message = match *error {
        // The list of all tokens that could follow fills the screen.
        wesl::Error::ParseError(error) => {
            let text = error.error.to_string();
            text.split(", expected").next().unwrap_or(&text).to_owned()
        }
        error => error.to_string(),
    };
    let path = detail.module_path.as_ref();
    let name = detail.display_name.or_else(|| Some(file_of(path?, None)));
    let name = name.unwrap_or_else(|| format!("`{function}`"));
    Error::Shader(match (detail.source, detail.span, detail.declaration) {
        (Some(source), Some(span), _) => at(&name, &source, span.start, &message),
        (_, _, Some(declaration)) => format!("{name}: {message}, in `{declaration}`"),
        _ => format!("{name}: {message}"),
    })
}

/// The name of a module's file, which the text that is not in one lacks.
fn file_of(module: &ModulePath, file: Option<&str>) -> String {
    match file {
        Some(file) => file.to_owned(),
        None if module.last() == Some(TEXT) => "text".to_owned(),
        None => module.to_string(),
    }
}

/// A message of naga on linked text, with the spans there that it names.
pub fn of_wgsl<'a>(
    linked: &Linked,
    message: &str,
    labels: impl Iterator<Item = (Span, &'a str)>,
) -> Error {
    let spans = labels.filter_map(|(span, label)| Some((span.to_range()?, label)));
    // Outer spans are named too: functions, and the module.
    let innermost = spans.min_by_key(|(range, _)| range.len());
    let found = innermost.and_then(|(range, label)| {
        let message = match label {
            "" => message.to_owned(),
            label => format!("{message}: {label}"),
        };
        Some(at_source(linked, range.start, &message))?
    });
    Error::Shader(found.unwrap_or_else(|| message.to_owned()))
}

/// A message on a byte of a source: the file, the line and its text.
fn at(file: &str, source: &str, byte: usize, message: &str) -> String {
    let before = source.get(..byte).unwrap_or_default();
    let line = before.matches('\n').count();
    let text = source.lines().nth(line).unwrap_or_default().trim();
    format!("{file}:{}: {message}\n    {text}", line + 1)
}

/// A message on a byte of the linked text, by the statement that was linked to it.
fn at_source(linked: &Linked, byte: usize, message: &str) -> Option<String> {
    // The printed text again, whose spans are its own; those of the syntax are of the sources.
    let printed: TranslationUnit = linked.wgsl.parse().ok()?;
    let mut items = printed.global_declarations.iter();
    let printed = items.find(|item| item.span().range().contains(&byte))?;
    let name = name(printed)?;
    let mut items = linked.syntax.global_declarations.iter();
    let source = items.find(|item| self::name(item).as_ref() == Some(&name))?;
    let statement = statements(printed)
        .iter()
        .rposition(|range| range.contains(&byte));
    let range = statement.and_then(|index| statements(source).into_iter().nth(index));
    let range = range.unwrap_or_else(|| source.span().range());
    let module = linked
        .map
        .get_decl(&name)
        .map_or(&linked.root, |(module, _)| module);
    let file = file_of(module, linked.map.get_display_name(module));
    Some(at(
        &file,
        linked.map.get_source(module)?,
        range.start,
        message,
    ))
}

fn name(item: &GlobalDeclaration) -> Option<String> {
    let ident = match item {
        GlobalDeclaration::Declaration(item) => &item.ident,
        GlobalDeclaration::TypeAlias(item) => &item.ident,
        GlobalDeclaration::Struct(item) => &item.ident,
        GlobalDeclaration::Function(item) => &item.ident,
        GlobalDeclaration::Void | GlobalDeclaration::ConstAssert(_) => return None,
    };
    Some(ident.to_string())
}

/// The statements of a function, outer ones before those in them.
fn statements(item: &GlobalDeclaration) -> Vec<Range<usize>> {
    let mut found = Vec::new();
    if let GlobalDeclaration::Function(function) = item {
        add_all(&function.body, &mut found);
    }
    found
}

fn add_all(body: &CompoundStatement, found: &mut Vec<Range<usize>>) {
    body.statements
        .iter()
        .for_each(|statement| add(statement, found));
}

fn add(statement: &StatementNode, found: &mut Vec<Range<usize>>) {
    found.push(statement.span().range());
    match statement.node() {
        Statement::Compound(body) => add_all(body, found),
        Statement::If(item) => {
            add_all(&item.if_clause.body, found);
            item.else_if_clauses
                .iter()
                .for_each(|clause| add_all(&clause.body, found));
            item.else_clause
                .iter()
                .for_each(|clause| add_all(&clause.body, found));
        }
        Statement::Switch(item) => item
            .clauses
            .iter()
            .for_each(|clause| add_all(&clause.body, found)),
        Statement::Loop(item) => {
            add_all(&item.body, found);
            item.continuing
                .iter()
                .for_each(|clause| add_all(&clause.body, found));
        }
        Statement::For(item) => add_all(&item.body, found),
        Statement::While(item) => add_all(&item.body, found),
        _ => (),
    }
}
