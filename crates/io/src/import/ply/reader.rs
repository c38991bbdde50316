//! The numbers of a PLY file, one after the other.

use super::AGAIN;
use super::types::{Element, Encoding, Kind, Property};
use crate::import::budget::Budget;
use crate::import::error::{ImportError, fault};
use crate::import::number;
use crate::import::source::quote;
use std::cell::Cell;
use std::path::Path;

pub(super) struct Reader<'a> {
    path: &'a Path,
    pub bytes: &'a [u8],
    pub at: usize,
    pub encoding: Encoding,
    /// The pictures that the header names, as MeshLab writes them.
    pub texture_files: Vec<String>,
    /// The message for the first value that cannot be used: the file is refused for it if nothing is left.
    pub fault: Option<ImportError>,
    /// Whether the end of the file was met too early.
    pub is_cut: Cell<bool>,
    /// Memory in bytes that the file takes.
    taken: u64,
}

impl<'a> Reader<'a> {
    pub fn new(path: &'a Path, bytes: &'a [u8]) -> Result<Self, ImportError> {
        let reader = Self {
            path,
            bytes,
            at: 0,
            encoding: Encoding::Text,
            texture_files: Vec::new(),
            fault: None,
            is_cut: Cell::new(false),
            taken: bytes.len() as u64,
        };
        match bytes.starts_with(b"ply") {
            true => Ok(reader),
            false => Err(reader.refuse("it does not begin with `ply`", "Name a PLY file")),
        }
    }

    pub fn refuse(&self, why: &str, todo: &str) -> ImportError {
        ImportError::Malformed(fault("bad mesh", self.path, why, todo))
    }

    /// Reserves memory from the budget, before it is allocated.
    pub fn reserve(&mut self, bytes: u64) -> Result<(), ImportError> {
        self.taken = self.taken.saturating_add(bytes);
        Budget::of(self.bytes.len()).check(self.taken, |why, todo| self.refuse(&why, todo))
    }

    pub fn cut(&self) -> ImportError {
        self.is_cut.set(true);
        let todo = "Check that it was written completely";
        self.refuse("it is shorter than its header announces", todo)
    }

    /// The error for a number that cannot be used.
    pub fn not_finite(&self, number: f64) -> ImportError {
        let why = format!("{number} is not a finite number of at most 3.4e38");
        self.refuse(&why, "Repair the mesh")
    }

    /// The columns of properties, if the element has all of them; lists are refused.
    pub fn columns(
        &self,
        element: &Element,
        names: &[&str],
    ) -> Result<Option<Vec<usize>>, ImportError> {
        let column = |name: &&str| element.properties.iter().position(|p| p.name == *name);
        let columns: Option<Vec<_>> = names.iter().map(column).collect();
        let lists = columns.iter().flatten();
        let mut lists = lists.filter(|&&i| element.properties[i].count.is_some());
        match lists.next() {
            Some(_) => Err(self.refuse(&format!("`{}` is a list", names[0]), AGAIN)),
            None => Ok(columns),
        }
    }

    /// Calls `take` with the numbers in `columns` of each row of the element.
    pub fn rows(
        &mut self,
        element: &Element,
        columns: &[usize],
        mut take: impl FnMut(&Self, &[f64]) -> Result<(), ImportError>,
    ) -> Result<(), ImportError> {
        let mut values = vec![0.0; columns.len()];
        let has_lists = element.properties.iter().any(|p| p.count.is_some());
        if self.encoding == Encoding::Text || has_lists {
            let mut row = Vec::new();
            for _ in 0..element.count {
                self.row(element, &mut row)?;
                for (value, &column) in values.iter_mut().zip(columns) {
                    *value = row[column];
                }
                take(self, &values)?;
            }
            return Ok(());
        }
        // All rows have the same length.
        let sizes = || element.properties.iter().map(|p| p.kind.size());
        let length: usize = sizes().sum();
        let place = |&column: &usize| {
            (
                sizes().take(column).sum::<usize>(),
                element.properties[column].kind,
            )
        };
        let places: Vec<(usize, Kind)> = columns.iter().map(place).collect();
        let bytes = self.bytes;
        let end = element
            .count
            .checked_mul(length)
            .and_then(|length| self.at.checked_add(length));
        let rows = end
            .and_then(|end| bytes.get(self.at..end))
            .ok_or_else(|| self.cut())?;
        self.at += rows.len();
        for row in rows.chunks_exact(length.max(1)) {
            for (value, &(at, kind)) in values.iter_mut().zip(&places) {
                *value = decoded(kind, &row[at..], self.encoding);
            }
            take(self, &values)?;
        }
        Ok(())
    }

    /// The numbers of one row; a list gives 0.
    fn row(&mut self, element: &Element, row: &mut Vec<f64>) -> Result<(), ImportError> {
        row.clear();
        for property in &element.properties {
            if property.count.is_none() {
                row.push(self.number(property.kind)?);
                continue;
            }
            for _ in 0..self.length(property)? {
                self.number(property.kind)?;
            }
            row.push(0.0);
        }
        Ok(())
    }

    pub fn pass_over(&mut self, element: &Element) -> Result<(), ImportError> {
        self.rows(element, &[], |_, _| Ok(()))
    }

    /// The number of values of a property, which the rest of the file has room for.
    pub fn length(&mut self, property: &Property) -> Result<usize, ImportError> {
        let Some(kind) = property.count else {
            return Ok(1);
        };
        let length = self.number(kind)?;
        if length.is_nan() || length < 0.0 {
            return Err(self.refuse("a list has a negative length", AGAIN));
        }
        let least = match self.encoding {
            Encoding::Text => 2,
            _ => property.kind.size(),
        };
        // The last word of a text file may lack its line break.
        match length as usize > (self.bytes.len() - self.at + 1) / least {
            true => Err(self.cut()),
            false => Ok(length as usize),
        }
    }

    /// The next list of a property if it has the length 3 in one byte and then three numbers below `most` in four bytes
    /// each, as most faces are written. Otherwise nothing is read.
    pub fn triple(&mut self, property: &Property, most: usize) -> Option<[u32; 3]> {
        let is_usual = self.encoding != Encoding::Text
            && matches!(property.count, Some(Kind::U8 | Kind::I8))
            && matches!(property.kind, Kind::U32 | Kind::I32);
        let [3, numbers @ ..] = self.bytes.get(self.at..)?.first_chunk::<13>()? else {
            return None;
        };
        let numbers = numbers.as_chunks::<4>().0.first_chunk::<3>()?;
        let triple = numbers.map(|bytes| match self.encoding {
            Encoding::Big => u32::from_be_bytes(bytes),
            _ => u32::from_le_bytes(bytes),
        });
        let fits = is_usual && triple.iter().all(|&number| (number as usize) < most);
        fits.then(|| {
            self.at += 13;
            triple
        })
    }

    /// The next number, in the range of its type.
    pub fn number(&mut self, kind: Kind) -> Result<f64, ImportError> {
        if self.encoding == Encoding::Text {
            return self.word();
        }
        let bytes = self.bytes.get(self.at..self.at + kind.size());
        let bytes = bytes.ok_or_else(|| self.cut())?;
        self.at += kind.size();
        Ok(decoded(kind, bytes, self.encoding))
    }

    fn word(&mut self) -> Result<f64, ImportError> {
        let is_space = |b: &u8| b.is_ascii_whitespace();
        let rest = &self.bytes[self.at..];
        let start = rest.iter().position(|b| !is_space(b));
        let start = start.ok_or_else(|| self.cut())?;
        let length = rest[start..].iter().position(is_space);
        let word = &rest[start..length.map_or(rest.len(), |length| start + length)];
        self.at += start + word.len();
        // Out of the range of f32 is finite in a list, which has whole numbers.
        if let Some(number) = std::str::from_utf8(word).ok().and_then(|w| w.parse().ok()) {
            return Ok(number);
        }
        if self.fault.is_none() && !number::is_nonfinite(word) {
            let why = format!("{} is not a number", quote(word));
            self.fault = Some(self.refuse(&why, AGAIN));
        }
        Ok(f64::NAN)
    }
}

/// The number at the beginning of `bytes`, which are long enough.
fn decoded(kind: Kind, bytes: &[u8], encoding: Encoding) -> f64 {
    // The length is known, so that it is one load.
    fn first<const N: usize>(bytes: &[u8], encoding: Encoding) -> [u8; N] {
        let mut first = bytes.first_chunk().copied().unwrap_or([0; N]);
        if encoding == Encoding::Big {
            first.reverse();
        }
        first
    }
    match kind {
        Kind::I8 => f64::from(i8::from_le_bytes(first(bytes, encoding))),
        Kind::U8 => f64::from(u8::from_le_bytes(first(bytes, encoding))),
        Kind::I16 => f64::from(i16::from_le_bytes(first(bytes, encoding))),
        Kind::U16 => f64::from(u16::from_le_bytes(first(bytes, encoding))),
        Kind::I32 => f64::from(i32::from_le_bytes(first(bytes, encoding))),
        Kind::U32 => f64::from(u32::from_le_bytes(first(bytes, encoding))),
        Kind::Float => f64::from(f32::from_le_bytes(first(bytes, encoding))),
        Kind::Double => f64::from_le_bytes(first(bytes, encoding)),
    }
}
