//! Links every kernel to plain WGSL, once for each of its variants. `make shaders` writes the result to `shaders/linked`;
//! a test compares them.

#[path = "../../../shaders/sources.rs"]
mod sources;

pub use sources::{SOURCES, sums};

use naga::{
    Expression, Function, MathFunction, Module, ScalarKind, TypeInner,
    valid::{Capabilities, FunctionInfo, ModuleInfo, ValidationFlags, Validator},
};
use std::{
    borrow::Cow,
    collections::{BTreeMap, BTreeSet},
    error::Error,
    iter,
    panic::resume_unwind,
    path::Path,
    thread,
};
use wesl::{FileResolver, Mangler, ModulePath, ResolveError, Resolver, Wesl};

/// Variants of kernels, the ends of the names of their modules, and their modes: where the scene is, and whether four rays
/// of a lane are traced together.
const VARIANTS: [(&str, &str, &[&str]); 3] = [
    ("image", "", &["image"]),
    ("buffer", "", &["buffer"]),
    ("packet", "_packet", &["packet", "image"]),
];

/// Names of kernels, which are those of modules in `shaders/kernels`, whether they record rays, and their variants.
const KERNELS: [(&str, &str, &[&str]); 12] = [
    ("lecture", "silent", &["image", "buffer"]),
    ("whitted", "silent", &["image", "buffer", "packet"]),
    ("path_trace", "silent", &["image", "buffer"]),
    ("debug_view", "silent", &["image", "buffer"]),
    ("develop", "silent", &["buffer"]),
    ("show", "silent", &["buffer"]),
    ("film_features", "silent", &["buffer"]),
    ("demodulate", "silent", &["buffer"]),
    ("denoise", "silent", &["image", "buffer"]),
    ("explain", "recording", &["image", "buffer"]),
    ("explain_path", "recording", &["image", "buffer"]),
    ("trace_rays", "silent", &["image", "buffer", "packet"]),
];

/// Finds modules in files. A module that differs between modes is in a folder for each: `scene::stack` is
/// `scene/image/stack.wesl` or `scene/buffer/stack.wesl`.
pub struct Modules {
    files: FileResolver,
    modes: Vec<&'static str>,
}

impl Modules {
    /// The modules in a folder, for these modes; the first that has a module counts.
    pub fn new(folder: &Path, modes: &[&'static str]) -> Self {
        Self {
            files: FileResolver::new(folder),
            modes: modes.to_vec(),
        }
    }

    /// The module as the file system has it.
    fn place(&self, path: &ModulePath) -> ModulePath {
        let is_file = |path: &ModulePath| self.files.fs_path(path).is_some();
        let in_modes = self.modes.iter().map(|mode| {
            let mut path = path.clone();
            let last = path.components.len().saturating_sub(1);
            path.components.insert(last, (*mode).to_owned());
            path
        });
        let mut places = iter::once(path.clone()).chain(in_modes);
        places.find(is_file).unwrap_or_else(|| path.clone())
    }
}

impl Resolver for Modules {
    fn resolve_source<'a>(&'a self, path: &ModulePath) -> Result<Cow<'a, str>, ResolveError> {
        self.files.resolve_source(&self.place(path))
    }

    fn display_name(&self, path: &ModulePath) -> Option<String> {
        self.files.display_name(&self.place(path))
    }
}

/// Names items of modules as `module__item`, where wesl would repeat the whole path: the program embeds the text.
/// Modules that share a name have no item of the same name; naga would reject the second.
struct ShortNames;

impl Mangler for ShortNames {
    fn mangle(&self, path: &ModulePath, item: &str) -> String {
        format!("{}__{item}", path.last().unwrap_or_default())
    }
}

/// The text with a tab for each level of four spaces, which is shorter.
fn indented_by_tabs(text: &str) -> String {
    let line = |line: &str| {
        let rest = line.trim_start_matches(' ');
        "\t".repeat((line.len() - rest.len()) / 4) + rest + "\n"
    };
    text.lines().map(line).collect()
}

/// Names of files for `shaders/linked`, and their text, of the sources in `folder`.
///
/// # Errors
/// An import is broken, or naga rejects what was linked.
pub fn kernels(folder: &Path) -> Result<Vec<(String, String)>, Box<dyn Error>> {
    // wesl takes seconds for each, on one thread.
    thread::scope(|scope| {
        let mut threads = Vec::new();
        for (kernel, recorder, variants) in KERNELS {
            for (variant, end, modes) in VARIANTS {
                if variants.contains(&variant) {
                    let name = format!("{kernel}_{variant}.wgsl");
                    let text = scope.spawn(move || {
                        linked(
                            folder,
                            &format!("{kernel}{end}"),
                            &[modes, &[recorder]].concat(),
                        )
                        .map_err(|error| error.to_string())
                    });
                    threads.push((name, text));
                }
            }
        }
        let texts = threads.into_iter().map(|(name, text)| {
            let text = text.join().unwrap_or_else(|panic| resume_unwind(panic))?;
            Ok((name, text))
        });
        texts.collect()
    })
}

/// A module of `shaders/kernels` and all that it imports, in these modes.
fn linked(folder: &Path, module: &str, modes: &[&'static str]) -> Result<String, Box<dyn Error>> {
    let mut compiler = Wesl::new(folder).set_custom_resolver(Modules::new(folder, modes));
    compiler.set_custom_mangler(ShortNames);
    let linked = compiler.compile(&format!("package::kernels::{module}").parse()?)?;
    with_extremes(indented_by_tabs(&linked.to_string()))
}

/// Replaces the built-in functions of their names for one type. `EXTREMES_BY_SELECT` is an override of
/// `bindings.wesl`.
const EXTREMES: &str = "
fn min_TYPE(a: TYPE, b: TYPE) -> TYPE {
	if (bindings__EXTREMES_BY_SELECT) {
		return select(b, a, a < b);
	}
	return min(a, b);
}

fn max_TYPE(a: TYPE, b: TYPE) -> TYPE {
	if (bindings__EXTREMES_BY_SELECT) {
		return select(b, a, a > b);
	}
	return max(a, b);
}

fn clamp_TYPE(value: TYPE, low: TYPE, high: TYPE) -> TYPE {
	return min_TYPE(max_TYPE(value, low), high);
}

fn saturate_TYPE(value: TYPE) -> TYPE {
	return clamp_TYPE(value, TYPE(0), TYPE(1));
}
";

/// The text with `min`, `max`, `clamp` and `saturate` of floats replaced by the functions of `EXTREMES`. WGSL has no
/// overloading, so sources could do so only with another name for each type.
fn with_extremes(mut text: String) -> Result<String, Box<dyn Error>> {
    let module =
        naga::front::wgsl::parse_str(&text).map_err(|error| error.emit_to_string(&text))?;
    let info = Validator::new(ValidationFlags::all(), Capabilities::all()).validate(&module)?;
    let mut calls = BTreeMap::new();
    for (function, info) in functions(&module, &info) {
        calls.extend(extremes(&module, function, info));
    }
    for (start, (name, ty)) in calls.iter().rev() {
        text.insert_str(start + name.len(), &format!("_{ty}"));
    }
    let types: BTreeSet<_> = calls.values().map(|(_, ty)| ty).collect();
    if !types.is_empty() {
        text += "\noverride bindings__EXTREMES_BY_SELECT: bool = false;\n";
    }
    for ty in types {
        text += &EXTREMES.replace("TYPE", ty);
    }
    Ok(text)
}

/// The functions of a module and of its entry points, with what its validation found.
pub fn functions<'a>(
    module: &'a Module,
    info: &'a ModuleInfo,
) -> impl Iterator<Item = (&'a Function, &'a FunctionInfo)> {
    let functions = (module.functions.iter()).map(|(handle, function)| (function, &info[handle]));
    let entries = module.entry_points.iter().enumerate();
    let entries = entries.map(|(index, entry)| (&entry.function, info.get_entry_point(index)));
    functions.chain(entries)
}

/// The calls of a function that `with_extremes` replaces: where each starts in the text, its name and its type.
fn extremes<'a>(
    module: &'a Module,
    function: &'a Function,
    info: &'a FunctionInfo,
) -> impl Iterator<Item = (usize, (&'static str, String))> + 'a {
    (function.expressions.iter()).filter_map(|(handle, expression)| {
        let Expression::Math { fun, .. } = expression else {
            return None;
        };
        let name = match fun {
            MathFunction::Min => "min",
            MathFunction::Max => "max",
            MathFunction::Clamp => "clamp",
            MathFunction::Saturate => "saturate",
            _ => return None,
        };
        let (scalar, ty) = match info[handle].ty.inner_with(&module.types) {
            TypeInner::Scalar(scalar) => (scalar, "f32".to_owned()),
            TypeInner::Vector { size, scalar } => (scalar, format!("vec{}f", *size as u32)),
            _ => return None,
        };
        let span = function.expressions.get_span(handle).to_range()?;
        (scalar.kind == ScalarKind::Float).then_some((span.start, (name, ty)))
    })
}
