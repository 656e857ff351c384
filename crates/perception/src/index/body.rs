//! Body of an object for queries: its geometry and pose.

use std::cell::OnceCell;
use std::collections::BTreeMap;
use std::rc::Rc;

use geometry::Mesh;
use proximity::{Bounds, Geometry, Placed, PointSet, TriangleMesh, VoxelGrid};

use super::growth::Growth;
use scene::{Kind, Object, Pose, Uid};

/// A mesh, prepared for queries when the first one comes near. Copies of a shape share it.
#[derive(Debug)]
pub(super) struct SharedMesh {
    mesh: Rc<Mesh>,
    bounds: Bounds,
    prepared: OnceCell<Option<TriangleMesh>>,
}

impl SharedMesh {
    fn prepared(&self) -> Option<&TriangleMesh> {
        let prepare = || TriangleMesh::new(&self.mesh.vertices, &self.mesh.triangles);
        self.prepared.get_or_init(prepare).as_ref()
    }
}

/// The meshes of all bodies by their addresses, which are only looked up.
#[derive(Debug, Default)]
pub(super) struct Meshes(BTreeMap<usize, Rc<SharedMesh>>);

impl Meshes {
    fn share(&mut self, mesh: &Rc<Mesh>) -> Rc<SharedMesh> {
        let new = || {
            let bounds = Bounds::around(&mesh.vertices);
            Rc::new(SharedMesh {
                mesh: Rc::clone(mesh),
                bounds,
                prepared: OnceCell::new(),
            })
        };
        // A mesh that is here cannot be freed, so its address is its own.
        Rc::clone(self.0.entry(Rc::as_ptr(mesh) as usize).or_insert_with(new))
    }

    #[cfg(test)]
    pub(super) fn count(&self) -> usize {
        self.0.len()
    }

    /// Drops meshes that no body has.
    pub(super) fn drop_unused(&mut self) {
        self.0.retain(|_, mesh| Rc::strong_count(mesh) > 1);
    }
}

/// An object with geometry.
#[derive(Debug)]
pub(crate) struct Body {
    pub(super) uid: Uid,
    parts: Vec<Part>,
    /// Of an octree.
    growth: Option<Growth>,
    /// In the world.
    pub(crate) bounds: Bounds,
}

#[derive(Debug)]
pub(super) struct Part {
    solid: Solid,
    /// In the frame of the object.
    local: Pose,
    /// In the world, as are the bounds.
    pose: Pose,
    bounds: Bounds,
}

#[derive(Debug)]
enum Solid {
    Mesh(Rc<SharedMesh>),
    Voxels(VoxelGrid),
    Points(PointSet),
    Point,
}

impl Body {
    /// The body of an object; none for objects without geometry. It has no place yet.
    pub(super) fn of(object: &Object, meshes: &mut Meshes) -> Option<Self> {
        let parts: Vec<Part> = match &object.kind {
            Kind::Shape(shape) => {
                let part = |part: &scene::shape::Part| {
                    Part::new(Solid::Mesh(meshes.share(&part.mesh)), part.pose)
                };
                shape.parts.iter().map(part).collect()
            }
            Kind::OcTree(tree) => {
                let grid =
                    VoxelGrid::new(tree.voxel_size(), tree.voxels().map(|(centre, _)| centre));
                grid.map(Solid::Voxels)
                    .into_iter()
                    .map(Part::centred)
                    .collect()
            }
            Kind::PointCloud(cloud) => {
                let points: Vec<_> = cloud.points.iter().map(|point| point.position).collect();
                PointSet::new(&points)
                    .map(Solid::Points)
                    .into_iter()
                    .map(Part::centred)
                    .collect()
            }
            Kind::Dummy(_) => vec![Part::centred(Solid::Point)],
            _ => return None,
        };
        Some(Self {
            uid: object.uid(),
            parts,
            growth: object.octree().ok().map(Growth::of),
            bounds: Bounds::EMPTY,
        })
    }

    /// Follows an object whose geometry has changed; false when the body has to be made anew.
    pub(super) fn follow(&mut self, object: &Object) -> bool {
        let (Some(growth), Ok(tree)) = (&mut self.growth, object.octree()) else {
            return false;
        };
        self.uid == object.uid() && growth.follow(tree, &mut self.parts)
    }

    /// Puts it at a pose in the world.
    pub(super) fn place(&mut self, pose: &Pose) {
        for part in &mut self.parts {
            part.pose = pose * part.local;
            part.bounds = part.solid.bounds().transformed(&part.pose);
        }
        self.bounds = self
            .parts
            .iter()
            .fold(Bounds::EMPTY, |bounds, part| bounds.merged(&part.bounds));
    }

    /// Its parts with the boxes around them in the world. Meshes without area are left out.
    pub(crate) fn parts(&self) -> impl Iterator<Item = (Placed<'_>, &Bounds)> {
        self.parts
            .iter()
            .filter_map(|part| Some((part.placed()?, &part.bounds)))
    }

    /// Whether it is a single point.
    pub(crate) fn is_point(&self) -> bool {
        matches!(
            self.parts.as_slice(),
            [Part {
                solid: Solid::Point,
                ..
            }]
        )
    }
}

impl Part {
    fn new(solid: Solid, local: Pose) -> Self {
        Self {
            solid,
            local,
            pose: local,
            bounds: Bounds::EMPTY,
        }
    }

    pub(super) fn of_voxels(grid: VoxelGrid) -> Self {
        Self::centred(Solid::Voxels(grid))
    }

    fn centred(solid: Solid) -> Self {
        Self::new(solid, Pose::identity())
    }

    fn placed(&self) -> Option<Placed<'_>> {
        Some(Placed {
            geometry: self.solid.geometry()?,
            pose: self.pose,
        })
    }
}

impl Solid {
    /// In its frame.
    fn bounds(&self) -> Bounds {
        match self {
            Self::Mesh(mesh) => mesh.bounds,
            Self::Voxels(grid) => grid.bounds(),
            Self::Points(points) => points.bounds(),
            Self::Point => Bounds {
                min: [0.0; 3],
                max: [0.0; 3],
            },
        }
    }

    fn geometry(&self) -> Option<Geometry<'_>> {
        Some(match self {
            Self::Mesh(mesh) => Geometry::Mesh(mesh.prepared()?),
            Self::Voxels(grid) => Geometry::Voxels(grid),
            Self::Points(points) => Geometry::Points(points),
            Self::Point => Geometry::Point,
        })
    }
}
