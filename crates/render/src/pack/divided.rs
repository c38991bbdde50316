//! The boxes of primitives for a BVH, with large primitives in several pieces. A primitive is stored once; each piece is a
//! leaf that refers to it.

use crate::bvh::Aabb;

/// The boxes of primitives, some of which are divided into pieces of a type that names its primitive.
pub struct Divided<P> {
    /// Boxes of undivided primitives, followed by boxes of pieces.
    pub boxes: Vec<Aabb>,
    /// Pieces, whose primitives are places in [`Self::order`].
    pub pieces: Vec<P>,
    /// The primitives that have a box of their own, and the others, in ascending order.
    whole: Vec<u32>,
    others: Vec<u32>,
}

impl<P> Divided<P> {
    /// No boxes.
    pub const NONE: Self = Self {
        boxes: Vec::new(),
        pieces: Vec::new(),
        whole: Vec::new(),
        others: Vec::new(),
    };

    /// `count` primitives without boxes.
    pub fn apart(count: usize) -> Self {
        Self {
            others: (0..count as u32).collect(),
            ..Self::NONE
        }
    }

    /// `boxes` are those of the primitives, `pieces` all those of one primitive after the other, in ascending order, each in
    /// the box `aabb` and of the primitive `primitive`.
    pub fn new(
        mut boxes: Vec<Aabb>,
        mut pieces: Vec<P>,
        aabb: impl Fn(&P) -> Aabb,
        primitive: impl Fn(&mut P) -> &mut u32,
    ) -> Self {
        let mut others: Vec<_> = pieces.iter_mut().map(|piece| *primitive(piece)).collect();
        others.dedup();
        let mut next = others.iter().peekable();
        let is_whole = |index: &u32| next.next_if_eq(&index).is_none();
        let whole: Vec<_> = (0..boxes.len() as u32).filter(is_whole).collect();
        // The boxes before the first that is divided are in their places.
        let first = others.first().map_or(whole.len(), |it| *it as usize);
        for (place, &index) in whole.iter().enumerate().skip(first) {
            boxes[place] = boxes[index as usize];
        }
        boxes.truncate(whole.len());
        for piece in &mut pieces {
            boxes.push(aabb(piece));
            let own = primitive(piece);
            let place = others.partition_point(|index| index < own);
            *own = (whole.len() + place) as u32;
        }
        Self {
            boxes,
            pieces,
            whole,
            others,
        }
    }

    /// The number of primitives that have a box of their own.
    pub fn whole_count(&self) -> usize {
        self.whole.len()
    }

    /// All primitives: those that have a box of their own in this order of the boxes, then the others.
    pub fn order(&self, boxes: impl IntoIterator<Item = u32>) -> Vec<u32> {
        let whole = (boxes.into_iter()).map(|place| self.whole[place as usize]);
        whole.chain(self.others.iter().copied()).collect()
    }

    /// The piece of a box.
    pub fn piece(&self, place: usize) -> usize {
        place - self.whole.len()
    }
}
