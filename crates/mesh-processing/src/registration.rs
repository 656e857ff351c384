//! Registration: where points lie in relation to others (P. J. Besl, N. D. McKay: A Method for Registration of 3-D Shapes, 1992).

use nalgebra::{Isometry3, Matrix3, Point3, Rotation3, Translation3, UnitQuaternion, Vector3};

/// Most rounds of one search.
const MAX_ROUNDS: usize = 300;
/// Most points that are looked at in each round: of more, every n-th.
const MAX_POINTS: usize = 5000;
/// The same while starts are compared.
const MAX_COARSE_POINTS: usize = 500;
/// Most rounds from each start while starts are compared.
const MAX_COARSE_ROUNDS: usize = 40;
/// How much better another start must be: as a part of the first result's error.
const MUCH_BETTER: f64 = 0.5;

/// What a search found.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Registration {
    /// Moves the points onto the model.
    pub pose: Isometry3<f64>,
    /// Root mean square of the distances of points that count, from the model.
    pub error: f64,
}

/// Moves points onto a model: iterative closest points, from where the points are, and from where centres and principal axes are the same; the
/// first one unless another is much better.
///
/// `nearest` answers the point of the model nearest to another. With `outliers`, points farther than that from the model do not count, unless there
/// are fewer than three others. None without points, or where the model has none.
pub fn register(
    points: &[[f64; 3]],
    model: &[[f64; 3]],
    nearest: &dyn Fn([f64; 3]) -> Option<[f64; 3]>,
    outliers: Option<f64>,
) -> Option<Registration> {
    if points.is_empty() || model.is_empty() {
        return None;
    }
    let (many, few) = (
        thinned(points, MAX_POINTS),
        thinned(points, MAX_COARSE_POINTS),
    );
    let coarse = |start| search(&few, start, MAX_COARSE_ROUNDS, nearest, outliers);
    let first = coarse(Isometry3::identity())?;
    let others = starts(&many, &thinned(model, MAX_POINTS))
        .into_iter()
        .filter_map(coarse);
    let best = others.fold(first, |best, other| {
        if other.error < best.error {
            other
        } else {
            best
        }
    });
    let first = search(&many, first.pose, MAX_ROUNDS, nearest, outliers)?;
    let best = search(&many, best.pose, MAX_ROUNDS, nearest, outliers)?;
    Some(if best.error < MUCH_BETTER * first.error {
        best
    } else {
        first
    })
}

fn thinned(points: &[[f64; 3]], most: usize) -> Vec<Point3<f64>> {
    points
        .iter()
        .step_by(points.len().div_ceil(most).max(1))
        .map(|point| Point3::from(*point))
        .collect()
}

/// Iterative closest points from a start, until nothing changes any more.
fn search(
    points: &[Point3<f64>],
    start: Isometry3<f64>,
    rounds: usize,
    nearest: &dyn Fn([f64; 3]) -> Option<[f64; 3]>,
    outliers: Option<f64>,
) -> Option<Registration> {
    let mut found = Registration {
        pose: start,
        error: f64::INFINITY,
    };
    for _ in 0..rounds {
        let mut pairs = Vec::with_capacity(points.len());
        for point in points {
            let moved = found.pose * point;
            let on_model = Point3::from(nearest(moved.coords.into())?);
            pairs.push((*point, on_model, (on_model - moved).norm()));
        }
        let inside =
            |pair: &&(Point3<f64>, Point3<f64>, f64)| outliers.is_none_or(|limit| pair.2 <= limit);
        if pairs.iter().filter(inside).count() >= 3 {
            pairs = pairs.iter().filter(inside).copied().collect();
        }
        let pose = alignment(&pairs);
        let squares: f64 = pairs
            .iter()
            .map(|(point, on_model, _)| (pose * point - on_model).norm_squared())
            .sum();
        let error = (squares / numbers::real(pairs.len())).sqrt();
        let is_done = error >= found.error * (1.0 - 1e-6);
        found = Registration { pose, error };
        if is_done || error == 0.0 {
            break;
        }
    }
    Some(found)
}

/// The pose that moves the first points of pairs onto the second ones with the least squares (W. Kabsch 1976).
fn alignment(pairs: &[(Point3<f64>, Point3<f64>, f64)]) -> Isometry3<f64> {
    let count = numbers::real(pairs.len());
    let from = pairs
        .iter()
        .map(|(point, ..)| point.coords)
        .sum::<Vector3<f64>>()
        / count;
    let to = pairs
        .iter()
        .map(|(_, point, _)| point.coords)
        .sum::<Vector3<f64>>()
        / count;
    let covariance: Matrix3<f64> = pairs
        .iter()
        .map(|(a, b, _)| (b.coords - to) * (a.coords - from).transpose())
        .sum();
    let svd = covariance.svd(true, true);
    let (Some(u), Some(v)) = (svd.u, svd.v_t) else {
        return Translation3::from(to - from).into();
    };
    // A mirror is no rotation: the least important direction is turned over.
    let sign = (u * v).determinant().signum();
    let rotation = u * Matrix3::from_diagonal(&Vector3::new(1.0, 1.0, sign)) * v;
    let rotation =
        UnitQuaternion::from_rotation_matrix(&Rotation3::from_matrix_unchecked(rotation));
    Isometry3::from_parts(Translation3::from(to - rotation * from), rotation)
}

/// Where centres and principal axes are the same: axes have no sign, and those of equal length no order.
fn starts(points: &[Point3<f64>], model: &[Point3<f64>]) -> Vec<Isometry3<f64>> {
    let ((from, own), (to, theirs)) = (principal_axes(points), principal_axes(model));
    let orders = [
        [0, 1, 2],
        [1, 2, 0],
        [2, 0, 1],
        [0, 2, 1],
        [2, 1, 0],
        [1, 0, 2],
    ];
    let signs = [[1.0, 1.0], [1.0, -1.0], [-1.0, 1.0], [-1.0, -1.0]];
    let turns = orders
        .into_iter()
        .flat_map(|order| signs.map(|sign| (order, sign)));
    let poses = turns.map(|(order, [first, second])| {
        let x = theirs.column(order[0]) * first;
        let y = theirs.column(order[1]) * second;
        let turned = Matrix3::from_columns(&[x, y, x.cross(&y)]);
        let rotation = Rotation3::from_matrix_unchecked(turned * own.transpose());
        let rotation = UnitQuaternion::from_rotation_matrix(&rotation);
        Isometry3::from_parts(Translation3::from(to - rotation * from), rotation)
    });
    poses.collect()
}

/// The centre of points, and their principal axes, the longest first, right-handed.
fn principal_axes(points: &[Point3<f64>]) -> (Vector3<f64>, Matrix3<f64>) {
    let centre = points
        .iter()
        .map(|point| point.coords)
        .sum::<Vector3<f64>>()
        / numbers::real(points.len());
    let covariance: Matrix3<f64> = points
        .iter()
        .map(|point| (point.coords - centre) * (point.coords - centre).transpose())
        .sum();
    let eigen = covariance.symmetric_eigen();
    let mut order = [0, 1, 2];
    order.sort_by(|a, b| eigen.eigenvalues[*b].total_cmp(&eigen.eigenvalues[*a]));
    let axis = |k: usize| eigen.eigenvectors.column(order[k]).into_owned();
    let (x, y) = (axis(0), axis(1));
    (centre, Matrix3::from_columns(&[x, y, x.cross(&y)]))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::kd_tree::KdTree;

    /// Points on three sides of a box, which has no symmetry but its own middle.
    fn corner() -> Vec<[f64; 3]> {
        let grid = |n: u32, m: u32| {
            (0..n).flat_map(move |i| (0..m).map(move |j| (f64::from(i) * 0.1, f64::from(j) * 0.1)))
        };
        let floor = grid(10, 6).map(|(x, y)| [x, y, 0.0]);
        let back = grid(10, 4).map(|(x, z)| [x, 0.0, z]);
        let side = grid(6, 4).map(|(y, z)| [0.0, y, z]);
        floor.chain(back).chain(side).collect()
    }

    fn moved(points: &[[f64; 3]], pose: &Isometry3<f64>) -> Vec<[f64; 3]> {
        points
            .iter()
            .map(|point| (pose * Point3::from(*point)).coords.into())
            .collect()
    }

    fn register_points(
        points: &[[f64; 3]],
        model: &[[f64; 3]],
        outliers: Option<f64>,
    ) -> Registration {
        let tree = KdTree::new(model);
        let nearest = |to: [f64; 3]| tree.nearest(to).map(|found| model[found.number as usize]);
        register(points, model, &nearest, outliers).expect("there are points")
    }

    #[test]
    fn finds_any_pose() {
        let model = corner();
        let turns = [
            [0.05, 0.02, -0.03],
            [1.0, 2.0, 3.0],
            [0.0, std::f64::consts::PI, 0.0],
            [-2.0, 0.5, 1.0],
        ];
        for (k, turn) in turns.into_iter().enumerate() {
            let pose = Isometry3::new(Vector3::new(0.02, -0.01, k as f64), Vector3::from(turn));
            let found = register_points(&moved(&model, &pose.inverse()), &model, None);
            assert!(found.error < 1e-9, "{turn:?}: {}", found.error);
            let both = (
                found.pose.rotation.angle_to(&pose.rotation),
                (found.pose.translation.vector - pose.translation.vector).norm(),
            );
            assert!(both.0 < 1e-6 && both.1 < 1e-6, "{turn:?}: {both:?}");
        }
    }

    #[test]
    fn outliers_do_not_count() {
        let model = corner();
        let pose = Isometry3::new(
            Vector3::new(0.02, -0.01, 0.01),
            Vector3::new(0.02, 0.01, 0.03),
        );
        let mut points = moved(&model, &pose.inverse());
        points.extend([[5.0, 5.0, 5.0], [-3.0, 4.0, 4.0]]);
        assert!(register_points(&points, &model, Some(0.2)).error < 1e-9);
        assert!(register_points(&points, &model, None).error > 0.1);
    }

    #[test]
    fn few_points_have_a_pose_too() {
        let found = register_points(&[[1.0, 2.0, 3.0]], &[[4.0, 6.0, 8.0]], None);
        assert!(found.error == 0.0 && found.pose.translation.vector == Vector3::new(3.0, 4.0, 5.0));
        assert_eq!(register(&[], &corner(), &Some, None), None);
    }
}
