//! Arrays made of shared segments: a scene that differs from another in one object shares the segments of all
//! other objects.

use bytemuck::Pod;
use std::{fmt, ops::Index, sync::Arc};

/// An owner of the elements of a segment.
pub trait Run<T>: Send + Sync {
    /// The elements, always the same ones.
    fn elements(&self) -> &[T];
}

impl<T: Send + Sync> Run<T> for Arc<[T]> {
    fn elements(&self) -> &[T] {
        self
    }
}

/// Segments that form one array. A clone shares them.
#[derive(Clone)]
pub struct Segments<T> {
    runs: Vec<Arc<dyn Run<T>>>,
    /// Index of the first element of each segment.
    starts: Vec<usize>,
    len: usize,
}

impl<T> Segments<T> {
    /// Appends a segment; empty ones are skipped.
    pub(super) fn push(&mut self, run: Arc<dyn Run<T>>) {
        let len = run.elements().len();
        if len > 0 {
            self.starts.push(self.len);
            self.len += len;
            self.runs.push(run);
        }
    }

    /// Appends the segments of another array.
    pub(super) fn append(&mut self, other: &Self) {
        other.runs.iter().for_each(|run| self.push(run.clone()));
    }

    /// Number of elements.
    pub fn len(&self) -> usize {
        self.len
    }

    /// Whether there is no element.
    pub fn is_empty(&self) -> bool {
        self.len == 0
    }

    /// All elements in order.
    pub fn iter(&self) -> impl Iterator<Item = &T> {
        self.runs.iter().flat_map(|run| run.elements())
    }

    /// The element at `index`; `None` beyond the end.
    pub fn get(&self, index: usize) -> Option<&T> {
        let run = self.starts.partition_point(|start| *start <= index);
        let run = run.checked_sub(1)?;
        self.runs[run].elements().get(index - self.starts[run])
    }

    /// Size of all elements in bytes.
    pub fn byte_len(&self) -> u64 {
        (self.len * size_of::<T>()) as u64
    }
}

impl<T: Pod> Segments<T> {
    /// The index of the first element of each segment, and its bytes.
    pub fn runs(&self) -> impl Iterator<Item = (usize, &[u8])> {
        self.starts.iter().copied().zip(self.bytes())
    }

    /// The bytes of each segment.
    pub fn bytes(&self) -> impl Iterator<Item = &[u8]> {
        (self.runs.iter()).map(|run| bytemuck::cast_slice(run.elements()))
    }
}

impl<T> Default for Segments<T> {
    fn default() -> Self {
        Self {
            runs: Vec::new(),
            starts: Vec::new(),
            len: 0,
        }
    }
}

impl<T: Send + Sync + 'static> FromIterator<Arc<[T]>> for Segments<T> {
    fn from_iter<I: IntoIterator<Item = Arc<[T]>>>(runs: I) -> Self {
        let mut segments = Self::default();
        (runs.into_iter()).for_each(|run| segments.push(Arc::new(run)));
        segments
    }
}

impl<T> Index<usize> for Segments<T> {
    type Output = T;

    fn index(&self, index: usize) -> &T {
        let run = self.starts.partition_point(|start| *start <= index) - 1;
        &self.runs[run].elements()[index - self.starts[run]]
    }
}

/// Compares elements, however they are split into segments.
impl<T: PartialEq> PartialEq for Segments<T> {
    fn eq(&self, other: &Self) -> bool {
        self.len == other.len && self.iter().eq(other.iter())
    }
}

impl<T: fmt::Debug> fmt::Debug for Segments<T> {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        f.debug_list().entries(self.iter()).finish()
    }
}
