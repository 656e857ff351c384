//! Which points of a pair of colliders are solved: more than a few of one surface share the load in many ways, which takes time and changes nothing.

use super::points::Point;

/// Largest number of contact points of one surface that are solved.
const MAX_GROUP_POINTS: usize = 4;
/// Cosine of the largest angle between the normals of points of one surface.
const MIN_NORMAL_COSINE: f64 = 0.99;
/// How far a point may be from a line of two others, metres, and the least length of such a line.
const LINE_TOLERANCE: f64 = 1e-7;
const MIN_LINE_LENGTH: f64 = 1e-4;

impl Point {
    /// Whether the point is on the line between two others, and not deeper than the surfaces are there by these.
    fn is_between(&self, first: &Self, last: &Self) -> bool {
        let (way, here) = (last.place() - first.place(), self.place() - first.place());
        let length = way.length();
        if length < MIN_LINE_LENGTH {
            return false;
        }
        let share = here.dot(way) / (length * length);
        let [here_distance, from, to] = [self, first, last].map(|point| point.contact.distance);
        (0.0..=1.0).contains(&share)
            && (here - way * share).length() < LINE_TOLERANCE
            && here_distance > from + (to - from) * share - LINE_TOLERANCE
    }
}

/// Removes those of the points from `first` on, which are of one manifold, that lie between two others on a line, as under a cylinder that lies: these two bear all that
/// it could.
pub(super) fn remove_middles(points: &mut Vec<Point>, first: usize) {
    let mut place = first;
    while place < points.len() && points.len() > first + 2 {
        let ends = || (first..points.len()).filter(|&end| end != place);
        let is_between =
            |from: usize, to: usize| points[place].is_between(&points[from], &points[to]);
        if ends().any(|from| ends().any(|to| is_between(from, to))) {
            points.remove(place);
        } else {
            place += 1;
        }
    }
}

/// At most four points of each surface: the deepest, and those that span the largest area with it.
pub(super) fn spread(points: Vec<Point>) -> Vec<Point> {
    if points.len() <= MAX_GROUP_POINTS {
        return points;
    }
    let mut groups: Vec<Vec<Point>> = Vec::new();
    for point in points {
        let group = groups
            .iter_mut()
            .find(|group| group[0].normal.dot(point.normal) > MIN_NORMAL_COSINE);
        match group {
            Some(group) => group.push(point),
            None => groups.push(vec![point]),
        }
    }
    groups.into_iter().flat_map(corners).collect()
}

fn corners(group: Vec<Point>) -> Vec<Point> {
    if group.len() <= MAX_GROUP_POINTS {
        return group;
    }
    let at = |index: usize| group[index].place();
    let best = |score: &dyn Fn(usize) -> f64| {
        (0..group.len()).fold(0, |best, index| {
            if score(index) > score(best) {
                index
            } else {
                best
            }
        })
    };
    let deepest = best(&|index| -group[index].contact.distance);
    let farthest = best(&|index| (at(index) - at(deepest)).length());
    let across = (at(farthest) - at(deepest)).cross(group[0].normal);
    let left = best(&|index| (at(index) - at(deepest)).dot(across));
    let right = best(&|index| (at(deepest) - at(index)).dot(across));
    let chosen = [deepest, farthest, left, right];
    group
        .into_iter()
        .enumerate()
        .filter(|(index, _)| chosen.contains(index))
        .map(|(_, point)| point)
        .collect()
}

#[cfg(test)]
mod tests {
    use rapier3d_f64::math::Vector;

    use super::*;

    /// Points along x, at these places and distances between the surfaces.
    fn along_x(points: &[[f64; 2]]) -> Vec<Point> {
        points
            .iter()
            .map(|&[x, distance]| Point::on_floor(Vector::new(x, 0.0, 0.0), distance))
            .collect()
    }

    #[test]
    fn points_between_two_others_go_unless_they_are_deeper() {
        let left = |points: &[[f64; 2]]| {
            let mut left = along_x(&[[7.0, 0.0], [0.0, 0.0]]);
            left.extend(along_x(points));
            remove_middles(&mut left, 2);
            left[2..]
                .iter()
                .map(|point| point.place().x)
                .collect::<Vec<_>>()
        };
        assert_eq!(left(&[[0.0, 0.0], [0.5, 0.0], [1.0, 0.0]]), [0.0, 1.0]);
        assert_eq!(left(&[[0.5, 0.0], [0.0, 0.0], [1.0, 0.0]]), [0.0, 1.0]);
        // Where two surfaces are inclined, and where one is curved.
        assert_eq!(left(&[[0.0, 0.0], [0.5, 0.001], [1.0, 0.002]]), [0.0, 1.0]);
        let deeper = [[0.0, 0.0], [0.5, -0.001], [1.0, 0.0]];
        assert_eq!(left(&deeper), [0.0, 0.5, 1.0]);
    }
}
