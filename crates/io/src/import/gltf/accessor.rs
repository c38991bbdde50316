//! Accessors: typed arrays in buffers (section 3.6.2 of the specification). Every range is checked before
//! anything is allocated. Integers are converted as `KHR_mesh_quantization` says, normalised or not.

use super::blame::Ledger;
use super::buffers::Buffers;
use super::document::{Accessor, Document, Kind};
use crate::import::budget;
use crate::import::error::ImportError;
use glimray_scene::threads;

/// Reads the accessors of a document.
pub(super) struct Accessors<'a> {
    pub document: &'a Document,
    pub buffers: &'a Buffers,
    pub ledger: &'a Ledger<'a>,
}

/// The type of the numbers in an accessor.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(super) enum Component {
    I8,
    U8,
    I16,
    U16,
    U32,
    F32,
}

impl Component {
    /// The type of this `componentType`.
    pub fn of(code: u32) -> Option<Self> {
        Some(match code {
            5120 => Self::I8,
            5121 => Self::U8,
            5122 => Self::I16,
            5123 => Self::U16,
            5125 => Self::U32,
            5126 => Self::F32,
            _ => return None,
        })
    }

    /// Bytes of a number.
    pub fn size(self) -> usize {
        match self {
            Self::I8 | Self::U8 => 1,
            Self::I16 | Self::U16 => 2,
            Self::U32 | Self::F32 => 4,
        }
    }

    /// The number at the start of `bytes`, which are long enough; normalised to [0, 1] or [−1, 1] if
    /// asked for.
    fn float(self, bytes: &[u8], normalized: bool) -> f32 {
        let value = match self {
            Self::I8 => f32::from(bytes[0].cast_signed()),
            Self::U8 => f32::from(bytes[0]),
            Self::I16 => f32::from(i16::from_le_bytes([bytes[0], bytes[1]])),
            Self::U16 => f32::from(u16::from_le_bytes([bytes[0], bytes[1]])),
            Self::U32 => u32::from_le_bytes([bytes[0], bytes[1], bytes[2], bytes[3]]) as f32,
            Self::F32 => f32::from_le_bytes([bytes[0], bytes[1], bytes[2], bytes[3]]),
        };
        let largest = match self {
            Self::I8 => 127.0,
            Self::U8 => 255.0,
            Self::I16 => 32767.0,
            Self::U16 => 65535.0,
            Self::U32 | Self::F32 => return value,
        };
        match normalized {
            true => (value / largest).max(-1.0),
            false => value,
        }
    }

    /// Appends the nearest number to `value` to `bytes`; integers that are too large are the largest.
    #[cfg(feature = "draco")]
    pub fn write(self, value: f32, bytes: &mut Vec<u8>) {
        match self {
            Self::I8 => bytes.extend((value.round() as i8).to_le_bytes()),
            Self::U8 => bytes.extend((value.round() as u8).to_le_bytes()),
            Self::I16 => bytes.extend((value.round() as i16).to_le_bytes()),
            Self::U16 => bytes.extend((value.round() as u16).to_le_bytes()),
            Self::U32 => bytes.extend((value.round() as u32).to_le_bytes()),
            Self::F32 => bytes.extend(value.to_le_bytes()),
        }
    }

    /// The whole number at the start of `bytes`; `None` if the type is signed or floating.
    fn index(self, bytes: &[u8]) -> Option<u32> {
        match self {
            Self::U8 => Some(u32::from(bytes[0])),
            Self::U16 => Some(u32::from(u16::from_le_bytes([bytes[0], bytes[1]]))),
            Self::U32 => Some(u32::from_le_bytes([bytes[0], bytes[1], bytes[2], bytes[3]])),
            Self::I8 | Self::I16 | Self::F32 => None,
        }
    }
}

impl Kind {
    /// Name of the element type in the file.
    fn name(self) -> &'static str {
        match self {
            Self::Scalar => "SCALAR",
            Self::Vec2 => "VEC2",
            Self::Vec3 => "VEC3",
            Self::Vec4 => "VEC4",
            Self::Mat2 => "MAT2",
            Self::Mat3 => "MAT3",
            Self::Mat4 => "MAT4",
        }
    }

    /// Number of components.
    pub(super) fn width(self) -> usize {
        match self {
            Self::Scalar => 1,
            Self::Vec2 => 2,
            Self::Vec3 => 3,
            Self::Vec4 | Self::Mat2 => 4,
            Self::Mat3 => 9,
            Self::Mat4 => 16,
        }
    }
}

/// A range of equal elements in a buffer, all within it.
struct Elements<'a> {
    /// Empty if all elements are zero.
    bytes: &'a [u8],
    stride: usize,
    count: usize,
    component: Component,
}

impl<'a> Elements<'a> {
    /// The bytes of element `i`; `None` if all elements are zero.
    fn at(&self, i: usize) -> Option<&'a [u8]> {
        match self.bytes {
            [] => None,
            bytes => Some(&bytes[i * self.stride..]),
        }
    }
}

impl<'a> Accessors<'a> {
    /// The elements of `accessors[index]`, to which `place` refers, as vectors of `N` floats. Missing
    /// components are `fill`. Numbers may be infinite or NaN.
    ///
    /// # Errors
    /// The accessor does not exist, has components in another number than `widths` allows, lies outside
    /// its buffer, or exceeds the budget.
    pub fn vectors<const N: usize>(
        &self,
        index: usize,
        widths: &[Kind],
        fill: f32,
        place: &str,
    ) -> Result<Vec<[f32; N]>, ImportError> {
        let blame = self.ledger.blame;
        let accessor = blame.get(&self.document.accessors, index, "accessors", place)?;
        let here = format!("accessors[{index}]");
        if !widths.contains(&accessor.kind) {
            let why = format!("{place} cannot have the type {}", accessor.kind.name());
            return Err(blame.bad(here, why));
        }
        let elements = self.elements(accessor, &here)?;
        let count = elements.count;
        self.ledger
            .take(0, budget::size::<[f32; N]>(count), &here)?;
        let width = accessor.kind.width().min(N);
        let (component, normalized) = (elements.component, accessor.normalized);
        let vector = |bytes: &[u8]| {
            let mut vector = [fill; N];
            for (i, value) in vector[..width].iter_mut().enumerate() {
                *value = component.float(&bytes[i * component.size()..], normalized);
            }
            vector
        };
        let zero = {
            let mut zero = [fill; N];
            zero[..width].fill(0.0);
            zero
        };
        let mut vectors: Vec<[f32; N]> =
            threads::collect(count, |i| elements.at(i).map_or(zero, vector));
        self.sparse(accessor, &here, |i, bytes| vectors[i] = vector(bytes))?;
        Ok(vectors)
    }

    /// The number that stands for 1 in `accessors[index]` if it has integers that are not marked as normalised.
    pub fn most_unless_normalized(&self, index: usize) -> Option<f32> {
        let accessor = self.document.accessors.get(index)?;
        match Component::of(accessor.component_type)? {
            _ if accessor.normalized => None,
            Component::F32 => None,
            Component::I8 => Some(127.0),
            Component::U8 => Some(255.0),
            Component::I16 => Some(32767.0),
            Component::U16 => Some(65535.0),
            Component::U32 => Some(u32::MAX as f32),
        }
    }

    /// The elements of `accessors[index]`, to which `place` refers, as whole numbers.
    ///
    /// # Errors
    /// As [`Self::vectors`], or the numbers are not unsigned integers.
    pub fn indices(&self, index: usize, place: &str) -> Result<Vec<u32>, ImportError> {
        let blame = self.ledger.blame;
        let accessor = blame.get(&self.document.accessors, index, "accessors", place)?;
        let here = format!("accessors[{index}]");
        let elements = self.elements(accessor, &here)?;
        let component = elements.component;
        if accessor.kind != Kind::Scalar || component.index(&[0; 4]).is_none() {
            return Err(blame.bad(here, format_args!("{place} must be unsigned integers")));
        }
        self.ledger
            .take(0, budget::size::<u32>(elements.count), &here)?;
        let number = |bytes: &[u8]| component.index(bytes).unwrap_or_default();
        let mut numbers: Vec<u32> =
            threads::collect(elements.count, |i| elements.at(i).map_or(0, number));
        self.sparse(accessor, &here, |i, bytes| numbers[i] = number(bytes))?;
        Ok(numbers)
    }

    /// The number of elements of `accessors[index]`, to which `place` refers.
    pub fn count(&self, index: usize, place: &str) -> Result<u64, ImportError> {
        let accessors = &self.document.accessors;
        let found = self
            .ledger
            .blame
            .get(accessors, index, "accessors", place)?;
        Ok(found.count)
    }

    /// The elements of an accessor without its sparse part.
    fn elements(&self, accessor: &Accessor, here: &str) -> Result<Elements<'a>, ImportError> {
        let blame = self.ledger.blame;
        let component = self.component(accessor.component_type, here)?;
        let size = accessor.kind.width() * component.size();
        let Some(view) = accessor.buffer_view else {
            let count = usize::try_from(accessor.count).unwrap_or(usize::MAX);
            // The count is only a claim here; no byte of a buffer backs it.
            self.ledger
                .take(0, (count as u64).saturating_mul(16), here)?;
            return Ok(Elements {
                bytes: &[],
                stride: 0,
                count,
                component,
            });
        };
        let (bytes, stride) = self.buffers.view(self.document, view, here, blame)?;
        let stride = stride.unwrap_or(size as u64);
        if stride < size as u64 {
            let why = format!("its elements have {size} bytes, more than the stride {stride}");
            return Err(blame.bad(here, why));
        }
        let bytes = self.within(
            bytes,
            accessor.byte_offset,
            accessor.count,
            stride,
            size,
            here,
        )?;
        Ok(Elements {
            bytes,
            stride: stride as usize,
            count: accessor.count as usize,
            component,
        })
    }

    fn component(&self, code: u32, here: &str) -> Result<Component, ImportError> {
        Component::of(code).ok_or_else(|| {
            let why = format!("componentType {code} is unknown");
            self.ledger.blame.bad(here, why)
        })
    }

    /// The bytes of `count` elements of `size` bytes each, `stride` apart, from byte `offset` of `bytes`.
    fn within(
        &self,
        bytes: &'a [u8],
        offset: u64,
        count: u64,
        stride: u64,
        size: usize,
        here: &str,
    ) -> Result<&'a [u8], ImportError> {
        let blame = self.ledger.blame;
        if count == 0 {
            return Err(blame.bad(here, "count is 0"));
        }
        let length = (count - 1)
            .checked_mul(stride)
            .and_then(|length| length.checked_add(size as u64));
        let end = length.and_then(|length| length.checked_add(offset));
        match (length, end) {
            (Some(_), Some(end)) if end <= bytes.len() as u64 => {
                Ok(&bytes[offset as usize..end as usize])
            }
            _ => {
                let have = bytes.len();
                let why = format!(
                    "{count} elements from byte {offset} lie outside the buffer view, which has {have} bytes"
                );
                Err(blame.bad(here, why))
            }
        }
    }

    /// Calls `set` for each element that the sparse part replaces.
    fn sparse(
        &self,
        accessor: &Accessor,
        here: &str,
        mut set: impl FnMut(usize, &[u8]),
    ) -> Result<(), ImportError> {
        let Some(sparse) = &accessor.sparse else {
            return Ok(());
        };
        let blame = self.ledger.blame;
        let here = format!("{here}.sparse");
        if sparse.count == 0 {
            return Ok(());
        }
        let kind = self.component(sparse.indices.component_type, &here)?;
        let size = kind.size();
        let (indices, values) = (&sparse.indices, &sparse.values);
        let (bytes, _) = self
            .buffers
            .view(self.document, indices.buffer_view, &here, blame)?;
        let count = sparse.count;
        let places = self.within(bytes, indices.byte_offset, count, size as u64, size, &here)?;
        let component = self.component(accessor.component_type, &here)?;
        let width = accessor.kind.width() * component.size();
        let (bytes, _) = self
            .buffers
            .view(self.document, values.buffer_view, &here, blame)?;
        let values = self.within(bytes, values.byte_offset, count, width as u64, width, &here)?;
        for (place, value) in places.chunks_exact(size).zip(values.chunks_exact(width)) {
            match kind.index(place) {
                Some(i) if u64::from(i) < accessor.count => set(i as usize, value),
                _ => {
                    let why = "an index is not below the accessor's count";
                    return Err(blame.bad(here, why));
                }
            }
        }
        Ok(())
    }
}
