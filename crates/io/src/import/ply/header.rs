//! The header of a PLY file: its elements and their properties.

use super::AGAIN;
use super::reader::Reader;
use super::types::{Element, Encoding, Kind, Property};
use crate::import::error::ImportError;
use crate::import::source::quote;

/// Size limit of the header in bytes.
const MAX_HEADER: usize = 64 << 10;

impl Reader<'_> {
    /// Parses the header.
    pub fn elements(&mut self) -> Result<Vec<Element>, ImportError> {
        let mut elements: Vec<Element> = Vec::new();
        let mut number = 0;
        // The first line tells how all of them end: a binary body may begin with a line feed.
        let newline = match self.bytes[3..] {
            [b'\r', b'\n', ..] => b'\n',
            [b'\r', ..] => b'\r',
            _ => b'\n',
        };
        loop {
            let rest = &self.bytes[self.at..self.bytes.len().min(MAX_HEADER)];
            let Some(end) = rest.iter().position(|&b| b == newline) else {
                return Err(self.refuse("its header does not end with `end_header`", AGAIN));
            };
            self.at += end + 1;
            number += 1;
            let line = String::from_utf8_lossy(&rest[..end]);
            let words: Vec<&str> = line.split_ascii_whitespace().collect();
            let bad = |reader: &Self| {
                let quoted = quote(line.trim_end().as_bytes());
                reader.refuse(&format!("line {number} of its header is {quoted}"), AGAIN)
            };
            match words[..] {
                ["ply"] if number == 1 => {}
                ["format", encoding, _] => {
                    self.encoding = match encoding {
                        "ascii" => Encoding::Text,
                        "binary_little_endian" => Encoding::Little,
                        "binary_big_endian" => Encoding::Big,
                        _ => return Err(bad(self)),
                    }
                }
                ["comment", "TextureFile", ..] => {
                    let name = line.trim_start().trim_start_matches("comment").trim_start();
                    let name = name.trim_start_matches("TextureFile").trim();
                    self.texture_files.push(name.to_owned());
                }
                [] | ["comment" | "obj_info", ..] => {}
                ["element", name, _] if elements.iter().any(|known| known.name == name) => {
                    let quoted = quote(name.as_bytes());
                    let why = format!("its header has the element {quoted} twice");
                    return Err(self.refuse(&why, AGAIN));
                }
                ["element", name, count] => elements.push(Element {
                    name: name.to_owned(),
                    count: count.parse().map_err(|_| bad(self))?,
                    properties: Vec::new(),
                }),
                ["property", "list", count, kind, name] => {
                    let element = elements.last_mut().ok_or_else(|| bad(self))?;
                    element.properties.push(Property {
                        name: name.to_owned(),
                        count: Some(Kind::named(count).ok_or_else(|| bad(self))?),
                        kind: Kind::named(kind).ok_or_else(|| bad(self))?,
                    });
                }
                ["property", kind, name] => {
                    let element = elements.last_mut().ok_or_else(|| bad(self))?;
                    element.properties.push(Property {
                        name: name.to_owned(),
                        count: None,
                        kind: Kind::named(kind).ok_or_else(|| bad(self))?,
                    });
                }
                ["end_header"] => break,
                _ => return Err(bad(self)),
            }
        }
        self.check(&elements)?;
        Ok(elements)
    }

    /// Refuses headers that announce more data than the file has, before memory is allocated. The elements after the
    /// vertices may be cut off.
    fn check(&self, elements: &[Element]) -> Result<(), ImportError> {
        let vertices = elements.iter().position(|element| element.name == "vertex");
        let needed = &elements[..vertices.map_or(elements.len(), |at| at + 1)];
        let size = |element: &Element| self.least_size(element) as u128 * element.count as u128;
        // The last line of a text file may lack its line break.
        match needed.iter().map(size).sum::<u128>() > self.left() as u128 + 1 {
            true => Err(self.cut()),
            false => Ok(()),
        }
    }

    /// Bytes of the shortest row of an element.
    fn least_size(&self, element: &Element) -> usize {
        let least = |property: &Property| match self.encoding {
            Encoding::Text => 2,
            _ => property.count.unwrap_or(property.kind).size(),
        };
        element.properties.iter().map(least).sum::<usize>().max(1)
    }

    /// Bytes that have not been read.
    fn left(&self) -> usize {
        self.bytes.len() - self.at
    }

    /// The rows of an element that the rest of the file has room for, at most as many as it announces.
    pub fn row_count(&self, element: &Element) -> usize {
        element
            .count
            .min((self.left() + 1) / self.least_size(element))
    }
}
