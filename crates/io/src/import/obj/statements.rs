//! The statements of OBJ files, in any case.

/// The kinds of statements.
#[derive(Clone, Copy, PartialEq)]
pub(super) enum Statement {
    Vertex,
    Normal,
    TextureCoordinates,
    Face,
    Material,
    Library,
    Smoothing,
    /// The name of an object.
    Object,
    /// The name of a group.
    Group,
    /// Lines and points.
    Thin,
    /// Curves and surfaces.
    FreeForm,
    /// The renderer has no such thing: it is reported.
    Skipped,
}

use Statement::{FreeForm, Skipped};

const TABLE: [(&str, Statement); 43] = [
    ("v", Statement::Vertex),
    ("vn", Statement::Normal),
    ("vt", Statement::TextureCoordinates),
    ("f", Statement::Face),
    ("fo", Statement::Face),
    ("usemtl", Statement::Material),
    ("mtllib", Statement::Library),
    ("s", Statement::Smoothing),
    ("o", Statement::Object),
    ("g", Statement::Group),
    ("l", Statement::Thin),
    ("p", Statement::Thin),
    ("vp", FreeForm),
    ("curv", FreeForm),
    ("curv2", FreeForm),
    ("surf", FreeForm),
    ("cstype", FreeForm),
    ("deg", FreeForm),
    ("bmat", FreeForm),
    ("step", FreeForm),
    ("parm", FreeForm),
    ("trim", FreeForm),
    ("hole", FreeForm),
    ("scrv", FreeForm),
    ("sp", FreeForm),
    ("con", FreeForm),
    ("end", FreeForm),
    ("mg", Skipped),
    ("bevel", Skipped),
    ("c_interp", Skipped),
    ("d_interp", Skipped),
    ("lod", Skipped),
    ("shadow_obj", Skipped),
    ("trace_obj", Skipped),
    ("ctech", Skipped),
    ("stech", Skipped),
    ("maplib", Skipped),
    ("usemap", Skipped),
    ("call", Skipped),
    ("csh", Skipped),
    ("bsp", Skipped),
    ("bzp", Skipped),
    ("res", Skipped),
];

/// The statement `word` in any case, and how it is usually written.
pub(super) fn find(word: &[u8]) -> Option<(&'static str, Statement)> {
    let is_named = |(name, _): &&(&str, Statement)| word.eq_ignore_ascii_case(name.as_bytes());
    TABLE.iter().find(is_named).copied()
}

/// All keywords.
pub(in crate::import) const KEYS: [&str; TABLE.len()] = {
    let mut names = [""; TABLE.len()];
    let mut i = 0;
    while i < TABLE.len() {
        names[i] = TABLE[i].0;
        i += 1;
    }
    names
};
