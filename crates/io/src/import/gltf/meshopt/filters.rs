//! The filters of compressed attributes: from what compresses well to what an accessor means.

use super::Fault;

/// How attributes were changed before they were compressed.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(in crate::import::gltf) enum Filter {
    None,
    /// Unit vectors as points of an octahedron.
    Octahedral,
    /// Unit quaternions without their largest component.
    Quaternion,
    /// Floats as 24 bits of mantissa and 8 of exponent.
    Exponential,
    /// Colours as luma and two differences.
    Color,
}

/// Undoes the filter of elements of `stride` bytes.
///
/// # Errors
/// The filter has no elements of this size.
pub(super) fn apply(filter: Filter, stride: usize, bytes: &mut [u8]) -> Result<(), Fault> {
    match (filter, stride) {
        (Filter::None, _) => {}
        (Filter::Octahedral, 4) => each(bytes, |it: [i8; 4]| octahedral(it.map(f32::from), 127.0)),
        (Filter::Octahedral, 8) => {
            each(bytes, |it: [i16; 4]| octahedral(it.map(f32::from), 32767.0));
        }
        (Filter::Quaternion, 8) => each(bytes, quaternion),
        (Filter::Exponential, _) => {
            for word in bytes.as_chunks_mut().0 {
                *word = exponential(i32::from_le_bytes(*word)).to_le_bytes();
            }
        }
        (Filter::Color, 4) => each(bytes, |[y, u, v, a]: [i8; 4]| {
            let [y, a] = [y, a].map(|x| i32::from(x.cast_unsigned()));
            color([y, u.into(), v.into(), a], 255.0).map(|x| (x as u8).cast_signed())
        }),
        (Filter::Color, 8) => each(bytes, |[y, u, v, a]: [i16; 4]| {
            let [y, a] = [y, a].map(|x| i32::from(x.cast_unsigned()));
            color([y, u.into(), v.into(), a], 65535.0).map(|x| (x as u16).cast_signed())
        }),
        _ => return Err("the filter does not suit the size of the elements"),
    }
    Ok(())
}

/// An integer in a buffer.
trait Stored: Copy + Default {
    fn from_bytes(bytes: &[u8]) -> Self;
    fn write(self, bytes: &mut [u8]);
}

impl Stored for i8 {
    fn from_bytes(bytes: &[u8]) -> Self {
        bytes[0].cast_signed()
    }

    fn write(self, bytes: &mut [u8]) {
        bytes[0] = self.cast_unsigned();
    }
}

impl Stored for i16 {
    fn from_bytes(bytes: &[u8]) -> Self {
        Self::from_le_bytes([bytes[0], bytes[1]])
    }

    fn write(self, bytes: &mut [u8]) {
        bytes.copy_from_slice(&self.to_le_bytes());
    }
}

/// Replaces each four integers of `bytes`.
fn each<T: Stored>(bytes: &mut [u8], change: impl Fn([T; 4]) -> [T; 4]) {
    let size = size_of::<T>();
    for element in bytes.chunks_exact_mut(4 * size) {
        let mut values = [T::default(); 4];
        for (value, bytes) in values.iter_mut().zip(element.chunks_exact(size)) {
            *value = T::from_bytes(bytes);
        }
        for (value, bytes) in change(values)
            .into_iter()
            .zip(element.chunks_exact_mut(size))
        {
            value.write(bytes);
        }
    }
}

/// x and y of a point of the octahedron, 1 in their unit, and a value that is kept; `largest` is 1 in the result.
fn octahedral<T: FromFloat>([x, y, one, kept]: [f32; 4], largest: f32) -> [T; 4] {
    let (x, y) = (x / one, y / one);
    let z = 1.0 - x.abs() - y.abs();
    let under = (-z).max(0.0);
    let (x, y) = (x - under.copysign(x), y - under.copysign(y));
    let scale = largest / (x * x + y * y + z * z).sqrt();
    [x * scale, y * scale, z * scale, kept].map(T::rounded)
}

trait FromFloat {
    /// The nearest value; 0 for NaN.
    fn rounded(value: f32) -> Self;
}

impl FromFloat for i8 {
    fn rounded(value: f32) -> Self {
        value.round() as Self
    }
}

impl FromFloat for i16 {
    fn rounded(value: f32) -> Self {
        value.round() as Self
    }
}

/// Three components after the largest, and 1/√2 in their unit with the place of the largest in its lowest bits.
fn quaternion([x, y, z, code]: [i16; 4]) -> [i16; 4] {
    let scale = std::f32::consts::FRAC_1_SQRT_2 / f32::from(code | 3);
    let [x, y, z] = [x, y, z].map(|value| f32::from(value) * scale);
    let w = (1.0 - x * x - y * y - z * z).max(0.0).sqrt();
    let largest = usize::from(code.cast_unsigned() & 3);
    let mut all = [0; 4];
    for (i, value) in [w, x, y, z].into_iter().enumerate() {
        all[(largest + i) % 4] = i16::rounded(value * 32767.0);
    }
    all
}

fn exponential(code: i32) -> f32 {
    let (exponent, mantissa) = (code >> 24, code << 8 >> 8);
    (f64::from(mantissa) * 2.0_f64.powi(exponent)) as f32
}

/// Luma, orange and green differences, and alpha below a bit that tells the precision; `largest` is 1 in the result.
fn color([y, orange, green, alpha]: [i32; 4], largest: f32) -> [f32; 4] {
    let bits = 32 - alpha.leading_zeros();
    let unit = (1_i32 << bits) - 1;
    let alpha = alpha & unit >> 1;
    let alpha = alpha << 1 | alpha & 1;
    let rgba = [y + orange - green, y + green, y - orange - green, alpha];
    rgba.map(|value| (value as f32 * largest / unit.max(1) as f32).round())
}
