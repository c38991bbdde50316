//! Private variables.

use naga::{AddressSpace, Expression, LocalVariable, Module, Span};
use std::collections::HashMap;

/// Makes private variables that start as zeros local to the entry point, if there is no other function.
pub fn private_variables_to_local(module: &mut Module) {
    let [entry] = &mut module.entry_points[..] else {
        return;
    };
    if !module.functions.is_empty() {
        return;
    }
    let function = &mut entry.function;
    let mut locals = HashMap::new();
    for (global, variable) in module.global_variables.iter() {
        if variable.space == AddressSpace::Private && variable.init.is_none() {
            let local = LocalVariable {
                name: variable.name.clone(),
                ty: variable.ty,
                init: None,
            };
            let local = function.local_variables.append(local, Span::UNDEFINED);
            locals.insert(global, local);
        }
    }
    for (_, expression) in function.expressions.iter_mut() {
        if let Expression::GlobalVariable(global) = expression
            && let Some(local) = locals.get(global)
        {
            *expression = Expression::LocalVariable(*local);
        }
    }
}
