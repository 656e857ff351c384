//! Structures as bytes, in a format of our own: a word of four letters, then numbers in little-endian order. Counts are compared with what is
//! there before anything is allocated.

use geometry::{Finite, Mesh};

use super::{ApiError, Result, refused};
use scene::voxels::octree::{OcTree, Voxel};
use scene::voxels::point_cloud::{CloudPoint, PointCloud};

const MESH: [u8; 4] = *b"sgM1";
const OCTREE: [u8; 4] = *b"sgO1";
const POINT_CLOUD: [u8; 4] = *b"sgP1";

/// Reads numbers from the front of bytes.
struct Reader<'a>(&'a [u8]);

impl<'a> Reader<'a> {
    fn new(bytes: &'a [u8], word: [u8; 4]) -> Option<Self> {
        bytes.strip_prefix(&word).map(Self)
    }

    fn take<const N: usize>(&mut self) -> Option<[u8; N]> {
        let (first, rest) = self.0.split_first_chunk()?;
        self.0 = rest;
        Some(*first)
    }

    /// How many records of `size` bytes there are: they must be.
    fn count(&mut self, size: usize) -> Option<usize> {
        let count = u32::from_le_bytes(self.take()?) as usize;
        (count <= self.0.len() / size).then_some(count)
    }

    fn number(&mut self) -> Option<f64> {
        f64::from_le_bytes(self.take()?).finite()
    }

    fn point(&mut self) -> Option<[f64; 3]> {
        Some([self.number()?, self.number()?, self.number()?])
    }

    fn integer(&mut self) -> Option<u32> {
        self.take().map(u32::from_le_bytes)
    }

    /// `value`, if nothing is left.
    fn end<T>(self, value: T) -> Option<T> {
        self.0.is_empty().then_some(value)
    }
}

fn put_count(bytes: &mut Vec<u8>, count: usize) -> Result<()> {
    let count =
        u32::try_from(count).map_err(|_| refused("the structure has too many elements."))?;
    bytes.extend(count.to_le_bytes());
    Ok(())
}

fn put_point(bytes: &mut Vec<u8>, point: &[f64; 3]) {
    point.iter().for_each(|x| bytes.extend(x.to_le_bytes()));
}

fn malformed() -> ApiError {
    refused("the data are no structure of this kind, or damaged.")
}

pub(super) fn of_mesh(mesh: &Mesh) -> Result<Vec<u8>> {
    let mut bytes = MESH.to_vec();
    put_count(&mut bytes, mesh.vertices.len())?;
    mesh.vertices
        .iter()
        .for_each(|vertex| put_point(&mut bytes, vertex));
    put_count(&mut bytes, mesh.triangles.len())?;
    mesh.triangles
        .as_flattened()
        .iter()
        .for_each(|index| bytes.extend(index.to_le_bytes()));
    Ok(bytes)
}

/// The mesh that [`of_mesh`] wrote.
///
/// # Errors
/// When it did not.
pub(super) fn to_mesh(bytes: &[u8]) -> Result<Mesh> {
    let read = || {
        let mut reader = Reader::new(bytes, MESH)?;
        let vertices = (0..reader.count(24)?)
            .map(|_| reader.point())
            .collect::<Option<Vec<_>>>()?;
        let corner =
            |reader: &mut Reader| Some([reader.integer()?, reader.integer()?, reader.integer()?]);
        let triangles = (0..reader.count(12)?)
            .map(|_| corner(&mut reader))
            .collect::<Option<Vec<_>>>()?;
        reader.end(())?;
        Mesh::new(vertices, triangles).ok()
    };
    read().ok_or_else(malformed)
}

pub(super) fn of_octree(tree: &OcTree) -> Result<Vec<u8>> {
    let mut bytes = OCTREE.to_vec();
    bytes.extend(tree.voxel_size().to_le_bytes());
    put_count(&mut bytes, tree.len())?;
    for (centre, voxel) in tree.voxels() {
        put_point(&mut bytes, &centre);
        bytes.extend(voxel.colour);
        bytes.extend(voxel.tag.to_le_bytes());
    }
    Ok(bytes)
}

/// The octree that [`of_octree`] wrote.
///
/// # Errors
/// When it did not.
pub(super) fn to_octree(bytes: &[u8]) -> Result<OcTree> {
    let read = || {
        let mut reader = Reader::new(bytes, OCTREE)?;
        let size = reader.number().filter(|size| *size > 0.0)?;
        // A scaled octree may have a voxel size that is not allowed for a new one.
        let mut tree = OcTree::new(1.0, 1.0);
        tree.scale(size);
        for _ in 0..reader.count(31)? {
            let centre = reader.point()?;
            tree.insert(
                centre,
                Voxel {
                    colour: reader.take()?,
                    tag: reader.integer()?,
                },
            );
        }
        reader.end(tree)
    };
    read().ok_or_else(malformed)
}

pub(super) fn of_point_cloud(cloud: &PointCloud) -> Result<Vec<u8>> {
    let mut bytes = POINT_CLOUD.to_vec();
    bytes.extend(cloud.max_cell_size.to_le_bytes());
    bytes.extend((cloud.max_points_in_cell.clamp(0, u32::MAX.into()) as u32).to_le_bytes());
    put_count(&mut bytes, cloud.points.len())?;
    for point in cloud.points.iter() {
        put_point(&mut bytes, &point.position);
        bytes.extend(point.colour);
    }
    Ok(bytes)
}

/// The point cloud that [`of_point_cloud`] wrote.
///
/// # Errors
/// When it did not.
pub(super) fn to_point_cloud(bytes: &[u8]) -> Result<PointCloud> {
    let read = || {
        let mut reader = Reader::new(bytes, POINT_CLOUD)?;
        let mut cloud = super::point_clouds::empty(reader.number()?, reader.integer()?.into());
        for _ in 0..reader.count(27)? {
            cloud.points.push(CloudPoint {
                position: reader.point()?,
                colour: reader.take()?,
            });
        }
        reader.end(cloud)
    };
    read().ok_or_else(malformed)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn mesh() -> Mesh {
        Mesh::new(
            vec![[0.0; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 0.5]],
            vec![[0, 1, 2]],
        )
        .unwrap()
    }

    fn octree() -> OcTree {
        let mut tree = OcTree::new(0.1, 1.0);
        tree.scale(30.0);
        tree.insert(
            [0.5; 3],
            Voxel {
                colour: [1, 2, 3],
                tag: 7,
            },
        );
        tree.insert(
            [-9.0; 3],
            Voxel {
                colour: [4, 5, 6],
                tag: 8,
            },
        );
        tree
    }

    fn cloud() -> PointCloud {
        let mut cloud = super::super::point_clouds::empty(0.05, 20);
        cloud.points.push(CloudPoint {
            position: [1.0, 2.0, 3.0],
            colour: [9, 8, 7],
        });
        cloud
    }

    #[test]
    fn structures_come_back() {
        assert_eq!(to_mesh(&of_mesh(&mesh()).unwrap()).unwrap(), mesh());
        assert_eq!(to_octree(&of_octree(&octree()).unwrap()).unwrap(), octree());
        assert_eq!(
            to_point_cloud(&of_point_cloud(&cloud()).unwrap()).unwrap(),
            cloud()
        );
    }

    /// Every prefix, and a byte too many.
    fn damaged(bytes: &[u8]) -> Vec<Vec<u8>> {
        let cut = (0..bytes.len()).map(|end| bytes[..end].to_vec());
        let longer = [bytes, &[0]].concat();
        cut.chain([longer]).collect()
    }

    #[test]
    fn damaged_data_are_refused() {
        let [mesh, octree, cloud] = [
            of_mesh(&mesh()).unwrap(),
            of_octree(&octree()).unwrap(),
            of_point_cloud(&cloud()).unwrap(),
        ];
        assert!(damaged(&mesh).iter().all(|bytes| to_mesh(bytes).is_err()));
        assert!(
            damaged(&octree)
                .iter()
                .all(|bytes| to_octree(bytes).is_err())
        );
        assert!(
            damaged(&cloud)
                .iter()
                .all(|bytes| to_point_cloud(bytes).is_err())
        );
        assert!(
            to_mesh(&octree).is_err()
                && to_octree(&cloud).is_err()
                && to_point_cloud(&mesh).is_err()
        );
    }

    #[test]
    fn what_is_written_over_changes_the_structure_or_is_refused() {
        let bytes = of_mesh(&mesh()).unwrap();
        for at in 0..bytes.len() {
            let mut changed = bytes.clone();
            changed[at] = 0xff;
            assert!(
                to_mesh(&changed).map_or(true, |other| other != mesh()),
                "byte {at}"
            );
        }
        let mut many = of_point_cloud(&cloud()).unwrap();
        many[16..20].fill(0xff);
        assert!(to_point_cloud(&many).is_err());
    }
}
