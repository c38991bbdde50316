//! Copies a function, with those that it calls in place of the calls.

use super::{Callee, Callees, Unsupported, operands::with_operands, returns::returns};
use crate::specialize::is_temporary;
use naga::{
    Arena, AtomicFunction, Block, Expression, Function, GatherMode, Handle, LocalVariable, Range,
    Span, Statement, SwitchCase,
};
use std::collections::{HashMap, HashSet};

/// The function with calls inlined, unless it has unsupported statements.
pub fn with_inlined_calls(function: &Function, callees: &Callees) -> Option<Function> {
    let mut copier = Copier {
        callees,
        expressions: Arena::new(),
        variables: Arena::new(),
    };
    let body = copier.block(&mut Source::new(function, None), &function.body);
    Some(Function {
        name: function.name.clone(),
        arguments: function.arguments.clone(),
        result: function.result.clone(),
        body: body.ok()?,
        local_variables: copier.variables,
        expressions: copier.expressions,
        named_expressions: Default::default(),
        diagnostic_filter_leaf: function.diagnostic_filter_leaf,
    })
}

/// Copies statements to a new function.
struct Copier<'a> {
    callees: &'a Callees<'a>,
    expressions: Arena<Expression>,
    variables: Arena<LocalVariable>,
}

/// A function whose statements are copied.
struct Source<'a> {
    function: &'a Function,
    /// The copies of its expressions so far.
    copies: Vec<Option<Handle<Expression>>>,
    variables: HashMap<Handle<LocalVariable>, Handle<LocalVariable>>,
    /// Where it is inlined, if it is not the function that is copied.
    call: Option<Call>,
    /// The number of loops around the current statement, in all functions.
    loops: usize,
}

struct Call {
    arguments: Vec<Handle<Expression>>,
    /// A pointer to the variable for the result, if the function returns at several places.
    result: Option<Handle<Expression>>,
}

impl<'a> Source<'a> {
    fn new(function: &'a Function, call: Option<Call>) -> Self {
        Self {
            function,
            copies: vec![None; function.expressions.len()],
            variables: HashMap::new(),
            call,
            loops: 0,
        }
    }
}

impl Copier<'_> {
    fn block(&mut self, source: &mut Source, block: &[Statement]) -> Result<Block, Unsupported> {
        let mut copy = Block::with_capacity(block.len());
        for statement in block {
            if let Statement::Call {
                function,
                arguments,
                result,
            } = statement
                && let Some(callee) = self.callees.get(function)
            {
                let arguments = self.all(source, arguments)?;
                let value = self.inlined(callee, arguments, source.loops, &mut copy)?;
                if let Some(result) = result {
                    source.copies[result.index()] = value;
                }
            } else if let Statement::Emit(range) = statement {
                self.emit(source, range, &mut copy)?;
            } else if let Some(statement) = self.statement(source, statement)? {
                copy.push(statement, Span::UNDEFINED);
            }
        }
        Ok(copy)
    }

    /// The copy of a statement, unless nothing is left to do.
    fn statement(
        &mut self,
        source: &mut Source,
        statement: &Statement,
    ) -> Result<Option<Statement>, Unsupported> {
        Ok(Some(match *statement {
            Statement::Block(ref inner) => Statement::Block(self.block(source, inner)?),
            Statement::If {
                condition,
                ref accept,
                ref reject,
            } => Statement::If {
                condition: self.operand(source, condition)?,
                accept: self.block(source, accept)?,
                reject: self.block(source, reject)?,
            },
            Statement::Switch {
                selector,
                ref cases,
            } => {
                let selector = self.operand(source, selector)?;
                let case = |case: &SwitchCase| {
                    Ok(SwitchCase {
                        value: case.value,
                        body: self.block(source, &case.body)?,
                        fall_through: case.fall_through,
                    })
                };
                let cases = cases.iter().map(case).collect::<Result<_, _>>()?;
                Statement::Switch { selector, cases }
            }
            Statement::Loop {
                ref body,
                ref continuing,
                break_if,
            } => {
                source.loops += 1;
                let body = self.block(source, body)?;
                let continuing = self.block(source, continuing)?;
                let break_if = self.optional(source, break_if)?;
                source.loops -= 1;
                Statement::Loop {
                    body,
                    continuing,
                    break_if,
                }
            }
            Statement::Return { value } => {
                let value = self.optional(source, value)?;
                let Some(call) = &source.call else {
                    return Ok(Some(Statement::Return { value }));
                };
                let stored = call.result.zip(value);
                return Ok(stored.map(|(pointer, value)| Statement::Store { pointer, value }));
            }
            Statement::Store { pointer, value } => Statement::Store {
                pointer: self.operand(source, pointer)?,
                value: self.operand(source, value)?,
            },
            Statement::ImageStore {
                image,
                coordinate,
                array_index,
                value,
            } => Statement::ImageStore {
                image: self.operand(source, image)?,
                coordinate: self.operand(source, coordinate)?,
                array_index: self.optional(source, array_index)?,
                value: self.operand(source, value)?,
            },
            Statement::Atomic {
                pointer,
                fun,
                value,
                result,
            } if !matches!(fun, AtomicFunction::Exchange { .. }) => Statement::Atomic {
                pointer: self.operand(source, pointer)?,
                fun,
                value: self.operand(source, value)?,
                result: self.optional(source, result)?,
            },
            Statement::Call {
                function,
                ref arguments,
                result,
            } => Statement::Call {
                function,
                arguments: self.all(source, arguments)?,
                result: self.optional(source, result)?,
            },
            Statement::SubgroupGather {
                mode: GatherMode::Shuffle(lane),
                argument,
                result,
            } => Statement::SubgroupGather {
                mode: GatherMode::Shuffle(self.operand(source, lane)?),
                argument: self.operand(source, argument)?,
                result: self.operand(source, result)?,
            },
            Statement::Break
            | Statement::Continue
            | Statement::ControlBarrier(_)
            | Statement::MemoryBarrier(_) => statement.clone(),
            _ => return Err(Unsupported),
        }))
    }

    /// Copies the body of a called function. Returns the value of its result.
    fn inlined(
        &mut self,
        callee: &Callee,
        arguments: Vec<Handle<Expression>>,
        loops: usize,
        copy: &mut Block,
    ) -> Result<Option<Handle<Expression>>, Unsupported> {
        let mut call = Call {
            arguments,
            result: None,
        };
        let Callee { function, body, .. } = callee;
        let end = match body.split_last() {
            Some((Statement::Return { value }, before)) if !returns(before) => {
                Some((*value, before))
            }
            _ => None,
        };
        if let (None, Some(result)) = (end, &function.result) {
            let variable = self.append_variable(None, result.ty, None);
            call.result = Some(self.append(Expression::LocalVariable(variable)));
        }
        let result = call.result;
        let mut source = Source::new(function, Some(call));
        source.loops = loops;
        if loops > 0 {
            self.initialize(&mut source, &callee.stored_first, copy)?;
        }
        if let Some((value, before)) = end {
            copy.extend_block(self.block(&mut source, before)?);
            return self.optional(&mut source, value);
        }
        copy.extend_block(self.block(&mut source, body)?);
        Ok(result.map(|pointer| {
            let load = self.append(Expression::Load { pointer });
            copy.push(emitted(load, load), Span::UNDEFINED);
            load
        }))
    }

    /// Stores the initial values of a function's variables, which would otherwise keep those of the iteration before.
    fn initialize(
        &mut self,
        source: &mut Source,
        stored_first: &HashSet<Handle<LocalVariable>>,
        copy: &mut Block,
    ) -> Result<(), Unsupported> {
        let function = source.function;
        for (handle, variable) in function.local_variables.iter() {
            if stored_first.contains(&handle) || is_temporary(variable) {
                continue;
            }
            let value = match variable.init {
                Some(init) => self.constant(source, init, Some(copy))?,
                None => self.append(Expression::ZeroValue(variable.ty)),
            };
            let variable = self.variable(source, handle)?;
            let pointer = self.append(Expression::LocalVariable(variable));
            copy.push(Statement::Store { pointer, value }, Span::UNDEFINED);
        }
        Ok(())
    }

    /// A copy of a constant expression: an initial value, or a value that `statements` evaluate.
    fn constant(
        &mut self,
        source: &mut Source,
        handle: Handle<Expression>,
        mut statements: Option<&mut Block>,
    ) -> Result<Handle<Expression>, Unsupported> {
        let expression = &source.function.expressions[handle];
        if expression.needs_pre_emit() {
            return self.operand(source, handle);
        }
        let copy = with_operands(expression, &mut |operand| {
            self.constant(source, operand, statements.as_deref_mut())
        })?;
        let copy = self.append(copy);
        if let Some(statements) = statements {
            statements.push(emitted(copy, copy), Span::UNDEFINED);
        }
        Ok(copy)
    }

    /// Emits the copies of a range.
    fn emit(
        &mut self,
        source: &mut Source,
        range: &Range<Expression>,
        copy: &mut Block,
    ) -> Result<(), Unsupported> {
        // Expressions in no range, such as literals, are copied between ranges.
        let mut run: Option<(Handle<Expression>, Handle<Expression>)> = None;
        for handle in range.clone() {
            let next = self.operand(source, handle)?;
            run = Some(match run {
                Some((first, last)) if last.index() + 1 == next.index() => (first, next),
                Some((first, last)) => {
                    copy.push(emitted(first, last), Span::UNDEFINED);
                    (next, next)
                }
                None => (next, next),
            });
        }
        if let Some((first, last)) = run {
            copy.push(emitted(first, last), Span::UNDEFINED);
        }
        Ok(())
    }

    fn all(
        &mut self,
        source: &mut Source,
        handles: &[Handle<Expression>],
    ) -> Result<Vec<Handle<Expression>>, Unsupported> {
        let copies = handles.iter().map(|handle| self.operand(source, *handle));
        copies.collect()
    }

    fn optional(
        &mut self,
        source: &mut Source,
        handle: Option<Handle<Expression>>,
    ) -> Result<Option<Handle<Expression>>, Unsupported> {
        handle
            .map(|handle| self.operand(source, handle))
            .transpose()
    }

    /// The copy of an expression.
    fn operand(
        &mut self,
        source: &mut Source,
        handle: Handle<Expression>,
    ) -> Result<Handle<Expression>, Unsupported> {
        if let Some(copy) = source.copies[handle.index()] {
            return Ok(copy);
        }
        let copy = match (&source.function.expressions[handle], &source.call) {
            (Expression::FunctionArgument(index), Some(call)) => call.arguments[*index as usize],
            (Expression::LocalVariable(variable), _) => {
                let variable = self.variable(source, *variable)?;
                self.append(Expression::LocalVariable(variable))
            }
            (other, _) => {
                let copy = with_operands(other, &mut |operand| self.operand(source, operand))?;
                self.append(copy)
            }
        };
        source.copies[handle.index()] = Some(copy);
        Ok(copy)
    }

    fn variable(
        &mut self,
        source: &mut Source,
        handle: Handle<LocalVariable>,
    ) -> Result<Handle<LocalVariable>, Unsupported> {
        if let Some(copy) = source.variables.get(&handle) {
            return Ok(*copy);
        }
        let LocalVariable { name, ty, init } = &source.function.local_variables[handle];
        let init = init.map(|init| self.constant(source, init, None));
        let init = init.transpose()?;
        let copy = self.append_variable(name.clone(), *ty, init);
        source.variables.insert(handle, copy);
        Ok(copy)
    }

    fn append(&mut self, expression: Expression) -> Handle<Expression> {
        self.expressions.append(expression, Span::UNDEFINED)
    }

    fn append_variable(
        &mut self,
        name: Option<String>,
        ty: Handle<naga::Type>,
        init: Option<Handle<Expression>>,
    ) -> Handle<LocalVariable> {
        let variable = LocalVariable { name, ty, init };
        self.variables.append(variable, Span::UNDEFINED)
    }
}

fn emitted(first: Handle<Expression>, last: Handle<Expression>) -> Statement {
    Statement::Emit(Range::new_from_bounds(first, last))
}
