//! Functions are inlined without a change of what they compute.

use crate::support::{
    harness::gpu,
    verdict::{Tolerance, Verdict},
};
use glimray::gpu::inline_functions;

/// Returns in branches and bare blocks, initial values in loops, pointers, structures, a `switch`, a loop that returns, and
/// private variables.
const SOURCE: &str = "
struct Pair { low: u32, both: vec2u }
var<private> calls: u32;
fn limited(x: u32) -> u32 {
    if (x < 3u) { return 3u; }
    let even = x & ~1u;
    if (even > 40u) { return 40u; } else if (even == 20u) { return 7u; }
    return even;
}
fn order(pair: ptr<function, vec2u>, is_wanted: bool) {
    if (!is_wanted) { return; }
    if ((*pair).x > (*pair).y) { *pair = (*pair).yx; } else { return; }
}
fn split(x: u32) -> Pair {
    var pair: Pair;
    if (x % 3u == 0u) { pair.low = x; return pair; }
    pair.both = vec2u(x, pair.low + 1u);
    return pair;
}
fn raise(steps: ptr<function, array<u32, 2>>, index: u32) {
    (*steps)[index] += 1u;
}
fn walked(count: u32) -> u32 {
    var sum: u32;
    var steps = array(3u, 5u);
    for (var k = 0u; k < count; k++) {
        sum += steps[k & 1u];
        raise(&steps, k & 1u);
    }
    return sum;
}
fn walks(x: u32) -> u32 {
    var sum = 0u;
    for (var k = 0u; k < 4u; k++) { sum += walked(x % 5u + 3u - k); }
    return sum;
}
fn named(x: u32) -> u32 {
    var number = 1u;
    switch (x % 4u) {
        case 0u: { number = 5u; }
        case 1u, 2u: { number += x; }
        default: {}
    }
    { if (number > 30u) { return 30u; } }
    return number;
}
fn root(x: u32) -> u32 {
    for (var k = 0u; k < 50u; k++) {
        if (k * k >= x) { return k; }
    }
    return 50u;
}
fn count_call(counter: ptr<private, u32>) { *counter += 1u; }
fn is_counted(x: u32) -> bool {
    count_call(&calls);
    return x > 10u;
}
fn probe(x: u32) -> array<u32, 7> {
    var sum = 0u;
    for (var k = 2u; k > 0u; k--) { sum += walks(x + k); }
    var ordered = vec2u(x, limited(x));
    order(&ordered, x % 2u == 0u);
    let pair = split(x);
    if ((is_counted(x) && is_counted(limited(x))) || is_counted(x + 5u)) { sum += 1000u; }
    is_counted(x);
    let both = pair.low + 100u * pair.both.x + pair.both.y;
    return array(sum, ordered.x, ordered.y, both, named(x), ROOT, calls);
}";

fn limited(x: u32) -> u32 {
    match x {
        0..3 => 3,
        20 | 21 => 7,
        _ => (x & !1).min(40),
    }
}

fn expected(x: u32) -> [u32; 7] {
    let walked = |count: u32| {
        (0..count)
            .map(|k| [3, 5][k as usize % 2] + k / 2)
            .sum::<u32>()
    };
    let walks = |x: u32| (0..4).map(|k| walked(x % 5 + 3 - k)).sum::<u32>();
    let mut sum = walks(x + 2) + walks(x + 1);
    let mut ordered = [x, limited(x)];
    if x.is_multiple_of(2) {
        ordered.sort();
    }
    let pair = if x.is_multiple_of(3) { x } else { 100 * x + 1 };
    let (first, second) = (x > 10, limited(x) > 10);
    let is_either = (first && second) || x + 5 > 10;
    sum += 1000 * u32::from(is_either);
    let calls = 2 + u32::from(first) + u32::from(!(first && second));
    let named = [5, 1 + x, 1 + x, 1][x as usize % 4].min(30);
    let root = (0..50).find(|k| k * k >= x).unwrap_or(50);
    [sum, ordered[0], ordered[1], pair, named, root, calls]
}

/// With `root` called, or with a number in its place.
fn source(calls_root: bool) -> String {
    SOURCE.replace("ROOT", if calls_root { "root(x)" } else { "0u" })
}

#[test]
fn inlined_functions_compute_what_called_ones_do() {
    let inputs: Vec<u32> = (0..64).chain([2500, 2501]).collect();
    let mut verdict = Verdict::on("inlining");
    for calls_root in [true, false] {
        let outputs: Vec<[u32; 7]> = gpu().map_source(&source(calls_root), &inputs);
        for (&x, output) in inputs.iter().zip(&outputs) {
            let mut expected = expected(x);
            if !calls_root {
                expected[5] = 0;
            }
            verdict.near(
                format!("{x}, {calls_root}"),
                output,
                &expected,
                Tolerance::Exact,
            );
        }
    }
    verdict.close();
}

#[test]
fn what_returns_in_a_loop_stays_a_function() {
    let entry = "
        @group(0) @binding(0) var<storage, read_write> out: array<u32>;
        @compute @workgroup_size(1)
        fn main(@builtin(global_invocation_id) id: vec3u) { out[id.x] = probe(id.x)[id.y]; }";
    for (calls_root, expected) in [(true, &[Some("root")][..]), (false, &[])] {
        let source = source(calls_root) + entry;
        let mut module = naga::front::wgsl::parse_str(&source).expect("WGSL");
        inline_functions(&mut module);
        let left: Vec<_> = (module.functions.iter())
            .map(|(_, function)| function.name.as_deref())
            .collect();
        assert_eq!(left, expected);
    }
}
