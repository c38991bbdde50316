//! The line of a scene file that an error points at, drawn for a terminal.

use crate::import::{Excerpt, Fault, Position};
use miette::{
    Diagnostic, GraphicalReportHandler, GraphicalTheme, LabeledSpan, MietteError,
    MietteSpanContents, SourceCode, SourceSpan, SpanContents,
};

/// Longer lines than this many bytes are not shown: a terminal is no place for a megabyte.
const MAX_LINE: usize = 300;

/// The line at fault with a mark; `None` where there is none, or it is too long.
pub fn of(fault: &Fault) -> Option<String> {
    let snippet = Snippet {
        name: fault.place(),
        position: fault.position?,
        excerpt: fault.excerpt.as_ref()?,
    };
    if snippet.excerpt.text.len() > MAX_LINE {
        return None;
    }
    let mut drawing = String::new();
    GraphicalReportHandler::new_themed(GraphicalTheme::default())
        .with_context_lines(0)
        .render_report(&mut drawing, &snippet)
        .ok()?;
    // The first line is the message, which has been printed.
    drawing.split_once('\n').map(|(_, rest)| rest.to_owned())
}

/// An excerpt as miette wants it, without a message.
#[derive(Debug, thiserror::Error)]
#[error("-")]
struct Snippet<'a> {
    name: String,
    position: Position,
    excerpt: &'a Excerpt,
}

impl Diagnostic for Snippet<'_> {
    fn source_code(&self) -> Option<&dyn SourceCode> {
        Some(self)
    }

    fn labels(&self) -> Option<Box<dyn Iterator<Item = LabeledSpan> + '_>> {
        let span = self.excerpt.span.clone();
        let label = LabeledSpan::new_primary_with_span(Some("here".to_owned()), span);
        Some(Box::new(std::iter::once(label)))
    }
}

impl SourceCode for Snippet<'_> {
    /// Always the whole excerpt, which is one line.
    fn read_span<'a>(
        &'a self,
        _: &SourceSpan,
        _: usize,
        _: usize,
    ) -> Result<Box<dyn SpanContents<'a> + 'a>, MietteError> {
        Ok(Box::new(MietteSpanContents::new_named(
            self.name.clone(),
            self.excerpt.text.as_bytes(),
            (0, self.excerpt.text.len()).into(),
            self.position.line - 1,
            self.position.column - 1,
            1,
        )))
    }
}
