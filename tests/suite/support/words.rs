//! Values as the GPU sees them: sequences of 32-bit words, and the WGSL that packs and unpacks them.

/// A Rust value that WGSL can unpack from input words.
pub trait Input {
    /// The WGSL expression of the value whose words start at `at`; advances `at`.
    fn load(at: &mut usize) -> String;
    /// Appends the words.
    fn write(&self, words: &mut Vec<u32>);
}

/// A Rust value that WGSL can pack into output words.
pub trait Output {
    /// The WGSL statements that write the value `from` to the words from `at` on; advances `at`.
    fn store(from: &str, at: &mut usize) -> String;
    /// Reads the words.
    fn read(words: &mut impl Iterator<Item = u32>) -> Self;
}

fn next(at: &mut usize) -> usize {
    *at += 1;
    *at - 1
}

fn take(words: &mut impl Iterator<Item = u32>) -> u32 {
    words.next().expect("as many words as were written")
}

macro_rules! scalar {
    ($type:ty, $load:literal, $store:literal, $to:expr, $from:expr) => {
        impl Input for $type {
            fn load(at: &mut usize) -> String {
                format!($load, next(at))
            }
            fn write(&self, words: &mut Vec<u32>) {
                words.push($to(*self));
            }
        }
        impl Output for $type {
            fn store(from: &str, at: &mut usize) -> String {
                format!($store, next(at), from)
            }
            fn read(words: &mut impl Iterator<Item = u32>) -> Self {
                $from(take(words))
            }
        }
    };
}

scalar!(
    f32,
    "real({}u)",
    "write({}u, bitcast<u32>({}));",
    f32::to_bits,
    f32::from_bits
);
scalar!(u32, "word({}u)", "write({}u, {});", |x| x, |x| x);
scalar!(
    bool,
    "(word({}u) != 0u)",
    "write({}u, u32({}));",
    u32::from,
    |x| x != 0
);

/// A WGSL vector.
impl<T: Input, const N: usize> Input for [T; N] {
    fn load(at: &mut usize) -> String {
        let parts: Vec<_> = (0..N).map(|_| T::load(at)).collect();
        format!("vec{N}({})", parts.join(", "))
    }
    fn write(&self, words: &mut Vec<u32>) {
        self.iter().for_each(|part| part.write(words));
    }
}

impl<T: Output, const N: usize> Output for [T; N] {
    fn store(from: &str, at: &mut usize) -> String {
        (0..N)
            .map(|i| T::store(&format!("{from}[{i}]"), at))
            .collect()
    }
    fn read(words: &mut impl Iterator<Item = u32>) -> Self {
        std::array::from_fn(|_| T::read(words))
    }
}

/// The arguments of a function.
macro_rules! arguments {
    ($($name:ident)*) => {
        impl<$($name: Input),*> Input for ($($name,)*) {
            fn load(at: &mut usize) -> String {
                [$($name::load(at)),*].join(", ")
            }
            #[allow(non_snake_case)]
            fn write(&self, words: &mut Vec<u32>) {
                let ($($name,)*) = self;
                $($name.write(words);)*
            }
        }
    };
}

arguments!(A B);
arguments!(A B C);
arguments!(A B C D);
arguments!(A B C D E);

/// A struct: `$wgsl` is its WGSL name, with members in order.
macro_rules! shader_struct {
    ($type:ty = $wgsl:literal { $($field:ident: $field_type:ty,)* }) => {
        impl $crate::support::words::Input for $type {
            fn load(at: &mut usize) -> String {
                let parts = [$(<$field_type as $crate::support::words::Input>::load(at)),*];
                format!("{}({})", $wgsl, parts.join(", "))
            }
            fn write(&self, words: &mut Vec<u32>) {
                $($crate::support::words::Input::write(&self.$field, words);)*
            }
        }
        impl $crate::support::words::Output for $type {
            fn store(from: &str, at: &mut usize) -> String {
                [$(<$field_type as $crate::support::words::Output>::store(
                    &format!("{from}.{}", stringify!($field)),
                    at,
                )),*]
                .concat()
            }
            fn read(words: &mut impl Iterator<Item = u32>) -> Self {
                Self { $($field: $crate::support::words::Output::read(words),)* }
            }
        }
    };
}
pub(crate) use shader_struct;
