//! Private variables.

use naga::{
    AddressSpace, Expression, Function, GlobalVariable, Handle, LocalVariable, Module, Span,
};

/// Makes private variables local to the entry point, where no other function uses them and they start as zeros.
pub fn private_variables_to_local(module: &mut Module) {
    let [entry] = &mut module.entry_points[..] else {
        return;
    };
    let function = &mut entry.function;
    for (global, variable) in module.global_variables.iter() {
        let is_private = variable.space == AddressSpace::Private && variable.init.is_none();
        let mut others = module.functions.iter().map(|(_, other)| other);
        if !is_private || others.any(|other| uses(other, global)) {
            continue;
        }
        let local = LocalVariable {
            name: variable.name.clone(),
            ty: variable.ty,
            init: None,
        };
        let local = function.local_variables.append(local, Span::UNDEFINED);
        for (_, expression) in function.expressions.iter_mut() {
            if is(expression, global) {
                *expression = Expression::LocalVariable(local);
            }
        }
    }
}

fn uses(function: &Function, global: Handle<GlobalVariable>) -> bool {
    function
        .expressions
        .iter()
        .any(|(_, expression)| is(expression, global))
}

fn is(expression: &Expression, global: Handle<GlobalVariable>) -> bool {
    matches!(expression, Expression::GlobalVariable(found) if *found == global)
}
