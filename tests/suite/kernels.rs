//! Every kernel is valid WGSL that WebGPU runs without asking for more than it must give.

use crate::support::verdict::Verdict;
use glimray::gpu::Kernel;
use naga::valid::{Capabilities, ValidationFlags, Validator};

/// All variants of every kernel: (name, WGSL).
fn sources() -> impl Iterator<Item = (String, &'static str)> {
    Kernel::ALL.iter().flat_map(|kernel| {
        let named = |(variant, source)| (format!("{} ({variant})", kernel.name), source);
        kernel.sources.map(named)
    })
}

#[test]
fn kernels_are_valid_without_any_optional_capability() {
    let mut verdict = Verdict::on("kernels");
    for (name, source) in sources() {
        let checked = naga::front::wgsl::parse_str(source)
            .map_err(|error| error.emit_to_string(source))
            .and_then(|module| {
                let mut validator = Validator::new(ValidationFlags::all(), Capabilities::empty());
                validator
                    .validate(&module)
                    .map_err(|error| error.emit_to_string(source))
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
    for (name, source) in sources() {
        let module = naga::front::wgsl::parse_str(source).expect("WGSL");
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
