//! Convex hulls as bytes, to be kept in a file.
//!
//! All numbers are little-endian: the number of hulls (4 bytes); then for each its numbers of points and of triangles (4 each), the points
//! (3 times 8) and the triangles (3 times 4).
//!
//! A file may have been written by anyone: what is read is a list of closed, convex surfaces, or nothing.

use nalgebra::Vector3;

/// The surface of a convex piece.
#[derive(Debug, Clone, PartialEq, Default)]
pub(super) struct Hull {
    /// Metres.
    pub points: Vec<[f64; 3]>,
    /// Indices into `points`, counter-clockwise seen from outside.
    pub triangles: Vec<[u32; 3]>,
}

/// Volume by which two triangles beside each other may be less than convex, as a part of the cube around the origin with the hull in it: hulls
/// are computed with rounding errors, which turn the normals of narrow triangles.
const MAX_DENT: f64 = 1e-12;

pub(super) fn encode(hulls: &[Hull]) -> Vec<u8> {
    let mut bytes = (hulls.len() as u32).to_le_bytes().to_vec();
    for hull in hulls {
        bytes.extend((hull.points.len() as u32).to_le_bytes());
        bytes.extend((hull.triangles.len() as u32).to_le_bytes());
        let numbers = hull.points.iter().flatten();
        bytes.extend(numbers.flat_map(|number| number.to_le_bytes()));
        let indices = hull.triangles.iter().flatten();
        bytes.extend(indices.flat_map(|index| index.to_le_bytes()));
    }
    bytes
}

/// None where the bytes are no list of hulls, or one of them is not convex.
pub(super) fn decode(mut bytes: &[u8]) -> Option<Vec<Hull>> {
    let mut hulls = Vec::new();
    for _ in 0..count(&mut bytes)? {
        hulls.push(hull(&mut bytes).filter(Hull::is_convex)?);
    }
    bytes.is_empty().then_some(hulls)
}

fn hull(bytes: &mut &[u8]) -> Option<Hull> {
    let counts = [count(bytes)?, count(bytes)?];
    Some(Hull {
        points: triples(bytes, counts[0], f64::from_le_bytes)?,
        triangles: triples(bytes, counts[1], u32::from_le_bytes)?,
    })
}

fn count(bytes: &mut &[u8]) -> Option<usize> {
    let (first, rest) = bytes.split_first_chunk()?;
    *bytes = rest;
    usize::try_from(u32::from_le_bytes(*first)).ok()
}

/// So many times three numbers of `N` bytes. Memory is only taken for what is there.
fn triples<T, const N: usize>(
    bytes: &mut &[u8],
    count: usize,
    number: fn([u8; N]) -> T,
) -> Option<Vec<[T; 3]>> {
    let (all, rest) = bytes.split_at_checked(count.checked_mul(3 * N)?)?;
    *bytes = rest;
    let numbers = all.as_chunks::<N>().0.as_chunks::<3>().0;
    Some(numbers.iter().map(|three| three.map(number)).collect())
}

impl Hull {
    /// Whether the triangles are one closed surface, on which all edges are convex.
    fn is_convex(&self) -> bool {
        let numbers = || self.points.iter().flatten().copied();
        let Some(edges) = Edges::of(self).filter(|_| numbers().all(f64::is_finite)) else {
            return false;
        };
        // Euler's formula; each edge is here in both directions.
        let is_sphere = self.points.len() + self.triangles.len() == edges.all.len() / 2 + 2;
        let limit = MAX_DENT * numbers().map(f64::abs).fold(0.0, f64::max).powi(3);
        let is_convex = |&triangle: &[u32; 3]| {
            let [a, b, c] = triangle;
            let beyond = [[b, a], [c, b], [a, c]].map(|back| edges.corner(back));
            let rises =
                |point: Option<u32>| point.is_none_or(|point| self.volume(point, triangle) > limit);
            !beyond.into_iter().any(rises)
        };
        is_sphere && self.triangles.iter().all(is_convex)
    }

    /// Six times the volume between a triangle and a point in front of it, cubic metres; negative behind it.
    fn volume(&self, point: u32, triangle: [u32; 3]) -> f64 {
        let at = |index: u32| Vector3::from(self.points[index as usize]);
        let [a, b, c] = triangle.map(at);
        (b - a).cross(&(c - a)).dot(&(at(point) - a))
    }
}

/// The directed edges of triangles.
struct Edges {
    /// Where the edges from each point begin in `all`, and where those of the last one end.
    starts: Vec<usize>,
    /// Where an edge leads, and the third corner of its triangle; rising among those from one point.
    all: Vec<(u32, u32)>,
}

impl Edges {
    /// None where an edge occurs twice or has no length, or a corner does not exist.
    fn of(hull: &Hull) -> Option<Self> {
        let edges = || {
            hull.triangles
                .iter()
                .flat_map(|&[a, b, c]| [[a, b, c], [b, c, a], [c, a, b]])
        };
        let mut starts = vec![0; hull.points.len() + 1];
        for [from, to, _] in edges() {
            *starts.get_mut(from as usize + 1).filter(|_| from != to)? += 1;
        }
        for point in 1..starts.len() {
            starts[point] += starts[point - 1];
        }
        let mut ends = starts.clone();
        let mut all = vec![(0, 0); 3 * hull.triangles.len()];
        for [from, to, corner] in edges() {
            let end = &mut ends[from as usize];
            all[*end] = (to, corner);
            *end += 1;
        }
        let are_different = starts.windows(2).all(|ends| {
            let from_one = &mut all[ends[0]..ends[1]];
            from_one.sort_unstable();
            from_one.windows(2).all(|two| two[0].0 != two[1].0)
        });
        are_different.then_some(Self { starts, all })
    }

    /// The third corner of the triangle at an edge, if there is one.
    fn corner(&self, [from, to]: [u32; 2]) -> Option<u32> {
        let from = from as usize;
        let edges = &self.all[self.starts[from]..self.starts[from + 1]];
        let place = edges.binary_search_by_key(&to, |(to, _)| *to).ok()?;
        Some(edges[place].1)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn tetrahedron() -> Hull {
        Hull {
            points: vec![[0.0; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]],
            triangles: vec![[0, 2, 1], [0, 1, 3], [0, 3, 2], [1, 2, 3]],
        }
    }

    fn is_read(change: impl FnOnce(&mut Hull)) -> bool {
        let mut hull = tetrahedron();
        change(&mut hull);
        decode(&encode(&[hull])).is_some()
    }

    #[test]
    fn what_is_written_is_read() {
        for hulls in [vec![], vec![tetrahedron()], vec![tetrahedron(); 3]] {
            assert_eq!(decode(&encode(&hulls)), Some(hulls));
        }
    }

    #[test]
    fn incomplete_bytes_are_nothing() {
        let bytes = encode(&vec![tetrahedron(); 2]);
        for length in 0..bytes.len() {
            assert_eq!(decode(&bytes[..length]), None, "{length}");
        }
        assert_eq!(decode(&[&bytes[..], &[0]].concat()), None);
    }

    #[test]
    fn large_counts_take_no_memory() {
        for counts in [[u32::MAX, 0, 0], [1, u32::MAX, 1], [1, 1, u32::MAX]] {
            let bytes: Vec<u8> = counts
                .iter()
                .flat_map(|count| count.to_le_bytes())
                .collect();
            assert_eq!(decode(&bytes), None);
        }
    }

    #[test]
    fn only_closed_convex_surfaces_are_read() {
        assert!(is_read(|_| ()));
        assert!(
            !is_read(|hull| hull.triangles[0][0] = 4),
            "a corner that is not there"
        );
        assert!(
            !is_read(|hull| hull.triangles[0] = [0, 2, 2]),
            "an edge without length"
        );
        assert!(!is_read(|hull| hull.triangles.truncate(3)), "an opening");
        assert!(!is_read(|hull| hull.triangles.clear()), "no surface");
        assert!(
            !is_read(|hull| hull.triangles[0].swap(0, 1)),
            "a face inside out"
        );
        assert!(
            !is_read(|hull| hull.triangles.push([0, 2, 1])),
            "a face twice"
        );
        assert!(
            !is_read(|hull| hull.points.push([2.0; 3])),
            "a point without faces"
        );
        assert!(
            !is_read(|hull| hull.points[3] = [0.0, 0.0, -1.0]),
            "faces inside out"
        );
        assert!(!is_read(|hull| hull.points[3][0] = f64::NAN), "no number");
        assert!(
            !is_read(|hull| hull.points[3][0] = f64::INFINITY),
            "no number"
        );
    }

    #[test]
    fn two_hulls_are_not_one() {
        let mut both = tetrahedron();
        both.points.extend(tetrahedron().points);
        let further = tetrahedron().triangles.into_iter();
        both.triangles
            .extend(further.map(|triangle| triangle.map(|corner| corner + 4)));
        assert_eq!(decode(&encode(&[both])), None);
    }

    #[test]
    fn a_dent_is_noticed() {
        let mut dented = tetrahedron();
        // The slanted face becomes three, around a point that lies further in.
        dented.triangles.pop();
        dented.points.push([0.2; 3]);
        dented.triangles.extend([[1, 2, 4], [2, 3, 4], [3, 1, 4]]);
        assert_eq!(decode(&encode(std::slice::from_ref(&dented))), None);
        dented.points[4] = [0.5; 3];
        assert!(decode(&encode(&[dented])).is_some());
    }

    #[test]
    fn dents_are_noticed_wherever_a_hull_is() {
        // A square and two points before and behind it, which lies at 1 / 2 / 3.
        let octahedron = |inside: bool| {
            let top = if inside { 2.5 } else { 4.0 };
            let points = [
                [0.0, 2.0, 3.0],
                [1.0, 1.0, 3.0],
                [2.0, 2.0, 3.0],
                [1.0, 3.0, 3.0],
            ];
            let poles = [[1.0, 2.0, top], [1.0, 2.0, 2.0]];
            let around = [[0, 1], [1, 2], [2, 3], [3, 0]];
            Hull {
                points: points.into_iter().chain(poles).collect(),
                triangles: around
                    .into_iter()
                    .flat_map(|[a, b]| [[a, b, 4], [b, a, 5]])
                    .collect(),
            }
        };
        let whole = octahedron(false);
        assert_eq!(
            decode(&encode(std::slice::from_ref(&whole))),
            Some(vec![whole])
        );
        assert_eq!(decode(&encode(&[octahedron(true)])), None);
    }
}
