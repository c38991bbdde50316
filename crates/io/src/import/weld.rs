//! Finds equal positions, exactly: formats without indices repeat a vertex in each of its triangles.

use glam::Vec3;
use std::hash::{BuildHasher, Hasher, RandomState};
use xxhash_rust::xxh3::xxh3_64_with_seed;

/// An empty slot of the table.
const EMPTY: u32 = u32::MAX;

/// Distinct positions in order of appearance, and a hash table of them.
pub(super) struct Welder {
    /// Indices into `positions`, with linear probing; its length is a power of two.
    slots: Vec<u32>,
    /// Chosen at random, so that no file can make the table slow. The result does not depend on it.
    seed: u64,
    pub positions: Vec<Vec3>,
}

impl Welder {
    /// Bytes of memory per position at most, while the table grows.
    pub const BYTES: usize = size_of::<[Vec3; 2]>() + 6 * size_of::<u32>();

    pub fn new() -> Self {
        Self {
            slots: vec![EMPTY; 64],
            seed: RandomState::new().build_hasher().finish(),
            positions: Vec::new(),
        }
    }

    /// The index of `position`, which is added if it is new. -0 equals 0.
    pub fn index(&mut self, position: Vec3) -> u32 {
        // Adding 0 turns -0 into 0.
        let position = position + Vec3::ZERO;
        if 2 * self.positions.len() >= self.slots.len() {
            self.grow();
        }
        let mut at = self.place(position);
        loop {
            match self.slots[at] {
                EMPTY => {
                    self.slots[at] = self.positions.len() as u32;
                    self.positions.push(position);
                    return self.slots[at];
                }
                known if self.positions[known as usize] == position => return known,
                _ => at = (at + 1) & (self.slots.len() - 1),
            }
        }
    }

    /// The first slot to look at.
    fn place(&self, position: Vec3) -> usize {
        let bits = position.to_array().map(f32::to_bits);
        xxh3_64_with_seed(bytemuck::bytes_of(&bits), self.seed) as usize & (self.slots.len() - 1)
    }

    fn grow(&mut self) {
        self.slots = vec![EMPTY; 2 * self.slots.len()];
        for index in 0..self.positions.len() {
            let mut at = self.place(self.positions[index]);
            while self.slots[at] != EMPTY {
                at = (at + 1) & (self.slots.len() - 1);
            }
            self.slots[at] = index as u32;
        }
    }
}
