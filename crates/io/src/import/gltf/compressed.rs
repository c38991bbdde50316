//! Compressed geometry becomes plain geometry before anything else reads it: buffer views with
//! `EXT_meshopt_compression` or `KHR_meshopt_compression`, and primitives with `KHR_draco_mesh_compression`, are decoded
//! into new buffers, to which the document then refers.
//!
//! A few bytes can stand for gigabytes. What all decoded data may take together is bounded by [`Room`].

#[cfg(feature = "draco")]
mod draco;

use super::blame::Blame;
use super::buffers::Buffers;
use super::document::{ABSENT, CompressedView, Document};
use super::meshopt::{self, Filter, Mode};
use crate::import::error::ImportError;
use glimray_scene::bytes::size;
use glimray_scene::threads;

/// Bytes that a byte of the file may become, and those that every file may have in addition.
const PER_BYTE: u64 = 64;
const ALWAYS: u64 = 64 << 20;

/// The bytes that may still be decoded.
struct Room<'a> {
    left: u64,
    blame: Blame<'a>,
    /// Why data were left out.
    faults: Vec<ImportError>,
}

impl Room<'_> {
    /// Takes `bytes` for what is at `place`.
    ///
    /// # Errors
    /// There is not so much room.
    fn take(&mut self, bytes: u64, place: &str) -> Result<(), ImportError> {
        match self.left.checked_sub(bytes) {
            Some(left) => {
                self.left = left;
                Ok(())
            }
            None => Err(self.too_big(place)),
        }
    }

    /// Whether something can be used; what is malformed is left out.
    fn spared(&mut self, found: Result<(), ImportError>) -> Result<bool, ImportError> {
        match found {
            Ok(()) => Ok(true),
            Err(fault @ ImportError::Malformed(_)) => {
                self.faults.push(fault);
                Ok(false)
            }
            Err(error) => Err(error),
        }
    }

    fn too_big(&self, place: &str) -> ImportError {
        let why = format!(
            "{place}: the compressed data would take more than {PER_BYTE} times the size of the file plus {}",
            size(ALWAYS)
        );
        let todo = "Export the model without compression";
        ImportError::TooBig(self.blame.file(&why, todo).into_fault())
    }
}

/// Decodes all compressed geometry of `document` into new `buffers`. Returns why some of it was left out: that leads
/// nowhere.
///
/// # Errors
/// Compressed data are too large.
pub(super) fn expand(
    document: &mut Document,
    buffers: &mut Buffers,
    blame: Blame,
) -> Result<Vec<ImportError>, ImportError> {
    let bytes = buffers.total() as u64;
    let mut room = Room {
        left: ALWAYS.saturating_add(bytes.saturating_mul(PER_BYTE)),
        blame,
        faults: Vec::new(),
    };
    views(document, buffers, &mut room)?;
    #[cfg(feature = "draco")]
    draco::primitives(document, buffers, &mut room)?;
    Ok(room.faults)
}

/// Decodes buffer views, several at a time.
fn views(
    document: &mut Document,
    buffers: &mut Buffers,
    room: &mut Room,
) -> Result<(), ImportError> {
    let blame = room.blame;
    let mut found = Vec::new();
    let mut jobs = Vec::new();
    let mut lost = Vec::new();
    for (index, view) in document.buffer_views.iter().enumerate() {
        let extensions = view.extensions.as_deref();
        let Some(compressed) = extensions.and_then(|it| it.ext.as_ref().or(it.khr.as_ref())) else {
            continue;
        };
        let place = format!("bufferViews[{index}]");
        let planned = planned(compressed, buffers, room, &place).map(|job| {
            found.push((index, place, job.0, compressed.byte_stride));
            jobs.push(job);
        });
        if !room.spared(planned)? {
            lost.push(index);
        }
    }
    let decoded = threads::map(jobs, |(mode, filter, count, stride, source)| {
        meshopt::decode(mode, filter, count, stride, source)
    });
    for ((index, place, mode, stride), decoded) in found.into_iter().zip(decoded) {
        let taken = decoded.map_err(|why| blame.bad(&place, why)).map(|bytes| {
            let view = &mut document.buffer_views[index];
            view.byte_offset = 0;
            view.byte_length = bytes.len() as u64;
            view.buffer = buffers.push(bytes);
            if mode == Mode::Attributes {
                view.byte_stride = Some(stride);
            }
        });
        if !room.spared(taken)? {
            lost.push(index);
        }
    }
    for index in lost {
        document.buffer_views[index].buffer = ABSENT;
    }
    Ok(())
}

/// The input of a view's decoder: mode and filter, the number and the size of the elements, and the bytes.
type Job<'b> = (Mode, Filter, usize, usize, &'b [u8]);

fn planned<'b>(
    compressed: &CompressedView,
    buffers: &'b Buffers,
    room: &mut Room,
    place: &str,
) -> Result<Job<'b>, ImportError> {
    let blame = room.blame;
    let bad = |why: String| blame.bad(place, why);
    let mode = match compressed.mode.as_str() {
        "ATTRIBUTES" => Mode::Attributes,
        "TRIANGLES" => Mode::Triangles,
        "INDICES" => Mode::Indices,
        other => return Err(bad(format!("the mode {other:?} is unknown"))),
    };
    let filter = match compressed.filter.as_deref() {
        None | Some("NONE") => Filter::None,
        Some("OCTAHEDRAL") => Filter::Octahedral,
        Some("QUATERNION") => Filter::Quaternion,
        Some("EXPONENTIAL") => Filter::Exponential,
        Some("COLOR") => Filter::Color,
        Some(other) => return Err(bad(format!("the filter {other:?} is unknown"))),
    };
    let CompressedView {
        buffer,
        byte_offset,
        byte_length,
        byte_stride,
        count,
        ..
    } = *compressed;
    let source = buffers.range(buffer, byte_offset, byte_length, place, blame)?;
    if meshopt::least_bytes(mode, count, byte_stride) > source.len() as u64 {
        let have = source.len();
        return Err(bad(format!("{have} bytes cannot hold {count} elements")));
    }
    room.take(count.saturating_mul(byte_stride), place)?;
    // Both fit, as there is room for them.
    Ok((mode, filter, count as usize, byte_stride as usize, source))
}
