//! Paths from before 4.2: converted to the modern form, a dummy with the points as custom data.

use crate::format::ttt::chunks::{Path, PathPoint};
use crate::scene::{CustomData, Data, Edit, Pose};

/// The path leads back to its beginning.
const CLOSED: i32 = 0x2;
/// More points than that for one corner are a mistake of the file.
const MOST_PER_CORNER: i32 = 1000;

/// A control point: where it is, and how its corner is rounded.
struct Corner {
    pose: Pose,
    /// Which parts of the ways to its neighbours are rounded.
    before: f64,
    after: f64,
    /// Of how many points the rounding consists.
    count: usize,
}

/// Adds control points and path: seven numbers per point, as `sim.createPath` makes them.
pub(super) fn fill(data: &mut CustomData, path: &Path) {
    let Some(control) = &path.path else { return };
    let corners: Vec<Corner> = control.points.iter().filter_map(corner).collect();
    let mut points: Vec<Pose> = corners.iter().map(|corner| corner.pose).collect();
    let mut line = rounded(&corners, control.attributes.unwrap_or(0) & CLOSED != 0);
    if control.attributes.unwrap_or(0) & CLOSED != 0 {
        points.extend(points.first().copied());
        line.extend(line.first().copied());
    }
    for (tag, poses) in [("PATHCTRLPTS", points), ("PATH", line)] {
        data.edit(Edit::Tag(tag, Some(Data::Buffer(poses.iter().flat_map(bytes).collect()))));
    }
}

fn corner(point: &PathPoint) -> Option<Corner> {
    let (pose, [before, after], count, _) = point.point.as_ref()?;
    let part = |factor: &f64| if factor.is_finite() { factor.clamp(0.0, 1.0) } else { 0.0 };
    let count = usize::try_from((*count).clamp(1, MOST_PER_CORNER)).ok()?;
    Some(Corner { pose: pose.pose()?, before: part(before), after: part(after), count })
}

/// The points of the path: those of each corner, on a quadratic Bezier curve from the way to it to the way from it.
fn rounded(corners: &[Corner], closed: bool) -> Vec<Pose> {
    let mut line = Vec::new();
    for (at, corner) in corners.iter().enumerate() {
        let neighbours = match (at.checked_sub(1), corners.get(at + 1)) {
            (Some(before), Some(after)) => Some((&corners[before], after)),
            (None, Some(after)) if closed => corners.last().map(|before| (before, after)),
            (Some(before), None) if closed => corners.first().map(|after| (&corners[before], after)),
            _ => None,
        };
        match neighbours.filter(|_| corner.count > 1) {
            Some((before, after)) => line.extend(curve(corner, &before.pose, &after.pose)),
            None => line.push(corner.pose),
        }
    }
    line
}

fn curve(corner: &Corner, before: &Pose, after: &Pose) -> impl Iterator<Item = Pose> {
    let start = between(&corner.pose, before, corner.before);
    let end = between(&corner.pose, after, corner.after);
    let (middle, last) = (corner.pose, (corner.count - 1) as f64);
    (0..corner.count).map(move |i| {
        let t = i as f64 / last;
        between(&between(&start, &middle, t), &between(&middle, &end, t), t)
    })
}

fn between(from: &Pose, to: &Pose, t: f64) -> Pose {
    let translation = from.translation.vector.lerp(&to.translation.vector, t);
    // Quaternions that are opposite have no way between them.
    let rotation = from.rotation.try_slerp(&to.rotation, t, 1e-9).unwrap_or(to.rotation);
    Pose::from_parts(translation.into(), rotation)
}

fn bytes(pose: &Pose) -> impl Iterator<Item = u8> {
    let (p, q) = (pose.translation, pose.rotation);
    [p.x, p.y, p.z, q.i, q.j, q.k, q.w].into_iter().flat_map(f64::to_le_bytes)
}

#[cfg(test)]
mod tests {
    use super::{Corner, rounded};
    use crate::scene::Pose;

    fn at(x: f64, y: f64, count: usize) -> Corner {
        Corner { pose: Pose::translation(x, y, 0.0), before: 0.5, after: 0.5, count }
    }

    fn places(corners: &[Corner], closed: bool) -> Vec<(f64, f64)> {
        rounded(corners, closed).iter().map(|pose| (pose.translation.x, pose.translation.y)).collect()
    }

    #[test]
    fn corners_of_one_point_stay() {
        assert_eq!(places(&[at(0.0, 0.0, 1), at(1.0, 0.0, 1)], false), [(0.0, 0.0), (1.0, 0.0)]);
        assert!(places(&[], true).is_empty());
    }

    #[test]
    fn corners_are_rounded_between_their_neighbours() {
        let corners = [at(0.0, 0.0, 3), at(2.0, 0.0, 3), at(2.0, 2.0, 3)];
        assert_eq!(places(&corners, false), [(0.0, 0.0), (1.0, 0.0), (1.75, 0.25), (2.0, 1.0), (2.0, 2.0)]);
        assert_eq!(places(&corners, true).len(), 9);
    }
}
