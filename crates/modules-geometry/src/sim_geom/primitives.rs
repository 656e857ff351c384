//! Distances between boxes, triangles, segments and points, and points in other frames.

use api_macro::api;
use geometry::pose::euler::rotation_from_euler;
use geometry::pose::multiply_vector;
use geometry::{Finite, Pose};
use nalgebra::{Point3, Vector3};
use proximity::primitive::{
    Pair, SolidBox, Triangle, closest_on_segment, closest_on_segments, closest_on_triangle,
    closest_on_triangles,
};

use super::{ApiError, ApiFn, Cx, Result, functions, invalid_data, points, pose, sum};

pub(super) const FUNCTIONS: &[ApiFn] = functions![
    get_box_box_distance,
    get_box_triangle_distance,
    get_box_segment_distance,
    get_box_point_distance,
    get_triangle_triangle_distance,
    get_triangle_segment_distance,
    get_triangle_point_distance,
    get_segment_segment_distance,
    get_segment_point_distance,
    get_transformed_points,
];

type Point = [f64; 3];

/// The corners of the faces of a box, by the signs of their coordinates; two triangles each.
const FACES: [[[f64; 3]; 4]; 6] = [
    [
        [-1., -1., -1.],
        [-1., 1., -1.],
        [1., 1., -1.],
        [1., -1., -1.],
    ],
    [[-1., -1., 1.], [1., -1., 1.], [1., 1., 1.], [-1., 1., 1.]],
    [
        [-1., -1., -1.],
        [1., -1., -1.],
        [1., -1., 1.],
        [-1., -1., 1.],
    ],
    [[-1., 1., -1.], [-1., 1., 1.], [1., 1., 1.], [1., 1., -1.]],
    [
        [-1., -1., -1.],
        [-1., -1., 1.],
        [-1., 1., 1.],
        [-1., 1., -1.],
    ],
    [[1., -1., -1.], [1., 1., -1.], [1., 1., 1.], [1., -1., 1.]],
];

/// A box in the world, solid or only its surface.
struct Cuboid {
    pose: Pose,
    half: Vector3<f64>,
    solid: bool,
}

impl Cuboid {
    fn new(position: Point, quaternion: [f64; 4], half: Point, solid: bool) -> Result<Self> {
        let half = Vector3::from(half.finite().ok_or_else(invalid_data)?).abs();
        Ok(Self {
            pose: pose(position, quaternion)?,
            half,
            solid,
        })
    }

    fn filled(&self) -> SolidBox {
        SolidBox {
            centre: Vector3::zeros(),
            half: self.half,
        }
    }

    /// The triangles of the surface, in the frame of the box.
    fn faces(&self) -> impl Iterator<Item = Triangle> {
        let half = self.half;
        FACES.into_iter().flat_map(move |face| {
            let [a, b, c, d] = face.map(|signs| Vector3::from(signs).component_mul(&half));
            [[a, b, c], [a, c, d]]
        })
    }

    fn local(&self, p: &Vector3<f64>) -> Vector3<f64> {
        self.pose.inverse_transform_point(&Point3::from(*p)).coords
    }

    fn world(&self, p: Vector3<f64>) -> Vector3<f64> {
        self.pose.transform_point(&Point3::from(p)).coords
    }

    /// To a triangle of the world; one without area is a segment or a point.
    fn closest(&self, triangle: &Triangle) -> Pair {
        let triangle = triangle.map(|p| self.local(&p));
        let found = if self.solid {
            self.filled().closest_to_triangle(&triangle)
        } else {
            nearest(
                self.faces()
                    .map(|face| closest_on_triangles(&face, &triangle)),
            )
        };
        (self.world(found.0), self.world(found.1), found.2)
    }

    fn closest_to_box(&self, other: &Self) -> Pair {
        if self.solid {
            let (p, q, squared) = self
                .filled()
                .closest_to_box(&other.filled(), &self.pose.inv_mul(&other.pose));
            return (self.world(p), self.world(q), squared);
        }
        nearest(
            other
                .faces()
                .map(|face| self.closest(&face.map(|p| other.world(p)))),
        )
    }
}

/// The pair with the smallest distance.
fn nearest(pairs: impl Iterator<Item = Pair>) -> Pair {
    let none = (Vector3::zeros(), Vector3::zeros(), f64::INFINITY);
    pairs.fold(none, |best, pair| if pair.2 < best.2 { pair } else { best })
}

fn triangle(p: Point, v: Point, w: Point) -> Result<Triangle> {
    let corners = [p, sum(p, v), sum(p, w)];
    let finite = corners.iter().all(geometry::Finite::is_finite);
    if finite {
        Ok(corners.map(Vector3::from))
    } else {
        Err(invalid_data())
    }
}

fn segment(end: Point, vector: Point) -> Result<[Vector3<f64>; 2]> {
    let [a, b, _] = triangle(end, vector, vector)?;
    Ok([a, b])
}

fn finite(point: Point) -> Result<Vector3<f64>> {
    point.finite().map(Vector3::from).ok_or_else(invalid_data)
}

fn results((p, q, squared): Pair) -> (f64, Point, Point) {
    (squared.sqrt(), p.into(), q.into())
}

/// Distance of the point where it is closest, and that place.
fn result_of_point(on: Vector3<f64>, point: Vector3<f64>) -> (f64, Point) {
    ((point - on).norm(), on.into())
}

/// Distance between two boxes.
///
/// @param box1Pos the middle of the first one
/// @param box1Quaternion how it is turned
/// @param box1HalfSize half of its extents, metres
/// @param box2Pos the middle of the second one
/// @param box2Quaternion how it is turned
/// @param box2HalfSize half of its extents, metres
/// @param boxesAreSolid whether the inside belongs to the boxes, and not only the surface
/// @param altRoutine without effect
/// @return dist metres
/// @return distSegPt1 on the first box
/// @return distSegPt2 on the second box
#[api("simGeom.getBoxBoxDistance")]
#[expect(clippy::too_many_arguments, reason = "the reference has them")]
fn get_box_box_distance(
    _cx: &Cx,
    box1_pos: Point,
    box1_quaternion: [f64; 4],
    box1_half_size: Point,
    box2_pos: Point,
    box2_quaternion: [f64; 4],
    box2_half_size: Point,
    boxes_are_solid: bool,
    #[default(false)] alt_routine: bool,
) -> Result<(f64, [f64; 3], [f64; 3])> {
    let _ = alt_routine;
    let first = Cuboid::new(box1_pos, box1_quaternion, box1_half_size, boxes_are_solid)?;
    let second = Cuboid::new(box2_pos, box2_quaternion, box2_half_size, boxes_are_solid)?;
    Ok(results(first.closest_to_box(&second)))
}

/// Distance between a box and a triangle.
///
/// @param boxPos the middle of the box
/// @param boxQuaternion how it is turned
/// @param boxHalfSize half of its extents, metres
/// @param boxIsSolid whether the inside belongs to the box, and not only the surface
/// @param p a corner of the triangle
/// @param v the edge vector to the second corner
/// @param w the edge vector to the third corner
/// @param altRoutine without effect
/// @return dist metres
/// @return distSegPt1 on the box
/// @return distSegPt2 on the triangle
#[api("simGeom.getBoxTriangleDistance")]
#[expect(clippy::too_many_arguments, reason = "the reference has them")]
fn get_box_triangle_distance(
    _cx: &Cx,
    box_pos: Point,
    box_quaternion: [f64; 4],
    box_half_size: Point,
    box_is_solid: bool,
    p: Point,
    v: Point,
    w: Point,
    #[default(false)] alt_routine: bool,
) -> Result<(f64, [f64; 3], [f64; 3])> {
    let _ = alt_routine;
    let cuboid = Cuboid::new(box_pos, box_quaternion, box_half_size, box_is_solid)?;
    Ok(results(cuboid.closest(&triangle(p, v, w)?)))
}

/// Distance between a box and a segment.
///
/// @param boxPos the middle of the box
/// @param boxQuaternion how it is turned
/// @param boxHalfSize half of its extents, metres
/// @param boxIsSolid whether the inside belongs to the box, and not only the surface
/// @param segmentEndPoint an end of the segment
/// @param segmentVector from there to the other end
/// @param altRoutine without effect
/// @return dist metres
/// @return distSegPt1 on the box
/// @return distSegPt2 on the segment
#[api("simGeom.getBoxSegmentDistance")]
#[expect(clippy::too_many_arguments, reason = "the reference has them")]
fn get_box_segment_distance(
    _cx: &Cx,
    box_pos: Point,
    box_quaternion: [f64; 4],
    box_half_size: Point,
    box_is_solid: bool,
    segment_end_point: Point,
    segment_vector: Point,
    #[default(false)] alt_routine: bool,
) -> Result<(f64, [f64; 3], [f64; 3])> {
    let _ = alt_routine;
    let cuboid = Cuboid::new(box_pos, box_quaternion, box_half_size, box_is_solid)?;
    let [a, b] = segment(segment_end_point, segment_vector)?;
    Ok(results(cuboid.closest(&[a, b, b])))
}

/// Distance between a box and a point.
///
/// @param boxPos the middle of the box
/// @param boxQuaternion how it is turned
/// @param boxHalfSize half of its extents, metres
/// @param boxIsSolid whether the inside belongs to the box, and not only the surface
/// @param point the point
/// @return dist metres
/// @return distSegPt on the box
#[api("simGeom.getBoxPointDistance")]
fn get_box_point_distance(
    _cx: &Cx,
    box_pos: Point,
    box_quaternion: [f64; 4],
    box_half_size: Point,
    box_is_solid: bool,
    point: Point,
) -> Result<(f64, [f64; 3])> {
    let cuboid = Cuboid::new(box_pos, box_quaternion, box_half_size, box_is_solid)?;
    let point = finite(point)?;
    let local = cuboid.local(&point);
    let on = if box_is_solid {
        cuboid.filled().closest_to_point(&local)
    } else {
        nearest(cuboid.faces().map(|face| {
            let on = closest_on_triangle(&local, &face);
            (on, local, (on - local).norm_squared())
        }))
        .0
    };
    Ok(result_of_point(cuboid.world(on), point))
}

/// Distance between two triangles.
///
/// @param p1 a corner of the first triangle
/// @param v1 the edge vector to the second corner
/// @param w1 the edge vector to the third corner
/// @param p2 a corner of the second triangle
/// @param v2 the edge vector to the second corner
/// @param w2 the edge vector to the third corner
/// @return dist metres
/// @return distSegPt1 on the first triangle
/// @return distSegPt2 on the second triangle
#[api("simGeom.getTriangleTriangleDistance")]
fn get_triangle_triangle_distance(
    _cx: &Cx,
    p1: Point,
    v1: Point,
    w1: Point,
    p2: Point,
    v2: Point,
    w2: Point,
) -> Result<(f64, [f64; 3], [f64; 3])> {
    Ok(results(closest_on_triangles(
        &triangle(p1, v1, w1)?,
        &triangle(p2, v2, w2)?,
    )))
}

/// Distance between a triangle and a segment.
///
/// @param p a corner of the triangle
/// @param v the edge vector to the second corner
/// @param w the edge vector to the third corner
/// @param segmentEndPoint an end of the segment
/// @param segmentVector from there to the other end
/// @return dist metres
/// @return distSegPt1 on the triangle
/// @return distSegPt2 on the segment
#[api("simGeom.getTriangleSegmentDistance")]
fn get_triangle_segment_distance(
    _cx: &Cx,
    p: Point,
    v: Point,
    w: Point,
    segment_end_point: Point,
    segment_vector: Point,
) -> Result<(f64, [f64; 3], [f64; 3])> {
    let [a, b] = segment(segment_end_point, segment_vector)?;
    Ok(results(closest_on_triangles(
        &triangle(p, v, w)?,
        &[a, b, b],
    )))
}

/// Distance between a triangle and a point.
///
/// @param p a corner of the triangle
/// @param v the edge vector to the second corner
/// @param w the edge vector to the third corner
/// @param point the point
/// @return dist metres
/// @return distSegPt on the triangle
#[api("simGeom.getTrianglePointDistance")]
fn get_triangle_point_distance(
    _cx: &Cx,
    p: Point,
    v: Point,
    w: Point,
    point: Point,
) -> Result<(f64, [f64; 3])> {
    let point = finite(point)?;
    Ok(result_of_point(
        closest_on_triangle(&point, &triangle(p, v, w)?),
        point,
    ))
}

/// Distance between two segments.
///
/// @param segment1EndPoint an end of the first segment
/// @param segment1Vector from there to the other end
/// @param segment2EndPoint an end of the second segment
/// @param segment2Vector from there to the other end
/// @return dist metres
/// @return distSegPt1 on the first segment
/// @return distSegPt2 on the second segment
#[api("simGeom.getSegmentSegmentDistance")]
fn get_segment_segment_distance(
    _cx: &Cx,
    segment1_end_point: Point,
    segment1_vector: Point,
    segment2_end_point: Point,
    segment2_vector: Point,
) -> Result<(f64, [f64; 3], [f64; 3])> {
    let [a, b] = segment(segment1_end_point, segment1_vector)?;
    let [c, d] = segment(segment2_end_point, segment2_vector)?;
    Ok(results(closest_on_segments([&a, &b], [&c, &d])))
}

/// Distance between a segment and a point.
///
/// @param segmentEndPoint an end of the segment
/// @param segmentVector from there to the other end
/// @param point the point
/// @return dist metres
/// @return distSegPt on the segment
#[api("simGeom.getSegmentPointDistance")]
fn get_segment_point_distance(
    _cx: &Cx,
    segment_end_point: Point,
    segment_vector: Point,
    point: Point,
) -> Result<(f64, [f64; 3])> {
    let ([a, b], point) = (segment(segment_end_point, segment_vector)?, finite(point)?);
    Ok(result_of_point(closest_on_segment(&point, &a, &b), point))
}

/// Points in another frame.
///
/// @param points three coordinates each
/// @param transformation a matrix of 12 numbers, row by row, or a position
/// @param rotation with a position: a quaternion, or Euler angles
/// @return transformedPoints three coordinates each
#[api("simGeom.getTransformedPoints")]
fn get_transformed_points(
    _cx: &Cx,
    points: Vec<f64>,
    transformation: Vec<f64>,
    rotation: Option<Vec<f64>>,
) -> Result<Vec<f64>> {
    let flat = self::points(&points)?.as_flattened();
    let position: Point = match transformation[..] {
        [_, _, _, _, _, _, _, _, _, _, _, _, ..] => {
            return multiply_vector(&transformation[..12], flat).map_err(|_| ApiError::TableSize);
        }
        [x, y, z, ..] => [x, y, z],
        _ => return Err(ApiError::TableSize),
    };
    let pose = match rotation.as_deref() {
        Some([x, y, z, w, ..]) => pose(position, [*x, *y, *z, *w])?,
        Some([a, b, g]) => Pose::from_parts(
            finite(position)?.into(),
            rotation_from_euler(&finite([*a, *b, *g])?.into()),
        ),
        Some(_) => return Err(ApiError::TableSize),
        None => return Err(ApiError::MoreArguments),
    };
    Ok(flat
        .as_chunks()
        .0
        .iter()
        .flat_map(|p: &Point| <Point>::from(pose * Point3::from(*p)))
        .collect())
}
