//! Loads and stores of a function's parameters and result, derived from its types.

use crate::{Error, Row, Scalar};
use wgpu::naga::{
    ArraySize, Function, Handle, Module, ScalarKind, Type, TypeInner, VectorSize, ir,
};

/// One scalar of a WGSL value.
struct Leaf {
    /// WGSL that reads it, such as `result.direction[1]`.
    path: String,
    scalar: Scalar,
    /// The index of the word in the row.
    word: usize,
}

/// A value in a row, taken apart.
struct Values<'a> {
    module: &'a Module,
    /// Types of the row's words.
    row: Vec<Scalar>,
    leaves: Vec<Leaf>,
}

/// WGSL around a function.
pub struct Signature {
    /// The arguments, from the array `shader_test_in` at `shader_test_from`.
    pub arguments: String,
    /// Writes `shader_test_result` to the array `shader_test_out` at `shader_test_to`.
    pub stores: String,
    /// Words of the arguments.
    pub inputs: usize,
    /// Words of the result.
    pub outputs: usize,
}

impl Signature {
    /// The signature of a function that is called `name` in messages, for rows `I` and `O`.
    ///
    /// # Errors
    /// The rows do not fit, or the function has types that rows cannot hold.
    pub fn new<I: Row, O: Row>(
        module: &Module,
        function: &Function,
        name: &str,
    ) -> Result<Self, Error> {
        let of_function = |problem: String| Error::Rows(format!("`{name}`: {problem}"));
        let mut inputs = Values::new::<I>(module);
        let mut at = 0;
        for argument in &function.arguments {
            let path = argument.name.clone().unwrap_or_default();
            at = inputs
                .add(argument.ty, path, at, false)
                .map_err(of_function)?;
        }
        inputs
            .check(at, "the parameters", "a row")
            .map_err(of_function)?;
        let mut words = inputs.leaves.iter().map(|leaf| leaf.word);
        let arguments = (function.arguments.iter())
            .map(|argument| load(module, argument.ty, &mut words))
            .collect::<Vec<_>>();

        let result = function.result.as_ref();
        let result = result.ok_or_else(|| of_function("there is no result".to_owned()))?;
        let mut outputs = Values::new::<O>(module);
        let path = "shader_test_result".to_owned();
        let end = outputs
            .add(result.ty, path, 0, false)
            .map_err(of_function)?;
        outputs
            .check(end, "the result", "the Rust type")
            .map_err(of_function)?;
        let stores = outputs.leaves.iter().map(|leaf| {
            let value = match leaf.scalar {
                Scalar::Bool => format!("u32({})", leaf.path),
                _ => format!("bitcast<u32>({})", leaf.path),
            };
            format!(
                "shader_test_out[shader_test_to + {}u] = {value};\n",
                leaf.word
            )
        });
        Ok(Self {
            arguments: arguments.join(", "),
            stores: stores.collect(),
            inputs: inputs.row.len(),
            outputs: outputs.row.len(),
        })
    }
}

impl<'a> Values<'a> {
    fn new<R: Row>(module: &'a Module) -> Self {
        let mut row = Vec::new();
        R::scalars(&mut row);
        Self {
            module,
            row,
            leaves: Vec::new(),
        }
    }

    /// Adds the scalars of a value that begins at a word; returns the word after it. In memory, values are padded as WGSL
    /// demands; in rows they are not.
    fn add(
        &mut self,
        ty: Handle<Type>,
        path: String,
        at: usize,
        in_memory: bool,
    ) -> Result<usize, String> {
        let in_memory = in_memory || self.row.get(at) == Some(&Scalar::Memory);
        match &self.module.types[ty].inner {
            TypeInner::Scalar(scalar) => self.leaf(*scalar, path, at),
            TypeInner::Vector { size, scalar } => (0..*size as usize)
                .try_fold(at, |at, i| self.leaf(*scalar, format!("{path}[{i}]"), at)),
            TypeInner::Matrix {
                columns,
                rows,
                scalar,
            } => {
                let stride = match (in_memory, *rows) {
                    (true, VectorSize::Tri) => 4,
                    (_, rows) => rows as usize,
                };
                for column in 0..*columns as usize {
                    for row in 0..*rows as usize {
                        let path = format!("{path}[{column}][{row}]");
                        self.leaf(*scalar, path, at + column * stride + row)?;
                    }
                }
                Ok(at + *columns as usize * stride)
            }
            TypeInner::Array {
                base,
                size: ArraySize::Constant(size),
                stride,
            } => (0..size.get()).try_fold(at, |at, i| {
                let end = self.add(*base, format!("{path}[{i}]"), at, in_memory)?;
                Ok(if in_memory {
                    at + *stride as usize / 4
                } else {
                    end
                })
            }),
            TypeInner::Struct { members, span } => {
                let mut end = at;
                for member in members {
                    let name = member.name.as_deref().unwrap_or_default();
                    let begin = if in_memory {
                        at + member.offset as usize / 4
                    } else {
                        end
                    };
                    end = self.add(member.ty, format!("{path}.{name}"), begin, in_memory)?;
                }
                Ok(if in_memory {
                    at + *span as usize / 4
                } else {
                    end
                })
            }
            _ => Err(format!(
                "rows cannot hold `{path}`; call it from a function with values"
            )),
        }
    }

    fn leaf(&mut self, scalar: ir::Scalar, path: String, word: usize) -> Result<usize, String> {
        let scalar = match (scalar.kind, scalar.width) {
            (ScalarKind::Float, 4) => Scalar::F32,
            (ScalarKind::Sint, 4) => Scalar::I32,
            (ScalarKind::Uint, 4) => Scalar::U32,
            (ScalarKind::Bool, _) => Scalar::Bool,
            _ => return Err(format!("`{path}` has no 32 bits")),
        };
        self.leaves.push(Leaf { path, scalar, word });
        Ok(word + 1)
    }

    /// Fails if the row has other words than the function: `subject` and `row` name both in messages.
    fn check(&self, words: usize, subject: &str, row: &str) -> Result<(), String> {
        for leaf in &self.leaves {
            let path = leaf.path.trim_start_matches("shader_test_");
            match self.row.get(leaf.word) {
                Some(&given) if given == Scalar::Memory || given == leaf.scalar => (),
                Some(given) => {
                    let (word, scalar) = (leaf.word, leaf.scalar);
                    return Err(format!(
                        "word {word} of {row} is {given:?}, but `{path}` is {scalar:?}"
                    ));
                }
                None => {
                    let given = self.row.len();
                    return Err(format!(
                        "{row} has {given} words; none is left for `{path}`"
                    ));
                }
            }
        }
        match self.row.len() == words {
            true => Ok(()),
            false => Err(format!(
                "{row} has {} words, {subject} {words}",
                self.row.len()
            )),
        }
    }
}

/// WGSL that puts a value together from the next words of the row.
fn load(module: &Module, ty: Handle<Type>, words: &mut impl Iterator<Item = usize>) -> String {
    let mut list = |scalar, count: usize| {
        let mut parts = Vec::new();
        parts.resize_with(count, || load_scalar(scalar, words));
        parts.join(", ")
    };
    let ty = &module.types[ty];
    match &ty.inner {
        TypeInner::Scalar(scalar) => list(*scalar, 1),
        TypeInner::Vector { size, scalar } => {
            let size = *size as usize;
            format!("vec{size}({})", list(*scalar, size))
        }
        TypeInner::Matrix {
            columns,
            rows,
            scalar,
        } => {
            let (columns, rows) = (*columns as usize, *rows as usize);
            format!("mat{columns}x{rows}({})", list(*scalar, columns * rows))
        }
        TypeInner::Array {
            base,
            size: ArraySize::Constant(size),
            ..
        } => {
            let parts: Vec<_> = (0..size.get())
                .map(|_| load(module, *base, words))
                .collect();
            format!("array({})", parts.join(", "))
        }
        TypeInner::Struct { members, .. } => {
            let parts = members.iter().map(|member| load(module, member.ty, words));
            let parts: Vec<_> = parts.collect();
            let name = ty.name.as_deref().unwrap_or_default();
            format!("{name}({})", parts.join(", "))
        }
        // `Values::add` has refused it.
        _ => String::new(),
    }
}

/// WGSL of the next word.
fn load_scalar(scalar: ir::Scalar, words: &mut impl Iterator<Item = usize>) -> String {
    let word = words.next().unwrap_or_default();
    let word = format!("shader_test_in[shader_test_from + {word}u]");
    match scalar.kind {
        ScalarKind::Float => format!("bitcast<f32>({word})"),
        ScalarKind::Sint => format!("bitcast<i32>({word})"),
        ScalarKind::Bool => format!("({word} != 0u)"),
        _ => word,
    }
}
