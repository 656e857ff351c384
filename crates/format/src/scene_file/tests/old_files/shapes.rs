//! Geometry and mass of shapes.

use super::{file, loaded, object, one};
use crate::ttt::chunks::{MeshData, MeshNode, MeshPool, Shape as Chunk, ShapeGeometry};
use crate::ttt::tree::{Class, Contents, Mesh as FileMesh, MeshTree};
use crate::ttt::{Heights, Indices, Normals, PositionFirst, Rest};
use geometry::PrimitiveKind;
use scene::Pose;
use scene::shape::Shape;

/// A cube of one metre around the origin.
const CORNERS: [[f32; 3]; 8] = [
    [-0.5, -0.5, -0.5],
    [0.5, -0.5, -0.5],
    [-0.5, 0.5, -0.5],
    [0.5, 0.5, -0.5],
    [-0.5, -0.5, 0.5],
    [0.5, -0.5, 0.5],
    [-0.5, 0.5, 0.5],
    [0.5, 0.5, 0.5],
];

#[rustfmt::skip]
const FACES: [i32; 36] = [
    0, 2, 1, 1, 2, 3, 4, 5, 6, 5, 7, 6, 0, 1, 4, 1, 5, 4, 2, 6, 3, 3, 6, 7, 0, 4, 2, 2, 4, 6, 1, 3, 5, 3, 7, 5,
];

pub(super) fn cube() -> MeshData {
    MeshData {
        vertices: Some(Rest(CORNERS.as_flattened().to_vec())),
        indices: Some(Indices(FACES.to_vec())),
        switches_2: Some(1),
        ..MeshData::default()
    }
}

pub(super) fn simple(node: MeshNode, data: MeshData) -> Chunk {
    let geometry = ShapeGeometry {
        mesh: Some(FileMesh { node, data }),
        ..ShapeGeometry::default()
    };
    Chunk {
        geometry: Some(geometry),
        ..Chunk::default()
    }
}

pub(super) fn shape(chunk: Chunk) -> Shape {
    one(Class::Shape(Box::new(chunk))).shape().unwrap().clone()
}

fn error(chunk: Chunk) -> String {
    let contents = Contents {
        objects: vec![object(1, -1, Class::Shape(Box::new(chunk)))],
        ..Contents::default()
    };
    let read = super::SceneFile::new(file(41_000, 25, contents));
    read.err().expect("it is damaged").to_string()
}

fn at(x: f64, y: f64, z: f64) -> PositionFirst {
    Pose::translation(x, y, z).into()
}

/// A quarter turn about z, at x.
fn turned(x: f64) -> Pose {
    Pose::new(
        [x, 0.0, 0.0].into(),
        [0.0, 0.0, std::f64::consts::FRAC_PI_2].into(),
    )
}

#[test]
fn geometry_that_is_damaged() {
    let node = MeshNode::default;
    let changed = |change: &dyn Fn(&mut MeshData)| {
        let mut data = cube();
        change(&mut data);
        error(simple(node(), data))
    };
    assert!(error(Chunk::default()).contains("no geometry"));
    let empty = Chunk {
        geometry: Some(ShapeGeometry::default()),
        ..Chunk::default()
    };
    assert!(error(empty).contains("neither a mesh nor a group"));
    let group = ShapeGeometry {
        group: Some(node()),
        ..ShapeGeometry::default()
    };
    assert!(
        error(Chunk {
            geometry: Some(group),
            ..Chunk::default()
        })
        .contains("no meshes")
    );
    assert!(changed(&|data| data.vertices = None).contains("not there"));
    assert!(changed(&|data| data.indices = Some(Indices(vec![0, 1, 8]))).contains("corner"));
    assert!(changed(&|data| data.indices = Some(Indices(Vec::new()))).contains("empty"));
    assert!(changed(&|data| data.vertices = Some(Rest(Vec::new()))).contains("empty"));
    assert!(changed(&|data| data.vertices = Some(Rest(vec![f32::NAN; 24]))).contains("not finite"));
}

#[test]
fn arrays_of_the_pool_are_counted_apart() {
    let far: Vec<f32> = CORNERS.as_flattened().iter().map(|c| c + 10.0).collect();
    let up = [0.0, 0.0, 1.0].repeat(36);
    let pool = MeshPool {
        vertices: vec![Rest(vec![0.0; 9]), Rest(far)],
        indices: vec![Indices(FACES.to_vec())],
        normals: vec![Normals(vec![0.0; 9]), Normals(up)],
        edges: Vec::new(),
    };
    let data = |normals| MeshData {
        vertices_at: Some(1),
        indices_at: Some(0),
        normals_at: Some(normals),
        switches_2: Some(1),
        ..MeshData::default()
    };
    let shapes = [1, 0].map(|normals| {
        let class = Class::Shape(Box::new(simple(MeshNode::default(), data(normals))));
        object(normals, -1, class)
    });
    let contents = Contents {
        objects: shapes.into(),
        mesh_pool: Some(pool),
        ..Contents::default()
    };
    let (scene, made) = loaded(file(40_100, 22, contents));
    let [first, second] = [0, 1].map(|at| {
        let shape = scene.object(made.objects[at]).unwrap().shape().unwrap();
        shape.parts[0].mesh.clone()
    });
    assert_eq!(
        (first.vertices[0], first.normals[0]),
        ([9.5; 3], [0.0, 0.0, 1.0])
    );
    // Those that are too few are computed: the first triangle looks down.
    assert_eq!(second.normals[0], [0.0, 0.0, -1.0]);
}

#[test]
fn the_frame_of_old_vertices_is_one_of_the_shape() {
    let old = MeshData {
        old_vertex_frame: Some(turned(2.0).into()),
        ..cube()
    };
    let part = &shape(simple(MeshNode::default(), old.clone())).parts[0];
    let (low, high) = part.mesh.aabb().unwrap();
    assert!((low[0] - 1.5).abs() < 1e-12 && (high[0] - 2.5).abs() < 1e-12);
    // A primitive is centred in a frame of its own.
    let cuboid = MeshData {
        primitive: Some((3, [1.0, -1.0, 1.0])),
        ..old
    };
    let part = &shape(simple(MeshNode::default(), cuboid)).parts[0];
    let kind = part.primitive.as_ref().unwrap();
    assert_eq!((kind.kind, kind.size), (PrimitiveKind::Cuboid, [1.0; 3]));
    assert!((part.pose.translation.x - 2.0).abs() < 1e-12);
    assert_eq!(part.mesh.aabb(), Some(([-0.5; 3], [0.5; 3])));
}

#[test]
fn frames_in_groups_are_relative_or_once_were_those_of_the_shape() {
    let child = |frame, old_frame, old_vertex_frame| {
        let node = MeshNode {
            frame,
            old_frame,
            box_frame: Some(at(0.0, 0.0, 3.0)),
            ..MeshNode::default()
        };
        let data = MeshData {
            old_vertex_frame,
            ..cube()
        };
        MeshTree::Mesh(Box::new(FileMesh { node, data }))
    };
    let group = |frame: Option<PositionFirst>, old_frame, children| {
        let inner = MeshNode {
            old_frame,
            frame,
            children,
            ..MeshNode::default()
        };
        let root = MeshNode {
            children: vec![MeshTree::Group(Box::new(inner))],
            ..MeshNode::default()
        };
        let geometry = ShapeGeometry {
            group: Some(root),
            ..ShapeGeometry::default()
        };
        shape(Chunk {
            geometry: Some(geometry),
            ..Chunk::default()
        })
    };
    let heights = |shape: &Shape| {
        let middle = |part: &scene::shape::Part| {
            let (low, high) = part.mesh.aabb().unwrap();
            let point = nalgebra::Point3::from([0, 1, 2].map(|i| (low[i] + high[i]) / 2.0));
            (part.pose * point).z
        };
        shape.parts.iter().map(middle).collect::<Vec<_>>()
    };
    let up = |z| Some(at(0.0, 0.0, z));
    let new = group(
        up(1.0),
        None,
        vec![child(up(2.0), None, None), child(up(4.0), None, None)],
    );
    assert_eq!(heights(&new), [6.0, 8.0]);
    assert_eq!(
        [&new.parts[0].group[..], &new.parts[1].group[..]],
        [[0], [0]]
    );
    let old = group(
        None,
        up(1.0),
        vec![child(None, up(2.0), up(7.0)), child(None, None, up(9.0))],
    );
    assert_eq!(heights(&old), [7.0, 9.0]);
    assert_eq!(
        [
            old.parts[0].pose.translation.z,
            old.parts[1].pose.translation.z
        ],
        [2.0, 1.0]
    );
    let alone = group(up(1.0), None, vec![child(up(2.0), None, None)]);
    assert!(alone.parts[0].group.is_empty());
}

#[test]
fn masses() {
    let mass = |node| shape(simple(node, cube())).mass;
    for wrong in [Some(0.0), Some(-1.0), Some(f64::NAN), None] {
        assert_eq!(
            mass(MeshNode {
                mass: wrong,
                ..MeshNode::default()
            })
            .mass,
            0.001,
            "{wrong:?}"
        );
    }
    // Along x when the axes are not turned, along y when they are.
    let old = (turned(0.5).into(), [1.0, 2.0, 3.0]);
    let old = mass(MeshNode {
        mass: Some(2.0),
        old_inertia: Some(old),
        ..MeshNode::default()
    });
    assert_eq!((old.mass, old.com), (2.0, [0.5, 0.0, 0.0]));
    assert!((old.inertia[(0, 0)] - 2.0).abs() < 1e-9 && (old.inertia[(1, 1)] - 1.0).abs() < 1e-9);
    let tensor = [1.0, 0.5, 0.0, 0.25, 0.0, 0.0, 0.0, 0.0, 2.0];
    let new = |centre_of_mass, inertia| {
        mass(MeshNode {
            centre_of_mass: Some(centre_of_mass),
            inertia: Some(inertia),
            ..MeshNode::default()
        })
    };
    let symmetric = new([1.0, 2.0, 3.0], tensor);
    assert_eq!(symmetric.com, [1.0, 2.0, 3.0]);
    assert_eq!(
        (symmetric.inertia[(0, 1)], symmetric.inertia[(1, 0)]),
        (0.375, 0.375)
    );
    assert_eq!(
        (symmetric.inertia[(1, 1)], symmetric.inertia[(2, 2)]),
        (1e-8, 2.0)
    );
    assert_eq!(new([f64::NAN, 0.0, 0.0], tensor).com, [0.0; 3]);
}

#[test]
fn the_box_of_a_shape_is_around_its_meshes_where_the_file_has_none() {
    let shifted = MeshData {
        old_vertex_frame: Some(at(2.0, 0.0, 0.0)),
        ..cube()
    };
    let simple = shape(simple(MeshNode::default(), shifted.clone()));
    assert_eq!(simple.bounding_box.size, [1.0; 3]);
    assert!((simple.bounding_box.pose.translation.x - 2.0).abs() < 1e-12);
    let child = |data| {
        MeshTree::Mesh(Box::new(FileMesh {
            node: MeshNode::default(),
            data,
        }))
    };
    let root = MeshNode {
        children: vec![child(cube()), child(shifted)],
        ..MeshNode::default()
    };
    let geometry = ShapeGeometry {
        group: Some(root),
        ..ShapeGeometry::default()
    };
    let both = shape(Chunk {
        geometry: Some(geometry),
        ..Chunk::default()
    });
    assert!((0..3).all(|i| (both.bounding_box.size[i] - [3.0, 1.0, 1.0][i]).abs() < 1e-9));
    assert!((both.bounding_box.pose.translation.x - 1.0).abs() < 1e-9);
}

#[test]
fn primitives_of_old_files() {
    let primitive = |kind, size, heightfield| {
        let data = MeshData {
            primitive: Some((kind, size)),
            heightfield,
            ..cube()
        };
        let shape = shape(simple(MeshNode::default(), data));
        shape.parts[0].primitive.as_ref().map(|p| (p.kind, p.size))
    };
    let round = [2.0, 0.0, 3.0];
    for (kind, expected) in [
        (5, PrimitiveKind::Cylinder),
        (6, PrimitiveKind::Cone),
        (8, PrimitiveKind::Capsule),
        (2, PrimitiveKind::Disc),
    ] {
        assert_eq!(
            primitive(kind, round, None),
            Some((expected, [2.0, 2.0, 3.0]))
        );
        assert_eq!(
            primitive(kind, [2.0, 1.0, 3.0], None),
            Some((expected, [2.0, 1.0, 3.0]))
        );
    }
    assert_eq!(
        primitive(1, round, None),
        Some((PrimitiveKind::Plane, round))
    );
    assert_eq!(
        [
            primitive(0, round, None),
            primitive(3, [f64::NAN, 1.0, 1.0], None)
        ],
        [None; 2]
    );
    let field = |columns, rows| {
        Some(Heights {
            columns,
            rows,
            heights: vec![0.0; columns * rows],
        })
    };
    let known = |field| primitive(7, [1.0; 3], field).is_some();
    assert!(known(field(2, 2)) && known(field(2, 3)));
    assert!(!known(None) && !known(field(1, 2)) && !known(field(2, 1)) && !known(field(0, 0)));
    assert_eq!(
        primitive(3, [1.0; 3], field(2, 2)),
        Some((PrimitiveKind::Cuboid, [1.0; 3]))
    );
}

#[test]
fn meshes_before_4_5_1_are_tested_for_being_convex() {
    // The corner at the top is pushed in, by so much of the mean side.
    let convex = |dent: f32, node_switches| {
        let mut corners = CORNERS;
        corners[7] = corners[7].map(|c| c - dent);
        let data = MeshData {
            vertices: Some(Rest(corners.as_flattened().to_vec())),
            switches_2: None,
            ..cube()
        };
        let node = MeshNode {
            switches: Some(node_switches),
            ..MeshNode::default()
        };
        let part = shape(simple(node, data)).parts[0].clone();
        (part.convex, part.mesh.triangles.len())
    };
    assert_eq!(convex(0.0, 0), (true, 12));
    assert_eq!(convex(0.01, 0), (true, 12));
    assert_eq!(convex(0.5, 0xfb), (false, 12));
    // What was said to be convex becomes its hull.
    let (is_convex, triangles) = convex(0.5, 0x4);
    assert!(is_convex && triangles < 12, "{triangles}");
    let known = |switches| {
        let data = MeshData {
            switches_2: Some(switches),
            ..cube()
        };
        shape(simple(MeshNode::default(), data)).parts[0].convex
    };
    assert_eq!([known(1), known(0xfe)], [true, false]);
}
