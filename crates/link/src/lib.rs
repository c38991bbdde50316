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
    collections::{BTreeMap, BTreeSet},
    error::Error,
    panic::resume_unwind,
    path::Path,
    thread,
};

/// Variants of kernels, and the features of `shaders` that they have.
const VARIANTS: [(&str, &[&str]); 3] = [
    ("image", &["image_fetch"]),
    ("buffer", &[]),
    ("packet", &["image_fetch", "packet"]),
];

/// Names of kernels, the modules in `shaders/kernels` they are made of, the features that all their variants
/// have, and their variants.
const KERNELS: [(&str, &str, &[&str], &[&str]); 12] = [
    ("lecture", "lecture", &[], &["image", "buffer"]),
    ("whitted", "whitted", &[], &["image", "buffer", "packet"]),
    ("path_trace", "path_trace", &[], &["image", "buffer"]),
    ("debug_view", "debug_view", &[], &["image", "buffer"]),
    ("develop", "develop", &[], &["buffer"]),
    ("show", "show", &[], &["buffer"]),
    ("film_features", "film_features", &[], &["buffer"]),
    ("demodulate", "demodulate", &[], &["buffer"]),
    ("denoise", "denoise", &[], &["image", "buffer"]),
    ("explain", "whitted", &["record"], &["image", "buffer"]),
    (
        "explain_path",
        "explain_path",
        &["record"],
        &["image", "buffer"],
    ),
    (
        "trace_rays",
        "trace_rays",
        &[],
        &["image", "buffer", "packet"],
    ),
];

/// Every feature of `shaders`.
pub const FEATURES: [&str; 3] = ["image_fetch", "packet", "record"];

/// Names items of modules as `module__item`, where wesl would repeat the whole path: the program embeds the text.
/// Modules that share a name have no item of the same name; naga would reject the second.
struct ShortNames;

impl wesl::Mangler for ShortNames {
    fn mangle(&self, path: &wesl::ModulePath, item: &str) -> String {
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
        for (kernel, module, own, variants) in KERNELS {
            for (variant, features) in VARIANTS {
                if variants.contains(&variant) {
                    let name = format!("{kernel}_{variant}.wgsl");
                    let text = scope.spawn(move || {
                        linked(folder, module, &[own, features].concat())
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

/// A module of `shaders/kernels` with these features and all that it imports.
fn linked(folder: &Path, module: &str, features: &[&str]) -> Result<String, Box<dyn Error>> {
    let mut compiler = wesl::Wesl::new(folder);
    compiler.set_custom_mangler(ShortNames);
    for feature in FEATURES {
        compiler.set_feature(feature, features.contains(&feature));
    }
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
