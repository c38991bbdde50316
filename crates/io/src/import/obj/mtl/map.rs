//! The picture of a material: its options and its file.

use super::super::lines::Line;
use crate::import::number;
use glam::{DAffine3, DVec3};

/// An image that multiplies a colour or a number.
#[derive(Clone, Copy)]
pub(in super::super) struct Map<N> {
    /// The name of the picture's file.
    pub name: N,
    /// By `-s` and `-o`.
    pub picture_from_uv: DAffine3,
    /// By `-bm`: how high white is in a height map, in texels.
    pub height: f64,
    /// By `-clamp`: whether its edge goes on instead of a repetition.
    pub is_clamped: bool,
}

impl<'s> Map<&'s [u8]> {
    pub fn to_text(self) -> Map<String> {
        Map {
            name: String::from_utf8_lossy(self.name).into_owned(),
            picture_from_uv: self.picture_from_uv,
            height: self.height,
            is_clamped: self.is_clamped,
        }
    }

    /// Reads the rest of a texture statement and calls `skip` with each option that has no effect but asks for one.
    /// `None` without a file.
    pub fn read(line: &mut Line<'s>, mut skip: impl FnMut(&'s [u8])) -> Option<Self> {
        let mut map = Map {
            name: &[][..],
            picture_from_uv: DAffine3::IDENTITY,
            height: 1.0,
            is_clamped: false,
        };
        let (mut scale, mut offset) = (DVec3::ONE, DVec3::ZERO);
        while line.rest().bytes.starts_with(b"-") {
            let Some(option) = line.word() else { break };
            let name = option.bytes.to_ascii_lowercase();
            let (least, most) = match &name[..] {
                b"-mm" => (2, 2),
                b"-o" | b"-s" | b"-t" => (1, 3),
                _ => (1, 1),
            };
            let mut numbers: Vec<f64> = Vec::new();
            let mut word: &[u8] = b"";
            for i in 0..most {
                let next = line.rest().bytes.split(u8::is_ascii_whitespace).next();
                let number = next.and_then(number::read);
                if i >= least && number.is_none() {
                    break;
                }
                // Beyond this, f32 has whole numbers only.
                numbers.extend(number.map(|n| n.clamp(-1e9, 1e9)));
                word = line.word().map_or(word, |word| word.bytes);
            }
            let is_on = word.eq_ignore_ascii_case(b"on");
            match (&name[..], &numbers[..]) {
                (b"-s", [first, ..]) if numbers.iter().all(|n| *n != 0.0) => {
                    scale = DVec3::new(*first, numbers.get(1).copied().unwrap_or(1.0), 1.0);
                }
                (b"-o", [first, ..]) => {
                    offset = DVec3::new(*first, numbers.get(1).copied().unwrap_or(0.0), 0.0);
                }
                (b"-bm", [number]) => map.height = *number,
                (b"-clamp", _) => map.is_clamped = is_on,
                // These ask for nothing.
                (b"-blendu" | b"-blendv", _) if is_on => {}
                (b"-cc", _) if !is_on => {}
                (b"-mm", [0.0, 1.0]) | (b"-boost", [0.0]) | (b"-texres", [_]) => {}
                (b"-t", numbers) if !numbers.is_empty() && numbers.iter().all(|n| *n == 0.0) => {}
                _ => skip(option.bytes),
            }
        }
        map.picture_from_uv = DAffine3::from_translation(offset) * DAffine3::from_scale(scale);
        map.name = unquoted(line.rest().bytes);
        (!map.name.is_empty()).then_some(map)
    }
}

/// `name` without quotes around it, which some exporters write.
pub(in super::super) fn unquoted(name: &[u8]) -> &[u8] {
    let inner = name.strip_prefix(b"\"").and_then(|n| n.strip_suffix(b"\""));
    inner.unwrap_or(name).trim_ascii()
}
