//! Which triangle has an edge, by its direction.

/// The edges of triangles, from each vertex.
pub(super) struct HalfEdges {
    /// Where the edges from each vertex begin in `edges`, and the end.
    starts: Vec<u32>,
    /// The vertex an edge leads to and its triangle; in order, for each vertex.
    edges: Vec<(u32, u32)>,
}

impl HalfEdges {
    /// Of triangles whose corners are below `vertices`.
    pub(super) fn new(vertices: usize, triangles: &[[u32; 3]]) -> Self {
        let mut starts = vec![0_u32; vertices + 1];
        triangles
            .as_flattened()
            .iter()
            .for_each(|from| starts[*from as usize + 1] += 1);
        (1..starts.len()).for_each(|i| starts[i] += starts[i - 1]);
        let mut next = starts.clone();
        let mut edges = vec![(0, 0); 3 * triangles.len()];
        for (number, triangle) in triangles.iter().enumerate() {
            for k in 0..3 {
                let slot = &mut next[triangle[k] as usize];
                edges[*slot as usize] = (triangle[(k + 1) % 3], number as u32);
                *slot += 1;
            }
        }
        starts
            .windows(2)
            .for_each(|range| edges[range[0] as usize..range[1] as usize].sort_unstable());
        Self { starts, edges }
    }

    fn from(&self, vertex: u32) -> &[(u32, u32)] {
        &self.edges
            [self.starts[vertex as usize] as usize..self.starts[vertex as usize + 1] as usize]
    }

    /// The triangle that goes from one vertex to another, the first of several.
    pub(super) fn triangle(&self, from: u32, to: u32) -> Option<u32> {
        let edges = self.from(from);
        let first = edges.partition_point(|(other, _)| *other < to);
        edges
            .get(first)
            .filter(|(other, _)| *other == to)
            .map(|(_, triangle)| *triangle)
    }

    /// Whether no two triangles have the same edge in the same direction.
    pub(super) fn are_distinct(&self) -> bool {
        self.starts.windows(2).all(|range| {
            let edges = &self.edges[range[0] as usize..range[1] as usize];
            edges.windows(2).all(|pair| pair[0].0 != pair[1].0)
        })
    }

    /// Whether each edge is that of two triangles, in opposite directions.
    pub(super) fn are_closed(&self, triangles: &[[u32; 3]]) -> bool {
        let has_twin = |t: &[u32; 3]| (0..3).all(|k| self.triangle(t[(k + 1) % 3], t[k]).is_some());
        self.are_distinct() && triangles.iter().all(has_twin)
    }
}
