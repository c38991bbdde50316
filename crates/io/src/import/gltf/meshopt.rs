//! The codecs of `EXT_meshopt_compression` and `KHR_meshopt_compression`: vertex attributes (versions 0 and 1), triangles
//! and sequences of indices, as their specifications describe the streams. Every read is checked.

mod filters;

pub(super) use filters::Filter;

/// Why a stream cannot be decoded, as a clause.
type Fault = &'static str;

const CUT: Fault = "the compressed data end too early";
const UNKNOWN: Fault = "the compressed data have an unknown version";

/// Elements in a block of attributes: at most this many, and at most this many bytes.
const BLOCK_ELEMENTS: usize = 256;
const BLOCK_BYTES: usize = 8192;

/// The kind of data in a stream.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(super) enum Mode {
    Attributes,
    Triangles,
    Indices,
}

/// The `count` elements of `stride` bytes each that `source` encodes; indices have 2 or 4 bytes.
///
/// # Errors
/// The stream is invalid or too short, or the stride does not suit it.
pub(super) fn decode(
    mode: Mode,
    filter: Filter,
    count: usize,
    stride: usize,
    source: &[u8],
) -> Result<Vec<u8>, Fault> {
    match mode {
        Mode::Attributes => {
            let mut bytes = attributes(count, stride, source)?;
            filters::apply(filter, stride, &mut bytes)?;
            Ok(bytes)
        }
        _ if !matches!(stride, 2 | 4) => Err("indices have 2 or 4 bytes"),
        Mode::Triangles => Ok(stored(&triangles(count, source)?, stride)),
        Mode::Indices => Ok(stored(&sequence(count, source)?, stride)),
    }
}

/// The fewest bytes that `count` elements may be encoded in, so that absurd counts are refused before anything is
/// allocated.
pub(super) fn least_bytes(mode: Mode, count: u64, stride: u64) -> u64 {
    match mode {
        // A block of attributes has at least a byte for four columns.
        Mode::Attributes => count / BLOCK_ELEMENTS as u64 * (stride / 4),
        Mode::Triangles => count / 3,
        Mode::Indices => count,
    }
}

/// Indices in little-endian order.
fn stored(indices: &[u32], stride: usize) -> Vec<u8> {
    (indices.iter())
        .flat_map(|index| index.to_le_bytes().into_iter().take(stride))
        .collect()
}

/// The part of a stream that is not read yet.
struct Stream<'s>(&'s [u8]);

impl<'s> Stream<'s> {
    fn take(&mut self, count: usize) -> Result<&'s [u8], Fault> {
        let (taken, rest) = self.0.split_at_checked(count).ok_or(CUT)?;
        self.0 = rest;
        Ok(taken)
    }

    fn byte(&mut self) -> Result<u8, Fault> {
        Ok(self.take(1)?[0])
    }

    /// A number in groups of seven bits, the lowest first.
    fn number(&mut self) -> Result<u32, Fault> {
        let mut number = 0;
        for shift in (0..32).step_by(7) {
            let byte = self.byte()?;
            number |= u32::from(byte & 0x7f) << shift;
            if byte < 0x80 {
                return Ok(number);
            }
        }
        Err("a number in the compressed data is too long")
    }
}

/// The signed difference that a zigzag code stands for, modulo 2³².
fn unzigzag(code: u32) -> u32 {
    (code >> 1) ^ (code & 1).wrapping_neg()
}

fn attributes(count: usize, stride: usize, source: &[u8]) -> Result<Vec<u8>, Fault> {
    if stride == 0 || stride > 256 || !stride.is_multiple_of(4) {
        return Err("attributes have 4 to 256 bytes, a multiple of 4");
    }
    let mut stream = Stream(source);
    let (is_second, padding) = match stream.byte()? {
        0xa0 => (false, 32),
        0xa1 => (true, 24),
        _ => return Err(UNKNOWN),
    };
    // At the end are the values before the first element, and in version 1 what the columns hold.
    let tail_len = if is_second {
        stride + stride / 4
    } else {
        stride
    };
    let body_len = (stream.0.len()).checked_sub(tail_len.max(padding));
    let body = stream.take(body_len.ok_or(CUT)?)?;
    let tail = &source[source.len() - tail_len..];
    let (mut last, channels) = (tail[..stride].to_vec(), &tail[stride..]);
    let mut stream = Stream(body);
    let most = ((BLOCK_BYTES / stride) & !15).min(BLOCK_ELEMENTS);
    let mut columns = vec![0; stride * most];
    let mut bytes = Vec::new();
    for first in (0..count).step_by(most) {
        let len = most.min(count - first);
        let control = stream.take(if is_second { stride / 4 } else { 0 })?;
        for (k, column) in columns.chunks_exact_mut(most).enumerate() {
            let control = control.get(k / 4).map(|it| it >> (k % 4 * 2) & 3);
            read_column(&mut stream, control, len, column)?;
        }
        for i in 0..len {
            for (word, last) in last.chunks_exact_mut(4).enumerate() {
                let codes = [0, 1, 2, 3].map(|k| columns[(4 * word + k) * most + i]);
                let channel = channels.get(word).copied().unwrap_or(0);
                advance(last, codes, channel)?;
            }
            bytes.extend_from_slice(&last);
        }
    }
    Ok(bytes)
}

/// Reads the codes of one byte of `len` elements.
fn read_column(
    stream: &mut Stream,
    control: Option<u8>,
    len: usize,
    column: &mut [u8],
) -> Result<(), Fault> {
    let widths = match control {
        None => [0, 2, 4, 8],
        Some(0) => [0, 1, 2, 4],
        Some(1) => [1, 2, 4, 8],
        Some(2) => {
            column.fill(0);
            return Ok(());
        }
        Some(_) => {
            column[..len].copy_from_slice(stream.take(len)?);
            return Ok(());
        }
    };
    let groups = column.as_chunks_mut::<16>().0;
    let groups = &mut groups[..len.div_ceil(16)];
    let header = stream.take(groups.len().div_ceil(4))?;
    for (i, group) in groups.iter_mut().enumerate() {
        match widths[usize::from(header[i / 4] >> (i % 4 * 2) & 3)] {
            0 => group.fill(0),
            8 => group.copy_from_slice(stream.take(16)?),
            width => {
                let packed = stream.take(2 * width)?;
                let (per_byte, largest) = (8 / width, (1_u8 << width) - 1);
                for (i, code) in group.iter_mut().enumerate() {
                    let place = i % per_byte * width;
                    // Single bits begin with the lowest, wider ones with the highest.
                    let shift = if width == 1 { place } else { 8 - width - place };
                    *code = packed[i / per_byte] >> shift & largest;
                    if *code == largest {
                        *code = stream.byte()?;
                    }
                }
            }
        }
    }
    Ok(())
}

/// Turns four bytes of one element into those of the next.
fn advance(last: &mut [u8], codes: [u8; 4], channel: u8) -> Result<(), Fault> {
    match channel & 3 {
        0 => {
            for (last, code) in last.iter_mut().zip(codes) {
                *last = last.wrapping_add(unzigzag(code.into()) as u8);
            }
        }
        1 => {
            for (last, codes) in last.chunks_exact_mut(2).zip(codes.chunks_exact(2)) {
                let code = u16::from_le_bytes([codes[0], codes[1]]);
                let value = u16::from_le_bytes([last[0], last[1]]);
                let value = value.wrapping_add(unzigzag(code.into()) as u16);
                last.copy_from_slice(&value.to_le_bytes());
            }
        }
        2 => {
            let turned = u32::from_le_bytes(codes).rotate_right(u32::from(channel >> 4));
            let value = u32::from_le_bytes([last[0], last[1], last[2], last[3]]) ^ turned;
            last.copy_from_slice(&value.to_le_bytes());
        }
        _ => return Err("the compressed data have an unknown kind of channel"),
    }
    Ok(())
}

/// The last 16 values that were pushed.
struct Recent<T> {
    values: [T; 16],
    next: usize,
}

impl<T: Copy> Recent<T> {
    fn new(value: T) -> Self {
        Self {
            values: [value; 16],
            next: 0,
        }
    }

    fn push(&mut self, value: T) {
        self.values[self.next % 16] = value;
        self.next += 1;
    }

    /// The value that was pushed `before` others.
    fn get(&self, before: u8) -> T {
        self.values[(self.next + 31 - usize::from(before)) % 16]
    }
}

/// The state of a triangle stream.
struct Triangles<'s> {
    data: Stream<'s>,
    edges: Recent<[u32; 2]>,
    vertices: Recent<u32>,
    /// The lowest index that did not occur yet.
    next: u32,
    /// The last index that was written as a difference.
    last: u32,
}

impl Triangles<'_> {
    fn fresh(&mut self) -> u32 {
        let index = self.next;
        self.next = index.wrapping_add(1);
        index
    }

    fn by_difference(&mut self, difference: u32) -> u32 {
        self.last = self.last.wrapping_add(difference);
        self.last
    }

    fn explicit(&mut self) -> Result<u32, Fault> {
        let code = self.data.number()?;
        Ok(self.by_difference(unzigzag(code)))
    }

    /// The corner that `code` from 0 to 15 stands for, and whether it is new among the recent ones.
    fn corner(&mut self, code: u8, has_explicit: bool) -> Result<(u32, bool), Fault> {
        Ok(match code {
            0 => (self.fresh(), true),
            15 if has_explicit => (self.explicit()?, true),
            _ => (self.vertices.get(code - 1), false),
        })
    }

    /// A triangle with an edge of an earlier one.
    fn at_edge(&mut self, edge: u8, third: u8) -> Result<[u32; 3], Fault> {
        let [a, b] = self.edges.get(edge);
        let c = match third {
            0 => self.fresh(),
            13 => self.by_difference(u32::MAX),
            14 => self.by_difference(1),
            15 => self.explicit()?,
            _ => self.vertices.get(third),
        };
        if matches!(third, 0 | 13..) {
            self.vertices.push(c);
        }
        self.edges.push([c, b]);
        self.edges.push([a, c]);
        Ok([a, b, c])
    }

    /// A triangle without such an edge. `table` are the most frequent codes of pairs of corners.
    fn apart(&mut self, kind: u8, table: &[u8]) -> Result<[u32; 3], Fault> {
        let has_explicit = kind >= 14;
        let pair = match has_explicit {
            true => self.data.byte()?,
            false => table[usize::from(kind)],
        };
        if has_explicit && pair == 0 {
            self.next = 0;
        }
        let a = match kind {
            15 => self.explicit()?,
            _ => self.fresh(),
        };
        let (b, b_is_new) = self.corner(pair >> 4, has_explicit)?;
        let (c, c_is_new) = self.corner(pair & 15, has_explicit)?;
        self.vertices.push(a);
        if b_is_new {
            self.vertices.push(b);
        }
        if c_is_new {
            self.vertices.push(c);
        }
        for edge in [[b, a], [c, b], [a, c]] {
            self.edges.push(edge);
        }
        Ok([a, b, c])
    }
}

fn triangles(count: usize, source: &[u8]) -> Result<Vec<u32>, Fault> {
    if !count.is_multiple_of(3) {
        return Err("the number of indices is not a multiple of 3");
    }
    let mut stream = Stream(source);
    if stream.byte()? != 0xe1 {
        return Err(UNKNOWN);
    }
    let codes = stream.take(count / 3)?;
    let data = stream.take(stream.0.len().checked_sub(16).ok_or(CUT)?)?;
    let table = stream.0;
    let mut state = Triangles {
        data: Stream(data),
        edges: Recent::new([0; 2]),
        vertices: Recent::new(0),
        next: 0,
        last: 0,
    };
    let mut indices = Vec::with_capacity(count);
    for code in codes {
        indices.extend(match (code >> 4, code & 15) {
            (15, kind) => state.apart(kind, table)?,
            (edge, third) => state.at_edge(edge, third)?,
        });
    }
    Ok(indices)
}

fn sequence(count: usize, source: &[u8]) -> Result<Vec<u32>, Fault> {
    let mut stream = Stream(source);
    if stream.byte()? != 0xd1 {
        return Err(UNKNOWN);
    }
    // Four bytes without a meaning follow.
    let mut data = Stream(stream.take(stream.0.len().checked_sub(4).ok_or(CUT)?)?);
    let mut last = [0_u32; 2];
    (0..count)
        .map(|_| {
            let code = data.number()?;
            let last = &mut last[code as usize & 1];
            *last = last.wrapping_add(unzigzag(code >> 1));
            Ok(*last)
        })
        .collect()
}
