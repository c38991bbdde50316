//! Inlines functions before Mesa does, for the software adapter.
//!
//! Mesa clones the body of a function into each of its callers, with all that was inlined into it before, and only then
//! simplifies it: what is called at depth 8 is cloned 8 times. It stores and loads each member of a structure wherever
//! that is a parameter or a result, and simplifies code with private variables twice. Here each statement is copied once
//! for each call, values stay values, and private variables become local.

mod copy;
mod operands;
mod private;
mod returns;

use crate::specialize::simplify;
use copy::with_inlined_calls;
use naga::{Block, Expression, Function, Handle, LocalVariable, Module, Statement};
use operands::with_operands;
use private::private_variables_to_local;
use returns::with_returns_at_ends;
use std::collections::{HashMap, HashSet};

/// A statement or an expression of a kind that no kernel has.
struct Unsupported;

/// Functions to be inlined.
type Callees<'a> = HashMap<Handle<Function>, Callee<'a>>;

struct Callee<'a> {
    function: &'a Function,
    /// The statements of the function, which returns only at the end of each branch.
    body: Block,
    /// Variables that are stored as a whole before anything else is done with them; not all such.
    stored_first: HashSet<Handle<LocalVariable>>,
}

/// Inlines all functions but those that return inside a loop or a `switch`, or that go on after an `if` that may have returned
/// in one of its branches only. A module with overrides stays as it is.
pub fn inline_functions(module: &mut Module) {
    // naga rejects some of these, inlined, when a pipeline sets the overrides.
    if !module.overrides.is_empty() {
        return;
    }
    let Module {
        functions,
        entry_points,
        ..
    } = module;
    let callee = |(handle, function)| Some((handle, Callee::new(function)?));
    let callees: Callees = functions.iter().filter_map(callee).collect();
    let others = functions
        .iter()
        .filter(|(handle, _)| !callees.contains_key(handle));
    let inlined: Vec<_> = others
        .filter_map(|(handle, function)| Some((handle, with_inlined_calls(function, &callees)?)))
        .collect();
    for entry in entry_points {
        if let Some(inlined) = with_inlined_calls(&entry.function, &callees) {
            entry.function = inlined;
        }
    }
    for (handle, function) in inlined {
        functions[handle] = function;
    }
    simplify(module);
    private_variables_to_local(module);
}

impl<'a> Callee<'a> {
    fn new(function: &'a Function) -> Option<Self> {
        Some(Self {
            function,
            body: with_returns_at_ends(&function.body)?,
            stored_first: stored_first(function).ok()?,
        })
    }
}

/// [`Callee::stored_first`].
fn stored_first(function: &Function) -> Result<HashSet<Handle<LocalVariable>>, Unsupported> {
    let variable = |handle: Handle<Expression>| match function.expressions[handle] {
        Expression::LocalVariable(variable) => Some(variable),
        _ => None,
    };
    let mut stored = HashSet::new();
    let mut others = HashSet::new();
    for statement in &function.body {
        match statement {
            Statement::Store { pointer, value: _ } => {
                stored.extend(variable(*pointer).filter(|found| !others.contains(found)));
            }
            Statement::Emit(range) => {
                for handle in range.clone() {
                    with_operands(&function.expressions[handle], &mut |operand| {
                        others.extend(variable(operand));
                        Ok(operand)
                    })?;
                }
            }
            Statement::Return { .. } => {}
            // How other statements use variables is not looked into.
            _ => break,
        }
    }
    Ok(stored)
}
