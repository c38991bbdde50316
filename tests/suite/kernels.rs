//! Every kernel is valid WGSL within the minimum limits of WebGPU.

use crate::support::{harness::gpu, verdict::Verdict};
use glimray::{layout::MIXED_LIGHTS, render::KERNEL_OVERRIDES};
use glimray_link as link;
use glimray_shaders::{Kernel, Variant, inline_functions};
use naga::{
    Expression, MathFunction, ScalarKind,
    valid::{Capabilities, ValidationFlags, Validator},
};
use std::{collections::HashMap, fs, path::Path};

/// Release builds from stale sources stop by themselves; others use the files as they are.
#[test]
fn linked_kernels_are_what_the_sources_link_to() {
    let mut verdict = Verdict::on("shaders/linked");
    let linked = link::kernels(Path::new("shaders")).expect("the sources link");
    for (name, text) in &linked {
        let kept = fs::read_to_string(format!("shaders/linked/{name}")).unwrap_or_default();
        verdict.that(name, kept == *text, || "differs: run `make shaders`");
    }
    for entry in fs::read_dir("shaders/linked").expect("a folder") {
        let name = entry.expect("an entry").file_name();
        let name = name.to_string_lossy();
        let is_known = name == "sources.txt" || linked.iter().any(|(known, _)| *known == name);
        verdict.that(&name, is_known, || "is no kernel");
    }
    verdict.close();
}

/// All variants of every kernel, with names for messages.
fn sources() -> impl Iterator<Item = (String, Variant, String)> {
    Kernel::ALL.iter().flat_map(|kernel| {
        kernel.variants().map(|variant| {
            let source = kernel.source(variant).expect("a variant has a source");
            (format!("{} ({variant:?})", kernel.name), variant, source)
        })
    })
}

/// The optional capabilities that a variant needs.
fn capabilities(variant: Variant) -> Capabilities {
    match variant {
        Variant::Packet => Capabilities::SUBGROUP,
        Variant::Image | Variant::Buffer => Capabilities::empty(),
    }
}

#[test]
fn only_packet_kernels_need_an_optional_capability() {
    let mut verdict = Verdict::on("kernels");
    for (name, variant, source) in sources() {
        let checked = naga::front::wgsl::parse_str(&source)
            .map_err(|error| error.emit_to_string(&source))
            .and_then(|module| {
                let mut validator = Validator::new(ValidationFlags::all(), capabilities(variant));
                validator
                    .validate(&module)
                    .map_err(|error| error.emit_to_string(&source))
            });
        verdict.that(&name, checked.is_ok(), || checked.err().unwrap_or_default());
        let asks = source.lines().find(|line| {
            ["enable ", "requires "]
                .iter()
                .any(|word| line.starts_with(word))
        });
        verdict.that(
            format!("{name} asks for no feature"),
            asks.is_none(),
            || asks.unwrap_or_default(),
        );
    }
    verdict.close();
}

/// Software renderers run lanes along X, eight at a time.
#[test]
fn workgroups_are_rows_of_a_multiple_of_eight() {
    let mut verdict = Verdict::on("workgroups");
    for (name, _, source) in sources() {
        let module = naga::front::wgsl::parse_str(&source).expect("WGSL");
        verdict.that(
            format!("{name} has one entry point"),
            module.entry_points.len() == 1,
            || module.entry_points.len(),
        );
        for entry in &module.entry_points {
            let [x, y, z] = entry.workgroup_size;
            let is_row = x % 8 == 0 && x > 0 && x <= 256 && [y, z] == [1, 1];
            verdict.that(format!("{} in {name}", entry.name), is_row, || {
                format!("{x} x {y} x {z}")
            });
        }
    }
    verdict.close();
}

/// Random values for every override, from a seed.
fn random_overrides(seed: u64) -> Vec<(&'static str, f64)> {
    let mut state = seed.wrapping_mul(0x9e37_79b9_7f4a_7c15) | 1;
    let mut next = || {
        state ^= state << 13;
        state ^= state >> 7;
        state ^= state << 17;
        state >> 33
    };
    let most = |ty: &str| if ty == "bool" { 2 } else { 4 };
    let value = |&(name, ty): &(&'static str, &str)| (name, (next() % most(ty)) as f64);
    let own = KERNEL_OVERRIDES.iter().map(value);
    let own: Vec<_> = own.collect();
    [&own[..], &[("EXTREMES_BY_SELECT", (next() % 2) as f64)]].concat()
}

/// Overrides that switch everything on but some.
fn everything_but(off: &[&str]) -> Vec<(&'static str, f64)> {
    let all = KERNEL_OVERRIDES.iter().map(|(name, _)| *name);
    let flags = all.filter(|name| name.starts_with("HAS_") && !off.contains(name));
    let kinds = [
        ("SHAPE_KINDS", f64::from(u32::MAX)),
        ("LIGHT_KIND", f64::from(MIXED_LIGHTS)),
        ("LIGHT_ATTENUATION", f64::from(MIXED_LIGHTS)),
    ];
    flags.map(|name| (name, 1.0)).chain(kinds).collect()
}

/// The blocks inside a statement.
fn inner_blocks(statement: &naga::Statement) -> Vec<&naga::Block> {
    match statement {
        naga::Statement::Block(body) => vec![body],
        naga::Statement::If { accept, reject, .. } => vec![accept, reject],
        naga::Statement::Loop {
            body, continuing, ..
        } => vec![body, continuing],
        naga::Statement::Switch { cases, .. } => cases.iter().map(|case| &case.body).collect(),
        _ => Vec::new(),
    }
}

/// Whether a block or a nested block branches on a literal.
fn branches_on_a_literal(function: &naga::Function, block: &naga::Block) -> bool {
    block.iter().any(|statement| {
        let is_literal = matches!(statement, naga::Statement::If { condition, .. }
            if matches!(function.expressions[*condition], Expression::Literal(_)));
        let mut inner = inner_blocks(statement).into_iter();
        is_literal || inner.any(|block| branches_on_a_literal(function, block))
    })
}

/// How many loops of a block have a `continuing` block.
fn continuing_loops(block: &naga::Block) -> usize {
    let of = |statement: &naga::Statement| {
        let continues = matches!(statement, naga::Statement::Loop { continuing, break_if, .. }
            if !continuing.is_empty() || break_if.is_some());
        let inner = inner_blocks(statement).into_iter().map(continuing_loops);
        usize::from(continues) + inner.sum::<usize>()
    };
    block.iter().map(of).sum()
}

/// The functions of a module and of its entry points.
fn functions(module: &naga::Module) -> impl Iterator<Item = &naga::Function> {
    let entries = module.entry_points.iter().map(|entry| &entry.function);
    let functions = module.functions.iter().map(|(_, function)| function);
    functions.chain(entries)
}

/// lavapipe executes the body of a loop with a `continuing` block once more, with no lane.
#[test]
fn loops_of_specialised_kernels_end_with_their_bodies() {
    let mut verdict = Verdict::on("loops");
    for kernel in Kernel::ALL {
        for variant in kernel.variants() {
            let module = kernel.specialized(variant, &everything_but(&[]));
            let module = module.expect("WGSL");
            let count = |function: &naga::Function| continuing_loops(&function.body);
            let continuing: usize = functions(&module).map(count).sum();
            let name = format!("{} ({variant:?})", kernel.name);
            verdict.that(name, continuing == 0, || continuing);
        }
    }
    verdict.close();
}

/// The private variables that entry points use.
fn private_variables(module: &naga::Module) -> impl Iterator<Item = &naga::GlobalVariable> {
    let entries = module.entry_points.iter();
    let expressions = entries.flat_map(|entry| entry.function.expressions.iter());
    let variables = expressions.filter_map(|(_, expression)| match *expression {
        Expression::GlobalVariable(global) => Some(&module.global_variables[global]),
        _ => None,
    });
    variables.filter(|variable| variable.space == naga::AddressSpace::Private)
}

#[test]
fn specialised_kernels_are_valid_and_branch_on_no_constant() {
    let mut verdict = Verdict::on("specialised kernels");
    for kernel in Kernel::ALL {
        let variants: Vec<_> = kernel.variants().collect();
        for (seed, variant) in (0..12).zip(variants.iter().cycle()) {
            let overrides = random_overrides(seed);
            let mut module = kernel
                .specialized(*variant, &overrides)
                .unwrap_or_else(|error| panic!("{}: {error}", kernel.name));
            let what = format!("{} with the choices of seed {seed}", kernel.name);
            let mut validator = Validator::new(ValidationFlags::all(), capabilities(*variant));
            let checked = validator.validate(&module);
            verdict.that(&what, checked.is_ok(), || format!("{checked:?}"));
            let branches =
                functions(&module).any(|function| branches_on_a_literal(function, &function.body));
            verdict.that(&what, !branches, || "branches on a constant");

            inline_functions(&mut module);
            let checked = validator.validate(&module);
            verdict.that(&what, checked.is_ok(), || format!("inlined: {checked:?}"));
            let left = module.functions.iter().map(|(_, function)| &function.name);
            let left: Vec<_> = left.collect();
            verdict.that(&what, left.is_empty(), || format!("not inlined: {left:?}"));
            let private: Vec<_> = private_variables(&module).collect();
            verdict.that(&what, private.is_empty(), || format!("{private:?}"));
        }
    }
    verdict.close();
}

#[test]
fn a_feature_that_is_off_leaves_no_function_behind() {
    let functions = |kernel: &Kernel, overrides: &[(&str, f64)]| -> String {
        let module = kernel.specialized(Variant::Image, overrides).expect("WGSL");
        let names = module.functions.iter();
        names
            .filter_map(|(_, function)| function.name.clone())
            .collect::<Vec<_>>()
            .join(" ")
    };
    let mut verdict = Verdict::on("functions");
    // With the functions that only this feature needs.
    for (kernel, feature, name) in [
        (&Kernel::WHITTED, "HAS_TEXTURES", "noise__"),
        (&Kernel::WHITTED, "HAS_INSTANCES", "load_instance"),
        (&Kernel::WHITTED, "HAS_AREA_LIGHTS", "area_incident"),
        (&Kernel::WHITTED, "HAS_LENS", "lens_ray"),
        (&Kernel::WHITTED, "HAS_CLIP", "clipped_ray"),
        (&Kernel::WHITTED, "HAS_CONTACT", "is_near"),
        (&Kernel::PATH_TRACE, "HAS_GLOSS", "ggx_albedo"),
        (
            &Kernel::PATH_TRACE,
            "HAS_METALLIC_ROUGHNESS",
            "metallic_roughness",
        ),
    ] {
        // Coats call functions of gloss.
        let coats = ["HAS_COATED_EMISSION", "HAS_COATINGS"];
        let all = functions(kernel, &everything_but(&coats));
        verdict.that(feature, all.contains(name), || format!("not in {all}"));
        let without = functions(kernel, &everything_but(&[coats[0], coats[1], feature]));
        verdict.that(feature, !without.contains(name), || without.clone());
    }
    verdict.close();
}

#[test]
fn an_undeclared_override_is_rejected() {
    let refused =
        Kernel::WHITTED.specialized(Variant::Image, &[("HAS_LIGHTS", 1.0), ("HAS_LIGHT", 1.0)]);
    assert_eq!(
        refused.map(|_| ()),
        Err("there is no override HAS_LIGHT".to_owned())
    );
}

/// How many calls of `min`, `max`, `clamp` and `saturate` of floats a module has.
fn extremes(module: &naga::Module, variant: Variant) -> usize {
    use MathFunction::{Clamp, Max, Min, Saturate};
    let mut validator = Validator::new(ValidationFlags::all(), capabilities(variant));
    let info = validator.validate(module).expect("a valid module");
    let functions = link::functions(module, &info);
    let count = |(function, info): (&naga::Function, &naga::valid::FunctionInfo)| {
        let calls = function.expressions.iter().filter(|(handle, expression)| {
            let kind = info[*handle].ty.inner_with(&module.types).scalar_kind();
            matches!(
                expression,
                Expression::Math {
                    fun: Min | Max | Clamp | Saturate,
                    ..
                }
            ) && kind == Some(ScalarKind::Float)
        });
        calls.count()
    };
    functions.map(count).sum()
}

#[test]
fn extremes_of_floats_can_be_selected() {
    let mut verdict = Verdict::on("min, max, clamp and saturate");
    for kernel in Kernel::ALL {
        for variant in kernel.variants() {
            let count = |by_select| {
                let by_select = [("EXTREMES_BY_SELECT", by_select)];
                let overrides = [&everything_but(&[])[..], &by_select].concat();
                let module = kernel.specialized(variant, &overrides).expect("WGSL");
                extremes(&module, variant)
            };
            let what = format!("{} ({variant:?})", kernel.name);
            // At most `min` and `max` of four types: all calls go through their functions.
            let built_in = count(0.0);
            verdict.that(&what, (2..=8).contains(&built_in), || built_in);
            let selected = count(1.0);
            verdict.that(&what, selected == 0, || selected);
        }
    }
    verdict.close();
}

#[test]
fn selected_extremes_are_those_of_ieee_754() {
    let linked = Kernel::PATH_TRACE.source(Variant::Image).expect("a source");
    let (_, functions) = linked
        .split_once("override bindings__EXTREMES_BY_SELECT: bool = false;")
        .expect("the functions are last");
    let source = format!(
        "const bindings__EXTREMES_BY_SELECT: bool = true; {functions}
         fn probe(a: f32, b: f32) -> vec4f {{
             let low = min_f32(a, b);
             let high = max_f32(a, b);
             return vec4f(low, high, clamp_f32(0.5, low, high), saturate_f32(a));
         }}"
    );
    let numbers = [
        f32::NEG_INFINITY,
        f32::MIN,
        -1.0,
        -f32::MIN_POSITIVE,
        0.0,
        0.25,
        0.75,
        1.0 - f32::EPSILON / 2.0,
        1.0,
        1.0 + f32::EPSILON,
        f32::MAX,
        f32::INFINITY,
    ];
    let pairs: Vec<_> = (numbers.iter())
        .flat_map(|&a| numbers.map(|b| (a, b)))
        .collect();
    let results: Vec<[f32; 4]> = gpu().map_source(&source, &pairs);
    let mut verdict = Verdict::on("selected extremes");
    for ((a, b), got) in pairs.iter().zip(results) {
        let (low, high) = (a.min(*b), a.max(*b));
        let expected = [low, high, 0.5_f32.clamp(low, high), a.clamp(0.0, 1.0)];
        verdict.that(format!("{a:e}, {b:e}"), got == expected, || {
            format!("{got:?}")
        });
    }
    verdict.close();
}

/// How often drivers inline each function of a module that is called, by its name without its module.
fn inlined(module: &naga::Module) -> HashMap<String, usize> {
    fn called(block: &naga::Block, found: &mut Vec<naga::Handle<naga::Function>>) {
        for statement in block {
            if let naga::Statement::Call { function, .. } = statement {
                found.push(*function);
            }
            for inner in inner_blocks(statement) {
                called(inner, found);
            }
        }
    }
    let mut counts = vec![0; module.functions.len()];
    let add = |counts: &mut Vec<usize>, function: &naga::Function, times: usize| {
        let mut found = Vec::new();
        called(&function.body, &mut found);
        for function in found {
            counts[function.index()] += times;
        }
    };
    add(&mut counts, &module.entry_points[0].function, 1);
    // Functions come before those that call them.
    for (handle, function) in module.functions.iter().rev() {
        let times = counts[handle.index()];
        add(&mut counts, function, times);
    }
    let name = |function: &naga::Function| {
        let name = function.name.clone().unwrap_or_default();
        name.rsplit("__").next().unwrap_or_default().to_owned()
    };
    let mut by_name = HashMap::new();
    for (handle, function) in module.functions.iter() {
        *by_name.entry(name(function)).or_default() += counts[handle.index()];
    }
    by_name
}

/// Each copy of a long function takes time to compile, on lavapipe to run, and GPUs the space for other code.
#[test]
fn long_functions_of_the_path_tracer_are_not_inlined_again_and_again() {
    let glass = everything_but(&[
        "HAS_ANISOTROPY",
        "HAS_CATCHERS",
        "HAS_COATED_EMISSION",
        "HAS_COATINGS",
        "HAS_COAT_NORMALS",
        "HAS_DISPERSION",
        "HAS_EMISSIVE_SHAPES",
        "HAS_EMITTERS",
        "HAS_EMITTER_GLOWS",
        "HAS_FEATURES",
        "HAS_LIGHT_TREE",
        "HAS_OPACITY",
        "HAS_ROUGH_GLASS",
    ]);
    let glass = [&glass[..], &[("FILTERED_SHADOWS", 1.0)]].concat();
    let count_of = |overrides: &[(&str, f64)]| {
        let module = Kernel::PATH_TRACE.specialized(Variant::Image, overrides);
        inlined(&module.expect("WGSL"))
    };
    let counts = count_of(&glass);
    let rough = count_of(&[&glass[..], &[("HAS_ROUGH_GLASS", 1.0)]].concat());
    let mut verdict = Verdict::on("functions");
    for (name, most) in [
        ("walked", 1),
        ("contact_at", 1),
        ("surface_at", 1),
        ("coverage_at", 1),
        ("layers_at", 1),
        ("bsdf_at", 1),
        ("bsdf_eval", 2),
        ("sample_light", 1),
        // Without rough glass nothing is evaluated at microfacets of a boundary.
        ("ggx_transmission", 0),
        ("boundary_eval", 0),
        // For the whole surface, and for a microfacet.
        ("boundary_at", 2),
    ] {
        let of = |counts: &HashMap<String, usize>| counts.get(name).copied().unwrap_or_default();
        let count = of(&counts);
        verdict.that(name, count <= most, || {
            format!("{count} copies, {most} allowed")
        });
        // A renamed function would never be found.
        verdict.that(format!("{name} is there"), of(&rough) > 0, || "is not");
    }
    verdict.close();
}
