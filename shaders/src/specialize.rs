//! Specialises kernels before the driver sees them: overrides become constants, branches on constants are
//! folded, and unreachable code and calls of functions that do nothing are removed. A driver would parse, inline and simplify a whole module before
//! removing the code that overrides disable, and no disk cache saves that time. Loops end where lavapipe can leave
//! them at once.

use crate::files;
use naga::{
    Arena, BinaryOperator, Block, Expression, Handle, Literal, LocalVariable, Module, Statement,
    UnaryOperator,
    compact::{KeepUnused, compact},
};
use std::{
    collections::{HashMap, HashSet},
    sync::OnceLock,
};

/// Declares the overrides as `override NAME: TYPE = DEFAULT;`. Linked kernels lack those that they do not use.
const BINDINGS: &str = "bindings.wesl";

/// The prefix that the linker adds to the names of `bindings.wesl`.
const PREFIX: &str = "bindings__";

/// The module of a linked kernel with values for its overrides, by name. Other overrides keep their defaults.
///
/// # Errors
/// An override does not exist, or naga rejects the source; its message shows the lines.
pub fn specialize(source: &str, overrides: &[(&str, f64)]) -> Result<Module, String> {
    let declared = declared()?;
    if let Some((name, _)) = (overrides.iter()).find(|(name, _)| !declared.contains(*name)) {
        return Err(format!("there is no override {name}"));
    }
    let source = with_constants(source, overrides);
    let mut module =
        naga::front::wgsl::parse_str(&source).map_err(|error| error.emit_to_string(&source))?;
    simplify(&mut module);
    Ok(module)
}

/// The names of all overrides.
fn declared() -> Result<&'static HashSet<String>, String> {
    static NAMES: OnceLock<HashSet<String>> = OnceLock::new();
    if let Some(names) = NAMES.get() {
        return Ok(names);
    }
    let text = files::read(BINDINGS)?;
    let declarations = text.lines().filter_map(Override::parse);
    let names = declarations.map(|declared| declared.name.to_owned());
    Ok(NAMES.get_or_init(|| names.collect()))
}

/// Folds branches on constants, and removes what is not used.
pub(crate) fn simplify(module: &mut Module) {
    for (_, function) in module.functions.iter_mut() {
        fold_function(function, &module.constants, &module.global_expressions);
    }
    for entry in &mut module.entry_points {
        fold_function(
            &mut entry.function,
            &module.constants,
            &module.global_expressions,
        );
    }
    remove_idle_calls(module);
    compact(module, KeepUnused::No);
}

/// Removes calls of functions that do nothing, such as those that record rays in kernels without records.
fn remove_idle_calls(module: &mut Module) {
    let is_idle = |function: &naga::Function| {
        let ends = |statement: &Statement| matches!(statement, Statement::Return { value: None });
        function.result.is_none() && function.body.iter().all(ends)
    };
    let idle = (module.functions.iter()).filter(|(_, function)| is_idle(function));
    let idle: HashSet<_> = idle.map(|(handle, _)| handle).collect();
    let functions = module.functions.iter_mut().map(|(_, function)| function);
    let entries = module
        .entry_points
        .iter_mut()
        .map(|entry| &mut entry.function);
    for function in functions.chain(entries) {
        without_calls(&mut function.body, &idle);
    }
}

/// Removes the calls of these functions from a block and its nested blocks.
fn without_calls(block: &mut Block, functions: &HashSet<Handle<naga::Function>>) {
    let mut kept = Block::with_capacity(block.len());
    for (mut statement, span) in std::mem::take(block).span_into_iter() {
        if matches!(&statement, Statement::Call { function, .. } if functions.contains(function)) {
            continue;
        }
        for inner in inner_blocks_mut(&mut statement) {
            without_calls(inner, functions);
        }
        kept.push(statement, span);
    }
    *block = kept;
}

/// The source with each `override NAME: TYPE = DEFAULT;` replaced by a `const`. The front end folds constant
/// expressions.
fn with_constants(source: &str, overrides: &[(&str, f64)]) -> String {
    let line = |line: &str| {
        let Some(Override { name, ty, default }) = Override::parse(line) else {
            return line.to_owned() + "\n";
        };
        let plain = name.strip_prefix(PREFIX).unwrap_or(name);
        let chosen = overrides.iter().find(|(known, _)| *known == plain);
        let value = chosen.map_or_else(|| default.into(), |&(_, value)| literal(ty, value));
        format!("const {name}: {ty} = {value};\n")
    };
    source.lines().map(line).collect()
}

/// A declaration as the linker prints it, on a line of its own.
struct Override<'a> {
    name: &'a str,
    ty: &'a str,
    default: &'a str,
}

impl<'a> Override<'a> {
    fn parse(line: &'a str) -> Option<Self> {
        let declaration = line.strip_prefix("override ")?.strip_suffix(';')?;
        let (name, value) = declaration.split_once(": ")?;
        let (ty, default) = value.split_once(" = ")?;
        Some(Self { name, ty, default })
    }
}

/// A value as a WGSL literal.
fn literal(ty: &str, value: f64) -> String {
    match ty {
        "bool" => (value != 0.0).to_string(),
        "f32" => format!("{:?}f", value as f32),
        _ => format!("{value}"),
    }
}

fn fold_function(
    function: &mut naga::Function,
    constants: &Arena<naga::Constant>,
    globals: &Arena<Expression>,
) {
    let mut body = std::mem::take(&mut function.body);
    let mut fold = Fold {
        function,
        constants,
        globals,
        temporaries: HashMap::new(),
    };
    // Each iteration may reveal another temporary with a constant value.
    loop {
        body = fold.block(body);
        let found = fold.constant_temporaries(&body);
        if found == fold.temporaries {
            break;
        }
        fold.temporaries = found;
    }
    function.body = body;
    // `compact` keeps named expressions, but cannot keep those that are no longer evaluated.
    function.named_expressions.clear();
}

/// Constant folding of a function.
struct Fold<'a> {
    function: &'a naga::Function,
    constants: &'a Arena<naga::Constant>,
    globals: &'a Arena<Expression>,
    /// Temporaries that always have the same value when read.
    temporaries: HashMap<Handle<LocalVariable>, bool>,
}

impl Fold<'_> {
    /// The block, with each `if` on a constant replaced by the taken branch, each loop that always ends after its
    /// first iteration replaced by its body, and without statements after one that ends the block.
    fn block(&self, block: Block) -> Block {
        let mut folded = Block::with_capacity(block.len());
        for (mut statement, span) in block.span_into_iter() {
            match &mut statement {
                Statement::If {
                    condition,
                    accept,
                    reject,
                } => {
                    let accept = self.block(std::mem::take(accept));
                    let reject = self.block(std::mem::take(reject));
                    match self.constant(*condition) {
                        Some(true) => folded.extend_block(accept),
                        Some(false) => folded.extend_block(reject),
                        None => {
                            let condition = *condition;
                            let kept = Statement::If {
                                condition,
                                accept,
                                reject,
                            };
                            folded.push(kept, span);
                        }
                    }
                }
                Statement::Block(inner) => {
                    *inner = self.block(std::mem::take(inner));
                    folded.push(statement, span);
                }
                Statement::Loop {
                    body,
                    continuing,
                    break_if,
                } => {
                    let mut body = self.block(std::mem::take(body));
                    let continuing = self.block(std::mem::take(continuing));
                    let break_if = *break_if;
                    let ends = break_if.and_then(|condition| self.constant(condition));
                    if ends == Some(true) && !jumps(&body) {
                        folded.extend_block(body);
                        folded.extend_block(continuing);
                    } else if let Some(once) = before_last_break(&body) {
                        body.cull(once..);
                        folded.extend_block(body);
                    } else {
                        folded.push(with_continuing_in_body(body, continuing, break_if), span);
                    }
                }
                Statement::Switch { cases, .. } => {
                    for case in cases {
                        case.body = self.block(std::mem::take(&mut case.body));
                    }
                    folded.push(statement, span);
                }
                _ => folded.push(statement, span),
            }
            if folded.last().is_some_and(ends_block) {
                break;
            }
        }
        folded
    }

    /// The temporaries to which the block stores one constant and nothing else.
    fn constant_temporaries(&self, block: &Block) -> HashMap<Handle<LocalVariable>, bool> {
        let mut found = Vec::new();
        stores(block, &mut found);
        let mut values = HashMap::<_, Option<bool>>::new();
        for (pointer, value) in found {
            if let Some(temporary) = self.temporary(pointer) {
                let value = self.constant(value);
                let known = values.entry(temporary).or_insert(value);
                *known = known.filter(|known| Some(*known) == value);
            }
        }
        let constant = |(temporary, value): (_, Option<bool>)| Some((temporary, value?));
        values.into_iter().filter_map(constant).collect()
    }

    /// The variable that a pointer points to, if it is a temporary.
    fn temporary(&self, pointer: Handle<Expression>) -> Option<Handle<LocalVariable>> {
        match self.function.expressions[pointer] {
            Expression::LocalVariable(variable) => {
                is_temporary(&self.function.local_variables[variable]).then_some(variable)
            }
            _ => None,
        }
    }

    /// The value of a constant condition.
    fn constant(&self, expression: Handle<Expression>) -> Option<bool> {
        let literal = match self.function.expressions[expression] {
            Expression::Load { pointer } => {
                return self.temporaries.get(&self.temporary(pointer)?).copied();
            }
            Expression::Unary {
                op: UnaryOperator::LogicalNot,
                expr,
            } => return self.constant(expr).map(|value| !value),
            Expression::Binary {
                op: BinaryOperator::InclusiveOr,
                left,
                right,
            } => {
                let sides = [left, right].map(|side| self.constant(side));
                return sides.contains(&Some(true)).then_some(true);
            }
            Expression::Constant(constant) => &self.globals[self.constants[constant].init],
            ref other => other,
        };
        match *literal {
            Expression::Literal(Literal::Bool(value)) => Some(value),
            _ => None,
        }
    }
}

/// Whether a variable is a temporary, which is stored before it is read: the result of `&&` or `||`, or of an inlined function.
pub fn is_temporary(variable: &LocalVariable) -> bool {
    variable.name.is_none() && variable.init.is_none()
}

/// All stores in a block and its nested blocks: (pointer, value).
fn stores(block: &Block, found: &mut Vec<(Handle<Expression>, Handle<Expression>)>) {
    for statement in block {
        if let Statement::Store { pointer, value } = statement {
            found.push((*pointer, *value));
        }
        for inner in inner_blocks(statement) {
            stores(inner, found);
        }
    }
}

/// The blocks of a statement.
pub fn inner_blocks(statement: &Statement) -> Vec<&Block> {
    match statement {
        Statement::Block(inner) => vec![inner],
        Statement::If { accept, reject, .. } => vec![accept, reject],
        Statement::Switch { cases, .. } => cases.iter().map(|case| &case.body).collect(),
        Statement::Loop {
            body, continuing, ..
        } => vec![body, continuing],
        _ => Vec::new(),
    }
}

/// As [`inner_blocks`], to be changed.
pub fn inner_blocks_mut(statement: &mut Statement) -> Vec<&mut Block> {
    match statement {
        Statement::Block(inner) => vec![inner],
        Statement::If { accept, reject, .. } => vec![accept, reject],
        Statement::Switch { cases, .. } => cases.iter_mut().map(|case| &mut case.body).collect(),
        Statement::Loop {
            body, continuing, ..
        } => vec![body, continuing],
        _ => Vec::new(),
    }
}

/// A loop whose body holds its `continuing` block and its `break if`, unless it has a `continue`. Mesa runs a
/// `continuing` block before the body of the next iteration, behind a flag; lavapipe, which skips no branch, then
/// executes the whole body once more with all lanes masked before the loop ends.
fn with_continuing_in_body(
    mut body: Block,
    continuing: Block,
    break_if: Option<Handle<Expression>>,
) -> Statement {
    if continues(&body) {
        return Statement::Loop {
            body,
            continuing,
            break_if,
        };
    }
    // Behind the end of a block nothing may follow, and nothing would be reached.
    if !body.last().is_some_and(ends_block) {
        body.extend_block(continuing);
        if let Some(condition) = break_if {
            let leave = Statement::If {
                condition,
                accept: Block::from_vec(vec![Statement::Break]),
                reject: Block::new(),
            };
            body.push(leave, naga::Span::UNDEFINED);
        }
    }
    Statement::Loop {
        body,
        continuing: Block::new(),
        break_if: None,
    }
}

/// Whether a block of a loop has a `continue` of that loop.
fn continues(block: &[Statement]) -> bool {
    any_of_loop(block, &|statement| matches!(statement, Statement::Continue))
}

/// Whether a block of a loop leaves it, or its iteration, by a statement. `break` in a switch ends the switch, but
/// `continue` belongs to the loop.
fn jumps(block: &[Statement]) -> bool {
    use Statement::{Break, Continue, Switch};
    any_of_loop(block, &|statement| {
        matches!(statement, Break | Continue | Switch { .. })
    })
}

/// The number of statements of the body of a loop before a `break` that ends it, if the loop is left by no other.
fn before_last_break(body: &Block) -> Option<usize> {
    let (last, others) = body.split_last()?;
    (matches!(last, Statement::Break) && !jumps(others)).then_some(others.len())
}

/// Whether any statement of a block of a loop is such, without those of inner loops.
fn any_of_loop(block: &[Statement], is_such: &impl Fn(&Statement) -> bool) -> bool {
    let is_inner = |block: &Block| any_of_loop(block, is_such);
    block.iter().any(|statement| {
        let is_loop = matches!(statement, Statement::Loop { .. });
        is_such(statement) || (!is_loop && inner_blocks(statement).into_iter().any(is_inner))
    })
}

/// Whether the statements after this one in its block are unreachable.
fn ends_block(statement: &Statement) -> bool {
    matches!(
        statement,
        Statement::Return { .. } | Statement::Break | Statement::Continue | Statement::Kill
    )
}
