//! Functions that return at their ends only, so that their statements can stand in others.

use crate::specialize::inner_blocks;
use naga::{Block, Span, Statement};

/// Whether a statement of a block, or one inside it, returns.
pub fn returns(block: &[Statement]) -> bool {
    block.iter().any(statement_returns)
}

fn statement_returns(statement: &Statement) -> bool {
    let inner = inner_blocks(statement);
    matches!(statement, Statement::Return { .. }) || inner.into_iter().any(|block| returns(block))
}

/// Whether every path through a block ends in a `return` of its last statement.
fn ends_with_returns(block: &[Statement]) -> bool {
    match block.last() {
        Some(Statement::Return { .. }) => true,
        Some(Statement::Block(inner)) => ends_with_returns(inner),
        Some(Statement::If { accept, reject, .. }) => {
            ends_with_returns(accept) && ends_with_returns(reject)
        }
        _ => false,
    }
}

/// The block with no statement after any `return`: what follows an `if` with a branch that returns moves into the other
/// branch. `None` if it returns inside a loop or a `switch`, or if a statement would have to move into two branches.
pub fn with_returns_at_ends(block: &[Statement]) -> Option<Block> {
    let Some(index) = block.iter().position(statement_returns) else {
        return Some(Block::from_vec(block.to_vec()));
    };
    let (before, after) = (&block[..index], &block[index + 1..]);
    let mut moved = Block::from_vec(before.to_vec());
    let with_rest = |inner: &Block| with_returns_at_ends(&[inner, after].concat());
    match &block[index] {
        statement @ Statement::Return { .. } => moved.push(statement.clone(), Span::UNDEFINED),
        Statement::Block(inner) => moved.extend_block(with_rest(inner)?),
        Statement::If {
            condition,
            accept,
            reject,
        } => {
            let ends = after.is_empty() || ends_with_returns(accept) || ends_with_returns(reject);
            let branch = |branch: &Block| match ends_with_returns(branch) {
                true => with_returns_at_ends(branch),
                false => with_rest(branch),
            };
            let branches = Statement::If {
                condition: *condition,
                accept: branch(accept)?,
                reject: branch(reject)?,
            };
            moved.push(ends.then_some(branches)?, Span::UNDEFINED);
        }
        _ => return None,
    }
    Some(moved)
}
