//! Vertices of the same position become one.

/// Merges vertices whose coordinates are equal; the first of them stays, in the old order.
pub(crate) fn weld(vertices: &mut Vec<[f64; 3]>, triangles: &mut [[u32; 3]]) {
    let mut table = Table::default();
    let new_index: Vec<u32> = vertices.iter().map(|vertex| table.index(*vertex)).collect();
    for index in triangles.as_flattened_mut() {
        *index = new_index[numbers::place(*index)];
    }
    *vertices = table.seen;
}

/// A hash table of indices with linear probing. Its order is never looked at. It grows, since few of many vertices are different: a small
/// table stays in the processor's cache.
pub(crate) struct Table<const N: usize> {
    slots: Vec<u32>,
    pub(crate) seen: Vec<[f64; N]>,
}

const FREE: u32 = u32::MAX;

impl<const N: usize> Default for Table<N> {
    fn default() -> Self {
        Self {
            slots: vec![FREE; 64],
            seen: Vec::new(),
        }
    }
}

impl<const N: usize> Table<N> {
    /// The index of a vertex among those that were seen; a new one is added.
    pub(crate) fn index(&mut self, vertex: [f64; N]) -> u32 {
        // -0 becomes 0: they are equal, their bits are not.
        let vertex = vertex.map(|x| x + 0.0);
        let slot = self.find(vertex);
        if self.slots[slot] != FREE {
            return self.slots[slot];
        }
        let index = numbers::count_u32(self.seen.len());
        self.slots[slot] = index;
        self.seen.push(vertex);
        if 2 * self.seen.len() > self.slots.len() {
            self.grow();
        }
        index
    }

    /// The slot of a vertex, or the free one where it belongs.
    #[expect(
        clippy::cast_possible_truncation,
        reason = "a hash of which only the lowest bits count"
    )]
    fn find(&self, vertex: [f64; N]) -> usize {
        let last = self.slots.len() - 1;
        let mut slot = hash(vertex) as usize & last;
        while self.slots[slot] != FREE && self.seen[numbers::place(self.slots[slot])] != vertex {
            slot = (slot + 1) & last;
        }
        slot
    }

    fn grow(&mut self) {
        self.slots = vec![FREE; 4 * self.slots.len()];
        for index in 0..self.seen.len() {
            let slot = self.find(self.seen[index]);
            self.slots[slot] = numbers::count_u32(index);
        }
    }
}

/// Multiplications and shifts after Steele, Lea and Flood, Fast Splittable Pseudorandom Number Generators (2014).
fn hash<const N: usize>(vertex: [f64; N]) -> u64 {
    vertex.iter().fold(0x9e37_79b9_7f4a_7c15_u64, |hash, x| {
        let mixed = (hash ^ x.to_bits()).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        let mixed = (mixed ^ (mixed >> 29)).wrapping_mul(0x94d0_49bb_1331_11eb);
        mixed ^ (mixed >> 32)
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn equal_positions_become_one_vertex_zero_of_either_sign_too() {
        let mut vertices = vec![
            [0.0, 1.0, 2.0],
            [5.0, 0.0, 0.0],
            [-0.0, 1.0, 2.0],
            [5.0, 0.0, 1e-300],
        ];
        let mut triangles = [[0, 1, 2], [3, 2, 1]];
        weld(&mut vertices, &mut triangles);
        assert_eq!(
            vertices,
            [[0.0, 1.0, 2.0], [5.0, 0.0, 0.0], [5.0, 0.0, 1e-300]]
        );
        assert_eq!(triangles, [[0, 1, 0], [2, 0, 1]]);
    }
}
