//! A bound on each loop, for software adapters.
//!
//! Mesa 22.3 goes on computing a value that leaves a loop for lanes that have left it, as long as other lanes stay, unless
//! several exits of the loop make it choose between values (docs/src/internals/drivers.md, "Loops with one exit"). The bound is
//! a second exit in front of all else in the body: each value that leaves the loop is then chosen lane by lane. wgpu's own
//! bound has the same effect, but GLSL that naga writes has none.

use crate::specialize::inner_blocks_mut;
use naga::{
    BinaryOperator, Block, Expression, Function, Handle, Literal, LocalVariable, Module, Range,
    Scalar, Span, Statement, Type, TypeInner,
};

/// Gives each loop of a module a counter that ends it after 2^32 - 1 rounds: no driver lets a kernel run that long.
pub fn bound_loops(module: &mut Module) {
    let ty = module.types.insert(
        Type {
            name: None,
            inner: TypeInner::Scalar(Scalar::U32),
        },
        Span::UNDEFINED,
    );
    let entries = module
        .entry_points
        .iter_mut()
        .map(|entry| &mut entry.function);
    for function in module.functions.iter_mut().map(|(_, it)| it).chain(entries) {
        let body = std::mem::take(&mut function.body);
        function.body = bounded(body, ty, function);
    }
}

/// The block, with a counter for each loop in it.
fn bounded(block: Block, ty: Handle<Type>, function: &mut Function) -> Block {
    let mut result = Block::with_capacity(block.len());
    for (mut statement, span) in block.span_into_iter() {
        for inner in inner_blocks_mut(&mut statement) {
            *inner = bounded(std::mem::take(inner), ty, function);
        }
        if let Statement::Loop { body, .. } = &mut statement {
            let (start, mut counted) = counter(ty, function);
            result.push(start, span);
            counted.extend_block(std::mem::take(body));
            *body = counted;
        }
        result.push(statement, span);
    }
    result
}

/// The statement that starts a counter, and those that count a round and leave the loop at its bound.
fn counter(ty: Handle<Type>, function: &mut Function) -> (Statement, Block) {
    let variable = function.local_variables.append(
        LocalVariable {
            name: Some("rounds_left".into()),
            ty,
            init: None,
        },
        Span::UNDEFINED,
    );
    let expressions = &mut function.expressions;
    let mut add = |expression| expressions.append(expression, Span::UNDEFINED);
    let pointer = add(Expression::LocalVariable(variable));
    let [most, zero, one] =
        [u32::MAX, 0, 1].map(|number| add(Expression::Literal(Literal::U32(number))));
    let left = add(Expression::Load { pointer });
    let binary = |op, right| Expression::Binary { op, left, right };
    let is_over = add(binary(BinaryOperator::Equal, zero));
    let fewer = add(binary(BinaryOperator::Subtract, one));
    let evaluated = Range::new_from_bounds(left, fewer);
    let leave = Statement::If {
        condition: is_over,
        accept: Block::from_vec(vec![Statement::Break]),
        reject: Block::new(),
    };
    let start = Statement::Store {
        pointer,
        value: most,
    };
    let count = Statement::Store {
        pointer,
        value: fewer,
    };
    (
        start,
        Block::from_vec(vec![Statement::Emit(evaluated), leave, count]),
    )
}
