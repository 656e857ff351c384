//! Voxelization of objects, by parry's box-triangle tests (spec: sensors 4).

use std::collections::BTreeSet;

use geometry::Mesh;
use nalgebra::{Point3, Vector3};
use parry3d_f64::bounding_volume::Aabb;
use parry3d_f64::math::Vector;
use parry3d_f64::query::PointQuery;
use parry3d_f64::query::details::intersection_test_aabb_triangle;
use parry3d_f64::shape::{TriMesh, Triangle};

use super::octree::OcTree;
use super::point_cloud::PointCloud;
use crate::{Handle, Kind, Pose, Scene, SceneError, SceneResult};

type Point = [f64; 3];
type Cell = [i32; 3];

/// Limit of cells, and of tests to find them, per object: a mistake in a script should not exhaust the machine.
const MAX_CELLS: usize = 2_000_000;
const MAX_TESTS: usize = 40 * MAX_CELLS;
/// Largest distance of a cell from the origin, in cells.
const MAX_DISTANCE: f64 = (1 << 30) as f64;
/// Relative enlargement of cells for tests: geometry on a boundary touches both sides.
const MARGIN: f64 = 1e-9;
/// Relative shrinkage of a voxel when it is inserted into a grid: it does not occupy cells that it only touches.
const INSET: f64 = 1e-6;

/// Cells of a grid with a boundary at the origin, by how many cells they are from it.
struct Grid {
    edge: f64,
    cells: BTreeSet<Cell>,
    tests: usize,
}

impl Grid {
    fn new(edge: f64) -> Self {
        Self {
            edge,
            cells: BTreeSet::new(),
            tests: 0,
        }
    }

    fn centres(&self) -> Vec<Point> {
        self.cells
            .iter()
            .map(|cell| cell.map(|at| (f64::from(at) + 0.5) * self.edge))
            .collect()
    }

    /// The box around cells, with a margin.
    fn around(&self, low: Cell, high: Cell) -> Aabb {
        let corner = |cell: Cell, more: f64| {
            Vector::from_array(cell.map(|at| (f64::from(at) + more) * self.edge))
        };
        Aabb::new(corner(low, -MARGIN), corner(high, 1.0 + MARGIN))
    }

    /// Adds the cells that `touches` says of, among those that a box from `low` to `high` touches.
    fn fill(
        &mut self,
        (low, high): (Point, Point),
        touches: impl Fn(&Aabb) -> bool,
    ) -> SceneResult<()> {
        let within = |c: &f64| c.abs() < MAX_DISTANCE * self.edge;
        if !low.iter().chain(&high).all(within) {
            return Err(SceneError::Refused(
                "the object is too far away for the cells of the grid.".into(),
            ));
        }
        let first = low.map(|c| (c / self.edge - MARGIN).ceil() as i32 - 1);
        let last = high.map(|c| (c / self.edge + MARGIN).floor() as i32);
        let mut pending = vec![(first, last)];
        while let Some((low, high)) = pending.pop() {
            self.tests += 1;
            if self.cells.len() > MAX_CELLS || self.tests > MAX_TESTS {
                return Err(SceneError::Refused(format!(
                    "the object takes more than {MAX_CELLS} cells."
                )));
            }
            if !touches(&self.around(low, high)) {
                continue;
            }
            match halves(low, high) {
                Some(both) => pending.extend(both),
                None => drop(self.cells.insert(low)),
            }
        }
        Ok(())
    }

    /// Adds the cells that the triangles of a mesh touch.
    fn add_surface(&mut self, mesh: &Mesh) -> SceneResult<()> {
        for triangle in &mesh.triangles {
            let corners = mesh.corners(triangle);
            let [a, b, c] = corners.map(|corner| Vector::from_array(corner.into()));
            let triangle = Triangle::new(a, b, c);
            self.fill(extent(&corners), |cells| {
                intersection_test_aabb_triangle(cells, &triangle)
            })?;
        }
        Ok(())
    }

    /// Adds the cells that overlap a cube of that edge, centred in `frame`.
    fn add_cube(&mut self, edge: f64, frame: &Pose) -> SceneResult<()> {
        let half = 0.5 * edge * (1.0 - INSET);
        let turn = frame.rotation.to_rotation_matrix();
        let axes: [Vector3<f64>; 3] =
            std::array::from_fn(|axis| turn.matrix().column(axis).into_owned());
        let reach =
            Vector3::from_fn(|i, _| half * axes.iter().map(|axis| axis[i].abs()).sum::<f64>());
        let centre = frame.translation.vector;
        let around = ((centre - reach).into(), (centre + reach).into());
        self.fill(around, |cells| overlap(&centre, &axes, half, cells))
    }
}

/// Whether a cube overlaps an upright box: no axis of either, or across both, separates them.
fn overlap(centre: &Vector3<f64>, axes: &[Vector3<f64>; 3], half: f64, cells: &Aabb) -> bool {
    let (middle, extents) = (
        Vector3::from(cells.center().to_array()),
        Vector3::from(cells.half_extents().to_array()),
    );
    let upright: [Vector3<f64>; 3] = std::array::from_fn(|axis| Vector3::ith(axis, 1.0));
    let across = upright.iter().flat_map(|a| axes.iter().map(|b| a.cross(b)));
    let meet = |axis: Vector3<f64>| {
        let cube: f64 = axes.iter().map(|own| half * own.dot(&axis).abs()).sum();
        (middle - centre).dot(&axis).abs() <= cube + extents.dot(&axis.abs())
    };
    upright.iter().chain(axes).copied().chain(across).all(meet)
}

/// Cuts a box of cells in two along its longest side; None for a single cell.
fn halves(low: Cell, high: Cell) -> Option<[(Cell, Cell); 2]> {
    let axis = (0..3).max_by_key(|axis| high[*axis] - low[*axis])?;
    if high[axis] == low[axis] {
        return None;
    }
    let middle = low[axis] + (high[axis] - low[axis]) / 2;
    let (mut end, mut start) = (high, low);
    (end[axis], start[axis]) = (middle, middle + 1);
    Some([(low, end), (start, high)])
}

fn extent(corners: &[Vector3<f64>; 3]) -> (Point, Point) {
    let [a, b, c] = corners;
    (a.inf(b).inf(c).into(), a.sup(b).sup(c).into())
}

/// The centres of the cells of a grid, with a boundary at the origin, that the triangles of a mesh touch.
///
/// # Errors
/// When they are too many, or too far away for the grid.
pub fn cells_of_mesh(mesh: &Mesh, edge: f64) -> SceneResult<Vec<Point>> {
    let mut grid = Grid::new(edge);
    grid.add_surface(mesh)?;
    Ok(grid.centres())
}

/// The centres of the cells of a grid, with a boundary at the origin, that the voxels of an octree at `pose` overlap.
///
/// # Errors
/// When they are too many, or too far away for the grid.
pub fn cells_of_octree(tree: &OcTree, pose: &Pose, edge: f64) -> SceneResult<Vec<Point>> {
    let mut grid = Grid::new(edge);
    for (centre, _) in tree.voxels() {
        grid.add_cube(
            tree.voxel_size(),
            &(pose * Pose::translation(centre[0], centre[1], centre[2])),
        )?;
    }
    Ok(grid.centres())
}

impl Scene {
    /// The centres of the cells an object takes in the grid of that edge through `frame`, in that frame: those that the triangles of a
    /// shape touch, that voxels overlap, or that points are in.
    ///
    /// # Errors
    /// When the object has no voxels, or they are too many.
    pub fn cells_of(&self, handle: Handle, frame: Handle, edge: f64) -> SceneResult<Vec<Point>> {
        let pose = self.world_pose(frame)?.inverse() * self.world_pose(handle)?;
        match &self.object(handle)?.kind {
            Kind::Shape(shape) => {
                let mut mesh = shape.mesh();
                mesh.transform(&pose);
                cells_of_mesh(&mesh, edge)
            }
            Kind::OcTree(tree) => cells_of_octree(tree, &pose, edge),
            _ => self.points_of(handle, frame, edge),
        }
    }

    /// Points that stand for an object, in the frame of another: the centres of the cells of that edge that a shape's triangles touch, of
    /// the voxels of an octree, the points of a point cloud, or where a dummy is.
    ///
    /// # Errors
    /// As for [`cells_of`](Self::cells_of).
    pub fn points_of(&self, handle: Handle, frame: Handle, edge: f64) -> SceneResult<Vec<Point>> {
        let pose = self.world_pose(frame)?.inverse() * self.world_pose(handle)?;
        let moved = |point: Point| <Point>::from(pose * Point3::from(point));
        Ok(match &self.object(handle)?.kind {
            Kind::Shape(_) => self.cells_of(handle, frame, edge)?,
            Kind::OcTree(tree) => tree.voxels().map(|(centre, _)| moved(centre)).collect(),
            Kind::PointCloud(cloud) => cloud
                .points
                .iter()
                .map(|point| moved(point.position))
                .collect(),
            Kind::Dummy(_) => vec![moved([0.0; 3])],
            _ => {
                return Err(SceneError::Refused(
                    "object is not a shape, octree, point cloud or dummy.".into(),
                ));
            }
        })
    }

    /// A point cloud without the points that lie within `tolerance` metres of an object: of the triangles of a shape, of voxels, or of points.
    ///
    /// # Errors
    /// When the first is no point cloud, or the other has no voxels.
    pub fn cloud_without(
        &self,
        cloud: Handle,
        handle: Handle,
        tolerance: f64,
    ) -> SceneResult<PointCloud> {
        let mut rest = self.object(cloud)?.point_cloud()?.clone();
        let pose = self.world_pose(handle)?.inverse() * self.world_pose(cloud)?;
        let local = |point: &Point| <Point>::from(pose * Point3::from(*point));
        match &self.object(handle)?.kind {
            Kind::Shape(shape) => {
                let mesh = shape.mesh();
                let corners = mesh
                    .vertices
                    .iter()
                    .map(|corner| Vector::from_array(*corner))
                    .collect();
                let surface = TriMesh::new(corners, mesh.triangles)
                    .map_err(|_| SceneError::OperationFailed)?;
                let distance =
                    |point: Point| surface.distance_to_local_point(Vector::from_array(point), true);
                let is_near = |point: &Point| distance(local(point)) <= tolerance;
                rest.points.retain(|point| !is_near(&point.position));
            }
            Kind::OcTree(tree) => rest
                .points
                .retain(|point| !tree.is_within(local(&point.position), tolerance)),
            _ => rest.remove(&self.points_of(handle, cloud, 1.0)?, tolerance),
        }
        Ok(rest)
    }
}

impl OcTree {
    /// Whether a point lies within `tolerance` metres of a voxel.
    pub fn is_within(&self, point: Point, tolerance: f64) -> bool {
        let half = 0.5 * self.voxel_size();
        let outside = |at: f64, centre: f64| ((at - centre).abs() - half).max(0.0);
        self.layers(point[2] - tolerance, point[2] + tolerance)
            .any(|centre| {
                let squared: f64 = (0..3)
                    .map(|axis| outside(point[axis], centre[axis]).powi(2))
                    .sum();
                squared <= tolerance * tolerance
            })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::shape::Shape;
    use crate::voxels::octree::Voxel;
    use geometry::PrimitiveKind;

    fn cube(scene: &mut Scene, edge: f64) -> Handle {
        let shape = Shape::primitive(PrimitiveKind::Cuboid, [edge; 3], Default::default()).unwrap();
        scene.add("c", Kind::Shape(Box::new(shape))).unwrap()
    }

    fn octree(scene: &mut Scene, edge: f64, voxels: &[Point]) -> Handle {
        let mut tree = OcTree::new(edge, 1.0);
        voxels.iter().for_each(|voxel| {
            tree.insert(
                *voxel,
                Voxel {
                    colour: [0; 3],
                    tag: 0,
                },
            );
        });
        scene.add("o", Kind::OcTree(Box::new(tree))).unwrap()
    }

    #[test]
    fn a_shape_takes_the_cells_its_faces_touch() {
        let mut scene = Scene::new();
        let (shape, tree) = (cube(&mut scene, 0.1), octree(&mut scene, 0.02, &[]));
        // From -0.05 to 0.05: six cells a side, of which the inner ones are not touched.
        assert_eq!(
            scene.cells_of(shape, tree, 0.02).unwrap().len(),
            6 * 6 * 6 - 4 * 4 * 4
        );
        scene
            .set_world_pose(tree, Pose::translation(0.01, 0.01, 0.01))
            .unwrap();
        // From -0.06 to 0.04, on boundaries: the cells on both sides.
        assert_eq!(
            scene.cells_of(shape, tree, 0.02).unwrap().len(),
            7 * 7 * 7 - 3 * 3 * 3
        );
    }

    #[test]
    fn voxels_are_solid_and_take_no_neighbours() {
        let mut scene = Scene::new();
        let (large, small) = (
            octree(&mut scene, 0.1, &[[0.05; 3]]),
            octree(&mut scene, 0.02, &[]),
        );
        assert_eq!(scene.cells_of(large, small, 0.02).unwrap().len(), 125);
        assert_eq!(scene.points_of(large, small, 0.02).unwrap(), [[0.05; 3]]);
        let tree = scene.object(large).unwrap().octree().unwrap();
        assert!(
            tree.is_within([0.15, 0.05, 0.05], 0.051) && !tree.is_within([0.15, 0.15, 0.05], 0.06)
        );
    }

    #[test]
    fn too_many_cells_and_wrong_kinds_are_refused() {
        let mut scene = Scene::new();
        let (shape, tree) = (cube(&mut scene, 50.0), octree(&mut scene, 0.001, &[]));
        assert!(scene.cells_of(shape, tree, 0.001).is_err());
        scene
            .set_world_pose(shape, Pose::translation(1e12, 0.0, 0.0))
            .unwrap();
        assert!(scene.cells_of(shape, tree, 0.001).is_err());
        let graph = scene.add("g", Kind::Graph(Default::default())).unwrap();
        assert!(scene.points_of(graph, tree, 0.1).is_err());
    }
}
