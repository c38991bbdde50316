//! Expressions with other operands.

use super::Unsupported;
use naga::{Expression, Handle, SampleLevel};

/// The expression with what `map` returns for each of its operands.
pub fn with_operands(
    expression: &Expression,
    map: &mut impl FnMut(Handle<Expression>) -> Result<Handle<Expression>, Unsupported>,
) -> Result<Expression, Unsupported> {
    use Expression as E;
    Ok(match *expression {
        E::Literal(_)
        | E::Constant(_)
        | E::Override(_)
        | E::ZeroValue(_)
        | E::FunctionArgument(_)
        | E::GlobalVariable(_)
        | E::LocalVariable(_)
        | E::CallResult(_)
        | E::AtomicResult { .. }
        | E::SubgroupOperationResult { .. } => expression.clone(),
        E::Compose { ty, ref components } => E::Compose {
            ty,
            components: components
                .iter()
                .map(|component| map(*component))
                .collect::<Result<_, _>>()?,
        },
        E::Access { base, index } => E::Access {
            base: map(base)?,
            index: map(index)?,
        },
        E::AccessIndex { base, index } => E::AccessIndex {
            base: map(base)?,
            index,
        },
        E::Splat { size, value } => E::Splat {
            size,
            value: map(value)?,
        },
        E::Swizzle {
            size,
            vector,
            pattern,
        } => E::Swizzle {
            size,
            vector: map(vector)?,
            pattern,
        },
        E::Load { pointer } => E::Load {
            pointer: map(pointer)?,
        },
        E::ImageSample {
            image,
            sampler,
            gather,
            coordinate,
            array_index,
            offset,
            level: level @ (SampleLevel::Auto | SampleLevel::Zero),
            depth_ref,
            clamp_to_edge,
        } => E::ImageSample {
            image: map(image)?,
            sampler: map(sampler)?,
            gather,
            coordinate: map(coordinate)?,
            array_index: array_index.map(&mut *map).transpose()?,
            offset: offset.map(&mut *map).transpose()?,
            level,
            depth_ref: depth_ref.map(&mut *map).transpose()?,
            clamp_to_edge,
        },
        E::ImageLoad {
            image,
            coordinate,
            array_index,
            sample,
            level,
        } => E::ImageLoad {
            image: map(image)?,
            coordinate: map(coordinate)?,
            array_index: array_index.map(&mut *map).transpose()?,
            sample: sample.map(&mut *map).transpose()?,
            level: level.map(&mut *map).transpose()?,
        },
        E::ImageQuery { image, query } => E::ImageQuery {
            image: map(image)?,
            query,
        },
        E::Unary { op, expr } => E::Unary {
            op,
            expr: map(expr)?,
        },
        E::Binary { op, left, right } => E::Binary {
            op,
            left: map(left)?,
            right: map(right)?,
        },
        E::Select {
            condition,
            accept,
            reject,
        } => E::Select {
            condition: map(condition)?,
            accept: map(accept)?,
            reject: map(reject)?,
        },
        E::Relational { fun, argument } => E::Relational {
            fun,
            argument: map(argument)?,
        },
        E::Math {
            fun,
            arg,
            arg1,
            arg2,
            arg3,
        } => E::Math {
            fun,
            arg: map(arg)?,
            arg1: arg1.map(&mut *map).transpose()?,
            arg2: arg2.map(&mut *map).transpose()?,
            arg3: arg3.map(&mut *map).transpose()?,
        },
        E::As {
            expr,
            kind,
            convert,
        } => E::As {
            expr: map(expr)?,
            kind,
            convert,
        },
        E::ArrayLength(array) => E::ArrayLength(map(array)?),
        _ => return Err(Unsupported),
    })
}
