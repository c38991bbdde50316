//! Rust values as 32-bit words.

use bytemuck::{AnyBitPattern, NoUninit};

/// The type of a word in a row.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Scalar {
    /// `f32`.
    F32,
    /// `i32`.
    I32,
    /// `u32`.
    U32,
    /// `bool`: 0 or 1.
    Bool,
    /// Memory of any type: a part of a [`Plain`] value.
    Memory,
}

/// Arguments or a result of a shader function.
///
/// | Rust | WGSL |
/// |---|---|
/// | `f32`, `i32`, `u32`, `bool` | the same |
/// | `[f32; 3]` | `vec3<f32>`, or an array |
/// | `[[f32; 3]; 4]` | `mat4x3<f32>`: a list of columns; or an array of vectors |
/// | a tuple | parameters, or a struct |
/// | a struct of [`shader_struct!`](crate::shader_struct) | the struct |
/// | a [`Plain`] struct | the struct as it lies in a buffer |
///
/// Only the order of the scalars counts, so that tuples may be nested as is handy.
pub trait Row: Sized {
    /// Appends the type of each word, in the order of [`Self::write`].
    fn scalars(list: &mut Vec<Scalar>);
    /// Appends the words.
    fn write(&self, words: &mut Vec<u32>);
    /// Takes the words of one value from the front.
    fn read(words: &mut &[u32]) -> Self;
}

/// Takes the first of the words, which [`Row::scalars`] has counted.
fn take(words: &mut &[u32]) -> u32 {
    *words.split_off_first().unwrap_or(&0)
}

macro_rules! scalar {
    ($type:ty, $scalar:ident, $to:expr, $from:expr) => {
        impl Row for $type {
            fn scalars(list: &mut Vec<Scalar>) {
                list.push(Scalar::$scalar);
            }
            fn write(&self, words: &mut Vec<u32>) {
                words.push($to(*self));
            }
            fn read(words: &mut &[u32]) -> Self {
                $from(take(words))
            }
        }
    };
}

scalar!(f32, F32, f32::to_bits, f32::from_bits);
scalar!(i32, I32, i32::cast_unsigned, u32::cast_signed);
scalar!(u32, U32, |x| x, |x| x);
scalar!(bool, Bool, u32::from, |x| x != 0);

impl<T: Row, const N: usize> Row for [T; N] {
    fn scalars(list: &mut Vec<Scalar>) {
        (0..N).for_each(|_| T::scalars(list));
    }
    fn write(&self, words: &mut Vec<u32>) {
        self.iter().for_each(|part| part.write(words));
    }
    fn read(words: &mut &[u32]) -> Self {
        std::array::from_fn(|_| T::read(words))
    }
}

/// No parameters.
impl Row for () {
    fn scalars(_: &mut Vec<Scalar>) {}
    fn write(&self, _: &mut Vec<u32>) {}
    fn read(_: &mut &[u32]) -> Self {}
}

macro_rules! tuple {
    ($($name:ident)*) => {
        impl<$($name: Row),*> Row for ($($name,)*) {
            fn scalars(list: &mut Vec<Scalar>) {
                $($name::scalars(list);)*
            }
            #[expect(non_snake_case, reason = "types name the variables")]
            fn write(&self, words: &mut Vec<u32>) {
                let ($($name,)*) = self;
                $($name.write(words);)*
            }
            fn read(words: &mut &[u32]) -> Self {
                ($($name::read(words),)*)
            }
        }
    };
}

tuple!(A);
tuple!(A B);
tuple!(A B C);
tuple!(A B C D);
tuple!(A B C D E);
tuple!(A B C D E F);
tuple!(A B C D E F G);
tuple!(A B C D E F G H);

/// A struct in the layout of WGSL buffers, padding included: the structs that programs upload.
///
/// The struct has `#[repr(C)]`, bytemuck's `Pod`, and the size of the WGSL struct.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Plain<T>(pub T);

impl<T> std::ops::Deref for Plain<T> {
    type Target = T;
    fn deref(&self) -> &T {
        &self.0
    }
}

impl<T: NoUninit + AnyBitPattern> Row for Plain<T> {
    fn scalars(list: &mut Vec<Scalar>) {
        const { assert!(size_of::<T>().is_multiple_of(4), "a struct of 32-bit words") };
        list.extend((0..size_of::<T>() / 4).map(|_| Scalar::Memory));
    }
    fn write(&self, words: &mut Vec<u32>) {
        words.extend(bytemuck::pod_collect_to_vec::<T, u32>(&[self.0]));
    }
    fn read(words: &mut &[u32]) -> Self {
        let own = words.split_off(..size_of::<T>() / 4).unwrap_or_default();
        Self(bytemuck::pod_read_unaligned(bytemuck::cast_slice(own)))
    }
}

/// Defines a struct that stands for a WGSL struct with the same members in the same order.
///
/// Padding has no members, and `bool` is allowed, which buffers cannot hold.
///
/// ```
/// glimray_shader_test::shader_struct! {
///     /// Where a ray hits.
///     #[derive(Clone, Copy, Debug, PartialEq)]
///     pub struct Hit {
///         /// Whether it does.
///         pub found: bool,
///         /// The distance.
///         pub t: f32,
///     }
/// }
/// ```
#[macro_export]
macro_rules! shader_struct {
    ($(#[$attribute:meta])* $visibility:vis struct $name:ident {
        $($(#[$note:meta])* $field_visibility:vis $field:ident: $type:ty,)*
    }) => {
        $(#[$attribute])*
        $visibility struct $name {
            $($(#[$note])* $field_visibility $field: $type,)*
        }
        impl $crate::Row for $name {
            fn scalars(list: &mut Vec<$crate::Scalar>) {
                $(<$type as $crate::Row>::scalars(list);)*
            }
            fn write(&self, words: &mut Vec<u32>) {
                $($crate::Row::write(&self.$field, words);)*
            }
            fn read(words: &mut &[u32]) -> Self {
                Self { $($field: $crate::Row::read(words),)* }
            }
        }
    };
}
