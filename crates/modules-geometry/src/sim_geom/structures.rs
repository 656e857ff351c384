//! The meshes, octrees and point clouds of a script.

use std::cell::{Cell, RefCell};
use std::collections::BTreeMap;
use std::rc::Rc;

use geometry::{Mesh, Pose};
use proximity::{Geometry, Placed, PointSet, TriangleMesh, VoxelGrid};

use super::{ApiError, Result, refused};
use scene::voxels::octree::OcTree;
use scene::voxels::point_cloud::PointCloud;

/// Structures created by a script. They are dropped with the script's state.
#[derive(Default)]
pub(super) struct Structures {
    pub meshes: Store<MeshStructure>,
    pub octrees: Store<OctreeStructure>,
    pub point_clouds: Store<CloudStructure>,
}

/// Structures of one kind, by handles from 0.
pub(super) struct Store<T> {
    items: RefCell<BTreeMap<i64, Rc<T>>>,
    next: Cell<i64>,
}

impl<T> Default for Store<T> {
    fn default() -> Self {
        Self {
            items: RefCell::default(),
            next: Cell::new(0),
        }
    }
}

/// A kind of structures, in the words of errors.
pub(super) trait Structure {
    const KIND: &'static str;
}

impl<T: Structure> Store<T> {
    pub fn add(&self, item: T) -> i64 {
        let handle = self.next.replace(self.next.get() + 1);
        self.items.borrow_mut().insert(handle, Rc::new(item));
        handle
    }

    pub fn get(&self, handle: i64) -> Result<Rc<T>> {
        self.items
            .borrow()
            .get(&handle)
            .cloned()
            .ok_or_else(|| unknown::<T>(handle))
    }

    pub fn replace(&self, handle: i64, item: T) {
        self.items.borrow_mut().insert(handle, Rc::new(item));
    }

    pub fn remove(&self, handle: i64) -> Result<()> {
        self.items
            .borrow_mut()
            .remove(&handle)
            .map(drop)
            .ok_or_else(|| unknown::<T>(handle))
    }
}

fn unknown<T: Structure>(handle: i64) -> ApiError {
    refused(&format!(
        "invalid handle: there is no {} {handle} in this script.",
        T::KIND
    ))
}

/// A mesh in its own frame. Without a triangle that has an area there is nothing to query.
pub(super) struct MeshStructure {
    pub mesh: Mesh,
    surface: Option<TriangleMesh>,
}

impl MeshStructure {
    pub fn new(mesh: Mesh) -> Self {
        let surface = TriangleMesh::new(&mesh.vertices, &mesh.triangles);
        Self { mesh, surface }
    }

    pub fn placed(&self, pose: Pose) -> Option<Placed<'_>> {
        self.surface.as_ref().map(|mesh| Placed {
            geometry: Geometry::Mesh(mesh),
            pose,
        })
    }
}

/// An octree in its own frame.
pub(super) struct OctreeStructure {
    pub tree: OcTree,
    grid: Option<VoxelGrid>,
}

impl OctreeStructure {
    pub fn new(tree: OcTree) -> Self {
        let grid = VoxelGrid::new(tree.voxel_size(), tree.voxels().map(|(centre, _)| centre));
        Self { tree, grid }
    }

    pub fn placed(&self, pose: Pose) -> Option<Placed<'_>> {
        self.grid.as_ref().map(|grid| Placed {
            geometry: Geometry::Voxels(grid),
            pose,
        })
    }
}

/// A point cloud in its own frame.
pub(super) struct CloudStructure {
    pub cloud: PointCloud,
    set: Option<PointSet>,
}

impl CloudStructure {
    pub fn new(cloud: PointCloud) -> Self {
        let positions: Vec<[f64; 3]> = cloud.points.iter().map(|point| point.position).collect();
        let set = PointSet::new(&positions);
        Self { cloud, set }
    }

    pub fn placed(&self, pose: Pose) -> Option<Placed<'_>> {
        self.set.as_ref().map(|points| Placed {
            geometry: Geometry::Points(points),
            pose,
        })
    }
}

impl Structure for MeshStructure {
    const KIND: &'static str = "mesh";
}

impl Structure for OctreeStructure {
    const KIND: &'static str = "octree";
}

impl Structure for CloudStructure {
    const KIND: &'static str = "point cloud";
}
